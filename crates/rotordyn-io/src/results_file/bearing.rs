//! Stand-alone ball bearings as data sets.

use super::GroupWriter;
use crate::error::Error;
use crate::hdf5::Store;
use rotordyn_bearing::ball_inertia::INERTIA_LIMIT;
use rotordyn_core::analysis::ball_inertia::InertiaUse;
use rotordyn_core::results::{BallState, BearingPoint, BearingResult, ContactState};

pub fn write(store: &Store, found: &[BearingResult]) -> Result<(), Error> {
    for bearing in found {
        let writer = GroupWriter::new(store, &format!("/bearings/{}", bearing.name))?;
        writer.set_attribute("load_source", bearing.load_source.as_str())?;
        if let Some(how) = bearing.bearing.estimated_geometry {
            writer.set_attribute("estimated_geometry", how)?;
        }
        let inertia = writer.subgroup("ball_inertia")?;
        inertia_use(&inertia, &bearing.ball_inertia)?;
        writer.set_attribute("preload_offset", bearing.preload.offset)?;
        writer.set_attribute("preload_force", bearing.preload.axial_force)?;
        if let Some(mounted) = &bearing.mounted_preload {
            writer.write_array("mounted_preload", &[mounted.rows.len()], &mounted.rows, "N")?;
        }
        for (name, value) in [
            ("dynamic_rating", bearing.rating.dynamic),
            ("static_rating", bearing.rating.static_rating),
            ("fatigue_limit", bearing.rating.fatigue),
        ] {
            writer.set_attribute(name, value)?;
        }
        let orders = &bearing.nominal_orders;
        for (name, value) in
            [("ftf", orders.ftf), ("bpfo", orders.bpfo), ("bpfi", orders.bpfi), ("bsf", orders.bsf)]
        {
            writer.set_attribute(name, value)?;
        }
        points(&writer.subgroup("operating")?, std::slice::from_ref(&bearing.point), None)?;
        for sweep in &bearing.sweeps {
            let at = writer.subgroup(&format!("sweep_{}", sweep.of.name()))?;
            at.set_attribute("label", sweep.label.as_str())?;
            at.write_array("swept_value", &[sweep.values.len()], &sweep.values, sweep.unit)?;
            points(&at, &sweep.points, Some("swept_value"))?;
        }
        for film in &bearing.films {
            let (at, fields) = (writer.subgroup(&format!("film_{}", film.race))?, &film.solution);
            for (name, value) in [
                ("load", film.load),
                ("entrainment_speed", film.speed),
                ("central_film", fields.central_film),
                ("minimum_film", fields.minimum_film),
                ("approach", fields.approach),
                ("rolling_force", fields.rolling_force),
            ] {
                at.set_attribute(name, value)?;
            }
            at.write_array("x", &[fields.x.len()], &fields.x, "m")?;
            at.write_array("y", &[fields.y.len()], &fields.y, "m")?;
            for (name, unit, data) in [("pressure", "Pa", &fields.pressure), ("film", "m", &fields.film)] {
                at.write_array(name, &[fields.x.len(), fields.y.len()], data, unit)?;
                at.attach_scale(name, 0, "x")?;
                at.attach_scale(name, 1, "y")?;
            }
        }
    }
    Ok(())
}

/// Arrays over \[point, ...\]; without an axis there is one point and no point dimension.
fn points(writer: &GroupWriter, points: &[BearingPoint], axis: Option<&str>) -> Result<(), Error> {
    let array = |name: &str, rest: &[usize], unit: &str, data: Vec<f64>| {
        let shape: Vec<usize> = axis.map(|_| points.len()).into_iter().chain(rest.iter().copied()).collect();
        writer.write_array(name, &shape, &data, unit)?;
        axis.map_or(Ok(()), |axis| writer.attach_scale(name, 0, axis))
    };
    let five = |pick: fn(&BearingPoint) -> &[f64; 5]| points.iter().flat_map(pick).copied().collect();
    array("load", &[5], "N, N m", five(|p| &p.state.load))?;
    array("displacement", &[5], "m, rad", five(|p| &p.state.displacement))?;
    let stiffness = points.iter().flat_map(|p| p.state.stiffness.as_flattened()).copied().collect();
    array("stiffness", &[5, 5], "N/m, N, N m/rad", stiffness)?;
    for (name, unit, value) in BearingPoint::COLUMNS {
        array(name, &[], unit, points.iter().map(value).collect())?;
    }
    let balls = points.first().map_or(0, |p| p.balls.len());
    let positions = points.iter().flat_map(|p| &p.balls).map(|b| b.position).collect();
    let rows = points.iter().flat_map(|p| &p.balls).map(|b| b.row as f64).collect();
    array("balls/row", &[balls], "1", rows)?;
    array("balls/position", &[balls], "rad", positions)?;
    for (name, unit, value) in BallState::COLUMNS {
        let data = points.iter().flat_map(|p| &p.balls).map(value).collect();
        array(&format!("balls/{name}"), &[balls], unit, data)?;
    }
    for (race, inner) in [("inner", true), ("outer", false)] {
        let pick = |b: &BallState| if inner { b.inner } else { b.outer };
        for (name, unit, value) in ContactState::COLUMNS {
            let data = points.iter().flat_map(|p| &p.balls).map(|b| value(&pick(b))).collect();
            array(&format!("balls/{race}/{name}"), &[balls], unit, data)?;
        }
    }
    Ok(())
}

/// Ball inertia of one bearing, and why, as attributes of a group.
pub fn inertia_use(writer: &GroupWriter, used: &InertiaUse) -> Result<(), Error> {
    let compared = &used.compared;
    writer.set_attribute("stated", used.inertia.keyword())?;
    writer.set_attribute("used", used.inertia.in_effect().keyword())?;
    for (name, value) in [
        ("speed", compared.speed),
        ("centrifugal_force", compared.centrifugal),
        ("largest_contact_load", compared.contact_load),
        ("ratio", compared.ratio()),
        ("limit", INERTIA_LIMIT),
    ] {
        writer.set_attribute(name, value)?;
    }
    Ok(())
}

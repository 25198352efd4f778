//! Equilibrium, modes, Campbell diagram, critical speeds, FRFs and unbalance response as data sets.

use super::GroupWriter;
use crate::error::Error;
use crate::hdf5::Store;
use rotordyn_core::analysis::Mode;
use rotordyn_core::analysis::critical_speed::CriticalSpeed;
use rotordyn_core::analysis::equilibrium::{CageTreatment, Equilibrium};
use rotordyn_core::analysis::peaks::Peak;
use rotordyn_core::results::{CampbellResult, FrfResult, ModalResult, UnbalanceResult, is_rotation, unit_of};
use rotordyn_core::study::Machine;
use rotordyn_linalg::Complex64;

const TO_RPM: f64 = 60.0 / std::f64::consts::TAU;

pub fn equilibrium(store: &Store, found: &Equilibrium, machine: &Machine) -> Result<(), Error> {
    let writer = GroupWriter::new(store, "/equilibrium")?;
    writer.set_attribute("speed", found.speed)?;
    writer.set_attribute(
        "cage",
        match found.cage {
            CageTreatment::FixedAngle => "fixed angle",
            CageTreatment::Averaged => "averaged over a ball pitch",
        },
    )?;
    writer.set_attribute("iterations", found.iterations as i64)?;
    writer.set_attribute("residual", found.residual)?;
    let q = machine.assembly.dofs.expand(&found.q);
    writer.write_array("displacement", &[q.len() / 6, 6], &q, "m, rad")?;
    for belt in &found.belts {
        let at = writer.subgroup(&format!("belts/{}", belt.name))?;
        at.write_array("stated_pull", &[2], &belt.stated, "N")?;
        at.write_array("pull", &[2], &belt.remaining, "N")?;
        at.write_array("displacement", &[2], &belt.displacement, "m")?;
    }
    for preload in &found.preloads {
        let at = writer.subgroup(&format!("preloads/{}", preload.bearing))?;
        at.write_array("axial_force", &[preload.rows.len()], &preload.rows, "N")?;
        if let Some(force) = preload.stated.force() {
            at.set_attribute("stated_force", force)?;
        }
    }
    for bearing in &found.bearings {
        let at = writer.subgroup(&format!("bearings/{}", bearing.name))?;
        at.set_attribute("largest_ball_load", bearing.largest_ball_load)?;
        at.write_array("force", &[6], &bearing.force, "N, N m")?;
        at.write_array("displacement", &[6], &bearing.displacement, "m, rad")?;
        at.write_array("stiffness", &[6, 6], bearing.tangent.stiffness.as_flattened(), "N/m, N, N m/rad")?;
        at.write_array("damping", &[6, 6], bearing.tangent.damping.as_flattened(), "N s/m, N s, N m s/rad")?;
        let balls = &bearing.balls;
        if !balls.is_empty() {
            let column = |value: fn(&rotordyn_bearing::BallLoad) -> f64| -> Vec<f64> {
                balls.iter().map(value).collect()
            };
            at.write_array("balls/position", &[balls.len()], &column(|b| b.position), "rad")?;
            at.write_array("balls/load", &[balls.len()], &column(|b| b.load), "N")?;
            at.write_array("balls/contact_angle", &[balls.len()], &column(|b| b.contact_angle), "rad")?;
            at.write_array("balls/deflection", &[balls.len()], &column(|b| b.deflection), "m")?;
        }
    }
    Ok(())
}

pub fn modes(store: &Store, found: &[ModalResult], machine: &Machine) -> Result<(), Error> {
    let writer = GroupWriter::new(store, "/modes")?;
    let max_modes = found.iter().map(|at| at.modes.len()).max().unwrap_or(0);
    let (speeds, dofs) = (found.len(), machine.assembly.dofs.full_len());
    let nodes = machine.assembly.dofs.shaft_nodes;
    let cells = || found.iter().flat_map(|at| (0..max_modes).map(|k| at.modes.get(k)));
    let one = |value: fn(&Mode) -> f64| -> Vec<f64> { cells().map(|m| m.map_or(f64::NAN, value)).collect() };
    let shape = [speeds, max_modes];
    writer.write_array("omega", &shape, &one(Mode::omega), "rad/s")?;
    writer.write_array("frequency", &shape, &one(Mode::frequency_hz), "Hz")?;
    writer.write_array("zeta", &shape, &one(Mode::zeta), "1")?;
    writer.write_array("log_dec", &shape, &one(Mode::log_dec), "1")?;
    let nan = Complex64::new(f64::NAN, f64::NAN);
    let eigenvalues: Vec<_> = cells().map(|m| m.map_or(nan, |m| m.eigenvalue)).collect();
    writer.write_complex("eigenvalue", &shape, &eigenvalues, "1/s")?;
    let shapes: Vec<Complex64> =
        cells().flat_map(|m| m.map_or_else(|| vec![nan; dofs], |m| m.full_shape.clone())).collect();
    writer.write_complex(
        "shapes",
        &[speeds, max_modes, dofs / 6, 6],
        &shapes,
        "m/sqrt(kg) m, rad/sqrt(kg) m",
    )?;
    let whirl: Vec<f64> =
        cells().flat_map(|m| m.map_or_else(|| vec![f64::NAN; nodes], |m| m.whirl.clone())).collect();
    writer.write_array("whirl", &[speeds, max_modes, nodes], &whirl, "1")?;
    let mass: Vec<f64> = cells().flat_map(|m| m.map_or([f64::NAN; 3], |m| m.effective_mass)).collect();
    writer.write_array("effective_mass", &[speeds, max_modes, 3], &mass, "1")?;
    let texts = |text: fn(&Mode) -> &str| -> Vec<&str> { cells().map(|m| m.map_or("", text)).collect() };
    writer.write_texts("kind", &shape, &texts(|m| m.kind.name()))?;
    writer.write_texts("label", &shape, &texts(|m| &m.label))?;
    let rpm: Vec<f64> = found.iter().map(|at| at.speed * TO_RPM).collect();
    writer.write_array("rpm", &[speeds], &rpm, "rpm")?;
    ["omega", "frequency", "zeta", "log_dec", "eigenvalue", "shapes", "whirl", "effective_mass"]
        .iter()
        .try_for_each(|name| writer.attach_scale(name, 0, "rpm"))
}

pub fn campbell(store: &Store, found: &CampbellResult) -> Result<(), Error> {
    let writer = GroupWriter::new(store, "/campbell")?;
    let diagram = &found.diagram;
    let shape = [diagram.branches.len(), diagram.speeds.len()];
    let rpm: Vec<f64> = diagram.speeds.iter().map(|s| s * TO_RPM).collect();
    writer.write_array("rpm", &[rpm.len()], &rpm, "rpm")?;
    for (name, value, unit) in [
        ("frequency", Mode::frequency_hz as fn(&Mode) -> f64, "Hz"),
        ("zeta", Mode::zeta, "1"),
        ("log_dec", Mode::log_dec, "1"),
    ] {
        let modes = diagram.branches.iter().flat_map(|b| &b.modes);
        let data: Vec<f64> = modes.map(|m| m.as_ref().map_or(f64::NAN, value)).collect();
        writer.write_array(name, &shape, &data, unit)?;
        writer.attach_scale(name, 1, "rpm")?;
    }
    let labels: Vec<&str> = diagram.branches.iter().map(|b| b.label.as_str()).collect();
    let kinds: Vec<&str> = diagram.branches.iter().map(|b| b.kind.name()).collect();
    writer.write_texts("label", &[labels.len()], &labels)?;
    writer.write_texts("kind", &[kinds.len()], &kinds)?;
    let each = diagram.branches.iter().flat_map(|b| &b.modes);
    let labels: Vec<&str> = each.map(|m| m.as_ref().map_or("", |m| m.label.as_str())).collect();
    writer.write_texts("labels", &shape, &labels)?;
    let names: Vec<&str> = found.orders.iter().map(|o| o.label.as_str()).collect();
    let orders: Vec<f64> = found.orders.iter().map(|o| o.order).collect();
    writer.write_texts("orders/label", &[names.len()], &names)?;
    writer.write_array("orders/order", &[orders.len()], &orders, "1/revolution")?;
    crossings(&writer.subgroup("crossings")?, &found.crossings.list)?;
    let at = writer.subgroup("thresholds")?;
    let speeds: Vec<f64> = found.thresholds.iter().map(|t| t.speed * TO_RPM).collect();
    let above: Vec<f64> = found.thresholds.iter().map(|t| f64::from(u8::from(t.unstable_above))).collect();
    let labels: Vec<&str> = found.thresholds.iter().map(|t| t.mode.label.as_str()).collect();
    at.write_array("rpm", &[speeds.len()], &speeds, "rpm")?;
    at.write_array("unstable_above", &[above.len()], &above, "1")?;
    at.write_texts("label", &[labels.len()], &labels)
}

pub fn crossings(writer: &GroupWriter, found: &[CriticalSpeed]) -> Result<(), Error> {
    let column = |value: fn(&CriticalSpeed) -> f64| -> Vec<f64> { found.iter().map(value).collect() };
    let shape = [found.len()];
    writer.write_array("rpm", &shape, &column(|c| c.speed * TO_RPM), "rpm")?;
    writer.write_array("order", &shape, &column(|c| c.order), "1/revolution")?;
    writer.write_array("frequency", &shape, &column(|c| c.mode.frequency_hz()), "Hz")?;
    writer.write_array("log_dec", &shape, &column(|c| c.mode.log_dec()), "1")?;
    writer.write_texts("whirl", &shape, &found.iter().map(|c| c.mode.kind.name()).collect::<Vec<_>>())?;
    writer.write_texts("label", &shape, &found.iter().map(|c| c.mode.label.as_str()).collect::<Vec<_>>())
}

pub fn frf(store: &Store, found: &FrfResult) -> Result<(), Error> {
    let writer = GroupWriter::new(store, "/frf")?;
    writer.set_attribute("rpm", found.speed * TO_RPM)?;
    writer.set_attribute("quantity", found.name())?;
    writer.write_array("frequency", &[found.frf.frequencies.len()], &found.frf.frequencies, "Hz")?;
    write_requested(&writer, &found.requested, found.frf.frequencies.len(), "frequency")?;
    let (responses, excitations) = (found.responses.len(), found.excitations.len());
    let values: Vec<Complex64> = found.frf.values.iter().flatten().flatten().copied().collect();
    let shape = [responses, excitations, found.frf.frequencies.len()];
    writer.write_complex("response", &shape, &values, "in units")?;
    writer.attach_scale("response", 2, "frequency")?;
    writer.write_texts("units", &[responses, excitations], &found.units.concat())?;
    writer.write_texts("responses", &[responses], &found.responses)?;
    writer.write_texts("excitations", &[excitations], &found.excitations)
}

/// 1 for every requested point of a refined axis, 0 for those added.
fn write_requested(
    writer: &GroupWriter,
    requested: &[usize],
    points: usize,
    axis: &str,
) -> Result<(), Error> {
    let mut mask = vec![0.0; points];
    requested.iter().for_each(|&k| mask[k] = 1.0);
    writer.write_array("requested", &[points], &mask, "1")?;
    writer.attach_scale("requested", 0, axis)
}

pub fn unbalance(store: &Store, found: &UnbalanceResult) -> Result<(), Error> {
    let writer = GroupWriter::new(store, "/unbalance")?;
    let rpm: Vec<f64> = found.response.speeds.iter().map(|s| s * TO_RPM).collect();
    writer.write_array("rpm", &[rpm.len()], &rpm, "rpm")?;
    write_requested(&writer, &found.requested, rpm.len(), "rpm")?;
    let peaks = writer.subgroup("peaks")?;
    let column =
        |value: &dyn Fn(&Peak) -> f64| -> Vec<f64> { found.peaks.iter().map(|p| value(&p.peak)).collect() };
    let shape = [found.peaks.len()];
    let names: Vec<&str> = found.peaks.iter().map(|p| p.response.as_str()).collect();
    peaks.write_texts("response", &shape, &names)?;
    peaks.write_array("rpm", &shape, &column(&|p| p.at * TO_RPM), "rpm")?;
    peaks.write_array("amplitude", &shape, &column(&|p| p.amplitude), "SI")?;
    let factors = column(&|p| p.amplification().unwrap_or(f64::NAN));
    peaks.write_array("amplification_factor", &shape, &factors, "1")?;
    let complex = |pairs: &[[f64; 2]]| -> Vec<Complex64> {
        pairs.iter().map(|&[re, im]| Complex64::new(re, im)).collect()
    };
    let mut written = Vec::new();
    for channel in &found.channels {
        let probe = &channel.probe;
        let unit = unit_of(probe.quantity, is_rotation(&probe.direction));
        written.push((format!("channels/{}", probe.name), &channel.amplitude, unit));
    }
    for orbit in &found.orbits {
        written.push((format!("orbits/{}/x", orbit.name), &orbit.x, "m"));
        written.push((format!("orbits/{}/y", orbit.name), &orbit.y, "m"));
    }
    for (name, values, unit) in written {
        writer.write_complex(&name, &[values.len()], &complex(values), unit)?;
        writer.attach_scale(&name, 0, "rpm")?;
    }
    Ok(())
}

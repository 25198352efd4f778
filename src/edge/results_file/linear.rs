//! Equilibrium, modes, Campbell diagram, critical speeds, FRFs and unbalance response as data sets.

use super::Place;
use crate::analysis::Mode;
use crate::analysis::critical_speed::CriticalSpeed;
use crate::analysis::equilibrium::{CageTreatment, Equilibrium};
use crate::edge::hdf5::Store;
use crate::error::Error;
use crate::linalg::Complex64;
use crate::results::{CampbellResult, FrfResult, ModalResult, UnbalanceResult, is_rotation, unit_of};
use crate::study::Machine;

const TO_RPM: f64 = 60.0 / std::f64::consts::TAU;

pub fn equilibrium(store: &Store, found: &Equilibrium, machine: &Machine) -> Result<(), Error> {
    let place = Place::new(store, "/equilibrium")?;
    place.note("speed", found.speed)?;
    place.note(
        "cage",
        match found.cage {
            CageTreatment::AsPlaced => "as placed",
            CageTreatment::Averaged => "averaged over a ball pitch",
        },
    )?;
    place.note("iterations", found.iterations as i64)?;
    place.note("residual", found.residual)?;
    let q = machine.assembly.dofs.expand(&found.q);
    place.array("displacement", &[q.len() / 6, 6], &q, "m, rad")?;
    for bearing in &found.bearings {
        let at = place.below(&format!("bearings/{}", bearing.name))?;
        at.note("largest_ball_load", bearing.largest_ball_load)?;
        at.array("force", &[6], &bearing.force, "N, N m")?;
        at.array("displacement", &[6], &bearing.displacement, "m, rad")?;
        at.array("stiffness", &[6, 6], bearing.tangent.stiffness.as_flattened(), "N/m, N, N m/rad")?;
        at.array("damping", &[6, 6], bearing.tangent.damping.as_flattened(), "N s/m, N s, N m s/rad")?;
        let balls = &bearing.balls;
        if !balls.is_empty() {
            let column = |value: fn(&crate::bearing::BallLoad) -> f64| -> Vec<f64> {
                balls.iter().map(value).collect()
            };
            at.array("balls/position", &[balls.len()], &column(|b| b.position), "rad")?;
            at.array("balls/load", &[balls.len()], &column(|b| b.load), "N")?;
            at.array("balls/contact_angle", &[balls.len()], &column(|b| b.contact_angle), "rad")?;
            at.array("balls/deflection", &[balls.len()], &column(|b| b.deflection), "m")?;
        }
    }
    Ok(())
}

pub fn modes(store: &Store, found: &[ModalResult], machine: &Machine) -> Result<(), Error> {
    let place = Place::new(store, "/modes")?;
    let most = found.iter().map(|at| at.modes.len()).max().unwrap_or(0);
    let (speeds, dofs) = (found.len(), machine.assembly.dofs.full_len());
    let nodes = machine.assembly.dofs.shaft_nodes;
    let cells = || found.iter().flat_map(|at| (0..most).map(|k| at.modes.get(k)));
    let one = |value: fn(&Mode) -> f64| -> Vec<f64> { cells().map(|m| m.map_or(f64::NAN, value)).collect() };
    let shape = [speeds, most];
    place.array("omega", &shape, &one(Mode::omega), "rad/s")?;
    place.array("frequency", &shape, &one(Mode::frequency_hz), "Hz")?;
    place.array("zeta", &shape, &one(Mode::zeta), "1")?;
    place.array("log_dec", &shape, &one(Mode::log_dec), "1")?;
    let nan = Complex64::new(f64::NAN, f64::NAN);
    let eigenvalues: Vec<_> = cells().map(|m| m.map_or(nan, |m| m.eigenvalue)).collect();
    place.complex("eigenvalue", &shape, &eigenvalues, "1/s")?;
    let shapes: Vec<Complex64> =
        cells().flat_map(|m| m.map_or_else(|| vec![nan; dofs], |m| m.full_shape.clone())).collect();
    place.complex("shapes", &[speeds, most, dofs / 6, 6], &shapes, "m/sqrt(kg) m, rad/sqrt(kg) m")?;
    let whirl: Vec<f64> =
        cells().flat_map(|m| m.map_or_else(|| vec![f64::NAN; nodes], |m| m.whirl.clone())).collect();
    place.array("whirl", &[speeds, most, nodes], &whirl, "1")?;
    let mass: Vec<f64> = cells().flat_map(|m| m.map_or([f64::NAN; 3], |m| m.effective_mass)).collect();
    place.array("effective_mass", &[speeds, most, 3], &mass, "1")?;
    let texts = |text: fn(&Mode) -> &str| -> Vec<&str> { cells().map(|m| m.map_or("", text)).collect() };
    place.texts("kind", &shape, &texts(|m| m.kind.name()))?;
    place.texts("label", &shape, &texts(|m| &m.label))?;
    let rpm: Vec<f64> = found.iter().map(|at| at.speed * TO_RPM).collect();
    place.array("rpm", &[speeds], &rpm, "rpm")?;
    ["omega", "frequency", "zeta", "log_dec", "eigenvalue", "shapes", "whirl", "effective_mass"]
        .iter()
        .try_for_each(|name| place.axis(name, 0, "rpm"))
}

pub fn campbell(store: &Store, found: &CampbellResult) -> Result<(), Error> {
    let place = Place::new(store, "/campbell")?;
    let diagram = &found.diagram;
    let shape = [diagram.branches.len(), diagram.speeds.len()];
    let rpm: Vec<f64> = diagram.speeds.iter().map(|s| s * TO_RPM).collect();
    place.array("rpm", &[rpm.len()], &rpm, "rpm")?;
    for (name, value, unit) in [
        ("frequency", Mode::frequency_hz as fn(&Mode) -> f64, "Hz"),
        ("zeta", Mode::zeta, "1"),
        ("log_dec", Mode::log_dec, "1"),
    ] {
        let modes = diagram.branches.iter().flat_map(|b| &b.modes);
        let data: Vec<f64> = modes.map(|m| m.as_ref().map_or(f64::NAN, value)).collect();
        place.array(name, &shape, &data, unit)?;
        place.axis(name, 1, "rpm")?;
    }
    let labels: Vec<&str> = diagram.branches.iter().map(|b| b.label.as_str()).collect();
    let kinds: Vec<&str> = diagram.branches.iter().map(|b| b.kind.name()).collect();
    place.texts("label", &[labels.len()], &labels)?;
    place.texts("kind", &[kinds.len()], &kinds)?;
    let names: Vec<&str> = found.orders.iter().map(|o| o.label.as_str()).collect();
    let orders: Vec<f64> = found.orders.iter().map(|o| o.order).collect();
    place.texts("orders/label", &[names.len()], &names)?;
    place.array("orders/order", &[orders.len()], &orders, "1/revolution")?;
    crossings(&place.below("crossings")?, &found.crossings)?;
    let at = place.below("thresholds")?;
    let speeds: Vec<f64> = found.thresholds.iter().map(|t| t.speed * TO_RPM).collect();
    let above: Vec<f64> = found.thresholds.iter().map(|t| f64::from(u8::from(t.unstable_above))).collect();
    let labels: Vec<&str> = found.thresholds.iter().map(|t| t.label.as_str()).collect();
    at.array("rpm", &[speeds.len()], &speeds, "rpm")?;
    at.array("unstable_above", &[above.len()], &above, "1")?;
    at.texts("label", &[labels.len()], &labels)
}

pub fn crossings(place: &Place, found: &[CriticalSpeed]) -> Result<(), Error> {
    let column = |value: fn(&CriticalSpeed) -> f64| -> Vec<f64> { found.iter().map(value).collect() };
    let shape = [found.len()];
    place.array("rpm", &shape, &column(|c| c.speed * TO_RPM), "rpm")?;
    place.array("order", &shape, &column(|c| c.order), "1/revolution")?;
    place.array("frequency", &shape, &column(|c| c.mode.frequency_hz()), "Hz")?;
    place.array("log_dec", &shape, &column(|c| c.mode.log_dec()), "1")?;
    place.texts("whirl", &shape, &found.iter().map(|c| c.mode.kind.name()).collect::<Vec<_>>())?;
    place.texts("label", &shape, &found.iter().map(|c| c.label.as_str()).collect::<Vec<_>>())
}

pub fn frf(store: &Store, found: &FrfResult) -> Result<(), Error> {
    let place = Place::new(store, "/frf")?;
    place.note("rpm", found.speed * TO_RPM)?;
    place.note("quantity", found.name())?;
    place.array("frequency", &[found.frf.frequencies.len()], &found.frf.frequencies, "Hz")?;
    let (responses, excitations) = (found.responses.len(), found.excitations.len());
    let values: Vec<Complex64> = found.frf.values.iter().flatten().flatten().copied().collect();
    let shape = [responses, excitations, found.frf.frequencies.len()];
    place.complex("response", &shape, &values, "in units")?;
    place.axis("response", 2, "frequency")?;
    place.texts("units", &[responses, excitations], &found.units.concat())?;
    place.texts("responses", &[responses], &found.responses)?;
    place.texts("excitations", &[excitations], &found.excitations)
}

pub fn unbalance(store: &Store, found: &UnbalanceResult) -> Result<(), Error> {
    let place = Place::new(store, "/unbalance")?;
    let rpm: Vec<f64> = found.response.speeds.iter().map(|s| s * TO_RPM).collect();
    place.array("rpm", &[rpm.len()], &rpm, "rpm")?;
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
        place.complex(&name, &[values.len()], &complex(values), unit)?;
        place.axis(&name, 0, "rpm")?;
    }
    Ok(())
}

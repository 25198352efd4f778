//! Comparison of a model with measurements as data sets.

use super::Place;
use crate::edge::hdf5::Store;
use crate::error::Error;
use crate::linalg::Complex64;
use crate::update::Update;
use crate::update::parameter::FreeParameter;
use crate::update::state::State;
use crate::update::target::Target;

const TO_RPM: f64 = 60.0 / std::f64::consts::TAU;

/// Writes `group`: measured and computed modes, pairs (−1 for none), MAC, and the FRFs at the measured
/// points.
///
/// # Errors
/// The file cannot be written.
pub fn write(
    store: &Store,
    group: &str,
    target: &Target,
    state: &State,
    frfs: Option<&[Vec<Vec<Complex64>>]>,
) -> Result<(), Error> {
    let place = Place::new(store, group)?;
    place.note("rpm", target.speed * TO_RPM)?;
    let (m, c, s) = (target.modes.len(), state.modes.len(), target.sensors.len());
    let sensors: Vec<String> = target.sensors.iter().map(|s| s.name(&state.linear.model)).collect();
    place.texts("sensors", &[s], &sensors)?;
    let measured = place.below("measured")?;
    let column = |of: &dyn Fn(usize) -> f64| -> Vec<f64> { (0..m).map(of).collect() };
    let modes = &target.modes;
    measured.array("frequency", &[m], &column(&|k| modes[k].frequency_hz), "Hz")?;
    measured.array("frequency_error", &[m], &column(&|k| modes[k].frequency_error), "Hz")?;
    measured.array("zeta", &[m], &column(&|k| modes[k].damping_ratio.unwrap_or(f64::NAN)), "1")?;
    let shapes: Vec<Complex64> = modes.iter().flat_map(|m| m.shape.clone()).collect();
    measured.complex("shapes", &[m, s], &shapes, "1")?;
    let partner = |k: usize| state.pairing.pairs.iter().find(|p| p.measured == k);
    measured.array("partner", &[m], &column(&|k| partner(k).map_or(-1.0, |p| p.computed as f64)), "1")?;
    let computed = place.below("computed")?;
    let own: Vec<f64> = state.modes.iter().map(|m| m.frequency_hz()).collect();
    computed.array("frequency", &[c], &own, "Hz")?;
    computed.array("zeta", &[c], &state.modes.iter().map(|m| m.zeta()).collect::<Vec<_>>(), "1")?;
    computed.complex("shapes", &[c, s], &state.shapes.concat(), "m/sqrt(kg) m")?;
    let labels: Vec<&str> = state.modes.iter().map(|m| m.label.as_str()).collect();
    computed.texts("label", &[c], &labels)?;
    place.array("mac", &[m, c], &state.pairing.mac.concat(), "1")?;
    if let (Some(found), Some(frf)) = (&target.frfs, frfs) {
        let at = place.below("frf")?;
        let shape = [found.responses.len(), found.references.len(), found.frequencies.len()];
        let flat =
            |v: &[Vec<Vec<Complex64>>]| -> Vec<Complex64> { v.iter().flatten().flatten().copied().collect() };
        at.array("frequency", &[shape[2]], &found.frequencies, "Hz")?;
        at.complex("measured", &shape, &flat(&found.values), "as measured, SI")?;
        at.complex("computed", &shape, &flat(frf), "as measured, SI")?;
        ["measured", "computed"].iter().try_for_each(|name| at.axis(name, 2, "frequency"))?;
    }
    Ok(())
}

/// Writes `/parameters`: start, value, standard error, share of the prior, and identifiability (SVD,
/// correlation).
///
/// # Errors
/// The file cannot be written.
pub fn write_parameters(store: &Store, parameters: &[FreeParameter], found: &Update) -> Result<(), Error> {
    let place = Place::new(store, "/parameters")?;
    let n = parameters.len();
    let names: Vec<&str> = parameters.iter().map(|p| p.name.as_str()).collect();
    let units: Vec<&str> = parameters.iter().map(|p| p.unit()).collect();
    let verdicts: Vec<&str> = found.outcomes.iter().map(|o| o.verdict.words()).collect();
    place.texts("name", &[n], &names)?;
    place.texts("unit", &[n], &units)?;
    place.texts("verdict", &[n], &verdicts)?;
    let column = |of: &dyn Fn(usize) -> f64| -> Vec<f64> { (0..n).map(of).collect() };
    let own = "in the parameter's unit";
    place.array("start", &[n], &column(&|k| parameters[k].value(0.0)), own)?;
    place.array("value", &[n], &column(&|k| parameters[k].value(found.outcomes[k].x)), own)?;
    let error = |k: usize| (found.outcomes[k].error * parameters[k].slope(found.outcomes[k].fitted)).abs();
    place.array("standard_error", &[n], &column(&error), own)?;
    place.array("prior_share", &[n], &column(&|k| found.outcomes[k].prior_share), "1")?;
    let told = &found.identifiability;
    place.array("singular_values", &[n], &told.singular_values, "1")?;
    place.array("directions", &[n, n], &told.directions.concat(), "1")?;
    place.array("correlation", &[n, n], &told.correlation.concat(), "1")
}

//! Comparison of a model with measurements as data sets.

use super::GroupWriter;
use crate::error::Error;
use crate::hdf5::Store;
use rotordyn_linalg::Complex64;
use rotordyn_update::Update;
use rotordyn_update::parameter::FreeParameter;
use rotordyn_update::state::ModelState;
use rotordyn_update::target::Target;

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
    state: &ModelState,
    frfs: Option<&[Vec<Vec<Complex64>>]>,
) -> Result<(), Error> {
    let writer = GroupWriter::new(store, group)?;
    writer.set_attribute("rpm", target.speed * TO_RPM)?;
    let (m, c, s) = (target.modes.len(), state.modes.len(), target.sensors.len());
    let sensors: Vec<String> = target.sensors.iter().map(|s| s.name(&state.linearised.model)).collect();
    writer.write_texts("sensors", &[s], &sensors)?;
    let measured = writer.subgroup("measured")?;
    let column = |of: &dyn Fn(usize) -> f64| -> Vec<f64> { (0..m).map(of).collect() };
    let modes = &target.modes;
    measured.write_array("frequency", &[m], &column(&|k| modes[k].frequency_hz), "Hz")?;
    measured.write_array("frequency_error", &[m], &column(&|k| modes[k].frequency_error), "Hz")?;
    measured.write_array("zeta", &[m], &column(&|k| modes[k].damping_ratio.unwrap_or(f64::NAN)), "1")?;
    let shapes: Vec<Complex64> = modes.iter().flat_map(|m| m.shape.clone()).collect();
    measured.write_complex("shapes", &[m, s], &shapes, "1")?;
    let paired_mode = |k: usize| state.pairing.pairs.iter().find(|p| p.measured == k);
    measured.write_array(
        "paired_mode",
        &[m],
        &column(&|k| paired_mode(k).map_or(-1.0, |p| p.computed as f64)),
        "1",
    )?;
    let computed = writer.subgroup("computed")?;
    let own: Vec<f64> = state.modes.iter().map(|m| m.frequency_hz()).collect();
    computed.write_array("frequency", &[c], &own, "Hz")?;
    computed.write_array("zeta", &[c], &state.modes.iter().map(|m| m.zeta()).collect::<Vec<_>>(), "1")?;
    computed.write_complex("shapes", &[c, s], &state.shapes.concat(), "m/sqrt(kg) m")?;
    let labels: Vec<&str> = state.modes.iter().map(|m| m.label.as_str()).collect();
    computed.write_texts("label", &[c], &labels)?;
    writer.write_array("mac", &[m, c], &state.pairing.mac.concat(), "1")?;
    if let (Some(found), Some(frf)) = (&target.frfs, frfs) {
        let at = writer.subgroup("frf")?;
        let shape = [found.responses.len(), found.references.len(), found.frequencies.len()];
        let flat =
            |v: &[Vec<Vec<Complex64>>]| -> Vec<Complex64> { v.iter().flatten().flatten().copied().collect() };
        at.write_array("frequency", &[shape[2]], &found.frequencies, "Hz")?;
        at.write_complex("measured", &shape, &flat(&found.values), "as measured, SI")?;
        at.write_complex("computed", &shape, &flat(frf), "as measured, SI")?;
        ["measured", "computed"].iter().try_for_each(|name| at.attach_scale(name, 2, "frequency"))?;
    }
    Ok(())
}

/// Writes `/parameters`: start, value, standard error, share of the prior, and identifiability (SVD,
/// correlation).
///
/// # Errors
/// The file cannot be written.
pub fn write_parameters(store: &Store, parameters: &[FreeParameter], found: &Update) -> Result<(), Error> {
    let writer = GroupWriter::new(store, "/parameters")?;
    let n = parameters.len();
    let names: Vec<&str> = parameters.iter().map(|p| p.name.as_str()).collect();
    let units: Vec<&str> = parameters.iter().map(|p| p.unit()).collect();
    let classes: Vec<&str> = found.outcomes.iter().map(|o| o.class.label()).collect();
    writer.write_texts("name", &[n], &names)?;
    writer.write_texts("unit", &[n], &units)?;
    writer.write_texts("identifiability", &[n], &classes)?;
    let column = |of: &dyn Fn(usize) -> f64| -> Vec<f64> { (0..n).map(of).collect() };
    let own = "in the parameter's unit";
    writer.write_array("start", &[n], &column(&|k| parameters[k].value(0.0)), own)?;
    writer.write_array("value", &[n], &column(&|k| parameters[k].value(found.outcomes[k].x)), own)?;
    let error =
        |k: usize| (found.outcomes[k].error * parameters[k].derivative(found.outcomes[k].fitted)).abs();
    writer.write_array("standard_error", &[n], &column(&error), own)?;
    writer.write_array("prior_variance_fraction", &[n], &column(&|k| found.outcomes[k].prior_share), "1")?;
    let identifiability = &found.identifiability;
    writer.write_array("singular_values", &[n], &identifiability.singular_values, "1")?;
    writer.write_array("singular_vectors", &[n, n], &identifiability.directions.concat(), "1")?;
    writer.write_array("correlation", &[n, n], &identifiability.correlation.concat(), "1")
}

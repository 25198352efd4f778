//! Channels of a measured run-up, assigned to sensor positions in a model.

use crate::error::Error;
use rotordyn_core::model::{Model, Probe, Quantity};
use rotordyn_core::study::signal::SignalChannel;
use rotordyn_signal::record::{Axis, MeasuredData, Points, Record};
use rotordyn_update::UpdateError;
use rotordyn_update::target::sensors;

/// Most names listed in a message.
const MAX_NAMES: usize = 6;

/// Channels of a file that can be compared with a model, and warnings.
pub type PlacedChannels = (Vec<(Probe, SignalChannel)>, Vec<String>);

/// Whether a record is a shaft rotation signal (tacho, keyphasor, angle, speed) rather than vibration.
pub fn is_rotation_signal(record: &Record) -> bool {
    let name = record.name.to_lowercase();
    let named = ["tacho", "keyphasor", "trigger", "pulse", "theta", "angle", "speed", "rpm"];
    matches!(record.unit.as_str(), "rpm" | "rad/s" | "s") || named.iter().any(|word| name.contains(word))
}

/// Displacements, velocities and accelerations over time, at the point and in the direction stated by their
/// records; a channel named like a probe of the model is at that probe. Only channels sampled like the first
/// are returned.
///
/// # Errors
/// No such channel, none with a known position, an unknown sampling rate, NaN.
pub fn channels(measured: &MeasuredData, model: &Model) -> Result<PlacedChannels, Error> {
    let mut warnings = Vec::new();
    let vibrates =
        |r: &&Record| r.time_samples().is_ok() && !is_rotation_signal(r) && quantity(&r.unit).is_some();
    let all: Vec<&Record> = measured.records.iter().filter(vibrates).collect();
    let unknown = measured.records.iter().filter(|r| r.time_samples().is_ok() && r.unit.is_empty());
    let unknown: Vec<&str> = unknown.filter(|r| !is_rotation_signal(r)).map(|r| r.name.as_str()).collect();
    let unit_advice = "give it in the mapping, such as [channel.NAME] unit = \"g\"";
    if all.is_empty() {
        let (problem, advice) = match &unknown[..] {
            [] => (
                "it contains no displacement, velocity or acceleration over time".into(),
                "give the file with the sensors' channels",
            ),
            names => (format!("the unit of {} is not known", listed(names)), unit_advice),
        };
        return Err(UpdateError::new(problem, advice).into());
    }
    if !unknown.is_empty() {
        warnings.push(format!("left out, their unit is not known: {}; {unit_advice}", listed(&unknown)));
    }
    let (mut placed, mut unplaced) = (Vec::new(), Vec::new());
    for record in all {
        match probe_of(record, measured, model) {
            Some(probe) => placed.push((probe, record)),
            None => unplaced.push(record.name.as_str()),
        }
    }
    let advice =
        "give it with --mapping, such as [channel.NAME] station = \"B\", direction = \"y\"".to_string();
    let Some((_, first)) = placed.first() else {
        let verb = if unplaced.len() == 1 { "was" } else { "were" };
        let problem = format!("where {} {verb} measured is not known", listed(&unplaced));
        return Err(UpdateError::new(problem, advice).into());
    };
    if !unplaced.is_empty() {
        warnings.push(format!("left out, their places are not known: {}; {advice}", listed(&unplaced)));
    }
    let rate = first
        .sample_rate()
        .map_err(|error| UpdateError::new(error.to_string(), "give it in the mapping: rate = \"RATE\""))?;
    let (axis, count): (Axis, usize) = (first.axis.clone(), first.values.len());
    let others: Vec<&str> = placed
        .iter()
        .filter(|(_, r)| r.axis != axis || r.values.len() != count)
        .map(|(_, r)| r.name.as_str())
        .collect();
    if !others.is_empty() {
        let (names, own) = (listed(&others), &first.name);
        warnings.push(format!("left out, not sampled like `{own}`: {names}; give them in a separate file"));
    }
    let mut out = Vec::new();
    for (probe, record) in placed.iter().filter(|(_, r)| r.axis == axis && r.values.len() == count) {
        let samples = record.time_samples()?.to_vec();
        if let Some(index) = samples.iter().position(|v| !v.is_finite()) {
            let problem = format!("`{}` is not finite at sample {index}", record.name);
            return Err(UpdateError::new(problem, "cut the record before or after it").into());
        }
        let start = match record.axis.points {
            Points::Uniform { start, .. } => start,
            _ => 0.0,
        };
        let (name, unit) = (record.name.clone(), record.unit.clone());
        out.push((
            probe.clone(),
            SignalChannel { name, unit, sample_rate: rate, start, samples, orthogonal: None },
        ));
    }
    Ok((out, warnings))
}

fn listed(names: &[&str]) -> String {
    let more = if names.len() > MAX_NAMES { ", ..." } else { "" };
    format!("{}{more}", names[..names.len().min(MAX_NAMES)].join(", "))
}

/// Quantity of a unit, translational or rotational.
pub fn quantity(unit: &str) -> Option<Quantity> {
    match unit {
        "m" | "rad" => Some(Quantity::Displacement),
        "m/s" | "rad/s" => Some(Quantity::Velocity),
        "m/s^2" | "rad/s^2" => Some(Quantity::Acceleration),
        _ => None,
    }
}

/// Sensor position and direction (probe) of a record in the model.
fn probe_of(record: &Record, measured: &MeasuredData, model: &Model) -> Option<Probe> {
    let quantity = quantity(&record.unit)?;
    let turns = record.unit.starts_with("rad");
    let known = |p: &&Probe| {
        p.name == record.name && p.quantity == quantity && turns == p.direction[..3].iter().all(|d| *d == 0.0)
    };
    if let Some(probe) = model.probes.iter().find(known) {
        return Some(probe.clone());
    }
    let dof = record.response;
    if dof.node == 0 || dof.direction == 0 || turns != dof.is_rotation() {
        return None;
    }
    let sensor = sensors(&[dof], &measured.geometry, model).ok()?.pop()?;
    let direction = sensor.direction.map(|d| if d == 0.0 { 0.0 } else { d.signum() });
    Some(Probe { name: record.name.clone(), at: sensor.anchor, direction, quantity })
}

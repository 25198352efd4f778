//! Simulated impact (hammer) test: FRFs from the stored run of a machine at rest under one load over time.

use std::f64::consts::TAU;

use crate::error::Error;
use crate::hdf5::read_recording;
use crate::hdf5::{Attribute, Reader};
use crate::results_file::history_of;
use rotordyn_model::{self as model, Load, LoadFactor, Model, Options, Quantity};
use rotordyn_signal::impact::{Hit, ImpactWindows, frf_from_hits};
use rotordyn_signal::record::{Axis, AxisQuantity, Dof, Kind, MeasuredData, Record, Values};

/// Name of the scalar with the peak force of the impact \[N\].
pub const PEAK_FORCE: &str = "peak_force";

/// FRFs from the load to every probe; `None` if the file contains no run under exactly one load over time.
///
/// The force is that of the model stored in the file. Frequencies go up to the inverse of the impact
/// duration, where the force spectrum of a half-sine is 0.33, of a triangle 0.41 of its value at 0 Hz. The
/// first value of a response is taken as its position at rest.
///
/// # Errors
/// The file cannot be read, or the run is too short for an FRF.
pub fn impact_frfs(store: &dyn Reader) -> Result<Option<MeasuredData>, Error> {
    impact_frfs_windowed(store, ImpactWindows::default())
}

/// As [`impact_frfs`], with a force window and an exponential window.
///
/// # Errors
/// As [`impact_frfs`].
pub fn impact_frfs_windowed(
    store: &dyn Reader,
    windows: ImpactWindows,
) -> Result<Option<MeasuredData>, Error> {
    if !store.contains("/time/t")? {
        return Ok(None);
    }
    let Some(model) = stored_model(store)? else { return Ok(None) };
    let varying: Vec<&Load> = model.loads.iter().filter(|l| !l.factor.is_constant()).collect();
    let [load] = varying[..] else { return Ok(None) };
    // A random force is no hit.
    let LoadFactor::Table(points) = &load.factor else { return Ok(None) };
    let history = history_of(&read_recording(store, "")?);
    let (Some(first), Some(last)) = (points.first(), points.last()) else { return Ok(None) };
    let (size, direction) = magnitude_and_direction(&load.force);
    let force: Vec<f64> = history.time.all()?.iter().map(|t| size * load.factor.at(*t)).collect();
    let node = |at: &rotordyn_core::element::Anchor| match at.node {
        Some(node) if at.offset == [0.0; 3] => node as i64 + 1,
        _ => 0,
    };
    let reference = Dof::new(node(&load.at), direction);
    let max_frequency = 1.0 / (last[0] - first[0]).max(1.0 / history.sample_rate);
    let mut out = MeasuredData { title: model.title.clone(), ..MeasuredData::default() };
    let speed = history.speed.at(0)?;
    for probe in &model.probes {
        let Some(channel) = history.channel(&probe.name) else { continue };
        let values = channel.values.all()?;
        let rest = values.first().copied().unwrap_or(0.0);
        let response: Vec<f64> = values.iter().map(|v| v - rest).collect();
        let hit = Hit { force: &force, response: &response };
        let found = frf_from_hits(&[hit], history.sample_rate, windows)?;
        let count = found.frequencies.iter().filter(|f| **f <= max_frequency).count();
        let step = found.frequencies.get(1).copied().unwrap_or(1.0);
        let axis = Axis::uniform(AxisQuantity::Frequency, 0.0, step);
        let values = Values::Complex(found.h1[..count].to_vec());
        let unit = match probe.quantity {
            Quantity::Displacement => "m/N",
            Quantity::Velocity => "(m/s)/N",
            Quantity::Acceleration => "(m/s^2)/N",
        };
        let (_, way) = magnitude_and_direction(&probe.direction);
        out.records.push(Record {
            response: Dof::new(node(&probe.at), way),
            reference,
            speed_rpm: speed.map(|s| s * 60.0 / TAU),
            ..Record::new(&probe.name, Kind::Frf, axis, values, unit)
        });
    }
    // Only translations at nodes have a point number in the model, not rotations or points at an offset.
    out.records.retain(|r| r.response.node != 0 && (1..=3).contains(&r.response.direction.abs()));
    let peak = force.iter().fold(0.0, |m: f64, f| m.max(f.abs()));
    out.scalars.push((PEAK_FORCE.into(), peak));
    Ok((!out.records.is_empty() && peak > 0.0).then_some(out))
}

/// Magnitude and direction number of a force; direction 0 if it is not along a single axis.
fn magnitude_and_direction(force: &[f64; 6]) -> (f64, i8) {
    let mut parts = force.iter().enumerate().filter(|(_, f)| **f != 0.0);
    match (parts.next(), parts.next()) {
        (Some((k, f)), None) => (f.abs(), (k as i8 + 1) * f.signum() as i8),
        _ => (force.iter().map(|f| f * f).sum::<f64>().sqrt(), 0),
    }
}

/// The model with which the run was computed.
pub(super) fn stored_model(store: &dyn Reader) -> Result<Option<Model>, Error> {
    let text = |name: &str| -> Result<Option<String>, Error> {
        Ok(match store.attribute("/meta", name)? {
            Some(Attribute::Text(text)) => Some(text),
            _ => None,
        })
    };
    let Some(model) = text("model")? else { return Ok(None) };
    let setting = |line: &str| line.split_once(" = ").map(|(path, value)| (path.into(), value.into()));
    let options = Options {
        variant: text("variant")?.filter(|name| !name.is_empty()),
        set: text("settings")?.unwrap_or_default().lines().filter_map(setting).collect(),
    };
    Ok(model::load("stored model", model, &options).ok().map(|loaded| loaded.model))
}

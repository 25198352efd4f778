//! Responses of a stored run at their points, as a record of a machine in operation.

use super::impact_run::stored_model;
use crate::error::Error;
use crate::hdf5::{Reader, Recording, read_recording};
use crate::machine_records::run_records;
use crate::results_file::history_of;
use rotordyn_core::model::Model;
use rotordyn_signal::record::MeasuredData;

/// A stored run.
#[derive(Clone, Debug)]
pub struct OperatingRun {
    /// Probes, shaft angle and speed, at the points of the model.
    pub records: MeasuredData,
    /// Ball-pass orders of the bearings with their side bands.
    pub orders: Vec<f64>,
    /// Whether a random force acts.
    pub is_random: bool,
    /// Whether the file has FRFs too.
    pub has_frfs: bool,
}

/// The responses of the run in a results file with its model; `None` if it has no run of more than two samples.
///
/// # Errors
/// The file cannot be read.
pub fn operating_run(store: &dyn Reader) -> Result<Option<OperatingRun>, Error> {
    if !store.contains("/time/t")? {
        return Ok(None);
    }
    let Some(model) = stored_model(store)? else { return Ok(None) };
    let recording = read_recording(store, "")?;
    if recording.time.len() < 3 {
        return Ok(None);
    }
    let mut history = history_of(&recording);
    history.channels.retain(|channel| model.probes.iter().any(|probe| probe.name == channel.name));
    let mut records = run_records(&history, &model)?;
    if recording.state != "complete" {
        records.notes.push(format!("the run is incomplete: {}", recording.state));
    }
    Ok(Some(OperatingRun {
        records,
        orders: ball_pass_orders(&model, &recording),
        is_random: model.loads.iter().any(|load| load.factor.is_random()),
        has_frfs: store.contains("/frf/response")?,
    }))
}

/// Highest multiple of the ball-pass order, and most side bands of the shaft speed on each side.
const MULTIPLES: u32 = 4;
const SIDE_BANDS: i32 = 3;

/// Multiples of the ball-pass order of every bearing in the run, with the side bands of a load that turns with the shaft; with
/// the cage speed of the run, which depends on the contact angles.
fn ball_pass_orders(model: &Model, recording: &Recording) -> Vec<f64> {
    let turned = |values: &[f64]| Some(values.last()? - values.first()?);
    let shaft = turned(&recording.angle).filter(|angle| *angle != 0.0);
    let mut out: Vec<f64> = Vec::new();
    for site in &model.bearings {
        let Some(orders) = site.bearing.characteristic_orders() else { continue };
        let name = rotordyn_core::model::run_channels::cage_angle(&site.name);
        let channel = recording.channels.iter().find(|(channel, _)| channel.name == name);
        let cage = channel.and_then(|(_, values)| Some(turned(values)? / shaft?));
        let ball_pass =
            cage.filter(|ratio| *ratio > 0.0).map_or(orders.bpfo, |ratio| orders.bpfo / orders.ftf * ratio);
        for k in 1..=MULTIPLES {
            out.extend((-SIDE_BANDS..=SIDE_BANDS).map(|j| f64::from(k) * ball_pass + f64::from(j)));
        }
    }
    out.retain(|order| *order > 0.0);
    out.sort_by(f64::total_cmp);
    out.dedup_by(|a, b| (*a - *b).abs() < 1e-6);
    out
}

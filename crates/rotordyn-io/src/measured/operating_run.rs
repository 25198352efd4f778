//! Responses of a stored run at their points, as a record of a machine in operation.

use super::impact_run::stored_model;
use crate::error::Error;
use crate::hdf5::{Reader, read_recording};
use crate::machine_records::run_records;
use crate::results_file::history_of;
use rotordyn_core::model::Model;
use rotordyn_signal::record::MeasuredData;

/// A stored run.
#[derive(Clone, Debug)]
pub struct OperatingRun {
    /// Probes, shaft angle and speed, at the points of the model.
    pub records: MeasuredData,
    /// Ball-pass orders of the bearings up to twice the order of the inner race.
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
        orders: ball_pass_orders(&model),
        is_random: model.loads.iter().any(|load| load.factor.is_random()),
        has_frfs: store.contains("/frf/response")?,
    }))
}

/// Multiples of the ball-pass orders of all bearings, without those of equal bearings.
fn ball_pass_orders(model: &Model) -> Vec<f64> {
    let mut out: Vec<f64> = Vec::new();
    for orders in model.bearings.iter().filter_map(|site| site.bearing.characteristic_orders()) {
        for base in [orders.bpfo, orders.bpfi] {
            out.extend((1..).map(|k| f64::from(k) * base).take_while(|order| *order <= 2.0 * orders.bpfi));
        }
    }
    out.sort_by(f64::total_cmp);
    out.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
    out
}

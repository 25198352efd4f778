//! A run-up as JSON: summary, step error, range over the cage phases.

use serde_json::{Value, json};

use super::TO_RPM;
use rotordyn_core::results::{CagePhaseBand, HistoryChannel, RunUpResult, StepError};
use rotordyn_core::transient::run::End;

pub(super) fn run_up(found: &RunUpResult) -> Value {
    let (report, energy) = (&found.report, &found.report.energy);
    let channel = |c: &HistoryChannel| {
        let minimum = c.values.iter().copied().fold(f64::INFINITY, f64::min);
        let maximum = c.values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let square = c.values.iter().map(|v| v * v).sum::<f64>() / c.values.len() as f64;
        json!({
            "name": c.name, "unit": c.unit, "quantity": c.quantity, "station": c.station,
            "direction": c.direction, "minimum": minimum, "maximum": maximum, "rms": square.sqrt(),
        })
    };
    let end = match &report.end {
        End::Complete => "complete".to_string(),
        End::Stopped => "stopped".to_string(),
        End::Failed(error) => format!("failed: {error}"),
    };
    json!({
        "reduced_modes": found.modes, "static_correction_modes": found.corrections,
        "static_error": found.static_error, "frequency_error": found.frequency_error,
        "end": end, "step_s": report.step, "requested_step_s": found.requested_step,
        "step_error": run_up_step_error(found),
        "cage_angles": found.cage_angles.iter().map(|(bearing, angle)| {
            json!({ "bearing": bearing, "initial_rad": angle })
        }).collect::<Value>(),
        "steps": report.steps, "iterations": report.iterations, "halvings": report.halvings,
        "energy_j": {
            "work": energy.work, "drive_work": energy.drive, "parametric_work": energy.parametric, "damping_loss": energy.damping_loss,
            "contact_loss": energy.contact_loss, "residual": energy.residual(),
            "stored_start": energy.start, "stored_end": energy.stored(),
            "stored_change": energy.stored() - energy.start, "kinetic_end": energy.kinetic,
            "strain_end": energy.strain, "contact_end": energy.contact,
        },
        "sample_rate_hz": found.history.sample_rate,
        "samples": found.history.time.len(),
        "channels": found.history.channels.iter().map(channel).collect::<Value>(),
    })
}

/// Estimated error of the order levels by the time step; null without an estimate.
pub fn run_up_step_error(found: &RunUpResult) -> Value {
    found.step_error.as_ref().map(step_error).into()
}

fn step_error(found: &StepError) -> Value {
    let lines = found.lines.iter().map(|l| {
        json!({
            "channel": l.channel, "label": l.line.label, "order": l.line.order, "rms": l.level,
            "rerun_rms": l.other_level, "relative_error": l.error,
        })
    });
    json!({
        "start_s": found.stretch[0], "end_s": found.stretch[1], "speed_rpm": found.speed * TO_RPM,
        "rerun_step_s": found.other_step, "steps": found.steps, "share_of_steps": found.cost, "lines": lines.collect::<Value>(),
        "largest_relative_error": found.worst().map(|l| l.error.abs()),
    })
}

/// Ranges of the order cuts over the initial cage phases.
pub(super) fn cage_phases(found: &CagePhaseBand) -> Value {
    let channels = found.channels.iter().map(|c| {
        let cuts = c.lines.iter().map(|l| {
            json!({
                "label": l.line.label, "order": l.line.order, "speed_rpm": l.cut.rpm, "rms": l.cut.rms,
                "minimum": l.minimum, "maximum": l.maximum, "peaks": l.peaks,
            })
        });
        json!({ "channel": c.channel, "unit": c.unit, "cuts": cuts.collect::<Value>() })
    });
    json!({
        "bearings": found.bearings, "angles_rad": found.angles, "channels": channels.collect::<Value>(),
    })
}

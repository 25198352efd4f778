//! Lines and tables of a run-up: step and its error, cage angles, ranges over the cage phases.

use rotordyn::results::{CagePhaseBand, RunUpResult};
use rotordyn::transient::run::End;

use super::terminal::{Terminal, number, rpm};

/// Largest number of rows of a table.
const MAX_ROWS: usize = 40;

/// The step used with its estimated error, and the cage angles at the start.
///
/// `needed`: time \[s\] and turns of the shaft that the estimate needs.
pub fn step_and_cages(terminal: &Terminal, found: &RunUpResult, seconds: f64, needed: (f64, f64)) {
    let requested = number(1e6 * found.requested_step, 4);
    match found.report.step {
        None => terminal.print("  steps chosen by error control"),
        Some(step) if (step / found.requested_step - 1.0).abs() < 1e-9 => {
            terminal.print(&format!("  time step {requested} us"));
        }
        Some(step) => terminal.print(&format!(
            "  time step {} us instead of {requested} us, {:.0} to a sample at {} Hz",
            number(1e6 * step, 5),
            1.0 / (step * found.history.sample_rate),
            number(found.history.sample_rate, 6)
        )),
    }
    if let Some(step) = found.report.defect_step {
        terminal.print(&format!(
            "  {} us on local defects and until the vibration has decayed",
            number(1e6 * step, 4)
        ));
    }
    if let Some((error, line)) = found.step_error.as_ref().and_then(|e| Some((e, e.worst()?))) {
        let [from, to] = error.stretch;
        terminal.print(&format!(
            "  estimated error of the order levels by the step: up to {} % ({} of {}), from {from:.3} to\n  \
             {to:.3} s at {:.0} rpm, by a rerun with {} us that added {:.1} % to the steps, {seconds:.2} s",
            number(100.0 * line.error.abs(), 2),
            line.line.label,
            line.channel,
            rpm(error.speed),
            number(1e6 * error.other_step, 4),
            100.0 * error.cost
        ));
    } else if found.has_free_balls() {
        terminal.print("  the shortest step; contacts and friction of the free balls choose the steps");
    } else if found.report.step.is_some() {
        terminal.print(&format!("  no estimate of the step's error: {}", missing_estimate(found, needed)));
    }
    if !found.cage_angles.is_empty() {
        let angle = |(bearing, angle): &(String, f64)| format!("{bearing} {:.2} deg", angle.to_degrees());
        let all: Vec<String> = found.cage_angles.iter().map(angle).collect();
        let hint = if found.cage_angles.len() > 1 {
            "; ball pass levels depend on the phase between cages: --cage-phases"
        } else {
            ""
        };
        terminal.print(&format!("  cage angles at the start: {}{hint}", all.join(", ")));
    }
}

/// Why a run has no estimate of its step's error.
fn missing_estimate(found: &RunUpResult, (seconds, turns): (f64, f64)) -> String {
    if found.report.end != End::Complete {
        return "the run did not reach its end".into();
    }
    let duration = found.summary.samples as f64 / found.history.sample_rate;
    if duration < seconds {
        return format!(
            "it needs a run of {seconds:.3} s at this sampling rate, this one has {duration:.3} s"
        );
    }
    format!("it needs about {turns:.0} turns of the shaft, more where the largest response is at low speed")
}

/// Largest level of every order cut: in the run of the model, smallest and largest over the phases.
pub fn cage_phases(terminal: &Terminal, found: &CagePhaseBand) {
    let mut rows = Vec::new();
    for channel in &found.channels {
        for line in &channel.lines {
            let (lo, hi) =
                line.peaks.iter().fold((f64::INFINITY, 0.0f64), |(lo, hi), p| (lo.min(*p), hi.max(*p)));
            let own = line.peaks.first().copied().unwrap_or_default();
            let mut row = vec![channel.channel.clone(), line.line.label.clone()];
            row.extend([own, lo, hi].map(|level| number(level, 4)));
            row.push(channel.unit.clone());
            rows.push(row);
        }
    }
    let left_out = rows.len().saturating_sub(MAX_ROWS);
    rows.truncate(MAX_ROWS);
    let title = format!(
        "Order cuts over {} initial cage phases of {}: peak RMS",
        found.angles.len(),
        found.bearings.join(", ")
    );
    let header = ["channel", "order line", "this model", "smallest", "largest", "unit"];
    terminal.table(&title, &header, &rows);
    if left_out > 0 {
        terminal.print(&format!("  {left_out} more in results.h5 and --json"));
    }
}

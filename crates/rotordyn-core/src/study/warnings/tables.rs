//! Studies that need speeds beyond the tables of bearings and motor.

use crate::analysis::table_range::{self, check_torque_table, speed_range};
use crate::model::{Drive, Model};
use crate::study::Results;
use crate::warning::Warning;

/// Warnings of tables that end within the speeds of the results, one for each table.
pub(super) fn warnings(model: &Model, results: &Results) -> Vec<Warning> {
    let mut found = table_range::warnings(model, &speeds_of(model, results));
    if let (Drive::Torque { table, .. }, Some(run)) = (&model.drive, &results.run_up) {
        found.extend(run.summary.speed_range.and_then(|reached| check_torque_table(table, reached)));
    }
    found
}

/// Name of every study with a result, and its lowest and highest speed \[rad/s\].
///
/// The speeds of a bifurcation diagram are those of its models, which may differ. A search for critical speeds begins at
/// standstill without showing anything there: its lowest speed is the lowest critical speed.
fn speeds_of(model: &Model, results: &Results) -> Vec<(&'static str, [f64; 2])> {
    let modal: Vec<f64> = results.modal.iter().map(|at| at.speed).collect();
    let critical = results.critical.as_ref().map(|found| {
        let speeds = found.crossings.list.iter().map(|crossing| crossing.speed);
        [speeds.fold(found.max_speed, f64::min), found.max_speed]
    });
    let run_up = results.run_up.as_ref().and_then(|run| match model.drive {
        Drive::Prescribed { .. } => Some(model.profile.speed_range()),
        Drive::Torque { .. } => run.summary.speed_range,
    });
    let at = |speed: f64| [speed; 2];
    [
        ("static", results.equilibrium.as_ref().map(|found| at(found.speed))),
        ("modal", speed_range(&modal)),
        ("campbell", results.campbell.as_ref().and_then(|found| speed_range(&found.diagram.speeds))),
        ("critical", critical),
        ("frf", results.frf.as_ref().map(|found| at(found.speed))),
        ("unbalance", results.unbalance.as_ref().and_then(|found| speed_range(&found.speeds))),
        ("run-up", run_up),
        ("poincare", results.poincare.as_ref().map(|found| at(found.speed))),
        ("lyapunov", results.lyapunov.as_ref().map(|found| at(found.speed))),
    ]
    .into_iter()
    .filter_map(|(study, speeds)| Some((study, speeds?)))
    .collect()
}

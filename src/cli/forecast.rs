//! Forecast of a command's work before it starts: refused if its results exceed the free disk space, with a warning
//! if it takes long.

use std::path::Path;

use rotordyn::error::Error;
use rotordyn::study::Machine;
use rotordyn::study::forecast::{Forecast, Work};
use rotordyn::warning::Code;
use serde_json::{Value, json};

use super::failure::Failure;
use super::studies::Study;
use super::system::free_space;
use super::terminal::{Terminal, number};

/// Computing time from which a warning is given \[s\].
const LONG: f64 = 3600.0;

/// Refuses matrices beyond the memory and results beyond the free disk space, and warns of more than an hour.
///
/// # Errors
/// A machine with too many degrees of freedom for a study. Results larger than the free space of the folder's file system, before anything is written.
pub fn examine(
    machine: &Machine,
    wanted: &[Study],
    folder: &Path,
    terminal: &Terminal,
) -> Result<(), Failure> {
    wanted.iter().try_for_each(|study| machine.check_memory(study.name()))?;
    let is_wanted = |found: &Forecast| wanted.iter().any(|study| study.name() == found.study);
    let mut all = machine.forecasts();
    all.retain(is_wanted);
    let total: f64 = all.iter().map(|found| found.bytes).sum();
    if let Some(free) = free_space(folder)
        && total > free
        && let Some(largest) = all.iter().max_by(|a, b| a.bytes.total_cmp(&b.bytes))
    {
        let why = format!(
            "{} would write {} and {} are free; change study.{}: {}",
            largest.study,
            size(largest.bytes),
            size(free),
            largest.study.replace('-', "_"),
            largest.keys
        );
        return Err(Error::of_file("write the results to", folder)(why).into());
    }
    let threads = |found: &Forecast| match found.study {
        "bifurcation" => rayon::current_num_threads() as f64,
        _ => 1.0,
    };
    let times: Vec<(f64, &Forecast)> = all
        .iter()
        .filter_map(|found| Some((machine.estimated_seconds(found)? / threads(found), found)))
        .collect();
    let seconds: f64 = times.iter().map(|(time, _)| time).sum();
    if seconds > LONG
        && let Some((time, longest)) = times.iter().max_by(|a, b| a.0.total_cmp(&b.0))
    {
        terminal.warn_of(
            Code::LongComputation,
            format!(
                "the computation takes about {}: study.{} needs {} {} of {} s each; change {}, or stop it with \
                 Ctrl-C",
                duration(seconds),
                longest.study.replace('-', "_"),
                count(longest.count),
                unit(longest.work),
                number(time / longest.count, 2),
                longest.keys
            ),
        );
    }
    Ok(())
}

/// Table of the forecasts of all requested studies.
pub fn table(machine: &Machine, terminal: &Terminal) {
    let all = machine.forecasts();
    let rows: Vec<Vec<String>> = all
        .iter()
        .map(|found| {
            vec![
                found.study.to_string(),
                format!("{} {}", count(found.count), unit(found.work)),
                size(found.bytes),
            ]
        })
        .collect();
    if !rows.is_empty() {
        terminal.table("Forecast of the studies", &["study", "work", "size of the results"], &rows);
    }
    for found in &all {
        if let Err(error) = machine.check_memory(found.study) {
            terminal.print(&format!("  {} would be refused: {error}", found.study));
        }
    }
}

/// The same as JSON.
pub fn to_json(machine: &Machine) -> Value {
    let all = machine.forecasts();
    let one = |found: &Forecast| {
        let mut out = json!({
            "study": found.study, "work": unit(found.work), "count": found.count, "bytes": found.bytes,
        });
        if let Err(error) = machine.check_memory(found.study) {
            out["refused"] = json!(error.to_string());
        }
        out
    };
    all.iter().map(one).collect()
}

/// "520010", "3.2e9".
fn count(count: f64) -> String {
    if count < 1e7 { format!("{count:.0}") } else { format!("{count:.1e}") }
}

fn unit(work: Work) -> &'static str {
    match work {
        Work::Steps => "steps",
        Work::Solutions => "solutions",
        Work::Frames => "frames",
    }
}

/// "3.2 MB".
fn size(bytes: f64) -> String {
    let units = [(1e15, "PB"), (1e12, "TB"), (1e9, "GB"), (1e6, "MB"), (1e3, "kB")];
    match units.iter().find(|(factor, _)| bytes >= *factor) {
        Some((factor, unit)) => format!("{} {unit}", number(bytes / factor, 3)),
        None => format!("{bytes:.0} B"),
    }
}

/// "3.2 hours".
fn duration(seconds: f64) -> String {
    let units = [(365.25 * 86400.0, "years"), (86400.0, "days"), (3600.0, "hours")];
    match units.iter().find(|(factor, _)| seconds >= 2.0 * factor) {
        Some((factor, unit)) => format!("{} {unit}", number(seconds / factor, 2)),
        None => format!("{} minutes", number(seconds / 60.0, 2)),
    }
}

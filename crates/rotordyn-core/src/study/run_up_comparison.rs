//! Comparison of the run-ups of several cases of a machine, and of a measured one, channel by channel.

use super::StudyError;
use super::case_comparison::MEASURED;
use super::run_up_correlation::{correlation, peak, vibration_rms};
use crate::results::{
    CaseCut, CaseRun, ComparedChannel, CutPoint, History, HistoryChannel, OrderResult, RunUpComparison,
    SpectrogramResult,
};
use rotordyn_signal::order::OrderCut;

/// A run with its spectra.
pub struct Run<'a> {
    /// The case, or [`MEASURED`] for a measured run, which stands first.
    pub name: &'a str,
    pub history: &'a History,
    pub spectrograms: &'a [SpectrogramResult],
    pub orders: &'a [OrderResult],
}

/// Levels, spectrograms and order cuts of the channels that every run has in the same unit and direction.
///
/// # Errors
/// Samples that cannot be read.
pub fn compare_run_ups(runs: &[Run]) -> Result<RunUpComparison, StudyError> {
    let mut out = RunUpComparison {
        cases: runs.iter().map(|run| run.name.into()).collect(),
        ..RunUpComparison::default()
    };
    let mut names: Vec<&str> = Vec::new();
    for run in runs {
        let mapped = run.spectrograms.iter().map(|s| s.channel.as_str());
        for name in mapped.chain(run.orders.iter().map(|o| o.channel.as_str())) {
            if !names.contains(&name) {
                names.push(name);
            }
        }
    }
    for name in names {
        let found: Vec<Option<&HistoryChannel>> = runs.iter().map(|run| run.history.channel(name)).collect();
        let missing: Vec<&str> =
            runs.iter().zip(&found).filter(|(_, c)| c.is_none()).map(|(run, _)| run.name).collect();
        if !missing.is_empty() {
            out.left_out.push(format!("{name}: not in {}", missing.join(", ")));
            continue;
        }
        let channels: Vec<&HistoryChannel> = found.into_iter().flatten().collect();
        let Some(first) = channels.first() else { continue };
        let differs = |c: &HistoryChannel| c.unit != first.unit || c.direction != first.direction;
        if let Some((other, _)) = runs.iter().zip(&channels).find(|(_, c)| differs(c)) {
            let (other, own) = (other.name, runs[0].name);
            out.left_out.push(format!("{name}: unit or direction in {other} is not that in {own}"));
            continue;
        }
        let mut compared = Vec::new();
        for (run, channel) in runs.iter().zip(&channels) {
            let orders = run.orders.iter().find(|o| o.channel == name);
            let measured = runs.first().filter(|first| first.name == MEASURED && run.name != MEASURED);
            let measured = measured.and_then(|first| first.orders.iter().find(|o| o.channel == name));
            compared.push(CaseRun {
                case: run.name.into(),
                rms: vibration_rms(run.history, channel)?,
                spectrogram: run.spectrograms.iter().find(|s| s.channel == name).cloned(),
                cuts: orders.map(|own| cuts(own, measured)).unwrap_or_default(),
                orders: orders.cloned(),
            });
        }
        out.channels.push(ComparedChannel { channel: name.into(), unit: first.unit.clone(), runs: compared });
    }
    Ok(out)
}

fn cuts(own: &OrderResult, measured: Option<&OrderResult>) -> Vec<CaseCut> {
    let of_measured = |label: &str| -> Option<&OrderCut> {
        measured?.cuts.iter().find(|(line, _)| line.label == label).map(|(_, cut)| cut)
    };
    let points = |cut: &OrderCut| {
        cut.rpm.iter().zip(&cut.rms).map(|(rpm, rms)| CutPoint { rpm: *rpm, rms: *rms }).collect()
    };
    own.cuts
        .iter()
        .map(|(line, cut)| CaseCut {
            label: line.label.clone(),
            order: cut.order,
            peak: peak(cut),
            correlation: of_measured(&line.label).map(|measured| correlation(measured, cut)),
            points: points(cut),
        })
        .collect()
}

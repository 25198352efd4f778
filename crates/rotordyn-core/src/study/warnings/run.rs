//! Runs: energy balance, step, reduced model, settling.

use crate::document::{TO_RPM, number};
use crate::model::Model;
use crate::results::{BifurcationPoint, RunUpResult};
use crate::study::Results;
use crate::warning::{Code, Warning};
use std::f64::consts::TAU;

/// Residual of the energy balance over the energy exchanged, above which the step is too long.
const OPEN_BALANCE: f64 = 1e-3;
/// Relative error of a level by the step.
const LEVEL_ERROR: f64 = 0.05;
/// Relative error of the reduced model's natural frequencies.
const FREQUENCY_ERROR: f64 = 0.01;

/// Warnings of a run-up: energy balance, error by the step, error of the reduced model.
pub fn run_up(run: &RunUpResult) -> Vec<Warning> {
    let mut found = Vec::new();
    let mut warn = |code, text: String, advice: String| {
        found.push(Warning::new(code, "study.run_up", text).advise(advice));
    };
    let energy = &run.report.energy;
    let open = energy.residual().abs() / energy.exchanged().max(f64::MIN_POSITIVE);
    if open > OPEN_BALANCE {
        let text = format!("the energy balance of the run-up has a residual of {:.2} %", 100.0 * open);
        let step = if run.report.defect_step.is_some() { "step or defect_step" } else { "the time step" };
        warn(Code::EnergyBalance, text, format!("reduce {step}"));
    }
    let worst = run.step_error.as_ref().and_then(|e| e.worst());
    if let Some(line) = worst.filter(|line| line.error.abs() > LEVEL_ERROR) {
        let step = run.report.step.unwrap_or_default();
        let text = format!(
            "the time step of {:.4} us changes the level of {} of {} by about {:.0} %",
            1e6 * step,
            line.line.label,
            line.channel,
            100.0 * line.error.abs()
        );
        let needed = 1e6 * step * (0.01 / line.error.abs()).sqrt();
        warn(Code::TimeStep, text, format!("about {needed:.3} us would give 1 %"));
    }
    if run.frequency_error > FREQUENCY_ERROR {
        let text = format!("frequency error of the reduced model is {:.1} %", 100.0 * run.frequency_error);
        warn(Code::Reduction, text, "raise the cutoff".into());
    }
    found
}

/// The highest order line of the spectrograms that leaves the record: above half its sampling rate at the highest speed.
///
/// Order tracking refuses such orders by itself.
pub(super) fn sample_rate(model: &Model, results: &Results) -> Option<Warning> {
    let rate = model.studies.run_up.as_ref()?.sample_rate;
    let speeds = results.spectrograms.iter().flat_map(|found| &found.speed);
    let top = speeds.fold(0.0, |top: f64, speed| top.max(speed.abs()));
    let lines = results.spectrograms.iter().flat_map(|found| &found.orders);
    let highest = lines.max_by(|a, b| a.order.total_cmp(&b.order))?;
    let frequency = highest.order * top / TAU;
    (frequency > 0.5 * rate).then(|| {
        let text = format!(
            "the order line {} reaches {frequency:.0} Hz at {:.0} rpm, above half the sampling rate of {rate:.0} Hz: the \
             spectrogram does not contain it there, and shows what the sampling folds back",
            highest.label,
            top * TO_RPM
        );
        Warning::new(Code::SampleRate, "study.spectrogram", text)
    })
}

/// Motions that have not settled, and records that were stopped before their end.
pub(super) fn settling(model: &Model, results: &Results) -> Vec<Warning> {
    let mut warnings = Vec::new();
    let partial = [
        ("poincare", "class of the motion", results.poincare.as_ref().and_then(|found| found.partial)),
        ("lyapunov", "exponent", results.lyapunov.as_ref().and_then(|found| found.partial)),
    ];
    for (study, what, partial) in partial {
        let Some(partial) = partial else { continue };
        let text = format!(
            "study.{study}: stopped after {}; the {what} is that of these periods alone, which may not have settled",
            partial.words()
        );
        let item = format!("study.{study}");
        warnings.push(Warning::new(Code::NotSettled, &item, text).advise("--resume goes on from there"));
    }
    if let (Some(found), Some(study)) = (&results.poincare, &model.studies.poincare)
        && !found.motion.motion.is_settled()
        && found.partial.is_none()
    {
        let periods = found.transient_periods + study.steady.periods;
        let more = match found.motion.periods_to_settle(study.tolerance) {
            Some(needed) => format!("; about {needed:.0} more periods are needed"),
            None => String::new(),
        };
        let text = format!(
            "study.poincare: the motion at {:.1} rpm has not settled after {periods} periods{more}",
            found.speed * TO_RPM
        );
        let advice = format!("raise transient_limit ({})", study.steady.transient_limit);
        warnings.push(Warning::new(Code::NotSettled, "study.poincare", text).advise(advice));
    }
    if let (Some(found), Some(study)) = (&results.bifurcation, &model.studies.bifurcation) {
        for sweep in &found.sweeps {
            let unsettled: Vec<f64> =
                sweep.points.iter().filter(|p| is_unsettled(p)).map(|p| p.value).collect();
            let ([first, .., last] | [first @ last]) = unsettled[..] else { continue };
            let unit = &found.parameter.unit;
            let at = match unsettled.len() {
                1 => format!("{} {unit}", number(first, 6)),
                _ => format!("from {} to {} {unit}", number(first, 6), number(last, 6)),
            };
            let text = format!(
                "study.bifurcation: {} of {} motions of the sweep {} have not settled ({})",
                unsettled.len(),
                sweep.points.len(),
                sweep.name,
                at.trim_end()
            );
            let advice = format!("raise transient_limit ({} periods)", study.steady.transient_limit);
            warnings.push(Warning::new(Code::NotSettled, "study.bifurcation", text).advise(advice));
        }
    }
    warnings
}

fn is_unsettled(point: &BifurcationPoint) -> bool {
    point.motion.as_ref().is_ok_and(|m| !m.motion.motion.is_settled())
}

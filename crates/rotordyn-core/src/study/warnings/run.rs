//! Runs: energy balance, step, reduced model, settling.

use crate::analysis::stability::is_unstable;
use crate::analysis::{Mode, modal};
use crate::assembly::PhysicsError;
use crate::document::{TO_RPM, number};
use crate::model::Model;
use crate::results::{BifurcationPoint, RunUpResult};
use crate::study::{Machine, Results};
use crate::transient::run::{End, Report};
use crate::warning::{Code, Warning};
use std::f64::consts::TAU;

/// Residual of the energy balance over the energy exchanged, above which the step is too long.
const OPEN_BALANCE: f64 = 1e-3;
/// Residual over the largest stored energy, mostly that of the static load, below which next to nothing vibrates.
const AT_REST: f64 = 1e-6;
/// Round-off of a step's energies, in that of one operation.
const ROUND_OFFS: f64 = 16.0;
/// Linear modes looked at where a motion grows, and exponent of their growth from which they matter.
const MODES: usize = 12;
const GROWTH: f64 = 3.0;
/// Relative error of a level by the step.
const LEVEL_ERROR: f64 = 0.05;
/// Relative error of the reduced model's natural frequencies.
const FREQUENCY_ERROR: f64 = 0.01;

impl Machine {
    /// Warnings of a run-up: energy balance and what makes the motion grow, error by the step, error of the reduced model.
    pub fn run_up_warnings(&self, run: &RunUpResult) -> Vec<Warning> {
        let mut found = Vec::new();
        let mut warn = |code, text: String, advice: String| {
            found.push(Warning::new(code, "study.run_up", text).advise(advice));
        };
        let energy = &run.report.energy;
        let residual = energy.residual().abs();
        let open = residual / energy.exchanged().max(f64::MIN_POSITIVE);
        let is_open = open > OPEN_BALANCE && residual > least_residual(&run.report);
        let diverged = matches!(run.report.end, End::Failed(PhysicsError::Diverged { .. }));
        let unstable = if is_open || diverged { self.growing_mode(run) } else { None };
        if let Some((speed, mode)) = &unstable {
            let text = format!(
                "{} is unstable at {:.0} rpm (zeta = {:.3} %): the motion grows by itself{}",
                mode.label,
                speed * TO_RPM,
                100.0 * mode.zeta(),
                if diverged { ", the likely cause of the divergence" } else { "" }
            );
            warn(Code::UnstableMode, text, Code::UnstableMode.advice().into());
        }
        if is_open {
            let text = format!("the energy balance of the run-up has a residual of {:.2} %", 100.0 * open);
            let advice = match (&unstable, run.report.step, run.report.defect_step) {
                (Some(_), ..) => "the motion grows by itself, which no time step prevents; see unstable-mode",
                (None, None, _) => "reduce relative_tolerance and absolute_tolerance, which choose the steps",
                (None, _, Some(_)) => "reduce step or defect_step",
                _ => "reduce the time step",
            };
            warn(Code::EnergyBalance, text, advice.into());
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
            // Contacts that open make chaos possible.
            let chaotic = match self.model.bearings.iter().any(|site| site.bearing.ball().is_some()) {
                true => ", unless the motion is chaotic: then two steps part whatever their length",
                false => "",
            };
            warn(Code::TimeStep, text, format!("about {needed:.3} us would give 1 %{chaotic}"));
        }
        if run.frequency_error > FREQUENCY_ERROR {
            let text =
                format!("frequency error of the reduced model is {:.1} %", 100.0 * run.frequency_error);
            warn(Code::Reduction, text, "raise the cutoff".into());
        }
        found
    }

    /// The least damped of the linear modes that grow by e^3 or more within the run, at the speed where it ended or at its
    /// highest one; with that speed \[rad/s\].
    fn growing_mode(&self, run: &RunUpResult) -> Option<(f64, Mode)> {
        let duration = run.summary.samples as f64 / run.history.sample_rate;
        let ended = match &run.report.end {
            End::Failed(PhysicsError::Diverged { speed_rpm, .. }) => Some(speed_rpm / TO_RPM),
            _ => None,
        };
        let highest = run.summary.speed_range.iter().flatten().fold(0.0, |top: f64, v| top.max(v.abs()));
        let speed = ended.unwrap_or(highest);
        // What cannot be linearised there has no modes.
        let modes = modal::modes(&self.assembly, &self.linear_system(speed).ok()?, MODES).ok()?;
        let growing = modes.into_iter().filter(|mode| {
            is_unstable(mode.eigenvalue) && (ended.is_some() || mode.eigenvalue.re * duration > GROWTH)
        });
        growing.min_by(|a, b| a.zeta().total_cmp(&b.zeta())).map(|mode| (speed, mode))
    }
}

/// Least residual of the energy balance \[J\] that counts: round-off of its largest term at every step, which adds up by chance,
/// and a millionth of the largest stored energy.
fn least_residual(report: &Report) -> f64 {
    let e = &report.energy;
    let terms = [e.kinetic, e.strain, e.contact, e.start, e.work, e.drive, e.parametric];
    let largest = terms.iter().fold(0.0, |largest: f64, term| largest.max(term.abs()));
    let stored = e.strain.abs().max(e.contact.abs());
    let rounding = ROUND_OFFS * f64::EPSILON * largest * (report.steps.max(1) as f64).sqrt();
    rounding.max(AT_REST * stored)
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

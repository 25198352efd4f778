//! Runs a reduced machine through its speed profile.

use std::ops::ControlFlow;

use super::energy::{Energy, EnergyLedger};
use super::generalised_alpha::{GeneralisedAlpha, Scheme};
use super::runge_kutta::RungeKutta;
use super::system::{State, System};
use crate::error::PhysicsError;
use crate::model::study::Integrator;

/// How a run is stepped and sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    pub integrator: Integrator,
    /// Largest step \[s\]; the step taken divides the sampling interval.
    pub step: f64,
    /// Sampling rate \[Hz\].
    pub sample_rate: f64,
    /// End of the run \[s\].
    pub duration: f64,
}

/// What an observer sees at every sampling instant.
pub struct Sample<'a> {
    pub index: usize,
    pub state: &'a State,
    /// Values of the system's channels, in order.
    pub channels: &'a [f64],
    pub energy: &'a Energy,
}

/// How a run ended, with the work it took.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    pub samples: usize,
    pub steps: u64,
    /// Newton iterations of an implicit run.
    pub iterations: u64,
    /// Effective matrices inverted by an implicit run.
    pub refactored: u64,
    /// Steps that had to be halved (implicit) or were refused by error control (explicit).
    pub halvings: u64,
    pub energy: Energy,
    pub end: End,
}

/// Why a run ended.
#[derive(Clone, Debug, PartialEq)]
pub enum End {
    Complete,
    /// The observer asked to stop (Ctrl-C).
    Stopped,
    /// The physics failed; what was sampled before stands.
    Failed(PhysicsError),
}

/// A step halved this often has no hope: 2⁻¹² of the step.
const MAX_HALVINGS: u32 = 12;
/// A bearing displacement beyond this \[m\] means the run has diverged.
const DIVERGED: f64 = 0.1;

#[allow(clippy::large_enum_variant)] // there is one
enum Stepper {
    Implicit(Box<GeneralisedAlpha>),
    Fixed(RungeKutta),
    Adaptive(StepControl),
}

/// Runs `system` from `state`, calling `observe` at t = 0 and every sampling instant.
///
/// A step that does not converge is halved; a run that fails ends with [`End::Failed`], everything sampled
/// before having been observed. The result depends on nothing but the arguments.
pub fn run(
    system: &System,
    mut state: State,
    settings: &Settings,
    mut observe: impl FnMut(&Sample) -> ControlFlow<()>,
) -> Report {
    let interval = 1.0 / settings.sample_rate;
    let substeps = (interval / settings.step * (1.0 - 1e-12)).ceil().max(1.0) as usize;
    let step = interval / substeps as f64;
    let samples = (settings.duration * settings.sample_rate + 1e-9).floor() as usize;
    let implicit_stepper = |scheme| Stepper::Implicit(Box::new(GeneralisedAlpha::new(system, scheme)));
    let mut stepper = match settings.integrator {
        Integrator::GeneralisedAlpha { rho_infinity } => {
            implicit_stepper(Scheme::generalised_alpha(rho_infinity))
        }
        Integrator::Newmark => implicit_stepper(Scheme::NEWMARK),
        Integrator::RungeKutta4 => Stepper::Fixed(RungeKutta::classical(system)),
        Integrator::DormandPrince { relative_tolerance, absolute_tolerance } => {
            Stepper::Adaptive(StepControl {
                method: RungeKutta::dormand_prince(system),
                tolerance: (relative_tolerance, absolute_tolerance),
                step,
            })
        }
    };
    let mut ledger = EnergyLedger::new(system, &state);
    let mut channels = vec![0.0; system.channels.len()];
    let mut report = Report {
        samples: 0,
        steps: 0,
        iterations: 0,
        refactored: 0,
        halvings: 0,
        energy: ledger.energy,
        end: End::Complete,
    };
    for index in 0..=samples {
        if index > 0 {
            let advanced = match &mut stepper {
                Stepper::Implicit(method) => (0..substeps).try_for_each(|k| {
                    implicit(system, &mut state, method, step, 0, &mut ledger, &mut report)?;
                    // Counted, not summed: the clock does not drift.
                    state.time = ((index - 1) * substeps + k + 1) as f64 * step;
                    Ok(())
                }),
                Stepper::Fixed(method) => {
                    for k in 0..substeps {
                        explicit(system, &mut state, method, step, None, &mut ledger, &mut report);
                        state.time = ((index - 1) * substeps + k + 1) as f64 * step;
                    }
                    Ok(())
                }
                Stepper::Adaptive(control) => {
                    let end = index as f64 * interval;
                    control.advance(system, &mut state, end, &mut ledger, &mut report)
                }
            };
            if let Err(error) = advanced.and_then(|()| check(system, &state)) {
                report.end = End::Failed(error);
                break;
            }
        }
        ledger.stored(system, &state);
        system.read_channels(&state, &mut channels);
        report.samples = index + 1;
        let sample = Sample { index, state: &state, channels: &channels, energy: &ledger.energy };
        if observe(&sample).is_break() {
            report.end = End::Stopped;
            break;
        }
    }
    if let Stepper::Implicit(method) = &stepper {
        report.iterations = method.iterations;
        report.refactored = method.refactored;
    }
    report.energy = ledger.energy;
    report
}

/// One implicit step, halved while Newton does not converge.
fn implicit(
    system: &System,
    state: &mut State,
    method: &mut GeneralisedAlpha,
    step: f64,
    depth: u32,
    ledger: &mut EnergyLedger,
    report: &mut Report,
) -> Result<(), PhysicsError> {
    let end = system.spin_ahead(state.time, &state.spin, step);
    match method.step(system, state, step, end) {
        Ok(()) => {
            finish_step(system, state, ledger, report);
            Ok(())
        }
        Err(_) if depth < MAX_HALVINGS => {
            report.halvings += 1;
            implicit(system, state, method, 0.5 * step, depth + 1, ledger, report)?;
            implicit(system, state, method, 0.5 * step, depth + 1, ledger, report)
        }
        Err(failure) => Err(PhysicsError::NoConvergence {
            item: system.name_of_row(failure.row),
            time: state.time,
            speed_rpm: rpm(state.spin.speed),
            residual: failure.residual,
            iterations: failure.iterations,
        }),
    }
}

/// One explicit step; returns the error estimate, above 1 when the step was refused.
fn explicit(
    system: &System,
    state: &mut State,
    method: &mut RungeKutta,
    step: f64,
    tolerance: Option<(f64, f64)>,
    ledger: &mut EnergyLedger,
    report: &mut Report,
) -> f64 {
    let (time, spin) = (state.time, state.spin);
    let ahead = |offset| system.spin_ahead(time, &spin, offset);
    let estimate = method.step(system, state, step, &ahead, tolerance);
    if estimate <= 1.0 {
        finish_step(system, state, ledger, report);
    }
    estimate
}

fn finish_step(system: &System, state: &mut State, ledger: &mut EnergyLedger, report: &mut Report) {
    report.steps += 1;
    ledger.book(system, state);
    if let Some(drive) = &system.drive {
        drive.recentre(state);
        ledger.start_from(system, state);
    }
}

/// Error control of an embedded method of order 5(4).
struct StepControl {
    method: RungeKutta,
    /// Relative, and absolute in mass-normalised coordinates.
    tolerance: (f64, f64),
    step: f64,
}

impl StepControl {
    /// Steps to `end` exactly, adapting the step on the way.
    fn advance(
        &mut self,
        system: &System,
        state: &mut State,
        end: f64,
        ledger: &mut EnergyLedger,
        report: &mut Report,
    ) -> Result<(), PhysicsError> {
        let smallest = 1e-12 * end.max(1e-3);
        while end - state.time > smallest {
            let left = end - state.time;
            // Two equal steps rather than one full and one sliver.
            let step = if self.step >= left {
                left
            } else if 2.0 * self.step > left {
                0.5 * left
            } else {
                self.step
            };
            let method = &mut self.method;
            let estimate = explicit(system, state, method, step, Some(self.tolerance), ledger, report);
            let factor = if estimate > 0.0 { 0.9 * estimate.powf(-0.2) } else { 5.0 };
            if estimate <= 1.0 {
                self.step = step * factor.clamp(0.2, 5.0);
            } else {
                report.halvings += 1;
                self.step = if estimate.is_finite() { step * factor.clamp(0.1, 0.9) } else { 0.1 * step };
                if self.step < smallest {
                    return Err(PhysicsError::NoConvergence {
                        item: "error control".into(),
                        time: state.time,
                        speed_rpm: rpm(state.spin.speed),
                        residual: estimate,
                        iterations: report.halvings as usize,
                    });
                }
            }
        }
        state.time = end;
        Ok(())
    }
}

/// Whether the state is still one: finite, and no bearing torn apart.
fn check(system: &System, state: &State) -> Result<(), PhysicsError> {
    let finite = state.x.iter().chain(state.v.iter()).all(|v| v.is_finite());
    let worst = state.d.iter().enumerate().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
    let (row, value) = worst.map_or((0, 0.0), |(r, v)| (r, *v));
    if finite && value.abs() < DIVERGED {
        return Ok(());
    }
    Err(PhysicsError::Diverged {
        item: system.name_of_row(row),
        time: state.time,
        speed_rpm: rpm(state.spin.speed),
        value,
    })
}

fn rpm(speed: f64) -> f64 {
    speed * 30.0 / std::f64::consts::PI
}

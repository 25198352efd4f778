//! A step under a torque drive: the rotation at the end of the step is found together with the coordinates.
//!
//! The coupling loads e and the angular acceleration Ω̇ at the end of the step are iterated. Every pass is a step with
//! given e and Ω̇. What e should have been at the accelerations found follows with the response of the linear part to e
//! ([`TorqueDrive::solve_coupling`]), so that only bearing tangents and terms in x and ẋ are left to iteration.

use super::driven_buffers::DrivenStep;
use nalgebra::DVector;

use super::{GeneralisedAlpha, StepFailure};
use crate::model::Spin;
use crate::transient::system::{State, System};
use crate::transient::torque::TorqueDrive;
use crate::transient::torque::coupling::Motion;

/// Defect of the coupling loads, relative to the accelerations, at which the iteration ends.
const TOLERANCE: f64 = 1e-11;
/// The same after the last pass, for the round-off of stiff coordinates.
const LAST_TOLERANCE: f64 = 1e-8;
const MAX_PASSES: usize = 30;

impl GeneralisedAlpha {
    /// Advances `state` by `step` with the rotation as an unknown.
    ///
    /// # Errors
    /// No convergence; the state is then unchanged.
    pub(super) fn driven_step(
        &mut self,
        system: &System,
        drive: &TorqueDrive,
        state: &mut State,
        step: f64,
    ) -> Result<(), StepFailure> {
        let mut driven = self.driven.take().unwrap_or_else(|| DrivenStep::new(drive, system.size()));
        let found = self.iterate(system, drive, state, step, &mut driven);
        if let Ok((spin, rate)) = found {
            driven.previous_load.copy_from(&state.driven.load);
            (driven.previous_rate, driven.previous_step) = (state.spin.acceleration, step);
            self.update(state, step, spin);
            state.driven.load.copy_from(&driven.load);
            state.driven.acceleration.copy_from(&driven.acceleration);
            state.driven.rate = rate;
        }
        self.driven = Some(driven);
        found.map(|_| ())
    }

    /// The shaft's motion at the end of the step and the integrator's angular acceleration there.
    fn iterate(
        &mut self,
        system: &System,
        drive: &TorqueDrive,
        state: &State,
        step: f64,
        driven: &mut DrivenStep,
    ) -> Result<(Spin, f64), StepFailure> {
        let scheme = self.scheme;
        let gain = scheme.gain(step);
        let mut change = f64::INFINITY;
        let mut end_rate = driven.guess(state, step);
        for pass in 0..MAX_PASSES {
            let (spin, rate) = self.frame(state, step, end_rate);
            self.predict(system, state, step, &spin);
            self.assemble(system, state, step, &spin);
            // α_f R₀ has the coupling at the start, (1−α_f) R₁ that at the end.
            self.right.axpy(scheme.alpha_f, &state.driven.load, 1.0);
            self.right.axpy(1.0 - scheme.alpha_f, &driven.load, 1.0);
            self.right.axpy(1.0 - scheme.alpha_f, &driven.spin_up, 1.0);
            let matrix_spin = Spin { acceleration: 0.0, ..spin };
            self.solve(system, state, step, &matrix_spin, pass == 0)?;
            self.end_of_step(system, state, step, driven);

            // δ = coupling(x₁, ẋ₁, ẍ₁) − e.
            driven.correction.copy_from(&driven.load);
            driven.correction.neg_mut();
            let at = Motion { spin: &spin, x: &driven.x, v: &driven.v, acceleration: &driven.acceleration };
            let reactions = self.newton.reactions();
            drive.add_coupling(system, &at, reactions, &mut driven.work, &mut driven.correction);
            // Mass-normalised accelerations: of the coordinates, of the rotation, and by the loads they balance.
            let scale = driven.acceleration.norm()
                + driven.load.norm()
                + drive.inertia().sqrt() * spin.acceleration.abs()
                + system.static_load.norm();
            change = driven.correction.norm();
            let tolerance = if pass + 1 < MAX_PASSES { TOLERANCE } else { LAST_TOLERANCE };
            if change <= tolerance * scale {
                return Ok((spin, rate));
            }
            if !change.is_finite() {
                break;
            }
            // D = (1−α_m) S⁻¹.
            let DrivenStep { work, correction, response, scratch, .. } = &mut *driven;
            let matrix = self.matrices.at(system, scheme, step, &matrix_spin);
            let mut respond = |load: &DVector<f64>, response: &mut DVector<f64>| {
                let n = system.structure();
                response.fill(0.0);
                matrix.add_inverse(
                    spin.speed,
                    &load.as_slice()[..n],
                    scratch,
                    &mut response.as_mut_slice()[..n],
                );
                *response *= 1.0 - scheme.alpha_m;
            };
            respond(correction, response);
            work.set_responses(&mut respond);
            drive.solve_coupling(work, response, correction);
            respond(correction, response);
            let turned = drive.rigid_part(response);
            end_rate += drive.rigid_part(&driven.acceleration) + turned;
            driven.load += &driven.correction;
            driven.load.axpy(turned, driven.work.spin_up_x(), 1.0);
            if system.panels.has_spin_up() {
                let n = system.structure();
                let by_step = self.a.rows(0, n);
                let factor = -spin.acceleration * gain.position;
                driven.spin_up.rows_mut(0, n).gemv(factor, &system.spin_up, &by_step, 0.0);
            }
        }
        Err(StepFailure { row: usize::MAX, residual: change, iterations: MAX_PASSES })
    }

    /// The frame's motion at the end of a step with the angular acceleration Ω̇₁, by the same formulas as x:
    /// (1−α_m) â₁ + α_m â₀ = (1−α_f) Ω̇₁ + α_f Ω̇₀. Returns it with â₁.
    fn frame(&self, state: &State, step: f64, end_rate: f64) -> (Spin, f64) {
        let super::Scheme { alpha_m, alpha_f, beta, gamma } = self.scheme;
        let Spin { angle, speed, acceleration } = state.spin;
        let start = state.driven.rate;
        let rate = ((1.0 - alpha_f) * end_rate + alpha_f * acceleration - alpha_m * start) / (1.0 - alpha_m);
        let spin = Spin {
            angle: angle + step * (speed + step * ((0.5 - beta) * start + beta * rate)),
            speed: speed + step * ((1.0 - gamma) * start + gamma * rate),
            acceleration: end_rate,
        };
        (spin, rate)
    }

    /// x₁, ẋ₁ and ẍ₁ = ((1−α_m) a₁ + α_m a₀ − α_f ẍ₀)/(1−α_f).
    fn end_of_step(&self, system: &System, state: &State, step: f64, driven: &mut DrivenStep) {
        let super::Scheme { alpha_m, alpha_f, .. } = self.scheme;
        let gain = self.scheme.gain(step);
        debug_assert_eq!(self.a.len(), system.size());
        driven.x.copy_from(&self.x);
        driven.x.axpy(gain.position, &self.a, 1.0);
        driven.v.copy_from(&self.v);
        driven.v.axpy(gain.velocity, &self.a, 1.0);
        let weight = 1.0 / (1.0 - alpha_f);
        driven.acceleration.copy_from(&self.a);
        driven.acceleration.scale_mut((1.0 - alpha_m) * weight);
        driven.acceleration.axpy(alpha_m * weight, &state.a, 1.0);
        driven.acceleration.axpy(-alpha_f * weight, &state.driven.acceleration, 1.0);
    }
}

//! A step under a torque drive: the rotation at the end of the step is found together with the coordinates.
//!
//! The coupling loads e and the angular acceleration Ω̇ at the end of the step are iterated. Every pass is a step with
//! given e and Ω̇. What e should have been at the accelerations found follows with the response of the linear part to e
//! ([`TorqueDrive::solve_coupling`]), so that only bearing tangents and terms in x and ẋ are left to iteration.

use super::driven_buffers::DrivenStep;
use nalgebra::DVector;

use super::{GeneralisedAlpha, Scheme, StepFailure};
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
        let mut change = f64::INFINITY;
        let mut end_rate = driven.guess(state, step);
        // The first guess of the acceleration at the end is that at the start.
        self.acceleration.copy_from(&state.acceleration);
        for pass in 0..MAX_PASSES {
            let (spin, rate) = self.frame(state, step, end_rate);
            self.predict(system, state, step, &spin);
            self.end_of_step(step, driven);
            self.find_load(system, step, state.time + step, &spin, driven);
            self.solve(system, state, step, &spin, pass == 0, Some(&driven.total))?;
            self.end_of_step(step, driven);

            // δ = coupling(x₁, ẋ₁, ẍ₁) − e.
            driven.correction.copy_from(&driven.load);
            driven.correction.neg_mut();
            let at = Motion { spin: &spin, x: &driven.x, v: &driven.v, acceleration: &self.acceleration };
            let reactions = self.newton.reactions();
            drive.add_coupling(system, &at, reactions, &mut driven.work, &mut driven.correction);
            // Mass-normalised accelerations: of the coordinates, of the rotation, and by the loads they balance.
            let scale = self.acceleration.norm()
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
            // D = S⁻¹.
            let DrivenStep { work, correction, response, .. } = &mut *driven;
            let n = system.structure();
            let matrix = self.matrices.at(system, self.scheme, step, state.time + step, &spin);
            let mut respond = |load: &DVector<f64>, response: &mut DVector<f64>| {
                response.fill(0.0);
                matrix.add_inverse(&load.as_slice()[..n], &mut response.as_mut_slice()[..n]);
            };
            respond(correction, response);
            work.set_responses(&mut respond);
            drive.solve_coupling(work, response, correction);
            respond(correction, response);
            let turned = drive.rigid_part(response);
            end_rate += drive.rigid_part(&self.acceleration) + turned;
            driven.load += &driven.correction;
            driven.load.axpy(turned, driven.work.spin_up_x(), 1.0);
        }
        Err(StepFailure { row: usize::MAX, residual: change, iterations: MAX_PASSES })
    }

    /// The frame's motion at the end of a step with the angular acceleration Ω̇₁, by the same formulas as x. Returns it
    /// with the integrator's acceleration.
    fn frame(&self, state: &State, step: f64, end_rate: f64) -> (Spin, f64) {
        let Scheme { beta, gamma, .. } = self.scheme;
        let Spin { angle, speed, acceleration } = state.spin;
        let (start, mean) = (state.driven.rate, self.scheme.mean());
        let rate = mean.end * end_rate + mean.start * acceleration + mean.before * start;
        let spin = Spin {
            angle: angle + step * (speed + step * ((0.5 - beta) * start + beta * rate)),
            speed: speed + step * ((1.0 - gamma) * start + gamma * rate),
            acceleration: end_rate,
        };
        (spin, rate)
    }

    /// e with what the step matrix of the speed Ω_w leaves out, −(Ω − Ω_w) (G ẋ₁ + K_c x₁) − Ω̇ K_s x₁, at the motion of
    /// the last pass.
    fn find_load(&mut self, system: &System, step: f64, time: f64, spin: &Spin, driven: &mut DrivenStep) {
        let matrix = self.matrices.at(system, self.scheme, step, time, spin);
        let left_out = Spin { speed: spin.speed - matrix.speed(), ..*spin };
        let DrivenStep { load, total, x, v, .. } = driven;
        total.copy_from(load);
        system.add_rotational(&left_out, [&*x, &*v], -1.0, &mut self.parts, total);
    }

    /// x₁ and ẋ₁.
    fn end_of_step(&self, step: f64, driven: &mut DrivenStep) {
        let gain = self.scheme.gain(step);
        driven.x.copy_from(&self.x);
        driven.x.axpy(gain.position, &self.acceleration, 1.0);
        driven.v.copy_from(&self.v);
        driven.v.axpy(gain.velocity, &self.acceleration, 1.0);
    }
}

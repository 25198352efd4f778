//! Generalised-α and Newmark time steps, with Newton iteration on the bearing interfaces only.
//!
//! A step is predict, assemble, solve, update: [`GeneralisedAlpha::step`] reads so. The linear part changes only with
//! the speed Ω, so one inverse of the effective matrix serves many steps (`effective_matrix`). The nonlinear bearings
//! act on a few interface rows, so Newton's method solves for those rows (`interface_newton`) and the other coordinates
//! follow by back-substitution. Internal coordinates of a bearing are coupled to that bearing alone, which solves
//! their equations at every Newton iteration.

mod driven_buffers;
mod driven_step;
mod effective_matrix;
mod interface_newton;
mod memory;
mod scheme;

pub use memory::StepMemory;
use nalgebra::DVector;
pub use scheme::{Scheme, StepFailure};

use super::cage;
use super::system::{State, System};
use crate::model::Spin;
use driven_buffers::DrivenStep;
use effective_matrix::EffectiveMatrices;
use interface_newton::InterfaceNewton;
use rotordyn_bearing::Rotation;

/// One-step implicit integrator; owns every buffer, so that a step allocates nothing.
pub struct GeneralisedAlpha {
    scheme: Scheme,
    matrices: EffectiveMatrices,
    newton: InterfaceNewton,
    /// Predicted x and v (with a₁ = 0), and the solved a₁.
    x: DVector<f64>,
    v: DVector<f64>,
    a: DVector<f64>,
    /// Right-hand side r of S a₁ = r + (1−α_f) Wᵀ f₁.
    right: DVector<f64>,
    /// R₀ or −R₁ without bearing forces.
    residual: DVector<f64>,
    /// Bearing forces at the start of the step, with the sign of R₀.
    minus_force: Vec<f64>,
    /// Bearing forces at the start of the previous step, and that step's length.
    previous_force: Vec<f64>,
    previous_step: f64,
    rotations: Vec<Rotation>,
    scratch: Vec<f64>,
    /// Buffers of a torque drive.
    driven: Option<DrivenStep>,
}

impl GeneralisedAlpha {
    pub fn new(system: &System, scheme: Scheme) -> Self {
        let (n, places) = (system.size(), system.interface_size());
        let zero = || DVector::zeros(n);
        Self {
            scheme,
            matrices: EffectiveMatrices::default(),
            newton: InterfaceNewton::new(system),
            x: zero(),
            v: zero(),
            a: zero(),
            right: zero(),
            residual: zero(),
            minus_force: vec![0.0; places],
            previous_force: vec![0.0; places],
            previous_step: 0.0,
            rotations: vec![Default::default(); system.interfaces.len()],
            scratch: Vec::new(),
            driven: None,
        }
    }

    /// Its parameters.
    pub fn scheme(&self) -> Scheme {
        self.scheme
    }

    /// Newton iterations so far, for the report of the run.
    pub fn iterations(&self) -> u64 {
        self.newton.iterations
    }

    /// Effective matrices inverted so far.
    pub fn inverted(&self) -> u64 {
        self.matrices.inverted
    }

    /// Advances `state` by `step`; `spin` is the shaft's motion at the end of the step, found here under a torque drive.
    ///
    /// (1−α_m) a₁ + α_m a₀ + (1−α_f) R₁ + α_f R₀ = 0 with R = (C+ΩG) v + (K+…) x − p − Wᵀ f,
    /// x₁ = x₀ + h v₀ + h² ((½−β) a₀ + β a₁), v₁ = v₀ + h ((1−γ) a₀ + γ a₁).
    ///
    /// # Errors
    /// Newton iteration that does not converge; the state is then unchanged.
    pub fn step(
        &mut self,
        system: &System,
        state: &mut State,
        step: f64,
        spin: Spin,
    ) -> Result<(), StepFailure> {
        if let Some(drive) = &system.drive {
            return self.driven_step(system, drive, state, step);
        }
        self.predict(system, state, step, &spin);
        self.assemble(system, state, step, &spin);
        self.solve(system, state, step, &spin, true)?;
        self.update(state, step, spin);
        Ok(())
    }

    /// x̄ = x₀ + h v₀ + h² (½−β) a₀ and v̄ = v₀ + h (1−γ) a₀, and the cage angles at the end of the step.
    fn predict(&mut self, system: &System, state: &State, step: f64, spin: &Spin) {
        let Scheme { beta, gamma, .. } = self.scheme;
        cage::advance(system, state, spin, &mut self.rotations);
        self.x.copy_from(&state.x);
        self.x.axpy(step, &state.v, 1.0);
        self.x.axpy(step * step * (0.5 - beta), &state.a, 1.0);
        self.v.copy_from(&state.v);
        self.v.axpy(step * (1.0 - gamma), &state.a, 1.0);
    }

    /// r = −α_f R₀ − α_m a₀ − (1−α_f) R₁(x̄, v̄), R₁ without bearing forces.
    fn assemble(&mut self, system: &System, state: &State, step: f64, spin: &Spin) {
        let Scheme { alpha_m, alpha_f, .. } = self.scheme;
        self.right.fill(0.0);
        if alpha_f != 0.0 {
            system.load(state.time, &state.spin, &mut self.residual);
            self.residual.neg_mut();
            let start = [&state.x, &state.v];
            system.add_linear(&state.spin, start, 1.0, &mut self.scratch, &mut self.residual);
            for (minus, force) in self.minus_force.iter_mut().zip(&state.force) {
                *minus = -force;
            }
            system.add_from_interface(&self.minus_force, &mut self.residual);
            self.right.axpy(-alpha_f, &self.residual, 1.0);
        }
        if alpha_m != 0.0 {
            self.right.axpy(-alpha_m, &state.a, 1.0);
        }
        system.load(state.time + step, spin, &mut self.residual);
        system.add_linear(spin, [&self.x, &self.v], -1.0, &mut self.scratch, &mut self.residual);
        self.right.axpy(1.0 - alpha_f, &self.residual, 1.0);
    }

    /// a₁ = S⁻¹ (r + (1−α_f) Wᵀ f₁), with f₁ from Newton's method on the interface rows; unless this is the `first`
    /// solution of the step, Newton starts from the forces of the last one.
    fn solve(
        &mut self,
        system: &System,
        state: &State,
        step: f64,
        spin: &Spin,
        first: bool,
    ) -> Result<(), StepFailure> {
        let Scheme { alpha_m, alpha_f, .. } = self.scheme;
        let (gain, weight) = (self.scheme.gain(step), 1.0 - alpha_f);
        let matrix = self.matrices.at(system, self.scheme, step, spin);

        let (right, on_internal) = self.right.as_slice().split_at(system.structure());
        self.a.fill(0.0);
        let (a, internal) = self.a.as_mut_slice().split_at_mut(system.structure());
        matrix.add_inverse(spin.speed, right, &mut self.scratch, a);
        for (a, right) in internal.iter_mut().zip(on_internal) {
            *a = right / (1.0 - alpha_m);
        }
        if system.interface_size() == 0 {
            return Ok(());
        }

        let newton = &mut self.newton;
        newton.set_free_motion(system, [&self.x, &self.v, &self.a], &gain);
        matrix.compliance(spin.speed, weight, &mut newton.compliance);
        if !first {
        } else if self.previous_step == step {
            newton.extrapolate_force(&state.force, &self.previous_force);
        } else {
            newton.force.copy_from_slice(&state.force);
        }
        newton.solve(system, &self.rotations, &gain)?;
        self.previous_force.copy_from_slice(&state.force);
        self.previous_step = step;

        let (force, on_internal) = newton.force.split_at(system.rows());
        let (a, internal) = self.a.as_mut_slice().split_at_mut(system.structure());
        matrix.add_response(spin.speed, weight, force, &mut self.scratch, a);
        for ((a, force), mass) in internal.iter_mut().zip(on_internal).zip(&system.internal_masses) {
            *a += gain.force * force / mass.sqrt();
        }
        Ok(())
    }

    /// x₁ = x̄ + β h² a₁, v₁ = v̄ + γ h a₁, with the bearing reactions there.
    fn update(&mut self, state: &mut State, step: f64, spin: Spin) {
        let gain = self.scheme.gain(step);
        state.x.copy_from(&self.x);
        state.x.axpy(gain.position, &self.a, 1.0);
        state.v.copy_from(&self.v);
        state.v.axpy(gain.velocity, &self.a, 1.0);
        state.a.copy_from(&self.a);
        state.time += step;
        state.spin = spin;
        state.rotations.copy_from_slice(&self.rotations);
        self.newton.store(state);
    }
}

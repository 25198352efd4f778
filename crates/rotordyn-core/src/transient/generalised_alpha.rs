//! Generalised-α and Newmark time steps, with Newton iteration on the bearing interfaces only.
//!
//! A step is predict, assemble, solve, update: [`GeneralisedAlpha::step`] reads so. The linear part changes only with
//! the speed Ω, so one inversion of the effective matrix serves many steps (`step_matrix`). The nonlinear bearings
//! act on a few interface rows, so Newton's method solves for those rows (`interface_newton`) and the other coordinates
//! follow by back-substitution. Internal coordinates of a bearing are coupled to that bearing alone, which solves
//! their equations at every Newton iteration.

mod driven_buffers;
mod driven_step;
mod force_history;
mod interface_newton;
mod kept_jacobian;
mod memory;
mod scheme;
mod step_matrix;

pub use memory::StepMemory;
use nalgebra::DVector;
pub use scheme::{Scheme, StepFailure};

use super::cage;
use super::system::{State, System};
use crate::model::Spin;
use driven_buffers::DrivenStep;
use force_history::ForceHistory;
use interface_newton::InterfaceNewton;
use rotordyn_bearing::Rotation;
use rotordyn_linalg::with_widest_vectors;
use step_matrix::StepMatrices;

/// One-step implicit integrator; owns every buffer, so that a step allocates nothing.
pub struct GeneralisedAlpha {
    scheme: Scheme,
    matrices: StepMatrices,
    newton: InterfaceNewton,
    /// Predicted x̂ and v̂ (with ẍ₁ = 0), and the solved ẍ₁.
    x: DVector<f64>,
    v: DVector<f64>,
    acceleration: DVector<f64>,
    /// v̂, x̂ of the structure and load factors, in the order of the step matrix.
    parts: Vec<f64>,
    /// Bearing forces of the last steps.
    forces: ForceHistory,
    rotations: Vec<Rotation>,
    /// Buffers of a torque drive.
    driven: Option<DrivenStep>,
}

impl GeneralisedAlpha {
    pub fn new(system: &System, scheme: Scheme) -> Self {
        let (n, places) = (system.size(), system.interface_size());
        let zero = || DVector::zeros(n);
        Self {
            scheme,
            matrices: StepMatrices::default(),
            newton: InterfaceNewton::new(system),
            x: zero(),
            v: zero(),
            acceleration: zero(),
            parts: Vec::new(),
            forces: ForceHistory::new(places),
            rotations: vec![Default::default(); system.interfaces.len()],
            driven: None,
        }
    }

    /// Ends Newton's iterations where they leave a thousandth of the first correction of a step.
    pub fn end_below_step_error(&mut self) {
        self.newton.end_below_step_error();
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
    /// (1−α_m) a₁ + α_m a₀ = (1−α_f) ẍ₁ + α_f ẍ₀ with M̂ ẍ = p + Wᵀ f − (C+ΩG) v − (K+…) x at both ends (M̂ = 1 unless the
    /// inertias are fitted to the step),
    /// x₁ = x₀ + h v₀ + h² ((½−β) a₀ + β a₁), v₁ = v₀ + h ((1−γ) a₀ + γ a₁).
    ///
    /// # Errors
    /// Newton iteration that does not converge; the state is then unchanged, but for inertias fitted to the step.
    pub fn step(
        &mut self,
        system: &System,
        state: &mut State,
        step: f64,
        spin: Spin,
    ) -> Result<(), StepFailure> {
        self.fit_inertias(system, state, step);
        if let Some(drive) = &system.drive {
            return self.driven_step(system, drive, state, step);
        }
        with_widest_vectors(
            #[inline(always)]
            || {
                self.predict(system, state, step, &spin);
                self.solve(system, state, step, &spin, true, None)?;
                self.update(state, step, spin);
                Ok(())
            },
        )
    }

    /// Fits the inertias of a state to steps of this length, if the scheme fits them, as the next step would.
    pub fn fit_inertias(&self, system: &System, state: &mut State, step: f64) {
        if !self.scheme.fitted || state.inertias.are_for(step) {
            return;
        }
        let values = system.natural_frequencies.iter().map(|f| self.scheme.inertia(*f, step)).collect();
        let State { v, a, acceleration, inertias, .. } = state;
        inertias.change(step, values, v, [a, acceleration]);
    }

    /// x̂ = x₀ + h v₀ + h² ((½−β) a₀ + β y) and v̂ = v₀ + h ((1−γ) a₀ + γ y) with a₁ = y for ẍ₁ = 0, and the cage angles at
    /// the end of the step.
    #[inline(always)]
    fn predict(&mut self, system: &System, state: &State, step: f64, spin: &Spin) {
        let Scheme { beta, gamma, .. } = self.scheme;
        let mean = self.scheme.mean();
        cage::advance(system, state, spin, &mut self.rotations);
        let by_square = step * step;
        let x_by = [by_square * (0.5 - beta + beta * mean.before), by_square * beta * mean.start];
        let v_by = [step * (1.0 - gamma + gamma * mean.before), step * gamma * mean.start];
        // Slices of one length, for vector instructions.
        let n = self.x.len();
        let [x0, v0, a0, acceleration] =
            [&state.x, &state.v, &state.a, &state.acceleration].map(|y| &y.as_slice()[..n]);
        let (x, v) = (self.x.as_mut_slice(), &mut self.v.as_mut_slice()[..n]);
        for k in 0..n {
            x[k] = x0[k] + step * v0[k] + (x_by[0] * a0[k] + x_by[1] * acceleration[k]);
            v[k] = v0[k] + (v_by[0] * a0[k] + v_by[1] * acceleration[k]);
        }
    }

    /// ẍ₁ = F (v̂, x̂, c) + R f₁ + S⁻¹ e, with f₁ from Newton's method on the interface rows and a load e of a torque drive;
    /// unless this is the `first` solution of the step, Newton starts from the forces of the last one.
    #[inline(always)]
    fn solve(
        &mut self,
        system: &System,
        state: &State,
        step: f64,
        spin: &Spin,
        first: bool,
        load: Option<&DVector<f64>>,
    ) -> Result<(), StepFailure> {
        let (n, end) = (system.structure(), state.time + step);
        let gain = self.scheme.gain(step);
        let matrix = self.matrices.at(system, self.scheme, step, end, spin);

        self.parts.clear();
        self.parts.extend_from_slice(&self.v.as_slice()[..n]);
        self.parts.extend_from_slice(&self.x.as_slice()[..n]);
        system.extend_by_load_factors(end, spin, &mut self.parts);
        self.acceleration.fill(0.0);
        let on_structure = &mut self.acceleration.as_mut_slice()[..n];
        matrix.add_free(&self.parts, on_structure);
        if let Some(load) = load {
            matrix.add_inverse(&load.as_slice()[..n], on_structure);
        }
        if system.interface_size() == 0 {
            return Ok(());
        }

        let newton = &mut self.newton;
        newton.set_free_motion(system, [&self.x, &self.v, &self.acceleration], &gain);
        if first {
            self.forces.extrapolate(&state.force, step, &mut newton.force);
        }
        newton.solve(system, &self.rotations, &gain, matrix.compliance())?;

        let (force, on_internal) = newton.force.split_at(system.rows());
        let (structure, internal) = self.acceleration.as_mut_slice().split_at_mut(n);
        matrix.add_response(force, structure);
        for ((acceleration, force), mass) in internal.iter_mut().zip(on_internal).zip(&system.internal_masses)
        {
            *acceleration = force / mass.sqrt();
        }
        Ok(())
    }

    /// x₁ = x̂ + g β h² ẍ₁, v₁ = v̂ + g γ h ẍ₁ and a₁, with the bearing reactions there.
    #[inline(always)]
    fn update(&mut self, state: &mut State, step: f64, spin: Spin) {
        let gain = self.scheme.gain(step);
        let mean = self.scheme.mean();
        self.forces.push(&state.force, step);
        let n = self.x.len();
        let [x_hat, v_hat, at_end] = [&self.x, &self.v, &self.acceleration].map(|y| &y.as_slice()[..n]);
        let State { x, v, a, acceleration, .. } = state;
        let [x, v, a, acceleration] = [x, v, a, acceleration].map(|y| &mut y.as_mut_slice()[..n]);
        for k in 0..n {
            x[k] = x_hat[k] + gain.position * at_end[k];
            v[k] = v_hat[k] + gain.velocity * at_end[k];
            a[k] = mean.end * at_end[k] + (mean.start * acceleration[k] + mean.before * a[k]);
            acceleration[k] = at_end[k];
        }
        state.time += step;
        state.spin = spin;
        state.rotations.copy_from_slice(&self.rotations);
        self.newton.store(state);
    }
}

//! Newton's method for the bearing forces at the end of a time step, on the interface rows.

use nalgebra::DVector;
use std::ops::Range;

use super::StepFailure;
use super::kept_jacobian::{Kept, KeptJacobian};
use super::step_matrix::Compliance;
use crate::transient::interface::{Interface, StepTangents};
use crate::transient::system::{Bodies, State, System};
use rotordyn_bearing::internal::NewmarkGain;
use rotordyn_bearing::{Reaction, Rotation};
use rotordyn_linalg::dot;

/// Newton stops once the error of the accelerations is below this \[m/s²\] with contact deflections of the given size
/// \[m\] or more: a change c of the displacements leaves an error of c²/(4 δ) with Hertz contacts, of c²/(4 δ b) in the
/// acceleration. In 125 us that is a change of 1.2e-10 m. The next change with the same Jacobian leaves c³/(8 δ² b).
const ACCELERATION_ERROR: f64 = 1e-5;
const DEFLECTION: f64 = 1e-7;
/// The same of an old Jacobian, which leaves a part of the change itself: that error is measured, the one above is a bound
/// which contacts under load keep far below.
const OLD_JACOBIAN_ERROR: f64 = 1e-6;
/// In a run-up it may also be this part of the first change, of what the forces extrapolated from the last steps miss. On the rig
/// half the step changes the accelerations by some hundred times what that leaves.
const PART_OF_FIRST_CHANGE: f64 = 1e-3;
/// The Jacobian is formed again where an iteration leaves more than this part of the last change.
const LARGEST_CONTRACTION: f64 = 0.02;
const MAX_ITERATIONS: usize = 25;

/// The interface problem d = d̄ + b u, ḋ = ḋ̄ + c u, u = Y f(d, ḋ) with Y = W S⁻¹ Wᵀ and the step's gains b and c, and
/// its buffers.
///
/// Displacements, velocities and forces hold the interface rows, then one entry per internal coordinate.
pub(super) struct InterfaceNewton {
    /// Displacement d̄ and velocity ḋ̄ at the end of the step without bearing forces in it.
    free_d: Vec<f64>,
    free_d_rate: Vec<f64>,
    /// Coordinates of that motion.
    free: DVector<f64>,
    /// Acceleration u of the rows by the bearing forces, the residual u − Y f, and the correction.
    acceleration: Vec<f64>,
    residual: Vec<f64>,
    correction: Vec<f64>,
    jacobian: KeptJacobian,
    /// Whether it serves later steps: iterations with forces alone must cost less than new tangents.
    keeps_jacobian: bool,
    /// Part of the first change that may remain, and part of the last change that an iteration with an old Jacobian may leave.
    part_of_first_change: f64,
    largest_contraction: f64,
    /// Rows of every interface.
    blocks: Vec<Range<usize>>,
    d: Vec<f64>,
    d_rate: Vec<f64>,
    /// Bearing forces: the initial guess, then the solution.
    pub force: Vec<f64>,
    reactions: Vec<Reaction>,
    /// Of bearings with internal coordinates.
    tangents: StepTangents,
    /// Newton iterations so far.
    pub iterations: u64,
}

impl InterfaceNewton {
    pub fn new(system: &System) -> Self {
        let (rows, places) = (system.rows(), system.interface_size());
        Self {
            free_d: vec![0.0; places],
            free_d_rate: vec![0.0; places],
            free: DVector::zeros(system.size()),
            acceleration: vec![0.0; rows],
            residual: vec![0.0; rows],
            correction: vec![0.0; rows],
            jacobian: KeptJacobian::new(rows),
            keeps_jacobian: system.interfaces.iter().all(|i| i.internal == 0 && i.element.has_cheap_force()),
            part_of_first_change: 0.0,
            largest_contraction: LARGEST_CONTRACTION,
            blocks: system.interfaces.iter().map(Interface::row_range).collect(),
            d: vec![0.0; places],
            d_rate: vec![0.0; places],
            force: vec![0.0; places],
            reactions: vec![Reaction::default(); system.interfaces.len()],
            tangents: StepTangents::new(&system.interfaces),
            iterations: 0,
        }
    }

    /// d̄ = W (x̂ + b a) and ḋ̄ = W (v̂ + c a) with the acceleration a without bearing forces.
    #[inline(always)]
    pub fn set_free_motion(&mut self, system: &System, [x, v, a]: [&DVector<f64>; 3], gain: &NewmarkGain) {
        let n = self.free.len();
        for (start, gain, out) in
            [(x, gain.position, &mut self.free_d), (v, gain.velocity, &mut self.free_d_rate)]
        {
            let [start, a] = [start, a].map(|y| &y.as_slice()[..n]);
            let free = &mut self.free.as_mut_slice()[..n];
            for k in 0..n {
                free[k] = start[k] + gain * a[k];
            }
            system.to_interface(&self.free, out);
        }
    }

    /// Ends where the error is far below that of the step.
    pub fn end_below_step_error(&mut self) {
        self.part_of_first_change = PART_OF_FIRST_CHANGE;
        // Two iterations then leave that part.
        self.largest_contraction = PART_OF_FIRST_CHANGE.sqrt();
    }

    /// What the next step takes from the Jacobian of this one.
    pub fn memory(&self) -> Kept {
        self.jacobian.memory()
    }

    /// Takes what earlier steps left.
    pub fn restore(&mut self, jacobian: &Kept, iterations: u64) {
        self.jacobian = KeptJacobian::after(jacobian, self.acceleration.len(), &self.blocks);
        self.iterations = iterations;
    }

    /// Solves for the bearing forces from the guess in `force`; `compliance`: Y.
    ///
    /// Starts with the Jacobian of an earlier step where that costs less: the tangents of a step are mostly those of the last one.
    ///
    /// # Errors
    /// No convergence within the largest number of iterations, a singular Jacobian, or NaN.
    #[inline(always)]
    pub fn solve(
        &mut self,
        system: &System,
        rotations: &[Rotation],
        gain: &NewmarkGain,
        compliance: &Compliance,
    ) -> Result<(), StepFailure> {
        compliance.times(&self.force[..system.rows()], &mut self.acceleration);
        let b = gain.position;
        let largest_kept = (8.0 * DEFLECTION.powi(2) * ACCELERATION_ERROR * b).cbrt();
        let has_internal = self.d.len() > system.rows();
        let mut keeps_jacobian = self.jacobian.is_for(gain);
        let mut change_before = None;
        let mut allowed = OLD_JACOBIAN_ERROR * b;
        let mut failure = StepFailure { row: 0, residual: f64::INFINITY, iterations: 0 };
        for iteration in 1..=MAX_ITERATIONS {
            self.iterations += 1;
            if keeps_jacobian {
                self.evaluate_forces(system, rotations, gain);
                self.find_residual(compliance);
            } else {
                self.evaluate(system, rotations, gain);
                self.find_residual(compliance);
                self.set_tangent(system, gain);
                if !self.jacobian.factor(gain, &compliance.rows, &self.blocks, self.keeps_jacobian) {
                    return Err(failure);
                }
                change_before = None;
            }
            self.jacobian.solve(&self.residual, &mut self.correction);
            let (row, change) = self.correct(gain);
            failure = StepFailure { row, residual: change, iterations: iteration };
            let is_old = self.jacobian.is_old();
            let serves = match change_before {
                Some(before) if is_old => {
                    self.jacobian.observe(change, before);
                    change <= self.largest_contraction * before
                }
                _ => is_old || change <= largest_kept,
            };
            let of_second_order = change * change / (4.0 * DEFLECTION) / (ACCELERATION_ERROR * b);
            if iteration == 1 {
                allowed = allowed.max(self.part_of_first_change * change);
            }
            let of_old_jacobian = self.jacobian.contraction() * change / allowed;
            if of_second_order + of_old_jacobian <= 1.0 {
                self.apply_last_correction(system, gain);
                self.jacobian.solved();
                return Ok(());
            }
            if !change.is_finite() {
                return Err(failure);
            }
            keeps_jacobian = !has_internal && serves;
            change_before = Some(change);
        }
        Err(failure)
    }

    /// Bearing reactions at the present u; internal coordinates are solved inside.
    #[inline(always)]
    fn evaluate(&mut self, system: &System, rotations: &[Rotation], gain: &NewmarkGain) {
        let rows = system.rows();
        self.set_row_motion(gain);
        self.d[rows..].copy_from_slice(&self.free_d[rows..]);
        self.d_rate[rows..].copy_from_slice(&self.free_d_rate[rows..]);
        system.bearing_reactions_in_step(
            [&mut self.d, &mut self.d_rate],
            rotations,
            gain,
            &mut self.reactions,
            &mut self.force,
            &mut self.tangents,
        );
    }

    /// Bearing forces at the present u, without tangents.
    #[inline(always)]
    fn evaluate_forces(&mut self, system: &System, rotations: &[Rotation], gain: &NewmarkGain) {
        self.set_row_motion(gain);
        let none = Bodies { states: &[], rates: &mut [] };
        system.bearing_forces(&self.d, &self.d_rate, rotations, none, &mut self.reactions, &mut self.force);
    }

    /// u − Y f.
    #[inline(always)]
    fn find_residual(&mut self, compliance: &Compliance) {
        compliance.times(&self.force[..self.residual.len()], &mut self.residual);
        for (residual, u) in self.residual.iter_mut().zip(&self.acceleration) {
            *residual = u - *residual;
        }
    }

    /// b K + c C, block by block.
    #[inline(always)]
    fn set_tangent(&mut self, system: &System, gain: &NewmarkGain) {
        for (interface, reaction) in system.interfaces.iter().zip(&self.reactions) {
            let (own, count) = (interface.row_range(), interface.rows);
            let effective = &self.tangents.stiffness[interface.stiffness_range()];
            for b in 0..count {
                let line = &mut self.jacobian.tangent.row_mut(own.start + b)[own.clone()];
                if effective.is_empty() {
                    let (k, c) = (&reaction.stiffness[b], &reaction.damping[b]);
                    for (entry, (k, c)) in line.iter_mut().zip(k.iter().zip(c)) {
                        *entry = gain.position * k + gain.velocity * c;
                    }
                } else {
                    for (entry, k) in line.iter_mut().zip(&effective[b * count..]) {
                        *entry = gain.position * k;
                    }
                }
            }
        }
    }

    /// u ← u − Δ; the row with the largest change of displacement, and that change.
    #[inline(always)]
    fn correct(&mut self, gain: &NewmarkGain) -> (usize, f64) {
        let (mut largest, mut row) = (0.0, 0);
        for (r, correction) in self.correction.iter().enumerate() {
            self.acceleration[r] -= correction;
            let change = gain.position * correction.abs();
            if change > largest || change.is_nan() {
                (largest, row) = (change, r);
            }
        }
        (row, largest)
    }

    /// Applies Newton's last correction to forces and displacements too, so that force and state agree:
    /// f ← f + (b K + c C) Δ.
    #[inline(always)]
    fn apply_last_correction(&mut self, system: &System, gain: &NewmarkGain) {
        let rows = system.rows();
        let (on_rows, on_internal) = self.force.split_at_mut(rows);
        for (interface, reaction) in system.interfaces.iter().zip(&mut self.reactions) {
            let correction = &self.correction[interface.row_range()];
            let on_rows = &mut on_rows[interface.row_range()];
            for (row, force) in interface.row_range().zip(&mut *on_rows) {
                *force += dot(&self.jacobian.tangent.row(row)[interface.row_range()], correction);
            }
            for (force, on_row) in reaction.force.iter_mut().zip(on_rows) {
                *force = *on_row;
            }
            if interface.internal == 0 {
                continue;
            }
            let tangents =
                self.tangents.internal_force[interface.tangent_range()].chunks_exact(interface.rows);
            for (k, tangent) in interface.internal_range().zip(tangents) {
                let change: f64 = tangent.iter().zip(correction).map(|(k, by)| k * by).sum();
                on_internal[k] += gain.position * change;
                let acceleration = on_internal[k] / system.internal_masses[k];
                self.d[rows + k] = self.free_d[rows + k] + gain.position * acceleration;
                self.d_rate[rows + k] = self.free_d_rate[rows + k] + gain.velocity * acceleration;
            }
        }
        self.set_row_motion(gain);
    }

    /// d = d̄ + b u and ḋ = ḋ̄ + c u of the rows.
    #[inline(always)]
    fn set_row_motion(&mut self, gain: &NewmarkGain) {
        for (r, u) in self.acceleration.iter().enumerate() {
            self.d[r] = self.free_d[r] + gain.position * u;
            self.d_rate[r] = self.free_d_rate[r] + gain.velocity * u;
        }
    }

    /// Bearing reactions of the solution.
    pub fn reactions(&self) -> &[Reaction] {
        &self.reactions
    }

    /// Writes the solution to a state.
    #[inline(always)]
    pub fn store(&mut self, state: &mut State) {
        // The next step evaluates all of them again.
        std::mem::swap(&mut state.reactions, &mut self.reactions);
        state.d.copy_from_slice(&self.d);
        state.d_rate.copy_from_slice(&self.d_rate);
        state.force.copy_from_slice(&self.force);
    }
}

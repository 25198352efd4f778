//! Newton's method for the bearing forces at the end of a time step, on the interface rows.

use nalgebra::DVector;

use super::StepFailure;
use crate::transient::interface::StepTangents;
use crate::transient::system::{State, System};
use rotordyn_bearing::internal::NewmarkGain;
use rotordyn_bearing::{Reaction, Rotation};
use rotordyn_linalg::small_dense::solve_in_place;

/// Newton stops when no interface displacement changed by more than this \[m, rad\] in an iteration; with quadratic
/// convergence on contact deflections of 1e-7 m and more, the error is then below 1e-15 m.
const TOLERANCE: f64 = 1e-11;
const MAX_ITERATIONS: usize = 25;

/// The interface problem d = d̄ + b u, ḋ = ḋ̄ + c u, u = Y f(d, ḋ) with Y = W S⁻¹ Wᵀ and the step's gains b and c, and
/// its buffers.
///
/// Displacements, velocities and forces hold the interface rows, then one entry per internal coordinate.
pub(super) struct InterfaceNewton {
    /// Displacement d̄ and velocity ḋ̄ at the end of the step without bearing forces in it.
    free_d: Vec<f64>,
    free_d_rate: Vec<f64>,
    free_acceleration: Vec<f64>,
    /// Acceleration u of the rows by the bearing forces, and the residual u − Y f, then the correction.
    acceleration: Vec<f64>,
    correction: Vec<f64>,
    jacobian: Vec<f64>,
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
            free_acceleration: vec![0.0; places],
            acceleration: vec![0.0; rows],
            correction: vec![0.0; rows],
            jacobian: vec![0.0; rows * rows],
            d: vec![0.0; places],
            d_rate: vec![0.0; places],
            force: vec![0.0; places],
            reactions: vec![Reaction::default(); system.interfaces.len()],
            tangents: StepTangents::new(&system.interfaces),
            iterations: 0,
        }
    }

    /// d̄ = W (x̂ + b a) and ḋ̄ = W (v̂ + c a) with the acceleration a without bearing forces.
    pub fn set_free_motion(&mut self, system: &System, [x, v, a]: [&DVector<f64>; 3], gain: &NewmarkGain) {
        system.to_interface(x, &mut self.free_d);
        system.to_interface(v, &mut self.free_d_rate);
        system.to_interface(a, &mut self.free_acceleration);
        for (r, acceleration) in self.free_acceleration.iter().enumerate() {
            self.free_d[r] += gain.position * acceleration;
            self.free_d_rate[r] += gain.velocity * acceleration;
        }
    }

    /// Initial guess of the force, extrapolated linearly from the last two states: about a hundred times closer than
    /// the last state's force.
    pub fn extrapolate_force(&mut self, last: &[f64], before: &[f64]) {
        for ((force, last), before) in self.force.iter_mut().zip(last).zip(before) {
            *force = 2.0 * last - before;
        }
    }

    /// Solves for the bearing forces from the guess in `force`; `compliance`: Y, row-major.
    ///
    /// # Errors
    /// No convergence within the largest number of iterations, a singular Jacobian, or NaN.
    pub fn solve(
        &mut self,
        system: &System,
        rotations: &[Rotation],
        gain: &NewmarkGain,
        compliance: &[f64],
    ) -> Result<(), StepFailure> {
        for (u, y) in self.acceleration.iter_mut().zip(compliance.chunks_exact(system.rows())) {
            *u = y.iter().zip(&self.force).map(|(y, f)| y * f).sum::<f64>();
        }
        let mut failure = StepFailure { row: 0, residual: f64::INFINITY, iterations: 0 };
        for iteration in 1..=MAX_ITERATIONS {
            self.iterations += 1;
            self.evaluate(system, rotations, gain);
            self.linearise(system, gain, compliance);
            if !solve_in_place(&mut self.jacobian, &mut self.correction) {
                return Err(failure);
            }
            let (row, largest) = self.correct(gain);
            failure = StepFailure { row, residual: largest, iterations: iteration };
            if largest <= TOLERANCE {
                self.apply_last_correction(system, gain);
                return Ok(());
            }
            if !largest.is_finite() {
                return Err(failure);
            }
        }
        Err(failure)
    }

    /// Bearing reactions at the present u; internal coordinates are solved inside.
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

    /// Residual u − Y f and Jacobian I + Y (b K + c C), with the tangents block by block.
    fn linearise(&mut self, system: &System, gain: &NewmarkGain, compliance: &[f64]) {
        let rows = system.rows();
        for r in 0..rows {
            let y = &compliance[r * rows..(r + 1) * rows];
            self.correction[r] =
                self.acceleration[r] - y.iter().zip(&self.force).map(|(y, f)| y * f).sum::<f64>();
            let line = &mut self.jacobian[r * rows..(r + 1) * rows];
            line.fill(0.0);
            for (interface, reaction) in system.interfaces.iter().zip(&self.reactions) {
                let (first, count) = (interface.first_row, interface.rows);
                let effective = &self.tangents.stiffness[interface.stiffness_range()];
                for (b, k) in effective.chunks_exact(count).enumerate() {
                    let yd = gain.position * y[first + b];
                    for (column, k) in k.iter().enumerate() {
                        line[first + column] += yd * k;
                    }
                }
                if !effective.is_empty() {
                    continue;
                }
                for b in 0..count {
                    let (yd, yv) = (gain.position * y[first + b], gain.velocity * y[first + b]);
                    let (k, c) = (&reaction.stiffness[b], &reaction.damping[b]);
                    for column in 0..count {
                        line[first + column] += yd * k[column] + yv * c[column];
                    }
                }
            }
            line[r] += 1.0;
        }
    }

    /// u ← u − Δ; the row with the largest change of displacement, and that change.
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
    fn apply_last_correction(&mut self, system: &System, gain: &NewmarkGain) {
        let rows = system.rows();
        let (on_rows, on_internal) = self.force.split_at_mut(rows);
        for (interface, reaction) in system.interfaces.iter().zip(&mut self.reactions) {
            let correction = &self.correction[interface.row_range()];
            let on_rows = &mut on_rows[interface.row_range()];
            if interface.internal == 0 {
                for (b, force) in reaction.force.iter_mut().enumerate().take(interface.rows) {
                    for (column, by) in correction.iter().enumerate() {
                        let (k, c) = (reaction.stiffness[b][column], reaction.damping[b][column]);
                        *force += (gain.position * k + gain.velocity * c) * by;
                    }
                }
                on_rows.copy_from_slice(&reaction.force[..interface.rows]);
                continue;
            }
            let effective = self.tangents.stiffness[interface.stiffness_range()].chunks_exact(interface.rows);
            for (force, k) in on_rows.iter_mut().zip(effective) {
                for (k, by) in k.iter().zip(correction) {
                    *force += gain.position * k * by;
                }
            }
            for (force, on_row) in reaction.force.iter_mut().zip(on_rows) {
                *force = *on_row;
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
    pub fn store(&self, state: &mut State) {
        state.reactions.copy_from_slice(&self.reactions);
        state.d.copy_from_slice(&self.d);
        state.d_rate.copy_from_slice(&self.d_rate);
        state.force.copy_from_slice(&self.force);
    }
}

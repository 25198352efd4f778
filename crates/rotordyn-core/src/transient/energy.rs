//! Energy balance of a run, step by step.
//!
//! Under a torque drive the rotation is an unknown: its kinetic energy belongs to the stored energy, and what unbalance,
//! gyroscopic terms, internal damping and cages exchange with it stays inside the machine.

use nalgebra::DVector;
use serde::{Deserialize, Serialize};

use super::interface::Interface;
use super::numbers::vector;
use super::system::{State, System};
use super::torque::DriveEnergy;
use crate::model::Spin;
use rotordyn_bearing::{Reaction, Rotation};
use rotordyn_linalg::dot::dot_in_sixteens;
use rotordyn_linalg::with_widest_vectors;

/// Energy balance \[J\]: kinetic + strain + contact = start + work + drive + parametric − losses + residual.
#[derive(Clone, Copy, Debug, PartialEq, Default, Serialize, Deserialize)]
pub struct Energy {
    /// ½ ẋᵀ M̂ ẋ (mass-normalised coordinates; M̂ = 1 unless fitted to the step) and of free bodies; under a torque drive
    /// with the energy of the rotation.
    pub kinetic: f64,
    /// ½ xᵀ K x of the linear parts.
    pub strain: f64,
    /// Elastic energy in the bearings.
    pub contact: f64,
    /// Work of loads and of unsymmetric bushings since the start, and with a prescribed speed of unbalance, angular
    /// acceleration and circulatory terms.
    pub work: f64,
    /// Work of a torque drive since the start.
    pub drive: f64,
    /// Work on the bearings by cage rotation, raceway waviness and speed change (parametric excitation), and by
    /// cross-coupled stiffness, since the start; on free bodies by the shaft's prescribed rotation and by gravity.
    pub parametric: f64,
    /// Energy dissipated by linear damping since the start.
    pub damping_loss: f64,
    /// Energy dissipated in bearing contacts since the start.
    pub contact_loss: f64,
    /// Stored energy at the start.
    pub start: f64,
}

impl Energy {
    /// Stored energy, not negative: kinetic + strain + contact, zero at rest and undeformed \[J\].
    pub fn stored(&self) -> f64 {
        self.kinetic + self.strain + self.contact
    }

    /// Residual of the energy balance \[J\].
    pub fn residual(&self) -> f64 {
        self.stored() - self.start - self.work - self.drive - self.parametric
            + self.damping_loss
            + self.contact_loss
    }

    /// Reference for the residual \[J\]: losses plus change of stored energy.
    pub fn exchanged(&self) -> f64 {
        self.damping_loss + self.contact_loss + (self.stored() - self.start).abs()
    }
}

/// Updates the energy balance step by step; allocation-free after construction.
///
/// Saved and loaded, it goes on with the same bits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EnergyBalance {
    pub energy: Energy,
    /// Factors of the working loads at the last state, and at the present one.
    factors: [Vec<f64>; 2],
    #[serde(with = "vector")]
    linear: DVector<f64>,
    scratch: Vec<f64>,
    #[serde(with = "vector")]
    moved: DVector<f64>,
    #[serde(with = "vector")]
    x: DVector<f64>,
    #[serde(with = "vector")]
    v: DVector<f64>,
    /// Parametric and contact-loss power at the last state.
    powers: [f64; 2],
    /// Displacements and velocities of the interfaces there.
    d: Vec<f64>,
    d_rate: Vec<f64>,
    /// Work of free bodies at the last state: given, lost \[J\].
    body_work: [f64; 2],
    rotations: Vec<Rotation>,
    rotation: Option<DriveEnergy>,
    spin: Spin,
    time: f64,
}

impl EnergyBalance {
    pub fn new(system: &System, state: &State) -> Self {
        let zero = || DVector::zeros(system.size());
        let mut balance = Self {
            energy: Energy::default(),
            factors: [factors(system, state).collect(), Vec::new()],
            linear: zero(),
            scratch: Vec::new(),
            moved: zero(),
            x: state.x.clone(),
            v: state.v.clone(),
            powers: powers(system, state),
            d: state.d.clone(),
            d_rate: state.d_rate.clone(),
            body_work: system.body_work(state),
            rotations: state.rotations.clone(),
            rotation: system.drive.as_ref().map(|drive| DriveEnergy::new(drive, system, state)),
            spin: state.spin,
            time: state.time,
        };
        balance.update_stored_energy(system, state);
        balance.energy.start = balance.energy.stored();
        balance
    }

    /// Whether it is one of a system of this size.
    pub(super) fn fits(&self, system: &System) -> bool {
        let vectors = [&self.linear, &self.moved, &self.x, &self.v];
        vectors.iter().all(|vector| vector.len() == system.size())
            && self.factors[0].len() == system.working_terms(0.0, &self.spin).count()
            && self.rotations.len() == system.interfaces.len()
            && self.rotation.is_some() == system.drive.is_some()
    }

    /// Adds one step: work of the mean load along the step's displacement, that of the forces of linear bearings too, and powers
    /// in other bearings by the trapezoidal rule.
    pub fn update(&mut self, system: &System, state: &State) {
        with_widest_vectors(
            #[inline(always)]
            || self.add_step(system, state),
        );
    }

    #[inline(always)]
    fn add_step(&mut self, system: &System, state: &State) {
        let step = state.time - self.time;
        // Slices of one length, for vector instructions.
        let size = state.x.len();
        let [x0, x1, v1] = [&self.x, &state.x, &state.v].map(|y| &y.as_slice()[..size]);
        let [moved, v] = [&mut self.moved, &mut self.v].map(|y| &mut y.as_mut_slice()[..size]);
        for k in 0..size {
            moved[k] = x1[k] - x0[k];
            v[k] = 0.5 * (v[k] + v1[k]);
        }
        if let (Some(drive), Some(rotation)) = (&system.drive, &mut self.rotation) {
            self.moved.axpy(rotation.turned(state), &drive.rigid_rotation, 1.0);
            let done = rotation.step(drive, system, state, &self.moved, step);
            self.energy.drive += done.drive;
            self.energy.work += done.gravity;
            self.energy.damping_loss += done.loss;
        }
        self.energy.work += self.work_of_loads(system, state) + self.work_of_rotation(system, state);
        self.energy.work += self.work_of_cross_coupling(system, state);
        // C (v₀ + v₁)/2 along the path.
        let n = system.structure();
        let damping = &mut self.linear.as_mut_slice()[..n];
        damping.fill(0.0);
        system.panels.damping.mul_add(&self.v.as_slice()[..n], damping);
        let lost = dot_in_sixteens(damping, &self.moved.as_slice()[..n]);
        let at_defects = self.jumps_at_defects(system, state);
        let in_linear_bearings = self.work_in_linear_bearings(system, state);
        let e = &mut self.energy;
        e.damping_loss += lost;
        e.parametric += in_linear_bearings[0];
        e.contact_loss += in_linear_bearings[1];
        let now = powers(system, state);
        e.parametric += 0.5 * step * (self.powers[0] + now[0]);
        e.parametric += energy_by_speed_change(system, state, &self.rotations);
        e.contact_loss += 0.5 * step * (self.powers[1] + now[1]);
        e.parametric += step * at_defects[0];
        e.contact_loss += step * at_defects[1];
        self.powers = now;
        self.d.copy_from_slice(&state.d);
        self.d_rate.copy_from_slice(&state.d_rate);
        let body_work = system.body_work(state);
        e.parametric += body_work[0] - self.body_work[0];
        e.contact_loss += body_work[1] - self.body_work[1];
        self.body_work = body_work;
        self.rotations.copy_from_slice(&state.rotations);
        self.x.copy_from(&state.x);
        self.v.copy_from(&state.v);
        self.spin = state.spin;
        self.time = state.time;
    }

    /// Parametric and dissipated energy of a step in linear bearings, at its mean displacement and velocity.
    ///
    /// With circular frequency ω and step h the mean load works by sin(ωh)/(ωh) of the exact work, trapezoids of powers are exact:
    /// where most is dissipated in bearings, sums of both kinds do not balance.
    fn work_in_linear_bearings(&self, system: &System, state: &State) -> [f64; 2] {
        let step = state.time - self.time;
        let mut sums = [0.0; 2];
        let mut reaction = Reaction::default();
        for (interface, (from, to)) in
            system.interfaces.iter().zip(self.rotations.iter().zip(&state.rotations))
        {
            if !is_summed_by_means(system, interface) || step <= 0.0 {
                continue;
            }
            let [d0, v0] = interface.motion(&self.d, &self.d_rate, from);
            let [d1, v1] = interface.motion(&state.d, &state.d_rate, to);
            let d = std::array::from_fn(|k| 0.5 * (d0[k] + d1[k]));
            // Between the mean velocity and the step's displacement over its length.
            let v = std::array::from_fn(|k| 0.25 * (v0[k] + v1[k]) + 0.5 * (d1[k] - d0[k]) / step);
            interface.element.force(&d, &v, &from.towards(to, 0.5), &mut reaction);
            sums[0] += step * reaction.parametric_power;
            sums[1] += step * reaction.dissipated_power;
        }
        sums
    }

    /// What the trapezoidal rule leaves out of the mean powers of a step where they jump, at the edges of local defects: with a
    /// jump J at the part s of the step (½ − s) J. Not for bearings with internal coordinates, nor under a torque drive.
    fn jumps_at_defects(&self, system: &System, state: &State) -> [f64; 2] {
        /// Distance of the states on both sides of an edge from it, as part of the step.
        const APART: f64 = 1e-6;
        let mut sums = [0.0; 2];
        if system.drive.is_some() {
            return sums;
        }
        let between = |a: &[f64], b: &[f64], part: f64| -> Vec<f64> {
            a.iter().zip(b).map(|(a, b)| a + part * (b - a)).collect()
        };
        let mut reaction = Reaction::default();
        for (interface, (from, to)) in
            system.interfaces.iter().zip(self.rotations.iter().zip(&state.rotations))
        {
            if !interface.has_no_inertia() {
                continue;
            }
            interface.element.each_defect_edge(from, to, &mut |part| {
                let d = between(&self.d, &state.d, part);
                let d_rate = between(&self.d_rate, &state.d_rate, part);
                for (side, sign) in [(part - APART, -1.0), (part + APART, 1.0)] {
                    let rotation = from.towards(to, side);
                    let [at, rate] = interface.motion(&d, &d_rate, &rotation);
                    interface.element.force(&at, &rate, &rotation, &mut reaction);
                    sums[0] += sign * (0.5 - part) * reaction.parametric_power;
                    sums[1] += sign * (0.5 - part) * reaction.dissipated_power;
                }
            });
        }
        sums
    }

    /// Work of the mean loads of the step.
    #[inline(always)]
    fn work_of_loads(&mut self, system: &System, state: &State) -> f64 {
        let [before, now] = &mut self.factors;
        now.clear();
        let mut sum = 0.0;
        for ((factor, vector), before) in system.working_terms(state.time, &state.spin).zip(&*before) {
            now.push(factor);
            let twice = before + factor;
            if twice != 0.0 {
                sum += 0.5 * twice * dot_in_sixteens(vector.as_slice(), self.moved.as_slice());
            }
        }
        self.factors.swap(0, 1);
        sum
    }

    /// Work of the mean of −(Ω̇ K_s + Ω K_c) x, the left-hand terms that are neither elastic nor damping; under a torque
    /// drive it stays inside the machine.
    #[inline(always)]
    fn work_of_rotation(&mut self, system: &System, state: &State) -> f64 {
        let panels = &system.panels;
        let with_spin_up = panels.has_spin_up();
        let is_zero = self.spin.acceleration == 0.0 && state.spin.acceleration == 0.0;
        if system.drive.is_some() || !panels.has_circulatory() && (is_zero || !with_spin_up) {
            return 0.0;
        }
        let n = system.structure();
        let (x0, x1) = (&self.x.as_slice()[..n], &state.x.as_slice()[..n]);
        self.scratch.clear();
        let mut add = |at: f64, to: f64| {
            self.scratch.extend(x0.iter().zip(x1).map(|(x0, x1)| -0.5 * (at * x0 + to * x1)));
        };
        if with_spin_up {
            add(self.spin.acceleration, state.spin.acceleration);
        }
        if panels.has_circulatory() {
            add(self.spin.speed, state.spin.speed);
        }
        let load = &mut self.linear.as_mut_slice()[..n];
        load.fill(0.0);
        panels.effective.mul_add(&self.scratch, load);
        dot_in_sixteens(load, &self.moved.as_slice()[..n])
    }

    /// Work of the mean of −½ (K − Kᵀ) x, which is not stored.
    fn work_of_cross_coupling(&self, system: &System, state: &State) -> f64 {
        let Some(matrix) = &system.cross_coupling else { return 0.0 };
        let n = system.structure();
        let mean = 0.5 * (self.x.rows(0, n) + state.x.rows(0, n));
        -self.moved.rows(0, n).dot(&(matrix * mean))
    }

    /// Continues from a state whose coordinates were changed between steps (recentring of a torque drive).
    pub fn restart_from(&mut self, system: &System, state: &State) {
        self.factors[0].clear();
        self.factors[0].extend(factors(system, state));
        self.x.copy_from(&state.x);
        self.v.copy_from(&state.v);
        self.spin = state.spin;
        self.rotation = system.drive.as_ref().map(|drive| DriveEnergy::new(drive, system, state));
    }

    /// Updates the stored energies (kinetic, strain, contact); needed before reading [`Self::energy`] only.
    pub fn update_stored_energy(&mut self, system: &System, state: &State) {
        let e = &mut self.energy;
        e.kinetic = state.inertias.kinetic_energy(&state.v);
        if let Some(drive) = &system.drive {
            e.kinetic += drive.kinetic_energy(system, state);
        }
        e.kinetic += system.body_energy(state);
        let x = &state.x.as_slice()[..system.structure()];
        let pull = &mut self.linear.as_mut_slice()[..system.structure()];
        pull.fill(0.0);
        system.panels.stiffness.mul_add(x, pull);
        e.strain = 0.5 * dot_in_sixteens(pull, x);
        e.contact = state.reactions.iter().map(|r| r.elastic_energy).sum();
    }
}

/// Whether the work in a bearing is summed by means of steps, not by powers.
fn is_summed_by_means(system: &System, interface: &Interface) -> bool {
    system.drive.is_none() && interface.element.is_linear() && interface.has_no_inertia()
}

/// Parametric and dissipated power of the bearings whose work is summed by powers.
fn powers(system: &System, state: &State) -> [f64; 2] {
    let others = || {
        let bearings = system.interfaces.iter().zip(&state.reactions);
        bearings.filter(|(interface, _)| !is_summed_by_means(system, interface)).map(|(_, reaction)| reaction)
    };
    let sum = |pick: fn(&Reaction) -> f64| others().map(pick).sum();
    let parametric = match &system.drive {
        None => sum(|r| r.parametric_power),
        Some(drive) => drive.remaining_parametric_power(system, state),
    };
    [parametric, sum(|r| r.dissipated_power)]
}

/// Change of the bearings' energy by the change of speed alone since `before` \[J\]: film, ball inertia,
/// preload and clearance depend on speed. (The stored energy of bearings with internal coordinates does not.)
fn energy_by_speed_change(system: &System, state: &State, before: &[Rotation]) -> f64 {
    let mut sum = 0.0;
    for ((interface, reaction), (now, before)) in
        system.interfaces.iter().zip(&state.reactions).zip(state.rotations.iter().zip(before))
    {
        let before = Rotation { cage_speed: before.cage_speed, shaft_speed: before.shaft_speed, ..*now };
        if before != *now && interface.has_no_inertia() && interface.element.depends_on_speed() {
            let [d, rate] = interface.motion(&state.d, &state.d_rate, &before);
            let slower = interface.element.reaction(&d, &rate, &before);
            sum += reaction.elastic_energy - slower.elastic_energy;
        }
    }
    sum
}

/// Factors of the loads that do work.
fn factors(system: &System, state: &State) -> impl Iterator<Item = f64> {
    system.working_terms(state.time, &state.spin).map(|(factor, _)| factor)
}

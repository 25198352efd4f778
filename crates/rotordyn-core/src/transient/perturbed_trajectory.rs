//! A perturbed trajectory alongside the reference run, for the largest Lyapunov exponent (Benettin).

use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

use super::interface::Interface;
use super::numbers::matrix;
use super::stepper::{Stepper, StepperMemory};
use super::system::{Bodies, State, System};
use crate::assembly::PhysicsError;
use crate::model::study::Integrator;
use rotordyn_bearing::Rotation;

/// A perturbed trajectory: a copy of a run with the same steps and the same shaft and cage angles.
///
/// Displacements and velocities are perturbed; shaft and cages rotate as in the reference run, as part of the
/// excitation. (A perturbed cage angle would give every motion of a perfect bearing a zero exponent, that of
/// a time shift.) So does the free rotation of a shaft that no station drives: a perturbed speed would let the angle grow
/// without end and without instability. The norm is twice the energy, |δ|² = δẋᵀ δẋ + δxᵀ (K + Wᵀ K_b W + ε) δx, with the bearing
/// stiffness K_b at the start and ε = 1 s⁻² for rigid-body modes: constant for an undamped vibration.
pub struct PerturbedTrajectory {
    state: State,
    stepper: Stepper,
    stiffness: DMatrix<f64>,
    /// Norm to which the perturbation is renormalised.
    size: f64,
    /// Free rotation of the shaft, of length 1, if nothing holds it.
    free_rotation: Option<DVector<f64>>,
    /// Cage states of the reference run before the step, and the mean cos α that sets their speed.
    cages: Vec<(Rotation, f64)>,
    dx: DVector<f64>,
    dv: DVector<f64>,
}

/// A perturbed trajectory between two steps, complete.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PerturbedSnapshot {
    state: State,
    stepper: StepperMemory,
    #[serde(with = "matrix")]
    stiffness: DMatrix<f64>,
    size: f64,
    cages: Vec<(Rotation, f64)>,
}

impl PerturbedSnapshot {
    /// Whether it is one of this integrator and of a system of this size.
    pub fn fits(&self, system: &System, integrator: Integrator) -> bool {
        self.state.fits(system)
            && self.stepper.fits(system, integrator)
            && self.stiffness.shape() == (system.size(), system.size())
            && self.cages.len() == system.interfaces.len()
    }
}

impl PerturbedTrajectory {
    /// The trajectory as it is after a step.
    pub fn snapshot(&self) -> PerturbedSnapshot {
        PerturbedSnapshot {
            state: self.state.clone(),
            stepper: self.stepper.memory(),
            stiffness: self.stiffness.clone(),
            size: self.size,
            cages: self.cages.clone(),
        }
    }

    /// The trajectory of a snapshot, which fits system and integrator; it goes on in the same bits.
    pub fn after(system: &System, integrator: Integrator, snapshot: PerturbedSnapshot) -> Self {
        let PerturbedSnapshot { state, stepper, stiffness, size, cages } = snapshot;
        let zero = || DVector::zeros(system.size());
        let stepper = Stepper::after(system, integrator, &stepper);
        let free_rotation = free_rotation(system, &stiffness);
        Self { state, stepper, stiffness, size, free_rotation, cages, dx: zero(), dv: zero() }
    }

    /// Copies `reference` with a perturbation of equal energy in every coordinate, whose largest displacement in any
    /// bearing is `displacement` \[m\] (small against clearances and ramps, large against round-off: 1e-9).
    pub fn new(
        system: &System,
        reference: &State,
        integrator: Integrator,
        step: f64,
        displacement: f64,
    ) -> Self {
        let n = system.size();
        let stiffness = elastic_stiffness(system, reference);
        // Quasi-random (golden ratio): excites every mode, and is the same in every run.
        let golden = 0.5 * (5f64.sqrt() - 1.0);
        let spread = |k: usize| 2.0 * ((k + 1) as f64 * golden).fract() - 1.0;
        let mut dx = DVector::from_fn(n, |i, _| spread(2 * i) / stiffness[(i, i)].sqrt());
        let mut dv = DVector::from_fn(n, |i, _| spread(2 * i + 1));
        let free_rotation = free_rotation(system, &stiffness);
        remove(&mut dx, free_rotation.as_ref());
        remove(&mut dv, free_rotation.as_ref());
        let mut moved = vec![0.0; system.interface_size()];
        system.to_interface(&dx, &mut moved);
        let translations = |i: &Interface| moved[i.row_range()].iter().take(3).copied().collect::<Vec<_>>();
        let internal = moved[system.rows()..].iter().copied();
        let translations = system.interfaces.iter().flat_map(translations).chain(internal);
        let largest = translations.fold(0.0, |m: f64, d| m.max(d.abs()));
        let scale = displacement / if largest > 0.0 { largest } else { dx.amax() };
        let mut perturbed = Self {
            state: reference.clone(),
            stepper: Stepper::new(system, integrator, step),
            stiffness,
            size: 1.0,
            free_rotation,
            cages: Vec::new(),
            dx: dx * scale,
            dv: dv * scale,
        };
        perturbed.size = perturbed.energy_norm();
        perturbed.state.x += &perturbed.dx;
        perturbed.state.v += &perturbed.dv;
        system.refresh(&mut perturbed.state);
        perturbed.sync(reference);
        perturbed
    }

    /// Repeats the last step of the reference run; `reference` is that run's state after it.
    ///
    /// # Errors
    /// A step that does not converge.
    pub fn repeat_step(&mut self, system: &System, reference: &State, step: f64) -> Result<(), PhysicsError> {
        let state = &mut self.state;
        for ((reaction, rotation), (cage, mean_cos)) in
            state.reactions.iter_mut().zip(&mut state.rotations).zip(&self.cages)
        {
            (*rotation, reaction.mean_cos) = (*cage, *mean_cos);
        }
        self.stepper.exact_step(system, state, step)?;
        self.sync(reference);
        Ok(())
    }

    /// Copies time, shaft rotation and cages of the reference run.
    pub fn sync(&mut self, reference: &State) {
        (self.state.time, self.state.spin) = (reference.time, reference.spin);
        self.cages.clear();
        let cages = reference.rotations.iter().zip(&reference.reactions);
        self.cages.extend(cages.map(|(rotation, reaction)| (*rotation, reaction.mean_cos)));
    }

    /// Renormalises the perturbation to its initial norm; returns ln of its growth since the last call.
    ///
    /// The whole difference is scaled, including the integrator's acceleration.
    pub fn renormalise(&mut self, system: &System, reference: &State) -> f64 {
        let state = &mut self.state;
        self.dx.copy_from(&state.x);
        self.dx -= &reference.x;
        self.dv.copy_from(&state.v);
        self.dv -= &reference.v;
        let free = self.free_rotation.as_ref();
        remove(&mut self.dx, free);
        remove(&mut self.dv, free);
        let norm = self.energy_norm();
        let back = self.size / norm;
        let state = &mut self.state;
        // y ← y_ref + (y − y_ref) back, without the free rotation.
        let scale = |y: &mut DVector<f64>, at: &DVector<f64>| {
            *y -= at;
            remove(y, free);
            *y *= back;
            *y += at;
        };
        scale(&mut state.x, &reference.x);
        scale(&mut state.v, &reference.v);
        scale(&mut state.a, &reference.a);
        state.rotations.copy_from_slice(&reference.rotations);
        system.to_interface(&state.x, &mut state.d);
        system.to_interface(&state.v, &mut state.d_rate);
        let State { d, d_rate, rotations, reactions, force, bodies, body_rates, .. } = state;
        let bodies = Bodies { states: bodies, rates: body_rates };
        system.bearing_reactions(d, d_rate, rotations, bodies, reactions, force);
        system.update_acceleration(state);
        (norm / self.size).ln()
    }

    fn energy_norm(&self) -> f64 {
        (self.dv.norm_squared() + self.dx.dot(&(&self.stiffness * &self.dx)).max(0.0)).sqrt()
    }
}

/// Largest ω² of a rotation that nothing holds \[rad²/s²\], above rounding of the stiffness and below that of any spring.
const FREE: f64 = 1e-4;

/// Rotation of the whole shaft about its axis, of length 1, if no stiffness holds it.
fn free_rotation(system: &System, stiffness: &DMatrix<f64>) -> Option<DVector<f64>> {
    let rotation = system.rigid_rotation.clone().try_normalize(0.0)?;
    // The norm's stiffness contains ε.
    let held = rotation.dot(&(stiffness * &rotation)) - 1.0;
    (held < FREE).then_some(rotation)
}

/// Removes the component along a direction of length 1.
fn remove(y: &mut DVector<f64>, direction: Option<&DVector<f64>>) {
    if let Some(direction) = direction {
        let along = direction.dot(y);
        y.axpy(-along, direction, 1.0);
    }
}

/// K + Wᵀ K_b W + ε with the bearings' elastic stiffness at a state; for internal
/// coordinates the diagonal entry, under their own inertial load.
fn elastic_stiffness(system: &System, state: &State) -> DMatrix<f64> {
    let (n, structure) = (system.size(), system.structure());
    let mut out = DMatrix::identity(n, n);
    let mut block = out.view_mut((0, 0), (structure, structure));
    block += &system.stiffness;
    for (interface, rotation) in system.interfaces.iter().zip(&state.rotations) {
        let rows = interface.element.relative_dofs();
        let mut d = [0.0; 6];
        d[..rows].copy_from_slice(&state.d[interface.first_row..interface.first_row + rows]);
        let still = Rotation { cage_speed: None, ..*rotation };
        let k = interface.element.reaction(&d, &[0.0; 6], &still).stiffness;
        let map = system.interface_map.rows(interface.first_row, rows);
        let symmetric = DMatrix::from_fn(rows, rows, |a, b| 0.5 * (k[a][b] + k[b][a]));
        block += map.transpose() * symmetric * map;
    }
    for (interface, rotation) in system.interfaces.iter().zip(&state.rotations) {
        let Some(internal) = interface.element.internal() else { continue };
        for (own, k) in interface.internal_range().enumerate() {
            out[(structure + k, structure + k)] +=
                internal.stiffness(own, rotation) / system.internal_masses[k];
        }
    }
    out
}

//! The reduced equations of motion of a machine with nonlinear bearings, for time integration.
//!
//! ẍ + (C + Ω G) ẋ + (K + Ω̇ K_s + Ω K_c) x = p(t) + Wᵀ f(d, ḋ, rotation), d = W x,
//! in mass-normalised coordinates q = V x; f holds the bearing forces on the shaft. Internal coordinates y of
//! bearings are appended: √m y to x, y to d, and the force on y to f. Free bodies of bearings have states z of their own
//! with ż = g(z, d, ḋ, rotation).

use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

use super::channels::Channels;
use super::inertias::Inertias;
use super::interface::{Interface, StepTangents};
use super::numbers::vector;
use super::panels::Panels;
use super::torque::{DrivenState, TorqueDrive};
use crate::assembly::PhysicsError;
use crate::model::{LoadFactor, SpeedCurve, Spin};
use rotordyn_bearing::internal::{InternalStep, Motion, NewmarkGain};
use rotordyn_bearing::{Reaction, Rotation};
use rotordyn_linalg::panel::Panel;

/// A load p(t) = factor(t) · vector.
#[derive(Clone, Debug)]
pub struct VaryingLoad {
    pub vector: DVector<f64>,
    pub factor: LoadFactor,
}

/// The reduced machine; immutable during a run. Matrices are over the structure, vectors over all coordinates.
#[derive(Clone, Debug)]
pub struct System {
    /// Natural frequencies of the structure's coordinates that are modes of the machine linearised at equilibrium \[rad/s\];
    /// zero for static corrections and unstable ones.
    pub natural_frequencies: DVector<f64>,
    pub stiffness: DMatrix<f64>,
    pub damping: DMatrix<f64>,
    pub gyroscopic: DMatrix<f64>,
    pub spin_up: DMatrix<f64>,
    pub circulatory: DMatrix<f64>,
    /// Skew-symmetric part of the stiffness (unsymmetric bushings), `None` without any.
    pub cross_coupling: Option<DMatrix<f64>>,
    /// Static load: gravity, belt pulls, constant loads.
    pub static_load: DVector<f64>,
    /// Unbalance along cos θ and sin θ, per Ω².
    pub unbalance: [DVector<f64>; 2],
    /// Vᵀ M r: the rotation of the whole shaft about its axis by 1 rad.
    pub rigid_rotation: DVector<f64>,
    /// −Vᵀ M r: inertial load on torsion per unit Ω̇.
    pub spin_inertia: DVector<f64>,
    pub varying_loads: Vec<VaryingLoad>,
    /// Interface map W, rows × coordinates of the structure.
    pub interface_map: DMatrix<f64>,
    pub interfaces: Vec<Interface>,
    /// Mass of every internal coordinate \[kg\].
    pub internal_masses: Vec<f64>,
    pub channels: Channels,
    pub curve: SpeedCurve,
    /// Torque drive, if the shaft speed follows from a torque balance instead of the profile.
    pub drive: Option<TorqueDrive>,
    pub panels: Panels,
}

/// State of a run: time, shaft motion, coordinates and bearing states.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct State {
    pub time: f64,
    pub spin: Spin,
    #[serde(with = "vector")]
    pub x: DVector<f64>,
    #[serde(with = "vector")]
    pub v: DVector<f64>,
    /// Acceleration of an implicit integrator, which may be shifted in time.
    #[serde(with = "vector")]
    pub a: DVector<f64>,
    /// ẍ of the equations of motion.
    #[serde(with = "vector")]
    pub acceleration: DVector<f64>,
    /// Inertias of an implicit integrator, for which v, a and ẍ hold.
    pub inertias: Inertias,
    /// Per interface: angle and speed of cage and shaft.
    pub rotations: Vec<Rotation>,
    /// Per interface: force, tangents and energies at this state.
    pub reactions: Vec<Reaction>,
    /// Relative displacements W x and velocities W ẋ, then positions and velocities of the internal coordinates.
    pub d: Vec<f64>,
    pub d_rate: Vec<f64>,
    /// The corresponding forces.
    pub force: Vec<f64>,
    /// States of the free bodies of all bearings, and their rates.
    pub bodies: Vec<f64>,
    pub body_rates: Vec<f64>,
    /// What a torque drive needs in addition; empty without.
    pub driven: DrivenState,
}

/// States of free bodies, and their rates to be found.
pub struct Bodies<'a> {
    pub states: &'a [f64],
    pub rates: &'a mut [f64],
}

impl State {
    /// x, ẋ and ẍ, the acceleration of an implicit integrator.
    pub fn motion(&self) -> [&DVector<f64>; 3] {
        [&self.x, &self.v, &self.a]
    }

    /// Whether it is one of a system of this size.
    pub fn fits(&self, system: &System) -> bool {
        let driven = if system.drive.is_some() { system.size() } else { 0 };
        let vectors = [&self.x, &self.v, &self.a, &self.acceleration];
        let places = [&self.d, &self.d_rate, &self.force];
        vectors.iter().all(|vector| vector.len() == system.size())
            && places.iter().all(|place| place.len() == system.interface_size())
            && [self.rotations.len(), self.reactions.len()] == [system.interfaces.len(); 2]
            && [self.bodies.len(), self.body_rates.len()] == [system.body_states(); 2]
            && self.driven.load.len() == driven
    }
}

impl System {
    /// Number of coordinates: those of the structure and internal ones of bearings.
    pub fn size(&self) -> usize {
        self.structure() + self.internal_masses.len()
    }

    /// Number of the structure's coordinates.
    pub fn structure(&self) -> usize {
        self.stiffness.nrows()
    }

    /// Number of rows of W.
    pub fn rows(&self) -> usize {
        self.interfaces.last().map_or(0, |i| i.first_row + i.rows)
    }

    /// Number of interface displacements: rows of W and internal coordinates.
    pub fn interface_size(&self) -> usize {
        self.rows() + self.internal_masses.len()
    }

    /// The shaft's rotation `offset` after (time, spin): from the profile, or at constant acceleration under
    /// a torque drive.
    pub fn spin_ahead(&self, time: f64, spin: &Spin, offset: f64) -> Spin {
        match &self.drive {
            None => self.curve.at(time + offset),
            Some(_) => Spin {
                angle: spin.angle + offset * (spin.speed + 0.5 * offset * spin.acceleration),
                speed: spin.speed + offset * spin.acceleration,
                acceleration: spin.acceleration,
            },
        }
    }

    /// Name of an interface row, for messages.
    pub fn name_of_row(&self, row: usize) -> String {
        const DIRECTIONS: [&str; 6] = ["u_x", "u_y", "u_z", "theta_x", "theta_y", "theta_z"];
        let rows = self.rows();
        let place = |i: &Interface| match row.checked_sub(rows) {
            None if !i.row_range().contains(&row) => None,
            None => {
                let (k, relative) = (row - i.first_row, i.element.relative_dofs());
                Some(match k.checked_sub(relative) {
                    None => DIRECTIONS[k].to_string(),
                    Some(k) => format!("{} of its housing", DIRECTIONS[k]),
                })
            }
            Some(k) => {
                let own = k.checked_sub(i.first_internal).filter(|own| *own < i.internal)?;
                Some(i.element.internal()?.name(own))
            }
        };
        let named = |i: &Interface| Some(format!("bearing {}, {}", i.name, place(i)?));
        self.interfaces.iter().find_map(named).unwrap_or("the structure".into())
    }

    /// Adds weight × ((C + Ω G) v + (K + Ω̇ K_s + Ω K_c) x) to `out`; `scratch`: reusable buffer.
    pub fn add_linear(
        &self,
        spin: &Spin,
        motion: [&DVector<f64>; 2],
        weight: f64,
        scratch: &mut Vec<f64>,
        out: &mut DVector<f64>,
    ) {
        self.add_product(&self.panels.linear, 0, spin, motion, weight, scratch, out);
    }

    /// Adds weight × (Ω G v + (Ω̇ K_s + Ω K_c) x) to `out`; `scratch`: reusable buffer.
    pub fn add_rotational(
        &self,
        spin: &Spin,
        motion: [&DVector<f64>; 2],
        weight: f64,
        scratch: &mut Vec<f64>,
        out: &mut DVector<f64>,
    ) {
        if self.panels.is_nonzero[2..].contains(&true) {
            self.add_product(&self.panels.rotational, 2, spin, motion, weight, scratch, out);
        }
    }

    /// Adds the product with the non-zero ones of \[C K G K_s K_c\] from the one at index `first` on.
    #[allow(clippy::too_many_arguments)]
    fn add_product(
        &self,
        panel: &Panel,
        first: usize,
        spin: &Spin,
        [x, v]: [&DVector<f64>; 2],
        weight: f64,
        scratch: &mut Vec<f64>,
        out: &mut DVector<f64>,
    ) {
        let n = self.structure();
        let (x, v) = (&x.as_slice()[..n], &v.as_slice()[..n]);
        let Spin { speed, acceleration, .. } = *spin;
        let factors = [(v, 1.0), (x, 1.0), (v, speed), (x, acceleration), (x, speed)];
        let terms = factors.iter().zip(self.panels.is_nonzero).skip(first);
        scratch.clear();
        for ((y, factor), _) in terms.filter(|(_, there)| *there) {
            let factor = weight * factor;
            scratch.extend(y.iter().map(|y| factor * y));
        }
        panel.mul_add(scratch, &mut out.as_mut_slice()[..n]);
    }

    /// W y for coordinates y, then the internal coordinates, written to `out`.
    pub fn to_interface(&self, y: &DVector<f64>, out: &mut [f64]) {
        let (structure, internal) = y.as_slice().split_at(self.structure());
        let (rows, places) = out.split_at_mut(self.rows());
        rows.fill(0.0);
        self.panels.to_interface.mul_add(structure, rows);
        for ((place, y), mass) in places.iter_mut().zip(internal).zip(&self.internal_masses) {
            *place = y / mass.sqrt();
        }
    }

    /// Adds Wᵀ f to `out`, and the forces on the internal coordinates to these.
    pub fn add_from_interface(&self, force: &[f64], out: &mut DVector<f64>) {
        let (rows, on_internal) = force.split_at(self.rows());
        let (structure, internal) = out.as_mut_slice().split_at_mut(self.structure());
        self.panels.from_interface.mul_add(rows, structure);
        for ((y, f), mass) in internal.iter_mut().zip(on_internal).zip(&self.internal_masses) {
            *y += f / mass.sqrt();
        }
    }

    /// Bearing forces with tangent stiffness and damping at displacements and velocities.
    ///
    /// No tangents for bearings with internal coordinates.
    pub fn bearing_reactions(
        &self,
        d: &[f64],
        d_rate: &[f64],
        rotations: &[Rotation],
        bodies: Bodies,
        reactions: &mut [Reaction],
        force: &mut [f64],
    ) {
        self.evaluate([d, d_rate], rotations, bodies, (reactions, force), true);
    }

    /// Bearing forces without tangents (those in `reactions` are stale): for explicit steps.
    pub fn bearing_forces(
        &self,
        d: &[f64],
        d_rate: &[f64],
        rotations: &[Rotation],
        bodies: Bodies,
        reactions: &mut [Reaction],
        force: &mut [f64],
    ) {
        self.evaluate([d, d_rate], rotations, bodies, (reactions, force), false);
    }

    fn evaluate(
        &self,
        [d, d_rate]: [&[f64]; 2],
        rotations: &[Rotation],
        bodies: Bodies,
        (reactions, force): (&mut [Reaction], &mut [f64]),
        tangents: bool,
    ) {
        let (rows, on_internal) = force.split_at_mut(self.rows());
        for ((interface, rotation), reaction) in self.interfaces.iter().zip(rotations).zip(reactions) {
            let own = interface.row_range();
            if let Some(free) = interface.element.bodies() {
                let motion = interface.ring_motion(d, d_rate, rotation);
                let states = interface.body_range();
                let rates = &mut bodies.rates[states.clone()];
                *reaction = free.rates(
                    motion.rows(),
                    &motion.rotation,
                    &bodies.states[states],
                    rates,
                    &mut rows[own],
                );
                continue;
            }
            let Some(internal) = interface.element.internal() else {
                if tangents {
                    *reaction = interface.reaction(d, d_rate, rotation);
                } else {
                    let [at, rate] = interface.motion(d, d_rate, rotation);
                    interface.element.force(&at, &rate, rotation, reaction);
                }
                rows[own].copy_from_slice(&reaction.force[..interface.rows]);
                continue;
            };
            let [position, velocity] = [d, d_rate].map(|y| &y[rows.len()..][interface.internal_range()]);
            *reaction = internal.forces(
                Motion { position: &d[own.clone()], velocity: &d_rate[own.clone()] },
                Motion { position, velocity },
                rotation,
                &mut rows[own],
                &mut on_internal[interface.internal_range()],
            );
        }
    }

    /// Bearing forces with tangents at the end of an implicit step; solves the internal coordinates.
    ///
    /// `d`, `d_rate`: displacements and velocities of the rows, and the force-free prediction of the internal
    /// coordinates, replaced by the values at the step's end. `force`: initial guess for the internal coordinates,
    /// replaced by the solution. `tangents`: of the bearings with internal coordinates.
    pub fn bearing_reactions_in_step(
        &self,
        [d, d_rate]: [&mut [f64]; 2],
        rotations: &[Rotation],
        gain: &NewmarkGain,
        reactions: &mut [Reaction],
        force: &mut [f64],
        tangents: &mut StepTangents,
    ) {
        let count = self.rows();
        let (rows, on_internal) = force.split_at_mut(count);
        for ((interface, rotation), reaction) in self.interfaces.iter().zip(rotations).zip(reactions) {
            let own = interface.row_range();
            let Some(internal) = interface.element.internal() else {
                *reaction = interface.reaction(d, d_rate, rotation);
                rows[own].copy_from_slice(&reaction.force[..interface.rows]);
                continue;
            };
            let (d_rows, d_internal) = d.split_at_mut(count);
            let (rate_rows, rate_internal) = d_rate.split_at_mut(count);
            let step = InternalStep {
                position: &mut d_internal[interface.internal_range()],
                velocity: &mut rate_internal[interface.internal_range()],
                force: &mut on_internal[interface.internal_range()],
                force_tangent: &mut tangents.internal_force[interface.tangent_range()],
                stiffness: &mut tangents.stiffness[interface.stiffness_range()],
            };
            let motion = Motion { position: &d_rows[own.clone()], velocity: &rate_rows[own.clone()] };
            *reaction = internal.step(motion, step, rotation, gain, &mut rows[own]);
        }
    }

    /// The state at t = 0 with given coordinates and velocities and consistent acceleration.
    ///
    /// # Errors
    /// Free bodies that overlap.
    pub fn initial_state(&self, x: DVector<f64>, v: DVector<f64>) -> Result<State, PhysicsError> {
        let mut spin = self.curve.at(0.0);
        if self.drive.is_some() {
            spin.acceleration = 0.0;
        }
        let (n, places) = (self.size(), self.interface_size());
        let rotations = self
            .interfaces
            .iter()
            .map(|i| Rotation {
                cage_angle: i.cage_angle,
                cage_speed: Some(i.element.cage_ratio(i.element.nominal_cos()) * spin.speed),
                shaft_angle: spin.angle,
                shaft_speed: spin.speed,
            })
            .collect();
        let mut state = State {
            time: 0.0,
            spin,
            x,
            v,
            a: DVector::zeros(n),
            acceleration: DVector::zeros(n),
            inertias: Inertias::default(),
            rotations,
            reactions: vec![Reaction::default(); self.interfaces.len()],
            d: vec![0.0; places],
            d_rate: vec![0.0; places],
            force: vec![0.0; places],
            bodies: Vec::new(),
            body_rates: vec![0.0; self.body_states()],
            driven: DrivenState::default(),
        };
        self.start_bodies(&mut state)?;
        self.refresh(&mut state);
        Ok(state)
    }

    /// The state at a given time with given cage angles and, unless empty, states of free bodies.
    ///
    /// # Errors
    /// As [`Self::initial_state`].
    pub fn state_at(
        &self,
        time: f64,
        cage_angles: &[f64],
        bodies: &[f64],
        [x, v]: [DVector<f64>; 2],
    ) -> Result<State, PhysicsError> {
        let mut state = self.initial_state(x, v)?;
        if bodies.len() == state.bodies.len() {
            state.bodies.copy_from_slice(bodies);
        }
        state.time = time;
        state.spin = self.curve.at(time);
        for (rotation, angle) in state.rotations.iter_mut().zip(cage_angles) {
            rotation.cage_angle = *angle;
            rotation.shaft_angle = state.spin.angle;
        }
        self.refresh(&mut state);
        Ok(state)
    }

    /// Recomputes reactions and acceleration of a state from its x, v, time and rotations.
    pub fn refresh(&self, state: &mut State) {
        let (x, v) = (state.x.clone(), state.v.clone());
        self.to_interface(&x, &mut state.d);
        self.to_interface(&v, &mut state.d_rate);
        let State { d, d_rate, rotations, reactions, force, bodies, body_rates, .. } = state;
        let bodies = Bodies { states: bodies, rates: body_rates };
        self.bearing_reactions(d, d_rate, rotations, bodies, reactions, force);
        self.update_acceleration(state);
        state.a.copy_from(&state.acceleration);
        if let Some(drive) = &self.drive {
            drive.start(self, state);
        }
    }

    /// M̂ ẍ = p + Wᵀ f − (C + Ω G) ẋ − (K + …) x of a state; under a torque drive without its coupling loads.
    pub fn update_acceleration(&self, state: &mut State) {
        let mut acceleration = std::mem::take(&mut state.acceleration);
        self.load(state.time, &state.spin, &mut acceleration);
        self.add_linear(&state.spin, [&state.x, &state.v], -1.0, &mut Vec::new(), &mut acceleration);
        self.add_from_interface(&state.force, &mut acceleration);
        state.inertias.divide(&mut acceleration);
        state.acceleration = acceleration;
    }
}

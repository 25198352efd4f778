//! Free bodies of bearings in the reduced system: start, steps, checks.

use super::interface::{Interface, RowMotion};
use super::system::{State, System};
use crate::assembly::PhysicsError;
use crate::model::study::Integrator;
use nalgebra::{DMatrix, SymmetricEigen};
use rotordyn_bearing::{BodyPose, FreeBodies, PlacedBalls};

/// Step times highest circular frequency of the structure, at most: RK4 is stable to 2.8 and loses 2 % of the amplitude
/// a step at 1.5.
const STRUCTURE_SHARE: f64 = 1.5;

/// A bearing with free bodies at a state: its bodies, the motion of its rows, their states.
type Place<'a> = (&'a Interface, &'a dyn FreeBodies, RowMotion);

impl System {
    /// Number of states of free bodies.
    pub fn body_states(&self) -> usize {
        self.interfaces.last().map_or(0, |interface| interface.body_range().end)
    }

    /// Whether a bearing has free bodies.
    pub fn has_bodies(&self) -> bool {
        self.body_states() > 0
    }

    fn bodies_at<'a>(&'a self, state: &'a State) -> impl Iterator<Item = Place<'a>> {
        self.interfaces.iter().zip(&state.rotations).filter_map(|(interface, rotation)| {
            let bodies = interface.element.bodies()?;
            Some((interface, bodies, interface.ring_motion(&state.d, &state.d_rate, rotation)))
        })
    }

    /// States of the bodies from the kinematic solution at a state.
    pub(super) fn start_bodies(&self, state: &mut State) -> Result<(), PhysicsError> {
        let (x, v) = (state.x.clone(), state.v.clone());
        self.to_interface(&x, &mut state.d);
        self.to_interface(&v, &mut state.d_rate);
        let mut all = Vec::new();
        for (interface, bodies, motion) in self.bodies_at(state) {
            let start = bodies.start(motion.rows(), &motion.rotation);
            all.extend(start.map_err(|error| failed(interface, state, &error))?);
        }
        state.bodies = all;
        Ok(())
    }

    /// # Errors
    /// Parts of a bearing with free balls that `overlap` finds in a state, in its words.
    pub fn check_placement(
        &self,
        state: &State,
        overlap: impl Fn(&PlacedBalls) -> Option<String>,
    ) -> Result<(), PhysicsError> {
        self.bodies_at(state).try_for_each(|(interface, bodies, motion)| {
            let own = &state.bodies[interface.body_range()];
            let placed = bodies.placed(motion.rows(), &motion.rotation, own);
            match placed.as_ref().and_then(&overlap) {
                Some(found) => Err(failed(interface, state, &found)),
                None => Ok(()),
            }
        })
    }

    /// Step \[s\] that resolves the bodies at a state, and the structure on its bearings; infinite without bodies.
    pub fn body_step(&self, state: &State) -> f64 {
        let steps = self.bodies_at(state).map(|(interface, bodies, motion)| {
            bodies.step(motion.rows(), &motion.rotation, &state.bodies[interface.body_range()])
        });
        steps.fold(f64::INFINITY, f64::min)
    }

    /// Longest explicit step \[s\] for the structure on its bearings at a state.
    pub fn structure_step(&self, state: &State) -> f64 {
        let mut stiffness = self.stiffness.clone();
        for (interface, rotation) in self.interfaces.iter().zip(&state.rotations) {
            let rows = interface.element.relative_dofs();
            let [d, _] = interface.motion(&state.d, &state.d_rate, rotation);
            let k = interface.element.reaction(&d, &[0.0; 6], rotation).stiffness;
            let map = self.interface_map.rows(interface.first_row, rows);
            let symmetric = DMatrix::from_fn(rows, rows, |a, b| 0.5 * (k[a][b] + k[b][a]));
            stiffness += map.transpose() * symmetric * map;
        }
        let largest = SymmetricEigen::new(stiffness).eigenvalues.iter().copied().fold(0.0, f64::max);
        STRUCTURE_SHARE / largest.sqrt()
    }

    /// Restores the length of quaternions, and follows the angles of the cages.
    pub(super) fn finish_bodies(&self, state: &mut State) {
        for (interface, rotation) in self.interfaces.iter().zip(&mut state.rotations) {
            let Some(bodies) = interface.element.bodies() else { continue };
            let own = &mut state.bodies[interface.body_range()];
            bodies.normalise(own);
            // The cage is near the kinematic one of the step, which counts its turns.
            let turns = (bodies.cage_angle(own) - rotation.cage_angle) / std::f64::consts::TAU;
            rotation.cage_angle += (turns - turns.round()) * std::f64::consts::TAU;
        }
    }

    /// # Errors
    /// A body that has left its bearing.
    pub fn check_bodies(&self, state: &State) -> Result<(), PhysicsError> {
        self.bodies_at(state).try_for_each(|(interface, bodies, motion)| {
            let own = &state.bodies[interface.body_range()];
            let checked = bodies.check(motion.rows(), &motion.rotation, own, state.time);
            checked.map_err(|error| failed(interface, state, &error))
        })
    }

    /// Appends the recorded quantities of an interface's bodies; nothing without bodies.
    pub fn read_bodies(&self, interface: usize, state: &State, out: &mut Vec<f64>) {
        let place = &self.interfaces[interface];
        let Some(bodies) = place.element.bodies() else { return };
        let motion = place.ring_motion(&state.d, &state.d_rate, &state.rotations[interface]);
        let first = out.len();
        out.resize(first + bodies.channels().len(), 0.0);
        let own = &state.bodies[place.body_range()];
        bodies.read(motion.rows(), &motion.rotation, own, &mut out[first..]);
    }

    /// Places and motions of an interface's bodies; none without bodies.
    pub fn body_poses(&self, interface: usize, state: &State) -> Vec<BodyPose> {
        let place = &self.interfaces[interface];
        place.element.bodies().map_or(Vec::new(), |bodies| bodies.poses(&state.bodies[place.body_range()]))
    }

    /// Forces on the balls of an interface \[N\], as [`FreeBodies::ball_forces`]; none without bodies.
    pub fn ball_forces(&self, interface: usize, state: &State) -> Vec<[f64; 3]> {
        let place = &self.interfaces[interface];
        let Some(bodies) = place.element.bodies() else { return Vec::new() };
        let motion = place.ring_motion(&state.d, &state.d_rate, &state.rotations[interface]);
        bodies.ball_forces(motion.rows(), &motion.rotation, &state.bodies[place.body_range()])
    }

    /// Kinetic energy of all free bodies \[J\].
    pub fn body_energy(&self, state: &State) -> f64 {
        let energies = self
            .bodies_at(state)
            .map(|(interface, bodies, _)| bodies.kinetic_energy(&state.bodies[interface.body_range()]));
        energies.sum()
    }

    /// Work given to all free bodies besides that of the rows, and energy lost, since the start \[J\].
    pub fn body_work(&self, state: &State) -> [f64; 2] {
        let mut out = [0.0; 2];
        for (interface, bodies, _) in self.bodies_at(state) {
            let work = bodies.work(&state.bodies[interface.body_range()]);
            out = [out[0] + work.given, out[1] + work.lost];
        }
        out
    }

    /// # Errors
    /// An integrator that does not take free bodies.
    pub fn check_integrator(&self, integrator: Integrator, state: &State) -> Result<(), PhysicsError> {
        match self.bodies_at(state).next() {
            Some((interface, ..)) if integrator != Integrator::RungeKutta4 => {
                Err(failed(interface, state, &"free balls need integrator = \"rk4\", explicit steps"))
            }
            _ => Ok(()),
        }
    }

    /// # Errors
    /// A bearing with free bodies, for `what` cannot be had with these.
    pub(super) fn refuse_bodies(&self, what: &str, state: &State) -> Result<(), PhysicsError> {
        self.bodies_at(state).next().map_or(Ok(()), |(interface, ..)| {
            let why = format!("{what} is not computed with free balls; it is with model = \"ball\"");
            Err(failed(interface, state, &why))
        })
    }
}

fn failed(interface: &Interface, state: &State, error: &dyn std::fmt::Display) -> PhysicsError {
    PhysicsError::FreeBodies {
        bearing: interface.name.clone(),
        time: state.time,
        speed_rpm: state.spin.speed * 30.0 / std::f64::consts::PI,
        reason: error.to_string(),
    }
}

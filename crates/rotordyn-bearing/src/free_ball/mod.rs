//! Ball bearing whose balls and cage are free bodies: slip, skidding, cage whirl, pocket contacts.
//!
//! Every ball is a rigid body between the grooves of two rings whose motion is given; contact with the races is Hertzian
//! with traction integrated over the contact ellipse. The cage is a rigid body with six degrees of freedom, with a pocket
//! for each ball and guided by the balls or on a land. All forces act in pairs, so that momentum is conserved and
//! energy balanced; the equations are integrated by the Runge-Kutta method of fourth order.
//!
//! The way of one evaluation, file by file: `ring` (motion of the rings), `state` (numbers of balls and cage), `surfaces`
//! (distances in closed form or from another source, such as the shapes of parry), `race`
//! (ball in a groove), `friction` and `ellipse` (traction), `point_contact` and `cage` (pockets, land, ball to ball), `forces` (sum
//! of all), `advance` (time steps between given rings) or `element` (in a machine); `initial` starts from the kinematic
//! solution, `energy` balances.

mod advance;
mod cage;
mod element;
mod ellipse;
mod energy;
mod error;
mod forces;
mod friction;
mod initial;
mod input;
mod point_contact;
mod proximity;
mod race;
mod report;
mod ring;
mod state;
mod surfaces;

pub use advance::{Interval, StableStep, StepShares};
pub use element::{FreeBallElement, ball_offset_name};
pub use energy::{Momentum, StoredEnergy};
pub use error::{FreeBallError, StepLimit};
pub use forces::{ForceSums, LOSSES, Loss};
pub use friction::{FilmShear, FrictionLaw, TractionCurve};
pub use input::{
    Drag, FreeBallBearing, FreeCage, Guidance, Land, Pocket, PointContactLaw, SlipModel, pocket_stiffness,
};
pub use proximity::{ContactPart, Proximity};
pub use report::{BallReport, RaceContactReport};
pub use ring::{RingState, Wrench};
pub use state::{BallBody, CageBody, FreeBallState};
pub use surfaces::{
    Approach, ClosedForms, Distances, GroovePlace, GrooveSurface, LandPlace, Placement, PocketPlace,
    PocketSurface,
};

use crate::BallElement;
use crate::contact::{EllipticContact, Race};
use cage::CageContacts;
use forces::Parts;
use race::Groove;
use ring::V;

/// A bearing with free balls and cage, prepared for integration.
#[derive(Clone, Debug)]
pub struct FreeBalls {
    bearing: FreeBallBearing,
    parts: Parts,
}

impl FreeBalls {
    /// Prepares a bearing with the clearance and preload at a shaft speed \[rad/s\].
    ///
    /// Errors: input data that are not supported; a cage that touches a ball or a ring when centred.
    pub fn new(bearing: FreeBallBearing, speed: f64) -> Result<Self, FreeBallError> {
        let problems = bearing.problems();
        if !problems.is_empty() {
            return Err(FreeBallError::Input(problems));
        }
        let g = &bearing.ball.geometry;
        let clearance = g.radial_clearance + bearing.ball.clearance_change(speed);
        let preload = BallElement::new(&bearing.ball).preload_state(speed).offset;
        let grooves = [Race::Inner, Race::Outer].map(|race| Groove::new(&bearing, race, clearance, preload));
        let ball = |j: usize| {
            let sizes = bearing.ball.imperfections.off_size.iter().filter(|size| size.ball == j);
            let difference: f64 = sizes.map(|size| size.diameter_difference).sum();
            let radius = 0.5 * (g.ball_diameter + difference);
            let mass = bearing.ball.ball_material.density * 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3);
            [radius, mass, 0.4 * mass * radius * radius]
        };
        let material = &bearing.ball.ball_material;
        let spheres =
            EllipticContact::new(4.0 / g.ball_diameter, 4.0 / g.ball_diameter, [material, material]);
        let parts = Parts {
            grooves,
            balls: (0..g.balls).map(ball).collect(),
            cage: bearing.cage.map(|cage| CageContacts::new(cage, g.balls, 0.5 * g.pitch_diameter)),
            ball_contact: PointContactLaw {
                stiffness: spheres.stiffness,
                damping: bearing.damping,
                friction: bearing.ball_friction,
            },
            drag: bearing.drag,
            gravity: V::from(bearing.gravity),
        };
        Ok(Self { bearing, parts })
    }

    /// Initial state from the kinematic solution at the state of the rings (inner, outer).
    ///
    /// Errors: the cage touches a ball or its land there.
    pub fn initial_state(&self, rings: &[RingState; 2]) -> Result<FreeBallState, FreeBallError> {
        let state = self.parts.kinematic_state(&self.bearing.ball, rings);
        match proximity::first_overlap(&self.proximities(&ClosedForms, &state, rings, 0.0)) {
            Some((what, depth)) => Err(FreeBallError::Overlap { what, depth }),
            None => Ok(state),
        }
    }

    /// Advances a state over an interval and returns mean forces and energies.
    ///
    /// `rings`: inner and outer ring at the start and at the end; `duration` and longest `step` \[s\]. Between, the rings
    /// move as [`RingState::between`]. Errors: a duration or step that is not positive and finite, a step beyond a
    /// stability limit, a ball or cage that leaves the bearing; the state is then that after the last accepted step.
    pub fn advance(
        &self,
        state: &mut FreeBallState,
        rings: [&[RingState; 2]; 2],
        duration: f64,
        step: f64,
    ) -> Result<Interval, FreeBallError> {
        self.parts.advance(&ClosedForms, state, rings, duration, step)
    }

    /// [`advance`](Self::advance) with distances from another source than the closed forms.
    pub fn advance_with<D: Distances>(
        &self,
        distances: &D,
        state: &mut FreeBallState,
        rings: [&[RingState; 2]; 2],
        duration: f64,
        step: f64,
    ) -> Result<Interval, FreeBallError> {
        self.parts.advance(distances, state, rings, duration, step)
    }

    /// Forces on the rings and powers in a state.
    pub fn forces(&self, state: &FreeBallState, rings: &[RingState; 2]) -> ForceSums {
        self.forces_with(&ClosedForms, state, rings)
    }

    /// [`forces`](Self::forces) with distances from another source than the closed forms.
    pub fn forces_with<D: Distances>(
        &self,
        distances: &D,
        state: &FreeBallState,
        rings: &[RingState; 2],
    ) -> ForceSums {
        let mut rates = vec![0.0; state.values.len()];
        self.parts.rates(distances, &state.values, &rings.map(|ring| ring.frame()), &mut rates)
    }

    /// All pairs of parts whose distance by a source is below `margin` \[m\].
    ///
    /// Balls and their pockets, cage and land, or neighbouring balls without cage; then balls and races, without the height
    /// of their surfaces.
    pub fn proximities<D: Distances>(
        &self,
        distances: &D,
        state: &FreeBallState,
        rings: &[RingState; 2],
        margin: f64,
    ) -> Vec<Proximity> {
        self.parts.proximities(distances, &state.values, &rings.map(|ring| ring.frame()), margin)
    }

    /// Grooves of inner and outer race.
    pub fn grooves(&self) -> [GrooveSurface; 2] {
        [0, 1].map(|k| self.parts.grooves[k].torus)
    }

    /// Radius \[m\] of each ball.
    pub fn ball_radii(&self) -> Vec<f64> {
        self.parts.balls.iter().map(|[radius, ..]| *radius).collect()
    }

    /// The input data.
    pub fn bearing(&self) -> &FreeBallBearing {
        &self.bearing
    }

    /// Largest stable steps in a state.
    pub fn stable_step(&self, state: &FreeBallState, rings: &[RingState; 2]) -> StableStep {
        StableStep::of(&self.forces(state, rings))
    }

    /// Largest stable step \[s\] of the friction law for one ball under a load Q \[N\] at zero slip.
    ///
    /// 2.785/(3.5 g Q/m), g the slope of the friction law (μ/v₀), for a ball on one race; 3.5 becomes 5 between two races
    /// under equal loads.
    pub fn stable_friction_step(&self, load: f64, races: usize) -> f64 {
        let slope = self.parts.grooves[1].friction_slope();
        let [_, mass, _] = self.parts.balls[0];
        2.785_293 * mass / (if races > 1 { 5.0 } else { 3.5 } * slope * load)
    }

    /// Stored energy in a state.
    pub fn energy(&self, state: &FreeBallState, rings: &[RingState; 2]) -> StoredEnergy {
        StoredEnergy { elastic: self.forces(state, rings).elastic_energy, ..self.parts.energy(&state.values) }
    }

    /// Momentum of balls and cage in a state.
    pub fn momentum(&self, state: &FreeBallState) -> Momentum {
        self.parts.momentum(&state.values)
    }

    /// Rate of the momentum of balls and cage in a state, gravity included.
    pub fn momentum_rate(&self, state: &FreeBallState, rings: &[RingState; 2]) -> Momentum {
        let mut rates = vec![0.0; state.values.len()];
        self.parts.rates(&ClosedForms, &state.values, &rings.map(|ring| ring.frame()), &mut rates);
        self.parts.momentum_of(&state.values, &rates)
    }

    /// Motion and contacts of every ball in a state.
    pub fn report(&self, state: &FreeBallState, rings: &[RingState; 2]) -> Vec<BallReport> {
        self.parts.report(&state.values, &rings.map(|ring| ring.frame()))
    }

    /// Mass \[kg\] and moment of inertia \[kg m²\] of a ball.
    pub fn ball_inertia(&self, ball: usize) -> [f64; 2] {
        let [_, mass, inertia] = self.parts.balls[ball];
        [mass, inertia]
    }
}

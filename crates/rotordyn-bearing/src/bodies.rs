//! Bodies of a bearing that move by themselves: balls and a cage with states of their own.
//!
//! A bearing with free bodies has states z with ż = g(z, r, ṙ, t), integrated in time with the machine by explicit steps.
//! Its rows r are the six relative displacements, then the six displacements of a housing that moves.

use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::fmt::Debug;

use crate::free_ball::{FreeBallError, FreeBallState, FreeBalls, RingState};
use crate::internal::Motion;
use crate::reaction::{Reaction, Rotation};

/// One quantity of free bodies that runs record.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyChannel {
    /// Name after that of the bearing: "cage_speed".
    pub name: Cow<'static, str>,
    pub unit: &'static str,
    pub quantity: &'static str,
    /// Body or direction in words: "cage".
    pub direction: &'static str,
}

/// Place and motion of one free body in the axes of the bearing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BodyPose {
    /// Centre \[m\].
    pub position: [f64; 3],
    /// Orientation as unit quaternion, scalar first; `None` where the state has none, as of a ball.
    pub orientation: Option<[f64; 4]>,
    /// Angular velocity \[rad/s\].
    pub rotation: [f64; 3],
}

/// Balls and cage of a bearing as free bodies.
pub trait FreeBodies: Debug {
    /// Number of states; the last two are the work \[J\] of [`BodyWork`].
    fn states(&self) -> usize;

    /// States at the start, from the kinematic solution at given motion of the rows.
    ///
    /// Errors: parts that overlap, data that are not supported.
    fn start(&self, rows: Motion, rotation: &Rotation) -> Result<Vec<f64>, FreeBallError>;

    /// Rates ż of the states, and the forces on the rows.
    ///
    /// The first six of the forces on the rows are also those of the reaction, which has no tangents and no powers: the
    /// states hold the work.
    fn rates(
        &self,
        rows: Motion,
        rotation: &Rotation,
        states: &[f64],
        rates: &mut [f64],
        on_rows: &mut [f64],
    ) -> Reaction;

    /// Step \[s\] that resolves the motion of the bodies, a share of the stability limits of RK4.
    fn step(&self, rows: Motion, rotation: &Rotation, states: &[f64]) -> f64;

    /// Restores what integration departs from, such as the length of quaternions.
    fn normalise(&self, states: &mut [f64]);

    /// Errors: a body that has left the bearing or whose motion is not finite.
    fn check(
        &self,
        rows: Motion,
        rotation: &Rotation,
        states: &[f64],
        time: f64,
    ) -> Result<(), FreeBallError>;

    /// Balls, cage and rings in a state, for shapes and pictures; `None` for a bearing that could not be prepared.
    fn placed(&self, rows: Motion, rotation: &Rotation, states: &[f64]) -> Option<PlacedBalls<'_>>;

    /// Kinetic energy of the bodies \[J\].
    fn kinetic_energy(&self, states: &[f64]) -> f64;

    /// Work on the bodies and energy lost, since the start.
    fn work(&self, states: &[f64]) -> BodyWork {
        match states {
            [.., given, lost] => BodyWork { given: *given, lost: *lost },
            _ => BodyWork::default(),
        }
    }

    /// Angle of the cage, or mean angle of the balls less their spacing without one, within a turn of 0 \[rad\].
    fn cage_angle(&self, states: &[f64]) -> f64;

    /// Place and motion of every body, the balls before the cage.
    fn poses(&self, states: &[f64]) -> Vec<BodyPose>;

    /// Forces on every ball \[N\]: normal loads of inner and outer race, and that of its pocket along the orbit.
    fn ball_forces(&self, rows: Motion, rotation: &Rotation, states: &[f64]) -> Vec<[f64; 3]>;

    /// Quantities that runs record.
    fn channels(&self) -> &[BodyChannel];

    /// Their values, written to `out` in order.
    fn read(&self, rows: Motion, rotation: &Rotation, states: &[f64], out: &mut [f64]);
}

/// Free balls and cage at a state of a machine.
#[derive(Clone, Debug)]
pub struct PlacedBalls<'a> {
    pub balls: &'a FreeBalls,
    pub state: FreeBallState,
    /// Inner and outer ring.
    pub rings: [RingState; 2],
}

/// Work on free bodies that does not go through the rows, since the start \[J\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyWork {
    /// By the prescribed rotation of the shaft and by gravity.
    pub given: f64,
    /// Lost in friction, damping and drag.
    pub lost: f64,
}

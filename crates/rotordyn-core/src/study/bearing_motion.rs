//! Motion of one bearing with free balls in its steady state, for animations.

use super::free_ball::FreeBallStudyError;
use super::motion::turned;
use crate::document::TO_RPM;
use crate::element::Anchor;
use crate::model::{BearingSite, Model};
use crate::results::{BearingMotion, BodyMotion, FreeBallResult, Motion};
use nalgebra::{Quaternion, UnitQuaternion};
use rotordyn_bearing::free_ball::{CageBody, FreeBallState, FreeBalls, RingState};
use std::f64::consts::TAU;

/// Frames in a turn of the kinematic cage: a ball turns by some 20 degrees from one to the next.
const FRAMES_PER_TURN: usize = 96;

/// The settled motion over turns of the kinematic cage, and a machine of the bearing alone in which it takes place; `None`
/// for a bearing without free balls.
///
/// The bearing runs again from its kinematic start, the inner ring at the displacement that balances the load, for the
/// time in which the study settled.
///
/// # Errors
/// A bearing that does not start or loses a ball.
pub fn bearing_motion(
    model: &Model,
    found: &FreeBallResult,
    turns: usize,
) -> Result<Option<(Model, Motion)>, FreeBallStudyError> {
    let site = model.bearings.iter().find(|site| site.name == found.name);
    let Some((site, free)) = site.and_then(|site| Some((site, site.bearing.free_balls()?))) else {
        return Ok(None);
    };
    let failed = |cause| FreeBallStudyError::FreeBalls {
        bearing: found.name.clone(),
        speed_rpm: found.speed * TO_RPM,
        cause,
    };
    let balls = FreeBalls::new(free.clone(), found.speed).map_err(failed)?;
    let turn = TAU / (found.comparison.kinematic.ftf * found.speed.abs());
    let interval = turn / FRAMES_PER_TURN as f64;
    let rings = |interval_number: usize| {
        let angle = found.speed * interval_number as f64 * interval;
        let inner = RingState { position: found.displacement, ..RingState::rotating(found.speed, angle) };
        [inner, RingState::default()]
    };
    let settled = (found.settling_time / interval).ceil() as usize;
    let mut state = balls.initial_state(&rings(0)).map_err(failed)?;
    let mut frames = Frames::new(&balls, found);
    for k in 0..=settled + turns * FRAMES_PER_TURN {
        if k > 0 {
            let ends = [&rings(k - 1), &rings(k)];
            balls.advance(&mut state, ends, interval, found.step).map_err(failed)?;
        }
        if k >= settled {
            frames.add(&state, &rings(k));
        }
    }
    let alone = Model {
        node_z: vec![0.0],
        shaft: Vec::new(),
        rigid_rotor: None,
        discs: Vec::new(),
        bodies: Vec::new(),
        bearings: vec![BearingSite { node: 0, housing: Anchor::GROUND, ..site.clone() }],
        ..model.clone()
    };
    Ok(Some((alone, frames.motion)))
}

/// Frames of a bearing, with the orientation of its balls.
struct Frames<'a> {
    balls: &'a FreeBalls,
    displacement: Vec<f64>,
    turns: Vec<UnitQuaternion<f64>>,
    motion: Motion,
}

impl<'a> Frames<'a> {
    fn new(balls: &'a FreeBalls, found: &FreeBallResult) -> Self {
        let count = balls.ball_radii().len();
        let bodies = count + usize::from(balls.bearing().cage.is_some());
        let bearing = BearingMotion {
            name: found.name.clone(),
            balls: count,
            bodies: vec![BodyMotion::default(); bodies],
            ..BearingMotion::default()
        };
        let [x, y, z] = found.displacement;
        Self {
            balls,
            displacement: vec![x, y, z, 0.0, 0.0, 0.0],
            turns: vec![UnitQuaternion::identity(); count],
            motion: Motion { bearings: vec![bearing], ..Motion::default() },
        }
    }

    fn add(&mut self, state: &FreeBallState, rings: &[RingState; 2]) {
        let last = self.motion.time.last().copied();
        let step = last.map_or(0.0, |last| state.time - last);
        self.motion.time.push(state.time);
        self.motion.shaft_angle.push(rings[0].angle);
        self.motion.displacement.push(self.displacement.clone());
        let Some(bearing) = self.motion.bearings.first_mut() else { return };
        let reports = self.balls.report(state, rings);
        for (j, (body, report)) in bearing.bodies.iter_mut().zip(&reports).enumerate() {
            let ball = state.ball(j);
            let rotation: [f64; 3] = ball.rotation.into();
            let before = body.rotation.last().copied().unwrap_or(rotation);
            self.turns[j] = turned(&self.turns[j], [before, rotation], step);
            let q = self.turns[j];
            let load = |race: usize| report.races[race].map_or(0.0, |race| race.load);
            body.position.push(ball.position.into());
            body.orientation.push([q.w, q.i, q.j, q.k]);
            body.rotation.push(rotation);
            body.forces.push([load(0), load(1), report.pocket]);
        }
        let cage = state.cage();
        bearing.cage_angle.push(cage.map_or(0.0, |cage| angle(&cage)));
        let inertia = self.balls.bearing().cage;
        if let (Some(cage), Some(body), Some(inertia)) =
            (cage, bearing.bodies.get_mut(reports.len()), inertia)
        {
            let [_, _, axis] = cage.axes();
            let rotation = cage.rotation(&axis, inertia.polar_inertia, inertia.transverse_inertia);
            body.position.push(cage.position.into());
            body.orientation.push(cage.orientation);
            body.rotation.push(rotation.into());
            body.forces.push([0.0; 3]);
        }
    }
}

/// Angle of a cage about z \[rad\].
fn angle(cage: &CageBody) -> f64 {
    let [w, x, y, z] = cage.orientation;
    let across = UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z)) * nalgebra::Vector3::x();
    across.y.atan2(across.x)
}

//! Free balls as a bearing of a machine: quasi-static in statics and linear studies, free bodies in runs.

use std::borrow::Cow;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use super::cage::CageFrame;
use super::forces::LOSSES;
use super::report::BallReport;
use super::ring::{RingFrame, RingState, V};
use super::state::{FreeBallState, ball_at, cage_at, normalise_orientation};
use super::surfaces::ClosedForms;
use super::{FreeBallBearing, FreeBallError, FreeBalls, StableStep, StepShares};
use crate::ball::{BallElement, PreloadState};
use crate::bodies::{BodyChannel, BodyPose, FreeBodies, PlacedBalls};
use crate::internal::Motion;
use crate::model::{BearingElement, BearingModel, BearingSymbol, CageStart};
use crate::{BallBearing, Bearing, BearingContact, Reaction, Rotation};

/// Speed of the shaft \[rad/s\] below which no cage slip is given.
const SLOWEST: f64 = 0.1;
/// Numbers behind those of the bodies: work given and energy lost.
const WORK: usize = 2;

const CHANNELS: [BodyChannel; 10] = [
    BodyChannel { name: Cow::Borrowed("ball_angle"), unit: "rad", quantity: "angle", direction: "balls" },
    BodyChannel { name: Cow::Borrowed("cage_speed"), unit: "rad/s", quantity: "speed", direction: "cage" },
    BodyChannel { name: Cow::Borrowed("cage_slip"), unit: "", quantity: "ratio", direction: "cage" },
    BodyChannel { name: Cow::Borrowed("ball_speed"), unit: "rad/s", quantity: "speed", direction: "balls" },
    BodyChannel {
        name: Cow::Borrowed("ball_pitch_angle"),
        unit: "rad",
        quantity: "angle",
        direction: "balls",
    },
    BodyChannel { name: Cow::Borrowed("cage_x"), unit: "m", quantity: "displacement", direction: "x" },
    BodyChannel { name: Cow::Borrowed("cage_y"), unit: "m", quantity: "displacement", direction: "y" },
    BodyChannel {
        name: Cow::Borrowed("pocket_force"),
        unit: "N",
        quantity: "contact force",
        direction: "cage",
    },
    BodyChannel {
        name: Cow::Borrowed("friction_torque"),
        unit: "N m",
        quantity: "moment",
        direction: "shaft",
    },
    BodyChannel { name: Cow::Borrowed("friction_power"), unit: "W", quantity: "power", direction: "" },
];

/// Name of the channel with the angle of a ball beyond even spacing about the balls' mean angle; balls count from 1.
pub fn ball_offset_name(ball: usize) -> String {
    format!("ball_{}_offset", ball + 1)
}

impl BearingModel for FreeBallBearing {
    fn keyword(&self) -> &'static str {
        "free_ball"
    }

    fn description(&self) -> String {
        match self.cage {
            Some(_) => "free balls and cage".into(),
            None => "free balls, full complement".into(),
        }
    }

    fn element(&self) -> Arc<dyn BearingElement> {
        Arc::new(FreeBallElement::new(self))
    }

    fn supports(&self) -> [bool; 6] {
        self.ball.supports()
    }

    fn depends_on_speed(&self) -> bool {
        self.ball.depends_on_speed()
    }

    fn symbol(&self) -> BearingSymbol<'_> {
        self.ball.symbol()
    }

    fn thrust_directions(&self) -> [bool; 2] {
        self.ball.thrust_directions()
    }

    fn with_rolling_cage(&self) -> Option<Bearing> {
        Some(self.ball.clone().into())
    }

    fn cage(&self) -> Option<CageStart> {
        self.ball.cage()
    }

    fn set_cage_angle(&mut self, angle: f64) {
        self.ball.cage_angle = angle;
    }

    fn ball(&self) -> Option<&BallBearing> {
        Some(&self.ball)
    }

    fn static_balls(&self) -> Option<&BallBearing> {
        Some(&self.ball)
    }

    fn free_balls(&self) -> Option<&FreeBallBearing> {
        Some(self)
    }

    fn static_balls_mut(&mut self) -> Option<&mut BallBearing> {
        Some(&mut self.ball)
    }
}

/// A bearing with free balls prepared for evaluation.
///
/// Statics and linear studies take the quasi-static bearing of the same geometry, to which free balls settle without
/// traction; its six relative degrees of freedom include θ_z, about which friction acts.
#[derive(Clone, Debug)]
pub struct FreeBallElement {
    quasi_static: BallElement,
    bodies: Result<FreeBalls, FreeBallError>,
    channels: Vec<BodyChannel>,
}

impl FreeBallElement {
    /// Prepares a bearing; its clearance is that at standstill.
    pub fn new(bearing: &FreeBallBearing) -> Self {
        let offset = |j: usize| BodyChannel {
            name: ball_offset_name(j).into(),
            unit: "rad",
            quantity: "angle",
            direction: "balls",
        };
        Self {
            quasi_static: BallElement::new(&bearing.ball),
            bodies: FreeBalls::new(bearing.clone(), 0.0),
            channels: CHANNELS.into_iter().chain((0..bearing.ball.geometry.balls).map(offset)).collect(),
        }
    }
}

impl BearingElement for FreeBallElement {
    fn relative_dofs(&self) -> usize {
        6
    }

    fn reaction(&self, d: &[f64; 6], v: &[f64; 6], rotation: &Rotation) -> Reaction {
        self.quasi_static.reaction(d, v, rotation)
    }

    fn force(&self, d: &[f64; 6], v: &[f64; 6], rotation: &Rotation, out: &mut Reaction) {
        self.quasi_static.force(d, v, rotation, out);
    }

    fn cage_average(&self, d: &[f64; 6], rotation: &Rotation, angles: usize) -> Reaction {
        self.quasi_static.cage_average(d, rotation, angles)
    }

    fn contact_loads(&self, d: &[f64; 6], rotation: &Rotation) -> Vec<BearingContact> {
        self.quasi_static.contact_loads(d, rotation)
    }

    fn depends_on_speed(&self) -> bool {
        self.quasi_static.depends_on_speed()
    }

    fn preload_state(&self, speed: f64) -> PreloadState {
        self.quasi_static.preload_state(speed)
    }

    fn rolling_elements(&self) -> usize {
        self.quasi_static.rolling_elements()
    }

    fn cage_ratio(&self, mean_cos: f64) -> f64 {
        self.quasi_static.cage_ratio(mean_cos)
    }

    fn nominal_cos(&self) -> f64 {
        self.quasi_static.nominal_cos()
    }

    fn bodies(&self) -> Option<&dyn FreeBodies> {
        Some(self)
    }
}

/// Inner and outer ring of a bearing whose rows move; the inner ring has the housing's motion and the relative one.
fn rings(rows: Motion, rotation: &Rotation) -> [RingState; 2] {
    let housing = |values: &[f64], k: usize| values.get(6 + k).copied().unwrap_or(0.0);
    let [position, velocity] = [rows.position, rows.velocity];
    let outer = RingState {
        position: std::array::from_fn(|k| housing(position, k)),
        velocity: std::array::from_fn(|k| housing(velocity, k)),
        tilt: std::array::from_fn(|k| housing(position, 3 + k)),
        tilt_rate: std::array::from_fn(|k| housing(velocity, 3 + k)),
        angle: housing(position, 5),
        speed: housing(velocity, 5),
    };
    let inner = RingState {
        position: std::array::from_fn(|k| outer.position[k] + position[k]),
        velocity: std::array::from_fn(|k| outer.velocity[k] + velocity[k]),
        tilt: std::array::from_fn(|k| outer.tilt[k] + position[3 + k]),
        tilt_rate: std::array::from_fn(|k| outer.tilt_rate[k] + velocity[3 + k]),
        angle: outer.angle + rotation.shaft_angle + position[5],
        speed: outer.speed + rotation.shaft_speed + velocity[5],
    };
    [inner, outer]
}

/// An angle plus whole turns, so that it is nearest another \[rad\].
fn near(angle: f64, other: f64) -> f64 {
    angle + ((other - angle) / TAU).round() * TAU
}

impl FreeBallElement {
    /// The free bodies, and the numbers of their state without the work.
    fn parts<'a>(&self, states: &'a [f64]) -> Option<(&FreeBalls, &'a [f64])> {
        let balls = self.bodies.as_ref().ok()?;
        Some((balls, &states[..states.len().checked_sub(WORK)?]))
    }
}

impl FreeBodies for FreeBallElement {
    fn states(&self) -> usize {
        self.bodies.as_ref().map_or(0, |balls| balls.parts.values() + WORK)
    }

    fn start(&self, rows: Motion, rotation: &Rotation) -> Result<Vec<f64>, FreeBallError> {
        let balls = self.bodies.as_ref().map_err(FreeBallError::clone)?;
        let mut values = balls.initial_state(&rings(rows, rotation))?.values;
        values.extend([0.0; WORK]);
        Ok(values)
    }

    fn rates(
        &self,
        rows: Motion,
        rotation: &Rotation,
        states: &[f64],
        rates: &mut [f64],
        on_rows: &mut [f64],
    ) -> Reaction {
        let Some((balls, values)) = self.parts(states) else { return Reaction::default() };
        let frames = rings(rows, rotation).map(|ring| ring.frame());
        let (bodies, work) = rates.split_at_mut(values.len());
        let sums = balls.parts.rates(&ClosedForms, values, &frames, bodies);
        let [inner, outer] = &sums.rings;
        let mut force = [0.0; 6];
        for k in 0..3 {
            (force[k], force[3 + k]) = (inner.force[k], inner.moment[k]);
        }
        on_rows[..6].copy_from_slice(&force);
        if let Some(on_housing) = on_rows.get_mut(6..12) {
            for k in 0..3 {
                on_housing[k] = inner.force[k] + outer.force[k];
                on_housing[3 + k] = inner.moment[k] + outer.moment[k];
            }
        }
        // What the moving rings give beyond the power of the rows: by the rotation of the shaft.
        let through_rows: f64 = on_rows.iter().zip(rows.velocity).map(|(f, v)| f * v).sum();
        let by_rotation = sums.ring_power[0] + sums.ring_power[1] + through_rows;
        work[0] = by_rotation + balls.parts.gravity_power(values);
        work[1] = sums.losses.iter().sum();
        Reaction {
            force,
            elastic_energy: sums.elastic_energy,
            mean_cos: self.quasi_static.nominal_cos(),
            ..Reaction::default()
        }
    }

    fn step(&self, rows: Motion, rotation: &Rotation, states: &[f64]) -> f64 {
        let Some((balls, values)) = self.parts(states) else { return f64::INFINITY };
        let frames = rings(rows, rotation).map(|ring| ring.frame());
        let mut rates = vec![0.0; values.len()];
        StableStep::of(&balls.parts.rates(&ClosedForms, values, &frames, &mut rates))
            .within(StepShares::IN_MACHINE)
    }

    fn normalise(&self, states: &mut [f64]) {
        if let Ok(balls) = &self.bodies {
            let end = states.len().saturating_sub(WORK);
            normalise_orientation(&mut states[..end], balls.parts.balls.len());
        }
    }

    fn check(
        &self,
        rows: Motion,
        rotation: &Rotation,
        states: &[f64],
        time: f64,
    ) -> Result<(), FreeBallError> {
        let Some((balls, values)) = self.parts(states) else { return Ok(()) };
        let frames = rings(rows, rotation).map(|ring| ring.frame());
        let state = FreeBallState { time, values: values.to_vec(), balls: balls.parts.balls.len() };
        balls.parts.check_bodies(&state, &frames)
    }

    fn placed(&self, rows: Motion, rotation: &Rotation, states: &[f64]) -> Option<PlacedBalls<'_>> {
        let (balls, values) = self.parts(states)?;
        let state = FreeBallState { time: 0.0, values: values.to_vec(), balls: balls.parts.balls.len() };
        Some(PlacedBalls { balls, state, rings: rings(rows, rotation) })
    }

    fn kinetic_energy(&self, states: &[f64]) -> f64 {
        self.parts(states).map_or(0.0, |(balls, values)| {
            let energy = balls.parts.energy(values);
            energy.balls + energy.cage
        })
    }

    fn cage_angle(&self, states: &[f64]) -> f64 {
        self.parts(states).map_or(0.0, |(balls, values)| balls.parts.cage_angle(values))
    }

    fn poses(&self, states: &[f64]) -> Vec<BodyPose> {
        let Some((balls, values)) = self.parts(states) else { return Vec::new() };
        let count = balls.parts.balls.len();
        let ball = |j: usize| {
            let ball = ball_at(values, j);
            BodyPose { position: ball.position.into(), orientation: None, rotation: ball.rotation.into() }
        };
        let cage = balls.parts.cage.as_ref().map(|contacts| {
            let frame = CageFrame::new(cage_at(values, count), &contacts.cage);
            BodyPose {
                position: frame.body.position.into(),
                orientation: Some(frame.body.orientation),
                rotation: frame.rotation.into(),
            }
        });
        (0..count).map(ball).chain(cage).collect()
    }

    fn ball_forces(&self, rows: Motion, rotation: &Rotation, states: &[f64]) -> Vec<[f64; 3]> {
        let Some((balls, values)) = self.parts(states) else { return Vec::new() };
        let reports = balls.parts.report(values, &rings(rows, rotation).map(|ring| ring.frame()));
        let load = |ball: &BallReport, race: usize| ball.races[race].map_or(0.0, |race| race.load);
        reports.iter().map(|ball| [load(ball, 0), load(ball, 1), ball.pocket]).collect()
    }

    fn channels(&self) -> &[BodyChannel] {
        &self.channels
    }

    fn read(&self, rows: Motion, rotation: &Rotation, states: &[f64], out: &mut [f64]) {
        out.fill(0.0);
        let Some((balls, values)) = self.parts(states) else { return };
        let frames = rings(rows, rotation).map(|ring| ring.frame());
        let mut rates = vec![0.0; values.len()];
        let sums = balls.parts.rates(&ClosedForms, values, &frames, &mut rates);
        let reports = balls.parts.report(values, &frames);
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len().max(1) as f64;
        let orbital: Vec<f64> = reports.iter().map(|ball| ball.orbital_speed).collect();
        let loaded = reports.iter().filter(|ball| ball.races[0].is_some());
        let pitch: Vec<f64> = loaded.clone().map(|ball| ball.pitch_angle()).collect();
        let cosines: Vec<f64> = loaded.filter_map(|ball| Some(ball.races[0]?.angle.cos())).collect();
        let mean_cos = if cosines.is_empty() { self.quasi_static.nominal_cos() } else { mean(&cosines) };
        let [inner, outer]: &[RingFrame; 2] = &frames;
        let ball_speed = mean(&orbital);
        let (mut cage_speed, mut centre) = (ball_speed, V::zeros());
        if let Some(contacts) = &balls.parts.cage {
            let cage = cage_at(values, reports.len());
            let (polar, transverse) = (contacts.cage.polar_inertia, contacts.cage.transverse_inertia);
            cage_speed =
                (cage.rotation(&cage.axes()[2], polar, transverse) - outer.rotation).dot(&outer.axis);
            centre = cage.position - outer.centre;
        }
        let shaft_speed = (inner.rotation - outer.rotation).dot(&outer.axis);
        let rolling = self.quasi_static.cage_ratio(mean_cos) * shaft_speed;
        let slip = if shaft_speed.abs() > SLOWEST { 1.0 - cage_speed / rolling } else { 0.0 };
        let pocket = reports.iter().map(|ball| ball.pocket.abs()).fold(0.0, f64::max);
        let ball_angle = balls.parts.ball_angle(values);
        let values = [
            near(ball_angle, rotation.cage_angle),
            cage_speed,
            slip,
            ball_speed,
            mean(&pitch),
            centre.x,
            centre.y,
            pocket,
            -sums.rings[0].moment.dot(&inner.axis),
            sums.losses[..LOSSES.len()].iter().sum(),
        ];
        let (first, offsets) = out.split_at_mut(CHANNELS.len());
        first.copy_from_slice(&values);
        let spacing = TAU / reports.len() as f64;
        for (j, (offset, ball)) in offsets.iter_mut().zip(&reports).enumerate() {
            let apart = ball.position - ball_angle - j as f64 * spacing;
            *offset = (apart + PI).rem_euclid(TAU) - PI;
        }
    }
}

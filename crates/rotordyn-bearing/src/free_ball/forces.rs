//! Sum of all forces on balls, cage and rings: the right-hand side of the equations of motion.

use super::cage::{CageContact, CageContacts, CageFrame, ball_contact};
use super::input::{Drag, PointContactLaw};
use super::point_contact::PointForce;
use super::race::{BallMotionState, Groove, RaceForce};
use super::ring::{RingFrame, V, Wrench};
use super::state::{BALL, CAGE, ball_at, cage_at};
use super::surfaces::Distances;
use crate::contact::Race;

/// Ways in which power is lost, in the order of [`LOSSES`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Loss {
    /// Traction in the inner and in the outer race contacts.
    InnerTraction,
    OuterTraction,
    RollingResistance,
    /// Damping of the race contacts.
    ContactDamping,
    /// Friction and damping of balls in their pockets, of the cage on its land, of balls that touch each other.
    Pocket,
    Guidance,
    BallContact,
    /// Drag of the lubricant.
    Drag,
}

/// All ways in which power is lost.
pub const LOSSES: [Loss; 8] = [
    Loss::InnerTraction,
    Loss::OuterTraction,
    Loss::RollingResistance,
    Loss::ContactDamping,
    Loss::Pocket,
    Loss::Guidance,
    Loss::BallContact,
    Loss::Drag,
];

/// Everything constant of a bearing with free balls.
#[derive(Clone, Debug)]
pub(super) struct Parts {
    /// Inner and outer race.
    pub grooves: [Groove; 2],
    /// Radius \[m\], mass \[kg\] and moment of inertia \[kg m²\] of each ball.
    pub balls: Vec<[f64; 3]>,
    pub cage: Option<CageContacts>,
    /// Contact of balls without cage.
    pub ball_contact: PointContactLaw,
    pub drag: Drag,
    pub gravity: V,
}

/// Forces and moments of one evaluation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ForceSums {
    /// Force and moment on inner and outer ring, about their centres.
    pub rings: [Wrench; 2],
    /// Power lost \[W\], in the order of [`LOSSES`].
    pub losses: [f64; LOSSES.len()],
    /// Power that the moving inner and outer ring give to balls and cage \[W\].
    pub ring_power: [f64; 2],
    /// Elastic energy of all contacts \[J\].
    pub elastic_energy: f64,
    /// Bounds of squared frequency \[1/s²\], damping rate and friction rate \[1/s\] of all contacts.
    pub(super) contact_rate: f64,
    pub(super) damping_rate: f64,
    pub(super) friction_rate: f64,
}

/// Rates of one body's contacts: stiffness, damping and friction slope over mass.
#[derive(Clone, Copy, Debug, Default)]
struct Rates([f64; 3]);

impl Rates {
    fn add(&mut self, slopes: &[f64; 3], mobility: f64) {
        self.0.iter_mut().zip(slopes).for_each(|(rate, slope)| *rate += slope * mobility);
    }
}

impl Parts {
    /// Numbers of a state.
    pub fn values(&self) -> usize {
        BALL * self.balls.len() + if self.cage.is_some() { CAGE } else { 0 }
    }

    /// Motion of a ball in a state.
    #[inline(always)]
    pub fn motion(&self, values: &[f64], ball: usize) -> BallMotionState {
        let body = ball_at(values, ball);
        let [radius, ..] = self.balls[ball];
        BallMotionState { position: body.position, velocity: body.velocity, rotation: body.rotation, radius }
    }

    /// Rates of all numbers of the state to `rates`, and the sums.
    pub fn rates<D: Distances>(
        &self,
        distances: &D,
        values: &[f64],
        rings: &[RingFrame; 2],
        rates: &mut [f64],
    ) -> ForceSums {
        let mut sums = ForceSums::default();
        let mut cage_force = Wrench::default();
        let mut cage_rates = Rates::default();
        let mut highest = Rates::default();
        rates.fill(0.0);
        let cage = self
            .cage
            .as_ref()
            .map(|contacts| (contacts, CageFrame::new(cage_at(values, self.balls.len()), &contacts.cage)));
        if cage.is_none() {
            highest = self.ball_contacts(distances, values, rates, &mut sums);
        }
        let mut highest_ball = Rates::default();
        for (j, &[_, mass, inertia]) in self.balls.iter().enumerate() {
            let ball = self.motion(values, j);
            let mut total = Wrench { force: mass * self.gravity, moment: V::zeros() };
            let mut own = Rates::default();
            let mut friction = [0.0; 2];
            let mut rolling = 0.0;
            for (k, ring) in rings.iter().enumerate() {
                let Some(force) = self.grooves[k].react(distances, ring, &ball) else { continue };
                let from_ring = ball.position - ring.centre;
                add_race_force(&mut total, &force);
                take_race_force(&mut sums.rings[k], &force, &from_ring);
                sums.losses[k] += force.traction_power;
                sums.losses[Loss::RollingResistance as usize] += force.rolling_power;
                sums.losses[Loss::ContactDamping as usize] += force.damping_power;
                sums.elastic_energy += force.energy;
                own.add(&[force.slopes[0], force.slopes[1], 0.0], 1.0 / mass);
                friction[k] = force.slopes[2] / mass;
                rolling += force.rolling_slope / inertia;
            }
            own.0[2] = sliding_rate(friction) + rolling;
            if let Some((contacts, frame)) = &cage {
                contacts.pocket(distances, frame, &ball, j, |CageContact { contact, arm }| {
                    let on_ball = arm + frame.body.position - ball.position;
                    total.add(&contact.force, &on_ball);
                    cage_force.add(&-contact.force, &arm);
                    add_point_force(&mut sums, Loss::Pocket, &contact);
                    let [stiffness, damping, friction] = contact.slopes;
                    own.add(&[stiffness, damping, 3.5 * friction], 1.0 / mass);
                    cage_rates.add(&contact.slopes, cage_mobility(contacts, &arm));
                });
            }
            let [force_slope, moment_slope] = self.add_ball_drag(&mut total, &mut sums, &ball, &rings[1]);
            own.0[2] += f64::max(force_slope / mass, moment_slope / inertia);
            for (high, own) in highest_ball.0.iter_mut().zip(own.0) {
                *high = f64::max(*high, own);
            }
            let rate = &mut rates[BALL * j..BALL * (j + 1)];
            let (acceleration, turning) = (total.force / mass, total.moment / inertia);
            for k in 0..3 {
                rate[k] = ball.velocity[k];
                rate[3 + k] += acceleration[k];
                rate[6 + k] += turning[k];
            }
        }
        if let Some((contacts, frame)) = &cage {
            self.add_land(distances, &mut sums, &mut cage_force, &mut cage_rates, contacts, frame, rings);
            let inertia = contacts.cage.polar_inertia.min(contacts.cage.transverse_inertia);
            cage_rates.0[2] += self.drag.cage_moment / inertia;
            let moment = -self.drag.cage_moment * (frame.rotation - rings[1].rotation);
            cage_force.moment += moment;
            sums.rings[1].moment -= moment;
            sums.losses[Loss::Drag as usize] -= moment.dot(&(frame.rotation - rings[1].rotation));
            let rate = &mut rates[BALL * self.balls.len()..];
            let acceleration = cage_force.force / contacts.cage.mass + self.gravity;
            let turning = frame.body.orientation_rate(&frame.rotation);
            for k in 0..3 {
                rate[k] = frame.body.velocity[k];
                rate[3 + k] = acceleration[k];
                rate[10 + k] = cage_force.moment[k];
            }
            rate[6..10].copy_from_slice(&turning);
        }
        for ((power, wrench), ring) in sums.ring_power.iter_mut().zip(&sums.rings).zip(rings) {
            *power = -wrench.force.dot(&ring.velocity) - wrench.moment.dot(&ring.rotation);
        }
        // The sum of the bounds of two coupled bodies bounds the whole (Gershgorin).
        let total = |k: usize| highest.0[k] + highest_ball.0[k] + cage_rates.0[k];
        (sums.contact_rate, sums.damping_rate, sums.friction_rate) = (total(0), total(1), total(2));
        sums
    }

    /// Contacts between neighbouring balls; returns their rates.
    fn ball_contacts<D: Distances>(
        &self,
        distances: &D,
        values: &[f64],
        rates: &mut [f64],
        sums: &mut ForceSums,
    ) -> Rates {
        let mut highest = Rates::default();
        let balls = self.balls.len();
        let pairs = if balls > 2 { balls } else { balls - 1 };
        for first in 0..pairs {
            let second = (first + 1) % balls;
            let motions = [first, second].map(|ball| self.motion(values, ball));
            let Some((contact, arm)) = ball_contact(distances, &self.ball_contact, &motions[0], &motions[1])
            else {
                continue;
            };
            let arms = [arm, arm + motions[0].position - motions[1].position];
            for ((ball, arm), sign) in [first, second].into_iter().zip(arms).zip([1.0, -1.0]) {
                let [_, mass, inertia] = self.balls[ball];
                let force = sign * contact.force;
                let (acceleration, turning) = (force / mass, arm.cross(&force) / inertia);
                for k in 0..3 {
                    rates[BALL * ball + 3 + k] += acceleration[k];
                    rates[BALL * ball + 6 + k] += turning[k];
                }
            }
            add_point_force(sums, Loss::BallContact, &contact);
            // Each ball touches at most two others, and each contact moves two balls.
            let [_, mass, _] = self.balls[first];
            let rate = contact.slopes.map(|slope| 4.0 * slope / mass);
            for (high, rate) in highest.0.iter_mut().zip([rate[0], rate[1], 3.5 * rate[2]]) {
                *high = f64::max(*high, rate);
            }
        }
        highest
    }

    /// Drag of a ball; returns the slopes of its force \[N s/m\] and of its moment \[N m s\].
    fn add_ball_drag(
        &self,
        total: &mut Wrench,
        sums: &mut ForceSums,
        ball: &BallMotionState,
        housing: &RingFrame,
    ) -> [f64; 2] {
        let Drag { density, ball_force, ball_moment, .. } = self.drag;
        if density == 0.0 {
            return [0.0; 2];
        }
        let from_ring = ball.position - housing.centre;
        let velocity = ball.velocity - housing.velocity_at(&from_ring);
        let rotation = ball.rotation - housing.rotation;
        let area = std::f64::consts::PI * ball.radius * ball.radius;
        // Half the slopes: both grow with the square of the speed.
        let over_speed = 0.5 * density * ball_force * area * velocity.norm();
        let over_rotation = 0.5 * density * ball_moment * ball.radius.powi(5) * rotation.norm();
        let (force, moment) = (-over_speed * velocity, -over_rotation * rotation);
        total.force += force;
        total.moment += moment;
        sums.rings[1].add(&-force, &from_ring);
        sums.rings[1].moment -= moment;
        sums.losses[Loss::Drag as usize] -= force.dot(&velocity) + moment.dot(&rotation);
        [2.0 * over_speed, 2.0 * over_rotation]
    }

    #[allow(clippy::too_many_arguments)] // all that a land acts on
    fn add_land<D: Distances>(
        &self,
        distances: &D,
        sums: &mut ForceSums,
        cage_force: &mut Wrench,
        cage_rates: &mut Rates,
        contacts: &CageContacts,
        frame: &CageFrame,
        rings: &[RingFrame; 2],
    ) {
        let Some(land) = contacts.land() else { return };
        let k = if land.race == Race::Inner { 0 } else { 1 };
        contacts.land_contacts(
            distances,
            land,
            frame,
            &rings[k],
            |CageContact { contact, arm }, ring_arm| {
                cage_force.add(&contact.force, &arm);
                sums.rings[k].add(&-contact.force, &ring_arm);
                add_point_force(sums, Loss::Guidance, &contact);
                cage_rates.add(&contact.slopes, cage_mobility(contacts, &arm));
            },
        );
    }
}

fn add_race_force(ball: &mut Wrench, force: &RaceForce) {
    ball.force += force.normal;
    ball.add(&force.friction, &force.arm);
    ball.moment += force.moment;
}

fn take_race_force(ring: &mut Wrench, force: &RaceForce, from_ring: &V) {
    ring.add(&-force.normal, from_ring);
    ring.add(&-force.friction, &(from_ring + force.arm));
    ring.moment -= force.moment;
}

fn add_point_force(sums: &mut ForceSums, loss: Loss, force: &PointForce) {
    sums.losses[loss as usize] += force.power;
    sums.elastic_energy += force.energy;
}

/// Velocity of a contact of the cage per force \[1/kg\], at most.
fn cage_mobility(contacts: &CageContacts, arm: &V) -> f64 {
    let cage = &contacts.cage;
    1.0 / cage.mass + arm.norm_squared() / cage.polar_inertia.min(cage.transverse_inertia)
}

/// Largest decay rate of slip of a ball between two races whose friction over slip and mass is k_i and k_o.
///
/// Largest eigenvalue of ((7/2 k_i, −3/2 k_o), (−3/2 k_i, 7/2 k_o)): a force at one contact accelerates the ball
/// and, by 5/2 of that, turns its surface there, backwards at the other contact. 3.5 k for one race, 5 k for two alike.
fn sliding_rate([inner, outer]: [f64; 2]) -> f64 {
    let sum = 3.5 * (inner + outer);
    0.5 * (sum + (sum * sum - 40.0 * inner * outer).max(0.0).sqrt())
}

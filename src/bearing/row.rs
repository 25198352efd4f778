//! One row of balls between two rings: where every ball stands, and the sum of what they do.

use super::massless;
use super::ring_sum::{PlaneForce, RingSum};
use super::waviness::Waviness;
use super::{BallBearing, BallLoad, Rotation};
use crate::contact::{BallContacts, ContactDamping, SpeedContacts};

/// A row of balls made ready for evaluation: constants and per-ball data laid out as arrays.
#[derive(Clone, Debug)]
pub(super) struct Row {
    pub contacts: BallContacts,
    /// Distance of the groove centres of an unloaded ball A = r_i + r_o − D_w \[m\].
    centre_distance: f64,
    /// Radius of the circle of inner groove centres R_i \[m\].
    arm: f64,
    /// Groove-centre offset of the centred bearing: radial A cos α₀ − P_d/2, axial A sin α₀ \[m\].
    offset: [f64; 2],
    damping: ContactDamping,
    /// Entrainment speed over shaft speed D_pw/4 (1 − γ²) \[m\].
    entrainment: f64,
    /// cos and sin of 2πj/Z.
    spacing: Vec<[f64; 2]>,
    inner_waves: Waviness,
    outer_waves: Waviness,
}

/// What holds for all balls of a row during one evaluation.
#[derive(Clone, Copy, Debug)]
pub(super) struct Operating<'a> {
    pub contacts: SpeedContacts<'a>,
    /// Groove-centre offset with clearance change and preload \[m\].
    pub offset: [f64; 2],
    /// Cage speed that counts as motion of the contacts \[rad/s\]; 0 in statics.
    pub turning: f64,
    /// Whether races are wavy.
    pub waves: bool,
}

/// Where one ball's inner groove centre is, seen from the outer one, in the plane (radial, axial).
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct PlaneMotion {
    /// s \[m\].
    pub s: [f64; 2],
    /// ṡ \[m/s\].
    pub rate: [f64; 2],
    /// Waviness of inner and outer race at the ball, positive towards it \[m\], and its rate \[m/s\].
    pub waves: [f64; 2],
    pub wave_rates: [f64; 2],
}

impl Row {
    pub fn new(bearing: &BallBearing, thrust_direction: f64) -> Self {
        let g = &bearing.geometry;
        let a = g.inner_groove_radius + g.outer_groove_radius - g.ball_diameter;
        let gamma = g.ball_diameter / g.pitch_diameter * g.contact_angle.cos();
        let spacing = (0..g.balls)
            .map(|j| {
                let angle = std::f64::consts::TAU * j as f64 / g.balls as f64;
                [angle.cos(), angle.sin()]
            })
            .collect();
        Self {
            contacts: BallContacts::new(bearing.hertz(), bearing.contact.clone()),
            centre_distance: a,
            arm: g.inner_centre_radius(),
            offset: [
                a * g.contact_angle.cos() - 0.5 * g.radial_clearance,
                a * g.contact_angle.sin() * thrust_direction,
            ],
            damping: bearing.damping,
            entrainment: 0.25 * g.pitch_diameter * (1.0 - gamma * gamma),
            spacing,
            inner_waves: Waviness::new(&bearing.inner_waviness),
            outer_waves: Waviness::new(&bearing.outer_waviness),
        }
    }

    pub fn balls(&self) -> usize {
        self.spacing.len()
    }

    /// What holds for all balls: `turning` is the cage speed that counts as motion.
    pub fn operating(&self, rotation: &Rotation, turning: f64, waves: bool) -> Operating<'_> {
        let speed = self.entrainment * rotation.shaft_speed.abs();
        Operating { contacts: self.contacts.at_speed(speed), offset: self.offset, turning, waves }
    }

    /// Sum over all balls at displacement d and velocity v of the inner ring relative to the outer one.
    pub fn sum(&self, d: &[f64; 6], v: &[f64; 6], rotation: &Rotation, operating: &Operating) -> RingSum {
        let a = self.centre_distance;
        // One loop per law, so that the law is known inside it.
        match operating.contacts {
            dry @ SpeedContacts::Hertz(pair) => self.sum_of(d, v, rotation, operating, |motion| {
                massless::react(|approach| pair.series(approach), &dry, &self.damping, a, motion)
            }),
            law => self.sum_of(d, v, rotation, operating, |motion| {
                massless::react(|approach| law.series(approach), &law, &self.damping, a, motion)
            }),
        }
    }

    #[inline(always)]
    fn sum_of(
        &self,
        d: &[f64; 6],
        v: &[f64; 6],
        rotation: &Rotation,
        operating: &Operating,
        react: impl Fn(&PlaneMotion) -> Option<PlaneForce>,
    ) -> RingSum {
        let mut sum = RingSum::default();
        self.each(d, v, rotation, operating, |[cos, sin], motion, turn| {
            if let Some(mut ball) = react(&motion) {
                // The cage carries the ball past the ring: at a still ring that is power put in.
                ball.power += ball.force[0] * turn[0] + ball.force[1] * turn[1];
                sum.add(cos, sin, &ball);
            }
        });
        sum
    }

    /// Calls `visit` with (cos ψ_j, sin ψ_j), the ball's motion and the part of its rate from the cage's turning.
    #[inline(always)]
    fn each(
        &self,
        d: &[f64; 6],
        v: &[f64; 6],
        rotation: &Rotation,
        operating: &Operating,
        mut visit: impl FnMut([f64; 2], PlaneMotion, [f64; 2]),
    ) {
        let (turned, r) = (operating.turning, self.arm);
        let (cage_sin, cage_cos) = rotation.cage_angle.sin_cos();
        let inner = (operating.waves && !self.inner_waves.is_empty()).then(|| rotation.shaft_angle.sin_cos());
        let outer = operating.waves && !self.outer_waves.is_empty();
        for [cj, sj] in &self.spacing {
            let cos = cage_cos * cj - cage_sin * sj;
            let sin = cage_sin * cj + cage_cos * sj;
            let turn = [turned * (d[1] * cos - d[0] * sin), turned * r * (d[3] * cos + d[4] * sin)];
            let mut motion = PlaneMotion {
                s: [
                    operating.offset[0] + d[0] * cos + d[1] * sin,
                    operating.offset[1] + d[2] + r * (d[3] * sin - d[4] * cos),
                ],
                rate: [v[0] * cos + v[1] * sin + turn[0], v[2] + r * (v[3] * sin - v[4] * cos) + turn[1]],
                ..PlaneMotion::default()
            };
            if let Some((st, ct)) = inner {
                let [w, slope] = self.inner_waves.at(cos * ct + sin * st, sin * ct - cos * st);
                motion.waves[0] = w;
                motion.wave_rates[0] = slope * (rotation.cage_speed - rotation.shaft_speed);
            }
            if outer {
                let [w, slope] = self.outer_waves.at(cos, sin);
                motion.waves[1] = w;
                motion.wave_rates[1] = slope * rotation.cage_speed;
            }
            visit([cos, sin], motion, turn);
        }
    }

    /// Force on the inner ring and tangents from a sum.
    pub fn reaction(&self, sum: &RingSum, operating: &Operating) -> super::Reaction {
        sum.reaction(self.arm, operating.turning)
    }

    /// Every ball under elastic forces alone.
    pub fn ball_loads(&self, d: &[f64; 6], rotation: &Rotation, operating: &Operating) -> Vec<BallLoad> {
        let mut out = Vec::with_capacity(self.balls());
        self.each(d, &[0.0; 6], rotation, operating, |[cos, sin], motion, _| {
            let distance = motion.s[0].hypot(motion.s[1]);
            let deflection = distance - self.centre_distance + motion.waves[0] + motion.waves[1];
            out.push(BallLoad {
                position: sin.atan2(cos),
                load: operating.contacts.series(deflection).load,
                contact_angle: motion.s[1].atan2(motion.s[0]),
                deflection,
            });
        });
        out
    }
}

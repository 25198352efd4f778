//! Force and tangents of a row of dry massless balls, several balls at once (SIMD), for time integration.

use pulp::{Arch, Simd, WithSimd};

use super::ring_motion::RingMotion;
use super::sum::{BallSum, HARMONICS, Harmonics};
use crate::lanes::Lanes;
use crate::{Profile, ProfileState};
use rotordyn_linalg::panel::vector_length;

/// Largest number of balls of a row.
const MAX_BALLS: usize = 32;

/// Kernel of a row of dry massless balls with rigid preload.
#[derive(Clone, Debug)]
pub(super) struct RowKernel {
    /// cos and sin of 2πj/Z, and 1 for a ball, 0 for the padding to whole vectors.
    balls: [Vec<f64>; 3],
    common: KernelParameters,
    arch: Arch,
}

/// Parameters common to all balls.
#[derive(Clone, Copy, Debug)]
pub(super) struct KernelParameters {
    /// Groove-centre offset with preload, radius of the inner groove centres, unloaded distance of the groove
    /// centres \[m\].
    pub offset: [f64; 2],
    pub arm: f64,
    pub centre_distance: f64,
    /// K \[N/m^1.5\].
    pub stiffness: f64,
    /// c \[N s/m\] and its ramp length, above zero \[m\].
    pub damping: [f64; 2],
}

/// Force of a row with energy, powers and load sums, as in a [`crate::Reaction`].
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct RowForce {
    pub force: [f64; 6],
    pub energy: f64,
    pub dissipated: f64,
    pub power: f64,
    pub load: f64,
    pub load_cos: f64,
}

impl RowForce {
    /// Adds a row at an axial offset from the bearing's station, transformed to the station (see
    /// `duplex::displacement_at_offset`).
    pub fn add(&mut self, row: &Self, place: f64) {
        for (sum, f) in self.force.iter_mut().zip(row.force) {
            *sum += f;
        }
        self.force[4] += place * row.force[0];
        self.force[3] -= place * row.force[1];
        self.energy += row.energy;
        self.dissipated += row.dissipated;
        self.power += row.power;
        self.load += row.load;
        self.load_cos += row.load_cos;
    }
}

impl RowKernel {
    /// `spacing`: cos and sin of 2πj/Z of every ball; `None` for more balls than the kernel holds.
    pub fn new(common: KernelParameters, spacing: &[[f64; 2]]) -> Option<Self> {
        let arch = Arch::new();
        let whole = spacing.len().next_multiple_of(vector_length(arch));
        let padded = |value: &dyn Fn(&[f64; 2]) -> f64| {
            let mut out: Vec<f64> = spacing.iter().map(value).collect();
            out.resize(whole, 0.0);
            out
        };
        let balls = [padded(&|ball| ball[0]), padded(&|ball| ball[1]), padded(&|_| 1.0)];
        (whole <= MAX_BALLS).then_some(Self { balls, common, arch })
    }

    /// The force of a row with surface deviations `profile`, whose defects act by displacement.
    pub fn force(&self, ring: &RingMotion, profile: Option<&Profile>) -> RowForce {
        let sum = self.evaluate::<false>(ring, profile);
        let ([[_, x, y, ..], [z, along_cos, along_sin, ..]], arm) = (sum.force, self.common.arm);
        RowForce {
            force: [-x, -y, -z, -arm * along_sin, arm * along_cos, 0.0],
            energy: sum.energy,
            dissipated: sum.dissipated,
            power: sum.power,
            load: sum.load,
            load_cos: sum.load_cos,
        }
    }

    /// Sum of ball forces and tangents of the same row: that of `Row::sum` but for the order of summation and for
    /// harmonics that no reaction needs.
    pub fn sum(&self, ring: &RingMotion, profile: Option<&Profile>) -> BallSum {
        self.evaluate::<true>(ring, profile)
    }

    fn evaluate<const TANGENTS: bool>(&self, ring: &RingMotion, profile: Option<&Profile>) -> BallSum {
        let passing = profile.map(|profile| profile.at_rotation(&ring.passing()));
        let (sin, cos) = ring.rotation.cage_angle.sin_cos();
        let mut sum = BallSum::default();
        self.arch.dispatch(SumOverBalls::<TANGENTS> {
            balls: &self.balls,
            common: &self.common,
            motion: [ring.d, ring.v],
            cage: [cos, sin, ring.cage_speed.unwrap_or(0.0)],
            passing: passing.as_ref(),
            sum: &mut sum,
        });
        sum
    }
}

/// Summation over the balls, compiled for each SIMD instruction set by `pulp`.
struct SumOverBalls<'a, const TANGENTS: bool> {
    balls: &'a [Vec<f64>; 3],
    common: &'a KernelParameters,
    /// Displacement and velocity of the inner ring.
    motion: [&'a [f64; 6]; 2],
    /// cos and sin of the cage angle, and the cage speed.
    cage: [f64; 3],
    passing: Option<&'a ProfileState<'a>>,
    sum: &'a mut BallSum,
}

impl<const TANGENTS: bool> WithSimd for SumOverBalls<'_, TANGENTS> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let mut sums = Sums::new(simd);
        let [cos, sin, present] = self.balls.each_ref().map(|of| S::as_simd_f64s(of).0);
        let balls = cos.iter().zip(sin).zip(present);
        let balls = balls.map(|((c, s), p)| [*c, *s, *p].map(|values| Lanes::new(simd, values)));
        match self.passing {
            None => balls.for_each(|ball| self.add(simd, &mut sums, ball, [Lanes::splat(simd, 0.0); 3])),
            Some(passing) => {
                let others = deviations_apart_from_race_waves(passing);
                let [height, rate, undamped] = others.each_ref().map(|of| S::as_simd_f64s(of).0);
                let others = height.iter().zip(rate).zip(undamped);
                for (ball, ((h, r), u)) in balls.zip(others) {
                    let [height, rate, undamped] = [*h, *r, *u].map(|values| Lanes::new(simd, values));
                    let waves = passing.race_waves(simd, [ball[0], ball[1]]);
                    self.add(simd, &mut sums, ball, [height + waves[0], rate + waves[1], undamped]);
                }
            }
        }
        sums.store::<TANGENTS>(self.sum);
    }
}

/// Of every ball: height, damped rate and undamped rate of its deviations without those by waves of the races.
fn deviations_apart_from_race_waves(passing: &ProfileState) -> [[f64; MAX_BALLS]; 3] {
    let mut out = [[0.0; MAX_BALLS]; 3];
    passing.each_deviating(|ball| {
        let deviation = passing.without_race_waves(ball);
        out[0][ball] = deviation.total();
        out[1][ball] = deviation.rate[0] + deviation.rate[1];
        out[2][ball] = deviation.undamped_rate[0] + deviation.undamped_rate[1];
    });
    out
}

/// Sums over the balls, lane by lane.
struct Sums<S: Simd> {
    /// p_r times cos ψ, sin ψ; p_z times 1, cos ψ, sin ψ.
    radial: [Lanes<S>; 2],
    axial: [Lanes<S>; 3],
    /// Tangents rr, rz, zr, zz and rr, rz, zz as in [`BallSum`].
    by_motion: [[Lanes<S>; HARMONICS]; 4],
    by_rate: [[Lanes<S>; HARMONICS]; 3],
    energy: Lanes<S>,
    dissipated: Lanes<S>,
    power: Lanes<S>,
    load: Lanes<S>,
    load_cos: Lanes<S>,
}

/// First harmonic that a reaction needs of the tangents rr, rz, zr, zz, and rr, rz, zz: radial ones come with cos ψ or sin ψ.
const FIRST_BY_MOTION: [usize; 4] = [3, 1, 1, 0];
const FIRST_BY_RATE: [usize; 3] = [3, 1, 0];

impl<S: Simd> Sums<S> {
    #[inline(always)]
    fn new(simd: S) -> Self {
        let zero = Lanes::splat(simd, 0.0);
        Self {
            radial: [zero; 2],
            axial: [zero; 3],
            by_motion: [[zero; HARMONICS]; 4],
            by_rate: [[zero; HARMONICS]; 3],
            energy: zero,
            dissipated: zero,
            power: zero,
            load: zero,
            load_cos: zero,
        }
    }

    /// Sums over the lanes, to a sum that is zero.
    #[inline(always)]
    fn store<const TANGENTS: bool>(&self, out: &mut BallSum) {
        for (h, sum) in [1, 2].into_iter().zip(self.radial) {
            out.force[0][h] = sum.sum();
        }
        for (h, sum) in self.axial.into_iter().enumerate() {
            out.force[1][h] = sum.sum();
        }
        out.energy = self.energy.sum();
        out.dissipated = self.dissipated.sum();
        out.power = self.power.sum();
        out.load = self.load.sum();
        out.load_cos = self.load_cos.sum();
        if TANGENTS {
            let by_motion = out.by_motion.iter_mut().zip(&self.by_motion).zip(FIRST_BY_MOTION);
            let by_rate = out.by_rate.iter_mut().zip(&self.by_rate).zip(FIRST_BY_RATE);
            by_motion.chain(by_rate).for_each(|((out, sums), first)| store(out, first, sums));
        }
    }
}

#[inline(always)]
fn store<S: Simd>(out: &mut Harmonics, first: usize, sums: &[Lanes<S>; HARMONICS]) {
    for (out, sum) in out.iter_mut().zip(sums).skip(first) {
        *out = sum.sum();
    }
}

/// Adds a tangent times the harmonics from the first one on.
#[inline(always)]
fn add<S: Simd>(
    sums: &mut [Lanes<S>; HARMONICS],
    first: usize,
    tangent: Lanes<S>,
    basis: &[Lanes<S>; HARMONICS],
) {
    for (sum, harmonic) in sums.iter_mut().zip(basis).skip(first) {
        *sum += tangent * *harmonic;
    }
}

impl<const TANGENTS: bool> SumOverBalls<'_, TANGENTS> {
    /// Adds the balls of a vector; the force law of `massless::ball_force`, branch-free.
    ///
    /// Written so that NaN propagates (a diverged state must remain visible).
    #[inline(always)]
    fn add<S: Simd>(
        &self,
        simd: S,
        sums: &mut Sums<S>,
        [ball_cos, ball_sin, present]: [Lanes<S>; 3],
        [height, passing, undamped]: [Lanes<S>; 3],
    ) {
        let ([cage_cos, cage_sin, cage_speed], [d, v], c) = (self.cage, self.motion, self.common);
        let r = c.arm;
        let splat = |value| Lanes::splat(simd, value);
        let cos = ball_cos * cage_cos - ball_sin * cage_sin;
        let sin = ball_cos * cage_sin + ball_sin * cage_cos;
        let turn = [(cos * d[1] - sin * d[0]) * cage_speed, (cos * d[3] + sin * d[4]) * (cage_speed * r)];
        let radial = splat(c.offset[0]) + cos * d[0] + sin * d[1];
        let axial = splat(c.offset[1] + d[2]) + (sin * d[3] - cos * d[4]) * r;
        let radial_rate = cos * v[0] + sin * v[1] + turn[0];
        let axial_rate = splat(v[2]) + (sin * v[3] - cos * v[4]) * r + turn[1];
        let distance = (radial * radial + axial * axial).sqrt();
        let x = (distance - splat(c.centre_distance) + height).positive_part();
        if x.is_zero() {
            return;
        }
        let root = x.sqrt() * c.stiffness;
        // Finite where the groove centres coincide: such a ball carries no load.
        let inverse = splat(1.0) / (distance + splat(1e-300));
        let n = [radial * inverse, axial * inverse];
        let rate = n[0] * radial_rate + n[1] * axial_rate + passing;
        let t = (x * (1.0 / c.damping[1])).at_most_one();
        let damping = t * t * (splat(3.0) - t * 2.0) * c.damping[0];
        let damped = root * x + damping * rate;
        let loaded = present * damped.is_positive();
        let (load, elastic) = (loaded * damped, present * (root * x));
        let force = [load * n[0], load * n[1]];
        for (sum, product) in sums.radial.iter_mut().zip([force[0] * cos, force[0] * sin]) {
            *sum += product;
        }
        for (sum, product) in sums.axial.iter_mut().zip([force[1], force[1] * cos, force[1] * sin]) {
            *sum += product;
        }
        sums.energy += elastic * x * 0.4;
        sums.dissipated += (load - elastic) * rate;
        sums.power += load * passing + elastic * undamped + force[0] * turn[0] + force[1] * turn[1];
        sums.load += load;
        sums.load_cos += force[0];
        if !TANGENTS {
            return;
        }
        let ramp = t * (splat(1.0) - t) * (6.0 * c.damping[0] / c.damping[1]);
        let (slope, by_rate) = (loaded * (root * 1.5 + ramp * rate), loaded * damping);
        let bend = load * inverse;
        let swing = by_rate * (n[0] * axial_rate - n[1] * radial_rate) * inverse;
        let nn = [n[0] * n[0], n[0] * n[1], n[1] * n[1]];
        let both = (slope - bend) * nn[1];
        let by_motion = [
            slope * nn[0] + bend * nn[2] - swing * nn[1],
            both + swing * nn[0],
            both - swing * nn[2],
            slope * nn[2] + bend * nn[0] + swing * nn[1],
        ];
        let basis = [splat(1.0), cos, sin, cos * cos, cos * sin, sin * sin];
        for ((sums, first), tangent) in sums.by_motion.iter_mut().zip(FIRST_BY_MOTION).zip(by_motion) {
            add(sums, first, tangent, &basis);
        }
        for ((sums, first), nn) in sums.by_rate.iter_mut().zip(FIRST_BY_RATE).zip(nn) {
            add(sums, first, by_rate * nn, &basis);
        }
    }
}

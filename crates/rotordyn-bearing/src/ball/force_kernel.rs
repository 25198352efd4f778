//! Force of a row without tangents, vectorised (SIMD), for explicit time integration.

use pulp::{Arch, NullaryFnOnce};

use super::ring_motion::RingMotion;
use crate::{Profile, ProfileState};

/// SIMD lane width: balls evaluated in parallel.
const LANES: usize = 4;
/// Maximum number of lane groups of a row, 32 balls.
const MAX_LANE_GROUPS: usize = 8;

type Lane = [f64; LANES];

/// Force-only kernel of a row of dry massless balls with rigid preload, in SIMD layout.
#[derive(Clone, Debug)]
pub(super) struct ForceKernel {
    /// Balls in groups of [`LANES`]: cos and sin of 2πj/Z, and 1 for a ball, 0 for padding.
    balls: Vec<[Lane; 3]>,
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
    /// c \[N s/m\] and its ramp length \[m\].
    pub damping: [f64; 2],
}

impl ForceKernel {
    /// `spacing`: cos and sin of 2πj/Z of every ball; `None` for more balls than the kernel holds.
    pub fn new(common: KernelParameters, spacing: &[[f64; 2]]) -> Option<Self> {
        let lane = |balls: &[[f64; 2]]| {
            let mut lane = [[0.0; LANES]; 3];
            for (l, [cos, sin]) in balls.iter().enumerate() {
                (lane[0][l], lane[1][l], lane[2][l]) = (*cos, *sin, 1.0);
            }
            lane
        };
        let balls: Vec<_> = spacing.chunks(LANES).map(lane).collect();
        (balls.len() <= MAX_LANE_GROUPS).then(|| Self { balls, common, arch: Arch::new() })
    }
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

/// Sums over the balls, lane by lane.
#[derive(Clone, Copy, Default)]
struct Sums {
    /// Radial force times cos ψ, sin ψ; axial force times 1, sin ψ, cos ψ.
    radial: [Lane; 2],
    axial: [Lane; 3],
    energy: Lane,
    dissipated: Lane,
    power: Lane,
    load: Lane,
    load_cos: Lane,
}

/// Deviations at the balls of a lane group: height, damped rate, undamped rate.
type Deviations = [Lane; 3];

impl ForceKernel {
    /// The force of a row with surface deviations `profile`; `None` if its defects act by the force law.
    ///
    /// Summation order differs from that with tangents, so results agree up to round-off of the largest ball force.
    pub fn force(&self, ring: &RingMotion, profile: Option<&Profile>) -> Option<RowForce> {
        let deviations = match profile {
            None => None,
            Some(profile) if profile.force_law().is_some() => return None,
            Some(profile) => Some(deviations(&profile.at_rotation(&ring.passing()))),
        };
        let (sin, cos) = ring.rotation.cage_angle.sin_cos();
        let mut sums = Sums::default();
        self.arch.dispatch(SimdSum {
            lanes: &self.balls,
            common: &self.common,
            motion: [ring.d, ring.v],
            cage: [cos, sin, ring.cage_speed.unwrap_or(0.0)],
            deviations: deviations.as_ref(),
            sums: &mut sums,
        });
        Some(sums.total(self.common.arm))
    }
}

/// Summation over the balls, compiled for each SIMD instruction set by `pulp` (a closure would not be inlined
/// into that code).
struct SimdSum<'a> {
    lanes: &'a [[Lane; 3]],
    common: &'a KernelParameters,
    /// Displacement and velocity of the inner ring.
    motion: [&'a [f64; 6]; 2],
    /// cos and sin of the cage angle, and the cage speed.
    cage: [f64; 3],
    deviations: Option<&'a [Deviations; MAX_LANE_GROUPS]>,
    sums: &'a mut Sums,
}

impl NullaryFnOnce for SimdSum<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let mut sums = Sums::default();
        match self.deviations {
            None => {
                for lane in self.lanes {
                    self.add(&mut sums, lane, &[[0.0; LANES]; 3]);
                }
            }
            Some(deviations) => {
                for (lane, deviation) in self.lanes.iter().zip(deviations) {
                    self.add(&mut sums, lane, deviation);
                }
            }
        }
        *self.sums = sums;
    }
}

/// Deviations at the balls, lane by lane.
fn deviations(passing: &ProfileState) -> [Deviations; MAX_LANE_GROUPS] {
    let mut out = [[[0.0; LANES]; 3]; MAX_LANE_GROUPS];
    passing.each_deviating(|ball| {
        let deviation = passing.ball(ball);
        let (lane, l) = (&mut out[ball / LANES], ball % LANES);
        lane[0][l] = deviation.total();
        lane[1][l] = deviation.rate[0] + deviation.rate[1];
        lane[2][l] = deviation.undamped_rate[0] + deviation.undamped_rate[1];
    });
    out
}

impl SimdSum<'_> {
    /// Adds the balls of a lane group; the force law of `massless::react`, branch-free.
    #[inline(always)]
    fn add(&self, sums: &mut Sums, [ball_cos, ball_sin, present]: &[Lane; 3], deviation: &Deviations) {
        let ([cage_cos, cage_sin, cage_speed], [d, v], c) = (self.cage, self.motion, self.common);
        let r = c.arm;
        for l in 0..LANES {
            let cos = cage_cos * ball_cos[l] - cage_sin * ball_sin[l];
            let sin = cage_sin * ball_cos[l] + cage_cos * ball_sin[l];
            let turn = [cage_speed * (d[1] * cos - d[0] * sin), cage_speed * r * (d[3] * cos + d[4] * sin)];
            let radial = c.offset[0] + d[0] * cos + d[1] * sin;
            let axial = c.offset[1] + d[2] + r * (d[3] * sin - d[4] * cos);
            let radial_rate = v[0] * cos + v[1] * sin + turn[0];
            let axial_rate = v[2] + r * (v[3] * sin - v[4] * cos) + turn[1];
            let [height, passing, undamped] = [deviation[0][l], deviation[1][l], deviation[2][l]];
            let distance = (radial * radial + axial * axial).sqrt();
            let approach = distance - c.centre_distance + height;
            // Written so that NaN propagates (a diverged state must remain visible).
            let x = if approach <= 0.0 { 0.0 } else { approach };
            let elastic = c.stiffness * x.sqrt() * x;
            let inverse = 1.0 / distance;
            let n = [radial * inverse, axial * inverse];
            let rate = n[0] * radial_rate + n[1] * axial_rate + passing;
            let t = if x >= c.damping[1] { 1.0 } else { x / c.damping[1] };
            let damped = elastic + c.damping[0] * (t * t * (3.0 - 2.0 * t)) * rate;
            let load = present[l] * if damped <= 0.0 { 0.0 } else { damped };
            let elastic = present[l] * elastic;
            let force = [load * n[0], load * n[1]];
            sums.radial[0][l] += force[0] * cos;
            sums.radial[1][l] += force[0] * sin;
            sums.axial[0][l] += force[1];
            sums.axial[1][l] += force[1] * sin;
            sums.axial[2][l] += force[1] * cos;
            sums.energy[l] += 0.4 * elastic * x;
            sums.dissipated[l] += (load - elastic) * rate;
            sums.power[l] += load * passing + elastic * undamped + force[0] * turn[0] + force[1] * turn[1];
            sums.load[l] += load;
            sums.load_cos[l] += force[0];
        }
    }
}

impl Sums {
    fn total(&self, arm: f64) -> RowForce {
        let sum = |lane: &Lane| lane.iter().sum::<f64>();
        let [x, y] = [sum(&self.radial[0]), sum(&self.radial[1])];
        let [z, about_x, about_y] = [sum(&self.axial[0]), sum(&self.axial[1]), sum(&self.axial[2])];
        RowForce {
            force: [-x, -y, -z, -arm * about_x, arm * about_y, 0.0],
            energy: sum(&self.energy),
            dissipated: sum(&self.dissipated),
            power: sum(&self.power),
            load: sum(&self.load),
            load_cos: sum(&self.load_cos),
        }
    }
}

//! A row's force alone, without tangents: what an explicit step asks for.

use pulp::Arch;

use super::preload::Seat;
use super::row::Row;
use super::{Passing, Rotation};
use crate::contact::{ContactDamping, SpeedContacts};

/// Balls evaluated side by side.
const LANES: usize = 4;
/// Most lanes of a row with deviations, 32 balls.
const MOST: usize = 8;

type Lane = [f64; LANES];

/// The balls of a row, some at a time: cos and sin of 2πj/Z, and 1 where there is a ball.
#[derive(Clone, Debug)]
pub(super) struct Lanes {
    balls: Vec<[Lane; 3]>,
    arch: Arch,
}

impl Lanes {
    pub fn new(spacing: &[[f64; 2]]) -> Self {
        let lane = |balls: &[[f64; 2]]| {
            let mut lane = [[0.0; LANES]; 3];
            for (l, [cos, sin]) in balls.iter().enumerate() {
                (lane[0][l], lane[1][l], lane[2][l]) = (*cos, *sin, 1.0);
            }
            lane
        };
        Self { balls: spacing.chunks(LANES).map(lane).collect(), arch: Arch::new() }
    }
}

/// Force of a row with what goes with it, as in a [`super::Reaction`].
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
    /// Adds a row at an axial place from the bearing's station, as seen there (see `duplex::motion_at`).
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

/// What all balls share.
struct Common<'a> {
    d: &'a [f64; 6],
    v: &'a [f64; 6],
    /// cos and sin of the cage angle, and the cage's speed.
    cage: [f64; 3],
    offset: [f64; 2],
    arm: f64,
    centre_distance: f64,
    stiffness: f64,
    /// c and the length of its rise.
    damping: [f64; 2],
}

/// Deviations at the balls of a lane: height, damped rate, undamped rate.
type Deviations = [Lane; 3];

impl Row {
    /// The force of [`Row::react`] on dry massless balls between rigid rings; `None` where there is more to it.
    ///
    /// The same sum in another order, so the same up to round-off of the largest ball force.
    pub fn force(&self, d: &[f64; 6], v: &[f64; 6], rotation: &Rotation) -> Option<RowForce> {
        let (ContactDamping::Constant { coefficient, ramp }, Seat::Fixed(_)) = (self.damping, self.seat)
        else {
            return None;
        };
        let operating = self.operating(rotation, rotation.cage_speed, true);
        if self.inertia.is_some() || self.force_law(&operating).is_some() {
            return None;
        }
        let SpeedContacts::Hertz(pair) = operating.contacts else { return None };
        let (sin, cos) = rotation.cage_angle.sin_cos();
        let common = Common {
            d,
            v,
            cage: [cos, sin, rotation.cage_speed],
            offset: operating.offset,
            arm: self.arm,
            centre_distance: self.centre_distance,
            stiffness: pair.stiffness,
            damping: [coefficient, ramp],
        };
        let mut sums = Sums::default();
        let passing = self.passing(rotation, &operating);
        match &passing {
            Some(_) if self.lanes.balls.len() > MOST => return None,
            None => self.lanes.arch.dispatch(
                #[inline(always)]
                || {
                    for lane in &self.lanes.balls {
                        add(&mut sums, &common, lane, &[[0.0; LANES]; 3]);
                    }
                },
            ),
            Some(passing) => {
                let deviations = deviations(passing);
                self.lanes.arch.dispatch(
                    #[inline(always)]
                    || {
                        for (lane, deviation) in self.lanes.balls.iter().zip(&deviations) {
                            add(&mut sums, &common, lane, deviation);
                        }
                    },
                );
            }
        }
        Some(sums.total(self.arm))
    }
}

/// Deviations at the balls, lane by lane.
fn deviations(passing: &Passing) -> [Deviations; MOST] {
    let mut out = [[[0.0; LANES]; 3]; MOST];
    passing.each_deviating(|ball| {
        let deviation = passing.ball(ball);
        let (lane, l) = (&mut out[ball / LANES], ball % LANES);
        lane[0][l] = deviation.total();
        lane[1][l] = deviation.rate[0] + deviation.rate[1];
        lane[2][l] = deviation.undamped_rate[0] + deviation.undamped_rate[1];
    });
    out
}

/// Adds the balls of a lane; the law of `massless::react`, without branches.
#[inline(always)]
fn add(sums: &mut Sums, c: &Common, [ball_cos, ball_sin, present]: &[Lane; 3], deviation: &Deviations) {
    let ([cage_cos, cage_sin, turned], r) = (c.cage, c.arm);
    for l in 0..LANES {
        let cos = cage_cos * ball_cos[l] - cage_sin * ball_sin[l];
        let sin = cage_sin * ball_cos[l] + cage_cos * ball_sin[l];
        let turn = [turned * (c.d[1] * cos - c.d[0] * sin), turned * r * (c.d[3] * cos + c.d[4] * sin)];
        let radial = c.offset[0] + c.d[0] * cos + c.d[1] * sin;
        let axial = c.offset[1] + c.d[2] + r * (c.d[3] * sin - c.d[4] * cos);
        let radial_rate = c.v[0] * cos + c.v[1] * sin + turn[0];
        let axial_rate = c.v[2] + r * (c.v[3] * sin - c.v[4] * cos) + turn[1];
        let [height, passing, undamped] = [deviation[0][l], deviation[1][l], deviation[2][l]];
        let distance = (radial * radial + axial * axial).sqrt();
        let approach = distance - c.centre_distance + height;
        // A state that is none any more must show: NaN is not "not positive".
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

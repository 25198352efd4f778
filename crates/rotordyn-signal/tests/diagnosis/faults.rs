//! Bearings, and the impacts of a damaged part.

use std::f64::consts::{PI, TAU};

use rotordyn_signal::bearing_lines::{BearingPart, DefectFrequencies};

use super::clock::Clock;
use super::path::{TransferPath, arrivals};
use super::random::Random;

/// A bearing at a speed: 8 to 60 rev/s, 6 to 16 balls, D cos α/D_pw from 0.1 to 0.3.
pub fn draw_bearing(random: &mut Random) -> (DefectFrequencies, usize) {
    let shaft = random.log_range(8.0, 60.0);
    let balls = random.integer(6, 16);
    // The balls must find room on the pitch circle.
    let ratio = random.range(0.1, (0.9 * PI / balls as f64).min(0.3));
    let z = balls as f64;
    let rates = DefectFrequencies {
        shaft,
        cage: 0.5 * shaft * (1.0 - ratio),
        outer: 0.5 * z * shaft * (1.0 - ratio),
        inner: 0.5 * z * shaft * (1.0 + ratio),
        ball: 0.5 * shaft / ratio * (1.0 - ratio * ratio),
    };
    (rates, balls)
}

/// Load over the angle from the load's direction, (1 − (1 − cos φ)/2ε)^1.5, 0 outside the load zone (Stribeck).
fn load(angle: f64, extent: f64) -> f64 {
    (1.0 - (1.0 - angle.cos()) / (2.0 * extent)).max(0.0).powf(1.5)
}

/// Places of the defects of a race over the ball spacing, and how hard each is struck.
fn draw_defects(random: &mut Random, balls: usize) -> Vec<(f64, f64)> {
    if !random.chance(0.15) {
        return vec![(0.0, 1.0)];
    }
    let count = random.integer(2, 8);
    // 3 to 15 degrees apart.
    let pitch = random.range(3.0, 15.0) * balls as f64 / 360.0;
    let even = random.chance(0.5);
    let defect = |k: usize| {
        let (shift, share) = (random.range(-0.4, 0.4), random.range(0.3, 1.0));
        if even { (k as f64 * pitch, 1.0) } else { ((k as f64 + shift) * pitch, share) }
    };
    (0..count).map(defect).collect()
}

/// How varied the faults of a set are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Variety {
    /// One defect, slip, jitter, load zone; no modulation by unbalance or unequal balls.
    Basic,
    /// As [`fault`] describes.
    Full,
}

/// Response to the impacts of one damaged part.
///
/// The cage slips by up to 2 % of its speed in either direction, which moves BPFO = Z FTF and
/// BPFI = Z (f_r − FTF) together; the ball's spin has its own 2 %. Intervals jitter by up to 2 %, strengths
/// by 20 %. A defect of the inner race passes the load zone with the shaft, one of a ball with the cage; a
/// ball strikes both races in turn, not equally hard. Unbalance and misalignment modulate the impacts of any part
/// by 1x, 2x and 3x, in a third of the records strongly, unequal balls by the cage. One record in five has
/// impacts as regular as a simulated machine's: no jitter, all equally hard. One damaged race in seven has several
/// defects, evenly spaced or not: every ball strikes all of them. `clock`: of the machine.
pub fn fault(
    random: &mut Random,
    part: BearingPart,
    rates: &DefectFrequencies,
    balls: usize,
    clock: &Clock,
    variety: Variety,
) -> Vec<f64> {
    let basic = variety == Variety::Basic;
    let slip = 0.02 * random.unit() * random.sign();
    let spin_slip = 0.02 * random.unit() * random.sign();
    let regular = random.chance(0.2) && !basic;
    let jitter = if regular { 0.0 } else { 0.02 * random.unit() };
    let extent = random.range(0.3, 1.5);
    let cage = rates.cage * (1.0 + slip);
    let rate = match part {
        BearingPart::OuterRace => balls as f64 * cage,
        BearingPart::InnerRace => balls as f64 * (rates.shaft - cage),
        BearingPart::Ball => 2.0 * rates.ball * (1.0 + spin_slip),
        BearingPart::Cage => cage,
    };
    let start = random.phase();
    let limit = match random.chance(0.35) {
        _ if basic => 0.0,
        true => 0.9,
        false => 0.2,
    };
    let by_shaft = [1.0, 2.0, 3.0].map(|n| (n, random.range(0.0, limit) / n, random.phase()));
    let (by_cage, cage_phase) =
        (if random.chance(0.2) && !basic { 0.3 * random.unit() } else { 0.0 }, random.phase());
    let machine = |time: f64| {
        let wave = |(n, depth, phase): &(f64, f64, f64)| depth * (n * TAU * rates.shaft * time + phase).cos();
        let shaft = (1.0 + by_shaft.iter().map(wave).sum::<f64>()).max(0.0);
        shaft * (1.0 + by_cage * (TAU * cage * time + cage_phase).cos())
    };
    let other_race = random.range(0.6, 1.0);
    let path = TransferPath::draw(random);
    let strength = |k: usize, time: f64| match part {
        BearingPart::InnerRace => load(TAU * rates.shaft * time + start, extent),
        BearingPart::Ball => {
            load(TAU * cage * time + start, extent) * if k.is_multiple_of(2) { 1.0 } else { other_race }
        }
        BearingPart::OuterRace | BearingPart::Cage => 1.0,
    };
    let spread = if regular { 0.0 } else { 0.2 };
    let defects = match part {
        BearingPart::OuterRace | BearingPart::InnerRace if !basic => draw_defects(random, balls),
        _ => vec![(0.0, 1.0)],
    };
    let times = arrivals(random, rate, jitter);
    let mut impacts = Vec::new();
    for (k, passage) in times.iter().enumerate() {
        for (place, share) in &defects {
            let time = passage + place / rate;
            let level = share * (1.0 + spread * random.normal());
            impacts.push((time, machine(time) * strength(k, time) * level));
        }
    }
    impacts.sort_by(|a, b| a.0.total_cmp(&b.0));
    path.impacts(&impacts, clock)
}

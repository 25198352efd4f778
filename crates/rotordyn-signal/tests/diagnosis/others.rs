//! Sources that are no bearing fault.

use std::f64::consts::TAU;

use super::clock::Clock;
use super::path::{TransferPath, arrivals, coloured, machine_tones, scaled_to, sum, tones, white};
use super::random::Random;
use super::{RATE, SECONDS};

/// What vibrates without a bearing fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Other {
    White,
    Coloured,
    Sine,
    GearMesh,
    BrokenTooth,
    ForeignImpacts,
    ModulatedImpacts,
    ShaftImpacts,
    RandomImpacts,
    Mains,
    CyclicNoise,
    Rub,
    Blades,
}

impl Other {
    pub const ALL: [Other; 13] = [
        Other::White,
        Other::Coloured,
        Other::Sine,
        Other::GearMesh,
        Other::BrokenTooth,
        Other::ForeignImpacts,
        Other::ModulatedImpacts,
        Other::ShaftImpacts,
        Other::RandomImpacts,
        Other::Mains,
        Other::CyclicNoise,
        Other::Rub,
        Other::Blades,
    ];

    /// The record, and the rates \[Hz\] at which it repeats; mains, sines and foreign machines know no `clock`.
    pub fn draw(self, random: &mut Random, shaft: f64, clock: &Clock) -> (Vec<f64>, Vec<f64>) {
        match self {
            Other::White => (white(random), vec![]),
            Other::Coloured => (coloured(random), vec![]),
            Other::Sine => sines(random),
            Other::GearMesh => gears(random, shaft, clock),
            Other::BrokenTooth => broken_tooth(random, shaft, clock),
            Other::ForeignImpacts => {
                let (rate, jitter) = (random.log_range(2.0, 300.0), draw_jitter(random));
                (train(random, rate, jitter, &Clock::STEADY, |_| 1.0), vec![rate])
            }
            Other::ModulatedImpacts => {
                let (rate, jitter) = (random.log_range(10.0, 300.0), draw_jitter(random));
                let by = rate / random.range(2.2, 12.0);
                let (depth, phase) = (random.range(0.2, 0.95), random.phase());
                let record = train(random, rate, jitter, &Clock::STEADY, |t| {
                    1.0 + depth * (TAU * by * t + phase).cos()
                });
                (record, vec![rate, by])
            }
            Other::ShaftImpacts => {
                let per_turn = random.integer(1, 3) as f64;
                (train(random, per_turn * shaft, 0.001, clock, |_| 1.0), vec![shaft])
            }
            Other::RandomImpacts => {
                let mut time = 0.0;
                let mut impacts = Vec::new();
                let rate = random.log_range(1.0, 60.0);
                while time < SECONDS {
                    impacts.push((time, random.normal()));
                    time -= (1.0 - random.unit()).ln() / rate;
                }
                (TransferPath::draw(random).impacts(&impacts, &Clock::STEADY), vec![])
            }
            Other::Mains => mains(random),
            Other::CyclicNoise => {
                let rate = if random.chance(0.4) {
                    shaft * random.integer(1, 4) as f64
                } else {
                    random.log_range(2.0, 200.0)
                };
                let (depth, sharpness) = (random.range(0.3, 1.0), random.range(0.5, 3.0));
                (
                    modulated_noise(random, clock, |t| {
                        (1.0 + depth * (TAU * rate * t).cos()).powf(sharpness)
                    }),
                    vec![rate],
                )
            }
            Other::Rub => {
                // Contact over part of each revolution.
                let (part, phase) = (random.range(0.05, 0.3), random.unit());
                let on = |t: f64| if (shaft * t + phase).fract() < part { 1.0 } else { 0.1 };
                (modulated_noise(random, clock, on), vec![shaft])
            }
            Other::Blades => {
                let blades = random.integer(3, 9) as f64 * shaft;
                let depth = random.range(0.2, 0.9);
                let by_shaft = random.range(0.0, 0.3);
                let noise = modulated_noise(random, clock, |t| {
                    1.0 + depth * (TAU * blades * t).cos() + by_shaft * (TAU * shaft * t).cos()
                });
                let lines: Vec<_> =
                    (1..=4).map(|n| (f64::from(n) * blades, 0.5f64.powi(n), random.phase())).collect();
                (sum(&scaled_to(noise, 1.0), &machine_tones(&lines, clock), 1.0), vec![shaft])
            }
        }
    }
}

/// Half of the sources are locked to a machine, half wander.
fn draw_jitter(random: &mut Random) -> f64 {
    if random.chance(0.5) { 0.0 } else { 0.02 * random.unit() }
}

fn train(
    random: &mut Random,
    rate: f64,
    jitter: f64,
    clock: &Clock,
    strength: impl Fn(f64) -> f64,
) -> Vec<f64> {
    let path = TransferPath::draw(random);
    let spread = random.range(0.0, 0.2);
    let impacts: Vec<(f64, f64)> = arrivals(random, rate, jitter)
        .into_iter()
        .map(|time| (time, strength(time) * (1.0 + spread * random.normal())))
        .collect();
    path.impacts(&impacts, clock)
}

fn modulated_noise(random: &mut Random, clock: &Clock, gain: impl Fn(f64) -> f64) -> Vec<f64> {
    let mut force = white(random);
    force.iter_mut().enumerate().for_each(|(n, f)| *f *= gain(clock.machine(n as f64 / RATE)));
    if random.chance(0.5) { force } else { TransferPath::draw(random).force(&force) }
}

fn sines(random: &mut Random) -> (Vec<f64>, Vec<f64>) {
    let count = random.integer(1, 5);
    let lines: Vec<_> =
        (0..count).map(|_| (random.log_range(5.0, 5500.0), random.range(0.3, 1.0), random.phase())).collect();
    // Pairs of tones in one band beat at their difference.
    let mut beats = Vec::new();
    for (k, a) in lines.iter().enumerate() {
        beats.extend(lines[..k].iter().map(|b| (a.0 - b.0).abs()));
    }
    (tones(&lines), beats)
}

/// Mesh of a pair of gears, amplitude and phase modulated by both shafts.
fn gears(random: &mut Random, shaft: f64, clock: &Clock) -> (Vec<f64>, Vec<f64>) {
    let (teeth, other_teeth) = (random.integer(17, 60) as f64, random.integer(17, 90) as f64);
    let other = shaft * teeth / other_teeth;
    let mut draw = |limit: f64| (random.range(0.0, limit), random.phase());
    let [(a1, p1), (a2, p2), (b1, q1), (b2, q2)] = [draw(0.6), draw(0.6), draw(0.5), draw(0.5)];
    let phases: Vec<f64> = (0..3).map(|_| random.phase()).collect();
    let record = (0..super::SAMPLES)
        .map(|n| {
            let t = clock.machine(n as f64 / RATE);
            let (own, pair) = (TAU * shaft * t, TAU * other * t);
            let amplitude = 1.0 + a1 * (own + p1).cos() + a2 * (pair + p2).cos();
            let phase = b1 * (own + q1).sin() + b2 * (pair + q2).sin();
            let harmonic = |k: usize| {
                let order = (k + 1) as f64;
                let inside = order * teeth * shaft * (1.0 + 0.5 * clock.change.abs()) < 0.45 * RATE;
                if inside {
                    0.6f64.powi(k as i32) * (order * (teeth * own + phase) + phases[k]).cos()
                } else {
                    0.0
                }
            };
            amplitude * (0..3).map(harmonic).sum::<f64>()
        })
        .collect();
    (record, vec![shaft, other])
}

/// A gear pair with one impact per revolution of one of its shafts.
fn broken_tooth(random: &mut Random, shaft: f64, clock: &Clock) -> (Vec<f64>, Vec<f64>) {
    let (mesh, rates) = gears(random, shaft, clock);
    let rate = rates[random.integer(0, 1)];
    let impacts = train(random, rate, 0.0, clock, |_| 1.0);
    let share = random.range(0.3, 2.0);
    (sum(&scaled_to(mesh, 1.0), &scaled_to(impacts, 1.0), share), rates)
}

/// Harmonics of the mains, and noise that its doubled frequency modulates.
fn mains(random: &mut Random) -> (Vec<f64>, Vec<f64>) {
    let base = if random.chance(0.5) { 50.0 } else { 60.0 };
    let lines: Vec<_> = (1..=12)
        .map(|n| (f64::from(n) * base, random.range(0.0, 1.0) / f64::from(n), random.phase()))
        .collect();
    let depth = random.range(0.0, 0.9);
    let noise = modulated_noise(random, &Clock::STEADY, |t| 1.0 + depth * (TAU * 2.0 * base * t).cos());
    let share = random.range(0.1, 1.0);
    (sum(&tones(&lines), &scaled_to(noise, 1.0), share), vec![base])
}

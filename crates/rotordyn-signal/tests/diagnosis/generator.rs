//! Seeded records: half with a damaged part, half with none.

use rotordyn_signal::bearing_lines::{BearingPart, DefectFrequencies};

use super::clock::Clock;
use super::faults::{Variety, draw_bearing, fault};
use super::others::Other;
use super::path::{coloured, machine_tones, power, scaled_to, sum, white};
use super::random::Random;
use super::{RATE, SECONDS};

/// A record and what it holds.
pub struct Generated {
    pub record: Vec<f64>,
    /// Catalogue rates at the true speed.
    pub rates: DefectFrequencies,
    pub part: Option<BearingPart>,
    /// Source without a fault; for faults, what stands in the background.
    pub other: Option<Other>,
    /// Power of the fault, or of the other source, over all else \[dB\].
    pub snr: f64,
    /// Repetition rates of the other source \[Hz\].
    pub rivals: Vec<f64>,
    pub clock: Clock,
}

/// Share of the faulty records with next to no noise, as simulations give them.
const CLEAN: f64 = 0.12;
/// Share of the records whose speed varies.
const VARYING: f64 = 0.08;
/// Share of the records that are shorter than the others.
const SHORT: f64 = 0.2;

/// Sequence of the draws of the speed.
const SPEED_SEED: u64 = 0x5EED;

/// Lines of the shaft, and noise.
fn machine(random: &mut Random, shaft: f64, clock: &Clock) -> Vec<f64> {
    let noise = if random.chance(0.5) { white(random) } else { coloured(random) };
    let noise = scaled_to(noise, 1.0);
    if random.chance(0.4) {
        return noise;
    }
    sum(&noise, &shaft_lines(random, shaft, clock), 1.0)
}

/// 1x to 6x, of falling level.
fn shaft_lines(random: &mut Random, shaft: f64, clock: &Clock) -> Vec<f64> {
    let level = random.log_range(0.01, 0.7);
    let lines: Vec<_> = (1..=6)
        .map(|n| (f64::from(n) * shaft, level * random.unit() / f64::from(n), random.phase()))
        .collect();
    machine_tones(&lines, clock)
}

impl Generated {
    /// Record `number` of the set `seed`: even numbers are faulty, the part by turns.
    pub fn new(seed: u64, number: usize) -> Self {
        let faulty = number.is_multiple_of(2);
        let part = BearingPart::ALL[number / 2 % 4];
        let speed = &mut Random::of_record(seed ^ SPEED_SEED, number);
        let clock = if speed.chance(VARYING) { Clock::draw(speed) } else { Clock::STEADY };
        let other = Other::ALL[number / 2 % Other::ALL.len()];
        let mut made = if faulty {
            Self::faulty(seed, number, part, clock)
        } else {
            Self::healthy(seed, number, other, clock)
        };
        let random = &mut Random::of_record(!seed, number);
        if random.chance(SHORT) {
            // Twelve turns of the cage at least.
            let seconds = random.range(1.0, SECONDS).max(12.0 / made.rates.cage).min(SECONDS);
            made.record.truncate((seconds * RATE) as usize);
        }
        made
    }

    /// A fault under plain conditions, the part by turns as in [`Self::new`], `number` even: 5 s at constant speed, one
    /// defect with slip, jitter and load zone in front of noise and shaft lines. `snr`: over them \[dB\].
    pub fn basic(seed: u64, number: usize, snr: f64) -> Self {
        let random = &mut Random::of_record(seed, number);
        let (rates, balls) = draw_bearing(random);
        // A draw for the SNR, as where it is not given.
        random.unit();
        let clock = Clock::STEADY;
        let background = machine(random, rates.shaft, &clock);
        let part = BearingPart::ALL[number / 2 % 4];
        let signal = fault(random, part, &rates, balls, &clock, Variety::Basic);
        let signal = scaled_to(signal, power(&background) * 10f64.powf(0.1 * snr));
        let record = sum(&background, &signal, 1.0);
        Generated { record, rates, part: Some(part), other: None, snr, rivals: vec![], clock }
    }

    /// Duration \[s\].
    pub fn seconds(&self) -> f64 {
        self.record.len() as f64 / RATE
    }

    /// A fault of `part` at −20 to 10 dB in front of a machine; one in eight 30 to 80 dB over its noise.
    pub fn faulty(seed: u64, number: usize, part: BearingPart, clock: Clock) -> Self {
        let random = &mut Random::of_record(seed, number);
        let (rates, balls) = draw_bearing(random);
        let drawn = random.range(-20.0, 10.0);
        let clean = random.chance(CLEAN);
        let snr = if clean { random.range(30.0, 80.0) } else { drawn };
        if clean {
            let signal = scaled_to(fault(random, part, &rates, balls, &clock, Variety::Full), 1.0);
            let background =
                sum(&shaft_lines(random, rates.shaft, &clock), &white(random), 10f64.powf(-0.05 * snr));
            let record = sum(&background, &signal, 1.0);
            return Generated { record, rates, part: Some(part), other: None, snr, rivals: vec![], clock };
        }
        let mut background = machine(random, rates.shaft, &clock);
        let steady = [Other::Sine, Other::GearMesh, Other::Mains, Other::CyclicNoise, Other::Blades];
        let other = random.chance(0.3).then(|| steady[random.integer(0, steady.len() - 1)]);
        let mut rivals = Vec::new();
        if let Some(other) = other {
            let (record, rates) = other.draw(random, rates.shaft, &clock);
            let level = 10f64.powf(random.range(-1.0, 0.5));
            background = sum(&background, &scaled_to(record, level), 1.0);
            rivals = rates;
        }
        let signal = fault(random, part, &rates, balls, &clock, Variety::Full);
        let signal = scaled_to(signal, power(&background) * 10f64.powf(0.1 * snr));
        Generated {
            record: sum(&background, &signal, 1.0),
            rates,
            part: Some(part),
            other,
            snr,
            rivals,
            clock,
        }
    }

    /// A source without fault: alone (60 dB above the sensor's noise) or −10 to 20 dB over a machine.
    pub fn healthy(seed: u64, number: usize, other: Other, clock: Clock) -> Self {
        let random = &mut Random::of_record(seed, number);
        let (rates, _) = draw_bearing(random);
        let alone = random.chance(0.3);
        let drawn = random.range(-10.0, 20.0);
        let snr = if alone { 60.0 } else { drawn };
        let background = if alone { white(random) } else { machine(random, rates.shaft, &clock) };
        let (record, rivals) = other.draw(random, rates.shaft, &clock);
        let signal = scaled_to(record, power(&background) * 10f64.powf(0.1 * snr));
        let record = sum(&background, &signal, 1.0);
        Generated { record, rates, part: None, other: Some(other), snr, rivals, clock }
    }

    /// Whether one of a rival's first twelve harmonics lies in the search window of a bearing line.
    pub fn rival_in_a_window(&self, slip: f64, resolution: f64) -> bool {
        BearingPart::ALL.iter().any(|part| {
            let line = part.defect_frequency(&self.rates);
            self.rivals.iter().any(|rival| {
                (1..=12).any(|h| (f64::from(h) * rival - line).abs() <= slip * line + resolution)
            })
        })
    }
}

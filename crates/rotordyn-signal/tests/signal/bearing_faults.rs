//! Bearing fault diagnosis on synthetic records with known faults.

use std::f64::consts::TAU;

use rotordyn_signal::WindowKind;
use rotordyn_signal::bearing_lines::{BearingPart, DefectFrequencies, LineSettings, Modulation};
use rotordyn_signal::cepstrum::{Lifter, lifter, real_cepstrum};
use rotordyn_signal::cyclic::cyclic_coherence;
use rotordyn_signal::diagnosis::{BandRule, ShaftRotation, diagnose};
use rotordyn_signal::envelope::{analytic_signal, band_analytic_signal, squared_envelope_spectrum};
use rotordyn_signal::jerk::jerk;
use rotordyn_signal::kurtogram::{depth_for_width, fast_kurtogram, scored_bands, spectral_kurtosis};
use rotordyn_signal::spectrum::{Level, Welch, amplitude_spectrum};
use rotordyn_signal::synchronous::synchronous_average;

use crate::{assert_close, noise, sampled};

const RATE: f64 = 12_000.0;
const SHAFT: f64 = 29.95;

/// A 6205-2RS at 1797 rpm.
fn rates() -> DefectFrequencies {
    let ratio = 7.94004 / 39.0398;
    DefectFrequencies {
        shaft: SHAFT,
        cage: 0.5 * SHAFT * (1.0 - ratio),
        outer: 4.5 * SHAFT * (1.0 - ratio),
        inner: 4.5 * SHAFT * (1.0 + ratio),
        ball: 0.5 * SHAFT / ratio * (1.0 - ratio * ratio),
    }
}

/// Nearly Gaussian noise: the sum of six uniform numbers, standard deviation √2.
fn gaussian(seed: u32, n: usize) -> Vec<f64> {
    noise(seed, 6 * n).chunks_exact(6).map(|c| c.iter().sum()).collect()
}

/// Impulses at `rate` exciting a decaying `resonance`, with amplitude `gain` over time and 1 % random slip.
fn impulse_train(
    n: usize,
    rate: f64,
    resonance: f64,
    decay: f64,
    seed: u32,
    gain: impl Fn(f64) -> f64,
) -> Vec<f64> {
    jittered_impulse_train(n, rate, 0.01, resonance, decay, seed, gain)
}

fn jittered_impulse_train(
    n: usize,
    rate: f64,
    jitter: f64,
    resonance: f64,
    decay: f64,
    seed: u32,
    gain: impl Fn(f64) -> f64,
) -> Vec<f64> {
    let mut x = vec![0.0; n];
    let shifts = noise(seed, (n as f64 / RATE * rate) as usize + 2);
    for (k, shift) in shifts.iter().enumerate() {
        let start = (k as f64 + jitter * shift) / rate;
        let first = (start * RATE).ceil().max(0.0) as usize;
        for (i, value) in x.iter_mut().enumerate().skip(first).take((8.0 / decay * RATE) as usize) {
            let t = i as f64 / RATE - start;
            *value += gain(start) * (-decay * t).exp() * (TAU * resonance * t).sin();
        }
    }
    x
}

fn sum(a: &[f64], b: &[f64], factor: f64) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a + factor * b).collect()
}

/// a (1 + m cos ωt) cos Ωt: squared envelope a² (1 + m²/2 + 2 m cos ωt + m²/2 cos 2ωt).
#[test]
fn squared_envelope_of_a_modulated_tone() {
    let x = sampled(1000, 1000.0, |t| 2.0 * (1.0 + 0.3 * (TAU * 10.0 * t).cos()) * (TAU * 200.0 * t).cos());
    for band in [None, Some((150.0, 250.0))] {
        let got = squared_envelope_spectrum(&x, 1000.0, band, WindowKind::Rectangular, Level::Peak).unwrap();
        for (k, value) in got.values.iter().enumerate() {
            let expected = match k {
                10 => 2.0 * 0.3 * 4.0,
                20 => 0.5 * 0.09 * 4.0,
                _ => 0.0,
            };
            assert_close(&format!("line {k}"), *value, expected, 1e-10);
        }
    }
}

/// Adjacent bands add up to the analytic signal, and their energies to its energy (Parseval).
#[test]
fn bands_partition_the_record() {
    for n in [500, 501] {
        let x = noise(8, n);
        let whole = analytic_signal(&x).unwrap();
        let edges = [0.0, 90.0, 94.5, 333.3, 500.0];
        let bands: Vec<_> =
            edges.windows(2).map(|w| band_analytic_signal(&x, 1000.0, (w[0], w[1])).unwrap()).collect();
        for (k, z) in whole.iter().enumerate() {
            let total: rotordyn_signal::Complex<f64> = bands.iter().map(|b| b[k]).sum();
            assert!((total - z).norm() < 1e-12);
        }
        let energy = |z: &[rotordyn_signal::Complex<f64>]| z.iter().map(|z| z.norm_sqr()).sum::<f64>();
        assert_close("energy", bands.iter().map(|b| energy(b)).sum(), energy(&whole), 1e-9);
    }
}

/// An echo of strength a after τ: ln|1 + a e^{−jωτ}| = a cos ωτ − a²/2 cos 2ωτ + …, c(τ) = a/2, c(2τ) = −a²/4.
#[test]
fn cepstrum_of_an_echo() {
    let (n, delay, a) = (1024, 40, 0.5);
    let x: Vec<f64> = (0..n)
        .map(|k| {
            if k == 0 {
                1.0
            } else if k == delay {
                a
            } else {
                0.0
            }
        })
        .collect();
    let c = real_cepstrum(&x, 100.0).unwrap();
    assert_close("quefrency", c.quefrencies[delay], 0.4, 1e-15);
    for (k, value) in c.values.iter().enumerate().take(500) {
        let expected = match k / delay {
            m if k % delay == 0 && m > 0 => -(-a).powi(m as i32) / (2.0 * m as f64),
            _ => 0.0,
        };
        // The series wraps around the record: terms of order a^{1024/gcd}/k are aliased.
        assert_close(&format!("at {k}"), *value, expected, 1e-3);
    }
    // The comb lifter removes the echo from the magnitude but not from the phase: √((1 + az)/(1 + a/z)) with z the
    // delay, 1 − a²/4 − 3a⁴/64 … at 0 and a/2 + a³/16 + 3a⁵/128 … at the delay; aliased terms are not removed.
    let comb = Lifter::Comb { quefrency: 0.4, half_width: 0.0 };
    let clean = lifter(&x, 100.0, comb).unwrap();
    assert_close("direct", clean[0], 1.0 - 0.25 * a * a - 3.0 / 64.0 * a.powi(4), 2e-3);
    assert_close("echo", clean[delay], 0.5 * a + a.powi(3) / 16.0 + 3.0 / 128.0 * a.powi(5), 3e-3);
}

/// Spectral kurtosis is 0 for Gaussian noise, −1 for a tone and large for rare impulses.
#[test]
fn spectral_kurtosis_of_noise_tone_and_impulses() {
    let n = 60_000;
    let back = gaussian(3, n);
    let tone = sampled(n, RATE, |t| 30.0 * (TAU * 1500.0 * t).cos());
    let pulses = impulse_train(n, 30.0, 3750.0, 1500.0, 9, |_| 12.0);
    let x = sum(&sum(&back, &tone, 1.0), &pulses, 1.0);
    let welch = Welch { overlap: 48, ..Welch::hann(64) };
    let sk = spectral_kurtosis(&x, RATE, &welch).unwrap();
    let at = |f: f64| sk.values[(f * 64.0 / RATE).round() as usize];
    // Standard deviation 2/√segments of independent segments, 2/√900.
    assert_close("noise", at(5000.0), 0.0, 0.3);
    assert_close("tone", at(1500.0), -1.0, 0.01);
    assert!(at(3750.0) > 1.0, "{}", at(3750.0));
}

/// The kurtogram selects the resonance excited by impulses.
#[test]
fn kurtogram_selects_the_band_of_the_impulses() {
    let n = 1 << 16;
    let x = sum(&gaussian(4, n), &impulse_train(n, 107.0, 4100.0, 1500.0, 2, |_| 6.0), 1.0);
    let depth = depth_for_width(n, RATE, 300.0).unwrap();
    let kurtogram = fast_kurtogram(&x, RATE, depth).unwrap();
    let best = kurtogram.best();
    assert!(best.low <= 4100.0 && best.high >= 4100.0 && best.high - best.low <= 2000.0, "{best:?}");
    assert!(best.value > 1.0, "{best:?}");
    assert_eq!(
        kurtogram.levels.iter().map(|l| l.values.len()).collect::<Vec<_>>(),
        [1, 2, 3, 4, 6, 8, 12, 16]
    );
    // Noise alone is flat: four standard deviations of the narrowest band, 2 √(2/4096)... of each band's samples.
    let flat = fast_kurtogram(&gaussian(4, n), RATE, depth).unwrap();
    for band in flat.bands() {
        let samples = n as f64 * (band.high - band.low) / (0.5 * RATE);
        // The sum of six uniform numbers has an excess kurtosis of −0.2; filtering reduces it.
        assert!(band.value.abs() < 0.25 + 8.0 / samples.sqrt(), "{band:?}");
    }
}

/// Rare impacts of another source have the highest kurtosis; the bearing fault lines are in another band.
#[test]
fn band_selection_by_fault_lines_with_interfering_impacts() {
    let n = 1 << 17;
    let bearing = impulse_train(n, rates().outer, 4200.0, 1500.0, 2, |_| 1.5);
    let knocks = jittered_impulse_train(n, 2.3, 0.5, 1300.0, 900.0, 7, |_| 60.0);
    let x = sum(&sum(&gaussian(11, n), &bearing, 1.0), &knocks, 1.0);
    let settings = LineSettings::default();
    let by_kurtosis =
        diagnose(&x, RATE, ShaftRotation::ConstantSpeed, &rates(), BandRule::Kurtosis, &settings).unwrap();
    assert!(by_kurtosis.band.0 <= 1300.0 && by_kurtosis.band.1 <= 3000.0, "{:?}", by_kurtosis.band);
    assert_eq!(by_kurtosis.lines.diagnosis, None, "{:?}", by_kurtosis.lines.strongest_line());
    let by_lines =
        diagnose(&x, RATE, ShaftRotation::ConstantSpeed, &rates(), BandRule::Lines, &settings).unwrap();
    assert!(
        by_lines.band.0 >= 3000.0 && (by_lines.band.0..by_lines.band.1).contains(&4200.0),
        "{:?}",
        by_lines.band
    );
    assert_eq!(by_lines.lines.diagnosis, Some(BearingPart::OuterRace));
}

/// The score is evaluated for every band of the filter bank, the whole record first.
#[test]
fn scored_bands_cover_the_axis() {
    let got = scored_bands(&noise(1, 2048), 1000.0, 3, |band| band.high - band.low).unwrap();
    assert_close("whole", got.best().high, 500.0, 0.0);
    for level in &got.levels {
        for width in &level.values {
            assert_close("width", *width, 500.0 / level.values.len() as f64, 1e-12);
        }
    }
}

/// The faulty part is diagnosed; passing the load zone gives the sidebands of that part.
#[test]
fn diagnosis_of_each_part() {
    let n = 60_000;
    let r = rates();
    let back = gaussian(21, n);
    let zone = |rate: f64| move |t: f64| 1.0 + 0.8 * (TAU * rate * t).cos();
    let settings = LineSettings::default();
    for (part, record) in [
        (BearingPart::OuterRace, impulse_train(n, 1.004 * r.outer, 3500.0, 1500.0, 3, |_| 4.0)),
        (
            BearingPart::InnerRace,
            impulse_train(n, 0.996 * r.inner, 3500.0, 1500.0, 4, |t| 4.0 * zone(r.shaft)(t)),
        ),
        (BearingPart::Ball, impulse_train(n, 2.006 * r.ball, 3500.0, 1500.0, 5, |t| 4.0 * zone(r.cage)(t))),
        (BearingPart::Cage, impulse_train(n, r.cage, 3500.0, 1500.0, 6, |_| 8.0)),
    ] {
        let x = sum(&back, &record, 1.0);
        for rule in [BandRule::Given(2000.0, 5000.0), BandRule::Whole, BandRule::Kurtosis, BandRule::Lines] {
            let got = diagnose(&x, RATE, ShaftRotation::ConstantSpeed, &r, rule, &settings).unwrap();
            assert_eq!(got.lines.diagnosis, Some(part), "{rule:?} {:?}", got.lines.strongest_line());
            let strongest = got.lines.strongest_line().unwrap();
            assert_eq!((strongest.part, strongest.modulation), (part, None));
            let line = &got.lines.family(part).lines[0];
            let ratio = [1.004, 0.996, 1.003, 1.0][index_of(part)];
            assert_close("slip", line.frequency / line.expected, ratio, 2e-3);
        }
        let expected = match part {
            BearingPart::InnerRace => Some(Modulation::Shaft(1)),
            BearingPart::Ball => Some(Modulation::Cage(1)),
            _ => None,
        };
        if let Some(modulation) = expected {
            let got =
                diagnose(&x, RATE, ShaftRotation::ConstantSpeed, &r, BandRule::Whole, &settings).unwrap();
            let family = got.lines.family(part);
            let band = family.lines.iter().find(|l| l.modulation == Some(modulation)).unwrap();
            assert!(band.significant, "{band:?}");
        }
    }
}

fn index_of(part: BearingPart) -> usize {
    BearingPart::ALL.iter().position(|p| *p == part).unwrap()
}

/// Noise, unbalance, a gear's modulation by the shaft: no bearing line, whatever the band.
#[test]
fn healthy_machine_has_no_bearing_line() {
    let n = 60_000;
    for seed in 0..6 {
        let back = gaussian(100 + seed, n);
        let gear = sampled(n, RATE, |t| {
            let shaft = TAU * SHAFT * t;
            3.0 * shaft.cos() + (1.0 + 0.7 * shaft.cos() + 0.3 * (2.0 * shaft).cos()) * (37.0 * shaft).cos()
        });
        let x = sum(&back, &gear, f64::from(seed % 2));
        for rule in [BandRule::Whole, BandRule::Kurtosis, BandRule::Lines] {
            let got =
                diagnose(&x, RATE, ShaftRotation::ConstantSpeed, &rates(), rule, &LineSettings::default())
                    .unwrap();
            assert_eq!(
                got.lines.diagnosis_name(),
                "no bearing fault",
                "{seed} {rule:?} {:?}",
                got.lines.strongest_line()
            );
        }
    }
}

/// Run-up from 10 to 30 rev/s: BPFI is smeared over 100 Hz but constant in order; the resonance is constant in Hz.
#[test]
fn diagnosis_of_a_run_up_by_shaft_angle() {
    let n = 120_000;
    let turns = |t: f64| 10.0 * t + t * t;
    let theta = sampled(n, RATE, |t| TAU * turns(t));
    let order = DefectFrequencies { shaft: 1.0, ..rates() };
    let orders = DefectFrequencies {
        cage: order.cage / SHAFT,
        outer: order.outer / SHAFT,
        inner: order.inner / SHAFT,
        ball: order.ball / SHAFT,
        ..order
    };
    // Pulse k at the time when the shaft has turned k/BPFI.
    let time = |turn: f64| -5.0 + (25.0 + turn).sqrt();
    let mut x = gaussian(31, n);
    for k in 0..(turns(10.0) * orders.inner) as usize {
        let start = time(k as f64 / orders.inner);
        let load = 1.0 + 0.8 * (TAU * k as f64 / orders.inner).cos();
        let first = (start * RATE).ceil() as usize;
        for (i, value) in x.iter_mut().enumerate().skip(first).take(60) {
            let t = i as f64 / RATE - start;
            *value += 4.0 * load * (-1500.0 * t).exp() * (TAU * 3500.0 * t).sin();
        }
    }
    let settings = LineSettings::default();
    for rule in [BandRule::Given(2500.0, 4500.0), BandRule::Kurtosis, BandRule::Lines] {
        let got = diagnose(&x, RATE, ShaftRotation::Angle(&theta), &orders, rule, &settings).unwrap();
        assert_eq!(got.lines.diagnosis, Some(BearingPart::InnerRace), "{rule:?}");
        let line = got.lines.strongest_line().unwrap();
        assert_close("order", line.frequency, line.harmonic as f64 * orders.inner, 0.005);
        assert!((got.band.0..got.band.1).contains(&3500.0), "{rule:?} {:?}", got.band);
    }
    let text =
        diagnose(&x[..9000], RATE, ShaftRotation::Angle(&theta[..9000]), &orders, BandRule::Whole, &settings)
            .unwrap_err()
            .to_string();
    assert!(text.contains("25.10") && text.contains("ten revolutions of the cage"), "{text}");
}

/// Errors for too short a record, too low a sampling rate and an invalid band.
#[test]
fn invalid_input_of_a_diagnosis() {
    let x = noise(1, 4000);
    let settings = LineSettings::default();
    let message = |rate: f64, rule: BandRule| {
        diagnose(&x, rate, ShaftRotation::ConstantSpeed, &rates(), rule, &settings).unwrap_err().to_string()
    };
    assert_eq!(
        message(RATE, BandRule::Whole),
        "record has 4000 samples: at least 10060 are needed for ten revolutions of the cage, to resolve its lines"
    );
    let text = message(1500.0, BandRule::Whole);
    assert!(
        text.starts_with("the sampling rate is 1500 Hz: the highest bearing line requested needs"),
        "{text}"
    );
    let x = noise(1, 12_000);
    let text =
        diagnose(&x, RATE, ShaftRotation::ConstantSpeed, &rates(), BandRule::Given(500.0, 7000.0), &settings)
            .unwrap_err()
            .to_string();
    assert!(text.starts_with("upper end of the band = 7000 is out of range"), "{text}");
    let bad = DefectFrequencies { inner: f64::NAN, ..rates() };
    let text = diagnose(&x, RATE, ShaftRotation::ConstantSpeed, &bad, BandRule::Whole, &settings)
        .unwrap_err()
        .to_string();
    assert!(text.starts_with("BPFI = NaN is out of range"), "{text}");
}

/// White noise modulated at 1/64 of the rate: coherence at that α and nowhere else.
#[test]
fn cyclic_coherence_of_modulated_noise() {
    let n = 64_000;
    let alpha = 15.625;
    let x: Vec<f64> = gaussian(5, n)
        .iter()
        .enumerate()
        .map(|(k, v)| v * (1.0 + 0.8 * (TAU * alpha * k as f64 / 1000.0).cos()))
        .collect();
    let alphas: Vec<f64> = (1..40).map(|k| k as f64 * alpha / 4.0).collect();
    let welch = Welch { overlap: 96, ..Welch::hann(128) };
    let got = cyclic_coherence(&x, 1000.0, &alphas, &welch).unwrap();
    let spectrum = got.enhanced_envelope_spectrum((50.0, 450.0)).unwrap();
    for (a, value) in spectrum.frequencies.iter().zip(&spectrum.values) {
        // |γ| = R(α)/R(0) of the power (1 + m cos)²: half of 2m and of m²/2, over 1 + m²/2.
        let expected = if *a == alpha {
            0.8 / 1.32
        } else if *a == 2.0 * alpha {
            0.16 / 1.32
        } else {
            0.0
        };
        assert_close(&format!("alpha {a}"), *value, expected, if expected == 0.0 { 0.06 } else { 0.03 });
    }
    // About one (α, f) in a hundred of those without modulation lies above the limit.
    let rows = alphas.iter().enumerate().filter(|(_, a)| **a % alpha != 0.0);
    let values: Vec<f64> = rows.flat_map(|(k, _)| got.row(k)[5..60].to_vec()).collect();
    let above =
        values.iter().filter(|v| **v > got.one_percent_threshold).count() as f64 / values.len() as f64;
    assert!((0.002..0.03).contains(&above), "{above}");
}

/// Time synchronous averaging: shaft orders (gear mesh 23) are in the average, order 3.6 in the residual.
#[test]
fn synchronous_average_separates_shaft_from_bearing() {
    let per_turn = 100;
    let turn = |k: usize| k as f64 / per_turn as f64;
    let gear = |k: usize| 2.0 * (TAU * 23.0 * turn(k) + 0.4).cos() + 0.5;
    let bearing = |k: usize| (TAU * 3.6 * turn(k)).cos();
    let x: Vec<f64> = (0..per_turn * 50 + 37).map(|k| gear(k) + bearing(k)).collect();
    let average = synchronous_average(&x, per_turn).unwrap();
    assert_eq!(average.periods, 50);
    for (k, mean) in average.mean.iter().enumerate() {
        // Fifty revolutions contain 180 whole periods of order 3.6: its mean at each angle is zero.
        // The cosine of an angle of thousands of radians is good to 1e-12.
        assert_close("mean", *mean, gear(k), 1e-10);
        assert_close("deviation", average.deviation[k], 0.5f64.sqrt(), 1e-10);
    }
    let rest = average.residual(&x).unwrap();
    let spectrum = amplitude_spectrum(&rest[..5000], 100.0, WindowKind::Rectangular, Level::Peak).unwrap();
    assert_close("bearing", spectrum.values[180], 1.0, 1e-10);
    assert_close("gear", spectrum.values[1150], 0.0, 1e-10);
}

#[test]
fn jerk_of_a_parabola_is_exact() {
    let a = sampled(50, 100.0, |t| 3.0 * t * t - t + 2.0);
    for (n, j) in jerk(&a, 100.0).unwrap().iter().enumerate().skip(1).take(48) {
        assert_close("jerk", *j, 6.0 * n as f64 / 100.0 - 1.0, 1e-11);
    }
}

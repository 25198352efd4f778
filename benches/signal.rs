//! STFT and order tracking of a run-up record: 13 s at 20 kHz, 260 thousand samples; bearing diagnosis on 120
//! thousand samples.

use std::f64::consts::TAU;
use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use rotordyn::signal::WindowKind;
use rotordyn::signal::bearing_lines::{DefectFrequencies, LineSettings};
use rotordyn::signal::cyclic::cyclic_coherence;
use rotordyn::signal::diagnosis::{BandRule, ShaftRotation, diagnose};
use rotordyn::signal::filter_bank::max_depth;
use rotordyn::signal::kurtogram::fast_kurtogram;
use rotordyn::signal::order::{OrderSettings, OrderTracker};
use rotordyn::signal::spectrum::Welch;
use rotordyn::signal::stft::{Stft, StftSettings};
use rotordyn::signal::vold_kalman::{Bandwidth, TrackedOrder, vold_kalman};

const RATE: f64 = 20_000.0;
const SAMPLES: usize = 260_000;

/// 1 s at rest, 10 s ramp to 1200 rpm, 2 s at that speed: shaft angle \[rad\].
fn angle(n: usize) -> f64 {
    let t = n as f64 / RATE;
    TAU * if t < 1.0 {
        0.0
    } else if t < 11.0 {
        (t - 1.0).powi(2)
    } else {
        100.0 + 20.0 * (t - 11.0)
    }
}

fn signal(c: &mut Criterion) {
    let theta: Vec<f64> = (0..SAMPLES).map(angle).collect();
    let x: Vec<f64> = theta.iter().map(|a| a.cos() + (7.0 * a).cos() + (7.14 * a).cos()).collect();
    let mut group = c.benchmark_group("signal");
    group.sample_size(20);

    let settings = StftSettings::new(WindowKind::Hann, 8192, 0.9).expect("overlap is below 1");
    let mut stft = Stft::new(settings, RATE).expect("settings are in range");
    group.bench_function("stft_260k", |b| b.iter(|| stft.spectrogram(black_box(&x)).expect("finite record")));

    let orders = |channels: &[&[f64]]| {
        let mut tracker =
            OrderTracker::new(&theta, RATE, OrderSettings::new(0.05, 50.0)).expect("turns enough");
        let records = tracker.resample(channels).expect("finite records");
        records.iter().map(|r| tracker.spectrogram(r)).collect::<Vec<_>>()
    };
    group.bench_function("orders_260k", |b| b.iter(|| orders(black_box(&[&x]))));
    group.bench_function("orders_260k_8_channels", |b| b.iter(|| orders(black_box(&[&x[..]; 8]))));
    group.finish();
}

/// Eight orders, 7x beside 7.144x, of a run-up of 13 s at 4 kHz.
fn vold_kalman_orders(c: &mut Criterion) {
    const STRIDE: usize = 5;
    let theta: Vec<f64> = (0..SAMPLES).step_by(STRIDE).map(angle).collect();
    let orders = [1.0, 2.0, 3.0, 3.572, 7.0, 7.144, 8.0, 9.0];
    let x: Vec<f64> = theta.iter().map(|a| orders.iter().map(|o| (o * a).cos()).sum()).collect();
    let bandwidth = Bandwidth::Orders { width: 0.25, min_hertz: 1.0 };
    let tracked = orders.map(|order| TrackedOrder { order, bandwidth });
    let mut group = c.benchmark_group("signal");
    group.sample_size(10);
    group.bench_function("vold_kalman_52k_8_orders", |b| {
        b.iter(|| vold_kalman(black_box(&x), &theta, RATE / STRIDE as f64, &tracked).expect("orders apart"))
    });
    group.finish();
}

/// Noise with pulses at BPFO of a 6205 at 1797 rpm, 12 kHz.
fn bearing_diagnosis(c: &mut Criterion) {
    const N: usize = 120_000;
    let mut state = 1u32;
    let x: Vec<f64> = (0..N)
        .map(|n| {
            state = state.wrapping_mul(1664525).wrapping_add(1013904223);
            let pulse = if n % 112 == 0 { 5.0 } else { 0.0 };
            f64::from(state) / 2f64.powi(31) - 1.0 + pulse
        })
        .collect();
    let rates = DefectFrequencies { shaft: 29.95, cage: 11.93, outer: 107.36, inner: 162.19, ball: 70.58 };
    let mut group = c.benchmark_group("faults");
    group.sample_size(20);
    let depth = max_depth(N);
    group.bench_function("fast_kurtogram_120k", |b| b.iter(|| fast_kurtogram(black_box(&x), 12e3, depth)));
    for (name, rule) in [("kurtosis", BandRule::Kurtosis), ("lines", BandRule::Lines)] {
        let run = || {
            diagnose(
                black_box(&x),
                12e3,
                ShaftRotation::ConstantSpeed,
                &rates,
                rule,
                &LineSettings::default(),
            )
        };
        group.bench_function(format!("diagnosis_by_{name}_120k"), |b| b.iter(run));
    }
    let alphas: Vec<f64> = (1..=100).map(|k| 0.1 * f64::from(k)).collect();
    let welch = Welch { overlap: 192, ..Welch::hann(256) };
    group.bench_function("cyclic_coherence_120k_100", |b| {
        b.iter(|| cyclic_coherence(black_box(&x), 12e3, &alphas, &welch))
    });
    group.finish();
}

criterion_group!(benches, signal, vold_kalman_orders, bearing_diagnosis);
criterion_main!(benches);

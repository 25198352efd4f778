//! Sines in a random record, recognised by their amplitude distribution.
//!
//! The complex amplitude z of a narrow band of a Gaussian response has E|z|⁴ = 2 (E|z|²)², that of a sine E|z|⁴ = (E|z|²)²:
//! the spectral kurtosis E|z|⁴/(E|z|²)² − 2 is 0 for a mode whatever its damping and −1 for a sine (the band-passed record has
//! an excess kurtosis of 3/2 of it, 0 and −1.5). Two tests: the kurtosis over some hundred short segments, which also finds
//! sines that wander within a segment's bin; and narrow lines of the spectrum of the whole record, whose phase advances evenly.
//!
//! Source: Antoni, Mech. Syst. Signal Process. 20 (2006) 282; Jacobsen, Andersen & Brincker, IMAC 25 (2007).

use std::f64::consts::TAU;

use rayon::prelude::*;
use rotordyn_linalg::{Complex64, fft_length};
use rotordyn_signal::WindowKind;
use rustfft::FftPlanner;

use super::prepare::Prepared;
use super::result::Harmonic;

/// Segments of the kurtosis test.
const SEGMENTS: usize = 256;
/// Fewest samples of a segment.
const MIN_SEGMENT: usize = 32;
/// Spectral kurtosis below which there is a sine; the kurtosis of a Gaussian band over 511 half-overlapping segments scatters by
/// 2/√430 ≈ 0.1.
const SINE_KURTOSIS: f64 = -0.55;
/// Height of a line of the whole spectrum over the mean around; for random lines 1e-9 per line and channel.
const LINE_HEIGHT: f64 = 21.0;
/// Part of the power near a line that has an evenly advancing phase.
const PHASE_COHERENCE: f64 = 0.7;
/// Parts of the record that the phases are compared over.
const PHASE_PARTS: usize = 16;

/// Sines of constant frequency in the band, in order of frequency.
pub(super) fn constant_sines(data: &Prepared) -> Vec<Harmonic> {
    let all = data.samples.par_iter().flat_map_iter(|samples| whole_record_lines(data, samples)).collect();
    merged(all, data.rate / data.len() as f64)
}

/// All sines in the band, in order of frequency.
pub(super) fn sines(data: &Prepared) -> Vec<Harmonic> {
    let mut all: Vec<Harmonic> =
        data.samples.par_iter().flat_map_iter(|samples| whole_record_lines(data, samples)).collect();
    let wide: Vec<Harmonic> =
        data.samples.par_iter().flat_map_iter(|samples| kurtosis_lines(data, samples)).collect();
    // A line of the finer test says more of the frequency.
    let fine = all.len();
    for line in wide {
        if !all[..fine].iter().any(|known| (known.frequency - line.frequency).abs() < 2.0 * line.half_width) {
            all.push(line);
        }
    }
    merged(all, data.rate / data.len() as f64)
}

/// One line for all within its width, in order of frequency.
fn merged(mut all: Vec<Harmonic>, resolution: f64) -> Vec<Harmonic> {
    all.sort_by(|a, b| a.frequency.total_cmp(&b.frequency));
    let mut out: Vec<Harmonic> = Vec::new();
    for line in all {
        match out.last_mut() {
            Some(last) if line.frequency - last.frequency < last.half_width.max(2.0 * resolution) => {
                if line.kurtosis < last.kurtosis {
                    *last = line;
                }
            }
            _ => out.push(line),
        }
    }
    out
}

fn in_band(data: &Prepared, hz: f64) -> bool {
    hz >= data.band[0] && hz <= data.band[1]
}

/// Bins of many short segments with the kurtosis of a sine.
fn kurtosis_lines(data: &Prepared, samples: &[f64]) -> Vec<Harmonic> {
    let segment = (samples.len() / SEGMENTS) & !1;
    if segment < MIN_SEGMENT {
        return Vec::new();
    }
    let window = WindowKind::Hann.samples(segment);
    let fft = FftPlanner::<f64>::new().plan_fft_forward(segment);
    let count = 2 * (samples.len() / segment) - 1;
    let (mut second, mut fourth) = (vec![0.0; segment / 2], vec![0.0; segment / 2]);
    for m in 0..count {
        let part = &samples[m * segment / 2..];
        let mut buffer: Vec<Complex64> = window.iter().zip(part).map(|(w, x)| (w * x).into()).collect();
        fft.process(&mut buffer);
        for k in 0..segment / 2 {
            let p = buffer[k].norm_sqr();
            second[k] += p;
            fourth[k] += p * p;
        }
    }
    let n = count as f64;
    let kurtosis: Vec<f64> =
        (0..segment / 2).map(|k| n * fourth[k] / (second[k] * second[k]) - 2.0).collect();
    let step = data.rate / segment as f64;
    (2..segment / 2 - 1)
        .filter(|&k| kurtosis[k] < SINE_KURTOSIS && in_band(data, k as f64 * step))
        // The strongest bin of the main lobe, which is four bins wide.
        .filter(|&k| second[k] >= second[k - 1] && second[k] > second[k + 1])
        .map(|k| Harmonic {
            frequency: interpolated(&second[k - 1..=k + 1], k) * step,
            half_width: step,
            order: None,
            kurtosis: 1.5 * kurtosis[k],
            removed: false,
        })
        .collect()
}

/// Place of a peak by a parabola through the logarithms of three powers.
fn interpolated(powers: &[f64], k: usize) -> f64 {
    let [a, b, c] = [0, 1, 2].map(|i| powers[i].max(f64::MIN_POSITIVE).ln());
    let curvature = a - 2.0 * b + c;
    k as f64 + if curvature < 0.0 { (0.5 * (a - c) / curvature).clamp(-0.5, 0.5) } else { 0.0 }
}

/// Narrow lines of the whole record's spectrum with an even phase.
fn whole_record_lines(data: &Prepared, samples: &[f64]) -> Vec<Harmonic> {
    const AROUND: usize = 24;
    let n = fft_length(samples.len(), 2);
    let window = WindowKind::Hann.samples(samples.len());
    let mut buffer = vec![Complex64::default(); n];
    for (slot, (w, x)) in buffer.iter_mut().zip(window.iter().zip(samples)) {
        slot.re = w * x;
    }
    FftPlanner::<f64>::new().plan_fft_forward(n).process(&mut buffer);
    let power: Vec<f64> = buffer[..n / 2].iter().map(|v| v.norm_sqr()).collect();
    let step = data.rate / n as f64;
    let mut out = Vec::new();
    for k in AROUND..(n / 2).saturating_sub(AROUND + 1) {
        if !in_band(data, k as f64 * step) || power[k] < power[k - 1] || power[k] <= power[k + 1] {
            continue;
        }
        let mut around: Vec<f64> =
            power[k - AROUND..k - 3].iter().chain(&power[k + 4..=k + AROUND]).copied().collect();
        let middle = around.len() / 2;
        let mean = *around.select_nth_unstable_by(middle, f64::total_cmp).1 / std::f64::consts::LN_2;
        if power[k] < LINE_HEIGHT * mean {
            continue;
        }
        let frequency = interpolated(&power[k - 1..=k + 1], k) * step;
        if let Some(kurtosis) = even_phase(samples, frequency / data.rate) {
            out.push(Harmonic {
                frequency,
                half_width: 1.5 * data.rate / samples.len() as f64,
                order: None,
                kurtosis,
                removed: false,
            });
        }
    }
    out
}

/// Excess kurtosis of the band around a line if its phase advances evenly through the record.
fn even_phase(samples: &[f64], cycles_per_sample: f64) -> Option<f64> {
    let length = samples.len() / PHASE_PARTS;
    let window = WindowKind::Hann.samples(length);
    let parts: Vec<Complex64> = (0..PHASE_PARTS)
        .map(|m| {
            let mut sum = Complex64::default();
            for (i, w) in window.iter().enumerate() {
                let k = m * length + i;
                sum += Complex64::from_polar(w * samples[k], -TAU * (cycles_per_sample * k as f64).fract());
            }
            sum
        })
        .collect();
    let total: f64 = parts.iter().map(|z| z.norm_sqr()).sum();
    // A residual error of the frequency turns the phase by up to half a cycle over the record.
    let best = (-16..=16)
        .map(|turn| {
            let turn = f64::from(turn) / 16.0 / PHASE_PARTS as f64;
            let sum: Complex64 = parts
                .iter()
                .enumerate()
                .map(|(m, z)| z * Complex64::from_polar(1.0, -TAU * turn * m as f64))
                .sum();
            sum.norm_sqr()
        })
        .fold(0.0, f64::max);
    let n = PHASE_PARTS as f64;
    let fourth: f64 = parts.iter().map(|z| z.norm_sqr().powi(2)).sum();
    (best > PHASE_COHERENCE * n * total).then(|| 1.5 * (n * fourth / (total * total) - 2.0))
}

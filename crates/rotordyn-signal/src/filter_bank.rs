//! Binary-ternary filter bank of the fast kurtogram: complex sub-bands in 1, 2, 3, 4, 6, 8, 12 … equal parts.

use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

use rayon::prelude::*;
use rustfft::num_complex::Complex;

use super::SignalError;
use super::error::{check, check_length, check_rate, check_record};

/// Orders (taps − 1) of the half-band and of the third-band low-pass.
const BINARY_ORDER: usize = 16;
const TERNARY_ORDER: usize = 24;
/// Cut-off of the half-band low-pass over Nyquist; 0.25 would be the nominal band, so that filters overlap.
const CUTOFF: f64 = 0.4;
/// Outputs computed together; their sums stay in registers.
const OUTPUTS_PER_BLOCK: usize = 8;

/// One sub-band of a record.
#[derive(Clone, Copy, Debug)]
pub struct SubBand<'a> {
    /// Nominal band in 0..f_s/2 \[Hz\]; each filter extends 30 % of its width beyond either end.
    pub low: f64,
    pub high: f64,
    /// Complex envelope without the filter's transient.
    pub signal: &'a [Complex<f64>],
    /// Its sampling rate \[Hz\], twice the band's width.
    pub rate: f64,
}

/// One level of the filter bank: a value for each of its equal bands, from low to high.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BankLevel {
    /// log₂ of the number of bands: 0, 1, 1.58, 2, 2.58, 3 …
    pub level: f64,
    pub values: Vec<f64>,
}

/// Maximum depth (number of halvings) with 128 samples or more per band: ⌊log₂ N⌋ − 7.
pub fn max_depth(samples: usize) -> usize {
    (samples.max(1).ilog2() as usize).saturating_sub(7)
}

/// Splits a record into sub-bands and evaluates `value` for each; levels 1, 1.58, 2, 2.58 … `depth`.
///
/// Each split filters with a Hamming-windowed sinc h (0.4 of the band, 17 taps, for halves; 0.267, 25 taps,
/// for thirds) shifted to the centre of the part, h_i(n) = h(n) e^{jπ(2i+1)n/2D}, decimates by D, and
/// multiplies odd parts by (−1)ᵐ so that frequency always increases. The mean is removed first. `record` (N),
/// `sample_rate` \[Hz\], `depth` at most ⌊log₂ N⌋ − 7. Errors: NaN, record too short for the depth.
/// Source: Antoni, Mech. Syst. Signal Process. 21 (2007).
pub fn filter_bank(
    record: &[f64],
    sample_rate: f64,
    depth: usize,
    value: impl Fn(SubBand) -> f64 + Sync,
) -> Result<Vec<BankLevel>, SignalError> {
    check_record("record", record)?;
    check_rate(sample_rate)?;
    check((1..=40).contains(&depth), "levels of the filter bank", "1 to 40", depth as f64)?;
    check_length("record", record.len(), 1 << (depth + 7), "this depth of the filter bank")?;
    let mean = record.iter().sum::<f64>() / record.len() as f64;
    let halves = low_pass(BINARY_ORDER, CUTOFF);
    let thirds = low_pass(TERNARY_ORDER, 2.0 / 3.0 * CUTOFF);
    let mut nodes = vec![record.iter().map(|x| Complex::from(x - mean)).collect::<Vec<_>>()];
    let mut levels = Vec::new();
    for level in 1..=depth {
        let evaluate = |parts: &[Vec<Complex<f64>>], transient: usize| {
            let width = 0.5 * sample_rate / parts.len() as f64;
            let band = |(i, part): (usize, &Vec<Complex<f64>>)| -> f64 {
                let (low, high) = (i as f64 * width, (i + 1) as f64 * width);
                value(SubBand { low, high, signal: &part[transient..], rate: 2.0 * width })
            };
            BankLevel {
                level: (parts.len() as f64).log2(),
                values: parts.par_iter().enumerate().map(band).collect(),
            }
        };
        let ternary = split_all(&nodes, &thirds, 3);
        nodes = split_all(&nodes, &halves, 2);
        levels.push(evaluate(&nodes, BINARY_ORDER));
        if level < depth {
            levels.push(evaluate(&ternary, TERNARY_ORDER));
        }
    }
    Ok(levels)
}

/// FIR low-pass of `order` + 1 taps, sin(πcm)/(πm) times a Hamming window, Σh = 1; `cutoff` c over Nyquist.
fn low_pass(order: usize, cutoff: f64) -> Vec<f64> {
    let tap = |n: usize| {
        let m = n as f64 - 0.5 * order as f64;
        let sinc = if m == 0.0 { cutoff } else { (PI * cutoff * m).sin() / (PI * m) };
        sinc * (0.54 - 0.46 * (2.0 * PI * n as f64 / order as f64).cos())
    };
    let taps: Vec<f64> = (0..=order).map(tap).collect();
    let sum: f64 = taps.iter().sum();
    taps.iter().map(|h| h / sum).collect()
}

fn split_all(nodes: &[Vec<Complex<f64>>], taps: &[f64], parts: usize) -> Vec<Vec<Complex<f64>>> {
    let pairs = (0..nodes.len() * parts).into_par_iter();
    pairs.map(|i| split(&nodes[i / parts], taps, parts, i % parts)).collect()
}

/// One of `parts` = D equal bands of a complex signal, decimated by D.
///
/// z_m = (±1)ᵐ Σ_n h_n e^{jωn} x_{k−n} at k = Dm + D − 1 is e^{jωk} Σ_n h_n (x e^{−jω·})_{k−n}: the low-pass
/// has real taps. The demodulated signal is stored in D polyphase components so that the sum over n runs
/// along contiguous outputs.
fn split(signal: &[Complex<f64>], taps: &[f64], parts: usize, part: usize) -> Vec<Complex<f64>> {
    // ω = π (2i + 1) / 2D repeats after 4D samples.
    let period = 4 * parts;
    let turn =
        |k: usize| Complex::from_polar(1.0, PI * ((2 * part + 1) * k % period) as f64 / (2 * parts) as f64);
    let turns: Vec<Complex<f64>> = (0..period).map(turn).collect();
    let outputs = signal.len() / parts;
    // Zero padding: `lead` zeros before each phase (record zero before its start), whole blocks at its end.
    let lead = taps.len() / parts + 1;
    let length = lead + outputs.next_multiple_of(OUTPUTS_PER_BLOCK);
    let mut phases = vec![vec![Complex::ZERO; length]; parts];
    for (p, phase) in phases.iter_mut().enumerate() {
        for (m, value) in phase[lead..lead + outputs].iter_mut().enumerate() {
            let k = m * parts + p;
            *value = signal[k] * turns[k % period].conj();
        }
    }
    let mut out = Vec::with_capacity(length);
    for first in (0..outputs).step_by(OUTPUTS_PER_BLOCK) {
        let mut sums = [Complex::ZERO; OUTPUTS_PER_BLOCK];
        for (n, h) in taps.iter().enumerate() {
            // Sample Dm + D − 1 − n is number m − shift of phase p.
            let (p, shift) = (parts - 1 - n % parts, n / parts);
            let from = lead + first - shift;
            for (sum, x) in sums.iter_mut().zip(&phases[p][from..from + OUTPUTS_PER_BLOCK]) {
                *sum += x * h;
            }
        }
        out.extend(sums);
    }
    out.truncate(outputs);
    for (m, z) in out.iter_mut().enumerate() {
        let sign = if part % 2 == 1 && m % 2 == 1 { -1.0 } else { 1.0 };
        *z *= turns[(m * parts + parts - 1) % period] * sign;
    }
    out
}

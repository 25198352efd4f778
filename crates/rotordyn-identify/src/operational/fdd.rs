//! Frequency-domain decomposition (FDD): singular values of the spectral matrix, a quick look at modes.
//!
//! Near a mode the spectral matrix S(f) = Σ_segments Y Yᴴ is of rank one, with the mode shape as its first singular
//! vector; a second large singular value shows a second mode. Source: Brincker, Zhang & Andersen, Smart Mater. Struct.
//! 10 (2001) 441.

use std::f64::consts::TAU;

use nalgebra::DMatrix;
use rayon::prelude::*;
use rotordyn_linalg::{Complex64, eigen, fft_length};
use rotordyn_signal::WindowKind;
use rustfft::FftPlanner;

use super::prepare::Prepared;
use super::result::{Harmonic, SpectralDecomposition, SpectralPeak};
use crate::IdentifyError;
use crate::plscf::normalise_largest;

/// Most channels of the spectral matrix; of more the most independent ones are taken.
pub(super) const MAX_CHANNELS: usize = 12;
/// Singular values that are kept.
const KEPT: usize = 3;
/// Least height of a peak over the median of the lines around \[dB\].
const PEAK_DB: f64 = 6.0;

/// Singular values of the spectral matrix of some channels, and the peaks of the first one with the vectors over all.
pub(super) fn decomposition(
    data: &Prepared,
    channels: &[usize],
    harmonics: &[Harmonic],
) -> Result<SpectralDecomposition, IdentifyError> {
    // About 40 segments with half overlap; more lines cannot be seen in a figure.
    let segment = fft_length((data.len() / 20).clamp(64, 4096), 2);
    if segment > data.len() {
        return Ok(SpectralDecomposition::default());
    }
    let spectra = spectra(data, segment);
    let step = data.rate / segment as f64;
    let lines: Vec<usize> = (1..segment / 2)
        .filter(|&k| k as f64 * step >= data.band[0] && k as f64 * step <= data.band[1])
        .collect();
    let scale = 2.0 / (spectra[0].len() as f64 * data.rate);
    let of_line = |&k: &usize| -> Result<Vec<f64>, IdentifyError> {
        let n = channels.len();
        let entry = |a: usize, b: usize| -> Complex64 {
            let pairs = spectra[channels[a]].iter().zip(&spectra[channels[b]]);
            pairs.map(|(x, y)| x[k] * y[k].conj()).sum::<Complex64>() * scale
        };
        let s = DMatrix::from_fn(n, n, |a, b| if a <= b { entry(a, b) } else { Complex64::default() });
        let full = DMatrix::from_fn(n, n, |a, b| if a <= b { s[(a, b)] } else { s[(b, a)].conj() });
        let (values, _) = eigen::hermitian(&full.map(|v| v.re), &full.map(|v| v.im))?;
        Ok(values.into_iter().rev().take(KEPT).map(|v| v.max(0.0)).collect())
    };
    let rows: Result<Vec<Vec<f64>>, IdentifyError> = lines.par_iter().map(of_line).collect();
    let rows = rows?;
    let count = channels.len().min(KEPT);
    let values: Vec<Vec<f64>> = (0..count).map(|j| rows.iter().map(|row| row[j]).collect()).collect();
    let frequencies: Vec<f64> = lines.iter().map(|k| *k as f64 * step).collect();
    let peaks = peaks(&frequencies, &values[0])
        .into_iter()
        .map(|(at, height_db)| {
            let frequency = frequencies[at];
            let harmonic = harmonics
                .iter()
                .any(|h| !h.removed && (h.frequency - frequency).abs() < h.half_width.max(1.5 * step));
            let factors = data.to_one_quantity(Complex64::new(0.0, TAU * frequency));
            let shape = first_vector(&spectra, lines[at]).iter().zip(&factors).map(|(v, s)| v * s).collect();
            SpectralPeak { frequency, shape: normalise_largest(shape), height_db, harmonic }
        })
        .collect();
    Ok(SpectralDecomposition { frequencies, values, peaks })
}

/// Hann-windowed spectra with half overlap, `[channel][segment][line]`, scaled to unit window power.
fn spectra(data: &Prepared, segment: usize) -> Vec<Vec<Vec<Complex64>>> {
    let window = WindowKind::Hann.samples(segment);
    let power = window.iter().map(|w| w * w).sum::<f64>().sqrt();
    let fft = FftPlanner::<f64>::new().plan_fft_forward(segment);
    let one = |samples: &Vec<f64>| {
        (0..=(samples.len() - segment) / (segment / 2))
            .map(|m| {
                let part = &samples[m * segment / 2..];
                let mut buffer: Vec<Complex64> =
                    window.iter().zip(part).map(|(w, x)| (w * x / power).into()).collect();
                fft.process(&mut buffer);
                buffer.truncate(segment / 2);
                buffer
            })
            .collect()
    };
    data.samples.par_iter().map(one).collect()
}

/// First singular vector over all channels at a line, by iterations S v.
fn first_vector(spectra: &[Vec<Vec<Complex64>>], k: usize) -> Vec<Complex64> {
    let segments = spectra[0].len();
    let largest = |v: &Vec<Complex64>| v.iter().map(|x| x.norm_sqr()).sum::<f64>();
    let at = |m: usize| spectra.iter().map(|of| of[m][k]).collect::<Vec<Complex64>>();
    let mut v = (0..segments).map(at).fold(Vec::new(), |best: Vec<Complex64>, own| {
        if best.is_empty() || largest(&own) > largest(&best) { own } else { best }
    });
    for _ in 0..30 {
        let mut next = vec![Complex64::default(); v.len()];
        for m in 0..segments {
            let along: Complex64 = spectra.iter().zip(&v).map(|(of, v)| of[m][k].conj() * v).sum();
            next.iter_mut().zip(spectra).for_each(|(sum, of)| *sum += of[m][k] * along);
        }
        v = normalise_largest(next);
    }
    v
}

/// Height of a line over the median of the lines within ±30 % \[dB\].
pub(super) fn height_db(frequencies: &[f64], values: &[f64], k: usize) -> f64 {
    let mut around = values[near(frequencies, k, 0.3, 10)].to_vec();
    let middle = around.len() / 2;
    let median = *around.select_nth_unstable_by(middle, f64::total_cmp).1;
    10.0 * (values[k] / median.max(f64::MIN_POSITIVE)).log10()
}

/// Lines within a relative range around a line, and at least some.
fn near(frequencies: &[f64], k: usize, ratio: f64, lines: usize) -> std::ops::Range<usize> {
    let from = frequencies.partition_point(|f| *f < frequencies[k] * (1.0 - ratio));
    let to = frequencies.partition_point(|f| *f <= frequencies[k] * (1.0 + ratio));
    from.min(k.saturating_sub(lines))..to.max((k + lines + 1).min(frequencies.len()))
}

/// Lines of peaks: highest within ±1.5 % and ±3 lines, and high over the lines around.
fn peaks(frequencies: &[f64], values: &[f64]) -> Vec<(usize, f64)> {
    let n = values.len();
    let mut out = Vec::new();
    for k in 0..n {
        if values[near(frequencies, k, 0.015, 3)].iter().any(|v| *v > values[k]) {
            continue;
        }
        let height = height_db(frequencies, values, k);
        if height > PEAK_DB && k > 0 && k + 1 < n {
            out.push((k, height));
        }
    }
    out
}

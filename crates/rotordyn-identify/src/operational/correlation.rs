//! Correlations of the responses with the reference channels, by blocks of the record.
//!
//! R_b(i) = 1/N_b Σ_{k in block b} y_{k+i} y_kᵀ(references), i = 1 .. 2s−1; samples y_{k+i} may lie in the next block, so
//! that the mean over blocks is the unbiased correlation of the record.

use nalgebra::DMatrix;
use rayon::prelude::*;
use rotordyn_linalg::{Complex64, fft_length};
use rustfft::FftPlanner;

use super::prepare::Prepared;

/// Block correlations.
pub(super) struct Correlations {
    /// `blocks[b][i − 1]`, channels by references.
    pub blocks: Vec<Vec<DMatrix<f64>>>,
    /// Mean over the blocks.
    pub mean: Vec<DMatrix<f64>>,
}

/// Correlations up to a lag, by blocks.
pub(super) fn correlations(
    data: &Prepared,
    references: &[usize],
    lags: usize,
    blocks: usize,
) -> Correlations {
    let length = (data.len() - lags) / blocks;
    let size = fft_length(length + lags, 1);
    let mut planner = FftPlanner::<f64>::new();
    let (forward, inverse) = (planner.plan_fft_forward(size), planner.plan_fft_inverse(size));
    let spectrum = |part: &[f64]| {
        let mut buffer = vec![Complex64::default(); size];
        buffer.iter_mut().zip(part).for_each(|(slot, x)| slot.re = *x);
        forward.process(&mut buffer);
        buffer
    };
    let of_block = |b: usize| {
        let first = b * length;
        let base: Vec<Vec<Complex64>> =
            references.iter().map(|&r| spectrum(&data.samples[r][first..first + length])).collect();
        let mut out = vec![DMatrix::zeros(data.channels(), references.len()); lags];
        for (c, samples) in data.samples.iter().enumerate() {
            let own = spectrum(&samples[first..first + length + lags]);
            for (r, base) in base.iter().enumerate() {
                let mut product: Vec<Complex64> = own.iter().zip(base).map(|(y, x)| y * x.conj()).collect();
                inverse.process(&mut product);
                for (i, matrix) in out.iter_mut().enumerate() {
                    matrix[(c, r)] = product[i + 1].re / (size * length) as f64;
                }
            }
        }
        out
    };
    let blocks: Vec<Vec<DMatrix<f64>>> = (0..blocks).into_par_iter().map(of_block).collect();
    let mean = (0..lags)
        .map(|i| {
            let mut sum = DMatrix::zeros(data.channels(), references.len());
            blocks.iter().for_each(|block| sum += &block[i]);
            sum / blocks.len() as f64
        })
        .collect();
    Correlations { blocks, mean }
}

/// Block Hankel matrix of `rows` by `rows` correlations, H_ab = R(a + b + 1).
pub(super) fn hankel(correlations: &[DMatrix<f64>], rows: usize) -> DMatrix<f64> {
    let (l, r) = correlations[0].shape();
    DMatrix::from_fn(rows * l, rows * r, |i, j| correlations[i / l + j / r][(i % l, j % r)])
}

/// Reference channels: as independent as possible, by pivoting of the correlation at lag 0 (Cholesky).
pub(super) fn independent_channels(data: &Prepared, count: usize) -> Vec<usize> {
    let n = data.channels();
    let product = |a: usize, b: usize| {
        data.samples[a].iter().zip(&data.samples[b]).map(|(x, y)| x * y).sum::<f64>() / data.len() as f64
    };
    let mut rest = DMatrix::from_fn(n, n, |a, b| if a <= b { product(a, b) } else { 0.0 });
    for a in 0..n {
        for b in 0..a {
            rest[(a, b)] = rest[(b, a)];
        }
    }
    let mut chosen = Vec::new();
    while chosen.len() < count.min(n) {
        let free = (0..n).filter(|k| !chosen.contains(k));
        let next = free.fold(usize::MAX, |best, k| {
            if best == usize::MAX || rest[(k, k)] > rest[(best, best)] { k } else { best }
        });
        let pivot = rest[(next, next)].max(f64::MIN_POSITIVE);
        let column = rest.column(next).into_owned();
        rest -= &column * column.transpose() / pivot;
        chosen.push(next);
    }
    chosen.sort_unstable();
    chosen
}

//! Weights of the FRFs by their noise and by what a first fit leaves of them.

use std::f64::consts::SQRT_2;

use super::data::Data;
use super::frf_power::{noise_rms, rms};
use super::plscf::{Pole, normalise_largest};
use super::refine::{FitPoint, Problem};
use rotordyn_linalg::Complex64;

/// Reweights every FRF by its noise and by the misfit of a fit; returns its poles in the new scales.
///
/// The misfit, over the size of an FRF, is the median of all, as far as its own may differ from that by chance: weights by
/// each FRF's own would follow the few that the model happens to fit.
pub(super) fn reweight(data: &mut Data, found: FitPoint) -> Vec<Pole> {
    let fit = Problem::new(data).fit(&found);
    let model = fit.synthesise(data, &found.poles);
    let frfs: Vec<FrfMisfit> = data
        .values
        .iter()
        .flatten()
        .zip(model.iter().flatten())
        .map(|(frf, model)| FrfMisfit::new(frf, model))
        .collect();
    let mut misfits: Vec<f64> = frfs.iter().filter(|f| f.square > 0.0).map(|f| f.misfit).collect();
    misfits.sort_by(f64::total_cmp);
    let median = misfits.get(misfits.len() / 2).copied().unwrap_or(0.0);
    let chance = ChanceLimits::of(misfits.len());
    let sizes = |row: &[FrfMisfit]| row.iter().map(|frf| frf.size(median, &chance)).collect();
    let mut sizes: Vec<Vec<f64>> = frfs.chunks(data.inputs()).map(sizes).collect();
    // Lower limit of the scale: a thousandth of the largest residual.
    let floor = 1e-3 * sizes.iter().flatten().copied().fold(0.0, f64::max);
    sizes.iter_mut().flatten().for_each(|size| *size = size.max(floor));
    let b = data.rescale(&sizes);
    let mut poles = found.poles;
    for pole in &mut poles {
        pole.participation.iter_mut().zip(&b).for_each(|(l, b)| *l /= b);
        pole.participation = normalise_largest(std::mem::take(&mut pole.participation));
    }
    poles
}

/// What a fit leaves of an FRF.
struct FrfMisfit {
    /// Mean squares of the FRF and of its noise.
    square: f64,
    noise: f64,
    /// Mean square of the residuals without noise, over that of the FRF.
    misfit: f64,
}

/// Misfits over their median that are no chance: smaller and larger ones.
///
/// Misfits by chance are squares of Gaussian errors; of n such ones the largest and the smallest exceed these limits in about
/// 40 %: P(z² > largest) = P(z² < smallest) = 1/(2n).
struct ChanceLimits {
    smallest: f64,
    largest: f64,
}

/// Median of the square of a Gaussian of unit variance.
const MEDIAN_SQUARE: f64 = 0.454_936;

impl ChanceLimits {
    fn of(count: usize) -> Self {
        let share = 0.5 / count.max(1) as f64;
        // P(|z| > limit) falls from 1 to 0: bisection.
        let limit = |share: f64| {
            let (mut low, mut high) = (0.0, 20.0);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if libm::erfc(middle / SQRT_2) > share { low = middle } else { high = middle }
            }
            low
        };
        let over_median = |share: f64| limit(share).powi(2) / MEDIAN_SQUARE;
        Self { smallest: over_median(1.0 - share), largest: over_median(share) }
    }
}

impl FrfMisfit {
    fn new(frf: &[Complex64], model: &[Complex64]) -> Self {
        let (square, noise) = (rms(frf).powi(2), noise_rms(frf).powi(2));
        let rest = frf.iter().zip(model).map(|(h, m)| (h - m).norm_sqr()).sum::<f64>() / frf.len() as f64;
        let misfit = if square > 0.0 { (rest - noise).max(0.0) / square } else { 0.0 };
        Self { square, noise, misfit }
    }

    /// RMS of the errors of the FRF.
    fn size(&self, median: f64, chance: &ChanceLimits) -> f64 {
        let misfit = if self.misfit > chance.largest * median {
            self.misfit / chance.largest
        } else if self.misfit < chance.smallest * median {
            self.misfit / chance.smallest
        } else {
            median
        };
        (self.noise + misfit * self.square).sqrt()
    }
}

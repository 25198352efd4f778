//! Weights of the FRFs by their noise and by what a first fit leaves of them.

use super::data::{Data, noise_rms, rms};
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
    let inputs = data.inputs();
    let mut sizes: Vec<Vec<f64>> =
        frfs.chunks(inputs).map(|row| row.iter().map(|frf| frf.size(median)).collect()).collect();
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

/// The own misfit of an FRF over the median of all, above and below which it is no chance: the squares of Gaussian errors
/// exceed ten times their median in 3 %, and fall below a thirtieth of it in 10 %.
const CHANCE_ABOVE: f64 = 10.0;
const CHANCE_BELOW: f64 = 1.0 / 30.0;

impl FrfMisfit {
    fn new(frf: &[Complex64], model: &[Complex64]) -> Self {
        let (square, noise) = (rms(frf).powi(2), noise_rms(frf).powi(2));
        let rest = frf.iter().zip(model).map(|(h, m)| (h - m).norm_sqr()).sum::<f64>() / frf.len() as f64;
        let misfit = if square > 0.0 { (rest - noise).max(0.0) / square } else { 0.0 };
        Self { square, noise, misfit }
    }

    /// RMS of the errors of the FRF.
    fn size(&self, median: f64) -> f64 {
        let misfit = if self.misfit > CHANCE_ABOVE * median {
            self.misfit / CHANCE_ABOVE
        } else if self.misfit < CHANCE_BELOW * median {
            self.misfit / CHANCE_BELOW
        } else {
            median
        };
        (self.noise + misfit * self.square).sqrt()
    }
}

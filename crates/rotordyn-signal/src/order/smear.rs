//! Maxima of orders that the averaging over a window, or a narrow filter, lowers.
//!
//! What averages an amplitude that changes within its reach lowers a maximum. The amplitude itself is not known, but the
//! same averaging once more shows it: what it takes from the averaged maximum (q of it) grows with what the first one took.
//! A neighbouring order does not disturb this, as the first averaging has removed it, and neither does the slow turn of the
//! phase of a line that is off its order.

use rustfft::num_complex::Complex;
use serde::{Deserialize, Serialize};
use std::f64::consts::{FRAC_PI_2, PI, SQRT_2};

/// Loss of a maximum at which it is named.
const LOSS: f64 = 0.1;
/// What the second averaging takes at the maximum over the median of what it takes along the run: noise and modulation
/// change an amplitude everywhere (by windows up to 6; by the filter, where the change of phase counts as well, up to 3), a
/// resonance at its maximum.
const DISTINCT_WINDOW: f64 = 8.0;
const DISTINCT_FILTER: f64 = 4.0;
/// Least number of places for that median.
const MIN_PLACES: usize = 5;
/// Bins by which a line may be off its order.
const OFF_BINS: f64 = 0.6;
/// Loss of a maximum over q, from sweeps through a resonance (quality factor 10 to 300, rates that take 6 % to 600 % of
/// the reach for the half-power width): for a Hann window the least loss, for the two-pole filter the loss within 2 %.
const OF_WINDOW: [[f64; 2]; 5] = [[0.0, 0.0], [0.045, 0.1], [0.07, 0.17], [0.081, 0.4], [0.09, 0.6]];
const OF_FILTER: [[f64; 2]; 5] = [[0.0, 0.0], [0.055, 0.1], [0.15, 0.44], [0.21, 0.76], [0.245, 0.95]];

/// Maximum of an order that is too low.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Smear {
    pub order: f64,
    /// Speed of the maximum \[rpm\].
    pub rpm: f64,
    /// Estimated loss of the amplitude, relative to the one without averaging.
    pub loss: f64,
}

impl Smear {
    /// Lower bound of the loss in coarse steps: of a resonance whose ringing lasts, the estimate is up to half too high.
    pub fn least_loss(&self) -> f64 {
        match self.loss {
            loss if loss >= 0.5 => 0.33,
            loss if loss >= 0.3 => 0.2,
            _ => LOSS,
        }
    }
}

/// Part of the range of speeds at either end in which a maximum is that of the run's beginning or end, where amplitudes grow
/// or stay, not a passage.
const ENDS: f64 = 0.05;

/// Whether a speed is passed: within the range of `rpm`, apart from its ends.
pub(crate) fn is_passed(rpm: f64, all: &[f64]) -> bool {
    let [low, high] = [f64::min, f64::max].map(|of: fn(f64, f64) -> f64| all.iter().copied().fold(rpm, of));
    let margin = ENDS * (high - low);
    rpm > low + margin && rpm < high - margin
}

/// Amplitude by windows, and by windows a quarter of one before and behind.
pub(super) type Neighbours = [Complex<f64>; 3];

/// What averaging once more over a window takes from an amplitude.
///
/// Σ w X over a quarter of a window before, at, and behind, w = ½, 1, ½: a Hann window's own transform to 1 %, up to the
/// edge of its main lobe. The phase may turn steadily, as that of a line off its order by up to 0.6 bins.
pub(super) fn taken_by_window([before, at, behind]: Neighbours) -> f64 {
    let averaged = |k: i32| {
        let turn = Complex::from_polar(0.5, f64::from(k) / 12.0 * OFF_BINS * FRAC_PI_2);
        0.5 * (at + before * turn + behind * turn.conj()).norm()
    };
    at.norm() - (-12..=12).map(averaged).fold(0.0, f64::max)
}

/// Loss by windows: `size` of the amplitude at the maximum, `taken` there and at all places.
pub(super) fn loss_by_window(size: f64, taken: f64, all: &[f64]) -> Option<f64> {
    let distinct = taken > DISTINCT_WINDOW * median_size(all)?;
    loss(taken / size, &OF_WINDOW).filter(|_| distinct)
}

/// Loss of the maximum of an amplitude after the two-pole filter 1/(1 + (√2 − 1)(2f/B)⁴), and its place.
///
/// `times` \[s\] of the points, `width` B \[Hz\] at each. `None` within 1/B of the ends, and in a run so short (some 10/B) that
/// most of it is the passage.
pub fn loss_by_filter(
    times: &[f64],
    amplitude: &[Complex<f64>],
    width: impl Fn(usize) -> f64,
) -> Option<(usize, f64)> {
    let averaged = |k: usize| {
        let ends = (times[k] - times[0]).min(times[times.len() - 1] - times[k]);
        let reach = (2.5 / width(k)).min(ends);
        if reach * width(k) < 1.0 {
            return None;
        }
        // e^(−a|t|) (cos at + sin a|t|) with a = √2 π f₀, f₀ = ½ B (√2 − 1)^(−¼).
        let rate = SQRT_2 * PI * 0.5 * width(k) * (SQRT_2 - 1.0).powf(-0.25);
        let first = times.partition_point(|t| *t < times[k] - reach);
        let end = times.partition_point(|t| *t <= times[k] + reach);
        let (mut sum, mut total) = (Complex::ZERO, 0.0);
        for n in first..end {
            let at = rate * (times[n] - times[k]).abs();
            let weight = (-at).exp() * (at.cos() + at.sin());
            sum += amplitude[n] * weight;
            total += weight;
        }
        Some(sum / total)
    };
    let largest = |a: &usize, b: &usize| amplitude[*a].norm().total_cmp(&amplitude[*b].norm());
    let highest = (0..times.len()).max_by(largest)?;
    let at = averaged(highest)?;
    let change = |k: usize| Some((amplitude[k] - averaged(k)?).norm());
    let all: Vec<f64> = (0..times.len()).filter_map(change).collect();
    let distinct = (amplitude[highest] - at).norm() > DISTINCT_FILTER * median_size(&all)?;
    let size = amplitude[highest].norm();
    loss(1.0 - at.norm() / size, &OF_FILTER).filter(|_| distinct).map(|loss| (highest, loss))
}

/// Median of the absolute values, of enough of them.
fn median_size(all: &[f64]) -> Option<f64> {
    let mut sizes: Vec<f64> = all.iter().map(|value| value.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    sizes.get(sizes.len() / 2).copied().filter(|_| sizes.len() >= MIN_PLACES)
}

/// Loss over the share taken, if it is named.
fn loss(share: f64, table: &[[f64; 2]]) -> Option<f64> {
    let next = table.partition_point(|row| row[0] <= share).clamp(1, table.len() - 1);
    let [[low, a], [high, b]] = [table[next - 1], table[next]];
    let loss = (a + (share - low) / (high - low) * (b - a)).min(table[table.len() - 1][1]);
    (loss >= LOSS).then_some(loss)
}

//! Refinement of a grid of frequencies or speeds around resonances.

use super::poles::Pole;
use rotordyn_linalg::Complex64;

/// Distances of the points around a pole, in parts of its half-power half-width.
///
/// At most 0.05 near the peak, where the amplitude between two points is then within 3e-4 of theirs.
const OFFSETS: [f64; 17] =
    [0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.65, 0.8, 1.0, 1.25, 1.6, 2.0, 2.6, 4.0, 7.0];
/// Deviation of a point from the line between its neighbours above which both intervals are halved, as a
/// fraction of the amplitude there.
const TOLERANCE: f64 = 1.5e-3;
/// Amplitude, as a fraction of the largest of the curve, below which the deviation is compared with that instead.
const FLOOR: f64 = 0.02;
/// Curves smaller than this fraction of the largest one are round-off.
const SMALLEST_CURVE: f64 = 1e-9;
const MAX_ROUNDS: usize = 24;
/// Largest number of points added to the grid by halving.
const MAX_ADDED: usize = 4000;
/// Smallest relative distance of two points.
const SMALLEST_STEP: f64 = 1e-9;

/// A grid that contains all requested points, and a sample at every point.
pub struct RefinedGrid<T> {
    pub points: Vec<f64>,
    pub samples: Vec<T>,
    /// Index of every requested point.
    pub requested: Vec<usize>,
}

/// Adds points to an increasing grid: around every pole within it, and where the curves bend between points.
///
/// `evaluate` gives a sample at each of some points, `curves` the complex amplitudes of all curves in a sample.
/// A grid of fewer than two points is left as it is, and so is the neighbourhood of an undamped pole.
///
/// # Errors
/// Those of `evaluate`.
pub fn refine<T, E>(
    grid: &[f64],
    poles: &[Pole],
    evaluate: impl Fn(&[f64]) -> Result<Vec<T>, E>,
    curves: impl Fn(&T) -> Vec<Complex64>,
) -> Result<RefinedGrid<T>, E> {
    let mut points = grid.to_vec();
    if grid.len() >= 2 {
        points.extend(poles.iter().flat_map(|pole| around(pole, grid)));
        points.sort_by(f64::total_cmp);
        points.dedup_by(|b, a| {
            let requested = |x: f64| grid.binary_search_by(|p| p.total_cmp(&x)).is_ok();
            (*b - *a) < SMALLEST_STEP * b.abs() && {
                // Of two nearly equal points the requested one stays.
                let drop = !(requested(*a) && requested(*b));
                if drop && requested(*b) {
                    *a = *b;
                }
                drop
            }
        });
    }
    let mut samples: Vec<Sample<T>> = Vec::new();
    let most = points.len() + MAX_ADDED;
    let mut new = points;
    for _ in 0..=MAX_ROUNDS {
        let found = evaluate(&new)?;
        samples.extend(new.iter().zip(found).map(|(&at, of)| {
            let values = curves(&of);
            let squares = values.iter().map(Complex64::norm_sqr).collect();
            Sample { at, of, values, squares }
        }));
        samples.sort_by(|a, b| a.at.total_cmp(&b.at));
        new = if grid.len() >= 2 { midpoints(&samples, poles) } else { Vec::new() };
        if new.is_empty() || samples.len() + new.len() > most {
            break;
        }
    }
    let points: Vec<f64> = samples.iter().map(|s| s.at).collect();
    let requested = grid.iter().map(|x| points.partition_point(|p| p < x)).collect();
    Ok(RefinedGrid { points, samples: samples.into_iter().map(|s| s.of).collect(), requested })
}

/// A sample at a point.
struct Sample<T> {
    at: f64,
    of: T,
    /// Amplitudes of its curves, and their squared absolute values.
    values: Vec<Complex64>,
    squares: Vec<f64>,
}

/// Points around a pole within the grid, if the grid is not as fine there.
fn around(pole: &Pole, grid: &[f64]) -> Vec<f64> {
    let (first, last) = (grid[0], grid[grid.len() - 1]);
    let (at, width) = (pole.at, pole.half_width);
    let next = grid.partition_point(|x| *x <= at).clamp(1, grid.len() - 1);
    if pole.is_undamped() || grid[next] - grid[next - 1] <= OFFSETS[0] * width {
        return Vec::new();
    }
    let offsets = OFFSETS.iter().flat_map(|&d| [-d, d]).chain([0.0]);
    offsets.map(|d| at + d * width).filter(|x| (first..=last).contains(x)).collect()
}

/// Midpoints of the intervals beside points that deviate from the line between their neighbours.
///
/// Squares are compared, which takes no square roots.
fn midpoints<T>(samples: &[Sample<T>], poles: &[Pole]) -> Vec<f64> {
    let count = samples.first().map_or(0, |s| s.squares.len());
    let mut peaks = vec![0.0_f64; count];
    for sample in samples {
        let finite = peaks.iter_mut().zip(&sample.squares).filter(|(_, square)| square.is_finite());
        finite.for_each(|(peak, square)| *peak = peak.max(*square));
    }
    let largest = peaks.iter().copied().fold(0.0, f64::max);
    let shown: Vec<usize> =
        (0..count).filter(|&k| peaks[k] > SMALLEST_CURVE * SMALLEST_CURVE * largest).collect();
    let mut split = vec![false; samples.len()];
    for i in 1..samples.len().saturating_sub(1) {
        let [a, b, c] = [&samples[i - 1], &samples[i], &samples[i + 1]];
        let part = (b.at - a.at) / (c.at - a.at);
        let bends = shown.iter().any(|&k| {
            let [p, q, r] = [a.values[k], b.values[k], c.values[k]];
            let local = a.squares[k].max(b.squares[k]).max(c.squares[k]).max(FLOOR * FLOOR * peaks[k]);
            (q - (p + (r - p) * part)).norm_sqr() > TOLERANCE * TOLERANCE * local
        });
        if bends {
            (split[i - 1], split[i]) = (true, true);
        }
    }
    let near_undamped = |low: f64, high: f64| {
        let width = high - low;
        poles.iter().any(|p| p.is_undamped() && p.at > low - width && p.at < high + width)
    };
    (0..samples.len().saturating_sub(1))
        .filter(|&i| split[i])
        .map(|i| [samples[i].at, samples[i + 1].at])
        .filter(|[low, high]| high - low > 4.0 * SMALLEST_STEP * high && !near_undamped(*low, *high))
        .map(|[low, high]| 0.5 * (low + high))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    /// Σ r/(p² − x² + 2jζpx) of unit static values.
    fn response(modes: &[(f64, f64)], x: f64) -> Complex64 {
        modes.iter().map(|(p, z)| p * p / Complex64::new(p * p - x * x, 2.0 * z * p * x)).sum()
    }

    #[test]
    fn the_largest_amplitude_is_right_however_coarse_the_grid() {
        let modes = [(31.3_f64, 1e-4_f64), (58.1, 0.03), (77.7, 2e-3)];
        let poles: Vec<Pole> =
            modes.iter().map(|(p, z)| Pole::new(p * (1.0 - z * z).sqrt(), z * p)).collect();
        for count in [3_usize, 12, 100] {
            let grid: Vec<f64> = (0..count).map(|k| 100.0 * k as f64 / (count - 1) as f64).collect();
            let evaluate = |x: &[f64]| Ok::<_, Infallible>(x.iter().map(|x| response(&modes, *x)).collect());
            let Ok(found) = refine(&grid, &poles, evaluate, |h: &Complex64| vec![*h]);
            assert!(found.points.windows(2).all(|w| w[0] < w[1]));
            assert!(grid.iter().zip(&found.requested).all(|(x, &i)| found.points[i] == *x));
            for (p, z) in modes {
                let near = |x: &f64| (x - p).abs() < 4.0 * z * p;
                let largest = found.points.iter().filter(|x| near(x)).map(|x| response(&modes, *x).norm());
                let exact = (0..40_001).map(|k| p * (1.0 + 4.0 * z * (f64::from(k) / 20_000.0 - 1.0)));
                let exact = exact.map(|x| response(&modes, x).norm()).fold(0.0, f64::max);
                let error = largest.fold(0.0, f64::max) / exact - 1.0;
                assert!(error.abs() < 5e-4, "{count} points, mode at {p}: {error:e}");
            }
            // Smooth: between the points the curve deviates little from straight lines.
            for w in found.points.windows(2) {
                let [a, b] = [response(&modes, w[0]), response(&modes, w[1])];
                let middle = response(&modes, 0.5 * (w[0] + w[1]));
                let off =
                    (middle - 0.5 * (a + b)).norm() / middle.norm().max(a.norm()).max(b.norm()).max(100.0);
                assert!(off < 5e-3, "{count} points, at {}: {off:e}", w[0]);
            }
        }
    }

    #[test]
    fn single_points_and_undamped_poles_are_left_alone() {
        let evaluate =
            |x: &[f64]| Ok::<_, Infallible>(x.iter().map(|x| response(&[(10.0, 0.0)], *x)).collect());
        let Ok(one) = refine(&[9.0], &[Pole::new(10.0, 0.1)], evaluate, |h: &Complex64| vec![*h]);
        assert_eq!(one.points, [9.0]);
        let grid: Vec<f64> = (0..30).map(|k| f64::from(k) + 0.5).collect();
        let Ok(found) = refine(&grid, &[Pole::new(10.0, 0.0)], evaluate, |h: &Complex64| vec![*h]);
        let nearest = found.points.iter().map(|x| (x - 10.0).abs()).fold(f64::INFINITY, f64::min);
        assert!(nearest >= 0.1 && found.points.len() < 300, "{nearest} {}", found.points.len());
    }
}

//! Lines of other orders in the band of an order cut or in the pass band of a tracked order.

use super::order::OrderSpectrogram;
use super::segment::Level;

/// Share of the power read that a neighbour's line must have to be named: the level is then 15 % too high.
const SHARE: f64 = 0.25;
/// Power of a line over the background in a bin, from which it is a line.
const OVER_BACKGROUND: f64 = 10.0;
/// Steps of the least squares, one unknown after the other.
const STEPS: usize = 1000;

/// A line of another order in what is read for an order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Neighbour {
    pub order: f64,
    /// RMS of everything that is read, and of the part of the other line in it.
    pub read: f64,
    pub part: f64,
}

impl<A> OrderSpectrogram<A> {
    /// Mean squares of lines at `orders` that explain the power-averaged spectrum `average` best, and of the background in a bin.
    ///
    /// Least squares of P_k = Σ_ν p_ν W²(k − ν)/W²(0) + c with p, c ≥ 0 over the bins that the lines reach: lines nearer than a
    /// bin are told apart where their phases to each other change along the run.
    fn line_powers(&self, average: &[f64], orders: &[f64]) -> (Vec<f64>, f64) {
        let spacing = self.orders.get(1).copied().unwrap_or(1.0);
        let reach = self.window.main_lobe_half_width() + 1.0;
        // Bin 0 is the mean.
        let bins: Vec<usize> = (1..average.len().min(self.orders.len()))
            .filter(|k| orders.iter().any(|order| (*k as f64 - order / spacing).abs() <= reach))
            .collect();
        let to_power = if self.level == Level::Peak { 0.5 } else { 1.0 };
        let power: Vec<f64> = bins.iter().map(|k| to_power * average[*k].powi(2)).collect();
        let shape = |order: &f64| -> Vec<f64> {
            bins.iter().map(|k| self.window.line_shape(*k as f64 - order / spacing).powi(2)).collect()
        };
        let mut columns: Vec<Vec<f64>> = orders.iter().map(shape).collect();
        columns.push(vec![1.0; bins.len()]);
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let mut found = vec![0.0; columns.len()];
        let mut rest = power;
        for _ in 0..STEPS {
            for (value, column) in found.iter_mut().zip(&columns) {
                let step = dot(column, &rest) / dot(column, column).max(f64::MIN_POSITIVE);
                let next = (*value + step).max(0.0);
                rest.iter_mut().zip(column).for_each(|(r, c)| *r -= (next - *value) * c);
                *value = next;
            }
        }
        let background = found.pop().unwrap_or(0.0);
        (found, background)
    }

    /// The line of one of the orders `others` that has most of what the cut `order` ± `half_band` reads, if a quarter of its power or
    /// more.
    ///
    /// `average`: power-averaged spectrum of this map. Others are those whose main lobe reaches the band.
    pub fn neighbour_in_cut(
        &self,
        average: &[f64],
        order: f64,
        half_band: f64,
        others: &[f64],
    ) -> Option<Neighbour> {
        let spacing = *self.orders.get(1)?;
        let band = self.band(order, half_band);
        let share = self.line_share(band.clone(), order);
        let reach = half_band + self.window.main_lobe_half_width() * spacing;
        let part = |other: f64, power: f64| power * self.line_share(band.clone(), other) / share;
        let to_power = if self.level == Level::Peak { 0.5 } else { 1.0 };
        let read: f64 =
            band.clone().filter_map(|k| average.get(k)).map(|a| to_power * a * a).sum::<f64>() / share;
        self.strongest(average, order, reach, others, read, part)
    }

    /// The same of a line that the Vold-Kalman filter of a −3 dB bandwidth of `width` orders tracks with a mean square of `read`:
    /// it lets a line at Δ through with 1/(1 + (√2 − 1)(2Δ/width)⁴).
    pub fn neighbour_in_track(
        &self,
        average: &[f64],
        order: f64,
        width: f64,
        read: f64,
        others: &[f64],
    ) -> Option<Neighbour> {
        let passed = |other: f64| {
            1.0 / (1.0 + (std::f64::consts::SQRT_2 - 1.0) * (2.0 * (other - order) / width).powi(4))
        };
        self.strongest(average, order, width, others, read, |other, power| power * passed(other).powi(2))
    }

    fn strongest(
        &self,
        average: &[f64],
        order: f64,
        reach: f64,
        others: &[f64],
        read: f64,
        part: impl Fn(f64, f64) -> f64,
    ) -> Option<Neighbour> {
        let mut lines = vec![order];
        lines.extend(others.iter().filter(|other| **other != order && (*other - order).abs() < 2.0 * reach));
        let (powers, background) = self.line_powers(average, &lines);
        let near = lines.iter().zip(&powers).skip(1).filter(|(other, power)| {
            (*other - order).abs() < reach && **power > OVER_BACKGROUND * background
        });
        let parts = near.map(|(other, power)| (*other, part(*other, *power)));
        let (other, part) = parts.max_by(|a, b| a.1.total_cmp(&b.1))?;
        (part > SHARE * read).then(|| Neighbour {
            order: other,
            read: read.sqrt(),
            part: part.min(read).sqrt(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::order::{OrderSettings, OrderTracker};
    use super::*;
    use std::f64::consts::TAU;

    /// Order spectrum of lines (order, RMS) in noise of RMS 0.05, at a resolution of 0.05 orders.
    fn spectrum(lines: &[(f64, f64)]) -> (OrderSpectrogram, Vec<f64>) {
        let mut state = 5u64;
        let mut uniform = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        };
        let angle: Vec<f64> = (0..30_000).map(|k| TAU * 25.0 * f64::from(k) / 1000.0).collect();
        let sample = |a: &f64| {
            let line = |(order, rms): &(f64, f64)| rms * std::f64::consts::SQRT_2 * (order * a + order).cos();
            lines.iter().map(line).sum::<f64>() + 0.09 * uniform()
        };
        let record: Vec<f64> = angle.iter().map(sample).collect();
        let mut tracker = OrderTracker::new(&angle, 1000.0, OrderSettings::new(0.05, 8.0)).unwrap();
        let over_angle = tracker.resample(&[&record]).unwrap().swap_remove(0);
        let map = tracker.spectrogram(&over_angle);
        let average = map.average(0.0, 1e9).unwrap();
        (map, average)
    }

    const HARMONICS: [f64; 6] = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];

    /// A bearing line 0.0366 orders beside 3x: where 3x alone has a line it is named, where the bearing has its own it is not.
    #[test]
    fn harmonic_by_a_bearing_line_is_named_where_it_has_a_line() {
        let (map, average) = spectrum(&[(1.0, 1.0), (3.0, 0.7), (5.0, 0.5)]);
        let found = map.neighbour_in_cut(&average, 3.0366, 0.05, &HARMONICS).unwrap();
        assert!(found.order == 3.0 && found.read > 0.5 && found.part > 0.9 * found.read, "{found:?}");
        let found = map.neighbour_in_track(&average, 3.0366, 0.2, 0.45, &HARMONICS).unwrap();
        assert!(found.order == 3.0 && found.part > 0.6, "{found:?}");
        for lines in
            [&[(1.0, 1.0), (3.0366, 0.7)][..], &[(1.0, 1.0), (3.0, 0.1), (3.0366, 0.7)], &[(1.0, 1.0)]]
        {
            let (map, average) = spectrum(lines);
            assert_eq!(map.neighbour_in_cut(&average, 3.0366, 0.05, &HARMONICS), None, "{lines:?}");
        }
        // A pass band that is narrow enough.
        assert_eq!(map.neighbour_in_track(&average, 3.0366, 0.01, 0.01, &HARMONICS), None);
    }

    /// Two orders a bin apart: the weaker one is named, the stronger one and orders that are apart are not.
    #[test]
    fn stronger_order_in_the_band_is_named() {
        let (map, average) = spectrum(&[(1.0, 0.7), (1.05, 0.35)]);
        let found = map.neighbour_in_cut(&average, 1.05, 0.05, &[1.0, 2.0]).unwrap();
        assert!(found.order == 1.0 && (found.read - 0.7).abs() < 0.15, "{found:?}");
        assert_eq!(map.neighbour_in_cut(&average, 1.0, 0.05, &[1.05, 2.0]), None);
        let (map, average) = spectrum(&[(1.0, 0.7), (1.2, 0.35)]);
        assert_eq!(map.neighbour_in_cut(&average, 1.2, 0.05, &[1.0, 2.0]), None);
    }
}

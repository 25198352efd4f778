//! Order subtraction: sines at multiples of the shaft angle are removed from the record.
//!
//! In overlapping Hann windows, which add up to 1, the complex amplitudes of all orders are fitted by least squares, and
//! the fit is subtracted. What remains has notches of 2/L around the orders for windows of the length L, so L is as long as
//! the speed allows.

use std::f64::consts::{PI, TAU};

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;
use rotordyn_linalg::{Complex64, fft_length};
use rustfft::FftPlanner;

use super::prepare::Prepared;
use super::result::Harmonic;
use super::settings::Shaft;

/// Most orders that are removed.
const MAX_ORDERS: usize = 200;
/// Windows per record at a steady speed.
const STEADY_WINDOWS: f64 = 12.0;
/// Change of the speed over the record from which it is not steady.
const STEADY: f64 = 0.02;

/// Shaft angle \[rad\] at every sample and mean speed \[rev/s\], if known; a steady speed is refined within a tolerance.
pub(super) fn shaft_angle(data: &Prepared, shaft: &Shaft, tolerance: f64) -> Option<(Vec<f64>, f64)> {
    let n = data.len();
    match shaft {
        Shaft::Unknown => None,
        Shaft::Steady(speed) => {
            let speed = refined_speed(data, *speed, tolerance);
            Some(((0..n).map(|k| TAU * speed * k as f64 / data.rate).collect(), speed))
        }
        Shaft::Angle(angle) => {
            let at = |k: usize| {
                let place = (data.first + k) as f64 * data.step;
                let i = (place as usize).min(angle.len() - 2);
                angle[i] + (place - i as f64) * (angle[i + 1] - angle[i])
            };
            let theta: Vec<f64> = (0..n).map(at).collect();
            let speed = ((theta[n - 1] - theta[0]) / TAU * data.rate / (n - 1) as f64).abs();
            Some((theta, speed))
        }
    }
}

/// Speeds \[rev/s\] that a tenth of the record each is below and above.
pub(super) fn usual_speeds(data: &Prepared, theta: &[f64]) -> [f64; 2] {
    const PARTS: usize = 100;
    let length = (data.len() - 1) / PARTS;
    let speed = |part: usize| {
        let from = part * length;
        ((theta[from + length] - theta[from]) / TAU * data.rate / length as f64).abs()
    };
    let mut speeds: Vec<f64> = (0..PARTS).map(speed).collect();
    speeds.sort_by(f64::total_cmp);
    [speeds[PARTS / 10], speeds[PARTS - 1 - PARTS / 10]]
}

/// Speed within the tolerance whose multiples stand out most from the spectrum of the record.
fn refined_speed(data: &Prepared, stated: f64, tolerance: f64) -> f64 {
    let spectrum = Spectrum::new(data);
    let step = spectrum.step;
    let highest = ((data.band[1] / stated) as usize).clamp(1, 20);
    let score = |speed: f64| -> f64 {
        (1..=highest)
            .map(|order| (1.0 + spectrum.height((order as f64 * speed / step).round() as usize)).ln())
            .sum()
    };
    let half = (tolerance * stated * highest as f64 / (0.5 * step)).ceil() as i64;
    let speeds = (-half..=half).map(|i| stated + i as f64 * 0.5 * step / highest as f64);
    let (best, top) =
        speeds.map(|v| (v, score(v))).fold((stated, f64::MIN), |a, b| if b.1 > a.1 { b } else { a });
    // Without harmonics the stated speed holds.
    if top > score(stated) + 6.0 { best } else { stated }
}

/// Half the range in which an order that is no multiple of the speed is looked for, relative: balls slip by up to 2 %, but rarely.
const ORDER_RANGE: f64 = 0.015;
/// Height of a line over the median around from which it refines an order; for noise 1e-9 per line.
const CLEAR_LINE: f64 = 21.0;

/// Orders at the lines near them, for a steady speed; an order without a clear line stays as given.
pub(super) fn refined_orders(data: &Prepared, speed: f64, orders: &[f64]) -> Vec<f64> {
    if orders.is_empty() {
        return Vec::new();
    }
    let spectrum = Spectrum::new(data);
    let refined = |order: &f64| {
        let line = |k: usize| k as f64 * spectrum.step / speed;
        let is_multiple = |k: usize| (line(k) - line(k).round()).abs() * speed < 4.0 * spectrum.step;
        let ends = [1.0 - ORDER_RANGE, 1.0 + ORDER_RANGE].map(|end| order * end * speed / spectrum.step);
        let (from, to) = (ends[0].floor().max(1.0) as usize, ends[1].ceil() as usize);
        let near = (from..=to.min(spectrum.power.len() - 1)).filter(|k| !is_multiple(*k));
        let best = near.max_by(|a, b| spectrum.power[*a].total_cmp(&spectrum.power[*b]));
        best.filter(|k| spectrum.height(*k) > CLEAR_LINE).map_or(*order, line)
    };
    orders.iter().map(refined).collect()
}

/// Hann-windowed power spectrum of the whole record, summed over the channels, twice as fine as its resolution.
struct Spectrum {
    power: Vec<f64>,
    /// \[Hz\].
    step: f64,
}

impl Spectrum {
    fn new(data: &Prepared) -> Self {
        let n = fft_length(2 * data.len(), 2);
        let fft = FftPlanner::<f64>::new().plan_fft_forward(n);
        let mut power = vec![0.0; n / 2];
        for samples in &data.samples {
            let mut buffer = vec![Complex64::default(); n];
            let length = samples.len() as f64;
            for (k, (slot, x)) in buffer.iter_mut().zip(samples).enumerate() {
                slot.re = x * (PI * k as f64 / length).sin().powi(2);
            }
            fft.process(&mut buffer);
            power.iter_mut().zip(&buffer).for_each(|(sum, v)| *sum += v.norm_sqr());
        }
        Spectrum { power, step: data.rate / n as f64 }
    }

    /// Power over the median of the 80 lines around; 0 near the ends.
    fn height(&self, k: usize) -> f64 {
        if k < 40 || k + 40 >= self.power.len() {
            return 0.0;
        }
        let mut around: Vec<f64> = self.power[k - 40..=k + 40].to_vec();
        let median = *around.select_nth_unstable_by(40, f64::total_cmp).1;
        self.power[k] / median.max(f64::MIN_POSITIVE)
    }
}

/// Subtracts the multiples of the shaft speed and the other orders that have a line from all channels; returns these.
///
/// Where an order has no line its subtraction would cut a notch into the response to the random forces.
pub(super) fn subtract(data: &mut Prepared, theta: &[f64], speed: f64, other: &[f64]) -> Vec<Harmonic> {
    let Some(windows) = Windows::new(data, theta, speed) else { return Vec::new() };
    let Windows { slowest, fastest, half, .. } = windows;
    let limit = 0.49 * data.rate;
    let mut orders: Vec<f64> = (1..=MAX_ORDERS).map(|k| k as f64).filter(|k| k * slowest < limit).collect();
    orders.extend(other.iter().copied().filter(|o| *o > 0.0 && o * slowest < limit && o.fract() != 0.0));
    orders.sort_by(f64::total_cmp);
    orders.dedup();
    let fits = windows.fits(data, theta, &orders, limit);
    let orders = orders_with_line(data, theta, &orders, &fits);
    if orders.is_empty() {
        return Vec::new();
    }
    windows.subtract(data, theta, &orders, limit);
    orders
        .iter()
        .filter(|order| *order * slowest < data.band[1] && *order * fastest > data.band[0])
        .map(|order| Harmonic {
            frequency: order * speed,
            half_width: (2.0 * data.rate / half as f64).max(0.5 * order * (fastest - slowest)),
            order: Some(*order),
            kurtosis: -1.5,
            removed: true,
        })
        .collect()
}

/// Most sines that are subtracted at a time.
const MAX_SINES: usize = 100;

/// Subtracts sines of constant frequency.
pub(super) fn subtract_sines(data: &mut Prepared, mut lines: Vec<Harmonic>) -> Vec<Harmonic> {
    lines.sort_by(|a, b| a.kurtosis.total_cmp(&b.kurtosis));
    lines.truncate(MAX_SINES);
    // As orders of one turn a second.
    let theta: Vec<f64> = (0..data.len()).map(|k| TAU * k as f64 / data.rate).collect();
    let Some(windows) = Windows::new(data, &theta, 1.0) else { return Vec::new() };
    let frequencies: Vec<f64> = lines.iter().map(|line| line.frequency).collect();
    windows.subtract(data, &theta, &frequencies, 0.49 * data.rate);
    lines.into_iter().map(|line| Harmonic { removed: true, ..line }).collect()
}

/// Power of an order over that of the noise in the same bandwidth, in the mean over windows and in one window, from which it is a
/// line. Noise has exponentially distributed powers of mean 1: 12 windows have a mean above 2.5 in one of 10⁴ cases, a single one
/// of 16 in one of 10⁷.
const MEAN_POWER: f64 = 2.5;
const LARGEST_POWER: f64 = 16.0;
/// Frequencies around an order that measure the noise: 3 to 5 cycles per window below and above.
const NEIGHBOURS: usize = 6;

/// Orders with a line in any channel.
fn orders_with_line(data: &Prepared, theta: &[f64], orders: &[f64], fits: &[Window]) -> Vec<f64> {
    let has_line = |o: usize| {
        let mut sums = vec![[0.0; 3]; data.channels()];
        for own in fits.iter().filter(|own| own.powers[o].iter().any(|power| *power > 0.0)) {
            let noise = noise(data, theta, orders[o], own);
            for ((sum, power), noise) in sums.iter_mut().zip(&own.powers[o]).zip(noise) {
                *sum = [sum[0] + power, sum[1] + noise, sum[2].max(power / noise.max(f64::MIN_POSITIVE))];
            }
        }
        sums.iter().any(|[power, noise, largest]| *power > MEAN_POWER * noise || *largest > LARGEST_POWER)
    };
    let found: Vec<bool> = (0..orders.len()).into_par_iter().map(has_line).collect();
    orders.iter().zip(found).filter(|(_, found)| *found).map(|(order, _)| *order).collect()
}

/// Power in the bandwidth of a window near an order, by channels: of what the fit leaves at its neighbours.
fn noise(data: &Prepared, theta: &[f64], order: f64, own: &Window) -> Vec<f64> {
    let span = own.to - own.from;
    let mut sums = vec![[Complex64::default(); NEIGHBOURS]; data.channels()];
    for k in 0..span {
        let base = Complex64::from_polar(1.0, -order * theta[own.from + k]);
        let one_cycle = Complex64::from_polar(1.0, -TAU * k as f64 / span as f64);
        let third = one_cycle * one_cycle * one_cycle;
        let [fourth, fifth] = [third * one_cycle, third * one_cycle * one_cycle];
        let turns = [fifth.conj(), fourth.conj(), third.conj(), third, fourth, fifth].map(|turn| base * turn);
        for (c, sums) in sums.iter_mut().enumerate() {
            let rest = data.samples[c][own.from + k] - own.tracked[c][k];
            sums.iter_mut().zip(&turns).for_each(|(sum, turn)| *sum += turn * rest);
        }
    }
    let mean = |sums: &[Complex64; NEIGHBOURS]| {
        sums.iter().map(|sum| 2.0 * (sum / span as f64).norm_sqr()).sum::<f64>() / NEIGHBOURS as f64
    };
    sums.iter().map(mean).collect()
}

/// Overlapping Hann windows, as long as the speed allows; window w covers (w − 1) half .. (w + 1) half.
struct Windows {
    slowest: f64,
    fastest: f64,
    half: usize,
    samples: usize,
}

impl Windows {
    fn new(data: &Prepared, theta: &[f64], speed: f64) -> Option<Self> {
        let (n, rate) = (data.len(), data.rate);
        let over = (rate / speed.max(1e-9)).ceil().min(n as f64 / 4.0) as usize + 1;
        let speed_at = |k: usize| {
            let (a, b) = (k.saturating_sub(over), (k + over).min(n - 1));
            ((theta[b] - theta[a]) / TAU * rate / (b - a) as f64).abs()
        };
        let speeds = (0..=200).map(|i| speed_at(i * (n - 1) / 200));
        let (slowest, fastest) = speeds.fold((f64::MAX, 0.0f64), |(a, b), v| (a.min(v), b.max(v)));
        let steady = fastest - slowest < STEADY * speed;
        // Windows with at least 8 revolutions, so that neighbouring orders are apart; at a changing speed no longer than that.
        let revolutions = 8.0 * rate / slowest.max(0.1 * speed).max(1e-9);
        let length = if steady { (n as f64 / STEADY_WINDOWS).max(revolutions) } else { 4.0 * revolutions };
        let half = ((0.5 * length) as usize).clamp(8, n / 2);
        (fastest > 0.0).then_some(Windows { slowest, fastest, half, samples: n })
    }

    /// Subtracts the fits of the orders, weighted by the windows, which add up to 1.
    fn subtract(&self, data: &mut Prepared, theta: &[f64], orders: &[f64], limit: f64) {
        for own in self.fits(data, theta, orders, limit) {
            for k in own.from..own.to {
                let x = (k as f64 - own.middle as f64) / self.half as f64;
                let weight = 0.5 + 0.5 * (PI * x).cos();
                for (c, samples) in data.samples.iter_mut().enumerate() {
                    samples[k] -= weight * own.tracked[c][k - own.from];
                }
            }
        }
    }

    /// Least-squares fits of the orders in all windows with enough samples for them.
    fn fits(&self, data: &Prepared, theta: &[f64], orders: &[f64], limit: f64) -> Vec<Window> {
        let of_window = |w: usize| {
            let middle = w * self.half;
            let (from, to) = (middle.saturating_sub(self.half), (middle + self.half).min(self.samples));
            (to > from + 2 * orders.len()).then(|| fit(data, theta, orders, [from, middle, to], limit))
        };
        (0..=self.samples.div_ceil(self.half)).into_par_iter().filter_map(of_window).collect()
    }
}

/// Fit of one window.
struct Window {
    from: usize,
    middle: usize,
    to: usize,
    /// Sum of all orders, `[channel][sample]`.
    tracked: Vec<Vec<f64>>,
    /// Mean square of each order by channels; 0 for those beyond the sampling.
    powers: Vec<Vec<f64>>,
}

fn fit(data: &Prepared, theta: &[f64], orders: &[f64], [from, middle, to]: [usize; 3], limit: f64) -> Window {
    let span = to - from;
    let speed = ((theta[to - 1] - theta[from]) / TAU * data.rate / (span - 1) as f64).abs();
    let used: Vec<usize> = (0..orders.len()).filter(|&o| orders[o] * speed < limit).collect();
    let columns = 2 * used.len();
    let basis = DMatrix::from_fn(span, columns, |k, j| {
        let phase = orders[used[j / 2]] * theta[from + k];
        if j % 2 == 0 { phase.cos() } else { phase.sin() }
    });
    let right = DMatrix::from_fn(span, data.channels(), |k, c| data.samples[c][from + k]);
    let mut gram = basis.tr_mul(&basis);
    // Orders that a window cannot separate share their amplitude.
    (0..columns).for_each(|j| gram[(j, j)] *= 1.0 + 1e-9);
    let amplitudes = match gram.cholesky() {
        Some(factor) => factor.solve(&basis.tr_mul(&right)),
        None => DMatrix::zeros(columns, data.channels()),
    };
    let tracked = (0..data.channels())
        .map(|c| (&basis * DVector::from(amplitudes.column(c).into_owned())).as_slice().to_vec())
        .collect();
    let mut powers = vec![vec![0.0; data.channels()]; orders.len()];
    for (j, &o) in used.iter().enumerate() {
        for (c, power) in powers[o].iter_mut().enumerate() {
            *power = 0.5 * amplitudes.view((2 * j, c), (2, 1)).norm_squared();
        }
    }
    Window { from, middle, to, tracked, powers }
}

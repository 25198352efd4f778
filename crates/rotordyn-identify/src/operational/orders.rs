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
                let place = k as f64 * data.step;
                let i = (place as usize).min(angle.len() - 2);
                angle[i] + (place - i as f64) * (angle[i + 1] - angle[i])
            };
            let theta: Vec<f64> = (0..n).map(at).collect();
            let speed = ((theta[n - 1] - theta[0]) / TAU * data.rate / (n - 1) as f64).abs();
            Some((theta, speed))
        }
    }
}

/// Speed within the tolerance whose multiples stand out most from the spectrum of the record.
fn refined_speed(data: &Prepared, stated: f64, tolerance: f64) -> f64 {
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
    let step = data.rate / n as f64;
    let highest = ((data.band[1] / stated) as usize).clamp(1, 20);
    let score = |speed: f64| -> f64 {
        (1..=highest)
            .map(|order| {
                let k = (order as f64 * speed / step).round() as usize;
                if k < 40 || k + 40 >= power.len() {
                    return 0.0;
                }
                let mut around: Vec<f64> = power[k - 40..=k + 40].to_vec();
                let median = *around.select_nth_unstable_by(40, f64::total_cmp).1;
                (1.0 + power[k] / median.max(f64::MIN_POSITIVE)).ln()
            })
            .sum()
    };
    let half = (tolerance * stated * highest as f64 / (0.5 * step)).ceil() as i64;
    let speeds = (-half..=half).map(|i| stated + i as f64 * 0.5 * step / highest as f64);
    let (best, top) =
        speeds.map(|v| (v, score(v))).fold((stated, f64::MIN), |a, b| if b.1 > a.1 { b } else { a });
    // Without harmonics the stated speed holds.
    if top > score(stated) + 6.0 { best } else { stated }
}

/// Subtracts multiples of the shaft speed and other orders from all channels; returns what was found at each order.
pub(super) fn subtract(data: &mut Prepared, theta: &[f64], speed: f64, other: &[f64]) -> Vec<Harmonic> {
    let n = data.len();
    let rate = data.rate;
    let speed_at = |k: usize, over: usize| {
        let (a, b) = (k.saturating_sub(over), (k + over).min(n - 1));
        ((theta[b] - theta[a]) / TAU * rate / (b - a) as f64).abs()
    };
    let over = (rate / speed.max(1e-9)).ceil().min(n as f64 / 4.0) as usize + 1;
    let samples = (0..=200).map(|i| speed_at(i * (n - 1) / 200, over));
    let (slowest, fastest) = samples.fold((f64::MAX, 0.0f64), |(a, b), v| (a.min(v), b.max(v)));
    let steady = fastest - slowest < STEADY * speed;
    let limit = 0.49 * rate;
    let mut orders: Vec<f64> = (1..=MAX_ORDERS).map(|k| k as f64).filter(|k| k * slowest < limit).collect();
    orders.extend(other.iter().copied().filter(|o| *o > 0.0 && o * slowest < limit && o.fract() != 0.0));
    orders.sort_by(f64::total_cmp);
    orders.dedup();
    if orders.is_empty() {
        return Vec::new();
    }
    // Windows with at least 8 revolutions, so that neighbouring orders are apart; at a changing speed no longer than that.
    let revolutions = 8.0 * rate / slowest.max(0.1 * speed).max(1e-9);
    let length = if steady { (n as f64 / STEADY_WINDOWS).max(revolutions) } else { 4.0 * revolutions };
    let half = ((0.5 * length) as usize).clamp(8, n / 2);
    let count = n.div_ceil(half) + 1;
    // Window w covers (w − 1) half .. (w + 1) half.
    let of_window = |w: usize| {
        let (from, to) = ((w * half).saturating_sub(half), ((w + 1) * half).min(n));
        (to > from + 2 * orders.len()).then(|| fit(data, theta, &orders, from, to, limit))
    };
    let fits: Vec<Option<Window>> = (0..count).into_par_iter().map(of_window).collect();
    let mut powers = vec![0.0; orders.len()];
    for (w, own) in fits.iter().enumerate() {
        let Some(own) = own else { continue };
        let (from, to) = ((w * half).saturating_sub(half), ((w + 1) * half).min(n));
        for k in from..to {
            let x = (k as f64 - w as f64 * half as f64) / half as f64;
            let weight = 0.5 + 0.5 * (PI * x).cos();
            for (c, samples) in data.samples.iter_mut().enumerate() {
                samples[k] -= weight * own.tracked[c][k - from];
            }
        }
        powers.iter_mut().zip(&own.powers).for_each(|(sum, own)| *sum += own / count as f64);
    }
    orders
        .iter()
        .zip(&powers)
        .filter(|(order, _)| *order * slowest < data.band[1] && *order * fastest > data.band[0])
        .filter(|(_, power)| **power > 1e-6)
        .map(|(order, _)| Harmonic {
            frequency: order * speed,
            half_width: (2.0 * rate / half as f64).max(0.5 * order * (fastest - slowest)),
            order: Some(*order),
            kurtosis: -1.5,
            removed: true,
        })
        .collect()
}

/// Fit of one window.
struct Window {
    /// Sum of all orders, `[channel][sample]`.
    tracked: Vec<Vec<f64>>,
    /// Mean square of each order over all channels.
    powers: Vec<f64>,
}

fn fit(data: &Prepared, theta: &[f64], orders: &[f64], from: usize, to: usize, limit: f64) -> Window {
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
    let mut powers = vec![0.0; orders.len()];
    for (j, &o) in used.iter().enumerate() {
        let rows = amplitudes.rows(2 * j, 2);
        powers[o] = 0.5 * rows.norm_squared() / data.channels() as f64;
    }
    Window { tracked, powers }
}

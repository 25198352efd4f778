//! Order tracks: amplitude and phase of several orders over time and speed, from the Vold-Kalman filter.

use rustfft::num_complex::Complex;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

use super::SignalError;
use super::error::check;
use super::order::smear::{Smear, is_passed, loss_by_filter};
use super::vold_kalman::{Bandwidth, TrackedOrder, shaft_speed, smallest_bandwidth, vold_kalman};

/// Points of a track in the time 1/B in which the narrowest pass band at the highest speed lets an amplitude change.
const POINTS_PER_CHANGE: f64 = 20.0;
/// Samples times orders that are tracked at once: some 120 bytes each.
const MAX_UNKNOWNS: f64 = 1e7;

/// Amplitudes and phases of orders over a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OrderTracks {
    /// From the first to the last instant at which every order lies above its bandwidth \[s\].
    pub times: Vec<f64>,
    /// Shaft speed there \[rpm\], the mean over 1/bandwidth revolutions: the amplitudes resolve no shorter time.
    pub rpm: Vec<f64>,
    /// In the sequence of the request.
    pub tracks: Vec<OrderTrack>,
    /// −3 dB bandwidth in orders, and its lower limit \[Hz\].
    pub bandwidth: f64,
    pub min_bandwidth_hz: f64,
    /// RMS of the record, and of what the orders leave of it, over these times.
    pub rms: [f64; 2],
    /// Tracks whose maximum the bandwidth lowers by more than 10 %.
    #[serde(default)]
    pub smeared: Vec<Smear>,
}

/// One order of [`OrderTracks`]: x = A cos(νθ + φ).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OrderTrack {
    pub order: f64,
    /// A, peak values.
    pub amplitude: Vec<f64>,
    /// φ \[rad\], −π to π.
    pub phase: Vec<f64>,
}

/// Tracks `orders` (> 0) and the slowly varying mean of a record by the Vold-Kalman filter with a bandwidth of `width`
/// orders.
///
/// `record` (N), `theta` (N) shaft angle \[rad\], `sample_rate` \[Hz\]. A bandwidth is B = max(width f, B_min), f the shaft
/// speed \[Hz\], B_min the smallest that the record's length and rate allow. Where an order lies below its bandwidth
/// (ν f < B) it cannot be told from the mean and is left out, as are the edges: the tracks are of the longest part of the
/// record without such places.
///
/// # Errors
/// Those of [`vold_kalman`]; a shaft too slow for the lowest order throughout; samples times orders above 10⁷.
pub fn order_tracks(
    record: &[f64],
    theta: &[f64],
    sample_rate: f64,
    orders: &[f64],
    width: f64,
) -> Result<OrderTracks, SignalError> {
    let lowest = orders.iter().copied().fold(f64::INFINITY, f64::min);
    check(!orders.is_empty(), "number of orders", "one or more", 0.0)?;
    check(lowest > 0.0, "order", "more than 0", lowest)?;
    check(width <= lowest, "bandwidth in orders", "at most the lowest order tracked", width)?;
    let unknowns = record.len() as f64 * orders.len() as f64;
    let expected = "at most 1e7: a shorter part of the record, fewer orders or a lower sampling rate";
    check(unknowns <= MAX_UNKNOWNS, "samples times orders", expected, unknowns)?;
    let min_hertz = smallest_bandwidth(record.len(), sample_rate);
    let bandwidth = Bandwidth::Orders { width, min_hertz };
    let mut wanted: Vec<TrackedOrder> =
        orders.iter().map(|&order| TrackedOrder { order, bandwidth }).collect();
    // What changes more slowly than any order, such as the drift of a sensor, is none of them.
    wanted.push(TrackedOrder { order: 0.0, bandwidth: Bandwidth::Hertz(min_hertz) });
    let found = vold_kalman(record, theta, sample_rate, &wanted)?;

    let speed = shaft_speed(theta, sample_rate);
    let fastest = speed.iter().copied().fold(0.0, f64::max);
    let range = longest_run(&speed, |f| lowest * f >= (width * f).max(min_hertz));
    let expected = "above the bandwidth over the lowest order";
    check(!range.is_empty(), "highest shaft speed [Hz]", expected, fastest)?;
    let widest = (width * fastest).max(min_hertz);
    let stride = ((sample_rate / (POINTS_PER_CHANGE * widest)) as usize).max(1);
    let places: Vec<usize> = range.clone().step_by(stride).collect();
    let rms = |x: &[f64]| (x.iter().map(|v| v * v).sum::<f64>() / x.len() as f64).sqrt();
    let envelopes = &found.orders[..orders.len()];
    let tracks = envelopes.iter().map(|envelope| OrderTrack {
        order: envelope.order,
        amplitude: places.iter().map(|&n| envelope.amplitude[n].norm()).collect(),
        phase: places.iter().map(|&n| envelope.amplitude[n].arg()).collect(),
    });
    let times: Vec<f64> = places.iter().map(|&n| n as f64 / sample_rate).collect();
    let rpm: Vec<f64> =
        places.iter().map(|&n| 60.0 * mean_speed(theta, sample_rate, n, speed[n], width)).collect();
    let smeared = envelopes.iter().filter_map(|envelope| {
        let amplitude: Vec<Complex<f64>> = places.iter().map(|&n| envelope.amplitude[n]).collect();
        let band = |k: usize| (width * rpm[k] / 60.0).max(min_hertz);
        let (highest, loss) = loss_by_filter(&times, &amplitude, band)?;
        is_passed(rpm[highest], &rpm).then(|| Smear { order: envelope.order, rpm: rpm[highest], loss })
    });
    Ok(OrderTracks {
        smeared: smeared.collect(),
        tracks: tracks.collect(),
        times,
        rpm,
        bandwidth: width,
        min_bandwidth_hz: min_hertz,
        rms: [rms(&record[range.clone()]), rms(&found.remainder[range])],
    })
}

/// The pairs of orders of which one lies within the −3 dB band of the other: |ν₁ − ν₂| < width/2.
///
/// Such a pair is separated only as far as the amplitudes change more slowly than the pair beats.
pub fn orders_in_one_band(orders: &[f64], width: f64) -> Vec<[usize; 2]> {
    let pairs = (0..orders.len()).flat_map(|b| (0..b).map(move |a| [a, b]));
    pairs.filter(|&[a, b]| (orders[a] - orders[b]).abs() < 0.5 * width).collect()
}

/// Mean shaft speed over 1/`width` revolutions about sample n \[Hz\], fewer towards the ends; `speed` the one at n.
fn mean_speed(theta: &[f64], sample_rate: f64, n: usize, speed: f64, width: f64) -> f64 {
    let half = (0.5 * sample_rate / (width * speed)) as usize;
    match half.min(n).min(theta.len() - 1 - n) {
        0 => speed,
        half => ((theta[n + half] - theta[n - half]) * sample_rate / (2.0 * half as f64 * TAU)).abs(),
    }
}

/// The longest range of places where a condition holds.
fn longest_run(values: &[f64], holds: impl Fn(f64) -> bool) -> std::ops::Range<usize> {
    let (mut best, mut first) = (0..0, 0);
    for (n, value) in values.iter().enumerate() {
        if !holds(*value) {
            first = n + 1;
        } else if n + 1 - first > best.len() {
            best = first..n + 1;
        }
    }
    best
}

//! Band-limited Gaussian random function of time, such as the force of a flow or of a road.

use crate::Complex;
use crate::error::{SignalError, check};
use crate::gaussian::GaussianStream;
use std::f64::consts::PI;
use std::sync::{Mutex, PoisonError};

/// Grid points of the noise on each side of an instant that contribute to it.
const HALF: i64 = 24;
/// Grid rate over the half band width B: above 2, and so high that nothing of the periodic spectrum of the numbers is left.
const RATE: f64 = 2.5;
/// Grid points after which sin(π 2/RATE k) repeats.
const PERIOD: usize = 5;

/// A Gaussian random function of time of RMS 1 with a flat spectrum between two frequencies, at any time.
///
/// f(t) = √2 Re(n(t) e^{−i 2π f_c t}), n(t) = Σ_k g_k h(r t − k)/√E with f_c the middle of the band, B half its width,
/// rate r = 2.5 B, complex Gaussian numbers g_k of mean square 1 that are a function of seed and k, and the low-pass
/// h(d) = sinc(0.8 d) (1 − (d/24)²)³, E = ∫ h². Stationary; the spectral density is 1/(2 B) per Hz, a quarter of it (−6 dB)
/// at both edges, within 0.1 dB of flat from 9 % of B inside them, and below −60 dB from 18 % of B outside.
#[derive(Clone, Debug, PartialEq)]
pub struct BandNoise {
    /// Middle of the band \[rad/s\].
    centre: f64,
    /// Rate of the grid \[1/s\].
    rate: f64,
    seed: u64,
    /// √(2/E).
    gain: f64,
    recent: Recent,
}

/// The numbers g_k of the last instant, most of which the next one needs too, and its value. No part of the function's identity.
#[derive(Debug, Default)]
struct Recent(Mutex<Option<Box<Instant>>>);

#[derive(Debug)]
struct Instant {
    time: f64,
    value: f64,
    /// First grid point of the numbers.
    first: i64,
    numbers: [Complex<f64>; 2 * HALF as usize],
}

impl Clone for Recent {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl PartialEq for Recent {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl BandNoise {
    /// `band`: lower and upper frequency \[Hz\]; same seed, same function.
    ///
    /// # Errors
    /// A negative or non-finite frequency, an upper one that is not above the lower one.
    pub fn new([low, high]: [f64; 2], seed: u64) -> Result<Self, SignalError> {
        check(low >= 0.0 && low.is_finite(), "lower frequency", "not negative", low)?;
        check(high > low && high.is_finite(), "upper frequency", "above the lower one", high)?;
        let half_width = 0.5 * (high - low);
        // The midpoint rule is exact for a band-limited h far below the sampling.
        let steps = 16;
        let square = |k: i64| low_pass((k as f64 + 0.5) / steps as f64).powi(2);
        let energy = (-HALF * steps..HALF * steps).map(square).sum::<f64>() / steps as f64;
        Ok(Self {
            centre: PI * (low + high),
            rate: RATE * half_width,
            seed,
            gain: (2.0 / energy).sqrt(),
            recent: Recent::default(),
        })
    }

    /// Upper frequency of the band \[Hz\].
    pub fn highest_frequency(&self) -> f64 {
        0.5 * self.centre / PI + self.rate / RATE
    }

    /// Value at a time \[s\].
    pub fn at(&self, time: f64) -> f64 {
        // A panic elsewhere leaves the numbers whole: they are replaced at once.
        let mut recent = self.recent.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = recent.as_ref().filter(|known| known.time == time) {
            return known.value;
        }
        let place = time * self.rate;
        let first = place.floor() as i64 - HALF + 1;
        let numbers = self.numbers(first, recent.as_deref());
        let sum: Complex<f64> = weights(place - place.floor())
            .iter()
            .zip(&numbers)
            .map(|(weight, number)| number * *weight)
            .sum();
        let (sin, cos) = (self.centre * time).sin_cos();
        let value = self.gain * (sum.re * cos + sum.im * sin);
        let now = Instant { time, value, first, numbers };
        match &mut *recent {
            Some(known) => **known = now,
            None => *recent = Some(Box::new(now)),
        }
        value
    }

    /// g_k of the grid points from `first` on.
    fn numbers(&self, first: i64, recent: Option<&Instant>) -> [Complex<f64>; 2 * HALF as usize] {
        let number = |k: i64| GaussianStream::new(self.seed, k as u64, 0).next();
        match recent {
            Some(known) if known.first == first => known.numbers,
            Some(known) => std::array::from_fn(|i| {
                let k = first + i as i64;
                let place = usize::try_from(k - known.first).ok();
                place.and_then(|place| known.numbers.get(place)).copied().unwrap_or_else(|| number(k))
            }),
            None => std::array::from_fn(|i| number(first + i as i64)),
        }
    }
}

/// h of the grid points around an instant that lies `part` of a step behind the middle one.
fn weights(part: f64) -> [f64; 2 * HALF as usize] {
    const STEP: f64 = PI * (2.0 / RATE);
    let sines: [f64; PERIOD] = std::array::from_fn(|i| (STEP * (part - (i as i64 - HALF + 1) as f64)).sin());
    std::array::from_fn(|i| {
        let d = part - (i as i64 - HALF + 1) as f64;
        let x = STEP * d;
        let sinc = if x.abs() < 1e-4 { 1.0 - x * x / 6.0 } else { sines[i % PERIOD] / x };
        sinc * taper(d)
    })
}

/// h(d), of cutoff 0.4 of the grid rate; d within ±HALF.
fn low_pass(d: f64) -> f64 {
    let x = PI * (2.0 / RATE) * d;
    let sinc = if x.abs() < 1e-4 { 1.0 - x * x / 6.0 } else { x.sin() / x };
    sinc * taper(d)
}

fn taper(d: f64) -> f64 {
    let u = d / HALF as f64;
    (1.0 - u * u).max(0.0).powi(3)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn samples(noise: &BandNoise, rate: f64, count: usize) -> Vec<f64> {
        (0..count).map(|k| noise.at(k as f64 / rate)).collect()
    }

    /// Spectral density \[1/Hz\] at a frequency: mean over blocks with a Hann window, by sums of sines.
    fn density(x: &[f64], rate: f64, hz: f64) -> f64 {
        let length = 1000;
        let blocks = x.chunks_exact(length);
        let count = blocks.len() as f64;
        let power = |block: &[f64]| {
            let (mut sum, mut squares) = (Complex::new(0.0, 0.0), 0.0);
            for (k, value) in block.iter().enumerate() {
                let window = 0.5 - 0.5 * (TAU * k as f64 / length as f64).cos();
                sum += Complex::from_polar(value * window, -TAU * hz * k as f64 / rate);
                squares += window * window;
            }
            2.0 * sum.norm_sqr() / (rate * squares)
        };
        blocks.map(power).sum::<f64>() / count
    }

    /// Mean square 1, kurtosis 3, density 1/(high − low) inside the band and none outside; deviations by chance below 3
    /// standard errors.
    #[test]
    fn rms_spectrum_and_distribution() {
        for (band, seed) in [([0.0, 100.0], 1), ([40.0, 60.0], 2), ([5.0, 180.0], 3)] {
            let noise = BandNoise::new(band, seed).unwrap();
            let (rate, count) = (1000.0, 400_000);
            let x = samples(&noise, rate, count);
            let width = band[1] - band[0];
            // Independent values: two per second and hertz.
            let independent = 2.0 * width * count as f64 / rate;
            let moment = |p: i32| x.iter().map(|v| v.powi(p)).sum::<f64>() / count as f64;
            assert!(moment(1).abs() < 3.0 / independent.sqrt(), "{band:?}: mean {}", moment(1));
            assert!((moment(2) - 1.0).abs() < 3.0 * (2.0 / independent).sqrt(), "{band:?}: {}", moment(2));
            let kurtosis = moment(4) / moment(2).powi(2);
            assert!((kurtosis - 3.0).abs() < 3.0 * (24.0 / independent).sqrt(), "{band:?}: {kurtosis}");
            for share in [0.1, 0.3, 0.5, 0.8, 0.9] {
                let found = density(&x, rate, band[0] + share * width) * width;
                assert!((found - 1.0).abs() < 0.16, "{band:?} at {share}: {found}");
            }
            for hz in [band[0] - 0.15 * width - 4.0, band[1] + 0.15 * width + 4.0] {
                let found = density(&x, rate, hz.abs()) * width;
                assert!(hz < 0.0 || found < 1e-5, "{band:?} at {hz} Hz: {found}");
            }
        }
    }

    /// Smooth: a difference quotient over 1 us is the derivative, also across the points of the grid and at negative times.
    #[test]
    fn it_is_smooth_and_repeatable() {
        let noise = BandNoise::new([10.0, 50.0], 7).unwrap();
        assert_eq!(noise.at(0.37), noise.at(0.37));
        assert_ne!(noise.at(0.37), BandNoise::new([10.0, 50.0], 8).unwrap().at(0.37));
        for k in -2000..2000 {
            let time = 5e-4 * f64::from(k);
            let h = 1e-6;
            let [a, b, c] = [time - h, time, time + h].map(|t| noise.at(t));
            // RMS of the second derivative: (2π 33 Hz)².
            assert!((a - 2.0 * b + c).abs() < 6.0 * (TAU * 33.0 * h).powi(2), "{time}: {a} {b} {c}");
        }
    }

    /// The weights by repeated sines are h; the order in which instants are asked for changes nothing.
    #[test]
    fn values_do_not_depend_on_what_was_asked_before() {
        for part in [0.0, 1e-6, 0.3, 0.999_999] {
            for (i, weight) in weights(part).iter().enumerate() {
                let expected = low_pass(part - (i as i64 - HALF + 1) as f64);
                assert!((weight - expected).abs() < 1e-13, "{part}, {i}: {weight} {expected}");
            }
        }
        let noise = BandNoise::new([5.0, 180.0], 3).unwrap();
        let times: Vec<f64> = (0..4000).map(|k| f64::from(k * 7919 % 4001) * 1.3e-3 - 2.0).collect();
        for time in times {
            assert_eq!(noise.at(time), noise.clone().at(time));
        }
    }

    #[test]
    fn bands_that_are_none_are_refused() {
        for band in [[-1.0, 5.0], [5.0, 5.0], [6.0, 5.0], [f64::NAN, 5.0], [0.0, f64::INFINITY]] {
            assert!(BandNoise::new(band, 1).is_err(), "{band:?}");
        }
    }
}

//! Shaft orbits of two perpendicular channels: filtered orbit (1X, 2X, … ) and full spectrum.

use std::f64::consts::PI;

use rustfft::FftPlanner;
use rustfft::num_complex::Complex;
use serde::{Deserialize, Serialize};

use super::SignalError;
use super::error::{check, check_rate, check_record, check_same_length};
use super::window::WindowKind;

const J: Complex<f64> = Complex::new(0.0, 1.0);

/// Filtered (elliptic) orbit, x = Re(X e^{jνθ}), y = Re(Y e^{jνθ}), x + jy = R_f e^{jνθ} + R_b e^{−jνθ}.
///
/// Forward whirl is from x towards y, the direction of shaft rotation for increasing θ.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FilteredOrbit {
    pub order: f64,
    /// Mean position of the record.
    pub centre: [f64; 2],
    /// Complex peak amplitude along x, phase relative to cos νθ.
    pub x: Complex<f64>,
    /// Complex peak amplitude along y.
    pub y: Complex<f64>,
}

impl FilteredOrbit {
    /// Fits the order ν to two channels over the shaft angle by least squares on 1, cos νθ, sin νθ.
    ///
    /// `x`, `y` (N) \[unit\], `theta` (N) \[rad\]. Exact for any length when the record contains no other
    /// component; other orders do not leak into it over whole revolutions common to both.
    /// Errors: NaN, unequal lengths, less than one revolution of νθ.
    pub fn fit(x: &[f64], y: &[f64], theta: &[f64], order: f64) -> Result<Self, SignalError> {
        Self::weighted(x, y, theta, order, |_| 1.0)
    }

    /// The same at constant speed with Hann's weights over the record, for an orbit among other lines.
    ///
    /// Without weights a line at Δν from the order, as of ball passes, leaks by about 1/(π |Δν| N) over N turns that are not
    /// whole ones of it; with them by about 1/(π |Δν|³ N³). Errors: as [`Self::fit`].
    pub fn fit_hann(x: &[f64], y: &[f64], theta: &[f64], order: f64) -> Result<Self, SignalError> {
        let [start, end] = [theta.first(), theta.last()].map(|angle| angle.copied().unwrap_or(0.0));
        let weight = |angle: f64| (PI * (angle - start) / (end - start)).sin().powi(2);
        Self::weighted(x, y, theta, order, weight)
    }

    /// Least squares with a weight at each shaft angle.
    fn weighted(
        x: &[f64],
        y: &[f64],
        theta: &[f64],
        order: f64,
        weight: impl Fn(f64) -> f64,
    ) -> Result<Self, SignalError> {
        for (name, record) in [("x", x), ("y", y), ("shaft angle", theta)] {
            check_record(name, record)?;
            check_same_length(name, record.len(), "x", x.len())?;
        }
        check(order > 0.0 && order.is_finite(), "order", "a positive number", order)?;
        let turned = (theta[theta.len() - 1] - theta[0]).abs() * order / std::f64::consts::TAU;
        // A grid of whole revolutions contains its end point once: one sample short counts as a whole one.
        let needed = (theta.len() - 1) as f64 / theta.len() as f64;
        if turned < needed * (1.0 - 1e-9) || theta.len() < 3 {
            return Err(SignalError::TooFewRevolutions {
                needed: 1.0 / order,
                given: turned / order,
                purpose: "an orbit",
            });
        }
        let mut normal = nalgebra::Matrix3::zeros();
        let mut right = nalgebra::Matrix3x2::zeros();
        for ((x, y), angle) in x.iter().zip(y).zip(theta) {
            let (sin, cos) = (order * angle).sin_cos();
            let row = nalgebra::Vector3::new(1.0, cos, sin);
            let weight = weight(*angle);
            normal += weight * row * row.transpose();
            right += weight * row * nalgebra::RowVector2::new(*x, *y);
        }
        let fit = normal.cholesky().map(|c| c.solve(&right)).ok_or(SignalError::TooFewRevolutions {
            needed: 1.0 / order,
            given: turned / order,
            purpose: "an orbit",
        })?;
        Ok(FilteredOrbit {
            order,
            centre: [fit[(0, 0)], fit[(0, 1)]],
            x: Complex::new(fit[(1, 0)], -fit[(2, 0)]),
            y: Complex::new(fit[(1, 1)], -fit[(2, 1)]),
        })
    }

    /// Forward whirl vector R_f = (X + jY)/2, rotating with e^{+jνθ}.
    pub fn forward(&self) -> Complex<f64> {
        (self.x + J * self.y) * 0.5
    }

    /// Backward whirl vector R_b = conj(X − jY)/2, rotating with e^{−jνθ}.
    pub fn backward(&self) -> Complex<f64> {
        (self.x - J * self.y).conj() * 0.5
    }

    /// Semi-major and semi-minor axes; the minor one is negative for backward whirl.
    pub fn semi_axes(&self) -> (f64, f64) {
        let (f, b) = (self.forward().norm(), self.backward().norm());
        (f + b, f - b)
    }

    /// Inclination of the major axis from x \[rad\], (arg R_f + arg R_b)/2.
    pub fn inclination(&self) -> f64 {
        0.5 * (self.forward().arg() + self.backward().arg())
    }

    /// `points` positions along the orbit, starting at θ = 0 (keyphasor mark).
    pub fn points(&self, points: usize) -> Vec<[f64; 2]> {
        let at = |k: usize| {
            let turn = Complex::from_polar(1.0, std::f64::consts::TAU * k as f64 / points as f64);
            [self.centre[0] + (self.x * turn).re, self.centre[1] + (self.y * turn).re]
        };
        (0..points).map(at).collect()
    }
}

/// Full spectrum of an orbit: amplitude of x + jy over frequencies from −f_s/2 to f_s/2.
#[derive(Clone, Debug, PartialEq)]
pub struct FullSpectrum {
    /// Frequencies \[Hz\], increasing; negative means backward whirl.
    pub frequencies: Vec<f64>,
    /// Radius of the circular motion at each frequency.
    pub amplitude: Vec<f64>,
}

/// Full spectrum, A_k = |Σ w_n (x_n + j y_n) e^{−2πjkn/N}| / Σw for k = −⌊N/2⌋ .. ⌈N/2⌉ − 1.
///
/// `x`, `y` (N) \[unit\], `sample_rate` \[Hz\]. A forward circular orbit of radius r has amplitude r at +f.
/// Errors: NaN, unequal lengths.
/// Source: Goldman and Muszynska, Orbit 20 (1999).
pub fn full_spectrum(
    x: &[f64],
    y: &[f64],
    sample_rate: f64,
    window: WindowKind,
) -> Result<FullSpectrum, SignalError> {
    check_record("x", x)?;
    check_record("y", y)?;
    check_same_length("y", y.len(), "x", x.len())?;
    check_rate(sample_rate)?;
    let n = x.len();
    let weights = window.samples(n);
    let sum: f64 = weights.iter().sum();
    let mut data: Vec<Complex<f64>> =
        x.iter().zip(y).zip(&weights).map(|((x, y), w)| Complex::new(w * x, w * y)).collect();
    FftPlanner::new().plan_fft_forward(n).process(&mut data);
    data.rotate_right(n / 2);
    let step = sample_rate / n as f64;
    Ok(FullSpectrum {
        frequencies: (0..n).map(|k| (k as f64 - (n / 2) as f64) * step).collect(),
        amplitude: data.iter().map(|z| z.norm() / sum).collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// Ball passes of order 3.085 and their harmonics in 486.3 turns.
    #[test]
    fn ball_passes_are_not_synchronous() {
        let theta: Vec<f64> = (0..48_630).map(|k| 0.01 * TAU * f64::from(k)).collect();
        let of = |once: f64, phase: f64| -> Vec<f64> {
            let passes = |a: f64| 2.0 + (3.085 * a + phase).cos() + 0.3 * (6.17 * a).sin();
            theta.iter().map(|a| passes(*a) + once * (a + phase).cos()).collect()
        };
        let none = FilteredOrbit::fit_hann(&of(0.0, 0.4), &of(0.0, 1.1), &theta, 1.0).unwrap();
        assert!(none.semi_axes().0 < 1e-8, "{none:?}");
        // Over the last ten turns alone, without weights, a hundredth.
        let last = 47_600..48_630;
        let short =
            FilteredOrbit::fit(&of(0.0, 0.4)[last.clone()], &of(0.0, 1.1)[last.clone()], &theta[last], 1.0);
        assert!(short.unwrap().semi_axes().0 > 1e-3);
        // x = 0.02 cos(θ − π/2), y = 0.02 cos θ: backward.
        let some = FilteredOrbit::fit_hann(&of(0.02, -0.5 * PI), &of(0.02, 0.0), &theta, 1.0).unwrap();
        let (major, minor) = some.semi_axes();
        assert!((major - 0.02).abs() < 1e-8 && (minor + 0.02).abs() < 1e-8, "{some:?}");
        assert!((some.centre[0] - 2.0).abs() < 1e-8);
        assert!(FilteredOrbit::fit_hann(&theta[..50], &theta[..50], &theta[..50], 1.0).is_err());
    }
}

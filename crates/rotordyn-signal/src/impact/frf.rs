//! Frequency response functions from force and response records: hits of an impact test, and random excitation.

use rustfft::num_complex::Complex;

use super::Hit;
use crate::SignalError;
use crate::error::{check, check_rate, check_record, check_same_length};
use crate::segment::{SegmentTransform, bin_axis};
use crate::spectrum::{Densities, Welch, densities};
use crate::window::WindowKind;

/// Estimated FRF between one force and one response \[response unit per force unit\].
#[derive(Clone, Debug, PartialEq)]
pub struct FrfEstimate {
    /// Frequencies \[Hz\].
    pub frequencies: Vec<f64>,
    /// H₁ = S_fx / S_ff: unbiased for noise on the response; biased low by noise on the force.
    pub h1: Vec<Complex<f64>>,
    /// H₂ = S_xx / S_xf: unbiased for noise on the force; biased high by noise on the response.
    pub h2: Vec<Complex<f64>>,
    /// H_v = √(S_xx/S_ff) e^{j arg S_fx}, the geometric mean of H₁ and H₂: for noise on both in equal proportion.
    ///
    /// It is the total least squares estimate of records scaled to equal power; |H₁| ≤ |H_v| ≤ |H₂|. Source:
    /// Rocklin, Crowley & Vold, IMAC 3 (1985).
    pub hv: Vec<Complex<f64>>,
    /// γ² = H₁ / H₂, 0..1; it is 1 by definition with one average.
    pub coherence: Vec<f64>,
    /// Decay rate added to every pole by the exponential window \[1/s\]; 0 without one.
    pub added_decay: f64,
}

impl FrfEstimate {
    /// Damping ratio corrected for the exponential window, ζ = ζ_measured − 1/(τω_n).
    ///
    /// With the window the estimate is H(jω + 1/τ) instead of H(jω).
    pub fn true_damping_ratio(&self, measured: f64, natural_frequency_hz: f64) -> f64 {
        measured - self.added_decay / (std::f64::consts::TAU * natural_frequency_hz)
    }

    /// Pole \[1/s\] corrected for the exponential window, λ = λ_measured + 1/τ.
    pub fn true_pole(&self, measured: Complex<f64>) -> Complex<f64> {
        measured + self.added_decay
    }
}

/// FRF estimator, by the noise for which it is unbiased.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Estimator {
    /// Noise on the response.
    #[default]
    H1,
    /// Noise on the force.
    H2,
    /// Noise on both.
    Hv,
}

/// Force window and exponential window of an impact test.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct ImpactWindows {
    /// Force beyond this many samples is set to zero; `None` keeps it all.
    pub force_length: Option<usize>,
    /// Time constant τ \[s\] of the exponential window e^{−t/τ} on force and response; `None` is rectangular.
    pub time_constant: Option<f64>,
}

impl ImpactWindows {
    /// 1/τ \[1/s\]; 0 without an exponential window.
    fn decay(&self) -> Result<f64, SignalError> {
        let Some(tau) = self.time_constant else { return Ok(0.0) };
        check(tau > 0.0 && tau.is_finite(), "time constant", "a positive number of seconds", tau)?;
        Ok(1.0 / tau)
    }

    /// The windows' samples over force and response, w_n = e^{−n/(τ f_s)}, that of the force cut off.
    ///
    /// Errors: time constant not positive.
    pub fn samples(&self, length: usize, sample_rate: f64) -> Result<(Vec<f64>, Vec<f64>), SignalError> {
        let decay = self.decay()?;
        let response: Vec<f64> = (0..length).map(|n| (-decay * n as f64 / sample_rate).exp()).collect();
        let mut force = response.clone();
        force[self.force_length.unwrap_or(length).min(length)..].fill(0.0);
        Ok((force, response))
    }
}

/// FRF from one or more hits of equal length, averaged; means are not removed.
///
/// With a rectangular window that contains the whole decay the ratio of DFTs is exact for a linear system, up to
/// aliasing. `sample_rate` \[Hz\]. Errors: no hit, NaN, unequal lengths, time constant not positive.
/// Source: Ewins, Modal Testing (2000), ch. 3.
pub fn frf_from_hits(
    hits: &[Hit],
    sample_rate: f64,
    windows: ImpactWindows,
) -> Result<FrfEstimate, SignalError> {
    check_rate(sample_rate)?;
    let length = hits.first().ok_or(SignalError::Empty { name: "list of hits" })?.force.len();
    check_record("force", hits[0].force)?;
    let (force_window, response_window) = windows.samples(length, sample_rate)?;
    let mut transform = SegmentTransform::new(WindowKind::Rectangular, length, length);
    let bins = transform.bins();
    let mut sums = Densities {
        frequencies: bin_axis(bins, length, sample_rate),
        xx: vec![0.0; bins],
        yy: vec![0.0; bins],
        xy: vec![Complex::ZERO; bins],
        noise_bandwidth_hz: sample_rate / length as f64,
    };
    let mut force = vec![0.0; length];
    let mut response = vec![0.0; length];
    let mut force_spectrum = vec![Complex::ZERO; bins];
    for hit in hits {
        check_record("force", hit.force)?;
        check_record("response", hit.response)?;
        check_same_length("force", hit.force.len(), "the first hit", length)?;
        check_same_length("response", hit.response.len(), "force", length)?;
        for n in 0..length {
            force[n] = force_window[n] * hit.force[n];
            response[n] = response_window[n] * hit.response[n];
        }
        force_spectrum.copy_from_slice(transform.transform(&force, 0.0));
        for (k, (f, x)) in force_spectrum.iter().zip(transform.transform(&response, 0.0)).enumerate() {
            sums.xx[k] += f.norm_sqr();
            sums.yy[k] += x.norm_sqr();
            sums.xy[k] += f.conj() * x;
        }
    }
    Ok(estimate(sums, windows.decay()?))
}

/// FRF from long records of random excitation, by Welch averages.
///
/// Errors as [`crate::spectrum::cross_spectral_density`].
pub fn frf_from_random(
    force: &[f64],
    response: &[f64],
    sample_rate: f64,
    welch: &Welch,
) -> Result<FrfEstimate, SignalError> {
    Ok(estimate(densities(force, response, sample_rate, welch)?, 0.0))
}

/// FRF from averaged one-sided spectra, as an analyser stores them: S_ff, S_xx and S_fx = mean conj(F) X.
///
/// All in one scaling; `added_decay` \[1/s\] is that of the exponential window used, or 0. Errors:
/// different lengths, values that are not finite.
pub fn frf_from_spectra(
    frequencies: &[f64],
    force: &[f64],
    response: &[f64],
    cross: &[Complex<f64>],
    added_decay: f64,
) -> Result<FrfEstimate, SignalError> {
    check_record("auto-spectrum of the force", force)?;
    check_record("auto-spectrum of the response", response)?;
    let parts: Vec<f64> = cross.iter().flat_map(|c| [c.re, c.im]).collect();
    check_record("cross spectrum", &parts)?;
    let same = |name, given| check_same_length(name, given, "the force's auto-spectrum", force.len());
    same("frequencies", frequencies.len())?;
    same("auto-spectrum of the response", response.len())?;
    same("cross spectrum", cross.len())?;
    let sums = Densities {
        frequencies: frequencies.to_vec(),
        xx: force.to_vec(),
        yy: response.to_vec(),
        xy: cross.to_vec(),
        noise_bandwidth_hz: 0.0,
    };
    Ok(estimate(sums, added_decay))
}

/// Bins without any force or response power are zero, with zero coherence, rather than NaN.
fn estimate(d: Densities, added_decay: f64) -> FrfEstimate {
    let ratio = |a: Complex<f64>, b: Complex<f64>| if b == Complex::ZERO { b } else { a / b };
    let bins = 0..d.xx.len();
    FrfEstimate {
        h1: bins.clone().map(|k| ratio(d.xy[k], d.xx[k].into())).collect(),
        h2: bins.clone().map(|k| ratio(d.yy[k].into(), d.xy[k].conj())).collect(),
        hv: bins.clone().map(|k| geometric_mean(&d, k)).collect(),
        coherence: bins.map(|k| d.coherence(k)).collect(),
        frequencies: d.frequencies,
        added_decay,
    }
}

fn geometric_mean(d: &Densities, k: usize) -> Complex<f64> {
    let size = d.xy[k].norm();
    if d.xx[k] > 0.0 && size > 0.0 { d.xy[k] / size * (d.yy[k] / d.xx[k]).sqrt() } else { Complex::ZERO }
}

//! Simulated FRF measurement: exact FRFs with noise on force and response, averaged (H₁ estimate).

use super::FrfMatrix;
use crate::Complex;
use crate::error::{SignalError, check};
use crate::gaussian::GaussianStream;

/// Settings of a simulated test with a flat force spectrum, such as an impact test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasurementNoise {
    /// Signal-to-noise ratio (SNR) of a single block \[dB\]: 20 log of the RMS ratio over the lines, for
    /// every response and the force.
    pub signal_to_noise_db: f64,
    /// Number of averages (blocks).
    pub averages: usize,
    pub seed: u64,
}

impl FrfMatrix {
    /// H₁ estimate and coherence of these FRFs measured with white Gaussian noise: independent for every
    /// response and block, that of the force common to all responses.
    ///
    /// H₁ = Σ F* X / Σ |F|², F = 1 + n_f, X = H + n_x. Same seed, same FRFs.
    ///
    /// # Errors
    /// No average, a signal-to-noise ratio that is not finite.
    pub fn with_measurement_noise(&self, test: &MeasurementNoise) -> Result<FrfMatrix, SignalError> {
        check(test.averages > 0, "averages", "one or more", test.averages as f64)?;
        let db = test.signal_to_noise_db;
        check(db.is_finite(), "signal-to-noise ratio", "a finite number of dB", db)?;
        let noise = 10f64.powf(-db / 20.0);
        let lines = self.frequencies.len();
        let mut out = self.clone();
        let mut coherence = vec![vec![vec![0.0; lines]; self.references.len()]; self.responses.len()];
        for e in 0..self.references.len() {
            let mut force = GaussianStream::new(test.seed, e as u64, 0);
            let forces: Vec<Complex<f64>> =
                (0..lines * test.averages).map(|_| force.next() * noise + 1.0).collect();
            for (r, row) in self.values.iter().enumerate() {
                let exact = &row[e];
                let rms = (exact.iter().map(|h| h.norm_sqr()).sum::<f64>() / lines as f64).sqrt();
                let mut own = GaussianStream::new(test.seed, e as u64, r as u64 + 1);
                for k in 0..lines {
                    let (mut ff, mut xx, mut fx) = (0.0, 0.0, Complex::new(0.0, 0.0));
                    for f in &forces[k * test.averages..(k + 1) * test.averages] {
                        let x = exact[k] + own.next() * (noise * rms);
                        ff += f.norm_sqr();
                        xx += x.norm_sqr();
                        fx += f.conj() * x;
                    }
                    out.values[r][e][k] = fx / ff;
                    coherence[r][e][k] = if xx > 0.0 { fx.norm_sqr() / (ff * xx) } else { 0.0 };
                }
            }
        }
        out.coherence = Some(coherence);
        Ok(out)
    }
}

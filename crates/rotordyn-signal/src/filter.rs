//! Butterworth filters (IIR) as second-order sections (SOS), causal and zero-phase.

use std::f64::consts::PI;

use rustfft::num_complex::Complex;

use super::SignalError;
use super::error::{check, check_length, check_rate, check_record};

/// Pass band; corner frequencies \[Hz\] are the −3 dB points of one pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Band {
    LowPass(f64),
    HighPass(f64),
    BandPass(f64, f64),
}

/// A filter as a cascade of sections b₀ b₁ b₂ a₁ a₂ (a₀ = 1).
#[derive(Clone, Debug, PartialEq)]
pub struct Sections {
    sections: Vec<[f64; 5]>,
}

/// Butterworth filter of an order 1..=20 (a band-pass has twice as many poles), by the bilinear transform.
///
/// |H|² = 1 / (1 + (Ω/Ω_c)^{2n}) at prewarped frequencies Ω = tan(πf/f_s). `sample_rate` \[Hz\].
/// Errors: order out of range, corners not inside 0..f_s/2 or not increasing.
pub fn butterworth(order: usize, band: Band, sample_rate: f64) -> Result<Sections, SignalError> {
    check_rate(sample_rate)?;
    check((1..=20).contains(&order), "filter order", "1 to 20", order as f64)?;
    let warp = |f: f64| -> Result<f64, SignalError> {
        check(
            f > 0.0 && f < sample_rate / 2.0,
            "corner frequency",
            "between 0 and half the sampling rate",
            f,
        )?;
        Ok((PI * f / sample_rate).tan())
    };
    // Poles of the analogue prototype: the upper half plane and, for odd orders, the real pole.
    let prototype = (0..order.div_ceil(2)).map(|k| {
        let angle = PI * (order - 1 - 2 * k) as f64 / (2 * order) as f64;
        Complex::new(-angle.cos(), angle.sin())
    });
    let mut poles: Vec<(Complex<f64>, Complex<f64>)> = Vec::new();
    let mut single: Option<Complex<f64>> = None;
    // Point of the unit circle where the gain is 1.
    let unity: Complex<f64>;
    let zeros: [f64; 2];
    match band {
        Band::LowPass(corner) | Band::HighPass(corner) => {
            let corner = warp(corner)?;
            let low = matches!(band, Band::LowPass(_));
            unity = Complex::from(if low { 1.0 } else { -1.0 });
            zeros = if low { [-1.0; 2] } else { [1.0; 2] };
            for (k, p) in prototype.enumerate() {
                let z = bilinear(if low { corner * p } else { corner / p });
                if 2 * k + 1 == order {
                    single = Some(z);
                } else {
                    poles.push((z, z.conj()));
                }
            }
        }
        Band::BandPass(low, high) => {
            let (low, high) = (warp(low)?, warp(high)?);
            check(low < high, "upper corner over lower corner", "more than 1", high / low)?;
            let (width, centre) = (high - low, (low * high).sqrt());
            unity = bilinear(Complex::new(0.0, centre));
            zeros = [1.0, -1.0];
            for (k, p) in prototype.enumerate() {
                let half = 0.5 * width * p;
                let root = (half * half - centre * centre).sqrt();
                let (a, b) = (bilinear(half + root), bilinear(half - root));
                if 2 * k + 1 == order {
                    poles.push((a, b));
                } else {
                    poles.extend([(a, a.conj()), (b, b.conj())]);
                }
            }
        }
    }
    let mut sections: Vec<[f64; 5]> = poles
        .iter()
        .map(|(a, b)| [1.0, -(zeros[0] + zeros[1]), zeros[0] * zeros[1], -(a + b).re, (a * b).re])
        .collect();
    if let Some(p) = single {
        sections.push([1.0, -zeros[0], 0.0, -p.re, 0.0]);
    }
    let mut filter = Sections { sections };
    // The gain at `unity` is real and positive: there the analogue prototype is at s = 0.
    let gain = filter.response_at(unity).re;
    for b in &mut filter.sections[0][..3] {
        *b /= gain;
    }
    Ok(filter)
}

/// z = (1 + s) / (1 − s).
fn bilinear(s: Complex<f64>) -> Complex<f64> {
    (1.0 + s) / (1.0 - s)
}

impl Sections {
    /// The sections, each b₀ b₁ b₂ a₁ a₂.
    pub fn sections(&self) -> &[[f64; 5]] {
        &self.sections
    }

    /// Frequency response of one pass at `frequency` \[Hz\].
    pub fn response(&self, frequency: f64, sample_rate: f64) -> Complex<f64> {
        self.response_at(Complex::from_polar(1.0, 2.0 * PI * frequency / sample_rate))
    }

    fn response_at(&self, z: Complex<f64>) -> Complex<f64> {
        let w = z.inv();
        self.sections
            .iter()
            .map(|[b0, b1, b2, a1, a2]| (b0 + w * (b1 + w * b2)) / (1.0 + w * (a1 + w * a2)))
            .product()
    }

    /// Causal (forward) filtering from zero initial state; errors: empty record, NaN.
    pub fn filter(&self, record: &[f64]) -> Result<Vec<f64>, SignalError> {
        check_record("record", record)?;
        let mut out = record.to_vec();
        self.pass(&mut out, 0.0);
        Ok(out)
    }

    /// Zero-phase (forward-backward) filtering: no phase shift, gain |H|².
    ///
    /// The record is extended by odd reflection at both ends by three times the filter's taps, and each pass
    /// starts from the steady state of its first sample. Errors: NaN, record not longer than the extension.
    /// Source: Gustafsson, IEEE Trans. Signal Process. 44 (1996); padding as scipy's sosfiltfilt.
    pub fn filter_zero_phase(&self, record: &[f64]) -> Result<Vec<f64>, SignalError> {
        check_record("record", record)?;
        let first_order = self.sections.iter().filter(|s| s[2] == 0.0 && s[4] == 0.0).count();
        let pad = 3 * (2 * self.sections.len() + 1 - first_order);
        check_length("record", record.len(), pad + 1, "the filter's transients at both ends")?;
        let (start, end) = (record[0], record[record.len() - 1]);
        let mut work = Vec::with_capacity(record.len() + 2 * pad);
        work.extend(record[1..=pad].iter().rev().map(|x| 2.0 * start - x));
        work.extend_from_slice(record);
        work.extend(record[record.len() - 1 - pad..record.len() - 1].iter().rev().map(|x| 2.0 * end - x));
        for _ in 0..2 {
            let first = work[0];
            self.pass(&mut work, first);
            work.reverse();
        }
        Ok(work[pad..pad + record.len()].to_vec())
    }

    /// One pass in place (direct form II transposed), from the steady state of the constant input `before`.
    fn pass(&self, data: &mut [f64], before: f64) {
        let mut level = before;
        for [b0, b1, b2, a1, a2] in &self.sections {
            let gain = (b0 + b1 + b2) / (1.0 + a1 + a2);
            let mut s2 = (b2 - a2 * gain) * level;
            let mut s1 = (b1 - a1 * gain) * level + s2;
            level *= gain;
            for x in data.iter_mut() {
                let y = b0 * *x + s1;
                s1 = b1 * *x - a1 * y + s2;
                s2 = b2 * *x - a2 * y;
                *x = y;
            }
        }
    }
}

//! Elastic deflection of the half-spaces by discrete (FFT) convolution.
//!
//! Pressure is constant over rectangles centred on the nodes (Love 1929). The convolution along rolling is
//! computed by FFT; across, where symmetry folds the kernel, by direct summation at each frequency,
//! which needs no padding and is as fast as a second FFT for the few rows of a contact.

use std::sync::Arc;

use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::num_complex::Complex;

use super::scaled::Scaled;
use rotordyn_linalg::fft_length;

/// Columns on either side kept in real space, for the preconditioner.
pub(super) const PRECONDITIONER_COLUMNS: usize = 1;

/// The operator from pressure P to deflection, both on the half domain, index i·ny + j.
pub(super) struct Deflection {
    nx: usize,
    ny: usize,
    /// Real spectra, \[frequency\]\[source row\]\[row\].
    spectra: Vec<f64>,
    /// Spatial kernel for column distances up to [`PRECONDITIONER_COLUMNS`], \[distance\]\[row\]\[source row\].
    near: Vec<f64>,
    forward: Arc<dyn RealToComplex<f64>>,
    inverse: Arc<dyn ComplexToReal<f64>>,
    work: Work,
}

struct Work {
    line: Vec<f64>,
    spectrum: Vec<Complex<f64>>,
    scratch: Vec<Complex<f64>>,
    /// Real and imaginary parts, \[frequency\]\[row\].
    source: [Vec<f64>; 2],
    sum: Vec<f64>,
}

impl Deflection {
    pub(super) fn new(s: &Scaled) -> Self {
        let (nx, ny) = (s.nx, s.ny);
        let padded = fft_length(2 * nx, 2);
        let mut planner = RealFftPlanner::new();
        let (forward, inverse) = (planner.plan_fft_forward(padded), planner.plan_fft_inverse(padded));
        let frequencies = padded / 2 + 1;
        let kernels = s.influence();
        let near = kernels.iter().take(PRECONDITIONER_COLUMNS + 1).flatten().copied().collect();
        let mut spectra = vec![0.0; frequencies * ny * ny];
        let mut line = vec![0.0; padded];
        let mut spectrum = forward.make_output_vec();
        let scratch_length = forward.get_scratch_len().max(inverse.get_scratch_len());
        let mut scratch = vec![Complex::default(); scratch_length];
        for row in 0..ny {
            for source in 0..ny {
                // Even in the distance, so the spectrum is real. Includes 1/N of the inverse transform.
                line.fill(0.0);
                for (d, kernel) in kernels.iter().enumerate() {
                    let value = kernel[row * ny + source] / padded as f64;
                    line[d] = value;
                    line[(padded - d) % padded] = value;
                }
                transform(forward.process_with_scratch(&mut line, &mut spectrum, &mut scratch));
                for (k, value) in spectrum.iter().enumerate() {
                    spectra[(k * ny + source) * ny + row] = value.re;
                }
            }
        }
        let source = [vec![0.0; frequencies * ny], vec![0.0; frequencies * ny]];
        let work = Work { line, spectrum, scratch, source, sum: vec![0.0; ny] };
        Self { nx, ny, spectra, near, forward, inverse, work }
    }

    /// Deflection in row `row` by unit pressure in each row of the column at distance `d` ≤ [`PRECONDITIONER_COLUMNS`].
    pub(super) fn near(&self, d: usize, row: usize) -> &[f64] {
        &self.near[(d * self.ny + row) * self.ny..][..self.ny]
    }

    /// out = K p.
    pub(super) fn apply(&mut self, p: &[f64], out: &mut [f64]) {
        let Self { nx, ny, ref spectra, ref forward, ref inverse, ref mut work, .. } = *self;
        let Work { line, spectrum, scratch, source, sum } = work;
        for j in 0..ny {
            line.fill(0.0);
            for (i, value) in line[..nx].iter_mut().enumerate() {
                *value = p[i * ny + j];
            }
            transform(forward.process_with_scratch(line, spectrum, scratch));
            for (k, value) in spectrum.iter().enumerate() {
                source[0][k * ny + j] = value.re;
                source[1][k * ny + j] = value.im;
            }
        }
        for part in source.iter_mut() {
            for (values, matrix) in part.chunks_exact_mut(ny).zip(spectra.chunks_exact(ny * ny)) {
                sum.fill(0.0);
                for (&value, column) in values.iter().zip(matrix.chunks_exact(ny)) {
                    for (sum, k) in sum.iter_mut().zip(column) {
                        *sum += value * k;
                    }
                }
                values.copy_from_slice(sum);
            }
        }
        for j in 0..ny {
            for (k, value) in spectrum.iter_mut().enumerate() {
                *value = Complex::new(source[0][k * ny + j], source[1][k * ny + j]);
            }
            transform(inverse.process_with_scratch(spectrum, line, scratch));
            for (i, value) in line[..nx].iter().enumerate() {
                out[i * ny + j] = *value;
            }
        }
    }
}

/// `realfft` fails only for buffers of the wrong length, or a mean or Nyquist value that is not real; the
/// buffers are its own, and those values come from a real transform times real factors.
fn transform(result: Result<(), realfft::FftError>) {
    debug_assert!(result.is_ok());
}

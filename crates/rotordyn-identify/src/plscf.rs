//! Poly-reference least-squares complex frequency (pLSCF, PolyMAX): poles and participations of all orders.
//!
//! H_o(ω) A(z) = B_o(z) row by row, A(z) = Σ A_j z^j with real N_i × N_i coefficients, A₀ = I, z = e^{jωT}.
//! The numerators are eliminated output by output: M = Σ_o (T_o − S_oᵀ R_o⁻¹ S_o), and M a = 0 gives A. With
//! A₀ fixed the computational (noise) poles lie outside the unit circle: they are unstable and easily
//! separated from physical ones.
//!
//! Source: Peeters, Van der Auweraer, Guillaume & Leuridan, Shock and Vibration 11 (2004) 395; Cauberghe,
//! thesis VUB (2004), on the constraint.

use std::f64::consts::TAU;

use nalgebra::{Cholesky, DMatrix};
use rayon::prelude::*;
use rustfft::FftPlanner;

use super::data::Data;
use super::{IdentifyError, Settings};
use rotordyn_linalg::{Complex64, StopRequest, eigen, fft_length};

/// A pole with its participation vector, of one order.
#[derive(Clone, Debug)]
pub(super) struct Pole {
    /// λ \[1/s\].
    pub value: Complex64,
    /// Participation l over the inputs (scaled data), its largest entry 1.
    pub participation: Vec<Complex64>,
    /// The stable pole of many orders that this one was refined from.
    pub stable: Option<StablePole>,
    /// Whether the pole stays at its value in a refinement.
    pub held: bool,
}

/// A pole that many orders share.
#[derive(Clone, Copy, Debug)]
pub(super) struct StablePole {
    /// Median over the orders \[1/s\].
    pub value: Complex64,
    /// Standard deviations of its real and imaginary part over the orders \[1/s\].
    pub spread: [f64; 2],
    /// Sum of the similarities over the orders, relative to their number: 0..1.
    pub support: f64,
}

impl Pole {
    pub fn new(value: Complex64, participation: Vec<Complex64>) -> Self {
        Self { value, participation, stable: None, held: false }
    }

    pub fn damping_ratio(&self) -> f64 {
        damping_ratio(self.value)
    }

    /// Whether its frequency is in a band \[Hz\].
    pub fn is_inside(&self, band: [f64; 2]) -> bool {
        (band[0]..=band[1]).contains(&(self.value.im / TAU))
    }

    /// Whether it is within its half-power bandwidth of the band, so that it acts there.
    pub fn reaches_into(&self, band: [f64; 2]) -> bool {
        let (hz, bandwidth) = (self.value.im / TAU, 2.0 * self.value.re.abs() / TAU);
        hz + bandwidth >= band[0] && hz - bandwidth <= band[1]
    }
}

/// Reduced normal equations, and the mapping between z and s.
pub(super) struct NormalEquations {
    matrix: DMatrix<f64>,
    order: usize,
    inputs: usize,
    /// Sampling interval T \[s\] of z = e^{(s − j·shift)T}.
    interval: f64,
    /// rad/s.
    shift: f64,
    band: [f64; 2],
    stop: StopRequest,
}

/// Outputs per parallel chunk; chunk sums are added in order: results do not depend on the number of threads.
const OUTPUTS_PER_CHUNK: usize = 4;

impl NormalEquations {
    /// Builds M for the highest order; its leading blocks are those of all lower ones.
    pub fn new(data: &Data, settings: &Settings) -> Result<Self, IdentifyError> {
        let n = data.max_order(settings);
        let (ni, lines) = (data.inputs(), data.lines());
        // Start at most a fifth along the half circle: near its end powers of z are ill-conditioned.
        let start = ((data.frequencies[0] / data.step).round() as usize).min(lines / 4);
        let length = fft_length((2 * (start + lines)).max(2 * n + 2), 1);
        let fft = FftPlanner::<f64>::new().plan_fft_forward(length);
        // Sums Σ x_k z_k^l for l = −n..n, by one FFT: X[m] = Σ x_k e^{−2πjkm/N}.
        let sums = |series: &mut dyn Iterator<Item = Complex64>| -> Vec<f64> {
            let mut buffer = vec![Complex64::default(); length];
            for (slot, value) in buffer[start..].iter_mut().zip(series) {
                *slot = value;
            }
            fft.process(&mut buffer);
            (0..=2 * n).map(|k| buffer[(length + n - k) % length].re).collect()
        };
        // Receptances fall with ω²: mobility-like weights give all modes similar weight.
        let weight: Vec<f64> = data
            .frequencies
            .iter()
            .map(|f| if data.power == 0 { (f / data.frequencies[lines - 1]).powi(2) } else { 1.0 })
            .collect();
        let toeplitz = |lags: &[f64]| DMatrix::from_fn(n + 1, n + 1, |j, k| lags[n + k - j]);
        let r = toeplitz(&sums(&mut weight.iter().map(|w| Complex64::from(*w))));
        let r = regularised_cholesky(r).unpack();
        let part = |rows: &[Vec<Vec<Complex64>>]| {
            let mut square = DMatrix::zeros(ni * (n + 1), ni * (n + 1));
            let mut lags = vec![vec![0.0; 2 * n + 1]; ni * ni];
            let mut s = DMatrix::<f64>::zeros(n + 1, ni * (n + 1));
            for row in rows {
                for i in 0..ni {
                    let own = sums(&mut row[i].iter().zip(&weight).map(|(h, w)| h * *w));
                    for k in 0..=n {
                        for j in 0..=n {
                            s[(j, k * ni + i)] = own[n + k - j];
                        }
                    }
                    for j in i..ni {
                        let pairs = row[i].iter().zip(&row[j]).zip(&weight);
                        let own = sums(&mut pairs.map(|((a, b), w)| a.conj() * b * *w));
                        lags[i * ni + j].iter_mut().zip(&own).for_each(|(total, own)| *total += own);
                    }
                }
                r.solve_lower_triangular_mut(&mut s);
                square += s.transpose() * &s;
            }
            (square, lags)
        };
        let parts: Vec<_> = data.values.par_chunks(OUTPUTS_PER_CHUNK).map(part).collect();
        let mut square = DMatrix::zeros(ni * (n + 1), ni * (n + 1));
        let mut lags = vec![vec![0.0; 2 * n + 1]; ni * ni];
        for (own, own_lags) in &parts {
            square += own;
            for (total, own) in lags.iter_mut().zip(own_lags) {
                total.iter_mut().zip(own).for_each(|(total, own)| *total += own);
            }
        }
        let matrix = DMatrix::from_fn(ni * (n + 1), ni * (n + 1), |row, column| {
            let ((j, a), (k, b)) = ((row / ni, row % ni), (column / ni, column % ni));
            // Re Σ conj(H_b) H_a z^l is that of conj(H_a) H_b at −l.
            let t = if a <= b { lags[a * ni + b][n + k - j] } else { lags[b * ni + a][n + j - k] };
            t - square[(row, column)]
        });
        let first_line = data.frequencies[0] / data.step - start as f64;
        Ok(Self {
            matrix,
            order: n,
            inputs: ni,
            interval: 1.0 / (length as f64 * data.step),
            shift: TAU * data.step * first_line,
            band: data.band(),
            stop: settings.stop.clone(),
        })
    }

    /// Poles of every requested order with a frequency in the band and a positive damping ratio.
    pub fn poles(&self, orders: &[usize]) -> Result<Vec<Vec<Pole>>, IdentifyError> {
        let ni = self.inputs;
        let size = ni * self.order;
        let block = self.matrix.view((ni, ni), (size, size)).into_owned();
        // Leading blocks of the Cholesky factor are those of the leading blocks.
        let lower = regularised_cholesky(block).unpack();
        let mut right = -self.matrix.view((ni, 0), (size, ni)).into_owned();
        lower.solve_lower_triangular_mut(&mut right);
        let of = |&n: &usize| {
            IdentifyError::if_stopped(&self.stop)?;
            self.poles_of(n, &lower, &right)
        };
        orders.par_iter().map(of).collect()
    }

    fn poles_of(
        &self,
        n: usize,
        lower: &DMatrix<f64>,
        right: &DMatrix<f64>,
    ) -> Result<Vec<Pole>, IdentifyError> {
        let ni = self.inputs;
        let size = n * ni;
        let mut a = right.rows(0, size).into_owned();
        lower.view((0, 0), (size, size)).tr_solve_lower_triangular_mut(&mut a);
        // lᵀ A(z) = 0 with μ = 1/z: μⁿ l + Σ μ^{n−j} A_jᵀ l = 0.
        let mut companion_matrix = DMatrix::zeros(size, size);
        for j in 0..n {
            for row in 0..ni {
                for column in 0..ni {
                    companion_matrix[(row, j * ni + column)] = -a[(j * ni + column, row)];
                }
            }
        }
        for k in ni..size {
            companion_matrix[(k, k - ni)] = 1.0;
        }
        let (values, vectors) = eigen::general(&companion_matrix)?;
        let mut poles = Vec::new();
        for (k, mu) in values.iter().enumerate() {
            if mu.norm_sqr() == 0.0 {
                continue;
            }
            let unshifted = mu.inv().ln() / self.interval;
            let value = unshifted + Complex64::new(0.0, self.shift);
            let hz = value.im / TAU;
            let damping = damping_ratio(value);
            let inside = hz >= self.band[0] && hz <= self.band[1];
            if unshifted.im <= 0.0 || !inside || damping <= 0.0 {
                continue;
            }
            let l: Vec<Complex64> = (0..ni).map(|i| vectors[(size - ni + i, k)]).collect();
            poles.push(Pole::new(value, normalise_largest(l)));
        }
        poles.sort_by(|a, b| a.value.im.total_cmp(&b.value.im));
        Ok(poles)
    }
}

/// Damping ratio ζ = −Re λ/|λ|.
pub(super) fn damping_ratio(pole: Complex64) -> f64 {
    -pole.re / pole.norm()
}

/// Normalises l to a largest entry of 1.
pub(super) fn normalise_largest(mut l: Vec<Complex64>) -> Vec<Complex64> {
    let largest =
        l.iter().copied().fold(Complex64::default(), |a, b| if b.norm() > a.norm() { b } else { a });
    if largest.norm_sqr() > 0.0 {
        l.iter_mut().for_each(|v| *v /= largest);
    }
    l
}

/// Cholesky factor of a matrix that is positive definite up to round-off, with the least diagonal
/// regularisation (jitter) needed: FRFs without noise leave M singular beyond their model order.
fn regularised_cholesky(matrix: DMatrix<f64>) -> Cholesky<f64, nalgebra::Dyn> {
    let size = matrix.diagonal().amax().max(f64::MIN_POSITIVE);
    let mut jitter = 0.0;
    loop {
        let mut regularised = matrix.clone();
        for k in 0..regularised.nrows() {
            regularised[(k, k)] += jitter * size;
        }
        if let Some(found) = Cholesky::new(regularised) {
            return found;
        }
        // Terminates at the latest when the diagonal dominates.
        jitter = if jitter == 0.0 { 1e-15 } else { 10.0 * jitter };
    }
}

//! Steady harmonic response: solution of (S − ω² M + jω D) q = f.

use crate::assembly::{LinearSystem, ModalDamping};
use nalgebra::{DMatrix, DVector};
use rotordyn_linalg::{BandLayout, BandLu, Complex64, ZeroPivot, gmres};

/// Relative change of the solution at which the iteration with modal damping ends.
const TOLERANCE: f64 = 1e-13;
/// Products with the modal damping matrix before the dense solution is used instead.
const MAX_PRODUCTS: usize = 60;

/// Band storage of a linear system for harmonic solutions at any number of frequencies.
pub struct HarmonicSystem<'a> {
    system: &'a LinearSystem,
    layout: BandLayout,
    mass: Vec<f64>,
    damping: Vec<f64>,
    stiffness: Vec<f64>,
    /// Stiffness of the modal damping, with that damping.
    modal: Option<(&'a ModalDamping, Vec<f64>)>,
}

impl<'a> HarmonicSystem<'a> {
    /// Prepares the groups of unknowns coupled to those in `reached`, all of them with `None`.
    pub fn new(system: &'a LinearSystem, reached: Option<&[usize]>) -> Self {
        let layout = BandLayout::new(&system.patterns());
        let layout = reached.map_or(layout.clone(), |reached| layout.restricted_to(reached));
        let [mass, damping, stiffness] =
            [&system.mass, &system.damping, &system.stiffness].map(|a| layout.scatter(a));
        let modal = system.modal.as_deref().map(|modal| (modal, layout.scatter(&modal.stiffness)));
        Self { system, layout, mass, damping, stiffness, modal }
    }

    /// Number of unknowns.
    pub fn size(&self) -> usize {
        self.layout.size()
    }

    /// Memory for the solution at one frequency after another.
    pub fn solver(&self) -> HarmonicSolver<'_> {
        HarmonicSolver { of: self, lu: self.layout.workspace(), omega: 0.0 }
    }
}

/// The factorised dynamic stiffness at one frequency.
///
/// Modal damping C is dense. The band matrix is factorised with the proportional damping ζ (ω M + K/ω) in its
/// place, which has the same ratio ζ at ω: for an undamped mode ω_i the difference from C is a fraction
/// ζ |ω − ω_i|/(ω + ω_i) of its dynamic stiffness, so that an iteration preconditioned by it (GMRES) converges in
/// a few products with C to the solution with C itself.
pub struct HarmonicSolver<'a> {
    of: &'a HarmonicSystem<'a>,
    lu: BandLu<'a, Complex64>,
    omega: f64,
}

impl HarmonicSolver<'_> {
    /// Factorises at an angular frequency ω \[rad/s\].
    ///
    /// # Errors
    /// A singular dynamic stiffness, with an unknown of its null space.
    pub fn factor(&mut self, omega: f64) -> Result<(), ZeroPivot> {
        let of = self.of;
        let (m, d, s) = (&of.mass, &of.damping, &of.stiffness);
        let square = omega * omega;
        self.omega = omega;
        match &of.modal {
            Some((modal, k)) if omega > 0.0 => {
                let ratio = modal.ratio(omega);
                self.lu.refactor(|i| {
                    Complex64::new(s[i] - square * m[i], omega * d[i] + ratio * (square * m[i] + k[i]))
                })
            }
            _ => self.lu.refactor(|i| Complex64::new(s[i] - square * m[i], omega * d[i])),
        }
    }

    /// Replaces f by the response q; unknowns outside the prepared groups must be zero.
    pub fn solve(&self, f: &mut [Complex64]) {
        let Some((modal, _)) = self.of.modal.as_ref().filter(|_| self.omega > 0.0) else {
            self.lu.solve(f);
            return;
        };
        let load = f.to_vec();
        self.lu.solve(f);
        let n = f.len();
        // q + P⁻¹ (A − P) q = P⁻¹ f, over the real and imaginary parts.
        let split =
            |q: &[Complex64]| -> Vec<f64> { q.iter().map(|v| v.re).chain(q.iter().map(|v| v.im)).collect() };
        let joined = |x: &[f64]| -> Vec<Complex64> {
            x[..n].iter().zip(&x[n..]).map(|(&re, &im)| Complex64::new(re, im)).collect()
        };
        let start = split(f);
        let apply = |x: &[f64], out: &mut [f64]| {
            let mut rest = self.difference(modal, &joined(x));
            self.lu.solve(&mut rest);
            out.iter_mut().zip(x.iter().zip(split(&rest))).for_each(|(o, (x, r))| *o = x + r);
        };
        let found = gmres(apply, |_| {}, &start, TOLERANCE, MAX_PRODUCTS);
        if found.residual <= 1e2 * TOLERANCE {
            f.copy_from_slice(&joined(&found.solution));
        } else if let Some(q) = self.dense_solution(&load) {
            f.copy_from_slice(&q);
        }
    }

    /// (A − P) q = jω C q − jζ (ω² M + K) q.
    fn difference(&self, modal: &ModalDamping, q: &[Complex64]) -> Vec<Complex64> {
        let ratio = modal.ratio(self.omega);
        let mut out = modal.matrix.mul_complex(q);
        let (m, k) = (self.of.system.mass.mul_complex(q), modal.stiffness.mul_complex(q));
        for (o, (m, k)) in out.iter_mut().zip(m.iter().zip(&k)) {
            let rest = *o * self.omega - (m * (self.omega * self.omega) + k) * ratio;
            *o = Complex64::new(-rest.im, rest.re);
        }
        out
    }

    /// The same by dense elimination; `None` for a singular matrix.
    fn dense_solution(&self, load: &[Complex64]) -> Option<Vec<Complex64>> {
        let system = self.of.system;
        let (m, s, d) =
            (system.mass.to_dense(), system.stiffness.to_dense(), system.full_damping().to_dense());
        let n = load.len();
        let matrix = DMatrix::from_fn(n, n, |i, j| {
            Complex64::new(s[(i, j)] - self.omega * self.omega * m[(i, j)], self.omega * d[(i, j)])
        });
        let q = matrix.lu().solve(&DVector::from_column_slice(load))?;
        Some(q.iter().copied().collect())
    }
}

//! Steady harmonic response: solution of (S − ω² M + jω D) q = f.

use crate::assembly::{LinearSystem, ModalDamping};
use nalgebra::{DMatrix, DVector};
use rotordyn_linalg::complex_lanes::{ComplexLanes, LANES};
use rotordyn_linalg::refinement::{NEGLIGIBLE, PreciseResidual, complex_values, refine, relative_size};
use rotordyn_linalg::{BandLayout, BandLu, BandLuLanes, Complex64, ZeroPivot, gmres};
use std::collections::HashSet;
use std::sync::Arc;

/// Relative change of the solution at which the iteration with modal damping ends.
const TOLERANCE: f64 = 1e-13;
/// Unknowns of a group from which round-off of direct solutions may show: a shaft of a hundred elements.
const MANY_UNKNOWNS: usize = 400;
/// Products with the modal damping matrix before the dense solution is used instead.
const MAX_PRODUCTS: usize = 60;

/// Band storage of a linear system for harmonic solutions at any number of frequencies.
pub struct HarmonicSystem<'a> {
    system: &'a LinearSystem,
    layout: Arc<BandLayout>,
    mass: Vec<f64>,
    damping: Vec<f64>,
    stiffness: Vec<f64>,
    /// Stiffness of the modal damping, with that damping.
    modal: Option<(&'a ModalDamping, Vec<f64>)>,
}

impl<'a> HarmonicSystem<'a> {
    /// Prepares the groups of unknowns coupled to those in `reached`, all of them with `None`.
    pub fn new(system: &'a LinearSystem, reached: Option<&[usize]>) -> Self {
        let layout = match reached {
            Some(reached) => Arc::new(system.layout.restricted_to(reached)),
            None => system.layout.clone(),
        };
        let [mass, damping, stiffness] =
            [&system.mass, &system.damping, &system.stiffness].map(|a| layout.scatter(a));
        let modal = system.modal.as_deref().map(|modal| (modal, layout.scatter(&modal.stiffness)));
        Self { system, layout, mass, damping, stiffness, modal }
    }

    /// Number of unknowns.
    pub fn size(&self) -> usize {
        self.layout.size()
    }

    /// Memory for solutions at several frequencies at once; `None` with modal damping or round-off, which take
    /// more than one solution each.
    pub fn lanes(&self) -> Option<HarmonicLanes> {
        let direct = self.modal.is_none() && !has_round_off(&self.layout);
        direct.then(|| HarmonicLanes { lu: BandLuLanes::new(self.layout.clone()) })
    }

    /// Memory for the solution at one frequency after another.
    pub fn solver(&self) -> HarmonicSolver<'_> {
        HarmonicSolver { of: self, lu: self.layout.workspace(), omega: 0.0, refined: false }
    }
}

/// The factorised dynamic stiffness at [`LANES`] frequencies.
pub struct HarmonicLanes {
    lu: BandLuLanes,
}

impl HarmonicLanes {
    /// Factorises a system at angular frequencies ω \[rad/s\]; false where they are to be taken one by one.
    pub fn factor(&mut self, of: &HarmonicSystem, omega: &[f64; LANES]) -> bool {
        self.lu.set_frequencies([&of.mass, &of.damping, &of.stiffness], omega);
        self.lu.factor()
    }

    /// Replaces f by the responses q.
    pub fn solve(&self, f: &mut [ComplexLanes]) {
        self.lu.solve(f);
    }
}

/// Whether round-off of direct solutions may show.
pub(super) fn has_round_off(layout: &BandLayout) -> bool {
    layout.groups().any(|group| group.len() >= MANY_UNKNOWNS)
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
    /// Whether round-off of the direct solution would show.
    refined: bool,
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
        (self.omega, self.refined) = (omega, false);
        match &of.modal {
            Some((modal, k)) if omega > 0.0 => {
                let ratio = modal.ratio(omega);
                self.lu.refactor(|i| {
                    Complex64::new(s[i] - square * m[i], omega * d[i] + ratio * (square * m[i] + k[i]))
                })
            }
            _ => self.lu.refactor(|i| Complex64::new(s[i] - square * m[i], omega * d[i])),
        }?;
        self.refined = has_round_off(&of.layout) && self.shows_round_off();
        Ok(())
    }

    /// Replaces f by the response q; unknowns outside the prepared groups must be zero.
    pub fn solve(&self, f: &mut [Complex64]) {
        let load = if self.refined { f.to_vec() } else { Vec::new() };
        self.solve_directly(f);
        if self.refined {
            refine(f, |q| self.correction(&load, q));
        }
    }

    /// Modal damping, if it acts at this frequency.
    fn modal(&self) -> Option<&ModalDamping> {
        self.of.modal.as_ref().filter(|_| self.omega > 0.0).map(|(modal, _)| *modal)
    }

    fn solve_directly(&self, f: &mut [Complex64]) {
        let Some(modal) = self.modal() else { return self.lu.solve(f) };
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

    /// Whether the direct solution under inertia of equal accelerations has errors that show.
    fn shows_round_off(&self) -> bool {
        let mut load = vec![Complex64::default(); self.of.size()];
        for &i in self.of.layout.groups().flatten() {
            load[i] = 1.0.into();
        }
        let mut load = self.of.system.mass.mul_complex(&load);
        let reached: HashSet<usize> = self.of.layout.groups().flatten().copied().collect();
        load.iter_mut().enumerate().filter(|(i, _)| !reached.contains(i)).for_each(|(_, f)| *f = 0.0.into());
        let mut q = load.clone();
        self.solve_directly(&mut q);
        relative_size(&self.correction(&load, &q), &q) > NEGLIGIBLE
    }

    /// (S − ω² M + jω D)⁻¹ (f − (S − ω² M + jω D) q).
    fn correction(&self, load: &[Complex64], q: &[Complex64]) -> Vec<Complex64> {
        let parts = |of: &[Complex64]| -> [Vec<f64>; 2] {
            [of.iter().map(|v| v.re).collect(), of.iter().map(|v| v.im).collect()]
        };
        let (system, omega) = (self.of.system, self.omega);
        let ([re, im], [load_re, load_im]) = (parts(q), parts(load));
        let part = |load: &[f64], own: &[f64], other: &[f64], sign: f64| {
            let mut residual = PreciseResidual::of(load);
            residual.subtract(1.0, &system.stiffness, own);
            residual.subtract(-omega * omega, &system.mass, own);
            residual.subtract(sign * omega, &system.damping, other);
            residual
        };
        let mut out = complex_values(&part(&load_re, &re, &im, -1.0), &part(&load_im, &im, &re, 1.0));
        if let Some(modal) = self.modal() {
            // Damping acts on what the motion is, not on small differences of it: its products need no more digits.
            for (o, c) in out.iter_mut().zip(modal.matrix.mul_complex(q)) {
                *o -= Complex64::new(0.0, omega) * c;
            }
        }
        self.solve_directly(&mut out);
        out
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

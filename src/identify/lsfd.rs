//! Least-squares frequency domain: residues and residual terms of known poles.
//!
//! H_oi(s) = s^p [Σ_r (ψ_or l_ir /(s − λ_r) + conj. pair) + U_oi + V_oi / s²], s = jω, p = 0, 1, 2 for receptance,
//! mobility, accelerance. U stands for the modes above the band (a stiffness), V for those below it (a mass). With real
//! and imaginary parts of ψ, U and V as unknowns the problem is real, and its matrix the same for all outputs.

use nalgebra::{Cholesky, DMatrix};

use super::data::Data;
use super::plscf::Pole;
use crate::linalg::Complex64;

/// Rows are inputs, and for each the real, then the imaginary parts of all lines.
pub(super) struct Basis {
    s: Vec<Complex64>,
    /// s^p, times the weight of the line.
    factor: Vec<Complex64>,
    inputs: usize,
}

/// What LSFD finds.
#[derive(Clone, Debug)]
pub(super) struct Fit {
    /// ψ\[mode\]\[output\].
    pub shapes: Vec<Vec<Complex64>>,
    /// U\[output\]\[input\].
    pub upper: Vec<Vec<f64>>,
    /// V\[output\]\[input\].
    pub lower: Vec<Vec<f64>>,
}

impl Basis {
    pub fn new(data: &Data, weights: &[f64]) -> Self {
        let s = data.s();
        let factor = s.iter().zip(weights).map(|(s, w)| s.powi(data.power) * *w).collect();
        Self { s, factor, inputs: data.inputs() }
    }

    pub fn rows(&self) -> usize {
        2 * self.s.len() * self.inputs
    }

    /// Writes the columns of the real and the imaginary part of c in c g(s) + conj(c) g̃(s), g̃ being g with conjugate
    /// constants, into `matrix` for one input.
    fn put(&self, matrix: &mut DMatrix<f64>, columns: [usize; 2], input: usize, g: impl Fn(Complex64) -> [Complex64; 2]) {
        let lines = self.s.len();
        let top = 2 * lines * input;
        for (k, (s, factor)) in self.s.iter().zip(&self.factor).enumerate() {
            let [a, b] = g(*s).map(|g| g * factor);
            let (re, im) = (a + b, Complex64::i() * (a - b));
            matrix[(top + k, columns[0])] = re.re;
            matrix[(top + lines + k, columns[0])] = re.im;
            matrix[(top + k, columns[1])] = im.re;
            matrix[(top + lines + k, columns[1])] = im.im;
        }
    }

    /// Columns of Re ψ_r, Im ψ_r (mode by mode), then of U and V (input by input).
    pub fn design(&self, poles: &[Pole]) -> DMatrix<f64> {
        let modes = poles.len();
        let mut a = DMatrix::zeros(self.rows(), 2 * modes + 2 * self.inputs);
        for (r, pole) in poles.iter().enumerate() {
            for (i, l) in pole.participation.iter().enumerate() {
                let g = |s: Complex64| [l / (s - pole.value), l.conj() / (s - pole.value.conj())];
                self.put(&mut a, [2 * r, 2 * r + 1], i, g);
            }
        }
        let lines = self.s.len();
        for i in 0..self.inputs {
            for (k, (s, factor)) in self.s.iter().zip(&self.factor).enumerate() {
                let (upper, lower) = (*factor, factor / (s * s));
                let (top, column) = (2 * lines * i + k, 2 * modes + 2 * i);
                (a[(top, column)], a[(top + lines, column)]) = (upper.re, upper.im);
                (a[(top, column + 1)], a[(top + lines, column + 1)]) = (lower.re, lower.im);
            }
        }
        a
    }

    /// Columns along which the FRFs change with λ_r, and with l_ir of every input but the largest: pairs as in
    /// [`Self::design`], for the products ψ δλ and ψ δl; and what each pair belongs to.
    pub fn changes(&self, poles: &[Pole]) -> (DMatrix<f64>, Vec<Change>) {
        let mut list = Vec::new();
        for (r, pole) in poles.iter().enumerate() {
            list.push(Change { mode: r, input: None });
            let fixed = fixed_input(pole);
            list.extend((0..self.inputs).filter(|i| *i != fixed).map(|i| Change { mode: r, input: Some(i) }));
        }
        let mut d = DMatrix::zeros(self.rows(), 2 * list.len());
        for (k, change) in list.iter().enumerate() {
            let Pole { value, participation } = &poles[change.mode];
            let columns = [2 * k, 2 * k + 1];
            match change.input {
                None => {
                    for (i, l) in participation.iter().enumerate() {
                        let square = |s: Complex64, value: Complex64| ((s - value) * (s - value)).inv();
                        let g = |s: Complex64| [l * square(s, *value), l.conj() * square(s, value.conj())];
                        self.put(&mut d, columns, i, g);
                    }
                }
                Some(i) => {
                    self.put(&mut d, columns, i, |s| [(s - value).inv(), (s - value.conj()).inv()]);
                }
            }
        }
        (d, list)
    }

    /// The FRFs as columns, one an output, in the order of the rows.
    pub fn right_side(&self, outputs: &[Vec<Vec<Complex64>>], weights: &[f64]) -> DMatrix<f64> {
        let lines = self.s.len();
        let mut y = DMatrix::zeros(self.rows(), outputs.len());
        for (o, row) in outputs.iter().enumerate() {
            for (i, frf) in row.iter().enumerate() {
                for (k, (h, w)) in frf.iter().zip(weights).enumerate() {
                    y[(2 * lines * i + k, o)] = w * h.re;
                    y[(2 * lines * i + lines + k, o)] = w * h.im;
                }
            }
        }
        y
    }

    /// Unknowns of [`Self::design`], one column an output, by their names.
    pub fn fit(&self, x: &DMatrix<f64>, modes: usize) -> Fit {
        let outputs = x.ncols();
        let shape = |r: usize| (0..outputs).map(|o| Complex64::new(x[(2 * r, o)], x[(2 * r + 1, o)])).collect();
        let term = |which: usize| {
            (0..outputs)
                .map(|o| (0..self.inputs).map(|i| x[(2 * modes + 2 * i + which, o)]).collect())
                .collect()
        };
        Fit { shapes: (0..modes).map(shape).collect(), upper: term(0), lower: term(1) }
    }
}

/// A complex parameter of the fit: λ of a mode, or its participation in an input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Change {
    pub mode: usize,
    pub input: Option<usize>,
}

/// The input with the largest participation, which is 1 by definition.
pub(super) fn fixed_input(pole: &Pole) -> usize {
    let sizes = pole.participation.iter().map(|l| l.norm()).enumerate();
    sizes.fold((0, -1.0), |best, here| if here.1 > best.1 { here } else { best }).0
}

/// Least squares A x = y through the normal equations of columns of unit length: quick, for candidates.
///
/// `None` where two columns are alike to round-off.
pub(super) fn quick_solve(mut a: DMatrix<f64>, y: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let sizes: Vec<f64> = a.column_iter().map(|c| c.norm()).collect();
    for (mut column, size) in a.column_iter_mut().zip(&sizes) {
        if *size > 0.0 {
            column /= *size;
        }
    }
    let transposed = a.transpose();
    let mut gram = &transposed * &a;
    for k in 0..gram.nrows() {
        // A grain for columns alike to round-off, as two poles on one another give them.
        gram[(k, k)] += 1e-13;
    }
    let mut x = Cholesky::new(gram)?.solve(&(&transposed * y));
    for (mut row, size) in x.row_iter_mut().zip(&sizes) {
        row /= size.max(f64::MIN_POSITIVE);
    }
    Some(x)
}

/// Thin QR of a matrix with columns of unit length: Q, R and the lengths; A = Q R diag(lengths).
pub(super) fn thin_qr(mut a: DMatrix<f64>) -> (DMatrix<f64>, DMatrix<f64>, Vec<f64>) {
    let sizes: Vec<f64> = a.column_iter().map(|c| c.norm().max(f64::MIN_POSITIVE)).collect();
    for (mut column, size) in a.column_iter_mut().zip(&sizes) {
        column /= *size;
    }
    let qr = a.qr();
    (qr.q(), qr.r(), sizes)
}

/// Residue matrices \[mode\]\[output\]\[input\] of poles, each FRF on its own: no rank is assumed.
pub(super) fn free_residues(data: &Data, weights: &[f64], values: &[Complex64]) -> Vec<DMatrix<Complex64>> {
    let single = Data { values: vec![vec![data.values[0][0].clone()]], ..data.clone() };
    let basis = Basis::new(&single, weights);
    let poles: Vec<Pole> =
        values.iter().map(|&value| Pole { value, participation: vec![1.0.into()] }).collect();
    let (no, ni) = (data.outputs(), data.inputs());
    let each: Vec<Vec<Vec<Complex64>>> =
        data.values.iter().flatten().map(|frf| vec![frf.clone()]).collect();
    let y = basis.right_side(&each, weights);
    let (q, r, sizes) = thin_qr(basis.design(&poles));
    let x = back(&r, &sizes, q.transpose() * y);
    (0..values.len())
        .map(|m| DMatrix::from_fn(no, ni, |o, i| Complex64::new(x[(2 * m, o * ni + i)], x[(2 * m + 1, o * ni + i)])))
        .collect()
}

/// R⁻¹ z over the lengths of the columns; unknowns that round-off alone determines are zero.
pub(super) fn back(r: &DMatrix<f64>, sizes: &[f64], mut z: DMatrix<f64>) -> DMatrix<f64> {
    let mut mended = r.clone();
    for k in 0..mended.nrows() {
        if mended[(k, k)].abs() < 1e-14 {
            mended[(k, k)] = f64::INFINITY;
        }
    }
    for mut column in z.column_iter_mut() {
        for row in (0..mended.nrows()).rev() {
            let known: f64 = (row + 1..mended.nrows()).map(|j| mended[(row, j)] * column[j]).sum();
            column[row] = (column[row] - known) / mended[(row, row)];
        }
    }
    for (mut row, size) in z.row_iter_mut().zip(sizes) {
        row /= *size;
    }
    z
}

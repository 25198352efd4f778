//! Least-squares frequency-domain method (LSFD): residues and residual terms of known poles.
//!
//! H_oi(s) = s^p [Σ_r (ψ_or l_ir /(s − λ_r) + conj. pair) + U_oi + V_oi / s²], s = jω, p = 0, 1, 2 for
//! receptance, mobility, accelerance. U represents the modes above the band (upper residual, stiffness), V
//! those below (lower residual, mass). With real and imaginary parts of ψ, U and V as unknowns the problem is
//! real, and its matrix the same for all outputs.

use nalgebra::DMatrix;

use super::ResidualTerms;
use super::data::Data;
use super::dense::{back_substitute, thin_qr, tr_mul};
use super::plscf::Pole;
use rotordyn_linalg::Complex64;

/// Residual term of an FRF.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Residual {
    Upper,
    Lower,
}

impl Residual {
    /// The term for U = 1 or V = 1 in an FRF, with the factor s^p of its quantity.
    fn unit(self, s: Complex64, factor: Complex64) -> Complex64 {
        match self {
            Self::Upper => factor,
            Self::Lower => factor / (s * s),
        }
    }
}

/// Basis functions of the fit. Rows: for each input the real, then the imaginary parts of all lines.
#[derive(Clone)]
pub(super) struct Basis {
    s: Vec<Complex64>,
    /// s^p, (s + σ)^p with an exponential window.
    factor: Vec<Complex64>,
    inputs: usize,
    residual_terms: ResidualTerms,
    added_decay: f64,
    /// Poles with a free residue of every FRF, beside the residual terms.
    free: Vec<Complex64>,
}

/// Result of LSFD.
#[derive(Clone, Debug)]
pub(super) struct Fit {
    /// ψ\[mode\]\[output\].
    pub shapes: Vec<Vec<Complex64>>,
    /// U\[output\]\[input\].
    pub upper: Vec<Vec<f64>>,
    /// V\[output\]\[input\].
    pub lower: Vec<Vec<f64>>,
}

impl Fit {
    /// FRFs of the modal model in the data's scales, `[output][input][line]`.
    pub fn synthesise(&self, data: &Data, poles: &[Pole]) -> Vec<Vec<Vec<Complex64>>> {
        let (s, factor) = (data.s(), data.factor());
        let one = |o: usize, i: usize| {
            let value = |(s, factor): (&Complex64, &Complex64)| {
                let mut sum = self.upper[o][i] + self.lower[o][i] / (s + data.added_decay).powi(2);
                for (pole, shape) in poles.iter().zip(&self.shapes) {
                    let residue = shape[o] * pole.participation[i];
                    sum += residue / (s - pole.value) + residue.conj() / (s - pole.value.conj());
                }
                sum * factor
            };
            s.iter().zip(&factor).map(value).collect()
        };
        (0..data.outputs()).map(|o| (0..data.inputs()).map(|i| one(o, i)).collect()).collect()
    }
}

impl Basis {
    pub fn new(data: &Data) -> Self {
        let (s, factor) = (data.s(), data.factor());
        Self {
            s,
            factor,
            inputs: data.inputs(),
            residual_terms: data.residual_terms,
            added_decay: data.added_decay,
            free: Vec::new(),
        }
    }

    /// With poles that have a free residue of every FRF.
    pub fn with_free(&self, free: &[Complex64]) -> Self {
        Self { free: free.to_vec(), ..self.clone() }
    }

    pub fn rows(&self) -> usize {
        2 * self.s.len() * self.inputs
    }

    /// Writes the columns of Re c and Im c in c g(s) + conj(c) g̃(s), g̃ being g with conjugate constants,
    /// into `matrix` for one input.
    fn write_columns(
        &self,
        matrix: &mut DMatrix<f64>,
        columns: [usize; 2],
        input: usize,
        g: impl Fn(Complex64) -> [Complex64; 2],
    ) {
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

    fn residuals(&self) -> Vec<Residual> {
        let terms = self.residual_terms;
        let upper = terms.has_upper().then_some(Residual::Upper);
        upper.into_iter().chain(terms.has_lower().then_some(Residual::Lower)).collect()
    }

    /// Design matrix: columns of Re ψ_r, Im ψ_r (mode by mode), then of the residual terms (input by input),
    /// then of the free residues.
    pub fn design(&self, poles: &[Pole]) -> DMatrix<f64> {
        let modes = poles.len();
        let residuals = self.residuals();
        let first_free = 2 * modes + residuals.len() * self.inputs;
        let mut a = DMatrix::zeros(self.rows(), first_free + 2 * self.free.len() * self.inputs);
        for (r, pole) in poles.iter().enumerate() {
            for (i, l) in pole.participation.iter().enumerate() {
                let g = |s: Complex64| [l / (s - pole.value), l.conj() / (s - pole.value.conj())];
                self.write_columns(&mut a, [2 * r, 2 * r + 1], i, g);
            }
        }
        let free = self.free.iter().flat_map(|pole| (0..self.inputs).map(move |i| (i, pole)));
        for (k, (i, pole)) in free.enumerate() {
            let column = first_free + 2 * k;
            let g = |s: Complex64| [(s - pole).inv(), (s - pole.conj()).inv()];
            self.write_columns(&mut a, [column, column + 1], i, g);
        }
        let lines = self.s.len();
        let columns = (0..self.inputs).flat_map(|i| residuals.iter().map(move |residual| (i, residual)));
        for (column, (i, residual)) in (2 * modes..).zip(columns) {
            for (k, (s, factor)) in self.s.iter().zip(&self.factor).enumerate() {
                let (top, value) = (2 * lines * i + k, residual.unit(*s + self.added_decay, *factor));
                (a[(top, column)], a[(top + lines, column)]) = (value.re, value.im);
            }
        }
        a
    }

    /// Derivatives of the FRFs by λ_r, and by l_ir of every input but the largest: column pairs as in
    /// [`Self::design`], for the products ψ δλ and ψ δl; and the parameter of each pair. Held poles have none.
    pub fn derivative_columns(&self, poles: &[Pole]) -> (DMatrix<f64>, Vec<FitParameter>) {
        let mut list = Vec::new();
        for (r, pole) in poles.iter().enumerate() {
            if pole.held {
                continue;
            }
            list.push(FitParameter { mode: r, input: None });
            let fixed = normalised_input(pole);
            list.extend(
                (0..self.inputs).filter(|i| *i != fixed).map(|i| FitParameter { mode: r, input: Some(i) }),
            );
        }
        let mut d = DMatrix::zeros(self.rows(), 2 * list.len());
        for (k, change) in list.iter().enumerate() {
            let Pole { value, participation, .. } = &poles[change.mode];
            let columns = [2 * k, 2 * k + 1];
            match change.input {
                None => {
                    for (i, l) in participation.iter().enumerate() {
                        let square = |s: Complex64, value: Complex64| ((s - value) * (s - value)).inv();
                        let g = |s: Complex64| [l * square(s, *value), l.conj() * square(s, value.conj())];
                        self.write_columns(&mut d, columns, i, g);
                    }
                }
                Some(i) => {
                    self.write_columns(&mut d, columns, i, |s| [(s - value).inv(), (s - value.conj()).inv()]);
                }
            }
        }
        (d, list)
    }

    /// Right-hand side: the FRFs as columns, one per output, in the order of the rows.
    pub fn right_side(&self, outputs: &[Vec<Vec<Complex64>>]) -> DMatrix<f64> {
        let lines = self.s.len();
        let mut y = DMatrix::zeros(self.rows(), outputs.len());
        for (o, row) in outputs.iter().enumerate() {
            for (i, frf) in row.iter().enumerate() {
                for (k, h) in frf.iter().enumerate() {
                    y[(2 * lines * i + k, o)] = h.re;
                    y[(2 * lines * i + lines + k, o)] = h.im;
                }
            }
        }
        y
    }

    /// Unpacks the unknowns of [`Self::design`], one column per output.
    pub fn fit(&self, x: &DMatrix<f64>, modes: usize) -> Fit {
        let outputs = x.ncols();
        let shape =
            |r: usize| (0..outputs).map(|o| Complex64::new(x[(2 * r, o)], x[(2 * r + 1, o)])).collect();
        let residuals = self.residuals();
        let term = |wanted: Residual| -> Vec<Vec<f64>> {
            let place = residuals.iter().position(|known| *known == wanted);
            let row = |i: usize, place: usize| 2 * modes + residuals.len() * i + place;
            let value = |i: usize, o: usize| place.map_or(0.0, |place| x[(row(i, place), o)]);
            (0..outputs).map(|o| (0..self.inputs).map(|i| value(i, o)).collect()).collect()
        };
        let shapes = (0..modes).map(shape).collect();
        Fit { shapes, upper: term(Residual::Upper), lower: term(Residual::Lower) }
    }
}

/// A complex nonlinear parameter of the fit: λ of a mode, or its participation in an input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct FitParameter {
    pub mode: usize,
    pub input: Option<usize>,
}

/// The input with the largest participation, normalised to 1.
pub(super) fn normalised_input(pole: &Pole) -> usize {
    let sizes = pole.participation.iter().map(|l| l.norm()).enumerate();
    sizes.fold((0, -1.0), |best, here| if here.1 > best.1 { here } else { best }).0
}

/// Residue matrices \[mode\]\[output\]\[input\] of poles, each FRF fitted separately: no rank-one constraint.
pub(super) fn free_residues(data: &Data, values: &[Complex64]) -> Vec<DMatrix<Complex64>> {
    let single = Data { values: vec![vec![data.values[0][0].clone()]], ..data.clone() };
    let basis = Basis::new(&single);
    let poles: Vec<Pole> = values.iter().map(|&value| Pole::new(value, vec![1.0.into()])).collect();
    let (no, ni) = (data.outputs(), data.inputs());
    let each: Vec<Vec<Vec<Complex64>>> = data.values.iter().flatten().map(|frf| vec![frf.clone()]).collect();
    let y = basis.right_side(&each);
    let (q, r, sizes) = thin_qr(basis.design(&poles));
    let x = back_substitute(&r, &sizes, tr_mul(&q, &y));
    (0..values.len())
        .map(|m| {
            DMatrix::from_fn(no, ni, |o, i| {
                Complex64::new(x[(2 * m, o * ni + i)], x[(2 * m + 1, o * ni + i)])
            })
        })
        .collect()
}

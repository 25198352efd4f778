//! Semismooth Newton method for film, cavitation and load balance on one grid.
//!
//! Complementarity min(P, R/d) = 0 at every node, with R linearised where R/d < P and P = 0 elsewhere, and the
//! rigid separation H₀ closing Σ w P = 1. The linear systems are dense because of the deflection: GMRES, with
//! a banded preconditioner that truncates the deflection after [`PRECONDITIONER_COLUMNS`] columns.

use super::deflection::{Deflection, PRECONDITIONER_COLUMNS};
use super::reynolds::{self, Row, STENCIL_POINTS, neighbour};
use super::scaled::Scaled;
use crate::contact::Lubricant;
use rotordyn_linalg::{BandMatrix, dot, gmres};

/// Convergence tolerance on the RMS of min(P, R/d).
const TOLERANCE: f64 = 1e-6;
const MAX_ITERATIONS: usize = 60;
const KRYLOV_TOLERANCE: f64 = 1e-2;
const KRYLOV_SPACE: usize = 200;
const MAX_HALVINGS: usize = 8;

/// Pressure, film and separation on a grid, with residual and convergence.
#[derive(Clone, Debug)]
pub(super) struct Field {
    pub pressure: Vec<f64>,
    pub film: Vec<f64>,
    /// H₀, film minus deflection at the centre.
    pub separation: f64,
    /// RMS of min(P, R/d).
    pub residual: f64,
    pub iterations: usize,
    pub converged: bool,
}

/// Initial guess of the iteration.
pub(super) struct InitialGuess {
    pub pressure: Vec<f64>,
    /// H₀, raised if the film were thinner than `least_film` anywhere.
    pub separation: f64,
    pub least_film: f64,
}

/// Iterates until convergence or stagnation.
pub(super) fn solve(s: &Scaled, lubricant: &Lubricant, start: InitialGuess) -> Field {
    let mut newton = Newton::new(s, lubricant);
    let minimum_gap = newton.film(&start.pressure, 0.0).into_iter().fold(f64::INFINITY, f64::min);
    let separation = start.separation.max(start.least_film - minimum_gap);
    let film = newton.film(&start.pressure, separation);
    let pressure = start.pressure;
    let mut field =
        Field { pressure, film, separation, residual: f64::INFINITY, iterations: 0, converged: false };
    for iteration in 0..=MAX_ITERATIONS {
        field.iterations = iteration;
        reynolds::rows(s, lubricant, &field.pressure, &field.film, &mut newton.rows);
        newton.rescale();
        newton.update_active_set(&field.pressure);
        field.residual = newton.merit(&field.pressure, &newton.rows);
        let imbalance = 1.0 - dot(&s.weights, &field.pressure);
        field.converged = field.residual <= TOLERANCE && imbalance.abs() <= 1e-10;
        if field.converged || !field.residual.is_finite() || iteration == MAX_ITERATIONS {
            break;
        }
        let Some(step) = newton.step(&field.pressure, imbalance) else { break };
        match newton.line_search(&field, &step) {
            Some(next) => field = next,
            None => break,
        }
    }
    field
}

struct Newton<'a> {
    s: &'a Scaled,
    lubricant: &'a Lubricant,
    deflection: Deflection,
    rows: Vec<Row>,
    /// Divisor d of each row, so that R/d is a pressure.
    scale: Vec<f64>,
    /// Nodes in the full film; the others (cavitated) have P = 0.
    full: Vec<bool>,
    band: BandMatrix,
}

impl<'a> Newton<'a> {
    fn new(s: &'a Scaled, lubricant: &'a Lubricant) -> Self {
        let n = s.nx * s.ny;
        let (lower, upper) =
            ((PRECONDITIONER_COLUMNS + 3) * s.ny - 1, (PRECONDITIONER_COLUMNS + 2) * s.ny - 1);
        Self {
            s,
            lubricant,
            deflection: Deflection::new(s),
            rows: Vec::with_capacity(n),
            scale: vec![1.0; n],
            full: vec![false; n],
            band: BandMatrix::zeros(n, lower, upper),
        }
    }

    /// H = H₀ + gap + K P.
    fn film(&mut self, pressure: &[f64], separation: f64) -> Vec<f64> {
        let mut film = vec![0.0; pressure.len()];
        self.deflection.apply(pressure, &mut film);
        film.iter_mut().zip(&self.s.gap).for_each(|(h, gap)| *h += separation + gap);
        film
    }

    /// Row scaling d from the diagonal of the linearised equations.
    fn rescale(&mut self) {
        for (node, (row, scale)) in self.rows.iter().zip(&mut self.scale).enumerate() {
            let j = node % self.s.ny;
            let own = self.deflection.near(0, j)[j];
            *scale = row.by_pressure[0].max(0.0) + row.by_film[0].abs() * own + f64::MIN_POSITIVE;
        }
    }

    /// Active set: divides the nodes into full film and cavitation.
    fn update_active_set(&mut self, pressure: &[f64]) {
        for (node, full) in self.full.iter_mut().enumerate() {
            *full = self.s.is_inner(node) && self.rows[node].residual / self.scale[node] < pressure[node];
        }
    }

    fn merit(&self, pressure: &[f64], rows: &[Row]) -> f64 {
        let sum: f64 = (0..rows.len())
            .filter(|&node| self.s.is_inner(node))
            .map(|node| pressure[node].min(rows[node].residual / self.scale[node]).powi(2))
            .sum();
        (sum / rows.len() as f64).sqrt()
    }

    /// Newton step of (P, H₀).
    fn step(&mut self, pressure: &[f64], imbalance: f64) -> Option<Vec<f64>> {
        let n = pressure.len();
        self.fill_band();
        self.band.factor().ok()?;
        let Self { s, deflection, rows, scale, full, band, .. } = self;
        let ny = s.ny;
        let mut right = vec![0.0; n + 1];
        let mut border = vec![0.0; n];
        for node in 0..n {
            right[node] = if full[node] { -rows[node].residual / scale[node] } else { -pressure[node] };
            if full[node] {
                border[node] = rows[node].by_film.iter().sum::<f64>() / scale[node];
            }
        }
        right[n] = imbalance;
        let mut inverse_border = border;
        band.solve(&mut inverse_border);
        let pivot = dot(&s.weights, &inverse_border);
        let mut film = vec![0.0; n];
        let apply = |v: &[f64], out: &mut [f64]| {
            deflection.apply(&v[..n], &mut film);
            film.iter_mut().for_each(|h| *h += v[n]);
            for node in 0..n {
                out[node] = v[node];
                if full[node] {
                    let row = &rows[node];
                    let mut sum = 0.0;
                    for point in 0..STENCIL_POINTS {
                        let (a, b) = (row.by_pressure[point], row.by_film[point]);
                        if a != 0.0 || b != 0.0 {
                            let other = neighbour(node, point, ny);
                            sum += a * v[other] + b * film[other];
                        }
                    }
                    out[node] = sum / scale[node];
                }
            }
            out[n] = dot(&s.weights, &v[..n]);
        };
        let precondition = |v: &mut [f64]| {
            band.solve(&mut v[..n]);
            let separation = (dot(&s.weights, &v[..n]) - v[n]) / pivot;
            v[..n].iter_mut().zip(&inverse_border).for_each(|(v, b)| *v -= separation * b);
            v[n] = separation;
        };
        let found = gmres(apply, precondition, &right, KRYLOV_TOLERANCE, KRYLOV_SPACE);
        found.solution.iter().all(|v| v.is_finite()).then_some(found.solution)
    }

    /// Linearised equations with the deflection truncated after [`PRECONDITIONER_COLUMNS`] columns.
    fn fill_band(&mut self) {
        let Self { s, deflection, rows, scale, full, band, .. } = self;
        let (nx, ny) = (s.nx, s.ny);
        let lower = (PRECONDITIONER_COLUMNS + 3) * ny - 1;
        band.clear();
        for node in 0..rows.len() {
            let line = band.row_mut(node);
            if !full[node] {
                line[lower] = 1.0;
                continue;
            }
            for point in 0..STENCIL_POINTS {
                let (a, b) = (rows[node].by_pressure[point], rows[node].by_film[point]);
                if a == 0.0 && b == 0.0 {
                    continue;
                }
                let other = neighbour(node, point, ny);
                line[other + lower - node] += a / scale[node];
                let (i, j) = (other / ny, other % ny);
                for column in
                    i.saturating_sub(PRECONDITIONER_COLUMNS)..=(i + PRECONDITIONER_COLUMNS).min(nx - 1)
                {
                    let near = deflection.near(i.abs_diff(column), j);
                    let start = column * ny + lower - node;
                    for (value, k) in line[start..start + ny].iter_mut().zip(near) {
                        *value += b / scale[node] * k;
                    }
                }
            }
        }
    }

    /// Line search: first step length of 1, 1/2, 1/4 … that decreases the residual, else the best of them.
    fn line_search(&mut self, field: &Field, step: &[f64]) -> Option<Field> {
        let n = field.pressure.len();
        let (by_pressure, by_separation) = (&step[..n], step[n]);
        let mut best: Option<Field> = None;
        let mut rows = Vec::with_capacity(n);
        let mut length = 1.0;
        for _ in 0..MAX_HALVINGS {
            let pressure: Vec<f64> =
                field.pressure.iter().zip(by_pressure).map(|(p, d)| (p + length * d).max(0.0)).collect();
            let separation = field.separation + length * by_separation;
            let film = self.film(&pressure, separation);
            reynolds::rows(self.s, self.lubricant, &pressure, &film, &mut rows);
            let residual = self.merit(&pressure, &rows);
            if residual.is_finite() && best.as_ref().is_none_or(|b| residual < b.residual) {
                best = Some(Field { pressure, film, separation, residual, ..*field });
            }
            if residual < (1.0 - 0.1 * length) * field.residual {
                break;
            }
            length *= 0.5;
        }
        best
    }
}

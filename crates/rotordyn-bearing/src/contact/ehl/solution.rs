//! Fields and scalar results of a solved EHL contact, in SI.

use super::Problem;
use super::minimum::Minima;
use super::newton::{Field, InitialGuess};
use super::scaled::Scaled;
use serde::{Deserialize, Serialize};

/// EHL solution: fields over the whole domain, index i·ny + j at (xᵢ, yⱼ), and scalar results.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Solution {
    /// Along rolling, upstream first \[m\].
    pub x: Vec<f64>,
    /// Across rolling, from side to side \[m\].
    pub y: Vec<f64>,
    /// Pressure p \[Pa\], nx × ny.
    pub pressure: Vec<f64>,
    /// Film thickness h \[m\], nx × ny.
    pub film: Vec<f64>,
    /// Film at the centre of the dry ellipse h_c \[m\].
    pub central_film: f64,
    /// Minimum film of all nodes \[m\]; extrapolated to zero mesh width in [`super::Extrapolated`].
    pub minimum_film: f64,
    /// Mutual approach δ = w − h at the centre = −h₀ \[m\]; negative where the film exceeds the deflection.
    ///
    /// The film reduces the dry approach by δ_dry − δ. Source: Zhang 2016 eq. 1.
    pub approach: f64,
    /// Approach of the dry contact under the same load δ_dry \[m\].
    pub dry_approach: f64,
    /// Rolling resistance of the pressure flow ½ ∫∫ h ∂p/∂x dA on each surface \[N\], positive against the motion.
    pub rolling_force: f64,
    /// Newton iterations on the grid of the fields.
    pub iterations: usize,
    /// RMS residual of film equation and cavitation condition, relative to the dry maximum pressure.
    pub residual: f64,
    /// Minimum film between the nodes at the exit and in the side lobe \[m\].
    pub(super) minima: Minima,
    /// Dry semi-axes along and across \[m\], dry maximum pressure \[Pa\].
    scales: [f64; 3],
}

impl Solution {
    pub(super) fn new(problem: &Problem, s: &Scaled, field: Field) -> Self {
        let Field { pressure, film, separation, residual, iterations, .. } = field;
        let whole = |half: &[f64], scale: f64| -> Vec<f64> {
            let rows = (0..2 * s.ny - 1).map(|j| j.abs_diff(s.ny - 1)).collect::<Vec<_>>();
            (0..s.nx)
                .flat_map(|i| rows.iter().map(move |j| scale * half[i * s.ny + j]).collect::<Vec<_>>())
                .collect()
        };
        let line: Vec<f64> = (0..s.nx).map(|i| film[i * s.ny]).collect();
        let slope =
            |i: usize, j: usize| (pressure[(i + 1) * s.ny + j] - pressure[(i - 1) * s.ny + j]) / (2.0 * s.dx);
        let Minima { exit, side } = Minima::new(s, &film);
        let minima = Minima { exit: s.film * exit, side: s.film * side };
        let inner = (1..s.nx - 1).flat_map(|i| (0..s.ny).map(move |j| (i, j)));
        let drag: f64 = inner.map(|(i, j)| s.weights[i * s.ny + j] * film[i * s.ny + j] * slope(i, j)).sum();
        Self {
            x: s.x.iter().map(|x| x * s.axes[0]).collect(),
            y: s.y[1..].iter().rev().map(|y| -y).chain(s.y.iter().copied()).map(|y| y * s.axes[1]).collect(),
            central_film: s.film * at_zero(&s.x, &line),
            minimum_film: s.film * film.iter().copied().fold(f64::INFINITY, f64::min),
            minima,
            approach: -s.film * separation,
            dry_approach: problem.contact.patch(problem.load).deflection,
            // Σ w P dA is in units of the load, h/x in those of film and semi-axis.
            rolling_force: 0.5 * problem.load * s.film / s.axes[0] * drag,
            pressure: whole(&pressure, s.pressure),
            film: whole(&film, s.film),
            iterations,
            residual,
            scales: [s.axes[0], s.axes[1], s.pressure],
        }
    }

    /// Reduction of the approach by the film, δ_dry − δ \[m\].
    pub fn film_shift(&self) -> f64 {
        self.dry_approach - self.approach
    }

    /// This solution interpolated as initial guess for another grid, load or speed.
    pub(super) fn on_grid(&self, problem: &Problem, s: &Scaled) -> InitialGuess {
        let ny = self.y.len();
        let half = &self.y[ny / 2..];
        let interval = |nodes: &[f64], at: f64| {
            let k = nodes.partition_point(|&n| n <= at).clamp(1, nodes.len() - 1);
            let t = (at - nodes[k - 1]) / (nodes[k] - nodes[k - 1]);
            // Zero pressure outside the domain.
            (0.0..=1.0 + 1e-9).contains(&t).then_some((k - 1, t))
        };
        let columns: Vec<_> = s.x.iter().map(|x| interval(&self.x, x * self.scales[0])).collect();
        let rows: Vec<_> = s.y.iter().map(|y| interval(half, y * self.scales[1])).collect();
        let value = |column: Option<(usize, f64)>, row: Option<(usize, f64)>| {
            let ((i, t), (j, u)) = (column?, row?);
            let p = |i: usize, j: usize| self.pressure[i * ny + ny / 2 + j] / self.scales[2];
            let along = |j: usize| (1.0 - t) * p(i, j) + t * p(i + 1, j);
            Some((1.0 - u) * along(j) + u * along(j + 1))
        };
        let nodes = columns.iter().flat_map(|&column| rows.iter().map(move |&row| (column, row)));
        let pressure = nodes
            .enumerate()
            .map(
                |(node, (column, row))| {
                    if s.is_inner(node) { value(column, row).unwrap_or(0.0) } else { 0.0 }
                },
            )
            .collect();
        let dry_approach = problem.contact.patch(problem.load).deflection;
        InitialGuess {
            pressure,
            separation: (self.film_shift() - dry_approach) / s.film,
            least_film: 0.3 * self.minimum_film / s.film,
        }
    }
}

/// Value at x = 0 by the cubic through the four nearest nodes.
fn at_zero(x: &[f64], values: &[f64]) -> f64 {
    let next = x.partition_point(|&x| x < 0.0).clamp(2, x.len() - 2);
    let nodes = next - 2..next + 2;
    nodes
        .clone()
        .map(|i| nodes.clone().filter(|&k| k != i).map(|k| x[k] / (x[k] - x[i])).product::<f64>() * values[i])
        .sum()
}

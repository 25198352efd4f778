//! Non-dimensional contact (scales of the dry Hertzian ellipse), on one grid of half the domain.

use super::half_space::corner;
use super::{Grid, Problem};
use crate::contact::FilmFormula;

/// Scales and nodes: X = x/b_x along rolling, Y = y/b_y across, P = p/p₀, H = h R_x/b_x².
///
/// b_x, b_y are the dry semi-axes, R_x, R_y the radii of relative curvature along and across. Node (i, j) has index i·ny + j;
/// j = 0 lies on the line of symmetry.
#[derive(Clone, Debug)]
pub(super) struct Scaled {
    pub nx: usize,
    /// Rows of the half domain.
    pub ny: usize,
    pub x: Vec<f64>,
    pub y: Vec<f64>,
    pub dx: f64,
    /// Edges of the cells across: cell j lies between edges j and j + 1; the first edge is the line of symmetry.
    pub edges: Vec<f64>,
    /// b_x, b_y \[m\].
    pub axes: [f64; 2],
    /// p₀ \[Pa\].
    pub pressure: f64,
    /// b_x²/R_x \[m\].
    pub film: f64,
    /// (b_x/b_y)².
    pub aspect: f64,
    /// λ = 12 η₀ u R_x² / (b_x³ p₀).
    pub lambda: f64,
    /// Undeformed gap X²/2 + (R_x/R_y)(b_y/b_x)² Y²/2.
    pub gap: Vec<f64>,
    /// Σ w P = 1 is the load balance.
    pub weights: Vec<f64>,
    /// p₀ R_x/(π E* b_x²): deflection per ∫∫ P dA/r.
    compliance: f64,
}

impl Scaled {
    pub(super) fn new(problem: &Problem, grid: &Grid) -> Self {
        let contact = &problem.contact;
        let patch = contact.patch(problem.load);
        let axes = contact.semi_axes(problem.load);
        let pressure = patch.maximum_pressure;
        let film = axes[0].powi(2) / contact.rolling_radius;
        let (nx, ny) = (grid.nx, grid.ny.div_ceil(2));
        let dx = (grid.domain.inlet + grid.domain.outlet) / (nx - 1) as f64;
        let formula = FilmFormula::new(contact, &problem.lubricant).central(problem.speed, problem.load);
        let rows = Spacing::new(formula / film, grid.domain.side);
        let row = |j: f64| rows.position(j / (ny - 1) as f64);
        let x: Vec<f64> = (0..nx).map(|i| i as f64 * dx - grid.domain.inlet).collect();
        let y: Vec<f64> = (0..ny).map(|j| row(j as f64)).collect();
        let edges: Vec<f64> = (0..=ny).map(|j| if j == 0 { 0.0 } else { row(j as f64 - 0.5) }).collect();
        let across = contact.rolling_radius / contact.transverse_radius * (axes[1] / axes[0]).powi(2);
        let nodes = || x.iter().flat_map(|&x| y.iter().map(move |&y| (x, y)));
        let gap = nodes().map(|(x, y)| 0.5 * (x * x + across * y * y)).collect();
        let cell = |j: usize| 2.0 * dx * (edges[j + 1] - edges[j]) / (2.0 * std::f64::consts::PI / 3.0);
        let weights = (0..nx * ny).map(|node| cell(node % ny)).collect();
        Self {
            nx,
            ny,
            dx,
            axes,
            pressure,
            film,
            aspect: (axes[0] / axes[1]).powi(2),
            lambda: 12.0 * problem.lubricant.viscosity * problem.speed * contact.rolling_radius.powi(2)
                / (axes[0].powi(3) * pressure),
            gap,
            weights,
            compliance: pressure / (std::f64::consts::PI * contact.modulus * film),
            x,
            y,
            edges,
        }
    }

    /// Influence coefficients by column distance: deflection in row `row` by unit pressure on cell `source` and on
    /// its mirror image, \[distance\]\[row\]\[source\].
    pub(super) fn influence(&self) -> Vec<Vec<f64>> {
        let ny = self.ny;
        let [along, across] = self.axes;
        // Corner values at every edge of a column, for every row and edge between the rows on both sides.
        let edge = |k: usize| if k < ny { -self.edges[ny - k] } else { self.edges[k - ny] };
        let strip = |i: usize| -> Vec<f64> {
            let x = (i as f64 - 0.5) * self.dx * along;
            let to = |row: usize| (0..=2 * ny).map(move |k| corner(x, (edge(k) - self.y[row]) * across));
            (0..ny).flat_map(to).collect()
        };
        let mut near = strip(0);
        let column = |i: usize| {
            let far = strip(i + 1);
            let mut kernel = vec![0.0; ny * ny];
            for row in 0..ny {
                let corners: Vec<f64> = (0..=2 * ny)
                    .map(|k| far[row * (2 * ny + 1) + k] - near[row * (2 * ny + 1) + k])
                    .collect();
                for source in 0..ny {
                    let cell = |k: usize| corners[k + 1] - corners[k];
                    kernel[row * ny + source] = self.compliance * (cell(ny + source) + cell(ny - 1 - source));
                }
            }
            near = far;
            kernel
        };
        (0..self.nx).map(column).collect()
    }

    /// Whether the node carries an unknown: inside the domain, not on its edge.
    pub(super) fn is_inner(&self, node: usize) -> bool {
        let (i, j) = (node / self.ny, node % self.ny);
        i > 0 && i + 1 < self.nx && j + 1 < self.ny
    }
}

/// Smooth spacing of the rows across: closest around the ends of the ellipse, where a thin film has its minimum.
///
/// The row number is proportional to Y + c w (tanh((Y − Y_c)/w) + tanh(Y_c/w)), so that rows are 1 + c times closer
/// around Y_c than elsewhere; c = H_1/H − 1 within 0 and [`MAX_CLOSENESS`], H = h R_x/b_x² after Hamrock and Dowson.
pub(super) struct Spacing {
    /// c.
    closeness: f64,
    side: f64,
}

/// Width w of the region of close rows, and its centre Y_c.
const CLOSE_WIDTH: f64 = 0.1;
const CLOSE_CENTRE: f64 = 0.95;
/// Film H_1 above which the rows are evenly spaced: its minimum is wide and inside the ellipse.
const EVEN_FILM: f64 = 0.25;
const MAX_CLOSENESS: f64 = 10.0;

impl Spacing {
    /// Spacing up to Y = `side` for the scaled film H of Hamrock and Dowson.
    pub(super) fn new(film: f64, side: f64) -> Self {
        Self { closeness: (EVEN_FILM / film - 1.0).clamp(0.0, MAX_CLOSENESS), side }
    }

    /// Length in Y that as many rows would cover at the wider spacing.
    pub(super) fn even_rows(&self) -> f64 {
        self.number(self.side)
    }

    fn number(&self, y: f64) -> f64 {
        let rise = |y: f64| ((y - CLOSE_CENTRE) / CLOSE_WIDTH).tanh();
        y + self.closeness * CLOSE_WIDTH * (rise(y) - rise(0.0))
    }

    /// Y at the share `t` of all rows, by bisection.
    fn position(&self, t: f64) -> f64 {
        if self.closeness == 0.0 {
            return t * self.side;
        }
        let wanted = t * self.number(self.side);
        // The row number is at least Y.
        let (mut low, mut high) = (0.0, wanted);
        while high - low > f64::EPSILON * high {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            if self.number(middle) < wanted { low = middle } else { high = middle }
        }
        high
    }
}

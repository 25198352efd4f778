//! Non-dimensional contact (scales of the dry Hertzian ellipse), on one grid of half the domain.

use super::deflection::corner;
use super::{Grid, Problem};

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
    pub dy: f64,
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
        let dy = grid.domain.side / (ny - 1) as f64;
        let x: Vec<f64> = (0..nx).map(|i| i as f64 * dx - grid.domain.inlet).collect();
        let y: Vec<f64> = (0..ny).map(|j| j as f64 * dy).collect();
        let across = contact.rolling_radius / contact.transverse_radius * (axes[1] / axes[0]).powi(2);
        let nodes = || x.iter().flat_map(|&x| y.iter().map(move |&y| (x, y)));
        let gap = nodes().map(|(x, y)| 0.5 * (x * x + across * y * y)).collect();
        let cell = dx * dy / (2.0 * std::f64::consts::PI / 3.0);
        let weights = nodes().map(|(_, y)| if y == 0.0 { cell } else { 2.0 * cell }).collect();
        Self {
            nx,
            ny,
            dx,
            dy,
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
        }
    }

    /// Influence coefficients: deflection by unit pressure on one cell, at d columns and 0 to 2 ny − 2 rows
    /// distance.
    pub(super) fn influence(&self, d: usize) -> Vec<f64> {
        let [width, height] = [self.dx * self.axes[0], self.dy * self.axes[1]];
        let edges = [(d as f64 - 0.5) * width, (d as f64 + 0.5) * width];
        // Corner values between rows, then differences of neighbours.
        let strip: Vec<f64> = (0..2 * self.ny)
            .map(|row| {
                let y = (row as f64 - 0.5) * height;
                corner(edges[1], y) - corner(edges[0], y)
            })
            .collect();
        strip.windows(2).map(|pair| self.compliance * (pair[1] - pair[0])).collect()
    }

    /// Whether the node carries an unknown: inside the domain, not on its edge.
    pub(super) fn is_inner(&self, node: usize) -> bool {
        let (i, j) = (node / self.ny, node % self.ny);
        i > 0 && i + 1 < self.nx && j + 1 < self.ny
    }
}

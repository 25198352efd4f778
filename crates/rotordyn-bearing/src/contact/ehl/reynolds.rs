//! Steady Reynolds equation of a compressible piezoviscous film, by second-order finite volumes.
//!
//! R = ∂(ρ̄ H)/∂X − ∂/∂X(ε ∂P/∂X) − (b_x/b_y)² ∂/∂Y(ε ∂P/∂Y), ε = ρ̄ H³ / (η̄ λ).
//! R = 0 in the full film; where the film cavitates, P = 0 and R ≥ 0 (diverging flow).
//!
//! Poiseuille flow between neighbours uses the mean of their ε. The entrained (Couette) flow through a face
//! is extrapolated from upstream, (3 q_i − q_{i−1})/2, q = ρ̄ H: conservative, second order, and in the
//! Hertzian zone, where ε vanishes, the film is determined by the inlet (Venner & Lubrecht 2000, ch. 5).

use super::scaled::Scaled;
use crate::contact::Lubricant;

/// Stencil of a node's equation: itself, west, east, south, north, west of west.
pub(super) const STENCIL_POINTS: usize = 6;

/// Equation of one node: R and its derivatives by P and by H at the [`POINTS`].
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Row {
    pub residual: f64,
    pub by_pressure: [f64; STENCIL_POINTS],
    pub by_film: [f64; STENCIL_POINTS],
}

/// Fluid properties at one node.
#[derive(Clone, Copy)]
struct Fluid {
    density: f64,
    /// ∂ρ̄/∂P.
    compressibility: f64,
    /// Flow coefficient ε and its derivatives by P and H.
    mobility: [f64; 3],
}

/// Index of the neighbour `point` of `node`; only those with a coefficient exist.
pub(super) fn neighbour(node: usize, point: usize, ny: usize) -> usize {
    match point {
        0 => node,
        1 => node - ny,
        2 => node + ny,
        3 => node - 1,
        4 => node + 1,
        _ => node - 2 * ny,
    }
}

/// Equations of all nodes; zero for nodes on the edge of the domain.
pub(super) fn rows(s: &Scaled, lubricant: &Lubricant, p: &[f64], h: &[f64], out: &mut Vec<Row>) {
    let fluid: Vec<Fluid> = p.iter().zip(h).map(|(&p, &h)| Fluid::new(s, lubricant, p, h)).collect();
    out.clear();
    out.extend((0..p.len()).map(|node| match s.is_inner(node) {
        true => row(s, &fluid, p, h, node),
        false => Row::default(),
    }));
}

impl Fluid {
    fn new(s: &Scaled, lubricant: &Lubricant, p: f64, h: f64) -> Self {
        let pressure = p.max(0.0) * s.pressure;
        let density = lubricant.density_ratio(pressure);
        let compressibility = lubricant.density_slope(pressure) * s.pressure;
        // Negative gap (in iterates, or at the ellipse's edge on coarse grids): no Poiseuille flow, only
        // entrainment.
        let gap = h.max(0.0);
        let per_gap = density * gap.powi(2) / (lubricant.viscosity_ratio(pressure) * s.lambda);
        let mobility = per_gap * gap;
        let by_pressure = compressibility / density - lubricant.log_viscosity_slope(pressure) * s.pressure;
        Self { density, compressibility, mobility: [mobility, mobility * by_pressure, 3.0 * per_gap] }
    }
}

fn row(s: &Scaled, fluid: &[Fluid], p: &[f64], h: &[f64], node: usize) -> Row {
    let mut row = Row::default();
    let along = s.dx.powi(-2);
    let j = node % s.ny;
    let across = |other: usize| s.aspect / ((s.y[j] - s.y[other]).abs() * (s.edges[j + 1] - s.edges[j]));
    // No flow across the line of symmetry.
    let [south, north] = [if j == 0 { 0.0 } else { across(j - 1) }, across(j + 1)];
    for (point, factor) in [(1, along), (2, along), (3, south), (4, north)] {
        if factor == 0.0 {
            continue;
        }
        let other = neighbour(node, point, s.ny);
        let mean = 0.5 * (fluid[node].mobility[0] + fluid[other].mobility[0]);
        let drop = p[other] - p[node];
        row.residual -= factor * mean * drop;
        row.by_pressure[point] -= factor * (mean + 0.5 * fluid[other].mobility[1] * drop);
        row.by_pressure[0] -= factor * (0.5 * fluid[node].mobility[1] * drop - mean);
        row.by_film[point] -= factor * 0.5 * fluid[other].mobility[2] * drop;
        row.by_film[0] -= factor * 0.5 * fluid[node].mobility[2] * drop;
    }
    // First-order upwind next to the inlet edge (no node two columns upstream).
    let upstream: &[(usize, f64)] =
        if node < 2 * s.ny { &[(0, 1.0), (1, -1.0)] } else { &[(0, 1.5), (1, -2.0), (5, 0.5)] };
    for &(point, weight) in upstream {
        let other = neighbour(node, point, s.ny);
        let factor = weight / s.dx;
        row.residual += factor * fluid[other].density * h[other];
        row.by_pressure[point] += factor * fluid[other].compressibility * h[other];
        row.by_film[point] += factor * fluid[other].density;
    }
    row
}

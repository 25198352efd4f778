//! Numerical solution of the isothermal elastohydrodynamic lubrication (EHL) of an elliptic point contact.
//!
//! | module | contents |
//! |---|---|
//! | `scaled` | non-dimensional contact (scales of the dry Hertzian ellipse), nodes of half the domain |
//! | `deflection` | elastic deflection by discrete convolution |
//! | `reynolds` | Reynolds equation, residual and derivatives |
//! | `guess` | initial film and pressure |
//! | `newton` | Newton solver: film, cavitation and load balance on one grid |
//! | `minimum` | minimum films at the exit and in the side lobe, between the nodes |
//! | `solution` | fields and scalar results in SI |
//! | `similarity` | films of similar contacts, solved once and stored with the program |
//! | `table`, `curve` | film tables over load and speed, and the contact law at one speed |
//! | `law` | EHL contact law of a ball |
//!
//! x lies along rolling (fluid flows towards +x), y across, p = 0 on the edges of the domain.

mod curve;
mod deflection;
mod half_space;
mod initial_guess;
mod law;
mod minimum;
mod newton;
mod problem;
mod reynolds;
mod scaled;
pub mod similarity;
mod solution;
mod table;

pub use curve::Curve;
pub use law::{EhlLaw, EhlPair};
pub use problem::{Domain, Grid, Problem};
pub use solution::Solution;
pub use table::{DEFAULT_POINTS, Films, SolvedContacts, Table, TableSpec, geometric};

use crate::contact::{EllipticContact, FilmFormula, Lubricant};
use scaled::{Scaled, Spacing};

/// Errors of the EHL solver.
#[derive(Clone, Debug, thiserror::Error)]
pub enum EhlError {
    #[error("{quantity} of a lubricated contact must be {range}, not {value}")]
    Input { quantity: &'static str, range: &'static str, value: f64 },
    #[error(
        "the film of a contact under {load:.4} N at an entrainment speed of {speed:.4} m/s did not converge: \
         residual {residual:.3e} after {iterations} iterations, minimum film {least_film:.2e} m"
    )]
    NoConvergence {
        load: f64,
        speed: f64,
        residual: f64,
        iterations: usize,
        /// Minimum film of the last iterate \[m\]; if negative, the grid is too coarse at the edges of the
        /// ellipse.
        least_film: f64,
        /// Fields of the last iterate, for inspection.
        last: Box<Solution>,
    },
}

/// Coarsest nested grid: nodes along rolling, and rows of the half domain.
const COARSEST_GRID: [usize; 2] = [25, 7];

/// Least intervals along rolling per `points` of [`Grid::flooded`]: A + B G, as the pressure spike is the sharper the
/// larger G = α p₀ is.
const SPIKE_INTERVALS: [f64; 2] = [20.0, 0.1];

/// Smallest length in semi-axes that [`Grid::flooded`] resolves, to limit the grid size.
const MIN_RESOLVED_LENGTH: f64 = 0.08;

/// Solves the EHL film on nested grids from coarse to fine.
///
/// Unknowns: pressure p ≥ 0 and rigid separation h₀ in
/// ∂/∂x(ρ h³/(12 η) ∂p/∂x) + ∂/∂y(ρ h³/(12 η) ∂p/∂y) = u ∂(ρ h)/∂x, h = h₀ + x²/(2 R_x) + y²/(2 R_y) + w,
/// w = (1/(π E*)) ∫∫ p dA/r, ∫∫ p dA = Q; cavitation by complementarity (Reynolds boundary condition).
///
/// `start`: initial guess from a nearby solution (other load, speed or grid), instead of a coarse grid.
///
/// # Errors
/// [`EhlError::Input`] for invalid input values; [`EhlError::NoConvergence`] with the last fields.
///
/// Validity: fully flooded inlet, Newtonian fluid, isothermal, half-spaces. Source: Venner & Lubrecht 2000.
pub fn solve(problem: &Problem, start: Option<&Solution>) -> Result<Solution, EhlError> {
    let found = solve_nested_grids(problem, start)?;
    if found.minimum_film > 0.0 { Ok(found) } else { Err(EhlError::new(problem, found)) }
}

/// As [`solve`], but accepts a negative film at the edges of the ellipse, as occurs on too coarse grids.
fn solve_nested_grids(problem: &Problem, start: Option<&Solution>) -> Result<Solution, EhlError> {
    problem.check()?;
    if let Some(found) = start.and_then(|near| solve_on_grid(problem, &problem.grid, Some(near)).ok()) {
        return Ok(found);
    }
    let mut coarse = Vec::new();
    let mut grid = problem.grid.coarser();
    while grid.nx >= COARSEST_GRID[0] && grid.rows() >= COARSEST_GRID[1] {
        coarse.push(grid);
        grid = grid.coarser();
    }
    let near = coarse
        .iter()
        .rev()
        .fold(None, |near: Option<Solution>, grid| solve_on_grid(problem, grid, near.as_ref()).ok());
    solve_on_grid(problem, &problem.grid, near.as_ref())
}

/// Scalar results extrapolated to zero mesh width (Richardson), and the fields on the fine grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Extrapolated {
    /// Central film h_c \[m\].
    pub central_film: f64,
    /// Minimum film h_min, the lesser of `exit_film` and `side_film` \[m\].
    pub minimum_film: f64,
    /// Minimum film at the exit, on the line of symmetry or near it \[m\].
    pub exit_film: f64,
    /// Minimum film in the side lobe near the end of the ellipse across \[m\]; without a side lobe a film above
    /// that at the exit.
    pub side_film: f64,
    /// Mutual approach δ \[m\].
    pub approach: f64,
    /// Rolling resistance on each surface \[N\].
    pub rolling_force: f64,
    /// Solution on the problem's own grid.
    pub fine: Solution,
}

impl Extrapolated {
    /// Reduction of the approach by the film, δ_dry − δ \[m\].
    pub fn film_shift(&self) -> f64 {
        self.fine.dry_approach - self.approach
    }

    /// Fields on the problem's own grid, with the extrapolated scalar results.
    pub fn solution(self) -> Solution {
        let mut solution = self.fine;
        solution.central_film = self.central_film;
        solution.minimum_film = self.minimum_film;
        solution.approach = self.approach;
        solution.rolling_force = self.rolling_force;
        solution
    }
}

/// Solves on the problem's grid and on one of half as many intervals; Richardson extrapolation f + (f − c)/3
/// (second order).
///
/// Not extrapolated if the coarser grid has no solution.
///
/// A grid may be too coarse for the ends of the ellipse and have a negative minimum film there; the extrapolated one
/// must be positive.
///
/// # Errors
/// As [`solve`].
pub fn extrapolate(problem: &Problem, start: Option<&Solution>) -> Result<Extrapolated, EhlError> {
    let coarse = solve_nested_grids(&Problem { grid: problem.grid.coarser(), ..problem.clone() }, start).ok();
    let fine = solve_nested_grids(problem, coarse.as_ref().or(start))?;
    let limit = |figure: fn(&Solution) -> f64| {
        let f = figure(&fine);
        coarse.as_ref().map_or(f, |coarse| f + (f - figure(coarse)) / 3.0)
    };
    let central_film = limit(|s| s.central_film);
    // Each minimum by itself: the lesser one may be another on the coarser grid. A minimum that the coarser grid
    // does not resolve is that of the finer one.
    let of_minimum = |figure: fn(&Solution) -> f64| {
        let f = figure(&fine);
        let is_resolved = coarse.as_ref().is_some_and(|coarse| (f - figure(coarse)).abs() <= 0.5 * f);
        if is_resolved { limit(figure) } else { f }
    };
    let [exit_film, side_film] = [of_minimum(|s| s.minima.exit), of_minimum(|s| s.minima.side)];
    // A side lobe well above the exit, which only the finer grid resolves, has no limit.
    let is_above = fine.minima.side > 1.1 * fine.minima.exit;
    let side_film = if is_above { side_film.max(exit_film) } else { side_film };
    let minimum_film = exit_film.min(side_film);
    if !(minimum_film > 0.0 && central_film > 0.0) {
        return Err(EhlError::new(problem, fine));
    }
    Ok(Extrapolated {
        central_film,
        minimum_film,
        exit_film,
        side_film,
        approach: limit(|s| s.approach),
        rolling_force: limit(|s| s.rolling_force),
        fine,
    })
}

fn solve_on_grid(problem: &Problem, grid: &Grid, near: Option<&Solution>) -> Result<Solution, EhlError> {
    let s = Scaled::new(problem, grid);
    let start = match near {
        Some(near) => near.on_grid(problem, &s),
        None => initial_guess::ellipse(problem, &s),
    };
    let field = newton::solve(&s, &problem.lubricant, start);
    let converged = field.converged;
    let solution = Solution::new(problem, &s, field);
    if converged {
        return Ok(solution);
    }
    Err(EhlError::new(problem, solution))
}

impl EhlError {
    fn new(problem: &Problem, last: Solution) -> Self {
        Self::NoConvergence {
            load: problem.load,
            speed: problem.speed,
            residual: last.residual,
            iterations: last.iterations,
            least_film: last.minimum_film,
            last: Box::new(last),
        }
    }
}

impl Grid {
    /// Grid for a flooded contact with `points` intervals over the inlet length in which the film builds up.
    ///
    /// With H = h R_x/b_x² and the Hamrock-Dowson film h that length is about b_x H^{2/3}, the distance from
    /// the edge of the dry ellipse at which the dry gap is h, or √(2 R_x h) for a film thick compared with
    /// the ellipse's depth; but along rolling at least (20 + 0.1 α p₀) `points` intervals, for the pressure spike, p₀
    /// the dry maximum pressure. Across, √(b_y² + 2 R_y h) gets twice `points`. The domain extends to undeformed
    /// gaps of 30 h upstream and 5 h to the sides beyond the ellipse: a wider domain changes δ_dry − δ by
    /// less than 1 %.
    pub fn flooded(
        contact: &EllipticContact,
        lubricant: &Lubricant,
        speed: f64,
        load: f64,
        points: usize,
    ) -> Self {
        let film = FilmFormula::new(contact, lubricant).central(speed, load);
        let axes = contact.semi_axes(load);
        // Distances in semi-axes at which the undeformed gap is `times` the film.
        let along = |times: f64| (2.0 * times * film * contact.rolling_radius).sqrt() / axes[0];
        let across = |times: f64| (2.0 * times * film * contact.transverse_radius).sqrt() / axes[1];
        let domain =
            Domain { inlet: 1.5 + along(30.0), outlet: 1.25 + 0.5 * along(1.0), side: 1.25 + across(5.0) };
        let scaled_film = 0.5 * along(1.0).powi(2);
        let intervals =
            |length: f64, unit: f64, points: usize| (length / unit * points as f64).ceil() as usize;
        let inlet = scaled_film.powf(2.0 / 3.0).min(along(1.0)).max(MIN_RESOLVED_LENGTH);
        // Even numbers of intervals, halved on the coarser grid.
        let [least, by_pressure] = SPIKE_INTERVALS;
        let pressure = lubricant.pressure_viscosity * contact.patch(load).maximum_pressure;
        let for_spike = intervals(least + by_pressure * pressure, 1.0, points);
        let for_inlet = intervals(domain.inlet + domain.outlet, inlet, points);
        let nx = for_inlet.max(for_spike).next_multiple_of(2) + 1;
        let spacing = Spacing::new(scaled_film, domain.side);
        let rows = intervals(2.5 * spacing.even_rows(), across(1.0).hypot(1.0), points);
        let rows = rows.next_multiple_of(2).max(8);
        Self { nx, ny: 2 * rows + 1, domain }
    }
}

impl Problem {
    fn check(&self) -> Result<(), EhlError> {
        let positive = |quantity, value: f64| match value > 0.0 && value.is_finite() {
            true => Ok(()),
            false => Err(EhlError::Input { quantity, range: "positive and finite", value }),
        };
        positive("load", self.load)?;
        positive("entrainment speed", self.speed)?;
        positive("viscosity", self.lubricant.viscosity)?;
        positive("pressure-viscosity coefficient", self.lubricant.pressure_viscosity)?;
        positive("radius along rolling", self.contact.rolling_radius)?;
        positive("radius across rolling", self.contact.transverse_radius)?;
        positive("contact modulus", self.contact.modulus)?;
        let Domain { inlet, outlet, side } = self.grid.domain;
        for (quantity, value) in [("inlet", inlet), ("outlet", outlet), ("side", side)] {
            if !(value > 1.0 && value.is_finite()) {
                return Err(EhlError::Input { quantity, range: "beyond the dry ellipse (above 1)", value });
            }
        }
        for (quantity, value, range, allowed) in [
            ("number of nodes along rolling", self.grid.nx, "9 to 4097", 9..=4097),
            ("number of nodes across rolling", self.grid.ny, "7 to 2049", 7..=2049),
        ] {
            if !allowed.contains(&value) {
                return Err(EhlError::Input { quantity, range, value: value as f64 });
            }
        }
        if self.grid.ny.is_multiple_of(2) {
            let value = self.grid.ny as f64;
            return Err(EhlError::Input { quantity: "number of nodes across rolling", range: "odd", value });
        }
        Ok(())
    }
}

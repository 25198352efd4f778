//! Isothermal elastohydrodynamic film of an elliptic point contact, solved numerically.
//!
//! | module | holds |
//! |---|---|
//! | `scaled` | the contact in the scales of its dry patch, nodes of half the domain |
//! | `deflection` | elastic deflection by discrete convolution |
//! | `reynolds` | Reynolds equation, its residual and derivatives |
//! | `guess` | film and pressure to start from |
//! | `newton` | film, rupture and load balance on one grid |
//! | `solution` | fields and figures in SI |
//! | `table`, `curve` | film over load and speed, and the contact law at one speed |
//! | `law` | the contacts of a ball under it |
//!
//! x lies along rolling (fluid flows towards +x), y across, p = 0 on the edges of the domain.

mod curve;
mod deflection;
mod guess;
mod law;
mod newton;
mod reynolds;
mod scaled;
mod solution;
mod table;

pub use curve::Curve;
pub use law::{EhlLaw, EhlPair};
pub use solution::Solution;
pub use table::{Table, TableSpec, geometric};

use crate::contact::{EllipticContact, FilmFormula, Lubricant};
use scaled::Scaled;

/// A lubricated contact under load, and the grid to solve it on.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    pub contact: EllipticContact,
    pub lubricant: Lubricant,
    /// Entrainment speed u, the mean of both surfaces' \[m/s\].
    pub speed: f64,
    /// Load Q \[N\].
    pub load: f64,
    pub grid: Grid,
}

/// Regular grid over a domain; the half on one side of the line of symmetry is what is solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// Nodes along rolling.
    pub nx: usize,
    /// Nodes across the whole domain, odd: (ny + 1)/2 rows are solved.
    pub ny: usize,
    pub domain: Domain,
}

/// Extent of the computed film in semi-axes of the dry ellipse, from its centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Domain {
    /// Upstream, in semi-axes along rolling.
    pub inlet: f64,
    /// Downstream, in semi-axes along rolling.
    pub outlet: f64,
    /// To either side, in semi-axes across.
    pub side: f64,
}

/// Why there is no film.
#[derive(Clone, Debug, thiserror::Error)]
pub enum Failure {
    #[error("{quantity} of a lubricated contact must be {range}, not {value}")]
    Input { quantity: &'static str, range: &'static str, value: f64 },
    #[error(
        "the film of a contact under {load:.4} N at an entrainment speed of {speed:.4} m/s did not converge: \
         residual {residual:.3e} after {iterations} iterations, least film {least_film:.2e} m"
    )]
    NoConvergence {
        load: f64,
        speed: f64,
        residual: f64,
        iterations: usize,
        /// Least film of the last iterate \[m\]; below zero the grid is too coarse for the edges of the ellipse.
        least_film: f64,
        /// The last fields, to be looked at.
        last: Box<Solution>,
    },
}

/// Coarsest grid of a nest: nodes along, and rows of the half domain.
const COARSEST: [usize; 2] = [25, 7];

/// Least length in semi-axes that [`Grid::flooded`] resolves, so that no film asks for an endless grid.
const THINNEST: f64 = 0.08;

/// Solves the film, on nested grids from coarse to fine.
///
/// Unknowns: pressure p ≥ 0 and rigid separation h₀ in
/// ∂/∂x(ρ h³/(12 η) ∂p/∂x) + ∂/∂y(ρ h³/(12 η) ∂p/∂y) = u ∂(ρ h)/∂x, h = h₀ + x²/(2 R_x) + y²/(2 R_y) + w,
/// w = (1/(π E*)) ∫∫ p dA/r, ∫∫ p dA = Q; ruptured film by complementarity (Reynolds' condition).
///
/// `start`: a solution nearby (another load, speed or grid of the contact) to start from instead of a coarse grid.
///
/// # Errors
/// [`Failure::Input`] for figures that make no problem; [`Failure::NoConvergence`] with the last fields.
///
/// Validity: flooded inlet, Newtonian fluid, no heat, half-spaces. Source: Venner & Lubrecht 2000.
pub fn solve(problem: &Problem, start: Option<&Solution>) -> Result<Solution, Failure> {
    let found = nested(problem, start)?;
    if found.minimum_film > 0.0 { Ok(found) } else { Err(Failure::new(problem, found)) }
}

/// As [`solve`], but the film may be below zero at the edges of the ellipse, as it is on grids too coarse for it.
fn nested(problem: &Problem, start: Option<&Solution>) -> Result<Solution, Failure> {
    problem.check()?;
    if let Some(found) = start.and_then(|near| attempt(problem, &problem.grid, Some(near)).ok()) {
        return Ok(found);
    }
    let mut coarse = Vec::new();
    let mut grid = problem.grid.coarser();
    while grid.nx >= COARSEST[0] && grid.rows() >= COARSEST[1] {
        coarse.push(grid);
        grid = grid.coarser();
    }
    let near = coarse
        .iter()
        .rev()
        .fold(None, |near: Option<Solution>, grid| attempt(problem, grid, near.as_ref()).ok());
    attempt(problem, &problem.grid, near.as_ref())
}

/// Figures of a contact extrapolated to zero mesh width, and the fields on its grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Extrapolated {
    /// Central film h_c \[m\].
    pub central_film: f64,
    /// Mutual approach δ \[m\].
    pub approach: f64,
    /// Rolling resistance on each surface \[N\].
    pub rolling_force: f64,
    /// Solution on the problem's own grid.
    pub fine: Solution,
}

impl Extrapolated {
    /// By how much the film lessens the approach, δ_dry − δ \[m\].
    pub fn film_shift(&self) -> f64 {
        self.fine.dry_approach - self.approach
    }
}

/// Solves on the problem's grid and on one of half as many intervals, and extrapolates: f + (f − c)/3 at second order.
///
/// A film that the coarser grid has no solution for is not extrapolated.
///
/// What is extrapolated belongs to the whole contact or its centre, so the grids may be too coarse for the edges of a
/// thin film: its least film is then below zero, which [`solve`] would refuse.
///
/// # Errors
/// As [`solve`], save that the film at the centre alone must be above zero.
pub fn extrapolate(problem: &Problem, start: Option<&Solution>) -> Result<Extrapolated, Failure> {
    let coarse = nested(&Problem { grid: problem.grid.coarser(), ..problem.clone() }, start).ok();
    let fine = nested(problem, coarse.as_ref().or(start))?;
    if fine.central_film <= 0.0 {
        return Err(Failure::new(problem, fine));
    }
    let limit = |figure: fn(&Solution) -> f64| {
        let f = figure(&fine);
        coarse.as_ref().map_or(f, |coarse| f + (f - figure(coarse)) / 3.0)
    };
    Ok(Extrapolated {
        central_film: limit(|s| s.central_film),
        approach: limit(|s| s.approach),
        rolling_force: limit(|s| s.rolling_force),
        fine,
    })
}

fn attempt(problem: &Problem, grid: &Grid, near: Option<&Solution>) -> Result<Solution, Failure> {
    let s = Scaled::new(problem, grid);
    let start = match near {
        Some(near) => near.on_grid(problem, &s),
        None => guess::ellipse(problem, &s),
    };
    let field = newton::solve(&s, &problem.lubricant, start);
    let converged = field.converged;
    let solution = Solution::new(problem, &s, field);
    if converged {
        return Ok(solution);
    }
    Err(Failure::new(problem, solution))
}

impl Failure {
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
    /// Rows that are solved: half the domain and the line of symmetry.
    fn rows(&self) -> usize {
        self.ny.div_ceil(2)
    }

    /// Half as many intervals either way over the same domain.
    fn coarser(&self) -> Self {
        Self { nx: (self.nx - 1) / 2 + 1, ny: 2 * (self.rows().saturating_sub(1) / 2) + 1, ..*self }
    }

    /// Grid for a flooded contact with `points` intervals to the length over which the film builds up.
    ///
    /// With H = h R_x/b_x² and h the Hamrock-Dowson film that length is about b_x H^{2/3}, the distance from the
    /// edge of the dry ellipse at which the dry gap is h, or √(2 R_x h) where the film is thicker than the ellipse is
    /// flat. Across, √(b_y² + 2 R_y h) gets twice `points`. The domain reaches to undeformed gaps of 30 h
    /// upstream and 5 h to the sides beyond the ellipse: a wider one changes δ_dry − δ by less than 1 %.
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
        let inlet = scaled_film.powf(2.0 / 3.0).min(along(1.0)).max(THINNEST);
        // Even numbers, so that the coarser grid has half of each.
        let nx = intervals(domain.inlet + domain.outlet, inlet, points).next_multiple_of(2) + 1;
        let rows = intervals(domain.side, across(1.0).hypot(1.0), 2 * points).next_multiple_of(2).max(8);
        Self { nx, ny: 2 * rows + 1, domain }
    }
}

impl Problem {
    fn check(&self) -> Result<(), Failure> {
        let positive = |quantity, value: f64| match value > 0.0 && value.is_finite() {
            true => Ok(()),
            false => Err(Failure::Input { quantity, range: "positive and finite", value }),
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
                return Err(Failure::Input { quantity, range: "beyond the dry ellipse (above 1)", value });
            }
        }
        for (quantity, value, range, allowed) in [
            ("number of nodes along rolling", self.grid.nx, "9 to 4097", 9..=4097),
            ("number of nodes across rolling", self.grid.ny, "7 to 2049", 7..=2049),
        ] {
            if !allowed.contains(&value) {
                return Err(Failure::Input { quantity, range, value: value as f64 });
            }
        }
        if self.grid.ny.is_multiple_of(2) {
            let value = self.grid.ny as f64;
            return Err(Failure::Input { quantity: "number of nodes across rolling", range: "odd", value });
        }
        Ok(())
    }
}

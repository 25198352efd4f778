//! Critical speeds: intersections of a mode's frequency with an order line ω = n Ω.
//!
//! | module | contents |
//! |---|---|
//! | `search` | all crossings over a range of speeds, without tracking of modes |
//! | `spectrum` | the modes at one speed that take part |
//! | `refine` | one crossing, refined on its own mode by inverse iteration |
//! | `undamped` | undamped critical speeds with constant bearings, solved directly or counted |

mod crossing;
mod refine;
mod search;
mod spectrum;
mod undamped;

pub use crossing::{CriticalSpeed, CrossingList, UncertainRange, UnstableMode};
pub(super) use refine::nearest_eigenpair;
pub use undamped::undamped_critical_speeds;

use super::campbell::{Campbell, ModeValue, Tangents};
use super::mode_kind::ModeKind;
use crate::analysis::modal::Mode;
use crate::assembly::{Assembly, LinearSystem, PhysicsError};
use rayon::prelude::*;
use rotordyn_linalg::Complex64;
use search::Search;
use spectrum::{Spectrum, is_heavily_damped};

/// Number of speeds of the search, both ends included.
pub const SPEEDS: usize = 33;

/// All crossings of damped modes with the lines ω_d = n Ω from one speed to another; damping and bearings included.
///
/// Modes with a damping ratio above 0.6 are searched only if damping ratios above 0.3 occur, up to 0.94. `nodes`: speeds between
/// which the bearings' coefficients run without a turn, those of their tables.
///
/// # Errors
/// Errors of the tangents or of an eigenvalue computation.
pub fn critical_speeds(
    assembly: &Assembly,
    [from, to]: [f64; 2],
    orders: &[f64],
    tangents: &impl Tangents,
    nodes: &[f64],
) -> Result<CrossingList, PhysicsError> {
    let search = Search::new(assembly, tangents, orders, None);
    let speeds: Vec<f64> = (0..SPEEDS).map(|k| from + (to - from) * k as f64 / (SPEEDS - 1) as f64).collect();
    search.run(search.with_speeds(search.spectra(&speeds)?, nodes)?, orders)
}

/// Crossings of the modes of a Campbell diagram with the lines ω_d = n Ω within its speeds.
///
/// At every speed the lowest modes, as many as the diagram has, take part, whether tracked or not; but for those with damping
/// ratios above 0.94. `nodes`: as in [`critical_speeds`].
///
/// # Errors
/// As [`critical_speeds`].
pub fn crossings(
    assembly: &Assembly,
    diagram: &Campbell,
    orders: &[f64],
    tangents: &impl Tangents,
    nodes: &[f64],
) -> Result<CrossingList, PhysicsError> {
    let search = Search::new(assembly, tangents, orders, Some(diagram.count));
    let at = |(speed, modes): (&f64, &Vec<ModeValue>)| {
        // The diagram has the lowest |λ|, the search needs the lowest damped frequencies.
        if modes.iter().any(|m| is_heavily_damped(m.eigenvalue)) {
            return search.spectrum(*speed, 0);
        }
        Ok(Spectrum::new(*speed, modes.iter().map(|m| (m.eigenvalue, m.label.clone()))))
    };
    let spectra = diagram.speeds.par_iter().zip(&diagram.all).map(at).collect::<Result<_, PhysicsError>>()?;
    search.run(search.with_speeds(spectra, nodes)?, orders)
}

/// λ of the mode of a system that continues a mode of a similar one; `None` if the iteration leaves it.
pub fn continued_eigenvalue(system: &LinearSystem, mode: &Mode) -> Option<Complex64> {
    refine::nearest_eigenpair(system, &(mode.eigenvalue, mode.shape.clone())).map(|(value, _)| value)
}

/// Whether a crossing can be excited by unbalance of an axisymmetric machine: forward, at order 1.
pub fn is_synchronous_forward(critical: &CriticalSpeed) -> bool {
    critical.order == 1.0 && critical.mode.kind == ModeKind::Forward
}

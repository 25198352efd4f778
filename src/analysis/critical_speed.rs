//! Critical speeds: intersections of a mode's frequency with an order line ω = n Ω.
//!
//! | module | contents |
//! |---|---|
//! | `search` | all crossings over a range of speeds, without tracking of modes |
//! | `refine` | one crossing, refined on its own mode by inverse iteration |
//! | `undamped` | undamped critical speeds with constant bearings, solved directly or counted |

mod refine;
mod search;
mod undamped;

pub use undamped::undamped_critical_speeds;

use super::campbell::{Campbell, Tangents};
use super::modal::Mode;
use super::mode_kind::ModeKind;
use crate::assembly::PhysicsError;
use crate::assembly::{Assembly, LinearSystem};
use search::{Search, Spectrum};

/// A mode on an order line.
#[derive(Clone, Debug, PartialEq)]
pub struct CriticalSpeed {
    /// Ω \[rad/s\].
    pub speed: f64,
    /// n in ω = n Ω.
    pub order: f64,
    /// The mode at this speed, with its kind and label there.
    pub mode: Mode,
}

impl CriticalSpeed {
    /// dω_d/dΩ of the mode, by a central difference; 0 if the mode is not found beside the crossing.
    ///
    /// # Errors
    /// Errors of the linearised system.
    pub fn frequency_slope(
        &self,
        assembly: &Assembly,
        tangents: &impl Tangents,
    ) -> Result<f64, PhysicsError> {
        let start = (self.mode.eigenvalue, self.mode.shape.clone());
        let omega_at = |speed: f64| -> Result<Option<f64>, PhysicsError> {
            let system = LinearSystem::new(assembly, &tangents(speed)?, speed)?;
            Ok(refine::nearest_eigenpair(&system, &start).map(|(value, _)| value.im))
        };
        let step = SLOPE_STEP * self.speed;
        let [below, above] = [omega_at(self.speed - step)?, omega_at(self.speed + step)?];
        Ok(above.zip(below).map_or(0.0, |(above, below)| 0.5 * (above - below) / step))
    }
}

/// Crossings over a range of speeds, and what the list lacks.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CrossingList {
    /// By speed.
    pub list: Vec<CriticalSpeed>,
    /// Per order: number of modes below the order line at the highest speed that are not among the modes searched.
    pub omitted: Vec<(f64, usize)>,
    /// Ranges of speeds in which the list may be incomplete: the modes change within steps of the search.
    pub uncertain: Vec<UncertainRange>,
}

/// A range of speeds in which crossings of an order may have been missed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UncertainRange {
    pub order: f64,
    /// Ω \[rad/s\].
    pub from: f64,
    pub to: f64,
}

/// Number of speeds of the search, both ends included.
const SPEEDS: usize = 33;
/// Relative step of speed for the derivative of a frequency.
const SLOPE_STEP: f64 = 1e-5;

/// All crossings of damped modes with the lines ω_d = n Ω from one speed to another; damping and bearings included.
///
/// Modes with a damping ratio above 0.6 are searched only if damping ratios above 0.3 occur, up to 0.94.
///
/// # Errors
/// Errors of the tangents or of an eigenvalue computation.
pub fn critical_speeds(
    assembly: &Assembly,
    [from, to]: [f64; 2],
    orders: &[f64],
    tangents: &impl Tangents,
) -> Result<CrossingList, PhysicsError> {
    let search = Search::new(assembly, tangents, orders, None);
    let speeds: Vec<f64> = (0..SPEEDS).map(|k| from + (to - from) * k as f64 / (SPEEDS - 1) as f64).collect();
    search.run(search.spectra(&speeds)?, orders)
}

/// Crossings of the modes of a Campbell diagram with the lines ω_d = n Ω within its speeds.
///
/// At every speed the lowest modes, as many as the diagram has, take part, whether tracked or not.
///
/// # Errors
/// As [`critical_speeds`].
pub fn crossings(
    assembly: &Assembly,
    diagram: &Campbell,
    orders: &[f64],
    tangents: &impl Tangents,
) -> Result<CrossingList, PhysicsError> {
    let search = Search::new(assembly, tangents, orders, Some(diagram.count));
    let sets = diagram.speeds.iter().zip(&diagram.sets);
    search.run(sets.map(|(speed, set)| Spectrum::of_modes(*speed, set)).collect(), orders)
}

/// Whether a crossing can be excited by unbalance of an axisymmetric machine: forward, at order 1.
pub fn is_synchronous_forward(critical: &CriticalSpeed) -> bool {
    critical.order == 1.0 && critical.mode.kind == ModeKind::Forward
}

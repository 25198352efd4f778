//! Crossings of natural frequencies and order lines.

use super::super::campbell::Tangents;
use super::super::modal::Mode;
use super::refine;
use crate::assembly::{Assembly, LinearSystem, PhysicsError};

/// Relative step of speed for the derivative of a frequency.
const SLOPE_STEP: f64 = 1e-5;

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

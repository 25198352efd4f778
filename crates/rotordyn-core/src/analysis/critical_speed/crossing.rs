//! Crossings of natural frequencies and order lines.

use super::super::campbell::Tangents;
use super::super::modal::Mode;
use super::refine;
use crate::assembly::{Assembly, LinearSystem, PhysicsError};
use crate::document::{Rows, TO_RPM, in_json, named};
use serde::{Deserialize, Serialize};

/// Relative step of speed for the derivative of a frequency.
const SLOPE_STEP: f64 = 1e-5;

/// A mode on an order line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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

    /// What is written to files, one row a crossing.
    pub fn columns<'a, 'r>(rows: Rows<'a, 'r, Self>) -> Rows<'a, 'r, Self> {
        rows.number(named("speed_rpm", "rpm"), "rpm", |c| c.speed * TO_RPM)
            .number("order", "1/revolution", |c| c.order)
            .number(named("frequency_hz", "frequency"), "Hz", |c| c.mode.frequency_hz())
            .number(in_json("damping_ratio"), "1", |c| c.mode.zeta())
            .number(named("log_decrement", "log_dec"), "1", |c| c.mode.log_dec())
            .text(named("kind", "whirl"), |c| c.mode.kind.name())
            .text("label", |c| &c.mode.label)
            .complex(in_json("eigenvalue"), "1/s", |c| c.mode.eigenvalue)
    }
}

/// Crossings over a range of speeds, and what the list lacks.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CrossingList {
    /// By speed.
    pub list: Vec<CriticalSpeed>,
    /// Per order: number of modes below the order line at the highest speed that are not among the modes searched.
    pub omitted: Vec<(f64, usize)>,
    /// Ranges of speeds in which the list may be incomplete: the modes change within steps of the search.
    pub uncertain: Vec<UncertainRange>,
    /// The least stable mode at every speed of the search at which one is unstable, by speed.
    #[serde(default)]
    pub unstable: Vec<UnstableMode>,
}

/// A mode that grows at a speed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct UnstableMode {
    /// Ω \[rad/s\].
    pub speed: f64,
    /// Empty where it is not known.
    pub label: String,
    /// ζ < 0.
    pub damping_ratio: f64,
}

impl UncertainRange {
    /// What is written to files, one row a range.
    pub fn columns<'a>(found: &[Self]) -> Rows<'a, '_, Self> {
        Rows::of(found)
            .number("order", "1/revolution", |range| range.order)
            .number("from_rpm", "rpm", |range| range.from * TO_RPM)
            .number("to_rpm", "rpm", |range| range.to * TO_RPM)
    }
}

/// A range of speeds in which crossings of an order may have been missed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct UncertainRange {
    pub order: f64,
    /// Ω \[rad/s\].
    pub from: f64,
    pub to: f64,
}

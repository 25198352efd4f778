//! What results of steady motions share: channels, clock, classification.

use crate::document::{Document, in_json, named};
use rotordyn_signal::lyapunov::LyapunovExponent;
use rotordyn_signal::motion_classification::Classification;
use serde::{Deserialize, Serialize};

/// A signal shown in a Poincaré section.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SectionChannel {
    pub name: String,
    pub unit: String,
}

/// The clock (stroboscopic phase) of a Poincaré section.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SectionClock {
    /// "shaft revolution", "cage revolution of B" or "ball passage of B".
    pub name: String,
    /// Phase of the section \[rad\].
    pub phase: f64,
    /// Mean frequency of the sections over the recorded periods \[Hz\].
    pub frequency: f64,
}

impl SectionClock {
    pub(super) fn document(&self) -> Document<'_> {
        Document::new().text(named("name", "clock"), &self.name).number("phase", "rad", self.phase).quantity(
            "frequency",
            "Hz",
            self.frequency,
        )
    }
}

/// Periods of a record that was stopped before its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RecordedPeriods {
    pub recorded: usize,
    pub requested: usize,
}

impl RecordedPeriods {
    /// "20 of 200 periods".
    pub fn words(&self) -> String {
        format!("{} of {} periods", self.recorded, self.requested)
    }

    pub(super) fn document(&self) -> Document<'static> {
        Document::new().integer("recorded", self.recorded).integer("requested", self.requested)
    }
}

/// What is written of a classified motion.
pub(super) fn motion_document<'a>(found: &Classification) -> Document<'a> {
    let period = found.motion.period();
    Document::new()
        .text(named("kind", "motion"), found.motion.name())
        .and_if(period, |out, period| out.integer(in_json("period"), period))
        .and_if(period.is_none().then_some(()), |out, ()| out.optional(in_json("period"), "1", None))
        .number("recurrence", "1", found.recurrence)
        .number("zero_one", "1", found.zero_one_k)
        .flag("settled", found.motion.is_settled())
        .number("residual", "1", found.residual)
        .number("decay_factor", "1", found.decay_factor)
}

/// What is written of a Lyapunov exponent without its convergence.
pub(super) fn exponent_document<'a>(found: &LyapunovExponent) -> Document<'a> {
    Document::new().number(named("value", "exponent"), "1/s", found.value).number(
        "standard_error",
        "1/s",
        found.standard_error,
    )
}

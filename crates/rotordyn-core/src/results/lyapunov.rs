//! Largest Lyapunov exponent.

use super::steady::{RecordedPeriods, SectionClock, exponent_document};
use crate::document::{Array, Document, named};
use rotordyn_signal::lyapunov::LyapunovExponent;
use serde::{Deserialize, Serialize};

/// Largest Lyapunov exponent at steady speed.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct LyapunovResult {
    /// Ω \[rad/s\].
    pub speed: f64,
    pub clock: SectionClock,
    pub exponent: LyapunovExponent,
    /// Periods recorded when the run was stopped before its end; the exponent is that of these alone.
    pub partial: Option<RecordedPeriods>,
}

impl LyapunovResult {
    /// What is written to files.
    pub fn document(&self) -> Document<'_> {
        let e = &self.exponent;
        let history = Array::real(&[e.history.len()], "1/s", &e.history).over(0, "time");
        Document::new()
            .quantity("speed", "rad/s", self.speed)
            .group(named("clock", ""), self.clock.document())
            .group(named("exponent", ""), exponent_document(e))
            .and_if(self.partial, |out, partial| out.group("partial", partial.document()))
            .array(named("history", "exponent"), history)
            .numbers(named("time_s", "time"), "s", &e.times)
    }
}

//! The probes of a run behind an anti-aliasing filter.

use serde::{Deserialize, Serialize};

use crate::transient::run::Sample;
use rotordyn_signal::decimate::Decimator;

/// Filters the probes from the steps of a run to its samples; a sample comes once the steps after it that it needs are there.
///
/// Nothing is filtered with one step to a sample, and under error control.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ProbeFilter {
    /// From the first sample on.
    filter: Option<Decimator>,
    values: Vec<f64>,
}

impl ProbeFilter {
    /// Takes the steps that end with a sample.
    pub fn push(&mut self, sample: &Sample) {
        let probes = sample.channels.len();
        // Without probes there is nothing to wait for.
        let factor = if probes == 0 { 1 } else { sample.steps_per_sample };
        let filter = self.filter.get_or_insert_with(|| Decimator::new(probes, factor));
        match probes {
            0 => filter.push(&[]),
            _ => sample.steps.chunks_exact(probes).for_each(|step| filter.push(step)),
        }
    }

    /// Values of the next sample, if they are there; `at_end`: no more steps come.
    pub fn pop(&mut self, at_end: bool) -> Option<&[f64]> {
        self.values.clear();
        let there = self.filter.as_mut()?.pop(at_end, &mut self.values);
        there.then_some(&self.values)
    }
}

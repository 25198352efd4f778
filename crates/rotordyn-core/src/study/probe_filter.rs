//! The probes of a run behind an anti-aliasing filter.

use serde::{Deserialize, Serialize};

use crate::transient::run::Sample;
use rotordyn_signal::decimate::Decimator;

/// Filters the probes from the steps of a run to its samples; a sample comes once the steps after it that it needs are there.
///
/// Nothing is filtered with one step to a sample, and under error control. Of divided steps, what the steps themselves do not
/// show is filtered at the rate of their parts and added.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ProbeFilter {
    /// From the first sample on.
    filter: Option<Filter>,
    values: Vec<f64>,
    differences: Vec<f64>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Filter {
    steps: Decimator,
    /// Where steps are divided.
    within: Option<WithinSteps>,
}

impl ProbeFilter {
    /// Takes the steps that end with a sample.
    pub fn push(&mut self, sample: &Sample) {
        let probes = sample.channels.len();
        // Without probes there is nothing to wait for.
        let factor = if probes == 0 { 1 } else { sample.steps_per_sample };
        let parts = if probes == 0 { 1 } else { sample.divided.parts };
        let Filter { steps: filter, within } = self.filter.get_or_insert_with(|| Filter {
            steps: Decimator::new(probes, factor),
            within: (parts > 1).then(|| WithinSteps::new(probes, factor, parts)),
        });
        if probes == 0 {
            filter.push(&[]);
            return;
        }
        let frames = sample.steps.chunks_exact(probes);
        if let Some(within) = within {
            let mut values = sample.divided.values.chunks_exact(probes * parts);
            let is_divided = sample.divided.is_divided.iter().copied().chain(std::iter::repeat(false));
            for (k, (frame, is_divided)) in frames.clone().zip(is_divided).enumerate() {
                let jump = sample.divided.jumps.iter().find(|jump| jump.step == k);
                let values = if is_divided { values.next() } else { None };
                within.push(frame, values, jump.map(|jump| jump.means.as_slice()));
            }
        }
        frames.for_each(|frame| filter.push(frame));
    }

    /// Values of the next sample, if they are there; `at_end`: no more steps come.
    pub fn pop(&mut self, at_end: bool) -> Option<&[f64]> {
        self.values.clear();
        let Filter { steps, within } = self.filter.as_mut()?;
        let Some(within) = within else {
            return steps.pop(at_end, &mut self.values).then_some(&self.values);
        };
        if at_end {
            within.finish();
        }
        if !(within.filter.has_next(at_end) && steps.pop(at_end, &mut self.values)) {
            return None;
        }
        self.differences.clear();
        within.filter.pop(at_end, &mut self.differences);
        self.values.iter_mut().zip(&self.differences).for_each(|(value, difference)| *value += difference);
        Some(&self.values)
    }
}

/// What is between the ends of divided steps: the channels at their parts minus the straight line between the ends.
///
/// The filter of the steps sees the ends alone, where vibrations faster than half their rate fold; adding the difference takes
/// them out again. A straight line has the same integral by the trapezoidal rule, so that lines far below the vibration in
/// divided steps are right: an acceleration sums up to the change of velocity, step by step. With the same aim jumps are added.
/// In divided steps of length h a vibration of frequency ω comes out too large by (ωh)²/12.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct WithinSteps {
    parts: usize,
    filter: Decimator,
    /// Channels at the end of the last step; empty at first.
    end: Vec<f64>,
    difference: Vec<f64>,
}

impl WithinSteps {
    fn new(probes: usize, factor: usize, parts: usize) -> Self {
        let filter = Decimator::new(probes, factor * parts);
        Self { parts, filter, end: Vec::new(), difference: vec![0.0; probes] }
    }

    /// Takes the channels at the end of a step, at its parts if it was divided, and a jump at its start over the length of a part.
    fn push(&mut self, end: &[f64], divided: Option<&[f64]>, jump: Option<&[f64]>) {
        if self.end.is_empty() {
            self.end.extend_from_slice(end);
            return;
        }
        match jump {
            Some(jump) => self.filter.push(jump),
            None => self.filter.push_zeros(1),
        }
        let inner = self.parts - 1;
        match divided {
            None => self.filter.push_zeros(inner),
            Some(values) => {
                for (p, part) in (1..).zip(values.chunks_exact(end.len()).take(inner)) {
                    let share = f64::from(p) / self.parts as f64;
                    let ends = self.end.iter().zip(end);
                    for (difference, (value, (start, end))) in
                        self.difference.iter_mut().zip(part.iter().zip(ends))
                    {
                        *difference = value - (start + share * (end - start));
                    }
                    self.filter.push(&self.difference);
                }
            }
        }
        self.end.copy_from_slice(end);
    }

    /// Completes the run with the end of its last step.
    fn finish(&mut self) {
        if !self.end.is_empty() {
            self.filter.push_zeros(1);
            self.end.clear();
        }
    }
}

//! Trigger: detection of hits in a force record.

use super::peak;
use crate::SignalError;
use crate::error::{check, check_record};

/// Settings of the trigger.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trigger {
    /// Trigger level of |force|, as a fraction of its largest value in the record.
    pub level: f64,
    /// Pre-trigger samples.
    pub before: usize,
    /// Block length in samples.
    pub length: usize,
}

impl Trigger {
    /// Sample ranges of all hits with a complete block in the record; blocks do not overlap.
    ///
    /// A second crossing within a block is not a new hit; [`super::inspect`] detects double hits. Errors: NaN, level not
    /// between 0 and 1, no length, more samples before the hit than in the block.
    pub fn find(&self, force: &[f64]) -> Result<Vec<std::ops::Range<usize>>, SignalError> {
        check_record("force", force)?;
        check(self.level > 0.0 && self.level < 1.0, "trigger level", "between 0 and 1", self.level)?;
        check(self.length > 0, "block length", "one sample or more", self.length as f64)?;
        let fits = self.before < self.length;
        check(fits, "samples before the hit", "fewer than in the block", self.before as f64)?;
        let largest = peak(force).1;
        let mut found = Vec::new();
        let mut free = 0;
        while let Some(at) =
            force[free..].iter().position(|f| largest > 0.0 && f.abs() >= self.level * largest)
        {
            let start = (free + at).saturating_sub(self.before).max(free);
            if start + self.length > force.len() {
                break;
            }
            found.push(start..start + self.length);
            free = start + self.length;
        }
        Ok(found)
    }
}

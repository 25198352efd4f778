//! Hits in a long record of the force.

use super::peak;
use crate::signal::SignalError;
use crate::signal::error::{check, check_record};

/// How hits are found in a long record of the force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trigger {
    /// A hit begins where |force| passes this share of its largest value in the record.
    pub level: f64,
    /// Samples kept before that.
    pub before: usize,
    /// Samples of a hit's block.
    pub length: usize,
}

impl Trigger {
    /// Ranges of samples of every hit whose block lies whole in the record; blocks do not overlap.
    ///
    /// A second crossing within a block belongs to it: [`super::inspect`] finds double hits. Errors: NaN, level not
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

//! Stability threshold (onset speed of instability): the speed where a mode's damping vanishes.

use super::campbell::{Campbell, Tangents, Tracker};
use super::modal::Mode;
use crate::assembly::Assembly;
use crate::error::Error;

/// A zero crossing of a mode's damping.
#[derive(Clone, Debug, PartialEq)]
pub struct Threshold {
    /// Ω \[rad/s\].
    pub speed: f64,
    /// Whether the mode is unstable above this speed.
    pub unstable_above: bool,
    pub mode: Mode,
    pub label: String,
}

/// Speeds where Re λ of a tracked branch changes sign, by speed.
///
/// # Errors
/// As [`campbell`](super::campbell::campbell).
pub fn thresholds(
    assembly: &Assembly,
    diagram: &Campbell,
    tangents: &impl Tangents,
) -> Result<Vec<Threshold>, Error> {
    let tracker = Tracker { assembly, tangents, count: diagram.branches.len() + 4 };
    let mut found = Vec::new();
    for branch in &diagram.branches {
        for (k, pair) in branch.modes.windows(2).enumerate() {
            let [Some(a), Some(b)] = pair else { continue };
            // The real part of an undamped mode is round-off at both ends: no crossing.
            let unstable = |m: &Mode| m.eigenvalue.re >= 0.0;
            let real = a.zeta().abs().max(b.zeta().abs()) > 1e-9;
            if real && unstable(a) != unstable(b) {
                let ends = ((diagram.speeds[k], a), (diagram.speeds[k + 1], b));
                let (speed, mode) = tracker.root(ends.0, ends.1, |m, _| m.eigenvalue.re)?;
                let unstable_above = unstable(b);
                found.push(Threshold { speed, unstable_above, mode, label: branch.label.clone() });
            }
        }
    }
    found.sort_by(|a, b| a.speed.total_cmp(&b.speed));
    Ok(found)
}

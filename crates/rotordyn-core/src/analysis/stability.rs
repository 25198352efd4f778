//! Stability threshold (onset speed of instability): the speed where a mode's damping vanishes.

use super::campbell::{Campbell, EXTRA_MODES, Tangents, Tracker};
use super::modal::Mode;
use crate::assembly::{Assembly, PhysicsError};
use serde::{Deserialize, Serialize};

/// A zero crossing of a mode's damping.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Threshold {
    /// Ω \[rad/s\].
    pub speed: f64,
    /// Whether the mode is unstable above this speed.
    pub unstable_above: bool,
    /// The mode at this speed, with its label there.
    pub mode: Mode,
}

/// Speeds where Re λ of a tracked branch changes sign, by speed.
///
/// # Errors
/// As [`campbell`](super::campbell::campbell).
pub fn thresholds(
    assembly: &Assembly,
    diagram: &Campbell,
    tangents: &impl Tangents,
) -> Result<Vec<Threshold>, PhysicsError> {
    let tracker = Tracker { assembly, tangents, count: diagram.count + EXTRA_MODES };
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
                found.push(Threshold { speed, unstable_above, mode });
            }
        }
    }
    found.sort_by(|a, b| a.speed.total_cmp(&b.speed));
    Ok(found)
}

impl<T: Tangents> Tracker<'_, T> {
    /// The speed between a and b where `gap` of the mode vanishes, and the mode there (secant method
    /// safeguarded by bisection, to 1e-12 of the speed).
    fn root(
        &self,
        (mut left, a): (f64, &Mode),
        (mut right, b): (f64, &Mode),
        gap: impl Fn(&Mode, f64) -> f64,
    ) -> Result<(f64, Mode), PhysicsError> {
        let (mut ga, mut gb) = (gap(a, left), gap(b, right));
        let mut best = (right, b.clone());
        if gb == 0.0 {
            return Ok(best);
        }
        let ends = [a.clone(), b.clone()];
        for step in 0..60 {
            let secant = (left * gb - right * ga) / (gb - ga);
            // Every third step bisects the bracket, so that neither end stagnates.
            let speed = if step % 3 == 2 { 0.5 * (left + right) } else { secant };
            let modes = self.modes(speed)?;
            let mac = self.mac(&ends, &modes);
            let mac_sum = |j: usize| mac[0][j] + mac[1][j];
            let Some(j) = (0..modes.len()).max_by(|&i, &j| mac_sum(i).total_cmp(&mac_sum(j))) else {
                break;
            };
            let g = gap(&modes[j], speed);
            best = (speed, modes.into_iter().nth(j).expect("index found above"));
            if g == 0.0 {
                break;
            }
            if (g > 0.0) == (ga > 0.0) {
                (left, ga) = (speed, g);
            } else {
                (right, gb) = (speed, g);
            }
            let tight = 1e-12 * right.abs();
            if (right - left).abs() < tight || (secant - speed).abs() < tight && g.abs() < 1e-11 * speed.abs()
            {
                break;
            }
        }
        Ok(best)
    }
}

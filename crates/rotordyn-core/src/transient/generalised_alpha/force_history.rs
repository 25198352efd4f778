//! Bearing forces of the last steps, from which Newton's method starts.

use serde::{Deserialize, Serialize};

/// Forces at the starts of the last equal steps.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct ForceHistory {
    /// At the start of the last step and of the one before.
    forces: [Vec<f64>; 2],
    /// Length of these steps \[s\], and how many of them there are.
    step: f64,
    count: usize,
}

impl ForceHistory {
    pub fn new(places: usize) -> Self {
        Self { forces: [vec![0.0; places], vec![0.0; places]], step: 0.0, count: 0 }
    }

    /// Number of forces.
    pub fn places(&self) -> usize {
        self.forces[0].len()
    }

    /// Force at the end of a step from `now` at its start: the parabola through the last three states, after fewer equal steps
    /// the straight line or the last force.
    pub fn extrapolate(&self, now: &[f64], step: f64, out: &mut [f64]) {
        let [last, before] = &self.forces;
        let states = now.iter().zip(last).zip(before);
        let count = if self.step == step { self.count } else { 0 };
        for (out, ((now, last), before)) in out.iter_mut().zip(states) {
            *out = match count {
                0 => *now,
                1 => 2.0 * now - last,
                _ => 3.0 * (now - last) + before,
            };
        }
    }

    /// Notes the force at the start of a step that was taken.
    pub fn push(&mut self, start: &[f64], step: f64) {
        self.count = if self.step == step { (self.count + 1).min(2) } else { 1 };
        self.step = step;
        self.forces.swap(0, 1);
        self.forces[0].copy_from_slice(start);
    }
}

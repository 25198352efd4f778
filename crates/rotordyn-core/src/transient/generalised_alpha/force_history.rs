//! Bearing forces of the last steps, from which Newton's method starts.

use serde::{Deserialize, Serialize};

/// Longest step to which forces are extrapolated, over the last step.
const LARGEST_GROWTH: f64 = 16.0;

/// Forces at the starts of the last two steps.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct ForceHistory {
    /// At the start of the last step and of the one before.
    forces: [Vec<f64>; 2],
    /// Lengths of these steps \[s\], and how many of them there are.
    steps: [f64; 2],
    count: usize,
}

impl ForceHistory {
    pub fn new(places: usize) -> Self {
        Self { forces: [vec![0.0; places], vec![0.0; places]], steps: [0.0; 2], count: 0 }
    }

    /// Number of forces.
    pub fn places(&self) -> usize {
        self.forces[0].len()
    }

    /// Force at the end of a step from `now` at its start: the parabola through the last three states, after one step the
    /// straight line, before any the last force.
    pub fn extrapolate(&self, now: &[f64], step: f64, out: &mut [f64]) {
        let [last, before] = &self.forces;
        let weights = self.weights(step);
        for (out, ((now, last), before)) in out.iter_mut().zip(now.iter().zip(last).zip(before)) {
            *out = now + weights[0] * (now - last) + weights[1] * (last - before);
        }
    }

    /// Weights of the change in the last step and of that in the one before.
    fn weights(&self, step: f64) -> [f64; 2] {
        let [last, before] = self.steps;
        match self.count {
            0 => [0.0; 2],
            _ if step > LARGEST_GROWTH * last => [0.0; 2],
            1 => [step / last, 0.0],
            // Newton's form: slopes of the two steps, and what they differ by.
            _ => {
                let bend = step * (step + last) / (last + before);
                [(step + bend) / last, -bend / before]
            }
        }
    }

    /// Notes the force at the start of a step that was taken.
    pub fn push(&mut self, start: &[f64], step: f64) {
        self.count = (self.count + 1).min(2);
        self.steps = [step, self.steps[0]];
        self.forces.swap(0, 1);
        self.forces[0].copy_from_slice(start);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parabolas_are_extrapolated_over_steps_of_any_length() {
        let force = |t: f64| 2.0 - 3.0 * t + 0.7 * t * t;
        let mut history = ForceHistory::new(1);
        let (mut time, mut out) = (0.0, [0.0]);
        for (k, step) in [1.0, 1.0, 0.25, 0.25, 1.5, 3.0].into_iter().enumerate() {
            history.extrapolate(&[force(time)], step, &mut out);
            if k >= 2 {
                assert!((out[0] - force(time + step)).abs() < 1e-13, "{k}");
            }
            history.push(&[force(time)], step);
            time += step;
        }
        // Much longer steps begin with the last force.
        history.extrapolate(&[force(time)], 60.0, &mut out);
        assert_eq!(out[0], force(time));
    }
}

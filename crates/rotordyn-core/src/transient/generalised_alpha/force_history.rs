//! Bearing forces of the last steps, from which Newton's method starts.

use serde::{Deserialize, Serialize};

/// States before the present one that are kept: the degree of the polynomial through all of them.
const DEGREE: usize = 4;
/// Longest step to which forces are extrapolated, over the last step.
const LARGEST_GROWTH: f64 = 16.0;
/// Lagrange's weights for equal steps, by the number of states before the present one.
const EQUAL_STEPS: [(f64, [f64; DEGREE]); DEGREE + 1] = [
    (1.0, [0.0; DEGREE]),
    (2.0, [-1.0, 0.0, 0.0, 0.0]),
    (3.0, [-3.0, 1.0, 0.0, 0.0]),
    (4.0, [-6.0, 4.0, -1.0, 0.0]),
    (5.0, [-10.0, 10.0, -5.0, 1.0]),
];

/// Forces at the starts of the last steps, the last one first.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct ForceHistory {
    forces: [Vec<f64>; DEGREE],
    /// Lengths of these steps \[s\], and how many of them there are.
    steps: [f64; DEGREE],
    count: usize,
}

impl ForceHistory {
    pub fn new(places: usize) -> Self {
        let forces = std::array::from_fn(|_| vec![0.0; places]);
        Self { forces, steps: [0.0; DEGREE], count: 0 }
    }

    /// Number of forces.
    pub fn places(&self) -> usize {
        self.forces[0].len()
    }

    /// Force at the end of a step from `now` at its start: the polynomial through the last five states or as many as there are.
    #[inline(always)]
    pub fn extrapolate(&self, now: &[f64], step: f64, out: &mut [f64]) {
        let (of_now, before) = self.weights(step);
        for (out, now) in out.iter_mut().zip(now) {
            *out = of_now * now;
        }
        for (weight, forces) in before.iter().zip(&self.forces) {
            for (out, force) in out.iter_mut().zip(forces) {
                *out += weight * force;
            }
        }
    }

    /// Lagrange's weights of the present state and of those before.
    #[inline(always)]
    fn weights(&self, step: f64) -> (f64, [f64; DEGREE]) {
        let count = if step > LARGEST_GROWTH * self.steps[0] { 0 } else { self.count };
        if self.steps[..count].iter().all(|length| *length == step) {
            return EQUAL_STEPS[count];
        }
        // How long ago the states were.
        let mut ages = [0.0; DEGREE];
        let mut age = 0.0;
        for (of, length) in ages.iter_mut().zip(self.steps).take(count) {
            age += length;
            *of = age;
        }
        let ages = &ages[..count];
        let of_now = ages.iter().map(|age| (step + age) / age).product();
        let mut before = [0.0; DEGREE];
        for (k, own) in ages.iter().enumerate() {
            let others = ages.iter().enumerate().filter(|(j, _)| *j != k);
            let product: f64 = others.map(|(_, age)| (step + age) / (age - own)).product();
            before[k] = -step / own * product;
        }
        (of_now, before)
    }

    /// Notes the force at the start of a step that was taken.
    #[inline(always)]
    pub fn push(&mut self, start: &[f64], step: f64) {
        self.count = (self.count + 1).min(DEGREE);
        self.steps.rotate_right(1);
        self.steps[0] = step;
        self.forces.rotate_right(1);
        self.forces[0].copy_from_slice(start);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_steps_extrapolate_the_polynomial_through_the_states_so_far() {
        for degree in 0..=DEGREE {
            let force = |k: usize| (k as f64 - 0.7).powi(degree as i32);
            let mut history = ForceHistory::new(1);
            (0..degree).for_each(|k| history.push(&[force(k)], 1.0));
            let mut out = [0.0];
            history.extrapolate(&[force(degree)], 1.0, &mut out);
            assert!((out[0] - force(degree + 1)).abs() < 1e-11, "{degree}: {out:?}");
        }
    }

    #[test]
    fn polynomials_are_extrapolated_over_steps_of_any_length() {
        let force = |t: f64| 2.0 - 3.0 * t + 0.7 * t * t - 0.2 * t * t * t + 0.03 * t.powi(4);
        let mut history = ForceHistory::new(1);
        let (mut time, mut out) = (0.0, [0.0]);
        for (k, step) in [1.0, 1.0, 0.25, 0.25, 1.5, 3.0, 0.5, 0.5, 0.5, 0.5, 0.5].into_iter().enumerate() {
            history.extrapolate(&[force(time)], step, &mut out);
            if k == 1 {
                assert!((out[0] - (force(1.0) + force(1.0) - force(0.0))).abs() < 1e-13);
            }
            // Weights up to some hundreds, forces up to a hundred.
            if k >= DEGREE {
                assert!((out[0] - force(time + step)).abs() < 1e-11, "{k}");
            }
            history.push(&[force(time)], step);
            time += step;
        }
        // Much longer steps begin with the last force.
        history.extrapolate(&[force(time)], 60.0, &mut out);
        assert_eq!(out[0], force(time));
    }
}

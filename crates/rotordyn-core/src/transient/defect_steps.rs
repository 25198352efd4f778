//! Shorter steps while a rolling element is on a local defect, and until what it excited has decayed.
//!
//! At the edges of a defect the path of a ball has a bend, and in it the ball may lose contact and come back: for a part of a run
//! steps must be much shorter than those that vibrations at the ball pass need.

use serde::{Deserialize, Serialize};

use super::cage;
use super::system::{State, System};
use rotordyn_bearing::Rotation;

/// Steps are divided until accelerations are down to this share of their peak since the passage.
const DECAYED: f64 = 0.2;
/// Steps for which they must be, so that an instant between two peaks does not count.
const LOW_STEPS: usize = 16;

/// Which steps of a run are divided.
pub struct DefectSteps {
    parts: usize,
    vibration: Vibration,
    /// Cages at the end of the next step.
    rotations: Vec<Rotation>,
}

/// Vibration around the last passage over a defect: norms of the mass-normalised accelerations.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Vibration {
    /// Whether steps are divided.
    is_divided: bool,
    /// Largest norm since the passage began.
    peak: f64,
    /// Number of steps for which the norm has been low.
    low: usize,
    /// Number of parts of the last step; 0 before the first one.
    parts: usize,
}

impl DefectSteps {
    /// For steps of a length \[s\], divided into parts that are not longer than `defect_step`, after a `vibration`.
    pub fn new(system: &System, step: f64, defect_step: f64, vibration: Vibration) -> Self {
        let has_defects = system.interfaces.iter().any(|i| i.has_cage() && i.element.has_defects());
        let parts =
            if has_defects { (step / defect_step * (1.0 - 1e-12)).ceil().max(1.0) as usize } else { 1 };
        Self { parts, vibration, rotations: vec![Rotation::default(); system.interfaces.len()] }
    }

    /// Number of parts of a divided step; 1 if none is divided.
    pub fn parts(&self) -> usize {
        self.parts
    }

    /// What the next steps take from those so far.
    pub fn vibration(&self) -> Vibration {
        self.vibration
    }

    /// Number of equal parts of the next step, from a state on, and that of the last step if it was another one.
    pub fn divide(&mut self, system: &System, state: &State, step: f64) -> (usize, Option<usize>) {
        if self.parts == 1 {
            return (1, None);
        }
        let spin = system.spin_ahead(state.time, &state.spin, step);
        cage::advance(system, state, &spin, &mut self.rotations);
        let mut moved = system.interfaces.iter().zip(state.rotations.iter().zip(&self.rotations));
        let meets_defect = moved.any(|(i, (from, to))| i.element.meets_defect(from, to));
        let divided = self.vibration.observe(meets_defect, state.acceleration.norm());
        let parts = if divided { self.parts } else { 1 };
        let last = std::mem::replace(&mut self.vibration.parts, parts);
        (parts, Some(last).filter(|last| *last > 0 && *last != parts))
    }
}

impl Vibration {
    /// Takes the level at the start of a step; whether the step is divided.
    fn observe(&mut self, meets_defect: bool, level: f64) -> bool {
        if !self.is_divided && !meets_defect {
            return false;
        }
        self.is_divided = true;
        self.peak = self.peak.max(level);
        let is_low = !meets_defect && level <= DECAYED * self.peak;
        self.low = if is_low { self.low + 1 } else { 0 };
        if self.low > LOW_STEPS {
            *self = Self { parts: self.parts, ..Self::default() };
        }
        self.is_divided
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_divided_until_the_vibration_has_decayed() {
        let mut vibration = Vibration::default();
        // A passage of 5 steps, then a vibration of 100 that decays by 10 % from one step to the next, twice.
        let level = |k: i32| 100.0 * 0.9f64.powi(k);
        for _ in 0..2 {
            let divided =
                (0..200).filter(|&k| vibration.observe((10..15).contains(&k), level((k - 10).max(0))));
            // DECAYED of the peak is reached after n steps.
            let n = (DECAYED.ln() / 0.9f64.ln()).ceil() as i32;
            assert_eq!(divided.collect::<Vec<_>>(), (10..10 + n + LOW_STEPS as i32).collect::<Vec<_>>());
        }
        // A vibration that does not decay keeps the steps short.
        assert_eq!((0..300).filter(|&k| vibration.observe(k == 50, 7.0)).count(), 250);
    }
}

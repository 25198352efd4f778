//! Inertias of the reduced modes, fitted to the length of the steps.

use nalgebra::DVector;
use serde::{Deserialize, Serialize};

/// Inertias M̂ of the structure's coordinates for steps of one length; none: all are 1.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Inertias {
    /// \[s\]; 0 before the first step.
    step: f64,
    values: Vec<f64>,
}

impl Inertias {
    /// Whether they are those of steps of this length.
    pub fn are_for(&self, step: f64) -> bool {
        self.step == step
    }

    /// Takes the inertias for steps of another length, and changes velocities and accelerations with them.
    ///
    /// With a step h a vibration x = A cos ωt has the velocity −A ω sin ωt · tan(ωh/2)/(ωh/2), whose square times M̂ is that of the
    /// exact one. Velocities therefore change with 1/√M̂, which keeps ½ ẋᵀ M̂ ẋ, and accelerations with 1/M̂, which keeps M̂ ẍ.
    /// Before the first step they hold for any inertias.
    pub fn change(
        &mut self,
        step: f64,
        values: Vec<f64>,
        velocity: &mut DVector<f64>,
        accelerations: [&mut DVector<f64>; 2],
    ) {
        let ratios = || self.values.iter().zip(&values).map(|(before, now)| before / now);
        velocity.iter_mut().zip(ratios()).for_each(|(v, ratio)| *v *= ratio.sqrt());
        for acceleration in accelerations {
            acceleration.iter_mut().zip(ratios()).for_each(|(a, ratio)| *a *= ratio);
        }
        *self = Self { step, values };
    }

    /// M̂⁻¹ f, in place.
    pub fn divide(&self, f: &mut DVector<f64>) {
        f.iter_mut().zip(&self.values).for_each(|(f, m)| *f /= m);
    }

    /// ½ ẋᵀ M̂ ẋ \[J\].
    pub fn kinetic_energy(&self, v: &DVector<f64>) -> f64 {
        let missing = self.values.iter().zip(v.iter()).map(|(m, v)| (1.0 - m) * v * v).sum::<f64>();
        0.5 * (v.norm_squared() - missing)
    }
}

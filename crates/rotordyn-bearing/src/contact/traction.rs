//! Traction between rolling bodies: Coulomb friction regularised at zero slip.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// Regularised Coulomb traction.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Traction {
    /// Coefficient of friction μ \[-\].
    pub friction: f64,
    /// Slip speed v₀ \[m/s\] below which traction is proportional to slip.
    pub slip_speed: f64,
}

impl Traction {
    /// Friction force \[N\] on the body with slip velocity v \[m/s\]: F = −μ Q v / √(v² + v₀²).
    ///
    /// Limits: −μ Q v/v₀ for small slip (a tangential load causes creep, no sticking), −μ Q v/|v| for
    /// large slip; F · v ≤ 0 always (dissipative).
    pub fn force(&self, load: f64, slip: &Vector3<f64>) -> Vector3<f64> {
        -slip * (self.friction * load / slip.norm().hypot(self.slip_speed))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_of_small_and_large_slip() {
        let law = Traction { friction: 0.1, slip_speed: 1e-2 };
        let small = law.force(50.0, &Vector3::new(1e-8, 0.0, 0.0)).x;
        assert!((small / (-0.1 * 50.0 * 1e-8 / 1e-2) - 1.0).abs() < 1e-12);
        let large = law.force(50.0, &Vector3::new(0.0, -1e6, 0.0));
        assert!((large.y - 5.0).abs() < 1e-12 && large.x == 0.0);
        assert_eq!(law.force(50.0, &Vector3::zeros()), Vector3::zeros());
    }
}

//! Load of each row of a ball bearing, preload contained.

use crate::BallLoad;
use std::ops::AddAssign;

/// Load integrals of Harris for a radial load on half of the balls, ε = 0.5, (1/2π) ∫ cosⁿψ dψ over ± π/2: of the radial force
/// (n = 5/2), of the sum of the balls' loads (3/2), and of their cubes (9/2), of which the third root counts for fatigue.
///
/// Source: Harris, Rolling Bearing Analysis, ch. 7.
const RADIAL: f64 = 0.2288;
const SUM: f64 = 0.2782;
const FATIGUE: f64 = 0.5625;
/// Z Q_max/F_r of ISO 76, with some clearance.
const LARGEST: f64 = 5.0;
/// F_r/Σ Q cos α below which more than half of the balls carry load; with half of them it is RADIAL/SUM = 0.82.
const PRELOADED: f64 = 0.75;

/// Resultant of the balls' loads on the inner ring of one row.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RowLoad {
    /// Along x and y \[N\].
    radial: [f64; 2],
    /// Along z \[N\].
    axial: f64,
    /// Σ Q_i cos α_i \[N\].
    pressing: f64,
    /// Number of balls, Σ (Q_i cos α_i)³ \[N³\], max Q_i cos α_i \[N\].
    balls: f64,
    cubes: f64,
    largest: f64,
}

impl AddAssign<&BallLoad> for RowLoad {
    fn add_assign(&mut self, ball: &BallLoad) {
        let (sin, cos) = ball.contact_angle.sin_cos();
        let across = ball.load * cos;
        self.radial[0] += across * ball.position.cos();
        self.radial[1] += across * ball.position.sin();
        self.axial += ball.load * sin;
        self.pressing += across.abs();
        self.balls += 1.0;
        self.cubes += across.abs().powi(3);
        self.largest = self.largest.max(across.abs());
    }
}

impl RowLoad {
    /// Loads of `rows` rows.
    pub fn of_rows(rows: usize, balls: &[BallLoad]) -> Vec<Self> {
        let mut found = vec![Self::default(); rows];
        for ball in balls {
            if let Some(row) = found.get_mut(ball.row) {
                *row += ball;
            }
        }
        found
    }

    /// F_r and F_a \[N\].
    pub fn forces(&self) -> [f64; 2] {
        [self.radial[0].hypot(self.radial[1]), self.axial.abs()]
    }

    /// Whether more than half of the balls carry load, which a radial load without clearance presses: in both rows of a pair
    /// only a preload does.
    pub fn is_preloaded(&self) -> bool {
        let [radial, _] = self.forces();
        self.pressing > 0.0 && radial < PRELOADED * self.pressing
    }

    /// The radial load \[N\] on half of the balls with the same sum of the balls' loads, which counts for friction.
    pub fn equal_in_friction(&self) -> f64 {
        RADIAL / SUM * self.pressing
    }

    /// The one \[N\] with the same mean cube of the balls' loads, which counts for fatigue of the turning ring.
    pub fn equal_in_fatigue(&self) -> f64 {
        RADIAL / FATIGUE * self.balls * (self.cubes / self.balls.max(1.0)).cbrt()
    }

    /// The one \[N\] with the same largest load of a ball, which counts for the static safety.
    pub fn equal_in_largest_load(&self) -> f64 {
        self.balls * self.largest / LARGEST
    }
}

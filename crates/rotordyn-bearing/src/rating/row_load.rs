//! Load of each row of a ball bearing, preload contained.

use crate::BallLoad;
use std::ops::AddAssign;

/// F_r/Σ Q cos α of a radial load on half of the balls, J_r/J_a of the load zone ε = 0.5 = 0.2288/0.2782.
///
/// Source: Harris, Rolling Bearing Analysis, ch. 7 (table 7.1 and 7.4).
const RADIAL_SHARE: f64 = 0.82;
/// The same below which more than half of the balls carry load.
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
}

impl AddAssign<&BallLoad> for RowLoad {
    fn add_assign(&mut self, ball: &BallLoad) {
        let (sin, cos) = ball.contact_angle.sin_cos();
        let across = ball.load * cos;
        self.radial[0] += across * ball.position.cos();
        self.radial[1] += across * ball.position.sin();
        self.axial += ball.load * sin;
        self.pressing += across.abs();
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

    /// Whether more balls carry load than half of them, as a radial load alone lets carry: both rows of a pair do so with a
    /// preload only.
    pub fn is_preloaded(&self) -> bool {
        let [radial, _] = self.forces();
        self.pressing > 0.0 && radial < PRELOADED * self.pressing
    }

    /// The radial load \[N\] that presses balls as much as interference between rings and balls does.
    pub fn equivalent_of_interference(&self) -> f64 {
        RADIAL_SHARE * self.pressing
    }
}

//! Automatic ball inertia of single bearings.

use super::{OperatingPoint, SingleBearingStudy, cage_treatment};
use crate::analysis::ball_inertia::{InertiaUse, largest_contact_load};
use crate::analysis::bearing_stiffness::{BearingSolver, Condition};
use crate::model::study::{BearingStudy, SweepVariable};
use crate::results::BearingPoint;
use rotordyn_bearing::{BallBearing, BallInertia};

/// Speeds of a study \[rad/s\]: of the operating point and of speed sweeps; a default sweep without a stated speed
/// reaches twice its speed.
pub(super) fn speeds(study: &BearingStudy, speed: f64) -> Vec<f64> {
    let default = study.sweeps.is_empty() && study.speed.is_none();
    let swept = study.sweeps.iter().filter(|sweep| sweep.variable == SweepVariable::Speed);
    let highest = if default { 2.0 * speed } else { speed };
    swept.flat_map(|sweep| sweep.values.iter().copied()).chain([highest]).collect()
}

impl SingleBearingStudy<'_> {
    /// The bearing with its automatic ball inertia decided at the highest speed of the study, from the largest
    /// contact load of massless balls under its load.
    pub(super) fn decided(&self) -> BallBearing {
        let mut ball = self.bearing.clone();
        if ball.inertia != BallInertia::Auto(None) {
            return ball;
        }
        let massless = BallBearing { inertia: BallInertia::None, ..ball.clone() };
        let solver = BearingSolver::new(self.name, &massless);
        let OperatingPoint { load, prescribed, .. } = self.operating();
        let speed = self.top_speed();
        let (cage, cage_angle) = (cage_treatment(self.study), ball.cage_angle);
        let found = solver.solve(&Condition { load, prescribed, speed, cage, cage_angle }, None);
        let largest = found.map_or(0.0, |found| {
            let [x, y, z, a, b] = found.displacement;
            largest_contact_load(solver.element.as_ref(), &[x, y, z, a, b, 0.0], speed)
        });
        ball.inertia = InertiaUse::new(self.name, &ball, speed, largest).inertia;
        ball
    }

    /// Ball inertia of the study: its decision, or the loads of the inner race at the operating point.
    pub(super) fn inertia_use(&self, point: &BearingPoint) -> InertiaUse {
        let largest = point.balls.iter().map(|ball| ball.inner.load).fold(0.0, f64::max);
        let mut found = InertiaUse::new(self.name, self.bearing, self.top_speed(), largest);
        if let BallInertia::Auto(Some(decision)) = self.bearing.inertia {
            found.compared = decision;
        }
        found
    }

    fn top_speed(&self) -> f64 {
        speeds(self.study, self.speed).iter().fold(0.0, |top, speed| top.max(speed.abs()))
    }
}

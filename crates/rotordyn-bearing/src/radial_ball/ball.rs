//! One ball between its races: position, contact deformation, contact forces.

use super::RadialElement;
use super::ball_state::{BallState, ContactState, LocalMotion};

impl RadialElement {
    /// State of the ball at position y and velocity ẏ.
    #[inline(always)]
    pub(super) fn ball_state(&self, seen: &LocalMotion, place: f64, rate: f64) -> BallState {
        let cage_speed = seen.cage_speed;
        let lift = place - seen.housing_displacement[0];
        let radius = self.outer_contact_radius + lift;
        let radial_rate = rate - seen.housing_velocity[0] - cage_speed * seen.housing_displacement[1];
        let arm = [radius - seen.relative_displacement[0], -seen.relative_displacement[1]];
        let distance = (arm[0] * arm[0] + arm[1] * arm[1]).sqrt();
        let n = [arm[0] / distance, arm[1] / distance];
        let drift =
            [radial_rate - seen.relative_velocity[0], radius * cage_speed - seen.relative_velocity[1]];
        // ρ_i − χ without cancellation: χ − a_r = a_t²/(χ + a_r).
        let bend = arm[1] * arm[1] / (distance + arm[0]);
        let gap = self.outer_contact_radius - self.inner_contact_radius;
        let depth =
            [seen.relative_displacement[0] - lift - gap - bend + seen.deviation[0], lift + seen.deviation[1]];
        let closing = [
            seen.deviation_rate[0] - n[0] * drift[0] - n[1] * drift[1],
            radial_rate + seen.deviation_rate[1],
        ];
        let contacts = [0, 1].map(|k| self.contact_force(k, depth[k], closing[k]));
        let carried = cage_speed
            * (cage_speed * (radius - seen.housing_displacement[0]) + 2.0 * seen.housing_velocity[1]);
        let force = contacts[0].force * n[0] - contacts[1].force + self.mass * carried + seen.weight;
        BallState {
            n,
            distance,
            relative_ball_velocity: drift,
            radial_rate,
            deformation: depth,
            deformation_rate: closing,
            contacts,
            force,
        }
    }

    /// Contact law F = K δ^{3/2} + (3/2) C K δ^{1/2} δ̇ for δ > 0 (Upadhyay 2009 eq. A.4, A.5, B.3, B.5 with
    /// p = 1).
    ///
    /// Limits: zero at δ ≤ 0; ∂F/∂δ is unbounded as δ → 0 with δ̇ ≠ 0.
    #[inline(always)]
    fn contact_force(&self, contact: usize, depth: f64, rate: f64) -> ContactState {
        if depth <= 0.0 {
            return ContactState::default();
        }
        let (k, lag) = (self.stiffness[contact], 1.5 * self.damping[contact] * rate);
        let root = depth.sqrt();
        let elastic = k * root * depth;
        let mut out = ContactState { elastic, energy: 0.4 * elastic * depth, ..ContactState::default() };
        if self.tensile_contact || depth + lag > 0.0 {
            out.force = elastic + k * root * lag;
            out.by_deformation = 1.5 * k * root + 0.5 * k * lag / root;
            out.by_rate = 1.5 * self.damping[contact] * k * root;
        }
        out
    }
}

//! First and second derivatives of a ball's equilibrium E(x, y) = 0, x = s − b and y = b.

use super::equilibrium::{
    BallEquilibrium, BallInertiaLoads, Matrix, RaceContact, RaceForces, difference, dot, solve_2x2,
};
use crate::contact::{ContactLoad, Race};

/// Relative change of loads and contact angles within a central difference of exact first derivatives: its error is the
/// square of this, 1e-8.
const RELATIVE_STEP: f64 = 1e-4;

/// First derivatives of a ball's equilibrium.
pub(super) struct EquilibriumDerivatives {
    pub forces: RaceForces,
    /// ∂E/∂x and ∂E/∂y.
    by_x: Matrix,
    by_y: Matrix,
    /// ∂E/∂b at fixed s.
    pub jacobian: Matrix,
    /// Columns of S = ∂b/∂s = −(∂E/∂b)⁻¹ ∂E/∂x.
    pub centre_by_position: [[f64; 2]; 2],
}

/// Change of a ball in equilibrium: of x, of y, and of the deviations of both surfaces.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct EquilibriumChange {
    x: [f64; 2],
    pub y: [f64; 2],
    deviation: [f64; 2],
}

/// Curvature of the axial force p_z of a ball over the position s = (radial, axial) of its inner groove centre.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct AxialCurvature {
    /// ∂²p_z/∂s²: rr, rz, zz \[N/m²\].
    pub by_position: [f64; 3],
    /// Rate of (∂p_z/∂s_r, ∂p_z/∂s_z) along the motion \[N/(m s)\].
    pub rate: [f64; 2],
}

fn apply(m: &Matrix, v: [f64; 2]) -> [f64; 2] {
    [dot(m[0], v), dot(m[1], v)]
}

fn along(n: [f64; 2], by: f64) -> [f64; 2] {
    n.map(|n| n * by)
}

fn sum(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

impl EquilibriumDerivatives {
    #[inline(always)]
    pub fn new(loads: &BallInertiaLoads, ball: &BallEquilibrium) -> Self {
        let forces = loads.forces(&ball.inner, &ball.outer);
        let by_x = difference(&forces.inner_by[0], &forces.outer_by[0]);
        let by_y = difference(&forces.inner_by[1], &forces.outer_by[1]);
        let jacobian = difference(&by_y, &by_x);
        let centre_by_position = [0, 1].map(|c| solve_2x2(&jacobian, [-by_x[0][c], -by_x[1][c]]));
        Self { forces, by_x, by_y, jacobian, centre_by_position }
    }

    /// Motion of the ball centre that keeps the equilibrium where E changes by `residual`: −(∂E/∂b)⁻¹ ΔE.
    pub fn centre_change(&self, residual: [f64; 2]) -> [f64; 2] {
        solve_2x2(&self.jacobian, residual.map(|r| -r))
    }

    /// Change of the ball with s and with the surface deviations, which act like a motion along the contact line.
    #[inline(always)]
    pub fn change(&self, ball: &BallEquilibrium, s: [f64; 2], deviation: [f64; 2]) -> EquilibriumChange {
        let x = sum(s, along(ball.inner.n, deviation[0]));
        let residual = sum(apply(&self.by_x, x), apply(&self.by_y, along(ball.outer.n, deviation[1])));
        let y = self.centre_change(residual);
        EquilibriumChange { x: [s[0] - y[0], s[1] - y[1]], y, deviation }
    }

    /// Change of the force p on the inner ring.
    pub fn force_change(&self, ball: &BallEquilibrium, change: &EquilibriumChange) -> [f64; 2] {
        let x = sum(change.x, along(ball.inner.n, change.deviation[0]));
        let y = sum(change.y, along(ball.outer.n, change.deviation[1]));
        sum(apply(&self.forces.inner_by[0], x), apply(&self.forces.inner_by[1], y))
    }

    /// Curvature of the axial force, and the rate of its first derivatives along a motion.
    ///
    /// With ′ for a change that keeps the equilibrium, E_zz\[z′_a, z′_b\] + (∂E/∂b) y″ = 0 gives y″, and
    /// p″ = R_i,zz\[z′_a, z′_b\] + (∂R_i/∂y − ∂R_i/∂x) y″, z = (x, y). The second derivatives of E and R_i are
    /// differences of the exact first ones along one change each: no further equilibrium is solved.
    pub fn axial_curvature(
        &self,
        loads: &BallInertiaLoads,
        single: impl Fn(Race, f64) -> ContactLoad,
        ball: &BallEquilibrium,
        motion: &EquilibriumChange,
        rate: [f64; 2],
    ) -> AxialCurvature {
        let unit = [[1.0, 0.0], [0.0, 1.0]].map(|s| self.change(ball, s, [0.0; 2]));
        let second = |derivatives: &[Matrix; 4], by: &EquilibriumChange| -> f64 {
            let [inner_x, inner_y, outer_x, outer_y] = derivatives;
            let of = |by_x: &Matrix, by_y: &Matrix| sum(apply(by_x, by.x), apply(by_y, by.y));
            let [inner, outer] = [of(inner_x, inner_y), of(outer_x, outer_y)];
            let y = self.centre_change([inner[0] - outer[0], inner[1] - outer[1]]);
            inner[1] + dot(self.forces.inner_by[1][1], y) - dot(self.forces.inner_by[0][1], y)
        };
        let [by_radial, by_axial] = unit.map(|change| self.rate_along(loads, &single, ball, &change));
        let mixed = second(&by_axial, &unit[0]);
        let [rr, zz] = [second(&by_radial, &unit[0]), second(&by_axial, &unit[1])];
        let rate = if motion.deviation == [0.0; 2] {
            [rr * rate[0] + mixed * rate[1], mixed * rate[0] + zz * rate[1]]
        } else {
            let by_motion = self.rate_along(loads, &single, ball, motion);
            unit.map(|by| second(&by_motion, &by))
        };
        AxialCurvature { by_position: [rr, mixed, zz], rate }
    }

    /// Derivative of ∂R_i/∂x, ∂R_i/∂y, ∂R_o/∂x and ∂R_o/∂y along a change of the ball.
    fn rate_along(
        &self,
        loads: &BallInertiaLoads,
        single: &impl Fn(Race, f64) -> ContactLoad,
        ball: &BallEquilibrium,
        change: &EquilibriumChange,
    ) -> [Matrix; 4] {
        let sides = [
            (Race::Inner, &ball.inner, change.x, change.deviation[0]),
            (Race::Outer, &ball.outer, change.y, change.deviation[1]),
        ];
        let largest = sides.into_iter().fold(0.0, |most: f64, (_, contact, by, deviation)| {
            let loaded = &contact.loaded;
            let closing = (dot(contact.n, by) + deviation).abs();
            let by_load = if loaded.load > 0.0 { closing * loaded.slope / loaded.load } else { 0.0 };
            most.max(by_load).max(by[0].hypot(by[1]) / contact.length)
        });
        if largest == 0.0 {
            return [Matrix::default(); 4];
        }
        let step = RELATIVE_STEP / largest;
        let at = |length: f64| {
            let [inner, outer] = sides.map(|(race, contact, by, deviation)| {
                let mut moved = contact.moved([by[0] * length, by[1] * length], deviation * length);
                moved.loaded = single(race, moved.approach);
                moved
            });
            let forces = loads.forces(&inner, &outer);
            [forces.inner_by[0], forces.inner_by[1], forces.outer_by[0], forces.outer_by[1]]
        };
        let (after, before) = (at(step), at(-step));
        std::array::from_fn(|k| {
            difference(&after[k], &before[k]).map(|row| row.map(|value| value / (2.0 * step)))
        })
    }
}

impl RaceContact {
    /// The contact with its vector changed by `by` and the deviation of its surfaces by `deviation` \[m\], without load.
    fn moved(&self, by: [f64; 2], deviation: f64) -> Self {
        let to = sum(along(self.n, self.length), by);
        let length = to[0].hypot(to[1]);
        Self {
            n: to.map(|v| v / length),
            length,
            approach: self.approach + (length - self.length) + deviation,
            loaded: ContactLoad::default(),
        }
    }
}

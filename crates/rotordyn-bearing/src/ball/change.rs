//! Change of a ball's static reaction with the ring position and with the cage speed.

use super::derivatives::EquilibriumDerivatives;
use super::equilibrium::{BallEquilibrium, BallInertiaLoads, dot};

/// Derivatives of a ball's static reaction on the inner ring by one parameter.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct BallChange {
    /// Of the force p (radial, axial) and the friction moment m, as in the plane force and moment of a ball.
    pub force: [f64; 2],
    pub moment: f64,
    /// Of the load Q_i of the inner contact, and of Q_i times the cos α that sets the cage speed.
    pub load: f64,
    pub load_cos: f64,
}

/// A ball's load sums and their derivatives.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct BallChanges {
    /// Force p on the inner ring (radial, axial).
    pub force: [f64; 2],
    pub load: f64,
    pub load_cos: f64,
    /// By the radial and axial position s of the inner groove centre \[1/m\], and by the cage speed ω_c \[s/rad\].
    pub by: [BallChange; 3],
}

impl BallInertiaLoads {
    /// Derivatives of a ball in static equilibrium, by implicit differentiation.
    ///
    /// E(x, y, ω_c) = 0 with x = s − b, y = b gives ∂b/∂s = −(∂E/∂b)⁻¹ ∂E/∂x and
    /// ∂b/∂ω_c = −(∂E/∂b)⁻¹ ∂E/∂ω_c; every quantity g(x, y, ω_c) then changes with both.
    pub fn changes(&self, ball: &BallEquilibrium) -> BallChanges {
        let BallEquilibrium { inner, outer } = ball;
        let load = inner.loaded.load;
        if load <= 0.0 {
            return BallChanges::default();
        }
        let derivatives = EquilibriumDerivatives::new(self, ball);
        let forces = &derivatives.forces;
        let (friction_by, share_by_orbit) = self.friction_by_orbit(inner, outer);
        let (share, by_inner, by_outer) = self.share(load, outer.loaded.load);
        let (ti, to) = (inner.t(), outer.t());
        let [fi, fo] = friction_by;
        let residual = [fi * ti[0] - fo * to[0] + self.force_by_orbit, fi * ti[1] - fo * to[1]];
        let [by_radial, by_axial] = derivatives.centre_by_position;
        let centre = [by_radial, by_axial, derivatives.centre_change(residual)];
        let cosine = self.cage_cosine(inner, outer, share);
        let gamma = self.balls.gamma;
        let cos = dot(inner.n, outer.n);
        let ratio = 0.5 * (1.0 - gamma * cosine);
        let mut out =
            BallChanges { force: forces.inner, load, load_cos: load * cosine, ..BallChanges::default() };
        for (k, dy) in centre.into_iter().enumerate() {
            let ds = [f64::from(k == 0), f64::from(k == 1)];
            let dx = [ds[0] - dy[0], ds[1] - dy[1]];
            let explicit = f64::from(k == 2);
            let along = |x: [f64; 2], y: [f64; 2]| dot(x, dx) + dot(y, dy);
            let force =
                [0, 1].map(|r| along(forces.inner_by[0][r], forces.inner_by[1][r]) + explicit * fi * ti[r]);
            let friction = along(forces.friction_by[0], forces.friction_by[1]) + explicit * fi;
            let by_load = inner.loaded.slope * dot(inner.n, dx);
            let share_by = by_inner * by_load
                + by_outer * outer.loaded.slope * dot(outer.n, dy)
                + explicit * share_by_orbit;
            let (turn_i, turn_o) = (dot(ti, dx) / inner.length, dot(to, dy) / outer.length);
            let (dn_i, dn_o) = (ti.map(|t| t * turn_i), to.map(|t| t * turn_o));
            let d_cos = dot(dn_i, outer.n) + dot(inner.n, dn_o);
            let by_share = (cos - gamma * outer.n[0]) - (1.0 - gamma * inner.n[0]);
            let numerator =
                share_by * by_share - (1.0 - share) * gamma * dn_i[0] + share * (d_cos - gamma * dn_o[0]);
            let d_ratio = (numerator - ratio * d_cos) / (1.0 + cos);
            out.by[k] = BallChange {
                force,
                moment: -self.balls.groove_radius * friction,
                load: by_load,
                load_cos: by_load * cosine - 2.0 * load / gamma * d_ratio,
            };
        }
        out
    }
}

//! Tangent stiffness and damping of one ball over its local coordinates d_r d_t h_r h_t y, and of the
//! bearing.

use super::ball_state::{BallState, LocalMotion};
use super::{RadialElement, Rings};
use crate::Rotation;
use crate::internal::InternalTangent;

/// −∂Q/∂q and −∂Q/∂q̇ over q = (d_r d_t h_r h_t y).
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct BallTangent {
    pub stiffness: [[f64; 5]; 5],
    pub damping: [[f64; 5]; 5],
}

/// Index of y among the five coordinates.
pub(super) const BALL_COORDINATE: usize = 4;

impl BallState {
    /// Tangents at this state.
    ///
    /// With a = ρ e_r − d, n = a/χ and the relative velocity ȧ, the inner contact has dδ_i = b dq,
    /// b = (n_r, n_t, n_r, 0, −n_r), and dδ̇_i = b dq̇ + g dq, g = −(w·∂a/∂q + n·∂ȧ/∂q), w = (ȧ − n (n·ȧ))/χ;
    /// its force acts along −b, which rotates with n: ∂n/∂q = (1 − n nᵀ)/χ ∂a/∂q. Outer contact:
    /// b = (0, 0, −1, 0, 1).
    pub(super) fn tangent(&self, seen: &LocalMotion, mass: f64) -> BallTangent {
        let [inner, outer] = &self.contacts;
        let (n, cage_speed) = (self.n, seen.cage_speed);
        let mut out = BallTangent::default();
        let along = n[0] * self.relative_ball_velocity[0] + n[1] * self.relative_ball_velocity[1];
        let w = [0, 1].map(|k| (self.relative_ball_velocity[k] - n[k] * along) / self.distance);
        let b = [n[0], n[1], n[0], 0.0, -n[0]];
        let late = w[0] + n[1] * cage_speed;
        let g = [w[0], w[1], late, n[0] * cage_speed, -late];
        // ∂n_r/∂q and ∂n_t/∂q.
        let p = [n[1] * n[1], -n[0] * n[1], n[0] * n[0]].map(|v| v / self.distance);
        let direction_tangent = [[-p[0], -p[1], -p[0], 0.0, p[0]], [-p[1], -p[2], -p[1], 0.0, p[1]]];
        for r in [0, 1, 2, BALL_COORDINATE] {
            let turned = match r {
                1 => &direction_tangent[1],
                _ => &direction_tangent[0],
            };
            let sign = if r == BALL_COORDINATE { -1.0 } else { 1.0 };
            for c in 0..5 {
                out.stiffness[r][c] = b[r] * (inner.by_deformation * b[c] + inner.by_rate * g[c])
                    + sign * inner.force * turned[c];
                out.damping[r][c] = b[r] * inner.by_rate * b[c];
            }
        }
        for (r, sign) in [(2, -1.0), (BALL_COORDINATE, 1.0)] {
            out.stiffness[r][2] -= sign * outer.by_deformation;
            out.stiffness[r][BALL_COORDINATE] += sign * outer.by_deformation;
            out.stiffness[r][3] -= sign * outer.by_rate * cage_speed;
            out.damping[r][2] -= sign * outer.by_rate;
            out.damping[r][BALL_COORDINATE] += sign * outer.by_rate;
        }
        // m ψ̇² (y − 2 h_r) + 2 m ψ̇ ḣ_t on y, −2 m ψ̇ (ẏ − ḣ_r − ψ̇ h_t) on h_t.
        let (coriolis, centrifugal) = (2.0 * mass * cage_speed, mass * cage_speed * cage_speed);
        out.stiffness[BALL_COORDINATE][BALL_COORDINATE] -= centrifugal;
        out.stiffness[BALL_COORDINATE][2] += 2.0 * centrifugal;
        out.damping[BALL_COORDINATE][3] -= coriolis;
        out.damping[3][BALL_COORDINATE] += coriolis;
        out.damping[3][2] -= coriolis;
        out.stiffness[3][3] -= coriolis * cage_speed;
        out
    }
}

impl RadialElement {
    /// Tangents over d_x d_y h_x h_y and the balls at ball positions y and velocities ẏ.
    pub fn tangent(
        &self,
        rings: &Rings,
        [places, rates]: [&[f64]; 2],
        rotation: &Rotation,
    ) -> InternalTangent {
        let size = 4 + self.balls();
        let mut out =
            InternalTangent { stiffness: vec![vec![0.0; size]; size], damping: vec![vec![0.0; size]; size] };
        self.for_each_ball(rings, rotation, |j, seen| {
            let tangent = self.ball_state(&seen, places[j], rates[j]).tangent(&seen, self.mass);
            // Local directions from global ones: q_local = T q.
            let (c, s) = (seen.cos, seen.sin);
            let turn = [
                (0, [(0, c), (1, s)]),
                (1, [(0, -s), (1, c)]),
                (2, [(2, c), (3, s)]),
                (3, [(2, -s), (3, c)]),
            ];
            let terms = |local: usize| match turn.get(local) {
                Some((_, terms)) => *terms,
                None => [(4 + j, 1.0), (4 + j, 0.0)],
            };
            for a in 0..5 {
                for b in 0..5 {
                    for (row, f) in terms(a) {
                        for (column, g) in terms(b) {
                            out.stiffness[row][column] += f * g * tangent.stiffness[a][b];
                            out.damping[row][column] += f * g * tangent.damping[a][b];
                        }
                    }
                }
            }
        });
        out
    }
}

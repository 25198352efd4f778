//! Ball bearing element: one force element per ball, clearance, loss of contact, kinematic cage.
//!
//! Force law of Cakmak & Sanliturk 2010 §2.1 and §3.1 with massless balls: the groove centres of ball j are
//! A + δ_j apart, A = r_i + r_o − D_w, and the ball carries Q(δ_j) along the line that joins them.

use super::row::Row;
use super::{BallBearing, Cage, Reaction, Rotation};
use crate::contact::HertzPair;

/// A ball bearing made ready for evaluation.
#[derive(Clone, Debug)]
pub struct BallElement {
    /// Dry contacts at the nominal contact angle.
    pub contacts: HertzPair,
    row: Row,
    cage: Cage,
    ball_to_pitch: f64,
    nominal_cos: f64,
}

/// What one ball carries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallLoad {
    /// Angular position ψ_j \[rad\] from +x towards +y.
    pub position: f64,
    /// Normal load Q \[N\].
    pub load: f64,
    /// Contact angle α \[rad\].
    pub contact_angle: f64,
    /// Approach δ of the races \[m\]; negative is the gap that is left.
    pub deflection: f64,
}

impl BallElement {
    /// Prepares a bearing for evaluation.
    pub fn new(bearing: &BallBearing) -> Self {
        let g = &bearing.geometry;
        let row = Row::new(bearing, g.thrust_direction);
        Self {
            contacts: row.contacts.hertz,
            row,
            cage: bearing.cage,
            ball_to_pitch: g.ball_diameter / g.pitch_diameter,
            nominal_cos: g.contact_angle.cos(),
        }
    }

    /// Number of balls Z.
    pub fn balls(&self) -> usize {
        self.row.balls()
    }

    /// Cage speed over shaft speed at a mean contact angle: ½ (1 − D_w cos α / D_pw), or the given ratio.
    ///
    /// Source: Cakmak & Sanliturk 2010 eq. 20 with the outer ring at rest.
    pub fn cage_ratio(&self, mean_cos: f64) -> f64 {
        match self.cage {
            Cage::Rolling => 0.5 * (1.0 - self.ball_to_pitch * mean_cos),
            Cage::Ratio(ratio) => ratio,
        }
    }

    /// Cosine of the nominal contact angle.
    pub fn nominal_cos(&self) -> f64 {
        self.nominal_cos
    }

    /// Force on the shaft and both tangents at a displacement of the inner ring relative to the outer one.
    ///
    /// δ_j = |s_j| − A + w_i + w_o with s_j = (A cos α₀ − P_d/2 + x cos ψ_j + y sin ψ_j,
    /// A sin α₀ + z + R_i (θ_x sin ψ_j − θ_y cos ψ_j)), Q_j = max(0, Q(δ) + damping); f = −Σ Q_j ∂δ_j/∂d.
    /// δ̇ is the full rate of approach: motion of the rings, of the cage and of the waves.
    ///
    /// `d`, `v`: displacement \[m, rad\] and velocity of the shaft relative to the housing (θ_z is ignored).
    /// Limits: all balls unloaded gives zero force and zero tangents; the force never pulls.
    pub fn reaction(&self, d: &[f64; 6], v: &[f64; 6], rotation: &Rotation) -> Reaction {
        self.react(d, v, rotation, rotation.cage_speed, true)
    }

    fn react(&self, d: &[f64; 6], v: &[f64; 6], rotation: &Rotation, turning: f64, waves: bool) -> Reaction {
        let operating = self.row.operating(rotation, turning, waves);
        let sum = self.row.sum(d, v, rotation, &operating);
        let mut out = self.row.reaction(&sum, &operating);
        out.mean_cos = if sum.load > 0.0 { sum.load_cos / sum.load } else { self.nominal_cos };
        out
    }

    /// Elastic force and stiffness averaged over one ball pitch of cage angles at fixed ring displacement.
    ///
    /// f̄(d) = (1/N) Σ_k f(d, ψ₀ + (2π/Z) k/N); the average is a potential force, so its tangent is symmetric.
    /// Waviness is left out: it averages to zero over a turn.
    pub fn cage_average(&self, d: &[f64; 6], rotation: &Rotation, angles: usize) -> Reaction {
        let pitch = std::f64::consts::TAU / self.balls() as f64;
        let mut out = Reaction::default();
        for k in 0..angles {
            let at =
                Rotation { cage_angle: rotation.cage_angle + pitch * k as f64 / angles as f64, ..*rotation };
            out.add(&self.react(d, &[0.0; 6], &at, 0.0, false), 1.0 / angles as f64);
        }
        out
    }

    /// Load, contact angle and approach of every ball under elastic forces alone.
    pub fn ball_loads(&self, d: &[f64; 6], rotation: &Rotation) -> Vec<BallLoad> {
        let operating = self.row.operating(rotation, 0.0, true);
        self.row.ball_loads(d, rotation, &operating)
    }
}

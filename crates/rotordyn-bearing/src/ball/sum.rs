//! Sum over a row's balls: from ball forces and tangents in their plane to the five degrees of freedom of the
//! inner ring.
//!
//! The displacement d = (u_x u_y u_z θ_x θ_y) of the inner ring moves the inner groove centre of ball j by
//! B_j d in the plane of the axis and the ball,
//! B = [[cos ψ, sin ψ, 0, 0, 0], [0, 0, 1, R sin ψ, −R cos ψ]] over (radial, axial).
//! Force −Σ Bᵀ p, stiffness Σ Bᵀ (∂p/∂s) B, damping Σ Bᵀ (∂p/∂ṡ) B need each plane quantity only times 1, cos ψ,
//! sin ψ and their products; the moment arm R is applied after summation.

use crate::Reaction;

/// Force of one ball in its plane, p opposing the motion of the inner groove centre (radial, axial), with
/// tangents.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct PlaneForce {
    /// p \[N\].
    pub force: [f64; 2],
    /// ∂p/∂s, row by row: rr, rz, zr, zz.
    pub by_motion: [f64; 4],
    /// ∂p/∂ṡ, symmetric: rr, rz, zz.
    pub by_rate: [f64; 3],
    /// Elastic energy \[J\].
    pub energy: f64,
    /// Dissipated power \[W\].
    pub dissipated: f64,
    /// Input power at a fixed inner groove centre \[W\].
    pub power: f64,
    /// Load of the inner contact \[N\], and its product with the cos α that sets the cage speed.
    pub load: f64,
    pub load_cos: f64,
}

/// Moment of race friction about the inner groove centre, resisting a tilt of the ring in the ball's plane.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct PlaneMoment {
    /// m \[N m\], conjugate to θ_x sin ψ − θ_y cos ψ.
    pub moment: f64,
    /// ∂m/∂s.
    pub by_motion: [f64; 2],
}

/// Sums over balls of a quantity times 1, cos, sin, cos², cos sin, sin².
pub(super) type Harmonics = [f64; HARMONICS];
pub(super) const HARMONICS: usize = 6;

const ONE: usize = 0;
const COS: usize = 1;
const SIN: usize = 2;
/// Harmonic of the product of two of ONE, COS, SIN.
const PRODUCT: [[usize; 3]; 3] = [[0, 1, 2], [1, 3, 4], [2, 4, 5]];
/// Rows of Bᵀ: plane component, harmonic. Factors with the moment arm: (1, 1, 1, R, −R).
const ROWS: [(usize, usize); 5] = [(0, COS), (0, SIN), (1, ONE), (1, SIN), (1, COS)];
/// Rows of ∂Bᵀ/∂ψ, with factors (−1, 1, 0, R, R).
const ROWS_BY_ANGLE: [(usize, usize); 5] = [(0, SIN), (0, COS), (1, ONE), (1, COS), (1, SIN)];

/// Running sums over a row's balls.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct BallSum {
    pub force: [Harmonics; 2],
    pub by_motion: [Harmonics; 4],
    pub by_rate: [Harmonics; 3],
    pub moment: Harmonics,
    pub moment_by_motion: [Harmonics; 2],
    pub energy: f64,
    pub dissipated: f64,
    pub power: f64,
    pub load: f64,
    pub load_cos: f64,
}

fn add(sum: &mut Harmonics, weight: f64, basis: &Harmonics) {
    for (s, b) in sum.iter_mut().zip(basis) {
        *s += weight * b;
    }
}

impl BallSum {
    /// Adds a ball at cos ψ, sin ψ.
    #[inline]
    pub fn add(&mut self, cos: f64, sin: f64, ball: &PlaneForce) {
        self.energy += ball.energy;
        self.dissipated += ball.dissipated;
        self.power += ball.power;
        self.load += ball.load;
        self.load_cos += ball.load_cos;
        let basis = [1.0, cos, sin, cos * cos, cos * sin, sin * sin];
        for (sum, value) in self.force.iter_mut().zip(ball.force) {
            add(sum, value, &basis);
        }
        for (sum, value) in self.by_motion.iter_mut().zip(ball.by_motion) {
            add(sum, value, &basis);
        }
        for (sum, value) in self.by_rate.iter_mut().zip(ball.by_rate) {
            add(sum, value, &basis);
        }
    }

    /// Adds a ball's friction moment.
    pub fn add_moment(&mut self, cos: f64, sin: f64, ball: &PlaneMoment) {
        let basis = [1.0, cos, sin, cos * cos, cos * sin, sin * sin];
        add(&mut self.moment, ball.moment, &basis);
        for (sum, value) in self.moment_by_motion.iter_mut().zip(ball.by_motion) {
            add(sum, value, &basis);
        }
    }

    /// Axial force Σ p_z and stiffness Σ ∂p_z/∂s_z.
    pub fn axial(&self) -> (f64, f64) {
        (self.force[1][ONE], self.by_motion[3][ONE])
    }

    /// Force and tangents with moment arm R \[m\] at a cage speed `cage_speed` \[rad/s\].
    ///
    /// ṡ = B ḋ + ψ̇ (∂B/∂ψ) d; hence the stiffness is Σ Bᵀ (∂p/∂s) B + ψ̇ Σ Bᵀ (∂p/∂ṡ) ∂B/∂ψ.
    pub fn reaction(&self, arm: f64, cage_speed: f64) -> Reaction {
        let factor = [1.0, 1.0, 1.0, arm, -arm];
        let turned = [-1.0, 1.0, 0.0, arm, arm].map(|f| f * cage_speed);
        let by_rate = [[&self.by_rate[0], &self.by_rate[1]], [&self.by_rate[1], &self.by_rate[2]]];
        let mut out = Reaction {
            elastic_energy: self.energy,
            dissipated_power: self.dissipated,
            parametric_power: self.power,
            ..Reaction::default()
        };
        for (a, (p, f)) in ROWS.into_iter().enumerate() {
            out.force[a] = -factor[a] * self.force[p][f];
            for (b, (q, g)) in ROWS.into_iter().enumerate() {
                let both = factor[a] * factor[b];
                let harmonic = PRODUCT[f][g];
                out.stiffness[a][b] = both * self.by_motion[2 * p + q][harmonic];
                out.damping[a][b] = both * by_rate[p][q][harmonic];
            }
        }
        if cage_speed != 0.0 {
            for (a, (p, f)) in ROWS.into_iter().enumerate() {
                for (b, (q, g)) in ROWS_BY_ANGLE.into_iter().enumerate() {
                    out.stiffness[a][b] += factor[a] * turned[b] * by_rate[p][q][PRODUCT[f][g]];
                }
            }
        }
        for (a, sign) in [(3, 1.0), (4, -1.0)] {
            let f = ROWS[a].1;
            out.force[a] -= sign * self.moment[f];
            for (b, (q, g)) in ROWS.into_iter().enumerate() {
                out.stiffness[a][b] += sign * factor[b] * self.moment_by_motion[q][PRODUCT[f][g]];
            }
        }
        out
    }
}

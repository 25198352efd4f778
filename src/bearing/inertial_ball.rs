//! Reaction of a ball with inertia (centrifugal force, gyroscopic moment) on the inner ring: force, friction
//! moment, tangents, power.

use super::ball_derivatives::EquilibriumDerivatives;
use super::ball_equilibrium::{BallEquilibrium, BallInertiaLoads, RaceContact, dot};
use super::ball_sum::{PlaneForce, PlaneMoment};
use super::plane_motion::PlaneMotion;
use super::root_finding;
use crate::contact::{ContactDamping, ContactLoad, SpeedContacts};

impl BallInertiaLoads {
    /// Force and friction moment of a ball in equilibrium on the inner ring, with tangents by implicit
    /// differentiation.
    ///
    /// E(x, y) = 0 with x = s − b, y = b gives ∂b/∂s = S = −(∂E/∂b)⁻¹ ∂E/∂x, and p = R_i changes by
    /// (∂R_i/∂x)(I − S) + (∂R_i/∂y) S. Damping acts along the inner contact, as for a massless ball with the
    /// contact load Q_i. Power at a fixed ring: work of the ball's inertia force along ḃ.
    pub fn inner_ring_reaction(
        &self,
        equilibrium: &BallEquilibrium,
        contacts: &SpeedContacts,
        damping: &ContactDamping,
        stiffness: f64,
        motion: &PlaneMotion,
    ) -> (PlaneForce, PlaneMoment) {
        let BallEquilibrium { inner, outer } = equilibrium;
        let energy = inner.loaded.energy + outer.loaded.energy;
        if inner.loaded.load <= 0.0 {
            return (PlaneForce { energy, ..PlaneForce::default() }, PlaneMoment::default());
        }
        let derivatives = EquilibriumDerivatives::new(self, equilibrium);
        let forces = &derivatives.forces;
        let (rate, [wi, wo]) = (motion.rate, motion.deviation.full_rate());
        let (n, t) = (inner.n, inner.t());
        let centre_tangent = derivatives.centre_by_position();

        let load = inner.loaded.load;
        let equivalent = {
            let series = |x: f64| {
                let at = contacts.series(x);
                [at.load - load, at.slope]
            };
            root_finding::increasing_root(series, (load / stiffness).cbrt().powi(2) + contacts.onset())
        };
        let elastic = contacts.series(equivalent);
        let [damped_wi, damped_wo] = motion.deviation.rate;
        let closing = dot(n, rate) + damped_wi + damped_wo;
        let damped = damping.apply(contacts, &ContactLoad { load, ..elastic }, equivalent, closing);

        let damping_rotation = damped.by_rate * dot(t, rate) / inner.length;
        let side = RaceContact {
            loaded: ContactLoad {
                load: damped.load,
                slope: damped.by_approach * inner.loaded.slope / elastic.slope,
                energy: 0.0,
            },
            ..*inner
        };
        let mut tangent = side.tangent(forces.friction[0]);
        for r in 0..2 {
            for c in 0..2 {
                tangent[r][c] += damping_rotation * n[r] * t[c] + t[r] * forces.friction_by[0][c];
            }
        }
        let along = |v: [f64; 2], c: usize| dot(v, centre_tangent[c]);
        let force = [0, 1].map(|k| damped.load * n[k] + forces.friction[0] * t[k]);
        let mut by_motion = [0.0; 4];
        let mut moment =
            PlaneMoment { moment: -self.balls.groove_radius * forces.friction[0], ..PlaneMoment::default() };
        for c in 0..2 {
            for r in 0..2 {
                by_motion[2 * r + c] =
                    tangent[r][c] - along(tangent[r], c) + t[r] * along(forces.friction_by[1], c);
            }
            let friction =
                forces.friction_by[0][c] - along(forces.friction_by[0], c) + along(forces.friction_by[1], c);
            moment.by_motion[c] = -self.balls.groove_radius * friction;
        }

        let dissipated = (damped.load - load) * closing;
        let to = outer.t();
        let velocity = derivatives.change(equilibrium, rate, [wi, wo]).y;
        let other_forces =
            [0, 1].map(|k| forces.friction[0] * t[k] - forces.friction[1] * to[k] + [self.force, 0.0][k]);
        let stored = load * (dot(n, rate) + wi) + outer.loaded.load * wo + dot(other_forces, velocity);
        let ball = PlaneForce {
            force,
            by_motion,
            by_rate: [n[0] * n[0], n[0] * n[1], n[1] * n[1]].map(|v| damped.by_rate * v),
            energy,
            dissipated,
            power: stored + dissipated - dot(force, rate),
            load: damped.load,
            load_cos: damped.load * self.cage_cosine(inner, outer, forces.share),
        };
        (ball, moment)
    }

    /// Effective cos α: that of the massless ball with the same cage speed ratio ½ (1 − γ′ cos α).
    ///
    /// Harris cage speed, rolling on both races: ω_c/Ω = (1 − γ′ cos α_i)/(1 + cos Δ) for outer-race control
    /// and (cos Δ − γ′ cos α_o)/(1 + cos Δ) for inner-race control, Δ = α_i − α_o. Source: Harris.
    pub fn cage_cosine(&self, inner: &RaceContact, outer: &RaceContact, share: f64) -> f64 {
        let gamma = self.balls.gamma;
        let cos = dot(inner.n, outer.n);
        let ratio =
            ((1.0 - share) * (1.0 - gamma * inner.n[0]) + share * (cos - gamma * outer.n[0])) / (1.0 + cos);
        (1.0 - 2.0 * ratio) / gamma
    }
}

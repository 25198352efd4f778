//! Reaction of a ball with inertia (centrifugal force, gyroscopic moment) on the inner ring: force, friction
//! moment, tangents, power.

use super::derivatives::EquilibriumDerivatives;
use super::equilibrium::{BallEquilibrium, BallInertiaLoads, RaceContact, RaceForces, dot};
use super::plane_motion::PlaneMotion;
use super::sum::{PlaneForce, PlaneMoment};
use crate::contact::{ContactDamping, ContactLoad, SpeedContacts};
use crate::root_finding;

impl BallEquilibrium {
    /// Elastic energy of both contacts \[J\].
    pub fn energy(&self) -> f64 {
        self.inner.loaded.energy + self.outer.loaded.energy
    }
}

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
        if equilibrium.inner.loaded.load <= 0.0 {
            let energy = equilibrium.energy();
            return (PlaneForce { energy, ..PlaneForce::default() }, PlaneMoment::default());
        }
        let derivatives = EquilibriumDerivatives::new(self, equilibrium);
        let (mut ball, moment) = self.elastic_reaction(equilibrium, &derivatives);
        self.add_motion(&mut ball, equilibrium, &derivatives, contacts, damping, stiffness, motion);
        (ball, moment)
    }

    /// Elastic part of the reaction, the ring at rest.
    #[inline(always)]
    pub fn elastic_reaction(
        &self,
        equilibrium: &BallEquilibrium,
        derivatives: &EquilibriumDerivatives,
    ) -> (PlaneForce, PlaneMoment) {
        let BallEquilibrium { inner, outer } = equilibrium;
        let RaceForces { inner: force, inner_by, friction_by, friction, share, .. } = &derivatives.forces;
        let by_position = &derivatives.centre_by_position;
        let mut by_motion = [0.0; 4];
        let mut moment =
            PlaneMoment { moment: -self.balls.groove_radius * friction[0], ..PlaneMoment::default() };
        for (c, y) in by_position.iter().enumerate() {
            let x = [f64::from(c == 0) - y[0], f64::from(c == 1) - y[1]];
            for r in 0..2 {
                by_motion[2 * r + c] = dot(inner_by[0][r], x) + dot(inner_by[1][r], *y);
            }
            let friction = dot(friction_by[0], x) + dot(friction_by[1], *y);
            moment.by_motion[c] = -self.balls.groove_radius * friction;
        }
        let load = inner.loaded.load;
        let ball = PlaneForce {
            force: *force,
            by_motion,
            energy: equilibrium.energy(),
            load,
            load_cos: load * self.cage_cosine(inner, outer, *share),
            ..PlaneForce::default()
        };
        (ball, moment)
    }

    /// Adds contact damping and the power at a fixed ring to the elastic reaction of a loaded ball.
    #[allow(clippy::too_many_arguments)] // the state of one ball
    #[inline(always)]
    pub fn add_motion(
        &self,
        ball: &mut PlaneForce,
        equilibrium: &BallEquilibrium,
        derivatives: &EquilibriumDerivatives,
        contacts: &SpeedContacts,
        damping: &ContactDamping,
        stiffness: f64,
        motion: &PlaneMotion,
    ) {
        let BallEquilibrium { inner, outer } = equilibrium;
        let (rate, [wi, wo]) = (motion.rate, motion.deviation.full_rate());
        let (n, t, load) = (inner.n, inner.t(), inner.loaded.load);
        let equivalent = {
            let series = |x: f64| {
                let at = contacts.series(x);
                [at.load - load, at.slope]
            };
            root_finding::increasing_root(series, (load / stiffness).cbrt().powi(2) + contacts.onset())
        };
        let elastic = contacts.series(equivalent);
        let damped_rate = motion.deviation.rate[0] + motion.deviation.rate[1];
        let closing = dot(n, rate) + damped_rate;
        let damped = damping.apply(contacts, &ContactLoad { load, ..elastic }, equivalent, closing);
        let damping_load = damped.load - load;

        // The contact with the damping load, and the rotation of ṡ against the contact line.
        let part = RaceContact {
            loaded: ContactLoad {
                load: damping_load,
                slope: (damped.by_approach / elastic.slope - 1.0) * inner.loaded.slope,
                energy: 0.0,
            },
            ..*inner
        };
        let mut tangent = part.tangent(0.0);
        let rotation = damped.by_rate * dot(t, rate) / inner.length;
        for (row, n) in tangent.iter_mut().zip(n) {
            for (entry, t) in row.iter_mut().zip(t) {
                *entry += rotation * n * t;
            }
        }
        for (c, y) in derivatives.centre_by_position.iter().enumerate() {
            let x = [f64::from(c == 0) - y[0], f64::from(c == 1) - y[1]];
            for (r, row) in tangent.iter().enumerate() {
                ball.by_motion[2 * r + c] += dot(*row, x);
            }
        }

        let friction = derivatives.forces.friction;
        let (to, velocity) = (outer.t(), derivatives.change(equilibrium, rate, [wi, wo]).y);
        let other_forces = [0, 1].map(|k| friction[0] * t[k] - friction[1] * to[k] + [self.force, 0.0][k]);
        let stored = load * (dot(n, rate) + wi) + outer.loaded.load * wo + dot(other_forces, velocity);
        ball.power = stored - dot(ball.force, rate) + damping_load * damped_rate;
        ball.dissipated = damping_load * closing;
        ball.by_rate = [n[0] * n[0], n[0] * n[1], n[1] * n[1]].map(|v| damped.by_rate * v);
        for (force, n) in ball.force.iter_mut().zip(n) {
            *force += damping_load * n;
        }
        ball.load_cos *= damped.load / load;
        ball.load = damped.load;
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

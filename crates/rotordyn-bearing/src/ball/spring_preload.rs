//! Spring preload: the outer ring slides axially on a spring, without mass and without a damper of its own.
//!
//! The ring's axial displacement ζ follows from the elastic axial ball force at each instant,
//! N(d, ζ, t) + k ζ = ± F₀, with N_d = ∂N/∂d, N_z = ∂N/∂ζ = ∂N/∂u_z and the time t for cage, waves and defects:
//!
//! T = ∂ζ/∂d = −N_d/(N_z + k), ζ̇ = T·ḋ + ζ̇_c = −Ṅ/(N_z + k), Ṅ the rate of N at a fixed ring.
//!
//! The elastic force is the balls' at the displaced ring. The force of contact damping f_d, at the ring's velocity ζ̇,
//! also drives the shaft through the ring: f = f_e + (1 + T e_zᵀ) f_d. Its tangents need the change of T,
//!
//! ∂T_a/∂d_b = −(N_ab + N_az T_b + T_a N_zb + N_zz T_a T_b)/(N_z + k), ∂ζ̇/∂d = dT/dt along the motion.
//!
//! The cage moves the ring by ζ̇_c against f_d: an input power −f_d·e_z ζ̇_c at a fixed shaft.

use super::derivatives::{AxialCurvature, EquilibriumDerivatives};
use super::equilibrium::{BallContactLaws, BallEquilibrium, BallInertiaLoads};
use super::massless;
use super::plane_motion::PlaneMotion;
use super::preload::RowReaction;
use super::ring_equilibrium::RingSpring;
use super::ring_motion::RingMotion;
use super::row::{OperatingState, Row};
use super::sum::{BallSum, PlaneForce, PlaneMoment};
use crate::Reaction;

/// A ball between the grooves.
struct PlacedBall {
    cos: f64,
    sin: f64,
    motion: PlaneMotion,
    /// Part of the motion's rate due to cage rotation.
    turn: [f64; 2],
    /// Equilibrium of a ball with inertia, and its derivatives if it is loaded.
    equilibrium: Option<(BallEquilibrium, Option<EquilibriumDerivatives>)>,
}

/// Vector over the degrees of freedom of the inner ring without rotation about its axis.
type Ring = [f64; 5];

/// How the outer ring follows the inner one.
struct RingFollowing {
    /// 1/(N_z + k) \[m/N\]; 0 for an unloaded ring without spring, which stays where it is.
    compliance: f64,
    /// T = ∂ζ/∂d.
    ratio: [f64; 6],
}

/// Second derivatives of the axial ball force N.
#[derive(Default)]
struct AxialForceDerivatives {
    /// Rate of ∂N/∂d along the motion.
    gradient_rate: Ring,
    /// ∂²N/∂d².
    curvature: [Ring; 5],
}

impl PlacedBall {
    /// Rows of B: how the inner groove centre moves with the ring, radial and axial.
    fn basis(&self, arm: f64) -> [Ring; 2] {
        [[self.cos, self.sin, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, arm * self.sin, -arm * self.cos]]
    }

    /// Ḃ at a cage speed.
    fn basis_rate(&self, arm: f64, cage_speed: f64) -> [Ring; 2] {
        [[-self.sin, self.cos, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, arm * self.cos, arm * self.sin]]
            .map(|row| row.map(|value| value * cage_speed))
    }
}

impl AxialForceDerivatives {
    /// Adds a ball; `at_rest`: its elastic force with tangents.
    fn add(&mut self, [basis, basis_rate]: [[Ring; 2]; 2], at_rest: &PlaneForce, ball: &AxialCurvature) {
        let [radial, axial] = basis;
        let [_, _, by_radial, by_axial] = at_rest.by_motion;
        let [rr, rz, zz] = ball.by_position;
        for a in 0..5 {
            self.gradient_rate[a] += ball.rate[0] * radial[a]
                + ball.rate[1] * axial[a]
                + by_radial * basis_rate[0][a]
                + by_axial * basis_rate[1][a];
            for b in 0..5 {
                self.curvature[a][b] += rr * radial[a] * radial[b]
                    + rz * (radial[a] * axial[b] + axial[a] * radial[b])
                    + zz * axial[a] * axial[b];
            }
        }
    }
}

impl RingFollowing {
    fn new(elastic: &Reaction, spring_stiffness: f64) -> Self {
        let whole = elastic.stiffness[2][2] + spring_stiffness;
        let compliance = if whole > 0.0 { 1.0 / whole } else { 0.0 };
        Self { compliance, ratio: std::array::from_fn(|k| -elastic.stiffness[2][k] * compliance) }
    }

    /// Completes the reaction of the balls at the moving ring, see the module: `elastic` is the part at rest, and
    /// `by` belongs to the motion.
    fn complete(&self, out: &mut Reaction, elastic: &Reaction, by: &AxialForceDerivatives) {
        let t = &self.ratio;
        let transform = |m: &[[f64; 6]; 6]| -> [[f64; 6]; 6] {
            std::array::from_fn(|a| {
                std::array::from_fn(|b| m[a][b] + t[a] * m[2][b] + (m[a][2] + t[a] * m[2][2]) * t[b])
            })
        };
        let damping_force: [f64; 6] = std::array::from_fn(|k| out.force[k] - elastic.force[k]);
        let damping_stiffness = transform(&std::array::from_fn(|a| {
            std::array::from_fn(|b| out.stiffness[a][b] - elastic.stiffness[a][b])
        }));
        let axial_damping: [f64; 6] = std::array::from_fn(|a| out.damping[a][2] + t[a] * out.damping[2][2]);
        for a in 0..6 {
            out.force[a] = elastic.force[a] + damping_force[a] + t[a] * damping_force[2];
            for b in 0..6 {
                out.stiffness[a][b] =
                    elastic.stiffness[a][b] + elastic.stiffness[a][2] * t[b] + damping_stiffness[a][b];
            }
        }
        out.damping = transform(&out.damping);
        let (rate, curvature) = (&by.gradient_rate, &by.curvature);
        for b in 0..5 {
            let velocity_by = -self.compliance * (rate[b] + t[b] * rate[2]);
            for a in 0..5 {
                let ratio_by = -self.compliance
                    * (curvature[a][b]
                        + curvature[a][2] * t[b]
                        + t[a] * (curvature[2][b] + curvature[2][2] * t[b]));
                out.stiffness[a][b] += axial_damping[a] * velocity_by - damping_force[2] * ratio_by;
            }
        }
    }
}

impl Row {
    /// Force on the inner ring and tangents with the outer ring on a spring of stiffness k \[N/m\] and force F₀ \[N\].
    pub fn spring_reaction(&self, ring: &RingMotion, stiffness: f64, force: f64) -> RowReaction {
        let operating = self.operating(ring);
        let (shift, mut balls) = self.balls_on_spring(ring, &operating, stiffness, force);
        let at_rest: Vec<_> = balls.iter().map(|ball| self.elastic_force(&operating, ball)).collect();
        let sum = self.sum_placed(&balls, &at_rest, &[0.0; 6], &operating);
        let elastic = sum.reaction(self.arm, 0.0);
        let follows = RingFollowing::new(&elastic, stiffness);
        let mut out = RowReaction { reaction: elastic, load: sum.load, load_cos: sum.load_cos };
        let mut derivatives = AxialForceDerivatives::default();
        if ring.cage_speed.is_some() || ring.v.iter().any(|v| *v != 0.0) {
            let rate: f64 = balls
                .iter()
                .zip(&at_rest)
                .map(|(ball, (force, _))| self.axial_rate(&operating, ball, force))
                .sum();
            let velocity = -rate * follows.compliance;
            for ball in &mut balls {
                ball.motion.rate[1] += velocity;
            }
            let with_motion = |(ball, at_rest)| self.force_in_motion(&operating, ball, at_rest);
            let moving: Vec<_> = balls.iter().zip(&at_rest).map(with_motion).collect();
            let sum = self.sum_placed(&balls, &moving, ring.v, &operating);
            let cage_speed = ring.cage_speed.unwrap_or(0.0);
            out.reaction = sum.reaction(self.arm, cage_speed);
            (out.load, out.load_cos) = (sum.load, sum.load_cos);
            for (ball, (force, _)) in balls.iter().zip(&at_rest) {
                let basis = [ball.basis(self.arm), ball.basis_rate(self.arm, cage_speed)];
                derivatives.add(basis, force, &self.axial_curvature(&operating, ball));
            }
            let with_shaft: f64 = follows.ratio.iter().zip(ring.v).map(|(t, v)| t * v).sum();
            let damping_force = out.reaction.force[2] - elastic.force[2];
            out.reaction.parametric_power -= damping_force * (velocity - with_shaft);
        }
        follows.complete(&mut out.reaction, &elastic, &derivatives);
        out.reaction.elastic_energy += (0.5 * stiffness * shift - force) * shift;
        out
    }

    /// Displacement of the ring in the direction of thrust, and the balls there.
    fn balls_on_spring(
        &self,
        ring: &RingMotion,
        operating: &OperatingState,
        stiffness: f64,
        force: f64,
    ) -> (f64, Vec<PlacedBall>) {
        let mut balls = Vec::with_capacity(self.balls());
        self.for_each_ball(ring, operating, |[cos, sin], motion, turn| {
            balls.push(PlacedBall { cos, sin, motion, turn, equilibrium: None });
        });
        let spring = RingSpring { stiffness, force: self.direction * force };
        let guess = self.direction * self.ring_displacement_guess(ring);
        let together = operating
            .inertial_loads
            .as_ref()
            .and_then(|loads| self.solve_with_ring(loads, operating, &balls, spring, guess));
        let (shift, found) = match together {
            Some((shift, found)) => (shift, Some(found)),
            None => (self.direction * self.ring_displacement(ring), None),
        };
        for (k, ball) in balls.iter_mut().enumerate() {
            ball.motion.s[1] += shift;
            ball.equilibrium = operating.inertial_loads.as_ref().map(|loads| {
                let equilibrium = match &found {
                    Some(found) => found[k],
                    None => self.solve_equilibrium(loads, operating, &ball.motion),
                };
                let is_loaded = equilibrium.inner.loaded.load > 0.0;
                (equilibrium, is_loaded.then(|| EquilibriumDerivatives::new(loads, &equilibrium)))
            });
        }
        (self.direction * shift, balls)
    }

    fn solve_with_ring(
        &self,
        loads: &BallInertiaLoads,
        operating: &OperatingState,
        balls: &[PlacedBall],
        spring: RingSpring,
        guess: f64,
    ) -> Option<(f64, Vec<BallEquilibrium>)> {
        let motions: Vec<_> = balls.iter().map(|ball| ball.motion).collect();
        let law = &operating.contacts;
        let laws = BallContactLaws {
            series: |x| law.series(x),
            single: |race, x| law.single(race, x),
            guess: |race, load| self.approach_at(law, race, load),
            stiffness: self.contacts.hertz.stiffness,
        };
        loads.solve_with_ring(&laws, &motions, spring, guess)
    }

    /// Elastic force of a ball, the ring at rest.
    fn elastic_force(&self, operating: &OperatingState, ball: &PlacedBall) -> (PlaneForce, PlaneMoment) {
        match (&operating.inertial_loads, &ball.equilibrium) {
            (Some(loads), Some((equilibrium, Some(derivatives)))) => {
                loads.elastic_reaction(equilibrium, derivatives)
            }
            (_, Some((equilibrium, _))) => {
                (PlaneForce { energy: equilibrium.energy(), ..PlaneForce::default() }, PlaneMoment::default())
            }
            _ => {
                let force = self.massless_force(&operating.contacts, &ball.motion.stopped());
                (force.unwrap_or_default(), PlaneMoment::default())
            }
        }
    }

    /// Force of a ball with damping and power; `at_rest`: its elastic force.
    fn force_in_motion(
        &self,
        operating: &OperatingState,
        ball: &PlacedBall,
        at_rest: &(PlaneForce, PlaneMoment),
    ) -> (PlaneForce, PlaneMoment) {
        let (mut force, moment) = *at_rest;
        match (&operating.inertial_loads, &ball.equilibrium) {
            (Some(loads), Some((equilibrium, Some(derivatives)))) => {
                let stiffness = self.contacts.hertz.stiffness;
                let (contacts, damping) = (&operating.contacts, &self.damping);
                loads.add_motion(
                    &mut force,
                    equilibrium,
                    derivatives,
                    contacts,
                    damping,
                    stiffness,
                    &ball.motion,
                );
            }
            (None, _) => force = self.massless_force(&operating.contacts, &ball.motion).unwrap_or_default(),
            _ => {}
        }
        (force, moment)
    }

    fn sum_placed(
        &self,
        balls: &[PlacedBall],
        reactions: &[(PlaneForce, PlaneMoment)],
        v: &[f64; 6],
        operating: &OperatingState,
    ) -> BallSum {
        let mut sum = BallSum::default();
        let has_moment = operating.inertial_loads.is_some_and(|loads| loads.inner_race_has_friction());
        for (PlacedBall { cos, sin, turn, .. }, (force, moment)) in balls.iter().zip(reactions) {
            let mut force = *force;
            force.power += force.force[0] * turn[0] + force.force[1] * turn[1];
            force.power -= moment.moment * (v[3] * sin - v[4] * cos);
            sum.add(*cos, *sin, &force);
            if has_moment {
                sum.add_moment(*cos, *sin, moment);
            }
        }
        sum
    }

    /// Rate of a ball's elastic axial force along its motion; `at_rest`: its elastic force.
    fn axial_rate(&self, operating: &OperatingState, ball: &PlacedBall, at_rest: &PlaneForce) -> f64 {
        let PlaneMotion { rate, deviation, .. } = ball.motion;
        match (&operating.inertial_loads, &ball.equilibrium) {
            (Some(_), Some((equilibrium, Some(by)))) => {
                by.force_change(equilibrium, &by.change(equilibrium, rate, deviation.full_rate()))[1]
            }
            (Some(_), _) => 0.0,
            // A deviation acts on the load like a motion along the contact line, which leaves its direction.
            (None, _) => {
                let [r, z] = ball.motion.s;
                let [inner, outer] = deviation.full_rate();
                let closing = (inner + outer) / r.hypot(z);
                at_rest.by_motion[2] * (rate[0] + closing * r)
                    + at_rest.by_motion[3] * (rate[1] + closing * z)
            }
        }
    }

    fn axial_curvature(&self, operating: &OperatingState, ball: &PlacedBall) -> AxialCurvature {
        let contacts = &operating.contacts;
        let PlaneMotion { rate, deviation, .. } = ball.motion;
        match (&operating.inertial_loads, &ball.equilibrium) {
            (Some(loads), Some((equilibrium, Some(by)))) => {
                let motion = by.change(equilibrium, rate, deviation.full_rate());
                by.axial_curvature(loads, |race, x| contacts.single(race, x), equilibrium, &motion, rate)
            }
            (Some(_), _) => AxialCurvature::default(),
            (None, _) => massless::axial_curvature(contacts, self.centre_distance, &ball.motion),
        }
    }
}

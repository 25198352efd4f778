//! Implicit time step: each ball's scalar equation solved inside the step (nested Newton, ball by ball).

use super::ball_state::{BallState, LocalMotion};
use super::tangent::BALL_COORDINATE;
use super::{RadialElement, RingForceSum, Rings};
use crate::internal::{InternalStep, NewmarkGain};
use crate::{Reaction, Rotation};

/// Convergence of a ball's equation: force residual \[N\], or position increment \[m\].
const FORCE_TOLERANCE: f64 = 1e-12;
const POSITION_TOLERANCE: f64 = 1e-19;
const MAX_ITERATIONS: usize = 200;

impl RadialElement {
    /// Solves every ball's equation of a step for the force Q_y on it, at fixed ring displacements.
    ///
    /// y = ȳ + β h² Q/m′, ẏ = ẏ̄ + γ h Q/m′ with Q = Q_y(y, ẏ): contact forces decrease with y, so that
    /// Q − Q_y increases and has one root, found by bracketed Newton however stiff the contact. (With tensile
    /// contact force Q − Q_y may decrease over less than 1e-10 m at opening; the bracket still contains one
    /// root.)
    ///
    /// `count`: number of interface rows, 2 or 4. Only force, energy and powers of the reaction are set.
    pub(super) fn step(
        &self,
        rings: &Rings,
        count: usize,
        balls: InternalStep,
        rotation: &Rotation,
        gain: &NewmarkGain,
    ) -> Reaction {
        let mut sum = RingForceSum::default();
        let mut stiffness = [[0.0; 4]; 4];
        let ratio = gain.velocity / gain.position;
        // Position and velocity per force at the end.
        let inverse_mass = 1.0 / self.mass;
        let by_force = [gain.position * inverse_mass, gain.velocity * inverse_mass];
        let InternalStep { position, velocity, force, force_tangent, stiffness: effective } = balls;
        self.for_each_ball(rings, rotation, |j, seen| {
            let (load, acting) = self.solve(&seen, [position[j], velocity[j]], by_force, force[j]);
            force[j] = load;
            position[j] += by_force[0] * load;
            velocity[j] += by_force[1] * load;
            sum.add(&seen, &acting, velocity[j], self.mass);

            let tangent = acting.tangent(&seen, self.mass);
            let both = |a: usize, b: usize| tangent.stiffness[a][b] + ratio * tangent.damping[a][b];
            let own = 1.0 + by_force[0] * both(BALL_COORDINATE, BALL_COORDINATE);
            let (c, s) = (seen.cos, seen.sin);
            let global = |v: [f64; 4]| {
                [v[0] * c - v[1] * s, v[0] * s + v[1] * c, v[2] * c - v[3] * s, v[2] * s + v[3] * c]
            };
            let tangent_row: [f64; 4] = std::array::from_fn(|b| both(BALL_COORDINATE, b) / own);
            force_tangent[j * count..(j + 1) * count].copy_from_slice(&global(tangent_row)[..count]);
            let rows: [[f64; 4]; 4] = std::array::from_fn(|a| {
                let back = by_force[0] * both(a, BALL_COORDINATE);
                global(std::array::from_fn(|b| both(a, b) - back * tangent_row[b]))
            });
            for b in 0..4 {
                for (row, value) in
                    stiffness.iter_mut().zip(global([rows[0][b], rows[1][b], rows[2][b], rows[3][b]]))
                {
                    row[b] += value;
                }
            }
        });
        for (row, values) in effective.chunks_exact_mut(count).zip(stiffness) {
            row.copy_from_slice(&values[..count]);
        }
        sum.reaction()
    }

    /// Solution Q and the ball's state under it.
    #[inline(always)]
    fn solve(
        &self,
        seen: &LocalMotion,
        [place, rate]: [f64; 2],
        [by_place, by_rate]: [f64; 2],
        guess: f64,
    ) -> (f64, BallState) {
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        let mut load = guess;
        let mut acting = self.ball_state(seen, place + by_place * load, rate + by_rate * load);
        for _ in 0..MAX_ITERATIONS {
            let left = load - acting.force;
            if left.abs() <= FORCE_TOLERANCE {
                break;
            }
            let [inner, outer] = &acting.contacts;
            let n = acting.n[0] * acting.n[0];
            let slope = 1.0
                + by_place * (inner.by_deformation * n + outer.by_deformation)
                + by_rate * (inner.by_rate * n + outer.by_rate);
            if left > 0.0 {
                high = load;
            } else {
                low = load;
            }
            let mut next = load - left / slope;
            if !(next > low && next < high) {
                next = match low.is_finite() && high.is_finite() {
                    true => 0.5 * (low + high),
                    // Fixed-point step, in the same direction as Newton's where the force decreases with y.
                    false => acting.force,
                };
            }
            let moved = by_place * (next - load).abs();
            load = next;
            acting = self.ball_state(seen, place + by_place * load, rate + by_rate * load);
            if moved <= POSITION_TOLERANCE {
                break;
            }
        }
        (load, acting)
    }
}

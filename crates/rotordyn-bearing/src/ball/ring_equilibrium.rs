//! Equilibrium of a row's balls with inertia together with the outer ring on its preload spring.
//!
//! The unknowns are the centre of every ball and the axial displacement ζ of the ring, N(ζ, b) + k ζ = N₀. Each step of
//! Newton's method eliminates the balls one by one, since they meet only in ζ: about the work of the balls' equilibrium at
//! a fixed ring.

use super::derivatives::EquilibriumDerivatives;
use super::equilibrium::{
    BallContactLaws, BallEquilibrium, BallInertiaLoads, InitialGuess, RaceContact, dot, solve_2x2,
};
use super::plane_motion::PlaneMotion;
use crate::contact::{ContactLoad, Race};

const MAX_ITERATIONS: usize = 15;
/// Forces out of balance over the contact loads after which one step more leaves round-off: its error is their square.
const LAST_STEP: f64 = 1e-8;

/// The ring's spring: stiffness \[N/m\], and the axial ball force N₀ at ζ = 0 \[N\].
#[derive(Clone, Copy, Debug)]
pub(super) struct RingSpring {
    pub stiffness: f64,
    pub force: f64,
}

/// A loaded ball on its way to equilibrium: centre b, approaches and loads of both contacts.
#[derive(Clone, Copy)]
struct Trial {
    centre: [f64; 2],
    approaches: [f64; 2],
    loads: [ContactLoad; 2],
}

/// Newton step of a ball and its change with the step of the ring.
#[derive(Clone, Copy)]
struct Step {
    normals: [[f64; 2]; 2],
    gaps: [f64; 2],
    centre: [f64; 2],
    by_ring: [f64; 2],
    /// Axial force after the step, and its derivative by ζ.
    axial: [f64; 2],
    is_small: bool,
}

impl BallInertiaLoads {
    /// Displacement ζ \[m\] of the ring and the balls' equilibria there; `None` where the iteration does not converge
    /// with all contacts that are loaded at its start. `balls`: positions at ζ = 0; `guess`: ζ to start from.
    pub fn solve_with_ring(
        &self,
        laws: &BallContactLaws<
            impl Fn(f64) -> ContactLoad,
            impl Fn(Race, f64) -> ContactLoad,
            impl Fn(Race, f64) -> f64,
        >,
        balls: &[PlaneMotion],
        spring: RingSpring,
        guess: f64,
    ) -> Option<(f64, Vec<BallEquilibrium>)> {
        let single = &laws.single;
        let mut shift = guess;
        let mut trials: Vec<Option<Trial>> = vec![None; balls.len()];
        let mut steps: Vec<Option<Step>> = vec![None; balls.len()];
        for _ in 0..MAX_ITERATIONS {
            let (mut force, mut slope) = (spring.stiffness * shift - spring.force, spring.stiffness);
            let (mut is_last, mut load) = (true, 0.0);
            for ((ball, trial), step) in balls.iter().zip(&mut trials).zip(&mut steps) {
                let s = [ball.s[0], ball.s[1] + shift];
                if self.is_held_by_centrifugal_force(single, ball, s) {
                    is_last &= trial.is_none();
                    (*trial, *step) = (None, None);
                    continue;
                }
                let trial = trial.get_or_insert_with(|| {
                    is_last = false;
                    let InitialGuess { centre, approaches } =
                        self.initial_guess(laws, s, ball.deviation.total());
                    let loads = [single(Race::Inner, approaches[0]), single(Race::Outer, approaches[1])];
                    Trial { centre, approaches, loads }
                });
                let next = self.step(trial, s, ball.deviation.height);
                force += next.axial[0];
                slope += next.axial[1];
                load += trial.loads[0].load;
                is_last &= next.is_small;
                *step = Some(next);
            }
            if slope <= 0.0 {
                return None;
            }
            let by_ring = -force / slope;
            shift += by_ring;
            is_last &= force.abs() <= LAST_STEP * load;
            for (trial, step) in trials.iter_mut().zip(&steps) {
                let (Some(trial), Some(step)) = (trial, step) else { continue };
                let by = [0, 1].map(|k| step.centre[k] + step.by_ring[k] * by_ring);
                let [inner, outer] = step.normals;
                trial.centre = [trial.centre[0] + by[0], trial.centre[1] + by[1]];
                trial.approaches[0] += step.gaps[0] + inner[1] * by_ring - dot(inner, by);
                trial.approaches[1] += step.gaps[1] + dot(outer, by);
                trial.loads =
                    [single(Race::Inner, trial.approaches[0]), single(Race::Outer, trial.approaches[1])];
                if trial.loads.iter().any(|contact| contact.load <= 0.0) {
                    return None;
                }
            }
            if is_last && shift.is_finite() {
                let place = |(ball, trial): (&PlaneMotion, &Option<Trial>)| {
                    let s = [ball.s[0], ball.s[1] + shift];
                    let [wi, wo] = ball.deviation.height;
                    let [li, lo] = self.balls.lengths;
                    let b = trial.map_or([lo + self.centrifugal_approach - wo, 0.0], |trial| trial.centre);
                    let mut inner = RaceContact::from_vector([s[0] - b[0], s[1] - b[1]], li, wi);
                    let mut outer = RaceContact::from_vector(b, lo, wo);
                    inner.loaded = single(Race::Inner, inner.approach);
                    outer.loaded = single(Race::Outer, outer.approach);
                    BallEquilibrium { inner, outer }
                };
                return Some((shift, balls.iter().zip(&trials).map(place).collect()));
            }
        }
        None
    }

    /// Whether centrifugal force holds the ball on the outer race without inner contact.
    fn is_held_by_centrifugal_force(
        &self,
        single: &impl Fn(Race, f64) -> ContactLoad,
        ball: &PlaneMotion,
        s: [f64; 2],
    ) -> bool {
        let [wi, wo] = ball.deviation.height;
        let [li, lo] = self.balls.lengths;
        let radial = s[0] - (lo + self.centrifugal_approach - wo);
        let inner = RaceContact::from_vector([radial, s[1]], li, wi);
        single(Race::Inner, inner.approach).load <= 0.0
    }

    /// Newton step of one ball, as in the equilibrium at a fixed ring.
    fn step(&self, trial: &Trial, s: [f64; 2], [wi, wo]: [f64; 2]) -> Step {
        let [li, lo] = self.balls.lengths;
        let b = trial.centre;
        let mut inner = RaceContact::from_vector([s[0] - b[0], s[1] - b[1]], li, wi);
        let mut outer = RaceContact::from_vector(b, lo, wo);
        [inner.loaded, outer.loaded] = trial.loads;
        let gaps = [inner.approach - trial.approaches[0], outer.approach - trial.approaches[1]];
        let at = EquilibriumDerivatives::new(self, &BallEquilibrium { inner, outer });
        let force = self.resultant(&at.forces);
        let lag = [gaps[0] * inner.loaded.slope, gaps[1] * outer.loaded.slope];
        let residual = [0, 1].map(|k| -force[k] - lag[0] * inner.n[k] + lag[1] * outer.n[k]);
        let centre = solve_2x2(&at.jacobian, residual);
        let by_ring = at.centre_by_position[1];
        let [by_x, by_y] = [at.forces.inner_by[0][1], at.forces.inner_by[1][1]];
        let axial = at.forces.inner[1] + lag[0] * inner.n[1] + dot(by_y, centre) - dot(by_x, centre);
        let axial_by_ring = by_x[1] + dot(by_y, by_ring) - dot(by_x, by_ring);
        let out_of_balance = force.into_iter().chain(lag).fold(0.0, |most: f64, f| most.max(f.abs()));
        Step {
            normals: [inner.n, outer.n],
            gaps,
            centre,
            by_ring,
            axial: [axial, axial_by_ring],
            is_small: out_of_balance <= LAST_STEP * outer.loaded.load,
        }
    }
}

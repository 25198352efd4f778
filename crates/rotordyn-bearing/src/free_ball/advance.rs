//! Time integration of balls and cage: classical Runge-Kutta method of fourth order with fixed steps.
//!
//! Accuracy asks for less than stability: the contacts vibrate at tens of kHz, and their motion along the groove loses
//! energy to the error of the method. A 6205's ball that orbits at 2 to 5 m/s without friction loses 1 % of its speed in 0.3 s
//! with steps of 10 μs, 2e-5 with 2 μs.

use super::error::{FreeBallError, StepLimit};
use super::forces::{ForceSums, LOSSES, Parts};
use super::ring::{RingFrame, RingState};
use super::state::{BALL, FreeBallState, cage_at, normalise_orientation};
use super::surfaces::Distances;

/// Stability limits of RK4 on the imaginary and on the negative real axis.
const IMAGINARY_LIMIT: f64 = 2.828_427;
const REAL_LIMIT: f64 = 2.785_293;

/// Mean forces over an interval and energies exchanged in it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Interval {
    /// Mean force \[N\] and moment about the ring's centre \[N m\] on inner and outer ring.
    pub rings: [[f64; 6]; 2],
    /// Energy given by the moving inner and outer ring \[J\].
    pub ring_work: [f64; 2],
    /// Energy lost \[J\], in the order of [`LOSSES`].
    pub losses: [f64; LOSSES.len()],
    /// Number of steps.
    pub steps: usize,
}

/// Largest stable steps of RK4 \[s\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StableStep {
    /// By the stiffness and damping of the contacts.
    pub contact: f64,
    /// By friction, rolling resistance and drag.
    pub friction: f64,
}

/// Shares of the stability limits that a step takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepShares {
    pub contact: f64,
    pub friction: f64,
}

impl StepShares {
    /// In a machine: contacts vibrate with 11 steps to a period and lose 2e-4 of their amplitude a step to the integration,
    /// so that the energy balance closes and order lines near the structure's modes are right. The fastest motion of friction
    /// only has to decay; loads may grow by 40 % before the step is found anew.
    pub const IN_MACHINE: Self = Self { contact: 0.2, friction: 0.7 };
    /// Between rings that move as given, for means of a settled bearing: twice the step of a machine, since nothing but the
    /// contacts themselves vibrates with them. The step is found once, so that loads may rise from there only by 25 %.
    pub const BETWEEN_GIVEN_RINGS: Self = Self { contact: 0.4, friction: 0.8 };
}

impl StableStep {
    /// The longest step \[s\] within these shares of both limits.
    pub fn within(&self, shares: StepShares) -> f64 {
        (shares.contact * self.contact).min(shares.friction * self.friction)
    }

    pub(super) fn of(sums: &ForceSums) -> Self {
        let oscillation = IMAGINARY_LIMIT / sums.contact_rate.sqrt();
        Self {
            contact: oscillation.min(REAL_LIMIT / sums.damping_rate),
            friction: REAL_LIMIT / sums.friction_rate,
        }
    }

    /// The smaller limit \[s\].
    pub fn smallest(&self) -> f64 {
        self.contact.min(self.friction)
    }

    fn check(&self, step: f64, time: f64) -> Result<(), FreeBallError> {
        let (stable, limit) = if self.contact <= self.friction {
            (self.contact, StepLimit::Contact)
        } else {
            (self.friction, StepLimit::Friction)
        };
        if step > stable { Err(FreeBallError::Step { step, stable, limit, time }) } else { Ok(()) }
    }
}

/// Steps after which balls and cage are searched for in the bearing: they move by micrometres in a step.
const STEPS_BETWEEN_CHECKS: usize = 16;

/// Arrays of one step.
struct Stages {
    rates: [Vec<f64>; 4],
    values: Vec<f64>,
}

/// Forces and powers of one evaluation, as they are integrated: rings, work, losses.
const TRACKED: usize = 12 + 2 + LOSSES.len();

impl Parts {
    /// Advances a state over an interval in equal steps no longer than `step` \[s\].
    ///
    /// `rings`: inner and outer ring at the start and at the end of the interval, moved between as
    /// [`RingState::between`]; `duration` \[s\]. Errors: a duration or step that is not positive and finite, a step
    /// beyond a stability limit at any time of the interval, a ball or cage that leaves the bearing. On an error the state is
    /// that after the last accepted step, at its time.
    pub fn advance<D: Distances>(
        &self,
        distances: &D,
        state: &mut FreeBallState,
        rings: [&[RingState; 2]; 2],
        duration: f64,
        step: f64,
    ) -> Result<Interval, FreeBallError> {
        let positive = |time: f64| time > 0.0 && time.is_finite();
        if !(positive(duration) && positive(step)) {
            let why =
                format!("an interval of {duration} s in steps of {step} s: both must be positive and finite");
            return Err(FreeBallError::Input(vec![why]));
        }
        let steps = ((duration / step - 1e-9).ceil() as usize).max(1);
        let h = duration / steps as f64;
        let n = state.values.len();
        let mut stages = Stages { rates: [(); 4].map(|()| vec![0.0; n]), values: vec![0.0; n] };
        let frames = |share: f64| -> [RingFrame; 2] {
            [0, 1].map(|k| RingState::between(&rings[0][k], &rings[1][k], duration, share).frame())
        };
        let mut tracked = [0.0; TRACKED];
        let mut before = frames(0.0);
        let start = state.time;
        for s in 0..steps {
            let share = |part: f64| (s as f64 + part) / steps as f64;
            let (middle, after) = (frames(share(0.5)), frames(share(1.0)));
            if s % STEPS_BETWEEN_CHECKS == 0 {
                self.check_bodies(state, &before)?;
            }
            self.step(distances, state, &mut stages, &[before, middle, after], h, &mut tracked)?;
            normalise_orientation(&mut state.values, self.balls.len());
            state.time = start + (s + 1) as f64 * h;
            before = after;
        }
        self.check_bodies(state, &before)?;
        let mean = |k: usize| std::array::from_fn(|i| tracked[6 * k + i] / duration);
        Ok(Interval {
            rings: [mean(0), mean(1)],
            ring_work: [tracked[12], tracked[13]],
            losses: std::array::from_fn(|k| tracked[14 + k]),
            steps,
        })
    }

    /// One step of the state's values; adds the integrals of forces and powers to `tracked`.
    ///
    /// Error: a step beyond the stability limit at its start; the state is then unchanged.
    fn step<D: Distances>(
        &self,
        distances: &D,
        state: &mut FreeBallState,
        stages: &mut Stages,
        rings: &[[RingFrame; 2]; 3],
        h: f64,
        tracked: &mut [f64; TRACKED],
    ) -> Result<(), FreeBallError> {
        const PLACES: [(usize, f64); 3] = [(1, 0.5), (1, 0.5), (2, 1.0)];
        let values = &mut state.values;
        let first = self.rates(distances, values, &rings[0], &mut stages.rates[0]);
        StableStep::of(&first).check(h, state.time)?;
        track(tracked, &first, h / 6.0);
        for (k, (place, share)) in PLACES.into_iter().enumerate() {
            let (done, next) = stages.rates.split_at_mut(k + 1);
            for ((at, value), rate) in stages.values.iter_mut().zip(values.iter()).zip(&done[k]) {
                *at = value + share * h * rate;
            }
            let sums = self.rates(distances, &stages.values, &rings[place], &mut next[0]);
            track(tracked, &sums, h / if k == 2 { 6.0 } else { 3.0 });
        }
        let [a, b, c, d] = &stages.rates;
        for (i, value) in values.iter_mut().enumerate() {
            *value += h / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i]);
        }
        Ok(())
    }

    /// Errors: a ball or the cage that has left the bearing or whose motion is not finite.
    pub(super) fn check_bodies(
        &self,
        state: &FreeBallState,
        rings: &[RingFrame; 2],
    ) -> Result<(), FreeBallError> {
        for (ball, &[radius, ..]) in self.balls.iter().enumerate() {
            let position = state.ball(ball).position;
            for (groove, ring) in self.grooves.iter().zip(rings) {
                if let Some(cause) = groove.lost(ring, &position, radius) {
                    return Err(FreeBallError::BallLost { ball, time: state.time, cause });
                }
            }
        }
        let lost = |cause: String| Err(FreeBallError::CageLost { time: state.time, cause });
        if state.values.iter().skip(BALL * self.balls.len()).any(|value| !value.is_finite()) {
            return lost("its motion diverged".into());
        }
        if let Some(contacts) = &self.cage {
            let apart = (cage_at(&state.values, self.balls.len()).position - rings[1].centre).norm();
            if apart > contacts.pitch_radius {
                return lost(format!("its centre moved {apart:.3e} m from that of the outer ring"));
            }
        }
        Ok(())
    }
}

fn track(tracked: &mut [f64; TRACKED], sums: &ForceSums, weight: f64) {
    for (k, ring) in sums.rings.iter().enumerate() {
        for i in 0..3 {
            tracked[6 * k + i] += weight * ring.force[i];
            tracked[6 * k + 3 + i] += weight * ring.moment[i];
        }
    }
    for k in 0..2 {
        tracked[12 + k] += weight * sums.ring_power[k];
    }
    for (sum, loss) in tracked[14..].iter_mut().zip(&sums.losses) {
        *sum += weight * loss;
    }
}

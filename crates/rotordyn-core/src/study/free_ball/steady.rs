//! One bearing with free balls from its kinematic start to a settled cage speed, its inner ring under a load.
//!
//! The ring moves as given; its displacement is corrected between turns of the kinematic cage by d += 0.6 K⁻¹ (F + f), with
//! the stiffness K of the quasi-static bearing and the mean force f of the last turn, until its mean force f balances the
//! load F to 0.1 %. The cage speed is settled when its mean over the last quarter of the run differs from that over the
//! quarter before by less than a given share.

use super::error::FreeBallStudyError;
#[cfg(feature = "shapes")]
use super::start::overlap_at_start;
use super::tally::{CageAngle, Tally};
use crate::analysis::bearing_stiffness::{BearingSolver, Condition};
use crate::analysis::equilibrium::CageTreatment;
use crate::document::TO_RPM;
use crate::model::free_ball_study::FreeBallStudy;
use crate::results::{CageComparison, FreeBallResult};
#[cfg(feature = "shapes")]
use rotordyn_bearing::PlacedBalls;
use rotordyn_bearing::free_ball::{
    FreeBallBearing, FreeBallError, FreeBallState, FreeBalls, Interval, RingState, StepShares,
};
use rotordyn_bearing::{BallInertia, CharacteristicOrders};
use rotordyn_linalg::small_dense::solve_in_place;
use std::f64::consts::TAU;
use std::ops::ControlFlow;

/// Samples in a turn of the kinematic cage: a ball passes in several of them, the cage turns by less than half a turn
/// between two.
const SAMPLES_PER_TURN: usize = 96;
/// Least number of turns until the cage speed counts as settled.
const LEAST_TURNS: usize = 8;
/// Remaining force over the load.
const BALANCE: f64 = 1e-3;
/// Share of a correction that is made: the quasi-static bearing may be softer than the skidding one.
const RELAXATION: f64 = 0.6;
/// Records after which a bearing whose force still does not balance its load is given up.
const MOST_RECORDS: usize = 12;
/// Largest share of the BPFO by which the kinematic cage may err.
const BPFO_SHARE: f64 = 1e-3;

/// A run in progress.
struct SteadyRun<'a> {
    name: &'a str,
    study: &'a FreeBallStudy,
    progress_or_stop: &'a dyn Fn() -> ControlFlow<()>,
    balls: FreeBalls,
    /// Stiffness of the ring's displacement \[N/m\].
    stiffness: [[f64; 3]; 3],
    kinematic: CharacteristicOrders,
    /// Turn of the kinematic cage and time step \[s\].
    turn: f64,
    step: f64,
    displacement: [f64; 3],
    state: FreeBallState,
    turns: Vec<[f64; 2]>,
}

/// The bearing settled under a load, or why it has no steady state.
///
/// # Errors
/// A speed or duration that is not positive, no static equilibrium, a bearing that does not start or loses a ball, a cage
/// speed that does not settle, a force that does not balance the load.
pub fn steady_run(
    name: &str,
    bearing: &FreeBallBearing,
    study: &FreeBallStudy,
) -> Result<FreeBallResult, FreeBallStudyError> {
    stoppable_run(name, bearing, study, &|| ControlFlow::Continue(()))
}

/// [`steady_run`] that asks after every turn of the kinematic cage whether to go on.
///
/// # Errors
/// As of [`steady_run`]; stopped.
pub(super) fn stoppable_run(
    name: &str,
    bearing: &FreeBallBearing,
    study: &FreeBallStudy,
    progress_or_stop: &dyn Fn() -> ControlFlow<()>,
) -> Result<FreeBallResult, FreeBallStudyError> {
    let mut run = SteadyRun::start(name, bearing, study, progress_or_stop)?;
    run.settle()?;
    let settling_time = run.state.time;
    let tally = run.record()?;
    Ok(run.result(settling_time, tally))
}

impl<'a> SteadyRun<'a> {
    fn start(
        name: &'a str,
        bearing: &FreeBallBearing,
        study: &'a FreeBallStudy,
        progress_or_stop: &'a dyn Fn() -> ControlFlow<()>,
    ) -> Result<Self, FreeBallStudyError> {
        let wrong = |what| Err(FreeBallStudyError::Setting { bearing: name.into(), what });
        if !(study.speed.abs() > 0.0 && study.speed.is_finite()) {
            return wrong("a speed for its cage to turn");
        }
        if !study.force.iter().all(|f| f.is_finite()) || study.recorded_turns == 0 {
            return wrong("a finite load and a record of at least one turn");
        }
        if !(study.drift > 0.0 && study.measured_duration > 0.0) || study.step.is_some_and(|step| step <= 0.0)
        {
            return wrong("a positive time step, drift and duration of a measured record");
        }
        let mut ball = bearing.ball.clone();
        if !ball.inertia.is_on() {
            ball.inertia = BallInertia::OuterRaceControl;
        }
        let [x, y, z] = study.force;
        let condition = Condition {
            load: [x, y, z, 0.0, 0.0],
            prescribed: [None, None, None, Some(0.0), Some(0.0)],
            speed: study.speed,
            cage: CageTreatment::Averaged,
            cage_angle: ball.cage_angle,
        };
        let found = BearingSolver::new(name, &ball).solve(&condition, None)?;
        let kinematic = ball.loaded_orders(found.mean_cos);
        let turn = TAU / (kinematic.ftf * study.speed.abs());
        let displacement = std::array::from_fn(|k| found.displacement[k]);
        let ring = inner_ring(study.speed, 0.0, displacement, [0.0; 3]);
        let rings = [ring, RingState::default()];
        let failed = |cause| failure(name, study, cause);
        let balls = FreeBalls::new(bearing.clone(), study.speed).map_err(failed)?;
        let state = balls.initial_state(&rings).map_err(failed)?;
        #[cfg(feature = "shapes")]
        if let Some(what) = overlap_at_start(&PlacedBalls { balls: &balls, state: state.clone(), rings }) {
            return Err(FreeBallStudyError::Overlap { bearing: name.into(), what });
        }
        let step = balls.stable_step(&state, &rings).within(StepShares::BETWEEN_GIVEN_RINGS);
        Ok(Self {
            name,
            study,
            progress_or_stop,
            stiffness: std::array::from_fn(|a| std::array::from_fn(|b| found.stiffness[a][b])),
            kinematic,
            turn,
            step: study.step.unwrap_or(step),
            displacement,
            balls,
            state,
            turns: Vec::new(),
        })
    }

    /// Runs until the cage speed is settled, with the ring's force near its load.
    fn settle(&mut self) -> Result<(), FreeBallStudyError> {
        let mut correction = [0.0; 3];
        let mut change = f64::INFINITY;
        while self.turns.len() < self.study.settling_turns.max(LEAST_TURNS) {
            let moves = correction.iter().any(|part| *part != 0.0);
            let mean = self.advance_turn(correction, |_, _, _| {})?;
            // A turn in which the ring moved is no measure of the force at its end.
            correction = if moves { [0.0; 3] } else { self.correction(&mean) };
            change = self.change();
            if change < self.study.drift && !moves {
                return Ok(());
            }
        }
        Err(FreeBallStudyError::NotSettled {
            bearing: self.name.into(),
            speed_rpm: self.study.speed * TO_RPM,
            turns: self.turns.len(),
            ratio: self.turns.last().map_or(f64::NAN, |turn| turn[1]),
            change,
        })
    }

    /// Records the bearing with the ring at rest; repeats it after a correction until force and load balance.
    fn record(&mut self) -> Result<Tally, FreeBallStudyError> {
        let mut residual = f64::INFINITY;
        for attempt in 1..=MOST_RECORDS {
            let mut tally = Tally::new(&self.state);
            // Longer each time: what remains may be the scatter of the mean.
            for _ in 0..attempt * self.study.recorded_turns {
                self.advance_turn([0.0; 3], |run, rings, interval| {
                    tally.add(&run.balls, &run.state, rings, interval);
                })?;
            }
            let mean = tally.inner_force();
            residual = self.residual(&mean);
            if residual <= BALANCE {
                return Ok(tally);
            }
            // Moves, then lets the balls come to rest.
            self.advance_turn(self.correction(&mean), |_, _, _| {})?;
            self.advance_turn([0.0; 3], |_, _, _| {})?;
        }
        Err(FreeBallStudyError::NotBalanced {
            bearing: self.name.into(),
            speed_rpm: self.study.speed * TO_RPM,
            load: norm(&self.study.force),
            residual,
        })
    }

    /// Advances by a turn of the kinematic cage while the ring moves smoothly by `correction` \[m\]; the mean force on the
    /// inner ring \[N\].
    fn advance_turn(
        &mut self,
        correction: [f64; 3],
        mut visit: impl FnMut(&Self, &[RingState; 2], &Interval),
    ) -> Result<[f64; 3], FreeBallStudyError> {
        let from = self.displacement;
        let start = self.state.time;
        let (mut force, mut angle) = ([0.0; 3], 0.0);
        // Times from numbers, so that rings have no gap between samples.
        let ring = |sample: usize, study: &FreeBallStudy, turn: f64| {
            let s = sample as f64 / SAMPLES_PER_TURN as f64;
            let (part, rate) = (s * s * (3.0 - 2.0 * s), 6.0 * s * (1.0 - s) / turn);
            let at = std::array::from_fn(|k| from[k] + part * correction[k]);
            inner_ring(study.speed, start + s * turn, at, correction.map(|d| d * rate))
        };
        for sample in 0..SAMPLES_PER_TURN {
            let [before, after] = [sample, sample + 1]
                .map(|sample| [ring(sample, self.study, self.turn), RingState::default()]);
            let old = CageAngle::of(&self.state);
            let duration = self.turn / SAMPLES_PER_TURN as f64;
            let interval = self
                .balls
                .advance(&mut self.state, [&before, &after], duration, self.step)
                .map_err(|cause| failure(self.name, self.study, cause))?;
            angle += CageAngle::of(&self.state).since(&old);
            for (sum, value) in force.iter_mut().zip(&interval.rings[0]) {
                *sum += value / SAMPLES_PER_TURN as f64;
            }
            visit(self, &after, &interval);
        }
        self.displacement = std::array::from_fn(|k| from[k] + correction[k]);
        self.turns.push([self.state.time, angle / TAU * self.study.speed.signum()]);
        match (self.progress_or_stop)() {
            ControlFlow::Continue(()) => Ok(force),
            ControlFlow::Break(()) => Err(FreeBallStudyError::Stopped { bearing: self.name.into() }),
        }
    }

    /// Displacement \[m\] by which the ring's force approaches its load.
    fn correction(&self, force: &[f64; 3]) -> [f64; 3] {
        let mut step: [f64; 3] = std::array::from_fn(|k| self.study.force[k] + force[k]);
        if norm(&step) <= 0.3 * BALANCE * self.load_scale() {
            return [0.0; 3];
        }
        let largest = (0..3).map(|k| self.stiffness[k][k]).fold(0.0, f64::max);
        let mut k = [0.0; 9];
        for a in 0..3 {
            for b in 0..3 {
                k[3 * a + b] = self.stiffness[a][b];
            }
            // An unresisted motion stays where it is.
            k[4 * a] += 1e-6 * largest;
        }
        if solve_in_place(&mut k, &mut step) { step.map(|d| RELAXATION * d) } else { [0.0; 3] }
    }

    /// Remaining force over the load.
    fn residual(&self, force: &[f64; 3]) -> f64 {
        let rest: [f64; 3] = std::array::from_fn(|k| self.study.force[k] + force[k]);
        norm(&rest) / self.load_scale()
    }

    /// The load \[N\]; without one a millionth of the stiffness times the ball, about 1 N.
    fn load_scale(&self) -> f64 {
        match norm(&self.study.force) {
            load if load > 0.0 => load,
            _ => 1e-6 * self.stiffness[0][0] * self.balls.ball_radii()[0],
        }
    }

    /// Relative change of the mean cage speed from the third to the last quarter of the run.
    fn change(&self) -> f64 {
        let turns = self.turns.len();
        let quarter = turns / 4;
        if turns < LEAST_TURNS {
            return f64::INFINITY;
        }
        let mean = |from: usize| self.turns[from..from + quarter].iter().map(|turn| turn[1]).sum::<f64>();
        let [before, last] = [mean(turns - 2 * quarter), mean(turns - quarter)];
        ((last - before) / last).abs()
    }

    fn result(self, settling_time: f64, tally: Tally) -> FreeBallResult {
        let Self { study, kinematic, .. } = self;
        let ratio = tally.turned() / (kinematic.ftf * study.speed * tally.duration());
        let bpfo = kinematic.bpfo * ratio;
        let frequency = study.speed.abs() / TAU;
        let comparison = CageComparison {
            kinematic,
            ftf: kinematic.ftf * ratio,
            bpfo,
            shift_hz: (bpfo - kinematic.bpfo) * frequency,
            limit_hz: (1.0 / study.measured_duration).max(BPFO_SHARE * kinematic.bpfo * frequency),
        };
        let [pocket_peak, pocket_rms] = tally.pocket_forces();
        FreeBallResult {
            name: self.name.into(),
            speed: study.speed,
            load: study.force,
            displacement: self.displacement,
            force: tally.inner_force(),
            step: self.step,
            settling_time,
            duration: tally.duration(),
            cage_speed: tally.turned() / tally.duration(),
            cage_ratio: ratio,
            slip: 1.0 - ratio,
            comparison,
            friction_torque: -tally.inner_moment() * study.speed.signum(),
            losses: tally.losses(),
            pocket_peak,
            pocket_rms,
            balls: tally.balls(),
            record: tally.into_record(kinematic.ftf * study.speed),
            turns: self.turns,
        }
    }
}

fn inner_ring(speed: f64, time: f64, position: [f64; 3], velocity: [f64; 3]) -> RingState {
    RingState { position, velocity, ..RingState::rotating(speed, speed * time) }
}

fn failure(name: &str, study: &FreeBallStudy, cause: FreeBallError) -> FreeBallStudyError {
    FreeBallStudyError::FreeBalls { bearing: name.into(), speed_rpm: study.speed * TO_RPM, cause }
}

fn norm(v: &[f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

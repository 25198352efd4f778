//! Sums over the record of a bearing with free balls.

use crate::results::{FreeBallMean, FreeBallRecord};
use rotordyn_bearing::free_ball::{FreeBallState, FreeBalls, Interval, LOSSES, RingState};
use std::f64::consts::{PI, TAU};

/// Angle of the cage about the outer ring's axis, or of every ball without cage \[rad\].
pub(super) struct CageAngle(Vec<f64>);

impl CageAngle {
    /// Angle in a state; the outer ring is at rest at the origin.
    pub fn of(state: &FreeBallState) -> Self {
        Self(match state.cage() {
            Some(cage) => {
                let [x, ..] = cage.axes();
                vec![x.y.atan2(x.x)]
            }
            None => (0..state.balls)
                .map(|j| {
                    let centre = state.ball(j).position;
                    centre.y.atan2(centre.x)
                })
                .collect(),
        })
    }

    /// Mean angle turned since an earlier state, less than half a turn ago \[rad\].
    pub fn since(&self, earlier: &Self) -> f64 {
        let turned = |(now, then): (&f64, &f64)| (now - then + PI).rem_euclid(TAU) - PI;
        self.0.iter().zip(&earlier.0).map(turned).sum::<f64>() / self.0.len() as f64
    }
}

/// Sums of one record.
pub(super) struct Tally {
    start: f64,
    time: f64,
    last_angle: CageAngle,
    turned: f64,
    /// Integrals of force \[N s\] and moment \[N m s\] of the inner ring and of the losses \[J\].
    ring: [f64; 6],
    losses: [f64; LOSSES.len()],
    balls: Vec<FreeBallMean>,
    pocket_peak: f64,
    pocket_squares: f64,
    record: FreeBallRecord,
}

impl Tally {
    /// A record that begins with a state.
    pub fn new(state: &FreeBallState) -> Self {
        Self {
            start: state.time,
            time: state.time,
            last_angle: CageAngle::of(state),
            turned: 0.0,
            ring: [0.0; 6],
            losses: [0.0; LOSSES.len()],
            balls: vec![FreeBallMean::default(); state.balls],
            pocket_peak: 0.0,
            pocket_squares: 0.0,
            record: FreeBallRecord::default(),
        }
    }

    /// Adds an interval that ends with a state and rings.
    pub fn add(
        &mut self,
        balls: &FreeBalls,
        state: &FreeBallState,
        rings: &[RingState; 2],
        interval: &Interval,
    ) {
        let duration = state.time - self.time;
        self.time = state.time;
        for (sum, value) in self.ring.iter_mut().zip(&interval.rings[0]) {
            *sum += duration * value;
        }
        for (sum, value) in self.losses.iter_mut().zip(&interval.losses) {
            *sum += value;
        }
        let angle = CageAngle::of(state);
        let turned = angle.since(&self.last_angle);
        self.last_angle = angle;
        self.turned += turned;
        self.record.time.push(state.time);
        self.record.cage_ratio.push(turned / duration);
        if let Some(cage) = state.cage() {
            self.record.cage_x.push(cage.position.x);
            self.record.cage_y.push(cage.position.y);
        }
        for (mean, ball) in self.balls.iter_mut().zip(balls.report(state, rings)) {
            let pitch = ball.pitch_angle();
            mean.pitch_angle += pitch;
            self.record.pitch_angles.push(pitch);
            for (k, race) in ball.races.iter().enumerate() {
                let (load, angle) = race.map_or((0.0, 0.0), |race| (race.load, race.angle));
                mean.loads[k] += load;
                mean.angles[k] += load * angle;
            }
            self.pocket_peak = self.pocket_peak.max(ball.pocket.abs());
            self.pocket_squares += ball.pocket * ball.pocket;
        }
    }

    /// Length of the record \[s\].
    pub fn duration(&self) -> f64 {
        self.time - self.start
    }

    /// Angle turned by the cage \[rad\].
    pub fn turned(&self) -> f64 {
        self.turned
    }

    /// Mean force on the inner ring \[N\] and its mean moment about the axis \[N m\].
    pub fn inner_force(&self) -> [f64; 3] {
        [0, 1, 2].map(|k| self.ring[k] / self.duration())
    }

    pub fn inner_moment(&self) -> f64 {
        self.ring[5] / self.duration()
    }

    /// Mean heat of each source \[W\].
    pub fn losses(&self) -> [f64; LOSSES.len()] {
        self.losses.map(|loss| loss / self.duration())
    }

    /// Largest and RMS force of the pockets \[N\].
    pub fn pocket_forces(&self) -> [f64; 2] {
        let samples = self.record.time.len() * self.balls.len();
        [self.pocket_peak, (self.pocket_squares / samples as f64).sqrt()]
    }

    /// Means of every ball.
    pub fn balls(&self) -> Vec<FreeBallMean> {
        let samples = self.record.time.len() as f64;
        let mean = |ball: &FreeBallMean| FreeBallMean {
            pitch_angle: ball.pitch_angle / samples,
            loads: ball.loads.map(|load| load / samples),
            angles: [0, 1].map(|k| ball.angles[k] / ball.loads[k]),
        };
        self.balls.iter().map(mean).collect()
    }

    /// The samples, with the cage speed over a speed \[rad/s\].
    pub fn into_record(mut self, cage_speed: f64) -> FreeBallRecord {
        self.record.cage_ratio.iter_mut().for_each(|speed| *speed /= cage_speed);
        self.record
    }
}

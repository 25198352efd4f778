//! Jerk, its jumps, and the race defects located from them.

use super::{Job, Race};
use crate::results::{JerkResult, RaceResult};
use rotordyn_signal::SignalError;
use rotordyn_signal::jerk::{jerk, jerk_jumps};
use rotordyn_signal::race_defects::{BallPassage, fold_jerk, race_defects};

/// Detection threshold of a jump in robust standard deviations.
const JUMP_THRESHOLD: f64 = 10.0;

impl Job<'_> {
    /// Jerk and jumps; with a bearing at constant speed the defects of the chosen race.
    pub(super) fn jerk(&self) -> Result<JerkResult, SignalError> {
        let race = match self.bearing {
            None => None,
            Some(bearing) => {
                let speed = self.steady_speed("locating a race's defects from the jerk")?;
                let (race, order, race_speed, radius) = match self.settings.race {
                    Race::Outer => ("outer race", bearing.orders.bpfo, 0.0, 1),
                    Race::Inner => ("inner race", bearing.orders.bpfi, speed, 0),
                };
                let passage = BallPassage {
                    frequency: order * speed,
                    balls: bearing.balls,
                    race_speed,
                    // Relative to the first analysed sample.
                    datum: self.settings.datum - self.channel.start - self.first as f64 / self.rate,
                };
                let orthogonal = self.channel.orthogonal.as_ref();
                let orthogonal = orthogonal.map(|y| &y[self.first..self.first + self.x.len()]);
                Some(RaceResult {
                    race: race.into(),
                    radius: bearing.raceway_radii.map(|radii| radii[radius]),
                    full_circumference: orthogonal.is_some(),
                    fold: fold_jerk(self.x, orthogonal, self.rate, &passage)?,
                    defects: race_defects(self.x, orthogonal, self.rate, &passage)?,
                })
            }
        };
        Ok(JerkResult {
            jerk: jerk(self.x, self.rate)?,
            jumps: jerk_jumps(self.x, self.rate, JUMP_THRESHOLD)?,
            race,
        })
    }
}

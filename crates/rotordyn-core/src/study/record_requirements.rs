//! What spectrogram and order study need of a run-up's record, compared with its speed profile before the run.

use std::f64::consts::TAU;

use super::Machine;
use crate::model::Drive;
use crate::model::speed_profile::SpeedProfile;
use rotordyn_signal::SignalError;
use rotordyn_signal::order::{OrderSettings, rate_too_low, too_few_revolutions};

/// Points of the profile at which its speed is taken.
const POINTS: usize = 20_000;
/// Share by which a need may be missed, as the profile is taken at points: the study itself decides then.
const MARGIN: f64 = 0.01;

/// Need of a study that the run-up does not meet.
#[derive(Clone, Debug, PartialEq)]
pub struct UnmetNeed {
    /// Name of the study, "orders".
    pub study: &'static str,
    pub error: SignalError,
    /// What changes it.
    pub advice: String,
}

impl Machine {
    /// Needs of the spectrogram and the order study that the run-up will not meet: a record of one window, a sampling rate
    /// for the highest order at the highest speed, and the revolutions of one window.
    ///
    /// Where a drive torque leaves the speed open, only the length of the record is known.
    pub fn unmet_record_needs(&self) -> Vec<UnmetNeed> {
        let studies = &self.model.studies;
        let Some(run) = &studies.run_up else { return Vec::new() };
        let profile = &self.model.profile;
        let rate = run.sample_rate;
        let mut unmet = Vec::new();
        if let Some(study) = &studies.spectrogram {
            let [needed, given] = [study.length, profile.duration()].map(|t| (t * rate).round() as usize);
            // Both ends are sampled.
            let given = given + 1;
            if given < needed {
                let (name, purpose) = ("record", "one window of the spectrogram");
                unmet.push(UnmetNeed {
                    study: "spectrogram",
                    error: SignalError::TooShort { name, needed, given, purpose },
                    advice: "shorten study.spectrogram.length, or lengthen the profile of [speed]".into(),
                });
            }
        }
        if let (Some(study), Drive::Prescribed { .. }) = (&studies.orders, &self.model.drive) {
            let settings = OrderSettings::new(study.resolution, study.max_order);
            let needed = settings.needed_sample_rate(profile.top_speed() / TAU);
            if needed > (1.0 + MARGIN) * rate {
                unmet.push(UnmetNeed {
                    study: "orders",
                    error: rate_too_low(rate, needed),
                    advice: "raise study.run_up.sample_rate, or lower study.orders.max_order".into(),
                });
            }
            let needed = settings.needed_revolutions();
            let turned = most_revolutions(profile, settings.min_speed);
            if needed > (1.0 + MARGIN) * turned {
                unmet.push(UnmetNeed {
                    study: "orders",
                    error: too_few_revolutions(turned, needed),
                    advice: "raise study.orders.resolution, or lengthen the profile of [speed]".into(),
                });
            }
        }
        unmet
    }
}

/// Most revolutions of a profile without a stop or a reversal; below `min_speed` \[rev/s\] the shaft counts as at rest.
fn most_revolutions(profile: &SpeedProfile, min_speed: f64) -> f64 {
    let (curve, duration) = (profile.curve(), profile.duration());
    let mut most: f64 = 0.0;
    let mut start = 0.0;
    let mut way = 0.0;
    for k in 0..=POINTS {
        let spin = curve.at(duration * k as f64 / POINTS as f64);
        let now = if spin.speed.abs() > TAU * min_speed { spin.speed.signum() } else { 0.0 };
        if now != way {
            (start, way) = (spin.angle, now);
        }
        if way != 0.0 {
            most = most.max((spin.angle - start).abs() / TAU);
        }
    }
    most
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn revolutions_of_profiles_in_closed_form() {
        let ramp = |from: f64, to: f64, settle: f64, hold: f64| SpeedProfile::Ramp {
            from: TAU * from,
            to: TAU * to,
            settle,
            ramp: 2.0,
            hold,
        };
        for (profile, expected) in [
            (SpeedProfile::Constant { speed: TAU * 7.0, duration: 3.0 }, 21.0),
            (SpeedProfile::Constant { speed: -TAU * 7.0, duration: 3.0 }, 21.0),
            // Half the top speed within the ramp; the standstill before it does not count.
            (ramp(0.0, 20.0, 1.0, 1.5), 20.0 + 30.0),
            // A reversal in the middle of the ramp: 5 on either side, and the hold.
            (ramp(-10.0, 10.0, 0.2, 0.5), 5.0 + 5.0),
            (SpeedProfile::Constant { speed: TAU * 0.01, duration: 3000.0 }, 0.0),
        ] {
            let found = most_revolutions(&profile, 0.05);
            assert!((found - expected).abs() <= 0.005 * expected, "{profile:?}: {found}");
        }
    }
}

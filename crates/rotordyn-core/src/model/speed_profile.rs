//! Shaft speed as a function of time.

use rotordyn_linalg::pchip::Pchip;
use rotordyn_linalg::spline::Spline;
use serde::{Deserialize, Serialize};

/// Prescribed shaft speed over time; speeds in rad/s, times in s.
#[derive(Clone, Debug, PartialEq)]
pub enum SpeedProfile {
    Constant {
        speed: f64,
        duration: f64,
    },
    /// `settle` at `from`, linear ramp over `ramp` to `to`, `hold` at `to`.
    Ramp {
        from: f64,
        to: f64,
        settle: f64,
        ramp: f64,
        hold: f64,
    },
    /// Like `Ramp` with a smooth (C²) quintic in place of the linear ramp.
    SCurve {
        from: f64,
        to: f64,
        settle: f64,
        ramp: f64,
        hold: f64,
    },
    /// Points (time, speed) of increasing time, interpolated by a monotone cubic (PCHIP); constant beyond the
    /// ends.
    Table {
        points: Vec<[f64; 2]>,
    },
    /// Tacho pulses: points (time, shaft angle) interpolated by a cubic spline, with continuous acceleration;
    /// the run is the part from 0 to `duration`. Angles count from a pulse, so the keyphasor is at whole
    /// revolutions.
    Pulses {
        points: Vec<[f64; 2]>,
        duration: f64,
    },
    /// Ω(t) = Ω₀ exp(−(t − settle)/τ) from `settle` on, until `duration`.
    CoastDown {
        from: f64,
        settle: f64,
        time_constant: f64,
        duration: f64,
    },
}

/// Shaft angle, speed and acceleration at one time.
#[derive(Clone, Copy, Debug, PartialEq, Default, Serialize, Deserialize)]
pub struct Spin {
    /// θ \[rad\], zero at t = 0; with measured pulses zero at the first pulse.
    pub angle: f64,
    /// Ω \[rad/s\].
    pub speed: f64,
    /// Ω̇ \[rad/s²\].
    pub acceleration: f64,
}

/// A speed profile with its interpolants, ready for evaluation.
#[derive(Clone, Debug)]
pub struct SpeedCurve {
    profile: SpeedProfile,
    table: Option<Pchip>,
    pulses: Option<Spline>,
}

impl SpeedProfile {
    /// Length of the profile \[s\].
    pub fn duration(&self) -> f64 {
        match self {
            Self::Constant { duration, .. }
            | Self::CoastDown { duration, .. }
            | Self::Pulses { duration, .. } => *duration,
            Self::Ramp { settle, ramp, hold, .. } | Self::SCurve { settle, ramp, hold, .. } => {
                settle + ramp + hold
            }
            Self::Table { points } => points.last().map_or(0.0, |p| p[0]),
        }
    }

    /// Maximum |Ω| of the profile \[rad/s\].
    pub fn top_speed(&self) -> f64 {
        match self {
            Self::Constant { speed, .. } => speed.abs(),
            Self::CoastDown { from, .. } => from.abs(),
            Self::Ramp { from, to, .. } | Self::SCurve { from, to, .. } => from.abs().max(to.abs()),
            Self::Table { points } => points.iter().fold(0.0, |m, p| m.max(p[1].abs())),
            Self::Pulses { points, .. } => {
                let curve = self.curve();
                points.iter().fold(0.0, |m, p| m.max(curve.at(p[0]).speed.abs()))
            }
        }
    }

    /// Lowest and highest speed of the profile \[rad/s\].
    pub fn speed_range(&self) -> [f64; 2] {
        const SAMPLES: usize = 2000;
        let (curve, duration) = (self.curve(), self.duration());
        let speeds = (0..=SAMPLES).map(|k| curve.at(duration * k as f64 / SAMPLES as f64).speed);
        let points: Vec<f64> = match self {
            Self::Table { points } => points.iter().map(|p| p[1]).collect(),
            Self::Pulses { points, .. } => points.iter().map(|p| curve.at(p[0]).speed).collect(),
            _ => Vec::new(),
        };
        speeds
            .chain(points)
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], speed| [low.min(speed), high.max(speed)])
    }

    /// The profile with its interpolants, ready for evaluation.
    pub fn curve(&self) -> SpeedCurve {
        let columns =
            |points: &[[f64; 2]]| -> (Vec<f64>, Vec<f64>) { points.iter().map(|p| (p[0], p[1])).unzip() };
        let (mut table, mut pulses) = (None, None);
        match self {
            Self::Table { points } => {
                let (time, speed) = columns(points);
                table = Pchip::new(&time, &speed);
            }
            Self::Pulses { points, .. } => {
                let (time, angle) = columns(points);
                pulses = Spline::new(&time, &angle);
            }
            _ => {}
        }
        SpeedCurve { profile: self.clone(), table, pulses }
    }
}

impl SpeedCurve {
    /// Angle, speed and acceleration at time `t` ≥ 0, each the exact derivative or integral of the others.
    pub fn at(&self, t: f64) -> Spin {
        match &self.profile {
            SpeedProfile::Constant { speed, .. } => {
                Spin { angle: speed * t, speed: *speed, acceleration: 0.0 }
            }
            SpeedProfile::Ramp { from, to, settle, ramp, .. } => {
                blend(*from, *to, *settle, *ramp, t, |x| [x * x / 2.0, x, 1.0])
            }
            SpeedProfile::SCurve { from, to, settle, ramp, .. } => {
                blend(*from, *to, *settle, *ramp, t, |x| {
                    [
                        x.powi(4) * (2.5 - 3.0 * x + x * x),
                        x.powi(3) * (10.0 - 15.0 * x + 6.0 * x * x),
                        30.0 * (x * (1.0 - x)).powi(2),
                    ]
                })
            }
            SpeedProfile::CoastDown { from, settle, time_constant, .. } => {
                if t <= *settle {
                    return Spin { angle: from * t, speed: *from, acceleration: 0.0 };
                }
                let decay = (-(t - settle) / time_constant).exp();
                Spin {
                    angle: from * settle + from * time_constant * (1.0 - decay),
                    speed: from * decay,
                    acceleration: -from * decay / time_constant,
                }
            }
            SpeedProfile::Pulses { .. } => {
                let [angle, speed, acceleration] = self.pulses.as_ref().map_or([0.0; 3], |s| s.evaluate(t));
                Spin { angle, speed, acceleration }
            }
            SpeedProfile::Table { points } => {
                let Some(table) = &self.table else {
                    return Spin::default();
                };
                let (first, last) = (points[0][0], points[points.len() - 1][0]);
                let inside = t.clamp(first, last);
                let [speed, slope, area] = table.evaluate(inside);
                Spin {
                    // Constant first speed from t = 0 to the first time.
                    angle: area + speed * (t - inside) + points[0][1] * first.max(0.0),
                    speed,
                    acceleration: if t == inside { slope } else { 0.0 },
                }
            }
        }
    }
}

/// Dwell at `from`, transition `from` → `to` with shape s (∫s, s, s′ on 0..1), dwell at `to`.
fn blend(from: f64, to: f64, settle: f64, ramp: f64, t: f64, shape: impl Fn(f64) -> [f64; 3]) -> Spin {
    if t < settle {
        return Spin { angle: from * t, speed: from, acceleration: 0.0 };
    }
    let before = from * settle;
    let (rise, end) = (to - from, settle + ramp);
    if t < end {
        let x = (t - settle) / ramp;
        let [area, value, slope] = shape(x);
        return Spin {
            angle: before + from * (t - settle) + rise * ramp * area,
            speed: from + rise * value,
            acceleration: rise * slope / ramp,
        };
    }
    let [area, ..] = shape(1.0);
    Spin { angle: before + from * ramp + rise * ramp * area + to * (t - end), speed: to, acceleration: 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angle_speed_and_acceleration_are_consistent() {
        let profiles = [
            SpeedProfile::Constant { speed: 30.0, duration: 5.0 },
            SpeedProfile::Ramp { from: 5.0, to: 125.0, settle: 1.0, ramp: 2.0, hold: 2.0 },
            SpeedProfile::SCurve { from: 0.0, to: -90.0, settle: 0.5, ramp: 3.0, hold: 1.5 },
            SpeedProfile::Table { points: vec![[0.5, 3.0], [1.0, 10.0], [2.5, 70.0], [5.0, 20.0]] },
            SpeedProfile::CoastDown { from: 80.0, settle: 1.0, time_constant: 1.5, duration: 5.0 },
        ];
        for profile in profiles {
            let curve = profile.curve();
            assert_eq!(profile.duration(), 5.0);
            assert_eq!(curve.at(0.0).angle, 0.0);
            let h = 1e-5;
            for k in 1..499 {
                let t = k as f64 * 0.01 + 0.003;
                let (a, b, c) = (curve.at(t - h), curve.at(t), curve.at(t + h));
                assert!(((c.angle - a.angle) / (2.0 * h) - b.speed).abs() < 1e-5, "{profile:?} {t}");
                assert!(((c.speed - a.speed) / (2.0 * h) - b.acceleration).abs() < 1e-4);
                assert!(b.speed.abs() <= profile.top_speed() * (1.0 + 1e-12));
            }
        }
    }
}

//! Figures of a run-up with free balls: cage speed, slip, pocket force and friction torque over time; orbits of the cage.

use super::run::shaft_speed;
use super::{Named, TO_RPM};
use crate::{Channel, Figure, History, Orbit, Orbits, SecondScale};
use rotordyn_bearing::free_ball::{FreeBallBearing, Guidance};
use rotordyn_core::model::BearingSite;
use rotordyn_core::results;
use rotordyn_core::series::SeriesError;
use rotordyn_core::study::Machine;
use std::borrow::Cow;
use std::f64::consts::TAU;

/// Share of the highest shaft speed below which slip is not drawn: the speed of the balls scatters there as elsewhere.
const LEAST_SPEED: f64 = 0.05;
/// Revolutions of the cage in an orbit, and their number over the run.
const ORBIT_TURNS: f64 = 4.0;
const ORBITS: usize = 4;

/// Figures of every bearing with free balls.
///
/// # Errors
/// Samples that cannot be read.
pub fn figures(history: &results::History, machine: &Machine) -> Result<Vec<Named>, SeriesError> {
    let mut found = Vec::new();
    for site in &machine.model.bearings {
        let Some(bearing) = site.bearing.free_balls() else { continue };
        let recorded = Recorded { history, site, title: &machine.model.title };
        found.extend(recorded.cage_motion(bearing)?);
        found.extend(recorded.cage_orbits(bearing)?);
    }
    Ok(found)
}

/// A bearing with free balls in a run.
struct Recorded<'a> {
    history: &'a results::History,
    site: &'a BearingSite,
    /// Title of the model.
    title: &'a str,
}

impl Recorded<'_> {
    fn channel(&self, name: &str) -> Result<Option<Cow<'_, [f64]>>, SeriesError> {
        let found = self.history.channel(&format!("{}_{name}", self.site.name));
        found.map(|channel| channel.values.all()).transpose()
    }

    fn name(&self, what: &str) -> String {
        format!("run_up_bearing_{}_{what}", self.site.name)
    }

    /// Speed, slip, pocket force and friction torque over time.
    fn cage_motion(&self, bearing: &FreeBallBearing) -> Result<Option<Named>, SeriesError> {
        let history = self.history;
        let body = if bearing.cage.is_some() { "cage" } else { "balls" };
        let (Some(speed), Some(slip)) = (self.channel("cage_speed")?, self.channel("cage_slip")?) else {
            return Ok(None);
        };
        let [shaft, angle] = [history.speed.all()?, history.angle.all()?];
        let top = shaft.iter().fold(0.0, |top: f64, speed| top.max(speed.abs()));
        // Slip is recorded as 1 − ω/ω_rolling.
        let rolling: Vec<f64> = speed
            .iter()
            .zip(&*slip)
            .zip(&*shaft)
            .map(
                |((speed, slip), shaft)| {
                    if shaft.abs() > LEAST_SPEED * top { speed / (1.0 - slip) } else { f64::NAN }
                },
            )
            .collect();
        let drawn: Vec<f64> = speed
            .iter()
            .zip(&rolling)
            .map(|(v, rolling)| if rolling.is_nan() { f64::NAN } else { *v })
            .collect();
        let [mean_speed, mean_rolling] = [&drawn, &rolling].map(|v| mean_over_turn(v, &angle));
        let over_rolling = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a / b).collect::<Vec<_>>();
        let over_time = |label: &str, quantity: &str, unit: &str, value: Vec<f64>| Channel {
            label: label.into(),
            quantity: quantity.into(),
            unit: unit.into(),
            time: history.time.clone(),
            mean: mean_over_turn(&value, &angle).into(),
            value: value.into(),
            ..Channel::default()
        };
        let scaled = |values: &[f64], factor: f64| values.iter().map(|v| v * factor).collect::<Vec<_>>();
        let ratio = Channel {
            mean: over_rolling(&mean_speed, &mean_rolling).into(),
            second: Some(SecondScale {
                quantity: "slip".into(),
                unit: "%".into(),
                offset: 100.0,
                factor: -100.0,
            }),
            ..over_time(
                &format!("{body}: speed over rolling"),
                "speed ratio",
                "",
                over_rolling(&speed, &rolling),
            )
        };
        let mut channels = vec![
            shaft_speed(history),
            Channel {
                reference: scaled(&rolling, TO_RPM).into(),
                ..over_time(&format!("{body}: speed"), "speed", "rpm", scaled(&speed, TO_RPM))
            },
            ratio,
        ];
        if let Some(force) = self.channel("pocket_force")?.filter(|_| bearing.cage.is_some()) {
            let label = "largest force of a pocket on its ball";
            channels.push(Channel { from_zero: true, ..over_time(label, "force", "N", force.into_owned()) });
        }
        if let Some(torque) = self.channel("friction_torque")? {
            channels.push(over_time("friction torque on the shaft", "torque", "N mm", scaled(&torque, 1e3)));
        }
        let figure = History {
            title: format!("Run-up, {body} of bearing {}", self.site.name),
            note: self.title.into(),
            legend: ["samples", "mean over a revolution of the shaft", "rolling without slip"]
                .map(String::from),
            channels,
        };
        Ok(Some((self.name("cage"), Figure::History(figure))))
    }

    /// Orbits of the cage in its clearance at instants of the run.
    fn cage_orbits(&self, bearing: &FreeBallBearing) -> Result<Option<Named>, SeriesError> {
        let Some(cage) = &bearing.cage else { return Ok(None) };
        let [x, y, speed] = ["cage_x", "cage_y", "cage_speed"].map(|name| self.channel(name));
        let (Some(x), Some(y), Some(speed)) = (x?, y?, speed?) else { return Ok(None) };
        let [time, shaft] = [self.history.time.all()?, self.history.speed.all()?];
        let (clearance, how) = match &cage.guidance {
            Guidance::Land(land) => (land.clearance, "on its land"),
            Guidance::Balls => (
                0.5 * (cage.pocket_diameter - bearing.ball.geometry.ball_diameter),
                "of its pockets about the balls",
            ),
        };
        let samples = x.len();
        let orbit = |number: usize| {
            let last = (samples * number / ORBITS).min(samples.checked_sub(1)?);
            let turned = ORBIT_TURNS * TAU * self.history.sample_rate;
            let length = (turned / speed[last].abs()).ceil() as usize;
            let first = last.saturating_sub(length.clamp(1, (samples / ORBITS).max(1)));
            let [from, to] = [first, last].map(|k| time[k]);
            let rpm = shaft[last] * TO_RPM;
            Some(Orbit {
                title: format!("{from:.3} to {to:.3} s, shaft at {rpm:.0} rpm"),
                x: x[first..=last].to_vec(),
                y: y[first..=last].to_vec(),
                clearance: Some(clearance),
                ..Orbit::default()
            })
        };
        let figure = Orbits {
            title: format!("Run-up, centre of the cage of bearing {} against the outer ring", self.site.name),
            note: format!("{}; circle: radial clearance of the cage {how}", self.title),
            orbits: (1..=ORBITS).filter_map(orbit).collect(),
        };
        Ok(Some((self.name("cage_orbit"), Figure::Orbits(figure))))
    }
}

/// Mean over the revolution of the shaft around every sample, by its angle; missing values do not count, in the first half
/// revolution there is none.
fn mean_over_turn(values: &[f64], angle: &[f64]) -> Vec<f64> {
    // Integral over the angle, and the angle that has a value.
    let mut sums = vec![[0.0; 2]];
    for (k, value) in values.iter().enumerate() {
        let [sum, turned] = sums[k];
        let step = if k > 0 && value.is_finite() { (angle[k] - angle[k - 1]).abs() } else { 0.0 };
        sums.push(if step > 0.0 { [sum + step * value, turned + step] } else { [sum, turned] });
    }
    // Round-off of angles that are equally spaced.
    let half = 0.5 * TAU * (1.0 + 1e-12);
    let turning = |k: usize| (angle[k] - angle[0]).abs() >= 0.5 * TAU * (1.0 - 1e-12);
    let (mut first, mut last) = (0, 0);
    let mean = |(k, value): (usize, &f64)| {
        while (angle[k] - angle[first]).abs() > half {
            first += 1;
        }
        while last + 1 < values.len() && (angle[last + 1] - angle[k]).abs() <= half {
            last += 1;
        }
        // The angle up to the first sample belongs to the revolution before.
        let ([before, passed], [sum, turned]) = (sums[first + 1], sums[last + 1]);
        if value.is_finite() && turning(k) && turned > passed {
            (sum - before) / (turned - passed)
        } else {
            f64::NAN
        }
    };
    values.iter().enumerate().map(mean).collect()
}

#[cfg(test)]
mod tests {
    use super::mean_over_turn;
    use std::f64::consts::FRAC_PI_2;

    /// Four samples to a revolution: means of the four samples that end the quarters from −180° to 180°, fewer at the
    /// ends, none of a missing value.
    #[test]
    fn mean_over_a_revolution() {
        let angle: Vec<f64> = (0..8).map(|k| f64::from(k) * FRAC_PI_2).collect();
        let values = [f64::NAN, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];
        let found = mean_over_turn(&values, &angle);
        assert!(found[..2].iter().all(|mean| mean.is_nan()));
        // The angles are multiples of pi/2 to round-off.
        let expected = [2.5, 3.5, 4.5, 5.5, 6.0, 6.5];
        assert!(found[2..].iter().zip(expected).all(|(mean, e)| (mean - e).abs() < 1e-12), "{found:?}");
    }

    /// Samples at standstill have no share of a revolution.
    #[test]
    fn standstill_does_not_count() {
        let angle = [0.0, 0.0, 0.0, FRAC_PI_2, 2.0 * FRAC_PI_2];
        let found = mean_over_turn(&[9.0, 9.0, 9.0, 1.0, 3.0], &angle);
        assert!(found[..4].iter().all(|mean| mean.is_nan()));
        assert_eq!(found[4], 2.0);
        assert!(mean_over_turn(&[9.0, 9.0], &[0.0, 0.0]).iter().all(|mean| mean.is_nan()));
    }
}

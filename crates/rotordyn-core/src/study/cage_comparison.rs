//! Run-up with free balls beside the same run-up with kinematic cages.
//!
//! Three kinematic runs, at a small share of the cost of that with free balls: with rolling cages; with each cage at the
//! recorded mean angle of the free balls, since the level of ball passage also depends on the phase between the cages; and
//! with every ball at its own recorded angle.
//!
//! Levels of the overhung rig at 1200 rpm, free balls in bearing B over those of a kinematic run with the same
//! angles (30 revolutions; over the line's noise by 25 to 75 times):
//!
//! | | 1x | BPFO, mean angle | BPFO, every ball |
//! |---|---|---|---|
//! | disc, x and y | within 0.03 % | +13 %, +6 % | −5 %, −4 % |
//! | housing A, x and y | within 0.03 % | +8 %, +9 % | −4 %, −3 % |
//!
//! What makes the difference at BPFO, each tried by itself: mostly the spacing of the balls, which lag outside the
//! load zone as far as their pockets let them (weighting the mean angle by the loads changes nothing); samples of accelerations,
//! into which collisions at tens of kHz alias (+6 % and +22 % at housing A at 4 kHz, so the levels are of means over the
//! sampling interval). Little: traction, 0.3 to 0.5 % of the excitation by passing balls; centrifugal force, 0.2 %; contact damping
//! of 4 s/m instead of 1 s/m, 1 %. What remains, 1 to 5 % over several runs, comes with loads of balls that enter the load zone,
//! which are 0.1 to 0.2 N below the quasi-static ones over the first 40°. Housing B itself shakes with the collisions: BPFO is only
//! 12 to 16 times above their noise there, and 12 to 15 % off.

use std::borrow::Cow;
use std::f64::consts::TAU;
use std::ops::ControlFlow;
use std::sync::Arc;

use super::cage_turns::CageTurns;
use super::step_error::line_level;
use super::{Machine, Recorder, StudyError};
use crate::model::run_channels::interval_mean;
use crate::model::study::{Integrator, RunUpStudy};
use crate::results::{CageLine, CageSpeed, History, RollingCageComparison};
use crate::series::{Series, SeriesError};
use crate::transient::run::End;
use rotordyn_bearing::free_ball::ball_offset_name;
use rotordyn_bearing::{BallBearing, SpacedBalls};

/// Share of the run's revolutions before the stretch that is compared.
const SKIPPED: f64 = 2.0 / 3.0;
/// Fewest cycles of an order in the stretch.
const FEWEST_CYCLES: f64 = 4.0;
/// Spectral lines from an order line to the noise beside it, outside the main lobe of the window.
const LINES_BESIDE: f64 = 3.0;

impl Machine {
    /// Compares a finished run-up with free balls, `history`, with the same run-up with kinematic cages.
    ///
    /// `None` for a machine without free balls, a shaft that reverses, a run too short or one that was stopped by `progress`. Errors: a kinematic run that fails.
    pub fn compare_cages(
        &self,
        study: &RunUpStudy,
        history: &History,
        progress: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<Option<RollingCageComparison>, StudyError> {
        let rolling = |site: usize| self.model.bearings[site].bearing.with_rolling_cage();
        let free: Vec<usize> =
            (0..self.model.bearings.len()).filter(|site| rolling(*site).is_some()).collect();
        if free.is_empty() {
            return Ok(None);
        }
        let angle = history.angle.all()?;
        let Some(stretch) = last_third(&angle) else { return Ok(None) };
        let [first, end] = stretch;
        let revolutions = (angle[end] - angle[first]).abs() / TAU;

        let mut model = self.model.clone();
        for site in &free {
            if let Some(bearing) = rolling(*site) {
                model.bearings[*site].bearing = bearing;
            }
        }
        let machine = Self::new(model)?;
        let machine = machine.decided(&[machine.top_speed_of_run()])?.unwrap_or_else(|| Arc::new(machine));
        let integrator = Integrator::GeneralisedAlpha { rho_infinity: RHO_INFINITY };
        let study = &RunUpStudy { integrator, ..study.clone() };
        let mut runs = Vec::new();
        for drive in [CageDrive::Rolling, CageDrive::MeanAngle, CageDrive::EveryBall] {
            let mut reduction = machine.reduce(study)?;
            for site in free.iter().filter(|_| drive != CageDrive::Rolling) {
                let site = &machine.model.bearings[*site];
                let Some(recorded) = BallAngles::of(history, &angle, &site.name)? else { return Ok(None) };
                let interfaces = reduction.system.interfaces.iter_mut();
                for interface in interfaces.filter(|interface| interface.name == site.name) {
                    interface.cage_angles = Some(recorded.mean_over_shaft());
                    if drive == CageDrive::EveryBall {
                        let spaced = site.bearing.ball().and_then(|ball| recorded.spaced(ball));
                        let Some(spaced) = spaced else { return Ok(None) };
                        interface.element = Arc::new(spaced);
                    }
                }
            }
            let probes = &self.model.probes;
            let recorder = Recorder::new(&machine.model, &reduction.system, study.sample_rate);
            // Only what is compared is kept: the probes, and the angles of the cages.
            let mut recorder = recorder.with_channels(|channel| {
                probes.iter().any(|probe| probe.name == channel.name) || channel.direction == "cage"
            });
            let report = machine.run_up(study, &reduction, |sample| {
                recorder.record(sample);
                progress()
            });
            match report.end {
                End::Complete => runs.push(recorder.into_history()),
                End::Stopped => return Ok(None),
                End::Failed(error) => return Err(error.into()),
            }
        }
        let [rolling, driven, spaced] = &runs[..] else { return Ok(None) };

        let cages = free.iter().map(|site| self.cage_speed(*site, history, rolling, stretch));
        let cages = cages.collect::<Result<Vec<CageSpeed>, SeriesError>>()?;
        let [free_turns, rolling_turns] = [
            CageTurns::of(self, history, first..end + 1)?.ratios(),
            CageTurns::of(self, rolling, first..end + 1)?.ratios(),
        ];
        let mut lines = Vec::new();
        let offset = LINES_BESIDE / revolutions;
        let samples_per_revolution = (end - first) as f64 / revolutions;
        for probe in 0..self.model.probes.len() {
            let own = &history.channels[probe];
            let means = history.channel(&interval_mean(&own.name)).unwrap_or(own);
            let means = means.values.read(first..end + 1)?;
            let angle = &angle[first..=end];
            let stretch_of = |run: &History| -> Result<[Vec<f64>; 2], SeriesError> {
                let values = run.channels[probe].values.read(first..end + 1)?;
                Ok([run.angle.read(first..end + 1)?.into_owned(), values.into_owned()])
            };
            let kinematic = [stretch_of(rolling)?, stretch_of(driven)?, stretch_of(spaced)?];
            for order in self.checked_orders() {
                // That of the first bearing that has it.
                let line_with = |turns: &[Option<f64>]| {
                    self.order_lines_of_cages(&[order], turns, f64::INFINITY).into_iter().next()
                };
                let (Some(of_run), Some(of_rolling)) = (line_with(&free_turns), line_with(&rolling_turns))
                else {
                    continue;
                };
                let (order_of_run, order) = (of_run.line.order, of_rolling.line.order);
                if order * revolutions < FEWEST_CYCLES {
                    continue;
                }
                let level =
                    |run: usize, order: f64| line_level(&kinematic[run][0], &kinematic[run][1], order);
                // Without aliasing; a mean over an interval lowers a line by sin(x)/x.
                let x = std::f64::consts::PI * order_of_run / samples_per_revolution;
                let free_level = |order: f64| line_level(angle, &means, order) * x / x.sin();
                let noise = [-offset, offset].map(|offset| free_level(order_of_run + offset));
                lines.push(CageLine {
                    channel: own.name.clone(),
                    unit: own.unit.clone(),
                    line: of_run.line,
                    free: free_level(order_of_run),
                    rolling: level(0, order),
                    driven: level(1, order_of_run),
                    spaced: level(2, order_of_run),
                    noise: 0.5 * (noise[0] + noise[1]),
                });
            }
        }
        let time_at = |index: usize| Ok::<_, SeriesError>(history.time.at(index)?.unwrap_or(f64::NAN));
        Ok(Some(RollingCageComparison {
            stretch: [time_at(first)?, time_at(end)?],
            revolutions,
            cages,
            lines,
        }))
    }

    /// Speeds, slip and losses of a bearing with free balls in a stretch.
    fn cage_speed(
        &self,
        site: usize,
        free: &History,
        rolling: &History,
        [first, end]: [usize; 2],
    ) -> Result<CageSpeed, SeriesError> {
        let site = &self.model.bearings[site];
        let change = |values: &Series| -> Result<f64, SeriesError> {
            let ends = values.at(end)?.zip(values.at(first)?);
            Ok(ends.map_or(f64::NAN, |(end, first)| end - first))
        };
        let of = |run: &History, name: &str| -> Result<f64, SeriesError> {
            let values = channel(run, &format!("{}_{name}", site.name));
            Ok(change(&values)? / change(&run.angle)?)
        };
        let within = |name: &str| -> Result<Vec<f64>, SeriesError> {
            let values = channel(free, &format!("{}_{name}", site.name));
            Ok(values.read(first..end + 1)?.into_owned())
        };
        let mean = |values: Vec<f64>| values.iter().sum::<f64>() / values.len().max(1) as f64;
        let largest = |values: Vec<f64>| {
            values.into_iter().fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a })
        };
        let balls = site.bearing.ball().map_or(0.0, |ball| ball.geometry.balls as f64);
        let (order, rolling_order) = (of(free, "ball_angle")?, of(rolling, "cage_angle")?);
        Ok(CageSpeed {
            bearing: site.name.clone(),
            order,
            rolling_order,
            bpfo: balls * order,
            rolling_bpfo: balls * rolling_order,
            largest_slip: largest(within("cage_slip")?),
            pocket_force: largest(within("pocket_force")?),
            friction_torque: mean(within("friction_torque")?),
            friction_power: mean(within("friction_power")?),
        })
    }
}

/// Spectral radius at high frequencies of the kinematic runs: the default of run-ups.
const RHO_INFINITY: f64 = 0.8;

/// The values of a channel; none without such a channel.
fn channel(history: &History, name: &str) -> Series {
    history.channel(name).map_or_else(Series::default, |channel| channel.values.clone())
}

/// What turns the balls of a kinematic run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum CageDrive {
    Rolling,
    /// The recorded mean angle of the free balls, evenly spaced.
    MeanAngle,
    /// Each ball its own recorded angle.
    EveryBall,
}

/// Angles of free balls over the shaft's angle \[rad\], as recorded.
struct BallAngles {
    shaft: Vec<f64>,
    mean: Vec<f64>,
    /// Of every ball at each angle of the shaft.
    every: Vec<Vec<f64>>,
}

impl BallAngles {
    /// By increasing angle of the shaft, without those at which it stands; `None` for a shaft that reverses, or without
    /// record.
    fn of(history: &History, angle: &[f64], bearing: &str) -> Result<Option<Self>, SeriesError> {
        let mean = channel(history, &format!("{bearing}_ball_angle"));
        let mean = mean.all()?;
        let mut offsets = Vec::new();
        while let Some(found) = history.channel(&format!("{bearing}_{}", ball_offset_name(offsets.len()))) {
            offsets.push(found.values.all()?);
        }
        let spacing = TAU / offsets.len() as f64;
        let points = angle.iter().zip(&*mean).enumerate().map(|(k, (shaft, mean))| {
            let ball = |(j, offset): (usize, &Cow<[f64]>)| mean + j as f64 * spacing + offset[k];
            (*shaft, *mean, offsets.iter().enumerate().map(ball).collect::<Vec<_>>())
        });
        let Some(points) = over_shaft_angle(points.collect(), |(shaft, ..)| *shaft) else { return Ok(None) };
        let mut out = Self { shaft: Vec::new(), mean: Vec::new(), every: Vec::new() };
        for (shaft, mean, every) in points {
            out.shaft.push(shaft);
            out.mean.push(mean);
            out.every.push(every);
        }
        Ok(Some(out))
    }

    fn mean_over_shaft(&self) -> Vec<[f64; 2]> {
        self.shaft.iter().zip(&self.mean).map(|(shaft, mean)| [*shaft, *mean]).collect()
    }

    fn spaced(&self, bearing: &BallBearing) -> Option<SpacedBalls> {
        SpacedBalls::new(bearing, self.shaft.clone(), self.every.clone())
    }
}

/// First and last sample of the last third of the revolutions; `None` unless the shaft turns.
fn last_third(angle: &[f64]) -> Option<[usize; 2]> {
    let (start, last) = (*angle.first()?, angle.len() - 1);
    let turned = angle[last] - start;
    let first = angle.iter().position(|angle| (angle - start).abs() >= SKIPPED * turned.abs())?;
    (turned != 0.0 && first < last).then_some([first, last])
}

/// Points by increasing shaft angle, without those at which the shaft stands; `None` for a shaft that reverses.
fn over_shaft_angle<P>(mut points: Vec<P>, shaft: impl Fn(&P) -> f64) -> Option<Vec<P>> {
    if shaft(points.last()?) < shaft(points.first()?) {
        points.reverse();
    }
    points.dedup_by(|after, before| shaft(after) == shaft(before));
    points.is_sorted_by(|before, after| shaft(before) < shaft(after)).then_some(points)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cage_angles_over_a_shaft_that_turns_either_way_but_not_both() {
        let over = |points: Vec<[f64; 2]>| over_shaft_angle(points, |point| point[0]);
        let forward = vec![[0.0, 0.1], [0.0, 0.1], [1.0, 0.5], [3.0, 1.3]];
        let backward = forward.iter().map(|[shaft, balls]| [-shaft, -balls]).collect();
        assert_eq!(over(forward), Some(vec![[0.0, 0.1], [1.0, 0.5], [3.0, 1.3]]));
        assert_eq!(over(backward), Some(vec![[-3.0, -1.3], [-1.0, -0.5], [0.0, -0.1]]));
        assert_eq!(over(vec![[0.0, 0.0], [1.0, 0.4], [0.5, 0.2]]), None);
    }
}

//! Run-up with free balls beside the same run-up with cages that roll without slip.
//!
//! The kinematic runs cost a small share of that with free balls. One has rolling cages; in the other each cage turns with
//! the recorded mean angle of the free balls, since the level of ball passage also depends on the phase between the cages.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use super::step_error::line_level;
use super::{Machine, Recorder, StudyError};
use crate::model::study::{Integrator, RunUpStudy};
use crate::results::{CageLine, CageSpeed, History, RollingCageComparison};
use crate::transient::run::End;

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
        let Some(stretch) = last_third(history).filter(|_| !free.is_empty()) else { return Ok(None) };
        let [first, end] = stretch;
        let revolutions = (history.angle[end] - history.angle[first]).abs() / TAU;

        let mut model = self.model.clone();
        for site in &free {
            if let Some(bearing) = rolling(*site) {
                model.bearings[*site].bearing = bearing;
            }
        }
        let machine = Self::new(model)?;
        let integrator = Integrator::GeneralisedAlpha { rho_infinity: RHO_INFINITY };
        let study = &RunUpStudy { integrator, ..study.clone() };
        let mut runs = Vec::new();
        for driven in [false, true] {
            let mut reduction = machine.reduce(study)?;
            for site in free.iter().filter(|_| driven) {
                let name = &self.model.bearings[*site].name;
                let angles = channel(history, &format!("{name}_ball_angle"));
                let points = history.angle.iter().zip(angles).map(|(shaft, balls)| [*shaft, *balls]);
                let Some(points) = over_shaft_angle(points.collect()) else { return Ok(None) };
                reduction.system.interfaces[*site].cage_angles = Some(points);
            }
            let mut recorder = Recorder::new(&machine.model, &reduction.system, study.sample_rate);
            let report = machine.run_up(study, &reduction, |sample| {
                recorder.record(sample);
                progress()
            });
            match report.end {
                End::Complete => runs.push(recorder.history),
                End::Stopped => return Ok(None),
                End::Failed(error) => return Err(error.into()),
            }
        }
        let [rolling, driven] = &runs[..] else { return Ok(None) };

        let cages: Vec<CageSpeed> =
            free.iter().map(|site| self.cage_speed(*site, history, rolling, stretch)).collect();
        let mut lines = Vec::new();
        let offset = LINES_BESIDE / revolutions;
        for probe in 0..self.model.probes.len() {
            for order in self.checked_orders() {
                let own = cages.iter().find(|cage| (cage.rolling_bpfo - order).abs() < 1e-6);
                let order_of_run = own.map_or(order, |cage| cage.bpfo);
                if order * revolutions < FEWEST_CYCLES {
                    continue;
                }
                let level = |run: &History, order: f64| {
                    line_level(&run.angle[first..=end], &run.channels[probe].values[first..=end], order)
                };
                lines.extend(self.order_lines(&[order]).into_iter().map(|line| CageLine {
                    channel: history.channels[probe].name.clone(),
                    unit: history.channels[probe].unit.clone(),
                    line,
                    free: level(history, order_of_run),
                    rolling: level(rolling, order),
                    driven: level(driven, order_of_run),
                    noise: 0.5
                        * (level(history, order_of_run - offset) + level(history, order_of_run + offset)),
                }));
            }
        }
        Ok(Some(RollingCageComparison {
            stretch: [history.time[first], history.time[end]],
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
    ) -> CageSpeed {
        let site = &self.model.bearings[site];
        let of = |run: &History, name: &str| -> f64 {
            let turned = run.angle[end] - run.angle[first];
            let values = channel(run, &format!("{}_{name}", site.name));
            values.get(end).zip(values.get(first)).map_or(f64::NAN, |(end, first)| (end - first) / turned)
        };
        let within = |name: &str| {
            let values = channel(free, &format!("{}_{name}", site.name));
            values.get(first..=end).unwrap_or_default().to_vec()
        };
        let mean = |values: Vec<f64>| values.iter().sum::<f64>() / values.len().max(1) as f64;
        let largest = |values: Vec<f64>| {
            values.into_iter().fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a })
        };
        let balls = site.bearing.ball().map_or(0.0, |ball| ball.geometry.balls as f64);
        let (order, rolling_order) = (of(free, "ball_angle"), of(rolling, "cage_angle"));
        CageSpeed {
            bearing: site.name.clone(),
            order,
            rolling_order,
            bpfo: balls * order,
            rolling_bpfo: site.bearing.characteristic_orders().map_or(balls * rolling_order, |c| c.bpfo),
            largest_slip: largest(within("cage_slip")),
            pocket_force: largest(within("pocket_force")),
            friction_torque: mean(within("friction_torque")),
            friction_power: mean(within("friction_power")),
        }
    }
}

/// Spectral radius at high frequencies of the kinematic runs: the default of run-ups.
const RHO_INFINITY: f64 = 0.8;

fn channel<'a>(history: &'a History, name: &str) -> &'a [f64] {
    history.channels.iter().find(|channel| channel.name == name).map_or(&[], |channel| &channel.values)
}

/// First and last sample of the last third of the revolutions; `None` unless the shaft turns.
fn last_third(history: &History) -> Option<[usize; 2]> {
    let (start, last) = (*history.angle.first()?, history.angle.len() - 1);
    let turned = history.angle[last] - start;
    let first = history.angle.iter().position(|angle| (angle - start).abs() >= SKIPPED * turned.abs())?;
    (turned != 0.0 && first < last).then_some([first, last])
}

/// Points by increasing shaft angle, without those at which the shaft stands; `None` for a shaft that reverses.
fn over_shaft_angle(mut points: Vec<[f64; 2]>) -> Option<Vec<[f64; 2]>> {
    if points.last()?[0] < points.first()?[0] {
        points.reverse();
    }
    points.dedup_by(|after, before| after[0] == before[0]);
    points.is_sorted_by(|before, after| before[0] < after[0]).then_some(points)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cage_angles_over_a_shaft_that_turns_either_way_but_not_both() {
        let forward = vec![[0.0, 0.1], [0.0, 0.1], [1.0, 0.5], [3.0, 1.3]];
        let backward = forward.iter().map(|[shaft, balls]| [-shaft, -balls]).collect();
        assert_eq!(over_shaft_angle(forward), Some(vec![[0.0, 0.1], [1.0, 0.5], [3.0, 1.3]]));
        assert_eq!(over_shaft_angle(backward), Some(vec![[-3.0, -1.3], [-1.0, -0.5], [0.0, -0.1]]));
        assert_eq!(over_shaft_angle(vec![[0.0, 0.0], [1.0, 0.4], [0.5, 0.2]]), None);
    }
}

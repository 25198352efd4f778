//! Order cuts over the initial cage phase: run-ups that differ in the cage angles at the start only.

use std::ops::ControlFlow;

use rayon::prelude::*;

use super::order_tracking::is_selected;
use super::{Machine, Recorder, StudyError};
use crate::model::Model;
use crate::model::study::{OrderStudy, RunUpStudy};
use crate::results::{CagePhaseBand, CagePhaseChannel, CagePhaseLine, OrderLine, OrderResult};
use crate::transient::run::End;
use rotordyn_signal::order::OrderCut;

impl Machine {
    /// Range of the order cuts over `study.cage_phases` initial cage phases; `base` are the cuts of the model's own.
    ///
    /// With several ball bearings the first keeps its angle and the cages of the others are turned against it; a single
    /// one is turned against shaft and unbalance, gravity and loads. Equal balls look the same after a pitch 2π/Z, over which the phases are
    /// spread; with unlike balls over 2π. The k-th turned cage takes the phases in steps of k, so that with several all
    /// combinations are sampled evenly. `progress` may stop the runs (`None`).
    ///
    /// # Errors
    /// No equilibrium or no modes at a phase, a run that fails, a record too short for the orders.
    pub fn cage_phase_band(
        &self,
        study: &RunUpStudy,
        orders: &OrderStudy,
        base: &[OrderResult],
        progress: &(dyn Fn() -> ControlFlow<()> + Sync),
    ) -> Result<Option<CagePhaseBand>, StudyError> {
        let turned = turned_bearings(&self.model);
        let own: Vec<f64> = turned.iter().map(|k| self.model.bearings[*k].bearing.cage_angle()).collect();
        let count = study.cage_phases;
        let angles = |phase: usize| -> Vec<f64> {
            let places = turned.iter().zip(&own).enumerate();
            places
                .map(|(k, (site, own))| {
                    let share = (phase * (k + 1) % count) as f64 / count as f64;
                    own + share * self.model.bearings[*site].bearing.cage().map_or(0.0, |cage| cage.period)
                })
                .collect()
        };
        let runs: Vec<Option<Vec<OrderResult>>> = (1..count)
            .into_par_iter()
            .map(|phase| self.orders_with_cages(&turned, &angles(phase), (study, orders), progress))
            .collect::<Result<_, StudyError>>()?;
        let Some(runs) = runs.into_iter().collect::<Option<Vec<_>>>() else { return Ok(None) };
        let channels = base.iter().enumerate().map(|(c, result)| CagePhaseChannel {
            channel: result.channel.clone(),
            unit: result.unit.clone(),
            lines: result
                .cuts
                .iter()
                .map(|(line, cut)| {
                    // Lines of bearings may part in one run and not in another: that of the nearest order.
                    let of_runs = runs.iter().map(|run| nearest_cut(&run[c].cuts, line.order));
                    let levels: Vec<&[f64]> = std::iter::once(cut.rms.as_slice()).chain(of_runs).collect();
                    let over = |pick: fn(f64, f64) -> f64, start: f64| -> Vec<f64> {
                        (0..cut.rms.len()).map(|at| levels.iter().map(|l| l[at]).fold(start, pick)).collect()
                    };
                    CagePhaseLine {
                        line: line.clone(),
                        cut: cut.clone(),
                        minimum: over(f64::min, f64::INFINITY),
                        maximum: over(f64::max, 0.0),
                        peaks: levels.iter().map(|l| l.iter().copied().fold(0.0, f64::max)).collect(),
                    }
                })
                .collect(),
        });
        Ok(Some(CagePhaseBand {
            bearings: turned.iter().map(|k| self.model.bearings[*k].name.clone()).collect(),
            angles: (0..count).map(angles).collect(),
            channels: channels.collect(),
        }))
    }

    /// Bearings with a cage and their cage angle at the start \[rad\].
    pub fn cage_angles(&self) -> Vec<(String, f64)> {
        let bearings = self.model.bearings.iter();
        bearings.filter_map(|site| Some((site.name.clone(), site.bearing.cage()?.angle))).collect()
    }

    /// Order cuts of a run-up with given initial cage angles of some bearings; `None` if stopped.
    fn orders_with_cages(
        &self,
        turned: &[usize],
        angles: &[f64],
        (study, orders): (&RunUpStudy, &OrderStudy),
        progress: &(dyn Fn() -> ControlFlow<()> + Sync),
    ) -> Result<Option<Vec<OrderResult>>, StudyError> {
        let mut model = self.model.clone();
        for (site, angle) in turned.iter().zip(angles) {
            model.bearings[*site].bearing.set_cage_angle(*angle);
        }
        let machine = Self::new(model)?;
        let reduction = machine.reduce(study)?;
        // Of these runs, several at once, only what the orders need is kept.
        let recorder = Recorder::new(&machine.model, &reduction.system, study.sample_rate);
        let mut recorder = recorder.with_channels(|channel| is_selected(channel, &orders.channels));
        let report = machine.run_up(study, &reduction, |sample| {
            recorder.record(sample);
            progress()
        });
        match report.end {
            End::Complete => Ok(Some(machine.orders(orders, &recorder.into_history())?)),
            End::Stopped => Ok(None),
            End::Failed(error) => Err(error.into()),
        }
    }
}

/// Bearings whose cages are turned: all but the first, or the only one.
fn turned_bearings(model: &Model) -> Vec<usize> {
    let with_cage: Vec<usize> =
        (0..model.bearings.len()).filter(|k| model.bearings[*k].bearing.cage().is_some()).collect();
    match with_cage.as_slice() {
        [_, others @ ..] if !others.is_empty() => others.to_vec(),
        _ => with_cage,
    }
}

/// Levels of the cut whose order is nearest.
fn nearest_cut(cuts: &[(OrderLine, OrderCut)], order: f64) -> &[f64] {
    let distance = |cut: &&(OrderLine, OrderCut)| (cut.0.order - order).abs();
    let nearest = cuts.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
    nearest.map_or(&[], |(_, cut)| cut.rms.as_slice())
}

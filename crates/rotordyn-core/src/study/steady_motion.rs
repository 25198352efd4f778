//! Steady motions (attractors) at constant speed: initial states, Poincaré sections, Lyapunov exponent.

use std::ops::ControlFlow;

use nalgebra::DVector;

use super::milestone::Milestone;
use super::settled_run::{Criteria, SettledRun, SettledSnapshot, SettledStart};
use super::{Machine, StudyError};
use crate::analysis::equilibrium::{CageTreatment, equilibrium};
use crate::element::Anchor;
use crate::model::study::{LyapunovStudy, Plane, PoincareStudy, SectionTrigger, SteadyRunSettings};
use crate::model::{BearingSite, Model, Probe, SpeedProfile};
use crate::results::{
    LyapunovResult, PlaneSection, PoincareResult, RecordedPeriods, SectionChannel, SectionClock,
    SteadyMotion, Whirl, is_rotation, unit_of,
};
use crate::transient::channels::Channel;
use crate::transient::reduction::{Reduction, reduce};
use crate::transient::steady::{SteadyRun, SteadySnapshot, SteadyStart, run_steady_from};
use crate::transient::system::State;
use rotordyn_signal::lyapunov::lyapunov_exponent;
use rotordyn_signal::motion_classification::classify_motion;
use rotordyn_signal::orbit::FilteredOrbit;
use rotordyn_signal::poincare::{StroboscopicSampling, cluster_points};
use serde::{Deserialize, Serialize};

/// Number of periods of the orbit stored with its section.
pub(super) const ORBIT_PERIODS: usize = 32;

/// Restart state: final free DOFs and angles of a run, from which a run of another model can start.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RestartState {
    displacement: Vec<f64>,
    velocity: Vec<f64>,
    /// Accumulated shaft angle and cage angles of the bearings \[rad\], not reduced to one turn: a ball's
    /// spin repeats with neither.
    shaft: f64,
    cages: Vec<f64>,
    /// Positions and velocities of the internal coordinates of bearings \[m, m/s\].
    internal: [Vec<f64>; 2],
    /// States of free bodies of bearings.
    bodies: Vec<f64>,
}

/// Callback after every period of the clock with the completed fraction; can stop the run.
pub type Progress<'a> = &'a mut dyn FnMut(f64) -> ControlFlow<()>;

impl Machine {
    /// Orbits and Poincaré sections at constant speed, with the motion classified; `None` when stopped.
    ///
    /// # Errors
    /// No equilibrium, or a run that fails.
    pub fn poincare(
        &self,
        study: &PoincareStudy,
        progress: Progress,
    ) -> Result<Option<PoincareResult>, StudyError> {
        let found = self.poincare_from(study, None, &mut |now| progress(now.share))?;
        Ok(found.filter(|found| found.partial.is_none()))
    }

    /// As [`Self::poincare`], from a snapshot of an earlier run; when stopped with what is recorded by then, marked as
    /// partial, or `None` if that is less than eight periods.
    ///
    /// # Errors
    /// As [`Self::poincare`], and a snapshot of another machine.
    pub fn poincare_from(
        &self,
        study: &PoincareStudy,
        snapshot: Option<SettledSnapshot>,
        progress: &mut dyn FnMut(&Milestone<SettledSnapshot>) -> ControlFlow<()>,
    ) -> Result<Option<PoincareResult>, StudyError> {
        let steady = &study.steady;
        let probes: Vec<&Probe> = study.planes.iter().flat_map(|p| [&p.x, &p.y]).collect();
        let (reduction, state) = self.steady_initial_state(steady, None)?;
        let channels: Vec<SectionChannel> = probes.iter().map(|probe| section_channel(probe)).collect();
        let criteria =
            Criteria { tolerance: study.tolerance, longest_period: study.longest_period, perturbation: None };
        let start = match snapshot {
            Some(snapshot) => SettledStart::Snapshot(Box::new(snapshot)),
            None => SettledStart::State(Box::new(state)),
        };
        let settled =
            self.settled_run(&reduction, start, steady, (&probes, &channels), criteria, progress)?;
        let Some(SettledRun { run, strobe, motion, complete }) = settled else { return Ok(None) };
        let reach: Vec<f64> =
            orbit_sizes(&motion.extremes, &channels).iter().map(|size| study.tolerance * size).collect();
        let all: Vec<&[f64]> = motion.sections.iter().map(Vec::as_slice).collect();
        let groups = cluster_points(&all, &reach)?.len();
        // The orbit's last whole periods.
        let (from, to) = {
            let end = strobe.positions.len() - 1;
            (strobe.positions[end - ORBIT_PERIODS.min(end)], strobe.positions[end])
        };
        let kept = from.floor() as usize..=to.ceil() as usize;
        let shaft_angle = run.shaft_angle[kept.clone()].to_vec();
        let planes = study.planes.iter().enumerate().map(|(k, plane)| {
            let orbit = [2 * k, 2 * k + 1].map(|c| run.channels[c][kept.clone()].to_vec());
            let proper = is_orbit(plane);
            let [x, y] = [&run.channels[2 * k], &run.channels[2 * k + 1]];
            PlaneSection {
                name: plane.name.clone(),
                axes: [&plane.x, &plane.y].map(section_channel),
                whirl: proper.then(|| whirl(&orbit, [x, y], &run.shaft_angle)).flatten(),
                clearance: clearance(&self.model, plane).filter(|_| proper),
                orbit,
                sample_rate: 1.0 / run.step,
                section: [2 * k, 2 * k + 1].map(|c| motion.sections[c].clone()),
            }
        });
        let planes = planes.collect();
        Ok(Some(PoincareResult {
            speed: steady.speed,
            clock: section_clock(&self.model, steady, motion.frequency),
            motion: motion.motion,
            transient_periods: motion.transient_periods,
            groups,
            shaft_angle,
            planes,
            partial: (!complete)
                .then_some(RecordedPeriods { recorded: run.periods, requested: steady.periods }),
        }))
    }

    /// Largest Lyapunov exponent at constant speed; `None` when stopped by `progress`.
    ///
    /// # Errors
    /// No equilibrium, or a run that fails.
    pub fn lyapunov(
        &self,
        study: &LyapunovStudy,
        progress: Progress,
    ) -> Result<Option<LyapunovResult>, StudyError> {
        let found = self.lyapunov_from(study, None, &mut |now| progress(now.share))?;
        Ok(found.filter(|found| found.partial.is_none()))
    }

    /// As [`Self::lyapunov`], from a snapshot of an earlier run; when stopped with the periods recorded by then, marked
    /// as partial, or `None` without any.
    ///
    /// # Errors
    /// As [`Self::lyapunov`], and a snapshot of another machine.
    pub fn lyapunov_from(
        &self,
        study: &LyapunovStudy,
        snapshot: Option<SteadySnapshot>,
        progress: &mut dyn FnMut(&Milestone<SteadySnapshot>) -> ControlFlow<()>,
    ) -> Result<Option<LyapunovResult>, StudyError> {
        let steady = &study.steady;
        let (reduction, state) = self.steady_initial_state(steady, None)?;
        let start = match snapshot {
            Some(snapshot) => SteadyStart::Snapshot(Box::new(snapshot)),
            None => SteadyStart::State(Box::new(state)),
        };
        let mut stopped = false;
        let perturbation = Some(study.perturbation);
        let run = self.steady_run(&reduction, start, steady, (&[], perturbation), &mut |now| {
            let flow = progress(now);
            stopped |= flow.is_break();
            flow
        })?;
        if stopped && run.log_growth.is_empty() {
            return Ok(None);
        }
        let time: f64 = run.intervals.iter().sum();
        let clock = section_clock(&self.model, steady, run.intervals.len() as f64 / time);
        let exponent = lyapunov_exponent(&run.log_growth, &run.intervals)?;
        let partial = stopped.then_some(RecordedPeriods { recorded: run.periods, requested: steady.periods });
        Ok(Some(LyapunovResult { speed: steady.speed, clock, exponent, partial }))
    }

    /// The machine reduced at a constant speed, and the initial state: static equilibrium, or the restart
    /// state of a run of a model with the same numbers of DOFs and bearings.
    ///
    /// # Errors
    /// No equilibrium, or no modes.
    pub fn steady_initial_state(
        &self,
        steady: &SteadyRunSettings,
        carried: Option<&RestartState>,
    ) -> Result<(Reduction, State), StudyError> {
        if let Some(machine) = self.decided(&[steady.speed])? {
            return machine.steady_initial_state(steady, carried);
        }
        self.check_tables("steady motion", &[steady.speed])?;
        let cage = CageTreatment::FixedAngle;
        let static_equilibrium = equilibrium(
            &self.model,
            &self.assembly,
            steady.speed,
            cage,
            Some(&self.standstill_equilibrium.q),
        )?;
        let mut reduction = reduce(&self.model, &self.assembly, &static_equilibrium, steady.cutoff)?;
        let system = &mut reduction.system;
        system.curve = SpeedProfile::Constant { speed: steady.speed, duration: f64::INFINITY }.curve();
        system.drive = None;
        let n = self.assembly.dofs.len();
        let fits = |c: &&RestartState| {
            c.displacement.len() == n
                && c.cages.len() == system.interfaces.len()
                && c.internal[0].len() == system.internal_masses.len()
                && c.bodies.len() == system.body_states()
        };
        let state = match carried.filter(fits) {
            None => {
                let x = reduction.equilibrium.clone();
                let v = &x * 0.0;
                system.initial_state(x, v)?
            }
            Some(carried) => {
                // Vᵀ M q: projection on this model's basis.
                let project = |q: &[f64], internal: &[f64]| {
                    let x = reduction.basis.tr_mul(&DVector::from_vec(self.assembly.mass.mul(q)));
                    let internal =
                        internal.iter().zip(&system.internal_masses).map(|(y, mass)| mass.sqrt() * y);
                    DVector::from_iterator(system.size(), x.iter().copied().chain(internal))
                };
                let time = carried.shaft / steady.speed;
                let x = project(&carried.displacement, &carried.internal[0]);
                let v = project(&carried.velocity, &carried.internal[1]);
                system.state_at(time, &carried.cages, &carried.bodies, [x, v])?
            }
        };
        Ok((reduction, state))
    }

    /// A run of the reduced machine, recording probes; with fewer periods when stopped.
    pub(super) fn steady_run(
        &self,
        reduction: &Reduction,
        start: SteadyStart,
        steady: &SteadyRunSettings,
        (probes, perturbation): (&[&Probe], Option<f64>),
        progress: &mut dyn FnMut(&Milestone<SteadySnapshot>) -> ControlFlow<()>,
    ) -> Result<SteadyRun, StudyError> {
        let channel = |probe: &&Probe| {
            let mut row = vec![0.0; self.assembly.dofs.len()];
            self.assembly.direction_row(&probe.at, &probe.direction).add_to(1.0, &mut row);
            Channel { name: probe.name.clone(), row: reduction.row(row), quantity: probe.quantity }
        };
        let channels: Vec<Channel> = probes.iter().map(channel).collect();
        let total = (steady.transient_periods + steady.periods) as f64;
        let recorded = (&channels[..], perturbation);
        Ok(run_steady_from(&reduction.system, start, steady, recorded, &mut |now| {
            progress(&Milestone::new(now.periods as f64 / total, &|| now.snapshot()))
        })?)
    }
}

impl RestartState {
    /// Restart state from the end of a run.
    pub fn new(reduction: &Reduction, state: &State) -> Self {
        let full = |x: &DVector<f64>| reduction.expand(x).as_slice().to_vec();
        let rows = reduction.system.rows();
        Self {
            displacement: full(&state.x),
            velocity: full(&state.v),
            shaft: state.spin.angle,
            internal: [&state.d, &state.d_rate].map(|d| d[rows..].to_vec()),
            bodies: state.bodies.clone(),
            cages: state.rotations.iter().map(|r| r.cage_angle).collect(),
        }
    }
}

/// Poincaré sections, extremes and classification of a recorded run; the strobe has one instant more than the
/// sections, the end of the last period.
pub(super) fn sections(
    run: &SteadyRun,
    channels: &[SectionChannel],
    steady: &SteadyRunSettings,
    tolerance: f64,
    longest: usize,
) -> Result<(StroboscopicSampling, SteadyMotion), StudyError> {
    let mut strobe = StroboscopicSampling::new(&run.phase, steady.phase, std::f64::consts::TAU)?;
    // The margins contain no further instant, unless the clock speed varies strongly.
    strobe.positions.truncate(steady.periods + 1);
    let whole = |channel: &Vec<f64>| -> Result<Vec<f64>, StudyError> {
        let mut points = strobe.section(channel)?;
        points.truncate(steady.periods);
        Ok(points)
    };
    let found: Vec<Vec<f64>> = run.channels.iter().map(whole).collect::<Result<_, _>>()?;
    let extreme = |channel: &Vec<f64>| {
        channel.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| [v.min(l), v.max(h)])
    };
    let extremes: Vec<[f64; 2]> = run.channels.iter().map(extreme).collect();
    let sizes = orbit_sizes(&extremes, channels);
    let slices: Vec<&[f64]> = found.iter().map(Vec::as_slice).collect();
    let motion = classify_motion(&slices, &sizes, tolerance, longest)?;
    let exponent = match run.log_growth[..] {
        [] => None,
        _ => Some(lyapunov_exponent(&run.log_growth, &run.intervals)?),
    };
    let (first, last) = (strobe.positions[0], strobe.positions[strobe.positions.len() - 1]);
    let frequency = (strobe.positions.len() - 1) as f64 / ((last - first) * run.step);
    let transient_periods = steady.transient_periods;
    Ok((strobe, SteadyMotion { sections: found, extremes, frequency, motion, transient_periods, exponent }))
}

/// Reference size of a channel: the largest peak-to-peak value of all channels of the same unit, so that
/// channels with little motion are not judged by their own small range.
pub(super) fn orbit_sizes(extremes: &[[f64; 2]], channels: &[SectionChannel]) -> Vec<f64> {
    let largest_range = |c: &SectionChannel| {
        let same = extremes.iter().zip(channels).filter(|(_, other)| other.unit == c.unit);
        same.map(|([l, h], _)| h - l).fold(0.0, f64::max)
    };
    channels.iter().map(largest_range).collect()
}

pub(super) fn section_channel(probe: &Probe) -> SectionChannel {
    let unit = unit_of(probe.quantity, is_rotation(&probe.direction)).into();
    SectionChannel { name: probe.name.clone(), unit }
}

/// Whether a plane shows x and y of one point, the shaft orbit.
fn is_orbit(plane: &Plane) -> bool {
    let along =
        |probe: &Probe, axis: usize| (0..6).all(|k| probe.direction[k] == if k == axis { 1.0 } else { 0.0 });
    let (x, y) = (&plane.x, &plane.y);
    x.at == y.at && x.quantity == y.quantity && along(x, 0) && along(y, 1)
}

/// Whirl direction of an orbit, and the 1x component of the whole record; `None` without motion or with less than one turn.
fn whirl([x, y]: &[Vec<f64>; 2], record: [&Vec<f64>; 2], shaft_angle: &[f64]) -> Option<Whirl> {
    let once = FilteredOrbit::fit_hann(record[0], record[1], shaft_angle, 1.0).ok()?;
    let mean = |v: &[f64]| v.iter().sum::<f64>() / v.len() as f64;
    let (mx, my) = (mean(x), mean(y));
    let (mut net, mut all) = (0.0, 0.0);
    for k in 1..x.len() {
        let (a, b) = ((x[k - 1] - mx, y[k - 1] - my), (x[k] - mx, y[k] - my));
        let swept = a.0 * b.1 - a.1 * b.0;
        net += swept;
        all += swept.abs();
    }
    (all > 0.0).then(|| Whirl { forwardness: net / all, synchronous: once })
}

/// Radial clearance circle of the ball bearing at a plane's point, P_d/2; for a fixed housing only, where the
/// orbit is relative to the outer ring.
fn clearance(model: &Model, plane: &Plane) -> Option<f64> {
    let here = |site: &&BearingSite| plane.x.at == Anchor::node(site.node) && site.housing.node.is_none();
    let ball = model.bearings.iter().find(here)?.bearing.ball()?;
    Some(0.5 * ball.geometry.radial_clearance).filter(|c| *c > 0.0)
}

fn section_clock(model: &Model, steady: &SteadyRunSettings, frequency: f64) -> SectionClock {
    SectionClock { name: clock_name(model, steady.trigger), phase: steady.phase, frequency }
}

/// Name of a clock.
pub(super) fn clock_name(model: &Model, clock: SectionTrigger) -> String {
    match clock {
        SectionTrigger::Shaft => "shaft revolution".into(),
        SectionTrigger::Cage { bearing } => format!("cage revolution of {}", model.bearings[bearing].name),
        SectionTrigger::BallPass { bearing, .. } => {
            format!("ball passage of {}", model.bearings[bearing].name)
        }
    }
}

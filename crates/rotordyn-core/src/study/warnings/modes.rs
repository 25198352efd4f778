//! Modes: unstable, lost or uncertain.

use super::supports::standstill_and_top;
use crate::analysis::campbell::{Branch, Campbell};
use crate::analysis::critical_speed::{CriticalSpeed, UnstableMode};
use crate::analysis::divergence::{Divergence, divergence};
use crate::analysis::stability::{Threshold, is_unstable};
use crate::analysis::table_range::speed_range;
use crate::analysis::{Mode, ModeKind, modal};
use crate::assembly::PhysicsError;
use crate::document::{TO_RPM, number};
use crate::results::CriticalResult;
use crate::study::{Machine, Results};
use crate::warning::{Code, Warning};
use rotordyn_linalg::Complex64;

/// Elements of the shaft in half a wave of a bending mode, below which its frequency is wrong by more than about 1 %.
const ELEMENTS_PER_HALF_WAVE: usize = 2;
/// Modes looked at for stability in studies that do not show them.
const MODES: usize = 12;

impl Machine {
    /// A motion that grows without oscillation at standstill, else at the highest of the speeds \[rad/s\].
    pub(super) fn divergence_warning(&self, speeds: &[f64]) -> Option<Warning> {
        standstill_and_top(speeds).into_iter().rev().find_map(|speed| {
            // What cannot be linearised is an error of the study itself.
            let found = divergence(&self.assembly, &self.linear_system(speed).ok()?)?;
            let at =
                if speed == 0.0 { "at standstill".into() } else { format!("at {:.0} rpm", speed * TO_RPM) };
            let Divergence { rate, motion } = found;
            let text = format!(
                "the static equilibrium {at} is unstable: {motion} diverges with e^(λt), λ = {} 1/s",
                number(rate, 4)
            );
            Some(Warning::new(Code::StaticInstability, "", text))
        })
    }

    /// Unstable modes in the studies of steady responses and critical speeds, whose results do not show them.
    pub(super) fn unstable_mode_warnings(&self, results: &Results) -> Result<Vec<Warning>, PhysicsError> {
        let mut found = Vec::new();
        let studies = &self.model.studies;
        if let (Some(frf), Some(study)) = (&results.frf, &studies.frf) {
            let (item, consequence) = ("study.frf", "frequency responses do not exist");
            found.extend(match &frf.least_damped {
                Some(mode) if mode.damping_ratio < 0.0 => {
                    Some(unstable(item, consequence, frf.speed, &mode.label, mode.damping_ratio))
                }
                Some(_) => None,
                None => self.unstable_at(item, consequence, [study.speed])?,
            });
        }
        if let Some(unbalance) = &results.unbalance
            && let Some([low, high]) = studies.unbalance.as_ref().and_then(|study| speed_range(&study.speeds))
        {
            let (item, consequence) = ("study.unbalance", "the steady response does not exist");
            found.extend(match &unbalance.unstable {
                Some(mode) => Some(unstable_mode(item, consequence, mode)),
                // Modes above the search for the peaks.
                None => self.unstable_at(item, consequence, [low, 0.5 * (low + high), high])?,
            });
        }
        if let Some(critical) = &results.critical {
            let (item, speeds) = ("study.critical", [0.5 * critical.max_speed, critical.max_speed]);
            let consequence = "critical speeds above it are not reached";
            let at_speeds = match critical.crossings.unstable.first() {
                Some(mode) => Some(unstable_mode(item, consequence, mode)),
                // Modes above the search for crossings.
                None => self.unstable_at(item, consequence, speeds)?,
            };
            // Stable there, but not in between.
            let first = || unstable_crossings(&critical.crossings.list).next();
            found.extend(at_speeds.or_else(|| first().map(|crossing| unstable_crossing(item, crossing))));
        }
        Ok(found)
    }

    /// The least stable mode at the first of the speeds at which there is an unstable one.
    fn unstable_at(
        &self,
        item: &str,
        consequence: &str,
        speeds: impl IntoIterator<Item = f64>,
    ) -> Result<Option<Warning>, PhysicsError> {
        for speed in speeds {
            let modes = modal::modes(&self.assembly, &self.linear_system(speed)?, MODES)?;
            let growing = modes.iter().filter(|mode| is_unstable(mode.eigenvalue));
            let least = growing.min_by(|a, b| a.zeta().total_cmp(&b.zeta()));
            let found = least.map(|mode| unstable(item, consequence, speed, &mode.label, mode.zeta()));
            if found.is_some() {
                return Ok(found);
            }
        }
        Ok(None)
    }

    /// The lowest bending mode that is too short for the mesh, in the modes of a study.
    fn mesh_limit<'m>(&self, item: &str, modes: impl Iterator<Item = &'m Mode>) -> Option<Warning> {
        if self.model.rigid_rotor.is_some() {
            return None;
        }
        let nodes = self.model.node_z.len();
        let (mode, elements) = modes
            .filter(|mode| !matches!(mode.kind, ModeKind::Body | ModeKind::Axial | ModeKind::Torsional))
            .filter_map(|mode| Some((mode, shortest_half_wave(&mode.full_shape[..6 * nodes])?)))
            .filter(|(_, elements)| *elements < ELEMENTS_PER_HALF_WAVE)
            .min_by(|a, b| a.0.natural_omega().total_cmp(&b.0.natural_omega()))?;
        let text = format!(
            "{} at {:.1} Hz has half a wave in {elements} element{} of the shaft: its frequency is too high by more than \
             about 1 %, and higher modes by more",
            mode.label,
            mode.frequency_hz(),
            if elements == 1 { "" } else { "s" }
        );
        Some(Warning::new(Code::MeshLimit, item, text))
    }

    pub(super) fn mesh_warnings(&self, results: &Results) -> Vec<Warning> {
        let modal = results.modal.first().and_then(|at| self.mesh_limit("study.modal", at.modes.iter()));
        let at_rest = results.campbell.iter().flat_map(|found| &found.diagram.branches);
        let first = at_rest.filter_map(|branch| branch.modes.first()?.as_ref());
        modal.or_else(|| self.mesh_limit("study.campbell", first)).into_iter().collect()
    }
}

/// The warning of an unstable mode at a speed \[rad/s\] with the damping ratio ζ.
fn unstable(item: &str, consequence: &str, speed: f64, label: &str, zeta: f64) -> Warning {
    let (rpm, zeta) = (speed * TO_RPM, 100.0 * zeta);
    let text = format!("{label} is unstable at {rpm:.0} rpm (zeta = {zeta:.3} %): {consequence}");
    Warning::new(Code::UnstableMode, item, text)
}

fn unstable_mode(item: &str, consequence: &str, mode: &UnstableMode) -> Warning {
    let label = if mode.label.is_empty() { "a mode" } else { &mode.label };
    unstable(item, consequence, mode.speed, label, mode.damping_ratio)
}

/// Crossings of unstable modes with order lines.
fn unstable_crossings(list: &[CriticalSpeed]) -> impl Iterator<Item = &CriticalSpeed> {
    list.iter().filter(|crossing| is_unstable(crossing.mode.eigenvalue))
}

fn unstable_crossing(item: &str, CriticalSpeed { speed, order, mode }: &CriticalSpeed) -> Warning {
    let (label, rpm, zeta) = (&mode.label, speed * TO_RPM, 100.0 * mode.zeta());
    let text =
        format!("{label} is unstable where it crosses order {order}, at {rpm:.0} rpm: zeta = {zeta:.3} %");
    Warning::new(Code::UnstableMode, item, text)
}

/// Number of elements between two successive sign changes of a shaft's deflection, the smallest; `None` with fewer than
/// two sign changes. `shape`: complex displacements, six per node.
fn shortest_half_wave(shape: &[Complex64]) -> Option<usize> {
    /// Deflection below which a node counts as one of zero deflection, as a share of the largest.
    const SMALL: f64 = 0.02;
    /// Half waves lower than this share of the largest deflection do not count.
    const HIGH: f64 = 0.2;
    let size = |axis: usize| shape.iter().skip(axis).step_by(6).map(|u| u.re.abs()).fold(0.0, f64::max);
    let axis = if size(1) > size(0) { 1 } else { 0 };
    let largest = size(axis);
    // Number of nodes between two sign changes, and the largest deflection there.
    let mut waves: Vec<(usize, f64)> = vec![(0, 0.0)];
    let mut last = 0.0;
    for deflection in shape.iter().skip(axis).step_by(6).map(|u| u.re) {
        if deflection.abs() > SMALL * largest {
            if last * deflection < 0.0 {
                waves.push((0, 0.0));
            }
            last = deflection;
        }
        if let Some((nodes, height)) = waves.last_mut() {
            *nodes += 1;
            *height = deflection.abs().max(*height);
        }
    }
    // Those at the ends of the shaft are not complete.
    let inner = waves.get(1..waves.len().saturating_sub(1)).unwrap_or_default();
    inner.iter().filter(|(_, height)| *height > HIGH * largest).map(|(nodes, _)| *nodes).min()
}

/// A branch with its thresholds and the ranges of speeds in which it is unstable \[rad/s\].
type UnstableBranch<'r> = (&'r Branch, Vec<f64>, Vec<[f64; 2]>);

/// Ranges of speeds in which a branch of a diagram is unstable, the last one without an end if it is so at the last speed at which
/// it is known: between its thresholds, else those of the diagram.
fn unstable_ranges(diagram: &Campbell, branch: usize, thresholds: &[&Threshold]) -> Vec<[f64; 2]> {
    let modes = diagram.speeds.iter().zip(&diagram.branches[branch].modes);
    let known =
        modes.filter_map(|(speed, mode)| Some((*speed, is_unstable(mode.as_ref()?.eigenvalue), false)));
    let turns = thresholds.iter().map(|threshold| (threshold.speed, threshold.unstable_above, true));
    let mut known: Vec<(f64, bool, bool)> = turns.chain(known).collect();
    known.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut ranges: Vec<[f64; 2]> = Vec::new();
    let mut is_open = false;
    for (speed, grows, is_threshold) in known {
        match ranges.last_mut().filter(|_| is_open && (grows || is_threshold)) {
            Some(range) => range[1] = speed,
            None if grows => ranges.push([speed; 2]),
            None => {}
        }
        is_open = grows;
    }
    if let Some(range) = ranges.last_mut().filter(|_| is_open) {
        range[1] = f64::INFINITY;
    }
    ranges
}

pub(super) fn warnings(results: &Results) -> Vec<Warning> {
    let mut found = Vec::new();
    if let Some(result) = &results.campbell {
        let diagram = &result.diagram;
        let ranges = |(at, branch)| {
            let own = result.thresholds.iter().filter(|threshold| threshold.branch == Some(at));
            let own: Vec<&Threshold> = own.collect();
            let ranges = unstable_ranges(diagram, at, &own);
            (branch, own.iter().map(|threshold| threshold.speed).collect(), ranges)
        };
        let unstable: Vec<UnstableBranch> = diagram
            .branches
            .iter()
            .enumerate()
            .map(ranges)
            .filter(|(.., ranges)| !ranges.is_empty())
            .collect();
        found.extend(unstable.iter().map(|(branch, thresholds, ranges)| {
            // A threshold is known more exactly than the distance of the speeds of the diagram.
            let rpm = |speed: &f64| match thresholds.contains(speed) {
                true => format!("{:.1}", speed * TO_RPM),
                false => format!("{:.0}", speed * TO_RPM),
            };
            let range = |[from, to]: &[f64; 2]| match () {
                () if to.is_infinite() && thresholds.contains(from) => format!("above {} rpm", rpm(from)),
                () if to.is_infinite() => format!("from {} rpm on", rpm(from)),
                () if from == to => format!("at {} rpm", rpm(from)),
                () => format!("from {} to {} rpm", rpm(from), rpm(to)),
            };
            let ranges = ranges.iter().map(range).collect::<Vec<_>>().join(" and ");
            let text = format!("{} is unstable {ranges}", branch.label);
            Warning::new(Code::UnstableMode, "study.campbell", text)
        }));
        // Stable at the speeds of the diagram, but not in between.
        let mut named: Vec<&String> = unstable.iter().map(|(branch, ..)| &branch.label).collect();
        for crossing in results.campbell.iter().flat_map(|found| unstable_crossings(&found.crossings.list)) {
            if !named.contains(&&crossing.mode.label) {
                named.push(&crossing.mode.label);
                found.push(unstable_crossing("study.campbell", crossing));
            }
        }
    }
    for at in &results.modal {
        for mode in at.modes.iter().filter(|mode| is_unstable(mode.eigenvalue)) {
            let (speed, zeta) = (at.speed * TO_RPM, 100.0 * mode.zeta());
            let text = format!("{} is unstable at {speed:.0} rpm: zeta = {zeta:.3} %", mode.label);
            found.push(Warning::new(Code::UnstableMode, "study.modal", text));
        }
    }
    let of_campbell = results.campbell.as_ref().map(|found| ("study.campbell", &found.crossings));
    let of_critical =
        results.critical.as_ref().map(|CriticalResult { crossings, .. }| ("study.critical", crossings));
    for (item, list) in of_campbell.into_iter().chain(of_critical) {
        found.extend(list.uncertain.iter().map(|range| {
            let text = format!(
                "crossings of order {} between {:.1} and {:.1} rpm may be missing: the modes change faster with speed than \
                 the search can follow",
                range.order,
                range.from * TO_RPM,
                range.to * TO_RPM
            );
            Warning::new(Code::CrossingUncertain, item, text)
        }));
    }
    if let Some(diagram) = results.campbell.as_ref().map(|found| &found.diagram) {
        found.extend(diagram.branches.iter().filter_map(|branch| {
            let mut turning = diagram.speeds.iter().zip(&branch.modes).filter(|(speed, _)| **speed != 0.0);
            let first = turning.next()?.1.as_ref()?;
            let last = branch.modes.last()?.as_ref()?;
            (family(first.kind) != family(last.kind)).then(|| {
                let text =
                    format!("the branch {} is called {} at the end of the diagram", branch.label, last.label);
                Warning::new(Code::BranchLabel, "study.campbell", text)
            })
        }));
        found.extend(diagram.lost.iter().map(|lost| {
            let [from, to] = lost.speeds.map(|speed| speed * TO_RPM);
            let label = |branch: usize| diagram.branches[branch].label.as_str();
            let continued = match lost.continued_by {
                Some(next) => format!("a new branch starts as {}", label(next)),
                None => "it ends there".into(),
            };
            let text = format!(
                "the branch {} cannot be followed from {from:.0} to {to:.0} rpm (no mode of similar shape): {continued}",
                label(lost.branch)
            );
            Warning::new(Code::BranchLost, "study.campbell", text)
        }));
    }
    found
}

/// Kinds between which a branch does not change without another mode near it.
fn family(kind: ModeKind) -> u8 {
    match kind {
        ModeKind::Forward | ModeKind::Backward | ModeKind::Mixed | ModeKind::PlaneX | ModeKind::PlaneY => 0,
        ModeKind::Torsional => 1,
        ModeKind::Axial => 2,
        ModeKind::Body => 3,
    }
}

//! All crossings of the modes with order lines over a range of speeds.
//!
//! The modes at each speed, sorted by damped frequency, are continuous functions of speed whichever mode has which
//! index. The k-th frequency therefore crosses an order line between two speeds where the number N of modes below the
//! line differs: for every index between both numbers one crossing is refined. No mode has to be tracked.
//!
//! Two crossings within one step leave N unchanged. With constant bearings N at the end is compared with the number
//! of undamped modes, which cannot decrease with speed; otherwise steps are halved until N changes in one direction
//! only and no frequency turns towards the line within a step.

use super::spectrum::{HEAVY_REACH, Spectrum, is_heavily_damped, takes_part};
use super::{CriticalSpeed, CrossingList, Tangents, UncertainRange, refine, undamped};
use crate::analysis::campbell::EXTRA_MODES;
use crate::analysis::modal::{self, Eigenpair};
use crate::analysis::mode_kind;
use crate::assembly::{Assembly, LinearSystem, PhysicsError};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::ops::Range;

/// Modes with |λ| up to this multiple of the highest order line are computed: damping ratios up to 0.6.
const REACH: f64 = 1.25;
/// A mode lies on an order line within this relative difference of frequencies.
const ON_LINE: f64 = 1e-8;
/// Least distance of a crossing from the next one and from the ends of its step, as a fraction of the step.
const APART: f64 = 1e-5;
/// Largest distance from an order line, relative to it, that may be round-off of a low mode.
const ROUND_OFF: f64 = 1e-4;
/// Largest number of halvings of a step in which N changes twice.
const MAX_HALVINGS: usize = 6;
/// Largest number of halvings of a step to separate its crossings, before each is bracketed.
const MAX_BISECTIONS: usize = 4;
const MAX_BRACKETINGS: usize = 80;
/// Frequencies below this \[rad/s\] are rigid-body modes, see [`krylov`](rotordyn_linalg::krylov).
const RIGID_BODY: f64 = 1e-3 * modal::SHIFT;

/// Number of modes below every order line at one speed.
struct AllBelow {
    /// `None` at standstill.
    system: Option<LinearSystem>,
    counts: Vec<usize>,
}

/// Search with one set of orders.
pub(super) struct Search<'a, T> {
    assembly: &'a Assembly,
    tangents: &'a T,
    highest_order: f64,
    /// Number of modes searched at every speed, by frequency; `None`: all.
    limit: Option<usize>,
}

/// Crossings in a step in which every index has one at most.
type ByIndex = BTreeMap<usize, CriticalSpeed>;

/// Crossings of a step, and where others could not be located.
#[derive(Default)]
struct Found {
    list: Vec<CriticalSpeed>,
    missing: Vec<UncertainRange>,
}

/// Where a frequency passes an order line.
enum Passage {
    /// At this speed, within a relative distance from the line.
    Crossing(f64, f64),
    /// It jumps over the line, as a mode below begins or ceases to take part.
    Jump,
}

impl<'a, T: Tangents> Search<'a, T> {
    pub fn new(assembly: &'a Assembly, tangents: &'a T, orders: &[f64], limit: Option<usize>) -> Self {
        let highest_order = orders.iter().copied().fold(0.0, f64::max);
        Self { assembly, tangents, highest_order, limit }
    }

    /// Eigenvalues at increasing speeds.
    pub fn spectra(&self, speeds: &[f64]) -> Result<Vec<Spectrum>, PhysicsError> {
        let Some(&top) = speeds.last() else { return Ok(Vec::new()) };
        let expected = match self.limit {
            Some(_) => 0,
            None => {
                let system = self.system(top)?;
                // And the one beyond.
                modal::undamped_modes_below(&system, REACH * self.highest_order * top) + 1
            }
        };
        let highest = self.spectrum(top, expected.max(8))?;
        let guess = |speed: f64| {
            let reach = REACH * self.highest_order * speed;
            highest.values.iter().filter(|value| value.norm() < reach).count() + 2
        };
        let lower = &speeds[..speeds.len() - 1];
        let mut spectra: Vec<Spectrum> =
            lower.par_iter().map(|&s| self.spectrum(s, guess(s))).collect::<Result<_, PhysicsError>>()?;
        spectra.push(highest);
        Ok(spectra)
    }

    /// These spectra and those at further speeds between them, in order.
    pub fn with_speeds(
        &self,
        mut spectra: Vec<Spectrum>,
        further: &[f64],
    ) -> Result<Vec<Spectrum>, PhysicsError> {
        let (Some(first), Some(last)) = (spectra.first(), spectra.last()) else { return Ok(spectra) };
        let inside = |speed: &f64| *speed > first.speed && *speed < last.speed;
        let is_new = |speed: &f64| spectra.iter().all(|at| at.speed != *speed);
        let speeds: Vec<f64> = further.iter().copied().filter(|s| inside(s) && is_new(s)).collect();
        let count = spectra.iter().map(|at| at.values.len()).max().unwrap_or(0) + 1;
        let more: Vec<Spectrum> = speeds
            .par_iter()
            .map(|&speed| self.spectrum(speed, count))
            .collect::<Result<_, PhysicsError>>()?;
        spectra.extend(more);
        spectra.sort_by(|a, b| a.speed.total_cmp(&b.speed));
        spectra.dedup_by(|a, b| a.speed == b.speed);
        Ok(spectra)
    }

    /// Eigenvalues at a speed: all below the highest order line and one above it, or as many as are searched.
    pub fn spectrum(&self, speed: f64, guess: usize) -> Result<Spectrum, PhysicsError> {
        if speed <= 0.0 {
            // No order line crosses at standstill.
            return Ok(Spectrum::new(speed, []));
        }
        let system = self.system(speed)?;
        let pairs = self.pairs(&system, guess)?;
        if self.assembly.has_modal_damping() {
            // Labels are not used, see `separate_crossings`.
            return Ok(Spectrum::new(speed, pairs.into_iter().map(|(value, _)| (value, String::new()))));
        }
        let modes = modal::modes_of(self.assembly, &system, pairs);
        Ok(Spectrum::new(speed, modes.into_iter().map(|mode| (mode.eigenvalue, mode.label))))
    }

    fn system(&self, speed: f64) -> Result<LinearSystem, PhysicsError> {
        LinearSystem::new(self.assembly, &(self.tangents)(speed)?, speed)
    }

    /// All eigenpairs within the reach of the search.
    fn all_pairs(&self, system: &LinearSystem, count: usize) -> Result<Vec<Eigenpair>, PhysicsError> {
        let reach = |pairs: &[Eigenpair]| {
            let heavy = pairs.iter().any(|(value, _)| is_heavily_damped(*value));
            let factor = if heavy { HEAVY_REACH } else { REACH };
            factor * self.highest_order * system.speed
        };
        modal::eigenpairs_up_to(self.assembly, system, count, reach)
    }

    /// As many eigenpairs as are searched.
    fn pairs(&self, system: &LinearSystem, guess: usize) -> Result<Vec<Eigenpair>, PhysicsError> {
        let Some(limit) = self.limit else { return self.all_pairs(system, guess) };
        let count = limit + EXTRA_MODES;
        // Up to where no mode is missing below those that are searched, or below the lines.
        let highest_line = REACH * self.highest_order * system.speed;
        let reach = |pairs: &[Eigenpair]| {
            if !pairs.iter().any(|(value, _)| is_heavily_damped(*value)) {
                return 0.0;
            }
            let mut lowest: Vec<f64> =
                pairs.iter().map(|pair| pair.0).filter(|v| takes_part(*v)).map(|v| v.im).collect();
            lowest.sort_by(f64::total_cmp);
            HEAVY_REACH * lowest.get(count - 1).map_or(highest_line, |last| last.min(highest_line))
        };
        modal::eigenpairs_up_to(self.assembly, system, count, reach)
    }

    /// The eigenpairs at these indices of a spectrum, by damped frequency.
    fn pairs_at(&self, of: &Spectrum, indices: Range<usize>) -> Result<Vec<Eigenpair>, PhysicsError> {
        if indices.is_empty() {
            return Ok(Vec::new());
        }
        let system = self.system(of.speed)?;
        let known = |index| refine::eigenpair_of(&system, of.isolated(index)?);
        if let Some(pairs) = indices.clone().map(known).collect() {
            return Ok(pairs);
        }
        let mut pairs = self.pairs(&system, of.values.len().max(2) - 1)?;
        pairs.retain(|(value, _)| takes_part(*value));
        pairs.sort_by(|a, b| a.0.im.total_cmp(&b.0.im));
        Ok(pairs.into_iter().skip(indices.start).take(indices.len()).collect())
    }

    /// Number of modes below an order line, at most as many as are searched.
    fn below(&self, at: &Spectrum, order: f64) -> usize {
        at.below(order).min(self.limit.unwrap_or(usize::MAX))
    }

    /// All crossings between the first and the last of the spectra.
    pub fn run(&self, spectra: Vec<Spectrum>, orders: &[f64]) -> Result<CrossingList, PhysicsError> {
        let spectra: Vec<Spectrum> = spectra.into_iter().filter(|s| s.speed >= 0.0).collect();
        let Some(last) = spectra.last() else { return Ok(CrossingList::default()) };
        let top = self.all_below(last.speed, orders)?;
        let speeds: Vec<f64> = spectra.iter().map(|at| at.speed).collect();
        let mut out = CrossingList { omitted: self.omitted(&top, orders), ..CrossingList::default() };
        let complete = self.number_is_monotonic(orders, &speeds, &top)?;
        let spectra = match complete {
            true => spectra,
            false => self.halve_steps(spectra, orders, &mut out.uncertain)?,
        };
        out.unstable = spectra.iter().filter_map(|at| at.unstable.clone()).collect();
        let steps: Vec<(&[Spectrum], f64)> =
            orders.iter().flat_map(|&order| spectra.windows(2).map(move |step| (step, order))).collect();
        let found: Vec<Found> = steps
            .par_iter()
            .map(|(step, order)| self.crossings(&step[0], &step[1], *order, MAX_BISECTIONS))
            .collect::<Result<_, PhysicsError>>()?;
        for Found { list, missing } in found {
            out.list.extend(list);
            out.uncertain.extend(missing);
        }
        out.list.sort_by(|a, b| a.speed.total_cmp(&b.speed).then(a.order.total_cmp(&b.order)));
        Ok(out)
    }

    /// The number of all modes below every order line at a speed, whatever the limit of the search.
    fn all_below(&self, speed: f64, orders: &[f64]) -> Result<AllBelow, PhysicsError> {
        if speed <= 0.0 {
            return Ok(AllBelow { system: None, counts: vec![0; orders.len()] });
        }
        let system = self.system(speed)?;
        let pairs = self.all_pairs(&system, self.limit.unwrap_or(0) + 8)?;
        let all = Spectrum::new(speed, pairs.into_iter().map(|(value, _)| (value, String::new())));
        let counts = orders.iter().map(|&order| all.below(order)).collect();
        Ok(AllBelow { system: Some(system), counts })
    }

    /// Modes below the order lines beyond the limit of the search.
    fn omitted(&self, top: &AllBelow, orders: &[f64]) -> Vec<(f64, usize)> {
        let Some(limit) = self.limit else { return Vec::new() };
        let beyond =
            orders.iter().zip(&top.counts).map(|(order, count)| (*order, count.saturating_sub(limit)));
        beyond.filter(|(_, count)| *count > 0).collect()
    }

    /// Whether the number of modes below every order line only increases: bearings of symmetric stiffness that are the same at
    /// all `speeds`, and at both ends as many modes below the lines as without damping.
    fn number_is_monotonic(
        &self,
        orders: &[f64],
        speeds: &[f64],
        top: &AllBelow,
    ) -> Result<bool, PhysicsError> {
        let Some(&first) = speeds.first() else { return Ok(true) };
        let at_first = (self.tangents)(first)?;
        // The other end first, which differs most often.
        for &speed in speeds.iter().skip(1).rev() {
            if (self.tangents)(speed)? != at_first {
                return Ok(false);
            }
        }
        let as_undamped = |at: &AllBelow| {
            let Some(system) = &at.system else { return true };
            let stiffness = &system.stiffness;
            let skew = stiffness.iter().map(|(i, j, v)| (v - stiffness.get(j, i)).abs()).fold(0.0, f64::max);
            let undamped = |order| undamped::undamped_modes_below(self.assembly, system, order, RIGID_BODY);
            skew <= 1e-9 * stiffness.max_abs()
                && orders.iter().zip(&at.counts).all(|(&order, count)| undamped(order) == *count)
        };
        Ok(as_undamped(top) && as_undamped(&self.all_below(first, orders)?))
    }

    /// Halves the steps in which N changes in both directions, or a frequency turns towards the line.
    fn halve_steps(
        &self,
        spectra: Vec<Spectrum>,
        orders: &[f64],
        uncertain: &mut Vec<UncertainRange>,
    ) -> Result<Vec<Spectrum>, PhysicsError> {
        // Spectra with whether the step that begins there is still to be halved.
        let mut steps: Vec<(Spectrum, bool)> = spectra.into_iter().map(|s| (s, true)).collect();
        for level in 0..MAX_HALVINGS {
            let middles: Vec<Option<Spectrum>> = steps
                .par_windows(2)
                .map(|step| match step[0].1 {
                    true => {
                        let (a, b) = (&step[0].0, &step[1].0);
                        self.spectrum(0.5 * (a.speed + b.speed), b.values.len().max(2) - 1).map(Some)
                    }
                    false => Ok(None),
                })
                .collect::<Result<_, PhysicsError>>()?;
            let mut next: Vec<(Spectrum, bool)> = Vec::with_capacity(2 * steps.len());
            let mut ends = steps.into_iter();
            let Some((mut a, _)) = ends.next() else { return Ok(Vec::new()) };
            for ((b, _), middle) in ends.zip(middles) {
                let Some(middle) = middle else {
                    next.push((std::mem::replace(&mut a, b), false));
                    continue;
                };
                let turns: Vec<f64> =
                    orders.iter().copied().filter(|&order| self.turns(&a, &middle, &b, order)).collect();
                if level + 1 == MAX_HALVINGS {
                    let range = |order| UncertainRange { order, from: a.speed, to: b.speed };
                    uncertain.extend(turns.iter().copied().map(range));
                }
                next.push((std::mem::replace(&mut a, b), !turns.is_empty()));
                next.push((middle, !turns.is_empty()));
            }
            next.push((a, true));
            steps = next;
            if steps[..steps.len() - 1].iter().all(|(_, halve)| !halve) {
                break;
            }
        }
        Ok(steps.into_iter().map(|(s, _)| s).collect())
    }

    /// Whether the number of modes below the line is not monotonic over three equidistant speeds, or the parabola
    /// through a frequency next to the line comes close to the line between them.
    fn turns(&self, a: &Spectrum, middle: &Spectrum, b: &Spectrum, order: f64) -> bool {
        let [na, nm, nb] = [a, middle, b].map(|at| self.below(at, order));
        if nm < na.min(nb) || nm > na.max(nb) {
            return true;
        }
        if na == nm && a.hides_crossing(middle, order) || nm == nb && middle.hides_crossing(b, order) {
            return true;
        }
        let near = |index: usize| {
            let (Some(p), Some(q), Some(r)) =
                (a.gap(index, order), middle.gap(index, order), b.gap(index, order))
            else {
                return false;
            };
            // q(t) = q + s t + c t², t from −1 to 1.
            let (s, c) = (0.5 * (r - p), 0.5 * (r + p) - q);
            let vertex = -0.5 * s / c;
            let lowest = q - 0.25 * s * s / c;
            c != 0.0 && vertex.abs() < 1.0 && lowest * q.signum() < 0.1 * q.abs() && lowest.abs() < q.abs()
        };
        na == nb && na == nm && (near(na) || na > 0 && near(na - 1))
    }

    /// Crossings between two neighbouring speeds: one for every index between the numbers of modes below the line.
    fn crossings(&self, a: &Spectrum, b: &Spectrum, order: f64, depth: usize) -> Result<Found, PhysicsError> {
        let (na, nb) = (self.below(a, order), self.below(b, order));
        let indices = na.min(nb)..na.max(nb);
        // The end at which the modes of these indices lie below the line, so that both are known there.
        let end = if nb > na { b } else { a };
        let starts = self.pairs_at(end, indices.clone())?;
        let mut roots = Vec::with_capacity(starts.len());
        for (index, start) in indices.clone().zip(&starts) {
            // Linear between both ends, or constant if the frequency is not known at the other.
            let trial = match (a.gap(index, order), b.gap(index, order)) {
                (Some(ga), Some(gb)) => a.speed + (b.speed - a.speed) * ga / (ga - gb),
                _ => start.0.im / order,
            };
            let (machine, ends) = ((self.assembly, self.tangents), (a.speed, b.speed));
            roots.push(refine::crossing(machine, order, (end.speed, start), trial, ends)?);
        }
        if let Some(found) = self.separate_crossings([a, b], order, indices.clone(), &roots) {
            return Ok(Found { list: found, ..Found::default() });
        }
        let mut found = ByIndex::new();
        for (index, root) in indices.clone().zip(roots) {
            if let Some((speed, _)) = root
                && !found.contains_key(&index)
            {
                self.modes_near_line(speed, order, ON_LINE, end.values.len(), &mut found)?;
            }
        }
        drop(starts);
        found.retain(|index, _| indices.contains(index));
        if depth == 0 {
            let mut missing = Vec::new();
            for index in indices.clone() {
                if found.contains_key(&index) {
                    continue;
                }
                if let Passage::Crossing(speed, distance) = self.passage(a, b, index, order)? {
                    self.modes_near_line(speed, order, distance, end.values.len(), &mut found)?;
                    if !found.contains_key(&index) {
                        missing.push(UncertainRange { order, from: a.speed, to: b.speed });
                    }
                }
            }
            found.retain(|index, _| indices.contains(index));
            return Ok(Found { list: found.into_values().collect(), missing });
        }
        if found.len() == indices.len() {
            return Ok(Found { list: found.into_values().collect(), ..Found::default() });
        }
        let middle = self.spectrum(0.5 * (a.speed + b.speed), end.values.len().max(2) - 1)?;
        let mut found = self.crossings(a, &middle, order, depth - 1)?;
        let right = self.crossings(&middle, b, order, depth - 1)?;
        found.list.extend(right.list);
        found.missing.extend(right.missing);
        Ok(found)
    }

    /// The crossings of a step whose modes reach the line one after another, in the order of their indices, and are labelled
    /// alike at both ends: no other mode has to be known. `None` where this is not so.
    fn separate_crossings(
        &self,
        [a, b]: [&Spectrum; 2],
        order: f64,
        indices: Range<usize>,
        roots: &[Option<(f64, Eigenpair)>],
    ) -> Option<Vec<CriticalSpeed>> {
        // With modal damping the iterations end before all digits of a shape.
        if self.assembly.has_modal_damping() {
            return None;
        }
        let labels = a.labels.get(..indices.end)?;
        if b.labels.get(..indices.end)? != labels {
            return None;
        }
        let roots: Vec<&(f64, Eigenpair)> = roots.iter().map(Option::as_ref).collect::<Option<_>>()?;
        if roots.len() != indices.len() {
            return None;
        }
        // The secant method may end with a change of 1e-8.
        let least = (APART * (b.speed - a.speed)).max(10.0 * ON_LINE * b.speed);
        // Modes that fall below the line with speed: the lowest first. Others rise above it, the highest first.
        let falls = self.below(b, order) > self.below(a, order);
        let apart = |pair: &[&(f64, Eigenpair)]| {
            let change = pair[1].0 - pair[0].0;
            (if falls { change } else { -change }) > least
        };
        let inside = |root: &&(f64, Eigenpair)| root.0 > a.speed + least && root.0 < b.speed - least;
        if !roots.iter().all(inside) || !roots.windows(2).all(apart) {
            return None;
        }
        let crossing = |((speed, (value, shape)), label): (&(f64, Eigenpair), &String)| {
            let mut mode = mode_kind::characterise(self.assembly, *value, shape.clone());
            let line = order * speed;
            let name = mode_kind::label_without_number(self.assembly, &mode);
            let known = *label == name || label.split_once(' ').is_some_and(|(_, rest)| rest == name);
            (known && (mode.omega() - line).abs() <= ON_LINE * line).then(|| {
                mode.label.clone_from(label);
                CriticalSpeed { speed: *speed, order, mode }
            })
        };
        roots.into_iter().zip(&labels[indices]).map(crossing).collect()
    }

    /// Where the frequency at an index passes the line, from the spectra alone: false position with bisection.
    fn passage(&self, a: &Spectrum, b: &Spectrum, index: usize, order: f64) -> Result<Passage, PhysicsError> {
        let count = a.values.len().max(b.values.len());
        let mut ends = [a, b].map(|end| (end.speed, end.gap(index, order)));
        for step in 0..MAX_BRACKETINGS {
            let [(left, ga), (right, gb)] = ends;
            let speed = match (ga, gb) {
                (Some(ga), Some(gb)) if step % 3 != 2 => left + (right - left) * ga / (ga - gb),
                _ => 0.5 * (left + right),
            };
            let gap = self.spectrum(speed, count.max(2) - 1)?.gap(index, order);
            if gap.is_some_and(|gap| gap.abs() < 0.1 * ON_LINE * order * speed) {
                return Ok(Passage::Crossing(speed, 10.0 * ON_LINE));
            }
            if right - left < 1e-12 * right {
                break;
            }
            // An index beyond the modes computed lies above the line.
            let above = |gap: Option<f64>| gap.is_none_or(|gap| gap > 0.0);
            ends[usize::from(above(gap) != above(ga))] = (speed, gap);
        }
        let [(left, Some(ga)), (right, Some(gb))] = ends else { return Ok(Passage::Jump) };
        let (speed, gap) = if ga.abs() < gb.abs() { (left, ga) } else { (right, gb) };
        let [distance, height] = [gap, ga - gb].map(|gap| gap.abs() / (order * right));
        // A low mode beside stiff elements may have that much round-off.
        Ok(match height <= ROUND_OFF {
            true => Passage::Crossing(speed, 2.0 * distance.max(height)),
            false => Passage::Jump,
        })
    }

    /// Adds the modes within a relative distance of an order line at a speed, by their indices.
    fn modes_near_line(
        &self,
        speed: f64,
        order: f64,
        distance: f64,
        count: usize,
        found: &mut ByIndex,
    ) -> Result<(), PhysicsError> {
        let system = self.system(speed)?;
        let pairs = self.pairs(&system, count.max(2) - 1)?;
        let mut modes = modal::modes_of(self.assembly, &system, pairs);
        modes.retain(|mode| takes_part(mode.eigenvalue));
        modes.sort_by(|a, b| a.omega().total_cmp(&b.omega()));
        let line = order * speed;
        for (index, mode) in modes.into_iter().enumerate() {
            if (mode.omega() - line).abs() <= distance * line {
                found.entry(index).or_insert(CriticalSpeed { speed, order, mode });
            }
        }
        Ok(())
    }
}

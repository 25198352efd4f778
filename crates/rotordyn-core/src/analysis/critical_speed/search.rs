//! All crossings of the modes with order lines over a range of speeds.
//!
//! The modes at each speed, sorted by damped frequency, are continuous functions of speed whichever mode has which
//! index. The k-th frequency therefore crosses an order line between two speeds where the number N of modes below the
//! line differs: for every index between both numbers one crossing is refined. No mode has to be tracked.
//!
//! Two crossings within one step leave N unchanged. With constant bearings N at the end is compared with the number
//! of undamped modes, which cannot decrease with speed; otherwise steps are halved until N changes in one direction
//! only and no frequency turns towards the line within a step.

use super::{CriticalSpeed, CrossingList, Tangents, UncertainRange, refine, undamped};
use crate::analysis::campbell::EXTRA_MODES;
use crate::analysis::modal::{self, Eigenpair};
use crate::analysis::mode_kind;
use crate::assembly::{Assembly, LinearSystem, PhysicsError};
use rayon::prelude::*;
use rotordyn_bearing::SiteTangent;
use rotordyn_linalg::Complex64;
use std::collections::BTreeMap;
use std::ops::Range;

/// Modes with |λ| up to this multiple of the highest order line are computed: damping ratios up to 0.6.
const REACH: f64 = 1.25;
/// The same if a damping ratio above [`HEAVY_DAMPING`] occurs: damping ratios up to 0.94.
const HEAVY_REACH: f64 = 3.0;
const HEAVY_DAMPING: f64 = 0.3;
/// A mode lies on an order line within this relative difference of frequencies.
const ON_LINE: f64 = 1e-8;
/// Relative distance of two eigenvalues from which each has a shape of its own.
const LEAST_GAP: f64 = 1e-5;
/// Least distance of a crossing from the next one and from the ends of its step, as a fraction of the step.
const APART: f64 = 1e-5;
/// Largest number of halvings of a step in which N changes twice.
const MAX_HALVINGS: usize = 6;
/// Largest number of halvings of a step to separate its crossings, before each is bracketed.
const MAX_BISECTIONS: usize = 4;
const MAX_BRACKETINGS: usize = 80;
/// Frequencies below this \[rad/s\] are rigid-body modes, see [`krylov`](rotordyn_linalg::krylov).
const RIGID_BODY: f64 = 1e-3 * modal::SHIFT;

/// Eigenvalues at one speed, by damped frequency, and labels of their modes. Without their shapes, which would be most of the
/// memory of a search.
#[derive(Clone, Debug)]
pub(super) struct Spectrum {
    speed: f64,
    values: Vec<Complex64>,
    labels: Vec<String>,
}

impl Spectrum {
    pub fn new(speed: f64, modes: impl IntoIterator<Item = (Complex64, String)>) -> Self {
        let mut modes: Vec<(Complex64, String)> = modes.into_iter().collect();
        modes.sort_by(|a, b| a.0.im.total_cmp(&b.0.im));
        let (values, labels) = modes.into_iter().unzip();
        Self { speed, values, labels }
    }

    /// Number of modes below an order line.
    fn below(&self, order: f64) -> usize {
        self.values.partition_point(|value| value.im < order * self.speed)
    }

    /// The eigenvalue at an index, unless another one is so near that both have a shape in common.
    fn isolated(&self, index: usize) -> Option<Complex64> {
        let value = *self.values.get(index)?;
        let near = |other: &Complex64| (other - value).norm() < LEAST_GAP * value.norm();
        (self.values.iter().filter(|other| near(other)).count() == 1).then_some(value)
    }

    /// ω_d − n Ω of the mode at an index.
    fn gap(&self, index: usize, order: f64) -> Option<f64> {
        self.values.get(index).map(|value| value.im - order * self.speed)
    }
}

/// Number of modes below every order line at one speed.
struct AllBelow {
    speed: f64,
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

impl<'a, T: Tangents> Search<'a, T> {
    pub fn new(assembly: &'a Assembly, tangents: &'a T, orders: &[f64], limit: Option<usize>) -> Self {
        let highest_order = orders.iter().copied().fold(0.0, f64::max);
        Self { assembly, tangents, highest_order, limit }
    }

    /// Eigenvalues at increasing speeds.
    pub fn spectra(&self, speeds: &[f64]) -> Result<Vec<Spectrum>, PhysicsError> {
        let Some(&top) = speeds.last() else { return Ok(Vec::new()) };
        let highest = self.spectrum(top, 8)?;
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

    /// Eigenvalues at a speed: all below the highest order line and one above it, or as many as are searched.
    fn spectrum(&self, speed: f64, guess: usize) -> Result<Spectrum, PhysicsError> {
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
            let heavy = pairs.iter().any(|(value, _)| -value.re > HEAVY_DAMPING * value.norm());
            let factor = if heavy { HEAVY_REACH } else { REACH };
            factor * self.highest_order * system.speed
        };
        modal::eigenpairs_up_to(self.assembly, system, count, reach)
    }

    /// As many eigenpairs as are searched.
    fn pairs(&self, system: &LinearSystem, guess: usize) -> Result<Vec<Eigenpair>, PhysicsError> {
        match self.limit {
            Some(limit) => modal::eigenpairs(self.assembly, system, limit + EXTRA_MODES),
            None => self.all_pairs(system, guess),
        }
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
        let (Some(first), Some(last)) = (spectra.first(), spectra.last()) else {
            return Ok(CrossingList::default());
        };
        let (first, top) = (first.speed, self.all_below(last.speed, orders)?);
        let mut out = CrossingList { omitted: self.omitted(&top, orders), ..CrossingList::default() };
        let complete = self.number_is_monotonic(orders, first, &top)?;
        let spectra = match complete {
            true => spectra,
            false => self.halve_steps(spectra, orders, &mut out.uncertain)?,
        };
        let steps: Vec<(&[Spectrum], f64)> =
            orders.iter().flat_map(|&order| spectra.windows(2).map(move |step| (step, order))).collect();
        let found: Vec<Vec<CriticalSpeed>> = steps
            .par_iter()
            .map(|(step, order)| self.crossings(&step[0], &step[1], *order, MAX_BISECTIONS))
            .collect::<Result<_, PhysicsError>>()?;
        out.list = found.concat();
        out.list.sort_by(|a, b| a.speed.total_cmp(&b.speed).then(a.order.total_cmp(&b.order)));
        Ok(out)
    }

    /// The number of all modes below every order line at a speed, whatever the limit of the search.
    fn all_below(&self, speed: f64, orders: &[f64]) -> Result<AllBelow, PhysicsError> {
        if speed <= 0.0 {
            return Ok(AllBelow { speed, system: None, counts: vec![0; orders.len()] });
        }
        let system = self.system(speed)?;
        let pairs = self.all_pairs(&system, self.limit.unwrap_or(0) + 8)?;
        let all = Spectrum::new(speed, pairs.into_iter().map(|(value, _)| (value, String::new())));
        let counts = orders.iter().map(|&order| all.below(order)).collect();
        Ok(AllBelow { speed, system: Some(system), counts })
    }

    /// Modes below the order lines beyond the limit of the search.
    fn omitted(&self, top: &AllBelow, orders: &[f64]) -> Vec<(f64, usize)> {
        let Some(limit) = self.limit else { return Vec::new() };
        let beyond =
            orders.iter().zip(&top.counts).map(|(order, count)| (*order, count.saturating_sub(limit)));
        beyond.filter(|(_, count)| *count > 0).collect()
    }

    /// Whether the number of modes below every order line only increases: constant bearings of symmetric stiffness, and
    /// at both ends as many modes below the lines as without damping.
    fn number_is_monotonic(&self, orders: &[f64], first: f64, top: &AllBelow) -> Result<bool, PhysicsError> {
        let speeds = [first, 0.5 * (first + top.speed), top.speed];
        let tangents: Vec<Vec<SiteTangent>> =
            speeds.into_iter().map(self.tangents).collect::<Result<_, PhysicsError>>()?;
        if tangents[0] != tangents[1] || tangents[1] != tangents[2] {
            return Ok(false);
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
    fn crossings(
        &self,
        a: &Spectrum,
        b: &Spectrum,
        order: f64,
        depth: usize,
    ) -> Result<Vec<CriticalSpeed>, PhysicsError> {
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
            return Ok(found);
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
            for index in indices.clone() {
                if !found.contains_key(&index)
                    && let Some(speed) = self.bracketed(a, b, index, order)?
                {
                    self.modes_near_line(speed, order, 10.0 * ON_LINE, end.values.len(), &mut found)?;
                }
            }
            found.retain(|index, _| indices.contains(index));
        }
        if found.len() == indices.len() || depth == 0 {
            return Ok(found.into_values().collect());
        }
        let middle = self.spectrum(0.5 * (a.speed + b.speed), end.values.len().max(2) - 1)?;
        let mut found = self.crossings(a, &middle, order, depth - 1)?;
        found.extend(self.crossings(&middle, b, order, depth - 1)?);
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

    /// The speed at which the frequency at an index crosses the line, from the spectra alone: false position with
    /// bisection. `None` where it jumps over the line, as a mode below becomes oscillatory or overdamped.
    fn bracketed(
        &self,
        a: &Spectrum,
        b: &Spectrum,
        index: usize,
        order: f64,
    ) -> Result<Option<f64>, PhysicsError> {
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
                return Ok(Some(speed));
            }
            if right - left < 1e-12 * right {
                break;
            }
            // An index beyond the modes computed lies above the line.
            let above = |gap: Option<f64>| gap.is_none_or(|gap| gap > 0.0);
            ends[usize::from(above(gap) != above(ga))] = (speed, gap);
        }
        Ok(None)
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

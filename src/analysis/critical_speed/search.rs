//! All crossings of the modes with order lines over a range of speeds.
//!
//! The modes at each speed, sorted by damped frequency, are continuous functions of speed whichever mode has which
//! place. The k-th frequency therefore crosses an order line between two speeds where the number N of modes below the
//! line differs: for every place between both numbers one crossing is refined. No mode has to be tracked.
//!
//! Two crossings within one step leave N unchanged. With constant bearings N at the end is compared with the number
//! of undamped modes, which cannot decrease with speed; otherwise steps are halved until N changes in one direction
//! only and no frequency turns towards the line within a step.

use super::{CriticalSpeed, CrossingList, Tangents, UncertainRange, refine};
use crate::analysis::modal::{self, Eigenpair, Mode};
use crate::assembly::{Assembly, LinearSystem};
use crate::bearing::SiteTangent;
use crate::error::Error;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Modes with |λ| up to this multiple of the highest order line are computed: damping ratios up to 0.6.
const REACH: f64 = 1.25;
/// The same if a damping ratio above [`HEAVY_DAMPING`] occurs: damping ratios up to 0.94.
const HEAVY_REACH: f64 = 3.0;
const HEAVY_DAMPING: f64 = 0.3;
/// A mode lies on an order line within this relative difference of frequencies.
const ON_LINE: f64 = 1e-8;
/// Largest number of halvings of a step in which N changes twice.
const MAX_HALVINGS: usize = 6;
/// Largest number of halvings of a step to separate its crossings, before each is bracketed.
const MAX_BISECTIONS: usize = 4;
const MAX_BRACKETINGS: usize = 80;
/// Modes in addition to the number searched, whose frequency may fall below that of the last.
const EXTRA_MODES: usize = 4;
/// Frequencies below this \[rad/s\] are rigid-body modes, see [`krylov`](crate::linalg::krylov).
const RIGID_BODY: f64 = 1e-3 * modal::SHIFT;

/// Eigenpairs at one speed, by damped frequency.
#[derive(Clone, Debug)]
pub(super) struct Spectrum {
    speed: f64,
    pairs: Vec<Eigenpair>,
}

impl Spectrum {
    fn new(speed: f64, mut pairs: Vec<Eigenpair>) -> Self {
        pairs.sort_by(|a, b| a.0.im.total_cmp(&b.0.im));
        Self { speed, pairs }
    }

    pub fn of_modes(speed: f64, modes: &[Mode]) -> Self {
        Self::new(speed, modes.iter().map(|m| (m.eigenvalue, m.shape.clone())).collect())
    }

    /// ω_d − n Ω of the mode at a place.
    fn gap(&self, place: usize, order: f64) -> Option<f64> {
        self.pairs.get(place).map(|pair| pair.0.im - order * self.speed)
    }
}

/// Search with one set of orders.
pub(super) struct Search<'a, T> {
    assembly: &'a Assembly,
    tangents: &'a T,
    highest_order: f64,
    /// Number of modes searched at every speed, by frequency; `None`: all.
    limit: Option<usize>,
}

/// Crossings in a step in which every place has one at most.
type ByPlace = BTreeMap<usize, CriticalSpeed>;

impl<'a, T: Tangents> Search<'a, T> {
    pub fn new(assembly: &'a Assembly, tangents: &'a T, orders: &[f64], limit: Option<usize>) -> Self {
        let highest_order = orders.iter().copied().fold(0.0, f64::max);
        Self { assembly, tangents, highest_order, limit }
    }

    /// Eigenpairs at increasing speeds.
    pub fn spectra(&self, speeds: &[f64]) -> Result<Vec<Spectrum>, Error> {
        let Some(&top) = speeds.last() else { return Ok(Vec::new()) };
        let highest = self.spectrum(top, 8)?;
        let guess = |speed: f64| {
            let reach = REACH * self.highest_order * speed;
            highest.pairs.iter().filter(|pair| pair.0.norm() < reach).count() + 2
        };
        let lower = &speeds[..speeds.len() - 1];
        let mut spectra: Vec<Spectrum> =
            lower.par_iter().map(|&s| self.spectrum(s, guess(s))).collect::<Result<_, Error>>()?;
        spectra.push(highest);
        Ok(spectra)
    }

    /// Eigenpairs at a speed: all below the highest order line and one above it, or as many as are searched.
    fn spectrum(&self, speed: f64, guess: usize) -> Result<Spectrum, Error> {
        if speed <= 0.0 {
            // No order line crosses at standstill.
            return Ok(Spectrum::new(speed, Vec::new()));
        }
        let (system, count) = (self.system(speed)?, self.limit.map_or(guess, |limit| limit + EXTRA_MODES));
        Ok(Spectrum::new(speed, self.pairs(&system, count, self.limit.is_none())?))
    }

    fn system(&self, speed: f64) -> Result<LinearSystem, Error> {
        LinearSystem::new(self.assembly, &(self.tangents)(speed)?, speed)
    }

    /// The lowest `count` eigenpairs; with `all`, `count` is raised until the last lies beyond the reach of the
    /// search.
    fn pairs(&self, system: &LinearSystem, mut count: usize, all: bool) -> Result<Vec<Eigenpair>, Error> {
        loop {
            let pairs = modal::eigenpairs(self.assembly, system, count)?;
            let Some(last) = pairs.get(count - 1).filter(|_| all) else {
                return Ok(pairs);
            };
            let heavy = pairs.iter().any(|(value, _)| -value.re > HEAVY_DAMPING * value.norm());
            let reach = if heavy { HEAVY_REACH } else { REACH } * self.highest_order * system.speed;
            if last.0.norm() >= reach {
                return Ok(pairs);
            }
            count += 4 + count / 2;
        }
    }

    /// Number of modes below an order line, at most as many as are searched.
    fn below(&self, at: &Spectrum, order: f64) -> usize {
        let count = at.pairs.partition_point(|pair| pair.0.im < order * at.speed);
        self.limit.map_or(count, |limit| count.min(limit))
    }

    /// All crossings between the first and the last of the spectra.
    pub fn run(&self, spectra: Vec<Spectrum>, orders: &[f64]) -> Result<CrossingList, Error> {
        let spectra: Vec<Spectrum> = spectra.into_iter().filter(|s| s.speed >= 0.0).collect();
        let (Some(first), Some(last)) = (spectra.first(), spectra.last()) else {
            return Ok(CrossingList::default());
        };
        let (first, top) = (first.speed, last.speed);
        let mut out = CrossingList::default();
        let complete = self.number_is_monotonic(orders, first, top, &mut out)?;
        let spectra = match complete {
            true => spectra,
            false => self.halve_steps(spectra, orders, &mut out.uncertain)?,
        };
        let steps: Vec<(&[Spectrum], f64)> =
            orders.iter().flat_map(|&order| spectra.windows(2).map(move |step| (step, order))).collect();
        let found: Vec<Vec<CriticalSpeed>> = steps
            .par_iter()
            .map(|(step, order)| self.crossings(&step[0], &step[1], *order, MAX_BISECTIONS))
            .collect::<Result<_, Error>>()?;
        out.list = found.concat();
        out.list.sort_by(|a, b| a.speed.total_cmp(&b.speed).then(a.order.total_cmp(&b.order)));
        Ok(out)
    }

    /// Whether the number of modes below every order line only increases: constant bearings, and as many modes below
    /// the line as without damping. Notes the modes beyond the limit of the search.
    fn number_is_monotonic(
        &self,
        orders: &[f64],
        first: f64,
        top: f64,
        out: &mut CrossingList,
    ) -> Result<bool, Error> {
        let system = self.system(top)?;
        let start = self.limit.map_or(8, |limit| limit + EXTRA_MODES);
        let all = Spectrum::new(top, self.pairs(&system, start, true)?);
        let unlimited = |at: &Spectrum, order: f64| at.pairs.partition_point(|p| p.0.im < order * at.speed);
        if let Some(limit) = self.limit {
            let beyond = |order: &f64| (*order, unlimited(&all, *order).saturating_sub(limit));
            out.omitted = orders.iter().map(beyond).filter(|(_, count)| *count > 0).collect();
        }
        let tangents: Vec<Vec<SiteTangent>> =
            [first, 0.5 * (first + top), top].into_iter().map(self.tangents).collect::<Result<_, Error>>()?;
        let stiffness = &system.stiffness;
        let skew = stiffness.iter().map(|(i, j, v)| (v - stiffness.get(j, i)).abs()).fold(0.0, f64::max);
        if tangents[0] != tangents[1] || tangents[1] != tangents[2] || skew > 1e-9 * stiffness.max_abs() {
            return Ok(false);
        }
        let same = |system: &LinearSystem, at: &Spectrum| {
            orders.iter().all(|&order| {
                super::undamped::undamped_modes_below(self.assembly, system, order, RIGID_BODY)
                    == unlimited(at, order)
            })
        };
        if first > 0.0 {
            let system = self.system(first)?;
            if !same(&system, &Spectrum::new(first, self.pairs(&system, start, true)?)) {
                return Ok(false);
            }
        }
        Ok(same(&system, &all))
    }

    /// Halves the steps in which N changes in both directions, or a frequency turns towards the line.
    fn halve_steps(
        &self,
        spectra: Vec<Spectrum>,
        orders: &[f64],
        uncertain: &mut Vec<UncertainRange>,
    ) -> Result<Vec<Spectrum>, Error> {
        // Spectra with whether the step that begins there is still to be halved.
        let mut steps: Vec<(Spectrum, bool)> = spectra.into_iter().map(|s| (s, true)).collect();
        for level in 0..MAX_HALVINGS {
            let middles: Vec<Option<Spectrum>> = steps
                .par_windows(2)
                .map(|step| match step[0].1 {
                    true => {
                        let (a, b) = (&step[0].0, &step[1].0);
                        self.spectrum(0.5 * (a.speed + b.speed), b.pairs.len().max(2) - 1).map(Some)
                    }
                    false => Ok(None),
                })
                .collect::<Result<_, Error>>()?;
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
        let near = |place: usize| {
            let (Some(p), Some(q), Some(r)) =
                (a.gap(place, order), middle.gap(place, order), b.gap(place, order))
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

    /// Crossings between two neighbouring speeds: one for every place between the numbers of modes below the line.
    fn crossings(
        &self,
        a: &Spectrum,
        b: &Spectrum,
        order: f64,
        depth: usize,
    ) -> Result<Vec<CriticalSpeed>, Error> {
        let (na, nb) = (self.below(a, order), self.below(b, order));
        let places = na.min(nb)..na.max(nb);
        // The end at which the modes of these places lie below the line, so that both are known there.
        let end = if nb > na { b } else { a };
        let mut found = ByPlace::new();
        for place in places.clone() {
            if !found.contains_key(&place) {
                let start = (end.speed, &end.pairs[place]);
                let ends = (a.speed, b.speed);
                // Linear between both ends, or constant if the frequency is not known at the other.
                let trial = match (a.gap(place, order), b.gap(place, order)) {
                    (Some(ga), Some(gb)) => a.speed + (b.speed - a.speed) * ga / (ga - gb),
                    _ => start.1.0.im / order,
                };
                let root = refine::crossing((self.assembly, self.tangents), order, start, trial, ends)?;
                if let Some((speed, _)) = root {
                    self.modes_near_line(speed, order, ON_LINE, end.pairs.len(), &mut found)?;
                }
            }
        }
        found.retain(|place, _| places.contains(place));
        if depth == 0 {
            for place in places.clone() {
                if !found.contains_key(&place)
                    && let Some(speed) = self.bracketed(a, b, place, order)?
                {
                    self.modes_near_line(speed, order, 10.0 * ON_LINE, end.pairs.len(), &mut found)?;
                }
            }
            found.retain(|place, _| places.contains(place));
        }
        if found.len() == places.len() || depth == 0 {
            return Ok(found.into_values().collect());
        }
        let middle = self.spectrum(0.5 * (a.speed + b.speed), end.pairs.len().max(2) - 1)?;
        let mut found = self.crossings(a, &middle, order, depth - 1)?;
        found.extend(self.crossings(&middle, b, order, depth - 1)?);
        Ok(found)
    }

    /// The speed at which the frequency at a place crosses the line, from the spectra alone: false position with
    /// bisection. `None` where it jumps over the line, as a mode below becomes oscillatory or overdamped.
    fn bracketed(&self, a: &Spectrum, b: &Spectrum, place: usize, order: f64) -> Result<Option<f64>, Error> {
        let count = a.pairs.len().max(b.pairs.len());
        let mut ends = [a, b].map(|end| (end.speed, end.gap(place, order)));
        for step in 0..MAX_BRACKETINGS {
            let [(left, ga), (right, gb)] = ends;
            let speed = match (ga, gb) {
                (Some(ga), Some(gb)) if step % 3 != 2 => left + (right - left) * ga / (ga - gb),
                _ => 0.5 * (left + right),
            };
            let gap = self.spectrum(speed, count.max(2) - 1)?.gap(place, order);
            if gap.is_some_and(|gap| gap.abs() < 0.1 * ON_LINE * order * speed) {
                return Ok(Some(speed));
            }
            if right - left < 1e-12 * right {
                break;
            }
            // A place beyond the modes computed lies above the line.
            let above = |gap: Option<f64>| gap.is_none_or(|gap| gap > 0.0);
            ends[usize::from(above(gap) != above(ga))] = (speed, gap);
        }
        Ok(None)
    }

    /// Adds the modes within a relative distance of an order line at a speed, by their places.
    fn modes_near_line(
        &self,
        speed: f64,
        order: f64,
        distance: f64,
        count: usize,
        found: &mut ByPlace,
    ) -> Result<(), Error> {
        let system = self.system(speed)?;
        let pairs = self.pairs(&system, count.max(2) - 1, self.limit.is_none())?;
        let mut modes = modal::modes_of(self.assembly, &system, pairs);
        modes.sort_by(|a, b| a.omega().total_cmp(&b.omega()));
        let line = order * speed;
        for (place, mode) in modes.into_iter().enumerate() {
            if (mode.omega() - line).abs() <= distance * line {
                found.entry(place).or_insert(CriticalSpeed { speed, order, mode });
            }
        }
        Ok(())
    }
}

//! Close pairs: modes that two close modes fit better.
//!
//! Two modes closer than their bandwidth, H = a/(s − λ − δ) + b/(s − λ + δ), are to first order a mode and a
//! double pole: (a + b)/(s − λ) + δ(a − b)/(s − λ)². Around every mode the FRFs, less the other modes, are fitted with
//! one and with two poles. A second pole is taken if the reduction of the residuals is significant, if it explains nearly all
//! that noise does not, and if its shape is another: noise of the force and nonlinearities give it the same.
//!
//! FRFs of a structure that changes between hits (pole λ + δ_o of output o) have the same double pole: unless the fit is
//! exact, the squared residuals fall to a hundredth with unlike shapes, or one pole for each FRF explains less
//! (`two_modes`), the mode stays one and is marked.

use std::f64::consts::TAU;

use rayon::prelude::*;

use super::Settings;
use super::data::Data;
use super::lsfd::{Fit, free_residues};
use super::mac::mac;
use super::plscf::{Pole, normalise_largest};
use super::pole_selection::directions;
use super::refine::{FitPoint, Problem};
use super::two_modes::{MIN_EXPLAINED, are_two, noise};
use super::window::Window;
use rotordyn_linalg::Complex64;

/// What a mode is.
pub(super) enum Split {
    One(Pole),
    /// These two close modes, or one that differs between the FRFs.
    Maybe([Pole; 2]),
    Two([Pole; 2]),
}

impl Split {
    pub fn poles(&self) -> &[Pole] {
        match self {
            Split::One(pole) => std::slice::from_ref(pole),
            Split::Maybe(pair) | Split::Two(pair) => pair,
        }
    }

    fn poles_mut(&mut self) -> &mut [Pole] {
        match self {
            Split::One(pole) => std::slice::from_mut(pole),
            Split::Maybe(pair) | Split::Two(pair) => pair,
        }
    }
}

/// Half width of the window around a mode in half-power bandwidths, and in lines at least.
const WINDOW: f64 = 2.0;
const MIN_LINES: f64 = 20.0;
/// Rounds in which pairs are sought.
const ROUNDS: usize = 4;
/// Steps of the fits around a mode with one pole and with two, and of the fit of all modes with the pairs of a round.
const ONE_STEPS: usize = 4;
const TWO_STEPS: usize = 12;
const TOGETHER_STEPS: usize = 40;
/// Distances of the two poles at the start, over their decay rate.
const START_DISTANCES: [f64; 2] = [0.2, 0.7];
/// Minimum F statistic of a second pole.
const MIN_SIGNIFICANCE: f64 = 10.0;
/// Minimum share of the second pole in the energy of the FRFs in the window: 0.1 % of the amplitude.
const MIN_SHARE: f64 = 1e-6;
/// Residuals over the FRFs, squared, at which of one mode there is nothing left to explain; and at which a fit counts as
/// exact, so that its modes are the only ones that explain the FRFs.
const ROUND_OFF: f64 = 1e-20;
const EXACT: f64 = 1e-15;
/// MAC of shapes and of participations below which two close modes differ.
const DIFFERENT_SHAPES: f64 = 0.9;
const DIFFERENT_PARTICIPATIONS: f64 = 0.95;
/// Reduction of the squared residuals that is taken for a second mode even with one input, if the shapes are unlike.
const LARGE_REDUCTION: f64 = 100.0;
const UNLIKE_SHAPES: f64 = 0.7;
/// Distance over the larger decay rate below which a pair is close.
const CLOSE: f64 = 1.5;
/// Largest distance of a pair over the larger decay rate.
const FARTHEST: f64 = 4.0;

/// Every mode with what it is.
///
/// A pair that leaves much unexplained hides smaller ones nearby: pairs are sought in rounds, each with those of the rounds
/// before in the model.
pub(super) fn splits(problem: &Problem, at: &FitPoint, settings: &Settings) -> Vec<Split> {
    let mut splits: Vec<Split> = at.poles.iter().cloned().map(Split::One).collect();
    let mut refined: Option<FitPoint> = None;
    for _ in 0..ROUNDS {
        let model = refined.as_ref().unwrap_or(at);
        let fit = problem.fit(model);
        let mut place = 0;
        let mut singles = Vec::new();
        for (m, split) in splits.iter().enumerate() {
            if matches!(split, Split::One(_)) {
                singles.push((m, place));
            }
            place += split.poles().len();
        }
        let found: Vec<(usize, Split)> = singles
            .into_par_iter()
            .filter_map(|(m, place)| Some((m, pair_of(problem, &model.poles, &fit, place, settings)?)))
            .collect();
        if found.is_empty() {
            break;
        }
        found.into_iter().for_each(|(m, split)| splits[m] = split);
        let all = splits.iter().flat_map(|split| split.poles().to_vec()).collect();
        let together = problem.refine(all, TOGETHER_STEPS);
        let exact = is_exact(problem, &together);
        let mut poles = together.poles.iter();
        for split in &mut splits {
            split.poles_mut().iter_mut().zip(&mut poles).for_each(|(own, refined)| own.clone_from(refined));
            if exact && let Split::Maybe(pair) = split {
                *split = Split::Two(pair.clone());
            }
        }
        if exact {
            break;
        }
        refined = Some(together);
    }
    splits
}

/// Two modes for certain in the place of a mode.
pub(super) fn certain_pair(
    problem: &Problem,
    at: &FitPoint,
    m: usize,
    settings: &Settings,
) -> Option<[Pole; 2]> {
    match pair_of(problem, &at.poles, &problem.fit(at), m, settings)? {
        Split::Two(pair) => Some(pair),
        _ => None,
    }
}

/// Two modes instead of one; `None` if it is one.
fn pair_of(problem: &Problem, poles: &[Pole], fit: &Fit, m: usize, settings: &Settings) -> Option<Split> {
    if poles[m].held {
        return None;
    }
    let around = Neighbourhood::new(problem.data(), poles, fit, m)?;
    let here = Problem::new(&around.window.data);
    let energy = here.energy();
    let one = here.refine(around.window.near.clone(), ONE_STEPS);
    if one.cost < ROUND_OFF * energy {
        return None;
    }
    let two = around.two(&here, &one)?;
    let (a, b) = (two.poles.len() - 2, two.poles.len() - 1);
    let pair = [two.poles[a].clone(), two.poles[b].clone()];
    let gain = one.cost - two.cost;
    let significance = gain / around.unknowns_of_a_mode() / two.residual_variance().max(f64::MIN_POSITIVE);
    if !around.valid(&pair, &poles[m], settings) || significance < MIN_SIGNIFICANCE {
        return None;
    }
    if two.cost < EXACT * energy {
        return Some(Split::Two(pair));
    }
    let unexplained = (two.cost - noise(&two, around.window.data.lines())).max(0.0);
    let alike = shape_mac(&here, &two, a, b);
    if gain < MIN_EXPLAINED * unexplained || gain < MIN_SHARE * energy {
        return None;
    }
    let certain = (one.cost > LARGE_REDUCTION * two.cost && alike < UNLIKE_SHAPES)
        || are_two(problem.data(), poles, fit, &[m], [&pair[0], &pair[1]], UNLIKE_SHAPES);
    if !certain && alike > DIFFERENT_SHAPES {
        return None;
    }
    Some(if certain { Split::Two(pair) } else { Split::Maybe(pair) })
}

/// The FRFs around a mode.
struct Neighbourhood {
    window: Window,
    /// Place of the mode among those of the window.
    own: usize,
}

impl Neighbourhood {
    /// `None` if there is no window, or too few lines for another mode.
    fn new(data: &Data, poles: &[Pole], fit: &Fit, m: usize) -> Option<Self> {
        let hz = poles[m].value.im / TAU;
        let half = (WINDOW * 2.0 * poles[m].value.re.abs() / TAU).max(MIN_LINES * data.step);
        let window = Window::new(data, poles, fit, [hz - half, hz + half])?;
        let own = window.inside.iter().position(|&k| k == m)?;
        let here = Self { window, own };
        let data = &here.window.data;
        let frfs = data.outputs() * data.inputs();
        let unknowns = (here.window.near.len() + 1) as f64 * here.unknowns_of_a_mode() + 2.0 * frfs as f64;
        ((data.lines() * frfs) as f64 >= unknowns).then_some(here)
    }

    fn unknowns_of_a_mode(&self) -> f64 {
        (2 * self.window.data.outputs() + 2 * self.window.data.inputs()) as f64
    }

    /// The best fit with two poles, which come last, instead of the mode's one.
    fn two(&self, here: &Problem, one: &FitPoint) -> Option<FitPoint> {
        let values: Vec<Complex64> = one.poles.iter().map(|p| p.value).collect();
        let residues = free_residues(&self.window.data, &values);
        let fits =
            start_pairs(&one.poles[self.own], directions(&residues[self.own])).into_iter().map(|pair| {
                let mut poles = one.poles.clone();
                poles.remove(self.own);
                poles.extend(pair);
                here.refine(poles, TWO_STEPS)
            });
        fits.min_by(|a, b| a.cost.total_cmp(&b.cost))
    }

    /// Whether two poles are two close modes at the place of one.
    fn valid(&self, pair: &[Pole; 2], one: &Pole, settings: &Settings) -> bool {
        let band = self.window.data.band();
        let decay = pair[0].value.re.abs().max(pair[1].value.re.abs());
        let damped = |p: &Pole| {
            let zeta = p.damping_ratio();
            zeta > 0.0 && zeta <= settings.largest_damping
        };
        pair.iter().all(|p| p.is_inside(band) && damped(p))
            && (pair[0].value - pair[1].value).norm() < FARTHEST * decay
            && decay < FARTHEST * one.value.re.abs()
    }
}

/// Start values of a pair around one pole: apart in frequency, with participations on both sides of the first
/// principal direction of its residues.
fn start_pairs(pole: &Pole, (directions, sizes): (Vec<Vec<Complex64>>, Vec<f64>)) -> Vec<[Pole; 2]> {
    let mut out = Vec::new();
    let decay = pole.value.re.abs();
    let turned = |sign: f64| -> Vec<Complex64> {
        match (&directions[..], &sizes[..]) {
            ([first, second, ..], [large, small, ..]) if *large > 0.0 => {
                let share = sign * (small / large).max(1e-3);
                normalise_largest(first.iter().zip(second).map(|(a, b)| a + b * share).collect())
            }
            _ => pole.participation.clone(),
        }
    };
    let (signs, distances): (&[f64], &[f64]) =
        if directions.len() > 1 { (&[1.0, -1.0], &START_DISTANCES[1..]) } else { (&[1.0], &START_DISTANCES) };
    for distance in distances {
        for sign in signs {
            let offset = Complex64::new(0.0, 0.5 * distance * decay);
            out.push([
                Pole::new(pole.value + offset, turned(*sign)),
                Pole::new(pole.value - offset, turned(-sign)),
            ]);
        }
    }
    out
}

/// MAC of two shapes as measured or as scaled for the fit, the larger.
fn shape_mac(problem: &Problem, at: &FitPoint, a: usize, b: usize) -> f64 {
    let scale = &problem.data().output_scale;
    let fitted = |m: usize| (0..scale.len()).map(|o| at.shape(m, o)).collect::<Vec<_>>();
    let measured = |m: usize| (0..scale.len()).map(|o| at.shape(m, o) * scale[o]).collect::<Vec<_>>();
    mac(&fitted(a), &fitted(b)).max(mac(&measured(a), &measured(b)))
}

/// Whether two close modes differ in shape and in participation.
fn different(shapes: f64, a: &Pole, b: &Pole) -> bool {
    shapes < DIFFERENT_SHAPES
        && a.participation.len() > 1
        && mac(&a.participation, &b.participation) < DIFFERENT_PARTICIPATIONS
}

/// Whether a fit leaves nothing to explain.
pub(super) fn is_exact(problem: &Problem, at: &FitPoint) -> bool {
    at.cost < EXACT * problem.energy()
}

/// Modes that may be one with a close neighbour, and the neighbour.
pub(super) fn indistinct(problem: &Problem, at: &FitPoint) -> Vec<(usize, usize)> {
    if is_exact(problem, at) {
        return Vec::new();
    }
    let distance = |a: usize, b: usize| (at.poles[a].value - at.poles[b].value).norm();
    let fit = problem.fit(at);
    let alike = |a: usize, b: usize| {
        let (first, second) = (&at.poles[a], &at.poles[b]);
        let close = distance(a, b) < CLOSE * first.value.re.abs().max(second.value.re.abs());
        close
            && !different(shape_mac(problem, at, a, b), first, second)
            && !are_two(problem.data(), &at.poles, &fit, &[a, b], [first, second], DIFFERENT_SHAPES)
    };
    let count = at.poles.len();
    let neighbour = |a: usize| {
        let alike = (0..count).filter(|&b| a != b && alike(a, b));
        Some((a, alike.min_by(|b, c| distance(a, *b).total_cmp(&distance(a, *c)))?))
    };
    (0..count).filter_map(neighbour).collect()
}

//! Close pairs: modes that two close modes fit better.
//!
//! Two modes closer than their bandwidth, H = a/(s − λ − δ) + b/(s − λ + δ), are to first order a mode and a
//! double pole: (a + b)/(s − λ) + δ(a − b)/(s − λ)². Around every mode the FRFs, less the other modes, are fitted with
//! one and with two poles; the reduction of the residuals is judged by its F statistic.
//! FRFs of a structure that changes between hits (pole λ + δ_o of output o) have the
//! same double pole: unless the fit is exact or the squared residuals fall to a hundredth with unlike shapes,
//! the mode stays one and is marked.

use std::f64::consts::TAU;

use nalgebra::DMatrix;
use rayon::prelude::*;

use super::Settings;
use super::data::{Data, noise_rms, rms};
use super::lsfd::{Fit, free_residues};
use super::mac::mac;
use super::plscf::{Pole, normalise_largest};
use super::pole_selection::directions;
use super::refine::{FitPoint, Problem};
use rotordyn_linalg::Complex64;

/// What a mode is.
pub(super) enum Split {
    One,
    /// These two close modes, or one that differs between the FRFs.
    Maybe([Pole; 2]),
    Two([Pole; 2]),
}

/// Half width of the window around a mode in half-power bandwidths, and in lines at least.
const WINDOW: f64 = 4.0;
const MIN_LINES: f64 = 20.0;
/// Steps of the fits with one pole and with two.
const ONE_STEPS: usize = 4;
const TWO_STEPS: usize = 12;
/// Principal directions of the outputs that are fitted around a mode: more than the modes there.
const DIRECTIONS: usize = 6;
/// Distances of the two poles at the start, over their decay rate.
const START_DISTANCES: [f64; 2] = [0.2, 0.7];
/// Minimum F statistic of a second pole.
const MIN_SIGNIFICANCE: f64 = 10.0;
/// Minimum share of the second pole in the energy of the FRFs in the window: 1 % of the amplitude.
const MIN_SHARE: f64 = 1e-4;
/// Residuals over the FRFs, squared, at which of one mode there is nothing left to explain; and at which a fit counts as
/// exact, so that its modes are the only ones that explain the FRFs.
const ROUND_OFF: f64 = 1e-20;
const EXACT: f64 = 1e-15;
/// Mean square of noise over that of the FRFs below which FRFs count as computed, not measured.
const NO_NOISE: f64 = 1e-8;
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
pub(super) fn splits(problem: &Problem, at: &FitPoint, settings: &Settings) -> Vec<Split> {
    let fit = problem.fit(at);
    (0..at.poles.len()).into_par_iter().map(|m| split(problem, at, &fit, m, settings)).collect()
}

fn split(problem: &Problem, at: &FitPoint, fit: &Fit, m: usize, settings: &Settings) -> Split {
    let data = problem.data();
    let pole = &at.poles[m];
    if pole.held {
        return Split::One;
    }
    let hz = pole.value.im / TAU;
    let half = (WINDOW * 2.0 * pole.value.re.abs() / TAU).max(MIN_LINES * data.step);
    let line =
        |hz: f64| ((hz - data.frequencies[0]) / data.step).round().clamp(0.0, (data.lines() - 1) as f64);
    let (first, last) = (line(hz - half) as usize, line(hz + half) as usize);
    let inside = |pole: &Pole| {
        let own = pole.value.im / TAU;
        own >= data.frequencies[first] && own <= data.frequencies[last]
    };
    let (near, far): (Vec<usize>, Vec<usize>) = (0..at.poles.len()).partition(|&k| inside(&at.poles[k]));
    let s: Vec<Complex64> = data.s();
    let others = |o: usize, i: usize, k: usize| -> Complex64 {
        let of = |&r: &usize| {
            let (value, residue) = (at.poles[r].value, fit.shapes[r][o] * at.poles[r].participation[i]);
            residue / (s[k] - value) + residue.conj() / (s[k] - value.conj())
        };
        far.iter().map(of).sum::<Complex64>() * s[k].powi(data.power)
    };
    let local = projected(data.window(first..=last, others));
    let here = Problem::new(&local);
    let start: Vec<Pole> = near.iter().map(|&k| at.poles[k].clone()).collect();
    let Some(own) = near.iter().position(|&k| k == m) else { return Split::One };
    let (outputs, inputs) = (local.outputs(), local.inputs());
    let unknowns = (start.len() + 1) * (2 * outputs + 2 * inputs) + 2 * inputs * outputs;
    let all = 2 * local.lines() * outputs * inputs;
    if all < 2 * unknowns {
        return Split::One;
    }
    let one = here.refine(start, ONE_STEPS);
    let energy = here.energy();
    if one.cost < ROUND_OFF * energy {
        return Split::One;
    }
    let values: Vec<Complex64> = one.poles.iter().map(|p| p.value).collect();
    let residues = free_residues(&local, &values);
    let mut best: Option<FitPoint> = None;
    for pair in start_pairs(&one.poles[own], directions(&residues[own])) {
        let mut poles = one.poles.clone();
        poles.remove(own);
        poles.extend(pair);
        let two = here.refine(poles, TWO_STEPS);
        if best.as_ref().is_none_or(|best| two.cost < best.cost) {
            best = Some(two);
        }
    }
    let Some(two) = best else { return Split::One };
    let count = two.poles.len();
    let pair = [two.poles[count - 2].clone(), two.poles[count - 1].clone()];
    let freedom = (2 * outputs + 2 * inputs) as f64;
    let variance = (two.cost / (all - unknowns) as f64).max(f64::MIN_POSITIVE);
    let significance = (one.cost - two.cost) / freedom / variance;
    let decay = pair[0].value.re.abs().max(pair[1].value.re.abs());
    let valid = pair.iter().all(|p| {
        let zeta = -p.value.re / p.value.norm();
        inside(p) && zeta > 0.0 && zeta <= settings.largest_damping
    });
    let together =
        (pair[0].value - pair[1].value).norm() < FARTHEST * decay && decay < FARTHEST * pole.value.re.abs();
    if !valid || !together || significance < MIN_SIGNIFICANCE {
        return Split::One;
    }
    if two.cost < EXACT * energy {
        return Split::Two(pair);
    }
    if one.cost - two.cost < MIN_SHARE * energy {
        return Split::One;
    }
    let shapes = shape_mac(&here, &two, count - 2, count - 1);
    let large = one.cost > LARGE_REDUCTION * two.cost && shapes < UNLIKE_SHAPES;
    if large { Split::Two(pair) } else { Split::Maybe(pair) }
}

/// FRFs on the principal directions of the outputs; lengths and angles of shapes are preserved.
fn projected(data: Data) -> Data {
    let outputs = data.outputs();
    if outputs <= DIRECTIONS {
        return data;
    }
    let (lines, inputs) = (data.lines(), data.inputs());
    let flat = DMatrix::from_fn(2 * inputs * lines, outputs, |row, o| {
        let h = data.values[o][row / (2 * lines)][row / 2 % lines];
        if row % 2 == 0 { h.re } else { h.im }
    });
    let eigen = flat.tr_mul(&flat).symmetric_eigen();
    let mut order: Vec<usize> = (0..outputs).collect();
    order.sort_by(|a, b| eigen.eigenvalues[*b].total_cmp(&eigen.eigenvalues[*a]));
    let along = |place: &usize| -> Vec<Vec<Complex64>> {
        let direction = eigen.eigenvectors.column(*place);
        let sum = |i: usize, k: usize| -> Complex64 {
            data.values.iter().zip(direction.iter()).map(|(row, weight)| row[i][k] * *weight).sum()
        };
        (0..inputs).map(|i| (0..lines).map(|k| sum(i, k)).collect()).collect()
    };
    let values = order.iter().take(DIRECTIONS).map(along).collect();
    Data { values, output_scale: vec![1.0; DIRECTIONS], ..data }
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

/// Poles with all pairs, certain or not; `None` if there is no pair.
pub(super) fn all_poles(poles: &[Pole], splits: &[Split]) -> Option<Vec<Pole>> {
    let of = |(pole, split): (&Pole, &Split)| match split {
        Split::One => vec![pole.clone()],
        Split::Maybe(pair) | Split::Two(pair) => pair.to_vec(),
    };
    let all: Vec<Pole> = poles.iter().zip(splits).flat_map(of).collect();
    (all.len() > poles.len()).then_some(all)
}

/// Whether the FRFs have no noise, so that their modes can be found exactly.
pub(super) fn without_noise(data: &Data) -> bool {
    let share = |frf: &Vec<Complex64>| noise_rms(frf).powi(2) / rms(frf).powi(2).max(f64::MIN_POSITIVE);
    let sum: f64 = data.values.iter().flatten().map(share).sum();
    sum < NO_NOISE * (data.outputs() * data.inputs()) as f64
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
    let alike = |a: usize, b: usize| {
        let (first, second) = (&at.poles[a], &at.poles[b]);
        let close = distance(a, b) < CLOSE * first.value.re.abs().max(second.value.re.abs());
        close && !different(shape_mac(problem, at, a, b), first, second)
    };
    let count = at.poles.len();
    let neighbour = |a: usize| {
        let alike = (0..count).filter(|&b| a != b && alike(a, b));
        Some((a, alike.min_by(|b, c| distance(a, *b).total_cmp(&distance(a, *c)))?))
    };
    (0..count).filter_map(neighbour).collect()
}

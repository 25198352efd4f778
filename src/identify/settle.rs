//! From poles that stay to modes that the data bear out: refined together, those that run off or explain nothing
//! dropped, those found twice made one.

use std::f64::consts::TAU;

use super::data::Data;
use super::lsfd::Fit;
use super::mac::mac;
use super::plscf::{Pole, unit};
use super::refine::{Point, Problem, significance};
use super::uncertainty::{PoleCovariance, covariance, errors, rough};
use super::{Settings, synthesised};
use crate::linalg::Complex64;

/// Poles at the minimum, and what goes with them.
pub(super) struct Settled {
    pub poles: Vec<Pole>,
    pub fit: Fit,
    pub covariance: Vec<PoleCovariance>,
    pub significance: Vec<f64>,
}

/// Steps of the refinement while poles may still be dropped, and at the end.
const TRIAL: usize = 4;
const FINAL: usize = 40;
/// Change of frequency, relative, by which a pole that was stable has run off.
const RUN_OFF: f64 = 0.01;
/// Significance F below which a mode is noise: the largest of many tries stays below it.
const LEAST_SIGNIFICANCE: f64 = 10.0;
/// Standard errors that make a mode worthless: of the frequency, relative, and of the damping, relative.
const WORST_FREQUENCY: f64 = 0.01;
const WORST_DAMPING: f64 = 0.5;

/// Settles poles; the data are rescaled by what a first fit leaves of each FRF. `None` where no pole is left.
pub(super) fn settle(
    data: &mut Data,
    mut poles: Vec<Pole>,
    settings: &Settings,
    dropped: &mut Vec<String>,
) -> Option<Settled> {
    poles = pruned(&Problem::new(data), poles, settings, dropped)?;
    // First with all FRFs alike, then each by what the first fit left of it.
    let first = Problem::new(data).refine(poles, TRIAL);
    let poles = reweighted(data, first);
    let problem = Problem::new(data);
    let mut at = problem.refine(pruned(&problem, poles, settings, dropped)?, FINAL);
    loop {
        while let Some(poles) = without_faults(&problem, &at, None, settings, dropped) {
            if poles.is_empty() {
                return None;
            }
            at = problem.refine(poles, FINAL);
        }
        let covariance = covariance(problem.data(), &at, &problem.step(&at));
        let significance = significance(&at);
        // A pole that follows the noise of a few lines is betrayed by what becomes of it without them.
        let fault = |m: usize| weak(&at.poles[m], covariance[m], significance[m]);
        let worst = (0..at.poles.len())
            .filter(|&m| fault(m).is_some())
            .min_by(|&a, &b| significance[a].total_cmp(&significance[b]));
        let Some(worst) = worst else {
            let fit = problem.fit(&at);
            return Some(Settled { poles: at.poles, fit, covariance, significance });
        };
        dropped.extend(fault(worst));
        let mut poles = at.poles;
        poles.remove(worst);
        if poles.is_empty() {
            return None;
        }
        at = problem.refine(poles, FINAL);
    }
}

/// Poles that stand a few steps of refinement.
fn pruned(
    problem: &Problem,
    mut poles: Vec<Pole>,
    settings: &Settings,
    dropped: &mut Vec<String>,
) -> Option<Vec<Pole>> {
    loop {
        let at = problem.refine(poles.clone(), TRIAL);
        match without_faults(problem, &at, Some(&poles), settings, dropped) {
            None => return Some(at.poles),
            Some(left) if left.is_empty() => return None,
            Some(left) => poles = left,
        }
    }
}

/// What is left when the faulty are taken away; `None` where none is. Poles that ran off go together, of the others
/// the least significant: the rest may recover without it.
fn without_faults(
    problem: &Problem,
    at: &Point,
    started: Option<&[Pole]>,
    settings: &Settings,
    dropped: &mut Vec<String>,
) -> Option<Vec<Pole>> {
    let band = [problem.data().frequencies[0], problem.data().frequencies[problem.data().lines() - 1]];
    let count = at.poles.len();
    let off: Vec<Option<String>> =
        (0..count).map(|m| run_off(at.poles[m].value, started.map(|s| s[m].value), band, settings)).collect();
    if off.iter().any(Option::is_some) {
        // Those that stayed go on from where they were: the others pulled at them.
        let stay = |m: &usize| off[*m].is_none();
        let from = started.unwrap_or(&at.poles);
        let left = (0..count).filter(stay).map(|m| from[m].clone()).collect();
        dropped.extend(off.into_iter().flatten());
        return Some(left);
    }
    let significance = significance(at);
    let covariance = rough(at, &problem.step(at));
    let verdict = |m: usize| {
        let weak = weak(&at.poles[m], covariance[m], significance[m]);
        weak.or_else(|| twin(problem.data(), at, m, &significance))
    };
    let worst = (0..count)
        .filter_map(|m| Some((m, verdict(m)?)))
        .min_by(|a, b| significance[a.0].total_cmp(&significance[b.0]));
    let (worst, reason) = worst?;
    dropped.push(reason);
    let mut left = at.poles.clone();
    left.remove(worst);
    Some(left)
}

fn name(pole: Complex64) -> String {
    format!("{:.3} Hz, damping {:.3} %", pole.im / TAU, -100.0 * pole.re / pole.norm())
}

fn run_off(
    pole: Complex64,
    started: Option<Complex64>,
    band: [f64; 2],
    settings: &Settings,
) -> Option<String> {
    let hz = pole.im / TAU;
    let zeta = -pole.re / pole.norm();
    let name = name(started.unwrap_or(pole));
    if zeta.is_nan() || zeta <= 0.0 {
        return Some(format!("{name}: not damped when fitted to the FRFs"));
    }
    if hz < band[0] || hz > band[1] {
        return Some(format!("{name}: outside the band when fitted to the FRFs"));
    }
    if zeta > settings.largest_damping {
        return Some(format!("{name}: damped too highly when fitted to the FRFs"));
    }
    match started {
        Some(first) if (pole.im / first.im - 1.0).abs() > RUN_OFF => {
            Some(format!("{name}: goes to {hz:.3} Hz when fitted to the FRFs"))
        }
        _ => None,
    }
}

fn weak(pole: &Pole, covariance: PoleCovariance, significance: f64) -> Option<String> {
    let (frequency, damping) = errors(pole.value, covariance);
    let zeta = -pole.value.re / pole.value.norm();
    let name = name(pole.value);
    if significance < LEAST_SIGNIFICANCE {
        return Some(format!("{name}: explains no more than noise would (F = {significance:.1})"));
    }
    let uncertain = frequency > WORST_FREQUENCY * pole.value.im / TAU || damping > WORST_DAMPING * zeta;
    uncertain.then(|| format!("{name}: known to {frequency:.2e} Hz and {:.2e} % only", 100.0 * damping))
}

/// Poles nearer than this many decay rates may be one.
const TWIN: f64 = 3.0;
/// They are where their shapes over at least so many outputs are alike to this MAC.
const FEW: usize = 8;
const ALIKE: f64 = 0.7;

/// Whether a more significant mode beside this one has its shape: FRFs that do not fit together (a structure that
/// changed between hits) give one mode twice.
///
/// Alike as measured, or as fitted: the weights of the fit raise outputs that hardly move, where twins share out at
/// random.
fn twin(data: &Data, at: &Point, m: usize, significance: &[f64]) -> Option<String> {
    let fitted = |m: usize| (0..at.x.ncols()).map(|o| at.shape(m, o)).collect::<Vec<_>>();
    let measured = |m: usize| {
        let scaled = fitted(m).into_iter().zip(&data.output_scale);
        scaled.map(|(v, scale)| v * *scale).collect::<Vec<_>>()
    };
    let own = &at.poles[m];
    let other = (0..at.poles.len()).filter(|&k| k != m && significance[k] > significance[m]).find(|&k| {
        let other = &at.poles[k];
        let near = (own.value - other.value).norm() < TWIN * own.value.re.abs().max(other.value.re.abs());
        let alike = || mac(&fitted(m), &fitted(k)).max(mac(&measured(m), &measured(k)));
        near && at.x.ncols() >= FEW && alike() > ALIKE
    })?;
    Some(format!("{}: the mode at {:.3} Hz once more", name(own.value), at.poles[other].value.im / TAU))
}

/// Rescales every FRF by what a fit left of it; returns its poles in the new scales.
fn reweighted(data: &mut Data, found: Point) -> Vec<Pole> {
    let fit = Problem::new(data).fit(&found);
    let model = synthesised(data, &found.poles, &fit);
    let left = |frf: &[Complex64], model: &[Complex64]| {
        let sum: f64 = frf.iter().zip(model).map(|(h, m)| (h - m).norm_sqr()).sum();
        (sum / frf.len() as f64).sqrt()
    };
    let mut sizes: Vec<Vec<f64>> = data
        .values
        .iter()
        .zip(&model)
        .map(|(row, model)| row.iter().zip(model).map(|(frf, model)| left(frf, model)).collect())
        .collect();
    // An FRF that fits a thousand times better than the worst is fitted no better than that.
    let floor = 1e-3 * sizes.iter().flatten().copied().fold(0.0, f64::max);
    sizes.iter_mut().flatten().for_each(|size| *size = size.max(floor));
    let b = data.rescale(&sizes);
    let mut poles = found.poles;
    for pole in &mut poles {
        pole.participation.iter_mut().zip(&b).for_each(|(l, b)| *l /= b);
        pole.participation = unit(std::mem::take(&mut pole.participation));
    }
    poles
}

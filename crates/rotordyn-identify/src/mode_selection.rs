//! Mode selection: stable poles are refined together; diverging, insignificant or uncertain ones are dropped,
//! duplicate poles are merged.

use std::f64::consts::TAU;

use super::Settings;
use super::data::Data;
use super::lsfd::Fit;
use super::mac::mac;
use super::plscf::{Pole, normalise_largest};
use super::refine::{FitPoint, Problem, significance};
use super::uncertainty::{PoleCovariance, covariance, standard_errors, white_noise_covariance};
use rotordyn_linalg::Complex64;

/// Selected modes: poles at the minimum with residues, covariance and significance.
pub(super) struct SelectedModes {
    pub poles: Vec<Pole>,
    pub fit: Fit,
    pub covariance: Vec<PoleCovariance>,
    pub significance: Vec<f64>,
}

/// Refinement steps while poles may still be dropped, and at the end.
const TRIAL_STEPS: usize = 4;
const FINAL_STEPS: usize = 40;
/// Relative change of frequency from which a stable pole counts as drifted away.
const MAX_FREQUENCY_DRIFT: f64 = 0.01;
/// Minimum significance F of a mode; the largest of many noise poles stays below it.
const MIN_SIGNIFICANCE: f64 = 10.0;
/// Maximum relative standard errors of a mode: of the frequency and of the damping ratio.
const MAX_FREQUENCY_ERROR: f64 = 0.01;
const MAX_DAMPING_ERROR: f64 = 0.5;

/// Refines and selects poles; FRFs are reweighted by the residuals of a first fit. `None` if no pole remains.
pub(super) fn select_modes(
    data: &mut Data,
    mut poles: Vec<Pole>,
    settings: &Settings,
    dropped: &mut Vec<String>,
) -> Option<SelectedModes> {
    poles = prune_poles(&Problem::new(data), poles, settings, dropped)?;
    // First fit with equal weights, then reweighted by its residuals.
    let first = Problem::new(data).refine(poles, TRIAL_STEPS);
    let poles = reweight(data, first);
    let problem = Problem::new(data);
    let mut at = problem.refine(prune_poles(&problem, poles, settings, dropped)?, FINAL_STEPS);
    loop {
        while let Some(poles) = remove_faulty_poles(&problem, &at, None, settings, dropped) {
            if poles.is_empty() {
                return None;
            }
            at = problem.refine(poles, FINAL_STEPS);
        }
        let covariance = covariance(problem.data(), &at, &problem.step(&at));
        let significance = significance(&at);
        // The jackknife covariance exposes poles that fit the noise of a few lines.
        let fault = |m: usize| significance_fault(&at.poles[m], covariance[m], significance[m]);
        let worst = (0..at.poles.len())
            .filter(|&m| fault(m).is_some())
            .min_by(|&a, &b| significance[a].total_cmp(&significance[b]));
        let Some(worst) = worst else {
            let fit = problem.fit(&at);
            return Some(SelectedModes { poles: at.poles, fit, covariance, significance });
        };
        dropped.extend(fault(worst));
        let mut poles = at.poles;
        poles.remove(worst);
        if poles.is_empty() {
            return None;
        }
        at = problem.refine(poles, FINAL_STEPS);
    }
}

/// Poles that remain valid over a few steps of refinement.
fn prune_poles(
    problem: &Problem,
    mut poles: Vec<Pole>,
    settings: &Settings,
    dropped: &mut Vec<String>,
) -> Option<Vec<Pole>> {
    loop {
        let at = problem.refine(poles.clone(), TRIAL_STEPS);
        match remove_faulty_poles(problem, &at, Some(&poles), settings, dropped) {
            None => return Some(at.poles),
            Some(left) if left.is_empty() => return None,
            Some(left) => poles = left,
        }
    }
}

/// Poles left after removing faulty ones; `None` if there is no faulty one. Drifted poles are removed
/// together, of the others only the least significant: the rest may recover without it.
fn remove_faulty_poles(
    problem: &Problem,
    at: &FitPoint,
    started: Option<&[Pole]>,
    settings: &Settings,
    dropped: &mut Vec<String>,
) -> Option<Vec<Pole>> {
    let band = [problem.data().frequencies[0], problem.data().frequencies[problem.data().lines() - 1]];
    let count = at.poles.len();
    let off: Vec<Option<String>> = (0..count)
        .map(|m| drift_fault(at.poles[m].value, started.map(|s| s[m].value), band, settings))
        .collect();
    if off.iter().any(Option::is_some) {
        // Restart the remaining poles from their previous values: the drifted ones have biased them.
        let stay = |m: &usize| off[*m].is_none();
        let from = started.unwrap_or(&at.poles);
        let left = (0..count).filter(stay).map(|m| from[m].clone()).collect();
        dropped.extend(off.into_iter().flatten());
        return Some(left);
    }
    let significance = significance(at);
    let covariance = white_noise_covariance(at, &problem.step(at));
    let fault_of = |m: usize| {
        let weak = significance_fault(&at.poles[m], covariance[m], significance[m]);
        weak.or_else(|| duplicate_fault(problem.data(), at, m, &significance))
    };
    let worst = (0..count)
        .filter_map(|m| Some((m, fault_of(m)?)))
        .min_by(|a, b| significance[a.0].total_cmp(&significance[b.0]));
    let (worst, reason) = worst?;
    dropped.push(reason);
    let mut left = at.poles.clone();
    left.remove(worst);
    Some(left)
}

fn describe_pole(pole: Complex64) -> String {
    format!("{:.3} Hz, damping {:.3} %", pole.im / TAU, -100.0 * pole.re / pole.norm())
}

fn drift_fault(
    pole: Complex64,
    started: Option<Complex64>,
    band: [f64; 2],
    settings: &Settings,
) -> Option<String> {
    let hz = pole.im / TAU;
    let zeta = -pole.re / pole.norm();
    let name = describe_pole(started.unwrap_or(pole));
    if zeta.is_nan() || zeta <= 0.0 {
        return Some(format!("{name}: not positively damped when fitted to the FRFs"));
    }
    if hz < band[0] || hz > band[1] {
        return Some(format!("{name}: outside the band when fitted to the FRFs"));
    }
    if zeta > settings.largest_damping {
        return Some(format!("{name}: damping above the limit when fitted to the FRFs"));
    }
    match started {
        Some(first) if (pole.im / first.im - 1.0).abs() > MAX_FREQUENCY_DRIFT => {
            Some(format!("{name}: moves to {hz:.3} Hz when fitted to the FRFs"))
        }
        _ => None,
    }
}

fn significance_fault(pole: &Pole, covariance: PoleCovariance, significance: f64) -> Option<String> {
    let (frequency, damping) = standard_errors(pole.value, covariance);
    let zeta = -pole.value.re / pole.value.norm();
    let name = describe_pole(pole.value);
    if significance < MIN_SIGNIFICANCE {
        return Some(format!("{name}: not significant against noise (F = {significance:.1})"));
    }
    let uncertain =
        frequency > MAX_FREQUENCY_ERROR * pole.value.im / TAU || damping > MAX_DAMPING_ERROR * zeta;
    uncertain.then(|| {
        format!("{name}: standard error too large ({frequency:.2e} Hz, damping {:.2e} %)", 100.0 * damping)
    })
}

/// Distance, in decay rates, below which two poles may be duplicates.
const MAX_DUPLICATE_DISTANCE: f64 = 3.0;
/// Minimum number of outputs, and MAC of the shapes, for two close poles to be duplicates.
const MIN_DUPLICATE_OUTPUTS: usize = 8;
const MIN_DUPLICATE_MAC: f64 = 0.7;

/// Duplicate pole: whether a more significant mode close to this one has the same shape. Inconsistent FRFs (a
/// structure that changed between hits) give one mode twice.
///
/// MAC of the shapes as measured or as scaled for the fit: the fit's weights amplify outputs of small motion,
/// over which duplicates split at random.
fn duplicate_fault(data: &Data, at: &FitPoint, m: usize, significance: &[f64]) -> Option<String> {
    let fitted = |m: usize| (0..at.x.ncols()).map(|o| at.shape(m, o)).collect::<Vec<_>>();
    let measured = |m: usize| {
        let scaled = fitted(m).into_iter().zip(&data.output_scale);
        scaled.map(|(v, scale)| v * *scale).collect::<Vec<_>>()
    };
    let own = &at.poles[m];
    let other = (0..at.poles.len()).filter(|&k| k != m && significance[k] > significance[m]).find(|&k| {
        let other = &at.poles[k];
        let near = (own.value - other.value).norm()
            < MAX_DUPLICATE_DISTANCE * own.value.re.abs().max(other.value.re.abs());
        let shape_mac = || mac(&fitted(m), &fitted(k)).max(mac(&measured(m), &measured(k)));
        near && at.x.ncols() >= MIN_DUPLICATE_OUTPUTS && shape_mac() > MIN_DUPLICATE_MAC
    })?;
    Some(format!(
        "{}: duplicate of the mode at {:.3} Hz",
        describe_pole(own.value),
        at.poles[other].value.im / TAU
    ))
}

/// Reweights every FRF by the residual of a fit; returns its poles in the new scales.
fn reweight(data: &mut Data, found: FitPoint) -> Vec<Pole> {
    let fit = Problem::new(data).fit(&found);
    let model = synthesise(data, &found.poles, &fit);
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
    // Lower limit of the scale: a thousandth of the largest residual.
    let floor = 1e-3 * sizes.iter().flatten().copied().fold(0.0, f64::max);
    sizes.iter_mut().flatten().for_each(|size| *size = size.max(floor));
    let b = data.rescale(&sizes);
    let mut poles = found.poles;
    for pole in &mut poles {
        pole.participation.iter_mut().zip(&b).for_each(|(l, b)| *l /= b);
        pole.participation = normalise_largest(std::mem::take(&mut pole.participation));
    }
    poles
}

/// FRFs of the modal model in the data's scales, `[output][input][line]`.
pub(super) fn synthesise(data: &Data, poles: &[Pole], fit: &Fit) -> Vec<Vec<Vec<Complex64>>> {
    let s = data.s();
    let one = |o: usize, i: usize| {
        let value = |s: &Complex64| {
            let mut sum = fit.upper[o][i] + fit.lower[o][i] / (s * s);
            for (pole, shape) in poles.iter().zip(&fit.shapes) {
                let residue = shape[o] * pole.participation[i];
                sum += residue / (s - pole.value) + residue.conj() / (s - pole.value.conj());
            }
            sum * s.powi(data.power)
        };
        s.iter().map(value).collect()
    };
    (0..data.outputs()).map(|o| (0..data.inputs()).map(|i| one(o, i)).collect()).collect()
}

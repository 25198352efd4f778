//! Mode selection: stable poles are refined together; diverging, insignificant or uncertain ones are dropped,
//! duplicate poles are merged, modes that are two are split.
//!
//! A pole that many orders share but that drifts away in a refinement is held at its stable value, once the others have
//! settled for good: unmodelled motion nearby, not the mode, has drawn it away.

use std::f64::consts::TAU;

use super::alternative_mode::{AlternativeMode, NOT_REFINED};
use super::data::Data;
use super::lsfd::Fit;
use super::mac::mac;
use super::misfit::{outputs_differ, with_model_error};
use super::outside::with_modes_outside;
use super::pairs::{self, Split};
use super::plscf::{Pole, StablePole, damping_ratio};
use super::refine::{FitPoint, MIN_LOCAL_GAIN, Problem, significance};
use super::reweight::reweight;
use super::shape_errors::shape_variances;
use super::truncation::truncation_errors;
use super::two_modes::are_two;
use super::uncertainty::{PoleCovariance, covariance, standard_errors, white_noise_covariance};
use super::{DroppedPole, QualityWarning, Settings};
use rotordyn_linalg::Complex64;

/// Selected modes: poles at the minimum with residues, covariance and significance.
pub(super) struct SelectedModes {
    pub poles: Vec<Pole>,
    pub fit: Fit,
    pub covariance: Vec<PoleCovariance>,
    /// E|δψ|² `[mode][output]`.
    pub shape_variances: Vec<Vec<f64>>,
    /// 1 − MAC of each shape by what the mode may be instead, and by the modes outside the band.
    pub alternative_shapes: Vec<f64>,
    pub significance: Vec<f64>,
    pub quality_warnings: Vec<Vec<QualityWarning>>,
}

/// Refinement steps while poles may still be dropped, and at the end.
const TRIAL_STEPS: usize = 4;
const FINAL_STEPS: usize = 40;
/// Relative change of frequency from which a stable pole counts as drifted away.
const MAX_FREQUENCY_DRIFT: f64 = 0.01;
/// Growth of the damping ratio from which it counts as drifted, and the damping ratio below which it does not.
const MAX_DAMPING_GROWTH: f64 = 3.0;
const MIN_BROAD_DAMPING: f64 = 0.03;
/// Support of a pole (mean similarity over the orders) from which it is held where it was stable.
const MIN_HELD_SUPPORT: f64 = 0.3;
/// Largest error of a held pole's frequency, relative.
const MAX_HELD_ERROR: f64 = 0.05;
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
    dropped: &mut Vec<DroppedPole>,
) -> Option<SelectedModes> {
    poles = prune_poles(&Problem::new(data), poles, settings, dropped)?;
    // First fit with equal weights, then reweighted by its residuals.
    let first = Problem::new(data).refine(poles, TRIAL_STEPS);
    let mut poles = reweight(data, first);
    // What the others left unexplained may have drawn a held pole away: it is tried once more.
    poles.iter_mut().for_each(|pole| pole.held = false);
    let problem = Problem::new(data);
    let pruned = prune_poles(&problem, poles, settings, dropped)?;
    let pruned = with_modes_outside(&problem, pruned, settings);
    let settled = settle(&problem, pruned, settings, dropped)?;
    let splits = pairs::splits(&problem, &settled.at, settings);
    let (settled, mut maybe_two) = with_pairs(&problem, settled, splits, settings, dropped)?;
    // A duplicate was taken for the same mode by its shape alone.
    let RefinedModes { at, mut covariance, significance, duplicates } = settled;
    let differ = outputs_differ(&problem, &at);
    let mut quality_warnings = vec![Vec::new(); at.poles.len()];
    let mut alternatives = vec![AlternativeMode::default(); at.poles.len()];
    let nearest = |value: Complex64| {
        let distance = |m: usize| (at.poles[m].value - value).norm();
        (0..at.poles.len()).min_by(|a, b| distance(*a).total_cmp(&distance(*b)))
    };
    let of_duplicate = |pole: Pole| {
        let other = at.poles[nearest(pole.value)?].clone();
        Some(MaybeTwo { value: pole.value, pair: [other, pole] })
    };
    maybe_two.extend(duplicates.into_iter().filter_map(of_duplicate));
    for MaybeTwo { value, pair } in &maybe_two {
        let Some(m) = nearest(*value).filter(|m| !differ[*m]) else { continue };
        if !quality_warnings[m].contains(&QualityWarning::MaybeTwo) {
            quality_warnings[m].push(QualityWarning::MaybeTwo);
        }
        alternatives[m] = alternatives[m].or(AlternativeMode::of_two(&problem, &at, m, pair));
    }
    for (m, neighbour) in pairs::indistinct(&problem, &at) {
        quality_warnings[m].push(QualityWarning::MaybeOne);
        alternatives[m] = alternatives[m].or(AlternativeMode::of_one(&problem, &at, m, neighbour));
    }
    for (m, pull) in pulls(&problem, &at) {
        quality_warnings[m].push(QualityWarning::Held);
        alternatives[m].shape = alternatives[m].shape.max(NOT_REFINED);
        covariance[m][0] += pull.re * pull.re;
        covariance[m][1] += pull.im * pull.im;
    }
    for (alternative, truncation) in alternatives.iter_mut().zip(truncation_errors(&problem, &at)) {
        *alternative = alternative.or(truncation);
    }
    for (covariance, alternative) in covariance.iter_mut().zip(&alternatives) {
        covariance[0] += alternative.pole[0];
        covariance[1] += alternative.pole[1];
    }
    let fit = problem.fit(&at);
    let shape_variances = shape_variances(&problem, &at, &covariance);
    Some(SelectedModes {
        poles: at.poles,
        fit,
        covariance,
        shape_variances,
        alternative_shapes: alternatives.into_iter().map(|alternative| alternative.shape).collect(),
        significance,
        quality_warnings,
    })
}

/// Held poles, and how far the FRFs draw each away, at most by its decay rate: the scatter over the orders does not contain this
/// error of the model.
fn pulls(problem: &Problem, at: &FitPoint) -> Vec<(usize, Complex64)> {
    if at.poles.iter().all(|pole| !pole.held) {
        return Vec::new();
    }
    let free: Vec<Pole> = at.poles.iter().map(|pole| Pole { held: false, ..pole.clone() }).collect();
    let free = problem.refine(free, 0);
    let moved = problem.step(&free).damped_step(&free.poles, 0.0).map(|(poles, _)| poles);
    let pull = |m: usize| {
        let (pole, decay) = (&at.poles[m], at.poles[m].value.re.abs());
        // Undetermined: all of it.
        let all = Complex64::new(decay, decay);
        let by = moved.as_ref().map_or(all, |moved| moved[m].value - pole.value);
        let size = by.norm();
        if !size.is_finite() {
            return (m, all);
        }
        (m, by * (decay / size.max(decay)))
    };
    (0..at.poles.len()).filter(|m| at.poles[*m].held).map(pull).collect()
}

/// A pole of a mode that may be two, and the two.
struct MaybeTwo {
    value: Complex64,
    pair: [Pole; 2],
}

/// The fit with the pairs that are certain, and the modes that may be two.
fn with_pairs(
    problem: &Problem,
    before: RefinedModes,
    splits: Vec<Split>,
    settings: &Settings,
    dropped: &mut Vec<DroppedPole>,
) -> Option<(RefinedModes, Vec<MaybeTwo>)> {
    let (mut poles, mut maybe_two, mut pairs) = (Vec::new(), Vec::new(), Vec::new());
    for (pole, split) in before.at.poles.iter().zip(splits) {
        match split {
            Split::One(pole) => poles.push(pole),
            Split::Maybe(pair) => {
                maybe_two.push(MaybeTwo { value: pole.value, pair });
                poles.push(pole.clone());
            }
            Split::Two(pair) => {
                poles.extend(pair.clone());
                pairs.push(MaybeTwo { value: pole.value, pair });
            }
        }
    }
    if pairs.is_empty() {
        return Some((before, maybe_two));
    }
    let settled = settle(problem, poles, settings, dropped)?;
    // Of a pair a pole may be dropped again: the mode that remains may be two.
    let left = |MaybeTwo { value, pair: [a, b] }: &MaybeTwo| {
        let reach = value.re.abs() + (a.value - b.value).norm();
        settled.at.poles.iter().filter(|pole| (pole.value - value).norm() < reach).count()
    };
    maybe_two.extend(pairs.into_iter().filter(|pair| left(pair) < 2));
    Some((settled, maybe_two))
}

/// Poles at the minimum without faults.
struct RefinedModes {
    at: FitPoint,
    covariance: Vec<PoleCovariance>,
    significance: Vec<f64>,
    /// Poles that were dropped as duplicates of a mode that remains.
    duplicates: Vec<Pole>,
}

/// Refines poles to the minimum, drops faulty ones. `None` if no pole remains.
fn settle(
    problem: &Problem,
    poles: Vec<Pole>,
    settings: &Settings,
    dropped: &mut Vec<DroppedPole>,
) -> Option<RefinedModes> {
    let band = problem.data().band();
    // Splits that are left.
    let mut splits = poles.len();
    let mut at = problem.refine(poles, FINAL_STEPS);
    let mut duplicates = Vec::new();
    loop {
        if problem.data().stop.is_requested() {
            return None;
        }
        while let Some(fault) = remove_faulty_poles(problem, &at, None, settings, dropped) {
            if fault.left.is_empty() {
                return None;
            }
            duplicates.extend(fault.duplicate);
            at = problem.refine(fault.left, FINAL_STEPS);
        }
        if let Some((idle, reason)) = held_fault(problem, &at) {
            dropped.push(DroppedPole { value: at.poles[idle].value, reason: reason.into() });
            at = refined_without(problem, at, idle)?;
            continue;
        }
        let noise = covariance(problem.data(), &at, &problem.step(&at));
        let covariance = with_model_error(problem, &at, &noise);
        let significance = significance(&at);
        // The jackknife covariance exposes poles that fit the noise of a few lines; the error of the model, poles that fit the
        // misfit of a stronger mode.
        let fault = |m: usize| {
            let of = |covariance: PoleCovariance| {
                significance_fault(&at.poles[m], covariance, significance[m], band)
            };
            let near = stronger_neighbours(&at, m, &significance).next();
            of(noise[m]).or_else(|| near.and_then(|_| of(covariance[m])))
        };
        let worst = (0..at.poles.len())
            .filter(|&m| fault(m).is_some())
            .min_by(|&a, &b| significance[a].total_cmp(&significance[b]));
        let Some(worst) = worst else {
            return Some(RefinedModes { at, covariance, significance, duplicates });
        };
        // A mode that is uncertain because it is two.
        if splits > 0
            && let Some(pair) = pairs::certain_pair(problem, &at, worst, settings)
        {
            splits -= 1;
            let mut poles = at.poles;
            poles.remove(worst);
            poles.extend(pair);
            at = problem.refine(poles, FINAL_STEPS);
            continue;
        }
        dropped.extend(fault(worst));
        at = refined_without(problem, at, worst)?;
    }
}

/// A held pole that is no mode, and why: the orders share it for another reason.
fn held_fault(problem: &Problem, at: &FitPoint) -> Option<(usize, &'static str)> {
    let idle = (0..at.poles.len()).find(|&m| at.poles[m].held && problem.local_gain(at, m) < MIN_LOCAL_GAIN);
    if let Some(idle) = idle {
        return Some((idle, "stable, but explains little of the FRFs"));
    }
    let is_undetermined = |(m, pull): &(usize, Complex64)| {
        let value = at.poles[*m].value;
        at.poles[*m].is_inside(problem.data().band()) && pull.im.abs() > MAX_HELD_ERROR * value.im
    };
    let found = pulls(problem, at).into_iter().find(is_undetermined);
    found.map(|(m, _)| (m, "stable, but the FRFs do not determine its frequency"))
}

/// The minimum without a pole. `None` if no pole remains.
fn refined_without(problem: &Problem, at: FitPoint, m: usize) -> Option<FitPoint> {
    let mut poles = at.poles;
    poles.remove(m);
    (!poles.is_empty()).then(|| problem.refine(poles, FINAL_STEPS))
}

/// Poles that remain valid over a few steps of refinement.
fn prune_poles(
    problem: &Problem,
    mut poles: Vec<Pole>,
    settings: &Settings,
    dropped: &mut Vec<DroppedPole>,
) -> Option<Vec<Pole>> {
    loop {
        if problem.data().stop.is_requested() {
            return None;
        }
        let at = problem.refine(poles.clone(), TRIAL_STEPS);
        match remove_faulty_poles(problem, &at, Some(&poles), settings, dropped) {
            None => return Some(at.poles),
            Some(fault) if fault.left.is_empty() => return None,
            Some(fault) => poles = fault.left,
        }
    }
}

/// Poles without a faulty one.
struct Fault {
    left: Vec<Pole>,
    /// The pole that was removed as a duplicate of another.
    duplicate: Option<Pole>,
}

/// Poles left after removing faulty ones; `None` if there is no faulty one. Drifted poles are removed
/// together, or held if they are stable; of the others only the least significant: the rest may recover without it.
fn remove_faulty_poles(
    problem: &Problem,
    at: &FitPoint,
    started: Option<&[Pole]>,
    settings: &Settings,
    dropped: &mut Vec<DroppedPole>,
) -> Option<Fault> {
    let band = problem.data().band();
    let count = at.poles.len();
    let off: Vec<Option<DroppedPole>> =
        (0..count).map(|m| drift_fault(&at.poles[m], started.map(|s| s[m].value), band, settings)).collect();
    if off.iter().any(Option::is_some) {
        // Restart the remaining poles from their previous values: the drifted ones have biased them.
        let from = started.unwrap_or(&at.poles);
        let mut left = Vec::new();
        for (m, fault) in off.into_iter().enumerate() {
            let mut pole = from[m].clone();
            if let Some(fault) = fault {
                let Some(stable) = pole.stable.filter(|stable| stable.support >= MIN_HELD_SUPPORT) else {
                    dropped.push(fault);
                    continue;
                };
                (pole.value, pole.held) = (stable.value, true);
            }
            left.push(pole);
        }
        return Some(Fault { left, duplicate: None });
    }
    let significance = significance(at);
    let covariance = white_noise_covariance(at, &problem.step(at));
    let fault_of = |m: usize| {
        let weak = significance_fault(&at.poles[m], covariance[m], significance[m], band)
            .map(|fault| (fault, false));
        weak.or_else(|| Some((duplicate_fault(problem, at, m, &significance)?, true)))
    };
    let worst = (0..count)
        .filter_map(|m| Some((m, fault_of(m)?)))
        .min_by(|a, b| significance[a.0].total_cmp(&significance[b.0]));
    let (worst, (reason, duplicate)) = worst?;
    dropped.push(reason);
    let mut left = at.poles.clone();
    let removed = left.remove(worst);
    Some(Fault { left, duplicate: duplicate.then_some(removed) })
}

fn drift_fault(
    pole: &Pole,
    started: Option<Complex64>,
    band: [f64; 2],
    settings: &Settings,
) -> Option<DroppedPole> {
    if pole.held {
        return None;
    }
    let value = pole.value;
    let (hz, zeta) = (value.im / TAU, pole.damping_ratio());
    let fault = |reason: String| Some(DroppedPole { value: started.unwrap_or(value), reason });
    if zeta.is_nan() || zeta <= 0.0 {
        return fault("not positively damped when fitted to the FRFs".into());
    }
    if !pole.reaches_into(band) {
        return fault("outside the band when fitted to the FRFs".into());
    }
    if zeta > settings.largest_damping {
        return fault("damping above the limit when fitted to the FRFs".into());
    }
    if !pole.is_inside(band) {
        // The stabilisation diagram has no pole there that it could have drifted from.
        return None;
    }
    let moved = match (started, &pole.stable) {
        (Some(first), _) if (value.im / first.im - 1.0).abs() > MAX_FREQUENCY_DRIFT => true,
        (_, Some(stable)) if stable.support >= MIN_HELD_SUPPORT => has_drifted(value, stable),
        _ => false,
    };
    if moved { fault(format!("moves to {hz:.3} Hz when fitted to the FRFs")) } else { None }
}

/// Whether a pole has left the stable pole that it was refined from.
fn has_drifted(value: Complex64, stable: &StablePole) -> bool {
    let first = stable.value;
    let far = (MAX_FREQUENCY_DRIFT * first.im).max(first.re.abs());
    let broad = damping_ratio(value) > (MAX_DAMPING_GROWTH * damping_ratio(first)).max(MIN_BROAD_DAMPING);
    (value.im - first.im).abs() > far || broad
}

fn significance_fault(
    pole: &Pole,
    covariance: PoleCovariance,
    significance: f64,
    band: [f64; 2],
) -> Option<DroppedPole> {
    let (frequency, damping) = standard_errors(pole.value, covariance);
    let zeta = pole.damping_ratio();
    let fault = |reason: String| Some(DroppedPole { value: pole.value, reason });
    if significance < MIN_SIGNIFICANCE {
        return fault(format!("not significant against noise (F = {significance:.1})"));
    }
    // A mode outside is no result: it takes up what it does in the band.
    let uncertain = pole.is_inside(band)
        && (frequency > MAX_FREQUENCY_ERROR * pole.value.im / TAU || damping > MAX_DAMPING_ERROR * zeta);
    if uncertain {
        fault(format!("standard error too large ({frequency:.2e} Hz, damping {:.2e} %)", 100.0 * damping))
    } else {
        None
    }
}

/// Distance, in decay rates, below which two poles may be duplicates.
const MAX_DUPLICATE_DISTANCE: f64 = 3.0;
/// Minimum number of outputs, and MAC of the shapes, for two close poles to be duplicates.
const MIN_DUPLICATE_OUTPUTS: usize = 8;
const MIN_DUPLICATE_MAC: f64 = 0.7;
/// Share of one output in |shape|² from which a mode moves that output alone.
const MIN_ALONE: f64 = 0.8;
/// |shape|² of an output over the mean of all, from which a mode moves it, and the share of nearly all outputs.
const MIN_MOTION: f64 = 0.01;
const MOST_OUTPUTS: f64 = 0.75;

/// Duplicate pole: whether a more significant mode close to this one has the same shape, or this one moves one output alone
/// that the other moves too (or all but that one: the poles part there). Inconsistent FRFs (a structure that changed between hits, an output measured at another time)
/// give one mode twice.
///
/// MAC of the shapes as measured or as scaled for the fit: the fit's weights amplify outputs of small motion,
/// over which duplicates split at random.
fn duplicate_fault(problem: &Problem, at: &FitPoint, m: usize, significance: &[f64]) -> Option<DroppedPole> {
    let data = problem.data();
    let fitted = |m: usize| (0..at.x.ncols()).map(|o| at.shape(m, o)).collect::<Vec<_>>();
    let measured = |m: usize| {
        let scaled = fitted(m).into_iter().zip(&data.output_scale);
        scaled.map(|(v, scale)| v * *scale).collect::<Vec<_>>()
    };
    let alone = the_only_output(&fitted(m)).filter(|o| the_only_output(&measured(m)) == Some(*o));
    let other = stronger_neighbours(at, m, significance).find(|&k| {
        let shape_mac = || mac(&fitted(m), &fitted(k)).max(mac(&measured(m), &measured(k)));
        let are_two = || {
            let (fit, pair) = (problem.fit(at), [&at.poles[m], &at.poles[k]]);
            are_two(data, &at.poles, &fit, &[m, k], pair, MIN_DUPLICATE_MAC)
        };
        at.x.ncols() >= MIN_DUPLICATE_OUTPUTS
            && (alone.is_some_and(|o| moves(&measured(k), o)) || shape_mac() > MIN_DUPLICATE_MAC)
            && !are_two()
    })?;
    let reason = format!("duplicate of the mode at {:.3} Hz", at.poles[other].value.im / TAU);
    Some(DroppedPole { value: at.poles[m].value, reason })
}

/// The output that a shape moves almost alone.
fn the_only_output(shape: &[Complex64]) -> Option<usize> {
    let all: f64 = shape.iter().map(|v| v.norm_sqr()).sum();
    shape.iter().position(|v| v.norm_sqr() > MIN_ALONE * all)
}

/// Whether a shape moves an output, or nearly all others.
fn moves(shape: &[Complex64], output: usize) -> bool {
    let mean = shape.iter().map(|v| v.norm_sqr()).sum::<f64>() / shape.len() as f64;
    let moved = shape.iter().filter(|v| v.norm_sqr() > MIN_MOTION * mean).count();
    shape[output].norm_sqr() > MIN_MOTION * mean || moved as f64 > MOST_OUTPUTS * shape.len() as f64
}

/// More significant modes so close to a mode that it may be a duplicate of them.
fn stronger_neighbours<'a>(
    at: &'a FitPoint,
    m: usize,
    significance: &'a [f64],
) -> impl Iterator<Item = usize> + 'a {
    let own = at.poles[m].value;
    (0..at.poles.len()).filter(move |&k| {
        let other = at.poles[k].value;
        let near = (own - other).norm() < MAX_DUPLICATE_DISTANCE * own.re.abs().max(other.re.abs());
        k != m && significance[k] > significance[m] && near
    })
}

//! Modes by stabilisation over the orders, with standard errors; harmonics and spurious poles are dropped by name.

use std::f64::consts::TAU;

use rotordyn_linalg::Complex64;
use rotordyn_signal::record::Dof;

use super::correlation::Correlations;
use super::prepare::Prepared;
use super::result::{Harmonic, OperationalMode};
use super::subspace::{Realisation, Subspace};
use super::uncertainty::{Place, variances};
use crate::plscf::normalise_largest;
use crate::pole_selection::clusters;
use crate::stabilisation::Candidate;
use crate::{IdentifyError, mac, uncertainty::standard_errors, whirl};

/// All that a selection needs.
pub(super) struct Search<'a> {
    pub data: &'a Prepared,
    pub space: &'a Subspace,
    pub correlations: &'a Correlations,
    pub rows: usize,
    pub orders: &'a [usize],
    pub candidates: &'a [Candidate],
    pub harmonics: &'a [Harmonic],
    pub dofs: &'a [Dof],
}

/// Modes, dropped poles and warnings.
pub(super) struct Selection {
    pub modes: Vec<OperationalMode>,
    pub dropped: Vec<String>,
    pub warnings: Vec<String>,
}

/// Least part of the orders that show a mode.
const MIN_SUPPORT: f64 = 0.25;
/// Relative standard error of the damping ratio above which a pole is no mode.
const MAX_DAMPING_ERROR: f64 = 0.4;
/// Damping ratio below which a pole at a harmonic is the harmonic, whatever the width of its line.
const SINE_DAMPING: f64 = 3e-4;
/// Decay rate times duration below which the record cannot determine the damping: its relative error is
/// √(1/(a T)) at best, 14 %.
const MIN_DECAYS: f64 = 50.0;

/// Poles of a cluster whose variance is computed; the one with the least is the mode.
const TRIED: usize = 5;

/// A pole of a cluster with its model.
struct Chosen<'a> {
    cluster: usize,
    candidate: &'a Candidate,
    model: &'a Realisation,
    vector: usize,
    largest: usize,
    support: f64,
}

/// Selects the modes.
pub(super) fn select(search: &Search) -> Result<Selection, IdentifyError> {
    let Search { space, orders, candidates, .. } = search;
    // Of every cluster the poles nearest to its median, with its support.
    let mut found: Vec<(usize, &Candidate, f64)> = Vec::new();
    let mut stable = clusters(candidates, orders.len());
    stable.retain(|cluster| cluster.score > MIN_SUPPORT * orders.len() as f64);
    // Orders without room for all modes (two per mode) give weak ones a bias without a variance.
    let enough = 2 * stable.len();
    for (k, cluster) in stable.into_iter().enumerate() {
        let mut members: Vec<&Candidate> = cluster.members.iter().map(|&k| &candidates[k]).collect();
        if members.iter().any(|m| orders[m.order] >= enough) {
            members.retain(|m| orders[m.order] >= enough);
        }
        let off = |x: &Candidate| (x.pole.value - cluster.value).norm();
        members.sort_by(|a, b| off(a).total_cmp(&off(b)));
        let support = cluster.score / orders.len() as f64;
        found.extend(members.into_iter().take(TRIED).map(|member| (k, member, support)));
    }
    let mut models: Vec<(usize, Realisation)> = Vec::new();
    for (_, candidate, _) in &found {
        if !models.iter().any(|(order, _)| *order == candidate.order)
            && let Some(model) = space.realisation(orders[candidate.order])?
        {
            models.push((candidate.order, model));
        }
    }
    let chosen: Vec<Chosen> = found
        .iter()
        .filter_map(|(cluster, candidate, support)| {
            let model = &models.iter().find(|(order, _)| *order == candidate.order)?.1;
            let off = |k: &usize| (space.pole(model.mu[*k]) - candidate.pole.value).norm();
            let vector = (0..model.mu.len()).min_by(|a, b| off(a).total_cmp(&off(b)))?;
            let size = |k: &usize| candidate.shape[*k].norm();
            let largest = (0..candidate.shape.len()).max_by(|a, b| size(a).total_cmp(&size(b)))?;
            Some(Chosen { cluster: *cluster, candidate, model, vector, largest, support: *support })
        })
        .collect();
    let places: Vec<Place> =
        chosen.iter().map(|c| Place { model: c.model, vector: c.vector, largest: c.largest }).collect();
    let spread = variances(space, search.correlations, search.rows, &places);
    // A spurious pole beside a mode at one order inflates its variance there.
    let variance = |k: usize| spread[k].pole[0] + spread[k].pole[1];
    let mut best: Vec<usize> = Vec::new();
    for k in 0..chosen.len() {
        match best.iter_mut().find(|b| chosen[**b].cluster == chosen[k].cluster) {
            Some(known) if variance(k) < variance(*known) => *known = k,
            Some(_) => {}
            None => best.push(k),
        }
    }
    let mut modes: Vec<OperationalMode> =
        best.into_iter().map(|k| mode(search, &chosen[k], &spread[k])).collect();
    modes.sort_by(|a, b| a.pole.im.total_cmp(&b.pole.im));
    Ok(judge(search, modes))
}

fn mode(search: &Search, chosen: &Chosen, spread: &super::uncertainty::ModeVariance) -> OperationalMode {
    let data = search.data;
    let pole = chosen.candidate.pole.value;
    let factors = data.to_one_quantity(pole);
    let scaled: Vec<_> = chosen.candidate.shape.iter().zip(&factors).map(|(v, s)| v * *s).collect();
    let largest = scaled.iter().map(|v| v.norm()).fold(f64::MIN_POSITIVE, f64::max);
    let shape_error: Vec<f64> =
        spread.shape.iter().zip(&factors).map(|(v, s)| v.sqrt() * s.norm() / largest).collect();
    let (frequency_error, damping_error) = standard_errors(pole, spread.pole);
    let energy: f64 = search.correlations.mean.iter().map(|r| r.norm_squared()).sum();
    let lags = search.correlations.mean.len();
    let shape = normalise_largest(scaled);
    OperationalMode {
        pole,
        frequency_error,
        damping_error,
        collinearity: mac::phase_collinearity(&shape),
        whirl: moves_across(search.dofs, &shape, &shape_error)
            .then(|| whirl::whirl(search.dofs, &shape))
            .flatten(),
        contribution: search.space.contribution(chosen.model, chosen.vector, lags, energy),
        support: chosen.support,
        order: search.orders[chosen.candidate.order],
        shape,
        shape_error,
        notes: Vec::new(),
    }
}

/// Whether a shape moves across the shaft by more than twice its standard error; a torsional one may not.
fn moves_across(dofs: &[Dof], shape: &[Complex64], error: &[f64]) -> bool {
    let across = || (0..dofs.len()).filter(|&k| matches!(dofs[k].direction.abs(), 1 | 2));
    let moved: f64 = across().map(|k| shape[k].norm_sqr()).sum();
    moved > 4.0 * across().map(|k| error[k] * error[k]).sum::<f64>()
}

/// Separates modes from harmonics and spurious poles; names what is doubtful.
fn judge(search: &Search, all: Vec<OperationalMode>) -> Selection {
    let mut out = Selection { modes: Vec::new(), dropped: Vec::new(), warnings: Vec::new() };
    let duration = search.data.duration();
    let is_harmonic: Vec<Option<&Harmonic>> = (0..all.len()).map(|k| harmonic_of(search, &all, k)).collect();
    for (mut mode, harmonic) in all.into_iter().zip(is_harmonic) {
        let (hz, zeta) = (mode.frequency_hz(), mode.damping_ratio());
        let name = format!("{hz:.3} Hz, {:.3} %", 100.0 * zeta);
        if let Some(line) = harmonic {
            let of = line.order.map_or(String::new(), |order| format!(", order {order}"));
            out.dropped.push(format!(
                "{name}: a sine at {:.3} Hz{of} (excess kurtosis {:.2} in its band; -1.5 is a sine)",
                line.frequency, line.kurtosis
            ));
            continue;
        }
        if mode.damping_error.is_nan() || mode.damping_error > MAX_DAMPING_ERROR * zeta {
            out.dropped.push(format!(
                "{name}: spurious, or too weak: the standard error of its damping is {:.0} %",
                100.0 * mode.damping_error / zeta
            ));
            continue;
        }
        if let Some(end) = search.data.band.into_iter().find(|end| (end - hz).abs() < zeta * hz) {
            out.dropped.push(format!("{name}: its peak reaches beyond the band, which ends at {end:.3} Hz"));
            continue;
        }
        if let Some(line) = lines(search).find(|h| (h.frequency - hz).abs() < 0.5 * zeta * hz) {
            let what = if line.removed { "removed before" } else { "in the record" };
            mode.notes.push(format!("a harmonic at {:.3} Hz, {what}, lies in its peak", line.frequency));
        }
        let decays = -mode.pole.re * duration;
        if decays < MIN_DECAYS {
            mode.notes.push(format!(
                "the record is {decays:.0} times its time constant; {MIN_DECAYS:.0} or more are needed for the damping"
            ));
            out.warnings.push(format!(
                "short record: the mode at {hz:.3} Hz with {:.3} % needs {:.0} s for its damping (1/(2πfζ) times \
                 {MIN_DECAYS:.0}), the record has {duration:.0} s",
                100.0 * zeta,
                MIN_DECAYS / -mode.pole.re,
            ));
        }
        out.modes.push(mode);
    }
    out
}

/// Swept over a range of this part of its frequency a harmonic is no line.
const MAX_SWEEP: f64 = 0.02;

/// Harmonics at a fixed frequency.
fn lines<'a>(search: &'a Search) -> impl Iterator<Item = &'a Harmonic> {
    search.harmonics.iter().filter(|h| h.half_width < MAX_SWEEP * h.frequency || h.order.is_none())
}

/// The harmonic that the pole k is, if it is one: near a line, narrower than it, and the least damped pole there.
fn harmonic_of<'a>(search: &'a Search, all: &[OperationalMode], k: usize) -> Option<&'a Harmonic> {
    let mode = &all[k];
    let resolution = 1.0 / search.data.duration();
    let near = |m: &OperationalMode, line: &Harmonic| {
        let off = (m.frequency_hz() - line.frequency).abs();
        off < line.half_width.max(2.0 * resolution) + 2.0 * m.frequency_error.min(line.half_width)
    };
    let hz = mode.frequency_hz();
    let half_width = -mode.pole.re / TAU;
    lines(search).find(|line| {
        let limit = line.half_width.max(SINE_DAMPING * hz).max(2.0 * resolution);
        let least = all.iter().filter(|m| near(m, line)).all(|m| -m.pole.re >= -mode.pole.re);
        near(mode, line) && half_width < limit && least
    })
}

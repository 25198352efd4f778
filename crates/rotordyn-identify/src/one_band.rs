//! Identification of one band: poles, selection, refinement, and their result in the units of the FRFs.

use std::f64::consts::TAU;

use super::data::Data;
use super::mode_selection::{SelectedModes, select_modes};
use super::plscf::{NormalEquations, Pole, normalise_largest};
use super::result::{
    DiagramPole, DroppedPole, ModalIdentification, Mode, QualityWarning, fit_error, total_error,
};
use super::{IdentifyError, Settings, lsfd, mac, pole_selection, stabilisation, uncertainty, whirl};
use rotordyn_linalg::Complex64;
use rotordyn_signal::Quantity;
use rotordyn_signal::record::FrfMatrix;

/// Lowest order tried.
const LOWEST_ORDER: usize = 2;
/// Phase collinearity below which a mode without whirl is doubtful, and the least number of points for it.
const MIN_COLLINEARITY: f64 = 0.7;
const MIN_COLLINEAR_POINTS: usize = 3;
/// Whirl measure below which an orbit counts as a straight line.
const STRAIGHT: f64 = 0.1;

/// Scatter of the poles of most orders, relative to their size, up to which they are one pole that is left out for its damping.
const LEFT_OUT_SCATTER: f64 = 0.05;

/// Identifies the modes of prepared FRFs in one band.
pub(super) fn identify_band(
    frfs: &FrfMatrix,
    settings: &Settings,
    mut data: Data,
) -> Result<ModalIdentification, IdentifyError> {
    let equations = NormalEquations::new(&data, settings)?;
    let orders: Vec<usize> = (LOWEST_ORDER..=data.max_order(settings)).collect();
    let (poles, too_damped) = split_by_damping(equations.poles(&orders)?, settings.largest_damping);
    let candidates = stabilisation::candidates(&data, poles)?;
    let diagram = stabilisation::diagram(&candidates, &orders);
    let poles = pole_selection::select_poles(&data, &candidates, orders.len());
    let mut dropped = poles_left_out(&too_damped, settings.largest_damping);
    let selected =
        if poles.is_empty() { None } else { select_modes(&mut data, poles, settings, &mut dropped) };
    IdentifyError::if_stopped(&settings.stop)?;
    let Some(found) = selected else {
        let ([from, to], poles, orders) = (data.band(), candidates.len(), orders.len());
        return Err(IdentifyError::NoMode { from, to, poles, orders, dropped });
    };
    // A pole may be dropped before and after the reweighting.
    let earlier = std::mem::take(&mut dropped);
    for pole in earlier {
        dropped.retain(|known: &DroppedPole| known.value != pole.value);
        dropped.push(pole);
    }
    Ok(assemble_result(frfs, settings, &data, found, diagram, orders, dropped))
}

/// The poles of every order up to a damping ratio, and those above.
fn split_by_damping(poles: Vec<Vec<Pole>>, largest: f64) -> (Vec<Vec<Pole>>, Vec<Vec<Pole>>) {
    poles.into_iter().map(|own| own.into_iter().partition(|pole| pole.damping_ratio() <= largest)).unzip()
}

/// Poles above the largest damping ratio that half of the orders or more share, from below.
fn poles_left_out(orders: &[Vec<Pole>], largest: f64) -> Vec<DroppedPole> {
    let near = |a: Complex64, b: Complex64| (a - b).norm() < LEFT_OUT_SCATTER * b.norm();
    let shared_by = |value: Complex64, orders: &[Vec<Complex64>]| {
        orders.iter().filter(|own| own.iter().any(|other| near(*other, value))).count()
    };
    let mut left: Vec<Vec<Complex64>> =
        orders.iter().map(|own| own.iter().map(|pole| pole.value).collect()).collect();
    let mut out = Vec::new();
    // The pole that most orders share; then the next, without those that are near it.
    while let Some((count, value)) =
        left.iter().flatten().map(|value| (shared_by(*value, &left), *value)).max_by_key(|(count, _)| *count)
    {
        if 2 * count < orders.len() {
            break;
        }
        let reason = format!("damping above the limit of {:.0} %", 100.0 * largest);
        out.push(DroppedPole { value, reason });
        left.iter_mut().for_each(|own| own.retain(|other| !near(*other, value)));
    }
    out.sort_by(|a, b| a.value.im.total_cmp(&b.value.im));
    out
}

fn assemble_result(
    frfs: &FrfMatrix,
    settings: &Settings,
    data: &Data,
    found: SelectedModes,
    diagram: Vec<DiagramPole>,
    orders: Vec<usize>,
    mut dropped: Vec<DroppedPole>,
) -> ModalIdentification {
    let model = found.fit.synthesise(data, &found.poles);
    let scale = |o: usize, i: usize| data.output_scale[o] * data.input_scale[i];
    let (responses, references) = (frfs.responses.len(), frfs.references.len());
    let place = |r: usize, e: usize| if data.swapped { (e, r) } else { (r, e) };
    let table = |of: &dyn Fn(usize, usize) -> f64| -> Vec<Vec<f64>> {
        (0..responses)
            .map(|r| {
                (0..references)
                    .map(|e| {
                        let (o, i) = place(r, e);
                        of(o, i)
                    })
                    .collect()
            })
            .collect()
    };
    let curves = |of: &[Vec<Vec<Complex64>>]| -> Vec<Vec<Vec<Complex64>>> {
        let one = |r: usize, e: usize| {
            let (o, i) = place(r, e);
            of[o][i].iter().map(|h| h * scale(o, i)).collect()
        };
        (0..responses).map(|r| (0..references).map(|e| one(r, e)).collect()).collect()
    };
    let errors = table(&|o, i| fit_error(&data.values[o][i], &model[o][i]));
    let mut modes: Vec<Mode> = (0..found.poles.len())
        .map(|m| {
            let pole = &found.poles[m];
            // The larger side carries the residue's magnitude, the smaller has a largest entry of 1.
            let mut small: Vec<Complex64> =
                pole.participation.iter().zip(&data.input_scale).map(|(l, b)| l * *b).collect();
            let before = small.clone();
            small = normalise_largest(small);
            let k = lsfd::normalised_input(&Pole::new(pole.value, before.clone()));
            let large: Vec<Complex64> =
                found.fit.shapes[m].iter().zip(&data.output_scale).map(|(v, a)| v * *a * before[k]).collect();
            let (frequency_error, damping_error) =
                uncertainty::standard_errors(pole.value, found.covariance[m]);
            let collinearity = mac::phase_collinearity(&large);
            let points = large.len();
            let (shape, participation) = if data.swapped { (small, large) } else { (large, small) };
            let whirl = whirl::whirl(&frfs.responses, &shape)
                .or_else(|| whirl::whirl(&frfs.references, &participation).map(|w| -w));
            let mut quality_warnings = found.quality_warnings[m].clone();
            let straight = whirl.is_none_or(|w| w.abs() < STRAIGHT);
            if straight && points >= MIN_COLLINEAR_POINTS && collinearity < MIN_COLLINEARITY {
                quality_warnings.push(QualityWarning::LowCollinearity);
            }
            Mode {
                pole: pole.value + settings.added_decay,
                shape,
                participation,
                frequency_error,
                damping_error,
                collinearity,
                whirl,
                significance: found.significance[m],
                quality_warnings,
            }
        })
        .collect();
    let [first, last] = data.band();
    modes.retain(|mode| {
        let hz = mode.pole.im / TAU;
        let inside = (first..=last).contains(&hz);
        if !inside {
            let reason = "outside the band; part of the fit".into();
            dropped.push(DroppedPole { value: mode.pole, reason });
        }
        inside
    });
    modes.sort_by(|a, b| a.pole.im.total_cmp(&b.pole.im));
    ModalIdentification {
        modes,
        responses: frfs.responses.clone(),
        references: frfs.references.clone(),
        quantity: [Quantity::Displacement, Quantity::Velocity, Quantity::Acceleration][data.power as usize],
        frequencies: data.frequencies.clone(),
        measured: curves(&data.values),
        synthesised: curves(&model),
        total_error: total_error(&errors),
        errors,
        upper: table(&|o, i| found.fit.upper[o][i] * scale(o, i)),
        lower: table(&|o, i| found.fit.lower[o][i] * scale(o, i)),
        diagram,
        orders,
        dropped,
        bands: vec![data.band()],
    }
}

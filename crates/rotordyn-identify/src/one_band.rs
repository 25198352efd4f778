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
/// Standard error of a shape, as √(1 − MAC), above which a low phase collinearity is taken for an error of the shape; below, for
/// a property of the mode.
const MIN_SHAPE_ERROR: f64 = 0.02;
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
            let mut shape_error = shape_error(&large, |o| {
                found.shape_variances[m][o] * (data.output_scale[o] * before[k].norm()).powi(2)
            });
            shape_error = shape_error.hypot(found.alternative_shapes[m].sqrt()).min(1.0);
            let collinearity = mac::phase_collinearity(&large);
            let points = large.len();
            let (shape, participation) = if data.swapped { (small, large) } else { (large, small) };
            let whirl = whirl::whirl(&frfs.responses, &shape)
                .or_else(|| whirl::whirl(&frfs.references, &participation).map(|w| -w));
            let mut quality_warnings = found.quality_warnings[m].clone();
            let straight = whirl.is_none_or(|w| w.abs() < STRAIGHT);
            if straight && points >= MIN_COLLINEAR_POINTS && collinearity < MIN_COLLINEARITY {
                quality_warnings.push(QualityWarning::LowCollinearity);
                if shape_error > MIN_SHAPE_ERROR {
                    shape_error = shape_error.max(out_of_phase_error(collinearity));
                }
            }
            Mode {
                pole: pole.value + settings.added_decay,
                shape,
                participation,
                frequency_error,
                damping_error,
                shape_error,
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
    let measured = curves(&data.values);
    ModalIdentification {
        modes,
        responses: frfs.responses.clone(),
        references: frfs.references.clone(),
        quantity: [Quantity::Displacement, Quantity::Velocity, Quantity::Acceleration][data.power as usize],
        frequencies: data.frequencies.clone(),
        total_error: total_error(&errors, &measured),
        measured,
        synthesised: curves(&model),
        errors,
        upper: table(&|o, i| found.fit.upper[o][i] * scale(o, i)),
        lower: table(&|o, i| found.fit.lower[o][i] * scale(o, i)),
        diagram,
        orders,
        dropped,
        bands: vec![data.band()],
    }
}

/// Standard deviation of √(1 − MAC) of a shape by the errors of its points, of E|δψ|² each; the part along the shape, one of n
/// points, does not change the MAC.
fn shape_error(shape: &[Complex64], variance: impl Fn(usize) -> f64) -> f64 {
    let size: f64 = shape.iter().map(|v| v.norm_sqr()).sum();
    let error: f64 = (0..shape.len()).map(variance).sum();
    let across = 1.0 - 1.0 / shape.len() as f64;
    if size > 0.0 { (across * error / size).min(1.0).sqrt() } else { 0.0 }
}

/// √(1 − √MPC), the error of a shape as √(1 − MAC) if its out-of-phase part is error, which is then as large in phase: the
/// out-of-phase part is (1 − √MPC)/2 of its square.
fn out_of_phase_error(collinearity: f64) -> f64 {
    (1.0 - collinearity.sqrt()).max(0.0).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn error_of_a_shape_by_its_points_and_by_its_out_of_phase_part() {
        // In phase 1, out of phase 0.5: 0.2 of the square is out of phase, and twice that is error.
        let shape = [Complex64::new(1.0, 0.0), Complex64::new(0.0, 0.5)];
        let error = out_of_phase_error(mac::phase_collinearity(&shape));
        assert!((error - 0.4f64.sqrt()).abs() < 1e-12, "{error}");
        // Half of the error 0.1² at two points is across the shape.
        let error = shape_error(&shape, |_| 0.01);
        assert!((error - (0.5 * 0.02 / 1.25f64).sqrt()).abs() < 1e-12, "{error}");
        assert_eq!(shape_error(&shape, |_| f64::INFINITY), 1.0);
    }
}

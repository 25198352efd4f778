//! Figures of an identification: stabilisation diagram, auto-MAC, synthesised FRFs, mode shapes.

use std::collections::BTreeSet;
use std::f64::consts::TAU;

use nalgebra::DMatrix;

use super::Named;
use super::display_unit::typographic_unit;
use super::geometry_lines::lines_between_points;
use crate::{Figure, Frf, FrfCurve, Matrix, PoleStability, Stabilisation, WireShape, Wireframe};
use rotordyn_core::model::Quantity;
use rotordyn_identify::operational::{OperationalMode, OperationalModes};
use rotordyn_identify::{DiagramPole, ModalIdentification, Mode, Stability};
use rotordyn_linalg::Complex64;
use rotordyn_signal::record::{Dof, FrfMatrix, Geometry};

/// Number of FRFs drawn, evenly spread from the best to the worst fit.
const MAX_FITS_DRAWN: usize = 6;

/// All figures of an identification.
pub fn figures(
    found: &ModalIdentification,
    frfs: &FrfMatrix,
    geometry: &Geometry,
    title: &str,
) -> Vec<Named> {
    let selected: Vec<f64> = found.modes.iter().map(Mode::frequency_hz).collect();
    let doubtful = found.modes.iter().map(|m| !m.quality_warnings.is_empty());
    let dropped = found.dropped.iter().map(|pole| (pole.value.im / TAU, pole.reason.clone()));
    let mut figures = vec![stabilisation(
        &found.diagram,
        selected.iter().copied().zip(doubtful).collect(),
        dropped.collect(),
        found.frequencies.clone(),
        ("mode indicator", mode_indicator(found)),
        title,
    )];
    if found.modes.len() > 1 && found.larger_side_shape(&found.modes[0]).0.len() > 1 {
        let side = if found.references.len() > found.responses.len() { "references" } else { "responses" };
        let side = format!("the {} {side}", found.larger_side_shape(&found.modes[0]).0.len());
        figures.push(auto_mac(&selected, found.auto_mac(), &side, title));
    }
    figures.extend(fits(found, frfs, title));
    let modes: Vec<DrawnMode> = found
        .modes
        .iter()
        .map(|m| {
            let (dofs, shape) = found.larger_side_shape(m);
            DrawnMode { hz: m.frequency_hz(), zeta: m.damping_ratio(), dofs, shape }
        })
        .collect();
    figures.extend(shapes(&modes, geometry, title));
    figures
}

/// All figures of an output-only identification.
pub fn operational_figures(found: &OperationalModes, geometry: &Geometry, title: &str) -> Vec<Named> {
    let selected: Vec<f64> = found.modes.iter().map(OperationalMode::frequency_hz).collect();
    let curves = found.spectrum.values.iter().map(|v| v.iter().map(|v| v.sqrt()).collect()).collect();
    let mut figures = vec![stabilisation(
        &found.diagram,
        selected.iter().map(|hz| (*hz, false)).collect(),
        Vec::new(),
        found.spectrum.frequencies.clone(),
        ("singular values of the spectral matrix", curves),
        title,
    )];
    if found.modes.len() > 1 && found.dofs.len() > 1 {
        let side = format!("the {} channels", found.dofs.len());
        figures.push(auto_mac(&selected, found.auto_mac(), &side, title));
    }
    let modes: Vec<DrawnMode> = found
        .modes
        .iter()
        .map(|m| DrawnMode {
            hz: m.frequency_hz(),
            zeta: m.damping_ratio(),
            dofs: &found.dofs,
            shape: &m.shape,
        })
        .collect();
    figures.extend(shapes(&modes, geometry, title));
    figures
}

fn stabilisation(
    diagram: &[DiagramPole],
    selected: Vec<(f64, bool)>,
    dropped: Vec<(f64, String)>,
    hz: Vec<f64>,
    (curves_name, curves): (&str, Vec<Vec<f64>>),
    title: &str,
) -> Named {
    let state = |stability: Stability| match stability {
        Stability::New => PoleStability::New,
        Stability::Frequency => PoleStability::Frequency,
        Stability::Damping => PoleStability::Damping,
        Stability::Shape => PoleStability::Shape,
        Stability::Stable => PoleStability::Stable,
    };
    let pole_hz = |pole: Complex64| pole.im / TAU;
    let figure = Stabilisation {
        title: "Stabilisation diagram".into(),
        note: format!(
            "stable: within 1 % in frequency, 5 % in damping, MAC 0.95 of the previous order; {title}"
        ),
        poles: diagram.iter().map(|p| (pole_hz(p.value), p.order, state(p.stability))).collect(),
        curves_name: curves_name.into(),
        hz,
        curves,
        selected,
        dropped,
    };
    ("stabilisation".into(), Figure::Stabilisation(figure))
}

/// Complex mode indicator function (CMIF): singular values of the FRF matrix at every frequency line, each
/// response row divided by its RMS.
fn mode_indicator(found: &ModalIdentification) -> Vec<Vec<f64>> {
    let (responses, references) = (found.responses.len(), found.references.len());
    let values = responses.min(references).min(3);
    let mut out = vec![Vec::with_capacity(found.frequencies.len()); values];
    let rms = |frf: &[Complex64]| (frf.iter().map(|h| h.norm_sqr()).sum::<f64>() / frf.len() as f64).sqrt();
    let sizes: Vec<f64> = found
        .measured
        .iter()
        .map(|row| (row.iter().map(|frf| rms(frf).powi(2)).sum::<f64>() / references as f64).sqrt())
        .collect();
    for k in 0..found.frequencies.len() {
        let h = DMatrix::from_fn(responses, references, |r, e| found.measured[r][e][k] / sizes[r]);
        // Gram matrix of the smaller dimension: its eigenvalues are the squared singular values.
        let square = if responses > references { h.adjoint() * &h } else { &h * h.adjoint() };
        let mut sizes: Vec<f64> = square.symmetric_eigenvalues().iter().map(|v| v.max(0.0).sqrt()).collect();
        sizes.sort_by(|a, b| b.total_cmp(a));
        out.iter_mut().zip(sizes).for_each(|(curve, size)| curve.push(size));
    }
    out
}

fn auto_mac(hz: &[f64], mac: Vec<Vec<f64>>, side: &str, title: &str) -> Named {
    let names: Vec<String> = hz.iter().map(|hz| format!("{hz:.2} Hz")).collect();
    let figure = Matrix {
        title: "Auto-MAC of the identified mode shapes".into(),
        note: format!("{title}; over {side}"),
        rows: names.clone(),
        columns: names,
        value: mac.concat(),
        quantity: "MAC".into(),
        ..Matrix::default()
    };
    ("auto_mac".into(), Figure::Matrix(figure))
}

fn fits(found: &ModalIdentification, frfs: &FrfMatrix, title: &str) -> Vec<Named> {
    let mut order: Vec<(usize, usize)> =
        (0..found.responses.len()).flat_map(|r| (0..found.references.len()).map(move |e| (r, e))).collect();
    order.sort_by(|a, b| found.errors[a.0][a.1].total_cmp(&found.errors[b.0][b.1]));
    let count = order.len().min(MAX_FITS_DRAWN);
    let pick = |k: usize| order[if count > 1 { k * (order.len() - 1) / (count - 1) } else { 0 }];
    let (first, last) = (found.frequencies[0], found.frequencies[found.frequencies.len() - 1]);
    let inside: Vec<usize> = (0..frfs.frequencies.len())
        .filter(|&k| frfs.frequencies[k] >= first && frfs.frequencies[k] <= last)
        .collect();
    (0..count)
        .map(pick)
        .map(|(r, e)| {
            let curve = |label: &str, values: &[Complex64], coherence: Vec<f64>| FrfCurve {
                label: label.into(),
                hz: found.frequencies.clone(),
                re: values.iter().map(|v| v.re).collect(),
                im: values.iter().map(|v| v.im).collect(),
                coherence,
            };
            let coherence = frfs.coherence.as_ref();
            let coherence = coherence.map(|c| inside.iter().map(|&k| c[r][e][k]).collect());
            let (response, reference) = (found.responses[r], found.references[e]);
            let error = 100.0 * found.errors[r][e];
            let figure = Frf {
                title: format!("FRF: response {response}, reference {reference}, measured and synthesised"),
                note: format!("{title}; fit error {error:.2} % of this FRF"),
                quantity: name(found.quantity).into(),
                unit: match frfs.units[r][e].as_str() {
                    "" => "unknown unit".into(),
                    unit => typographic_unit(unit),
                },
                curves: vec![
                    curve("measured", &found.measured[r][e], coherence.unwrap_or_default()),
                    curve("synthesised", &found.synthesised[r][e], Vec::new()),
                ],
                apart: false,
            };
            let plain = |dof: Dof| dof.to_string().replace(['+', ':'], "");
            (format!("frf_fit_{}_{}", plain(response), plain(reference)), Figure::Frf(figure))
        })
        .collect()
}

fn name(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Displacement => "receptance",
        Quantity::Velocity => "mobility",
        Quantity::Acceleration => "accelerance",
    }
}

/// A mode on the wireframe.
struct DrawnMode<'a> {
    hz: f64,
    zeta: f64,
    dofs: &'a [Dof],
    shape: &'a [Complex64],
}

/// Mode shapes on the wireframe, if the geometry contains all measured points.
fn shapes(modes: &[DrawnMode], geometry: &Geometry, title: &str) -> Option<Named> {
    let dofs = modes.first()?.dofs;
    let index = |number: i64| geometry.nodes.iter().position(|n| n.number == number);
    if geometry.nodes.is_empty() || !dofs.iter().all(|d| index(d.node).is_some()) {
        return None;
    }
    let shape = |(k, mode): (usize, &DrawnMode)| {
        let (dofs, values) = (mode.dofs, mode.shape);
        // Rotate the phase to maximise the real part.
        let square: Complex64 = values.iter().map(|v| v * v).sum();
        let turn = Complex64::from_polar(1.0, -0.5 * square.arg());
        // Unmeasured points stay NaN and are omitted from the deflected lines.
        let mut motion = vec![[f64::NAN; 3]; geometry.nodes.len()];
        dofs.iter().filter_map(|d| index(d.node)).for_each(|at| motion[at] = [0.0; 3]);
        for (dof, value) in dofs.iter().zip(values).filter(|(d, _)| !d.is_rotation()) {
            let Some(at) = index(dof.node) else { continue };
            let (axis, sign) = match dof.direction {
                0 => (2, 1.0),
                d => (usize::from(d.unsigned_abs()) - 1, f64::from(d.signum())),
            };
            motion[at][axis] = sign * (turn * value).re;
        }
        WireShape { title: format!("{}: {:.2} Hz, {:.2} %", k + 1, mode.hz, 100.0 * mode.zeta), motion }
    };
    let figure = Wireframe {
        title: "Identified mode shapes".into(),
        note: format!("{title}; real part at the phase of the largest deflection"),
        points: geometry.nodes.iter().map(|n| n.position).collect(),
        strokes: lines_between_points(
            geometry,
            &dofs.iter().filter_map(|d| index(d.node)).collect::<BTreeSet<_>>(),
        ),
        shapes: modes.iter().enumerate().map(shape).collect(),
    };
    Some(("mode_shapes".into(), Figure::Wireframe(figure)))
}

//! Correlation of a model with measurements: MAC, frequency errors, FRF overlays, FRAC and FDAC.

use super::Named;
use super::display_unit::typographic_unit;
use crate::{Curve, Figure, Frf, FrfCurve, HeatMap, Lines, Matrix};
use rotordyn_core::model::Quantity;
use rotordyn_identify::mac::fdac;
use rotordyn_linalg::Complex64;
use rotordyn_update::correlation::frac_of_frfs;
use rotordyn_update::state::ModelState;
use rotordyn_update::target::{Sensor, Target, TargetFrfs, rotation_radius};

/// A state of the model, named "computed", "before" or "after", with its FRFs at the measured points.
pub struct Stage<'a> {
    pub name: &'a str,
    pub state: &'a ModelState,
    /// `[response][reference][line]`, if FRFs were measured.
    pub frfs: Option<&'a [Vec<Vec<Complex64>>]>,
}

/// Largest number of FRFs drawn, one figure each.
const MAX_FRFS: usize = 12;
/// Largest number of frequency lines along each FDAC axis.
const FDAC_LINES: usize = 200;

/// All figures of one measurement and the stages of a model; file names start with `prefix`.
pub fn figures(prefix: &str, title: &str, target: &Target, stages: &[Stage]) -> Vec<Named> {
    let mut out = vec![frequencies(prefix, title, target, stages)];
    for stage in stages {
        let tail = if stages.len() > 1 { format!("_{}", stage.name) } else { String::new() };
        out.push((format!("{prefix}_mac{tail}"), mac_matrix(title, target, stage)));
    }
    if let Some(measured) = &target.frfs {
        out.extend(overlays(prefix, measured, stages));
        for stage in stages {
            let tail = if stages.len() > 1 { format!("_{}", stage.name) } else { String::new() };
            if let Some(computed) = stage.frfs {
                out.push((format!("{prefix}_frac{tail}"), frac(title, measured, computed, stage)));
                out.push((format!("{prefix}_fdac{tail}"), fdac_map(title, measured, computed, stage)));
            }
        }
    }
    out
}

fn note(title: &str, stage: &Stage) -> String {
    if stage.name == "computed" { title.to_string() } else { format!("{title}, {}", stage.name) }
}

/// Frequency error of every mode pair in per cent.
fn frequencies(prefix: &str, title: &str, target: &Target, stages: &[Stage]) -> Named {
    let curves = stages.iter().map(|stage| {
        let pairs = &stage.state.pairing.pairs;
        let measured = |k: usize| target.modes[k].frequency_hz;
        let error = |p: &rotordyn_update::pairing::Pair| {
            100.0 * (stage.state.modes[p.computed].frequency_hz() / measured(p.measured) - 1.0)
        };
        Curve {
            label: stage.name.into(),
            x: pairs.iter().map(|p| measured(p.measured)).collect(),
            y: pairs.iter().map(error).collect(),
            points: true,
        }
    });
    let figure = Lines {
        title: "Error of computed natural frequencies".into(),
        note: title.into(),
        x_name: "measured frequency".into(),
        x_unit: "Hz".into(),
        y_name: "frequency error".into(),
        y_unit: "%".into(),
        x_range: Some([0.0, 1.05 * target.modes.iter().map(|m| m.frequency_hz).fold(1.0, f64::max)]),
        curves: curves.collect(),
        ..Lines::default()
    };
    (format!("{prefix}_frequencies"), Figure::Lines(figure))
}

fn mac_matrix(title: &str, target: &Target, stage: &Stage) -> Figure {
    let state = stage.state;
    let label = |m: &rotordyn_core::analysis::Mode| format!("{} {:.1} Hz", m.label, m.frequency_hz());
    Figure::Matrix(Matrix {
        title: "MAC of measured and computed modes".into(),
        note: format!("{}; mode pairs are framed", note(title, stage)),
        row_name: "measured".into(),
        column_name: "computed".into(),
        rows: target.modes.iter().map(|m| format!("{:.1} Hz", m.frequency_hz)).collect(),
        columns: state.modes.iter().map(label).collect(),
        value: state.pairing.mac.concat(),
        quantity: "MAC".into(),
        marked: state.pairing.pairs.iter().map(|p| (p.measured, p.computed)).collect(),
    })
}

fn overlays(prefix: &str, measured: &TargetFrfs, stages: &[Stage]) -> Vec<Named> {
    let mut out = Vec::new();
    let ends = (0..measured.references.len())
        .flat_map(|e| (0..measured.responses.len()).map(move |r| (r, e)))
        .filter(|&(r, e)| measured.is_nonzero(r, e))
        .take(MAX_FRFS);
    for (r, e) in ends {
        let Some(model) = stages.first().map(|s| &s.state.linearised.model) else { continue };
        let (response, reference) = (&measured.responses[r], &measured.references[e]);
        let curve = |label: &str, values: &[Complex64]| FrfCurve {
            label: label.into(),
            hz: measured.frequencies.clone(),
            re: values.iter().map(|v| v.re).collect(),
            im: values.iter().map(|v| v.im).collect(),
            coherence: Vec::new(),
        };
        let mut first = curve("measured", &measured.values[r][e]);
        if let Some(coherence) = &measured.coherence {
            first.coherence.clone_from(&coherence[r][e]);
        }
        let mut curves = vec![first];
        for stage in stages {
            curves.extend(stage.frfs.map(|frfs| curve(stage.name, &frfs[r][e])));
        }
        let (quantity, moved) = match measured.quantities[r] {
            Quantity::Displacement => ("receptance", "m"),
            Quantity::Velocity => ("mobility", "m/s"),
            Quantity::Acceleration => ("accelerance", "m/s^2"),
        };
        let unit_of = |rotation: bool, plain: &str, turned: &str| {
            if rotation { turned.to_string() } else { plain.into() }
        };
        let moved = unit_of(response.dof.is_rotation(), moved, &moved.replacen('m', "rad", 1));
        let unit = format!("({moved})/{}", unit_of(reference.dof.is_rotation(), "N", "(N m)"));
        let (from, to) = (reference.name(model), response.name(model));
        let figure = Frf {
            title: format!("FRF: response {to}, force at {from}"),
            note: "measured and computed".into(),
            quantity: quantity.into(),
            unit: typographic_unit(&unit),
            curves,
            apart: false,
        };
        out.push((format!("{prefix}_frf_{from}_{to}"), Figure::Frf(figure)));
    }
    out
}

fn frac(title: &str, measured: &TargetFrfs, computed: &[Vec<Vec<Complex64>>], stage: &Stage) -> Figure {
    let model = &stage.state.linearised.model;
    Figure::Matrix(Matrix {
        title: "FRAC: frequency response assurance criterion of every FRF".into(),
        note: note(title, stage),
        row_name: "response".into(),
        column_name: "force".into(),
        rows: measured.responses.iter().map(|s| s.name(model)).collect(),
        columns: measured.references.iter().map(|s| s.name(model)).collect(),
        value: frac_of_frfs(measured, computed).concat(),
        quantity: "FRAC".into(),
        marked: Vec::new(),
    })
}

fn fdac_map(title: &str, measured: &TargetFrfs, computed: &[Vec<Vec<Complex64>>], stage: &Stage) -> Figure {
    let every = measured.frequencies.len().div_ceil(FDAC_LINES).max(1);
    // Rotations and moments are weighted with a reference radius.
    let radius = rotation_radius(&stage.state.linearised.model);
    let weight = |of: &Sensor| if of.dof.is_rotation() { radius } else { 1.0 };
    let ends = || {
        let of_one = |r| measured.references.iter().map(move |e| weight(r) * weight(e));
        measured.responses.iter().flat_map(of_one)
    };
    let thin = |frfs: &[Vec<Vec<Complex64>>]| -> Vec<Vec<Complex64>> {
        let weighed = |(frf, w): (&Vec<Complex64>, f64)| frf.iter().step_by(every).map(|h| h * w).collect();
        frfs.iter().flatten().zip(ends()).map(weighed).collect()
    };
    let (a, b) = (thin(&measured.values), thin(computed));
    let (a, b): (Vec<&[Complex64]>, Vec<&[Complex64]>) =
        (a.iter().map(Vec::as_slice).collect(), b.iter().map(Vec::as_slice).collect());
    let lines: Vec<f64> = measured.frequencies.iter().step_by(every).copied().collect();
    let range = lines.first().copied().zip(lines.last().copied()).map(|(a, b)| [a, b]);
    Figure::HeatMap(HeatMap {
        title: "FDAC: frequency domain assurance criterion".into(),
        note: format!("{}; an off-diagonal ridge is a frequency shift", note(title, stage)),
        x_name: "computed, frequency".into(),
        x_unit: "Hz".into(),
        y_name: "measured, frequency".into(),
        y_unit: "Hz".into(),
        // First index of the map: computed frequency line.
        value: fdac(&b, &a).concat(),
        x: lines.clone(),
        y: lines,
        quantity: "FDAC".into(),
        x_range: range,
        y_range: range,
        diagonal: true,
        ..HeatMap::default()
    })
}

//! Identified modes (experimental modal analysis): what is written to files, and shapes for other programs.

use rotordyn_core::document::{Array, Document, Rows, Section, in_hdf5, in_json, named};
use rotordyn_identify::{DiagramPole, DroppedPole, ModalIdentification, Mode, QualityWarning};
use rotordyn_linalg::Complex64;
use rotordyn_signal::record::{Analysis, Dof, Geometry, MeasuredData, Shape};

/// The modes with their standard errors, the fit errors, messages on dropped poles, FRFs measured and synthesised, and
/// the stabilisation diagram.
pub fn section(found: &ModalIdentification) -> Section<'_> {
    Section::new("identified", "identified", document(found))
}

fn document(found: &ModalIdentification) -> Document<'_> {
    let names = |dofs: &[Dof]| dofs.iter().map(Dof::to_string).collect::<Vec<_>>();
    let (responses, references, modes) = (found.responses.len(), found.references.len(), found.modes.len());
    let band = [found.frequencies.first(), found.frequencies.last()];
    let band: Vec<f64> = band.iter().map(|end| end.copied().unwrap_or(f64::NAN)).collect();
    let frfs = |values: &[Vec<Vec<Complex64>>]| {
        let flat: Vec<Complex64> = values.iter().flatten().flatten().copied().collect();
        let shape = [responses, references, found.frequencies.len()];
        Array::complex(&shape, "as measured, SI", flat).over(2, "frequencies")
    };
    Document::new()
        .table(named("modes", ""), mode_rows(found))
        .texts("responses", names(&found.responses))
        .texts("references", names(&found.references))
        .numbers(in_json("band_hz"), "Hz", band)
        .integer(in_json("lines"), found.frequencies.len())
        .number(named("fit_error", "total_fit_error"), "1", found.total_error)
        .array(
            named("fit_errors", "fit_error"),
            Array::real(&[responses, references], "1", found.errors.concat()),
        )
        .texts("noise_only_frfs", noise_only_names(found))
        .array("auto_mac", Array::real(&[modes, modes], "1", found.auto_mac().concat()))
        .texts("dropped", found.dropped.iter().map(DroppedPole::to_string))
        .array(in_json("bands_hz"), Array::real(&[found.bands.len(), 2], "Hz", found.bands.concat()))
        .numbers(in_hdf5("frequencies"), "Hz", &found.frequencies)
        .array(in_hdf5("measured"), frfs(&found.measured))
        .array(in_hdf5("synthesised"), frfs(&found.synthesised))
        .group(in_hdf5("stabilisation"), diagram(&found.diagram))
}

/// FRFs of noise alone, such as "3:+x/1:+x".
pub fn noise_only_names(found: &ModalIdentification) -> Vec<String> {
    let name = |(r, e): (usize, usize)| format!("{}/{}", found.responses[r], found.references[e]);
    found.noise_only().into_iter().map(name).collect()
}

fn mode_rows<'r>(found: &'r ModalIdentification) -> Rows<'r, 'r, Mode> {
    // JSON has complex numbers as pairs.
    let pairs = |values: &[Complex64]| values.iter().flat_map(|v| [v.re, v.im]).collect::<Vec<f64>>();
    let (responses, references) = (found.responses.len(), found.references.len());
    Rows::of(&found.modes)
        .number(named("frequency_hz", "frequency"), "Hz", Mode::frequency_hz)
        .number(named("frequency_error_hz", "frequency_error"), "Hz", |m| m.frequency_error)
        .number("damping_ratio", "1", Mode::damping_ratio)
        .number("damping_ratio_error", "1", |m| m.damping_error)
        .numbers(in_json("pole"), "1/s", &[2], move |m| pairs(&[m.pole]))
        .numbers(in_json("shape"), "", &[responses, 2], move |m| pairs(&m.shape))
        .numbers(in_json("participation"), "", &[references, 2], move |m| pairs(&m.participation))
        .complex(in_hdf5("pole"), "1/s", |m| m.pole)
        .complex_numbers(in_hdf5("shape"), "", &[responses], |m| &m.shape)
        .complex_numbers(in_hdf5("participation"), "", &[references], |m| &m.participation)
        .number("phase_collinearity", "1", |m| m.collinearity)
        .optional("whirl", "1", |m| m.whirl)
        .number("significance", "1", |m| m.significance)
        .number(named("natural_frequency_hz", "natural_frequency"), "Hz", Mode::natural_frequency_hz)
        .text("quality_warnings", |m| {
            m.quality_warnings.iter().copied().map(QualityWarning::label).collect::<Vec<_>>().join("; ")
        })
}

/// Poles of all model orders with their stability.
pub(crate) fn diagram(poles: &[DiagramPole]) -> Document<'_> {
    let values: Vec<Complex64> = poles.iter().map(|p| p.value).collect();
    let orders: Vec<f64> = poles.iter().map(|p| p.order as f64).collect();
    Document::new()
        .array("pole", Array::complex(&[poles.len()], "1/s", values))
        .numbers("order", "1", orders)
        .texts("stability", poles.iter().map(|p| p.stability.label()))
}

/// Complex mode shapes at the points of the side (responses or references) with more DOFs, for universal files.
pub fn mode_shapes(found: &ModalIdentification, geometry: &Geometry) -> MeasuredData {
    let shape = |(k, mode): (usize, &Mode)| {
        let (dofs, values) = found.larger_side_shape(mode);
        shape_at_points(k, dofs, values, mode.pole)
    };
    MeasuredData {
        title: "identified modes".into(),
        shapes: found.modes.iter().enumerate().map(shape).collect(),
        geometry: geometry.clone(),
        ..MeasuredData::default()
    }
}

/// The shape of mode k, counted from 0, at the points of its DOFs; DOFs without a direction are assigned to z.
pub(crate) fn shape_at_points(k: usize, dofs: &[Dof], values: &[Complex64], pole: Complex64) -> Shape {
    let mut nodes: Vec<i64> = dofs.iter().map(|d| d.node).collect();
    nodes.sort_unstable();
    nodes.dedup();
    let components = if dofs.iter().any(|d| d.is_rotation()) { 6 } else { 3 };
    let mut out = vec![Complex64::default(); components * nodes.len()];
    for (dof, value) in dofs.iter().zip(values) {
        let Ok(node) = nodes.binary_search(&dof.node) else { continue };
        let (axis, sign) = match dof.direction {
            0 => (2, 1.0),
            d => (usize::from(d.unsigned_abs()) - 1, f64::from(d.signum())),
        };
        out[components * node + axis] = value * sign;
    }
    Shape {
        name: format!("mode {} {:.3} Hz", k + 1, pole.im / std::f64::consts::TAU),
        analysis: Analysis::ComplexMode { eigenvalue: pole, modal_a: 0.0.into(), modal_b: 0.0.into() },
        number: k as i64 + 1,
        components,
        nodes,
        values: out,
        complex: true,
        unit: String::new(),
    }
}

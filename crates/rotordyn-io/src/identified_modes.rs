//! Identified modes (experimental modal analysis) as JSON, HDF5 and shapes for other programs.

use serde_json::{Value, json};

use super::hdf5::{Attribute, Store};
use crate::error::Error;
use rotordyn_identify::{ModalIdentification, Mode};
use rotordyn_linalg::Complex64;
use rotordyn_signal::record::{Analysis, Dof, Geometry, MeasuredData, Shape};

/// The modes with their standard errors, the fit errors, and messages on dropped poles.
pub fn to_json(found: &ModalIdentification) -> Value {
    let names = |dofs: &[Dof]| dofs.iter().map(Dof::to_string).collect::<Vec<_>>();
    let complex = |values: &[Complex64]| values.iter().map(|v| json!([v.re, v.im])).collect::<Vec<_>>();
    let mode = |m: &Mode| {
        json!({
            "frequency_hz": m.frequency_hz(),
            "frequency_error_hz": m.frequency_error,
            "damping_ratio": m.damping_ratio(),
            "damping_ratio_error": m.damping_error,
            "pole": [m.pole.re, m.pole.im],
            "shape": complex(&m.shape),
            "participation": complex(&m.participation),
            "phase_collinearity": m.collinearity,
            "whirl": m.whirl,
            "significance": m.significance,
        })
    };
    json!({
        "modes": found.modes.iter().map(mode).collect::<Vec<_>>(),
        "responses": names(&found.responses),
        "references": names(&found.references),
        "band_hz": [found.frequencies.first(), found.frequencies.last()],
        "lines": found.frequencies.len(),
        "fit_error": found.total_error,
        "fit_errors": found.errors,
        "auto_mac": found.auto_mac(),
        "dropped": found.dropped,
    })
}

/// `/identified`: poles, mode shapes, modal participation, phase collinearity (MPC), FRFs measured and
/// synthesised, stabilisation diagram.
///
/// # Errors
/// The file cannot be written.
pub fn write_hdf5(store: &Store, found: &ModalIdentification) -> Result<(), Error> {
    let (n, responses, references) = (found.modes.len(), found.responses.len(), found.references.len());
    let own = |name: &str| format!("/identified/{name}");
    let unit = |unit: &str| vec![("unit", Attribute::from(unit))];
    let column = |name: &str, at: &str, of: &dyn Fn(&Mode) -> f64| {
        let values: Vec<f64> = found.modes.iter().map(of).collect();
        store.write(&own(name), &[n], &values, &unit(at))
    };
    column("frequency", "Hz", &|m| m.frequency_hz())?;
    column("frequency_error", "Hz", &|m| m.frequency_error)?;
    column("damping_ratio", "1", &|m| m.damping_ratio())?;
    column("damping_ratio_error", "1", &|m| m.damping_error)?;
    column("phase_collinearity", "1", &|m| m.collinearity)?;
    column("whirl", "1", &|m| m.whirl.unwrap_or(f64::NAN))?;
    let poles: Vec<Complex64> = found.modes.iter().map(|m| m.pole).collect();
    store.write_complex(&own("pole"), &[n], &poles, &unit("1/s"))?;
    let all = |of: &dyn Fn(&Mode) -> Vec<Complex64>| found.modes.iter().flat_map(of).collect::<Vec<_>>();
    store.write_complex(&own("shape"), &[n, responses], &all(&|m| m.shape.clone()), &[])?;
    let participation = all(&|m| m.participation.clone());
    store.write_complex(&own("participation"), &[n, references], &participation, &[])?;
    let names = |dofs: &[Dof]| dofs.iter().map(Dof::to_string).collect::<Vec<_>>();
    store.write_texts(&own("responses"), &names(&found.responses), &[])?;
    store.write_texts(&own("references"), &names(&found.references), &[])?;
    let lines = found.frequencies.len();
    store.write(&own("frequencies"), &[lines], &found.frequencies, &unit("Hz"))?;
    for (name, frfs) in [("measured", &found.measured), ("synthesised", &found.synthesised)] {
        let values: Vec<Complex64> = frfs.iter().flatten().flatten().copied().collect();
        store.write_complex(&own(name), &[responses, references, lines], &values, &[])?;
    }
    let errors: Vec<f64> = found.errors.iter().flatten().copied().collect();
    store.write(&own("fit_error"), &[responses, references], &errors, &unit("1"))?;
    let poles: Vec<Complex64> = found.diagram.iter().map(|p| p.value).collect();
    store.write_complex(&own("stabilisation/pole"), &[poles.len()], &poles, &unit("1/s"))?;
    let orders: Vec<f64> = found.diagram.iter().map(|p| p.order as f64).collect();
    store.write(&own("stabilisation/order"), &[orders.len()], &orders, &[])?;
    let stability: Vec<&str> = found.diagram.iter().map(|p| p.stability.label()).collect();
    store.write_texts(&own("stabilisation/stability"), &stability, &[])?;
    store.flush()
}

/// Complex mode shapes at the points of the side (responses or references) with more DOFs, for universal
/// files; DOFs without a direction are assigned to z.
pub fn mode_shapes(found: &ModalIdentification, geometry: &Geometry) -> MeasuredData {
    let shape = |(k, mode): (usize, &Mode)| {
        let (dofs, values) = found.larger_side_shape(mode);
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
            name: format!("mode {} {:.3} Hz", k + 1, mode.frequency_hz()),
            analysis: Analysis::ComplexMode {
                eigenvalue: mode.pole,
                modal_a: 0.0.into(),
                modal_b: 0.0.into(),
            },
            number: k as i64 + 1,
            components,
            nodes,
            values: out,
            complex: true,
            unit: String::new(),
        }
    };
    MeasuredData {
        title: "identified modes".into(),
        shapes: found.modes.iter().enumerate().map(shape).collect(),
        geometry: geometry.clone(),
        ..MeasuredData::default()
    }
}

//! Modes of a machine in operation: what is written to files, and shapes for other programs.

use rotordyn_core::document::{Array, Document, Rows, Section, in_hdf5, in_json, named};
use rotordyn_identify::operational::{OperationalMode, OperationalModes};
use rotordyn_linalg::Complex64;
use rotordyn_signal::record::{Dof, Geometry, MeasuredData};

use crate::identified_modes::{diagram, shape_at_points};

/// The modes with their standard errors, the harmonics, what was dropped and why, singular values of the spectral matrix,
/// and the stabilisation diagram.
pub fn section(found: &OperationalModes) -> Section<'_> {
    Section::new("operational", "operational", document(found))
}

fn document(found: &OperationalModes) -> Document<'_> {
    let modes = found.modes.len();
    Document::new()
        .table(named("modes", ""), mode_rows(found))
        .texts("channels", found.dofs.iter().map(Dof::to_string))
        .texts("references", found.references.iter().map(|k| found.dofs[*k].to_string()))
        .numbers("band_hz", "Hz", found.band.to_vec())
        .number("duration", "s", found.duration)
        .number("left_out", "s", found.left_out)
        .integer("blocks", found.blocks)
        .number("block_length", "s", found.block_length)
        .number("longest_lag", "s", found.longest_lag)
        .optional("shaft_speed", "1/s", found.shaft_speed)
        .array("auto_mac", Array::real(&[modes, modes], "1", found.auto_mac().concat()))
        .group("harmonics", harmonics(found))
        .texts("dropped", &found.dropped)
        .group("spectrum", spectrum(found))
        .group(in_hdf5("stabilisation"), diagram(&found.diagram))
}

fn mode_rows(found: &OperationalModes) -> Rows<'_, '_, OperationalMode> {
    // JSON has complex numbers as pairs.
    let pairs = |values: &[Complex64]| values.iter().flat_map(|v| [v.re, v.im]).collect::<Vec<f64>>();
    let channels = found.dofs.len();
    Rows::of(&found.modes)
        .number(named("frequency_hz", "frequency"), "Hz", OperationalMode::frequency_hz)
        .number(named("frequency_error_hz", "frequency_error"), "Hz", |m| m.frequency_error)
        .number("damping_ratio", "1", OperationalMode::damping_ratio)
        .number("damping_ratio_error", "1", |m| m.damping_error)
        .numbers(in_json("pole"), "1/s", &[2], move |m| pairs(&[m.pole]))
        .numbers(in_json("shape"), "", &[channels, 2], move |m| pairs(&m.shape))
        .numbers(in_json("shape_error"), "", &[channels], |m| m.shape_error.clone())
        .complex(in_hdf5("pole"), "1/s", |m| m.pole)
        .complex_numbers(in_hdf5("shape"), "", &[channels], |m| &m.shape)
        .number("phase_collinearity", "1", |m| m.collinearity)
        .optional("whirl", "1", |m| m.whirl)
        .number("contribution", "1", |m| m.contribution)
        .number("support", "1", |m| m.support)
}

fn harmonics(found: &OperationalModes) -> Document<'_> {
    let of = |value: &dyn Fn(&rotordyn_identify::operational::Harmonic) -> f64| -> Vec<f64> {
        found.harmonics.iter().map(value).collect()
    };
    Document::new()
        .numbers("frequency", "Hz", of(&|h| h.frequency))
        .numbers("order", "1", of(&|h| h.order.unwrap_or(f64::NAN)))
        .numbers("kurtosis", "1", of(&|h| h.kurtosis))
        .texts("treatment", found.harmonics.iter().map(|h| if h.removed { "removed" } else { "recognised" }))
}

fn spectrum(found: &OperationalModes) -> Document<'_> {
    let spectrum = &found.spectrum;
    let (count, lines) = (spectrum.values.len(), spectrum.frequencies.len());
    Document::new()
        .numbers("peaks", "Hz", spectrum.peaks.iter().map(|p| p.frequency).collect::<Vec<f64>>())
        .numbers(in_hdf5("frequencies"), "Hz", &spectrum.frequencies)
        .array(
            in_hdf5("singular_values"),
            Array::real(&[count, lines], "1/Hz", spectrum.values.concat()).over(1, "frequencies"),
        )
}

/// Complex mode shapes at the points of the channels, for universal files, `validate` and `update`.
pub fn mode_shapes(found: &OperationalModes, geometry: &Geometry) -> MeasuredData {
    let shape =
        |(k, mode): (usize, &OperationalMode)| shape_at_points(k, &found.dofs, &mode.shape, mode.pole);
    MeasuredData {
        title: "modes in operation".into(),
        shapes: found.modes.iter().enumerate().map(shape).collect(),
        geometry: geometry.clone(),
        ..MeasuredData::default()
    }
}

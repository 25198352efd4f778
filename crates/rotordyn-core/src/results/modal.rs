//! Damped modes.

use crate::analysis::Mode;
use crate::assembly::DofMap;
use crate::document::{Document, Rows, TO_RPM, in_hdf5, named};
use serde::{Deserialize, Serialize};

/// Modes at one speed.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct ModalResult {
    /// Ω \[rad/s\].
    pub speed: f64,
    pub modes: Vec<Mode>,
    /// Motions at 0 Hz that nothing constrains, in words; the modes do not contain them.
    pub rigid_body_modes: Vec<String>,
}

impl ModalResult {
    /// What is written to files, one row a speed.
    pub fn document<'a>(found: &[Self], dofs: &DofMap) -> Document<'a> {
        let (nodes, shaft_nodes) = (dofs.full_len() / 6, dofs.shaft_nodes);
        let rows = Rows::of(found)
            .over("rpm")
            .number(named("speed_rpm", "rpm"), "rpm", |at| at.speed * TO_RPM)
            .lists("rigid_body_modes", |at| at.rigid_body_modes.clone())
            .lists("nodes", |_| dofs.node_names.clone())
            .nested(named("modes", ""), |at| &at.modes, |rows| modes(rows, nodes, shaft_nodes));
        Document::new().table("", rows)
    }
}

/// One row a mode.
fn modes<'a, 'r>(rows: Rows<'a, 'r, Mode>, nodes: usize, shaft_nodes: usize) -> Rows<'a, 'r, Mode> {
    rows.number(in_hdf5("omega"), "rad/s", Mode::omega)
        .number(named("frequency_hz", "frequency"), "Hz", Mode::frequency_hz)
        .number(named("damping_ratio", "zeta"), "1", Mode::zeta)
        .number(named("log_decrement", "log_dec"), "1", Mode::log_dec)
        .complex("eigenvalue", "1/s", |m| m.eigenvalue)
        .complex_numbers(named("shape", "shapes"), "m/sqrt(kg) m, rad/sqrt(kg) m", &[nodes, 6], |m| {
            &m.full_shape
        })
        .numbers(in_hdf5("whirl"), "1", &[shaft_nodes], |m| &m.whirl)
        .numbers("effective_mass", "1", &[3], |m| &m.effective_mass)
        .text("kind", |m| m.kind.name())
        .text("label", |m| &m.label)
}

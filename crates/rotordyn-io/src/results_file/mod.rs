//! The results of a machine as one HDF5 file, `results.h5`.
//!
//! | group | contents |
//! |---|---|
//! | `/meta` | attributes: schema (2; files without it have schema 1), program, version, git, identity (digest of model, settings and side files, also in figures), run_state (complete, running or stopped: why), files (figures and tables of these results), model (its text), title, variant, settings, seed, units, estimated_geometry (bearings whose internal geometry is estimated) |
//! | `/meta/files` | columns of the external data files of the model |
//! | `/labels` | names and positions of nodes, names of DOFs; per bearing its geometry and orders as attributes |
//! | `/equilibrium` | displacement \[node, DOF\]; per bearing force, displacement, tangents, balls; per belt stated and remaining pull; per preloaded bearing stated and carried axial force |
//! | `/modes` | \[speed, mode, ...\]: omega, zeta, log_dec, shapes (complex), whirl, kind, label |
//! | `/campbell` | \[branch, speed\]: frequency, zeta, log_dec; order lines, crossings, thresholds |
//! | `/critical_speeds` | speed, order, frequency, whirl, label |
//! | `/frf` | response \[response, excitation, frequency\] (complex); requested: 1 for the requested frequencies, 0 for those added around peaks |
//! | `/unbalance` | complex amplitude over speed of every response and of every disc's orbit; requested: as in `/frf`; peaks: speed, amplitude, amplification factor |
//! | `/poincare` | attributes: speed, clock, motion, settled (1 or 0), residual, decay_factor, transient_periods; `shaft_angle`, per plane `orbit_x`, `orbit_y`, `section_x`, `section_y` |
//! | `/lyapunov` | attributes: speed, clock, exponent with its standard error; convergence of `exponent` over `time` |
//! | `/bifurcation/<sweep>` | over `value`: motion, period, settled, residual, decay_factor, transient_periods, exponent; per channel `section` \[value, point\] and extremes |
//! | `/ball_inertia/<study>/<bearing>` | attributes: stated and used ball inertia; speed, centrifugal_force, largest_contact_load, ratio, limit: why |
//! | `/bearings/<bearing>` | stand-alone ball bearing: `geometry`, `operating` point, `limits` with their figures and `sweep_<variable>` over `swept_value`; `film_<race>` |
//! | `/time`, `/channels` | the run-up; in `results_unfinished.h5` the samples so far, NaN behind them |
//! | `/motion` | frames of the run for animations: `displacement` \[frame, node, DOF\]; per bearing with free balls `position`, `orientation` (quaternion, scalar first), `angular_velocity`, `ball_forces` (inner, outer, pocket) \[body, frame, component\], the balls before the cage |
//! | `/run_up` | attributes: size and errors of the reduced model, steps, energy balance; `step_error`, `cage_phases` |
//! | `/spectra/<channel>` | `spectrogram` and `orders` with their axes as dimension scales, order cuts |
//! | `/warnings` | code, severity, item, text and advice of the warnings of all studies |
//!
//! Every data set of numbers has an attribute `unit`. Missing values (a lost mode, fewer modes at a speed) are NaN, or
//! an empty text. Writing a study again replaces its earlier results.

mod external_files;
mod group_writer;
mod motion;
mod provenance;
mod run_history;
mod run_up_correlation;
mod section;
mod signal;
mod writer;

pub use external_files::{read_external_files, write_external_files};
use group_writer::GroupWriter;
pub use motion::{read_motion, write_motion};
pub use provenance::{
    Meta, Provenance, SCHEMA, results_state, schema, stored_files, stored_identity, write_meta,
};
pub use run_history::{channels_of, history_of, read_history};
pub use run_up_correlation::write_run_up_correlation;
pub use section::{Sink, write_document, write_section};
pub use signal::{SignalMeta, write_signal, write_trend};
pub use writer::{FINISHED, PREVIOUS, ResultsWriter, UNFINISHED, UNFINISHED_PREVIOUS, newest_results};

use super::hdf5::Store;
use crate::error::Error;
use rotordyn_core::results::{BearingResult, warnings_section};
use rotordyn_core::study::{Machine, Results};

/// Writes every available result, replacing earlier ones; the run itself is streamed.
///
/// # Errors
/// The file cannot be written.
pub fn write_study(store: &Store, results: &Results, machine: &Machine) -> Result<(), Error> {
    write_labels(store, machine)?;
    store.remove("/warnings")?;
    let sections = results.sections(&machine.assembly.dofs);
    sections.iter().try_for_each(|section| write_section(store, "", section))?;
    store.flush()
}

/// Writes stand-alone ball bearings (no machine), replacing earlier ones.
///
/// # Errors
/// The file cannot be written.
pub fn write_bearings(store: &Store, results: &Results) -> Result<(), Error> {
    store.remove("/warnings")?;
    let bearings = results.bearings.iter().map(BearingResult::section);
    let mut sections = bearings.chain(warnings_section(&results.warnings));
    sections.try_for_each(|section| write_section(store, "", &section))?;
    store.flush()
}

/// Removes a stored run with its summary and spectra, so that another can be streamed into the file.
///
/// # Errors
/// The file cannot be written.
pub fn remove_run(store: &Store) -> Result<(), Error> {
    ["/channels", "/time", "/run_up", "/spectra", "/motion"].iter().try_for_each(|group| store.remove(group))
}

/// Writes names and positions of nodes, DOFs and bearings, the indices of the arrays in other groups.
///
/// # Errors
/// The file cannot be written.
pub fn write_labels(store: &Store, machine: &Machine) -> Result<(), Error> {
    let writer = GroupWriter::new(store, "/labels")?;
    let (model, dofs) = (&machine.model, &machine.assembly.dofs);
    writer.write_texts("node", &[dofs.node_names.len()], &dofs.node_names)?;
    let z: Vec<f64> =
        model.node_z.iter().copied().chain(model.bodies.iter().map(|b| b.position[2])).collect();
    writer.write_array("node_z", &[z.len()], &z, "m")?;
    writer.write_texts("dof", &[6], &["u_x", "u_y", "u_z", "theta_x", "theta_y", "theta_z"])?;
    for site in &model.bearings {
        let at = writer.subgroup(&format!("bearings/{}", site.name))?;
        at.set_attribute("model", site.bearing.keyword())?;
        let Some(ball) = site.bearing.ball() else { continue };
        let g = &ball.geometry;
        let orders = g.characteristic_orders(g.contact_angle);
        at.set_attribute("condition", ball.imperfections.condition())?;
        at.set_attribute("balls", g.balls as i64)?;
        for (name, value) in [
            ("ball_diameter", g.ball_diameter),
            ("pitch_diameter", g.pitch_diameter),
            ("radial_clearance", g.radial_clearance),
            ("contact_angle", g.contact_angle),
            ("ftf", orders.ftf),
            ("bpfo", orders.bpfo),
            ("bpfi", orders.bpfi),
            ("bsf", orders.bsf),
        ] {
            at.set_attribute(name, value)?;
        }
    }
    Ok(())
}

//! The results of a machine as one HDF5 file, `results.h5`.
//!
//! | group | contents |
//! |---|---|
//! | `/meta` | attributes: schema (2; files without it have schema 1), program, version, git, model (its text), title, variant, settings, seed, units, estimated_geometry (bearings whose internal geometry is estimated) |
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
//! | `/bearings/<bearing>` | stand-alone ball bearing: `operating` point and `sweep_<variable>` over `swept_value`; `film_<race>` |
//! | `/time`, `/channels` | the run-up, streamed during the run |
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
mod run_up_correlation;
mod section;
mod signal;

pub use external_files::{read_external_files, write_external_files};
use group_writer::GroupWriter;
pub use motion::{read_motion, write_motion};
pub use run_up_correlation::write_run_up_correlation;
pub use section::{write_document, write_section};
pub use signal::{SignalMeta, write_signal};

use super::hdf5::{Attribute, Channel, Store, read_recording};
use crate::error::Error;
use rotordyn_core::results::{BearingResult, History, HistoryChannel, warnings_section};
use rotordyn_core::study::{Machine, Results};

/// Version of the names of groups, data sets and attributes, in `/meta`.
pub const SCHEMA: i64 = 2;

/// Provenance of results.
#[derive(Clone, Copy, Debug, Default)]
pub struct Meta<'a> {
    /// Text of the model file.
    pub model: &'a str,
    pub title: &'a str,
    /// Empty for the base model.
    pub variant: &'a str,
    /// Every override "path = value" of the file.
    pub settings: &'a [String],
}

/// Writes `/meta`, replacing an earlier one.
///
/// # Errors
/// The file cannot be written.
pub fn write_meta(store: &Store, meta: &Meta) -> Result<(), Error> {
    let writer = GroupWriter::new(store, "/meta")?;
    writer.set_attribute("schema", SCHEMA)?;
    writer.set_attribute("program", "rotordyn")?;
    writer.set_attribute("version", env!("CARGO_PKG_VERSION"))?;
    writer.set_attribute("git", option_env!("ROTORDYN_GIT").unwrap_or("unknown"))?;
    writer.set_attribute("model", meta.model)?;
    writer.set_attribute("title", meta.title)?;
    writer.set_attribute("variant", meta.variant)?;
    writer.set_attribute("settings", meta.settings.join("\n"))?;
    writer.set_attribute(
        "seed",
        "none for the program: random parts of the model have their seeds in its text",
    )?;
    writer.set_attribute("units", "SI: m, kg, s, N, rad; speeds in rad/s unless named rpm, frequencies in Hz")
}

/// Schema of a stored file; 1 for files written before the attribute was added.
///
/// # Errors
/// The file cannot be read.
pub fn schema(store: &Store) -> Result<i64, Error> {
    let stored = if store.contains("/meta") { store.attribute("/meta", "schema")? } else { None };
    Ok(match stored {
        Some(Attribute::Integer(schema)) => schema,
        _ => 1,
    })
}

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

/// Records in `/meta` that the run's speed is a measured one, not that of the model's text.
///
/// # Errors
/// The file cannot be written.
pub fn note_measured_speed(store: &Store, source: &str) -> Result<(), Error> {
    store.set_attribute("/meta", "speed", format!("as measured: {source}"))
}

/// The channels of a history in the form of a stream.
pub fn channels_of(history: &History) -> Vec<Channel> {
    let plain = |c: &HistoryChannel| Channel {
        name: c.name.clone(),
        unit: c.unit.clone(),
        quantity: c.quantity.clone(),
        station: c.station.clone(),
        direction: c.direction.clone(),
    };
    history.channels.iter().map(plain).collect()
}

/// Removes a stored run with its summary and spectra, so that another can be streamed into the file.
///
/// # Errors
/// The file cannot be written.
pub fn remove_run(store: &Store) -> Result<(), Error> {
    ["/channels", "/time", "/run_up", "/spectra", "/motion"].iter().try_for_each(|group| store.remove(group))
}

/// Reads the stored run, complete or not, its channels in the order they were recorded.
///
/// # Errors
/// The file cannot be read or contains no run.
pub fn read_history(store: &Store) -> Result<History, Error> {
    let stored = read_recording(store, "")?;
    let plain = |(c, values): (Channel, Vec<f64>)| HistoryChannel {
        name: c.name,
        unit: c.unit,
        quantity: c.quantity,
        station: c.station,
        direction: c.direction,
        values,
    };
    let mut channels: Vec<HistoryChannel> = stored.channels.into_iter().map(plain).collect();
    if let Some(Attribute::Texts(order)) = store.attribute("/channels", "names")? {
        channels.sort_by_key(|c| order.iter().position(|name| *name == c.name));
    }
    Ok(History {
        sample_rate: stored.sample_rate,
        time: stored.time,
        angle: stored.angle,
        speed: stored.speed,
        channels,
    })
}

/// Names and positions of nodes, DOFs and bearings, the indices of the arrays in other groups.
fn write_labels(store: &Store, machine: &Machine) -> Result<(), Error> {
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

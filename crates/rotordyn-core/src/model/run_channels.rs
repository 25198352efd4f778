//! Names of the channels that a run records besides the probes.

use super::{Drive, Model};

/// Terms of the energy balance that are recorded, in their order.
pub const ENERGIES: [&str; 8] =
    ["kinetic", "strain", "contact", "work", "parametric", "damping_loss", "contact_loss", "residual"];
/// The further term of a machine with a torque drive.
pub const DRIVE_ENERGY: &str = "drive";

/// Force of a bearing along an axis.
pub fn bearing_force(bearing: &str, axis: &str) -> String {
    format!("{bearing}_force_{axis}")
}

/// Angle of a bearing's cage.
pub fn cage_angle(bearing: &str) -> String {
    format!("{bearing}_cage_angle")
}

/// A term of the energy balance.
pub fn energy(term: &str) -> String {
    format!("energy_{term}")
}

/// Name of the channel with a probe's means over the sampling interval.
pub fn interval_mean(probe: &str) -> String {
    format!("{probe}_interval_mean")
}

/// Names of all channels of a run-up that are no probes, with the item that each belongs to in words.
pub fn automatic_channels(model: &Model) -> Vec<(String, String)> {
    let mut found: Vec<(String, String)> = Vec::new();
    for site in &model.bearings {
        let of = format!("bearing.{}", site.name);
        let mut names = vec![];
        names.extend(["x", "y", "z"].map(|axis| bearing_force(&site.name, axis)));
        names.extend(site.bearing.cage().map(|_| cage_angle(&site.name)));
        for channel in site.bearing.element().bodies().map_or(&[][..], |bodies| bodies.channels()) {
            names.push(format!("{}_{}", site.name, channel.name));
        }
        found.extend(names.into_iter().map(|name| (name, of.clone())));
    }
    let drive = matches!(model.drive, Drive::Torque { .. });
    let terms = ENERGIES.into_iter().chain(drive.then_some(DRIVE_ENERGY));
    found.extend(terms.map(|term| (energy(term), "the energy balance".into())));
    if model.bearings.iter().any(|site| site.bearing.element().bodies().is_some()) {
        let means =
            model.probes.iter().map(|probe| (interval_mean(&probe.name), format!("probe.{}", probe.name)));
        found.extend(means);
    }
    found
}

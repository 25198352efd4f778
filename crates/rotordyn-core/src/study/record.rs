//! Recorder of a transient run: probes, bearing forces, cage angles, energies.

use crate::model::{Model, Probe, Quantity};
use crate::results::{History, HistoryChannel, unit_of};
use crate::series::Series;
use crate::transient::run::Sample;
use crate::transient::system::System;

/// Collects the samples of a run, channel by channel.
pub struct Recorder {
    pub history: History,
    row: Vec<f64>,
    /// Places in the row of the channels of the history.
    kept: Vec<usize>,
    /// Whether samples are kept in memory.
    keeps_samples: bool,
    /// Number of force components (of u_x u_y u_z) of every bearing.
    directions: Vec<usize>,
    /// Whether the work of a torque drive is recorded.
    drive: bool,
}

impl Recorder {
    /// Channels of a run of `system`: every probe; per ball bearing its force on the shaft and its cage
    /// angle, with free balls their motion, slip, forces and losses; the terms of the energy balance, with the work of a torque
    /// drive; with free balls every probe as mean over the sampling interval, into which collisions do not alias.
    pub fn new(model: &Model, system: &System, sample_rate: f64) -> Self {
        let mut channels: Vec<HistoryChannel> =
            model.probes.iter().map(|p| probe_channel(model, p)).collect();
        let plain =
            |name: String, unit: &str, quantity: &str, station: &str, direction: &str| HistoryChannel {
                name,
                unit: unit.into(),
                quantity: quantity.into(),
                station: station.into(),
                direction: direction.into(),
                values: Series::default(),
            };
        for interface in &system.interfaces {
            let site = &interface.name;
            for axis in ["x", "y", "z"] {
                channels.push(plain(format!("{site}_force_{axis}"), "N", "force", site, axis));
            }
            channels.push(plain(format!("{site}_cage_angle"), "rad", "angle", site, "cage"));
            for c in interface.element.bodies().map_or(&[][..], |bodies| bodies.channels()) {
                channels.push(plain(format!("{site}_{}", c.name), c.unit, c.quantity, site, c.direction));
            }
        }
        let drive = system.drive.is_some();
        for name in ENERGIES.into_iter().chain(drive.then_some("drive")) {
            channels.push(plain(format!("energy_{name}"), "J", "energy", "machine", ""));
        }
        if system.has_bodies() {
            channels.extend(model.probes.iter().map(|probe| {
                let channel = probe_channel(model, probe);
                // Another quantity than that of the probe, so that figures and analyses do not show it twice.
                let quantity = format!("mean {}", channel.quantity);
                HistoryChannel { name: interval_mean_name(&channel.name), quantity, ..channel }
            }));
        }
        Self {
            row: Vec::with_capacity(channels.len()),
            kept: (0..channels.len()).collect(),
            keeps_samples: true,
            drive,
            directions: system.interfaces.iter().map(|i| i.element.relative_dofs().min(3)).collect(),
            history: History { sample_rate, channels, ..History::default() },
        }
    }

    /// The recorder of only those channels that are `wanted`, with less memory.
    pub fn with_channels(mut self, wanted: impl Fn(&HistoryChannel) -> bool) -> Self {
        let channels = std::mem::take(&mut self.history.channels);
        let kept = channels.into_iter().zip(std::mem::take(&mut self.kept)).filter(|(c, _)| wanted(c));
        (self.history.channels, self.kept) = kept.unzip();
        self
    }

    /// The recorder for samples that are stored elsewhere: the history has the channels without values.
    pub fn without_samples(mut self) -> Self {
        self.keeps_samples = false;
        self
    }

    /// Records one sample; returns the values of all channels of the run in their order.
    pub fn record(&mut self, sample: &Sample) -> &[f64] {
        let state = sample.state;
        self.row.clear();
        self.row.extend_from_slice(sample.channels);
        let bearings = state.reactions.iter().zip(&state.rotations);
        for (k, ((reaction, rotation), directions)) in bearings.zip(&self.directions).enumerate() {
            let along = |k: usize| if k < *directions { reaction.force[k] } else { 0.0 };
            self.row.extend([along(0), along(1), along(2)]);
            self.row.push(rotation.cage_angle);
            sample.system.read_bodies(k, state, &mut self.row);
        }
        let e = sample.energy;
        self.row.extend([
            e.kinetic,
            e.strain,
            e.contact,
            e.work,
            e.parametric,
            e.damping_loss,
            e.contact_loss,
            e.residual(),
        ]);
        if self.drive {
            self.row.push(e.drive);
        }
        self.row.extend_from_slice(sample.means);
        if self.keeps_samples {
            let history = &mut self.history;
            history.time.push(state.time);
            history.angle.push(state.spin.angle);
            history.speed.push(state.spin.speed);
            for (channel, place) in history.channels.iter_mut().zip(&self.kept) {
                channel.values.push(self.row[*place]);
            }
        }
        &self.row
    }
}

/// Name of the channel with a probe's means over the sampling interval.
pub(super) fn interval_mean_name(probe: &str) -> String {
    format!("{probe}_interval_mean")
}

const ENERGIES: [&str; 8] =
    ["kinetic", "strain", "contact", "work", "parametric", "damping_loss", "contact_loss", "residual"];

/// Channel with name, unit, station and direction of a probe, without values.
pub(super) fn probe_channel(model: &Model, probe: &Probe) -> HistoryChannel {
    let rotation = probe.direction[3..].iter().any(|d| *d != 0.0);
    let names = ["x", "y", "z", "theta_x", "theta_y", "theta_z"];
    let single = (0..6)
        .find(|&k| probe.direction[k] == 1.0 && probe.direction.iter().filter(|d| **d != 0.0).count() == 1);
    let direction = match single {
        Some(k) => names[k].to_string(),
        None => format!("{:?}", probe.direction),
    };
    let shaft_nodes = model.node_z.len();
    let station = match probe.at.node {
        None => "ground".to_string(),
        Some(node) if node >= shaft_nodes => model.bodies[node - shaft_nodes].name.clone(),
        Some(node) => model
            .stations
            .iter()
            .find(|s| s.node == node)
            .map_or_else(|| format!("z = {} m", model.node_z[node]), |s| s.name.clone()),
    };
    let quantity = match probe.quantity {
        Quantity::Displacement => "displacement",
        Quantity::Velocity => "velocity",
        Quantity::Acceleration => "acceleration",
    };
    HistoryChannel {
        name: probe.name.clone(),
        unit: unit_of(probe.quantity, rotation).into(),
        quantity: quantity.into(),
        station,
        direction,
        values: Series::default(),
    }
}

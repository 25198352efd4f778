//! Recorder of a transient run: probes, bearing forces, cage angles, energies.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};

use super::probe_filter::ProbeFilter;
use crate::model::{Model, Probe, Quantity, run_channels};
use crate::results::{History, HistoryChannel, is_rotation, unit_of};
use crate::series::Series;
use crate::transient::peak_loads::{PeakLoad, PeakLoads};
use crate::transient::run::Sample;
use crate::transient::system::System;

/// Collects the samples of a run, channel by channel.
///
/// The probes are read at every step and pass an anti-aliasing filter, as before the converter of a measurement: what vibrates
/// above the band of the record would fold into its lines. A sample is therefore complete some intervals later; forces,
/// angles and energies are those of its instant.
pub struct Recorder {
    /// Channels, with the samples that are complete, if they are kept.
    pub history: History,
    filter: ProbeFilter,
    /// Samples whose filtered values are to come, those that have just come, and the buffers of earlier ones.
    waiting: VecDeque<RecordedSample>,
    complete: Vec<RecordedSample>,
    spare: Vec<RecordedSample>,
    /// Places among all channels of a run of the channels of the history.
    kept: Vec<usize>,
    /// Whether samples are kept in memory.
    keeps_samples: bool,
    /// Number of force components (of u_x u_y u_z) of every bearing, and whether it has a cage.
    directions: Vec<(usize, bool)>,
    /// Whether the work of a torque drive is recorded.
    drive: bool,
    peak_loads: PeakLoads,
}

/// A complete sample: instant and shaft, and the values of all channels of the run in their order.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RecordedSample {
    /// \[s\].
    pub time: f64,
    /// \[rad\].
    pub angle: f64,
    /// \[rad/s\].
    pub speed: f64,
    pub values: Vec<f64>,
}

/// What a recorder takes from the samples before: with it a new one goes on with the same bits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RecorderSnapshot {
    filter: ProbeFilter,
    waiting: VecDeque<RecordedSample>,
    peak_loads: PeakLoads,
}

impl RecorderSnapshot {
    /// Number of samples that are not complete yet.
    pub fn waiting(&self) -> usize {
        self.waiting.len()
    }
}

impl Recorder {
    /// Channels of a run of `system`: every probe; per bearing its force on the shaft and, of one with a cage,
    /// its angle, with free balls their motion, slip, forces and losses; the terms of the energy balance, with the work of a torque
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
        let has_cage = |name: &str| {
            let site = model.bearings.iter().find(|site| site.name == name);
            site.is_some_and(|site| site.bearing.cage().is_some())
        };
        for interface in &system.interfaces {
            let site = &interface.name;
            for axis in ["x", "y", "z"] {
                channels.push(plain(run_channels::bearing_force(site, axis), "N", "force", site, axis));
            }
            if has_cage(site) {
                channels.push(plain(run_channels::cage_angle(site), "rad", "angle", site, "cage"));
            }
            for c in interface.element.bodies().map_or(&[][..], |bodies| bodies.channels()) {
                channels.push(plain(format!("{site}_{}", c.name), c.unit, c.quantity, site, c.direction));
            }
        }
        let drive = system.drive.is_some();
        for term in run_channels::ENERGIES.into_iter().chain(drive.then_some(run_channels::DRIVE_ENERGY)) {
            channels.push(plain(run_channels::energy(term), "J", "energy", "machine", ""));
        }
        if system.has_bodies() {
            channels.extend(model.probes.iter().map(|probe| {
                let channel = probe_channel(model, probe);
                // Another quantity than that of the probe, so that figures and analyses do not show it twice.
                let quantity = format!("mean {}", channel.quantity);
                HistoryChannel { name: run_channels::interval_mean(&channel.name), quantity, ..channel }
            }));
        }
        Self {
            filter: ProbeFilter::default(),
            waiting: VecDeque::new(),
            complete: Vec::new(),
            spare: Vec::new(),
            kept: (0..channels.len()).collect(),
            keeps_samples: true,
            drive,
            peak_loads: PeakLoads::default(),
            directions: system
                .interfaces
                .iter()
                .map(|i| (i.element.relative_dofs().min(3), has_cage(&i.name)))
                .collect(),
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

    /// The largest loads of the bearings at the samples so far.
    pub fn peak_loads(&self) -> Vec<PeakLoad> {
        self.peak_loads.found()
    }

    /// The record of a run that has ended.
    pub fn into_history(mut self) -> History {
        self.finish();
        self.history
    }

    /// What it takes to go on after the last sample.
    pub fn snapshot(&self) -> RecorderSnapshot {
        RecorderSnapshot {
            filter: self.filter.clone(),
            waiting: self.waiting.clone(),
            peak_loads: self.peak_loads.clone(),
        }
    }

    /// Goes on after the samples of a snapshot.
    pub fn resume(&mut self, snapshot: RecorderSnapshot) {
        (self.filter, self.waiting) = (snapshot.filter, snapshot.waiting);
        self.peak_loads = snapshot.peak_loads;
    }

    /// Records one sample; returns those that are complete with it.
    pub fn record(&mut self, sample: &Sample) -> &[RecordedSample] {
        let state = sample.state;
        self.peak_loads.observe(sample.system, state);
        let mut recorded = self.spare.pop().unwrap_or_default();
        (recorded.time, recorded.angle, recorded.speed) = (state.time, state.spin.angle, state.spin.speed);
        let row = &mut recorded.values;
        row.clear();
        row.extend_from_slice(sample.channels);
        let bearings = state.reactions.iter().zip(&state.rotations);
        for (k, ((reaction, rotation), (directions, has_cage))) in bearings.zip(&self.directions).enumerate()
        {
            let along = |k: usize| if k < *directions { reaction.force[k] } else { 0.0 };
            row.extend([along(0), along(1), along(2)]);
            row.extend(has_cage.then_some(rotation.cage_angle));
            sample.system.read_bodies(k, state, row);
        }
        let e = sample.energy;
        row.extend([
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
            row.push(e.drive);
        }
        row.extend_from_slice(sample.means);
        self.waiting.push_back(recorded);
        self.filter.push(sample);
        self.complete_samples(sample.is_last())
    }

    /// Ends the record of a run that ended before its last sample; returns the samples that were not complete.
    pub fn finish(&mut self) -> &[RecordedSample] {
        self.complete_samples(true)
    }

    fn complete_samples(&mut self, at_end: bool) -> &[RecordedSample] {
        self.spare.append(&mut self.complete);
        while let Some(filtered) = self.filter.pop(at_end) {
            let Some(mut sample) = self.waiting.pop_front() else { break };
            sample.values[..filtered.len()].copy_from_slice(filtered);
            if self.keeps_samples {
                let history = &mut self.history;
                history.time.push(sample.time);
                history.angle.push(sample.angle);
                history.speed.push(sample.speed);
                for (channel, place) in history.channels.iter_mut().zip(&self.kept) {
                    channel.values.push(sample.values[*place]);
                }
            }
            self.complete.push(sample);
        }
        &self.complete
    }
}

/// Channel with name, unit, station and direction of a probe, without values.
pub(super) fn probe_channel(model: &Model, probe: &Probe) -> HistoryChannel {
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
        unit: unit_of(probe.quantity, is_rotation(&probe.direction)).into(),
        quantity: quantity.into(),
        station,
        direction,
        values: Series::default(),
    }
}

//! Channels of a run: streamed to disk during the run, read back afterwards.

use super::{Attribute, DEFLATE_LEVEL, Store, attribute};
use crate::error::Error;
use hdf5::Dataset;

/// Samples per chunk; also the most that a killed run loses.
const BLOCK_SAMPLES: usize = 4096;
/// Attribute of `<at>/time`: state of the run.
const RUN_STATE: &str = "run_state";

/// Description of a channel.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// Name, also of its data set; without `/`.
    pub name: String,
    /// Unit, "m/s2".
    pub unit: String,
    /// Quantity, "acceleration".
    pub quantity: String,
    /// Station or body of the sensor.
    pub station: String,
    /// Direction, "x", "theta_y" or a vector.
    pub direction: String,
}

/// Streams the samples of a run to disk.
///
/// `<at>/time/{t, theta, speed}` and `<at>/channels/<name>` (in the order of the attribute `names`) grow
/// together in blocks, each followed by a flush, and no block is written twice: after a kill the file can be
/// opened and contains all complete blocks. The attribute `run_state` of `<at>/time` is "running", then
/// "complete" or "stopped: reason".
#[derive(Debug)]
pub struct ChannelStream {
    store: Store,
    root: String,
    datasets: Vec<Dataset>,
    columns: Vec<Vec<f64>>,
    written: usize,
    finished: bool,
}

impl ChannelStream {
    /// Starts a run under the group `at` ("" for the root) of a store open for writing.
    ///
    /// `sample_rate` \[Hz\] and `start` \[s\] are f_s and t_0 of the uniform sampling.
    pub fn create(
        store: &Store,
        root: &str,
        channels: &[Channel],
        sample_rate: f64,
        start: f64,
    ) -> Result<ChannelStream, Error> {
        let store = Store { file: store.file.clone(), path: store.path.clone() };
        let sampling = [("fs", Attribute::from(sample_rate)), ("t0", start.into())];
        let mut datasets = Vec::with_capacity(3 + channels.len());
        for (name, unit) in [("t", "s"), ("theta", "rad"), ("speed", "rad/s")] {
            let attributes = [&[("unit", unit.into())], &sampling[..]].concat();
            datasets.push(growable_dataset(&store, &format!("{root}/time/{name}"), &attributes)?);
        }
        let names: Vec<String> = channels.iter().map(|c| c.name.clone()).collect();
        if !names.is_empty() {
            store.set_attribute(&format!("{root}/channels"), "names", names)?;
        }
        store.create_group(&format!("{root}/channels"))?;
        for channel in channels {
            if channel.name.is_empty() || channel.name.contains('/') {
                let message = format!("{:?} cannot be the name of a channel", channel.name);
                return Err(Error::of_file("write", &store.path)(message));
            }
            let attributes: [(&str, Attribute); 4] = [
                ("unit", channel.unit.as_str().into()),
                ("quantity", channel.quantity.as_str().into()),
                ("station", channel.station.as_str().into()),
                ("direction", channel.direction.as_str().into()),
            ];
            let name = format!("{root}/channels/{}", channel.name);
            datasets.push(growable_dataset(&store, &name, &[&attributes[..], &sampling[..]].concat())?);
        }
        for channel in channels {
            let name = format!("{root}/channels/{}", channel.name);
            store.attach_scale(&name, 0, &format!("{root}/time/t"), "time")?;
        }
        store.set_attribute(&format!("{root}/time"), RUN_STATE, "running")?;
        store.flush()?;
        let columns = vec![Vec::with_capacity(BLOCK_SAMPLES); datasets.len()];
        Ok(ChannelStream { store, root: root.into(), datasets, columns, written: 0, finished: false })
    }

    /// Appends one sample: time \[s\], shaft angle \[rad\], speed \[rad/s\] and the channels' values.
    pub fn push(&mut self, time: f64, angle: f64, speed: f64, values: &[f64]) -> Result<(), Error> {
        if values.len() + 3 != self.columns.len() {
            let message = format!("{} values for {} channels", values.len(), self.columns.len() - 3);
            return Err(Error::of_file("write", &self.store.path)(message));
        }
        let row = [time, angle, speed];
        for (column, value) in self.columns.iter_mut().zip(row.iter().chain(values)) {
            column.push(*value);
        }
        if self.columns[0].len() == BLOCK_SAMPLES { self.write_block() } else { Ok(()) }
    }

    /// Writes the remaining samples and the final state, "complete" or "stopped: reason".
    pub fn finish(mut self, state: &str) -> Result<(), Error> {
        self.finalise(state)
    }

    fn finalise(&mut self, state: &str) -> Result<(), Error> {
        self.finished = true;
        self.write_block()?;
        self.store.set_attribute(&format!("{}/time", self.root), RUN_STATE, state)?;
        self.store.flush()
    }

    fn write_block(&mut self) -> Result<(), Error> {
        let end = self.written + self.columns[0].len();
        for (dataset, column) in self.datasets.iter().zip(&mut self.columns) {
            let written =
                dataset.resize(end).and_then(|()| dataset.write_slice(&column[..], self.written..end));
            self.store.map_write_error(&dataset.name(), written)?;
            column.clear();
        }
        self.written = end;
        self.store.flush()
    }
}

impl Drop for ChannelStream {
    /// Keeps the samples of a run that ended with an error.
    fn drop(&mut self) {
        if !self.finished {
            // `drop` cannot report an error; `run_state` then stays "running".
            let _ = self.finalise("stopped: not finished");
        }
    }
}

/// An empty one-dimensional data set that can grow.
fn growable_dataset(store: &Store, name: &str, attributes: &[(&str, Attribute)]) -> Result<Dataset, Error> {
    let parent = name.rsplit_once('/').map_or("", |(parent, _)| parent);
    let created = store.group(parent).and_then(|_| {
        let builder = store.file.new_dataset::<f64>().obj_track_times(false).chunk(BLOCK_SAMPLES);
        let dataset = builder.shuffle().deflate(DEFLATE_LEVEL).shape(0..).create(name)?;
        attributes.iter().try_for_each(|(name, value)| attribute::set(&dataset, name, value))?;
        Ok(dataset)
    });
    store.map_write_error(name, created)
}

/// A stored run.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// Times \[s\].
    pub time: Vec<f64>,
    /// Shaft angles \[rad\].
    pub angle: Vec<f64>,
    /// Speeds \[rad/s\].
    pub speed: Vec<f64>,
    /// Sampling rate \[Hz\].
    pub sample_rate: f64,
    /// Time of the first sample \[s\].
    pub start: f64,
    /// Description and samples of every channel, in alphabetical order of the names.
    pub channels: Vec<(Channel, Vec<f64>)>,
    /// "running", "complete" or "stopped: reason".
    pub state: String,
}

/// Reads a run that a [`ChannelStream`] wrote under `at`, complete or not.
pub fn read_recording(store: &Store, root: &str) -> Result<Recording, Error> {
    let missing =
        |object: &str, name| Error::of_file("read", &store.path)(format!("{object} has no attribute {name}"));
    let text = |object: &str, name| match store.attribute(object, name)? {
        Some(Attribute::Text(text)) => Ok(text),
        _ => Err(missing(object, name)),
    };
    let number = |object: &str, name| match store.attribute(object, name)? {
        Some(Attribute::Number(number)) => Ok(number),
        _ => Err(missing(object, name)),
    };
    let (time, folder) = (format!("{root}/time/t"), format!("{root}/channels"));
    let mut channels = Vec::new();
    for name in store.members(&folder)? {
        let object = format!("{folder}/{name}");
        let channel = Channel {
            unit: text(&object, "unit")?,
            quantity: text(&object, "quantity")?,
            station: text(&object, "station")?,
            direction: text(&object, "direction")?,
            name,
        };
        channels.push((channel, store.read(&object)?.data));
    }
    Ok(Recording {
        time: store.read(&time)?.data,
        angle: store.read(&format!("{root}/time/theta"))?.data,
        speed: store.read(&format!("{root}/time/speed"))?.data,
        sample_rate: number(&time, "fs")?,
        start: number(&time, "t0")?,
        channels,
        state: text(&format!("{root}/time"), RUN_STATE)?,
    })
}

//! The data sets of a run: preallocated while it is under way, compressed where it pays when it has ended.

use super::compression::{DEFLATE_LEVEL, TRIED_VALUES, is_worthwhile};
use super::recording::{
    Channel, RUN_STATE, RUNNING, channel_names, channel_path, describe_channel, recorded_samples, sampling,
    time_path,
};
use super::{Attribute, CACHE_PLACES, Store, attribute};
use crate::error::Error;
use hdf5::Dataset;
use hdf5::plist::dataset_create::{AllocTime, FillTime};

/// Samples per chunk of the compressed data sets of a run that has ended.
const CHUNK_SAMPLES: usize = 4096;
/// Samples copied at a time: whole chunks.
const BLOCK_SAMPLES: usize = 16 * CHUNK_SAMPLES;
/// Chunks in memory of every one of them while it is written, each of them once and whole \[bytes\].
const WRITE_CACHE: usize = 2 * 8 * CHUNK_SAMPLES;

/// Name and unit of the data sets of `<root>/time`, before the channels.
pub(super) const TIME_SETS: [(&str, &str); 3] = [("t", "s"), ("theta", "rad"), ("speed", "rad/s")];

/// What the data sets of a run describe.
#[derive(Clone, Copy, Debug)]
pub struct RunFormat<'a> {
    pub channels: &'a [Channel],
    /// f_s of the uniform sampling \[Hz\].
    pub sample_rate: f64,
    /// Time of the first sample \[s\].
    pub start: f64,
}

/// Creates the data sets of a run under the group `root` ("" for the root) at their full size, filled with NaN.
///
/// From then on only samples are written, in place, by a [`ChannelStream`](super::ChannelStream): nothing that HDF5
/// needs to open the file changes during the run.
///
/// # Errors
/// The file cannot be written, or a channel's name cannot be that of a data set.
pub fn preallocate_run(store: &Store, root: &str, run: &RunFormat, samples: usize) -> Result<(), Error> {
    let contiguous = |name: &str, attributes: &[(&str, Attribute)]| {
        let builder = store.file.new_dataset::<f64>().obj_track_times(false);
        let builder = builder.alloc_time(Some(AllocTime::Early)).fill_value(f64::NAN);
        let dataset = builder.fill_time(FillTime::Alloc).shape(samples).create(name)?;
        attributes.iter().try_for_each(|(name, value)| attribute::set(&dataset, name, value))?;
        Ok(dataset)
    };
    create(store, root, run, &contiguous)?;
    store.set_attribute(&format!("{root}/time"), RUN_STATE, RUNNING)
}

/// Copies a run under `root` into another file, compressed where it pays and cut to the samples recorded, block by block.
///
/// `state`: "complete" or "stopped: reason".
///
/// # Errors
/// One of the files cannot be read or written.
pub fn copy_run(from: &Store, to: &Store, root: &str, state: &str) -> Result<(), Error> {
    let names = channel_names(from, root)?;
    let channels: Vec<Channel> =
        names.iter().map(|name| describe_channel(from, root, name)).collect::<Result<_, _>>()?;
    let [sample_rate, start] = sampling(from, root)?;
    let samples = recorded_samples(from, root)?;
    let begin = samples.saturating_sub(TRIED_VALUES) / 2;
    let middle = begin..samples.min(begin + TRIED_VALUES);
    // Only what is compressed needs chunks.
    let whole = |name: &str, attributes: &[(&str, Attribute)]| {
        let (places, whole_first) = CACHE_PLACES;
        let builder = to.file.new_dataset::<f64>().obj_track_times(false);
        let part = from.file.dataset(name)?.read_slice_1d::<f64, _>(middle.clone())?;
        let builder = if is_worthwhile(part.into_iter()) {
            let builder =
                builder.chunk(CHUNK_SAMPLES.min(samples)).chunk_cache(places, WRITE_CACHE, whole_first);
            builder.shuffle().deflate(DEFLATE_LEVEL)
        } else {
            builder.fill_time(FillTime::Never)
        };
        let dataset = builder.shape(samples).create(name)?;
        attributes.iter().try_for_each(|(name, value)| attribute::set(&dataset, name, value))?;
        Ok(dataset)
    };
    let sets = create(to, root, &RunFormat { channels: &channels, sample_rate, start }, &whole)?;
    let paths = set_paths(root, &names);
    let sources: Vec<Dataset> = paths
        .iter()
        .map(|path| from.map_read_error(path, from.file.dataset(path)))
        .collect::<Result<_, _>>()?;
    let copied = sources.iter().zip(&sets).try_for_each(|(source, set)| {
        (0..samples).step_by(BLOCK_SAMPLES).try_for_each(|begin| {
            let end = samples.min(begin + BLOCK_SAMPLES);
            set.write_slice(&source.read_slice_1d::<f64, _>(begin..end)?, begin..end)
        })
    });
    to.map_write_error(&format!("{root}/channels"), to.file.flush_open(sets, copied))?;
    to.set_attribute(&format!("{root}/time"), RUN_STATE, state)
}

/// Paths of the data sets of a run: time, angle, speed, channels.
pub(super) fn set_paths<T: AsRef<str>>(root: &str, channels: &[T]) -> Vec<String> {
    let time = TIME_SETS.iter().map(|(name, _)| time_path(root, name));
    time.chain(channels.iter().map(|name| channel_path(root, name.as_ref()))).collect()
}

/// Creates a data set of a name with attributes.
type NewSet<'a> = &'a dyn Fn(&str, &[(&str, Attribute)]) -> hdf5::Result<Dataset>;

/// Creates all data sets by a function of name and attributes, with the times as their dimension scale.
fn create(store: &Store, root: &str, run: &RunFormat, new: NewSet) -> Result<Vec<Dataset>, Error> {
    let sampling = [("fs", Attribute::from(run.sample_rate)), ("t0", run.start.into())];
    let (times, folder) = (format!("{root}/time"), format!("{root}/channels"));
    store.create_group(&times)?;
    let mut sets = Vec::with_capacity(TIME_SETS.len() + run.channels.len());
    let mut add = |name: &str, own: &[(&str, Attribute)]| -> Result<(), Error> {
        let created = new(name, &[own, &sampling[..]].concat());
        sets.push(store.map_write_error(name, created)?);
        Ok(())
    };
    for (name, unit) in TIME_SETS {
        add(&time_path(root, name), &[("unit", unit.into())])?;
    }
    let names: Vec<String> = run.channels.iter().map(|c| c.name.clone()).collect();
    if !names.is_empty() {
        store.set_attribute(&folder, "names", names)?;
    }
    store.create_group(&folder)?;
    for channel in run.channels {
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
        add(&channel_path(root, &channel.name), &attributes)?;
    }
    for channel in run.channels {
        store.attach_scale(&channel_path(root, &channel.name), 0, &time_path(root, "t"), "time")?;
    }
    Ok(sets)
}

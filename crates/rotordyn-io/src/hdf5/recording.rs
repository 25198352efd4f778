//! Channels of a stored run, read whole or one at a time, from a run that ended and from one under way.

use super::reader::{Link, LinkTarget, Reader, damaged};
use super::{Attribute, ObjectKind};
use crate::budget::{Budget, Exceeded};
use crate::error::Error;
use std::collections::HashMap;
use std::ops::Range;

/// Attribute of `<root>/time`: state of the run.
pub(super) const RUN_STATE: &str = "run_state";
/// State of a run under way, or of one whose program was killed.
pub const RUNNING: &str = "running";
/// State of a run that reached its end.
pub const COMPLETE: &str = "complete";
/// Samples read at a time in search of the end of a run.
const BLOCK_SAMPLES: usize = 65_536;

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

/// Path of a data set below `<root>/time`: "t" \[s\], "theta" \[rad\], "speed" \[rad/s\].
pub(crate) fn time_path(root: &str, name: &str) -> String {
    format!("{root}/time/{name}")
}

/// Path of the data set of a channel.
pub(crate) fn channel_path(root: &str, name: &str) -> String {
    format!("{root}/channels/{name}")
}

/// State of the run under `root`: "running", "complete" or "stopped: reason"; `None` if there is no run.
///
/// # Errors
/// The file cannot be read.
pub fn run_state(store: &dyn Reader, root: &str) -> Result<Option<String>, Error> {
    let group = format!("{root}/time");
    if !store.contains(&group)? {
        return Ok(None);
    }
    Ok(match store.attribute(&group, RUN_STATE)? {
        Some(Attribute::Text(state)) => Some(state),
        _ => None,
    })
}

/// Number of samples recorded so far: of a run under way, those before the first NaN of its times.
///
/// # Errors
/// The file cannot be read or contains no run.
pub fn recorded_samples(store: &dyn Reader, root: &str) -> Result<usize, Error> {
    let path = time_path(root, "t");
    let allocated = allocated_samples(store, root)?;
    if run_state(store, root)?.as_deref() != Some(RUNNING) {
        return Ok(allocated);
    }
    for from in (0..allocated).step_by(BLOCK_SAMPLES) {
        let block = store.read_range(&path, from..allocated.min(from + BLOCK_SAMPLES))?;
        if let Some(end) = block.iter().position(|time| time.is_nan()) {
            return Ok(from + end);
        }
    }
    Ok(allocated)
}

/// Reads samples of one channel; `range` lies within the [recorded samples](recorded_samples).
///
/// # Errors
/// The file cannot be read, or has no such channel or samples.
pub fn read_channel(
    store: &dyn Reader,
    root: &str,
    name: &str,
    range: Range<usize>,
) -> Result<Vec<f64>, Error> {
    store.read_range(&channel_path(root, name), range)
}

/// Reads samples of "t" \[s\], "theta" \[rad\] or "speed" \[rad/s\]; `range` as in [`read_channel`].
///
/// # Errors
/// As [`read_channel`].
pub fn read_time(store: &dyn Reader, root: &str, name: &str, range: Range<usize>) -> Result<Vec<f64>, Error> {
    store.read_range(&time_path(root, name), range)
}

/// Length of the data sets of a run. Only a run that is not complete may end between two channels.
fn allocated_samples(store: &dyn Reader, root: &str) -> Result<usize, Error> {
    let length = |link: Link| match link.target {
        LinkTarget::DataSet(ObjectKind::Real(shape)) if shape.len() == 1 => Some((link.name, shape[0])),
        _ => None,
    };
    let time = format!("{root}/time");
    let times: Vec<_> = store.links(&time)?.links.into_iter().filter_map(length).collect();
    if !times.iter().any(|(name, _)| name == "t") {
        return Err(damaged(store.path(), format!("{} is no list of times", time_path(root, "t"))));
    }
    let channels = store.links(&format!("{root}/channels"))?.links.into_iter().filter_map(length);
    let lengths: Vec<usize> = times.into_iter().chain(channels).map(|(_, length)| length).collect();
    let shortest = lengths.iter().copied().min().unwrap_or(0);
    let complete = run_state(store, root)?.as_deref() == Some(COMPLETE);
    if complete && lengths.iter().any(|length| *length != shortest) {
        return Err(damaged(store.path(), format!("{time}: the channels of the run have different lengths")));
    }
    Ok(shortest)
}

/// Description of a channel of a stored run.
pub(crate) fn describe_channel(store: &dyn Reader, root: &str, name: &str) -> Result<Channel, Error> {
    let object = channel_path(root, name);
    let attributes = store.attributes(&object)?;
    let text = |wanted| match attributes.iter().find(|(name, _)| name == wanted) {
        Some((_, Attribute::Text(text))) => Ok(text.clone()),
        _ => Err(missing(store, &object, wanted)),
    };
    Ok(Channel {
        unit: text("unit")?,
        quantity: text("quantity")?,
        station: text("station")?,
        direction: text("direction")?,
        name: name.into(),
    })
}

/// Names of the channels in the order they were recorded.
///
/// # Errors
/// The file cannot be read or contains no run.
pub fn channel_names(store: &dyn Reader, root: &str) -> Result<Vec<String>, Error> {
    let group = format!("{root}/channels");
    let mut names = store.members(&group)?;
    if let Some(Attribute::Texts(order)) = store.attribute(&group, "names")? {
        let places: HashMap<&str, usize> =
            order.iter().enumerate().rev().map(|(k, name)| (name.as_str(), k)).collect();
        names.sort_by_key(|name| places.get(name.as_str()).copied());
    }
    Ok(names)
}

/// Sampling rate \[Hz\] and time of the first sample \[s\] of a stored run.
pub(crate) fn sampling(store: &dyn Reader, root: &str) -> Result<[f64; 2], Error> {
    let time = time_path(root, "t");
    let number = |name: &str| match store.attribute(&time, name)? {
        Some(Attribute::Number(number)) => Ok(number),
        _ => Err(missing(store, &time, name)),
    };
    Ok([number("fs")?, number("t0")?])
}

fn text(store: &dyn Reader, object: &str, name: &str) -> Result<String, Error> {
    match store.attribute(object, name)? {
        Some(Attribute::Text(text)) => Ok(text),
        _ => Err(missing(store, object, name)),
    }
}

fn missing(store: &dyn Reader, object: &str, name: &str) -> Error {
    damaged(store.path(), format!("{object} has no attribute {name}"))
}

/// Reads a run stored under `root`, complete or not.
///
/// # Errors
/// The file cannot be read or contains no run.
pub fn read_recording(store: &dyn Reader, root: &str) -> Result<Recording, Error> {
    let [sample_rate, start] = sampling(store, root)?;
    if !(sample_rate > 0.0 && sample_rate.is_finite() && start.is_finite()) {
        let problem = format!("{root}/time: a sampling rate of {sample_rate} Hz from {start} s on");
        return Err(damaged(store.path(), problem));
    }
    let samples = 0..recorded_samples(store, root)?;
    let budget = Budget::of_memory(store.memory());
    let within = |request: Result<(), Exceeded>| request.map_err(|exceeded| exceeded.of_file(store.path()));
    let mut channels = Vec::new();
    for name in store.members(&format!("{root}/channels"))? {
        // Links to one data set would multiply it.
        within(budget.take_values::<f64>(|| channel_path(root, &name), samples.len()))?;
        within(budget.objects("channels", 1))?;
        let values = read_channel(store, root, &name, samples.clone())?;
        channels.push((describe_channel(store, root, &name)?, values));
    }
    Ok(Recording {
        time: read_time(store, root, "t", samples.clone())?,
        angle: read_time(store, root, "theta", samples.clone())?,
        speed: read_time(store, root, "speed", samples)?,
        sample_rate,
        start,
        channels,
        state: text(store, &format!("{root}/time"), RUN_STATE)?,
    })
}

//! The samples of a stored run, read channel by channel.

use crate::budget::Limits;
use crate::error::Error;
use crate::hdf5::{
    Channel, Reader, Recording, channel_names, channel_path, describe_channel, open_reader, recorded_samples,
    sampling, time_path,
};
use rotordyn_core::results::{History, HistoryChannel};
use rotordyn_core::series::{Series, SeriesError, SeriesSource};
use std::ops::Range;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

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

/// The run stored in a results file, complete or not, its channels in the order they were recorded.
///
/// Their values are read when they are needed; the file stays open as long as the history is used, also if its name is
/// given to another file.
///
/// # Errors
/// The file cannot be read or contains no run.
pub fn read_history(path: &Path, limits: &Limits) -> Result<History, Error> {
    let reader = open_reader(path, limits)?;
    let [sample_rate, _] = sampling(&*reader, "")?;
    let samples = recorded_samples(&*reader, "")?;
    let names = channel_names(&*reader, "")?;
    let described = names.iter().map(|name| describe_channel(&*reader, "", name));
    let described: Vec<Channel> = described.collect::<Result<_, _>>()?;
    let shared = Arc::new(Mutex::new(reader));
    let series = |name: String| {
        let place = format!("{}: {name}", path.display());
        Series::stored(StoredColumn { file: shared.clone(), name, place, length: samples })
    };
    let channel = |c: Channel| HistoryChannel {
        values: series(channel_path("", &c.name)),
        name: c.name,
        unit: c.unit,
        quantity: c.quantity,
        station: c.station,
        direction: c.direction,
    };
    Ok(History {
        sample_rate,
        time: series(time_path("", "t")),
        angle: series(time_path("", "theta")),
        speed: series(time_path("", "speed")),
        channels: described.into_iter().map(channel).collect(),
    })
}

/// A recording as a history in memory, its channels in the order of their names.
pub fn history_of(recording: &Recording) -> History {
    let channel = |(c, values): &(Channel, Vec<f64>)| HistoryChannel {
        name: c.name.clone(),
        unit: c.unit.clone(),
        quantity: c.quantity.clone(),
        station: c.station.clone(),
        direction: c.direction.clone(),
        values: values.clone().into(),
    };
    History {
        sample_rate: recording.sample_rate,
        time: recording.time.clone().into(),
        angle: recording.angle.clone().into(),
        speed: recording.speed.clone().into(),
        channels: recording.channels.iter().map(channel).collect(),
    }
}

/// The recorded part of a data set of a run.
struct StoredColumn {
    file: Arc<Mutex<Box<dyn Reader>>>,
    name: String,
    /// Path of the file, and the data set in it.
    place: String,
    length: usize,
}

impl SeriesSource for StoredColumn {
    fn len(&self) -> usize {
        self.length
    }

    fn read(&self, range: Range<usize>) -> Result<Vec<f64>, SeriesError> {
        // A reader that panicked answers with an error itself.
        let file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        let values = file.read_range(&self.name, range);
        values.map_err(|error| SeriesError { place: self.place.clone(), reason: error.to_string() })
    }
}

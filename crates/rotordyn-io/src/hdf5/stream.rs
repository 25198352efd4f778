//! Samples of a run, written to its preallocated data sets while it is under way.

use super::Store;
use super::recording::{RUNNING, channel_names, recorded_samples, run_state};
use super::sample_sets::set_paths;
use crate::error::Error;
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Samples written at a time; also the most that a killed program loses.
const BLOCK_SAMPLES: usize = 1024;
/// Bytes of a sample.
const BYTES: u64 = 8;
/// Interval at which samples are synced to the disk; a loss of power loses those since.
const SYNC_INTERVAL: Duration = Duration::from_secs(10);

/// Writes the samples of a run to the data sets of [`preallocate_run`](super::preallocate_run), of a file that is closed.
///
/// The samples go straight to their places in the file, without HDF5: whatever ends the program, the file can be
/// opened, and what was recorded ends before the first NaN of the times, which are written last.
#[derive(Debug)]
pub struct ChannelStream {
    path: PathBuf,
    file: File,
    names: Vec<String>,
    /// Offset of every data set in the file: time, angle, speed, channels.
    offsets: Vec<u64>,
    columns: Vec<Vec<f64>>,
    bytes: Vec<u8>,
    written: usize,
    capacity: usize,
    synced: Instant,
}

impl ChannelStream {
    /// Starts a run in the file `path`, whose data sets are preallocated under `root`.
    ///
    /// # Errors
    /// The file cannot be opened, or has no preallocated run.
    pub fn start(path: &Path, root: &str) -> Result<ChannelStream, Error> {
        ChannelStream::resume(path, root, 0)
    }

    /// Goes on with a run under way after its first `samples`; those behind are discarded.
    ///
    /// # Errors
    /// The file cannot be opened, or has no preallocated run with as many samples.
    pub fn resume(path: &Path, root: &str, samples: usize) -> Result<ChannelStream, Error> {
        let store = Store::open(path)?;
        if run_state(&store, root)?.as_deref() != Some(RUNNING) {
            return Err(Error::of_file("write", path)("no run under way"));
        }
        let names = channel_names(&store, root)?;
        let mut offsets = Vec::new();
        let mut capacity = usize::MAX;
        for set in set_paths(root, &names) {
            let dataset = store.map_read_error(&set, store.file.dataset(&set))?;
            let Some(offset) = dataset.offset().filter(|_| !dataset.is_chunked()) else {
                let message = format!("{set} is no preallocated data set of a run under way");
                return Err(Error::of_file("write", path)(message));
            };
            offsets.push(offset);
            capacity = capacity.min(dataset.size());
        }
        let recorded = recorded_samples(&store, root)?;
        drop(store);
        if samples > recorded {
            let message = format!("{recorded} samples are recorded, fewer than {samples}");
            return Err(Error::of_file("resume", path)(message));
        }
        let file = File::options().read(true).write(true).open(path);
        let columns = vec![Vec::with_capacity(BLOCK_SAMPLES); offsets.len()];
        let mut stream = ChannelStream {
            path: path.into(),
            file: file.map_err(Error::of_file("open for writing", path))?,
            names,
            offsets,
            columns,
            bytes: Vec::with_capacity(BLOCK_SAMPLES * BYTES as usize),
            written: samples,
            capacity,
            synced: Instant::now(),
        };
        for from in (samples..recorded).step_by(BLOCK_SAMPLES) {
            let none = [f64::NAN; BLOCK_SAMPLES];
            stream.write_column(0, from, &none[..BLOCK_SAMPLES.min(recorded - from)])?;
        }
        Ok(stream)
    }

    /// Samples pushed so far, with those before [`resume`](Self::resume).
    pub fn samples(&self) -> usize {
        self.written + self.columns[0].len()
    }

    /// Appends one sample: time \[s\], shaft angle \[rad\], speed \[rad/s\] and the channels' values.
    ///
    /// # Errors
    /// Another number of values than channels, more samples than preallocated, or a file that cannot be written.
    pub fn push(&mut self, time: f64, angle: f64, speed: f64, values: &[f64]) -> Result<(), Error> {
        if values.len() + 3 != self.columns.len() {
            return self.refuse(format!("{} values for {} channels", values.len(), self.columns.len() - 3));
        }
        if self.samples() == self.capacity {
            return self.refuse(format!("more samples than the {} announced", self.capacity));
        }
        let row = [time, angle, speed];
        for (column, value) in self.columns.iter_mut().zip(row.iter().chain(values)) {
            column.push(*value);
        }
        if self.columns[0].len() < BLOCK_SAMPLES {
            return Ok(());
        }
        self.write_block()?;
        if self.synced.elapsed() > SYNC_INTERVAL { self.sync() } else { Ok(()) }
    }

    fn refuse(&self, message: String) -> Result<(), Error> {
        Err(Error::of_file("write", &self.path)(message))
    }

    /// Writes all samples pushed so far and waits until they are on the disk.
    ///
    /// # Errors
    /// The file cannot be written, or was removed.
    pub fn sync(&mut self) -> Result<(), Error> {
        self.write_block()?;
        self.synced = Instant::now();
        self.file.sync_data().map_err(Error::of_file("write", &self.path))?;
        if !self.path.exists() {
            return self.refuse("the file was removed during the run".into());
        }
        Ok(())
    }

    /// Reads samples of a channel back, of those pushed so far.
    ///
    /// # Errors
    /// The file cannot be read, or has no such channel or samples.
    pub fn read_channel(&mut self, name: &str, range: Range<usize>) -> Result<Vec<f64>, Error> {
        let channel = self.names.iter().position(|other| other == name);
        match channel.filter(|_| range.start <= range.end && range.end <= self.samples()) {
            Some(channel) => self.read_column(channel + 3, range),
            None => {
                let message = format!("samples {} to {} of channel {name}", range.start, range.end);
                Err(Error::of_file("read", &self.path)(message))
            }
        }
    }

    fn read_column(&mut self, column: usize, range: Range<usize>) -> Result<Vec<f64>, Error> {
        self.write_block()?;
        let mut bytes = vec![0; range.len() * BYTES as usize];
        let from = self.offsets[column] + BYTES * range.start as u64;
        self.file
            .seek(SeekFrom::Start(from))
            .and_then(|_| self.file.read_exact(&mut bytes))
            .map_err(Error::of_file("read", &self.path))?;
        let (samples, _) = bytes.as_chunks();
        Ok(samples.iter().map(|sample| f64::from_ne_bytes(*sample)).collect())
    }

    /// Writes the remaining samples and waits until they are on the disk; returns their number.
    ///
    /// # Errors
    /// The file cannot be written, or was removed.
    pub fn finish(mut self) -> Result<usize, Error> {
        self.sync()?;
        Ok(self.written)
    }

    /// The times come last: a sample exists when its time does.
    fn write_block(&mut self) -> Result<(), Error> {
        let count = self.columns[0].len();
        for column in (0..self.columns.len()).rev() {
            let samples = std::mem::take(&mut self.columns[column]);
            let written = self.write_column(column, self.written, &samples);
            self.columns[column] = samples;
            written?;
        }
        self.columns.iter_mut().for_each(Vec::clear);
        self.written += count;
        Ok(())
    }

    fn write_column(&mut self, column: usize, from: usize, samples: &[f64]) -> Result<(), Error> {
        if samples.is_empty() {
            return Ok(());
        }
        // HDF5 stores native numbers in this order of bytes.
        self.bytes.clear();
        self.bytes.extend(samples.iter().flat_map(|sample| sample.to_ne_bytes()));
        let write = |file: &mut File, at: u64, bytes: &[u8]| -> io::Result<()> {
            file.seek(SeekFrom::Start(at))?;
            file.write_all(bytes)
        };
        let at = self.offsets[column] + BYTES * from as u64;
        write(&mut self.file, at, &self.bytes).map_err(Error::of_file("write", &self.path))
    }
}

impl Drop for ChannelStream {
    /// Keeps the samples of a run that ended with an error.
    fn drop(&mut self) {
        // `drop` cannot report an error; what is recorded then ends earlier.
        let _ = self.write_block();
    }
}

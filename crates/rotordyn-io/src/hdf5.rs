//! HDF5 files: groups, attributes, data sets and streamed channels, readable with plain h5py.
//!
//! The only module that uses the hdf5 crate. Files can be read by HDF5 1.8 or later and contain no time
//! stamps, so that a repeated run gives the same file. Objects are named by absolute paths, `/modes/omega`;
//! missing parent groups are created.

mod attribute;
mod child;
mod compression;
mod handle;
mod new_store;
mod protocol;
mod reader;
mod recording;
mod sample_sets;
mod scale;
mod serve;
mod stream;

pub use attribute::Attribute;
pub use child::open_reader;
pub use reader::{Link, LinkTarget, Links, OpenFile, Reader};
pub use recording::{
    COMPLETE, Channel, RUNNING, Recording, channel_names, read_channel, read_recording, read_time,
    recorded_samples, run_state,
};
pub(crate) use recording::{channel_path, describe_channel, sampling, time_path};
pub use sample_sets::{RunFormat, copy_run, preallocate_run};
pub use serve::{Stage, serve_if_asked};
pub use stream::ChannelStream;

use crate::atomic_file::NewFile;
use crate::error::Error;
use compression::{DEFLATE_LEVEL, is_worthwhile};
use handle::Handle;
use hdf5::file::LibraryVersion;
use hdf5::types::{TypeDescriptor, VarLenUnicode};
use hdf5::{Dataset, File, Group, H5Type, OpenMode};
use nalgebra::Complex;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// Most values per chunk (256 kB of f64).
const MAX_CHUNK_VALUES: usize = 32_768;
/// Data sets with fewer values, and those that compression hardly reduces, are stored contiguously and uncompressed.
const MIN_CHUNKED_VALUES: usize = 1024;
/// Chunks of an open data set that HDF5 keeps in memory \[bytes\]: four of ours, and the default of HDF5 1.x, by which
/// programs choose their chunks. The eight times of HDF5 2 let an open run keep its record.
const CHUNK_CACHE: usize = 1 << 20;
/// Places of chunks in the cache, a prime number, and the preference to drop chunks that were read or written whole.
const CACHE_PLACES: (usize, f64) = (521, 1.0);

/// An open HDF5 file.
#[derive(Debug)]
pub struct Store {
    file: Handle,
    path: PathBuf,
    /// The temporary file of a store that replaces `path` when it is committed.
    new: Option<NewFile>,
}

/// Kind of object that a name in a file refers to.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum ObjectKind {
    Group,
    /// Numbers, read as f64, with their shape.
    Real(Vec<usize>),
    /// Compounds {r, i}.
    Complex(Vec<usize>),
    Text(Vec<usize>),
    /// References to objects of the file.
    References(Vec<usize>),
    /// Any other data type; not read.
    Other,
}

/// An N-dimensional data set in row-major order.
#[derive(Clone, Debug, PartialEq)]
pub struct Array<T> {
    pub shape: Vec<usize>,
    pub data: Vec<T>,
}

/// The compound that h5py reads as complex128.
#[derive(Clone, Copy, H5Type)]
#[repr(C)]
struct ComplexPair {
    r: f64,
    i: f64,
}

impl Store {
    /// Creates a file and its parent folders; an existing file is overwritten in place, see [`replace`](Self::replace).
    pub fn create(path: impl AsRef<Path>) -> Result<Store, Error> {
        let path = path.as_ref();
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder).map_err(Error::of_file("create the folder of", path))?;
        }
        Store::open_as(path, OpenMode::Create, "create")
    }

    /// Opens a file for reading.
    pub fn open(path: impl AsRef<Path>) -> Result<Store, Error> {
        Store::open_as(path.as_ref(), OpenMode::Read, "open")
    }

    /// Opens a file for appending; creates it if missing.
    pub fn append(path: impl AsRef<Path>) -> Result<Store, Error> {
        match path.as_ref().exists() {
            true => Store::open_as(path.as_ref(), OpenMode::ReadWrite, "open for writing"),
            false => Store::create(path),
        }
    }

    fn open_as(path: &Path, mode: OpenMode, operation: &'static str) -> Result<Store, Error> {
        let mut options = File::with_options();
        // The 1.8 format has no "open for writing" flag, so a file whose writer was killed can still be
        // opened. No file locking, so that a file can be read during the run.
        options.with_fapl(|access| {
            let (places, whole_first) = CACHE_PLACES;
            access.chunk_cache(places, CHUNK_CACHE, whole_first);
            access.libver_bounds(LibraryVersion::V18, LibraryVersion::V18).file_locking(false)
        });
        options.with_fcpl(|create| create.obj_track_times(false));
        let file = options.open_as(path, mode).map_err(Error::of_file(operation, path))?;
        Ok(Store { file: Handle::new(file), path: path.into(), new: None })
    }

    /// The file's path.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Flushes all written data to the operating system.
    pub fn flush(&self) -> Result<(), Error> {
        self.file.flush_open(Vec::new(), Ok(())).map_err(Error::of_file("write", &self.path))
    }

    /// Whether there is a group or data set of this name.
    pub fn contains(&self, name: &str) -> bool {
        prefixes(name).all(|prefix| self.file.link_exists(prefix))
    }

    /// Names of the groups and data sets in a group, in alphabetical order.
    pub fn members(&self, group: &str) -> Result<Vec<String>, Error> {
        let mut names = self.map_read_error(group, self.file.group(group).and_then(|g| g.member_names()))?;
        names.sort();
        Ok(names)
    }

    /// Removes a group with its members, or a data set; no effect if missing.
    ///
    /// Remove data sets together with their dimension scales. Freed space is reused only until the file is
    /// closed.
    pub fn remove(&self, name: &str) -> Result<(), Error> {
        match self.contains(name) {
            true => self.map_write_error(name, self.file.unlink(name)),
            false => Ok(()),
        }
    }

    /// Creates a group and its parent groups; no effect if it exists.
    pub fn create_group(&self, name: &str) -> Result<(), Error> {
        self.map_write_error(name, self.group(name)).map(drop)
    }

    /// Writes a data set of f64 with its shape and attributes; the name must not exist yet.
    pub fn write(
        &self,
        name: &str,
        shape: &[usize],
        data: &[f64],
        attributes: &[(&str, Attribute)],
    ) -> Result<(), Error> {
        let compressed = is_worthwhile(data.iter().copied());
        self.map_write_error(name, self.dataset(name, shape, data, compressed, attributes))
    }

    /// Writes a data set of complex numbers, a compound {r, i} of f64; the name must not exist yet.
    pub fn write_complex(
        &self,
        name: &str,
        shape: &[usize],
        data: &[Complex<f64>],
        attributes: &[(&str, Attribute)],
    ) -> Result<(), Error> {
        let pairs: Vec<_> = data.iter().map(|z| ComplexPair { r: z.re, i: z.im }).collect();
        let parts = data.iter().map(|z| z.re);
        self.map_write_error(name, self.dataset(name, shape, &pairs, is_worthwhile(parts), attributes))
    }

    /// Writes a list of UTF-8 strings; the name must not exist yet.
    pub fn write_texts<T: AsRef<str>>(
        &self,
        name: &str,
        texts: &[T],
        attributes: &[(&str, Attribute)],
    ) -> Result<(), Error> {
        self.write_text_array(name, &[texts.len()], texts, attributes)
    }

    /// Writes a data set of UTF-8 strings with its shape; the name must not exist yet.
    pub fn write_text_array<T: AsRef<str>>(
        &self,
        name: &str,
        shape: &[usize],
        texts: &[T],
        attributes: &[(&str, Attribute)],
    ) -> Result<(), Error> {
        let written = texts
            .iter()
            .map(|text| attribute::unicode(text.as_ref()))
            .collect::<hdf5::Result<Vec<_>>>()
            .and_then(|texts| self.dataset(name, shape, &texts, true, attributes));
        self.map_write_error(name, written)
    }

    /// Kind and shape of the object of a name.
    pub fn object_kind(&self, name: &str) -> Result<ObjectKind, Error> {
        let Ok(dataset) = self.file.dataset(name) else { return Ok(ObjectKind::Group) };
        let shape = dataset.shape();
        let descriptor = self.map_read_error(name, dataset.dtype().and_then(|t| t.to_descriptor()));
        Ok(match descriptor {
            Ok(TypeDescriptor::Integer(_) | TypeDescriptor::Unsigned(_) | TypeDescriptor::Float(_)) => {
                ObjectKind::Real(shape)
            }
            Ok(TypeDescriptor::VarLenUnicode) => ObjectKind::Text(shape),
            Ok(TypeDescriptor::Compound(compound))
                if compound.fields.iter().map(|f| f.name.as_str()).eq(["r", "i"]) =>
            {
                ObjectKind::Complex(shape)
            }
            _ => ObjectKind::Other,
        })
    }

    /// Reads a data set of numbers.
    pub fn read(&self, name: &str) -> Result<Array<f64>, Error> {
        self.read_as(name)
    }

    /// Reads a data set of complex numbers.
    pub fn read_complex(&self, name: &str) -> Result<Array<Complex<f64>>, Error> {
        let Array { shape, data } = self.read_as::<ComplexPair>(name)?;
        Ok(Array { shape, data: data.iter().map(|z| Complex::new(z.r, z.i)).collect() })
    }

    /// Reads a list of strings.
    pub fn read_texts(&self, name: &str) -> Result<Vec<String>, Error> {
        Ok(self.read_as::<VarLenUnicode>(name)?.data.iter().map(|text| text.to_string()).collect())
    }

    /// Sets an attribute of a data set or group, replacing an earlier value; a missing group is created.
    pub fn set_attribute(&self, object: &str, name: &str, value: impl Into<Attribute>) -> Result<(), Error> {
        let set = match self.file.dataset(object) {
            Ok(dataset) => attribute::set(&dataset, name, &value.into()),
            Err(_) => self.group(object).and_then(|group| attribute::set(&group, name, &value.into())),
        };
        self.map_write_error(object, set)
    }

    /// Reads an attribute of a data set or group; `None` if missing.
    pub fn attribute(&self, object: &str, name: &str) -> Result<Option<Attribute>, Error> {
        let read = match self.file.dataset(object) {
            Ok(dataset) => attribute::get(&dataset, name, u64::MAX),
            Err(_) => self.file.group(object).and_then(|group| attribute::get(&group, name, u64::MAX)),
        };
        self.map_read_error(object, read)
    }

    /// Attaches the one-dimensional data set `scale` as dimension scale to a dimension (from 0) of `dataset`.
    ///
    /// `label` (at most 63 bytes) names the axis, "frequency"; h5py shows both as `dataset.dims[dimension]`.
    pub fn attach_scale(
        &self,
        dataset: &str,
        dimension: usize,
        scale: &str,
        label: &str,
    ) -> Result<(), Error> {
        self.map_write_error(dataset, scale::attach(&self.file, &self.path, dataset, dimension, scale, label))
    }

    /// The group of this name; it and its parent groups are created if missing.
    fn group(&self, name: &str) -> hdf5::Result<Group> {
        let mut group = self.file.as_group()?;
        for prefix in prefixes(name) {
            group = match self.file.link_exists(prefix) {
                true => self.file.group(prefix)?,
                false => self.file.create_group_builder().obj_track_times(false).create(prefix)?,
            };
        }
        Ok(group)
    }

    fn dataset<T: H5Type>(
        &self,
        name: &str,
        shape: &[usize],
        data: &[T],
        compressed: bool,
        attributes: &[(&str, Attribute)],
    ) -> hdf5::Result<()> {
        if shape.iter().product::<usize>() != data.len() {
            let message = format!("the shape {shape:?} does not fit {} values", data.len());
            return Err(hdf5::Error::Internal(message));
        }
        let parent = name.rsplit_once('/').map_or("", |(parent, _)| parent);
        self.group(parent)?;
        let mut builder = self.file.new_dataset::<T>().obj_track_times(false);
        if compressed && data.len() >= MIN_CHUNKED_VALUES {
            builder = builder.chunk(chunk(shape)).shuffle().deflate(DEFLATE_LEVEL);
        }
        let dataset = builder.shape(shape).create(name)?;
        let set = |(name, value): &(&str, Attribute)| attribute::set(&dataset, name, value);
        let written = dataset.write_raw(data).and_then(|()| attributes.iter().try_for_each(set));
        self.file.flush_open(vec![dataset], written)
    }

    fn read_as<T: H5Type>(&self, name: &str) -> Result<Array<T>, Error> {
        let read = self
            .file
            .dataset(name)
            .and_then(|dataset: Dataset| Ok(Array { shape: dataset.shape(), data: dataset.read_raw()? }));
        self.map_read_error(name, read)
    }

    fn map_write_error<T>(&self, object: &str, result: hdf5::Result<T>) -> Result<T, Error> {
        result.map_err(|e| {
            self.file.keep_open();
            Error::of_file("write", &self.path)(format!("{object}: {e}"))
        })
    }

    fn map_read_error<T>(&self, object: &str, result: hdf5::Result<T>) -> Result<T, Error> {
        result.map_err(|e| Error::of_file("read", &self.path)(format!("{object}: {e}")))
    }
}

/// `/a/b/c` as `/a`, `/a/b`, `/a/b/c`.
fn prefixes(name: &str) -> impl Iterator<Item = &str> {
    let name = name.trim_end_matches('/');
    let ends = name.match_indices('/').map(|(end, _)| end).chain([name.len()]);
    ends.filter(|&end| end > 0).map(|end| &name[..end])
}

/// Chunk shape of at most `MAX_CHUNK_VALUES` values, filled from the last dimension.
fn chunk(shape: &[usize]) -> Vec<usize> {
    let mut left = MAX_CHUNK_VALUES;
    let mut chunk = shape.to_vec();
    for size in chunk.iter_mut().rev() {
        *size = (*size).min(left.max(1));
        left /= *size;
    }
    chunk
}

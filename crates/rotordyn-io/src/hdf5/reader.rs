//! Reading HDF5 files: what is asked of one, and the answers of a file that is open in this process.
//!
//! Shapes and lengths in a file are held against a budget before anything is allocated, and what a file only refers to in
//! other files is not read.

use std::fmt::Debug;
use std::ops::Range;
use std::path::Path;

use hdf5::plist::dataset_create::Layout;
use hdf5::types::{
    CompoundType, FixedAscii, FixedUnicode, Reference, TypeDescriptor, VarLenAscii, VarLenUnicode,
};
use hdf5::{
    Dataset, H5Type, IndexType, IterationOrder, LinkType, LocationType, ObjectReference, ObjectReference1,
    ReferencedObject,
};
use nalgebra::Complex;
use serde::{Deserialize, Serialize};

use super::attribute::{MAX_FIXED_TEXT, lossy};
use super::{Array, Attribute, ComplexPair, ObjectKind, Store, attribute};
use crate::budget::{Budget, Limits};
use crate::error::Error;

/// A file to read from, in this process or in another. Objects are named by absolute paths, `/modes/omega`.
///
/// # Errors
/// Every method: the file is damaged or the object is missing, of another type or larger than the budget.
pub trait Reader: Debug + Send {
    /// The file's path.
    fn path(&self) -> &Path;
    /// Memory that the contents of the file may take, and each of its data sets \[bytes\].
    fn memory(&self) -> u64;
    /// Whether there is a group or data set of this name.
    fn contains(&self, name: &str) -> Result<bool, Error>;
    /// Names of the groups and data sets in a group, in alphabetical order.
    fn members(&self, group: &str) -> Result<Vec<String>, Error>;
    /// What the links of a group lead to, in alphabetical order of their names.
    fn links(&self, group: &str) -> Result<Links, Error>;
    /// An attribute of a data set or group; `None` if missing.
    fn attribute(&self, object: &str, name: &str) -> Result<Option<Attribute>, Error>;
    /// All attributes of a data set or group; those that cannot be read say why.
    fn attributes(&self, object: &str) -> Result<Vec<(String, Attribute)>, Error>;
    /// A data set of numbers.
    fn read(&self, name: &str) -> Result<Array<f64>, Error>;
    /// Values of a one-dimensional data set of numbers.
    fn read_range(&self, name: &str, range: Range<usize>) -> Result<Vec<f64>, Error>;
    /// A data set of complex numbers.
    fn read_complex(&self, name: &str) -> Result<Array<Complex<f64>>, Error>;
    /// Marks of the objects to which a data set of references leads, as in [`Link::mark`]; empty for those to nothing.
    fn references(&self, name: &str) -> Result<Vec<String>, Error>;
    /// A data set of strings.
    fn read_texts(&self, name: &str) -> Result<Vec<String>, Error>;
}

/// The links of a group.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Links {
    /// Mark of the group's place in the file, as in [`LinkTarget::Group`].
    pub group: String,
    pub links: Vec<Link>,
}

/// A link of a group.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Link {
    pub name: String,
    /// Mark of the place in the file of what the link leads to; empty if to nothing.
    pub mark: String,
    pub target: LinkTarget,
}

/// What a link leads to.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum LinkTarget {
    /// A group, with a mark of its place in the file: two links to one group have the same.
    Group(String),
    DataSet(ObjectKind),
    /// Nothing that is read, and why.
    Nothing(String),
}

/// A file open in this process, with the memory that its contents may take \[bytes\].
pub trait Bounded: Debug + Send {
    fn store(&self) -> &Store;
    fn allowed(&self) -> u64;
}

impl Bounded for Store {
    fn store(&self) -> &Store {
        self
    }

    fn allowed(&self) -> u64 {
        Limits::default().memory_of(self.file.size())
    }
}

/// A file open for reading in this process, within stated limits.
#[derive(Debug)]
pub struct OpenFile {
    store: Store,
    memory: u64,
}

impl OpenFile {
    /// Opens a file for reading.
    ///
    /// # Errors
    /// The file cannot be read, or is no HDF5 file.
    pub fn open(path: &Path, limits: &Limits) -> Result<Self, Error> {
        let file = std::fs::File::open(path).map_err(Error::of_file("open", path))?;
        let size = crate::budget::regular_size(path, &file)?;
        let store = Store::open(path).map_err(|error| unopened(path, &cause(&error)))?;
        Ok(Self { store, memory: limits.memory_of(size) })
    }

    /// Values that a data set claims to have, at most 2⁴⁸; none if it cannot be opened.
    pub(super) fn values_in(&self, name: &str) -> u64 {
        let shape = self.store.file.dataset(name).map_or(vec![0], |data| data.shape());
        shape.iter().fold(1_u64, |product, n| product.saturating_mul(*n as u64)).min(1 << 48)
    }
}

impl Bounded for OpenFile {
    fn store(&self) -> &Store {
        &self.store
    }

    fn allowed(&self) -> u64 {
        self.memory
    }
}

/// The error without operation and path.
fn cause(error: &Error) -> String {
    match error {
        Error::Environment { source, .. } => source.to_string(),
        other => other.to_string(),
    }
}

/// The error of a file that the library does not open: none of its kind, or a damaged one.
fn unopened(path: &Path, problem: &str) -> Error {
    if !problem.contains("file signature not found") {
        return damaged(path, format!("the HDF5 library does not open it: {problem}"));
    }
    let advice = "give results.h5 of a run or its folder; if it is meant to be one, copy the file again";
    Error::Content { path: path.into(), problem: "not an HDF5 file".into(), advice: advice.into() }
}

/// The error of a file whose contents cannot be read.
pub(super) fn damaged(path: &Path, problem: String) -> Error {
    let advice = "copy the file again, or write it again with the program that made it".into();
    Error::Content { path: path.into(), problem, advice }
}

/// Memory of a mark \[bytes\].
const MARK: usize = 128;

/// The compound of complex numbers in MATLAB 7.3; that of h5py is {r, i}.
#[derive(Clone, Copy, H5Type)]
#[repr(C)]
struct MatlabPair {
    real: f64,
    imag: f64,
}

fn is_pair(compound: &CompoundType, names: [&str; 2]) -> bool {
    compound.fields.iter().map(|field| field.name.as_str()).eq(names)
}

/// Values per block of a list of texts, whose lengths are known only when they have been read.
const TEXT_BLOCK: usize = 64;
impl<T: Bounded> Reader for T {
    fn path(&self) -> &Path {
        &self.store().path
    }

    fn memory(&self) -> u64 {
        self.allowed()
    }

    fn contains(&self, name: &str) -> Result<bool, Error> {
        Ok(self.store().contains(name))
    }

    fn members(&self, group: &str) -> Result<Vec<String>, Error> {
        let names = self.store().file.group(group).and_then(|group| group.member_names());
        let mut names = self.answer(group, names)?;
        names.sort();
        Ok(names)
    }

    fn links(&self, group: &str) -> Result<Links, Error> {
        let opened = self.answer(group, self.store().file.group(group))?;
        let mark = format!("{:?}", self.answer(group, opened.loc_info())?.token);
        let found = opened.links(IndexType::Name, IterationOrder::Increasing);
        let found = self.answer(group, found)?;
        let counted = self.budget().objects(&format!("links in {group}"), found.len());
        counted.map_err(|exceeded| exceeded.of_file(&self.store().path))?;
        let mut links = Vec::with_capacity(found.len());
        for (name, about) in found {
            let path = format!("{}/{name}", group.trim_end_matches('/'));
            let (mark, target) = match about.link_type {
                LinkType::External => (String::new(), LinkTarget::Nothing("a link to another file".into())),
                LinkType::Hard | LinkType::Soft => self.target(&path),
            };
            links.push(Link { name, mark, target });
        }
        links.sort_by(|a, b| a.name.cmp(&b.name));
        Ok(Links { group: mark, links })
    }

    fn attribute(&self, object: &str, name: &str) -> Result<Option<Attribute>, Error> {
        let file = &self.store().file;
        let read = match file.dataset(object) {
            Ok(dataset) => attribute::get(&dataset, name, self.allowed()),
            Err(_) => file.group(object).and_then(|group| attribute::get(&group, name, self.allowed())),
        };
        self.answer(object, read)
    }

    fn attributes(&self, object: &str) -> Result<Vec<(String, Attribute)>, Error> {
        let file = &self.store().file;
        let all = match file.dataset(object) {
            Ok(dataset) => attribute::all(&dataset, self.allowed()),
            Err(_) => file.group(object).and_then(|group| attribute::all(&group, self.allowed())),
        };
        self.answer(object, all)
    }

    fn read(&self, name: &str) -> Result<Array<f64>, Error> {
        self.values(name, 0.0)
    }

    fn read_range(&self, name: &str, range: Range<usize>) -> Result<Vec<f64>, Error> {
        let dataset = self.data(name)?;
        let shape = self.shape(name, &dataset)?;
        if range.start > range.end || shape.len() != 1 || range.end > shape[0] {
            let problem = format!("{name} of shape {shape:?} has no values {} .. {}", range.start, range.end);
            return Err(damaged(self.path(), problem));
        }
        // HDF5 has no selection of nothing.
        if range.is_empty() {
            return Ok(Vec::new());
        }
        self.allow::<f64>(name, Some(range.len()))?;
        let read = dataset.read_slice_1d::<f64, _>(range);
        Ok(self.answer(name, read)?.into_raw_vec_and_offset().0)
    }

    fn read_complex(&self, name: &str) -> Result<Array<Complex<f64>>, Error> {
        let kind = self.data(name)?.dtype().and_then(|kind| kind.to_descriptor());
        let of_matlab = |kind: &TypeDescriptor| matches!(kind, TypeDescriptor::Compound(c) if is_pair(c, ["real", "imag"]));
        if kind.is_ok_and(|kind| of_matlab(&kind)) {
            let Array { shape, data } = self.values(name, MatlabPair { real: 0.0, imag: 0.0 })?;
            return Ok(Array { shape, data: data.iter().map(|z| Complex::new(z.real, z.imag)).collect() });
        }
        let Array { shape, data } = self.values(name, ComplexPair { r: 0.0, i: 0.0 })?;
        Ok(Array { shape, data: data.iter().map(|z| Complex::new(z.r, z.i)).collect() })
    }

    fn references(&self, name: &str) -> Result<Vec<String>, Error> {
        let dataset = self.data(name)?;
        let shape = self.shape(name, &dataset)?;
        let count = shape.iter().try_fold(1_usize, |product, n| product.checked_mul(*n));
        self.allow::<(ObjectReference1, [u8; MARK])>(name, count)?;
        let counted = self.budget().objects("references", count.unwrap_or(usize::MAX));
        counted.map_err(|exceeded| exceeded.of_file(&self.store().path))?;
        let found = self.answer(name, dataset.read_raw::<ObjectReference1>())?;
        let mark = |reference: &ObjectReference1| {
            let about = match reference.dereference(&self.store().file)? {
                ReferencedObject::Group(group) => group.loc_info(),
                ReferencedObject::Dataset(data) => data.loc_info(),
                ReferencedObject::Datatype(_) => return Ok(String::new()),
            };
            Ok::<_, hdf5::Error>(format!("{:?}", about?.token))
        };
        Ok(found.iter().map(|reference| mark(reference).unwrap_or_default()).collect())
    }

    fn read_texts(&self, name: &str) -> Result<Vec<String>, Error> {
        let dataset = self.data(name)?;
        let kind = dataset.dtype().and_then(|kind| kind.to_descriptor());
        match self.answer(name, kind)? {
            TypeDescriptor::VarLenUnicode => {
                self.texts(name, &dataset, |t: &VarLenUnicode| lossy(t.as_bytes()))
            }
            TypeDescriptor::VarLenAscii => self.texts(name, &dataset, |t: &VarLenAscii| lossy(t.as_bytes())),
            TypeDescriptor::FixedAscii(_) => {
                self.texts(name, &dataset, |t: &FixedAscii<MAX_FIXED_TEXT>| lossy(t.as_bytes()))
            }
            TypeDescriptor::FixedUnicode(_) => {
                self.texts(name, &dataset, |t: &FixedUnicode<MAX_FIXED_TEXT>| lossy(t.as_bytes()))
            }
            other => Err(damaged(self.path(), format!("{name} is of type {other}, not a list of texts"))),
        }
    }
}

/// The steps of [`Reader`].
trait Steps: Bounded {
    fn answer<V>(&self, object: &str, result: hdf5::Result<V>) -> Result<V, Error> {
        result.map_err(|error| damaged(&self.store().path, format!("{object}: {error}")))
    }

    /// What a link leads to, with its mark.
    fn target(&self, path: &str) -> (String, LinkTarget) {
        let file = &self.store().file;
        let Ok(about) = file.loc_info_by_name(path) else {
            return (String::new(), LinkTarget::Nothing("a link to nothing".into()));
        };
        let mark = format!("{:?}", about.token);
        let target = match about.loc_type {
            LocationType::Group => LinkTarget::Group(mark.clone()),
            LocationType::Dataset => match self.data(path).and_then(|data| self.kind(path, &data)) {
                Ok(ObjectKind::Other) => LinkTarget::Nothing("neither numbers nor texts".into()),
                // Its shape is that of a number.
                Ok(_) if self.is_null(path) => LinkTarget::Nothing("empty".into()),
                Ok(kind) => LinkTarget::DataSet(kind),
                Err(Error::Content { problem, .. }) => {
                    LinkTarget::Nothing(problem.trim_start_matches(&format!("{path}: ")).to_owned())
                }
                Err(other) => LinkTarget::Nothing(other.to_string()),
            },
            _ => LinkTarget::Nothing("a data type".into()),
        };
        (mark, target)
    }

    /// A data set whose values are in this file.
    fn data(&self, name: &str) -> Result<Dataset, Error> {
        let data = self.answer(name, self.store().file.dataset(name))?;
        let plist = self.answer(name, data.dcpl())?;
        if plist.layout() == Layout::Virtual || !plist.external().is_empty() {
            let problem = format!("{name}: its values are in other files, which are not read");
            return Err(damaged(&self.store().path, problem));
        }
        Ok(data)
    }

    /// Whether a data set has no values at all.
    fn is_null(&self, name: &str) -> bool {
        self.store().file.dataset(name).and_then(|data| data.space()).is_ok_and(|space| space.is_null())
    }

    fn shape(&self, name: &str, data: &Dataset) -> Result<Vec<usize>, Error> {
        self.answer(name, data.space().map(|space| space.shape()))
    }

    fn kind(&self, name: &str, data: &Dataset) -> Result<ObjectKind, Error> {
        let shape = self.shape(name, data)?;
        Ok(match data.dtype().and_then(|kind| kind.to_descriptor()) {
            Ok(TypeDescriptor::Integer(_) | TypeDescriptor::Unsigned(_) | TypeDescriptor::Float(_)) => {
                ObjectKind::Real(shape)
            }
            Ok(TypeDescriptor::VarLenUnicode | TypeDescriptor::VarLenAscii) => ObjectKind::Text(shape),
            Ok(TypeDescriptor::FixedAscii(length) | TypeDescriptor::FixedUnicode(length))
                if length <= MAX_FIXED_TEXT =>
            {
                ObjectKind::Text(shape)
            }
            Ok(TypeDescriptor::Compound(compound))
                if is_pair(&compound, ["r", "i"]) || is_pair(&compound, ["real", "imag"]) =>
            {
                ObjectKind::Complex(shape)
            }
            Ok(TypeDescriptor::Reference(Reference::Object)) => ObjectKind::References(shape),
            _ => ObjectKind::Other,
        })
    }

    /// Holds a number of values against the memory; `None` is one that overflows.
    fn allow<V>(&self, name: &str, count: Option<usize>) -> Result<(), Error> {
        let taken = self.budget().take_values::<V>(|| name.into(), count.unwrap_or(usize::MAX));
        taken.map_err(|exceeded| exceeded.of_file(&self.store().path))
    }

    fn budget(&self) -> Budget {
        Budget::of_memory(self.allowed())
    }

    fn values<V: H5Type + Copy>(&self, name: &str, zero: V) -> Result<Array<V>, Error> {
        let dataset = self.data(name)?;
        let shape = self.shape(name, &dataset)?;
        let count = shape.iter().try_fold(1_usize, |product, n| product.checked_mul(*n));
        self.allow::<V>(name, count)?;
        let count = count.unwrap_or(0);
        let mut data = Vec::new();
        let no_memory = |_| damaged(&self.store().path, format!("{name}: the system has no memory for it"));
        data.try_reserve_exact(count).map_err(no_memory)?;
        data.resize(count, zero);
        self.answer(name, dataset.as_reader().read_into_raw(&mut data))?;
        Ok(Array { shape, data })
    }

    fn texts<V: H5Type>(
        &self,
        name: &str,
        dataset: &Dataset,
        text: impl Fn(&V) -> String,
    ) -> Result<Vec<String>, Error> {
        let shape = self.shape(name, dataset)?;
        let count = shape.iter().try_fold(1_usize, |product, n| product.checked_mul(*n));
        self.allow::<V>(name, count)?;
        self.allow::<String>(name, count)?;
        let [length] = shape[..] else {
            return Ok(self.answer(name, dataset.read_raw::<V>())?.iter().map(text).collect());
        };
        let mut out = Vec::new();
        let mut bytes = 0;
        for start in (0..length).step_by(TEXT_BLOCK) {
            let block = dataset.read_slice_1d::<V, _>(start..length.min(start + TEXT_BLOCK));
            for found in self.answer(name, block)?.iter().map(&text) {
                bytes += found.len() + size_of::<String>();
                out.push(found);
            }
            self.allow::<u8>(name, Some(bytes))?;
        }
        Ok(out)
    }
}

impl<T: Bounded> Steps for T {}

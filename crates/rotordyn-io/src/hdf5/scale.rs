//! Dimension scales: axes of data sets, in the form of the HDF5 dimension scale specification.

use super::attribute;
use crate::atomic_file::NewFile;
use hdf5::types::{FixedAscii, FixedUnicode, TypeDescriptor, VarLenArray, VarLenUnicode};
use hdf5::{Dataset, Datatype, File, H5Type, ObjectReference1};
use std::path::Path;
use std::sync::OnceLock;

/// A file whose only attribute CLASS has the type required by the specification, a null-terminated string of
/// 16 bytes; the hdf5 crate can read this type from a file but not create it. Written with h5py:
/// `t = h5t.C_S1.copy(); t.set_size(16); h5a.create(f.id, b"CLASS", t, h5s.create(h5s.SCALAR))`.
const SCALE_CLASS: &[u8] = include_bytes!("scale_class.h5");

/// Data set and dimension that a scale is attached to, an element of the scale's attribute REFERENCE_LIST.
#[derive(Clone, Copy, H5Type)]
#[repr(C)]
struct BackReference {
    dataset: ObjectReference1,
    dimension: u32,
}

/// Attaches `scale` to one dimension of `dataset`; both must exist in `file` of the path `path`.
pub(super) fn attach(
    file: &File,
    path: &Path,
    dataset: &str,
    dimension: usize,
    scale: &str,
    label: &str,
) -> hdf5::Result<()> {
    let (data, axis) = (file.dataset(dataset)?, file.dataset(scale)?);
    let shape = data.shape();
    if axis.ndim() != 1 || shape.get(dimension) != axis.shape().first() {
        let message =
            format!("{scale} of shape {:?} does not fit dimension {dimension} of {shape:?}", axis.shape());
        return Err(hdf5::Error::Internal(message));
    }
    mark_as_scale(&axis, path, label)?;

    let empty = || vec![VarLenArray::from_slice(&[]); shape.len()];
    let mut scales: Vec<VarLenArray<ObjectReference1>> = list(&data, "DIMENSION_LIST")?.unwrap_or_else(empty);
    let of_dimension = [&scales[dimension][..], &[file.reference(scale)?]].concat();
    scales[dimension] = VarLenArray::from_slice(&of_dimension);
    replace(&data, "DIMENSION_LIST", &scales)?;

    let empty = || vec![VarLenUnicode::new(); shape.len()];
    let mut labels: Vec<VarLenUnicode> = list(&data, "DIMENSION_LABELS")?.unwrap_or_else(empty);
    labels[dimension] = attribute::unicode(label)?;
    replace(&data, "DIMENSION_LABELS", &labels)?;

    let mut owners: Vec<BackReference> = list(&axis, "REFERENCE_LIST")?.unwrap_or_default();
    // HDF5 allows 32 dimensions.
    owners.push(BackReference { dataset: file.reference(dataset)?, dimension: dimension as u32 });
    replace(&axis, "REFERENCE_LIST", &owners)
}

fn list<T: H5Type>(object: &Dataset, name: &str) -> hdf5::Result<Option<Vec<T>>> {
    match attribute::has(object, name)? {
        true => object.attr(name)?.read_raw().map(Some),
        false => Ok(None),
    }
}

fn replace<T: H5Type>(object: &Dataset, name: &str, values: &[T]) -> hdf5::Result<()> {
    if attribute::has(object, name)? {
        object.delete_attr(name)?;
    }
    attribute::list(object, name, values)
}

fn mark_as_scale(axis: &Dataset, path: &Path, label: &str) -> hdf5::Result<()> {
    if attribute::has(axis, "CLASS")? {
        return Ok(());
    }
    let class = axis.new_attr_builder().empty_as(scale_class(path)?).create("CLASS")?;
    class.write_scalar(&FixedAscii::<16>::from_ascii(b"DIMENSION_SCALE").map_err(internal)?)?;
    // Readers take the name's length from its type, with one byte for a NUL.
    let length = TypeDescriptor::FixedUnicode(label.len() + 1);
    let name = axis.new_attr_builder().empty_as(&length).create("NAME")?;
    name.write_scalar(&label.parse::<FixedUnicode<64>>().map_err(internal)?)
}

/// The type of CLASS, read once from a temporary file next to `path`.
fn scale_class(path: &Path) -> hdf5::Result<Datatype> {
    static CLASS: OnceLock<Datatype> = OnceLock::new();
    if let Some(class) = CLASS.get() {
        return Ok(class.clone());
    }
    let small = NewFile::replacing(path);
    std::fs::write(small.part(), SCALE_CLASS).map_err(internal)?;
    let class = File::open(small.part()).and_then(|file| file.attr("CLASS")?.dtype())?;
    Ok(CLASS.get_or_init(|| class).clone())
}

fn internal(error: impl std::fmt::Display) -> hdf5::Error {
    hdf5::Error::Internal(error.to_string())
}

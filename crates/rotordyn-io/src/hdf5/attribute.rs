//! Attributes of groups and data sets.

use hdf5::types::{FixedAscii, FixedUnicode, TypeDescriptor, VarLenAscii, VarLenUnicode};
use hdf5::{H5Type, Location};
use serde::{Deserialize, Serialize};

/// Longest text of fixed length that is read \[bytes\].
pub(super) const MAX_FIXED_TEXT: usize = 1024;

/// The value of an attribute.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Attribute {
    Text(String),
    Number(f64),
    Integer(i64),
    Texts(Vec<String>),
    Numbers(Vec<f64>),
    /// Neither texts nor numbers, or too large: why it was not read.
    Unread(String),
}

impl From<&str> for Attribute {
    fn from(text: &str) -> Self {
        Attribute::Text(text.into())
    }
}

impl From<String> for Attribute {
    fn from(text: String) -> Self {
        Attribute::Text(text)
    }
}

impl From<f64> for Attribute {
    fn from(number: f64) -> Self {
        Attribute::Number(number)
    }
}

impl From<i64> for Attribute {
    fn from(number: i64) -> Self {
        Attribute::Integer(number)
    }
}

impl From<&[f64]> for Attribute {
    fn from(numbers: &[f64]) -> Self {
        Attribute::Numbers(numbers.into())
    }
}

impl From<Vec<String>> for Attribute {
    fn from(texts: Vec<String>) -> Self {
        Attribute::Texts(texts)
    }
}

/// Sets an attribute, replacing an earlier value.
pub(super) fn set(object: &Location, name: &str, value: &Attribute) -> hdf5::Result<()> {
    if has(object, name)? {
        object.delete_attr(name)?;
    }
    match value {
        Attribute::Text(text) => scalar(object, name, &unicode(text)?),
        Attribute::Number(number) => scalar(object, name, number),
        Attribute::Integer(number) => scalar(object, name, number),
        Attribute::Texts(texts) => {
            let texts = texts.iter().map(|text| unicode(text)).collect::<hdf5::Result<Vec<_>>>()?;
            list(object, name, &texts)
        }
        Attribute::Numbers(numbers) => list(object, name, numbers),
        Attribute::Unread(why) => Err(hdf5::Error::Internal(format!("attribute {name}: {why}"))),
    }
}

/// Text of a file, which need not be UTF-8.
pub(super) fn lossy(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Reads an attribute of at most `memory` bytes; `None` if missing.
pub(super) fn get(object: &Location, name: &str, memory: u64) -> hdf5::Result<Option<Attribute>> {
    if !has(object, name)? {
        return Ok(None);
    }
    let found = value(object, name, memory);
    found.map(Some).map_err(|why| hdf5::Error::Internal(format!("attribute {name}: {why}")))
}

/// All attributes; those that cannot be read say why.
pub(super) fn all(object: &Location, memory: u64) -> hdf5::Result<Vec<(String, Attribute)>> {
    let names = object.attr_names()?.into_iter();
    let found = names.map(|name| {
        let value = value(object, &name, memory).unwrap_or_else(|why| Attribute::Unread(why.to_string()));
        (name, value)
    });
    Ok(found.collect())
}

fn value(object: &Location, name: &str, memory: u64) -> hdf5::Result<Attribute> {
    let attribute = object.attr(name)?;
    let shape = attribute.space()?.shape();
    let count = shape.iter().try_fold(1_usize, |product, n| product.checked_mul(*n));
    // The largest element is a text of fixed length.
    if count.is_none_or(|count| (count as u64).saturating_mul(MAX_FIXED_TEXT as u64) > memory) {
        return Err(hdf5::Error::Internal("it is too large".into()));
    }
    let one = attribute.is_scalar();
    let texts = |found: Vec<String>| match one {
        true => Attribute::Text(found.into_iter().next().unwrap_or_default()),
        false => Attribute::Texts(found),
    };
    Ok(match attribute.dtype()?.to_descriptor()? {
        TypeDescriptor::VarLenUnicode => {
            texts(attribute.read_raw::<VarLenUnicode>()?.iter().map(|t| lossy(t.as_bytes())).collect())
        }
        TypeDescriptor::VarLenAscii => {
            texts(attribute.read_raw::<VarLenAscii>()?.iter().map(|t| lossy(t.as_bytes())).collect())
        }
        TypeDescriptor::FixedAscii(length) if length <= MAX_FIXED_TEXT => {
            let found = attribute.read_raw::<FixedAscii<MAX_FIXED_TEXT>>()?;
            texts(found.iter().map(|t| lossy(t.as_bytes())).collect())
        }
        TypeDescriptor::FixedUnicode(length) if length <= MAX_FIXED_TEXT => {
            let found = attribute.read_raw::<FixedUnicode<MAX_FIXED_TEXT>>()?;
            texts(found.iter().map(|t| lossy(t.as_bytes())).collect())
        }
        TypeDescriptor::Integer(_) | TypeDescriptor::Unsigned(_) if one => {
            Attribute::Integer(attribute.read_raw()?.first().copied().unwrap_or(0))
        }
        TypeDescriptor::Float(_) if one => {
            Attribute::Number(attribute.read_raw()?.first().copied().unwrap_or(f64::NAN))
        }
        TypeDescriptor::Integer(_) | TypeDescriptor::Unsigned(_) | TypeDescriptor::Float(_) => {
            Attribute::Numbers(attribute.read_raw()?)
        }
        other => {
            return Err(hdf5::Error::Internal(format!("it is of type {other}")));
        }
    })
}

pub(super) fn has(object: &Location, name: &str) -> hdf5::Result<bool> {
    Ok(object.attr_names()?.iter().any(|present| present == name))
}

pub(super) fn scalar<T: H5Type>(object: &Location, name: &str, value: &T) -> hdf5::Result<()> {
    object.new_attr::<T>().create(name)?.write_scalar(value)
}

pub(super) fn list<T: H5Type>(object: &Location, name: &str, values: &[T]) -> hdf5::Result<()> {
    object.new_attr::<T>().shape(values.len()).create(name)?.write_raw(values)
}

/// A variable-length UTF-8 string; a NUL character in it is an error.
pub(super) fn unicode(text: &str) -> hdf5::Result<VarLenUnicode> {
    text.parse().map_err(|e| hdf5::Error::Internal(format!("text {text:?}: {e}")))
}

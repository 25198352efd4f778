//! Attributes of groups and data sets.

use hdf5::types::{TypeDescriptor, VarLenUnicode};
use hdf5::{H5Type, Location};

/// The value of an attribute.
#[derive(Clone, Debug, PartialEq)]
pub enum Attribute {
    Text(String),
    Number(f64),
    Integer(i64),
    Texts(Vec<String>),
    Numbers(Vec<f64>),
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
    }
}

/// Reads an attribute; `None` if missing.
pub(super) fn get(object: &Location, name: &str) -> hdf5::Result<Option<Attribute>> {
    if !has(object, name)? {
        return Ok(None);
    }
    let attribute = object.attr(name)?;
    let value = match (attribute.dtype()?.to_descriptor()?, attribute.is_scalar()) {
        (TypeDescriptor::VarLenUnicode, true) => {
            Attribute::Text(attribute.read_scalar::<VarLenUnicode>()?.to_string())
        }
        (TypeDescriptor::VarLenUnicode, false) => {
            Attribute::Texts(attribute.read_raw::<VarLenUnicode>()?.iter().map(|t| t.to_string()).collect())
        }
        (TypeDescriptor::Integer(_) | TypeDescriptor::Unsigned(_), true) => {
            Attribute::Integer(attribute.read_scalar()?)
        }
        (TypeDescriptor::Float(_), true) => Attribute::Number(attribute.read_scalar()?),
        (TypeDescriptor::Float(_), false) => Attribute::Numbers(attribute.read_raw()?),
        (other, _) => {
            return Err(hdf5::Error::Internal(format!("attribute {name} is of type {other}")));
        }
    };
    Ok(Some(value))
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

//! A named array of a file.

use super::stated_value::stated_value;
use super::unit_label::SiUnit;
use rotordyn_signal::Complex;

/// An array of a file; values with the last index fastest.
#[derive(Clone, Debug, PartialEq)]
pub struct Array {
    pub name: String,
    pub shape: Vec<usize>,
    pub data: Data,
}

/// Values of an array.
#[derive(Clone, Debug, PartialEq)]
pub enum Data {
    Real(Vec<f64>),
    Complex(Vec<Complex<f64>>),
    Text(Vec<String>),
}

impl Data {
    pub fn len(&self) -> usize {
        match self {
            Data::Real(values) => values.len(),
            Data::Complex(values) => values.len(),
            Data::Text(texts) => texts.len(),
        }
    }

    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl Array {
    pub fn real(name: &str, values: Vec<f64>) -> Self {
        Array { name: name.into(), shape: vec![values.len()], data: Data::Real(values) }
    }

    pub fn scalar(name: &str, value: f64) -> Self {
        Array { name: name.into(), shape: Vec::new(), data: Data::Real(vec![value]) }
    }

    pub fn text(name: &str, text: &str) -> Self {
        Array { name: name.into(), shape: vec![1], data: Data::Text(vec![text.into()]) }
    }

    /// The shape without dimensions of one.
    pub(super) fn squeezed(&self) -> Vec<usize> {
        self.shape.iter().copied().filter(|&n| n != 1).collect()
    }

    pub(super) fn as_scalar(&self) -> Option<f64> {
        match &self.data {
            Data::Real(values) if values.len() == 1 => Some(values[0]),
            _ => None,
        }
    }

    /// A number, also one that is stored as text, with the unit that the text states.
    ///
    /// Programs write texts with a decimal point: "51.200 Hz" is below 52 Hz. "51,200" may be either, and is none.
    pub(super) fn as_stated(&self) -> Option<(f64, Option<SiUnit>)> {
        match &self.data {
            Data::Text(texts) if texts.len() == 1 => {
                let (written, si) = stated_value(&texts[0])?;
                let by_point = || written.with('.').filter(|_| written.has_point());
                Some((written.definite().or_else(by_point)?, si))
            }
            _ => self.as_scalar().map(|value| (value, None)),
        }
    }

    pub(super) fn as_text(&self) -> Option<&str> {
        match &self.data {
            Data::Text(texts) => texts.first().map(String::as_str),
            _ => None,
        }
    }

    /// Values if the array has one dimension.
    pub(super) fn as_list(&self) -> Option<&[f64]> {
        match &self.data {
            Data::Real(values) if values.len() > 1 && self.squeezed().len() == 1 => Some(values),
            _ => None,
        }
    }
}

//! MATLAB v5 .mat files: numeric and text arrays, compressed or not, either byte order; written uncompressed.
//!
//! Cells, structs and sparse matrices are skipped and their names reported. Version 7.3 files are HDF5.
//! The crate matfile 0.5 reads numbers only, without texts, the names of what it skips, or writing.
//! Format: MATLAB MAT-File Format, The MathWorks, R2019b.

use std::borrow::Cow;
use std::path::Path;

use super::inflate;
use super::measured::arrays::{Array, Data};
use crate::error::Error;
use rotordyn_signal::Complex;

/// Data types of elements.
const INT32: u32 = 5;
const UINT32: u32 = 6;
const DOUBLE: u32 = 9;
const MATRIX: u32 = 14;
const COMPRESSED: u32 = 15;
/// Array classes.
const CHAR_CLASS: u8 = 4;
const DOUBLE_CLASS: u8 = 6;
/// Classes of numbers: double, single, and integers of either sign up to 64 bits.
const NUMERIC: std::ops::RangeInclusive<u8> = 6..=15;
const COMPLEX_FLAG: u32 = 0x0800;
const HEADER: usize = 128;
/// Longest variable name in MATLAB (`namelengthmax`).
pub const MAX_NAME_LENGTH: usize = 63;

/// Message on an error in a file.
type Message = &'static str;

/// Whether a file starts with the header of a v5 .mat file.
pub fn is_mat(head: &[u8]) -> bool {
    matches!(head.get(124..128), Some([0, 1, b'I', b'M'] | [1, 0, b'M', b'I']))
}

/// Reads every numeric and text array of a file; the second list has the names of skipped arrays.
///
/// # Errors
/// The file cannot be read, is cut off, or is not a v5 .mat file.
pub fn read(path: &Path) -> Result<(Vec<Array>, Vec<String>), Error> {
    let bytes = std::fs::read(path).map_err(Error::of_file("read", path))?;
    parse(&bytes).map_err(|problem| Error::Content {
        path: path.into(),
        problem: problem.into(),
        advice: "copy the file again, or save it with `save -v7`".into(),
    })
}

fn parse(bytes: &[u8]) -> Result<(Vec<Array>, Vec<String>), Message> {
    if !is_mat(bytes) {
        return Err("it is not a MATLAB v5 file");
    }
    let little = bytes[126] == b'I';
    let (mut arrays, mut left_out) = (Vec::new(), Vec::new());
    let mut file = Reader { rest: &bytes[HEADER..], little };
    while !file.rest.is_empty() {
        let (kind, data) = file.element()?;
        let inflated: Cow<[u8]> = match kind {
            COMPRESSED => inflate::zlib(data).map_err(|_| "a compressed array is damaged or cut off")?.into(),
            MATRIX => data.into(),
            _ => continue,
        };
        // A compressed element contains a complete element with its tag.
        let mut inner = Reader { rest: &inflated, little };
        let body = if kind == COMPRESSED { inner.element()?.1 } else { &inflated };
        match matrix(Reader { rest: body, little })? {
            Ok(array) => arrays.push(array),
            Err(name) => left_out.push(name),
        }
    }
    Ok((arrays, left_out))
}

/// Reads data elements in sequence.
struct Reader<'a> {
    rest: &'a [u8],
    little: bool,
}

const CUT_OFF: Message = "the file is cut off";

impl<'a> Reader<'a> {
    fn number<const N: usize>(&self, bytes: &[u8]) -> [u8; N] {
        std::array::from_fn(|k| bytes[if self.little { k } else { N - 1 - k }])
    }

    fn u32(&self, bytes: &[u8]) -> u32 {
        u32::from_le_bytes(self.number(bytes))
    }

    /// Type and data of the next element; data of up to four bytes are stored within its tag.
    fn element(&mut self) -> Result<(u32, &'a [u8]), Message> {
        let (tag, rest) = self.rest.split_at_checked(8).ok_or(CUT_OFF)?;
        let first = self.u32(&tag[..4]);
        let small = (first >> 16) as usize;
        if small > 0 {
            self.rest = rest;
            return Ok((first & 0xffff, tag.get(4..4 + small).ok_or("an element's tag is damaged")?));
        }
        let size = self.u32(&tag[4..]) as usize;
        let (data, after) = rest.split_at_checked(size).ok_or(CUT_OFF)?;
        let padding = if first == COMPRESSED { 0 } else { size.next_multiple_of(8) - size };
        self.rest = after.get(padding..).unwrap_or_default();
        Ok((first, data))
    }

    /// Numbers of an element of any numeric type.
    fn numbers(&mut self) -> Result<Vec<f64>, Message> {
        let (kind, data) = self.element()?;
        macro_rules! read {
            ($type:ty) => {{
                const SIZE: usize = size_of::<$type>();
                data.chunks_exact(SIZE).map(|b| <$type>::from_le_bytes(self.number(b)) as f64).collect()
            }};
        }
        Ok(match kind {
            1 => read!(i8),
            2 | 16 => read!(u8),
            3 => read!(i16),
            4 | 17 => read!(u16),
            5 => read!(i32),
            6 | 18 => read!(u32),
            7 => read!(f32),
            9 => read!(f64),
            12 => read!(i64),
            13 => read!(u64),
            _ => return Err("an array's data is of an unknown type"),
        })
    }
}

/// Reads one array, or the name of one that is neither numeric nor text.
fn matrix(mut body: Reader) -> Result<Result<Array, String>, Message> {
    let flags = body.element()?.1;
    let flags = body.u32(flags.get(..4).ok_or(CUT_OFF)?);
    let class = (flags & 0xff) as u8;
    let shape: Vec<usize> = body.numbers()?.iter().map(|&n| n as usize).collect();
    let name = String::from_utf8_lossy(body.element()?.1).into_owned();
    let count = shape.iter().try_fold(1_usize, |product, n| product.checked_mul(*n));
    let count = count.ok_or("an array's size is damaged")?;
    if class == CHAR_CLASS {
        let codes = if count == 0 { Vec::new() } else { text_codes(&mut body, count)? };
        let rows = shape.first().copied().filter(|_| count > 0).unwrap_or(0);
        let row = |k: usize| -> String {
            let letters = codes.iter().skip(k).step_by(rows.max(1));
            let text: String = letters.map(|&c| char::from_u32(c).unwrap_or('?')).collect();
            // Rows are padded with blanks or zeros.
            text.trim_matches(|c: char| c == '\0' || c.is_whitespace()).to_owned()
        };
        let texts: Vec<String> = (0..rows).map(row).collect();
        return Ok(Ok(Array { name, shape: vec![rows], data: Data::Text(texts) }));
    }
    if !NUMERIC.contains(&class) {
        return Ok(Err(name));
    }
    let re = body.numbers()?;
    let data = if flags & COMPLEX_FLAG == 0 {
        Data::Real(to_row_major(&re, &shape))
    } else {
        let im = body.numbers()?;
        let values: Vec<_> = re.iter().zip(&im).map(|(&re, &im)| Complex::new(re, im)).collect();
        Data::Complex(to_row_major(&values, &shape))
    };
    if data.len() != count {
        return Err("an array has fewer values than its size states");
    }
    Ok(Ok(Array { name, shape, data }))
}

/// Character codes of a text; UTF-8 has several bytes per character.
fn text_codes(body: &mut Reader, count: usize) -> Result<Vec<u32>, Message> {
    let before = body.rest;
    let (kind, data) = body.element()?;
    if kind == 16 {
        return Ok(String::from_utf8_lossy(data).chars().map(u32::from).collect());
    }
    body.rest = before;
    let codes = body.numbers()?;
    if codes.len() < count {
        return Err("a text has fewer characters than its size states");
    }
    Ok(codes.iter().map(|&c| c as u32).collect())
}

/// Column-major values (first index fastest) reordered to row-major (last index fastest).
pub(super) fn to_row_major<T: Copy>(values: &[T], shape: &[usize]) -> Vec<T> {
    reorder(values, shape, shape.iter().scan(1, |stride, n| Some(std::mem::replace(stride, *stride * n))))
}

/// Row-major values reordered to column-major.
fn to_column_major<T: Copy>(values: &[T], shape: &[usize]) -> Vec<T> {
    let mirrored: Vec<usize> = shape.iter().rev().copied().collect();
    to_row_major(values, &mirrored)
}

fn reorder<T: Copy>(values: &[T], shape: &[usize], strides: impl Iterator<Item = usize>) -> Vec<T> {
    let strides: Vec<usize> = strides.collect();
    let mut index = vec![0; shape.len()];
    let mut out = Vec::with_capacity(values.len());
    while out.len() < values.len() {
        let at: usize = index.iter().zip(&strides).map(|(i, s)| i * s).sum();
        let Some(value) = values.get(at) else { break };
        out.push(*value);
        for axis in (0..shape.len()).rev() {
            index[axis] += 1;
            if index[axis] < shape[axis] {
                break;
            }
            index[axis] = 0;
        }
    }
    out
}

/// Writes arrays as doubles and texts, uncompressed, little endian; one-dimensional ones as column vectors.
///
/// # Errors
/// An array of 4 GB or more, or a file that cannot be written.
pub fn write(path: &Path, arrays: &[Array]) -> Result<(), Error> {
    let bytes = to_bytes(arrays).map_err(|name| Error::Content {
        path: path.into(),
        problem: format!("`{name}` is too large for a v5 .mat file"),
        advice: "write .npz or HDF5 instead".into(),
    })?;
    std::fs::write(path, bytes).map_err(Error::of_file("write", path))
}

/// The bytes of a file; error: the name of an array that is too large.
fn to_bytes(arrays: &[Array]) -> Result<Vec<u8>, String> {
    let mut out = format!("{:<124}", "MATLAB 5.0 MAT-file, Platform: any, written by rotordyn").into_bytes();
    out.extend([0, 1, b'I', b'M']);
    for array in arrays {
        let body = body(array).ok_or_else(|| array.name.clone())?;
        element(&mut out, MATRIX, &body).ok_or_else(|| array.name.clone())?;
    }
    Ok(out)
}

/// Flags, dimensions, name and values; `None` if a size exceeds its 32-bit field.
fn body(array: &Array) -> Option<Vec<u8>> {
    let mut out = Vec::new();
    let (class, flags) = match array.data {
        Data::Text(_) => (CHAR_CLASS, 0),
        Data::Real(_) => (DOUBLE_CLASS, 0),
        Data::Complex(_) => (DOUBLE_CLASS, COMPLEX_FLAG),
    };
    element(&mut out, UINT32, &[(flags | u32::from(class)).to_le_bytes(), [0; 4]].concat())?;
    let letters = |texts: &[String]| texts.iter().map(|t| t.encode_utf16().count()).max().unwrap_or(0);
    let shape = match (&array.data, &array.shape[..]) {
        (Data::Text(texts), _) => vec![texts.len(), letters(texts)],
        (_, []) => vec![1, 1],
        (_, [count]) => vec![*count, 1],
        (_, shape) => shape.to_vec(),
    };
    let sizes: Option<Vec<[u8; 4]>> =
        shape.iter().map(|&n| i32::try_from(n).ok().map(i32::to_le_bytes)).collect();
    element(&mut out, INT32, &sizes?.concat())?;
    let name: String = array.name.chars().take(MAX_NAME_LENGTH).collect();
    element(&mut out, 1, name.as_bytes())?;
    let doubles = |values: Vec<f64>| values.iter().flat_map(|v| v.to_le_bytes()).collect::<Vec<u8>>();
    match &array.data {
        Data::Real(values) => element(&mut out, DOUBLE, &doubles(to_column_major(values, &array.shape)))?,
        Data::Complex(values) => {
            let values = to_column_major(values, &array.shape);
            element(&mut out, DOUBLE, &doubles(values.iter().map(|v| v.re).collect()))?;
            element(&mut out, DOUBLE, &doubles(values.iter().map(|v| v.im).collect()))?;
        }
        Data::Text(texts) => {
            let rows: Vec<Vec<u16>> = texts.iter().map(|t| t.encode_utf16().collect()).collect();
            let letter =
                |k: usize| rows.iter().map(move |row| row.get(k).copied().unwrap_or(u16::from(b' ')));
            let codes: Vec<u8> = (0..shape[1]).flat_map(letter).flat_map(u16::to_le_bytes).collect();
            element(&mut out, 4, &codes)?;
        }
    }
    Some(out)
}

/// Writes a tag and data padded to eight bytes.
fn element(out: &mut Vec<u8>, kind: u32, data: &[u8]) -> Option<()> {
    out.extend(kind.to_le_bytes());
    out.extend(u32::try_from(data.len()).ok()?.to_le_bytes());
    out.extend(data);
    out.resize(out.len().next_multiple_of(8), 0);
    Some(())
}

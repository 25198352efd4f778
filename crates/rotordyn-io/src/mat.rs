//! MATLAB v5 .mat files: numeric and text arrays, compressed or not, either byte order; written uncompressed.
//!
//! The contents of structures and cells are named by their path as in MATLAB, with linear indices: `bearing.gs`,
//! `runs(2).x`, `c{3}`. Sparse matrices, function handles and objects without fields are skipped and their names reported.
//! Version 4 files are read too; version 7.3 files are HDF5.
//! The crate matfile 0.5 reads numbers only, without texts, structures, the names of what it skips, or writing.
//! Format: MATLAB MAT-File Format, The MathWorks, R2019b.

mod elements;
mod version_4;

use std::borrow::Cow;
use std::path::Path;

use super::inflate;
use super::measured::arrays::{Array, Data};
use crate::atomic_file;
use crate::budget::{self, Budget, Limits, MAX_DEPTH, MAX_DIMENSIONS};
use crate::error::Error;
pub(crate) use elements::to_row_major;
use elements::{COMPRESSED, CUT_OFF, Contents, DAMAGED_SIZE, Fault, Reader};
use rotordyn_signal::Complex;

/// Data types of elements.
const INT32: u32 = 5;
const UINT32: u32 = 6;
const DOUBLE: u32 = 9;
const MATRIX: u32 = 14;
/// Array classes.
const CELL_CLASS: u8 = 1;
const STRUCTURE_CLASS: u8 = 2;
const OBJECT_CLASS: u8 = 3;
const OPAQUE_CLASS: u8 = 17;
const CHAR_CLASS: u8 = 4;
const DOUBLE_CLASS: u8 = 6;
/// Classes of numbers: double, single, and integers of either sign up to 64 bits.
const NUMERIC: std::ops::RangeInclusive<u8> = 6..=15;
const COMPLEX_FLAG: u32 = 0x0800;
const HEADER: usize = 128;
/// Longest variable name in MATLAB (`namelengthmax`).
pub const MAX_NAME_LENGTH: usize = 63;

/// Whether a file starts with the header of a .mat file of version 5, or of an array of version 4.
pub fn is_mat(head: &[u8]) -> bool {
    is_version_5(head) || version_4::is_array(head)
}

fn is_version_5(head: &[u8]) -> bool {
    matches!(head.get(124..128), Some([0, 1, b'I', b'M'] | [1, 0, b'M', b'I']))
}

/// Reads every numeric and text array of a file, also within structures and cells; the second list has the names of
/// skipped arrays.
///
/// # Errors
/// The file cannot be read, is cut off, is not a .mat file of version 4 or 5, or exceeds its budget.
pub fn read(path: &Path, limits: &Limits) -> Result<(Vec<Array>, Vec<String>, Budget), Error> {
    let (bytes, budget) = budget::read_file(path, limits)?;
    let found = if is_version_5(&bytes) { parse(&bytes, &budget) } else { version_4::parse(&bytes, &budget) };
    match found {
        Ok((arrays, left_out)) => Ok((arrays, left_out, budget)),
        Err(Fault::Budget(exceeded)) => Err(exceeded.of_file(path)),
        Err(Fault::Damage(problem)) => Err(Error::Content {
            path: path.into(),
            problem: problem.into(),
            advice: "copy the file again, or save it with `save -v7`".into(),
        }),
    }
}

const DAMAGED_ARRAY: &str = "a compressed array is damaged or cut off";
fn parse(bytes: &[u8], budget: &Budget) -> Result<Contents, Fault> {
    let little = bytes[126] == b'I';
    let mut found = Contents::default();
    let mut file = Reader { rest: &bytes[HEADER..], little };
    while !file.rest.is_empty() {
        let (kind, data) = file.element()?;
        let element: Cow<[u8]> = match kind {
            COMPRESSED => inflated(data, little, budget)?.into(),
            MATRIX => data.into(),
            _ => continue,
        };
        collect(Reader { rest: &element, little }, None, 0, budget, &mut found)?;
        if let Cow::Owned(inflated) = element {
            budget.give_back(inflated.len());
        }
    }
    Ok(found)
}

/// The data of the one element within a compressed one. Its own tag states its size, which is held against the budget
/// before anything is inflated.
fn inflated(data: &[u8], little: bool, budget: &Budget) -> Result<Vec<u8>, Fault> {
    let tag = inflate::zlib_start(data, 8).map_err(|_| DAMAGED_ARRAY)?;
    let reader = Reader { rest: &[], little };
    if reader.u32(&tag[..4]) != MATRIX {
        return Err("a compressed element contains no array".into());
    }
    let size = reader.u32(&tag[4..]) as usize;
    let mut out = budget.list(|| "a compressed array".into(), size + 8)?;
    inflate::zlib(data, size + 8, &mut out).map_err(|_| DAMAGED_ARRAY)?;
    out.drain(..8);
    Ok(out)
}

/// Sizes of an array's dimensions.
fn dimensions(body: &mut Reader, budget: &Budget) -> Result<Vec<usize>, Fault> {
    let sizes = body.numbers(budget)?;
    if sizes.len() > MAX_DIMENSIONS || sizes.iter().any(|n| *n < 0.0) {
        return Err(DAMAGED_SIZE.into());
    }
    Ok(sizes.iter().map(|&n| n as usize).collect())
}

/// Reads one array, with what it contains if it is a structure or a cell. `path`: its name, if it is within another.
fn collect(
    mut body: Reader,
    path: Option<String>,
    depth: usize,
    budget: &Budget,
    found: &mut Contents,
) -> Result<(), Fault> {
    budget.objects("arrays", 1)?;
    let flags = body.element()?.1;
    let flags = body.u32(flags.get(..4).ok_or(CUT_OFF)?);
    let class = (flags & 0xff) as u8;
    // Objects of classes such as table and string state no size.
    let shape = if class == OPAQUE_CLASS { Vec::new() } else { dimensions(&mut body, budget)? };
    let own_name = String::from_utf8_lossy(body.element()?.1).into_owned();
    let name = path.unwrap_or(own_name);
    // The data of such objects follow in an array without a name.
    if name.is_empty() {
        return Ok(());
    }
    let count = shape.iter().try_fold(1_usize, |product, n| product.checked_mul(*n)).ok_or(DAMAGED_SIZE)?;
    let nested = matches!(class, CELL_CLASS | STRUCTURE_CLASS | OBJECT_CLASS);
    if nested && depth == MAX_DEPTH {
        found.1.push(format!("{name} (more than {MAX_DEPTH} structures or cells deep)"));
        return Ok(());
    }
    match class {
        CELL_CLASS => {
            for k in 1..=count {
                member(&mut body, format!("{name}{{{k}}}"), depth, budget, found)?;
            }
        }
        STRUCTURE_CLASS | OBJECT_CLASS => {
            if class == OBJECT_CLASS {
                // The name of its class.
                body.element()?;
            }
            let fields = field_names(&mut body, budget)?;
            if fields.is_empty() {
                found.1.push(format!("{name} (a structure without fields)"));
            }
            for k in 1..=if fields.is_empty() { 0 } else { count } {
                let element = if count == 1 { name.clone() } else { format!("{name}({k})") };
                for field in &fields {
                    member(&mut body, format!("{element}.{field}"), depth, budget, found)?;
                }
            }
        }
        CHAR_CLASS => {
            let texts = if count == 0 { Vec::new() } else { texts(&mut body, &shape, count, budget)? };
            found.0.push(Array { name, shape: vec![texts.len()], data: Data::Text(texts) });
        }
        _ if NUMERIC.contains(&class) => {
            let data = numbers(&mut body, &shape, count, flags & COMPLEX_FLAG != 0, budget)?;
            found.0.push(Array { name, shape, data });
        }
        5 => found.1.push(format!("{name} (a sparse matrix)")),
        16 => found.1.push(format!("{name} (a function handle)")),
        _ => found.1.push(format!("{name} (a MATLAB object)")),
    }
    Ok(())
}

/// One array within a structure or a cell; an element without data is an empty array.
fn member(
    body: &mut Reader,
    path: String,
    depth: usize,
    budget: &Budget,
    found: &mut Contents,
) -> Result<(), Fault> {
    // The names of elements may be longer than what they name.
    budget.take(|| "the names of structures and cells".into(), 2 * path.len() as u64)?;
    let (kind, data) = body.element()?;
    if kind != MATRIX {
        return Err("a structure or cell contains something that is no array".into());
    }
    if data.is_empty() {
        budget.objects("arrays", 1)?;
        found.1.push(format!("{path} (empty)"));
        return Ok(());
    }
    collect(Reader { rest: data, little: body.little }, Some(path), depth + 1, budget, found)
}

/// Names of a structure's fields: texts of one length, ended by zeros.
fn field_names(body: &mut Reader, budget: &Budget) -> Result<Vec<String>, Fault> {
    let length = body.element()?.1;
    let length = body.u32(length.get(..4).ok_or(CUT_OFF)?) as usize;
    let letters = body.element()?.1;
    if letters.is_empty() {
        return Ok(Vec::new());
    }
    if length == 0 || letters.len() % length != 0 {
        return Err("the names of a structure's fields are damaged".into());
    }
    budget.objects("fields", letters.len() / length)?;
    let name = |letters: &[u8]| {
        let end = letters.iter().position(|&c| c == 0).unwrap_or(letters.len());
        String::from_utf8_lossy(&letters[..end]).into_owned()
    };
    Ok(letters.chunks_exact(length).map(name).collect())
}

/// The values of a numeric array.
fn numbers(
    body: &mut Reader,
    shape: &[usize],
    count: usize,
    complex: bool,
    budget: &Budget,
) -> Result<Data, Fault> {
    let fewer = "an array has fewer values than its size states";
    let re = body.numbers(budget)?;
    if re.len() != count {
        return Err(fewer.into());
    }
    if !complex {
        return Ok(Data::Real(to_row_major(&re, shape)));
    }
    let im = body.numbers(budget)?;
    if im.len() != count {
        return Err(fewer.into());
    }
    let values: Vec<_> = re.iter().zip(&im).map(|(&re, &im)| Complex::new(re, im)).collect();
    Ok(Data::Complex(to_row_major(&values, shape)))
}

/// The rows of a text, of which at least one letter is there.
fn texts(body: &mut Reader, shape: &[usize], count: usize, budget: &Budget) -> Result<Vec<String>, Fault> {
    let codes = text_codes(body, budget)?;
    let rows = shape.first().copied().unwrap_or(0);
    // In UTF-8 a letter beyond 16 bits is one code for two letters.
    if codes.len() < rows || codes.len() < count / 2 {
        return Err("a text has fewer characters than its size states".into());
    }
    budget.objects("rows of a text", rows)?;
    let row = |k: usize| -> String {
        let letters = codes.iter().skip(k).step_by(rows);
        let text: String = letters.map(|&c| char::from_u32(c).unwrap_or('?')).collect();
        // Rows are padded with blanks or zeros.
        text.trim_matches(|c: char| c == '\0' || c.is_whitespace()).to_owned()
    };
    Ok((0..rows).map(row).collect())
}

/// Character codes of a text; UTF-8 has several bytes per character.
fn text_codes(body: &mut Reader, budget: &Budget) -> Result<Vec<u32>, Fault> {
    let before = body.rest;
    let (kind, data) = body.element()?;
    if kind == 16 {
        budget.take_values::<[u32; 2]>(|| "a text".into(), data.len())?;
        return Ok(String::from_utf8_lossy(data).chars().map(u32::from).collect());
    }
    body.rest = before;
    Ok(body.numbers(budget)?.iter().map(|&c| c as u32).collect())
}

/// Row-major values reordered to column-major.
fn to_column_major<T: Copy>(values: &[T], shape: &[usize]) -> Vec<T> {
    let mirrored: Vec<usize> = shape.iter().rev().copied().collect();
    to_row_major(values, &mirrored)
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
    atomic_file::write(path, &bytes).map_err(Error::of_file("write", path))
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

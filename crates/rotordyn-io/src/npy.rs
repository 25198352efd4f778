//! NumPy files: .npy arrays and .npz archives of them, compressed or not; written uncompressed.
//!
//! Booleans, integers, floats and complex numbers of any width and byte order, and texts. Format:
//! numpy.lib.format, versions 1.0 to 3.0. The crate npyz would do, but for its parser of headers (pest) and its zip 0.6,
//! which need a C compiler.

use std::io::{BufWriter, Cursor, Read, Seek, Write};
use std::path::Path;

use zip::result::{ZipError, ZipResult};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipArchive, ZipWriter};

use super::measured::arrays::{Array, Data};
use crate::error::Error;
use rotordyn_signal::Complex;

const MAGIC: &[u8] = b"\x93NUMPY";

/// Whether a file starts with the .npy magic bytes.
pub fn is_npy(head: &[u8]) -> bool {
    head.starts_with(MAGIC)
}

/// Whether a file starts with the signature of a .npz (ZIP) archive.
pub fn is_npz(head: &[u8]) -> bool {
    head.starts_with(b"PK\x03\x04") || head.starts_with(b"PK\x05\x06")
}

/// Reads the array of a .npy file, named after the file, or those of a .npz archive; the second list has the
/// names of skipped members.
///
/// # Errors
/// The file cannot be read, is damaged or cut off.
pub fn read(path: &Path) -> Result<(Vec<Array>, Vec<String>), Error> {
    let bytes = std::fs::read(path).map_err(Error::of_file("read", path))?;
    let content = |problem: String| Error::Content {
        path: path.into(),
        problem,
        advice: "copy the file again, or save plain arrays with numpy.savez".into(),
    };
    if is_npy(&bytes) {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let array = array(&name, &bytes).map_err(|p| content(p.into()))?;
        return Ok(array.map_or_else(|| (Vec::new(), vec![name]), |array| (vec![array], Vec::new())));
    }
    let (mut arrays, mut left_out) = (Vec::new(), Vec::new());
    for (name, data) in members(&bytes).map_err(|p| content(p.into()))? {
        let Some(name) = name.strip_suffix(".npy") else {
            left_out.push(name);
            continue;
        };
        match array(name, &data).map_err(|p| content(format!("`{name}`: {p}")))? {
            Some(array) => arrays.push(array),
            None => left_out.push(name.to_owned()),
        }
    }
    Ok((arrays, left_out))
}

/// Message on an error in a file.
type Message = &'static str;

const CUT_OFF: Message = "the file is cut off";
const DAMAGED: Message = "the archive is damaged";

fn u16_at(bytes: &[u8], at: usize) -> Result<usize, Message> {
    let b = bytes.get(at..at + 2).ok_or(CUT_OFF)?;
    Ok(usize::from(b[0]) | usize::from(b[1]) << 8)
}

fn u32_at(bytes: &[u8], at: usize) -> Result<usize, Message> {
    Ok(u16_at(bytes, at)? | u16_at(bytes, at + 2)? << 16)
}

/// Files of a ZIP archive.
fn members(bytes: &[u8]) -> Result<Vec<(String, Vec<u8>)>, Message> {
    // The directory of an archive is at its end.
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(|_| CUT_OFF)?;
    let mut out = Vec::with_capacity(archive.len());
    for k in 0..archive.len() {
        let mut file = archive.by_index(k).map_err(|error| match error {
            ZipError::CompressionMethodNotSupported(_) => {
                "an array has a compression method other than deflate"
            }
            ZipError::UnsupportedArchive(_) => "the archive is encrypted or of an unsupported kind",
            _ => DAMAGED,
        })?;
        let mut data = Vec::new();
        file.read_to_end(&mut data).map_err(|_| DAMAGED)?;
        let name = file.name().map_err(|_| DAMAGED)?.into_owned();
        out.push((name, data));
    }
    Ok(out)
}

/// Reads one .npy; `None` for object and structured arrays, which are not supported.
fn array(name: &str, bytes: &[u8]) -> Result<Option<Array>, Message> {
    if !is_npy(bytes) {
        return Err("it is not a NumPy array");
    }
    let version = *bytes.get(6).ok_or(CUT_OFF)?;
    let (length, start) = if version == 1 { (u16_at(bytes, 8)?, 10) } else { (u32_at(bytes, 8)?, 12) };
    let header = bytes.get(start..start + length).ok_or(CUT_OFF)?;
    let header = std::str::from_utf8(header).map_err(|_| "its header is damaged")?;
    let entry = |key: &str| {
        let after = &header[header.find(&format!("'{key}':"))? + key.len() + 3..];
        Some(after.trim_start())
    };
    let damaged = "its header is damaged";
    let descr = entry("descr").ok_or(damaged)?;
    let Some(descr) = descr.strip_prefix('\'').and_then(|d| d.split('\'').next()) else { return Ok(None) };
    let fortran = entry("fortran_order").ok_or(damaged)?.starts_with("True");
    let shape = entry("shape").and_then(|s| s.strip_prefix('(')?.split(')').next()).ok_or(damaged)?;
    let shape: Option<Vec<usize>> =
        shape.split(',').map(str::trim).filter(|n| !n.is_empty()).map(|n| n.parse().ok()).collect();
    let shape = shape.ok_or(damaged)?;
    let count = shape.iter().try_fold(1_usize, |product, n| product.checked_mul(*n)).ok_or(damaged)?;
    let (order, kind) = descr.split_at(usize::from(descr.starts_with(['<', '>', '|', '='])));
    let big = order == ">";
    if !kind.is_ascii() {
        return Err(damaged);
    }
    let (kind, width) = kind.split_at(kind.len().min(1));
    let width: usize = width.parse().unwrap_or(1);
    let element = if kind == "U" { width.checked_mul(4).ok_or(damaged)? } else { width };
    let size = count.checked_mul(element).ok_or(damaged)?;
    let data = bytes[start + length..].get(..size).ok_or(CUT_OFF)?;
    let values = |width: usize, read: fn([u8; 8]) -> f64| -> Vec<f64> {
        let ordered = |b: &[u8]| {
            std::array::from_fn(|k| match (k < width, big) {
                (false, _) => 0,
                (true, false) => b[k],
                (true, true) => b[width - 1 - k],
            })
        };
        data.chunks_exact(width).map(|b| read(ordered(b))).collect()
    };
    let single = |b: [u8; 8]| f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]]));
    let data = match (kind, width) {
        ("f", 8) => Data::Real(values(8, f64::from_le_bytes)),
        ("f", 4) => Data::Real(values(4, single)),
        ("b" | "u", 1 | 2 | 4 | 8) => Data::Real(values(width, |b| u64::from_le_bytes(b) as f64)),
        ("i", 1) => Data::Real(values(1, |b| f64::from(b[0] as i8))),
        ("i", 2) => Data::Real(values(2, |b| f64::from(i16::from_le_bytes([b[0], b[1]])))),
        ("i", 4) => Data::Real(values(4, |b| f64::from(i32::from_le_bytes([b[0], b[1], b[2], b[3]])))),
        ("i", 8) => Data::Real(values(8, |b| i64::from_le_bytes(b) as f64)),
        ("c", 16) => Data::Complex(paired(&values(8, f64::from_le_bytes))),
        ("c", 8) => Data::Complex(paired(&values(4, single))),
        ("U", _) => {
            let letter =
                |b: &[u8]| u32::from_le_bytes(std::array::from_fn(|k| b[if big { 3 - k } else { k }]));
            let text = |b: &[u8]| -> String {
                b.chunks_exact(4).filter_map(|b| char::from_u32(letter(b))).filter(|&c| c != '\0').collect()
            };
            let texts = if element == 0 {
                vec![String::new(); count]
            } else {
                data.chunks_exact(element).map(text).collect()
            };
            Data::Text(texts)
        }
        _ => return Ok(None),
    };
    let data = match data {
        Data::Real(v) if fortran => Data::Real(super::mat::to_row_major(&v, &shape)),
        Data::Complex(v) if fortran => Data::Complex(super::mat::to_row_major(&v, &shape)),
        data => data,
    };
    Ok(Some(Array { name: name.to_owned(), shape, data }))
}

fn paired(values: &[f64]) -> Vec<Complex<f64>> {
    values.chunks_exact(2).map(|v| Complex::new(v[0], v[1])).collect()
}

/// Writes a .npz archive that `numpy.load` opens.
///
/// # Errors
/// A file that cannot be written.
pub fn write(path: &Path, arrays: &[Array]) -> Result<(), Error> {
    let file = std::fs::File::create(path).map_err(Error::of_file("write", path))?;
    write_archive(BufWriter::new(file), arrays).map_err(Error::of_file("write", path))
}

/// A ZIP archive of stored files, without the time of writing: the same arrays give the same bytes.
fn write_archive(file: impl Write + Seek, arrays: &[Array]) -> ZipResult<()> {
    let stored = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Stored)
        .last_modified_time(DateTime::default());
    let mut archive = ZipWriter::new(file);
    for array in arrays {
        let bytes = npy(array);
        let large = bytes.len() >= u32::MAX as usize;
        archive.start_file(format!("{}.npy", array.name), stored.large_file(large))?;
        archive.write_all(&bytes)?;
    }
    archive.finish()?.flush()?;
    Ok(())
}

fn npy(array: &Array) -> Vec<u8> {
    let longest = |texts: &[String]| texts.iter().map(|t| t.chars().count()).max().unwrap_or(0).max(1);
    let (descr, data): (String, Vec<u8>) = match &array.data {
        Data::Real(v) => ("<f8".into(), v.iter().flat_map(|v| v.to_le_bytes()).collect()),
        Data::Complex(v) => {
            ("<c16".into(), v.iter().flat_map(|v| [v.re, v.im]).flat_map(f64::to_le_bytes).collect())
        }
        Data::Text(texts) => {
            let width = longest(texts);
            let padded = |t: &String| {
                t.chars().map(u32::from).chain(std::iter::repeat(0)).take(width).collect::<Vec<u32>>()
            };
            (format!("<U{width}"), texts.iter().flat_map(padded).flat_map(u32::to_le_bytes).collect())
        }
    };
    let shape: String = array.shape.iter().map(|n| format!("{n}, ")).collect();
    let shape = if array.shape.len() == 1 { shape.trim_end() } else { shape.trim_end_matches(", ") };
    let mut header = format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': ({shape}), }}");
    // Magic, version, length and header are padded to a multiple of 64 bytes.
    let padded = (10 + header.len() + 1).next_multiple_of(64) - 10;
    header = format!("{header:<width$}\n", width = padded - 1);
    let mut out = MAGIC.to_vec();
    out.extend([1, 0]);
    out.extend((header.len() as u16).to_le_bytes());
    out.extend(header.as_bytes());
    out.extend(data);
    out
}

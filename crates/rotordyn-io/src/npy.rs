//! NumPy files: .npy arrays and .npz archives of them, compressed or not; written uncompressed.
//!
//! Booleans, integers, floats and complex numbers of any width and byte order, and texts. Format:
//! numpy.lib.format, versions 1.0 to 3.0; ZIP: PKWARE APPNOTE 6.3.

use std::path::Path;

use super::inflate;
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

/// Files of a ZIP archive by its central directory.
fn members(bytes: &[u8]) -> Result<Vec<(String, Vec<u8>)>, Message> {
    // The end record of the directory is followed by a comment of at most 65535 bytes.
    let from = bytes.len().saturating_sub(22 + 65_535);
    let end = bytes[from..].windows(4).rposition(|w| w == b"PK\x05\x06").ok_or(CUT_OFF)? + from;
    let count = u16_at(bytes, end + 10)?;
    let mut at = u32_at(bytes, end + 16)?;
    let mut out = Vec::with_capacity(count);
    for _ in 0..count {
        if bytes.get(at..at + 4) != Some(b"PK\x01\x02") {
            return Err(DAMAGED);
        }
        let (method, size) = (u16_at(bytes, at + 10)?, u32_at(bytes, at + 20)?);
        let lengths = [u16_at(bytes, at + 28)?, u16_at(bytes, at + 30)?, u16_at(bytes, at + 32)?];
        let local = u32_at(bytes, at + 42)?;
        let name = bytes.get(at + 46..at + 46 + lengths[0]).ok_or(CUT_OFF)?;
        at += 46 + lengths.iter().sum::<usize>();
        let data_at = local + 30 + u16_at(bytes, local + 26)? + u16_at(bytes, local + 28)?;
        let data = bytes.get(data_at..data_at + size).ok_or(CUT_OFF)?;
        let data = match method {
            0 => data.to_vec(),
            8 => inflate::raw(data).map_err(|_| DAMAGED)?,
            _ => return Err("an array has a compression method other than deflate"),
        };
        out.push((String::from_utf8_lossy(name).into_owned(), data));
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
    let (kind, width) = kind.split_at(kind.len().min(1));
    let width: usize = width.parse().unwrap_or(1);
    let element = if kind == "U" { 4 * width } else { width };
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
/// Arrays of 4 GB or more together, or a file that cannot be written.
pub fn write(path: &Path, arrays: &[Array]) -> Result<(), Error> {
    let files: Vec<(String, Vec<u8>)> = arrays.iter().map(|a| (format!("{}.npy", a.name), npy(a))).collect();
    let bytes = archive(&files).ok_or_else(|| Error::Content {
        path: path.into(),
        problem: "the records are too large for a .npz archive".into(),
        advice: "write HDF5 instead".into(),
    })?;
    std::fs::write(path, bytes).map_err(Error::of_file("write", path))
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

/// A ZIP archive of stored files, without dates; `None` if its sizes do not fit 32 bits.
fn archive(files: &[(String, Vec<u8>)]) -> Option<Vec<u8>> {
    let (mut out, mut directory) = (Vec::new(), Vec::new());
    for (name, data) in files {
        let size = u32::try_from(data.len()).ok()?;
        let offset = u32::try_from(out.len()).ok()?;
        // Version 2.0, no flags, stored, 1980-01-01.
        let mut common = Vec::new();
        for field in [20_u16, 0, 0, 0, 0x21] {
            common.extend(field.to_le_bytes());
        }
        for field in [crc32(data), size, size] {
            common.extend(field.to_le_bytes());
        }
        common.extend(u16::try_from(name.len()).ok()?.to_le_bytes());
        common.extend([0, 0]);
        out.extend(b"PK\x03\x04");
        out.extend(&common);
        out.extend(name.as_bytes());
        out.extend(data);
        directory.extend(b"PK\x01\x02\x14\x00");
        directory.extend(&common);
        directory.extend([0; 10]);
        directory.extend(offset.to_le_bytes());
        directory.extend(name.as_bytes());
    }
    let (start, length) = (u32::try_from(out.len()).ok()?, u32::try_from(directory.len()).ok()?);
    let count = u16::try_from(files.len()).ok()?;
    out.extend(directory);
    out.extend(b"PK\x05\x06\0\0\0\0");
    out.extend([count, count].iter().flat_map(|n| n.to_le_bytes()));
    out.extend([length, start].iter().flat_map(|n| n.to_le_bytes()));
    out.extend([0, 0]);
    Some(out)
}

/// CRC-32 of ZIP, polynomial 0xEDB88320.
fn crc32(data: &[u8]) -> u32 {
    let table: [u32; 256] = std::array::from_fn(|byte| {
        (0..8).fold(byte as u32, |c, _| if c & 1 == 1 { c >> 1 ^ 0xEDB8_8320 } else { c >> 1 })
    });
    !data.iter().fold(!0, |crc, byte| table[((crc ^ u32::from(*byte)) & 0xff) as usize] ^ crc >> 8)
}

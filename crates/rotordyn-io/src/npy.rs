//! NumPy files: .npy arrays and .npz archives of them, compressed or not; written uncompressed.
//!
//! Booleans, integers, floats and complex numbers of any width and byte order, and texts. Format:
//! numpy.lib.format, versions 1.0 to 3.0. The crate npyz would do, but for its parser of headers (pest) and its zip 0.6,
//! which need a C compiler.

use std::io::{Cursor, ErrorKind, Read, Seek, Write};
use std::path::Path;

use zip::result::{ZipError, ZipResult};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipArchive, ZipWriter};

use super::measured::arrays::{Array, Data};
use super::measured::axis_names::{Role, meaning};
use crate::atomic_file;
use crate::budget::{self, Budget, Exceeded, Limits, MAX_DIMENSIONS};
use crate::error::Error;
use crate::inflate::crc32;
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
/// The file cannot be read, is damaged or cut off, fails a checksum, or exceeds its budget.
pub fn read(path: &Path, limits: &Limits) -> Result<(Vec<Array>, Vec<String>, Budget), Error> {
    let (bytes, budget) = budget::read_file(path, limits)?;
    let content = |fault: Fault| match fault {
        Fault::Budget(exceeded) => exceeded.of_file(path),
        Fault::Damage(problem) => Error::Content {
            path: path.into(),
            problem,
            advice: "copy the file again, or save plain arrays with numpy.savez".into(),
        },
    };
    if is_npy(&bytes) {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let found = array(&name, &bytes, &budget).map_err(content)?;
        return Ok(match found {
            Member::Numbers(array) => (vec![array], Vec::new(), budget),
            Member::Other(reason) => (Vec::new(), vec![format!("{name} ({reason})")], budget),
        });
    }
    let (arrays, left_out) = archive(&bytes, &budget).map_err(content)?;
    Ok((arrays, left_out, budget))
}

/// Why a file cannot be used.
enum Fault {
    Damage(String),
    Budget(Exceeded),
}

impl From<&str> for Fault {
    fn from(problem: &str) -> Self {
        Self::Damage(problem.into())
    }
}

impl From<Exceeded> for Fault {
    fn from(exceeded: Exceeded) -> Self {
        Self::Budget(exceeded)
    }
}

const CUT_OFF: &str = "the file is cut off";
const DAMAGED: &str = "the archive is damaged";
const DAMAGED_HEADER: &str = "its header is damaged";

fn u16_at(bytes: &[u8], at: usize) -> Result<usize, Fault> {
    let b = bytes.get(at..at + 2).ok_or(CUT_OFF)?;
    Ok(usize::from(b[0]) | usize::from(b[1]) << 8)
}

fn u32_at(bytes: &[u8], at: usize) -> Result<usize, Fault> {
    Ok(u16_at(bytes, at)? | u16_at(bytes, at + 2)? << 16)
}

/// Arrays of a ZIP archive, and the names of its other files.
fn archive(bytes: &[u8], budget: &Budget) -> Result<(Vec<Array>, Vec<String>), Fault> {
    // The directory of an archive is at its end.
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(|_| CUT_OFF)?;
    budget.objects("files in the archive", archive.len())?;
    // Files that share their bytes would be inflated again and again.
    if archive.has_overlapping_files().map_err(|_| DAMAGED)? {
        return Err("files of the archive overlap".into());
    }
    let (mut arrays, mut left_out) = (Vec::new(), Vec::new());
    for k in 0..archive.len() {
        let mut file = archive.by_index(k).map_err(|error| match error {
            ZipError::CompressionMethodNotSupported(_) => {
                "an array has a compression method other than deflate"
            }
            ZipError::UnsupportedArchive(_) => "the archive is encrypted or of an unsupported kind",
            _ => DAMAGED,
        })?;
        let name = file.name().map_err(|_| DAMAGED)?.into_owned();
        let Some(plain) = name.strip_suffix(".npy").map(str::to_owned) else {
            left_out.push(format!("{name} (no NumPy array)"));
            continue;
        };
        let damaged = |problem: &str| Fault::Damage(format!("`{plain}`: {problem}"));
        let size = usize::try_from(file.size()).map_err(|_| damaged(DAMAGED))?;
        let mut data = budget.list(|| format!("`{plain}`"), size)?;
        let (stated, start) = (file.crc32(), file.header_start());
        Read::by_ref(&mut file).take(size as u64 + 1).read_to_end(&mut data).map_err(|error| {
            damaged(match error.kind() {
                ErrorKind::InvalidData => "its checksum (CRC) does not fit: the archive is damaged",
                _ => "it is cut off or damaged",
            })
        })?;
        if data.len() != size {
            return Err(damaged("its size is not the stated one"));
        }
        if crc32(&data) != stated || local_crc(bytes, start).is_some_and(|local| local != stated) {
            return Err(damaged("its checksum (CRC) does not fit: the archive is damaged"));
        }
        match array(&plain, &data, budget) {
            Ok(Member::Numbers(array)) => arrays.push(array),
            Ok(Member::Other(reason)) => left_out.push(format!("{plain} ({reason})")),
            Err(Fault::Damage(problem)) => return Err(damaged(&problem)),
            Err(fault) => return Err(fault),
        }
        budget.give_back(size);
    }
    Ok((arrays, left_out))
}

/// Checksum in the header before a file's data; `None` if it stands after the data (bit 3 of the flags).
fn local_crc(bytes: &[u8], start: u64) -> Option<u32> {
    let header = bytes.get(usize::try_from(start).ok()?..)?.first_chunk::<18>()?;
    let after = header[6] & 8 != 0;
    (!after).then(|| u32::from_le_bytes([header[14], header[15], header[16], header[17]]))
}

/// Header of a .npy.
struct Header<'a> {
    /// Type as "<f8"; `None` for structured types.
    descr: Option<&'a str>,
    fortran: bool,
    shape: Vec<usize>,
    /// Where the data starts.
    end: usize,
}

impl<'a> Header<'a> {
    fn read(bytes: &'a [u8]) -> Result<Self, Fault> {
        if !is_npy(bytes) {
            return Err("it is not a NumPy array".into());
        }
        let version = *bytes.get(6).ok_or(CUT_OFF)?;
        let (length, start) = if version == 1 { (u16_at(bytes, 8)?, 10) } else { (u32_at(bytes, 8)?, 12) };
        let end = start + length;
        let header = bytes.get(start..end).ok_or(CUT_OFF)?;
        let header = std::str::from_utf8(header).map_err(|_| DAMAGED_HEADER)?;
        let entry = |key: &str| {
            let after = &header[header.find(&format!("'{key}':"))? + key.len() + 3..];
            Some(after.trim_start())
        };
        let descr = entry("descr").ok_or(DAMAGED_HEADER)?;
        let descr = descr.strip_prefix('\'').and_then(|d| d.split('\'').next());
        let fortran = entry("fortran_order").ok_or(DAMAGED_HEADER)?.starts_with("True");
        let shape = entry("shape").and_then(|s| s.strip_prefix('(')?.split(')').next());
        let sizes = shape.ok_or(DAMAGED_HEADER)?.split(',').map(str::trim).filter(|n| !n.is_empty());
        // Python 2 wrote long integers with an L.
        let shape: Option<Vec<usize>> =
            sizes.take(MAX_DIMENSIONS + 1).map(|n| n.strip_suffix('L').unwrap_or(n).parse().ok()).collect();
        let shape = shape.filter(|shape| shape.len() <= MAX_DIMENSIONS).ok_or(DAMAGED_HEADER)?;
        Ok(Header { descr, fortran, shape, end })
    }
}

/// What a .npy contains.
enum Member {
    Numbers(Array),
    /// Not read, with the reason.
    Other(&'static str),
}

const NO_NUMBERS: &str = "Python objects or a structured type";

/// Reads one .npy.
fn array(name: &str, bytes: &[u8], budget: &Budget) -> Result<Member, Fault> {
    let Header { descr, fortran, shape, end } = Header::read(bytes)?;
    let Some(descr) = descr else { return Ok(Member::Other(NO_NUMBERS)) };
    let count = shape.iter().try_fold(1_usize, |product, n| product.checked_mul(*n)).ok_or(DAMAGED_HEADER)?;
    let (order, kind) = descr.split_at(usize::from(descr.starts_with(['<', '>', '|', '='])));
    let big = order == ">";
    if !kind.is_ascii() {
        return Err(DAMAGED_HEADER.into());
    }
    let (kind, width) = kind.split_at(kind.len().min(1));
    // "M8[us]" has a unit behind its width.
    let dates = match kind {
        "M" => Some("dates, datetime64: store seconds from the start"),
        "m" => Some("durations, timedelta64: store seconds"),
        _ => None,
    };
    if let Some(reason) = dates {
        let times = times_of(&bytes[end..], width, big, &shape, budget, name)?;
        let found = |values| Array { name: name.to_owned(), shape, data: Data::Real(values) };
        return Ok(times.map_or(Member::Other(reason), |values| Member::Numbers(found(values))));
    }
    let width: usize = if width.is_empty() { 1 } else { width.parse().map_err(|_| DAMAGED_HEADER)? };
    let element = if kind == "U" { width.checked_mul(4).ok_or(DAMAGED_HEADER)? } else { width };
    let size = count.checked_mul(element).ok_or(DAMAGED_HEADER)?;
    let data = bytes[end..].get(..size).ok_or(CUT_OFF)?;
    let memory = match kind {
        "c" => size_of::<Complex<f64>>(),
        "U" | "S" => size_of::<String>() + element,
        _ => size_of::<f64>(),
    };
    budget.take(|| format!("`{name}`"), (count as u64).saturating_mul(memory as u64))?;
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
            Data::Text(texts(data, element, count, |b| {
                b.chunks_exact(4).filter_map(|b| char::from_u32(letter(b))).filter(|&c| c != '\0').collect()
            }))
        }
        ("S", _) => Data::Text(texts(data, element, count, |b| {
            String::from_utf8_lossy(b).trim_end_matches('\0').to_owned()
        })),
        _ => {
            budget.give_back(count.saturating_mul(memory));
            return Ok(Member::Other(NO_NUMBERS));
        }
    };
    let data = match data {
        Data::Real(v) if fortran => Data::Real(super::mat::to_row_major(&v, &shape)),
        Data::Complex(v) if fortran => Data::Complex(super::mat::to_row_major(&v, &shape)),
        data => data,
    };
    Ok(Member::Numbers(Array { name: name.to_owned(), shape, data }))
}

/// Seconds from the first of a list of dates or durations that is named as times are, such as `t`; `None` for others.
///
/// `width`: "8\[us\]", the bytes of each and their unit.
fn times_of(
    data: &[u8],
    width: &str,
    big: bool,
    shape: &[usize],
    budget: &Budget,
    name: &str,
) -> Result<Option<Vec<f64>>, Fault> {
    const UNITS: [(&str, f64); 8] = [
        ("ns", 1e9),
        ("us", 1e6),
        ("ms", 1e3),
        ("s", 1.0),
        ("m", 1.0 / 60.0),
        ("h", 1.0 / 3600.0),
        ("ps", 1e12),
        ("fs", 1e15),
    ];
    let [count] = *shape else { return Ok(None) };
    let Some(unit) = width.strip_prefix("8[").and_then(|unit| unit.strip_suffix(']')) else {
        return Ok(None);
    };
    let Some((_, per_second)) = UNITS.iter().find(|(known, _)| *known == unit) else { return Ok(None) };
    if meaning(name, &[Role::Times]).is_none() {
        return Ok(None);
    }
    let data = data.get(..count.checked_mul(8).ok_or(DAMAGED_HEADER)?).ok_or(CUT_OFF)?;
    budget.take(|| format!("`{name}`"), data.len() as u64)?;
    let integer = |b: &[u8]| {
        let bytes = std::array::from_fn(|k| b[if big { 7 - k } else { k }]);
        i64::from_le_bytes(bytes)
    };
    let first = data.chunks_exact(8).next().map_or(0, integer);
    // NaT is the smallest integer.
    let seconds = |time: i64| match (time, time.checked_sub(first)) {
        (i64::MIN, _) | (_, None) => f64::NAN,
        (_, Some(since)) => since as f64 / per_second,
    };
    Ok(Some(data.chunks_exact(8).map(|b| seconds(integer(b))).collect()))
}

/// Texts of `element` bytes each, which may be none.
fn texts(data: &[u8], element: usize, count: usize, read: impl Fn(&[u8]) -> String) -> Vec<String> {
    match element {
        0 => vec![String::new(); count],
        _ => data.chunks_exact(element).map(read).collect(),
    }
}

fn paired(values: &[f64]) -> Vec<Complex<f64>> {
    values.chunks_exact(2).map(|v| Complex::new(v[0], v[1])).collect()
}

/// Writes a .npz archive that `numpy.load` opens.
///
/// # Errors
/// A file that cannot be written.
pub fn write(path: &Path, arrays: &[Array]) -> Result<(), Error> {
    atomic_file::write_with(path, |out| write_archive(out, arrays).map_err(std::io::Error::other))
        .map_err(Error::of_file("write", path))
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

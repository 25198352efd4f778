//! Measured files: format detected by content when reading, chosen by the extension when writing.
//!
//! | format | read | written | contents |
//! |---|---|---|---|
//! | universal file | .uff .unv .uf | .uff (ASCII), .unv | all |
//! | MATLAB v5 | .mat | .mat | records |
//! | NumPy | .npz .npy | .npz | records |
//! | WAV | .wav | .wav | time records of one rate, without units |
//! | table | .csv .txt .tsv .dat | .csv | records over one axis |
//! | HDF5 | .h5 .hdf5, .mat v7.3, results.h5 | .h5 | records |

mod array;
pub mod arrays;
#[cfg(feature = "hdf5")]
pub mod hdf5_records;
#[cfg(feature = "hdf5")]
pub mod impact_run;
pub mod mapping;
pub mod run_up;
mod signal_calc;
#[cfg(feature = "hdf5")]
pub mod test_data;
pub mod unit_label;

use std::io::Read;
use std::path::Path;

use super::{csv, mat, npy, uff, wav};
use crate::error::Error;
use rotordyn_signal::record::{MeasuredData, Points, Record};

/// A file format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    Universal,
    Mat,
    Numpy,
    Wav,
    Table,
    Hdf5,
}

/// Bytes from the start for detecting a format; HDF5 may follow a user block of 512 bytes.
const DETECTION_BYTES: usize = 520;

impl Format {
    /// The format of a file by its first bytes; text that is not a universal file is a table.
    pub fn of_content(head: &[u8]) -> Option<Format> {
        let hdf5 = b"\x89HDF\r\n\x1a\n";
        let first_line = head.split(|&b| b == b'\n').map(<[u8]>::trim_ascii).find(|line| !line.is_empty());
        match head {
            _ if [0, 512].iter().any(|&at| head.get(at..).is_some_and(|h| h.starts_with(hdf5))) => {
                Some(Format::Hdf5)
            }
            _ if mat::is_mat(head) => Some(Format::Mat),
            _ if npy::is_npy(head) || npy::is_npz(head) => Some(Format::Numpy),
            _ if wav::is_wav(head) => Some(Format::Wav),
            _ if first_line == Some(b"-1") => Some(Format::Universal),
            // Text has no control characters other than tabs and line ends.
            _ if head.iter().all(|&b| b >= 0x20 || matches!(b, b'\t' | b'\n' | b'\r')) => Some(Format::Table),
            _ => None,
        }
    }

    /// The format of a file extension.
    pub fn of_extension(path: &Path) -> Option<Format> {
        let extension = path.extension()?.to_str()?.to_ascii_lowercase();
        Some(match extension.as_str() {
            "uff" | "unv" | "uf" => Format::Universal,
            "mat" => Format::Mat,
            "npz" | "npy" => Format::Numpy,
            "wav" => Format::Wav,
            "csv" | "txt" | "tsv" | "dat" => Format::Table,
            "h5" | "hdf5" => Format::Hdf5,
            _ => return None,
        })
    }
}

/// Reads every channel of a file of any supported format.
///
/// Names of records are made unique, and non-finite values are reported in the notes.
///
/// # Errors
/// The file cannot be read, is of an unknown format, damaged or cut off; each message has a hint.
pub fn read(path: &Path) -> Result<MeasuredData, Error> {
    let mut head = Vec::new();
    let file = std::fs::File::open(path);
    file.and_then(|file| file.take(DETECTION_BYTES as u64).read_to_end(&mut head))
        .map_err(Error::of_file("read", path))?;
    let content = |problem: &str, advice: &str| Error::Content {
        path: path.into(),
        problem: problem.into(),
        advice: advice.into(),
    };
    if head.is_empty() {
        return Err(content("the file is empty", "copy or export it again"));
    }
    let of_arrays = |(arrays, left_out): (Vec<arrays::Array>, Vec<String>)| {
        let mut out = arrays::to_records(arrays);
        if !left_out.is_empty() {
            out.notes.push(format!("not read, since they are not plain arrays: {}", left_out.join(", ")));
        }
        out
    };
    let mut out = match Format::of_content(&head) {
        Some(Format::Universal) => uff::read(path)?,
        Some(Format::Mat) => of_arrays(mat::read(path)?),
        Some(Format::Numpy) => of_arrays(npy::read(path)?),
        Some(Format::Wav) => wav::read(path)?,
        #[cfg(feature = "hdf5")]
        Some(Format::Hdf5) => hdf5_records::read(path)?,
        #[cfg(not(feature = "hdf5"))]
        Some(Format::Hdf5) => return Err(without_hdf5(path)),
        Some(Format::Table) => csv::read(path)?,
        None if Format::of_extension(path) == Some(Format::Mat) => {
            return Err(content("it is not a MATLAB file of version 5 or 7.3", "save it with `save -v7`"));
        }
        None => {
            let advice = "use a universal file, MATLAB, NumPy, WAV, CSV or HDF5 file";
            return Err(content("the file's format is not known", advice));
        }
    };
    if out.records.is_empty() && out.shapes.is_empty() && out.geometry.nodes.is_empty() {
        return Err(content("the file contains no channel", "export the records themselves"));
    }
    make_names_unique_and_check(&mut out);
    Ok(out)
}

#[cfg(not(feature = "hdf5"))]
fn without_hdf5(path: &Path) -> Error {
    Error::Content {
        path: path.into(),
        problem: "this build has no HDF5".into(),
        advice: "build with the feature `hdf5`, or use another format".into(),
    }
}

/// Start of the note on channels without an axis.
pub const MISSING_AXIS_NOTE: &str = "no sampling rate or frequency step is stated for";

/// Makes names unique and reports non-finite values.
fn make_names_unique_and_check(out: &mut MeasuredData) {
    for k in 1..out.records.len() {
        let (before, here) = out.records.split_at_mut(k);
        let taken = |name: &str| before.iter().any(|r| r.name == name);
        let name = here[0].name.clone();
        let mut number = 1;
        while taken(&here[0].name) {
            number += 1;
            here[0].name = format!("{name} ({number})");
        }
    }
    for record in &out.records {
        if let Some((count, first)) = record.values.not_finite() {
            let (name, length) = (&record.name, record.values.len());
            out.notes.push(format!(
                "`{name}` has {count} values of {length} that are not finite, the first at index {first}"
            ));
        }
    }
    let without: Vec<&str> =
        out.records.iter().filter(|r| r.axis.points == Points::Unknown).map(|r| r.name.as_str()).collect();
    if !without.is_empty() {
        let more = if without.len() > 6 { ", ..." } else { "" };
        let some = without[..without.len().min(6)].join(", ");
        out.notes.push(format!("{MISSING_AXIS_NOTE} {some}{more}"));
    }
}

/// Writes a file in the format of its extension.
///
/// # Errors
/// An unknown extension, records that the format cannot store, or a file that cannot be written.
pub fn write(path: &Path, measured: &MeasuredData) -> Result<(), Error> {
    let all: Vec<&Record> = measured.records.iter().collect();
    match Format::of_extension(path) {
        Some(Format::Universal) => {
            let modern = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("unv"));
            let geometry = if modern { uff::GeometrySets::Modern } else { uff::GeometrySets::Classic };
            uff::write(path, measured, uff::Options { geometry, ..uff::Options::default() })
        }
        Some(Format::Mat) => mat::write(path, &arrays::from_records(measured, mat::MAX_NAME_LENGTH)),
        Some(Format::Numpy) => npy::write(path, &arrays::from_records(measured, usize::MAX)),
        Some(Format::Wav) => wav::write(path, &all, wav::SampleFormat::Float),
        Some(Format::Table) => csv::write_records(path, &all),
        #[cfg(feature = "hdf5")]
        Some(Format::Hdf5) => hdf5_records::write(path, measured),
        #[cfg(not(feature = "hdf5"))]
        Some(Format::Hdf5) => Err(without_hdf5(path)),
        None => Err(Error::Content {
            path: path.into(),
            problem: "its extension is not that of a supported format".into(),
            advice: "use .uff, .unv, .mat, .npz, .wav, .csv or .h5".into(),
        }),
    }
}

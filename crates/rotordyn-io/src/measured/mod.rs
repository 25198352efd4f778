//! Measured files: format detected by content when reading, chosen by the extension when writing.
//!
//! | format | read | written | contents |
//! |---|---|---|---|
//! | universal file | .uff .unv .uf | .uff (ASCII), .unv | all |
//! | MATLAB v4, v5 | .mat | .mat (v5) | records |
//! | NumPy | .npz .npy | .npz | records |
//! | WAV, RF64 | .wav | .wav | time records of one rate, without units |
//! | table | .csv .txt .tsv .dat | .csv | records over one axis |
//! | LabVIEW | .lvm | | records |
//! | HDF5 | .h5 .hdf5, .mat v7.3, results.h5 | .h5 | records |

pub(crate) mod array;
mod array_names;
pub mod arrays;
pub(crate) mod axis_names;
pub(crate) mod axis_units;
mod coherence_names;
pub(crate) mod content_problem;
#[cfg(feature = "hdf5")]
mod hdf5_arrays;
#[cfg(feature = "hdf5")]
pub mod hdf5_records;
#[cfg(feature = "hdf5")]
pub mod impact_run;
pub mod mapping;
pub(crate) mod name_unit;
#[cfg(feature = "hdf5")]
pub mod operating_run;
mod own_axes;
pub mod ramps;
mod record_arrays;
pub mod run_up;
mod signal_calc;
pub(crate) mod stated_value;
mod structures;
#[cfg(feature = "hdf5")]
pub mod test_data;
pub mod unit_label;

use std::collections::{HashMap, HashSet};
use std::io::Read;
use std::path::Path;

use super::{csv, mat, npy, uff, wav};
use crate::budget::{self, Budget, Limits};
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

/// Beginnings of TDMS files and of their index files. The crates tdms 0.3 and tdms-rs 2.0 allocate what a file states and
/// have never been fuzzed.
const TDMS_MARKS: [&[u8]; 2] = [b"TDSm", b"TDSh"];
const TDMS_ADVICE: &str = "export it as .lvm, .csv or .mat from LabVIEW or DIAdem, or in Python with the package npTDMS: \
                           `TdmsFile.read(\"x.tdms\").as_hdf(\"x.h5\")`";

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
            _ if csv::encoding::utf_16(head).is_some() => Some(Format::Table),
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
            "csv" | "txt" | "tsv" | "dat" | "lvm" => Format::Table,
            "h5" | "hdf5" => Format::Hdf5,
            _ => return None,
        })
    }
}

/// Reads every channel of a file of any supported format, within the usual limits.
///
/// Names of records are made unique, and non-finite values are reported in the notes.
///
/// # Errors
/// The file cannot be read, is of an unknown format, damaged or cut off, or exceeds its budget; each message has a hint.
pub fn read(path: &Path) -> Result<MeasuredData, Error> {
    read_within(path, &Limits::default())
}

/// As [`read`], within other limits.
///
/// # Errors
/// As [`read`].
pub fn read_within(path: &Path, limits: &Limits) -> Result<MeasuredData, Error> {
    read_at_rate(path, limits, None)
}

/// As [`read_within`], with a sampling rate \[Hz\] that holds where the file states two that differ, with a note.
///
/// It is no other rate for records that state one, and none for those that state none.
///
/// # Errors
/// As [`read`].
pub fn read_at_rate(path: &Path, limits: &Limits, given_rate: Option<f64>) -> Result<MeasuredData, Error> {
    let mut head = Vec::new();
    let file = std::fs::File::open(path).map_err(Error::of_file("read", path))?;
    budget::regular_size(path, &file)?;
    file.take(DETECTION_BYTES as u64).read_to_end(&mut head).map_err(Error::of_file("read", path))?;
    let content = |problem: &str, advice: &str| Error::Content {
        path: path.into(),
        problem: problem.into(),
        advice: advice.into(),
    };
    if head.is_empty() {
        return Err(content("the file is empty", "copy or export it again"));
    }
    let of_arrays = |(arrays, left_out, budget): (Vec<arrays::Array>, Vec<String>, Budget)| {
        let mut out =
            arrays::to_records(&arrays, &budget, given_rate).map_err(|problem| problem.of_file(path))?;
        out.left_out.splice(0..0, left_out);
        ramps::take_times(&mut out, given_rate);
        Ok::<_, Error>(out)
    };
    let mut out = match Format::of_content(&head) {
        Some(Format::Universal) => uff::read(path, limits)?.0,
        Some(Format::Mat) => of_arrays(mat::read(path, limits)?)?,
        Some(Format::Numpy) => of_arrays(npy::read(path, limits)?)?,
        Some(Format::Wav) => wav::read(path, limits)?.0,
        #[cfg(feature = "hdf5")]
        Some(Format::Hdf5) => hdf5_records::read(path, limits, given_rate)?,
        #[cfg(not(feature = "hdf5"))]
        Some(Format::Hdf5) => return Err(without_hdf5(path)),
        Some(Format::Table) => {
            let mut out = csv::read(path, limits, given_rate)?.0;
            ramps::take_times(&mut out, given_rate);
            out
        }
        None if Format::of_extension(path) == Some(Format::Mat) => {
            return Err(content("it is not a MATLAB file of version 4, 5 or 7.3", "save it with `save -v7`"));
        }
        None if TDMS_MARKS.iter().any(|mark| head.starts_with(mark)) => {
            return Err(content("it is a TDMS file of LabVIEW or DIAdem, which is not read", TDMS_ADVICE));
        }
        None => {
            let advice = "use a universal file, MATLAB, NumPy, WAV, CSV or HDF5 file";
            return Err(content("the file's format is not known", advice));
        }
    };
    if out.records.is_empty() && out.shapes.is_empty() && out.geometry.nodes.is_empty() {
        let problem = match out.left_out_text() {
            Some(left_out) => format!("the file contains no channel that can be read; {left_out}"),
            None => "the file contains no channel".into(),
        };
        return Err(content(&problem, "export the records themselves"));
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

/// Most remarks on a file; further ones are counted.
const MAX_NOTES: usize = 50;

/// Start of the note on channels without an axis.
pub const MISSING_AXIS_NOTE: &str = "no sampling rate or frequency step is stated for";

/// Makes names unique and reports non-finite values.
fn make_names_unique_and_check(out: &mut MeasuredData) {
    let mut taken: HashSet<String> = HashSet::with_capacity(out.records.len());
    let mut last_numbers: HashMap<String, usize> = HashMap::new();
    for record in &mut out.records {
        if taken.insert(record.name.clone()) {
            continue;
        }
        let base = std::mem::take(&mut record.name);
        let number = last_numbers.entry(base.clone()).or_insert(1);
        loop {
            *number += 1;
            record.name = format!("{base} ({number})");
            if taken.insert(record.name.clone()) {
                break;
            }
        }
    }
    let mut more = 0;
    for record in &out.records {
        let Some((count, first)) = record.values.not_finite() else { continue };
        if out.notes.len() >= MAX_NOTES {
            more += 1;
            continue;
        }
        let (name, length) = (&record.name, record.values.len());
        out.notes.push(format!(
            "`{name}` has {count} values of {length} that are not finite, the first at index {first}"
        ));
    }
    if more > 0 {
        out.notes.push(format!("{more} more channels have values that are not finite"));
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
        Some(Format::Mat) => mat::write(path, &record_arrays::from_records(measured, mat::MAX_NAME_LENGTH)),
        Some(Format::Numpy) => npy::write(path, &record_arrays::from_records(measured, usize::MAX)),
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

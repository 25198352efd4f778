//! WAV files: PCM of 8 to 64 bits and floats of 32 and 64 bits read, 32-bit floats or PCM written.
//!
//! The only module that uses the hound crate, which writes; it reads neither 64-bit floats nor RF64. PCM values are
//! fractions of full scale, −1 to 1; WAV has no units.

mod chunks;

use std::path::Path;

use crate::atomic_file::NewFile;
use crate::budget::{self, Budget, Limits};
use crate::error::Error;
use rotordyn_signal::record::{MeasuredData, Record, RecordError, Values};

/// How samples are written.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum SampleFormat {
    /// 32-bit floats of the values as they are.
    #[default]
    Float,
    /// PCM of 16, 24 or 32 bits; a value of `full_scale` becomes the largest sample.
    Pcm { bits: u16, full_scale: f64 },
}

/// Whether a file starts with a WAV header.
pub fn is_wav(head: &[u8]) -> bool {
    chunks::is_wav(head)
}

/// Reads every channel, named after the file and numbered if there is more than one.
///
/// # Errors
/// The file cannot be read, is cut off, has another encoding than PCM and floats, or exceeds its budget.
pub fn read(path: &Path, limits: &Limits) -> Result<(MeasuredData, Budget), Error> {
    let (bytes, budget) = budget::read_file(path, limits)?;
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    match chunks::records(&bytes, &stem, &budget) {
        Ok(found) => Ok((found, budget)),
        Err(problem) => Err(problem.of_file(path)),
    }
}

/// Writes time records of one rate and length as the channels of one file.
///
/// # Errors
/// No record, rates or lengths that differ, a rate that is not an integer number of Hz, NaN, a value beyond
/// full scale, or a file that cannot be written.
pub fn write(path: &Path, records: &[&Record], samples: SampleFormat) -> Result<(), Error> {
    let content =
        |problem: String, advice: &str| Error::Content { path: path.into(), problem, advice: advice.into() };
    let first =
        records.first().ok_or_else(|| content("there is no channel to write".into(), "choose one"))?;
    let rate = first.sample_rate()?;
    let count = first.values.len();
    let mut channels = Vec::new();
    for record in records {
        let values = record.time_samples()?;
        if record.sample_rate()? != rate || values.len() != count {
            return Err(RecordError::axes_differ(first, record).into());
        }
        if let Some((_, index)) = Values::Real(values.to_vec()).not_finite() {
            return Err(RecordError::NotFinite { channel: record.name.clone(), index }.into());
        }
        channels.push(values);
    }
    let whole = rate.round();
    if (rate - whole).abs() > 1e-9 * rate || !(1.0..=f64::from(u32::MAX)).contains(&whole) {
        let problem = format!("a WAV file needs an integer sampling rate in Hz, not {rate}");
        return Err(content(problem, "resample, or write .uff or .mat"));
    }
    let (bits, format) = match samples {
        SampleFormat::Float => (32, hound::SampleFormat::Float),
        SampleFormat::Pcm { bits, .. } => (bits, hound::SampleFormat::Int),
    };
    let spec = hound::WavSpec {
        channels: channels.len() as u16,
        sample_rate: whole as u32,
        bits_per_sample: bits,
        sample_format: format,
    };
    let failed = |error: hound::Error| failure("write", path, error);
    let new = NewFile::replacing(path);
    let mut file = hound::WavWriter::create(new.part(), spec).map_err(failed)?;
    for k in 0..count {
        for (values, record) in channels.iter().zip(records) {
            match samples {
                SampleFormat::Float => file.write_sample(values[k] as f32).map_err(failed)?,
                SampleFormat::Pcm { bits, full_scale } => {
                    let top = 2.0_f64.powi(i32::from(bits) - 1);
                    let level = (values[k] / full_scale * top).round();
                    if level.abs() > top {
                        let problem = format!(
                            "`{}` reaches {} at sample {k}, full scale is {full_scale}",
                            record.name, values[k]
                        );
                        return Err(content(problem, "choose a larger full scale, or floats"));
                    }
                    file.write_sample(level.min(top - 1.0) as i32).map_err(failed)?;
                }
            }
        }
    }
    file.finalize().map_err(failed)?;
    new.publish().map_err(Error::of_file("write", path))
}

fn failure(operation: &'static str, path: &Path, error: hound::Error) -> Error {
    match error {
        hound::Error::IoError(source) if source.kind() != std::io::ErrorKind::Other => {
            Error::of_file(operation, path)(source)
        }
        other => Error::Content {
            path: path.into(),
            problem: other.to_string(),
            advice: "save it as PCM of 16, 24 or 32 bits, or as 32-bit floats".into(),
        },
    }
}

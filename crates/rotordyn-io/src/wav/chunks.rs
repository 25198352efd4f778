//! The chunks of a WAV or RF64 file and their samples.
//!
//! Format: Multimedia Programming Interface and Data Specifications 1.0 (RIFF WAVE), WAVEFORMATEXTENSIBLE, and EBU Tech 3306
//! (RF64, whose sizes beyond 4 GB are in the chunk `ds64`).

use crate::budget::Budget;
use crate::measured::content_problem::ContentProblem;
use rotordyn_signal::record::{MeasuredData, Record};

/// Codes of the format.
const PCM: u16 = 1;
const FLOAT: u16 = 3;
const EXTENSIBLE: u16 = 0xfffe;
/// A size that stands in `ds64`, or that a writer left because it did not come to its end.
const UNKNOWN_SIZE: u64 = u32::MAX as u64;
/// What follows the code in the sub-format of an extensible format.
const GUID: [u8; 14] = [0, 0, 0, 0, 0x10, 0, 0x80, 0, 0, 0xaa, 0, 0x38, 0x9b, 0x71];
/// Chunks without content of interest: filling, the number of samples, peaks of a display.
const SILENT: [&[u8; 4]; 9] =
    [b"JUNK", b"junk", b"PAD ", b"FLLR", b"fact", b"PEAK", b"ds64", b"fmt ", b"data"];
/// Most chunks that are named when they are left out.
const MAX_NAMED: usize = 20;

const COPY_AGAIN: &str = "copy the file again";
const SAVE_AS: &str = "save it as PCM of 8, 16, 24 or 32 bits, or as floats of 32 or 64 bits";

pub(super) fn is_wav(head: &[u8]) -> bool {
    [b"RIFF", b"RF64", b"BW64"].iter().any(|mark| head.starts_with(*mark)) && head.get(8..12) == Some(b"WAVE")
}

/// What the chunk `fmt ` states.
struct Form {
    /// Floats, not integers.
    float: bool,
    channels: usize,
    rate: u32,
    /// Bytes of a sample.
    width: usize,
}

fn u16_at(bytes: &[u8], at: usize) -> Option<u16> {
    bytes.get(at..)?.first_chunk().map(|b| u16::from_le_bytes(*b))
}

fn u32_at(bytes: &[u8], at: usize) -> Option<u32> {
    bytes.get(at..)?.first_chunk().map(|b| u32::from_le_bytes(*b))
}

impl Form {
    fn read(chunk: &[u8]) -> Result<Self, ContentProblem> {
        let damaged = || ContentProblem::new("its format (chunk `fmt `) is damaged", COPY_AGAIN);
        let code = u16_at(chunk, 0).ok_or_else(damaged)?;
        let channels = usize::from(u16_at(chunk, 2).ok_or_else(damaged)?);
        let rate = u32_at(chunk, 4).ok_or_else(damaged)?;
        let block = usize::from(u16_at(chunk, 12).ok_or_else(damaged)?);
        let bits = u16_at(chunk, 14).ok_or_else(damaged)?;
        let code = match code {
            EXTENSIBLE => {
                let sub_format = u16_at(chunk, 24).ok_or_else(damaged)?;
                if chunk.get(26..40) != Some(&GUID[..]) {
                    return Err(ContentProblem::new(
                        "its samples are of an unknown kind (sub-format)",
                        SAVE_AS,
                    ));
                }
                sub_format
            }
            code => code,
        };
        if channels == 0 || !block.is_multiple_of(channels) {
            return Err(damaged());
        }
        // Samples are stored in whole bytes, the unused bits below.
        let width = block / channels;
        let float = match (code, width, bits) {
            (PCM, 1..=4 | 8, 1..) if usize::from(bits) <= 8 * width => false,
            (FLOAT, 4, 32) | (FLOAT, 8, 64) => true,
            (PCM | FLOAT, ..) => {
                let kind = if code == PCM { "integers" } else { "floats" };
                let problem =
                    format!("its samples are {kind} of {bits} bits in {width} bytes, which are not read");
                return Err(ContentProblem::new(problem, SAVE_AS));
            }
            (code, ..) => {
                let kind = match code {
                    2 | 0x11 => "compressed (ADPCM)",
                    6 => "compressed (A-law)",
                    7 => "compressed (µ-law)",
                    0x50 | 0x55 => "compressed (MPEG)",
                    _ => "of an unknown kind",
                };
                return Err(ContentProblem::new(
                    format!("its samples are {kind}: format code {code}"),
                    SAVE_AS,
                ));
            }
        };
        if rate == 0 {
            return Err(ContentProblem::new(
                "the sampling rate is 0 Hz",
                "write the file again with its rate",
            ));
        }
        Ok(Self { float, channels, rate, width })
    }

    /// A sample as a float, or as a fraction of full scale.
    fn value(&self, b: &[u8]) -> f64 {
        let at = |k: usize| b.get(k).copied().unwrap_or(0);
        match (self.float, self.width) {
            (true, 4) => f64::from(f32::from_le_bytes(std::array::from_fn(at))),
            (true, _) => f64::from_le_bytes(std::array::from_fn(at)),
            // Eight bits have their zero at 128.
            (false, 1) => (f64::from(at(0)) - 128.0) / 128.0,
            (false, width) => {
                // The bytes at the upper end of a word keep the sign.
                let word: [u8; 8] =
                    std::array::from_fn(|k| if k + width < 8 { 0 } else { at(k + width - 8) });
                i64::from_le_bytes(word) as f64 / 2.0_f64.powi(63)
            }
        }
    }
}

/// The channels of a file, and what of its chunks is not read.
///
/// # Errors
/// Samples that are missing or of another kind, or contents that exceed the budget.
pub(super) fn records(bytes: &[u8], stem: &str, budget: &Budget) -> Result<MeasuredData, ContentProblem> {
    let mut out = MeasuredData::default();
    let (mut form, mut found, mut long_size, mut more) = (None, None, None, 0);
    let mut rest = bytes.get(12..).unwrap_or_default();
    while let Some((head, after)) = rest.split_at_checked(8) {
        let name = &head[..4];
        let stated = u64::from(u32_at(head, 4).unwrap_or(0));
        let stated = match long_size {
            Some(size) if name == b"data" && stated == UNKNOWN_SIZE => size,
            _ => stated,
        };
        let there = usize::try_from(stated).map_or(after.len(), |size| size.min(after.len()));
        let chunk = &after[..there];
        match name {
            b"fmt " if form.is_none() => form = Some(Form::read(chunk)?),
            b"ds64" => {
                let low_high = [8, 12].map(|at| u32_at(chunk, at).map(u64::from));
                long_size = low_high[0].zip(low_high[1]).map(|(low, high)| low | high << 32);
            }
            b"data" if found.is_none() => found = Some((chunk, stated)),
            _ if SILENT.iter().any(|silent| *silent == name) => {}
            _ if out.left_out.len() < MAX_NAMED => {
                let name = String::from_utf8_lossy(name);
                out.left_out.push(format!("the chunk {} ({stated} bytes)", name.trim().escape_default()));
            }
            _ => more += 1,
        }
        // Chunks begin at even places.
        rest = after.get(there + there % 2..).unwrap_or_default();
    }
    if more > 0 {
        out.left_out.push(format!("{more} more chunks"));
    }
    let form =
        form.ok_or_else(|| ContentProblem::new("the file has no format (chunk `fmt `)", COPY_AGAIN))?;
    let (data, stated) =
        found.ok_or_else(|| ContentProblem::new("the file is cut off: it has no samples", COPY_AGAIN))?;
    let expected = stated / form.width as u64;
    let samples = data.len() / form.width;
    if (samples as u64) < expected || samples < form.channels {
        return Err(ContentProblem::new(
            format!("the file is cut off: {samples} of {expected} samples"),
            COPY_AGAIN,
        ));
    }
    budget.objects("channels", form.channels)?;
    let count = samples / form.channels;
    for channel in 0..form.channels {
        let name = if form.channels == 1 { stem.to_owned() } else { format!("{stem}_{}", channel + 1) };
        let mut values = budget.list(|| "the channels".into(), count)?;
        let own = data.chunks_exact(form.width).skip(channel).step_by(form.channels).take(count);
        values.extend(own.map(|sample| form.value(sample)));
        out.records.push(Record::samples(&name, f64::from(form.rate), 0.0, values, ""));
    }
    Ok(out)
}

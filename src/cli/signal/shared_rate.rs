//! Channels that are read at the sampling rate of others although they are shorter by a whole factor.

use rotordyn::signal::record::Record;

use super::super::terminal::number;
use super::input::File;

/// A warning for a channel whose rate is that of the file, where another one at that rate has a multiple of its samples: both
/// may be of the same duration.
pub fn warning(file: &File, record: &Record) -> Option<String> {
    let source = |record: &Record| {
        let mut sources = file.measured.axis_sources.iter();
        sources.find(|(name, _)| *name == record.name).map(|(_, source)| source.as_str())
    };
    let count = record.values.len();
    let is_multiple = |other: &&Record| {
        let factor = (other.values.len() as f64 / count as f64).round() as usize;
        factor >= 2
            && other.values.len().abs_diff(factor * count) <= factor
            && source(other) == source(record)
            && other.sample_rate().ok() == record.sample_rate().ok()
    };
    // Where every channel states its own axis there is nothing to assume.
    if source(record).is_none() && record.sample_rate().is_ok() {
        return None;
    }
    let other = file.time_records().filter(is_multiple).max_by_key(|other| other.values.len())?;
    let factor = (other.values.len() as f64 / count as f64).round();
    let (rate, by) = match (record.sample_rate(), source(record)) {
        (Ok(rate), Some(source)) => (format!("{rate} Hz"), format!(" of {source}")),
        _ => ("the rate given".into(), String::new()),
    };
    let its = record
        .sample_rate()
        .map_or_else(|_| format!("1/{factor} of it"), |rate| format!("{} Hz", number(rate / factor, 6)));
    Some(format!(
        "`{0}` has {count} samples, 1/{factor} of the {1} of `{2}`, and no rate of its own: {rate}{by} is used for both. If both are \
         equally long in time its rate is {its}: state it in the file, as `{0}_fs`",
        record.name,
        other.values.len(),
        other.name
    ))
}

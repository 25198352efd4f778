//! Signal analyses of records as one HDF5 file, `signal.h5`.
//!
//! | group | contents |
//! |---|---|
//! | `/meta` | attributes: schema, program, version, git, file, command |
//! | `/compared_record/<channel>` | the channel of the compared record |
//! | `/<channel>` | attributes: channel (its name, in which `/` is allowed), unit, sample_rate, start, statistics, speed, bearing and its orders, diagnosis |
//! | `.../record`, `.../speed` | the samples analysed; the shaft's speed over time |
//! | `.../spectrum`, `.../density`, `.../envelope`, `.../spectral_kurtosis` | values over their axis |
//! | `.../kurtogram`, `.../band_scores` | low, high, level, value of every band |
//! | `.../spectrogram`, `.../orders`, `.../cyclic_coherence` | spectrogram, order map, cyclic spectral coherence, with their axes as dimension scales |
//! | `.../cepstrum`, `.../jerk`, `.../folded_jerk`, `.../synchronous_average` | curves; jerk folded over the ball passages, time-synchronous average |
//! | `.../lines` | one row for every bearing defect line searched |

use super::GroupWriter;
use super::provenance::SCHEMA;
use super::section::write_section;
use crate::error::Error;
use crate::hdf5::Store;
use rotordyn_core::results::{SignalResult, TrendResult};

/// Provenance of results.
#[derive(Clone, Copy, Debug)]
pub struct SignalMeta<'a> {
    pub file: &'a str,
    /// The command's arguments.
    pub command: &'a str,
}

/// Writes the results of every channel, and of the channel of another record for comparison.
///
/// # Errors
/// The file cannot be written.
pub fn write_signal(
    store: &Store,
    meta: &SignalMeta,
    results: &[SignalResult],
    compared: Option<&SignalResult>,
) -> Result<(), Error> {
    write_meta(store, meta)?;
    results.iter().try_for_each(|result| write_section(store, "", &result.section()))?;
    compared.map_or(Ok(()), |other| write_section(store, "/compared_record", &other.section()))?;
    store.flush()
}

/// Writes the trend of several records: `/meta` and `/trend`.
///
/// # Errors
/// The file cannot be written.
pub fn write_trend(store: &Store, meta: &SignalMeta, found: &TrendResult) -> Result<(), Error> {
    write_meta(store, meta)?;
    write_section(store, "", &found.section())?;
    store.flush()
}

fn write_meta(store: &Store, meta: &SignalMeta) -> Result<(), Error> {
    let writer = GroupWriter::new(store, "/meta")?;
    writer.set_attribute("schema", SCHEMA)?;
    writer.set_attribute("program", "rotordyn")?;
    writer.set_attribute("version", env!("CARGO_PKG_VERSION"))?;
    writer.set_attribute("git", option_env!("ROTORDYN_GIT").unwrap_or("unknown"))?;
    writer.set_attribute("file", meta.file)?;
    writer.set_attribute("command", meta.command)?;
    writer.set_attribute(
        "units",
        "SI where the record's unit is known; frequencies in Hz, orders per revolution of the shaft",
    )
}

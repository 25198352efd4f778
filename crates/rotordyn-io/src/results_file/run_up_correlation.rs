//! Measured and computed run as data sets.

use super::GroupWriter;
use super::section::write_section;
use crate::error::Error;
use crate::hdf5::Store;
use rotordyn_core::results::{ChannelPair, History};

/// Writes a measured and a computed run as `/measured` and `/computed`, each with its channels over time and their
/// spectra.
///
/// # Errors
/// The file cannot be written.
pub fn write_run_up_correlation(
    store: &Store,
    pairs: &[ChannelPair],
    measured: &History,
    computed: &History,
) -> Result<(), Error> {
    for (k, (name, run)) in ["/measured", "/computed"].iter().zip([measured, computed]).enumerate() {
        let writer = GroupWriter::new(store, name)?;
        let count = run.time.len();
        writer.set_attribute("sample_rate", run.sample_rate)?;
        writer.write_array("time/t", &[count], &run.time.all()?, "s")?;
        writer.write_array("time/theta", &[count], &run.angle.all()?, "rad")?;
        writer.write_array("time/speed", &[count], &run.speed.all()?, "rad/s")?;
        for pair in pairs {
            if let Some(channel) = run.channels.iter().find(|c| c.name == pair.channel) {
                let at = format!("channels/{}", pair.channel);
                writer.write_array(&at, &[count], &channel.values.all()?, &pair.unit)?;
            }
            write_section(store, name, &pair.spectrograms[k].section())?;
            write_section(store, name, &pair.orders[k].section())?;
        }
    }
    Ok(())
}

//! Output-only (operational) modal analysis: modes of a running machine from its responses alone.
//!
//! | module | contents |
//! |---|---|
//! | `settings`, `result` | record, shaft, settings; modes with standard errors, harmonics, what was dropped |
//! | `band` | the steps below, for one band |
//! | `prepare` | band, decimation, scale |
//! | `lines`, `orders` | sines recognised by their amplitude distribution; order subtraction |
//! | `correlation` | correlations by blocks, block Hankel matrix |
//! | `subspace`, `uncertainty` | covariance-driven stochastic subspace identification (SSI-cov); standard errors |
//! | `selection` | modes by stabilisation over the orders; harmonics, spurious poles, doubts |
//! | `parts` | parts of the band identified by themselves where peaks are left over |
//! | `fdd` | frequency-domain decomposition |
//!
//! The unknown forces are taken for broadband and random. A peak of their spectrum is indistinguishable from a mode, and
//! a sine (unbalance, ball pass) is an undamped one: harmonics are removed or recognised.

mod band;
mod correlation;
mod fdd;
mod lines;
mod orders;
mod parts;
mod prepare;
mod result;
mod selection;
mod settings;
mod subspace;
mod uncertainty;

pub use result::{Harmonic, OperationalMode, OperationalModes, SpectralDecomposition, SpectralPeak};
pub use settings::{OperationalSettings, OutputRecord, Shaft};

use crate::IdentifyError;

/// Identifies the modes of a machine from its responses to unknown random forces.
///
/// `record` y (channels by samples, SI), at least some thousand cycles of the lowest mode for its damping;
/// [`OperationalSettings`]. Harmonics are subtracted where the motion of the shaft is known, and recognised by their
/// amplitude distribution; none is returned as a mode. Standard errors from the scatter of the correlations between blocks.
///
/// # Errors
/// Values that are not finite, dead channels, too few samples, wrong settings, no mode.
pub fn identify_operational(
    record: &OutputRecord,
    settings: &OperationalSettings,
) -> Result<OperationalModes, IdentifyError> {
    let mut found = band::identify_band(record, settings)?;
    parts::resolve(record, settings, &mut found);
    IdentifyError::if_stopped(&settings.stop)?;
    found.warnings.extend(parts::unexplained_peaks(&found).into_iter().map(|peak| {
        format!(
            "the spectrum has a peak of {:.0} dB at {:.3} Hz that no mode explains: too short a record for it, a peak of the \
             forces, or an unsteady harmonic",
            peak.height_db, peak.frequency
        )
    }));
    if found.modes.is_empty() && found.warnings.is_empty() {
        let poles = found.diagram.len();
        return Err(IdentifyError::NoMode {
            from: found.band[0],
            to: found.band[1],
            poles,
            orders: found.orders.len(),
            dropped: Vec::new(),
        });
    }
    Ok(found)
}

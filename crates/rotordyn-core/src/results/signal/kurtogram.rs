//! Kurtogram and spectral kurtosis.

use super::curves::{bands, over_axis};
use crate::document::{Document, in_hdf5, in_json};
use rotordyn_signal::kurtogram::Kurtogram;
use rotordyn_signal::spectrum::Spectrum;
use serde::{Deserialize, Serialize};

/// Impulsiveness over frequency: kurtogram and spectral kurtosis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct KurtogramResult {
    pub kurtogram: Kurtogram,
    /// Spectral kurtosis over segments.
    pub spectral: Spectrum,
}

impl KurtogramResult {
    pub(super) fn document(&self) -> Document<'_> {
        let (best, s) = (self.kurtogram.best(), &self.spectral);
        let top = (1..s.values.len() - 1).max_by(|&a, &b| s.values[a].total_cmp(&s.values[b])).unwrap_or(0);
        let best = Document::new()
            .number("low_hz", "Hz", best.low)
            .number("high_hz", "Hz", best.high)
            .number("kurtosis", "1", best.value);
        let highest = Document::new().number("frequency_hz", "Hz", s.frequencies[top]).number(
            "value",
            "1",
            s.values[top],
        );
        let found = Document::new().group("best", best).group("spectral_kurtosis", highest);
        Document::new()
            .group(in_json("kurtogram"), found)
            .with(in_hdf5("kurtogram"), bands(&self.kurtogram, "1"))
            .group(in_hdf5("spectral_kurtosis"), over_axis(s, "frequency", "Hz", "1"))
    }
}

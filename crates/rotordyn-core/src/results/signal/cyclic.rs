//! Cyclic spectral coherence.

use crate::document::{Array, Document, Rows, in_hdf5, in_json};
use rotordyn_signal::bearing_lines::BearingPart;
use rotordyn_signal::cyclic::CyclicCoherence;
use rotordyn_signal::spectrum::Spectrum;
use serde::{Deserialize, Serialize};

/// Cyclic spectral coherence over carrier and modulation frequency.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct CyclicResult {
    pub coherence: CyclicCoherence,
    /// Enhanced envelope spectrum: mean coherence over the carriers, over modulation frequency.
    pub enhanced: Spectrum,
    /// The bearing's first two harmonics in it; none without a bearing.
    pub lines: Vec<CyclicLine>,
    /// Duration of the analysed part \[s\].
    pub duration: f64,
}

/// A peak of the enhanced envelope spectrum near a characteristic frequency.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CyclicLine {
    pub part: BearingPart,
    pub harmonic: usize,
    /// Nominal characteristic frequency, and frequency of the highest coherence near it \[Hz\].
    pub expected: f64,
    pub rate: f64,
    /// Mean |γ| over the carriers there, and its median in the neighbourhood.
    pub coherence: f64,
    pub background: f64,
    /// Excess over the background in robust standard deviations.
    pub deviations: f64,
}

impl CyclicResult {
    pub(super) fn document(&self, channel: &str) -> Document<'_> {
        let c = &self.coherence;
        let (rates, carriers) = (c.cyclic_frequencies.len(), c.frequencies.len());
        let heading = format!("Cyclic spectral coherence of {channel}, mean over all carrier frequencies");
        let lines = Rows::of(&self.lines)
            .heading(heading)
            .text("line", |l| l.part.line_name())
            .integer("harmonic", |l| l.harmonic)
            .quantity("expected", "Hz", |l| l.expected)
            .quantity("peak", "Hz", |l| l.rate)
            .number("coherence", "1", |l| l.coherence)
            .number("background", "1", |l| l.background)
            .number("z_score", "1", |l| l.deviations);
        let squared = Array::real(&[rates, carriers], "1", &c.squared);
        let enhanced = Array::real(&[rates], "1", &self.enhanced.values);
        Document::new()
            .quantity("duration", "s", self.duration)
            .table(in_json("lines"), lines)
            .number(in_hdf5("threshold_1_percent"), "1", c.one_percent_threshold)
            .array(in_hdf5("squared_coherence"), squared.over(0, "cyclic_frequency").over(1, "frequency"))
            .numbers(in_hdf5("cyclic_frequency"), "Hz", &c.cyclic_frequencies)
            .numbers(in_hdf5("frequency"), "Hz", &c.frequencies)
            .array(in_hdf5("enhanced_envelope_spectrum"), enhanced.over(0, "cyclic_frequency"))
    }
}

//! FRFs and unbalance responses of several cases of a machine, and measured FRFs, on common axes.

use crate::document::{Document, MissingCell, Rows};
use rotordyn_linalg::Complex64;
use serde::{Deserialize, Serialize};

/// FRFs between points that two cases or more have.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FrfComparison {
    /// Receptance, mobility or accelerance.
    pub quantity: String,
    pub pairs: Vec<ComparedFrf>,
    /// Responses and excitations that are not compared, with the reason.
    pub left_out: Vec<String>,
}

/// One response to one excitation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ComparedFrf {
    pub response: String,
    pub excitation: String,
    /// Such as "(m/s^2)/N".
    pub unit: String,
    /// A measured one first.
    pub curves: Vec<CaseFrf>,
}

/// An FRF of one case, or a measured one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CaseFrf {
    pub case: String,
    /// By frequency.
    pub points: Vec<FrfPoint>,
    /// By frequency.
    pub peaks: Vec<FrfPeak>,
    /// FRAC with the measured FRF over its frequencies; `None` without one.
    pub frac: Option<f64>,
    /// Mean over the measured frequencies of the level above the measured one \[dB\].
    pub level_db: Option<f64>,
}

/// A point of an FRF.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FrfPoint {
    pub hz: f64,
    pub value: Complex64,
    /// Coherence γ², if measured.
    pub coherence: Option<f64>,
}

/// A peak of the magnitude of an FRF.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FrfPeak {
    pub hz: f64,
    pub magnitude: f64,
}

/// Synchronous responses of several cases at the probes they have in common.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct UnbalanceComparison {
    pub probes: Vec<ComparedUnbalance>,
    /// Probes that are not compared, with the reason.
    pub left_out: Vec<String>,
}

/// The response of one probe.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ComparedUnbalance {
    pub probe: String,
    /// Such as "m".
    pub unit: String,
    pub curves: Vec<CaseUnbalance>,
}

/// The response in one case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CaseUnbalance {
    pub case: String,
    /// By speed.
    pub points: Vec<UnbalancePoint>,
    /// Speed \[rpm\] and amplitude where it is largest.
    pub largest: [f64; 2],
    /// Peaks within the range: speed \[rpm\], amplitude and amplification factor.
    pub peaks: Vec<UnbalancePeak>,
}

/// A point of a synchronous response.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct UnbalancePoint {
    pub rpm: f64,
    /// Zero to peak.
    pub amplitude: f64,
    pub phase_deg: f64,
}

/// A resonance of a synchronous response.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct UnbalancePeak {
    pub rpm: f64,
    pub amplitude: f64,
    /// N_c/(N_2 − N_1); `None` if the amplitude does not fall to 0.707 of the peak on both sides.
    pub amplification: Option<f64>,
}

impl FrfComparison {
    /// What is written to files.
    pub fn document(&self) -> Document<'_> {
        let pairs = Rows::of(&self.pairs)
            .text("response", |p| &p.response)
            .text("excitation", |p| &p.excitation)
            .text("unit", |p| &p.unit)
            .nested(
                "curves",
                |p| &p.curves,
                |rows| {
                    rows.text("case", |c| &c.case)
                        .optional("frac", "1", |c| c.frac)
                        .optional("level_db", "dB", |c| c.level_db)
                        .nested(
                            "peaks",
                            |c| &c.peaks,
                            |rows| {
                                rows.number("frequency_hz", "Hz", |p| p.hz)
                                    .number("magnitude", "", |p| p.magnitude)
                            },
                        )
                        .nested(
                            "points",
                            |c| &c.points,
                            |rows| {
                                rows.number("frequency_hz", "Hz", |p| p.hz)
                                    .number("re", "", |p| p.value.re)
                                    .number("im", "", |p| p.value.im)
                                    .optional("coherence", "1", |p| p.coherence)
                                    .missing(MissingCell::Omitted)
                            },
                        )
                },
            );
        Document::new()
            .text("quantity", &self.quantity)
            .table("pairs", pairs)
            .texts("left_out", &self.left_out)
    }
}

impl UnbalanceComparison {
    /// What is written to files.
    pub fn document(&self) -> Document<'_> {
        let probes = Rows::of(&self.probes).text("probe", |p| &p.probe).text("unit", |p| &p.unit).nested(
            "curves",
            |p| &p.curves,
            |rows| {
                rows.text("case", |c| &c.case)
                    .number("largest_rpm", "rpm", |c| c.largest[0])
                    .number("largest_amplitude", "", |c| c.largest[1])
                    .nested(
                        "peaks",
                        |c| &c.peaks,
                        |rows| {
                            rows.number("rpm", "rpm", |p| p.rpm)
                                .number("amplitude", "", |p| p.amplitude)
                                .optional("amplification_factor", "1", |p| p.amplification)
                        },
                    )
                    .nested(
                        "points",
                        |c| &c.points,
                        |rows| {
                            rows.number("rpm", "rpm", |p| p.rpm)
                                .number("amplitude", "", |p| p.amplitude)
                                .number("phase_deg", "deg", |p| p.phase_deg)
                        },
                    )
            },
        );
        Document::new().table("probes", probes).texts("left_out", &self.left_out)
    }
}

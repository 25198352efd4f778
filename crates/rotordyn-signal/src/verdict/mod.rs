//! What a record says of a bearing: the damaged part with its probability, rivals, and lines left unexplained.

mod contest;
mod grade;
mod line_spectrum;
mod part_fit;
mod rival_kind;
mod rivals;
mod shaft_speed;
mod strong_lines;

use serde::{Deserialize, Serialize};

use super::bearing_lines::{BearingPart, DefectFrequencies, LineSettings};
use super::spectrum::Spectrum;
use contest::{Contest, contest};
pub use grade::{COEFFICIENTS, FEATURE_COUNT, Features};
use line_spectrum::LineSpectrum;
pub use rival_kind::RivalKind;
pub use rivals::Rival;
pub use shaft_speed::{RecordSpeed, SpeedFinding, shaft_speed};
pub use strong_lines::{Explanation, StrongLine};
use strong_lines::strong_lines;

/// Probability from which a part is named.
const NAMED: f64 = 0.5;
/// Harmonic of the highest defect frequency up to which a spectrum is looked at.
const LAST_HARMONIC: f64 = 5.3;
/// Probability below which a part is not mentioned.
const MENTIONED: f64 = 0.2;

/// What is said of a record.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Finding {
    /// The named part is damaged.
    Part(BearingPart),
    /// No bearing line, nor any other periodic family.
    NoFault,
    /// Impacts or modulation at a rate \[Hz, or order\] that is no line of the bearing.
    Periodic(f64),
    /// The record does not resolve the part's line \[Hz, or order\] from a rival's.
    Unresolved { part: BearingPart, frequency: f64, rival: Rival },
    /// Lines of this part stand, but too little speaks for it.
    Uncertain(BearingPart),
}

/// Diagnosis with its grade.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    pub finding: Finding,
    /// The part that fits best, named or not.
    pub candidate: BearingPart,
    /// Fitted defect frequency of the candidate \[Hz, or order\].
    pub frequency: f64,
    /// Probability that the candidate is the damaged part.
    pub probability: f64,
    /// What the probability was computed from.
    pub features: Features,
    /// Other families in the spectrum.
    pub rivals: Vec<Rival>,
    /// Every strong line of the spectrum with what explains it, the highest first.
    pub strong_lines: Vec<StrongLine>,
}

impl Verdict {
    /// The damaged part, if one is named.
    pub fn part(&self) -> Option<BearingPart> {
        match self.finding {
            Finding::Part(part) => Some(part),
            _ => None,
        }
    }

    /// "outer race, 98 %", "no bearing fault", "periodic at 12.42 Hz, no line of this bearing" or "cannot tell: …".
    ///
    /// `unit`: "Hz", or "x" for orders.
    pub fn statement(&self, unit: &str) -> String {
        match self.finding {
            Finding::Part(part) => format!("{}, {}", part.name(), percent(self.probability)),
            Finding::NoFault => "no bearing fault".into(),
            Finding::Periodic(rate) => {
                format!("periodic at {} {unit}, no line of this bearing", significant(rate))
            }
            Finding::Unresolved { part, frequency, rival } => {
                let (of, number) = (rival.name(), (frequency / rival.rate).round());
                format!(
                    "cannot tell: the record does not resolve {} ({} {unit}) from {number} x {of} ({} {unit})",
                    part.line_name(),
                    significant(frequency),
                    significant(rival.rate)
                )
            }
            Finding::Uncertain(part) => format!(
                "cannot tell: lines near {} do not suffice for a fault ({}, {})",
                part.line_name(),
                part.name(),
                percent(self.probability)
            ),
        }
    }
}

impl Rival {
    /// "shaft speed", "mains", "another source".
    pub fn name(&self) -> &'static str {
        match self.kind {
            RivalKind::Shaft => "shaft speed",
            RivalKind::Mains => "mains",
            RivalKind::Periodic => "another source",
        }
    }
}

/// "98 %"; never 100.
fn percent(probability: f64) -> String {
    if probability > 0.99 { "above 99 %".into() } else { format!("{:.0} %", 100.0 * probability) }
}

/// Four digits.
fn significant(value: f64) -> String {
    let digits = (3 - value.abs().max(1e-12).log10().floor() as i32).clamp(0, 6);
    format!("{value:.*}", digits as usize)
}

/// One band's contest, before the best band is chosen.
pub(crate) struct BandVerdict {
    spectrum: LineSpectrum,
    contest: Contest,
}

impl BandVerdict {
    /// Compares parts and rivals in an envelope spectrum of amplitudes.
    ///
    /// `hz_per_unit`: Hz per unit of the frequency axis, `None` if it varies (orders).
    pub fn new(
        spectrum: &Spectrum,
        rates: &DefectFrequencies,
        settings: &LineSettings,
        hz_per_unit: Option<f64>,
    ) -> Self {
        let end = Self::needed_range(rates, settings);
        let spectrum = LineSpectrum::new(&spectrum.up_to(end), rates.shaft, hz_per_unit);
        let contest = contest(&spectrum, rates, settings, hz_per_unit);
        BandVerdict { spectrum, contest }
    }

    /// Frequency up to which a spectrum is looked at.
    pub fn needed_range(rates: &DefectFrequencies, settings: &LineSettings) -> f64 {
        let highest = BearingPart::ALL.map(|part| part.defect_frequency(rates)).into_iter().fold(0.0, f64::max);
        LAST_HARMONIC * highest * (1.0 + settings.slip)
    }

    /// Rank of the band: ln(1 + evidence of the best part), less what stronger lines leave unexplained.
    pub fn score(&self) -> f64 {
        self.contest.score
    }

    /// What the band says.
    pub fn verdict(&self, rates: &DefectFrequencies) -> Verdict {
        let Contest { winner, rivals, features, unresolved, .. } = &self.contest;
        let probability = grade::probability(features);
        let free = rivals.iter().filter(|r| r.kind == RivalKind::Periodic);
        let finding = match (unresolved, free.max_by(|a, b| a.amplitude.total_cmp(&b.amplitude))) {
            _ if probability >= NAMED => Finding::Part(winner.part),
            (Some((part, frequency, rival)), _) => {
                Finding::Unresolved { part: *part, frequency: *frequency, rival: *rival }
            }
            _ if probability >= MENTIONED => Finding::Uncertain(winner.part),
            (None, Some(rival)) => Finding::Periodic(rival.rate),
            (None, None) => Finding::NoFault,
        };
        let named = (probability >= MENTIONED).then_some(winner);
        Verdict {
            finding,
            candidate: winner.part,
            frequency: winner.base,
            probability,
            features: *features,
            rivals: rivals.clone(),
            strong_lines: strong_lines(&self.spectrum, named, rivals, rates.shaft),
        }
    }
}

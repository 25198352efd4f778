//! Joint evidence of a family's lines in the spectrum of the squared envelope of its band.
//!
//! Impacts weaker than the noise rise over it for a moment only, which the square shows better than the magnitude does.
//! At the places of a family fitted before, lines too weak to be found one by one count together.

use super::super::bearing_lines::{BearingPart, DefectFrequencies};
use super::line_spectrum::{KnownLines, LineSpectrum};
use super::part_fit::{FittedLine, PartFit, offset};

/// Evidence of one line that counts fully in a sum: no line alone decides it.
const LIMIT: f64 = 12.0;
/// Highest harmonic that counts.
const LAST_HARMONIC: usize = 4;
/// Highest harmonic whose side bands count.
const LAST_WITH_SIDE_BANDS: usize = 3;

/// Joint evidence of the lines of a family that neither shaft, mains nor another family explains.
pub(super) struct JointEvidence {
    /// ln(1 + evidence of the first harmonic).
    pub first: f64,
    /// ln(1 + Σ (min(e, 12) − ē)) over the harmonics from the second to the fourth, and over the side
    /// bands of the first three: e evidence of a line, ē its mean over the spectrum, which is what chance gives; 0 for
    /// a negative sum. With e a log-likelihood ratio the sum is that of all its lines, which are independent in noise.
    pub harmonics: f64,
    pub side_bands: f64,
}

/// Evidence of a family, fitted to the envelope's spectrum, in that of the squared envelope.
///
/// 0 for the cage: its many harmonics stand one by one, and the sum added as many sure cages as it took away.
pub(super) fn joint_evidence(
    fit: &PartFit,
    squared: &LineSpectrum,
    rates: &DefectFrequencies,
    known: &KnownLines,
) -> JointEvidence {
    if fit.part == BearingPart::Cage {
        return JointEvidence { first: 0.0, harmonics: 0.0, side_bands: 0.0 };
    }
    let own = || fit.lines.iter().filter(|l| l.own && !known.contains(l.frequency));
    let evidence = |l: &FittedLine| {
        let shift = l.modulation.map_or(0.0, |m| offset(m, rates.shaft, fit.cage));
        squared.evidence(l.harmonic as f64 * fit.base + shift)
    };
    let mean = squared.mean_evidence(LIMIT);
    let sum = |counts: &dyn Fn(&FittedLine) -> bool| {
        let excess = own().filter(|l| counts(l)).map(|l| evidence(l).min(LIMIT) - mean);
        excess.sum::<f64>().max(0.0).ln_1p()
    };
    let first = own().find(|l| l.modulation.is_none() && l.harmonic == 1);
    JointEvidence {
        first: first.map_or(0.0, evidence).ln_1p(),
        harmonics: sum(&|l| l.modulation.is_none() && (2..=LAST_HARMONIC).contains(&l.harmonic)),
        side_bands: sum(&|l| l.modulation.is_some() && l.harmonic <= LAST_WITH_SIDE_BANDS),
    }
}

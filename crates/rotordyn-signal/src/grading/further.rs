//! Parts beside the named one that have lines of their own in the same spectrum: two faults in one bearing.

use super::super::bearing_lines::BearingPart;
use super::line_spectrum::LineSpectrum;
use super::part_fit::{FittedLine, PRESENT, PartFit};

/// Evidence of one of the first two harmonics, and number of lines, that make a further candidate; a cage, of which every
/// part may have the first few lines, has more.
const CLEAR: f64 = 30.0;
const LINES: usize = 3;
const CAGE_LINES: usize = 6;
/// Amplitude of its highest line over that of the named part from which it is no by-product.
const SHARE: f64 = 0.1;

/// Parts of `others` with lines that neither the named part, shaft, mains nor another source explain.
pub(super) fn further_parts<'a>(
    named: &PartFit,
    others: &'a [PartFit],
    spectrum: &LineSpectrum,
    shaft: f64,
) -> Vec<&'a PartFit> {
    let least = SHARE * named.own_amplitude();
    let is_left = |line: &&FittedLine| {
        line.own
            && line.evidence > PRESENT
            && !spectrum.known.contains(line.frequency)
            && !named.explains(line.frequency, shaft, spectrum.step)
    };
    let stands = |fit: &&PartFit| {
        let left: Vec<&FittedLine> = fit.lines.iter().filter(is_left).collect();
        let is_clear = |l: &&FittedLine| {
            l.modulation.is_none() && l.harmonic <= 2 && l.evidence > CLEAR && l.amplitude >= least
        };
        let needed = if fit.part == BearingPart::Cage { CAGE_LINES } else { LINES };
        left.len() >= needed && left.iter().any(is_clear)
    };
    let mut found: Vec<&PartFit> = others.iter().filter(|fit| !fit.is_foreign).filter(stands).collect();
    found.sort_by(|a, b| b.own_amplitude().total_cmp(&a.own_amplitude()));
    found
}

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

#[cfg(test)]
mod tests {
    use super::super::super::bearing_lines::LineSettings;
    use super::super::super::spectrum::Spectrum;
    use super::*;

    const STEP: f64 = 0.2;

    /// Amplitudes of noise, √(−ln u), with lines of 2.5 times its mean square at harmonics 2, 3 and 4 of `base`.
    fn spectrum(seed: u64, base: Option<f64>) -> Spectrum {
        let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
        let mut noise = || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (-((state >> 11) as f64 / (1u64 << 53) as f64).max(1e-12).ln()).sqrt()
        };
        let mut values: Vec<f64> = (0..2600).map(|_| noise()).collect();
        for harmonic in 2..=4 {
            if let Some(base) = base {
                let bin = (f64::from(harmonic) * base / STEP).round() as usize;
                values[bin] = (values[bin].powi(2) + 2.5).sqrt();
            }
        }
        let frequencies = (0..values.len()).map(|k| k as f64 * STEP).collect();
        Spectrum { frequencies, values, noise_bandwidth_hz: 1.5 * STEP }
    }

    /// Three lines that are too weak to stand count together; noise does not.
    #[test]
    fn weak_lines_at_the_places_of_a_family_count_together() {
        let rates = DefectFrequencies { shaft: 20.3, cage: 7.9, outer: 71.2, inner: 111.5, ball: 47.7 };
        let settings = LineSettings::default();
        let known = KnownLines::new(rates.shaft, Some(1.0), STEP, Vec::new());
        let mean = |part: BearingPart, with_lines: bool| {
            let of = |seed: u64| {
                let plain = LineSpectrum::new(&spectrum(seed, None), rates.shaft, Some(1.0), None);
                let fit = PartFit::new(&plain, part, &rates, &settings);
                let other = spectrum(seed + 1000, with_lines.then_some(fit.base));
                joint_evidence(&fit, &LineSpectrum::new(&other, rates.shaft, Some(1.0), None), &rates, &known)
            };
            let all: Vec<JointEvidence> = (1..=60).map(of).collect();
            let of = |value: fn(&JointEvidence) -> f64| all.iter().map(value).sum::<f64>() / 60.0;
            [of(|e| e.first), of(|e| e.harmonics), of(|e| e.side_bands)]
        };
        let [noise, lines] = [false, true].map(|with_lines| mean(BearingPart::OuterRace, with_lines));
        assert!(noise[1] < 0.7 && lines[1] > noise[1] + 0.7, "{noise:?} {lines:?}");
        assert!((noise[0] - lines[0]).abs() < 0.1 && lines[2] == 0.0, "{noise:?} {lines:?}");
        assert_eq!(mean(BearingPart::Cage, true), [0.0; 3]);
    }
}

//! Comparison of FRFs over cases of a machine, and with measured FRFs.

use super::{Machine, StudyError};
use crate::analysis::frf::derivative_factor;
use crate::analysis::peaks::parabola;
use crate::model::Quantity;
use crate::model::study::FrfStudy;
use crate::results::{CaseFrf, ComparedFrf, FrfComparison, FrfPeak, FrfPoint, FrfResult};
use rotordyn_linalg::Complex64;
use std::f64::consts::TAU;

/// Name of the measurement among the cases.
pub const MEASURED: &str = "measured";
/// A peak of an FRF rises by this factor above the higher of the valleys beside it (6 dB).
const PEAK_RISE: f64 = 2.0;
/// Peaks below this part of the highest are not listed (60 dB).
const LOWEST_PEAK: f64 = 1e-3;
/// Coherence below which a measured line is no peak.
const PEAK_COHERENCE: f64 = 0.8;
/// Largest difference of offsets \[m\] and direction cosines of one point in two cases.
const SAME: f64 = 1e-9;

/// A case of a machine with its FRFs.
pub struct FrfCase<'a> {
    pub name: &'a str,
    pub machine: &'a Machine,
    pub found: &'a FrfResult,
}

/// A measured FRF between two named points of the model.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredFrf {
    pub response: String,
    pub excitation: String,
    /// Frequencies \[Hz\].
    pub hz: Vec<f64>,
    pub values: Vec<Complex64>,
    /// Empty if not measured.
    pub coherence: Vec<f64>,
    pub quantity: Quantity,
}

/// FRFs of cases on common axes: those between a response and an excitation that two cases, or one case and the
/// measurement, have.
///
/// A measured FRF is converted to the quantity of the first case. FRAC and level compare each case with it at the
/// measured frequencies, computed anew there.
///
/// # Errors
/// A singular dynamic stiffness at a measured frequency.
pub fn compare_frfs(cases: &[FrfCase], measured: &[MeasuredFrf]) -> Result<FrfComparison, StudyError> {
    let Some(first) = cases.first() else { return Ok(FrfComparison::default()) };
    let quantity = first.found.frf.quantity;
    let mut ends: Vec<(&str, &str)> = Vec::new();
    for case in cases {
        let found = case.found;
        for end in found.excitations.iter().flat_map(|e| found.responses.iter().map(move |r| (&**r, &**e))) {
            if !ends.contains(&end) {
                ends.push(end);
            }
        }
    }
    let (mut pairs, mut left_out) = (Vec::new(), Vec::new());
    for (response, excitation) in ends {
        let mut reference: Option<(&FrfCase, usize, usize)> = None;
        let own = measured.iter().find(|m| m.response == response && m.excitation == excitation);
        let mut curves: Vec<CaseFrf> = own.map(|m| measured_curve(m, quantity)).into_iter().collect();
        for case in cases {
            let Some((r, e)) = place(case.found, response, excitation) else { continue };
            if !case.found.is_coupled(r, e) {
                continue;
            }
            let (other, ro, eo) = *reference.get_or_insert((case, r, e));
            if let Some(why) = difference(other, (ro, eo), case, (r, e)) {
                left_out.push(format!("{response}/{excitation} of {}: {why}", case.name));
                continue;
            }
            let mut curve = curve(case.name, case.found, r, e);
            if let Some(m) = own {
                let (own, computed) = (converted(m, quantity), at_measured(case, r, e, &m.hz)?);
                (curve.frac, curve.level_db) = (frac(&own, &computed), level_db(&own, &computed));
            }
            curves.push(curve);
        }
        if let Some((case, r, e)) = reference.filter(|_| curves.len() > 1) {
            let (response, excitation) = (response.to_string(), excitation.to_string());
            pairs.push(ComparedFrf { response, excitation, unit: case.found.units[r][e].clone(), curves });
        }
    }
    Ok(FrfComparison { quantity: first.found.name().into(), pairs, left_out })
}

fn place(found: &FrfResult, response: &str, excitation: &str) -> Option<(usize, usize)> {
    let r = found.responses.iter().position(|name| name == response)?;
    let e = found.excitations.iter().position(|name| name == excitation)?;
    Some((r, e))
}

/// Why FRFs of the same name cannot be compared, if so.
fn difference(
    a: &FrfCase,
    (ra, ea): (usize, usize),
    b: &FrfCase,
    (rb, eb): (usize, usize),
) -> Option<String> {
    let (unit, other) = (&a.found.units[ra][ea], &b.found.units[rb][eb]);
    if unit != other {
        return Some(format!("in {other}, in {} in {unit}", a.name));
    }
    let ends = |case: &FrfCase, r: usize, e: usize| {
        let study = case.machine.model.studies.frf.as_ref()?;
        let (response, excitation) = (study.responses.get(r)?, study.excitations.get(e)?);
        Some([(response.at.offset, response.direction), (excitation.at.offset, excitation.direction)])
    };
    let (own, other) = (ends(a, ra, ea)?, ends(b, rb, eb)?);
    let same = own.iter().zip(&other).all(|(a, b)| near(&a.0, &b.0) && near(&a.1, &b.1));
    (!same).then(|| format!("its point or direction is not that of {}", a.name))
}

/// Whether two offsets or two directions are the same.
pub(super) fn near(a: &[f64], b: &[f64]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= SAME)
}

fn curve(case: &str, found: &FrfResult, r: usize, e: usize) -> CaseFrf {
    // An undamped peak is infinite: no point of the curve.
    let points: Vec<FrfPoint> = found
        .frf
        .frequencies
        .iter()
        .zip(&found.frf.values[r][e])
        .filter(|(_, h)| h.re.is_finite())
        .map(|(hz, h)| FrfPoint { hz: *hz, value: *h, coherence: None })
        .collect();
    let peaks = frf_peaks(&points);
    CaseFrf { case: case.into(), points, peaks, frac: None, level_db: None }
}

/// Values of a measured FRF in another quantity, by powers of jω.
fn converted(measured: &MeasuredFrf, quantity: Quantity) -> Vec<Complex64> {
    let factor = |hz: f64| {
        let omega = TAU * hz;
        derivative_factor(quantity, omega) / derivative_factor(measured.quantity, omega)
    };
    measured.hz.iter().zip(&measured.values).map(|(hz, h)| h * factor(*hz)).collect()
}

fn measured_curve(measured: &MeasuredFrf, quantity: Quantity) -> CaseFrf {
    let values = converted(measured, quantity);
    let points: Vec<FrfPoint> = (measured.hz.iter().zip(values).enumerate())
        .map(|(k, (hz, value))| FrfPoint { hz: *hz, value, coherence: measured.coherence.get(k).copied() })
        // A receptance has no value from an accelerance at 0 Hz.
        .filter(|p| is_finite(&p.value))
        .collect();
    let peaks = frf_peaks(&points);
    CaseFrf { case: MEASURED.into(), points, peaks, frac: None, level_db: None }
}

/// FRF of a case at the measured frequencies.
fn at_measured(case: &FrfCase, r: usize, e: usize, hz: &[f64]) -> Result<Vec<Complex64>, StudyError> {
    let Some(study) = &case.machine.model.studies.frf else { return Ok(Vec::new()) };
    let study = FrfStudy {
        frequencies: hz.to_vec(),
        refine: false,
        excitations: vec![study.excitations[e].clone()],
        responses: vec![study.responses[r].clone()],
        ..study.clone()
    };
    let found = case.machine.frf(&study)?.at_requested();
    Ok(found.frf.values.into_iter().flatten().next().unwrap_or_default())
}

fn is_finite(h: &Complex64) -> bool {
    h.re.is_finite() && h.im.is_finite()
}

/// Pairs of values that are both finite.
fn known(a: &[Complex64], b: &[Complex64]) -> Vec<(Complex64, Complex64)> {
    let pairs = a.iter().zip(b).filter(|(a, b)| is_finite(a) && is_finite(b));
    pairs.map(|(a, b)| (*a, *b)).collect()
}

/// FRAC |Σ a* b|² / (Σ|a|² Σ|b|²). Source: Heylen & Lammens, IMAC 14 (1996).
fn frac(a: &[Complex64], b: &[Complex64]) -> Option<f64> {
    let (mut product, mut own, mut other) = (Complex64::default(), 0.0, 0.0);
    for (a, b) in known(a, b) {
        product += a.conj() * b;
        own += a.norm_sqr();
        other += b.norm_sqr();
    }
    let size = own * other;
    (size > 0.0).then(|| product.norm_sqr() / size)
}

/// Mean of 20 lg |b|/|a| \[dB\].
fn level_db(a: &[Complex64], b: &[Complex64]) -> Option<f64> {
    let both = known(a, b).into_iter().map(|(a, b)| (a.norm_sqr(), b.norm_sqr()));
    let levels: Vec<f64> =
        both.filter(|(a, b)| *a > 0.0 && *b > 0.0).map(|(a, b)| 10.0 * (b / a).log10()).collect();
    (!levels.is_empty()).then(|| levels.iter().sum::<f64>() / levels.len() as f64)
}

/// Maxima of the magnitude that rise by 6 dB above the higher of the valleys beside them, down to 60 dB below the
/// highest; the ends of the range excluded.
fn frf_peaks(points: &[FrfPoint]) -> Vec<FrfPeak> {
    let hz: Vec<f64> = points.iter().map(|p| p.hz).collect();
    let size: Vec<f64> = points.iter().map(|p| p.value.norm()).collect();
    let highest = size.iter().copied().fold(0.0, f64::max);
    let mut found = Vec::new();
    for k in 1..size.len().saturating_sub(1) {
        let top = size[k];
        let is_peak = top > size[k - 1] && top >= size[k + 1] && top >= LOWEST_PEAK * highest;
        if !is_peak || points[k].coherence.is_some_and(|c| c < PEAK_COHERENCE) {
            continue;
        }
        let valley =
            |side: &mut dyn Iterator<Item = f64>| side.take_while(|value| *value <= top).fold(top, f64::min);
        let below = valley(&mut size[..k].iter().rev().copied());
        let above = valley(&mut size[k + 1..].iter().copied());
        if top >= PEAK_RISE * below.max(above) {
            let at = [k - 1, k, k + 1];
            let (hz, magnitude) = parabola(at.map(|k| hz[k]), at.map(|k| size[k]));
            found.push(FrfPeak { hz, magnitude });
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(of: impl Fn(f64) -> Complex64) -> Vec<FrfPoint> {
        let hz = (1..2000).map(|k| 0.1 * f64::from(k));
        hz.map(|hz| FrfPoint { hz, value: of(hz), coherence: None }).collect()
    }

    /// Receptance of one mode, 1/(f0² − f² + 2jζ f0 f).
    fn mode(f0: f64, zeta: f64, hz: f64) -> Complex64 {
        1.0 / Complex64::new(f0 * f0 - hz * hz, 2.0 * zeta * f0 * hz)
    }

    #[test]
    fn peaks_are_those_of_the_modes() {
        let found = frf_peaks(&points(|hz| mode(40.0, 0.01, hz) + mode(120.0, 0.02, hz)));
        assert_eq!(found.len(), 2, "{found:?}");
        for (peak, f0, zeta) in [(found[0], 40.0, 0.01), (found[1], 120.0, 0.02f64)] {
            let expected = f0 * (1.0 - 2.0 * zeta * zeta).sqrt();
            assert!((peak.hz / expected - 1.0).abs() < 1e-3, "{peak:?} {expected}");
        }
        assert!(frf_peaks(&points(|hz| mode(300.0, 0.01, hz))).is_empty());
    }

    #[test]
    fn an_accelerance_is_converted_to_a_receptance() {
        let hz = vec![10.0, 50.0, 200.0];
        let receptance: Vec<Complex64> = hz.iter().map(|hz| mode(40.0, 0.05, *hz)).collect();
        let to = |hz: f64| -(TAU * hz).powi(2);
        let measured = MeasuredFrf {
            response: "r".into(),
            excitation: "e".into(),
            values: hz.iter().zip(&receptance).map(|(hz, h)| h * to(*hz)).collect(),
            hz,
            coherence: Vec::new(),
            quantity: Quantity::Acceleration,
        };
        let found = converted(&measured, Quantity::Displacement);
        for (a, b) in found.iter().zip(&receptance) {
            assert!((a - b).norm() < 1e-12 * b.norm());
        }
        let doubled: Vec<Complex64> = receptance.iter().map(|h| 2.0 * h).collect();
        assert!((frac(&receptance, &doubled).unwrap() - 1.0).abs() < 1e-12);
        assert!((level_db(&receptance, &doubled).unwrap() - 20.0 * 2f64.log10()).abs() < 1e-9);
    }
}

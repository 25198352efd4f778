//! Measured FRFs as data: which lines are fitted, and what each is worth.

use rayon::prelude::*;

use super::residual::Rows;
use super::state::State;
use super::target::{Sensor, TargetFrfs};
use crate::analysis::sensitivity::{FrfSensitivity, SystemDerivative, frf_sensitivity};
use crate::error::Error;
use crate::linalg::{Complex64, SparseRow};

/// How FRFs are fitted.
///
/// A line gives ln|H_computed/H_measured|, and with `complex` their difference in phase \[rad\] beside it; for small errors
/// the two are the complex difference over |H|. Logarithms let resonances and antiresonances count alike and grow
/// evenly as they part, so that a fit finds its way from housings twice too stiff. Both |H| have 2 % of the largest
/// response to the same force added in squares, a: sensors answer across and hits are askew, and no test knows an
/// antiresonance or a plane that the force hardly moves any better.
///
/// A line's variance is n σ² + (1 − γ²)/(2 γ²). The first part is what a good model leaves: it is shared by neighbouring
/// lines and by all FRFs, which meet the same resonance, so that the n numbers within a fifth of a frequency are worth
/// one, however fine the lines. The second is the scatter of one average by the coherence γ²; how many were taken no
/// file tells, so that this is the most it can be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrfFitting {
    pub complex: bool,
    /// σ of ln|H| and of the phase.
    pub deviation: f64,
    /// Band \[Hz\].
    pub band: [f64; 2],
}

/// σ where the user states none, about 1 dB: what a damping that is known to a tenth leaves at a resonance.
pub const DEFAULT_DEVIATION: f64 = 0.1;

impl FrfFitting {
    /// FRFs of a band as they are.
    pub fn new(complex: bool, band: [f64; 2]) -> Self {
        Self { complex, deviation: DEFAULT_DEVIATION, band }
    }
}

/// Lines below this coherence tell more of the noise than of the machine: its floor would be taken for the FRF.
const LEAST_COHERENCE: f64 = 0.5;
/// Part of the largest response that shows in every other.
const ACROSS: f64 = 0.02;
/// Part of a frequency over which lines share the model's error.
const SHARED: f64 = 0.2;
/// Lines that are fitted at most.
const MOST_LINES: usize = 300;

/// Rows of the FRFs, with their derivatives.
///
/// # Errors
/// A singular dynamic stiffness.
pub(super) fn frf_rows(
    state: &State,
    measured: &TargetFrfs,
    fitting: &FrfFitting,
    by: &[&SystemDerivative],
    rows: &mut Rows,
) -> Result<(), Error> {
    let lines = lines(measured, fitting.band);
    let found = computed(state, measured, &lines, by)?;
    let shared = shared(measured, &lines, fitting.complex);
    for (r, e) in pairs(measured) {
        for (k, &line) in lines.iter().enumerate().filter(|(_, line)| tells(measured, r, e, **line)) {
            let seen = Seen::new(found.values[r][e][k], measured.values[r][e][line], {
                ACROSS * largest(measured, r, e, line)
            });
            let model = fitting.deviation.powi(2);
            let noise = scatter(measured, r, e, line) * seen.share;
            let variance = shared[k] * model + noise;
            let size = variance.sqrt();
            rows.data += (model + noise) / variance * if fitting.complex { 2.0 } else { 1.0 };
            let slopes = || found.slopes.iter().map(|s| s[r][e][k]);
            rows.push(seen.magnitude() / size, slopes().map(|s| seen.magnitude_slope(s) / size));
            if fitting.complex {
                let (apart, slope) = (seen.apart() / size, |s| seen.apart_slope(s) / size);
                rows.push(apart.re, slopes().map(|s| slope(s).re));
                rows.push(apart.im, slopes().map(|s| slope(s).im));
            }
        }
    }
    Ok(())
}

/// Computed h and measured m at a line, as a test sees them that adds a of what other directions do.
struct Seen {
    h: Complex64,
    /// √(|h|² + a²).
    size: f64,
    /// m/√(|m|² + a²).
    measured: Complex64,
    /// √(|m|² + a²).
    measured_size: f64,
    /// |m|²/(|m|² + a²).
    share: f64,
}

impl Seen {
    fn new(h: Complex64, m: Complex64, a: f64) -> Self {
        let [size, measured_size] = [h, m].map(|v| v.norm().hypot(a));
        let measured = m / measured_size;
        Self { h, size, measured, measured_size, share: measured.norm_sqr() }
    }

    /// ln √(|h|² + a²)/√(|m|² + a²).
    fn magnitude(&self) -> f64 {
        (self.size / self.measured_size).ln()
    }

    fn magnitude_slope(&self, slope: Complex64) -> f64 {
        (self.h.conj() * slope).re / self.size.powi(2)
    }

    /// h/√(|h|² + a²) − m/√(|m|² + a²), turned to m: 2 sin Δφ/2 across where both stand out of a.
    fn apart(&self) -> Complex64 {
        (self.h / self.size - self.measured) * self.turn()
    }

    fn apart_slope(&self, slope: Complex64) -> Complex64 {
        (slope - self.h * self.magnitude_slope(slope)) / self.size * self.turn()
    }

    fn turn(&self) -> Complex64 {
        self.measured.conj() / self.measured.norm()
    }
}

/// Numbers that the FRFs give to a fit.
pub(super) fn count(measured: &TargetFrfs, fitting: &FrfFitting) -> usize {
    let lines = lines(measured, fitting.band);
    let of = |k: &usize| pairs(measured).filter(|&(r, e)| tells(measured, r, e, *k)).count();
    lines.iter().map(of).sum::<usize>() * if fitting.complex { 2 } else { 1 }
}

/// RMS of 20 log(|H_computed|/|H_measured|) \[dB\] over the lines that are fitted; `computed` is over all lines.
pub fn decibels_apart(measured: &TargetFrfs, computed: &[Vec<Vec<Complex64>>], fitting: &FrfFitting) -> f64 {
    let lines = lines(measured, fitting.band);
    let (mut sum, mut count) = (0.0, 0);
    for (r, e, &line) in pairs(measured).flat_map(|(r, e)| lines.iter().map(move |line| (r, e, line))) {
        if tells(measured, r, e, line) {
            let a = ACROSS * largest(measured, r, e, line);
            let apart = Seen::new(computed[r][e][line], measured.values[r][e][line], a).magnitude();
            sum += (20.0 * std::f64::consts::LOG10_E * apart).powi(2);
            count += 1;
        }
    }
    (sum / f64::from(count.max(1))).sqrt()
}

/// Every response with every reference.
fn pairs(measured: &TargetFrfs) -> impl Iterator<Item = (usize, usize)> + use<> {
    let references = measured.references.len();
    (0..measured.responses.len()).flat_map(move |r| (0..references).map(move |e| (r, e)))
}

/// The model's FRFs at some of the measured lines, chunk by chunk.
fn computed(
    state: &State,
    measured: &TargetFrfs,
    lines: &[usize],
    by: &[&SystemDerivative],
) -> Result<FrfSensitivity, Error> {
    const CHUNK: usize = 32;
    let of = |sensors: &[Sensor]| -> Vec<SparseRow> {
        sensors.iter().map(|s| s.row(&state.linear.assembly)).collect()
    };
    let (responses, references) = (of(&measured.responses), of(&measured.references));
    let frequencies: Vec<f64> = lines.iter().map(|&k| measured.frequencies[k]).collect();
    let parts: Vec<FrfSensitivity> = frequencies
        .par_chunks(CHUNK)
        .map(|f| frf_sensitivity(&state.linear, f, &references, &responses, &measured.quantities, by))
        .collect::<Result<_, _>>()?;
    let joined = |of: &dyn Fn(&FrfSensitivity, usize, usize) -> Vec<Complex64>| -> Vec<Vec<Vec<Complex64>>> {
        let one = |r: usize, e: usize| parts.iter().flat_map(|p| of(p, r, e)).collect();
        (0..responses.len()).map(|r| (0..references.len()).map(|e| one(r, e)).collect()).collect()
    };
    Ok(FrfSensitivity {
        values: joined(&|p, r, e| p.values[r][e].clone()),
        slopes: (0..by.len()).map(|k| joined(&|p, r, e| p.slopes[k][r][e].clone())).collect(),
    })
}

/// Whether a line of an FRF is there and stands out of its noise.
fn tells(measured: &TargetFrfs, r: usize, e: usize, line: usize) -> bool {
    let clear = measured.coherence.as_ref().is_none_or(|c| c[r][e][line] >= LEAST_COHERENCE);
    clear && measured.values[r][e][line].norm_sqr() > 0.0
}

/// Largest |H| at a line by the same force, of responses of the same kind.
fn largest(measured: &TargetFrfs, r: usize, e: usize, line: usize) -> f64 {
    let turns = |r: usize| measured.responses[r].direction[3..].iter().any(|d| *d != 0.0);
    let kind = |r: usize| (measured.quantities[r], turns(r));
    let alike = (0..measured.responses.len()).filter(|&other| kind(other) == kind(r));
    alike.map(|other| measured.values[other][e][line].norm()).fold(0.0, f64::max)
}

/// Variance of ln|H| and of the phase by the coherence of one average; 0 where it was not measured.
fn scatter(measured: &TargetFrfs, r: usize, e: usize, line: usize) -> f64 {
    measured.coherence.as_ref().map_or(0.0, |c| {
        let coherence = c[r][e][line].clamp(LEAST_COHERENCE, 1.0);
        (1.0 - coherence) / (2.0 * coherence)
    })
}

/// Numbers within a fifth of every line's frequency.
fn shared(measured: &TargetFrfs, lines: &[usize], complex: bool) -> Vec<f64> {
    let at = |line: usize| {
        pairs(measured).filter(|&(r, e)| tells(measured, r, e, line)).count() as f64
            * if complex { 2.0 } else { 1.0 }
    };
    let counts: Vec<f64> = lines.iter().map(|&line| at(line)).collect();
    let log: Vec<f64> = lines.iter().map(|&line| measured.frequencies[line].ln()).collect();
    log.iter()
        .map(|centre| {
            let near = |other: &f64| (other - centre).abs() <= 0.5 * SHARED;
            let sum: f64 = log.iter().zip(&counts).filter(|(l, _)| near(l)).map(|(_, n)| n).sum();
            sum.max(1.0)
        })
        .collect()
}

/// Lines within the band: all, or where there are many, half of them evenly and half where magnitudes change most, which
/// is about resonances and antiresonances.
fn lines(measured: &TargetFrfs, [from, to]: [f64; 2]) -> Vec<usize> {
    let all: Vec<usize> = (0..measured.frequencies.len())
        .filter(|&k| (from..=to).contains(&measured.frequencies[k]) && measured.frequencies[k] > 0.0)
        .collect();
    if all.len() <= MOST_LINES {
        return all;
    }
    let change = |pair: &[usize]| {
        let mut sum = 0.0;
        for (r, e) in pairs(measured).filter(|&(r, e)| pair.iter().all(|&k| tells(measured, r, e, k))) {
            let [a, b] = [pair[0], pair[1]].map(|k| measured.values[r][e][k].norm());
            sum += (b / a).ln().abs();
        }
        sum
    };
    let changes: Vec<f64> = all.windows(2).map(change).collect();
    let total = changes.iter().sum::<f64>().max(f64::MIN_POSITIVE);
    let even = 1.0 / changes.len() as f64;
    let mut out = vec![all[0]];
    let (mut passed, mut next) = (0.0, 1.0);
    for (change, &line) in changes.iter().zip(&all[1..]) {
        passed += 0.5 * (even + change / total) * (MOST_LINES - 1) as f64;
        if passed >= next - 1e-9 {
            out.push(line);
            next = passed.floor() + 1.0;
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slopes_are_those_of_differences_at_a_zero_too() {
        let c = Complex64::new;
        for h in [c(3.0, -2.0), c(1e-3, 2e-3), c(0.0, 0.0)] {
            let (m, a, slope, step) = (c(-0.2, 0.5), 0.1, c(0.7, -0.4), 1e-6);
            let [low, here, high] = [-step, 0.0, step].map(|x| Seen::new(h + slope * x, m, a));
            let magnitude = (high.magnitude() - low.magnitude()) / (2.0 * step);
            assert!((here.magnitude_slope(slope) - magnitude).abs() < 1e-7);
            let apart = (high.apart() - low.apart()) / (2.0 * step);
            assert!((here.apart_slope(slope) - apart).norm() < 1e-7);
        }
        let (seen, turned) =
            (Seen::new(c(0.0, 2.0), c(2.0, 0.0), 1e-9), 2.0 * (0.25 * std::f64::consts::PI).sin());
        assert!((seen.apart().norm() - turned).abs() < 1e-12 && seen.magnitude().abs() < 1e-12);
    }

    #[test]
    fn many_lines_are_thinned_about_resonances() {
        let frequencies: Vec<f64> = (0..4000).map(|k| 0.1 * f64::from(k)).collect();
        let h = |f: f64| 1.0 / Complex64::new(2500.0 - f * f, 2.0 * 0.005 * 50.0 * f);
        let point = |direction| Sensor {
            dof: crate::signal::record::Dof::new(1, direction),
            at: crate::element::Anchor::node(0),
            direction: [1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        };
        let measured = TargetFrfs {
            responses: vec![point(1)],
            references: vec![point(1)],
            quantities: vec![crate::model::Quantity::Displacement],
            values: vec![vec![frequencies.iter().map(|f| h(*f)).collect()]],
            coherence: None,
            frequencies,
        };
        let chosen = lines(&measured, [5.0, 300.0]);
        assert!((250..=MOST_LINES).contains(&chosen.len()), "{}", chosen.len());
        let within = |low: f64, high: f64| {
            chosen.iter().filter(|&&k| (low..=high).contains(&measured.frequencies[k])).count()
        };
        // The upper half of the peak takes a sixth of all that ln|H| rises and falls by; 1 Hz elsewhere one half line.
        assert!(within(49.5, 50.5) >= 10 && within(200.0, 210.0) >= 5, "{chosen:?}");
        let few = TargetFrfs { frequencies: measured.frequencies[..200].to_vec(), ..measured.clone() };
        assert_eq!(lines(&few, [5.0, 300.0]).len(), 150);
    }
}

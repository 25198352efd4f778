//! Peaks of a response over speed: amplification factor and separation margin.

use serde::{Deserialize, Serialize};

/// Fraction of a peak's amplitude at its half-power points, 1/√2.
const HALF_POWER: f64 = std::f64::consts::FRAC_1_SQRT_2;
/// A peak falls at least to this fraction of its amplitude on both sides before a higher one follows.
const VALLEY: f64 = 0.95;
/// Amplification factor below which a peak counts as critically damped.
pub const CRITICALLY_DAMPED: f64 = 2.5;
/// Largest separation margin that API 617 requires below, and among and above the operating speeds.
pub const LARGEST_REQUIRED: [f64; 2] = [0.16, 0.26];

/// A resonance peak of an amplitude over speed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Peak {
    /// N_c: speed of the peak, in the unit of the speeds.
    pub at: f64,
    /// Amplitude there.
    pub amplitude: f64,
    /// N_1 and N_2: speeds with 0.707 of the amplitude below and above; `None` if it does not fall that far.
    pub half_power: Option<[f64; 2]>,
}

impl Peak {
    /// Amplification factor AF = N_c/(N_2 − N_1).
    ///
    /// Source: API 617 and API 684, SP 6.8.2.1.
    pub fn amplification(&self) -> Option<f64> {
        self.half_power.map(|[low, high]| self.at / (high - low))
    }

    /// Separation margin from the operating speeds, as [`separation`].
    pub fn separation(&self, operating: [f64; 2]) -> f64 {
        separation(self.at, operating)
    }

    /// Separation margin required by API 617, as [`required_separation`]; `None` without an amplification factor.
    pub fn required_separation(&self, operating: [f64; 2]) -> Option<f64> {
        Some(required_separation(self.at, self.amplification()?, operating))
    }
}

/// Separation margin of a critical speed N_c from operating speeds N_min to N_max: (N_min − N_c)/N_min below them,
/// (N_c − N_max)/N_max above them, 0 among them.
///
/// Source: API 617 and API 684, SP 6.8.2.10.
pub fn separation(critical: f64, [lowest, highest]: [f64; 2]) -> f64 {
    if critical < lowest {
        (lowest - critical) / lowest
    } else if critical > highest {
        (critical - highest) / highest
    } else {
        0.0
    }
}

/// Separation margin required by API 617: 0 for AF < 2.5, else 17 % (1 − 1/(AF − 1.5)) up to 16 % below the
/// operating speeds, 10 % more among and above them.
///
/// Source: API 617 and API 684, SP 6.8.2.10.
pub fn required_separation(critical: f64, factor: f64, [lowest, _]: [f64; 2]) -> f64 {
    if factor < CRITICALLY_DAMPED {
        return 0.0;
    }
    let margin = 0.17 * (1.0 - 1.0 / (factor - 1.5));
    let [below, above] = LARGEST_REQUIRED;
    if critical < lowest { margin.min(below) } else { (0.1 + margin).min(above) }
}

/// Peaks of an amplitude over increasing speeds, the ends of the range excluded.
///
/// Each is a maximum from which the amplitude falls by 5 % on both sides before it becomes higher. Between the
/// points a parabola gives the maximum, straight lines the half-power points.
pub fn peaks(speeds: &[f64], amplitudes: &[f64]) -> Vec<Peak> {
    let n = speeds.len().min(amplitudes.len());
    let mut found = Vec::new();
    for i in 1..n.saturating_sub(1) {
        let top = amplitudes[i];
        if !(top.is_finite() && top > amplitudes[i - 1] && top >= amplitudes[i + 1]) {
            continue;
        }
        let (before, after) = ((0..i).rev(), i + 1..n);
        let falls = |mut side: Box<dyn Iterator<Item = usize>>| {
            side.find(|&k| !(VALLEY * top..=top).contains(&amplitudes[k]))
                .is_some_and(|k| amplitudes[k] < top)
        };
        if !falls(Box::new(before.clone())) || !falls(Box::new(after.clone())) {
            continue;
        }
        let (at, amplitude) = parabola(
            [speeds[i - 1], speeds[i], speeds[i + 1]],
            [amplitudes[i - 1], amplitudes[i], amplitudes[i + 1]],
        );
        let level = HALF_POWER * amplitude;
        // The first point below the level, unless a higher peak comes first.
        let below = |mut side: Box<dyn Iterator<Item = usize>>| {
            side.find(|&k| amplitudes[k] < level || amplitudes[k] > top).filter(|&k| amplitudes[k] < level)
        };
        let crossing = |inside: usize, outside: usize| {
            let part = (amplitudes[inside] - level) / (amplitudes[inside] - amplitudes[outside]);
            speeds[inside] + part * (speeds[outside] - speeds[inside])
        };
        let half_power = below(Box::new(before))
            .zip(below(Box::new(after)))
            .map(|(low, high)| [crossing(low + 1, low), crossing(high - 1, high)]);
        found.push(Peak { at, amplitude, half_power });
    }
    found
}

/// Maximum of the parabola through three points, the middle one highest.
pub(crate) fn parabola(x: [f64; 3], y: [f64; 3]) -> (f64, f64) {
    let (left, right) = ((y[1] - y[0]) / (x[1] - x[0]), (y[2] - y[1]) / (x[2] - x[1]));
    let curvature = (right - left) / (x[2] - x[0]);
    if curvature >= 0.0 {
        return (x[1], y[1]);
    }
    // Slope of the parabola in the middle point.
    let slope = left + curvature * (x[1] - x[0]);
    let shift = (-0.5 * slope / curvature).clamp(x[0] - x[1], x[2] - x[1]);
    (x[1] + shift, y[1] + shift * (slope + curvature * shift))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Amplitude of one mode with unbalance, r²/√((1 − r²)² + (2ζr)²).
    fn curve(zeta: f64, count: usize) -> (Vec<f64>, Vec<f64>) {
        let r: Vec<f64> = (0..count).map(|k| 2.0 * k as f64 / (count - 1) as f64).collect();
        let a = r.iter().map(|r| r * r / ((1.0 - r * r).powi(2) + (2.0 * zeta * r).powi(2)).sqrt()).collect();
        (r, a)
    }

    #[test]
    fn one_mode_has_its_closed_form_peak_and_amplification() {
        for zeta in [0.005, 0.02, 0.1] {
            let (r, a) = curve(zeta, 20_001);
            let found = peaks(&r, &a);
            assert_eq!(found.len(), 1);
            let peak = found[0];
            let (at, amplitude) =
                (1.0 / (1.0 - 2.0 * zeta * zeta).sqrt(), 0.5 / zeta / (1.0 - zeta * zeta).sqrt());
            assert!((peak.at / at - 1.0).abs() < 1e-5 && (peak.amplitude / amplitude - 1.0).abs() < 1e-5);
            // r² = s solves (1 − 2/A²) s² − (2 − 4ζ²) s + 1 = 0 at A/√2.
            let (p, q) = (1.0 - 2.0 / (amplitude * amplitude), 1.0 - 2.0 * zeta * zeta);
            let root = |sign: f64| ((q + sign * (q * q - p).sqrt()) / p).sqrt();
            let factor = at / (root(1.0) - root(-1.0));
            assert!((peak.amplification().unwrap() / factor - 1.0).abs() < 1e-3, "{peak:?} {factor}");
        }
    }

    #[test]
    fn margins_of_api_617() {
        let peak = |at: f64, factor: f64| Peak {
            at,
            amplitude: 1.0,
            half_power: Some([at - 0.5 * at / factor, at + 0.5 * at / factor]),
        };
        let close = |a: Option<f64>, b: f64| assert!((a.unwrap() - b).abs() < 1e-12, "{a:?} {b}");
        close(peak(80.0, 2.4).required_separation([100.0; 2]), 0.0);
        close(peak(80.0, 3.5).required_separation([100.0; 2]), 0.085);
        close(peak(130.0, 3.5).required_separation([100.0; 2]), 0.185);
        close(peak(80.0, 100.0).required_separation([100.0; 2]), 0.16);
        close(peak(130.0, 100.0).required_separation([100.0; 2]), 0.26);
        close(Some(peak(80.0, 9.0).separation([100.0; 2])), 0.2);
        // Among the operating speeds there is no margin; below and above them it is that from the nearer end.
        close(Some(peak(95.0, 9.0).separation([90.0, 110.0])), 0.0);
        close(peak(95.0, 3.5).required_separation([90.0, 110.0]), 0.185);
        close(Some(peak(72.0, 9.0).separation([90.0, 110.0])), 0.2);
        close(Some(peak(132.0, 9.0).separation([90.0, 110.0])), 0.2);
        assert!(Peak { at: 1.0, amplitude: 1.0, half_power: None }.required_separation([2.0; 2]).is_none());
    }

    #[test]
    fn ripples_ends_and_shoulders_are_no_peaks() {
        let x: Vec<f64> = (0..8).map(f64::from).collect();
        assert!(peaks(&x, &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]).is_empty());
        let found = peaks(&x, &[0.0, 5.0, 4.9, 5.1, 1.0, 4.0, 3.9, 4.05]);
        assert_eq!(found.len(), 1, "{found:?}");
        assert!((found[0].at - 3.0).abs() < 0.5 && found[0].half_power.is_some());
        // A plateau that falls to less than 0.707 on one side only.
        assert!(peaks(&x, &[0.0, 5.0, 4.5, 4.4, 4.4, 4.4, 4.4, 4.4])[0].half_power.is_none());
    }
}

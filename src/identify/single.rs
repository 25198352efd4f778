//! Circle and peak fit: one mode from one FRF, a quick look beside the poly-reference fit.

use std::f64::consts::TAU;

use nalgebra::{Matrix3, Vector3};

use crate::linalg::Complex64;
use crate::model::Quantity;

/// One mode from one FRF.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SingleMode {
    /// Natural frequency \[Hz\].
    pub frequency_hz: f64,
    /// Damping ratio.
    pub damping_ratio: f64,
    /// Residue of the receptance.
    pub residue: Complex64,
}

/// Peak of |H| in a band with its half-power width, ζ = (f₂² − f₁²)/(4 f²).
///
/// Between lines the peak and the crossings of |H|/√2 are found on parabolas and straight lines. `None` where a side
/// does not fall to half power within the band. Valid for a mode alone, some lines wide, with ζ below a tenth or so.
pub fn peak_fit(frequencies: &[f64], frf: &[Complex64], band: [f64; 2]) -> Option<SingleMode> {
    let inside: Vec<usize> =
        (0..frf.len()).filter(|&k| frequencies[k] >= band[0] && frequencies[k] <= band[1]).collect();
    let square = |k: usize| frf[k].norm_sqr();
    let top = inside.iter().copied().fold(None, |best: Option<usize>, k| match best {
        Some(b) if square(b) >= square(k) => Some(b),
        _ => Some(k),
    })?;
    if top == 0 || top + 1 >= frf.len() {
        return None;
    }
    // |H|⁻² of a mode is a parabola in f² − f_n².
    let [a, b, c] = [top - 1, top, top + 1].map(|k| 1.0 / square(k));
    let curvature = a - 2.0 * b + c;
    let offset = if curvature > 0.0 { (0.5 * (a - c) / curvature).clamp(-1.0, 1.0) } else { 0.0 };
    let step = frequencies[top + 1] - frequencies[top];
    let natural = frequencies[top] + offset * step;
    let least = b - 0.25 * (a - c) * offset;
    let half = 2.0 * least;
    let crossing = |near: usize, far: usize| {
        let (x, y) = (1.0 / square(near), 1.0 / square(far));
        let share = (half - x) / (y - x);
        frequencies[near] + share * (frequencies[far] - frequencies[near])
    };
    let (first, last) = (*inside.first()?, *inside.last()?);
    let upper = (top + 1..=last).find(|&k| 1.0 / square(k) >= half).map(|k| crossing(k - 1, k))?;
    let lower = (first..top).rev().find(|&k| 1.0 / square(k) >= half).map(|k| crossing(k + 1, k))?;
    let damping_ratio = (upper * upper - lower * lower) / (4.0 * natural * natural);
    let omega = TAU * natural;
    // At resonance H = A/(ζ ω_n) in size, for H = A/(s − λ).
    let residue = frf[top] * damping_ratio * omega;
    Some(SingleMode { frequency_hz: natural, damping_ratio, residue })
}

/// Circle through the FRF near a mode: frequency where it is run through fastest, damping from the angles.
///
/// The mobility of a mode is a circle, so H is brought to it by `quantity`. With angle θ at either side of resonance
/// tan(θ/2) = (ω_n² − ω²)/(2 ζ ω_n ω) is a straight line, fitted over all lines of the band. `None` where the
/// lines (at least four) lie on no circle. Source: Kennedy & Pancu, J. Aeronautical Sciences 14 (1947); Ewins, Modal
/// Testing (2000), 4.3.
pub fn circle_fit(
    frequencies: &[f64],
    frf: &[Complex64],
    band: [f64; 2],
    quantity: Quantity,
) -> Option<SingleMode> {
    let power = match quantity {
        Quantity::Displacement => 1,
        Quantity::Velocity => 0,
        Quantity::Acceleration => -1,
    };
    let points: Vec<(f64, Complex64)> = frequencies
        .iter()
        .zip(frf)
        .filter(|(f, _)| **f >= band[0] && **f <= band[1] && **f > 0.0)
        .map(|(f, h)| (TAU * f, h * Complex64::new(0.0, TAU * f).powi(power)))
        .collect();
    if points.len() < 4 {
        return None;
    }
    // Circle x² + y² + a x + b y + c = 0 by least squares.
    let size = points.iter().map(|(_, h)| h.norm()).fold(0.0, f64::max);
    let (mut square, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for (_, h) in &points {
        let (x, y) = (h.re / size, h.im / size);
        let row = Vector3::new(x, y, 1.0);
        square += row * row.transpose();
        right -= row * (x * x + y * y);
    }
    let solution = square.lu().solve(&right)?;
    let centre = Complex64::new(-0.5 * solution[0], -0.5 * solution[1]) * size;
    let radius = size * (0.25 * (solution[0].powi(2) + solution[1].powi(2)) - solution[2]).max(0.0).sqrt();
    // The point where ω → 0 and ω → ∞ meet lies opposite to resonance: the angle about the centre is
    // φ = φ_r − 2 atan((ω² − ω_n²)/(2ζω_nω)), so that tan of half of it is linear in (ω − ω_n²/ω).
    let angles: Vec<f64> = points.iter().map(|(_, h)| (h - centre).arg()).collect();
    let mut unwound = vec![angles[0]];
    for pair in angles.windows(2) {
        let turn = (pair[1] - pair[0] + std::f64::consts::PI).rem_euclid(TAU) - std::f64::consts::PI;
        unwound.push(unwound[unwound.len() - 1] + turn);
    }
    let fastest = (1..unwound.len()).min_by(|&a, &b| {
        let rate = |k: usize| (unwound[k] - unwound[k - 1]) / (points[k].0 - points[k - 1].0);
        rate(a).total_cmp(&rate(b))
    })?;
    let mut resonance = 0.5 * (unwound[fastest] + unwound[fastest - 1]);
    let mut found = None;
    // tan(half angle) = p ω + q/ω is exact for the right φ_r; p ω_n + q/ω_n = 0 there moves φ_r until it stays.
    for _ in 0..50 {
        let (mut a, mut b, mut d, mut u, mut v) = (0.0, 0.0, 0.0, 0.0, 0.0);
        for ((omega, _), angle) in points.iter().zip(&unwound) {
            let half = 0.5 * (resonance - angle);
            // Far from resonance the tangent runs off and tells little.
            let weight = half.cos().powi(4).max(0.0);
            if half.abs() >= 1.4 {
                continue;
            }
            let (x, y, t) = (*omega, 1.0 / omega, half.tan());
            a += weight * x * x;
            b += weight * x * y;
            d += weight * y * y;
            u += weight * x * t;
            v += weight * y * t;
        }
        let determinant = a * d - b * b;
        let (p, q) = ((u * d - v * b) / determinant, (a * v - b * u) / determinant);
        if !(p > 0.0 && q < 0.0) {
            return None;
        }
        let natural = (-q / p).sqrt();
        found = Some((natural, 1.0 / (2.0 * natural * p)));
        // The angle that the circle has at ω_n, between its neighbours.
        let k = points.iter().position(|(omega, _)| *omega > natural)?;
        if k == 0 {
            return None;
        }
        let tangent = |k: usize| p * points[k].0 + q / points[k].0;
        let own = |k: usize| unwound[k] + 2.0 * tangent(k).atan();
        let (x0, x1) = (points[k - 1].0, points[k].0);
        let share = (natural - x0) / (x1 - x0);
        let next = (1.0 - share) * own(k - 1) + share * own(k);
        let moved = (next - resonance).abs();
        resonance = next;
        if moved < 1e-13 {
            break;
        }
    }
    let (natural, damping_ratio) = found?;
    // Mobility's diameter is 2|A| ω_n/(2 ζ ω_n) for A/(s − λ) + conj. in the receptance.
    let across = Complex64::from_polar(2.0 * radius, resonance);
    // s A/(s − λ) at ω_n: jω_n A/(ζω_n) to first order of ζ.
    let residue = across * damping_ratio / Complex64::i();
    Some(SingleMode { frequency_hz: natural / TAU, damping_ratio, residue })
}

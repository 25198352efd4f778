//! Single-degree-of-freedom (SDOF) fits: half-power (peak picking) and circle fit of one mode from one FRF.

use std::f64::consts::TAU;

use nalgebra::{Matrix3, Vector3};

use rotordyn_linalg::Complex64;
use rotordyn_signal::Quantity;

/// Result of an SDOF fit: one mode from one FRF.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SdofMode {
    /// Natural frequency \[Hz\].
    pub frequency_hz: f64,
    /// Damping ratio.
    pub damping_ratio: f64,
    /// Residue of the receptance.
    pub residue: Complex64,
}

/// Half-power bandwidth method (peak picking): peak of |H| in a band, ζ = (f₂² − f₁²)/(4 f²).
///
/// The peak is interpolated by a parabola, the crossings of |H|/√2 linearly. `None` if |H| does not fall to
/// half power on both sides within the band. Valid for an isolated mode several lines wide, with ζ below
/// about 0.1.
pub fn half_power_fit(frequencies: &[f64], frf: &[Complex64], band: [f64; 2]) -> Option<SdofMode> {
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
    // At resonance |H| = |A|/(ζ ω_n), for H = A/(s − λ).
    let residue = frf[top] * damping_ratio * omega;
    Some(SdofMode { frequency_hz: natural, damping_ratio, residue })
}

/// Circle fit of an FRF near a mode (Nyquist circle of the mobility M): M = c + A/(jω − λ).
///
/// The image of jω is a circle for every λ, so a linear complex fit of jω M = λ M + c jω + d in λ, c and d
/// fits the circle and the angles along it together; c represents neighbouring modes (offset of the circle).
/// `None` if the band contains fewer than four lines, or if the fitted pole is outside the band or undamped.
/// Source: the circle of Kennedy & Pancu, J. Aeronautical Sciences 14 (1947); linearised as in Levy, IRE
/// Trans. 4 (1959).
pub fn circle_fit(
    frequencies: &[f64],
    frf: &[Complex64],
    band: [f64; 2],
    quantity: Quantity,
) -> Option<SdofMode> {
    let power = match quantity {
        Quantity::Displacement => 1,
        Quantity::Velocity => 0,
        Quantity::Acceleration => -1,
    };
    let points: Vec<(Complex64, Complex64)> = frequencies
        .iter()
        .zip(frf)
        .filter(|(f, _)| **f >= band[0] && **f <= band[1] && **f > 0.0)
        .map(|(f, h)| {
            let s = Complex64::new(0.0, TAU * f);
            (s, h * s.powi(power))
        })
        .collect();
    if points.len() < 4 {
        return None;
    }
    // Centred on the band and scaled by the FRF's magnitude, for the conditioning of the columns.
    let middle = points.iter().map(|(s, _)| s).sum::<Complex64>() / points.len() as f64;
    let width = points.iter().map(|(s, _)| (s - middle).norm()).fold(0.0, f64::max);
    let size = points.iter().map(|(_, m)| m.norm()).fold(0.0, f64::max);
    let (mut square, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for (s, m) in &points {
        let (x, m) = ((s - middle) / width, m / size);
        let row = Vector3::new(m, x, Complex64::new(1.0, 0.0));
        square += row.conjugate() * row.transpose();
        right += row.conjugate() * (x * m);
    }
    let found: Vector3<Complex64> = square.lu().solve(&right)?;
    let value = middle + found[0] * width;
    let inside = (TAU * band[0]..=TAU * band[1]).contains(&value.im);
    if !inside || value.re >= 0.0 {
        return None;
    }
    // d = A − c λ, and sA_r/(s − λ) = A_r + λA_r/(s − λ) for the receptance's residue A_r.
    let residue = (found[2] + found[1] * found[0]) * width * size / value;
    let natural = value.norm();
    Some(SdofMode { frequency_hz: natural / TAU, damping_ratio: -value.re / natural, residue })
}

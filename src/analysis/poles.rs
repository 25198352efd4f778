//! Poles of frequency responses and of the unbalance response: where they peak, and how wide.

use super::campbell::Tangents;
use super::modal::{self, Mode, inner};
use crate::assembly::{Assembly, LinearSystem};
use crate::error::Error;
use crate::linalg::Complex64;
use rayon::prelude::*;

/// Damping ratio below which a mode counts as undamped: above the round-off of an undamped one.
const UNDAMPED: f64 = 1e-9;
/// Largest number of modes searched for poles.
const MAX_MODES: usize = 160;
/// Number of speeds from which the poles of the unbalance response are sought.
const START_SPEEDS: usize = 24;
/// Relative tolerance of a pole's speed.
const POLE_TOLERANCE: f64 = 1e-9;

/// A pole of a response over frequency or speed.
#[derive(Clone, Debug, PartialEq)]
pub struct Pole {
    /// Frequency \[Hz\] or speed \[rad/s\] where the response peaks.
    pub at: f64,
    /// Distance from it to the half-power points, in the same unit.
    pub half_width: f64,
    /// Label of the mode.
    pub label: String,
    /// Damping ratio ζ.
    pub damping_ratio: f64,
    /// Mode shape over the free DOFs.
    pub shape: Vec<Complex64>,
}

impl Pole {
    /// A pole without its mode.
    pub fn new(at: f64, half_width: f64) -> Self {
        Self { at, half_width, label: String::new(), damping_ratio: half_width / at, shape: Vec::new() }
    }

    /// Whether the response at the pole is infinite.
    pub fn is_undamped(&self) -> bool {
        self.damping_ratio.abs() < UNDAMPED
    }

    /// Whether a force excites the mode: |φᴴ F| above round-off of |φ| |F|.
    pub fn is_excited_by(&self, force: &[Complex64]) -> bool {
        let size = |v: &[Complex64]| inner(v, v).re.sqrt();
        inner(&self.shape, force).norm() > 1e-6 * size(&self.shape) * size(force)
    }

    fn of(mode: &Mode, at: f64, half_width: f64) -> Self {
        let (label, shape) = (mode.label.clone(), mode.shape.clone());
        Self { at, half_width: half_width.abs(), label, damping_ratio: mode.zeta(), shape }
    }
}

/// Poles of the FRFs of a system up to a frequency \[Hz\]: its damped natural frequencies, half-widths −Re λ.
///
/// # Errors
/// As [`modal::modes`].
pub fn frf_poles(assembly: &Assembly, system: &LinearSystem, max_hz: f64) -> Result<Vec<Pole>, Error> {
    use std::f64::consts::TAU;
    let modes = modes_up_to(assembly, system, TAU * max_hz)?;
    Ok(modes.iter().map(|mode| Pole::of(mode, mode.frequency_hz(), mode.eigenvalue.re / TAU)).collect())
}

/// Modes up to a little above an angular frequency.
fn modes_up_to(assembly: &Assembly, system: &LinearSystem, omega: f64) -> Result<Vec<Mode>, Error> {
    let mut count = 12;
    loop {
        let found = modal::modes(assembly, system, count)?;
        let reaches = found.last().is_none_or(|mode| mode.natural_omega() > 1.1 * omega);
        if reaches || found.len() < count || count >= MAX_MODES {
            return Ok(found);
        }
        count *= 2;
    }
}

/// Poles of the unbalance response between two speeds \[rad/s\]: λ(Ω) with Im λ = Ω, half-width
/// |Re λ|/|1 − dω/dΩ|.
///
/// Every mode near the line ω = Ω at one of several speeds is followed to it by the secant method.
///
/// # Errors
/// Those of the tangents or of the eigenvalue computation.
pub fn synchronous_poles(
    assembly: &Assembly,
    [low, high]: [f64; 2],
    tangents: &impl Tangents,
) -> Result<Vec<Pole>, Error> {
    if high <= low || high <= 0.0 {
        return Ok(Vec::new());
    }
    let step = (high - low) / (START_SPEEDS - 1) as f64;
    let modes_at = |speed: f64| -> Result<Vec<Mode>, Error> {
        let system = LinearSystem::new(assembly, &tangents(speed)?, speed)?;
        modes_up_to(assembly, &system, speed.max(step))
    };
    let speeds: Vec<f64> = (0..START_SPEEDS).map(|k| low + step * k as f64).collect();
    let sets: Vec<Vec<Mode>> = speeds.par_iter().map(|&s| modes_at(s)).collect::<Result<_, _>>()?;
    let starts: Vec<(f64, &Mode)> = speeds
        .iter()
        .zip(&sets)
        .flat_map(|(&speed, modes)| {
            modes.iter().filter(move |m| (m.omega() - speed).abs() <= 1.5 * step).map(move |m| (speed, m))
        })
        .collect();
    let found: Vec<Option<Pole>> = starts
        .par_iter()
        .map(|&(speed, mode)| follow(assembly, &modes_at, speed, mode))
        .collect::<Result<_, Error>>()?;
    let mut poles: Vec<Pole> = Vec::new();
    for pole in found.into_iter().flatten().filter(|p| p.at >= low - step && p.at <= high + step) {
        let same = |other: &&Pole| {
            let near = (other.at - pole.at).abs() < 1e-6 * pole.at;
            near && correlation(assembly, &other.shape, &pole.shape) > 0.5
        };
        if !poles.iter().any(|other| same(&other)) {
            poles.push(pole);
        }
    }
    poles.sort_by(|a, b| a.at.total_cmp(&b.at));
    Ok(poles)
}

/// |aᴴ M b|² of mass-normalised shapes.
fn correlation(assembly: &Assembly, a: &[Complex64], b: &[Complex64]) -> f64 {
    inner(a, &assembly.mass.mul_complex(b)).norm_sqr()
}

/// The pole to which a mode leads from a speed; `None` if its frequency does not meet the line ω = Ω.
fn follow(
    assembly: &Assembly,
    modes_at: &impl Fn(f64) -> Result<Vec<Mode>, Error>,
    start: f64,
    mode: &Mode,
) -> Result<Option<Pole>, Error> {
    const MAX_STEPS: usize = 25;
    let (mut speed, mut mode) = (start, mode.clone());
    let (mut next, mut slope) = (mode.omega(), 0.0_f64);
    for _ in 0..MAX_STEPS {
        if next <= 0.0 || !next.is_finite() {
            return Ok(None);
        }
        let nearest = |a: &Mode, b: &Mode| {
            let closeness = |m: &Mode| correlation(assembly, &m.shape, &mode.shape);
            closeness(a).total_cmp(&closeness(b))
        };
        let Some(there) = modes_at(next)?.into_iter().max_by(nearest) else { return Ok(None) };
        let moved = next - speed;
        if moved != 0.0 {
            // A slope of one or more never meets the line.
            slope = ((there.omega() - mode.omega()) / moved).clamp(-10.0, 0.95);
        }
        (speed, mode) = (next, there);
        let gap = mode.omega() - speed;
        if gap.abs() < POLE_TOLERANCE * speed {
            let half_width = mode.eigenvalue.re / (1.0 - slope);
            return Ok(Some(Pole::of(&mode, speed, half_width)));
        }
        next = speed + gap / (1.0 - slope);
    }
    Ok(None)
}

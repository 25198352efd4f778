//! Axial preload of ball bearings in the assembled machine: the force that results, and the preload that gives a
//! stated one.

use super::equilibrium::{CageTreatment, equilibrium};
pub use super::mounted_preload::MountedPreload;
use crate::assembly::{Assembly, PhysicsError};
use crate::model::Model;
use rotordyn_bearing::{Bearing, Preload};

/// Relative tolerance of the axial force of a mounted preload.
const TOLERANCE: f64 = 1e-9;
const MAX_SOLUTIONS: usize = 100;
/// Largest change of the preload from its estimate \[m\].
const LARGEST_OFFSET: f64 = 1e-3;

/// The model with the interference of its bearing of [`Preload::Mounted`] at which that bearing carries the stated axial
/// force in the machine at standstill; `None` if no bearing has one.
///
/// F(δ₀) increases with the interference δ₀; its root by the safeguarded secant method.
///
/// # Errors
/// No equilibrium; [`PhysicsError::NoMountedPreload`] if no interference gives the force.
pub fn with_mounted_preload(model: &Model, assembly: &Assembly) -> Result<Option<Model>, PhysicsError> {
    let mounted = |bearing: &Bearing| match bearing.static_balls()?.preload {
        Preload::Mounted { force, interference: None } => Some(force),
        _ => None,
    };
    let Some((index, force)) =
        model.bearings.iter().enumerate().find_map(|(k, site)| Some((k, mounted(&site.bearing)?)))
    else {
        return Ok(None);
    };
    let mut trial = model.clone();
    let mut start: Option<Vec<f64>> = None;
    let direction = model.bearings[index].bearing.ball().map_or(1.0, |ball| ball.geometry.thrust_direction);
    let set = |model: &mut Model, interference: f64| {
        if let Some(ball) = model.bearings[index].bearing.static_balls_mut() {
            ball.preload = Preload::Mounted { force, interference: Some(interference) };
        }
    };
    let mut excess = |interference: f64| -> Result<f64, PhysicsError> {
        set(&mut trial, interference);
        let found = equilibrium(&trial, assembly, 0.0, CageTreatment::Averaged, start.as_deref())?;
        start = Some(found.q);
        Ok(-direction * found.bearings[index].force[2] - force)
    };
    let estimate = model.bearings[index].bearing.element().preload_state(0.0).offset;

    // Bracket: steps that double from the estimate, the first of the size of a contact deflection.
    let mut at = (estimate, excess(estimate)?);
    let mut step = estimate.abs().max(1e-6) * if at.1 > 0.0 { -0.5 } else { 0.5 };
    let mut other = at;
    while other.1 * at.1 > 0.0 {
        if (other.0 - estimate).abs() > LARGEST_OFFSET {
            let item = model.bearings[index].name.clone();
            return Err(PhysicsError::NoMountedPreload { item, force, reached: force + other.1 });
        }
        at = other;
        other = (at.0 + step, excess(at.0 + step)?);
        step *= 2.0;
    }
    let (mut low, mut high) = if at.1 < other.1 { (at, other) } else { (other, at) };
    // False position; the value of an end kept twice is halved (Illinois).
    let mut before = 0.0;
    for _ in 0..MAX_SOLUTIONS {
        let next = low.0 - low.1 * (high.0 - low.0) / (high.1 - low.1);
        let value = excess(next)?;
        if value.abs() <= TOLERANCE * force {
            let mut solved = model.clone();
            set(&mut solved, next);
            return Ok(Some(solved));
        }
        let (moved, kept) = if value < 0.0 { (&mut low, &mut high) } else { (&mut high, &mut low) };
        *moved = (next, value);
        if value * before > 0.0 {
            kept.1 *= 0.5;
        }
        before = value;
    }
    let item = model.bearings[index].name.clone();
    Err(PhysicsError::NoMountedPreload { item, force, reached: force + before })
}

//! Discs that do not fit the shaft, or the machine.

use super::inertia::{DISC, TOP};
use crate::Model;
use crate::file::diagnostic::{Kind, Problem};
use crate::file::reader::Reader;
use rotordyn_core::element::Disc;
use rotordyn_core::warning::Code;

/// Bore of a disc over the diameter of the shaft in it: a loose fit is a slip.
const BORE_RATIO: f64 = 1.25;
/// Outer diameter of a disc over the diameter of the shaft; below 1 up to rounding it lies within the shaft.
const OUTER_RATIO: f64 = 0.98;
/// Diameter and thickness of a disc over the length of the shaft, beyond which a unit is wrong.
const LARGEST_DIAMETER: f64 = 5.0;
const LARGEST_THICKNESS: f64 = 2.0;
/// Diameter of a ring with a disc's inertia over that of the shaft in it, below which a unit is wrong: a coupling half on a
/// stub has 0.5.
const SMALLEST_RING: f64 = 0.02;

/// Warns of discs by dimensions whose bore or outer diameter cannot be those of a part on the shaft, and of discs far larger
/// than the machine.
pub(super) fn check(top: &Reader, model: &Model) {
    for disc in &model.discs {
        let Some(r) = top.item(&TOP.disc, &disc.name) else { continue };
        if r.has(&DISC.mass) {
            gyration(top, model, disc, &r);
            continue;
        }
        fit(top, model, disc, &r);
        size(top, model, disc, &r);
    }
}

fn fit(top: &Reader, model: &Model, disc: &Disc, r: &Reader) {
    let diameters = diameters_at(model, disc.node);
    // Without a shaft there, on a rigid rotor, or as a ring on another disc it fits something else.
    let on_other = model.discs.iter().any(|other| other.node == disc.node && other.name != disc.name);
    if diameters.is_empty() || on_other {
        return;
    }
    let largest = diameters.iter().copied().fold(0.0, f64::max);
    let smallest = diameters.iter().copied().fold(f64::INFINITY, f64::min);
    let bore = r.get(&DISC.inner_diameter).unwrap_or(0.0);
    let (key, message) = if bore > BORE_RATIO * largest {
        let message = format!(
            "disc.{} has a bore of {:.4} mm, but the shaft in it has a diameter of {:.4} mm",
            disc.name,
            1e3 * bore,
            1e3 * largest
        );
        (&DISC.inner_diameter, message)
    } else if disc.outer_diameter < OUTER_RATIO * smallest {
        let message = format!(
            "disc.{} has an outer diameter of {:.4} mm, less than the {:.4} mm of the shaft there",
            disc.name,
            1e3 * disc.outer_diameter,
            1e3 * smallest
        );
        (&DISC.outer_diameter, message)
    } else {
        return;
    };
    let problem = Problem::new(Kind::Geometry, &r.span_of(key), message)
        .hint("check the units and the section under it; a part on a hub is stated by mass and inertia");
    top.log.warn(Code::DiscFit, format!("disc.{}", disc.name), problem);
}

fn size(top: &Reader, model: &Model, disc: &Disc, r: &Reader) {
    let extent = shaft_length(model);
    if extent <= 0.0 {
        return;
    }
    let (key, what, value) = if disc.outer_diameter > LARGEST_DIAMETER * extent {
        (&DISC.outer_diameter, "diameter", disc.outer_diameter)
    } else if disc.thickness > LARGEST_THICKNESS * extent {
        (&DISC.thickness, "thickness", disc.thickness)
    } else {
        return;
    };
    let message = format!(
        "disc.{} has a {what} of {value:.4} m and a mass of {:.3e} kg, on a shaft of {extent:.4} m length",
        disc.name, disc.mass
    );
    let problem = Problem::new(Kind::OutOfRange, &r.span_of(key), message).hint("check the unit");
    top.log.warn(Code::DiscSize, format!("disc.{}", disc.name), problem);
}

/// Warns of inertias that no part of the disc's mass has on this machine: those of a ring of the diameter 2 √(I/m) far larger
/// than the shaft is long, or far thinner than the shaft.
fn gyration(top: &Reader, model: &Model, disc: &Disc, r: &Reader) {
    let extent = shaft_length(model);
    if extent <= 0.0 || disc.mass <= 0.0 {
        return;
    }
    let thinnest = diameters_at(model, disc.node).into_iter().fold(f64::INFINITY, f64::min);
    let inertias =
        [(&DISC.polar_inertia, disc.polar_inertia), (&DISC.diametral_inertia, disc.diametral_inertia)];
    for (key, inertia) in inertias.into_iter().filter(|(_, inertia)| *inertia > 0.0) {
        let diameter = 2.0 * (inertia / disc.mass).sqrt();
        let is_thin = thinnest.is_finite() && diameter < SMALLEST_RING * thinnest;
        if diameter <= LARGEST_DIAMETER * extent && !is_thin {
            continue;
        }
        let message = format!(
            "{} is that of a ring of {} kg with a diameter of {diameter:.3e} m, on a shaft of {extent:.4} m length",
            r.name(key),
            disc.mass
        );
        let problem = Problem::new(Kind::OutOfRange, &r.span_of(key), message)
            .hint("check the unit: kg m^2, or kg mm^2");
        top.log.warn(Code::DiscSize, format!("disc.{}", disc.name), problem);
        return;
    }
}

/// Length of the shaft \[m\]; 0 without one.
fn shaft_length(model: &Model) -> f64 {
    match (model.node_z.first(), model.node_z.last()) {
        (Some(first), Some(last)) if !model.shaft.is_empty() => last - first,
        _ => 0.0,
    }
}

/// Diameters of the shaft with its layers on both sides of a node.
fn diameters_at(model: &Model, node: usize) -> Vec<f64> {
    let outer = |k: usize, end: usize| {
        let element = model.shaft.get(k)?;
        Some(element.with_layers().map(|layer| layer.outer_diameter[end]).fold(0.0, f64::max))
    };
    let left = node.checked_sub(1).and_then(|k| outer(k, 1));
    left.into_iter().chain(outer(node, 0)).collect()
}

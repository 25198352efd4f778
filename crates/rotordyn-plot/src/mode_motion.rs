//! Displacements of a mode: the largest of shaft, discs and bodies, and the caption that tells it.

use super::campbell::Whirl;
use super::mode_shape::{BodyBox, BodyMotion, ModeShape, Rotor};
use super::scale::{Range, extremes};

/// With bodies: which part moves most and in which direction, and how far the others move.
pub(super) fn caption(rotor: &Rotor, mode: &ModeShape) -> String {
    let (shaft, how) = shaft_motion(rotor, mode);
    let bodies: Vec<f64> = rotor.bodies.iter().zip(&mode.bodies).map(|(b, m)| body_motion(b, m)).collect();
    let largest = bodies.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1));
    let share = |part: f64, whole: f64| match 100.0 * part / whole {
        p if p < 0.1 => "below 0.1 %".into(),
        p if p < 9.95 => format!("{p:.1} %"),
        p => format!("{p:.0} %"),
    };
    match largest {
        _ if shaft.max(largest.map_or(0.0, |b| *b.1)) == 0.0 => String::new(),
        None => String::new(),
        Some((k, &body)) if body > shaft => format!(
            "largest motion: {}, {}; {how} {}",
            rotor.bodies[k].name,
            body_direction(&rotor.bodies[k], &mode.bodies[k]),
            share(shaft, body)
        ),
        Some((k, &body)) => {
            format!("largest motion: {how}; {} {}", rotor.bodies[k].name, share(body, shaft))
        }
    }
}

/// Largest displacement of the shaft and its discs, and its direction.
pub(super) fn shaft_motion(rotor: &Rotor, mode: &ModeShape) -> (f64, &'static str) {
    let arm = twist_radius(rotor);
    let most = |of: &[[f64; 2]], arm: f64| arm * of.iter().map(size).fold(0.0, f64::max);
    let tilts = rotor.discs.iter().filter_map(|d| {
        let theta = [mode.theta_x.get(d.node)?, mode.theta_y.get(d.node)?];
        Some(d.radius * major(&theta.map(|t| *t)))
    });
    let lateral = mode.u_x.iter().zip(&mode.u_y).map(|(x, y)| major(&[*x, *y])).fold(0.0, f64::max);
    let sideways = if most(&mode.u_x, 1.0) >= most(&mode.u_y, 1.0) { "horizontal" } else { "vertical" };
    let whirls = matches!(mode.whirl, Whirl::Forward | Whirl::Backward);
    let all = [
        (
            lateral,
            if whirls {
                "shaft, lateral"
            } else if sideways == "vertical" {
                "shaft, vertical"
            } else {
                "shaft, horizontal"
            },
        ),
        (most(&mode.u_z, 1.0), "shaft, axial"),
        (most(&mode.theta_z, arm), "shaft, torsion"),
        (tilts.fold(0.0, f64::max), "disc, tilt"),
    ];
    // The first of equal ones.
    all.into_iter().rev().max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((0.0, "shaft"))
}

/// Largest displacement of a body's centre and corners.
pub(super) fn body_motion(body: &BodyBox, moves: &BodyMotion) -> f64 {
    body.arms().map(|r| major(&moves.at(r))).fold(major(&moves.u), f64::max)
}

/// The degree of freedom of a body that moves its corners most.
fn body_direction(body: &BodyBox, moves: &BodyMotion) -> &'static str {
    const NAMES: [&str; 6] =
        ["horizontal", "vertical", "axial", "tilt about x", "tilt about y", "rotation about z"];
    let part = |d: usize| {
        let mut one = BodyMotion::default();
        if d < 3 {
            one.u[d] = moves.u[d]
        } else {
            one.theta[d - 3] = moves.theta[d - 3]
        }
        body_motion(body, &one)
    };
    let most = (0..6).max_by(|&a, &b| part(a).total_cmp(&part(b))).unwrap_or(0);
    NAMES[most]
}

/// |u|; 0 if not finite.
pub(super) fn size(u: &[f64; 2]) -> f64 {
    Some(u[0].hypot(u[1])).filter(|s| s.is_finite()).unwrap_or(0.0)
}

/// Largest length of the vector Re(u e^{iφ}) over φ: √((Σ|u|² + |Σu²|)/2), the major semi-axis.
pub(super) fn major(u: &[[f64; 2]]) -> f64 {
    let scale = u.iter().map(size).fold(0.0, f64::max);
    if scale == 0.0 {
        return 0.0;
    }
    let (mut square, mut re, mut im) = (0.0, 0.0, 0.0);
    for [a, b] in u.iter().filter(|u| size(u) > 0.0).map(|u| u.map(|x| x / scale)) {
        square += a * a + b * b;
        re += a * a - b * b;
        im += 2.0 * a * b;
    }
    scale * (0.5 * (square + f64::hypot(re, im))).sqrt()
}

/// Radius that converts twist to displacement \[m\]: the largest disc radius, or a tenth of the shaft length.
pub(super) fn twist_radius(rotor: &Rotor) -> f64 {
    let z = Range::of(rotor.z.iter().copied());
    extremes(rotor.discs.iter().map(|d| d.radius))
        .map(|e| e.1)
        .filter(|r| *r > 0.0)
        .unwrap_or(0.1 * (z.hi - z.lo))
}

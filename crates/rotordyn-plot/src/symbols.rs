//! Symbols of supports: spring, damper, joint, ball, ground.

use super::style::*;
use super::svg::{Point, Style, Svg};

/// How a support is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SupportSymbol {
    /// Ball bearing.
    Ball,
    /// Linear bearing or bushing: which of spring and damper it has, and whether it acts along the shaft only.
    SpringDamper { spring: bool, damper: bool, axial: bool },
    /// Ideal joint.
    Joint(JointSymbol),
}

/// What a joint constrains.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointSymbol {
    /// Lateral displacement: a pin.
    Pin,
    /// Lateral displacement and tilt: a sleeve.
    Sleeve,
    /// Axial displacement or rotation only: a stop.
    Stop,
}

/// Half the distance of spring and damper side by side \[px\].
const HALF_PAIR: f64 = 4.5;

/// A spring, a damper or both side by side from `a` to `b`, with ground hatching at `b` if grounded.
pub fn spring_damper(svg: &mut Svg, a: Point, b: Point, (spring, damper): (bool, bool), grounded: bool) {
    let d = [b[0] - a[0], b[1] - a[1]];
    let length = d[0].hypot(d[1]);
    if !length.is_finite() || length < 1.0 {
        return;
    }
    let (along, across) = ([d[0] / length, d[1] / length], [-d[1] / length, d[0] / length]);
    // Part of the length, offset across in px.
    let at = |t: f64, out: f64| [a[0] + t * d[0] + out * across[0], a[1] + t * d[1] + out * across[1]];
    let line = Style::stroke(INK, 1.0);
    let both = spring && damper;
    let side = if both { HALF_PAIR } else { 0.0 };
    let (from, to) = if both { (0.14, 0.86) } else { (0.0, 1.0) };
    if both {
        svg.line(at(0.0, 0.0), at(from, 0.0), line);
        svg.line(at(to, 0.0), at(1.0, 0.0), line);
        for t in [from, to] {
            svg.line(at(t, -side), at(t, side), line);
        }
    }
    let part = |t: f64, out: f64| at(from + t * (to - from), out);
    if spring || !damper {
        let wide = if both { 3.2 } else { 4.5 };
        let zigzag = |k: usize| match k {
            2..=8 if k.is_multiple_of(2) => wide,
            2..=8 => -wide,
            _ => 0.0,
        };
        let points: Vec<Point> = (0..=10).map(|k| part(0.1 * k as f64, zigzag(k) - side)).collect();
        svg.polyline(&points, line);
    }
    if damper {
        // Cup open towards `a`, piston on the rod from `a`.
        let (half, cup) = (3.2, [0.35, 0.75]);
        svg.polyline(
            &[
                part(cup[0], side - half),
                part(cup[1], side - half),
                part(cup[1], side + half),
                part(cup[0], side + half),
            ],
            line,
        );
        svg.line(part(0.0, side), part(0.55, side), line);
        svg.line(part(0.55, side - 0.7 * half), part(0.55, side + 0.7 * half), line.thick(1.4));
        svg.line(part(cup[1], side), part(1.0, side), line);
    }
    if grounded {
        ground(svg, b, along);
    } else {
        svg.line(at(1.0, -6.0), at(1.0, 6.0), line.thick(1.4));
    }
}

/// Ground hatching at a point, its solid side in the direction `into`.
pub fn ground(svg: &mut Svg, at: Point, into: [f64; 2]) {
    let across = [-into[1], into[0]];
    let place = |along: f64, out: f64| {
        [at[0] + along * across[0] + out * into[0], at[1] + along * across[1] + out * into[1]]
    };
    svg.line(place(-10.0, 0.0), place(10.0, 0.0), Style::stroke(INK, 1.2));
    for k in 0..5 {
        let along = -8.0 + 4.5 * f64::from(k);
        svg.line(place(along, 0.0), place(along - 3.5, 5.0), Style::stroke(INK, 0.7));
    }
}

/// A joint below a point of the shaft's surface, with ground hatching if grounded.
pub fn joint(svg: &mut Svg, at: Point, kind: JointSymbol, grounded: bool) {
    let [x, y] = at;
    let line = Style::stroke(INK, 1.0);
    match kind {
        JointSymbol::Pin => svg.circle([x, y + 4.0], 4.0, line.filled(WHITE)),
        JointSymbol::Sleeve => svg.rect(x - 9.0, y, 18.0, 6.0, line.filled(PALE)),
        JointSymbol::Stop => {
            svg.line([x, y], [x, y + 16.0], line.thick(1.6));
            for side in [-1.0, 1.0] {
                let tip = [x + side, y + 9.0];
                svg.polygon(&[tip, [x + side * 8.0, y + 5.0], [x + side * 8.0, y + 13.0]], Style::fill(INK));
            }
            return;
        }
    }
    let top = if kind == JointSymbol::Pin { 8.0 } else { 6.0 };
    svg.polygon(
        &[[x, y + top], [x + 7.0, y + JOINT_HEIGHT], [x - 7.0, y + JOINT_HEIGHT]],
        line.filled(WHITE),
    );
    if grounded {
        ground(svg, [x, y + JOINT_HEIGHT], [0.0, 1.0]);
    }
}

/// Height of a joint's symbol without ground hatching \[px\].
const JOINT_HEIGHT: f64 = 19.0;

/// Length of a drawn support from the shaft's surface to the ground \[px\].
pub const SUPPORT_LENGTH: f64 = 26.0;

/// A support below a point of the shaft's surface.
pub fn support(svg: &mut Svg, at: Point, symbol: SupportSymbol, grounded: bool) {
    let [x, y] = at;
    match symbol {
        SupportSymbol::Ball => {
            svg.rect(x - 5.0, y + 1.0, 10.0, 10.0, Style::stroke(INK, 0.9).filled(WHITE));
            svg.circle([x, y + 6.0], 3.2, Style::stroke(INK, 0.9).filled(STEEL));
            if grounded {
                ground(svg, [x, y + 11.0], [0.0, 1.0]);
            }
        }
        SupportSymbol::SpringDamper { spring, damper, axial: false } => {
            spring_damper(svg, at, [x, y + SUPPORT_LENGTH], (spring, damper), grounded);
        }
        SupportSymbol::SpringDamper { spring, damper, axial: true } => {
            let start = [x, y + 8.0];
            svg.line(at, [x, y + 16.0], Style::stroke(INK, 1.6));
            spring_damper(svg, start, [x + SUPPORT_LENGTH, y + 8.0], (spring, damper), grounded);
        }
        SupportSymbol::Joint(kind) => joint(svg, at, kind, grounded),
    }
}

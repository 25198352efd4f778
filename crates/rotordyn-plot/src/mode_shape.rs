//! Mode shapes of the machine: deflected shaft, discs and bodies in axonometric projection with whirl orbits.

pub use super::mode_data::{BodyBox, BodyMotion, ModeShape, Rotor, RotorDisc, RotorSupport};
use std::f64::consts::TAU;

use super::axes::Frame;
use super::campbell::Whirl;
use super::font;
use super::labels::page_heading;
use super::mode_motion::{body_motion, caption, major, shaft_motion, twist_radius};
use super::mode_view::View;
use super::scale::extremes;
use super::style::*;
use super::svg::{Dash, Point, Style, Svg, Text};
use super::symbols::{self, JointSymbol, SupportSymbol};

/// Largest number of modes in one figure.
const MAX_MODES: usize = 24;
/// Largest number of orbits in one panel.
const MAX_ORBITS: usize = 14;
/// Largest drawn displacement over the height of a panel.
const DISPLACEMENT: f64 = 0.18;
/// Largest drawn slope of a body.
const MAX_BODY_SLOPE: f64 = 0.6;

/// Data of a figure of mode shapes.
#[derive(Clone, Debug, Default)]
pub struct ModeShapes {
    pub title: String,
    pub note: String,
    pub rotor: Rotor,
    pub modes: Vec<ModeShape>,
}

pub fn draw(data: &ModeShapes) -> Svg {
    const W: f64 = 376.0;
    const H: f64 = 232.0;
    let count = data.modes.len().min(MAX_MODES);
    let columns = if count > 1 { 2 } else { 1 };
    let width = (W * columns as f64 + 16.0).max(WIDTH * 0.66);
    let (mut svg, top) = page_heading(width, 16.0, &data.title, &data.note, &[]);
    let modes = &data.modes[..count];
    let view = common_view(&data.rotor, modes, Frame { x: 0.0, y: 0.0, w: W, h: H });
    for (k, mode) in modes.iter().enumerate() {
        let frame =
            Frame { x: 8.0 + W * (k % columns) as f64, y: top + H * (k / columns) as f64, w: W, h: H };
        let view = view.moved([frame.x, frame.y]);
        svg.group(&format!("mode mode-{}", k + 1), |svg| panel(svg, &data.rotor, mode, frame, &view));
        if k == 0 {
            triad(&mut svg, [frame.x + 30.0, frame.bottom() - 34.0]);
        }
    }
    let bottom = top + H * count.div_ceil(columns).max(1) as f64;
    let bodies = if data.rotor.bodies.is_empty() { "" } else { " Boxes: bodies." };
    let how = format!(
        "Line: shaft at phase 0.{bodies} One scale for all motions of a mode. Orbits run from the dot to the gap (whirl direction)."
    );
    svg.text([16.0, bottom + 12.0], &font::fit(&how, SMALL, width - 24.0), Text::new(SMALL, MUTED));
    svg.height = bottom + 24.0;
    svg
}

/// The view in which the motion in every mode fits into the panel below its caption.
fn common_view(rotor: &Rotor, modes: &[ModeShape], frame: Frame) -> View {
    let mut view = View::new(rotor, frame);
    let mut points: Vec<Point> = Vec::new();
    for motion in std::iter::once(None).chain(modes.iter().map(Some)) {
        let motion = motion.and_then(|mode| Motion::new(rotor, mode, &view, frame));
        let phases: &[f64] = if motion.is_some() { &[0.0, 0.25, 0.5, 0.75] } else { &[0.0] };
        let shift = |k, phase| motion.as_ref().map_or([0.0; 3], |m| m.node(k, TAU * phase));
        for &phase in phases {
            points.extend(rotor.z.iter().enumerate().map(|(k, &z)| view.at(z, shift(k, phase))));
        }
        for (k, body) in rotor.bodies.iter().enumerate() {
            let (by, turn) = motion.as_ref().map_or(([0.0; 3], [0.0; 3]), |m| m.body(k, 0.0));
            points.extend(view.faces(body, by, turn).into_iter().flatten());
        }
        for disc in &rotor.discs {
            let (by, tilt) = motion.as_ref().map_or(([0.0; 3], [0.0; 2]), |m| m.tilted(disc.node));
            if let Some(&z) = rotor.z.get(disc.node) {
                points.extend(view.rim(z, view.disc_radius(disc.radius, frame), by, tilt));
            }
        }
    }
    let x = extremes(points.iter().map(|p| p[0]));
    let y = extremes(points.iter().map(|p| p[1]));
    if let (Some(x), Some(y)) = (x, y) {
        let area = Frame { x: frame.x + 14.0, y: frame.y + 44.0, w: frame.w - 32.0, h: frame.h - 66.0 };
        view.fit([x.0, y.0, x.1, y.1], area);
    }
    view
}

/// Displacements of one mode on the page \[px\].
struct Motion<'a> {
    mode: &'a ModeShape,
    /// px per amplitude.
    scale: f64,
    /// Slope per rotation.
    slope: f64,
}

impl<'a> Motion<'a> {
    fn new(rotor: &Rotor, mode: &'a ModeShape, view: &View, frame: Frame) -> Option<Self> {
        let scale = pixels_per_amplitude(rotor, mode, view, DISPLACEMENT * frame.h)?;
        Some(Self { mode, scale, slope: scale / view.scale })
    }

    /// Displacement of a shaft node.
    fn node(&self, k: usize, phase: f64) -> [f64; 3] {
        let m = self.mode;
        [&m.u_x, &m.u_y, &m.u_z].map(|u| u.get(k).map_or(0.0, |u| self.scale * at_phase(*u, phase)))
    }

    /// Displacement and tilt of a shaft node at phase 0.
    fn tilted(&self, node: usize) -> ([f64; 3], [f64; 2]) {
        let slope = |theta: &[[f64; 2]]| theta.get(node).map_or(0.0, |t| self.slope * t[0]);
        (self.node(node, 0.0), [slope(&self.mode.theta_x), slope(&self.mode.theta_y)])
    }

    /// Displacement and rotation of a body.
    fn body(&self, k: usize, phase: f64) -> ([f64; 3], [f64; 3]) {
        let moves = self.mode.bodies.get(k).copied().unwrap_or_default();
        let part = |u: [[f64; 2]; 3], by: f64| u.map(|u| by * at_phase(u, phase));
        (part(moves.u, self.scale), part(moves.theta, self.slope))
    }
}

fn panel(svg: &mut Svg, rotor: &Rotor, mode: &ModeShape, frame: Frame, view: &View) {
    let title = font::fit(&mode.title, LABEL, frame.w - 20.0);
    svg.text([frame.x + 8.0, frame.y + 16.0], &title, Text::new(LABEL, INK));
    svg.line(
        [frame.x + 8.0, frame.y + 22.0],
        [frame.right() - 12.0, frame.y + 22.0],
        Style::stroke(GRID, 1.0),
    );
    let caption = font::fit(&caption(rotor, mode), SMALL, frame.w - 20.0);
    svg.text([frame.x + 8.0, frame.y + 35.0], &caption, Text::new(SMALL, MUTED));
    undeformed(svg, view, rotor, frame);
    for z in orbit_nodes(rotor).into_iter().filter_map(|k| rotor.z.get(k)) {
        svg.circle(view.at(*z, [0.0; 3]), 1.5, Style::fill(PALE));
    }
    let Some(moves) = Motion::new(rotor, mode, view, frame) else { return };
    let (arm, scale, color) = (twist_radius(rotor), moves.scale, mode.whirl.color());
    let motion =
        |k: usize, phase: f64| rotor.z.get(k).map_or([f64::NAN; 2], |&z| view.at(z, moves.node(k, phase)));
    svg.group("bodies", |svg| {
        for k in 0..rotor.bodies.len().min(MAX_MODES) {
            moving_body(svg, view, &rotor.bodies[k], |phase| moves.body(k, phase), color);
        }
    });
    for disc in rotor.discs.iter().take(4 * MAX_MODES) {
        let Some(&z) = rotor.z.get(disc.node) else { continue };
        let (by, tilt) = moves.tilted(disc.node);
        let rim = view.rim(z, view.disc_radius(disc.radius, frame), by, tilt);
        svg.polygon(&rim, Style::stroke(PALE, 0.9).filled(STEEL).faint(0.55));
    }
    // No orbit for purely axial motion: it would coincide with the shaft line.
    let lateral = |k: usize| {
        let size = |u: &[[f64; 2]]| u.get(k).map_or(0.0, |u| scale * u[0].hypot(u[1]));
        size(&mode.u_x).max(size(&mode.u_y)) > 2.0
    };
    for k in orbit_nodes(rotor).into_iter().filter(|k| lateral(*k)) {
        orbit(svg, |phase| motion(k, phase), Style::stroke(color, 0.9));
    }
    axial_arrow(svg, view, rotor, mode, scale);
    draw_twist(svg, view, rotor, mode, scale * arm, 0.2 * frame.h);
    let line = centreline(rotor, &moves, view);
    svg.group("shaft", |svg| svg.polyline(&line, Style::stroke(color, 2.2)));
    for p in orbit_nodes(rotor).into_iter().map(|k| motion(k, 0.0)) {
        svg.circle(p, 2.2, Style::fill(INK));
    }
}

/// The deflected centreline at phase 0: cubic between nodes, with the slopes ∂u_x/∂z = θ_y, ∂u_y/∂z = −θ_x.
fn centreline(rotor: &Rotor, moves: &Motion, view: &View) -> Vec<Point> {
    let Some(last) = rotor.z.len().checked_sub(1) else { return Vec::new() };
    let mut line = Vec::new();
    for k in 0..last {
        let (a, b) = (moves.tilted(k), moves.tilted(k + 1));
        let (z, length) = (rotor.z[k], rotor.z[k + 1] - rotor.z[k]);
        // Pieces of about 4 px.
        let steps = (0.25 * length * view.scale).clamp(1.0, 16.0).ceil();
        for step in 0..steps as usize {
            let t = step as f64 / steps;
            let (square, cube) = (t * t, t * t * t);
            let hermite = |u: [f64; 2], slope: [f64; 2]| {
                let tangent = slope.map(|s| s * length * view.scale);
                (2.0 * cube - 3.0 * square + 1.0) * u[0]
                    + (cube - 2.0 * square + t) * tangent[0]
                    + (3.0 * square - 2.0 * cube) * u[1]
                    + (cube - square) * tangent[1]
            };
            let by = [
                hermite([a.0[0], b.0[0]], [a.1[1], b.1[1]]),
                hermite([a.0[1], b.0[1]], [-a.1[0], -b.1[0]]),
                a.0[2] + t * (b.0[2] - a.0[2]),
            ];
            line.push(view.at(z + t * length, by));
        }
    }
    line.push(view.at(rotor.z[last], moves.node(last, 0.0)));
    line
}

/// A body at its largest displacement, the path of its centre, and its spring to the ground.
fn moving_body(
    svg: &mut Svg,
    view: &View,
    body: &BodyBox,
    moves: impl Fn(f64) -> ([f64; 3], [f64; 3]),
    color: super::svg::Color,
) {
    let (by, turn) = moves(0.0);
    if body.to_ground != (false, false) {
        let [x, y] = view.body_foot(body, [0.0; 3]);
        symbols::spring_damper(svg, view.body_foot(body, by), [x, y + 18.0], body.to_ground, true);
    }
    view.moved_body(svg, body, by, turn);
    orbit(svg, |phase| view.body_centre(body, moves(phase).0), Style::stroke(INK, 0.9));
    let (from, to) = (view.body_centre(body, [0.0; 3]), view.body_centre(body, by));
    if (to[0] - from[0]).hypot(to[1] - from[1]) > 6.0 {
        svg.arrow(from, to, 7.0, color, 1.4);
    } else {
        svg.circle(to, 1.8, Style::fill(INK));
    }
}

/// Re(u e^{i phase}).
fn at_phase([re, im]: [f64; 2], phase: f64) -> f64 {
    re * phase.cos() - im * phase.sin()
}

/// Common scale of all displacements of the mode \[px\], so that small ones are not exaggerated: the largest of
/// shaft, discs and bodies in any direction is drawn `height` px, unless a body would turn too far. None
/// without motion.
fn pixels_per_amplitude(rotor: &Rotor, mode: &ModeShape, view: &View, height: f64) -> Option<f64> {
    let bodies = || rotor.bodies.iter().zip(&mode.bodies);
    let largest = bodies().map(|(b, m)| body_motion(b, m)).fold(shaft_motion(rotor, mode).0, f64::max);
    let turn = bodies().map(|(_, m)| major(&m.theta)).fold(0.0, f64::max);
    let scale =
        (height / largest).min(if turn > 0.0 { MAX_BODY_SLOPE * view.scale / turn } else { f64::INFINITY });
    (largest > 0.0 && scale.is_finite() && scale > 0.0).then_some(scale)
}

fn orbit_nodes(rotor: &Rotor) -> Vec<usize> {
    let n = rotor.z.len();
    if !rotor.orbit_nodes.is_empty() {
        return rotor.orbit_nodes.iter().copied().filter(|k| *k < n).take(4 * MAX_ORBITS).collect();
    }
    (0..n).step_by(n.div_ceil(MAX_ORBITS).max(1)).collect()
}

/// Draws an orbit from its start to a gap that shows the whirl direction.
fn orbit(svg: &mut Svg, place: impl Fn(f64) -> Point, style: Style) {
    const STEPS: usize = 40;
    let points: Vec<Point> = (0..=STEPS).map(|k| place(0.9 * TAU * k as f64 / STEPS as f64)).collect();
    let x = extremes(points.iter().map(|p| p[0])).map_or(0.0, |e| e.1 - e.0);
    let y = extremes(points.iter().map(|p| p[1])).map_or(0.0, |e| e.1 - e.0);
    if x.max(y) > 1.0 {
        svg.polyline(&points, style);
    }
}

fn undeformed(svg: &mut Svg, view: &View, rotor: &Rotor, frame: Frame) {
    for body in rotor.bodies.iter().take(MAX_MODES) {
        view.rest_body(svg, body);
    }
    for disc in rotor.discs.iter().take(4 * MAX_MODES) {
        let Some(&z) = rotor.z.get(disc.node) else { continue };
        let rim = view.rim(z, view.disc_radius(disc.radius, frame), [0.0; 3], [0.0; 2]);
        svg.polygon(&rim, Style::stroke(PALE, 0.8).dashed(Dash::Short));
    }
    let line: Vec<Point> = rotor.z.iter().map(|&z| view.at(z, [0.0; 3])).collect();
    svg.polyline(&line, Style::stroke(PALE, 1.2).dashed(Dash::Long));
    // A joint that holds no lateral motion would hide the shaft.
    let stop = SupportSymbol::Joint(JointSymbol::Stop);
    for support in rotor.supports.iter().filter(|s| s.symbol != stop).take(4 * MAX_MODES) {
        let [x, y] = view.at(support.z, [0.0; 3]);
        symbols::support(svg, [x, y + 2.0], support.symbol, true);
    }
}

/// Torsion as pointers rotated by θ_z and joined by a line; vertical pointers mean no twist.
fn draw_twist(svg: &mut Svg, view: &View, rotor: &Rotor, mode: &ModeShape, px_per_rad: f64, length: f64) {
    let largest = extremes(mode.theta_z.iter().map(|t| t[0].hypot(t[1]))).map_or(0.0, |e| e.1);
    // A twist too small compared with the deflection is not drawn.
    if px_per_rad * largest < 0.25 * length {
        return;
    }
    let color = Whirl::Torsion.color();
    let turn = px_per_rad / length * 0.8;
    let tip = |k: usize, phase: f64| {
        let angle = mode.theta_z.get(k).map_or(f64::NAN, |t| turn * at_phase(*t, phase));
        // Rotation about +z: from y towards -x.
        view.at(rotor.z[k], [-length * angle.sin(), length * angle.cos(), 0.0])
    };
    let base: Vec<Point> = rotor.z.iter().map(|&z| view.at(z, [0.0, length, 0.0])).collect();
    svg.polyline(&base, Style::stroke(PALE, 0.8).dashed(Dash::Short));
    for k in orbit_nodes(rotor) {
        svg.line(view.at(rotor.z[k], [0.0; 3]), tip(k, 0.0), Style::stroke(color, 0.9));
    }
    let tips: Vec<Point> = (0..rotor.z.len()).map(|k| tip(k, 0.0)).collect();
    svg.polyline(&tips, Style::stroke(color, 1.5));
}

/// An arrow above mid-shaft for axial motion.
fn axial_arrow(svg: &mut Svg, view: &View, rotor: &Rotor, mode: &ModeShape, scale: f64) {
    let middle = rotor.z.len() / 2;
    let (Some(&z), Some(u)) = (rotor.z.get(middle), mode.u_z.get(middle)) else { return };
    let shift = scale * u[0];
    if shift.abs() > 6.0 {
        svg.arrow(
            view.at(z, [0.0, 18.0, 0.0]),
            view.at(z, [0.0, 18.0, shift]),
            8.0,
            Whirl::Axial.color(),
            1.5,
        );
    }
}

/// The axes of the view.
fn triad(svg: &mut Svg, at: Point) {
    let view = View::of_axes(at);
    for (name, end) in [
        ("x", view.at(0.0, [24.0, 0.0, 0.0])),
        ("y", view.at(0.0, [0.0, 22.0, 0.0])),
        ("z", view.at(22.0, [0.0; 3])),
    ] {
        svg.arrow(at, end, 5.0, MUTED, 0.9);
        let way = [end[0] - at[0], end[1] - at[1]];
        svg.text(
            [end[0] + 0.3 * way[0], end[1] + 0.3 * way[1] + 3.0],
            name,
            Text::new(SMALL, MUTED).middle(),
        );
    }
}

//! Mode shapes of the rotor: deflected centreline in axonometric projection with whirl orbits.

use std::f64::consts::TAU;

use super::axes::Frame;
use super::campbell::Whirl;
use super::font;
use super::labels::page_heading;
use super::scale::{Range, extremes};
use super::style::*;
use super::svg::{Dash, Point, Style, Svg, Text};

/// Largest number of modes in one figure.
const MAX_MODES: usize = 24;
/// Largest number of orbits in one panel.
const MAX_ORBITS: usize = 14;

/// Simplified machine drawn in the panels.
#[derive(Clone, Debug, Default)]
pub struct Rotor {
    /// Axial positions of the shaft nodes \[m\], ascending.
    pub z: Vec<f64>,
    /// Discs: axial position and radius \[m\].
    pub discs: Vec<[f64; 2]>,
    /// Axial positions of the bearings \[m\].
    pub bearings: Vec<f64>,
    /// Nodes whose orbits are drawn; empty for an even selection.
    pub orbit_nodes: Vec<usize>,
}

/// Motion of another body (a housing) in a mode.
#[derive(Clone, Copy, Debug)]
pub struct BodyMotion {
    /// Axial position \[m\].
    pub z: f64,
    /// Complex displacement \[re, im\] in x and y, with the scale of the mode.
    pub u_x: [f64; 2],
    pub u_y: [f64; 2],
}

/// One mode; complex amplitudes \[re, im\] at every node, motion Re(u e^{iωt}), arbitrary common scale.
#[derive(Clone, Debug)]
pub struct ModeShape {
    /// E.g. "27.1 Hz, 1st bending, forward".
    pub title: String,
    pub whirl: Whirl,
    pub u_x: Vec<[f64; 2]>,
    pub u_y: Vec<[f64; 2]>,
    /// Axial displacement; may be empty.
    pub u_z: Vec<[f64; 2]>,
    /// Twist \[rad\]; may be empty.
    pub theta_z: Vec<[f64; 2]>,
    pub bodies: Vec<BodyMotion>,
}

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
    const H: f64 = 212.0;
    let count = data.modes.len().min(MAX_MODES);
    let columns = if count > 1 { 2 } else { 1 };
    let width = (W * columns as f64 + 16.0).max(WIDTH * 0.66);
    let (mut svg, top) = page_heading(width, 16.0, &data.title, &data.note, &[]);
    for (k, mode) in data.modes.iter().take(MAX_MODES).enumerate() {
        let frame =
            Frame { x: 8.0 + W * (k % columns) as f64, y: top + H * (k / columns) as f64, w: W, h: H };
        panel(&mut svg, &data.rotor, mode, frame, k == 0);
    }
    let bottom = top + H * count.div_ceil(columns).max(1) as f64;
    svg.text([16.0, bottom + 12.0], HOW_TO_READ, Text::new(SMALL, MUTED));
    svg.height = bottom + 24.0;
    svg
}

const HOW_TO_READ: &str = "Line: shaft at phase 0. Orbits run from the dot to the gap (whirl direction).";

/// Axonometric view of one machine in a panel.
struct View {
    origin: Point,
    /// px per m along the shaft.
    along: f64,
    /// Mid-length of the shaft \[m\].
    middle: f64,
}

impl View {
    fn new(rotor: &Rotor, frame: Frame) -> Self {
        let z =
            Range::of(rotor.z.iter().chain(&rotor.bearings).copied().chain(rotor.discs.iter().map(|d| d[0])));
        let along = 0.7 * frame.w / (z.hi - z.lo);
        View { origin: [frame.center()[0], frame.center()[1] + 8.0], along, middle: 0.5 * (z.lo + z.hi) }
    }

    /// Page point of the axial position z \[m\] displaced by x, y, s \[px\] across and along the shaft:
    /// azimuth 30°, elevation 25°; z to the right, y up, x to the back.
    fn at(&self, z: f64, x: f64, y: f64, s: f64) -> Point {
        let z = (z - self.middle) * self.along + s;
        [self.origin[0] + 0.97 * z + 0.5 * x, self.origin[1] - 0.906 * y + 0.17 * z - 0.366 * x]
    }
}

fn panel(svg: &mut Svg, rotor: &Rotor, mode: &ModeShape, frame: Frame, first: bool) {
    let title = font::fit(&mode.title, LABEL, frame.w - 20.0);
    svg.text([frame.x + 8.0, frame.y + 16.0], &title, Text::new(LABEL, INK));
    svg.line(
        [frame.x + 8.0, frame.y + 22.0],
        [frame.right() - 12.0, frame.y + 22.0],
        Style::stroke(GRID, 1.0),
    );
    let view = View::new(rotor, frame);
    undeformed(svg, &view, rotor, frame);
    for z in orbit_nodes(rotor).into_iter().filter_map(|k| rotor.z.get(k)) {
        svg.circle(view.at(*z, 0.0, 0.0, 0.0), 1.5, Style::fill(PALE));
    }
    if first {
        triad(svg, [frame.x + 30.0, frame.bottom() - 34.0]);
    }
    let arm = twist_radius(rotor);
    let Some(scale) = pixels_per_amplitude(mode, arm, 0.22 * frame.h) else { return };
    let color = mode.whirl.color();
    let motion = |k: usize, phase: f64| {
        let part = |u: &[[f64; 2]]| u.get(k).map_or(0.0, |u| scale * at_phase(*u, phase));
        rotor
            .z
            .get(k)
            .map_or([f64::NAN; 2], |&z| view.at(z, part(&mode.u_x), part(&mode.u_y), part(&mode.u_z)))
    };
    // No orbit for purely axial motion: it would coincide with the shaft line.
    let lateral = |k: usize| {
        let size = |u: &[[f64; 2]]| u.get(k).map_or(0.0, |u| scale * u[0].hypot(u[1]));
        size(&mode.u_x).max(size(&mode.u_y)) > 2.0
    };
    for k in orbit_nodes(rotor).into_iter().filter(|k| lateral(*k)) {
        orbit(svg, |phase| motion(k, phase), Style::stroke(color, 0.9));
    }
    axial_arrow(svg, &view, rotor, mode, scale);
    draw_twist(svg, &view, rotor, mode, scale * arm, 0.2 * frame.h);
    let line: Vec<Point> = (0..rotor.z.len()).map(|k| motion(k, 0.0)).collect();
    svg.polyline(&line, Style::stroke(color, 2.2));
    for body in mode.bodies.iter().take(MAX_MODES) {
        let place = |phase| {
            view.at(body.z, scale * at_phase(body.u_x, phase), scale * at_phase(body.u_y, phase), 0.0)
        };
        orbit(svg, place, Style::stroke(MUTED, 0.9));
        let p = place(0.0);
        svg.rect(p[0] - 3.5, p[1] - 3.5, 7.0, 7.0, Style::stroke(INK, 1.0).filled(WHITE));
    }
    for p in orbit_nodes(rotor).into_iter().map(|k| motion(k, 0.0)) {
        svg.circle(p, 2.2, Style::fill(INK));
    }
}

/// Re(u e^{i phase}).
fn at_phase([re, im]: [f64; 2], phase: f64) -> f64 {
    re * phase.cos() - im * phase.sin()
}

/// Radius that converts twist to displacement \[m\]: the largest disc radius, or a tenth of the shaft length.
fn twist_radius(rotor: &Rotor) -> f64 {
    let z = Range::of(rotor.z.iter().copied());
    extremes(rotor.discs.iter().map(|d| d[1]))
        .map(|e| e.1)
        .filter(|r| *r > 0.0)
        .unwrap_or(0.1 * (z.hi - z.lo))
}

/// Common scale of all displacements of the mode, so that small ones are not exaggerated. None without
/// motion.
fn pixels_per_amplitude(mode: &ModeShape, arm: f64, height: f64) -> Option<f64> {
    let size = |u: &[f64; 2]| u[0].hypot(u[1]);
    let lateral = mode.u_x.iter().chain(&mode.u_y).chain(&mode.u_z).map(size);
    let twist = mode.theta_z.iter().map(|t| arm * size(t));
    let bodies = mode.bodies.iter().flat_map(|b| [size(&b.u_x), size(&b.u_y)]);
    let (_, largest) = extremes(lateral.chain(twist).chain(bodies))?;
    (largest > 0.0).then(|| height / largest).filter(|s| s.is_finite())
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
    for &[z, radius] in rotor.discs.iter().take(4 * MAX_MODES) {
        let r = (radius * view.along).clamp(6.0, 0.3 * frame.h);
        let rim: Vec<Point> = (0..48)
            .map(|k| {
                let angle = TAU * f64::from(k) / 48.0;
                view.at(z, r * angle.cos(), r * angle.sin(), 0.0)
            })
            .collect();
        svg.polygon(&rim, Style::stroke(PALE, 0.9).filled(STEEL).faint(0.55));
    }
    let line: Vec<Point> = rotor.z.iter().map(|&z| view.at(z, 0.0, 0.0, 0.0)).collect();
    svg.polyline(&line, Style::stroke(PALE, 1.2).dashed(Dash::Long));
    for &z in rotor.bearings.iter().take(4 * MAX_MODES) {
        let [x, y] = view.at(z, 0.0, 0.0, 0.0);
        svg.polygon(
            &[[x, y + 2.0], [x + 6.0, y + 12.0], [x - 6.0, y + 12.0]],
            Style::stroke(MUTED, 0.9).filled(WHITE),
        );
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
        view.at(rotor.z[k], -length * angle.sin(), length * angle.cos(), 0.0)
    };
    let base: Vec<Point> = rotor.z.iter().map(|&z| view.at(z, 0.0, length, 0.0)).collect();
    svg.polyline(&base, Style::stroke(PALE, 0.8).dashed(Dash::Short));
    for k in orbit_nodes(rotor) {
        svg.line(view.at(rotor.z[k], 0.0, 0.0, 0.0), tip(k, 0.0), Style::stroke(color, 0.9));
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
        svg.arrow(view.at(z, 0.0, 18.0, 0.0), view.at(z, 0.0, 18.0, shift), 8.0, Whirl::Axial.color(), 1.5);
    }
}

/// The axes of the view.
fn triad(svg: &mut Svg, at: Point) {
    let view = View { origin: at, along: 1.0, middle: 0.0 };
    for (name, end) in [
        ("x", view.at(0.0, 24.0, 0.0, 0.0)),
        ("y", view.at(0.0, 0.0, 22.0, 0.0)),
        ("z", view.at(22.0, 0.0, 0.0, 0.0)),
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

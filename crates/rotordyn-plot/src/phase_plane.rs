//! Orbits and phase planes with Poincaré points: shaft orbits on equal axes, displacement and velocity on
//! separate scales.

use super::axes::{Axes, Frame, Marker};
use super::labels::{Entry, page_heading};
use super::orbit::direction;
use super::scale::{Range, extremes};
use super::style::*;
use super::svg::{Color, Dash, Point, Style, Svg, Text};
use super::{decimate, font};

/// Largest number of planes in one figure.
const MAX_PLANES: usize = 12;
/// A clearance circle larger than this multiple of the orbit is not drawn.
const MAX_CLEARANCE_RATIO: f64 = 6.0;

/// One plane of a motion; all values in the units of its axes.
#[derive(Clone, Debug, Default)]
pub struct PhasePlane {
    pub title: String,
    /// Name and unit of each axis.
    pub x_name: String,
    pub x_unit: String,
    pub y_name: String,
    pub y_unit: String,
    /// Equal scale of both axes: a shaft orbit.
    pub equal: bool,
    /// The orbit, in order of time; may be empty.
    pub x: Vec<f64>,
    pub y: Vec<f64>,
    /// Its 1x-filtered part, in order of time; may be empty.
    pub filtered_x: Vec<f64>,
    pub filtered_y: Vec<f64>,
    /// Samples of the orbit at which the keyphasor passes.
    pub keyphasor: Vec<usize>,
    /// Poincaré section points.
    pub section_x: Vec<f64>,
    pub section_y: Vec<f64>,
    /// Radius of the clearance circle about the origin.
    pub clearance: Option<f64>,
}

/// Data of a figure of phase planes.
#[derive(Clone, Debug, Default)]
pub struct PhasePlanes {
    pub title: String,
    pub note: String,
    pub planes: Vec<PhasePlane>,
}

const RAW: Style = Style::stroke(PALE, 0.8);
const FILTERED: Style = Style::stroke(BLUE, 1.8);
const CLEARANCE: Style = Style::stroke(INK, 1.0).dashed(Dash::Long);
const KEYPHASOR: Style = Style::stroke(WHITE, 0.6).filled(INK);
const SECTION: Color = RED;

pub fn draw(data: &PhasePlanes) -> Svg {
    let planes = &data.planes[..data.planes.len().min(MAX_PLANES)];
    let columns = if planes.len() > 1 { 2 } else { 1 };
    let side = if columns == 1 { 380.0 } else { 286.0 };
    let any = |has: fn(&PhasePlane) -> bool| planes.iter().any(has);
    let mut entries = Vec::new();
    if any(|p| !p.x.is_empty()) {
        entries.push(Entry::line("orbit", RAW.thick(1.6)));
    }
    if any(|p| !p.filtered_x.is_empty()) {
        entries.push(Entry::line("1x filtered", FILTERED));
    }
    if any(|p| !p.keyphasor.is_empty()) {
        entries.push(Entry::marker("keyphasor", Marker::Square, KEYPHASOR));
    }
    entries.push(Entry::marker("Poincaré points", Marker::Circle, Style::fill(SECTION)));
    if any(|p| clearance_radius(p).is_some()) {
        entries.push(Entry::line("clearance", CLEARANCE));
    }
    let cell = side + LEFT + RIGHT;
    let width = (cell * columns as f64).max(500.0);
    let (mut svg, top) = page_heading(width, 16.0, &data.title, &data.note, &entries);
    let row = side + BOTTOM + 24.0;
    let none = PhasePlane::default();
    for k in 0..planes.len().max(1) {
        let x = (width - cell * columns as f64) / 2.0 + cell * (k % columns) as f64 + LEFT;
        let y = top + row * (k / columns) as f64 + 18.0;
        panel(&mut svg, planes.get(k).unwrap_or(&none), Frame { x, y, w: side, h: side });
    }
    svg.height = top + row * planes.len().max(1).div_ceil(columns) as f64 + 4.0;
    svg
}

/// Radius of the clearance circle, unless far larger than the orbit.
fn clearance_radius(plane: &PhasePlane) -> Option<f64> {
    let all = plane.x.iter().chain(&plane.y).chain(&plane.section_x).chain(&plane.section_y);
    let seen = extremes(all.map(|v| v.abs())).map_or(0.0, |e| e.1);
    plane.clearance.filter(|c| c.is_finite() && *c > 0.0 && plane.equal && *c < MAX_CLEARANCE_RATIO * seen)
}

fn panel(svg: &mut Svg, plane: &PhasePlane, frame: Frame) {
    let circle = clearance_radius(plane);
    let edge = || circle.into_iter().flat_map(|c| [-c, c]);
    let range =
        |lists: [&[f64]; 3]| Range::of(lists.into_iter().flatten().copied().chain(edge())).padded(0.08);
    let x = range([&plane.x, &plane.filtered_x, &plane.section_x]);
    let y = range([&plane.y, &plane.filtered_y, &plane.section_y]);
    let axes = if plane.equal { Axes::equal(frame, x, y) } else { Axes::linear(frame, x, y) };
    axes.grid(svg);
    if let Some(c) = circle {
        let turn = |k: u32| (f64::from(k) * 3f64).to_radians().sin_cos();
        let points: Vec<Point> = (0..=120).map(turn).map(|(s, o)| axes.at(c * o, c * s)).collect();
        axes.clipped(svg, &points, CLEARANCE);
    }
    let page = |x: &[f64], y: &[f64]| decimate::decimate_curve(x.iter().zip(y).map(|(&x, &y)| axes.at(x, y)));
    let (orbit, filtered) = (page(&plane.x, &plane.y), page(&plane.filtered_x, &plane.filtered_y));
    axes.clipped(svg, &orbit, RAW);
    axes.clipped(svg, &filtered, FILTERED);
    let dots: Vec<Point> =
        plane.section_x.iter().zip(&plane.section_y).map(|(&x, &y)| axes.at(x, y)).collect();
    // Smaller dots for many points, to show the fine structure of the section.
    let radius = if dots.len() > 400 { 1.1 } else { 1.9 };
    svg.dots(dots.into_iter().filter(|p| axes.contains(*p)), radius, SECTION);
    for (&x, &y) in plane.keyphasor.iter().take(400).filter_map(|&k| plane.x.get(k).zip(plane.y.get(k))) {
        let at = axes.at(x, y);
        if axes.contains(at) {
            Marker::Square.draw(svg, at, KEYPHASOR);
        }
    }
    match filtered.len() > 3 {
        true => direction(svg, &filtered, BLUE),
        false => direction(svg, &orbit, INK),
    }
    axes.border(
        svg,
        Some(&axes.x.label(&plane.x_name, &plane.x_unit)),
        &axes.y.label(&plane.y_name, &plane.y_unit),
    );
    let title = font::fit(&plane.title, LABEL, frame.w + 40.0);
    svg.text([frame.x, frame.y - 7.0], &title, Text::new(LABEL, INK));
}

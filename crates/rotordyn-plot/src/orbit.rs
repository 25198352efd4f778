//! Shaft orbits: equal axes, keyphasor dots, direction of whirl, clearance circle.

use super::axes::{Axes, Frame};
use super::labels::{Entry, page_heading};
use super::scale::{Range, extremes};
use super::style::*;
use super::svg::{Dash, Point, Style, Svg, Text};
use super::{decimate, font};

/// Largest number of orbits in one figure.
const MAX_ORBITS: usize = 12;
const MICROMETRES_PER_METRE: f64 = 1e6;

/// Orbit of one station.
#[derive(Clone, Debug, Default)]
pub struct Orbit {
    /// E.g. "disc, 1200 rpm".
    pub title: String,
    /// Displacements as simulated or measured \[m\].
    pub x: Vec<f64>,
    pub y: Vec<f64>,
    /// Displacements of the 1x-filtered orbit \[m\], in order of time; may be empty.
    pub filtered_x: Vec<f64>,
    pub filtered_y: Vec<f64>,
    /// Samples at which the keyphasor passes.
    pub keyphasor: Vec<usize>,
    /// Radius of the clearance circle \[m\], about the origin.
    pub clearance: Option<f64>,
}

/// Data of an orbit figure.
#[derive(Clone, Debug, Default)]
pub struct Orbits {
    pub title: String,
    pub note: String,
    pub orbits: Vec<Orbit>,
}

/// Points on the page from which an orbit is drawn thin.
const LONG: usize = 500;
const RAW: Style = Style::stroke(PALE, 0.9);
const FILTERED: Style = Style::stroke(BLUE, 1.8);
const CLEARANCE: Style = Style::stroke(RED, 1.1).dashed(Dash::Long);

pub fn draw(data: &Orbits) -> Svg {
    const SIDE: f64 = 270.0;
    let orbits = &data.orbits[..data.orbits.len().min(MAX_ORBITS)];
    let columns = if orbits.len() > 1 { 2 } else { 1 };
    let mut entries = Vec::new();
    // A single unfiltered orbit needs no legend.
    if orbits.iter().any(|o| !o.filtered_x.is_empty()) {
        entries.extend([Entry::line("raw", RAW.thick(1.4)), Entry::line("1x filtered", FILTERED)]);
    }
    if orbits.iter().any(|o| !o.keyphasor.is_empty()) {
        entries.push(Entry::marker("keyphasor", super::axes::Marker::Circle, Style::fill(INK)));
    }
    if orbits.iter().any(|o| o.clearance.is_some()) {
        entries.push(Entry::line("clearance", CLEARANCE));
    }
    let cell = SIDE + LEFT + RIGHT;
    let width = (cell * columns as f64).max(430.0);
    let (mut svg, top) = page_heading(width, 16.0, &data.title, &data.note, &entries);
    let titled = orbits.iter().any(|o| !o.title.is_empty());
    let row = SIDE + BOTTOM + if titled { 24.0 } else { 6.0 };
    let none = Orbit::default();
    for k in 0..orbits.len().max(1) {
        let x = (width - cell * columns as f64) / 2.0 + cell * (k % columns) as f64 + LEFT;
        let y = top + row * (k / columns) as f64 + if titled { 18.0 } else { 0.0 };
        panel(&mut svg, orbits.get(k).unwrap_or(&none), Frame { x, y, w: SIDE, h: SIDE });
    }
    svg.height = top + row * orbits.len().max(1).div_ceil(columns) as f64 + 4.0;
    svg
}

fn panel(svg: &mut Svg, orbit: &Orbit, frame: Frame) {
    let micro = |list: &[f64]| -> Vec<f64> { list.iter().map(|v| v * MICROMETRES_PER_METRE).collect() };
    let (x, y) = (micro(&orbit.x), micro(&orbit.y));
    let (fx, fy) = (micro(&orbit.filtered_x), micro(&orbit.filtered_y));
    let clearance = orbit.clearance.filter(|c| c.is_finite() && *c > 0.0).map(|c| c * MICROMETRES_PER_METRE);
    // A clearance circle much larger than the orbit is not drawn.
    let max_displacement =
        extremes(x.iter().chain(&y).chain(&fx).chain(&fy).map(|v| v.abs())).map_or(0.0, |e| e.1);
    let ring = clearance.filter(|c| *c < 6.0 * max_displacement || max_displacement == 0.0);
    let edge = ring.map_or([0.0, 0.0], |c| [-c, c]);
    let edges = || ring.into_iter().flat_map(move |_| edge);
    let range = |a: &[f64], b: &[f64]| Range::of(a.iter().chain(b).copied().chain(edges())).padded(0.1);
    let axes = Axes::equal(frame, range(&x, &fx), range(&y, &fy));
    axes.grid(svg);
    if let Some(c) = ring {
        let circle: Vec<Point> = (0..=120)
            .map(|k| (f64::from(k) * 3f64).to_radians().sin_cos())
            .map(|(s, o)| axes.at(c * o, c * s))
            .collect();
        axes.clipped(svg, &circle, CLEARANCE);
    }
    let page = |x: &[f64], y: &[f64]| decimate::decimate_curve(x.iter().zip(y).map(|(&x, &y)| axes.at(x, y)));
    let filtered = page(&fx, &fy);
    let raw = page(&x, &y);
    let style = match filtered.is_empty() {
        true if raw.len() > LONG => FILTERED.thick(0.8),
        true => FILTERED,
        false => RAW,
    };
    axes.clipped(svg, &raw, style);
    axes.clipped(svg, &filtered, FILTERED);
    if filtered.len() > 3 {
        direction(svg, &filtered, BLUE)
    } else {
        direction(svg, &raw, INK)
    }
    for (&kx, &ky) in orbit.keyphasor.iter().take(400).filter_map(|&k| x.get(k).zip(y.get(k))) {
        let at = axes.at(kx, ky);
        if axes.contains(at) {
            svg.circle(at, 2.6, Style::fill(INK));
        }
    }
    axes.border(svg, Some(&axes.x.label("x", "µm")), &axes.y.label("y", "µm"));
    let title = font::fit(&orbit.title, LABEL, frame.w + 40.0);
    svg.text([frame.x, frame.y - 7.0], &title, Text::new(LABEL, INK));
}

/// Arrow head on the orbit that shows its direction.
pub(super) fn direction(svg: &mut Svg, points: &[Point], color: super::svg::Color) {
    let k = points.len() / 4;
    let Some(&tail) = points.get(k) else { return };
    let ahead = points.iter().skip(k).find(|p| (p[0] - tail[0]).hypot(p[1] - tail[1]) > 13.0);
    if let Some(&tip) = ahead {
        svg.arrow(tail, tip, 14.0, color, 1.8);
    }
}

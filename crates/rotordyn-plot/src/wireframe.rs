//! Mode shapes of a measured structure as wireframes: undeformed and deformed.

use super::font;
use super::labels::{Entry, page_heading};
use super::scale::extremes;
use super::style::*;
use super::svg::{Point, Style, Svg, Text};

/// One shape.
#[derive(Clone, Debug, Default)]
pub struct WireShape {
    /// Title of the panel, e.g. "1: 18.84 Hz, 0.34 %".
    pub title: String,
    /// Deflection of every point at the phase of the largest deflection, any unit; NaN if unknown.
    pub motion: Vec<[f64; 3]>,
}

/// Data of a wireframe figure.
#[derive(Clone, Debug, Default)]
pub struct Wireframe {
    pub title: String,
    pub note: String,
    /// Points \[m\].
    pub points: Vec<[f64; 3]>,
    /// Lines through points, by index.
    pub strokes: Vec<Vec<usize>>,
    pub shapes: Vec<WireShape>,
}

/// Size of a panel \[px\], number of columns, largest number of panels.
const PANEL: [f64; 2] = [236.0, 190.0];
const COLUMNS: usize = 3;
const MAX_SHAPES: usize = 24;
/// Drawn largest deflection as a fraction of the size of the structure.
const DEFLECTION: f64 = 0.16;

pub fn draw(data: &Wireframe) -> Svg {
    let entries = [
        Entry::line("undeformed", Style::stroke(PALE, 1.0)),
        Entry::line("deformed", Style::stroke(BLUE, 1.4)),
    ];
    let (mut svg, top) = page_heading(WIDTH, LEFT, &data.title, &data.note, &entries);
    let shapes = &data.shapes[..data.shapes.len().min(MAX_SHAPES)];
    let size = (0..3)
        .filter_map(|a| extremes(data.points.iter().map(|p| p[a])))
        .map(|(lo, hi)| hi - lo)
        .fold(0.0, f64::max);
    // Oblique view from above: x to the right, y to the back, z up.
    let flat = |p: &[f64; 3]| [0.94 * p[0] + 0.42 * p[1], -(0.34 * p[1] - 0.15 * p[0]) - 0.9 * p[2]];
    let seen: Vec<Point> = data.points.iter().map(flat).collect();
    let Some(((x0, x1), (y0, y1))) =
        extremes(seen.iter().map(|p| p[0])).zip(extremes(seen.iter().map(|p| p[1])))
    else {
        svg.height = top + 20.0;
        return svg;
    };
    let room = 2.0 * DEFLECTION * size;
    let scale = (PANEL[0] / (x1 - x0 + 0.02 * size)).min((PANEL[1] - 30.0) / (y1 - y0 + room));
    for (k, shape) in shapes.iter().enumerate() {
        let (column, row) = (k % COLUMNS, k / COLUMNS);
        let corner = [24.0 + (PANEL[0] + 4.0) * column as f64, top + PANEL[1] * row as f64];
        svg.text(
            [corner[0] + 0.5 * PANEL[0], corner[1] + 12.0],
            &font::fit(&font::shorten(&shape.title, 60), SMALL, PANEL[0]),
            Text::new(SMALL, INK).middle(),
        );
        let center = [corner[0] + 0.5 * PANEL[0], corner[1] + 18.0 + 0.5 * (PANEL[1] - 26.0)];
        let place = |p: [f64; 2]| {
            [center[0] + scale * (p[0] - 0.5 * (x0 + x1)), center[1] + scale * (p[1] - 0.5 * (y0 + y1))]
        };
        let lengths = shape.motion.iter().map(|m| m.iter().map(|v| v * v).sum::<f64>().sqrt());
        let largest = lengths.fold(0.0, f64::max);
        let factor = if largest > 0.0 { DEFLECTION * size / largest } else { 0.0 };
        let moved: Vec<Point> = data
            .points
            .iter()
            .zip(&shape.motion)
            .map(|(p, m)| flat(&[p[0] + factor * m[0], p[1] + factor * m[1], p[2] + factor * m[2]]))
            .collect();
        let lines = |svg: &mut Svg, points: &[Point], style: Style| {
            for stroke in &data.strokes {
                let known = stroke.iter().filter_map(|&k| points.get(k)).filter(|p| p[0].is_finite());
                let path: Vec<Point> = known.map(|p| place(*p)).collect();
                svg.polyline(&path, style);
            }
        };
        lines(&mut svg, &seen, Style::stroke(PALE, 0.9));
        if data.strokes.is_empty() {
            for (a, b) in seen.iter().zip(&moved).filter(|(_, b)| b[0].is_finite()) {
                svg.line(place(*a), place(*b), Style::stroke(BLUE, 0.9));
            }
        }
        lines(&mut svg, &moved, Style::stroke(BLUE, 1.3));
        for point in moved.iter().filter(|p| p[0].is_finite()) {
            svg.circle(place(*point), 1.6, Style::fill(BLUE));
        }
    }
    svg.height = top + PANEL[1] * shapes.len().div_ceil(COLUMNS) as f64 + 10.0;
    svg
}

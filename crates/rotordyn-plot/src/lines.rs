//! General line figure: y over x, such as order cuts.

use super::axes::{Axes, Frame, Marker};
use super::labels::{Entry, page_heading};
use super::scale::{Kind, Range, Scale};
use super::style::*;
use super::svg::{Color, Point, Style, Svg};

/// One curve.
#[derive(Clone, Debug, Default)]
pub struct Curve {
    pub label: String,
    pub x: Vec<f64>,
    pub y: Vec<f64>,
    /// Points only, without a line between them (measured or reference values).
    pub points: bool,
}

/// Data of a line figure.
#[derive(Clone, Debug, Default)]
pub struct Lines {
    pub title: String,
    pub note: String,
    /// Name and unit of each axis.
    pub x_name: String,
    pub x_unit: String,
    pub y_name: String,
    pub y_unit: String,
    pub curves: Vec<Curve>,
    pub log_x: bool,
    pub log_y: bool,
    /// The y axis starts at zero (amplitudes, RMS).
    pub from_zero: bool,
    /// Ends of a linear x axis; by default those of the data.
    pub x_range: Option<[f64; 2]>,
    /// Range (lower, upper) about every point of every curve, drawn as a band; empty for none.
    pub bands: Vec<Vec<[f64; 2]>>,
}

pub fn draw(data: &Lines) -> Svg {
    let style = |k: usize| Style::stroke(INK, 0.0).filled(curve(k).stroke.unwrap_or(INK));
    const SHAPES: [Marker; 4] = [Marker::Circle, Marker::Square, Marker::Diamond, Marker::Up];
    let entry = |(k, c): (usize, &Curve)| {
        if c.points {
            Entry::marker(&c.label, SHAPES[k % SHAPES.len()], style(k))
        } else {
            Entry::line(&c.label, curve(k))
        }
    };
    let entries: Vec<Entry> = match data.curves.as_slice() {
        [only] if only.label.is_empty() => Vec::new(),
        curves => curves.iter().enumerate().map(entry).collect(),
    };
    let (mut svg, top) = page_heading(WIDTH, LEFT, &data.title, &data.note, &entries);
    let frame = Frame { x: LEFT, y: top, w: WIDTH - LEFT - RIGHT, h: 340.0 };
    let xs = || data.curves.iter().flat_map(|c| c.x.iter().copied());
    let ys = || data.curves.iter().flat_map(|c| &c.y).chain(data.bands.iter().flatten().flatten()).copied();
    let x = if data.log_x {
        Scale::log(Range::positive(xs()), frame.across(), 60.0)
    } else {
        let range = data.x_range.map_or_else(|| Range::of(xs()).near_zero(), |[lo, hi]| Range::new(lo, hi));
        Scale::linear(range, frame.across(), 80.0)
    };
    let y = if data.log_y {
        Scale::log(Range::positive(ys()).log_padded(0.04), frame.up(), 26.0)
    } else if data.from_zero {
        Scale::linear(Range::with_zero(ys()).padded_top(0.06), frame.up(), 48.0)
    } else {
        Scale::linear(Range::of(ys()).padded(0.06), frame.up(), 48.0)
    };
    let axes = Axes { frame, x, y };
    axes.grid(&mut svg);
    if axes.y.kind == Kind::Linear && axes.y.range.contains(0.0) {
        axes.segment(&mut svg, [axes.x.range.lo, 0.0], [axes.x.range.hi, 0.0], Style::stroke(PALE, 0.9));
    }
    for (k, (c, band)) in data.curves.iter().zip(&data.bands).enumerate() {
        draw_band(&mut svg, &axes, &c.x, band, curve(k).stroke.unwrap_or(INK));
    }
    for (k, c) in data.curves.iter().enumerate() {
        if c.points || c.x.len() == 1 {
            axes.markers(&mut svg, &c.x, &c.y, SHAPES[k % SHAPES.len()], style(k), 2.0);
        } else {
            axes.curve(&mut svg, &c.x, &c.y, curve(k));
        }
    }
    axes.border(
        &mut svg,
        Some(&axes.x.label(&data.x_name, &data.x_unit)),
        &axes.y.label(&data.y_name, &data.y_unit),
    );
    svg.height = frame.bottom() + BOTTOM;
    svg
}

/// The range about a curve as a pale area, clipped to the frame.
fn draw_band(svg: &mut Svg, axes: &Axes, x: &[f64], band: &[[f64; 2]], color: Color) {
    if band.len() != x.len() || x.len() < 2 {
        return;
    }
    let (bottom, top) = (axes.y.range.lo, axes.y.range.hi);
    let along =
        |side: usize| x.iter().zip(band).map(move |(x, ends)| axes.at(*x, ends[side].clamp(bottom, top)));
    let outline: Vec<Point> = along(0).chain(along(1).rev()).collect();
    svg.polygon(&outline, Style { opacity: 0.18, ..Style::fill(color) });
}

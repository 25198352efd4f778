//! Static deflection of the shaft's centreline.

use super::axes::Marker;
use super::axes::{Axes, Frame};
use super::labels::{Entry, NameRow, page_heading};
use super::scale::Range;
use super::style::*;
use super::svg::{Dash, Style, Svg};
use rotordyn_linalg::piecewise_within;

/// A labelled station of the shaft.
#[derive(Clone, Debug, Default)]
pub struct Mark {
    pub label: String,
    /// Axial position \[m\].
    pub z: f64,
}

/// Data of a deflection figure.
#[derive(Clone, Debug, Default)]
pub struct Deflection {
    pub title: String,
    pub note: String,
    /// Axial positions of the nodes \[m\], ascending.
    pub z: Vec<f64>,
    /// Displacements \[m\].
    pub u_x: Vec<f64>,
    pub u_y: Vec<f64>,
    pub stations: Vec<Mark>,
}

pub fn draw(data: &Deflection) -> Svg {
    let horizontal = Style::stroke(BLUE, 1.6).dashed(Dash::Long);
    let vertical = Style::stroke(RED, 1.9);
    let dot = |style: Style| Style::fill(style.stroke.unwrap_or(INK));
    let entries = [
        Entry::line("horizontal (x)", horizontal).marked(Marker::Square, dot(horizontal)),
        Entry::line("vertical (y)", vertical).marked(Marker::Circle, dot(vertical)),
    ];
    let (mut svg, top) = page_heading(WIDTH, LEFT, &data.title, &data.note, &entries);
    let scaled = |list: &[f64], by: f64| -> Vec<f64> { list.iter().map(|v| v * by).collect() };
    let z = scaled(&data.z, 1e3);
    let (u_x, u_y) = (scaled(&data.u_x, 1e6), scaled(&data.u_y, 1e6));
    let x = Range::of(z.iter().copied().chain(data.stations.iter().map(|s| 1e3 * s.z))).padded(0.02);
    let y = Range::with_zero(u_x.iter().chain(&u_y).copied()).padded(0.08);
    let frame = Frame { x: LEFT, y: top, w: WIDTH - LEFT - RIGHT, h: 300.0 };
    let row = |axes: &Axes| {
        NameRow::new(data.stations.iter().map(|s| (axes.x.px(1e3 * s.z), s.label.clone())), WIDTH)
    };
    // The height of the name row shifts the panel down; x positions do not depend on it.
    let frame = Frame { y: top + 10.0 + row(&Axes::linear(frame, x, y)).height, ..frame };
    let axes = Axes::linear(frame, x, y);
    axes.grid(&mut svg);
    axes.segment(&mut svg, [x.lo, 0.0], [x.hi, 0.0], Style::stroke(PALE, 1.2));
    for at in data.stations.iter().map(|s| axes.x.px(1e3 * s.z)) {
        svg.line([at, frame.y], [at, frame.bottom()], Style::stroke(PALE, 0.8).dashed(Dash::Short));
    }
    row(&axes).draw(&mut svg, frame.y, true, MUTED);
    for (u, style, marker) in [(&u_x, horizontal, Marker::Square), (&u_y, vertical, Marker::Circle)] {
        axes.curve(&mut svg, &z, u, style);
        let line: Vec<[f64; 2]> = z.iter().zip(u).map(|(z, u)| [*z, *u]).collect();
        for station in &data.stations {
            if let Some([_, value]) = piecewise_within(&line, 1e3 * station.z) {
                axes.markers(&mut svg, &[1e3 * station.z], &[value], marker, dot(style), 0.0);
            }
        }
    }
    axes.border(&mut svg, Some(&axes.x.label("axial position z", "mm")), &axes.y.label("deflection", "µm"));
    svg.height = frame.bottom() + BOTTOM;
    svg
}

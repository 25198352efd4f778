//! Panel grid (small multiples): several quantities over one abscissa, one panel each.

use super::axes::{Axes, Frame, Marker};
use super::labels::{Entry, page_heading};
use super::lines::Curve;
use super::scale::{Range, Scale};
use super::style::*;
use super::svg::{Style, Svg};

/// One panel.
#[derive(Clone, Debug, Default)]
pub struct GridPanel {
    /// Name and unit of its y axis.
    pub name: String,
    pub unit: String,
    /// One curve per legend entry of the figure, in its order; an empty curve is not drawn.
    pub curves: Vec<Curve>,
    /// The y axis includes zero.
    pub from_zero: bool,
    pub log_y: bool,
}

/// Data of a panel grid.
#[derive(Clone, Debug, Default)]
pub struct Grid {
    pub title: String,
    pub note: String,
    pub x_name: String,
    pub x_unit: String,
    /// Names of the curves; none when every panel has one.
    pub legend: Vec<String>,
    pub panels: Vec<GridPanel>,
    /// Number of panels per row.
    pub columns: usize,
    /// Value of x marked in every panel, such as the operating point.
    pub mark: Option<f64>,
}

/// Largest number of panels in one figure.
const MAX_PANELS: usize = 24;

pub fn draw(data: &Grid) -> Svg {
    const CELL: [f64; 2] = [226.0, 150.0];
    let panels = &data.panels[..data.panels.len().min(MAX_PANELS)];
    let columns = data.columns.clamp(1, 4).min(panels.len().max(1));
    let page = (LEFT + CELL[0]) * columns as f64 + RIGHT;
    let style = |k: usize| if data.legend.is_empty() { Style::stroke(BLUE, 1.5) } else { curve(k) };
    let entries: Vec<Entry> =
        data.legend.iter().enumerate().map(|(k, name)| entry(data, k, name, style(k))).collect();
    let (mut svg, top) = page_heading(page.max(430.0), LEFT, &data.title, &data.note, &entries);
    let rows = panels.len().max(1).div_ceil(columns);
    let x = Range::of(panels.iter().flat_map(|p| &p.curves).flat_map(|c| c.x.iter().copied())).near_zero();
    for (k, panel) in panels.iter().enumerate() {
        let (column, row) = (k % columns, k / columns);
        let frame = Frame {
            x: LEFT + (LEFT + CELL[0]) * column as f64,
            y: top + (CELL[1] + GAP) * row as f64,
            w: CELL[0],
            h: CELL[1],
        };
        // Only the lowest panel of a column has an x label.
        let lowest = k + columns >= panels.len();
        let ys = panel.curves.iter().flat_map(|c| c.y.iter().copied());
        let y = if panel.log_y {
            Scale::log(Range::positive(ys).log_padded(0.04), frame.up(), 26.0)
        } else if panel.from_zero {
            Scale::linear(Range::with_zero(ys).padded_top(0.06), frame.up(), 32.0)
        } else {
            Scale::linear(with_min_span(Range::of(ys)).padded(0.06), frame.up(), 32.0)
        };
        let axes = Axes { frame, x: Scale::linear(x, frame.across(), 60.0), y };
        axes.grid(&mut svg);
        if let Some(mark) = data.mark.filter(|mark| x.contains(*mark)) {
            let at = axes.x.px(mark);
            svg.line(
                [at, frame.y],
                [at, frame.bottom()],
                Style::stroke(MUTED, 0.8).dashed(super::svg::Dash::Short),
            );
        }
        for (k, c) in panel.curves.iter().enumerate() {
            if c.points || c.x.len() == 1 {
                axes.markers(&mut svg, &c.x, &c.y, marker(k), filled(style(k)), 2.0);
            } else {
                axes.curve(&mut svg, &c.x, &c.y, style(k));
            }
        }
        let x_label = axes.x.label(&data.x_name, &data.x_unit);
        axes.border(&mut svg, lowest.then_some(x_label.as_str()), &axes.y.label(&panel.name, &panel.unit));
    }
    svg.height = top + (CELL[1] + GAP) * rows as f64 - GAP + BOTTOM;
    svg
}

/// Shape of the points of curve number k.
fn marker(k: usize) -> Marker {
    const SHAPES: [Marker; 4] = [Marker::Circle, Marker::Square, Marker::Diamond, Marker::Up];
    SHAPES[k % SHAPES.len()]
}

fn filled(style: Style) -> Style {
    Style::stroke(INK, 0.0).filled(style.stroke.unwrap_or(INK))
}

/// Legend entry of curve number k: a marker if it has points in every panel.
fn entry(data: &Grid, k: usize, name: &str, style: Style) -> Entry {
    let mut curves = data.panels.iter().filter_map(|panel| panel.curves.get(k)).peekable();
    if curves.peek().is_some() && curves.all(|curve| curve.points) {
        return Entry::marker(name, marker(k), filled(style));
    }
    Entry::line(name, style)
}

/// Range of at least ±0.1 % of its mean, so that round-off of a constant does not fill the panel.
fn with_min_span(range: Range) -> Range {
    let middle = 0.5 * (range.lo + range.hi);
    let half = (0.5 * (range.hi - range.lo)).max(1e-3 * middle.abs());
    Range::new(middle - half, middle + half)
}

//! Spectra with cursors: labelled vertical lines, and markers on detected peaks.

use super::axes::{Axes, Frame, Marker};
use super::labels::{EndLabel, Entry, end_labels, page_heading};
use super::lines::Curve;
use super::panels::stack;
use super::scale::{Range, Scale};
use super::style::*;
use super::svg::{Color, Dash, Style, Svg, Text};

/// A vertical line at a value of the x axis.
#[derive(Clone, Debug, Default)]
pub struct Cursor {
    pub at: f64,
    /// Label above the panel; empty for sidebands, which are drawn thin.
    pub label: String,
    /// Cursors of one group have the same style.
    pub group: usize,
}

/// A detected peak that belongs to a group of cursors.
#[derive(Clone, Debug, Default)]
pub struct CursorMark {
    pub x: f64,
    pub y: f64,
    pub group: usize,
}

/// One spectrum with its cursors.
#[derive(Clone, Debug, Default)]
pub struct CursorPanel {
    /// Label inside the panel; empty for a single panel.
    pub label: String,
    /// Name and unit of the y axis.
    pub y_name: String,
    pub y_unit: String,
    pub curves: Vec<Curve>,
    pub cursors: Vec<Cursor>,
    pub found: Vec<CursorMark>,
}

/// Data of stacked spectra with cursors and a common x axis.
#[derive(Clone, Debug, Default)]
pub struct CursorLines {
    pub title: String,
    pub note: String,
    /// Name and unit of the x axis.
    pub x_name: String,
    pub x_unit: String,
    /// Legend names of the cursor groups; an empty name has no entry.
    pub groups: Vec<String>,
    pub panels: Vec<CursorPanel>,
    pub log_y: bool,
    /// Ends of the x axis; by default 0 and the last abscissa.
    pub x_range: Option<[f64; 2]>,
}

/// Colour and dash of a group, distinguishable in grey too.
fn group_style(group: usize) -> Style {
    const COLORS: [Color; 7] = [MUTED, RED, ORANGE, GREEN, PURPLE, BLUE, INK];
    const DASHES: [Dash; 7] =
        [Dash::Short, Dash::Solid, Dash::DashDot, Dash::Long, Dash::Dotted, Dash::Dotted, Dash::Dotted];
    Style::stroke(COLORS[group % COLORS.len()], 1.0).dashed(DASHES[group % DASHES.len()])
}

fn group_color(group: usize) -> Color {
    group_style(group).stroke.unwrap_or(INK)
}

const SHAPES: [Marker; 7] = [
    Marker::Circle,
    Marker::Diamond,
    Marker::Square,
    Marker::Up,
    Marker::Down,
    Marker::Circle,
    Marker::Diamond,
];

fn mark_style(group: usize) -> Style {
    Style::stroke(group_color(group), 1.2).filled(WHITE)
}

pub fn draw(data: &CursorLines) -> Svg {
    let found = || data.panels.iter().flat_map(|p| &p.found);
    let mut entries: Vec<Entry> = Vec::new();
    for (group, name) in data.groups.iter().enumerate().filter(|(_, name)| !name.is_empty()) {
        let line = Entry::line(name, group_style(group));
        let marked = found().any(|f| f.group == group);
        entries.push(if marked { line.marked(shape(group), mark_style(group)) } else { line });
    }
    let named = data.panels.first().into_iter().flat_map(|p| p.curves.iter().enumerate());
    let named = named.filter(|(_, c)| !c.label.is_empty());
    entries.extend(named.map(|(k, c)| Entry::line(&c.label, curve(k).thick(0.9))));
    let (mut svg, top) = page_heading(WIDTH, LEFT, &data.title, &data.note, &entries);
    let height = if data.panels.len() > 1 { 220.0 } else { 340.0 };
    let frames = stack(top + 16.0, WIDTH - LEFT - RIGHT, &vec![height; data.panels.len().max(1)]);
    let x = match data.x_range.filter(|x| x.iter().all(|end| end.is_finite())) {
        Some([a, b]) => Range::new(a, b),
        None => Range::of(curves(data).flat_map(|c| c.x.iter().copied())).near_zero(),
    };
    let none = CursorPanel::default();
    for (k, frame) in frames.iter().enumerate() {
        let panel_data = data.panels.get(k).unwrap_or(&none);
        panel(&mut svg, *frame, x, data, panel_data, [k == 0, k + 1 == frames.len()]);
    }
    svg.height = frames.last().map_or(top, |f| f.bottom()) + BOTTOM;
    svg
}

fn curves(data: &CursorLines) -> impl Iterator<Item = &Curve> {
    data.panels.iter().flat_map(|p| &p.curves)
}

fn shape(group: usize) -> Marker {
    SHAPES[group % SHAPES.len()]
}

fn panel(
    svg: &mut Svg,
    frame: Frame,
    x: Range,
    data: &CursorLines,
    of: &CursorPanel,
    [first, last]: [bool; 2],
) {
    let shown = |c: &Curve| -> Vec<f64> {
        c.x.iter().zip(&c.y).filter(|(at, _)| x.contains(**at)).map(|(_, y)| *y).collect()
    };
    // An interpolated peak between bins lies above the curve.
    let marks = || of.found.iter().filter(|f| x.contains(f.x)).map(|f| f.y);
    let ys = || of.curves.iter().flat_map(shown).chain(marks());
    let y = if data.log_y {
        Scale::log(Range::positive(ys()).log_padded(0.04), frame.up(), 26.0)
    } else {
        Scale::linear(Range::with_zero(ys()).padded_top(0.06), frame.up(), 48.0)
    };
    let axes = Axes { frame, x: Scale::linear(x, frame.across(), 80.0), y };
    axes.grid(svg);
    let (bottom, upper) = (axes.y.range.lo, axes.y.range.hi);
    let mut labels = Vec::new();
    for cursor in of.cursors.iter().filter(|c| axes.x.range.contains(c.at)) {
        let style = group_style(cursor.group);
        let style = if cursor.label.is_empty() { style.thick(0.6).faint(0.45) } else { style.faint(0.8) };
        axes.segment(svg, [cursor.at, bottom], [cursor.at, upper], style);
        labels.push(EndLabel {
            at: [axes.x.px(cursor.at), frame.y],
            text: cursor.label.clone(),
            color: group_color(cursor.group),
        });
    }
    for (k, c) in of.curves.iter().enumerate() {
        axes.curve(svg, &c.x, &c.y, curve(k).thick(0.9));
    }
    for group in 0..data.groups.len() {
        let (xs, ys): (Vec<f64>, Vec<f64>) =
            of.found.iter().filter(|f| f.group == group).map(|f| (f.x, f.y)).unzip();
        axes.markers(svg, &xs, &ys, shape(group), mark_style(group), 0.0);
    }
    let x_label = axes.x.label(&data.x_name, &data.x_unit);
    axes.border(svg, last.then_some(x_label.as_str()), &axes.y.label(&of.y_name, &of.y_unit));
    if first {
        end_labels(svg, &axes, &labels);
    }
    if !of.label.is_empty() {
        svg.text([frame.right() - 8.0, frame.y + 15.0], &of.label, Text::new(TICK, INK).end().halo());
    }
}

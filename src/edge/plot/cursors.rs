//! A spectrum with cursors: vertical lines at named places, and marks on the peaks found there.

use super::axes::{Axes, Frame, Marker};
use super::labels::{EndLabel, Entry, end_labels, head};
use super::lines::Curve;
use super::scale::{Range, Scale};
use super::style::*;
use super::svg::{Color, Dash, Style, Svg};

/// A vertical line at a place of the x axis.
#[derive(Clone, Debug, Default)]
pub struct Cursor {
    pub at: f64,
    /// Written above the panel; empty for side bands and the like, which are drawn thin.
    pub label: String,
    /// Cursors of one group look alike.
    pub group: usize,
}

/// A point on the curve that belongs to a group of cursors.
#[derive(Clone, Debug, Default)]
pub struct CursorMark {
    pub x: f64,
    pub y: f64,
    pub group: usize,
}

/// Data of a spectrum with cursors.
#[derive(Clone, Debug, Default)]
pub struct CursorLines {
    pub title: String,
    pub note: String,
    /// Name and unit of each axis.
    pub x_name: String,
    pub x_unit: String,
    pub y_name: String,
    pub y_unit: String,
    pub curves: Vec<Curve>,
    /// Names of the cursors' groups, for the legend.
    pub groups: Vec<String>,
    pub cursors: Vec<Cursor>,
    pub found: Vec<CursorMark>,
    pub log_y: bool,
    /// Upper end of the x axis; by default the last abscissa.
    pub max_x: Option<f64>,
}

/// Colour and dash of a group, apart in grey too.
fn group_style(group: usize) -> Style {
    const COLORS: [Color; 5] = [MUTED, RED, ORANGE, GREEN, PURPLE];
    const DASHES: [Dash; 5] = [Dash::Short, Dash::Solid, Dash::DashDot, Dash::Long, Dash::Dotted];
    Style::stroke(COLORS[group % COLORS.len()], 1.0).dashed(DASHES[group % DASHES.len()])
}

fn group_color(group: usize) -> Color {
    group_style(group).stroke.unwrap_or(INK)
}

const SHAPES: [Marker; 5] = [Marker::Circle, Marker::Diamond, Marker::Square, Marker::Up, Marker::Down];

fn mark_style(group: usize) -> Style {
    Style::stroke(group_color(group), 1.2).filled(WHITE)
}

pub fn draw(data: &CursorLines) -> Svg {
    let mut entries: Vec<Entry> = Vec::new();
    for (group, name) in data.groups.iter().enumerate() {
        let line = Entry::line(name, group_style(group));
        let marked = data.found.iter().any(|f| f.group == group);
        let shape = SHAPES[group % SHAPES.len()];
        entries.push(if marked { line.marked(shape, mark_style(group)) } else { line });
    }
    let named = data.curves.iter().enumerate().filter(|(_, c)| !c.label.is_empty());
    entries.extend(named.map(|(k, c)| Entry::line(&c.label, curve(k).thick(0.9))));
    let (mut svg, top) = head(WIDTH, LEFT, &data.title, &data.note, &entries);
    let frame = Frame { x: LEFT, y: top + 16.0, w: WIDTH - LEFT - RIGHT, h: 340.0 };
    let x = match data.max_x.filter(|x| x.is_finite() && *x > 0.0) {
        Some(end) => Range::new(0.0, end),
        None => Range::of(data.curves.iter().flat_map(|c| c.x.iter().copied())).near_zero(),
    };
    let shown = |c: &Curve| -> Vec<f64> {
        c.x.iter().zip(&c.y).filter(|(at, _)| x.contains(**at)).map(|(_, y)| *y).collect()
    };
    let ys = || data.curves.iter().flat_map(shown);
    let y = if data.log_y {
        Scale::log(Range::positive(ys()).log_padded(0.04), frame.up(), 26.0)
    } else {
        Scale::linear(Range::with_zero(ys()).raised(0.06), frame.up(), 48.0)
    };
    let axes = Axes { frame, x: Scale::linear(x, frame.across(), 80.0), y };
    axes.grid(&mut svg);
    let (bottom, upper) = (axes.y.range.lo, axes.y.range.hi);
    let mut labels = Vec::new();
    for cursor in data.cursors.iter().filter(|c| axes.x.range.contains(c.at)) {
        let style = group_style(cursor.group);
        let style = if cursor.label.is_empty() { style.thick(0.6).faint(0.45) } else { style.faint(0.8) };
        axes.segment(&mut svg, [cursor.at, bottom], [cursor.at, upper], style);
        labels.push(EndLabel {
            at: [axes.x.px(cursor.at), frame.y],
            text: cursor.label.clone(),
            color: group_color(cursor.group),
        });
    }
    for (k, c) in data.curves.iter().enumerate() {
        axes.curve(&mut svg, &c.x, &c.y, curve(k).thick(0.9));
    }
    for (group, _) in data.groups.iter().enumerate() {
        let (xs, ys): (Vec<f64>, Vec<f64>) =
            data.found.iter().filter(|f| f.group == group).map(|f| (f.x, f.y)).unzip();
        axes.markers(&mut svg, &xs, &ys, SHAPES[group % SHAPES.len()], mark_style(group), 0.0);
    }
    axes.border(
        &mut svg,
        Some(&axes.x.label(&data.x_name, &data.x_unit)),
        &axes.y.label(&data.y_name, &data.y_unit),
    );
    end_labels(&mut svg, &axes, &labels);
    svg.height = frame.bottom() + BOTTOM;
    svg
}

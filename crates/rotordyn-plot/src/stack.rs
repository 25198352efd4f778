//! Panels one below the other over a common axis, with named marks: loads along the shaft, bearing forces over speed.

use super::axes::{Axes, Marker};
use super::labels::{Entry, NameRow, page_heading};
use super::lines::Curve;
use super::panels::stack;
use super::scale::{Range, Scale};
use super::style::*;
use super::svg::{Dash, Style, Svg};

/// One panel.
#[derive(Clone, Debug, Default)]
pub struct StackPanel {
    /// Name and unit of its y axis.
    pub name: String,
    pub unit: String,
    /// One curve per legend entry of the figure, in its order; an empty curve is not drawn.
    pub curves: Vec<Curve>,
    pub log_y: bool,
    /// The y axis includes zero.
    pub from_zero: bool,
    /// Ends of a linear y axis; by default those of the data.
    pub y_range: Option<[f64; 2]>,
}

/// Data of stacked panels.
#[derive(Clone, Debug, Default)]
pub struct Stack {
    pub title: String,
    pub note: String,
    pub x_name: String,
    pub x_unit: String,
    /// Names of the curves; none when every panel has one.
    pub legend: Vec<String>,
    pub panels: Vec<StackPanel>,
    /// Named positions on the x axis, such as stations or critical speeds.
    pub marks: Vec<(String, f64)>,
    /// Height of a panel \[px\].
    pub height: f64,
}

/// Largest number of panels in one figure.
const MAX_PANELS: usize = 12;

pub fn draw(data: &Stack) -> Svg {
    let panels = &data.panels[..data.panels.len().min(MAX_PANELS)];
    let style = |k: usize| if data.legend.is_empty() { Style::stroke(BLUE, 1.5) } else { curve(k) };
    let filled = |k: usize| Style::stroke(INK, 0.0).filled(style(k).stroke.unwrap_or(INK));
    const SHAPES: [Marker; 4] = [Marker::Circle, Marker::Square, Marker::Diamond, Marker::Up];
    let is_points = |k: usize| {
        let mut curves = panels.iter().filter_map(|panel| panel.curves.get(k)).peekable();
        curves.peek().is_some() && curves.all(|curve| curve.points)
    };
    let entry = |(k, name): (usize, &String)| match is_points(k) {
        true => Entry::marker(name, SHAPES[k % SHAPES.len()], filled(k)),
        false => Entry::line(name, style(k)),
    };
    let entries: Vec<Entry> = data.legend.iter().enumerate().map(entry).collect();
    let (mut svg, top) = page_heading(WIDTH, LEFT, &data.title, &data.note, &entries);
    let xs = panels.iter().flat_map(|p| &p.curves).flat_map(|c| c.x.iter().copied());
    let x = Range::of(xs).near_zero();
    let heights = vec![data.height.max(60.0); panels.len().max(1)];
    let width = WIDTH - LEFT - RIGHT;
    let scale = Scale::linear(x, stack(top, width, &heights)[0].across(), 80.0);
    let shown: Vec<&(String, f64)> = data.marks.iter().filter(|(_, at)| x.contains(*at)).collect();
    let names = NameRow::new(shown.iter().map(|(name, at)| (scale.px(*at), name.clone())), WIDTH);
    let room = if shown.is_empty() { 0.0 } else { names.height + 6.0 };
    let frames = stack(top + room, width, &heights);
    for (k, (panel, frame)) in panels.iter().zip(&frames).enumerate() {
        let ys = || panel.curves.iter().flat_map(|c| c.y.iter().copied());
        let y = if panel.log_y {
            Scale::log(Range::positive(ys()).log_padded(0.04), frame.up(), 26.0)
        } else if let Some([low, high]) = panel.y_range {
            Scale::linear(Range::new(low, high), frame.up(), 32.0)
        } else if panel.from_zero {
            Scale::linear(Range::with_zero(ys()).padded(0.06), frame.up(), 32.0)
        } else {
            Scale::linear(Range::of(ys()).padded(0.06), frame.up(), 32.0)
        };
        let axes = Axes { frame: *frame, x: scale.clone(), y };
        axes.grid(&mut svg);
        if !panel.log_y && axes.y.range.contains(0.0) {
            axes.segment(&mut svg, [x.lo, 0.0], [x.hi, 0.0], Style::stroke(PALE, 1.2));
        }
        for at in shown.iter().map(|(_, at)| axes.x.px(*at)) {
            svg.line([at, frame.y], [at, frame.bottom()], Style::stroke(PALE, 0.8).dashed(Dash::Short));
        }
        for (k, c) in panel.curves.iter().enumerate() {
            if c.points || c.x.len() == 1 {
                axes.markers(&mut svg, &c.x, &c.y, SHAPES[k % SHAPES.len()], filled(k), 2.0);
            } else {
                axes.curve(&mut svg, &c.x, &c.y, style(k));
            }
        }
        let lowest = k + 1 == panels.len();
        let x_label = axes.x.label(&data.x_name, &data.x_unit);
        axes.border(&mut svg, lowest.then_some(x_label.as_str()), &axes.y.label(&panel.name, &panel.unit));
    }
    if let (Some(first), false) = (frames.first(), shown.is_empty()) {
        names.draw(&mut svg, first.y, true, MUTED);
    }
    svg.height = frames.last().map_or(top, |frame| frame.bottom()) + BOTTOM;
    svg
}

//! Campbell diagram (linear): natural frequencies over speed, with order lines and log decrement.

use super::axes::{Axes, Frame, Marker, clip};
use super::font;
use super::labels::{EndLabel, Entry, end_label_width, end_labels, page_heading};
use super::obstacles::Obstacles;
use super::scale::{Range, extremes};
use super::style::*;
use super::svg::{Color, Dash, Point, Style, Svg, Text};

/// Kind of a mode, by whirl direction and energy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Whirl {
    Forward,
    Backward,
    Torsion,
    Axial,
    /// Mixed kind; also planar modes at standstill.
    Mixed,
}

impl Whirl {
    const ALL: [Whirl; 5] = [Whirl::Forward, Whirl::Backward, Whirl::Torsion, Whirl::Axial, Whirl::Mixed];

    /// Name for legends.
    pub fn name(self) -> &'static str {
        match self {
            Whirl::Forward => "forward whirl",
            Whirl::Backward => "backward whirl",
            Whirl::Torsion => "torsional",
            Whirl::Axial => "axial",
            Whirl::Mixed => "mixed or planar",
        }
    }

    pub(super) fn color(self) -> Color {
        match self {
            Whirl::Forward => BLUE,
            Whirl::Backward => RED,
            Whirl::Torsion => GREEN,
            Whirl::Axial => PURPLE,
            Whirl::Mixed => MUTED,
        }
    }

    fn marker(self) -> Marker {
        match self {
            Whirl::Forward => Marker::Up,
            Whirl::Backward => Marker::Down,
            Whirl::Torsion => Marker::Diamond,
            Whirl::Axial => Marker::Square,
            Whirl::Mixed => Marker::Circle,
        }
    }

    fn line(self) -> Style {
        Style::stroke(self.color(), 1.5)
    }

    /// Filled marker for a stable mode, hollow for an unstable one.
    fn marker_style(self, stable: bool) -> Style {
        Style::stroke(self.color(), 1.0).filled(if stable { self.color() } else { WHITE })
    }
}

/// One mode tracked over speed.
#[derive(Clone, Debug)]
pub struct Branch {
    /// Label at the end of the branch, e.g. "1st bending".
    pub label: String,
    /// Kind of the mode at every speed.
    pub whirl: Vec<Whirl>,
    /// Shaft speeds \[rpm\].
    pub rpm: Vec<f64>,
    /// Natural frequencies \[Hz\].
    pub hz: Vec<f64>,
    /// Logarithmic decrements \[-\]; empty if not known.
    pub log_decrement: Vec<f64>,
}

impl Branch {
    /// A curve of values over speed in the style of each kind; a step between two kinds has that of its upper end.
    pub(super) fn curves(&self, svg: &mut Svg, axes: &Axes, values: &[f64], style: impl Fn(Whirl) -> Style) {
        let count = values.len().min(self.rpm.len());
        let mut from = 0;
        for k in 1..count {
            if self.whirl.get(k + 1) != self.whirl.get(k) || k + 1 == count {
                let kind = self.whirl.get(k).copied().unwrap_or(Whirl::Mixed);
                axes.curve(svg, &self.rpm[from..=k], &values[from..=k], style(kind));
                from = k;
            }
        }
    }

    /// Kind at the last speed at which the branch is known.
    fn end_kind(&self) -> Whirl {
        let last = self.hz.iter().rposition(|hz| hz.is_finite()).unwrap_or(0);
        self.whirl.get(last).copied().unwrap_or(Whirl::Mixed)
    }
}

/// A line f = order × rpm / 60.
#[derive(Clone, Debug)]
pub struct OrderLine {
    /// Label at the end of the line, e.g. "2x" or "BPFO".
    pub label: String,
    pub order: f64,
    /// A bearing order (BPFO, BPFI, ...), drawn in another colour and dash than the shaft's harmonics.
    pub bearing: bool,
}

impl OrderLine {
    /// Its frequency at a speed \[rpm\].
    pub(super) fn hz(&self, rpm: f64) -> f64 {
        self.order * rpm / 60.0
    }

    pub(super) fn style(&self) -> Style {
        if self.bearing {
            Style::stroke(ORANGE, 1.0).dashed(Dash::DashDot)
        } else {
            Style::stroke(MUTED, 0.9).dashed(Dash::Short)
        }
    }

    pub(super) fn color(&self) -> Color {
        if self.bearing { ORANGE } else { MUTED }
    }
}

/// A critical speed: a natural frequency on an order line.
#[derive(Clone, Debug)]
pub struct Critical {
    pub rpm: f64,
    pub hz: f64,
    /// Label next to the marker; may be empty.
    pub label: String,
}

/// Data of a linear Campbell diagram.
#[derive(Clone, Debug, Default)]
pub struct Campbell {
    pub title: String,
    /// Line below the title, e.g. the model and bearing.
    pub note: String,
    pub branches: Vec<Branch>,
    pub orders: Vec<OrderLine>,
    pub criticals: Vec<Critical>,
    /// Upper end of the frequency axis \[Hz\]; by default the highest branch.
    pub max_hz: Option<f64>,
}

pub fn draw(data: &Campbell) -> Svg {
    let unstable = data.branches.iter().any(|b| b.log_decrement.iter().any(|d| *d < 0.0));
    let (mut svg, top) = page_heading(WIDTH, LEFT, &data.title, &data.note, &entries(data, unstable));
    let damped = data.branches.iter().any(|b| b.log_decrement.iter().any(|d| d.is_finite()));
    let names = data.branches.iter().map(|b| &b.label).chain(data.orders.iter().map(|o| &o.label));
    let w = WIDTH - LEFT - end_label_width(names.cloned());
    let main = Frame { x: LEFT, y: top + 16.0, w, h: 380.0 };
    let x = Range::of(data.branches.iter().flat_map(|b| b.rpm.iter().copied())).near_zero();
    let y = match data.max_hz.filter(|hz| hz.is_finite() && *hz > 0.0) {
        Some(hz) => Range::new(0.0, hz),
        None => Range::with_zero(data.branches.iter().flat_map(|b| b.hz.iter().copied())).padded_top(0.06),
    };
    let axes = Axes::linear(main, x, y);
    axes.grid(&mut svg);
    let mut labels = order_lines(&mut svg, &axes, &data.orders);
    for branch in &data.branches {
        branch.curves(&mut svg, &axes, &branch.hz, Whirl::line);
        mark_branch(&mut svg, &axes, branch, &branch.hz);
    }
    labels.extend(branch_ends(&axes, &data.branches));
    criticals(&mut svg, &axes, data);
    let x_label = axes.x.label("shaft speed", "rpm");
    axes.border(&mut svg, (!damped).then_some(x_label.as_str()), &axes.y.label("natural frequency", "Hz"));
    end_labels(&mut svg, &axes, &labels);
    svg.height = main.bottom() + BOTTOM;
    if damped {
        let lower = Frame { y: main.bottom() + GAP, h: 120.0, ..main };
        decrements(&mut svg, &data.branches, lower, x, &x_label);
        svg.height = lower.bottom() + BOTTOM;
    }
    svg
}

fn entries(data: &Campbell, unstable: bool) -> Vec<Entry> {
    let kinds = Whirl::ALL.into_iter().filter(|w| data.branches.iter().any(|b| b.whirl.contains(w)));
    let mut entries: Vec<Entry> =
        kinds.map(|w| Entry::line(w.name(), w.line()).marked(w.marker(), w.marker_style(true))).collect();
    if unstable {
        entries.push(Entry::marker(
            "hollow: unstable",
            Marker::Circle,
            Style::stroke(INK, 1.0).filled(WHITE),
        ));
    }
    if !data.criticals.is_empty() {
        entries.push(Entry::marker("critical speed", Marker::Circle, CRITICAL));
    }
    entries
}

const CRITICAL: Style = Style::stroke(INK, 1.4).filled(Color(255, 214, 64));

/// Marker on a branch about every 36 px, hollow where the mode is unstable.
fn mark_branch(svg: &mut Svg, axes: &Axes, branch: &Branch, values: &[f64]) {
    for (whirl, stable) in Whirl::ALL.into_iter().flat_map(|whirl| [(whirl, true), (whirl, false)]) {
        let shown: Vec<f64> = (values.iter().zip(&branch.whirl).enumerate())
            .map(|(k, (v, kind))| {
                let is_stable = branch.log_decrement.get(k).is_none_or(|d| *d >= 0.0 || d.is_nan());
                if *kind == whirl && is_stable == stable { *v } else { f64::NAN }
            })
            .collect();
        axes.markers(svg, &branch.rpm, &shown, whirl.marker(), whirl.marker_style(stable), 36.0);
    }
}

/// Order lines over axes of rpm and Hz; returns the labels of their ends.
pub(super) fn order_lines(svg: &mut Svg, axes: &Axes, orders: &[OrderLine]) -> Vec<EndLabel> {
    let mut labels = Vec::new();
    for order in orders {
        let line = order_line(axes, order);
        svg.polyline(&line, order.style());
        if let Some(&at) = line.last() {
            labels.push(EndLabel { at, text: order.label.clone(), color: order.color() });
        }
    }
    labels
}

/// An order line inside the panel, over axes of rpm and Hz.
fn order_line(axes: &Axes, order: &OrderLine) -> Vec<Point> {
    let (a, b) = (axes.x.range.lo, axes.x.range.hi);
    clip(&[axes.at(a, order.hz(a)), axes.at(b, order.hz(b))], axes.frame)
}

/// Order lines over axes of time and Hz, along the speeds \[rpm\] at some times; returns labels at their highest points.
pub(super) fn order_lines_over_time(
    svg: &mut Svg,
    axes: &Axes,
    orders: &[OrderLine],
    [times, rpm]: [&[f64]; 2],
) -> Vec<EndLabel> {
    let mut labels = Vec::new();
    for order in orders {
        let points: Vec<Point> = times.iter().zip(rpm).map(|(t, rpm)| axes.at(*t, order.hz(*rpm))).collect();
        let line = clip(&points, axes.frame);
        svg.polyline(&line, order.style());
        let highest = line.iter().map(|point| point[1]).filter(|y| y.is_finite()).min_by(f64::total_cmp);
        if let Some(y) = highest {
            let at = [axes.frame.right(), y];
            labels.push(EndLabel { at, text: order.label.clone(), color: order.color() });
        }
    }
    labels
}

/// Labels where the branches leave the panel.
pub(super) fn branch_ends(axes: &Axes, branches: &[Branch]) -> Vec<EndLabel> {
    let mut labels = Vec::new();
    for branch in branches {
        let points: Vec<_> = branch.rpm.iter().zip(&branch.hz).map(|(&x, &y)| axes.at(x, y)).collect();
        if let Some(&at) = clip(&points, axes.frame).last() {
            labels.push(EndLabel { at, text: branch.label.clone(), color: branch.end_kind().color() });
        }
    }
    // A branch that ends before the right edge is labelled there too, at its last height.
    labels.iter_mut().filter(|l| l.at[1] > axes.frame.y + 0.5).for_each(|l| l.at[0] = axes.frame.right());
    labels
}

/// Markers and labels of critical speeds; each label is placed where it covers no line, marker or label, with a
/// leader if that is not beside its marker.
fn criticals(svg: &mut Svg, axes: &Axes, data: &Campbell) {
    let marks: Vec<(Point, &String)> = (data.criticals.iter())
        .map(|c| (axes.at(c.rpm, c.hz), &c.label))
        .filter(|m| axes.contains(m.0))
        .collect();
    let mut obstacles = Obstacles::default();
    for (p, _) in &marks {
        obstacles.add([p[0] - 5.0, p[1] - 5.0, p[0] + 5.0, p[1] + 5.0]);
    }
    for branch in &data.branches {
        let points: Vec<Point> = branch.rpm.iter().zip(&branch.hz).map(|(&x, &y)| axes.at(x, y)).collect();
        // With the markers on it.
        obstacles.add_line(&clip(&points, axes.frame), 4.0);
    }
    for order in &data.orders {
        obstacles.add_line(&order_line(axes, order), 1.0);
    }
    for (at, label) in &marks {
        Marker::Circle.draw(svg, *at, CRITICAL);
        let label = font::fit(label, SMALL, 160.0);
        if let Some(area) = obstacles.place_label(*at, font::width(&label, SMALL), axes.frame) {
            obstacles.callout(svg, *at, area, &label);
        }
    }
}

fn decrements(svg: &mut Svg, branches: &[Branch], frame: Frame, x: Range, x_label: &str) {
    let (values, above) = decrement_scale(branches);
    let y = Range::with_zero(values);
    let y = Range { lo: if y.lo < 0.0 { y.padded(0.08).lo } else { 0.0 }, hi: y.padded_top(0.08).hi };
    let axes = Axes::linear(frame, x, y);
    axes.grid(svg);
    axes.segment(svg, [x.lo, 0.0], [x.hi, 0.0], Style::stroke(INK, 0.9));
    for branch in branches {
        branch.curves(svg, &axes, &branch.log_decrement, |whirl| whirl.line().thick(1.2));
        mark_branch(svg, &axes, branch, &branch.log_decrement);
    }
    axes.border(svg, Some(x_label), &axes.y.label("log decrement", "–"));
    if !above.is_empty() {
        // In the gap above the panel, off its curves.
        let text = font::fit(&format!("above: {}", above.join(", ")), SMALL, frame.w - 16.0);
        svg.text([frame.x + 8.0, frame.y - 4.0], &text, Text::new(SMALL, MUTED));
    }
}

/// Log decrements that set the scale of the panel, and the labels of the branches above it: an overdamped
/// mode has an unbounded decrement and would compress all others.
fn decrement_scale(branches: &[Branch]) -> (Vec<f64>, Vec<&str>) {
    let ends =
        branches.iter().filter_map(|b| Some((extremes(b.log_decrement.iter().copied())?, b.label.as_str())));
    let ends: Vec<((f64, f64), &str)> = ends.collect();
    let mut highest: Vec<f64> = ends.iter().map(|e| e.0.1).collect();
    highest.sort_by(f64::total_cmp);
    let usual = highest.get(highest.len() / 2).copied().unwrap_or(0.0);
    let limit = if usual > 0.0 { 6.0 * usual } else { f64::INFINITY };
    let (shown, above): (Vec<_>, Vec<_>) = ends.into_iter().partition(|e| e.0.0 <= limit);
    let bounds = shown.iter().flat_map(|e| [e.0.0, e.0.1.min(limit)]).collect();
    (bounds, above.into_iter().map(|e| e.1).collect())
}

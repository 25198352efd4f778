//! Bifurcation diagram: Poincaré section values over a parameter, with period, class and Lyapunov exponent.

use super::axes::{Axes, Frame, Marker};
use super::labels::{Entry, page_heading};
use super::panels::stack;
use super::scale::{Range, Scale};
use super::style::*;
use super::svg::{Color, Style, Svg};

/// Colour of the sweep drawn first: lighter, with larger dots, so that it stays visible under the other, also
/// in grey.
const BACK_COLOR: Color = Color(240, 150, 96);
/// Colour of the sweep drawn on top.
const FRONT_COLOR: Color = Color(16, 60, 130);

/// One sweep; points in any order.
#[derive(Clone, Debug, Default)]
pub struct SweepPoints {
    pub label: String,
    /// Parameter and section value of every point.
    pub x: Vec<f64>,
    pub y: Vec<f64>,
    /// Parameter and period number (1, 2, 3, ...) of every periodic motion.
    pub period: Vec<[f64; 2]>,
    /// Parameters with quasi-periodic and with chaotic motion.
    pub quasi_periodic: Vec<f64>,
    pub chaotic: Vec<f64>,
    /// Parameters at which the transient has not decayed, or too few points tell the motion.
    pub undecided: Vec<f64>,
    /// Parameter, largest Lyapunov exponent and its standard error; may be empty.
    pub exponent: Vec<[f64; 3]>,
}

/// Data of a bifurcation diagram.
#[derive(Clone, Debug, Default)]
pub struct Bifurcation {
    pub title: String,
    pub note: String,
    pub x_name: String,
    pub x_unit: String,
    pub y_name: String,
    pub y_unit: String,
    /// One or two sweeps.
    pub sweeps: Vec<SweepPoints>,
}

/// Highest period number resolved in the panel of motion classes.
const MAX_PERIOD_SHOWN: f64 = 8.0;
/// Ordinates of quasi-periodic and chaotic motion in that panel.
const QUASI_PERIODIC_LEVEL: f64 = MAX_PERIOD_SHOWN + 1.7;
const CHAOTIC_LEVEL: f64 = MAX_PERIOD_SHOWN + 3.4;
/// Ordinate of undecided motions, shown if there are any.
const UNDECIDED_LEVEL: f64 = MAX_PERIOD_SHOWN + 5.1;

pub fn draw(data: &Bifurcation) -> Svg {
    let sweeps = &data.sweeps[..data.sweeps.len().min(2)];
    // The second sweep is drawn under the first.
    let over = if sweeps.len() > 1 { 0.9 } else { 1.2 };
    let dot_style = |k: usize| if k == 0 { (FRONT_COLOR, over) } else { (BACK_COLOR, 2.0) };
    let marker = |k: usize| {
        let shape = if k == 0 { Marker::Circle } else { Marker::Square };
        (shape, Style::fill(dot_style(k).0))
    };
    let entry = |(k, s): (usize, &SweepPoints)| Entry::marker(&s.label, marker(k).0, marker(k).1);
    let entries: Vec<Entry> = match sweeps {
        [only] if only.label.is_empty() => Vec::new(),
        sweeps => sweeps.iter().enumerate().map(entry).collect(),
    };
    let (mut svg, top) = page_heading(WIDTH, LEFT, &data.title, &data.note, &entries);
    let with_exponents = sweeps.iter().any(|s| !s.exponent.is_empty());
    let mut heights = vec![330.0, 120.0];
    if with_exponents {
        heights.push(130.0);
    }
    let frames = stack(top, WIDTH - LEFT - RIGHT, &heights);
    let all = sweeps.iter().flat_map(|s| {
        let periods = s.period.iter().map(|p| p[0]);
        s.x.iter()
            .copied()
            .chain(periods)
            .chain(s.quasi_periodic.iter().copied())
            .chain(s.chaotic.iter().copied())
            .chain(s.undecided.iter().copied())
    });
    let x = Range::of(all).padded(0.01);
    let y = Range::of(sweeps.iter().flat_map(|s| s.y.iter().copied())).padded(0.06);
    let main = Axes::linear(frames[0], x, y);
    main.grid(&mut svg);
    for (k, sweep) in sweeps.iter().enumerate().rev() {
        let (color, radius) = dot_style(k);
        let dots = sweep.x.iter().zip(&sweep.y).map(|(&x, &y)| main.at(x, y)).filter(|p| main.contains(*p));
        svg.dots(dots, radius, color);
    }
    main.border(&mut svg, None, &main.y.label(&data.y_name, &data.y_unit));
    let x_label = main.x.label(&data.x_name, &data.x_unit);
    motion_classes(&mut svg, sweeps, &dot_style, frames[1], x, (!with_exponents).then_some(x_label.as_str()));
    if with_exponents {
        exponents(&mut svg, sweeps, &marker, frames[2], x, &x_label);
    }
    svg.height = frames.last().map_or(top, |f| f.bottom()) + BOTTOM;
    svg
}

/// Panel of motion classes: period number, quasi-periodic or chaotic.
fn motion_classes(
    svg: &mut Svg,
    sweeps: &[SweepPoints],
    dot_style: &dyn Fn(usize) -> (Color, f64),
    frame: Frame,
    x: Range,
    x_label: Option<&str>,
) {
    let levels = [1.0, 2.0, 4.0, MAX_PERIOD_SHOWN, QUASI_PERIODIC_LEVEL, CHAOTIC_LEVEL, UNDECIDED_LEVEL];
    let names = ["1", "2", "4", "≥ 8", "quasi-p.", "chaotic", "unclear"];
    let shown = levels.len() - usize::from(sweeps.iter().all(|s| s.undecided.is_empty()));
    let mut axes = Axes::linear(frame, x, Range::new(0.3, levels[shown - 1] + 0.8));
    axes.y = Scale::at_ticks(axes.y, &levels[..shown]);
    for (tick, name) in axes.y.ticks.iter_mut().zip(names) {
        tick.label = name.into();
    }
    axes.grid(svg);
    for (k, sweep) in sweeps.iter().enumerate().rev() {
        // Shifted so that both sweeps are visible where they agree.
        let shift = if sweeps.len() < 2 { 0.0 } else { [-0.22, 0.22][k] };
        let periods = sweep.period.iter().map(|[x, p]| [*x, p.min(MAX_PERIOD_SHOWN)]);
        let regular = sweep.quasi_periodic.iter().map(|x| [*x, QUASI_PERIODIC_LEVEL]);
        let chaotic = sweep.chaotic.iter().map(|x| [*x, CHAOTIC_LEVEL]);
        let open = sweep.undecided.iter().map(|x| [*x, UNDECIDED_LEVEL]);
        let dots = periods.chain(regular).chain(chaotic).chain(open).map(|[x, y]| axes.at(x, y + shift));
        svg.dots(dots.filter(|p| axes.contains(*p)), 1.4, dot_style(k).0);
    }
    axes.border(svg, x_label, "period");
}

fn exponents(
    svg: &mut Svg,
    sweeps: &[SweepPoints],
    marker: &dyn Fn(usize) -> (Marker, Style),
    frame: Frame,
    x: Range,
    x_label: &str,
) {
    let values = sweeps.iter().flat_map(|s| s.exponent.iter().map(|e| e[1]));
    let axes = Axes::linear(frame, x, Range::with_zero(values).padded(0.08));
    axes.grid(svg);
    axes.segment(svg, [x.lo, 0.0], [x.hi, 0.0], Style::stroke(INK, 0.9));
    for (k, sweep) in sweeps.iter().enumerate().rev() {
        let (shape, style) = marker(k);
        let mut points = sweep.exponent.clone();
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        for [x, value, error] in &points {
            // Error bars of two standard errors.
            axes.segment(
                svg,
                [*x, value - 2.0 * error],
                [*x, value + 2.0 * error],
                Style { fill: None, stroke: style.fill, width: 0.7, ..style },
            );
        }
        let (xs, ys): (Vec<f64>, Vec<f64>) = points.iter().map(|p| (p[0], p[1])).unzip();
        let line = Style { fill: None, stroke: style.fill, width: 0.8, ..style };
        axes.curve(svg, &xs, &ys, line);
        if points.len() < 120 {
            axes.markers(svg, &xs, &ys, shape, style, 2.0);
        }
    }
    axes.border(svg, Some(x_label), &axes.y.label("Lyapunov exponent", "1/s"));
}

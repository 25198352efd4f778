//! Waterfall: spectra offset over speed, each hiding what is behind it.

use super::axes::{Axes, Frame};
use super::campbell::OrderLine;
use super::labels::{EndLabel, end_labels, end_room, head, readable};
use super::scale::{Range, extremes, nice_step};
use super::style::*;
use super::svg::{Point, Style, Svg, Text};
use super::thin;

/// Most spectra drawn; more lie on each other.
const MOST: usize = 70;
/// Height of the highest peak \[fraction of the panel\].
const PEAK: f64 = 0.22;

/// Data of a waterfall.
#[derive(Clone, Debug, Default)]
pub struct Waterfall {
    pub title: String,
    pub note: String,
    /// Shaft speed of each spectrum \[rpm\].
    pub rpm: Vec<f64>,
    /// Frequencies \[Hz\].
    pub hz: Vec<f64>,
    /// Amplitudes, `amplitude[i * hz.len() + j]` at `rpm[i]`, `hz[j]`.
    pub amplitude: Vec<f64>,
    /// Unit of the amplitudes, e.g. "m/s²".
    pub unit: String,
    pub orders: Vec<OrderLine>,
}

pub fn draw(data: &Waterfall) -> Svg {
    let (mut svg, top) = head(WIDTH, LEFT, &data.title, &data.note, &[]);
    let room = end_room(data.orders.iter().map(|o| o.label.clone())).max(86.0);
    let frame = Frame { x: LEFT, y: top + 16.0, w: WIDTH - LEFT - room, h: 470.0 };
    let x = Range::of(data.hz.iter().copied()).near_zero();
    let speeds = Range::of(data.rpm.iter().copied()).near_zero();
    // The uppermost spectrum needs room for its peaks.
    let mut axes = Axes::linear(frame, x, speeds.raised(PEAK / (1.0 - PEAK)));
    axes.y.ticks.retain(|t| t.value <= speeds.hi);
    let highest = extremes(data.amplitude.iter().copied()).map_or(0.0, |e| e.1);
    let px_per_unit = if highest > 0.0 { PEAK * frame.h / highest } else { 0.0 };
    let grid = Style::stroke(GRID, 0.8);
    for x in axes.x.ticks.iter().map(|t| axes.x.px(t.value)) {
        svg.line([x, frame.y], [x, frame.bottom()], grid);
    }
    let n = data.hz.len();
    let mut ascending: Vec<usize> = (0..n).filter(|&j| data.hz[j].is_finite()).collect();
    ascending.sort_by(|&a, &b| data.hz[a].total_cmp(&data.hz[b]));
    let stride = data.rpm.len().div_ceil(MOST).max(1);
    // The white fill hides what is behind.
    let line = Style::stroke(INK, 0.8).filled(WHITE);
    for (i, &rpm) in data.rpm.iter().enumerate().step_by(stride).collect::<Vec<_>>().into_iter().rev() {
        let base = axes.y.px(rpm);
        let Some(row) = data.amplitude.get(i * n..(i + 1) * n).filter(|_| base.is_finite()) else { continue };
        let points = ascending.iter().map(|&j| (data.hz[j], row[j])).filter(|(_, a)| a.is_finite());
        let spectrum = thin::peaks(points.map(|(hz, a)| [axes.x.px(hz), base - px_per_unit * a.max(0.0)]));
        if let (Some(first), Some(last)) = (spectrum.first(), spectrum.last()) {
            let ends = ([first[0], base], [last[0], base]);
            let closed: Vec<Point> =
                std::iter::once(ends.0).chain(spectrum.iter().copied()).chain([ends.1]).collect();
            svg.polyline(&closed, line);
        }
    }
    let labels = cursors(&mut svg, &axes, &data.orders);
    axes.border(&mut svg, Some(&axes.x.label("frequency", "Hz")), &axes.y.label("shaft speed", "rpm"));
    end_labels(&mut svg, &axes, &labels);
    if px_per_unit > 0.0 {
        scale_bar(&mut svg, frame, highest, px_per_unit, &data.unit);
    }
    svg.height = frame.bottom() + BOTTOM;
    svg
}

/// Order cursors along the base lines: f = order × rpm / 60.
fn cursors(svg: &mut Svg, axes: &Axes, orders: &[OrderLine]) -> Vec<EndLabel> {
    let mut labels = Vec::new();
    let speeds = axes.y.range;
    for order in orders {
        let hz = |rpm: f64| order.order * rpm / 60.0;
        let line = super::axes::clip(
            &[axes.at(hz(speeds.lo), speeds.lo), axes.at(hz(speeds.hi), speeds.hi)],
            axes.frame,
        );
        svg.polyline(&line, order.style().faint(0.8));
        if let Some(&at) = line.last() {
            labels.push(EndLabel { at, text: order.label.clone(), color: order.color() });
        }
    }
    labels
}

/// A bar beside the panel that says how high an amplitude is.
fn scale_bar(svg: &mut Svg, frame: Frame, highest: f64, px_per_unit: f64, unit: &str) {
    let value = nice_step(highest, 2.0);
    let h = value * px_per_unit;
    let (x, y) = (WIDTH - 12.0, frame.bottom());
    let style = Style::stroke(INK, 1.2);
    svg.line([x, y], [x, y - h], style);
    for end in [y, y - h] {
        svg.line([x - 4.0, end], [x + 4.0, end], style);
    }
    svg.text([x + 4.0, y - h - 7.0], &format!("{} {unit}", readable(value)), Text::new(SMALL, INK).end());
}

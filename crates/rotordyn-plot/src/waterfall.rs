//! Waterfall (cascade) plot: spectra offset over speed, with hidden lines.

use super::axes::{Axes, Frame};
use super::campbell::OrderLine;
use super::decimate;
use super::labels::{EndLabel, end_label_width, end_labels, format_value, page_heading};
use super::panel_row::PanelRow;
use super::scale::{Range, extremes, nice_step};
use super::style::*;
use super::svg::{Point, Style, Svg, Text};

/// Largest number of spectra drawn.
const MAX_SPECTRA: usize = 70;
/// Height of the highest peak \[fraction of the panel\].
const PEAK_HEIGHT: f64 = 0.22;

/// Spectra of one run.
#[derive(Clone, Debug, Default)]
pub struct WaterfallPanel {
    /// Panel name, shown if there are several, e.g. "measured".
    pub name: String,
    /// Shaft speed of each spectrum \[rpm\].
    pub rpm: Vec<f64>,
    /// Frequencies \[Hz\].
    pub hz: Vec<f64>,
    /// Amplitudes, `amplitude[i * hz.len() + j]` at `rpm[i]`, `hz[j]`.
    pub amplitude: Vec<f64>,
}

/// Data of a waterfall; several panels are drawn in rows on common scales.
#[derive(Clone, Debug, Default)]
pub struct Waterfall {
    pub title: String,
    pub note: String,
    pub panels: Vec<WaterfallPanel>,
    /// Unit of the amplitudes, e.g. "m/s²".
    pub unit: String,
    pub orders: Vec<OrderLine>,
}

pub fn draw(data: &Waterfall) -> Svg {
    const HEIGHT: f64 = 470.0;
    let room = end_label_width(data.orders.iter().map(|o| o.label.clone())).max(86.0);
    let row = PanelRow::new(data.panels.len(), WIDTH - LEFT - room);
    let page = LEFT + row.width() + room;
    let (mut svg, top) = page_heading(page, LEFT, &data.title, &data.note, &[]);
    let all_values = |of: fn(&WaterfallPanel) -> &[f64]| data.panels.iter().flat_map(of).copied();
    let x = Range::of(all_values(|p| &p.hz)).near_zero();
    let speeds = Range::of(all_values(|p| &p.rpm)).near_zero();
    let highest = extremes(all_values(|p| &p.amplitude)).map_or(0.0, |e| e.1);
    let px_per_unit = if highest > 0.0 { PEAK_HEIGHT * HEIGHT / highest } else { 0.0 };
    let count = data.panels.len().max(1);
    for k in 0..count {
        let frame = row.frame(k, top + 16.0, HEIGHT);
        // Margin for the peaks of the uppermost spectrum.
        let mut axes = Axes::linear(frame, x, speeds.padded_top(PEAK_HEIGHT / (1.0 - PEAK_HEIGHT)));
        axes.y.ticks.retain(|t| t.value <= speeds.hi);
        if let Some(panel) = data.panels.get(k) {
            spectra(&mut svg, &axes, panel, px_per_unit);
        }
        let labels = cursors(&mut svg, &axes, &data.orders);
        row.border(&mut svg, &axes, k, ("frequency", "Hz"), ("shaft speed", "rpm"));
        row.name(&mut svg, frame, data.panels.get(k).map_or("", |p| &p.name));
        // The panels of a row have the same lines: only those of its last are labelled.
        if row.ends_row(k) {
            end_labels(&mut svg, &axes, &labels);
            if px_per_unit > 0.0 {
                scale_bar(&mut svg, frame, highest, px_per_unit, &data.unit);
            }
            svg.height = frame.bottom() + BOTTOM;
        }
    }
    svg
}

/// Grid lines and spectra, the highest speed first.
fn spectra(svg: &mut Svg, axes: &Axes, panel: &WaterfallPanel, px_per_unit: f64) {
    let frame = axes.frame;
    for x in axes.x.ticks.iter().map(|t| axes.x.px(t.value)) {
        svg.line([x, frame.y], [x, frame.bottom()], Style::stroke(GRID, 0.8));
    }
    let n = panel.hz.len();
    let mut ascending: Vec<usize> = (0..n).filter(|&j| panel.hz[j].is_finite()).collect();
    ascending.sort_by(|&a, &b| panel.hz[a].total_cmp(&panel.hz[b]));
    let stride = panel.rpm.len().div_ceil(MAX_SPECTRA).max(1);
    // The white fill hides the spectra behind.
    let line = Style::stroke(INK, 0.8).filled(WHITE);
    for (i, &rpm) in panel.rpm.iter().enumerate().step_by(stride).collect::<Vec<_>>().into_iter().rev() {
        let base = axes.y.px(rpm);
        let Some(row) = panel.amplitude.get(i * n..(i + 1) * n).filter(|_| base.is_finite()) else {
            continue;
        };
        let points = ascending.iter().map(|&j| (panel.hz[j], row[j])).filter(|(_, a)| a.is_finite());
        let spectrum =
            decimate::peaks(points.map(|(hz, a)| [axes.x.px(hz), base - px_per_unit * a.max(0.0)]));
        if let (Some(first), Some(last)) = (spectrum.first(), spectrum.last()) {
            let ends = ([first[0], base], [last[0], base]);
            let closed: Vec<Point> =
                std::iter::once(ends.0).chain(spectrum.iter().copied()).chain([ends.1]).collect();
            svg.polyline(&closed, line);
        }
    }
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

/// Amplitude scale bar at the right of the panel.
fn scale_bar(svg: &mut Svg, frame: Frame, highest: f64, px_per_unit: f64, unit: &str) {
    let value = nice_step(highest, 2.0);
    let h = value * px_per_unit;
    let (x, y) = (svg.width - 12.0, frame.bottom());
    let style = Style::stroke(INK, 1.2);
    svg.line([x, y], [x, y - h], style);
    for end in [y, y - h] {
        svg.line([x - 4.0, end], [x + 4.0, end], style);
    }
    svg.text([x + 4.0, y - h - 7.0], &format!("{} {unit}", format_value(value)), Text::new(SMALL, INK).end());
}

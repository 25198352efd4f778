//! Spectrogram over speed (the Campbell diagram as measured), with the linear lines laid over it.

use super::axes::{Axes, Frame};
use super::campbell::{Branch, OrderLine, branch_ends, order_lines};
use super::heat::{BAR_ROOM, Heat, color_bar};
use super::labels::{Entry, end_labels, end_room, head};
use super::scale::Range;
use super::style::*;
use super::svg::{Style, Svg};

/// Data of a spectrogram over speed.
#[derive(Clone, Debug, Default)]
pub struct Spectrogram {
    pub title: String,
    pub note: String,
    /// Shaft speed of each spectrum \[rpm\].
    pub rpm: Vec<f64>,
    /// Frequencies \[Hz\].
    pub hz: Vec<f64>,
    /// Levels \[dB\], `level_db[i * hz.len() + j]` at `rpm[i]`, `hz[j]`.
    pub level_db: Vec<f64>,
    /// What the decibels are, e.g. "acceleration level" and "dB re 1 m/s²".
    pub quantity: String,
    pub unit: String,
    /// Levels shown under the highest \[dB\].
    pub span_db: f64,
    pub orders: Vec<OrderLine>,
    pub branches: Vec<Branch>,
    /// Upper end of the frequency axis \[Hz\]; by default the highest frequency.
    pub max_hz: Option<f64>,
}

pub fn draw(data: &Spectrogram) -> Svg {
    let mut kinds: Vec<Entry> = Vec::new();
    for whirl in data.branches.iter().map(|b| b.whirl) {
        if kinds.iter().all(|k| k.text != whirl.name()) {
            kinds.push(Entry::line(whirl.name(), Style::stroke(whirl.color(), 1.3)));
        }
    }
    let (mut svg, top) = head(WIDTH, LEFT, &data.title, &data.note, &kinds);
    let names = data.branches.iter().map(|b| &b.label).chain(data.orders.iter().map(|o| &o.label));
    let room = end_room(names.cloned());
    let frame = Frame { x: LEFT, y: top + 16.0, w: WIDTH - LEFT - room - BAR_ROOM, h: 420.0 };
    let y = match data.max_hz.filter(|hz| hz.is_finite() && *hz > 0.0) {
        Some(hz) => Range::new(0.0, hz),
        None => Range::of(data.hz.iter().copied()).near_zero(),
    };
    let axes = Axes::linear(frame, Range::of(data.rpm.iter().copied()).near_zero(), y);
    let heat = Heat { x: &data.rpm, y: &data.hz, level: &data.level_db };
    let bounds = heat.bounds(data.span_db);
    heat.draw(&mut svg, &axes, bounds);
    let mut labels = order_lines(&mut svg, &axes, &data.orders);
    for branch in &data.branches {
        // A white edge keeps the thin line apart from the ridge under it.
        axes.curve(&mut svg, &branch.rpm, &branch.hz, Style::stroke(WHITE, 2.6).faint(0.75));
        axes.curve(&mut svg, &branch.rpm, &branch.hz, Style::stroke(branch.whirl.color(), 1.1));
    }
    labels.extend(branch_ends(&axes, &data.branches));
    axes.border(&mut svg, Some(&axes.x.label("shaft speed", "rpm")), &axes.y.label("frequency", "Hz"));
    end_labels(&mut svg, &axes, &labels);
    let label = format!("{} [{}]", data.quantity, data.unit);
    color_bar(&mut svg, frame, WIDTH - BAR_ROOM, bounds, &label);
    svg.height = frame.bottom() + BOTTOM;
    svg
}

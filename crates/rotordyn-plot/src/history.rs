//! Time histories, one panel per channel.

use super::axes::Axes;
use super::labels::page_heading;
use super::panels::stack;
use super::scale::Range;
use super::style::*;
use super::svg::{Style, Svg, Text};

/// Largest number of channels in one figure.
const MAX_CHANNELS: usize = 12;

/// One recorded quantity.
#[derive(Clone, Debug, Default)]
pub struct Channel {
    pub label: String,
    /// Quantity and unit of the y axis, e.g. "acceleration", "m/s²".
    pub quantity: String,
    pub unit: String,
    /// Times \[s\], ascending.
    pub time: Vec<f64>,
    pub value: Vec<f64>,
}

/// Data of a time history figure; the panels share the time axis.
#[derive(Clone, Debug, Default)]
pub struct History {
    pub title: String,
    pub note: String,
    pub channels: Vec<Channel>,
}

pub fn draw(data: &History) -> Svg {
    let (mut svg, top) = page_heading(WIDTH, LEFT, &data.title, &data.note, &[]);
    let channels = &data.channels[..data.channels.len().min(MAX_CHANNELS)];
    let height = match channels.len() {
        0 | 1 => 240.0,
        2 => 180.0,
        3..=5 => 130.0,
        _ => 100.0,
    };
    let frames = stack(top, WIDTH - LEFT - RIGHT, &vec![height; channels.len().max(1)]);
    let x = Range::of(channels.iter().flat_map(|c| c.time.iter().copied()));
    let none = Channel::default();
    for (k, frame) in frames.iter().enumerate() {
        let channel = channels.get(k).unwrap_or(&none);
        let y = Range::of(channel.value.iter().copied()).padded(0.08);
        let axes = Axes::linear(*frame, x, y);
        axes.grid(&mut svg);
        if y.contains(0.0) {
            axes.segment(&mut svg, [x.lo, 0.0], [x.hi, 0.0], Style::stroke(PALE, 0.8));
        }
        axes.curve(&mut svg, &channel.time, &channel.value, Style::stroke(BLUE, 0.9));
        let last = k + 1 == frames.len();
        let x_label = axes.x.label("time", "s");
        axes.border(
            &mut svg,
            last.then_some(x_label.as_str()),
            &axes.y.label(&channel.quantity, &channel.unit),
        );
        svg.text([frame.x + 8.0, frame.y + 15.0], &channel.label, Text::new(TICK, INK).halo());
    }
    svg.height = frames.last().map_or(top, |f| f.bottom()) + BOTTOM;
    svg
}

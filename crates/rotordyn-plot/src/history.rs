//! Time histories, one panel per channel.

use super::axes::Axes;
use super::labels::{Entry, page_heading};
use super::panels::stack;
use super::scale::{Range, widened};
use super::style::*;
use super::svg::{Dash, Style, Svg, Text};
use rotordyn_core::series::{Series, SeriesError};

/// Largest number of channels in one figure.
const MAX_CHANNELS: usize = 12;
/// Height of the label of a panel with its margins \[px\].
const LABEL_ROOM: f64 = 15.0;
/// Right margin with second scales \[px\].
const SECOND_SCALE: f64 = 66.0;

/// One recorded quantity.
#[derive(Clone, Debug, Default)]
pub struct Channel {
    pub label: String,
    /// Quantity and unit of the y axis, e.g. "acceleration", "m/s²".
    pub quantity: String,
    pub unit: String,
    /// Times \[s\], ascending.
    pub time: Series,
    pub value: Series,
    /// Running mean of the values, drawn over them; empty for none.
    pub mean: Series,
    /// What the values are compared with; empty for none.
    pub reference: Series,
    /// Second scale at the right edge.
    pub second: Option<SecondScale>,
    /// The y axis starts at zero.
    pub from_zero: bool,
}

/// A second scale of the same curve, offset + factor · value.
#[derive(Clone, Debug, Default)]
pub struct SecondScale {
    pub quantity: String,
    pub unit: String,
    pub offset: f64,
    pub factor: f64,
}

/// Data of a time history figure; the panels share the time axis.
#[derive(Clone, Debug, Default)]
pub struct History {
    pub title: String,
    pub note: String,
    /// Names of values, means and references, for a legend; those of curves that no channel has may be empty.
    pub legend: [String; 3],
    pub channels: Vec<Channel>,
}

const VALUE: Style = Style::stroke(BLUE, 0.9);
/// Values below their mean.
const SCATTER: Style = Style::stroke(PALE, 0.7);
const MEAN: Style = Style::stroke(BLUE, 1.5);
const REFERENCE: Style = Style::stroke(RED, 1.3).dashed(Dash::Long);

/// # Errors
/// Samples that cannot be read.
pub fn draw(data: &History) -> Result<Svg, SeriesError> {
    let channels = &data.channels[..data.channels.len().min(MAX_CHANNELS)];
    let averaged = channels.iter().any(|c| !c.mean.is_empty());
    let styles = [if averaged { SCATTER.thick(1.4) } else { VALUE }, MEAN, REFERENCE];
    let named = data.legend.iter().zip(styles).filter(|(name, _)| !name.is_empty());
    let entries: Vec<Entry> = named.map(|(name, style)| Entry::line(name, style)).collect();
    let (mut svg, top) = page_heading(WIDTH, LEFT, &data.title, &data.note, &entries);
    let height = match channels.len() {
        0 | 1 => 240.0,
        2 => 180.0,
        3..=5 => 130.0,
        _ => 100.0,
    };
    let second = channels.iter().any(|c| c.second.is_some());
    let right = if second { SECOND_SCALE } else { RIGHT };
    let frames = stack(top, WIDTH - LEFT - right, &vec![height; channels.len().max(1)]);
    let x = Range::of(extremes(channels.iter().map(|c| &c.time))?);
    let none = Channel::default();
    for (k, frame) in frames.iter().enumerate() {
        let channel = channels.get(k).unwrap_or(&none);
        let values = extremes([&channel.value, &channel.reference])?;
        // Room for the label above the values.
        let room = if channel.label.is_empty() { 0.0 } else { LABEL_ROOM / (frame.h - LABEL_ROOM) };
        let y = match channel.from_zero {
            true => Range::with_zero(values).padded_top(room.max(0.25)),
            false => Range::of(values).padded(0.08).padded_top(room),
        };
        let axes = Axes::linear(*frame, x, y);
        axes.grid(&mut svg);
        if y.contains(0.0) {
            axes.segment(&mut svg, [x.lo, 0.0], [x.hi, 0.0], Style::stroke(PALE, 0.8));
        }
        let style = if channel.mean.is_empty() { VALUE } else { SCATTER };
        axes.curve_of(&mut svg, &channel.time, &channel.value, style)?;
        axes.curve_of(&mut svg, &channel.time, &channel.reference, REFERENCE)?;
        axes.curve_of(&mut svg, &channel.time, &channel.mean, MEAN)?;
        let last = k + 1 == frames.len();
        let x_label = axes.x.label("time", "s");
        axes.border(
            &mut svg,
            last.then_some(x_label.as_str()),
            &axes.y.label(&channel.quantity, &channel.unit),
        );
        if let Some(second) = &channel.second {
            axes.second_y(&mut svg, &second.quantity, &second.unit, |v| second.offset + second.factor * v);
        }
        svg.text([frame.x + 8.0, frame.y + 15.0], &channel.label, Text::new(TICK, INK).halo());
    }
    svg.height = frames.last().map_or(top, |f| f.bottom()) + BOTTOM;
    Ok(svg)
}

/// Smallest and largest finite value of some series; empty if there is none.
fn extremes<'a>(series: impl IntoIterator<Item = &'a Series>) -> Result<Vec<f64>, SeriesError> {
    let found = series.into_iter().try_fold(None, |seen, series| series.fold(seen, widened))?;
    Ok(found.map_or_else(Vec::new, |(lo, hi)| vec![lo, hi]))
}

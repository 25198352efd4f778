//! Order map (order tracking): level over shaft speed and order.

use super::axes::{Axes, Frame};
use super::campbell::OrderLine;
use super::heat::{self, COLOR_BAR_WIDTH, color_bar};
use super::labels::{EndLabel, end_label_width, end_labels, page_heading};
use super::over_time::OverTime;
use super::scale::{Range, widened};
use super::style::*;
use super::svg::Svg;
use rotordyn_core::series::{Series, SeriesError};

/// Data of an order map.
#[derive(Clone, Debug, Default)]
pub struct OrderMap {
    pub title: String,
    pub note: String,
    /// Shaft speed of each order spectrum \[rpm\], and its time \[s\], over which it is drawn if the speed is constant,
    /// or rises and falls.
    pub rpm: Vec<f64>,
    pub time: Vec<f64>,
    /// Orders \[events per revolution\].
    pub order: Vec<f64>,
    /// Levels \[dB\], `level_db[i * order.len() + j]` at `rpm[i]`, `order[j]`.
    pub level_db: Series,
    /// Quantity and unit of the levels, e.g. "acceleration level" and "dB re 1 m/s²".
    pub quantity: String,
    pub unit: String,
    /// Dynamic range \[dB\].
    pub span_db: f64,
    /// Order line cursors.
    pub orders: Vec<OrderLine>,
    /// Upper end of the order axis; by default the highest order.
    pub max_order: Option<f64>,
}

/// # Errors
/// Levels that cannot be read.
pub fn draw(data: &OrderMap) -> Result<Svg, SeriesError> {
    let over_time = OverTime::of(std::iter::once([&data.rpm[..], &data.time]));
    let note = OverTime::note(over_time, &data.note);
    let (mut svg, top) = page_heading(WIDTH, LEFT, &data.title, &note, &[]);
    let room = end_label_width(data.orders.iter().map(|o| o.label.clone()));
    let frame = Frame { x: LEFT, y: top + 4.0, w: WIDTH - LEFT - room - COLOR_BAR_WIDTH, h: 420.0 };
    let y = match data.max_order.filter(|o| o.is_finite() && *o > 0.0) {
        Some(order) => Range::new(0.0, order),
        None => Range::of(data.order.iter().copied()).near_zero(),
    };
    let (places, x, name, unit) = match over_time {
        Some(_) => (&data.time, Range::of(data.time.iter().copied()), "time", "s"),
        None => (&data.rpm, Range::of(data.rpm.iter().copied()).near_zero(), "shaft speed", "rpm"),
    };
    let axes = Axes::linear(frame, x, y);
    let bounds = heat::bounds_between(data.level_db.fold(None, widened)?, data.span_db);
    heat::draw_rows(&mut svg, &axes, bounds, [places, &data.order], &data.level_db)?;
    let mut labels = Vec::new();
    for line in data.orders.iter().filter(|o| y.contains(o.order)) {
        let (a, b) = (axes.x.range.lo, axes.x.range.hi);
        axes.segment(&mut svg, [a, line.order], [b, line.order], line.style().thick(0.8).faint(0.8));
        labels.push(EndLabel { at: axes.at(b, line.order), text: line.label.clone(), color: line.color() });
    }
    axes.border(&mut svg, Some(&axes.x.label(name, unit)), &axes.y.label("order", "1/rev"));
    end_labels(&mut svg, &axes, &labels);
    let label = format!("{} [{}]", data.quantity, data.unit);
    color_bar(&mut svg, frame, WIDTH - COLOR_BAR_WIDTH, bounds, &label);
    svg.height = frame.bottom() + BOTTOM;
    Ok(svg)
}

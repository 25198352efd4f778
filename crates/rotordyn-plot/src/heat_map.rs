//! General heat map: spectrogram over time, kurtogram, cyclic coherence, FDAC, with an optional marked
//! rectangle.

use super::axes::{Axes, Frame};
use super::contour;
use super::heat::{self, COLOR_BAR_WIDTH, Heat, color_bar};
use super::labels::page_heading;
use super::scale::{Range, Scale, extremes, nice_step};
use super::style::*;
use super::svg::{Dash, Style, Svg, Text};

/// A marked rectangle of the map.
#[derive(Clone, Debug, Default)]
pub struct MarkedRegion {
    pub x: [f64; 2],
    pub y: [f64; 2],
    pub label: String,
}

/// Data of a heat map.
#[derive(Clone, Debug, Default)]
pub struct HeatMap {
    pub title: String,
    pub note: String,
    /// Name and unit of each axis.
    pub x_name: String,
    pub x_unit: String,
    pub y_name: String,
    pub y_unit: String,
    pub x: Vec<f64>,
    pub y: Vec<f64>,
    /// Values, `value[i * y.len() + j]` at `x[i]`, `y[j]`.
    pub value: Vec<f64>,
    /// Quantity and unit of the values, e.g. "level" and "dB re 1 m/s²".
    pub quantity: String,
    pub unit: String,
    /// Range of values shown below the highest; `None` shows all, between round bounds.
    pub range_below_max: Option<f64>,
    /// Bounds of the axes; by default those of the data.
    pub x_range: Option<[f64; 2]>,
    pub y_range: Option<[f64; 2]>,
    /// Named ticks of y instead of numbers.
    pub y_ticks: Vec<(f64, String)>,
    pub marked: Option<Box<MarkedRegion>>,
    /// Draw the line x = y.
    pub diagonal: bool,
    /// Contour lines with their labels, over increasing x and y.
    pub contours: Vec<(f64, String)>,
}

pub fn draw(data: &HeatMap) -> Svg {
    let (mut svg, top) = page_heading(WIDTH, LEFT, &data.title, &data.note, &[]);
    let frame = Frame { x: LEFT, y: top + 16.0, w: WIDTH - LEFT - COLOR_BAR_WIDTH - 26.0, h: 380.0 };
    let range = |wanted: Option<[f64; 2]>, values: &[f64]| match wanted {
        Some([a, b]) => Range::new(a, b),
        None => Range::of(values.iter().copied()).near_zero(),
    };
    let mut axes = Axes::linear(frame, range(data.x_range, &data.x), range(data.y_range, &data.y));
    if !data.y_ticks.is_empty() {
        axes.y = Scale::named(axes.y, &data.y_ticks);
    }
    let heat = Heat { x: &data.x, y: &data.y, level: &data.value };
    let bounds = match data.range_below_max {
        Some(span) => heat::bounds(data.value.iter().copied(), span),
        None => round_bounds(&data.value),
    };
    heat.draw(&mut svg, &axes, bounds);
    contour::draw(&mut svg, &axes, &heat, &data.contours);
    if data.diagonal {
        let (x, y) = (axes.x.range, axes.y.range);
        let (lo, hi) = (x.lo.min(y.lo), x.hi.max(y.hi));
        axes.segment(&mut svg, [lo, lo], [hi, hi], Style::stroke(WHITE, 2.6).faint(0.75));
        axes.segment(&mut svg, [lo, lo], [hi, hi], Style::stroke(INK, 0.9).dashed(Dash::Short));
    }
    if let Some(field) = &data.marked {
        let ([x0, y0], [x1, y1]) = (axes.at(field.x[0], field.y[0]), axes.at(field.x[1], field.y[1]));
        let (left, right) =
            (x0.min(x1).clamp(frame.x, frame.right()), x0.max(x1).clamp(frame.x, frame.right()));
        let (upper, lower) =
            (y0.min(y1).clamp(frame.y, frame.bottom()), y0.max(y1).clamp(frame.y, frame.bottom()));
        svg.rect(left, upper, right - left, lower - upper, Style::stroke(WHITE, 3.6));
        svg.rect(left, upper, right - left, lower - upper, Style::stroke(INK, 1.6));
        let middle = 0.5 * (left + right);
        svg.text([middle, frame.y - 6.0], &field.label, Text::new(SMALL, INK).middle());
    }
    let label = |name: &str, unit: &str, with_unit: String| {
        if unit.is_empty() { name.to_string() } else { with_unit }
    };
    axes.border(
        &mut svg,
        Some(&label(&data.x_name, &data.x_unit, axes.x.label(&data.x_name, &data.x_unit))),
        &label(&data.y_name, &data.y_unit, axes.y.label(&data.y_name, &data.y_unit)),
    );
    let quantity = if data.unit.is_empty() {
        data.quantity.clone()
    } else {
        format!("{} [{}]", data.quantity, data.unit)
    };
    color_bar(&mut svg, frame, WIDTH - COLOR_BAR_WIDTH, bounds, &quantity);
    svg.height = frame.bottom() + BOTTOM;
    svg
}

/// Bounds of all values, rounded outwards to about a twentieth of their range.
fn round_bounds(values: &[f64]) -> Range {
    let Some((lo, hi)) = extremes(values.iter().copied()) else { return Range::new(0.0, 1.0) };
    let step = nice_step(hi - lo, 20.0);
    Range::new(step * (lo / step).floor(), step * (hi / step).ceil())
}

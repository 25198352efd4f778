//! Bode plot over shaft speed: amplitude and phase of the synchronous (1x) response.

use super::axes::Axes;
use super::campbell::Critical;
use super::labels::{Entry, page_heading};
use super::panels::{phase_axes, phase_curve, stack};
use super::scale::Range;
use super::style::*;
use super::svg::{Dash, Style, Svg, Text};

/// Response of one point over speed.
#[derive(Clone, Debug, Default)]
pub struct BodeCurve {
    pub label: String,
    /// Shaft speeds \[rpm\], ascending.
    pub rpm: Vec<f64>,
    /// Amplitudes in the unit of the figure.
    pub amplitude: Vec<f64>,
    /// Phase angles \[deg\], wrapped or unwrapped.
    pub phase_deg: Vec<f64>,
}

/// Data of a Bode plot over speed.
#[derive(Clone, Debug, Default)]
pub struct Bode {
    pub title: String,
    pub note: String,
    /// Quantity of the amplitude and its unit, e.g. "amplitude 0–peak", "µm".
    pub quantity: String,
    pub unit: String,
    pub curves: Vec<BodeCurve>,
    /// Logarithmic amplitude.
    pub log: bool,
    /// Critical speeds, marked on the speed axis.
    pub criticals: Vec<Critical>,
}

/// Decades that a logarithmic axis shows of every curve, from its peak down: near standstill the response to an
/// unbalance grows with the square of the speed, from nothing.
const SHOWN_DECADES: i32 = 4;

pub fn draw(data: &Bode) -> Svg {
    let entries: Vec<Entry> =
        data.curves.iter().enumerate().map(|(k, c)| Entry::line(&c.label, curve(k))).collect();
    let (mut svg, top) = page_heading(WIDTH, LEFT, &data.title, &data.note, &entries);
    let marked = if data.criticals.is_empty() { 0.0 } else { 12.0 };
    let frames = stack(top + marked, WIDTH - LEFT - RIGHT, &[280.0, 140.0]);
    let x = Range::of(data.curves.iter().flat_map(|c| c.rpm.iter().copied())).near_zero();
    let amplitudes = data.curves.iter().flat_map(|c| c.amplitude.iter().copied());
    let amplitude = if data.log {
        let floor = axis_floor(&data.curves);
        Axes::log_y(frames[0], x, Range::positive(amplitudes.filter(|a| *a >= floor)).log_padded(0.04))
    } else {
        Axes::linear(frames[0], x, Range::with_zero(amplitudes).padded_top(0.06))
    };
    let phase = phase_axes(frames[1], x);
    amplitude.grid(&mut svg);
    phase.grid(&mut svg);
    let mut free_from = f64::NEG_INFINITY;
    for critical in data.criticals.iter().filter(|c| x.contains(c.rpm)) {
        let at = amplitude.x.px(critical.rpm);
        for frame in &frames {
            svg.line([at, frame.y], [at, frame.bottom()], Style::stroke(PALE, 1.0).dashed(Dash::Short));
        }
        let half = 0.5 * super::font::width(&critical.label, SMALL);
        if at - half > free_from {
            svg.text([at, frames[0].y - 5.0], &critical.label, Text::new(SMALL, MUTED).middle());
            free_from = at + half + 6.0;
        }
    }
    for (k, c) in data.curves.iter().enumerate() {
        amplitude.curve(&mut svg, &c.rpm, &c.amplitude, curve(k));
        phase_curve(&mut svg, &phase, &c.rpm, &c.phase_deg, curve(k).thick(1.2));
    }
    amplitude.border(&mut svg, None, &amplitude.y.label(&data.quantity, &data.unit));
    phase.border(&mut svg, Some(&phase.x.label("shaft speed", "rpm")), "phase [°]");
    svg.height = frames[1].bottom() + BOTTOM;
    svg
}

/// Least amplitude that a logarithmic axis shows.
fn axis_floor(curves: &[BodeCurve]) -> f64 {
    let peaks = curves.iter().map(|c| c.amplitude.iter().copied().fold(0.0, f64::max));
    peaks.filter(|peak| *peak > 0.0).fold(f64::INFINITY, f64::min) * 10f64.powi(-SHOWN_DECADES)
}

//! Frequency response functions (Bode plot over frequency): magnitude, phase, and coherence if measured.

use super::axes::Axes;
use super::labels::{Entry, page_heading};
use super::panels::{degrees, phase_axes, phase_curve, stack};
use super::scale::Range;
use super::style::*;
use super::svg::Svg;

/// One frequency response function.
#[derive(Clone, Debug, Default)]
pub struct FrfCurve {
    pub label: String,
    /// Frequencies \[Hz\], ascending.
    pub hz: Vec<f64>,
    /// Real and imaginary part, in the unit of the figure.
    pub re: Vec<f64>,
    pub im: Vec<f64>,
    /// Coherence from 0 to 1; empty if not measured.
    pub coherence: Vec<f64>,
}

/// Data of an FRF figure.
#[derive(Clone, Debug, Default)]
pub struct Frf {
    pub title: String,
    pub note: String,
    /// "receptance", "mobility" or "accelerance".
    pub quantity: String,
    /// Its unit, e.g. "m/N".
    pub unit: String,
    pub curves: Vec<FrfCurve>,
}

pub fn draw(data: &Frf) -> Svg {
    let entries: Vec<Entry> = match data.curves.as_slice() {
        [only] if only.label.is_empty() => Vec::new(),
        curves => curves.iter().enumerate().map(|(k, c)| Entry::line(&c.label, curve(k))).collect(),
    };
    let (mut svg, top) = page_heading(WIDTH, LEFT, &data.title, &data.note, &entries);
    let coherent = data.curves.iter().any(|c| !c.coherence.is_empty());
    let heights: &[f64] = if coherent { &[280.0, 120.0, 90.0] } else { &[300.0, 130.0] };
    let frames = stack(top, WIDTH - LEFT - RIGHT, heights);
    let x = Range::of(data.curves.iter().flat_map(|c| c.hz.iter().copied())).near_zero();
    let magnitudes: Vec<Vec<f64>> =
        data.curves.iter().map(|c| c.re.iter().zip(&c.im).map(|(re, im)| re.hypot(*im)).collect()).collect();
    let y = Range::positive(magnitudes.iter().flatten().copied()).log_padded(0.04);
    let magnitude = Axes::log_y(frames[0], x, y);
    let phase = phase_axes(frames[1], x);
    magnitude.grid(&mut svg);
    phase.grid(&mut svg);
    for (k, (c, values)) in data.curves.iter().zip(&magnitudes).enumerate() {
        magnitude.curve(&mut svg, &c.hz, values, curve(k));
        let angles: Vec<f64> = c.re.iter().zip(&c.im).map(|(re, im)| degrees(*re, *im)).collect();
        phase_curve(&mut svg, &phase, &c.hz, &angles, curve(k).thick(1.2));
    }
    let x_label = magnitude.x.label("frequency", "Hz");
    magnitude.border(&mut svg, None, &magnitude.y.label(&data.quantity, &data.unit));
    phase.border(&mut svg, (!coherent).then_some(x_label.as_str()), "phase [°]");
    if let Some(&frame) = frames.get(2) {
        let axes = Axes::linear(frame, x, Range::new(0.0, 1.0));
        axes.grid(&mut svg);
        for (k, c) in data.curves.iter().enumerate() {
            axes.curve(&mut svg, &c.hz, &c.coherence, curve(k).thick(1.0));
        }
        axes.border(&mut svg, Some(&x_label), "coherence [–]");
    }
    svg.height = frames.last().map_or(top, |f| f.bottom()) + BOTTOM;
    svg
}

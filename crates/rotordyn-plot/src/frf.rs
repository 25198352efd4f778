//! Frequency response functions (Bode plot over frequency): magnitude, phase, and coherence if measured.

use super::axes::{Axes, Frame};
use super::font;
use super::labels::{Entry, page_heading};
use super::panels::{degrees, phase_axes, phase_curve, stack};
use super::scale::Range;
use super::style::*;
use super::svg::{Svg, Text};

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
    /// A panel for each curve, all with the same axes, instead of common axes.
    pub apart: bool,
}

pub fn draw(data: &Frf) -> Svg {
    if data.apart {
        return draw_apart(data);
    }
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

/// A panel of magnitude and phase for every curve, in two columns.
fn draw_apart(data: &Frf) -> Svg {
    const COLUMNS: usize = 2;
    const GAP_ACROSS: f64 = 46.0;
    const HEIGHTS: [f64; 2] = [132.0, 58.0];
    const GAPS: [f64; 2] = [6.0, NAME];
    /// Above a panel, for its name.
    const NAME: f64 = 26.0;
    let (mut svg, heading) = page_heading(WIDTH, LEFT, &data.title, &data.note, &[]);
    let top = heading + NAME - 10.0;
    let w = (WIDTH - LEFT - RIGHT - GAP_ACROSS) / COLUMNS as f64;
    let x = Range::of(data.curves.iter().flat_map(|c| c.hz.iter().copied())).near_zero();
    let magnitudes: Vec<Vec<f64>> =
        data.curves.iter().map(|c| c.re.iter().zip(&c.im).map(|(re, im)| re.hypot(*im)).collect()).collect();
    let y = Range::positive(magnitudes.iter().flatten().copied()).log_padded(0.06);
    let mut bottom = top;
    for (k, (c, values)) in data.curves.iter().zip(&magnitudes).enumerate() {
        let (column, row) = (k % COLUMNS, k / COLUMNS);
        let left = LEFT + (w + GAP_ACROSS) * column as f64;
        let upper = top + (HEIGHTS.iter().sum::<f64>() + GAPS.iter().sum::<f64>()) * row as f64;
        let magnitude = Axes::log_y(Frame { x: left, y: upper, w, h: HEIGHTS[0] }, x, y);
        let lower = Frame { x: left, y: upper + HEIGHTS[0] + GAPS[0], w, h: HEIGHTS[1] };
        let mut phase = phase_axes(lower, x);
        phase.y = phase.y.at_ticks(&[-180.0, 0.0, 180.0]);
        magnitude.grid(&mut svg);
        phase.grid(&mut svg);
        magnitude.curve(&mut svg, &c.hz, values, curve(0));
        let angles: Vec<f64> = c.re.iter().zip(&c.im).map(|(re, im)| degrees(*re, *im)).collect();
        phase_curve(&mut svg, &phase, &c.hz, &angles, curve(0).thick(1.0));
        // Only the lowest panel of a column has an x label, only the first of a row one of y.
        let x_label = (k + COLUMNS >= data.curves.len()).then(|| magnitude.x.label("frequency", "Hz"));
        let labels = match column {
            0 => [magnitude.y.label(&data.quantity, &data.unit), "phase [°]".into()],
            _ => Default::default(),
        };
        magnitude.border(&mut svg, None, &labels[0]);
        phase.border(&mut svg, x_label.as_deref(), &labels[1]);
        let name = font::fit(&c.label, LABEL, w);
        svg.text([left, upper - 7.0], &name, Text::new(LABEL, INK));
        bottom = bottom.max(lower.bottom());
    }
    svg.height = bottom + BOTTOM;
    svg
}

//! Stabilisation diagram (stability diagram): poles of every model order with the mode indicator function
//! (CMIF).

use super::axes::{Axes, Frame, Marker};
use super::footnote;
use super::labels::{EndLabel, Entry, end_labels, page_heading};
use super::scale::Range;
use super::style::*;
use super::svg::{Color, Dash, Style, Svg};

/// Stability class of a pole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PoleStability {
    New,
    Frequency,
    Damping,
    Shape,
    Stable,
}

/// Data of a stabilisation diagram.
#[derive(Clone, Debug, Default)]
pub struct Stabilisation {
    pub title: String,
    pub note: String,
    /// Frequency \[Hz\], model order and stability class of every pole.
    pub poles: Vec<(f64, usize, PoleStability)>,
    /// Name of the curves behind the poles, such as "mode indicator".
    pub curves_name: String,
    /// Frequencies \[Hz\] and values of these curves (any unit), the largest first.
    pub hz: Vec<f64>,
    pub curves: Vec<Vec<f64>>,
    /// Frequencies \[Hz\] of the selected modes, and whether they are doubtful.
    pub selected: Vec<(f64, bool)>,
    /// Frequencies \[Hz\] of stable poles that are no modes, with the reason.
    pub dropped: Vec<(f64, String)>,
}

const STATES: [(PoleStability, &str, Marker, Color); 5] = [
    (PoleStability::New, "new pole", Marker::Circle, PALE),
    (PoleStability::Frequency, "stable frequency", Marker::Circle, ORANGE),
    (PoleStability::Damping, "frequency and damping", Marker::Down, PURPLE),
    (PoleStability::Shape, "frequency and shape", Marker::Up, GREEN),
    (PoleStability::Stable, "stable", Marker::Square, BLUE),
];

pub fn draw(data: &Stabilisation) -> Svg {
    let mark = |color: Color, stable: bool| {
        let style = Style::stroke(color, 0.8);
        if stable { style.filled(color) } else { style }
    };
    let mut entries: Vec<Entry> = STATES
        .iter()
        .map(|(state, name, marker, color)| {
            Entry::marker(name, *marker, mark(*color, *state == PoleStability::Stable))
        })
        .collect();
    entries.push(Entry::line(&data.curves_name, Style::stroke(PALE, 1.2)));
    let selected = |doubtful: bool| match doubtful {
        false => Style::stroke(RED, 0.9).dashed(Dash::Short),
        true => Style::stroke(ORANGE, 0.9).dashed(Dash::Dotted),
    };
    entries.push(Entry::line("selected mode", selected(false)));
    if data.selected.iter().any(|(_, doubtful)| *doubtful) {
        entries.push(Entry::line("doubtful mode", selected(true)));
    }
    let dropped = Style::stroke(MUTED, 0.9);
    if !data.dropped.is_empty() {
        entries.push(Entry::marker("dropped", Marker::Diamond, dropped));
    }
    let (mut svg, top) = page_heading(WIDTH, LEFT, &data.title, &data.note, &entries);
    let frame = Frame { x: LEFT, y: top + 30.0, w: WIDTH - LEFT - RIGHT, h: 400.0 };
    let x = match (data.hz.first(), data.hz.last()) {
        (Some(a), Some(b)) => Range::new(*a, *b),
        _ => Range::of(data.poles.iter().map(|p| p.0)),
    };
    let orders = Range::with_zero(data.poles.iter().map(|p| p.1 as f64)).padded_top(0.03);
    let axes = Axes::linear(frame, x, orders);
    axes.grid(&mut svg);
    let sizes = data.curves.iter().flatten().copied();
    let behind = Axes::log_y(frame, x, Range::positive(sizes).log_padded(0.05));
    for (k, curve) in data.curves.iter().enumerate() {
        behind.curve(&mut svg, &data.hz, curve, Style::stroke(PALE, if k == 0 { 1.6 } else { 0.9 }));
    }
    let mut labels = Vec::new();
    for (hz, doubtful) in &data.selected {
        let style = selected(*doubtful);
        axes.segment(&mut svg, [*hz, axes.y.range.lo], [*hz, axes.y.range.hi], style);
        let color = if *doubtful { ORANGE } else { RED };
        labels.push(EndLabel { at: axes.at(*hz, axes.y.range.hi), text: format!("{hz:.1}"), color });
    }
    for (hz, _) in &data.dropped {
        let at = axes.at(*hz, axes.y.range.hi);
        if axes.contains(at) {
            Marker::Diamond.draw(&mut svg, at, dropped);
        }
    }
    for (state, _, marker, color) in STATES {
        for (hz, order, _) in data.poles.iter().filter(|p| p.2 == state) {
            let at = axes.at(*hz, *order as f64);
            if axes.contains(at) {
                marker.draw(&mut svg, at, mark(color, state == PoleStability::Stable));
            }
        }
    }
    end_labels(&mut svg, &axes, &labels);
    axes.border(&mut svg, Some(&axes.x.label("frequency", "Hz")), "model order");
    svg.height = frame.bottom() + BOTTOM;
    let reasons: Vec<String> =
        data.dropped.iter().map(|(hz, reason)| format!("{hz:.2} Hz {reason}")).collect();
    footnote::list(&mut svg, "Dropped:", &reasons, ";");
    svg
}

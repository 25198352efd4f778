//! Panels side by side on the same scales: one run beside another.

use super::axes::{Axes, Frame};
use super::style::*;
use super::svg::{Svg, Text};

/// Width of each of several panels \[px\].
const BESIDE: f64 = 400.0;
/// Between them: the last number of one axis must keep off the first of the next \[px\].
const BETWEEN: f64 = 34.0;

/// A row of panels, the first with the scale of y.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    count: usize,
    panel: f64,
}

impl Row {
    /// One panel is as wide as `alone`.
    pub fn new(count: usize, alone: f64) -> Self {
        Row { count: count.max(1), panel: if count > 1 { BESIDE } else { alone } }
    }

    /// Of all panels with the gaps between them \[px\].
    pub fn width(self) -> f64 {
        self.panel * self.count as f64 + BETWEEN * (self.count - 1) as f64
    }

    pub fn frame(self, k: usize, y: f64, h: f64) -> Frame {
        Frame { x: LEFT + (self.panel + BETWEEN) * k as f64, y, w: self.panel, h }
    }

    /// Border with its labels, each a name and a unit; y is labelled at the first panel only.
    pub fn border(self, svg: &mut Svg, axes: &Axes, k: usize, x: (&str, &str), y: (&str, &str)) {
        let x_label = axes.x.label(x.0, x.1);
        if k == 0 {
            axes.border(svg, Some(&x_label), &axes.y.label(y.0, y.1));
        } else {
            axes.bare_border(svg, &x_label);
        }
    }

    /// The panel's name in its corner, where there are several.
    pub fn name(self, svg: &mut Svg, frame: Frame, name: &str) {
        if self.count > 1 {
            svg.text([frame.x + 8.0, frame.y + 17.0], name, Text::new(LABEL, INK).halo());
        }
    }
}

//! Panels in a row on common scales, to compare runs.

use super::axes::{Axes, Frame};
use super::style::*;
use super::svg::{Svg, Text};

/// Panel width with several panels \[px\].
const PANEL_WIDTH: f64 = 400.0;
/// Gap between panels, so that tick labels of adjacent axes do not overlap \[px\].
const PANEL_GAP: f64 = 34.0;

/// A row of panels; only the first has a labelled y axis.
#[derive(Clone, Copy, Debug)]
pub struct PanelRow {
    count: usize,
    panel: f64,
}

impl PanelRow {
    /// `alone` is the width of a single panel.
    pub fn new(count: usize, alone: f64) -> Self {
        PanelRow { count: count.max(1), panel: if count > 1 { PANEL_WIDTH } else { alone } }
    }

    /// Total width of the panels and gaps \[px\].
    pub fn width(self) -> f64 {
        self.panel * self.count as f64 + PANEL_GAP * (self.count - 1) as f64
    }

    pub fn frame(self, k: usize, y: f64, h: f64) -> Frame {
        Frame { x: LEFT + (self.panel + PANEL_GAP) * k as f64, y, w: self.panel, h }
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

    /// Writes the panel name into its corner, if there are several panels.
    pub fn name(self, svg: &mut Svg, frame: Frame, name: &str) {
        if self.count > 1 {
            svg.text([frame.x + 8.0, frame.y + 17.0], name, Text::new(LABEL, INK).halo());
        }
    }
}

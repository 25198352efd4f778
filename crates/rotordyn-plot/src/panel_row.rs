//! Panels on common scales, to compare runs: in a row, several rows if there are many.

use super::axes::{Axes, Frame};
use super::style::*;
use super::svg::{Svg, Text};

/// Panel width with several panels \[px\].
const PANEL_WIDTH: f64 = 400.0;
/// Gap between panels, so that tick labels of adjacent axes do not overlap \[px\].
const PANEL_GAP: f64 = 34.0;
/// Gap between rows, for the x axis of one and the labels above the next \[px\].
const ROW_GAP: f64 = BOTTOM + 26.0;
/// Largest number of panels in a row.
const MAX_COLUMNS: usize = 4;

/// Rows of panels; only the first of a row has a labelled y axis.
#[derive(Clone, Copy, Debug)]
pub struct PanelRow {
    count: usize,
    columns: usize,
    panel: f64,
}

impl PanelRow {
    /// `alone` is the width of a single panel.
    pub fn new(count: usize, alone: f64) -> Self {
        let count = count.max(1);
        let columns = count.div_ceil(count.div_ceil(MAX_COLUMNS));
        PanelRow { count, columns, panel: if count > 1 { PANEL_WIDTH } else { alone } }
    }

    /// Total width of the panels and gaps \[px\].
    pub fn width(self) -> f64 {
        self.panel * self.columns as f64 + PANEL_GAP * (self.columns - 1) as f64
    }

    pub fn frame(self, k: usize, y: f64, h: f64) -> Frame {
        let (column, row) = ((k % self.columns) as f64, (k / self.columns) as f64);
        Frame { x: LEFT + (self.panel + PANEL_GAP) * column, y: y + (h + ROW_GAP) * row, w: self.panel, h }
    }

    /// Whether panel k is the last of its row.
    pub fn ends_row(self, k: usize) -> bool {
        k + 1 == self.count || (k + 1).is_multiple_of(self.columns)
    }

    /// Border with its labels, each a name and a unit; y is labelled at the first panel of a row only.
    pub fn border(self, svg: &mut Svg, axes: &Axes, k: usize, x: (&str, &str), y: (&str, &str)) {
        let x_label = axes.x.label(x.0, x.1);
        if k.is_multiple_of(self.columns) {
            axes.border(svg, Some(&x_label), &axes.y.label(y.0, y.1));
        } else {
            axes.bare_border(svg, &x_label);
        }
    }

    /// Writes the panel name into its corner, if there are several panels.
    pub fn name(self, svg: &mut Svg, frame: Frame, name: &str) {
        if self.count > 1 {
            let name = super::font::fit(name, LABEL, frame.w - 16.0);
            svg.text([frame.x + 8.0, frame.y + 17.0], &name, Text::new(LABEL, INK).halo());
        }
    }
}

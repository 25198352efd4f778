//! Names of parts in a row above a drawing, with leader lines that cross no name.

use super::font;
use super::labels::place_without_overlap;
use super::style::*;
use super::svg::{Color, Style, Svg, Text};

/// The name of a part and where its leader may end.
#[derive(Clone, Debug)]
pub struct Callout {
    pub text: String,
    pub color: Color,
    /// Horizontal extent of the part \[px\].
    pub x: [f64; 2],
    /// Page height of the end of the leader \[px\].
    pub y: f64,
}

/// Names in a row; upright if too many to fit horizontally.
#[derive(Clone, Debug)]
pub struct CalloutRow {
    items: Vec<Callout>,
    upright: bool,
    page: f64,
    /// Height of the names \[px\].
    pub height: f64,
}

impl CalloutRow {
    /// A row on a page of the given width \[px\].
    pub fn new(items: Vec<Callout>, page: f64) -> Self {
        let widths = || items.iter().map(|c| font::width(&c.text, SMALL));
        let upright = widths().map(|w| w + 10.0).sum::<f64>() > page - 8.0;
        let height = if upright { widths().fold(0.0, f64::max) } else { SMALL };
        CalloutRow { items, upright, page, height }
    }

    /// Writes the names on the baseline `y`, the leaders down from there.
    ///
    /// A leader ends in the extent of its part below its name, so that those of parts at one place do not
    /// coincide.
    pub fn draw(&self, svg: &mut Svg, y: f64) {
        let size = |c: &Callout| if self.upright { 1.25 * SMALL } else { font::width(&c.text, SMALL) + 10.0 };
        let wanted: Vec<f64> = self.items.iter().map(|c| 0.5 * (c.x[0] + c.x[1])).collect();
        let sizes: Vec<f64> = self.items.iter().map(size).collect();
        let places = place_without_overlap(&wanted, &sizes, 4.0, self.page - 4.0);
        for (c, x) in self.items.iter().zip(places).filter_map(|(c, x)| Some((c, x?))) {
            let tip = x.clamp(c.x[0].min(c.x[1]), c.x[1].max(c.x[0]));
            svg.group("leader", |svg| {
                svg.polyline(&[[tip, c.y], [tip, y + 10.0], [x, y + 3.0]], Style::stroke(MUTED, 0.7));
            });
            let text = Text::new(SMALL, c.color);
            if self.upright {
                svg.text([x + 0.36 * SMALL, y], &c.text, text.upright());
            } else {
                svg.text([x, y], &c.text, text.middle());
            }
        }
    }
}

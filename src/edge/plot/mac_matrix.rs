//! MAC matrix: shapes of two sets against each other.

use super::color_map;
use super::font;
use super::labels::head;
use super::style::*;
use super::svg::{Style, Svg, Text};

/// Data of a MAC matrix.
#[derive(Clone, Debug, Default)]
pub struct MacMatrix {
    pub title: String,
    pub note: String,
    /// Names of the sets, and of the modes in them.
    pub row_set: String,
    pub column_set: String,
    pub rows: Vec<String>,
    pub columns: Vec<String>,
    /// `values[row][column]`, 0 to 1.
    pub values: Vec<Vec<f64>>,
}

/// Side of the matrix \[px\], and of a cell at most.
const SIDE: f64 = 470.0;
const CELL: f64 = 44.0;

/// Most modes of a set.
const MOST: usize = 80;

pub fn draw(data: &MacMatrix) -> Svg {
    let names = |all: &[String]| -> Vec<String> {
        all.iter().take(MOST).map(|name| font::fit(&font::shorten(name, 40), SMALL, 120.0)).collect()
    };
    let (rows, columns) = (names(&data.rows), names(&data.columns));
    let (mut svg, top) = head(WIDTH, LEFT, &data.title, &data.note, &[]);
    let count = rows.len().max(columns.len()).max(1);
    let cell = (SIDE / count as f64).min(CELL);
    let left = LEFT + rows.iter().map(|r| font::width(r, SMALL)).fold(0.0, f64::max) - 20.0;
    let above = columns.iter().map(|c| font::width(c, SMALL)).fold(0.0, f64::max);
    let top = top + above + 34.0;
    let colors = color_map::table();
    for (r, row) in data.values.iter().take(rows.len()).enumerate() {
        for (c, value) in row.iter().take(columns.len()).enumerate() {
            let (x, y) = (left + cell * c as f64, top + cell * r as f64);
            let Some(index) = color_map::index(*value, 0.0, 1.0) else { continue };
            svg.rect(x, y, cell, cell, Style::stroke(WHITE, 0.8).filled(colors[usize::from(index)]));
            if cell >= 24.0 && *value >= 0.005 {
                let ink = if *value > 0.45 { WHITE } else { INK };
                let at = [x + 0.5 * cell, y + 0.5 * cell + 0.36 * SMALL];
                svg.text(at, &format!("{value:.2}"), Text::new(SMALL, ink).middle());
            }
        }
    }
    let (w, h) = (cell * columns.len() as f64, cell * rows.len() as f64);
    svg.rect(left, top, w, h, FRAME);
    for (r, name) in rows.iter().enumerate() {
        let y = top + cell * (r as f64 + 0.5) + 0.36 * SMALL;
        svg.text([left - 6.0, y], name, Text::new(SMALL, INK).end());
    }
    for (c, name) in columns.iter().enumerate() {
        let x = left + cell * (c as f64 + 0.5) + 0.36 * SMALL;
        svg.text([x, top - 6.0], name, Text::new(SMALL, INK).upright());
    }
    svg.text([left + 0.5 * w, top - above - 16.0], &data.column_set, Text::new(LABEL, INK).middle());
    svg.text([LEFT - 58.0, top + 0.5 * h], &data.row_set, Text::new(LABEL, INK).middle().upright());
    svg.height = top + h + 24.0;
    svg
}

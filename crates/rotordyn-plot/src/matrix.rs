//! Matrix of values from 0 to 1 as shaded cells: MAC, auto-MAC, FRAC.

use super::axes::Frame;
use super::heat::{COLOR_BAR_WIDTH, cells_png, color_bar};
use super::labels::page_heading;
use super::scale::Range;
use super::style::*;
use super::svg::{Style, Svg, Text};
use super::{color_map, font};

/// Data of a matrix figure.
#[derive(Clone, Debug, Default)]
pub struct Matrix {
    pub title: String,
    pub note: String,
    /// Axis names of rows and columns.
    pub row_name: String,
    pub column_name: String,
    pub rows: Vec<String>,
    pub columns: Vec<String>,
    /// `value[row * columns.len() + column]`, 0..1.
    pub value: Vec<f64>,
    /// Quantity of the values.
    pub quantity: String,
    /// Framed cells, (row, column).
    pub marked: Vec<(usize, usize)>,
}

/// Largest number of cells per side drawn individually.
const MAX_CELLS_PER_SIDE: usize = 120;
/// Line height of a label \[px\].
const LABEL_HEIGHT: f64 = 1.3 * SMALL;

pub fn draw(data: &Matrix) -> Svg {
    let (rows, columns) = (data.rows.len().max(1) as f64, data.columns.len().max(1) as f64);
    let short = |names: &[String]| -> Vec<String> {
        names.iter().map(|n| font::fit(&font::shorten(n, 40), SMALL, 160.0)).collect()
    };
    let (row_names, column_names) = (short(&data.rows), short(&data.columns));
    let widest = |names: &[String]| names.iter().map(|n| font::width(n, SMALL)).fold(0.0, f64::max);
    let left = 34.0 + widest(&row_names);
    let cell = [((WIDTH - left - COLOR_BAR_WIDTH - 30.0) / columns).min(62.0), (440.0 / rows).min(30.0)];
    // Page width limited to that of the matrix and its title.
    let text = font::width(&data.title, TITLE).max(font::width(&data.note, TICK)) + 12.0;
    let page = (left + text.max(cell[0] * columns + COLOR_BAR_WIDTH + 26.0)).min(WIDTH);
    let (mut svg, top) = page_heading(page, left, &data.title, &data.note, &[]);
    let frame = Frame { x: left, y: top, w: cell[0] * columns, h: cell[1] * rows };
    // Very fine cells are drawn as one image.
    let picture = data.rows.len().max(data.columns.len()) > MAX_CELLS_PER_SIDE;
    if picture && let Some(png) = cells_png(&data.value, [data.rows.len(), data.columns.len()], [440, 600]) {
        svg.image(frame.x, frame.y, frame.w, frame.h, &png);
    }
    let one_by_one = if picture { &[] } else { &data.value[..] };
    for (k, value) in one_by_one.iter().enumerate() {
        let (i, j) = (k / data.columns.len().max(1), k % data.columns.len().max(1));
        let Some(shade) = color_map::index(*value, 0.0, 1.0) else { continue };
        let at = [frame.x + cell[0] * j as f64, frame.y + cell[1] * i as f64];
        svg.rect(at[0], at[1], cell[0], cell[1], Style::fill(color_map::table()[usize::from(shade)]));
        if cell[0] >= 26.0 && cell[1] >= LABEL_HEIGHT && *value >= 0.05 {
            let color = if *value > 0.45 { WHITE } else { INK };
            let middle = [at[0] + 0.5 * cell[0], at[1] + 0.5 * cell[1] + 0.36 * SMALL];
            svg.text(middle, &format!("{value:.2}"), Text::new(SMALL, color).middle());
        }
    }
    for &(i, j) in &data.marked {
        let at = [frame.x + cell[0] * j as f64, frame.y + cell[1] * i as f64];
        svg.rect(at[0] + 1.0, at[1] + 1.0, cell[0] - 2.0, cell[1] - 2.0, Style::stroke(BLUE, 2.0));
    }
    svg.rect(frame.x, frame.y, frame.w, frame.h, FRAME);
    // Only every n-th name if there is no room for all.
    let every = |size: f64| (LABEL_HEIGHT / size).ceil().max(1.0) as usize;
    for (i, name) in row_names.iter().enumerate().step_by(every(cell[1])) {
        let y = frame.y + cell[1] * (i as f64 + 0.5);
        svg.line([frame.x - 4.0, y], [frame.x, y], FRAME);
        svg.text([frame.x - 7.0, y + 0.36 * SMALL], name, Text::new(SMALL, INK).end());
    }
    // Rotated names below their columns.
    let names = widest(&column_names);
    for (j, name) in column_names.iter().enumerate().step_by(every(cell[0])) {
        let x = frame.x + cell[0] * (j as f64 + 0.5);
        svg.line([x, frame.bottom()], [x, frame.bottom() + 4.0], FRAME);
        svg.text([x + 0.36 * SMALL, frame.bottom() + 8.0], name, Text::new(SMALL, INK).upright().end());
    }
    svg.text([12.0, frame.center()[1]], &data.row_name, Text::new(LABEL, INK).middle().upright());
    let below = frame.bottom() + names + 26.0;
    svg.text([frame.center()[0], below], &data.column_name, Text::new(LABEL, INK).middle());
    let bar = Frame { h: frame.h.max(120.0), ..frame };
    color_bar(&mut svg, bar, frame.right() + 20.0, Range::new(0.0, 1.0), &data.quantity);
    svg.height = (below + 14.0).max(bar.bottom() + 20.0);
    svg
}

//! Heat maps: levels over two axes as an embedded indexed PNG, and the colour bar.

use super::axes::{Axes, Frame};
use super::color_map;
use super::scale::{Range, Scale, extremes};
use super::style::*;
use super::svg::{PNG_SCALE, Svg, Text};
use rotordyn_core::series::{Series, SeriesError};
use std::borrow::Cow;
use std::convert::Infallible;

/// Image pixels per page px: those of the PNG; with 200 colours a noisy map stays below a megabyte.
const PIXELS_PER_PX: f64 = PNG_SCALE as f64;

/// Levels on a grid: `level[i * y.len() + j]` at `x[i]`, `y[j]`; any order, any spacing.
#[derive(Clone, Copy, Debug)]
pub struct Heat<'a> {
    pub x: &'a [f64],
    pub y: &'a [f64],
    pub level: &'a [f64],
}

/// Level bounds of the colour map: highest level rounded up to a multiple of five, minus `span`.
pub fn bounds(levels: impl Iterator<Item = f64>, span: f64) -> Range {
    bounds_between(extremes(levels), span)
}

/// The same from the lowest and highest level.
pub fn bounds_between(extremes: Option<(f64, f64)>, span: f64) -> Range {
    let (lo, hi) = extremes.unwrap_or((-1.0, 0.0));
    let top = 5.0 * (hi / 5.0).ceil();
    let span = if span > 0.0 && span.is_finite() { span } else { 80.0 };
    Range::new(if hi - lo < 1.0 { top - 5.0 } else { top - span }, top)
}

/// Levels of the points of a grid along y, one row for each x; a row may be shorter.
pub trait Rows {
    type Error;

    /// The row at `x[i]`, of `count` levels.
    ///
    /// # Errors
    /// Levels that cannot be read.
    fn row(&self, i: usize, count: usize) -> Result<Cow<'_, [f64]>, Self::Error>;
}

impl Rows for [f64] {
    type Error = Infallible;

    fn row(&self, i: usize, count: usize) -> Result<Cow<'_, [f64]>, Infallible> {
        let end = ((i + 1) * count).min(self.len());
        Ok(Cow::Borrowed(&self[(i * count).min(end)..end]))
    }
}

impl Rows for Series {
    type Error = SeriesError;

    fn row(&self, i: usize, count: usize) -> Result<Cow<'_, [f64]>, SeriesError> {
        self.read(i * count..(i + 1) * count)
    }
}

impl Heat<'_> {
    /// Draws the map into the axes: each pixel shows the highest level of the cells it covers, so that narrow
    /// ridges are kept; non-finite levels and points outside the grid stay white.
    pub fn draw(&self, svg: &mut Svg, axes: &Axes, bounds: Range) {
        match draw_rows(svg, axes, bounds, [self.x, self.y], self.level) {
            Ok(()) => {}
            Err(never) => match never {},
        }
    }
}

/// The same with levels that are read row by row, at `x` and `y`.
///
/// # Errors
/// Levels that cannot be read.
pub fn draw_rows<L: Rows + ?Sized>(
    svg: &mut Svg,
    axes: &Axes,
    bounds: Range,
    [x, y]: [&[f64]; 2],
    levels: &L,
) -> Result<(), L::Error> {
    let f = axes.frame;
    let (w, h) =
        ((f.w * PIXELS_PER_PX).round().max(1.0) as usize, (f.h * PIXELS_PER_PX).round().max(1.0) as usize);
    let columns = cells(x, &axes.x, w);
    let rows = cells(y, &axes.y, h);
    let empty = color_map::COUNT as u8;
    let mut pixels = vec![empty; w * h];
    let mut highest = vec![f64::NEG_INFINITY; h];
    for (px, xs) in columns.of_pixel.iter().enumerate() {
        highest.fill(f64::NEG_INFINITY);
        for i in &columns.order[xs.clone()] {
            let row = levels.row(*i, y.len())?;
            for (highest, ys) in highest.iter_mut().zip(&rows.of_pixel) {
                let levels = rows.order[ys.clone()].iter().filter_map(|j| row.get(*j));
                *highest = levels.copied().filter(|v| v.is_finite()).fold(*highest, f64::max);
            }
        }
        for (py, highest) in highest.iter().enumerate() {
            if let Some(index) = color_map::index(*highest, bounds.lo, bounds.hi) {
                // Image rows go downwards.
                pixels[(h - 1 - py) * w + px] = index;
            }
        }
    }
    if let Some(png) = indexed_png(w, h, &pixels) {
        svg.image(f.x, f.y, f.w, f.h, &png);
    }
    Ok(())
}

/// The cells of a grid along one axis.
struct Cells {
    /// Grid indices by ascending value, without non-finite values.
    order: Vec<usize>,
    /// For each pixel the cells it covers, as a range of `order`.
    of_pixel: Vec<std::ops::Range<usize>>,
}

/// Cell edges are midway between grid values.
fn cells(grid: &[f64], scale: &Scale, pixels: usize) -> Cells {
    let mut order: Vec<usize> = (0..grid.len()).filter(|&k| grid[k].is_finite()).collect();
    order.sort_by(|&a, &b| grid[a].total_cmp(&grid[b]));
    let grid: Vec<f64> = order.iter().map(|&k| grid[k]).collect();
    let n = grid.len();
    if n == 0 {
        return Cells { order, of_pixel: vec![0..0; pixels] };
    }
    let Range { lo, hi } = scale.range;
    let edge = |k: usize| match k {
        _ if n == 1 => [lo, hi][k.min(1)],
        0 => grid[0] - 0.5 * (grid[1] - grid[0]),
        k if k == n => grid[n - 1] + 0.5 * (grid[n - 1] - grid[n - 2]),
        k => 0.5 * (grid[k - 1] + grid[k]),
    };
    let edges: Vec<f64> = (0..=n).map(edge).collect();
    let value = |part: f64| lo + part * (hi - lo);
    let covered = |p: usize| {
        let (a, b) = (value(p as f64 / pixels as f64), value((p + 1) as f64 / pixels as f64));
        let from = edges.partition_point(|e| *e <= a).saturating_sub(1);
        let to = edges.partition_point(|e| *e < b).min(n);
        if b <= edges[0] || a >= edges[n] { 0..0 } else { from..to.max(from) }
    };
    Cells { of_pixel: (0..pixels).map(covered).collect(), order }
}

/// Evenly spaced cells as an image of at most `most` pixels; NaN is transparent.
///
/// `value[row * columns + column]`, coloured from 0 to 1.
pub fn cells_png(value: &[f64], [rows, columns]: [usize; 2], most: [usize; 2]) -> Option<Vec<u8>> {
    let (height, width) = (rows.min(most[0]), columns.min(most[1]));
    let shade = |p: usize| {
        let (i, j) = (p / width * rows / height, p % width * columns / width);
        let value = value.get(i * columns + j).copied().unwrap_or(f64::NAN);
        color_map::index(value, 0.0, 1.0).unwrap_or(color_map::COUNT as u8)
    };
    let pixels: Vec<u8> = (0..width * height).map(shade).collect();
    indexed_png(width, height, &pixels)
}

/// An indexed PNG of the colour map; the index after the last colour is transparent.
fn indexed_png(width: usize, height: usize, pixels: &[u8]) -> Option<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, u32::try_from(width).ok()?, u32::try_from(height).ok()?);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    let mut palette: Vec<u8> = color_map::table().iter().flat_map(|c| [c.0, c.1, c.2]).collect();
    palette.extend([255, 255, 255]);
    let mut alpha = vec![255; color_map::COUNT];
    alpha.push(0);
    encoder.set_palette(palette);
    encoder.set_trns(alpha);
    let mut writer = encoder.write_header().ok()?;
    writer.write_image_data(pixels).ok()?;
    writer.finish().ok()?;
    Some(bytes)
}

/// Width of the colour bar with its labels \[px\].
pub const COLOR_BAR_WIDTH: f64 = 74.0;

/// Draws the colour bar of a map, with the height of its panel and its left edge at `x`.
pub fn color_bar(svg: &mut Svg, panel: Frame, x: f64, bounds: Range, label: &str) {
    let bar = Frame { x, w: 14.0, ..panel };
    let pixels: Vec<u8> = (0..color_map::COUNT as u8).rev().collect();
    if let Some(png) = indexed_png(1, pixels.len(), &pixels) {
        svg.image(bar.x, bar.y, bar.w, bar.h, &png);
    }
    svg.rect(bar.x, bar.y, bar.w, bar.h, FRAME);
    let scale = Scale::linear(bounds, bar.up(), 48.0);
    for tick in &scale.ticks {
        let y = scale.px(tick.value);
        svg.line([bar.right(), y], [bar.right() + 4.0, y], FRAME);
        svg.text([bar.right() + 7.0, y + 0.36 * TICK], &tick.label, Text::new(TICK, INK));
    }
    svg.text([bar.right() + 48.0, bar.center()[1]], label, Text::new(LABEL, INK).middle().upright());
}

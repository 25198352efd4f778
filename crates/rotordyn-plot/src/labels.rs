//! Label placement without overlap: line end labels, name rows, legend and page heading.

use super::axes::{Axes, Marker};
use super::style::*;
use super::svg::{Color, Point, Style, Svg, Text};
use super::{font, scale};

/// Places intervals of given sizes without overlap, as near as possible to the wanted centres (least
/// squares), inside `lo..hi`; the last of the list are omitted if there is no room.
pub fn place_without_overlap(wanted: &[f64], sizes: &[f64], lo: f64, hi: f64) -> Vec<Option<f64>> {
    let mut room = hi - lo;
    let mut kept: Vec<usize> = (0..wanted.len().min(sizes.len()))
        .filter(|&k| {
            let fits = wanted[k].is_finite() && sizes[k] <= room;
            room -= if fits { sizes[k] } else { 0.0 };
            fits
        })
        .collect();
    kept.sort_by(|&a, &b| wanted[a].total_cmp(&wanted[b]));
    // Centre k is offset[k] + t[k] with non-decreasing t: isotonic regression (pool adjacent violators).
    let mut offsets = Vec::with_capacity(kept.len());
    let mut edge = 0.0;
    for &k in &kept {
        offsets.push(edge + 0.5 * sizes[k]);
        edge += sizes[k];
    }
    let mut pools: Vec<(f64, usize)> = Vec::new();
    for (&k, offset) in kept.iter().zip(&offsets) {
        let mut pool = (wanted[k] - offset, 1);
        while let Some(last) = pools.last().copied().filter(|last| last.0 >= pool.0) {
            pools.pop();
            let count = last.1 + pool.1;
            pool = ((last.0 * last.1 as f64 + pool.0 * pool.1 as f64) / count as f64, count);
        }
        pools.push(pool);
    }
    let shifts = pools.iter().flat_map(|(mean, count)| std::iter::repeat_n(*mean, *count));
    let mut placed = vec![None; wanted.len()];
    for ((&k, offset), shift) in kept.iter().zip(&offsets).zip(shifts) {
        placed[k] = Some(offset + shift.max(lo).min(hi - edge));
    }
    placed
}

/// A label at the end of a line, at the right or upper edge of a panel.
#[derive(Clone, Debug)]
pub struct EndLabel {
    pub at: Point,
    pub text: String,
    pub color: Color,
}

/// Width needed by end labels to the right of a panel \[px\].
pub fn end_label_width(texts: impl IntoIterator<Item = String>) -> f64 {
    texts.into_iter().map(|t| font::width(&font::shorten(&t, 40), SMALL)).fold(0.0, f64::max).min(170.0)
        + 26.0
}

/// Writes labels to the right of the right edge and above the upper edge; a shifted label gets a leader line.
pub fn end_labels(svg: &mut Svg, axes: &Axes, labels: &[EndLabel]) {
    let f = axes.frame;
    let text = |l: &EndLabel| font::fit(&font::shorten(&l.text, 40), SMALL, 170.0);
    let (top, right): (Vec<&EndLabel>, Vec<&EndLabel>) = labels
        .iter()
        .filter(|l| !l.text.is_empty())
        .partition(|l| l.at[1] <= f.y + 0.5 && l.at[0] < f.right() - 0.5);
    let wanted: Vec<f64> = right.iter().map(|l| l.at[1]).collect();
    let sizes = vec![1.22 * SMALL; right.len()];
    for (label, place) in
        right.iter().zip(place_without_overlap(&wanted, &sizes, f.y - 8.0, f.bottom() + 8.0))
    {
        let Some(y) = place else { continue };
        svg.polyline(
            &[
                [f.right(), label.at[1]],
                [f.right() + 4.0, label.at[1]],
                [f.right() + 12.0, y],
                [f.right() + 15.0, y],
            ],
            Style::stroke(label.color, 0.7).faint(0.7),
        );
        svg.text([f.right() + 18.0, y + 0.36 * SMALL], &text(label), Text::new(SMALL, label.color));
    }
    let wanted: Vec<f64> = top.iter().map(|l| l.at[0]).collect();
    let sizes: Vec<f64> = top.iter().map(|l| font::width(&text(l), SMALL) + 9.0).collect();
    for (label, place) in top.iter().zip(place_without_overlap(&wanted, &sizes, f.x - 10.0, f.right() + 10.0))
    {
        let Some(x) = place else { continue };
        svg.line([label.at[0], f.y], [x, f.y - 6.0], Style::stroke(label.color, 0.7).faint(0.7));
        svg.text([x, f.y - 9.0], &text(label), Text::new(SMALL, label.color).middle());
    }
}

/// A row of names at positions along a horizontal axis; rotated upright if too many to fit horizontally.
#[derive(Clone, Debug)]
pub struct NameRow {
    names: Vec<(f64, String)>,
    upright: bool,
    /// Height of the row \[px\].
    pub height: f64,
}

impl NameRow {
    /// A row of (position \[px\], name) on a page of the given width.
    pub fn new(names: impl IntoIterator<Item = (f64, String)>, page: f64) -> Self {
        let names: Vec<(f64, String)> =
            names.into_iter().map(|(x, n)| (x, font::fit(&n, SMALL, 120.0))).collect();
        let widths = || names.iter().map(|n| font::width(&n.1, SMALL));
        let upright = widths().map(|w| w + 8.0).sum::<f64>() > 0.7 * page;
        let height = if upright { widths().fold(0.0, f64::max) } else { SMALL };
        NameRow { names, upright, height }
    }

    /// Writes the row above (`up`) or below the page height `y`, with leader lines from the positions at `y`.
    pub fn draw(&self, svg: &mut Svg, y: f64, up: bool, color: Color) {
        let side = if up { -1.0 } else { 1.0 };
        let size = |name: &str| if self.upright { 1.15 * SMALL } else { font::width(name, SMALL) + 8.0 };
        let wanted: Vec<f64> = self.names.iter().map(|n| n.0).collect();
        let sizes: Vec<f64> = self.names.iter().map(|n| size(&n.1)).collect();
        for ((at, name), place) in
            self.names.iter().zip(place_without_overlap(&wanted, &sizes, 4.0, svg.width - 4.0))
        {
            let Some(x) = place else { continue };
            svg.line([*at, y], [x, y + side * 8.0], Style::stroke(PALE, 0.8));
            let text = Text::new(SMALL, color);
            match (self.upright, up) {
                (false, true) => svg.text([x, y - 11.0], name, text.middle()),
                (false, false) => svg.text([x, y + 11.0 + 0.75 * SMALL], name, text.middle()),
                (true, true) => svg.text([x + 0.36 * SMALL, y - 11.0], name, text.upright()),
                (true, false) => svg.text([x + 0.36 * SMALL, y + 11.0], name, text.upright().end()),
            }
        }
    }
}

/// One entry of a legend.
#[derive(Clone, Debug)]
pub struct Entry {
    pub text: String,
    pub line: Option<Style>,
    pub marker: Option<(Marker, Style)>,
}

impl Entry {
    pub fn line(text: &str, style: Style) -> Self {
        Entry { text: text.to_string(), line: Some(style), marker: None }
    }

    pub fn marker(text: &str, marker: Marker, style: Style) -> Self {
        Entry { text: text.to_string(), line: None, marker: Some((marker, style)) }
    }

    /// The same with a marker on the line.
    pub fn marked(self, marker: Marker, style: Style) -> Self {
        Entry { marker: Some((marker, style)), ..self }
    }

    fn sample(&self) -> f64 {
        if self.line.is_some() { 30.0 } else { 12.0 }
    }

    fn label(&self) -> String {
        font::fit(&self.text, TICK, 300.0)
    }
}

const LEGEND_ROW_HEIGHT: f64 = 18.0;
/// Largest number of lines of a title.
const TITLE_LINES: usize = 3;
/// Largest number of lines of a note.
const NOTE_LINES: usize = 4;

/// Writes a legend in rows starting at the page height `y`; returns the height below it.
pub fn legend(svg: &mut Svg, entries: &[Entry], x: f64, y: f64, room: f64) -> f64 {
    let (mut at, mut row) = (x, y);
    if entries.is_empty() {
        return y;
    }
    for entry in entries.iter().take(24) {
        let label = entry.label();
        let need = entry.sample() + 5.0 + font::width(&label, TICK);
        if at > x && at + need > x + room {
            at = x;
            row += LEGEND_ROW_HEIGHT;
        }
        let middle = row + 0.5 * LEGEND_ROW_HEIGHT;
        if let Some(style) = entry.line {
            svg.line([at, middle], [at + entry.sample(), middle], style);
        }
        if let Some((marker, style)) = entry.marker {
            marker.draw(svg, [at + 0.5 * entry.sample(), middle], style);
        }
        svg.text([at + entry.sample() + 5.0, middle + 0.36 * TICK], &label, Text::new(TICK, INK));
        at += need + 18.0;
    }
    row + LEGEND_ROW_HEIGHT
}

/// Starts a page with title, note in grey and legend; returns the page and the height at which panels start.
pub fn page_heading(width: f64, x: f64, title: &str, note: &str, entries: &[Entry]) -> (Svg, f64) {
    let mut svg = Svg::new(width, 0.0);
    let mut y = 12.0;
    for line in font::wrapped(title, TITLE, width - x - 8.0, TITLE_LINES) {
        svg.text([x, y + 0.9 * TITLE], &line, Text::new(TITLE, INK));
        y += 1.5 * TITLE;
    }
    for line in font::wrapped(note, TICK, width - x - 8.0, NOTE_LINES) {
        svg.text([x, y + 0.9 * TICK], &line, Text::new(TICK, MUTED));
        y += 1.5 * TICK;
    }
    y = legend(&mut svg, entries, x, y + 1.0, width - x - RIGHT);
    (svg, y + 8.0)
}

/// Formats a number with three significant digits (all integer digits below 10⁶), else with a power of ten.
pub fn format_value(value: f64) -> String {
    if !value.is_finite() {
        return "–".to_string();
    }
    if value == 0.0 {
        return "0".to_string();
    }
    let magnitude = value.abs().log10().floor() as i32;
    let text = if (-3..6).contains(&magnitude) {
        let decimals = (2 - magnitude).clamp(0, 6) as usize;
        let text = format!("{value:.decimals$}");
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_string() } else { text }
    } else {
        format!("{:.2}·{}", value / 10f64.powi(magnitude), scale::power(magnitude))
    };
    text.replace('-', "−")
}

//! Maps of pressure and film thickness of an EHL contact, and both on its centreline.

use super::axes::Axes;
use super::heat::{COLOR_BAR_WIDTH, Heat, color_bar};
use super::labels::{Entry, page_heading};
use super::scale::Range;
use super::style::*;
use super::svg::{Style, Svg};

/// Fields of an EHL contact, index i·ny + j at (x_i, y_j).
#[derive(Clone, Debug, Default)]
pub struct FilmMap {
    pub title: String,
    pub note: String,
    /// Coordinates along rolling (inlet first) and across \[mm\].
    pub x: Vec<f64>,
    pub y: Vec<f64>,
    /// Pressure \[GPa\].
    pub pressure: Vec<f64>,
    /// Film thickness \[um\].
    pub film: Vec<f64>,
    /// Central film thickness \[um\]; the map shows up to twice this value.
    pub central_film: f64,
}

pub fn draw(data: &FilmMap) -> Svg {
    let line = [Style::stroke(BLUE, 1.5), Style::stroke(RED, 1.5)];
    let entries = [
        Entry::line("pressure / maximum pressure", line[0]),
        Entry::line("film thickness / (2 × central film)", line[1]),
    ];
    let (mut svg, top) = page_heading(WIDTH, LEFT, &data.title, &data.note, &entries);
    let frames =
        super::panels::stack(top + 6.0, WIDTH - LEFT - COLOR_BAR_WIDTH - 24.0, &[170.0, 170.0, 130.0]);
    let x = loaded_range(data);
    let y = Range::of(data.y.iter().copied());
    let most = data.pressure.iter().copied().fold(0.0, f64::max);
    let thick = 2.0 * data.central_film;
    // Thicker films are drawn white.
    let film: Vec<f64> = data.film.iter().map(|&h| if h > thick { f64::NAN } else { h }).collect();
    for (frame, level, top, label) in [
        (frames[0], &data.pressure, most, "pressure [GPa]"),
        (frames[1], &film, thick, "film thickness [µm]"),
    ] {
        let axes = Axes::linear(frame, x, y);
        let bounds = Range::new(0.0, top);
        Heat { x: &data.x, y: &data.y, level }.draw(&mut svg, &axes, bounds);
        axes.border(&mut svg, None, &axes.y.label("transverse y", "mm"));
        color_bar(&mut svg, frame, WIDTH - COLOR_BAR_WIDTH, bounds, label);
    }
    let axes = Axes::linear(frames[2], x, Range::new(0.0, 1.05));
    let (ny, middle) = (data.y.len(), data.y.len() / 2);
    for (field, top, style) in [(&data.pressure, most, line[0]), (&data.film, thick, line[1])] {
        let along: Vec<f64> = (0..data.x.len()).map(|i| field[i * ny + middle] / top).collect();
        axes.curve(&mut svg, &data.x, &along, style);
    }
    axes.border(&mut svg, Some(&axes.x.label("rolling direction x", "mm")), "centreline y = 0");
    svg.height = frames[2].bottom() + BOTTOM;
    svg
}

/// Range of x in which the centreline pressure exceeds 1 % of the maximum, widened by a quarter of its length
/// on each side.
fn loaded_range(data: &FilmMap) -> Range {
    let (ny, middle) = (data.y.len(), data.y.len() / 2);
    let along = |i: usize| data.pressure.get(i * ny + middle).copied().unwrap_or(0.0);
    let most = (0..data.x.len()).map(along).fold(0.0, f64::max);
    let mut loaded = (0..data.x.len()).filter(|&i| along(i) > 0.01 * most).map(|i| data.x[i]);
    let first = loaded.next();
    let (Some(first), Some(last)) = (first, loaded.next_back().or(first)) else {
        return Range::of(data.x.iter().copied());
    };
    let margin = 0.25 * (last - first);
    Range::new(first - margin, last + margin)
}

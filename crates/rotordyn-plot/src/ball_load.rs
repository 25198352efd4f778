//! Load distribution: ball loads around each bearing.

use super::axes::Frame;
use super::labels::{format_value, page_heading};
use super::scale::extremes;
use super::style::*;
use super::svg::{Color, Point, Style, Svg, Text};
use super::{color_map, font};

/// Largest number of ball rows in one figure, and of balls in a row.
const MAX_ROWS: usize = 9;
const MAX_BALLS: usize = 400;

/// One row of balls.
#[derive(Clone, Debug, Default)]
pub struct BallRow {
    /// E.g. "bearing A".
    pub title: String,
    /// Line below the title, e.g. the bearing force.
    pub note: String,
    /// Angular positions from x to y \[deg\].
    pub angle_deg: Vec<f64>,
    /// Contact loads \[N\].
    pub load: Vec<f64>,
    /// Radial load on the inner ring along x and y \[N\], drawn as an arrow; none if zero.
    pub radial_load: [f64; 2],
}

/// Data of a load distribution figure.
#[derive(Clone, Debug, Default)]
pub struct BallLoads {
    pub title: String,
    pub note: String,
    pub rows: Vec<BallRow>,
}

pub fn draw(data: &BallLoads) -> Svg {
    const SIDE: f64 = 330.0;
    const CELL: f64 = SIDE + 46.0;
    let rows = &data.rows[..data.rows.len().min(MAX_ROWS)];
    let columns = rows.len().clamp(1, 2);
    let width = CELL * columns as f64 + 20.0;
    let (mut svg, top) = page_heading(width.max(430.0), 20.0, &data.title, &data.note, &[]);
    let left = 0.5 * (svg.width - CELL * columns as f64) + 23.0;
    let largest = extremes(rows.iter().flat_map(|r| r.load.iter().copied())).map_or(0.0, |e| e.1);
    let height = SIDE + 34.0;
    for (k, row) in rows.iter().enumerate() {
        let x = left + CELL * (k % columns) as f64;
        panel(
            &mut svg,
            row,
            Frame { x, y: top + height * (k / columns) as f64, w: SIDE, h: height },
            largest,
        );
    }
    svg.height = top + height * rows.len().max(1).div_ceil(columns) as f64 + 8.0;
    svg
}

fn panel(svg: &mut Svg, row: &BallRow, frame: Frame, largest: f64) {
    svg.text([frame.x, frame.y + 13.0], &font::fit(&row.title, LABEL, frame.w), Text::new(LABEL, INK));
    svg.text([frame.x, frame.y + 28.0], &font::fit(&row.note, SMALL, frame.w), Text::new(SMALL, MUTED));
    let center = [frame.center()[0], frame.y + 34.0 + 0.5 * frame.w];
    // Bars grow outwards from the outer ring.
    let (inner, pitch, outer, longest) = (0.19 * frame.w, 0.24 * frame.w, 0.29 * frame.w, 0.13 * frame.w);
    let count = row.angle_deg.len().min(row.load.len()).min(MAX_BALLS);
    let ball = (0.9 * std::f64::consts::PI * pitch / count.max(3) as f64).min(0.9 * 0.5 * (outer - inner));
    svg.circle(center, outer + 5.0, Style::stroke(MUTED, 0.9).filled(STEEL));
    svg.circle(center, outer, Style::stroke(MUTED, 0.9).filled(WHITE));
    svg.circle(center, inner, Style::stroke(MUTED, 0.9).filled(STEEL));
    svg.circle(center, inner - 14.0, Style::stroke(MUTED, 0.9).filled(WHITE));
    direction_arrows(svg, center);
    load_arrow(svg, center, row.radial_load, inner - 14.0);
    let labelled = count <= 24;
    for (angle, load) in row.angle_deg.iter().zip(&row.load).take(MAX_BALLS) {
        let (sin, cos) = angle.to_radians().sin_cos();
        let at = |r: f64| -> Point { [center[0] + r * cos, center[1] - r * sin] };
        if !(load.is_finite() && cos.is_finite()) {
            continue;
        }
        let part = if largest > 0.0 { (load / largest).clamp(0.0, 1.0) } else { 0.0 };
        svg.circle(at(pitch), ball, Style::stroke(INK, 0.8).filled(fill(part)));
        let tip = outer + 7.0 + longest * part;
        if part > 0.0 {
            svg.line(at(outer + 7.0), at(tip), Style::stroke(bar(part), (1.1 * ball).clamp(1.0, 9.0)));
            if labelled {
                let text = Text::new(SMALL, INK).middle();
                let label = format_value(*load);
                let out = tip + 9.0 + 0.42 * font::width(&label, SMALL) * cos.abs();
                svg.text([at(out)[0], at(out)[1] + 0.36 * SMALL], &label, text);
            }
        }
    }
    svg.text([frame.right() - 4.0, frame.bottom() - 6.0], "load [N]", Text::new(SMALL, MUTED).end());
}

/// Colour of a ball by its fraction of the maximum load; white if unloaded.
fn fill(part: f64) -> Color {
    if part == 0.0 { WHITE } else { bar(part) }
}

fn bar(part: f64) -> Color {
    let table = color_map::table();
    table[((0.2 + 0.6 * part) * (table.len() - 1) as f64) as usize]
}

/// Arrows of the x and y directions at the bearing centre.
fn direction_arrows(svg: &mut Svg, at: Point) {
    for (name, way) in [("x", [1.0, 0.0]), ("y", [0.0, -1.0])] {
        svg.arrow(at, [at[0] + 20.0 * way[0], at[1] + 20.0 * way[1]], 5.0, MUTED, 0.9);
        let place = [at[0] + 27.0 * way[0], at[1] + 27.0 * way[1] + 3.0];
        svg.text(place, name, Text::new(SMALL, MUTED).middle());
    }
}

/// Direction of the radial load, from the bearing centre; beyond the names of the axes if it points to one of them.
fn load_arrow(svg: &mut Svg, center: Point, [x, y]: [f64; 2], radius: f64) {
    let size = x.hypot(y);
    if !(size > 0.0 && size.is_finite()) {
        return;
    }
    let at = |r: f64| [center[0] + r * x / size, center[1] - r * y / size];
    let start = if x.max(y) > 0.8 * size { 35.0 } else { 0.0 };
    svg.arrow(at(start), at(0.97 * radius), 8.0, RED, 2.0);
    // Beside the arrow's head, on the side away from the names of the axes.
    let [tip_x, tip_y] = at(0.78 * radius);
    let at_side = |side: f64| [tip_x + side * 10.0 * y / size, tip_y + side * 10.0 * x / size];
    let room = |[px, py]: Point| {
        let to = |axis: Point| (px - axis[0]).hypot(py - axis[1]);
        to([center[0] + 27.0, center[1]]).min(to([center[0], center[1] - 27.0]))
    };
    let place = if room(at_side(1.0)) >= room(at_side(-1.0)) { at_side(1.0) } else { at_side(-1.0) };
    let label = [place[0], place[1] + 4.0];
    svg.text(label, "F", Text::new(LABEL, RED).middle().halo());
}

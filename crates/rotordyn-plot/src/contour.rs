//! Contour lines of a map with their levels.

use super::axes::Axes;
use super::heat::Heat;
use super::style::*;
use super::svg::{Point, Style, Svg, Text};

/// Draws the lines at which a map on an increasing grid has given levels, linear between grid points, and a label on each.
///
/// Cells with a value that is not finite have no line.
pub fn draw(svg: &mut Svg, axes: &Axes, map: &Heat, levels: &[(f64, String)]) {
    for (level, label) in levels {
        let lines = segments(map, *level);
        for [a, b] in &lines {
            axes.segment(svg, *a, *b, Style::stroke(WHITE, 2.6).faint(0.75));
            axes.segment(svg, *a, *b, Style::stroke(INK, 1.1));
        }
        // On the segment in the middle of the line, from left to right.
        let mut middles: Vec<Point> =
            lines.iter().map(|[a, b]| axes.at(0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]))).collect();
        middles.sort_by(|a, b| a[0].total_cmp(&b[0]));
        if let Some([x, y]) = middles.get(middles.len() / 2) {
            svg.text([*x, y + 0.36 * SMALL], label, Text::new(SMALL, INK).middle().halo());
        }
    }
}

/// Pieces of the line of a level, each across one cell (marching squares).
fn segments(map: &Heat, level: f64) -> Vec<[[f64; 2]; 2]> {
    let Heat { x, y, level: values } = *map;
    let mut out = Vec::new();
    for i in 1..x.len() {
        for j in 1..y.len() {
            let corner = |a: usize, b: usize| {
                let (i, j) = (i - 1 + a, j - 1 + b);
                ([x[i], y[j]], values.get(i * y.len() + j).copied().unwrap_or(f64::NAN))
            };
            let corners = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
            if corners.iter().any(|(_, value)| !value.is_finite()) {
                continue;
            }
            let crossing = |k: usize| {
                let ((from, a), (to, b)) = (corners[k], corners[(k + 1) % 4]);
                let part = (level - a) / (b - a);
                ((a < level) != (b < level)).then(|| [0, 1].map(|d| from[d] + part * (to[d] - from[d])))
            };
            let crossings: Vec<[f64; 2]> = (0..4).filter_map(crossing).collect();
            out.extend(crossings.chunks_exact(2).map(|pair| [pair[0], pair[1]]));
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The level of a plane is a straight line from edge to edge, also over cells of different size.
    #[test]
    fn contour_of_a_plane_is_straight() {
        let (x, y) = ([0.0, 1.0, 4.0], [0.0, 2.0, 3.0]);
        let level: Vec<f64> = x.iter().flat_map(|x| y.iter().map(move |y| x + 2.0 * y)).collect();
        let found = segments(&Heat { x: &x, y: &y, level: &level }, 4.5);
        for [px, py] in found.iter().flatten() {
            assert!((px + 2.0 * py - 4.5).abs() < 1e-12);
        }
        let length: f64 = found.iter().map(|[a, b]| (a[0] - b[0]).hypot(a[1] - b[1])).sum();
        // From (0, 2.25) to (4, 0.25).
        assert!((length - 4.0f64.hypot(2.0)).abs() < 1e-12, "{length}");
        let hole = Heat { x: &x, y: &y, level: &[f64::NAN; 9] };
        assert!(segments(&hole, 4.5).is_empty());
    }
}

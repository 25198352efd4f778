//! Decimation of long curves to the page resolution, to keep the SVG small.

use super::svg::Point;

/// Largest number of points of a free curve (an orbit).
const MAX_FREE_CURVE_POINTS: usize = 20_000;

/// Keeps the first, lowest, highest and last of the consecutive points that fall in one px column of the
/// page.
#[derive(Default)]
pub struct Columns {
    out: Vec<Point>,
    /// Points of the current column.
    group: Vec<Point>,
    column: Option<i64>,
}

impl Columns {
    /// Takes the next point of the curve.
    pub fn push(&mut self, p: Point) {
        let here = if p[0].is_finite() && p[1].is_finite() { p[0].floor() as i64 } else { i64::MAX };
        if self.column != Some(here) {
            flush(&mut self.group, &mut self.out);
            self.column = Some(here);
        }
        // Keep one point of a gap.
        if here == i64::MAX && !self.group.is_empty() {
            return;
        }
        self.group.push(p);
        if self.group.len() > 64 {
            reduce(&mut self.group);
        }
    }

    /// The points kept.
    pub fn finish(mut self) -> Vec<Point> {
        flush(&mut self.group, &mut self.out);
        self.out
    }
}

/// The points of a curve that [`Columns`] keeps.
pub fn decimate_columns(points: impl Iterator<Item = Point>) -> Vec<Point> {
    let mut columns = Columns::default();
    points.for_each(|p| columns.push(p));
    columns.finish()
}

fn flush(group: &mut Vec<Point>, out: &mut Vec<Point>) {
    if group.len() > 4 {
        reduce(group);
    }
    out.append(group);
}

/// First, lowest, highest and last point in their order.
fn reduce(group: &mut Vec<Point>) {
    let by = |a: &usize, b: &usize| group[*a][1].total_cmp(&group[*b][1]);
    let low = (0..group.len()).min_by(by).unwrap_or(0);
    let high = (0..group.len()).max_by(by).unwrap_or(0);
    let mut keep = [0, low, high, group.len() - 1];
    keep.sort_unstable();
    let mut kept: Vec<Point> = Vec::with_capacity(4);
    let mut last = usize::MAX;
    for k in keep.into_iter().filter(|k| *k < group.len()) {
        if k != last {
            kept.push(group[k]);
        }
        last = k;
    }
    *group = kept;
}

/// Keeps the uppermost of the consecutive points that fall in one px column of the page: peaks of a spectrum.
pub fn peaks(points: impl Iterator<Item = Point>) -> Vec<Point> {
    let mut out: Vec<Point> = Vec::new();
    for p in points {
        match out.last_mut() {
            Some(last) if last[0].floor() == p[0].floor() => {
                if p[1] < last[1] {
                    *last = p;
                }
            }
            _ => out.push(p),
        }
    }
    out
}

/// Drops points of a free curve closer than 0.25 px to the previous one, then keeps every n-th if still too
/// many.
pub fn decimate_curve(points: impl Iterator<Item = Point>) -> Vec<Point> {
    let mut out: Vec<Point> = Vec::new();
    for p in points {
        let near = out.last().is_some_and(|l| (p[0] - l[0]).hypot(p[1] - l[1]) < 0.25);
        let gap_again = p[0].is_nan() && out.last().is_some_and(|l| l[0].is_nan());
        if !near && !gap_again {
            out.push(p);
        }
    }
    let stride = out.len().div_ceil(MAX_FREE_CURVE_POINTS).max(1);
    if stride > 1 { out.into_iter().step_by(stride).collect() } else { out }
}

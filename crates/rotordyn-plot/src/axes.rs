//! Plot panel: frame, grid, ticks, axis labels, and clipped curves.

use super::scale::{Range, Scale, Tick};
use super::style::*;
use super::svg::{Point, Style, Svg, Text};
use super::{decimate, font};
use rotordyn_core::series::{Series, SeriesError};

/// A rectangle on the page \[px\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    pub x: f64,
    pub y: f64,
    pub w: f64,
    pub h: f64,
}

impl Frame {
    pub fn right(self) -> f64 {
        self.x + self.w
    }

    pub fn bottom(self) -> f64 {
        self.y + self.h
    }

    pub fn center(self) -> Point {
        [self.x + 0.5 * self.w, self.y + 0.5 * self.h]
    }

    /// Page coordinates of a horizontal axis.
    pub fn across(self) -> [f64; 2] {
        [self.x, self.right()]
    }

    /// Page coordinates of a vertical axis, values growing upwards.
    pub fn up(self) -> [f64; 2] {
        [self.bottom(), self.y]
    }

    fn contains(self, p: Point) -> bool {
        const SLACK: f64 = 0.01;
        p[0] >= self.x - SLACK
            && p[0] <= self.right() + SLACK
            && p[1] >= self.y - SLACK
            && p[1] <= self.bottom() + SLACK
    }
}

/// A panel with two scaled axes.
#[derive(Clone, Debug)]
pub struct Axes {
    pub frame: Frame,
    pub x: Scale,
    pub y: Scale,
}

impl Axes {
    /// Linear axes with default tick spacing.
    pub fn linear(frame: Frame, x: Range, y: Range) -> Self {
        let spacing = (0.25 * frame.h).clamp(24.0, 48.0);
        Axes { frame, x: Scale::linear(x, frame.across(), 80.0), y: Scale::linear(y, frame.up(), spacing) }
    }

    /// Linear x, logarithmic y.
    pub fn log_y(frame: Frame, x: Range, y: Range) -> Self {
        Axes { frame, x: Scale::linear(x, frame.across(), 80.0), y: Scale::log(y, frame.up(), 26.0) }
    }

    /// Linear axes with equal scale (aspect ratio 1), centred in the frame.
    pub fn equal(frame: Frame, x: Range, y: Range) -> Self {
        let per_px = ((x.hi - x.lo) / frame.w).max((y.hi - y.lo) / frame.h);
        let around = |r: Range, px: f64| {
            let middle = 0.5 * (r.lo + r.hi);
            Range::new(middle - 0.5 * px * per_px, middle + 0.5 * px * per_px)
        };
        let (x, y) = (around(x, frame.w), around(y, frame.h));
        Axes { frame, x: Scale::linear(x, frame.across(), 44.0), y: Scale::linear(y, frame.up(), 44.0) }
    }

    /// Page coordinates of a value pair; NaN if undefined.
    pub fn at(&self, x: f64, y: f64) -> Point {
        [self.x.px(x), self.y.px(y)]
    }

    /// Grid lines, drawn before the data.
    pub fn grid(&self, svg: &mut Svg) {
        let style = Style::stroke(GRID, 0.8);
        for x in self.x.ticks.iter().map(|t| self.x.px(t.value)) {
            svg.line([x, self.frame.y], [x, self.frame.bottom()], style);
        }
        for y in self.y.ticks.iter().map(|t| self.y.px(t.value)) {
            svg.line([self.frame.x, y], [self.frame.right(), y], style);
        }
    }

    /// Frame, ticks and labels, drawn after the data; without `x_label` the x axis has ticks only.
    pub fn border(&self, svg: &mut Svg, x_label: Option<&str>, y_label: &str) {
        let f = self.frame;
        svg.rect(f.x, f.y, f.w, f.h, FRAME);
        self.x_axis(svg, x_label);
        for Tick { value, label } in &self.y.ticks {
            let y = self.y.px(*value);
            svg.line([f.x - 4.0, y], [f.x, y], FRAME);
            svg.text([f.x - 7.0, y + 0.36 * TICK], label, Text::new(TICK, INK).end());
        }
        for y in self.y.minor.iter().map(|v| self.y.px(*v)) {
            svg.line([f.x - 2.0, y], [f.x, y], FRAME);
        }
        // At a low panel the label must not overlap the labels of adjacent panels.
        let room = f.h + GAP;
        let size = if font::width(y_label, LABEL) <= room { LABEL } else { SMALL };
        let label = font::fit(y_label, size, room.max(100.0));
        // Outside the tick labels, inside the margin.
        let ticks = self.y.ticks.iter().map(|t| font::width(&t.label, TICK)).fold(0.0, f64::max);
        let place = f.x - (ticks + 15.0).clamp(53.0, 66.0);
        svg.text([place, f.center()[1]], &label, Text::new(size, INK).middle().upright());
    }

    /// Second scale of the y axis at the right edge: ticks and label of `map`(y), increasing or decreasing in y.
    pub fn second_y(&self, svg: &mut Svg, quantity: &str, unit: &str, map: impl Fn(f64) -> f64) {
        let f = self.frame;
        let ends = [map(self.y.range.lo), map(self.y.range.hi)];
        let across = if ends[0] <= ends[1] { f.up() } else { [f.y, f.bottom()] };
        let spacing = (0.25 * f.h).clamp(24.0, 48.0);
        let scale = Scale::linear(Range::new(ends[0], ends[1]), across, spacing);
        for Tick { value, label } in &scale.ticks {
            let y = scale.px(*value);
            svg.line([f.right(), y], [f.right() + 4.0, y], FRAME);
            svg.text([f.right() + 7.0, y + 0.36 * TICK], label, Text::new(TICK, INK));
        }
        let ticks = scale.ticks.iter().map(|t| font::width(&t.label, TICK)).fold(0.0, f64::max);
        let label = font::fit(&scale.label(quantity, unit), LABEL, (f.h + GAP).max(100.0));
        let place = f.right() + ticks + 24.0;
        svg.text([place, f.center()[1]], &label, Text::new(LABEL, INK).middle().upright());
    }

    /// Frame and x axis; the y axis is labelled at the adjacent panel.
    pub fn bare_border(&self, svg: &mut Svg, x_label: &str) {
        let f = self.frame;
        svg.rect(f.x, f.y, f.w, f.h, FRAME);
        self.x_axis(svg, Some(x_label));
    }

    fn x_axis(&self, svg: &mut Svg, x_label: Option<&str>) {
        let f = self.frame;
        for Tick { value, label } in &self.x.ticks {
            let x = self.x.px(*value);
            svg.line([x, f.bottom()], [x, f.bottom() + 4.0], FRAME);
            if x_label.is_some() {
                svg.text([x, f.bottom() + 17.0], label, Text::new(TICK, INK).middle());
            }
        }
        for x in self.x.minor.iter().map(|v| self.x.px(*v)) {
            svg.line([x, f.bottom()], [x, f.bottom() + 2.0], FRAME);
        }
        if let Some(label) = x_label {
            let label = font::fit(label, LABEL, f.w + 80.0);
            svg.text([f.center()[0], f.bottom() + 36.0], &label, Text::new(LABEL, INK).middle());
        }
    }

    /// A curve: broken at non-finite values, thinned to the page's resolution, clipped to the frame.
    pub fn curve(&self, svg: &mut Svg, x: &[f64], y: &[f64], style: Style) {
        let points = decimate::decimate_columns(x.iter().zip(y).map(|(&x, &y)| self.at(x, y)));
        self.clipped(svg, &points, style);
    }

    /// The same of samples, which are read block by block.
    ///
    /// # Errors
    /// Samples that cannot be read.
    pub fn curve_of(&self, svg: &mut Svg, x: &Series, y: &Series, style: Style) -> Result<(), SeriesError> {
        let mut columns = decimate::Columns::default();
        for (x, y) in x.blocks().zip(y.blocks()) {
            x?.iter().zip(&*y?).for_each(|(&x, &y)| columns.push(self.at(x, y)));
        }
        self.clipped(svg, &columns.finish(), style);
        Ok(())
    }

    /// A curve of page points clipped to the frame.
    pub fn clipped(&self, svg: &mut Svg, points: &[Point], style: Style) {
        svg.polyline(&clip(points, self.frame), style);
    }

    /// A straight line between two value pairs, clipped to the frame.
    pub fn segment(&self, svg: &mut Svg, a: [f64; 2], b: [f64; 2], style: Style) {
        self.clipped(svg, &[self.at(a[0], a[1]), self.at(b[0], b[1])], style);
    }

    /// Markers at the points inside the frame, at least `apart` px from each other along the curve.
    pub fn markers(&self, svg: &mut Svg, x: &[f64], y: &[f64], marker: Marker, style: Style, apart: f64) {
        let mut last: Option<Point> = None;
        for p in x.iter().zip(y).map(|(&x, &y)| self.at(x, y)).filter(|p| self.frame.contains(*p)) {
            if last.is_none_or(|l| (p[0] - l[0]).hypot(p[1] - l[1]) >= apart) {
                marker.draw(svg, p, style);
                last = Some(p);
            }
        }
    }

    /// Whether a page point lies in the frame.
    pub fn contains(&self, p: Point) -> bool {
        self.frame.contains(p)
    }
}

/// Marker shapes, distinguishable without colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marker {
    None,
    Up,
    Down,
    Circle,
    Square,
    Diamond,
}

impl Marker {
    /// Draws the marker with its centre at a page point.
    pub fn draw(self, svg: &mut Svg, at: Point, style: Style) {
        const R: f64 = 3.4;
        let corners = |list: &[[f64; 2]]| -> Vec<Point> {
            list.iter().map(|c| [at[0] + R * c[0], at[1] + R * c[1]]).collect()
        };
        match self {
            Marker::None => {}
            Marker::Up => svg.polygon(&corners(&[[0.0, -1.15], [1.05, 0.75], [-1.05, 0.75]]), style),
            Marker::Down => svg.polygon(&corners(&[[0.0, 1.15], [1.05, -0.75], [-1.05, -0.75]]), style),
            Marker::Circle => svg.circle(at, 0.9 * R, style),
            Marker::Square => {
                svg.polygon(&corners(&[[-0.85, -0.85], [0.85, -0.85], [0.85, 0.85], [-0.85, 0.85]]), style)
            }
            Marker::Diamond => {
                svg.polygon(&corners(&[[0.0, -1.2], [1.1, 0.0], [0.0, 1.2], [-1.1, 0.0]]), style)
            }
        }
    }
}

/// The parts of a polyline inside a frame (Liang-Barsky), separated by NaN points.
pub fn clip(points: &[Point], frame: Frame) -> Vec<Point> {
    let mut out: Vec<Point> = Vec::with_capacity(points.len());
    for pair in points.windows(2) {
        let Some((a, b)) = clip_segment(pair[0], pair[1], frame) else { continue };
        if out.last() != Some(&a) {
            if !out.is_empty() {
                out.push([f64::NAN; 2]);
            }
            out.push(a);
        }
        out.push(b);
    }
    out
}

fn clip_segment(a: Point, b: Point, frame: Frame) -> Option<(Point, Point)> {
    let d = [b[0] - a[0], b[1] - a[1]];
    if !(a[0].is_finite() && a[1].is_finite() && d[0].is_finite() && d[1].is_finite()) {
        return None;
    }
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for (start, step, lo, hi) in [(a[0], d[0], frame.x, frame.right()), (a[1], d[1], frame.y, frame.bottom())]
    {
        if step == 0.0 {
            if start < lo || start > hi {
                return None;
            }
            continue;
        }
        let (t0, t1) = ((lo - start) / step, (hi - start) / step);
        from = from.max(t0.min(t1));
        to = to.min(t0.max(t1));
    }
    if from > to {
        return None;
    }
    let at = |t: f64| {
        if t == 0.0 {
            a
        } else if t == 1.0 {
            b
        } else {
            [a[0] + t * d[0], a[1] + t * d[1]]
        }
    };
    Some((at(from), at(to)))
}

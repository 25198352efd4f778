//! Polar (Nyquist) plot of a response over speed.

use std::f64::consts::TAU;

use super::axes::{Axes, Frame};
use super::labels::{Entry, format_value, page_heading};
use super::obstacles::Obstacles;
use super::scale::{Range, extremes, nice_step};
use super::style::*;
use super::svg::{Point, Style, Svg, Text};
use super::{arcs, decimate, font};

/// Response of one point over speed.
#[derive(Clone, Debug, Default)]
pub struct PolarCurve {
    pub label: String,
    /// Shaft speeds \[rpm\].
    pub rpm: Vec<f64>,
    /// Amplitudes in the unit of the figure.
    pub amplitude: Vec<f64>,
    /// Phase angles \[deg\].
    pub phase_deg: Vec<f64>,
}

/// Data of a polar plot.
#[derive(Clone, Debug, Default)]
pub struct Polar {
    pub title: String,
    pub note: String,
    /// Unit of the amplitudes, e.g. "µm".
    pub unit: String,
    pub curves: Vec<PolarCurve>,
}

pub fn draw(data: &Polar) -> Svg {
    const SIDE: f64 = 420.0;
    let entries: Vec<Entry> =
        data.curves.iter().enumerate().map(|(k, c)| Entry::line(&c.label, curve(k))).collect();
    let (mut svg, top) = page_heading(SIDE + 100.0, 30.0, &data.title, &data.note, &entries);
    let amplitudes = extremes(data.curves.iter().flat_map(|c| c.amplitude.iter().copied()));
    let least = 1e-3 * amplitudes.map_or(0.0, |e| e.1);
    let smooth: Vec<Vec<(f64, Point)>> = data.curves.iter().map(|c| interpolated(c, least)).collect();
    let lengths = smooth.iter().flatten().map(|(_, [re, im])| re.hypot(*im));
    let largest = extremes(lengths).map_or(1.0, |e| e.1);
    let step = nice_step(if largest > 0.0 { largest.min(1e150) } else { 1.0 }, 6.0);
    let rings = ((largest / step).ceil() as i32).clamp(1, 8);
    let reach = step * f64::from(rings);
    let frame = Frame { x: 50.0, y: top + 22.0, w: SIDE, h: SIDE };
    let range = Range::new(-reach, reach);
    let axes = Axes::equal(frame, range, range);
    polar_grid(&mut svg, frame, rings);
    let smooth: Vec<SmoothCurve> = smooth.iter().map(|points| SmoothCurve::new(&axes, points)).collect();
    svg.group("curves", |svg| {
        for (k, c) in smooth.iter().enumerate() {
            let points = decimate::decimate_curve(c.points.iter().map(|p| p.1));
            axes.clipped(svg, &points, curve(k));
        }
    });
    let mut obstacles = Obstacles::default();
    for c in &smooth {
        let line: Vec<Point> = c.points.iter().map(|p| p.1).collect();
        obstacles.add_line(&super::axes::clip(&line, frame), 1.0);
    }
    let values: Vec<String> = (1..=rings)
        .map(|k| {
            let unit = if k == rings { format!(" {}", data.unit) } else { String::new() };
            format_value(step * f64::from(k)) + &unit
        })
        .collect();
    ring_labels(&mut svg, frame, &values, &mut obstacles);
    speed_labels(&mut svg, &axes, &smooth, &mut obstacles);
    svg.height = frame.bottom() + 34.0;
    svg
}

/// The curve in the complex plane, with points dense enough to be drawn as a polygon.
fn interpolated(c: &PolarCurve, least: f64) -> Vec<(f64, Point)> {
    let samples = c.rpm.iter().zip(&c.amplitude).zip(&c.phase_deg).map(|((rpm, a), phase)| {
        let (sin, cos) = phase.to_radians().sin_cos();
        (*rpm, [a * cos, a * sin])
    });
    arcs::interpolate(&samples.collect::<Vec<_>>(), least)
}

/// Rings and rays every 30 degrees, with angle labels.
fn polar_grid(svg: &mut Svg, frame: Frame, rings: i32) {
    let ([x, y], reach) = (frame.center(), 0.5 * frame.w);
    for k in 1..=rings {
        let style = if k == rings { FRAME } else { Style::stroke(GRID, 0.9) };
        svg.circle([x, y], reach * f64::from(k) / f64::from(rings), style);
    }
    for k in 0..12 {
        let (sin, cos) = (TAU * f64::from(k) / 12.0).sin_cos();
        svg.line([x, y], [x + reach * cos, y - reach * sin], Style::stroke(GRID, 0.9));
        let label = format!("{}°", 30 * k);
        let text = Text::new(TICK, INK).middle();
        svg.text([x + (reach + 18.0) * cos, y - (reach + 14.0) * sin + 0.36 * TICK], &label, text);
    }
}

/// Values of the rings inside them, beside the vertical ray that has the fewest curves.
fn ring_labels(svg: &mut Svg, frame: Frame, values: &[String], obstacles: &mut Obstacles) {
    let ([x, y], reach) = (frame.center(), 0.5 * frame.w);
    let areas = |right: f64, up: f64| -> Vec<[f64; 4]> {
        (values.iter().enumerate())
            .map(|(k, value)| {
                let r = reach * (k + 1) as f64 / values.len() as f64;
                let width = font::width(value, SMALL);
                let far = width + 8.0;
                // Below the ring at the end of the text; a small ring is shorter than its label.
                let height = (r * r - far * far).max(0.16 * r * r).sqrt() - 7.0;
                let middle = [x + right * (5.0 + 0.5 * width), y - up * height];
                [middle[0] - 0.5 * width, middle[1] - 5.0, middle[0] + 0.5 * width, middle[1] + 5.0]
            })
            .collect()
    };
    let sides = [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)].map(|(right, up)| areas(right, up));
    let taken = |areas: &Vec<[f64; 4]>| areas.iter().filter(|a| !obstacles.is_free(**a)).count();
    let Some(best) = sides.iter().min_by_key(|areas| taken(areas)) else { return };
    let free: Vec<bool> = best.iter().map(|area| obstacles.is_free(*area)).collect();
    for ((area, value), free) in best.iter().zip(values).zip(free) {
        // The outermost value has the unit; others are omitted under a curve.
        if free || Some(value) == values.last() {
            let place = [0.5 * (area[0] + area[2]), 0.5 * (area[1] + area[3]) + 0.36 * SMALL];
            svg.text(place, value, Text::new(SMALL, MUTED).middle().halo());
            obstacles.add(*area);
        }
    }
}

/// A curve on the page.
struct SmoothCurve {
    /// Speed \[rpm\] and page point \[px\].
    points: Vec<(f64, Point)>,
    /// Index of the largest amplitude among the points.
    peak: Option<usize>,
}

impl SmoothCurve {
    fn new(axes: &Axes, points: &[(f64, Point)]) -> Self {
        let points: Vec<_> = points.iter().map(|(rpm, [re, im])| (*rpm, axes.at(*re, *im))).collect();
        let [x, y] = axes.frame.center();
        let reach = |k: &usize| {
            let p = points[*k].1;
            (p[0] - x).hypot(p[1] - y)
        };
        let finite = (0..points.len()).filter(|k| reach(k).is_finite());
        let peak = finite.max_by(|a, b| reach(a).total_cmp(&reach(b)));
        Self { points, peak }
    }

    /// Point of the curve at a speed \[rpm\].
    fn at(&self, rpm: f64) -> Option<Point> {
        self.points.windows(2).find_map(|pair| {
            let [(r0, a), (r1, b)] = [pair[0], pair[1]];
            let t = (rpm - r0) / (r1 - r0);
            (0.0..=1.0).contains(&t).then(|| [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])])
        })
    }
}

/// Speeds written along the curves: that of the largest amplitude of each, then round ones, the roundest first,
/// where there is room.
fn speed_labels(svg: &mut Svg, axes: &Axes, curves: &[SmoothCurve], obstacles: &mut Obstacles) {
    /// Least distance of two marks of one curve, and of a mark from the centre \[px\].
    const APART: f64 = 34.0;
    const FROM_CENTRE: f64 = 24.0;
    let [x, y] = axes.frame.center();
    for c in curves {
        let mut marks: Vec<Point> = Vec::new();
        let peak = c.peak.map(|k| c.points[k]);
        let round = round_speeds(&c.points).into_iter().filter_map(|rpm| Some((rpm, c.at(rpm)?)));
        for (rpm, point) in peak.into_iter().chain(round) {
            let out = [point[0] - x, point[1] - y];
            let reach = out[0].hypot(out[1]);
            let near = marks.iter().any(|m| (m[0] - point[0]).hypot(m[1] - point[1]) < APART);
            if !axes.contains(point) || near || reach.is_nan() || reach < FROM_CENTRE {
                continue;
            }
            let label = format!("{rpm:.0}");
            let half = 0.5 * font::width(&label, SMALL) + 2.0;
            // Around the point, outwards first.
            let places = [0.0, 0.5, -0.5, 1.0, -1.0, 1.6, -1.6, 2.2, -2.2, std::f64::consts::PI];
            let around = [6.0, 12.0].into_iter().flat_map(|gap| places.map(|turn| (gap, turn)));
            let area = around.map(|(gap, turn)| {
                let (sin, cos) = (out[1].atan2(out[0]) + turn).sin_cos();
                let center =
                    [point[0] + (gap + half * cos.abs()) * cos, point[1] + (gap + 6.0 * sin.abs()) * sin];
                [center[0] - half, center[1] - 6.0, center[0] + half, center[1] + 6.0]
            });
            let reach_of = |a: &[f64; 4]| {
                let corner = |i: usize, j: usize| (a[i] - x).hypot(a[j] - y);
                corner(0, 1).max(corner(2, 1)).max(corner(0, 3)).max(corner(2, 3))
            };
            // Inside the outer ring, whose angle labels are outside.
            let free = |a: &[f64; 4]| obstacles.is_free(*a) && reach_of(a) < 0.5 * axes.frame.w;
            if let Some(area) = area.into_iter().find(free) {
                svg.circle(point, 2.4, Style::fill(INK));
                let place = [0.5 * (area[0] + area[2]), 0.5 * (area[1] + area[3]) + 0.36 * SMALL];
                svg.text(place, &label, Text::new(SMALL, INK).middle().halo());
                obstacles.add(area);
                obstacles.add([point[0] - 3.0, point[1] - 3.0, point[0] + 3.0, point[1] + 3.0]);
                marks.push(point);
            }
        }
    }
}

/// Round speeds in the range of a curve, multiples of the largest steps first.
fn round_speeds(points: &[(f64, Point)]) -> Vec<f64> {
    let Some((lo, hi)) = extremes(points.iter().map(|p| p.0)) else { return Vec::new() };
    let mut out: Vec<f64> = Vec::new();
    for count in [2.0, 4.0, 10.0, 20.0, 40.0, 100.0, 200.0] {
        // A step below 1 rpm would repeat labels.
        let step = nice_step(hi - lo, count).max(1.0);
        let (first, last) = ((lo / step).ceil(), (hi / step).floor());
        let number = (last - first).clamp(-1.0, 400.0) as i64;
        let multiples = (0..=number).map(|k| (first + k as f64) * step);
        let new: Vec<f64> = multiples.filter(|rpm| !out.contains(rpm)).collect();
        out.extend(new);
    }
    out
}

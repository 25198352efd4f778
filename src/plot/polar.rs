//! Polar (Nyquist) plot of a response over speed.

use std::f64::consts::TAU;

use super::axes::{Axes, Frame};
use super::labels::{Entry, format_value, page_heading};
use super::scale::{Range, extremes, nice_step};
use super::style::*;
use super::svg::{Point, Style, Svg, Text};
use super::{decimate, font};

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
    let largest = extremes(data.curves.iter().flat_map(|c| c.amplitude.iter().copied())).map_or(1.0, |e| e.1);
    let step = nice_step(if largest > 0.0 { largest.min(1e150) } else { 1.0 }, 6.0);
    let rings = ((largest / step).ceil() as i32).clamp(1, 8);
    let reach = step * f64::from(rings);
    let frame = Frame { x: 50.0, y: top + 22.0, w: SIDE, h: SIDE };
    let range = Range::new(-reach, reach);
    let axes = Axes::equal(frame, range, range);
    polar_grid(&mut svg, frame, rings);
    for k in 1..=rings {
        let r = 0.5 * SIDE * f64::from(k) / f64::from(rings);
        let text = if k == rings {
            format!("{} {}", format_value(step * f64::from(k)), data.unit)
        } else {
            format_value(step * f64::from(k))
        };
        let angle = 75f64.to_radians();
        let [x, y] = frame.center();
        svg.text(
            [x + r * angle.cos() + 3.0, y - r * angle.sin() - 3.0],
            &text,
            Text::new(SMALL, MUTED).halo(),
        );
    }
    for (k, c) in data.curves.iter().enumerate() {
        let points: Vec<Point> =
            c.amplitude.iter().zip(&c.phase_deg).map(|(a, p)| at(&axes, *a, *p)).collect();
        axes.clipped(&mut svg, &decimate::decimate_curve(points.iter().copied()), curve(k));
    }
    let mut taken = Vec::new();
    for c in &data.curves {
        speed_labels(&mut svg, &axes, c, &mut taken);
    }
    svg.height = frame.bottom() + 34.0;
    svg
}

fn at(axes: &Axes, amplitude: f64, phase_deg: f64) -> Point {
    let (sin, cos) = phase_deg.to_radians().sin_cos();
    axes.at(amplitude * cos, amplitude * sin)
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

/// Speed labels at a minimum distance along the curve.
fn speed_labels(svg: &mut Svg, axes: &Axes, c: &PolarCurve, taken: &mut Vec<[f64; 4]>) {
    let [x, y] = axes.frame.center();
    let mut last: Option<Point> = None;
    for ((rpm, a), p) in c.rpm.iter().zip(&c.amplitude).zip(&c.phase_deg) {
        let point = at(axes, *a, *p);
        let far = last.is_none_or(|t| (t[0] - point[0]).hypot(t[1] - point[1]) > 46.0);
        let from_centre = (point[0] - x).hypot(point[1] - y);
        if !axes.contains(point) || !far || from_centre < 30.0 {
            continue;
        }
        let label = format!("{rpm:.0}");
        let (ux, uy) = ((point[0] - x) / from_centre, (point[1] - y) / from_centre);
        let out = 8.0 + 0.5 * font::width(&label, SMALL) * ux.abs();
        // Inside the curve where the angle labels are near.
        let out = if from_centre + 2.0 * out > 0.5 * axes.frame.w { -out } else { out };
        let place = [point[0] + out * ux, point[1] + out * uy + 0.36 * SMALL];
        let half = 0.5 * font::width(&label, SMALL);
        let area = [place[0] - half, place[1] - SMALL, place[0] + half, place[1] + 2.0];
        if taken.iter().any(|o| area[2] > o[0] && area[0] < o[2] && area[3] > o[1] && area[1] < o[3]) {
            continue;
        }
        svg.circle(point, 2.4, Style::fill(INK));
        svg.text(place, &label, Text::new(SMALL, INK).middle().halo());
        taken.push(area);
        taken.push([point[0] - 3.0, point[1] - 3.0, point[0] + 3.0, point[1] + 3.0]);
        last = Some(point);
    }
}

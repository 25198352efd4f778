//! Section through a ball and its grooves: contact ellipses, contact angles and shoulders.

use super::axes::{Axes, Frame};
use super::labels::{Entry, page_heading};
use super::scale::Range;
use super::style::*;
use super::svg::{Color, Dash, Point, Style, Svg, Text};

/// One groove in the section, angles from the radial direction towards +z \[rad\].
#[derive(Clone, Copy, Debug, Default)]
pub struct GrooveSection {
    /// Groove radius \[mm\].
    pub radius: f64,
    /// Contact angle α.
    pub contact_angle: f64,
    /// Half of the ellipse's extent about the groove's centre, a/r.
    pub half_ellipse: f64,
    /// Angle of both shoulders.
    pub shoulder_angle: f64,
    /// Load of the contact \[N\].
    pub load: f64,
    /// Radius of the bore or the outside diameter less the pitch radius \[mm\].
    pub ring_edge: f64,
}

/// Data of a section through a ball and its grooves.
#[derive(Clone, Debug, Default)]
pub struct BearingSection {
    pub title: String,
    pub note: String,
    /// Lines below the drawing.
    pub lines: Vec<String>,
    /// Ball diameter and ring width \[mm\].
    pub ball_diameter: f64,
    pub width: f64,
    /// Nominal contact angle, with the sign of the loaded side \[rad\].
    pub nominal_angle: f64,
    pub inner: GrooveSection,
    pub outer: GrooveSection,
}

const COLORS: [Color; 2] = [BLUE, RED];

pub fn draw(data: &BearingSection) -> Svg {
    let entries = [
        Entry::line("contact ellipse, inner race", Style::stroke(COLORS[0], 4.0)),
        Entry::line("outer race", Style::stroke(COLORS[1], 4.0)),
        Entry::line("contact angle and load", Style::stroke(INK, 1.2)),
        Entry::line("nominal contact angle", nominal_style()),
    ];
    let (mut svg, top) = page_heading(WIDTH, LEFT, &data.title, &data.note, &entries);
    let frame = Frame { x: LEFT, y: top + 6.0, w: WIDTH - LEFT - RIGHT, h: 430.0 };
    let ball = 0.5 * data.ball_diameter;
    let reach =
        [data.inner.ring_edge, data.outer.ring_edge].map(f64::abs).into_iter().fold(1.7 * ball, f64::max);
    let side = (0.62 * data.width).max(1.5 * ball);
    let axes = Axes::equal(frame, Range::new(-side, side), Range::new(-1.05 * reach, 1.05 * reach));
    axes.grid(&mut svg);
    svg.clip(frame.x, frame.y, frame.w, frame.h);
    for (k, (groove, sign)) in [(&data.inner, -1.0), (&data.outer, 1.0)].into_iter().enumerate() {
        ring(&mut svg, &axes, data, groove, sign);
        ellipse(&mut svg, &axes, data, groove, sign, COLORS[k]);
    }
    let centre = axes.at(0.0, 0.0);
    svg.circle(centre, axes.at(ball, 0.0)[0] - centre[0], Style::stroke(INK, 1.1));
    let (sin, cos) = data.nominal_angle.sin_cos();
    let long = 1.25 * ball;
    axes.segment(&mut svg, [-long * sin, -long * cos], [long * sin, long * cos], nominal_style());
    let most = data.inner.load.max(data.outer.load);
    for (groove, sign) in [(&data.inner, -1.0), (&data.outer, 1.0)] {
        if groove.load > 0.0 {
            let (sin, cos) = groove.contact_angle.sin_cos();
            let at = |r: f64| axes.at(sign * r * sin, sign * r * cos);
            // The race presses the ball: the arrow points from the contact to the ball's centre.
            let length = 0.25 + 0.6 * groove.load / most;
            svg.line(centre, at(ball), Style::stroke(MUTED, 0.8));
            svg.arrow(at(ball), at(ball * (1.0 - length)), 8.0, INK, 1.4);
        }
    }
    svg.unclip();
    axes.border(
        &mut svg,
        Some(&axes.x.label("axial z from the ball centre", "mm")),
        &axes.y.label("radial", "mm"),
    );
    let mut y = frame.bottom() + BOTTOM + 8.0;
    for line in &data.lines {
        svg.text([LEFT, y], line, Text::new(LABEL, INK));
        y += 17.0;
    }
    svg.height = y + 4.0;
    svg
}

fn nominal_style() -> Style {
    Style::stroke(GREEN, 1.4).dashed(Dash::DashDot)
}

/// Centre of a groove and a point of it at an angle; `sign` −1 for the inner race.
fn groove_point(data: &BearingSection, groove: &GrooveSection, sign: f64, angle: f64) -> [f64; 2] {
    let (sin, cos) = groove.contact_angle.sin_cos();
    let back = sign * (groove.radius - 0.5 * data.ball_diameter);
    [sign * groove.radius * angle.sin() - back * sin, sign * groove.radius * angle.cos() - back * cos]
}

/// Ring with its groove between both shoulders.
fn ring(svg: &mut Svg, axes: &Axes, data: &BearingSection, groove: &GrooveSection, sign: f64) {
    const STEPS: usize = 80;
    let half = groove.shoulder_angle;
    let arc = (0..=STEPS).map(|k| -half + 2.0 * half * k as f64 / STEPS as f64);
    let mut outline: Vec<[f64; 2]> = arc.map(|angle| groove_point(data, groove, sign, angle)).collect();
    let (Some(&first), Some(&last)) = (outline.first(), outline.last()) else { return };
    let middle = 0.5 * (first[0] + last[0]);
    // Ends of the ring on the side of the last and of the first point of the groove.
    let end = |point: [f64; 2]| middle + (0.5 * data.width).copysign(point[0] - middle);
    outline.push([end(last), last[1]]);
    outline.push([end(last), groove.ring_edge]);
    outline.push([end(first), groove.ring_edge]);
    outline.push([end(first), first[1]]);
    let points: Vec<Point> = outline.iter().map(|[z, r]| axes.at(*z, *r)).collect();
    svg.polygon(&points, Style::stroke(MUTED, 1.0).filled(STEEL));
}

/// Extent of the contact ellipse on the groove.
fn ellipse(
    svg: &mut Svg,
    axes: &Axes,
    data: &BearingSection,
    groove: &GrooveSection,
    sign: f64,
    color: Color,
) {
    const STEPS: usize = 60;
    if groove.half_ellipse <= 0.0 {
        return;
    }
    let angle = |k: usize| groove.contact_angle + groove.half_ellipse * (2.0 * k as f64 / STEPS as f64 - 1.0);
    let points: Vec<Point> =
        (0..=STEPS).map(|k| groove_point(data, groove, sign, angle(k))).map(|[z, r]| axes.at(z, r)).collect();
    svg.polyline(&points, Style::stroke(color, 4.0));
}

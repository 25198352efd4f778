//! Stacked panels and phase panel, shared by FRF and Bode plots.

use super::axes::{Axes, Frame};
use super::decimate;
use super::scale::{Range, Scale};
use super::style::*;
use super::svg::{Point, Style, Svg};

/// Phase panel from -180° to 180° with ticks every 90°.
pub fn phase_axes(frame: Frame, x: Range) -> Axes {
    let axes = Axes::linear(frame, x, Range::new(-180.0, 180.0));
    let y = Scale::at_ticks(axes.y, &[-180.0, -90.0, 0.0, 90.0, 180.0]);
    Axes { y, ..axes }
}

/// Phase angle of a complex number \[deg\], -180 to 180.
pub fn degrees(re: f64, im: f64) -> f64 {
    im.atan2(re).to_degrees()
}

/// A phase curve \[deg\], wrapped to -180..180 and broken at wrap-around jumps.
pub fn phase_curve(svg: &mut Svg, axes: &Axes, x: &[f64], phase: &[f64], style: Style) {
    let mut points: Vec<Point> = Vec::with_capacity(x.len());
    let mut last = f64::NAN;
    for (&x, &phase) in x.iter().zip(phase) {
        let wrapped = (phase + 180.0).rem_euclid(360.0) - 180.0;
        if (wrapped - last).abs() > 180.0 {
            points.push([f64::NAN; 2]);
        }
        points.push(axes.at(x, wrapped));
        last = wrapped;
    }
    axes.clipped(svg, &decimate::decimate_columns(points.into_iter()), style);
}

/// Vertically stacked panels of the given heights with a common x axis.
pub fn stack(top: f64, w: f64, heights: &[f64]) -> Vec<Frame> {
    let mut y = top;
    heights
        .iter()
        .map(|&h| {
            let frame = Frame { x: LEFT, y, w, h };
            y += h + GAP;
            frame
        })
        .collect()
}

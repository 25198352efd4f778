//! Side view of the machine layout to scale, to check the model.

use super::axes::{Axes, Frame};
use super::font;
use super::labels::{NameRow, page_heading, place_without_overlap};
use super::scale::{Range, extremes};
use super::style::*;
use super::svg::{Color, Dash, Point, Style, Svg, Text};

/// A shaft section, possibly tapered or hollow.
#[derive(Clone, Copy, Debug)]
pub struct LayoutSection {
    /// Axial positions of the ends \[m\].
    pub z: [f64; 2],
    /// Outer and inner radius at the two ends \[m\].
    pub outer: [f64; 2],
    pub inner: [f64; 2],
}

/// A disc or body as a rectangle in the z-y plane.
#[derive(Clone, Debug)]
pub struct LayoutBlock {
    pub label: String,
    /// Axial and vertical extent \[m\].
    pub z: [f64; 2],
    pub y: [f64; 2],
    /// Part of the rotor (dark) or stationary (light).
    pub rotating: bool,
}

/// A bearing around the shaft.
#[derive(Clone, Debug)]
pub struct LayoutBearing {
    pub label: String,
    /// Axial position and width \[m\].
    pub z: f64,
    pub width: f64,
    /// Bore and outside radius \[m\].
    pub bore: f64,
    pub outside: f64,
}

/// A spring or bushing between two points.
#[derive(Clone, Copy, Debug)]
pub struct LayoutSpring {
    /// \[z, y\] of the ends \[m\].
    pub from: [f64; 2],
    pub to: [f64; 2],
    /// The second end is connected to ground.
    pub grounded: bool,
}

/// Belt pull on the shaft.
#[derive(Clone, Debug)]
pub struct LayoutBelt {
    pub label: String,
    /// Axial position, pulley radius \[m\].
    pub z: f64,
    pub radius: f64,
    /// Direction of the pull in x and y; x points into the page.
    pub pull: [f64; 2],
}

/// Data of a machine layout figure.
#[derive(Clone, Debug, Default)]
pub struct MachineLayout {
    pub title: String,
    pub note: String,
    pub sections: Vec<LayoutSection>,
    pub blocks: Vec<LayoutBlock>,
    pub supports: Vec<LayoutBearing>,
    pub springs: Vec<LayoutSpring>,
    pub belts: Vec<LayoutBelt>,
    /// Names and axial positions \[m\] of the stations.
    pub stations: Vec<(String, f64)>,
}

const SHAFT: Color = Color(186, 196, 208);
const ROTATING: Color = Color(150, 164, 182);
const STATIONARY: Color = Color(238, 235, 226);

pub fn draw(data: &MachineLayout) -> Svg {
    let (mut svg, top) = page_heading(WIDTH, 24.0, &data.title, &data.note, &[]);
    let (z, y) = extent(data);
    let w = WIDTH - 48.0;
    let h = (w * (y.hi - y.lo) / (z.hi - z.lo)).clamp(130.0, 420.0);
    let frame = Frame { x: 24.0, y: top + 30.0, w, h };
    let axes = Axes::equal(frame, z, y);
    let corner = |z: f64, y: f64| axes.at(1e3 * z, 1e3 * y);
    let under_names = stations(&mut svg, &axes, &data.stations);
    for block in data.blocks.iter().filter(|b| !b.rotating) {
        let fill = Style::stroke(MUTED, 0.9).filled(STATIONARY);
        rectangle(&mut svg, corner(block.z[0], block.y[0]), corner(block.z[1], block.y[1]), fill);
    }
    for spring in &data.springs {
        zigzag(
            &mut svg,
            corner(spring.from[0], spring.from[1]),
            corner(spring.to[0], spring.to[1]),
            spring.grounded,
        );
    }
    for block in data.blocks.iter().filter(|b| b.rotating) {
        let fill = Style::stroke(INK, 0.9).filled(ROTATING);
        rectangle(&mut svg, corner(block.z[0], block.y[0]), corner(block.z[1], block.y[1]), fill);
    }
    shaft(&mut svg, &axes, &data.sections);
    for support in &data.supports {
        bearing(&mut svg, &axes, support);
    }
    for b in &data.belts {
        belt(&mut svg, &axes, b);
    }
    let [x0, x1] = [z.lo, z.hi].map(|z| axes.at(z, 0.0)[0]);
    svg.line(
        [x0, axes.at(0.0, 0.0)[1]],
        [x1, axes.at(0.0, 0.0)[1]],
        Style::stroke(INK, 0.7).dashed(Dash::DashDot),
    );
    names(&mut svg, &axes, data);
    ruler(&mut svg, &axes, under_names + 10.0);
    svg.height = under_names + 56.0;
    svg
}

/// The shaft: outline and shoulders dark, boundaries between equal sections pale.
fn shaft(svg: &mut Svg, axes: &Axes, sections: &[LayoutSection]) {
    let corner = |z: f64, y: f64| axes.at(1e3 * z, 1e3 * y);
    let dark = Style::stroke(INK, 0.9);
    for s in sections {
        let shape = |r: [f64; 2]| {
            [corner(s.z[0], r[0]), corner(s.z[1], r[1]), corner(s.z[1], -r[1]), corner(s.z[0], -r[0])]
        };
        svg.polygon(&shape(s.outer), Style::stroke(PALE, 0.5).filled(SHAFT));
        if s.inner.iter().any(|r| *r > 0.0) {
            svg.polygon(&shape(s.inner), Style::stroke(MUTED, 0.7).filled(WHITE).faint(0.8));
        }
    }
    for (k, s) in sections.iter().enumerate() {
        for side in [1.0, -1.0] {
            svg.line(corner(s.z[0], side * s.outer[0]), corner(s.z[1], side * s.outer[1]), dark);
        }
        let before = k.checked_sub(1).and_then(|k| sections.get(k)).map(|o| (o.z[1], o.outer[1]));
        let after = sections.get(k + 1).map(|o| (o.z[0], o.outer[0]));
        for (end, neighbour) in [(0, before), (1, after)] {
            if neighbour != Some((s.z[end], s.outer[end])) {
                svg.line(corner(s.z[end], s.outer[end]), corner(s.z[end], -s.outer[end]), dark);
            }
        }
    }
}

/// Padded extent of all parts \[mm\].
fn extent(data: &MachineLayout) -> (Range, Range) {
    let zs = (data.sections.iter().flat_map(|s| s.z))
        .chain(data.blocks.iter().flat_map(|b| b.z))
        .chain(data.springs.iter().flat_map(|s| [s.from[0], s.to[0]]))
        .chain(data.supports.iter().flat_map(|s| [s.z - 0.5 * s.width, s.z + 0.5 * s.width]))
        .chain(data.stations.iter().map(|s| s.1));
    let ys = (data.sections.iter().flat_map(|s| s.outer.into_iter().flat_map(|r| [r, -r])))
        .chain(data.blocks.iter().flat_map(|b| b.y))
        .chain(data.springs.iter().flat_map(|s| [s.from[1], s.to[1]]))
        .chain(data.supports.iter().flat_map(|s| [s.outside, -s.outside]))
        .chain(data.belts.iter().flat_map(|b| [b.radius, -b.radius]));
    (Range::of(zs.map(|v| 1e3 * v)).padded(0.04), Range::of(ys.map(|v| 1e3 * v)).padded(0.06))
}

fn rectangle(svg: &mut Svg, a: Point, b: Point, style: Style) {
    svg.polygon(&[a, [b[0], a[1]], b, [a[0], b[1]]], style);
}

/// Rolling bearing in section: rings and a ball above and below the shaft.
fn bearing(svg: &mut Svg, axes: &Axes, s: &LayoutBearing) {
    for side in [1.0, -1.0] {
        let a = axes.at(1e3 * (s.z - 0.5 * s.width), side * 1e3 * s.bore);
        let b = axes.at(1e3 * (s.z + 0.5 * s.width), side * 1e3 * s.outside);
        rectangle(svg, a, b, Style::stroke(INK, 1.0).filled(WHITE));
        let center = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
        let radius = 0.3 * (b[1] - a[1]).abs().min((b[0] - a[0]).abs().max(4.0));
        svg.circle(center, radius, Style::stroke(INK, 0.9).filled(STEEL));
    }
}

/// A spring as a zigzag, with ground hatching if grounded.
fn zigzag(svg: &mut Svg, a: Point, b: Point, grounded: bool) {
    let d = [b[0] - a[0], b[1] - a[1]];
    let length = d[0].hypot(d[1]);
    if !length.is_finite() || length < 1.0 {
        return;
    }
    let across = [-d[1] / length, d[0] / length];
    let offset = |k: usize| {
        if !(2..=8).contains(&k) {
            0.0
        } else if k.is_multiple_of(2) {
            4.5
        } else {
            -4.5
        }
    };
    let points: Vec<Point> = (0..=10)
        .map(|k| {
            let t = k as f64 / 10.0;
            [a[0] + t * d[0] + offset(k) * across[0], a[1] + t * d[1] + offset(k) * across[1]]
        })
        .collect();
    svg.polyline(&points, Style::stroke(INK, 1.0));
    if grounded {
        let at = |along: f64, out: f64| {
            [b[0] + along * across[0] + out * d[0] / length, b[1] + along * across[1] + out * d[1] / length]
        };
        svg.line(at(-10.0, 0.0), at(10.0, 0.0), Style::stroke(INK, 1.2));
        for k in 0..5 {
            let along = -8.0 + 4.5 * f64::from(k);
            svg.line(at(along, 0.0), at(along - 3.5, 5.0), Style::stroke(INK, 0.7));
        }
    }
}

/// Belt pull: an arrow up or down, or the symbol of an arrow into (cross) or out of the page (dot).
fn belt(svg: &mut Svg, axes: &Axes, b: &LayoutBelt) {
    let side = if b.pull[1] >= 0.0 { 1.0 } else { -1.0 };
    let [x, y] = axes.at(1e3 * b.z, side * 1e3 * b.radius);
    if b.pull[0].abs() > b.pull[1].abs() {
        const R: f64 = 7.0;
        let at = [x, y - side * 18.0];
        let line = Style::stroke(GREEN, 1.6);
        svg.circle(at, R, line.filled(WHITE));
        if b.pull[0] > 0.0 {
            let d = R * std::f64::consts::FRAC_1_SQRT_2;
            svg.line([at[0] - d, at[1] - d], [at[0] + d, at[1] + d], line);
            svg.line([at[0] - d, at[1] + d], [at[0] + d, at[1] - d], line);
        } else {
            svg.circle(at, 2.0, Style::fill(GREEN));
        }
    } else {
        svg.arrow([x, y], [x, y - side * 30.0], 8.0, GREEN, 2.0);
    }
    svg.text(
        [x + 12.0, y - side * 18.0 + 4.0],
        &font::fit(&b.label, SMALL, 150.0),
        Text::new(SMALL, GREEN).halo(),
    );
}

/// Stations: dotted lines from the axis to their names below the drawing; returns the height below the names.
fn stations(svg: &mut Svg, axes: &Axes, list: &[(String, f64)]) -> f64 {
    let (axis, bottom) = (axes.at(0.0, 0.0)[1], axes.frame.bottom() + 4.0);
    let row = NameRow::new(list.iter().map(|s| (axes.x.px(1e3 * s.1), s.0.clone())), WIDTH);
    for x in list.iter().map(|s| axes.x.px(1e3 * s.1)) {
        svg.line([x, axis], [x, bottom], Style::stroke(PALE, 0.7).dashed(Dash::Dotted));
    }
    row.draw(svg, bottom, false, MUTED);
    bottom + 11.0 + row.height
}

/// Names of blocks and bearings in a row above the drawing, with leader lines.
fn names(svg: &mut Svg, axes: &Axes, data: &MachineLayout) {
    let blocks = data.blocks.iter().map(|b| (&b.label, 0.5 * (b.z[0] + b.z[1]), b.y[0].max(b.y[1])));
    let supports = data.supports.iter().map(|s| (&s.label, s.z, s.outside));
    let list: Vec<_> = blocks.chain(supports).filter(|n| !n.0.is_empty()).collect();
    let places: Vec<f64> = list.iter().map(|n| axes.x.px(1e3 * n.1)).collect();
    let labels: Vec<String> = list.iter().map(|n| font::fit(n.0, SMALL, 140.0)).collect();
    let sizes: Vec<f64> = labels.iter().map(|l| font::width(l, SMALL) + 10.0).collect();
    let row = axes.frame.y - 12.0;
    for (k, place) in place_without_overlap(&places, &sizes, 4.0, WIDTH - 4.0).into_iter().enumerate() {
        let Some(x) = place else { continue };
        let tip = axes.at(1e3 * list[k].1, 1e3 * list[k].2);
        svg.polyline(&[tip, [tip[0], row + 10.0], [x, row + 3.0]], Style::stroke(MUTED, 0.7));
        svg.text([x, row], &labels[k], Text::new(SMALL, INK).middle());
    }
}

/// Axial scale below the station names.
fn ruler(svg: &mut Svg, axes: &Axes, y: f64) {
    let ends = extremes(axes.x.ticks.iter().map(|t| axes.x.px(t.value)))
        .unwrap_or((axes.frame.x, axes.frame.right()));
    svg.line([ends.0, y], [ends.1, y], FRAME);
    for tick in &axes.x.ticks {
        let x = axes.x.px(tick.value);
        svg.line([x, y], [x, y + 4.0], FRAME);
        svg.text([x, y + 16.0], &tick.label, Text::new(TICK, INK).middle());
    }
    let label = axes.x.label("axial position z", "mm");
    svg.text([axes.frame.center()[0], y + 34.0], &label, Text::new(LABEL, INK).middle());
}

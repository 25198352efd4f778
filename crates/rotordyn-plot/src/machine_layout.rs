//! Side view of the machine layout to scale, to check the model.

use super::axes::{Axes, Frame};
use super::font;
use super::labels::{NameRow, page_heading};
use super::leaders::{Callout, CalloutRow};
use super::scale::{Range, extremes};
use super::style::*;
use super::svg::{Color, Dash, Point, Style, Svg, Text};
use super::symbols::{self, SupportSymbol};

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

/// A rolling bearing around the shaft.
#[derive(Clone, Debug)]
pub struct LayoutBearing {
    pub label: String,
    /// Bore and outside radius \[m\].
    pub bore: f64,
    pub outside: f64,
    pub rows: Vec<LayoutRow>,
}

/// One row of balls with its rings.
#[derive(Clone, Copy, Debug)]
pub struct LayoutRow {
    /// Axial position and width \[m\].
    pub z: f64,
    pub width: f64,
    /// Pitch radius and ball radius \[m\].
    pub pitch: f64,
    pub ball: f64,
    /// Contact angle \[rad\], positive if the load lines meet the axis on the −z side of the row.
    pub contact_angle: f64,
}

/// A linear bearing, bushing or joint on the shaft, drawn as its symbol below the shaft.
#[derive(Clone, Debug)]
pub struct LayoutSupport {
    pub label: String,
    /// Axial position, radius of the surface it acts on \[m\].
    pub z: f64,
    pub radius: f64,
    pub symbol: SupportSymbol,
    /// The other side is the ground, else a body.
    pub grounded: bool,
}

/// A bushing between two points.
#[derive(Clone, Copy, Debug)]
pub struct LayoutSpring {
    /// \[z, y\] of the ends \[m\].
    pub from: [f64; 2],
    pub to: [f64; 2],
    pub spring: bool,
    pub damper: bool,
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
    pub bearings: Vec<LayoutBearing>,
    pub supports: Vec<LayoutSupport>,
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
    let frame = Frame { x: 24.0, y: top, w, h };
    // The height of the names shifts the drawing down; x positions do not depend on it.
    let names = names(&Axes::equal(frame, z, y), data).height;
    let axes = Axes::equal(Frame { y: top + 18.0 + names, ..frame }, z, y);
    let corner = |z: f64, y: f64| axes.at(1e3 * z, 1e3 * y);
    let under_names = stations(&mut svg, &axes, &data.stations);
    for block in data.blocks.iter().filter(|b| !b.rotating) {
        let fill = Style::stroke(MUTED, 0.9).filled(STATIONARY);
        rectangle(&mut svg, corner(block.z[0], block.y[0]), corner(block.z[1], block.y[1]), fill);
    }
    for s in &data.springs {
        let ends = (corner(s.from[0], s.from[1]), corner(s.to[0], s.to[1]));
        svg.group("spring", |svg| {
            symbols::spring_damper(svg, ends.0, ends.1, (s.spring, s.damper), s.grounded);
        });
    }
    for block in data.blocks.iter().filter(|b| b.rotating) {
        let fill = Style::stroke(INK, 0.9).filled(ROTATING);
        rectangle(&mut svg, corner(block.z[0], block.y[0]), corner(block.z[1], block.y[1]), fill);
    }
    shaft(&mut svg, &axes, &data.sections);
    for b in &data.bearings {
        svg.group("ball-bearing", |svg| bearing(svg, &axes, b));
    }
    for (k, support) in data.supports.iter().enumerate() {
        let at = [support_x(&axes, data, k), corner(support.z, -support.radius)[1]];
        let class = match support.symbol {
            SupportSymbol::Ball => "ball-bearing",
            SupportSymbol::SpringDamper { .. } => "spring-damper",
            SupportSymbol::Joint(_) => "joint",
        };
        svg.group(class, |svg| symbols::support(svg, at, support.symbol, support.grounded));
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
    self::names(&axes, data).draw(&mut svg, axes.frame.y - 10.0);
    ruler(&mut svg, &axes, under_names + 10.0);
    svg.height = under_names + 56.0;
    svg
}

/// The shaft: outline and shoulders; boundaries between elements are not drawn.
fn shaft(svg: &mut Svg, axes: &Axes, sections: &[LayoutSection]) {
    let corner = |z: f64, y: f64| axes.at(1e3 * z, 1e3 * y);
    let dark = Style::stroke(INK, 0.9);
    for s in sections {
        let shape = |r: [f64; 2]| {
            [corner(s.z[0], r[0]), corner(s.z[1], r[1]), corner(s.z[1], -r[1]), corner(s.z[0], -r[0])]
        };
        svg.polygon(&shape(s.outer), Style::stroke(SHAFT, 0.6).filled(SHAFT));
        if s.inner.iter().any(|r| *r > 0.0) {
            let bore = shape(s.inner);
            svg.polygon(&bore, Style::stroke(WHITE, 0.6).filled(WHITE));
            svg.line(bore[0], bore[1], Style::stroke(MUTED, 0.7));
            svg.line(bore[3], bore[2], Style::stroke(MUTED, 0.7));
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
    let rows = || data.bearings.iter().flat_map(|b| &b.rows);
    let zs = (data.sections.iter().flat_map(|s| s.z))
        .chain(data.blocks.iter().flat_map(|b| b.z))
        .chain(data.springs.iter().flat_map(|s| [s.from[0], s.to[0]]))
        .chain(rows().flat_map(|r| [r.z - 0.5 * r.width, r.z + 0.5 * r.width]))
        .chain(data.supports.iter().map(|s| s.z))
        .chain(data.stations.iter().map(|s| s.1));
    let z = Range::of(zs.map(|v| 1e3 * v)).padded(0.04);
    // Symbols of supports have a size in px.
    let below = (symbols::SUPPORT_LENGTH + 8.0) * (z.hi - z.lo) / (WIDTH - 48.0) / 1e3;
    let ys = (data.sections.iter().flat_map(|s| s.outer.into_iter().flat_map(|r| [r, -r])))
        .chain(data.blocks.iter().flat_map(|b| b.y))
        .chain(data.springs.iter().flat_map(|s| [s.from[1], s.to[1]]))
        .chain(data.bearings.iter().flat_map(|b| [b.outside, -b.outside]))
        .chain(data.supports.iter().flat_map(|s| [s.radius, -s.radius - below]))
        .chain(data.belts.iter().flat_map(|b| [b.radius + below, -b.radius]));
    (z, Range::of(ys.map(|v| 1e3 * v)).padded(0.06))
}

fn rectangle(svg: &mut Svg, a: Point, b: Point, style: Style) {
    svg.polygon(&[a, [b[0], a[1]], b, [a[0], b[1]]], style);
}

/// Rolling bearing in section above and below the shaft: per row the rings, a ball, and its contact line.
fn bearing(svg: &mut Svg, axes: &Axes, b: &LayoutBearing) {
    for row in &b.rows {
        let [low, high] = [-0.5, 0.5].map(|side| row.z + side * row.width);
        let shoulder = 0.6 * row.ball;
        for side in [1.0, -1.0] {
            let at = |z: f64, r: f64| axes.at(1e3 * z, side * 1e3 * r);
            let line = Style::stroke(INK, 0.9);
            rectangle(svg, at(low, b.bore), at(high, b.outside), line.filled(WHITE));
            for r in [[b.bore, row.pitch - shoulder], [row.pitch + shoulder, b.outside]] {
                rectangle(svg, at(low, r[0]), at(high, r[1]), line.filled(STEEL));
            }
            let center = at(row.z, row.pitch);
            let radius = (center[1] - at(row.z, row.pitch + row.ball)[1]).abs();
            svg.circle(center, radius, line.filled(WHITE));
            if row.contact_angle != 0.0 {
                // Outwards from the axis: towards +z if the load lines meet the axis on the −z side.
                let (sin, cos) = row.contact_angle.sin_cos();
                let reach = 0.5 * (b.outside - b.bore) / cos.max(0.3);
                let end = |t: f64| at(row.z + t * reach * sin, row.pitch + t * reach * cos);
                svg.group("contact-line", |svg| {
                    svg.line(end(-1.0), end(1.0), Style::stroke(RED, 1.2));
                });
            }
        }
    }
}

/// Height of a belt's symbol above the pulley \[px\].
const BELT_SYMBOL: f64 = 26.0;

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
        svg.arrow([x, y], [x, y - side * BELT_SYMBOL], 8.0, GREEN, 2.0);
    }
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

/// Page position of a support; those at one station are side by side.
fn support_x(axes: &Axes, data: &MachineLayout, k: usize) -> f64 {
    let x = axes.x.px(1e3 * data.supports[k].z);
    let near = |o: &&LayoutSupport| (axes.x.px(1e3 * o.z) - x).abs() < 14.0;
    x + 24.0 * data.supports[..k].iter().filter(near).count() as f64
}

/// Names of all parts in a row above the drawing, with leader lines.
fn names(axes: &Axes, data: &MachineLayout) -> CalloutRow {
    let place = |label: &str, z: [f64; 2], y: f64, color: Color| {
        let x = z.map(|z| axes.x.px(1e3 * z));
        let x = if x[1] - x[0] > 6.0 { [x[0] + 2.0, x[1] - 2.0] } else { [0.5 * (x[0] + x[1]); 2] };
        Callout { text: font::fit(label, SMALL, 170.0), color, x, y: axes.y.px(1e3 * y) }
    };
    let blocks = data.blocks.iter().map(|b| place(&b.label, b.z, b.y[0].max(b.y[1]), INK));
    let bearings = data.bearings.iter().map(|b| {
        let z = extremes(b.rows.iter().flat_map(|r| [r.z - 0.5 * r.width, r.z + 0.5 * r.width]));
        place(&b.label, z.map_or([0.0; 2], |z| [z.0, z.1]), b.outside, INK)
    });
    let supports = data.supports.iter().enumerate().map(|(k, s)| {
        let at = support_x(axes, data, k);
        Callout { x: [at; 2], ..place(&s.label, [s.z; 2], s.radius, INK) }
    });
    let belts = data.belts.iter().map(|b| {
        let place = place(&b.label, [b.z; 2], b.radius, GREEN);
        // To the symbol, which is above the pulley unless the pull is downwards.
        Callout { y: place.y - if b.pull[1] >= 0.0 { BELT_SYMBOL } else { 0.0 }, ..place }
    });
    let all = blocks.chain(bearings).chain(supports).chain(belts).filter(|c| !c.text.is_empty());
    CalloutRow::new(all.collect(), WIDTH)
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

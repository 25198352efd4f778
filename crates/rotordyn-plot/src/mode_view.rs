//! Axonometric view of the machine in a panel of mode shapes, and the solids in it.

use super::vector::{cross, dot};
use std::f64::consts::TAU;

use super::axes::Frame;
use super::mode_shape::{BodyBox, Rotor};
use super::scale::{Range, extremes};
use super::style::*;
use super::svg::{Color, Dash, Point, Style, Svg};

const BODY: Color = Color(238, 235, 226);

/// Axonometric view of one machine in a panel: azimuth 30°, elevation 25°; z to the right, y up, x to the back.
pub(super) struct View {
    origin: Point,
    /// px per m.
    pub scale: f64,
    /// Point of the machine at the middle of the panel \[m\].
    middle: [f64; 3],
    /// Largest half edge of a drawn body \[px\].
    largest_body: f64,
    /// Factor on everything and shift \[px\], so that the motion fits into the panel.
    zoom: f64,
    shift: [f64; 2],
}

impl View {
    /// The view in which shaft and bodies fit into the frame; bodies larger than the shaft is long do not
    /// shrink it.
    pub fn new(rotor: &Rotor, frame: Frame) -> Self {
        let shaft = Range::of(rotor.z.iter().copied().chain(rotor.supports.iter().map(|s| s.z)));
        let length = shaft.hi - shaft.lo;
        let radius = rotor.discs.iter().map(|d| d.radius).filter(|r| r.is_finite()).fold(0.0, f64::max);
        // A rotor that is one node has the size of its disc.
        let length = if rotor.z.len() > 1 { length } else { (4.0 * radius).max(1e-3) };
        let bodies = rotor.bodies.iter().flat_map(BodyBox::corners).map(|c| c[2]);
        let near = bodies.filter(|z| (shaft.lo - length..shaft.hi + length).contains(z));
        let z = Range::of([shaft.lo, shaft.hi].into_iter().chain(near));
        let scale = 0.7 * frame.w / (z.hi - z.lo).max(length);
        let center = frame.center();
        Self {
            origin: [center[0], center[1] + 10.0],
            scale,
            middle: [0.0, 0.0, 0.5 * (z.lo + z.hi)],
            largest_body: 0.16 * frame.h,
            zoom: 1.0,
            shift: [0.0; 2],
        }
    }

    /// A view of directions about a point of the page.
    pub fn of_axes(origin: Point) -> Self {
        Self { origin, scale: 1.0, middle: [0.0; 3], largest_body: f64::INFINITY, zoom: 1.0, shift: [0.0; 2] }
    }

    /// Zooms and shifts the view so that the box of page points (low x, low y, high x, high y) fits into the area.
    pub fn fit(&mut self, points: [f64; 4], area: Frame) {
        const MAX_ZOOM: f64 = 1.5;
        let [x0, y0, x1, y1] = points;
        let zoom = (area.w / (x1 - x0)).min(area.h / (y1 - y0)).min(MAX_ZOOM);
        if !zoom.is_finite() || zoom <= 0.0 {
            return;
        }
        let (center, at) = (area.center(), self.origin);
        self.zoom = zoom;
        self.shift = [
            center[0] - at[0] - zoom * (0.5 * (x0 + x1) - at[0]),
            center[1] - at[1] - zoom * (0.5 * (y0 + y1) - at[1]),
        ];
    }

    /// The same view in another panel.
    pub fn moved(&self, by: [f64; 2]) -> Self {
        Self { origin: [self.origin[0] + by[0], self.origin[1] + by[1]], ..*self }
    }

    /// Page point of the axial position z \[m\] displaced by `by` \[px\] in x, y, z.
    pub fn at(&self, z: f64, by: [f64; 3]) -> Point {
        self.page([by[0], by[1], (z - self.middle[2]) * self.scale + by[2]])
    }

    /// Page point of a position from the middle of the panel \[px\].
    fn page(&self, [x, y, z]: [f64; 3]) -> Point {
        let [across, down] = [0.97 * z + 0.5 * x, -0.906 * y + 0.17 * z - 0.366 * x];
        [
            self.origin[0] + self.shift[0] + self.zoom * across,
            self.origin[1] + self.shift[1] + self.zoom * down,
        ]
    }

    /// The rim of a disc at z \[m\], displaced \[px\] and tilted by the slopes φ_x, φ_y.
    pub fn rim(&self, z: f64, radius: f64, by: [f64; 3], tilt: [f64; 2]) -> Vec<Point> {
        let normal = unit([tilt[1], -tilt[0], 1.0]);
        let first = unit([1.0 - normal[0] * normal[0], -normal[0] * normal[1], -normal[0] * normal[2]]);
        let second = cross(normal, first);
        (0..48)
            .map(|k| {
                let (sin, cos) = (TAU * f64::from(k) / 48.0).sin_cos();
                let rim = |i: usize| radius * (cos * first[i] + sin * second[i]);
                self.at(z, [0, 1, 2].map(|i| by[i] + rim(i)))
            })
            .collect()
    }

    /// Drawn radius of a disc \[px\].
    pub fn disc_radius(&self, radius: f64, frame: Frame) -> f64 {
        (radius * self.scale).clamp(6.0, 0.28 * frame.h)
    }

    /// Drawn centre and half edges of a body \[px\]: to scale, unless it would fill the panel.
    fn drawn(&self, body: &BodyBox) -> ([f64; 3], [[f64; 3]; 3]) {
        let largest = extremes(body.half_edges.iter().flatten().map(|e| e.abs() * self.scale));
        let largest = largest.map_or(0.0, |e| e.1);
        let shrink = if largest > self.largest_body { self.largest_body / largest } else { 1.0 };
        let edge = |e: [f64; 3]| e.map(|e| shrink * e * self.scale);
        let centre = [0, 1, 2].map(|i| (body.centre[i] - self.middle[i]) * self.scale);
        let reach = 2.0 * self.largest_body;
        let limit = [reach, reach, 5.0 * reach];
        ([0, 1, 2].map(|i| centre[i].clamp(-limit[i], limit[i])), body.half_edges.map(edge))
    }

    /// Page point of a body's centre displaced by `by` \[px\].
    pub fn body_centre(&self, body: &BodyBox, by: [f64; 3]) -> Point {
        let (centre, _) = self.drawn(body);
        self.page([0, 1, 2].map(|i| centre[i] + by[i]))
    }

    /// Page point below a body, at the middle of its lower face.
    pub fn body_foot(&self, body: &BodyBox, by: [f64; 3]) -> Point {
        let (centre, edges) = self.drawn(body);
        let height: f64 = edges.iter().map(|e| e[1].abs()).sum();
        self.page([centre[0] + by[0], centre[1] + by[1] - height, centre[2] + by[2]])
    }

    /// A body at rest: dashed outline of its visible faces.
    pub fn rest_body(&self, svg: &mut Svg, body: &BodyBox) {
        for face in self.faces(body, [0.0; 3], [0.0; 3]) {
            svg.polygon(&face, Style::stroke(PALE, 0.8).dashed(Dash::Short));
        }
    }

    /// A body displaced by `by` \[px\] and turned by the small rotation `turn`.
    pub fn moved_body(&self, svg: &mut Svg, body: &BodyBox, by: [f64; 3], turn: [f64; 3]) {
        for face in self.faces(body, by, turn) {
            svg.polygon(&face, Style::stroke(MUTED, 1.0).filled(BODY).faint(0.75));
        }
    }

    /// The faces of a body towards the viewer.
    pub fn faces(&self, body: &BodyBox, by: [f64; 3], turn: [f64; 3]) -> Vec<[Point; 4]> {
        let (centre, edges) = self.drawn(body);
        let edges = edges.map(|e| turned(e, turn));
        let mut faces = Vec::new();
        for axis in 0..3 {
            for sign in [-1.0, 1.0] {
                let (u, v) = (edges[(axis + 1) % 3], edges[(axis + 2) % 3]);
                // Outwards from the body, and from the page to the viewer.
                let out = cross(u, v);
                let out = out.map(|o| sign * o * dot(out, edges[axis]).signum());
                if dot(out, [-1.0, 0.5007, 0.5155]) <= 0.0 {
                    continue;
                }
                faces.push([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[a, b]| {
                    self.page(
                        [0, 1, 2].map(|i| centre[i] + by[i] + sign * edges[axis][i] + a * u[i] + b * v[i]),
                    )
                }));
            }
        }
        faces
    }
}

/// A vector turned about `turn`, by the angle whose tangent is its length (a slope drawn to scale).
fn turned(v: [f64; 3], turn: [f64; 3]) -> [f64; 3] {
    let slope = dot(turn, turn).sqrt();
    if slope == 0.0 || !slope.is_finite() {
        return v;
    }
    let axis = turn.map(|t| t / slope);
    let (sin, cos) = slope.atan().sin_cos();
    let (across, along) = (cross(axis, v), dot(axis, v));
    [0, 1, 2].map(|i| v[i] * cos + across[i] * sin + axis[i] * along * (1.0 - cos))
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = dot(v, v).sqrt();
    v.map(|x| x / length)
}

//! Path of a ball over a spall: rolling over its rounded edges and, if it reaches it, along the floor.

use crate::{BallGeometry, Surface};
use std::f64::consts::FRAC_PI_2;

/// Depth to which a round body sinks as it rolls over a pit (spall) in another round body.
///
/// In the plane across the axis: the pitted surface has the signed radius s (positive where convex), the
/// rolling body t. Each edge is an arc of radius ρ tangent to the surface where the opening begins, its
/// centre at a = s − ρ from the surface's centre. At an angle φ past that point the body on the edge has sunk
/// by
///
/// H = 2 a sin²(φ/2) + x²/(T + √(T² − x²)), T = t + ρ, x = a sin φ, the root with the sign of T,
///
/// the same from the other end, and no deeper than the floor: the minimum of the three is the envelope. An edge more than a
/// quarter turn away is out of reach. The walls below the edges are never touched, as the body is much larger than the pit depth.
///
/// Limits: H = 0 with zero slope at both ends; a flat surface and a sharp edge give t − √(t² − x²).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpallPath {
    width: f64,
    depth: f64,
    /// |s|: angle = length / |s|.
    surface: f64,
    /// a and T \[m\].
    edge: f64,
    radius_sum: f64,
}

impl SpallPath {
    /// Path over a pit of some width and depth \[m\] with edges of radius ρ \[m\], surface and roller given by
    /// signed radii \[m\].
    pub fn new(width: f64, depth: f64, edge_radius: f64, surface: f64, roller: f64) -> Self {
        Self {
            width,
            depth,
            surface: surface.abs(),
            edge: surface - edge_radius,
            radius_sum: roller + edge_radius,
        }
    }

    /// Ball paths over a pit at the inner and outer contact; identical for a pit in a race.
    ///
    /// Radii are those of the normal section in the rolling direction, R / cos α for a race of radius R.
    pub fn on(on: Surface, g: &BallGeometry, width: f64, depth: f64, edge_radius: f64) -> [Self; 2] {
        let ball = 0.5 * g.ball_diameter;
        let axis = 0.5 * g.pitch_diameter / g.contact_angle.cos();
        let (inner, outer) = (axis - ball, -(axis + ball));
        let path = |surface, roller| Self::new(width, depth, edge_radius, surface, roller);
        match on {
            Surface::Inner => [path(inner, ball); 2],
            Surface::Outer => [path(outer, ball); 2],
            Surface::Ball(_) => [path(ball, inner), path(ball, outer)],
        }
    }

    /// Depth of the body and its slope at a length 0 ≤ p ≤ width into the pit \[m\].
    pub fn at(&self, p: f64) -> [f64; 2] {
        let entry = self.edge_path(p);
        let exit = self.edge_path(self.width - p);
        let on_edge = if entry[0] <= exit[0] { entry } else { [exit[0], -exit[1]] };
        if on_edge[0] < self.depth { on_edge } else { [self.depth, 0.0] }
    }

    /// The same for one edge alone, at a length past its start; infinite where the body no longer touches it.
    fn edge_path(&self, length: f64) -> [f64; 2] {
        if length > FRAC_PI_2 * self.surface {
            return [f64::INFINITY, 0.0];
        }
        let (sin, cos) = (length / self.surface).sin_cos();
        let half = (0.5 * length / self.surface).sin();
        let (a, t) = (self.edge, self.radius_sum);
        let x = a * sin;
        let square = t * t - x * x;
        if square <= 0.0 {
            return [f64::INFINITY, 0.0];
        }
        let root = square.sqrt().copysign(t);
        [2.0 * a * half * half + x * x / (t + root), (a * sin + x * a * cos / root) / self.surface]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Depth to which a circle can sink along the ray at p, by bisection against sampled points of the pit's
    /// outline: an independent check of the closed form.
    fn depth_by_outline(pit: &SpallPath, s: f64, t: f64, rho: f64, p: f64) -> f64 {
        // Points of the outline in coordinates along (u) and out of (v) the surface at the ray.
        let turn = |angle: f64, radius: f64| (angle, radius);
        let mut outline: Vec<(f64, f64)> = Vec::new();
        let n = 4000;
        for end in [0.0, pit.width] {
            let side = if end == 0.0 { 1.0 } else { -1.0 };
            // Edge arc, from the surface down to the wall: centre at radius s − rho in direction end/|s|.
            for k in 0..=n {
                // The contact is within a few degrees of the top of the arc.
                let tilt = 0.6 * f64::from(k) / f64::from(n);
                let centre = s - rho;
                let (x, y) = (rho * tilt.sin() * side, centre + rho * tilt.cos());
                let at = end / s.abs();
                outline.push(turn(at + (x / y.abs()).atan(), s.signum() * x.hypot(y)));
            }
        }
        for k in 0..=4 * n {
            let at = pit.width * f64::from(k) / f64::from(4 * n);
            outline.push(turn(at / s.abs(), s - pit.depth));
        }
        let ray = p / s.abs();
        // The circle of radius |t| at the signed distance c along the ray: no penetration of convex bodies, a
        // concave one encloses the outline.
        let clear = |c: f64| {
            outline.iter().all(|&(angle, radius)| {
                let (x, y) = (radius * (angle - ray).sin(), radius * (angle - ray).cos());
                let distance = (x * x + (y - c) * (y - c)).sqrt();
                if t > 0.0 { distance >= t } else { distance <= -t }
            })
        };
        // Inwards from contact with the undamaged surface.
        let (mut free, mut stuck) = (0.0, pit.depth + 1e-4);
        for _ in 0..45 {
            let middle = 0.5 * (free + stuck);
            if clear(s + t - middle) {
                free = middle;
            } else {
                stuck = middle;
            }
        }
        free
    }

    #[test]
    fn path_matches_sampled_outline() {
        let (ball, inner, outer) = (3.969e-3, 15.281e-3, -23.219e-3);
        for (surface, roller) in [(inner, ball), (outer, ball), (ball, inner), (ball, outer)] {
            for (width, depth, edge) in [(1e-3, 50e-6, 0.1e-3), (1e-3, 10e-6, 0.3e-3), (2.5e-3, 40e-6, 1e-3)]
            {
                let pit = SpallPath::new(width, depth, edge, surface, roller);
                for k in 0..=10 {
                    let p = width * f64::from(k) / 10.0;
                    let [sunk, _] = pit.at(p);
                    let outline = depth_by_outline(&pit, surface, roller, edge, p);
                    // Points 1.6e-7 m apart on a floor radius of at least 4 mm: chord within 1e-12 m of its
                    // arc.
                    assert!((sunk - outline).abs() < 1e-11, "{surface} {roller} {p}: {sunk} {outline}");
                }
            }
        }
    }

    #[test]
    fn slopes_match_finite_differences() {
        let pit = SpallPath::new(1e-3, 12e-6, 0.2e-3, -23e-3, 4e-3);
        for k in 1..200 {
            let (p, h) = (1e-3 * f64::from(k) / 200.0, 1e-10);
            let slope = (pit.at(p + h)[0] - pit.at(p - h)[0]) / (2.0 * h);
            let off = (slope - pit.at(p)[1]).abs();
            // Differences of 1e-16 m over 1e-10 m; the corner at the floor and the middle lie between the points.
            assert!(off < 1e-5, "{p}: {slope} off by {off}");
        }
    }

    /// Whether the other end is near or half a turn away, the ball goes over the near edge in the same way.
    #[test]
    fn the_far_edge_of_a_long_pit_is_out_of_reach() {
        let (ball, inner, outer) = (6.15e-3, 20.0e-3, -32.3e-3);
        for surface in [inner, outer] {
            let of = |angle: f64| SpallPath::new(angle * f64::abs(surface), 20e-6, 0.1e-3, surface, ball);
            let short = of(0.5);
            for angle in [1.0, 2.0, 3.0, 3.1, 3.2, 5.0, 6.2] {
                let long = of(angle);
                for p in [1e-6, 1e-5, 1e-4, 1e-3] {
                    assert_eq!(long.at(p), short.at(p), "{angle} rad, {p} m");
                    let end = angle * f64::abs(surface) - p;
                    assert!((long.at(end)[0] - short.at(p)[0]).abs() < 1e-15, "{angle} rad, {p} m");
                }
                assert_eq!(long.at(0.5 * angle * f64::abs(surface)), [20e-6, 0.0]);
            }
        }
    }

    #[test]
    fn limits() {
        // A sharp edge on a nearly flat surface: the chord's height.
        let pit = SpallPath::new(1e-3, 1.0, 0.0, 1e9, 4e-3);
        let [middle, slope] = pit.at(0.5e-3);
        let chord = 4e-3 - (4e-3_f64.powi(2) - 0.5e-3_f64.powi(2)).sqrt();
        assert!((middle / chord - 1.0).abs() < 1e-5 && slope.abs() < 1.0, "{middle} {chord}");
        assert_eq!(pit.at(0.0), [0.0, 0.0]);
        assert_eq!(SpallPath::new(1e-3, 5e-6, 0.1e-3, 23e-3, 4e-3).at(0.5e-3), [5e-6, 0.0]);
    }
}

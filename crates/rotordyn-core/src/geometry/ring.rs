//! Bearing ring: a rectangle revolved about z with a circular groove cut out of it.

use nalgebra::{Vector2, Vector3};

use super::solid::{ExactSolid, RevolvedSolid, revolved_rectangle, revolved_segment};

/// Section of a ring in the half plane (r, z), all lengths \[m\]; z along the bearing's axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ring {
    /// Radius of the seat: half the bore (inner ring) or half the outside diameter (outer ring).
    pub seat_radius: f64,
    /// Radius of the shoulders next to the groove.
    pub shoulder_radius: f64,
    /// Radius of the circle of groove centres R_c and its axial position z_c.
    pub centre_radius: f64,
    pub centre_z: f64,
    /// Groove radius r.
    pub groove_radius: f64,
    /// Axial positions of the two side faces, increasing.
    pub faces: [f64; 2],
}

impl Ring {
    /// +1 for an outer ring (material outside its shoulder), −1 for an inner one.
    pub fn sense(&self) -> f64 {
        (self.seat_radius - self.shoulder_radius).signum()
    }

    /// Distance of the groove's chord (the shoulder line) from the groove centre, at most the groove radius.
    fn chord(&self) -> f64 {
        (self.sense() * (self.shoulder_radius - self.centre_radius))
            .clamp(-self.groove_radius, self.groove_radius)
    }

    /// Half the axial width of the groove at the shoulder \[m\].
    pub fn groove_half_width(&self) -> f64 {
        let h = self.chord();
        (self.groove_radius * self.groove_radius - h * h).sqrt()
    }

    /// Radius of the groove's deepest point \[m\].
    pub fn groove_bottom(&self) -> f64 {
        self.centre_radius + self.sense() * self.groove_radius
    }

    /// Points (r, z) of the groove arc from the lower to the higher z, `count` ≥ 2 of them.
    pub fn groove_arc(&self, count: usize) -> Vec<[f64; 2]> {
        let half = (self.chord() / self.groove_radius).acos();
        (0..count)
            .map(|k| {
                let angle = half * (2.0 * k as f64 / (count - 1) as f64 - 1.0);
                [
                    self.centre_radius + self.sense() * self.groove_radius * angle.cos(),
                    self.centre_z + self.groove_radius * angle.sin(),
                ]
            })
            .collect()
    }

    fn contains(&self, p: Vector2<f64>) -> bool {
        let between = (p.x - self.seat_radius) * (p.x - self.shoulder_radius) <= 0.0
            && p.y >= self.faces[0]
            && p.y <= self.faces[1];
        between && (p - self.centre()).norm_squared() >= self.groove_radius * self.groove_radius
    }

    fn centre(&self) -> Vector2<f64> {
        Vector2::new(self.centre_radius, self.centre_z)
    }

    /// Nearest point of the section's outline: the groove arc, or one of its straight sides.
    fn nearest(&self, p: Vector2<f64>) -> Vector2<f64> {
        let from_centre = p - self.centre();
        let distance = from_centre.norm();
        let depth = self.sense() * from_centre.x;
        let mut best = None;
        let mut shortest = f64::INFINITY;
        // On the arc the distance is ||p − c| − r|, computed without the nearest point: no cancellation.
        if distance > 0.0 && depth >= self.chord() * (distance / self.groove_radius) {
            shortest = (distance - self.groove_radius).abs();
            best = Some(self.centre() + from_centre * (self.groove_radius / distance));
        }
        let edge = self.groove_half_width();
        let [low, high] = self.faces;
        let (back, shoulder) = (self.seat_radius, self.shoulder_radius);
        let sides = [
            [[shoulder, low], [shoulder, self.centre_z - edge]],
            [[shoulder, self.centre_z + edge], [shoulder, high]],
            [[back, low], [back, high]],
            [[back, low], [shoulder, low]],
            [[back, high], [shoulder, high]],
        ];
        for [a, b] in sides {
            let (a, b) = (Vector2::from(a), Vector2::from(b));
            let side = b - a;
            let length2 = side.norm_squared();
            let t = if length2 > 0.0 { ((p - a).dot(&side) / length2).clamp(0.0, 1.0) } else { 0.0 };
            let q = a + side * t;
            let d = (p - q).norm();
            if d < shortest {
                shortest = d;
                best = Some(q);
            }
        }
        best.unwrap_or(p)
    }
}

impl ExactSolid for Ring {
    /// Whether a point is in the material, and the nearest point of the surface; exact to rounding.
    fn project(&self, p: &Vector3<f64>) -> (bool, Vector3<f64>) {
        let radius = p.x.hypot(p.y);
        let section = Vector2::new(radius, p.z);
        let q = self.nearest(section);
        let (cos, sin) = if radius > 0.0 { (p.x / radius, p.y / radius) } else { (1.0, 0.0) };
        (self.contains(section), Vector3::new(q.x * cos, q.x * sin, q.y))
    }

    fn extent(&self) -> (f64, [f64; 2]) {
        (self.seat_radius.max(self.shoulder_radius), self.faces)
    }

    fn wall(&self) -> f64 {
        (self.seat_radius - self.groove_bottom()).abs()
    }

    /// Mass, centre and inertia: rectangle less circular segment, both revolved; exact.
    ///
    /// Valid while the groove lies between the side faces and leaves a wall (see
    /// `BearingShapes::overlaps`).
    fn solid(&self, density: f64) -> RevolvedSolid {
        let [low, high] = self.faces;
        let (r1, r2) =
            (self.seat_radius.min(self.shoulder_radius), self.seat_radius.max(self.shoulder_radius));
        let blank = revolved_rectangle([r1, r2], [low, high], density);
        let groove = revolved_segment(
            self.centre_radius,
            self.sense(),
            self.groove_radius,
            self.chord(),
            self.centre_z,
            density,
        );
        blank.without(&groove)
    }
}

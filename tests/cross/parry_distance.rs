//! parry's ball-to-race gaps compared with the deflection δ of the force element.
//!
//! Where a ball's centre lies on the line through its groove centres, gap to inner race + gap to outer race
//! = −δ, for any split of δ between the races.

use crate::agree;
use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};
use rotordyn::bearing::{BallBearing, BallElement, Rotation};
use rotordyn::geometry::{BearingShapes, Race};

use crate::bearing::rig_6205;

/// Deterministic numbers in [−1, 1) (SplitMix64).
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// Ball centre on the line of groove centres, outer ring at rest; `share` of the approach is at the inner
/// race.
fn ball_centre(shapes: &BearingShapes, angle: f64, inner_centre: Vector3<f64>, share: f64) -> Point3<f64> {
    let (sin, cos) = angle.sin_cos();
    let outer = Vector3::new(
        shapes.outer.centre_radius * cos,
        shapes.outer.centre_radius * sin,
        shapes.outer.centre_z,
    );
    let to_outer = shapes.outer.groove_radius - 0.5 * shapes.ball_diameter;
    let to_inner = shapes.inner.groove_radius - 0.5 * shapes.ball_diameter;
    let line = inner_centre - outer;
    let deflection = line.norm() - to_inner - to_outer;
    Point3::from(outer + line.normalize() * (to_outer + (1.0 - share) * deflection))
}

fn angular(mut bearing: BallBearing, contact_angle: f64, thrust: f64) -> BallBearing {
    bearing.geometry.contact_angle = contact_angle;
    bearing.geometry.thrust_direction = thrust;
    bearing
}

/// Kinematics of the element: displacement of the groove in the plane of each ball.
/// Lengths of 0.02 m have a last bit of 3.5e-18 m; a dozen roundings of the trigonometry give some 1e-17.
#[test]
fn gaps_sum_to_element_deflection() {
    let mut random = Random(1);
    let mut worst: f64 = 0.0;
    for bearing in [rig_6205(), angular(rig_6205(), 15f64.to_radians(), 1.0), angular(rig_6205(), 0.6, -1.0)]
    {
        let element = BallElement::new(&bearing);
        let shapes = BearingShapes::new(&bearing.geometry, bearing.cage_pocket_diameter);
        for _ in 0..200 {
            let d: [f64; 6] = std::array::from_fn(|k| {
                random.next()
                    * if k < 3 {
                        30e-6
                    } else if k < 5 {
                        1e-3
                    } else {
                        0.0
                    }
            });
            let rotation = Rotation { cage_angle: 4.0 * random.next(), ..Rotation::default() };
            for ball in element.ball_loads(&d, &rotation) {
                let (sin, cos) = ball.position.sin_cos();
                let radial = d[0] * cos + d[1] * sin;
                let axial = d[2] + bearing.geometry.inner_centre_radius() * (d[3] * sin - d[4] * cos);
                let shift = Vector3::new(radial * cos, radial * sin, axial);
                let ring = Isometry3::from_parts(Translation3::from(shift), UnitQuaternion::identity());
                let radius = shapes.inner.centre_radius;
                let centre = ball_centre(
                    &shapes,
                    ball.position,
                    Vector3::new(radius * cos, radius * sin, shapes.inner.centre_z) + shift,
                    0.5 + 0.5 * random.next(),
                );
                let gaps = shapes.race_gap(Race::Inner, &ring, &centre)
                    + shapes.race_gap(Race::Outer, &Isometry3::identity(), &centre);
                worst = worst.max((gaps + ball.deflection).abs());
            }
        }
    }
    agree::absolute(
        "gaps of exact shapes and the approach of a ball: largest difference [m]",
        worst,
        0.0,
        1e-16,
    );
}

/// The ring moved and tilted as a rigid body: the element is linear in the displacement, so the difference is
/// of second order, at most about |d|²/R with |d| the displacement of the groove, a quarter when |d| is
/// halved.
#[test]
fn ring_linearisation_error_is_second_order() {
    let bearing = rig_6205();
    let element = BallElement::new(&bearing);
    let shapes = BearingShapes::new(&bearing.geometry, bearing.cage_pocket_diameter);
    let mut random = Random(2);
    let directions: Vec<[f64; 6]> =
        (0..20).map(|_| std::array::from_fn(|k| if k == 5 { 0.0 } else { random.next() })).collect();
    let worst = |scale: f64| {
        let mut worst: f64 = 0.0;
        for direction in &directions {
            let d: [f64; 6] =
                std::array::from_fn(|k| scale * direction[k] * if k < 3 { 20e-6 } else { 1e-3 });
            let ring = Isometry3::new(Vector3::new(d[0], d[1], d[2]), Vector3::new(d[3], d[4], 0.0));
            let rotation = Rotation { cage_angle: 0.3, ..Rotation::default() };
            for ball in element.ball_loads(&d, &rotation) {
                // The point of the tilted circle of groove centres nearest to the outer groove centre.
                let (sin, cos) = ball.position.sin_cos();
                let outer = Point3::new(
                    shapes.outer.centre_radius * cos,
                    shapes.outer.centre_radius * sin,
                    shapes.outer.centre_z,
                );
                let local = ring.inverse_transform_point(&outer);
                let radius = local.x.hypot(local.y);
                let on_circle = Point3::new(
                    local.x / radius * shapes.inner.centre_radius,
                    local.y / radius * shapes.inner.centre_radius,
                    shapes.inner.centre_z,
                );
                let centre = ball_centre(&shapes, ball.position, (ring * on_circle).coords, 0.5);
                let gaps = shapes.race_gap(Race::Inner, &ring, &centre)
                    + shapes.race_gap(Race::Outer, &Isometry3::identity(), &centre);
                worst = worst.max((gaps + ball.deflection).abs());
            }
        }
        worst
    };
    let (full, half) = (worst(1.0), worst(0.5));
    println!("{full:e} {half:e} ratio {}", full / half);
    let groove = 20e-6 + 1e-3 * shapes.inner.centre_radius;
    assert!(full < 4.0 * groove * groove / shapes.inner.centre_radius, "{full:e}");
    agree::absolute("order of the distance: error over half the step", full / half, 4.0, 0.2);
}

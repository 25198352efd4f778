//! Balls, rings and cage of a bearing as solids, and where they are.
//!
//! The bearing's axes: z along the shaft, origin on the axis in the plane of the inner groove centres, where
//! the force element defines its tilts. The outer ring is at rest in them. A ring's groove is exact (a torus
//! segment, not a mesh).

use super::cage::CageShape;
use super::ring::Ring;
use super::solid::{ExactSolid, RevolvedSolid};
use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};
use rotordyn_bearing::BallGeometry;

/// Shoulder height over ball diameter at α₀ = 0; 0.17 to 0.25 in catalogues, not given in the model file.
const SHOULDER_HEIGHT_RATIO: f64 = 0.2;
/// Half the cage's wall thickness over the ball diameter, chosen to fit between the shoulders.
const CAGE_HALF_WALL_RATIO: f64 = 0.12;
/// Cage width over pocket diameter; never more than 0.9 of the bearing's width.
const CAGE_WIDTH_RATIO: f64 = 1.35;

/// Shapes of one bearing.
#[derive(Clone, Debug, PartialEq)]
pub struct BearingShapes {
    pub inner: Ring,
    pub outer: Ring,
    pub cage: CageShape,
    /// Ball diameter D_w \[m\].
    pub ball_diameter: f64,
    /// Number of balls Z.
    pub balls: usize,
    /// Radius and axial position of the ball centres of the unloaded, centred bearing \[m\].
    pub ball_centre: [f64; 2],
}

/// Poses of a bearing's parts, in its own axes.
#[derive(Clone, Debug, PartialEq)]
pub struct BearingPose {
    /// Pose of the inner ring; identity when centred.
    pub inner: Isometry3<f64>,
    pub cage: Isometry3<f64>,
    /// Centres of the balls \[m\].
    pub balls: Vec<Point3<f64>>,
}

/// One of the two races.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Race {
    Inner,
    Outer,
}

/// Masses and inertias of a bearing's parts; `ball` is one ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BearingMasses {
    pub ball: RevolvedSolid,
    pub inner: RevolvedSolid,
    pub outer: RevolvedSolid,
    pub cage: RevolvedSolid,
}

impl BearingShapes {
    /// Shapes from internal geometry and pocket diameter \[m\].
    ///
    /// Circles of groove centres, with ±z by thrust direction:
    /// R_i = D_pw/2 + (r_i − D_w/2) cos α₀ − P_d/4 at z = 0,
    /// R_o = D_pw/2 − (r_o − D_w/2) cos α₀ + P_d/4 at z = −A sin α₀, A = r_i + r_o − D_w.
    /// Shoulder heights and cage section are not in the geometry: 0.2 D_w (more at large α₀), and a cage wall
    /// of 0.24 D_w centred on the pitch circle; both shoulders of a ring are of equal height.
    pub fn new(g: &BallGeometry, pocket_diameter: f64) -> Self {
        let (sin, cos) = g.contact_angle.sin_cos();
        let ball_radius = 0.5 * g.ball_diameter;
        let pitch_radius = 0.5 * g.pitch_diameter;
        let to_inner = g.inner_groove_radius - ball_radius;
        let to_outer = g.outer_groove_radius - ball_radius;
        let inner_centre = pitch_radius + to_inner * cos - 0.25 * g.radial_clearance;
        let outer_centre = pitch_radius - to_outer * cos + 0.25 * g.radial_clearance;
        let ball_z = -to_inner * sin * g.thrust_direction;
        let outer_z = -(to_inner + to_outer) * sin * g.thrust_direction;
        let shoulder = g.ball_diameter * SHOULDER_HEIGHT_RATIO.max(0.52 * (1.0 - cos) + 0.12);
        let faces = [ball_z - 0.5 * g.width, ball_z + 0.5 * g.width];
        let wall = CAGE_HALF_WALL_RATIO * g.ball_diameter;
        // A default cage is as thin as its pockets need to stay apart at its inner radius.
        let apart = 0.5 * pocket_diameter / (std::f64::consts::PI / g.balls as f64).sin();
        let default_pocket = pocket_diameter <= g.default_cage_pocket() * (1.0 + 1e-12);
        let inside = if default_pocket { (1.001 * apart).min(pitch_radius) } else { 0.0 };
        Self {
            inner: Ring {
                seat_radius: 0.5 * g.bore,
                shoulder_radius: inner_centre - g.inner_groove_radius + shoulder,
                centre_radius: inner_centre,
                centre_z: 0.0,
                groove_radius: g.inner_groove_radius,
                faces,
            },
            outer: Ring {
                seat_radius: 0.5 * g.outside_diameter,
                shoulder_radius: outer_centre + g.outer_groove_radius - shoulder,
                centre_radius: outer_centre,
                centre_z: outer_z,
                groove_radius: g.outer_groove_radius,
                faces,
            },
            cage: CageShape {
                radii: [(pitch_radius - wall).max(inside), pitch_radius + wall],
                centre_z: ball_z,
                width: (CAGE_WIDTH_RATIO * pocket_diameter).min(0.9 * g.width),
                pocket_radius: 0.5 * pocket_diameter,
                pockets: g.balls,
            },
            ball_diameter: g.ball_diameter,
            balls: g.balls,
            ball_centre: [pitch_radius, ball_z],
        }
    }

    /// Everything centred and unloaded, the cage and ball 0 at angle ψ \[rad\] from +x towards +y.
    pub fn centred(&self, cage_angle: f64) -> BearingPose {
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), cage_angle);
        let [radius, z] = self.ball_centre;
        let balls = (0..self.balls)
            .map(|j| {
                let angle = cage_angle + std::f64::consts::TAU * j as f64 / self.balls as f64;
                Point3::new(radius * angle.cos(), radius * angle.sin(), z)
            })
            .collect();
        BearingPose {
            inner: Isometry3::identity(),
            cage: Isometry3::from_parts(Translation3::identity(), turn),
            balls,
        }
    }

    /// Masses, centres and inertias from densities \[kg/m³\] of balls, rings and cage.
    ///
    /// Closed forms for balls and rings (groove taken out); the cage's pockets by quadrature to rounding.
    pub fn masses(&self, ball: f64, ring: f64, cage: f64) -> BearingMasses {
        BearingMasses {
            ball: RevolvedSolid::ball(self.ball_diameter, ball),
            inner: self.inner.solid(ring),
            outer: self.outer.solid(ring),
            cage: self.cage.solid(cage),
        }
    }
}

//! Distances of free balls, races and cage by parry's contact query.

use nalgebra::{Isometry3, Rotation3, Translation3, UnitQuaternion, Vector3};
use parry3d_f64::math::Pose;
use parry3d_f64::query;
use parry3d_f64::shape::{Ball, Shape};
use rotordyn_bearing::contact::Race;
use rotordyn_bearing::free_ball::{
    Approach, Distances, GroovePlace, GrooveSurface, Land, LandPlace, Placement, Pocket, PocketPlace,
    PocketSurface,
};

use super::convert::{pose, vector};
use super::shape::ExactShape;
use crate::geometry::contact_surfaces::{CylindricalHole, EndWalls, GrooveSolid, SphericalHole};

/// Half the length of a pocket's bounding box over its radius.
const POCKET_LENGTH_RATIO: f64 = 1.5;

/// Every distance by parry: a shape with exact projection for each surface, a stock ball for each ball.
#[derive(Clone, Copy, Debug, Default)]
pub struct ParryDistances;

impl Distances for ParryDistances {
    fn groove(&self, groove: &GrooveSurface, place: &GroovePlace) -> ([f64; 2], f64) {
        let shape = ExactShape(GrooveSolid(*groove));
        let found = touch(&shape, &place.ring(), &place.centre, place.radius);
        (place.in_section(&found.normal), found.depth)
    }

    fn pocket(
        &self,
        pocket: &PocketSurface,
        place: &PocketPlace,
        margin: f64,
        mut visit: impl FnMut(Approach),
    ) {
        let at = pocket_placement(place.pocket_centre, place.radial, place.axial);
        let centre = place.pocket_centre + place.from_pocket;
        let mut near = |shape: &dyn Shape| {
            let found = touch(shape, &at, &centre, place.radius);
            if found.depth > -margin {
                visit(found);
            }
        };
        match pocket.shape {
            Pocket::Spherical => near(&ExactShape(SphericalHole { radius: pocket.radius })),
            Pocket::Cylindrical => near(&ExactShape(pocket_hole(pocket.radius))),
            Pocket::Closed { radial_clearance } => {
                near(&ExactShape(pocket_hole(pocket.radius)));
                near(&ExactShape(end_walls(pocket.radius, radial_clearance, place.radius)));
            }
        }
    }

    /// The ball that fills the cage's edge in the land of the outer ring; that of the inner ring's land in the cage.
    fn land(&self, land: &Land, place: &LandPlace) -> Approach {
        let ring = place.ring();
        let [hole, ball] = land_radii(land);
        let shape = ExactShape(CylindricalHole { radius: hole, half_length: land.width });
        match land.race {
            Race::Outer => touch(&shape, &ring, &place.edge, ball),
            Race::Inner => {
                let at = Placement { centre: place.edge, ..ring };
                let found = touch(&shape, &at, &(place.edge - place.eccentric), ball);
                Approach { normal: -found.normal, ..found }
            }
        }
    }

    fn balls(&self, centres: [&Vector3<f64>; 2], radii: [f64; 2]) -> Approach {
        let [first, second] = centres.map(|centre| Pose::from_translation(vector(centre)));
        let [one, other] = radii.map(Ball::new);
        approach(query::contact(&second, &other, &first, &one, f64::MAX))
    }
}

/// Radii of hole and ball \[m\] that touch where an edge of the cage touches its land.
pub(crate) fn land_radii(land: &Land) -> [f64; 2] {
    match land.race {
        Race::Outer => [land.radius, land.radius - land.clearance],
        Race::Inner => [land.radius + land.clearance, land.radius],
    }
}

/// Cylindrical pocket of a radius \[m\].
pub(crate) fn pocket_hole(radius: f64) -> CylindricalHole {
    CylindricalHole { radius, half_length: POCKET_LENGTH_RATIO * radius }
}

/// Walls of a closed pocket with a radial clearance to its ball \[m\].
pub(crate) fn end_walls(radius: f64, radial_clearance: f64, ball_radius: f64) -> EndWalls {
    EndWalls { distance: radial_clearance + ball_radius, radius }
}

/// Pocket with its axis along z.
pub(crate) fn pocket_placement(centre: Vector3<f64>, radial: Vector3<f64>, axial: Vector3<f64>) -> Placement {
    Placement { centre, axes: [axial, radial.cross(&axial), radial] }
}

/// Placement in parry's type.
pub(crate) fn placement_pose(at: &Placement) -> Pose {
    let turn = Rotation3::from_basis_unchecked(&at.axes);
    pose(&Isometry3::from_parts(Translation3::from(at.centre), UnitQuaternion::from_rotation_matrix(&turn)))
}

/// Contact of a surface and a ball; the normal is along the force on the ball.
fn touch(shape: &dyn Shape, at: &Placement, centre: &Vector3<f64>, radius: f64) -> Approach {
    let ball = Pose::from_translation(vector(centre));
    approach(query::contact(&placement_pose(at), shape, &ball, &Ball::new(radius), f64::MAX))
}

/// Normal from the first to the second shape; NaN from non-finite input alone.
fn approach(found: Result<Option<query::Contact>, query::Unsupported>) -> Approach {
    match found {
        Ok(Some(contact)) => {
            let n = contact.normal1;
            Approach { normal: Vector3::new(n.x, n.y, n.z), depth: -contact.dist }
        }
        _ => Approach { normal: Vector3::repeat(f64::NAN), depth: f64::NAN },
    }
}

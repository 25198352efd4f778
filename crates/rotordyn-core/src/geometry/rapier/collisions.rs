//! Which balls, rings, pockets and lands of a bearing with free balls are near each other, by shapes.
//!
//! rapier's broad phase finds the pairs by their bounding boxes, its narrow phase their distance by parry. Nothing is
//! assumed of which ball can reach which other; the closed forms test neighbours and own pockets alone.

use nalgebra::Vector3;
use rapier3d_f64::geometry::{ActiveCollisionTypes, SolverFlags};
use rapier3d_f64::math::Vector;
use rapier3d_f64::pipeline::{ActiveHooks, PairFilterContext, PhysicsHooks, PhysicsWorld};
use rapier3d_f64::prelude::{
    ColliderBuilder, ColliderHandle, RigidBodyBuilder, RigidBodyHandle, SharedShape,
};
use std::f64::consts::TAU;

use crate::geometry::contact_surfaces::{CylindricalHole, GrooveSolid, SphericalHole};
use crate::geometry::parry::free_ball::{
    end_walls, land_radii, placement_pose, pocket_hole, pocket_placement,
};
use crate::geometry::parry::{ExactShape, Overlap, Part};
use rotordyn_bearing::contact::Race;
use rotordyn_bearing::free_ball::{
    Approach, ContactPart, FreeBallState, FreeBalls, Guidance, Land, Placement, Pocket, Proximity, RingState,
};

/// Bodies of a bearing with free balls, placed at given states; rapier moves none of them.
pub struct BodyCollisions {
    world: PhysicsWorld,
    balls: Vec<RigidBodyHandle>,
    rings: [RigidBodyHandle; 2],
    cage: Option<RigidBodyHandle>,
    /// Guiding land and the bodies of its two places: edges of the cage or, on the inner ring, of the land.
    land: Option<(Land, [RigidBodyHandle; 2])>,
    parts: Vec<ContactPart>,
}

/// Admits the pairs that can carry force: balls among each other, ball and race, own pocket, cage and land.
struct Pairs<'a>(&'a [ContactPart]);

impl PhysicsHooks for Pairs<'_> {
    fn filter_contact_pair(&self, context: &PairFilterContext) -> Option<SolverFlags> {
        let part = |handle: ColliderHandle| self.0[context.colliders[handle].user_data as usize];
        is_pair(part(context.collider1), part(context.collider2)).then(SolverFlags::empty)
    }
}

fn is_pair(first: ContactPart, second: ContactPart) -> bool {
    use ContactPart::{Ball, CageEdge, InnerLand, InnerRace, OuterLand, OuterRace, Pocket};
    match (first, second) {
        (Ball(j), Pocket(k)) | (Pocket(k), Ball(j)) => j == k,
        (Ball(_), Ball(_) | InnerRace | OuterRace) | (InnerRace | OuterRace, Ball(_)) => true,
        (CageEdge(_), InnerLand | OuterLand) | (InnerLand | OuterLand, CageEdge(_)) => true,
        _ => false,
    }
}

impl BodyCollisions {
    /// Bodies and shapes of a bearing; pairs nearer than `margin` \[m\] are found.
    pub fn new(balls: &FreeBalls, margin: f64) -> Self {
        let mut world = PhysicsWorld::new();
        let p = &mut world.integration_parameters;
        p.contact_recycling = false;
        p.contact_clustering = false;
        p.normalized_prediction_distance = margin.max(f64::MIN_POSITIVE);
        let mut bodies = Self {
            balls: Vec::new(),
            rings: [0, 1].map(|_| world.insert_body(RigidBodyBuilder::kinematic_position_based())),
            cage: None,
            land: None,
            world,
            parts: Vec::new(),
        };
        for (k, groove) in balls.grooves().into_iter().enumerate() {
            let part = [ContactPart::InnerRace, ContactPart::OuterRace][k];
            let shape = SharedShape::new(ExactShape(GrooveSolid(groove)));
            bodies.attach(bodies.rings[k], part, shape, None);
        }
        for (j, radius) in balls.ball_radii().into_iter().enumerate() {
            let body = bodies.world.insert_body(RigidBodyBuilder::dynamic());
            bodies.attach(body, ContactPart::Ball(j), SharedShape::ball(radius), None);
            bodies.balls.push(body);
        }
        bodies.add_cage(balls);
        bodies
    }

    fn add_cage(&mut self, balls: &FreeBalls) {
        let Some(cage) = &balls.bearing().cage else { return };
        let g = &balls.bearing().ball.geometry;
        let body = self.world.insert_body(RigidBodyBuilder::dynamic());
        let radius = 0.5 * cage.pocket_diameter;
        for (j, ball_radius) in balls.ball_radii().into_iter().enumerate() {
            let (sin, cos) = (TAU * j as f64 / g.balls as f64).sin_cos();
            let radial = Vector3::new(cos, sin, 0.0);
            let at = pocket_placement(0.5 * g.pitch_diameter * radial, radial, Vector3::z());
            let part = ContactPart::Pocket(j);
            let hole = match cage.pocket {
                Pocket::Spherical => SharedShape::new(ExactShape(SphericalHole { radius })),
                _ => SharedShape::new(ExactShape(pocket_hole(radius))),
            };
            self.attach(body, part, hole, Some(&at));
            if let Pocket::Closed { radial_clearance } = cage.pocket {
                let ends = end_walls(radius, radial_clearance, ball_radius);
                self.attach(body, part, SharedShape::new(ExactShape(ends)), Some(&at));
            }
        }
        self.cage = Some(body);
        let Guidance::Land(land) = cage.guidance else { return };
        let [hole, ball] = land_radii(&land);
        let hole = SharedShape::new(ExactShape(CylindricalHole { radius: hole, half_length: land.width }));
        let ball = SharedShape::ball(ball);
        let places = [0, 1].map(|k| {
            let place = self.world.insert_body(RigidBodyBuilder::dynamic());
            let edge = ContactPart::CageEdge(k);
            match land.race {
                Race::Outer => self.attach(place, edge, ball.clone(), None),
                Race::Inner => {
                    self.attach(place, edge, hole.clone(), None);
                }
            }
            place
        });
        match land.race {
            Race::Outer => self.attach(self.rings[1], ContactPart::OuterLand, hole, None),
            Race::Inner => self.attach(self.rings[0], ContactPart::InnerLand, ball, None),
        }
        self.land = Some((land, places));
    }

    /// Adds a shape to a body, `at` a place in its axes.
    fn attach(
        &mut self,
        body: RigidBodyHandle,
        part: ContactPart,
        shape: SharedShape,
        at: Option<&Placement>,
    ) {
        let collider = ColliderBuilder::new(shape)
            .density(0.0)
            .active_collision_types(ActiveCollisionTypes::all())
            .active_hooks(ActiveHooks::FILTER_CONTACT_PAIRS)
            .user_data(self.parts.len() as u128);
        let collider = match at {
            Some(at) => collider.position(placement_pose(at)),
            None => collider,
        };
        self.parts.push(part);
        self.world.insert_collider(collider, Some(body));
    }

    fn place(&mut self, body: RigidBodyHandle, at: &Placement) {
        self.world.bodies[body].set_position(placement_pose(at), true);
    }

    /// All pairs of parts nearer than the margin in a state.
    pub fn detect(&mut self, state: &FreeBallState, rings: &[RingState; 2]) -> Vec<Proximity> {
        let placements = rings.map(|ring| ring.placement());
        for (k, at) in placements.iter().enumerate() {
            self.place(self.rings[k], at);
        }
        for j in 0..self.balls.len() {
            let centre = state.ball(j).position;
            let place = Vector::new(centre.x, centre.y, centre.z);
            self.world.bodies[self.balls[j]].set_translation(place, true);
        }
        if let (Some(body), Some(cage)) = (self.cage, state.cage()) {
            let at = Placement { centre: cage.position, axes: cage.axes() };
            self.place(body, &at);
            if let Some((land, places)) = self.land {
                let ring = placements[if land.race == Race::Inner { 0 } else { 1 }];
                for (side, place) in [-0.5, 0.5].into_iter().zip(places) {
                    let edge = Placement { centre: at.centre + side * land.width * at.axes[2], ..ring };
                    self.place(place, &edge);
                }
            }
        }
        let Self { world, parts, .. } = self;
        world.detect_collisions(&Pairs(parts), &());
        let mut found: Vec<Proximity> = Vec::new();
        for pair in world.contact_pairs() {
            let part = |handle: ColliderHandle| parts[world.colliders[handle].user_data as usize];
            let mut pair_parts = [part(pair.collider1), part(pair.collider2)];
            // The first body's force is along −normal of rapier, which points from the first to the second.
            let turned = pair_parts[0] > pair_parts[1];
            if turned {
                pair_parts.swap(0, 1);
            }
            for manifold in pair.manifolds() {
                let n = manifold.data.normal;
                let normal = Vector3::new(n.x, n.y, n.z) * if turned { 1.0 } else { -1.0 };
                found.extend(manifold.points.iter().map(|point| Proximity {
                    parts: pair_parts,
                    approach: Approach { normal, depth: -point.dist },
                }));
            }
        }
        found.sort_by(|a, b| a.parts.cmp(&b.parts).then(a.approach.depth.total_cmp(&b.approach.depth)));
        found
    }
}

/// Overlaps of balls, rings and cage in a state, by shapes: the check of a run's start.
///
/// `race_allowance` \[m\]: permitted elastic approach of balls and races.
pub fn overlaps(
    balls: &FreeBalls,
    state: &FreeBallState,
    rings: &[RingState; 2],
    race_allowance: f64,
) -> Vec<Overlap> {
    let solid = |part: ContactPart| match part {
        ContactPart::Ball(j) => Part::Ball(j),
        ContactPart::Pocket(j) => Part::Pocket(j),
        ContactPart::CageEdge(_) => Part::Cage,
        ContactPart::InnerRace | ContactPart::InnerLand => Part::InnerRing,
        ContactPart::OuterRace | ContactPart::OuterLand => Part::OuterRing,
    };
    let found = BodyCollisions::new(balls, 0.0).detect(state, rings);
    let overlap = |Proximity { parts, approach }: &Proximity| {
        let is_race = matches!(parts[1], ContactPart::InnerRace | ContactPart::OuterRace);
        // Round-off of touching parts (1e-15 m) is no overlap.
        let allowed = if is_race { race_allowance } else { 1e-12 };
        (approach.depth > allowed).then(|| Overlap {
            first: solid(parts[0]),
            second: solid(parts[1]),
            depth: approach.depth,
        })
    };
    found.iter().filter_map(overlap).collect()
}

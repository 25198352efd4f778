//! Free balls and cage of one bearing as rigid bodies in rapier: reference for the kinematic cage model.
//!
//! rapier integrates the bodies (symplectic Euler) and detects the contacts; the contact forces are computed
//! here (Hertz and traction at the races, a stiff spring at the pockets), since those of rapier are not an
//! elastic law.

use nalgebra::{Point3, Vector3};
use rapier3d_f64::geometry::{ContactPair, Group, InteractionGroups, InteractionTestMode};
use rapier3d_f64::math::Vector;
use rapier3d_f64::pipeline::PhysicsWorld;
use rapier3d_f64::prelude::{
    ColliderBuilder, ColliderHandle, ColliderSet, RigidBody, RigidBodyBuilder, RigidBodyHandle, SharedShape,
};

use crate::geometry::BearingShapes;
use crate::geometry::parry::{ExactShape, vector};
use rotordyn_bearing::BallBearing;
use rotordyn_bearing::contact::{HertzPair, Traction};

/// Settings of a free-ball simulation.
#[derive(Clone, Debug, PartialEq)]
pub struct FreeBallSettings {
    /// Time step \[s\]; stable below about 2 √(m / (k_i + k_o)) of a ball between its contacts.
    pub step: f64,
    /// Speed Ω of the inner ring about z \[rad/s\].
    pub speed: f64,
    /// Prescribed constant displacement of the inner ring from the centre \[m\].
    pub displacement: [f64; 3],
    pub gravity: [f64; 3],
    /// Traction at the races.
    pub traction: Traction,
    /// Whether there is a cage; its pockets are frictionless.
    pub cage: bool,
    /// Stiffness \[N/m\] and damping \[N s/m\] of the ball-pocket and ball-ball contacts.
    pub pocket: [f64; 2],
    /// Damping of the contacts of ball and race \[N s/m\].
    pub race_damping: f64,
}

/// One bearing with free balls: outer ring at rest, inner ring at constant speed, balls and cage free.
pub struct FreeBallBearing {
    world: PhysicsWorld,
    balls: Vec<RigidBodyHandle>,
    cage: Option<RigidBodyHandle>,
    inner: ColliderHandle,
    outer: ColliderHandle,
    contacts: HertzPair,
    settings: FreeBallSettings,
}

/// One contact detected by rapier.
struct DetectedContact {
    bodies: [RigidBodyHandle; 2],
    colliders: [ColliderHandle; 2],
    point: Vector,
    /// Unit normal from the first body to the second.
    normal: Vector,
    depth: f64,
}

impl FreeBallBearing {
    /// The bearing with balls and cage at rest, evenly spaced from the bearing's cage angle.
    pub fn new(bearing: &BallBearing, settings: FreeBallSettings) -> Self {
        let g = &bearing.geometry;
        let shapes = BearingShapes::new(g, bearing.cage_pocket_diameter);
        let at = shapes.centred(bearing.cage_angle);
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::from_array(settings.gravity);
        let p = &mut world.integration_parameters;
        p.dt = settings.step;
        // More solver iterations would keep the applied forces constant over substeps: unstable with stiff
        // contacts.
        p.num_solver_iterations = 1;
        // Recycled and clustered contacts would be out of date by about 1e-4 m.
        p.contact_recycling = false;
        p.contact_clustering = false;
        // Only penetrating contacts carry force.
        p.normalized_prediction_distance = 1e-6;
        p.normalized_max_linear_velocity = f64::MAX;

        let balls_group = InteractionGroups::new(Group::GROUP_1, Group::ALL, InteractionTestMode::And);
        let rings_group = InteractionGroups::new(Group::GROUP_2, Group::GROUP_1, InteractionTestMode::And);
        let collider = |shape: SharedShape, density: f64, groups: InteractionGroups| {
            ColliderBuilder::new(shape)
                .density(density)
                .collision_groups(groups)
                .solver_groups(InteractionGroups::none())
        };
        let ring_density = bearing.ring_material.density;
        let (_, outer) = world.insert(
            RigidBodyBuilder::fixed(),
            collider(SharedShape::new(ExactShape(shapes.outer)), ring_density, rings_group),
        );
        let inner_ring = RigidBodyBuilder::kinematic_velocity_based()
            .translation(Vector::from_array(settings.displacement))
            .angvel(Vector::new(0.0, 0.0, settings.speed));
        let (_, inner) = world.insert(
            inner_ring,
            collider(SharedShape::new(ExactShape(shapes.inner)), ring_density, rings_group),
        );
        let ball = SharedShape::ball(0.5 * g.ball_diameter);
        let balls = at
            .balls
            .iter()
            .map(|centre| {
                let body = RigidBodyBuilder::dynamic().translation(vector(&centre.coords)).can_sleep(false);
                world.insert(body, collider(ball.clone(), bearing.ball_material.density, balls_group)).0
            })
            .collect();
        let cage = settings.cage.then(|| {
            let body = RigidBodyBuilder::dynamic()
                .rotation(Vector::new(0.0, 0.0, bearing.cage_angle))
                .enabled_translations(false, false, false)
                .enabled_rotations(false, false, true)
                .can_sleep(false);
            world
                .insert(body, collider(SharedShape::new(ExactShape(shapes.cage)), ring_density, rings_group))
                .0
        });
        Self { world, balls, cage, inner, outer, contacts: bearing.hertz(), settings }
    }

    /// Advances by whole steps.
    pub fn run(&mut self, steps: usize) {
        for _ in 0..steps {
            self.world.detect_collisions(&(), &());
            let contacts: Vec<DetectedContact> = self
                .world
                .contact_pairs()
                .flat_map(|pair| penetrating_contacts(pair, &self.world.colliders))
                .collect();
            for (_, body) in self.world.bodies.iter_mut() {
                body.reset_forces(false);
                body.reset_torques(false);
            }
            for touch in &contacts {
                self.apply_contact_force(touch);
            }
            self.world.step();
        }
    }

    fn apply_contact_force(&mut self, touch: &DetectedContact) {
        let velocity = |k: usize| {
            let body = &self.world.bodies[touch.bodies[k]];
            body.velocity_at_point(touch.point)
        };
        let slip = velocity(1) - velocity(0);
        let approach = -slip.dot(touch.normal);
        let depth = touch.depth;
        let race = if touch.colliders.contains(&self.inner) {
            Some(self.contacts.inner.stiffness)
        } else if touch.colliders.contains(&self.outer) {
            Some(self.contacts.outer.stiffness)
        } else {
            None
        };
        // Damping causes no tensile contact force.
        let (load, traction) = match race {
            Some(stiffness) => {
                let load =
                    (stiffness * depth * depth.sqrt() + self.settings.race_damping * approach).max(0.0);
                let along = slip - touch.normal * slip.dot(touch.normal);
                let force = self.settings.traction.force(load, &Vector3::new(along.x, along.y, along.z));
                (load, vector(&force))
            }
            None => {
                let [stiffness, damping] = self.settings.pocket;
                ((stiffness * depth + damping * approach).max(0.0), Vector::ZERO)
            }
        };
        let force = touch.normal * load + traction;
        self.world.bodies[touch.bodies[1]].add_force_at_point(force, touch.point, false);
        self.world.bodies[touch.bodies[0]].add_force_at_point(-force, touch.point, false);
    }

    /// Centre of a ball \[m\].
    pub fn ball_centre(&self, ball: usize) -> Point3<f64> {
        let p = self.body(self.balls[ball]).translation();
        Point3::new(p.x, p.y, p.z)
    }

    /// Orbital speed of a ball about the bearing's axis \[rad/s\].
    pub fn orbital_speed(&self, ball: usize) -> f64 {
        let body = self.body(self.balls[ball]);
        let (p, v) = (body.translation(), body.linvel());
        (p.x * v.y - p.y * v.x) / (p.x * p.x + p.y * p.y)
    }

    /// Angle ψ of the cage in (−π, π] and its speed ψ̇ \[rad, rad/s\]; `None` without a cage.
    pub fn cage(&self) -> Option<[f64; 2]> {
        self.cage.map(|handle| {
            let body = self.body(handle);
            let x = *body.rotation() * Vector::X;
            [x.y.atan2(x.x), body.angvel().z]
        })
    }

    fn body(&self, handle: RigidBodyHandle) -> &RigidBody {
        &self.world.bodies[handle]
    }
}

/// The penetrating contacts of a pair; the point is midway between the two surfaces.
fn penetrating_contacts(pair: &ContactPair, colliders: &ColliderSet) -> Vec<DetectedContact> {
    let mut found = vec![];
    let handles = [pair.collider1, pair.collider2];
    let poses = handles.map(|handle| *colliders[handle].position());
    for manifold in pair.manifolds() {
        let (Some(first), Some(second)) = (manifold.data.rigid_body1, manifold.data.rigid_body2) else {
            continue;
        };
        for contact in manifold.points.iter().filter(|c| c.dist < 0.0) {
            let ends = [poses[0] * contact.local_p1, poses[1] * contact.local_p2];
            found.push(DetectedContact {
                bodies: [first, second],
                colliders: handles,
                point: (ends[0] + ends[1]) * 0.5,
                normal: manifold.data.normal,
                depth: -contact.dist,
            });
        }
    }
    found
}

//! rapier's integration of free bodies against closed forms, beside that of the free balls.

use crate::agree;
use crate::free_balls::{ball_bearing, free, geometry_6205, plastic_cage};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use rapier3d_f64::math::{Rotation, Vector};
use rapier3d_f64::pipeline::PhysicsWorld;
use rapier3d_f64::prelude::{MassProperties, RigidBodyBuilder};
use rotordyn::bearing::free_ball::{
    BallBody, CageBody, FreeBallState, FreeBalls, Guidance, Pocket, RingState, SlipModel,
};

type V = Vector3<f64>;

const GRAVITY: f64 = 9.80665;

fn world(step: f64, gravity: f64) -> PhysicsWorld {
    let mut world = PhysicsWorld::new();
    world.gravity = Vector::new(0.0, -gravity, 0.0);
    let p = &mut world.integration_parameters;
    p.dt = step;
    p.num_solver_iterations = 1;
    p.normalized_max_linear_velocity = f64::MAX;
    world
}

/// Order by which an error falls from the first to the last step, each half the one before.
fn order(errors: &[f64]) -> f64 {
    (errors[0] / errors[errors.len() - 1]).log2() / (errors.len() - 1) as f64
}

/// Free fall over T: rapier's is ½ g T h too long, of first order; the free balls' is exact to rounding.
#[test]
fn free_fall_of_rapier_is_of_first_order() {
    let (duration, height) = (4e-3, 0.5 * GRAVITY * 4e-3 * 4e-3);
    let steps = [8e-6, 4e-6, 2e-6, 1e-6];
    let errors = steps.map(|step| {
        let mut world = world(step, GRAVITY);
        let ball = MassProperties::new(Vector::ZERO, 2e-3, Vector::splat(1.3e-8));
        let body = RigidBodyBuilder::dynamic().additional_mass_properties(ball).can_sleep(false);
        let body = world.insert_body(body);
        for _ in 0..(duration / step).round() as usize {
            world.step();
        }
        (world.bodies[body].translation().y + height).abs()
    });
    // A clearance of 1 mm: 78 um of fall touch nothing.
    let balls = FreeBalls::new(free(ball_bearing(geometry_6205(1, 1e-3)), 0.0, 1e-2, SlipModel::Centre), 0.0);
    let mut bearing = balls.unwrap().bearing().clone();
    bearing.gravity = [0.0, -GRAVITY, 0.0];
    let balls = FreeBalls::new(bearing, 0.0).unwrap();
    let ball = BallBody { position: V::new(19.25e-3, 0.0, 0.0), ..BallBody::default() };
    let mut state = FreeBallState::new(&[ball], None);
    let rest = [RingState::default(); 2];
    balls.advance(&mut state, [&rest, &rest], duration, 8e-6).unwrap();
    let own = state.ball(0).position.y + height;
    println!("rapier {errors:?} m, order {:.3}; free balls {own:.1e} m", order(&errors));
    for (error, step) in errors.iter().zip(steps) {
        agree::relative(
            "error of semi-implicit Euler in free fall [m]",
            *error,
            0.5 * GRAVITY * duration * step,
            1e-3,
        );
    }
    agree::absolute("order of semi-implicit Euler", order(&errors), 1.0, 1e-3);
    agree::absolute("free fall by our integrator, off the parabola [m]", own, 0.0, 1e-17);
}

/// Orientation of a symmetric top without moment: precession |L|/I_t about L, then its own spin L·a (1/I_p − 1/I_t).
fn top(inertia: [f64; 2], rotation: V, time: f64) -> UnitQuaternion<f64> {
    let [polar, transverse] = inertia;
    let momentum = V::new(transverse * rotation.x, transverse * rotation.y, polar * rotation.z);
    let precession = momentum * (time / transverse);
    let spin = momentum.z * (1.0 / polar - 1.0 / transverse) * time;
    UnitQuaternion::from_scaled_axis(precession) * UnitQuaternion::from_scaled_axis(V::z() * spin)
}

/// The cage of a 6205 at 20000 rpm, tilting freely: rapier's orientation is of first order and its angular momentum drifts;
/// the free cage's is of fourth order and its angular momentum exact.
#[test]
fn rotation_of_a_free_cage_by_rapier_is_of_first_order() {
    let mut cage = plastic_cage(Pocket::Cylindrical, Guidance::Balls, 0.0);
    cage.pocket_diameter = 14e-3;
    let inertia = [cage.polar_inertia, cage.transverse_inertia];
    let rotation = V::new(50.0, 0.0, 830.0);
    let duration = 4e-3;
    let exact = top(inertia, rotation, duration);
    let steps = [16e-6, 8e-6, 4e-6, 2e-6];

    let mut drift = 0.0;
    let rapier = steps.map(|step| {
        let mut world = world(step, 0.0);
        let [polar, transverse] = inertia;
        let mass = MassProperties::new(Vector::ZERO, cage.mass, Vector::new(transverse, transverse, polar));
        let body = RigidBodyBuilder::dynamic()
            .additional_mass_properties(mass)
            .angvel(Vector::new(rotation.x, rotation.y, rotation.z))
            .can_sleep(false);
        let body = world.insert_body(body);
        world.bodies[body].enable_gyroscopic_forces(true);
        for _ in 0..(duration / step).round() as usize {
            world.step();
        }
        let body = &world.bodies[body];
        let q: Rotation = *body.rotation();
        let turned = UnitQuaternion::from_quaternion(Quaternion::new(q.w, q.x, q.y, q.z));
        let w = body.angvel();
        let own_axes = turned.inverse() * V::new(w.x, w.y, w.z);
        let momentum = turned * V::new(transverse * own_axes.x, transverse * own_axes.y, polar * own_axes.z);
        let start = V::new(transverse * rotation.x, 0.0, polar * rotation.z);
        drift = (momentum - start).norm() / start.norm();
        turned.angle_to(&exact)
    });

    // One ball, coasting without friction between the races, in a pocket that the cage does not reach.
    let mut bearing = free(ball_bearing(geometry_6205(1, -4e-6)), 0.0, 1e-2, SlipModel::Centre);
    bearing.cage = Some(cage);
    let balls = FreeBalls::new(bearing, 0.0).unwrap();
    let rest = [RingState::default(); 2];
    let rolling = balls.initial_state(&[RingState::rotating(2094.0, 0.0), RingState::default()]).unwrap();
    let momentum = V::new(inertia[1] * rotation.x, 0.0, inertia[0] * rotation.z);
    let body = CageBody { momentum, ..CageBody::rotating(V::zeros(), V::zeros(), 0.0, 0.0, inertia[0]) };
    let mut kept = 0.0;
    let own = steps[1..].iter().map(|step| {
        let mut state = FreeBallState::new(&[rolling.ball(0)], Some(&body));
        balls.advance(&mut state, [&rest, &rest], duration, *step).unwrap();
        let cage = state.cage().unwrap();
        kept = (cage.momentum - momentum).norm() / momentum.norm();
        let [w, x, y, z] = cage.orientation;
        UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)).angle_to(&exact)
    });
    let own: Vec<f64> = own.collect();
    println!("rapier {rapier:?} rad, order {:.2}, momentum {drift:.1e}", order(&rapier));
    println!("free cage {own:?} rad, order {:.2}, momentum {kept:.1e}", order(&own));
    agree::absolute("order of semi-implicit Euler on a spring", order(&rapier), 1.0, 0.1);
    assert!(drift > 1e-7);
    agree::curve("error of our Runge-Kutta over that of rapier", own[0], rapier[1], 1e-6);
    assert!(order(&own) > 3.8 && kept == 0.0);
}

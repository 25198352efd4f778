//! Balls with inertia compared with vector Newton-Euler equations, independent of the element's equations:
//! ball spin by raceway control, gyroscopic moment, the friction force that balances it, centrifugal force,
//! and the ring reaction.

use crate::agree;
use crate::bearing::rig_6205;
use nalgebra::Vector3;
use rotordyn_bearing::contact::ContactDamping;
use rotordyn_bearing::{BallBearing, BallElement, BallInertia, BallLoad, Rotation};

type V = Vector3<f64>;

/// Raceway control: the race relative to which the ball has no spin about the contact normal.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Control {
    Outer,
    Inner,
}

/// Angular-contact bearing; thrust −1 reverses the contact angle.
fn bearing(control: Control, thrust: f64) -> BallBearing {
    let mut bearing = rig_6205();
    bearing.geometry.contact_angle = 0.4;
    bearing.geometry.radial_clearance = 0.0;
    bearing.geometry.thrust_direction = thrust;
    bearing.inertia = match control {
        Control::Outer => BallInertia::OuterRaceControl,
        Control::Inner => BallInertia::InnerRaceControl,
    };
    // Without damping the cage speed adds no force.
    bearing.damping = ContactDamping::Constant { coefficient: 0.0, ramp: 1e-6 };
    bearing
}

/// Forces on a ball from the vector equations, in axes e_r, e_t, e_z at the ball.
struct BallForces {
    /// Friction of the controlling race on the ball \[N\].
    friction: V,
    /// Force of the inner race on the ball \[N\].
    by_inner: V,
    /// Residual of Newton's law m a − Σ F \[N\]; 0 at equilibrium.
    residual: V,
    /// Centrifugal force \[N\].
    centrifugal_force: f64,
}

/// Contact normal in the axial plane of the ball: from the ball centre to the outer contact, or from the
/// inner contact to the ball centre.
fn normal(angle: f64) -> V {
    V::new(angle.cos(), 0.0, angle.sin())
}

fn newton_euler(bearing: &BallBearing, ball: &BallLoad, control: Control, rotation: &Rotation) -> BallForces {
    let (d, pitch) = (bearing.geometry.ball_diameter, bearing.geometry.pitch_diameter);
    let mass = bearing.ball_material.density * std::f64::consts::PI / 6.0 * d.powi(3);
    let inertia = 0.4 * mass * (0.5 * d).powi(2);
    let axis = V::new(0.0, 0.0, 1.0);
    let (cage, shaft) = (axis * rotation.cage_speed.unwrap(), axis * rotation.shaft_speed);
    let centre = V::new(0.5 * pitch, 0.0, 0.0);
    let (inner, outer) = (normal(ball.contact_angle), normal(ball.outer_contact_angle));

    // No slip and no spin relative to the race of angular velocity `race`, at the contact point `arm` from
    // the ball centre: ω' = ω − race satisfies ω' × arm = v, ω' · arm = 0.
    let (arm, race) = match control {
        Control::Outer => (outer * (0.5 * d), V::zeros()),
        Control::Inner => (inner * (-0.5 * d), shaft),
    };
    let slip = race.cross(&centre) - cage.cross(&centre);
    let relative = arm.cross(&slip) / arm.norm_squared();
    agree::curve("slip at the controlling race", (relative.cross(&arm) - slip).norm(), slip.norm(), 1e-12);
    let spin = race + relative;

    // Steady motion in axes rotating with the cage: dL/dt = ω_c × L; no moment along e_t from the cage
    // pockets.
    let rate = cage.cross(&(spin * inertia));
    // Friction force F at `arm`, tangential, in the axial plane: arm × F = rate.
    let friction = rate.cross(&arm) / arm.norm_squared();
    agree::curve("moment of the friction force", (arm.cross(&friction) - rate).norm(), rate.norm(), 1e-12);

    let (mut by_inner, mut by_outer) = (inner * ball.load, -outer * ball.outer_load);
    match control {
        Control::Outer => by_outer += friction,
        Control::Inner => by_inner += friction,
    }
    let acceleration = cage.cross(&cage.cross(&centre));
    BallForces {
        friction,
        by_inner,
        residual: acceleration * mass - by_inner - by_outer,
        centrifugal_force: (acceleration * mass).norm(),
    }
}

fn for_each_case(mut visit: impl FnMut(Control, f64, &BallBearing, &[f64; 6], &Rotation)) {
    // Axial displacement with some radial displacement and tilt: every ball is in contact with both races,
    // with an inner load above the centrifugal force.
    let d = [6e-6, -4e-6, 60e-6, 2e-4, -1e-4, 0.0];
    for control in [Control::Outer, Control::Inner] {
        for thrust in [1.0, -1.0] {
            for speed in [3000.0, -3000.0] {
                let bearing = bearing(control, thrust);
                let d = [d[0], d[1], thrust * d[2], d[3], d[4], 0.0];
                let rotation = Rotation {
                    cage_angle: 0.3,
                    cage_speed: Some(0.4 * speed),
                    shaft_speed: speed,
                    ..Rotation::default()
                };
                visit(control, thrust, &bearing, &d, &rotation);
            }
        }
    }
}

#[test]
fn ball_loads_satisfy_newton_euler_equations() {
    for_each_case(|control, thrust, bearing, d, rotation| {
        let element = BallElement::new(bearing);
        for ball in element.ball_loads(d, rotation) {
            let forces = newton_euler(bearing, &ball, control, rotation);
            assert!(ball.load > forces.centrifugal_force, "inner load below the centrifugal force: {ball:?}");
            assert!(ball.contact_angle * thrust > 0.1 && ball.outer_contact_angle * thrust > 0.1);
            // Friction exceeds 2 N; the residual is round-off of loads of 1e3 N through the contact angles.
            assert!(forces.friction.norm() > 2.0, "{}", forces.friction);
            let in_plane = forces.residual - V::new(0.0, forces.residual[1], 0.0);
            let what = format_args!("{control:?} thrust {thrust}: force not balanced [N]");
            agree::absolute(what, in_plane.norm(), 0.0, 1e-9);
        }
    });
}

/// The ball force on the inner ring acts at their contact, a groove radius from the groove centre.
#[test]
fn inner_ring_reaction_is_sum_of_contact_forces() {
    for_each_case(|control, thrust, bearing, d, rotation| {
        let element = BallElement::new(bearing);
        let (mut force, mut moment, mut friction_moment, mut size) = (V::zeros(), V::zeros(), 0.0_f64, 0.0);
        for ball in element.ball_loads(d, rotation) {
            let forces = newton_euler(bearing, &ball, control, rotation);
            let (sin, cos) = ball.position.sin_cos();
            let to_fixed_axes = |v: V| V::new(v[0] * cos - v[1] * sin, v[0] * sin + v[1] * cos, v[2]);
            let from_groove = normal(ball.contact_angle) * -bearing.geometry.inner_groove_radius;
            let contact = V::new(bearing.geometry.inner_centre_radius(), 0.0, 0.0) + from_groove;
            let on_ring = to_fixed_axes(-forces.by_inner);
            force += on_ring;
            moment += to_fixed_axes(contact).cross(&on_ring);
            friction_moment = friction_moment.max(from_groove.cross(&forces.by_inner).norm());
            size += forces.by_inner.norm();
        }
        let found = element.reaction(d, &[0.0; 6], rotation).force;
        // Round-off of the sum of all loads, moments with an arm of 20 mm.
        for k in 0..3 {
            let off = (found[k] - force[k]).abs();
            agree::curve(format_args!("{control:?} thrust {thrust}: force {k}"), off, size, 1e-13);
        }
        for k in 0..2 {
            let off = (found[3 + k] - moment[k]).abs();
            agree::curve(format_args!("{control:?} thrust {thrust}: moment {k}"), off, size, 1e-14);
        }
        // The line of action of the normal load passes through the groove centre, that of friction does not.
        assert_eq!(friction_moment > 5e-3, control == Control::Inner, "{friction_moment} N m");
    });
}

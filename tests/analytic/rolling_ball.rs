//! A ball with inertia by Newton and Euler with vectors: its rotation from rolling, the rate of its angular momentum,
//! the friction that makes it, and the ring that takes both. None of it knows the element's equations.

use crate::bearing::rig_6205;
use nalgebra::Vector3;
use rotordyn::bearing::{BallBearing, BallElement, BallInertia, BallLoad, Rotation};
use rotordyn::contact::ContactDamping;

type V = Vector3<f64>;

/// The race on which the ball does not spin.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Control {
    Outer,
    Inner,
}

/// A bearing at a contact angle; thrust −1 turns the contact lines round.
fn bearing(control: Control, thrust: f64) -> BallBearing {
    let mut bearing = rig_6205();
    bearing.geometry.contact_angle = 0.4;
    bearing.geometry.radial_clearance = 0.0;
    bearing.geometry.thrust_direction = thrust;
    bearing.inertia = match control {
        Control::Outer => BallInertia::OuterRaceControl,
        Control::Inner => BallInertia::InnerRaceControl,
    };
    // Without damping the turning cage adds no force.
    bearing.damping = ContactDamping::Constant { coefficient: 0.0, ramp: 1e-6 };
    bearing
}

/// A ball's forces by hand, in axes e_r, e_t, e_z at the ball.
struct Ball {
    /// Friction of the controlling race on the ball \[N\].
    friction: V,
    /// Force of the inner race on the ball, and where it acts, seen from the ball's centre.
    by_inner: V,
    /// m a less all forces: 0 when the loads are right \[N\].
    left: V,
    /// Centrifugal force \[N\].
    flung: f64,
}

/// Direction in the plane of axis and ball from the ball's centre to the outer contact, or from the inner contact to it.
fn normal(angle: f64) -> V {
    V::new(angle.cos(), 0.0, angle.sin())
}

fn by_hand(bearing: &BallBearing, ball: &BallLoad, control: Control, rotation: &Rotation) -> Ball {
    let (d, pitch) = (bearing.geometry.ball_diameter, bearing.geometry.pitch_diameter);
    let mass = bearing.ball_material.density * std::f64::consts::PI / 6.0 * d.powi(3);
    let inertia = 0.4 * mass * (0.5 * d).powi(2);
    let axis = V::new(0.0, 0.0, 1.0);
    let (cage, shaft) = (axis * rotation.cage_speed, axis * rotation.shaft_speed);
    let centre = V::new(0.5 * pitch, 0.0, 0.0);
    let (inner, outer) = (normal(ball.contact_angle), normal(ball.outer_contact_angle));

    // The race turns at `race`; the ball's point at `arm` from its centre moves with it, and the ball does not turn
    // about the contact's normal relative to it: ω' = ω − race satisfies ω' × arm = v, ω' · arm = 0.
    let (arm, race) = match control {
        Control::Outer => (outer * (0.5 * d), V::zeros()),
        Control::Inner => (inner * (-0.5 * d), shaft),
    };
    let slip = race.cross(&centre) - cage.cross(&centre);
    let relative = arm.cross(&slip) / arm.norm_squared();
    assert!((relative.cross(&arm) - slip).norm() < 1e-12 * slip.norm());
    let spin = race + relative;

    // Steady in axes that turn with the cage: dL/dt = Ω × L, of which the cage pockets take nothing along e_t.
    let rate = cage.cross(&(spin * inertia));
    // A force F at `arm`, across the normal and in the plane of axis and ball: arm × F = rate.
    let friction = rate.cross(&arm) / arm.norm_squared();
    assert!((arm.cross(&friction) - rate).norm() < 1e-12 * rate.norm());

    let (mut by_inner, mut by_outer) = (inner * ball.load, -outer * ball.outer_load);
    match control {
        Control::Outer => by_outer += friction,
        Control::Inner => by_inner += friction,
    }
    let acceleration = cage.cross(&cage.cross(&centre));
    Ball {
        friction,
        by_inner,
        left: acceleration * mass - by_inner - by_outer,
        flung: (acceleration * mass).norm(),
    }
}

fn each(mut visit: impl FnMut(Control, f64, &BallBearing, &[f64; 6], &Rotation)) {
    // Thrust with some radial load and tilt: every ball keeps both contacts, more on the inner one than F_c.
    let d = [6e-6, -4e-6, 60e-6, 2e-4, -1e-4, 0.0];
    for control in [Control::Outer, Control::Inner] {
        for thrust in [1.0, -1.0] {
            for speed in [3000.0, -3000.0] {
                let bearing = bearing(control, thrust);
                let d = [d[0], d[1], thrust * d[2], d[3], d[4], 0.0];
                let rotation = Rotation {
                    cage_angle: 0.3,
                    cage_speed: 0.4 * speed,
                    shaft_speed: speed,
                    ..Rotation::default()
                };
                visit(control, thrust, &bearing, &d, &rotation);
            }
        }
    }
}

#[test]
fn forces_on_a_ball_are_mass_times_acceleration() {
    each(|control, thrust, bearing, d, rotation| {
        let element = BallElement::new(bearing);
        for ball in element.ball_loads(d, rotation) {
            let hand = by_hand(bearing, &ball, control, rotation);
            assert!(ball.load > hand.flung, "inner control is whole only above F_c: {ball:?}");
            assert!(ball.contact_angle * thrust > 0.1 && ball.outer_contact_angle * thrust > 0.1);
            // The friction at stake is 2 N and more; what is left is round-off of loads of 1e3 N through angles.
            assert!(hand.friction.norm() > 2.0, "{}", hand.friction);
            let along = hand.left - V::new(0.0, hand.left[1], 0.0);
            assert!(along.norm() < 1e-9, "{control:?} {thrust}: {} N left of {}", along.norm(), hand.flung);
        }
    });
}

/// What the ball does to the inner ring acts at their contact, a groove's radius from the groove's centre.
#[test]
fn the_ring_takes_the_forces_at_its_contacts() {
    each(|control, thrust, bearing, d, rotation| {
        let element = BallElement::new(bearing);
        let (mut force, mut moment, mut own, mut size) = (V::zeros(), V::zeros(), 0.0_f64, 0.0);
        for ball in element.ball_loads(d, rotation) {
            let hand = by_hand(bearing, &ball, control, rotation);
            let (sin, cos) = ball.position.sin_cos();
            let turned = |v: V| V::new(v[0] * cos - v[1] * sin, v[0] * sin + v[1] * cos, v[2]);
            let from_groove = normal(ball.contact_angle) * -bearing.geometry.inner_groove_radius;
            let contact = V::new(bearing.geometry.inner_centre_radius(), 0.0, 0.0) + from_groove;
            let on_ring = turned(-hand.by_inner);
            force += on_ring;
            moment += turned(contact).cross(&on_ring);
            own = own.max(from_groove.cross(&hand.by_inner).norm());
            size += hand.by_inner.norm();
        }
        let found = element.reaction(d, &[0.0; 6], rotation).force;
        // Round-off of all loads together, at a lever of 20 mm.
        for k in 0..3 {
            let off = (found[k] - force[k]).abs();
            assert!(off < 1e-13 * size, "{control:?} {thrust} force {k}: {} {}", found[k], force[k]);
        }
        for k in 0..2 {
            let off = (found[3 + k] - moment[k]).abs();
            assert!(off < 1e-14 * size, "{control:?} {thrust} moment {k}: {} {}", found[3 + k], moment[k]);
        }
        // The load goes through the groove's centre; friction at the inner race does not.
        assert_eq!(own > 5e-3, control == Control::Inner, "{own} N m");
    });
}

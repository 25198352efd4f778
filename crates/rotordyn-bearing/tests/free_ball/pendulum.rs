//! One ball in the outer groove under gravity: period of its swing, energy.

use crate::bearings::{ball_bearing, free, geometry_6205, off};
use rotordyn_bearing::free_ball::{BallBody, FreeBallState, FreeBalls, RingState, SlipModel};

type V = nalgebra::Vector3<f64>;

const G: f64 = 9.80665;
/// Amplitude \[rad\].
const SWING: f64 = 0.05;

/// One ball that rests at the outer groove, turned by [`SWING`] from its lowest place, 1 mm of clearance.
struct Pendulum {
    balls: FreeBalls,
    state: FreeBallState,
    rings: [RingState; 2],
    /// Orbit radius of the ball centre \[m\].
    radius: f64,
}

fn pendulum(friction: f64, slip_speed: f64, swing: f64) -> Pendulum {
    let mut bearing = free(ball_bearing(geometry_6205(1, 1e-3)), friction, slip_speed, SlipModel::Centre);
    bearing.gravity = [0.0, -G, 0.0];
    let hertz = bearing.ball.hertz();
    let g = bearing.ball.geometry.clone();
    let balls = FreeBalls::new(bearing, 0.0).unwrap();
    let [mass, _] = balls.ball_inertia(0);
    let depth = |load: f64| (load / hertz.outer.stiffness).powf(2.0 / 3.0);
    // Lowest point of the groove at D_pw/2 + P_d/4 from the axis, less than the ball's radius.
    let radius = 0.5 * g.pitch_diameter + 0.25 * g.radial_clearance + depth(mass * G);
    let start = radius - depth(mass * G) + depth(mass * G * swing.cos());
    let body =
        BallBody { position: V::new(start * swing.sin(), -start * swing.cos(), 0.0), ..BallBody::default() };
    Pendulum { balls, state: FreeBallState::new(&[body], None), rings: Default::default(), radius }
}

/// Mean period over a number of full swings, from the zeros of the horizontal position.
fn period(pendulum: &mut Pendulum, swings: usize, step: f64) -> f64 {
    let mut crossings = Vec::new();
    let interval = 40.0 * step;
    while crossings.len() < 2 * swings + 1 {
        let (x, t) = (pendulum.state.ball(0).position.x, pendulum.state.time);
        let slope = pendulum.state.ball(0).velocity.x;
        pendulum.balls.advance(&mut pendulum.state, [&pendulum.rings; 2], interval, step).unwrap();
        let after = pendulum.state.ball(0);
        if x.signum() != after.position.x.signum() {
            // Root of the cubic through both ends with their slopes.
            let (mut low, mut high) = (0.0, 1.0);
            let (a, b) =
                (slope * interval - after.position.x + x, after.position.x - x - after.velocity.x * interval);
            let value = |s: f64| x + s * (after.position.x - x + (1.0 - s) * ((1.0 - s) * a + s * b));
            for _ in 0..60 {
                let middle: f64 = 0.5 * (low + high);
                if value(middle).signum() == x.signum() { low = middle } else { high = middle }
            }
            crossings.push(t + low * interval);
        }
    }
    (crossings[2 * swings] - crossings[0]) / swings as f64
}

/// 2π √(r/g) (1 + θ²/16), to 1e-6: a race of which both sides pressed would touch the ball from inside, with 1 mm of
/// clearance by 0.7 %.
#[test]
fn sliding_ball_swings_like_a_mathematical_pendulum() {
    let mut it = pendulum(0.0, 1e-3, SWING);
    let expected = std::f64::consts::TAU * (it.radius / G).sqrt() * (1.0 + SWING * SWING / 16.0);
    let found = period(&mut it, 3, 5e-6);
    println!("sliding period {found:.9} s, closed form {expected:.9} s, off {:.2e}", found / expected - 1.0);
    assert!(off(found, expected) < 1e-6);
}

/// √(7/5) longer, to 1e-5 at v₀ = 1e-4 m/s: the friction turns the ball, the creep it needs is below v₀.
#[test]
fn rolling_ball_swings_longer() {
    let mut it = pendulum(0.3, 1e-4, SWING);
    let expected = std::f64::consts::TAU * (1.4 * it.radius / G).sqrt() * (1.0 + SWING * SWING / 16.0);
    let found = period(&mut it, 3, 5e-6);
    println!("rolling period {found:.9} s, closed form {expected:.9} s, off {:.2e}", found / expected - 1.0);
    assert!(off(found, expected) < 1e-5);
}

/// Without friction the energy of the swing stays within 1e-9 of it over 10 s.
#[test]
fn sliding_swing_keeps_its_energy() {
    let mut it = pendulum(0.0, 1e-3, SWING);
    let [mass, _] = it.balls.ball_inertia(0);
    let swing = mass * G * it.radius * (1.0 - SWING.cos());
    let start = it.balls.energy(&it.state, &it.rings).total();
    let mut worst = 0.0_f64;
    for _ in 0..100 {
        it.balls.advance(&mut it.state, [&it.rings; 2], 0.1, 1e-5).unwrap();
        worst = worst.max((it.balls.energy(&it.state, &it.rings).total() - start).abs());
    }
    println!("energy of the swing {swing:.3e} J, largest drift {:.2e} of it", worst / swing);
    assert!(worst < 1e-9 * swing);
}

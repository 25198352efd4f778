//! Gross sliding: balls that a suddenly turning inner ring accelerates, a cage held back by drag.

use crate::bearings::{ball_bearing, free, geometry_6205, off, plastic_cage, rings, rpm};
use rotordyn_bearing::contact::HertzPair;
use rotordyn_bearing::free_ball::{BallBody, Drag, FreeBallState, FreeBalls, Guidance, Pocket, SlipModel};

type V = nalgebra::Vector3<f64>;

/// Loads of a ball between fixed races under a centrifugal force: δ_i + δ_o = `approach`, Q_o = Q_i + F.
fn inner_load(hertz: &HertzPair, approach: f64, centrifugal: f64) -> f64 {
    let depth = |load: f64, stiffness: f64| (load / stiffness).powf(2.0 / 3.0);
    let (mut low, mut high) = (0.0, 1e4);
    for _ in 0..200 {
        let load: f64 = 0.5 * (low + high);
        let sum = depth(load, hertz.inner.stiffness) + depth(load + centrifugal, hertz.outer.stiffness);
        if sum < approach { low = load } else { high = load }
    }
    low
}

/// Ball at rest between the races of a centred bearing, in static equilibrium.
fn resting_ball(hertz: &HertzPair, pitch_radius: f64, interference: f64) -> BallBody {
    let load = inner_load(hertz, 0.5 * interference, 0.0);
    let outwards = (load / hertz.outer.stiffness).powf(2.0 / 3.0) - 0.25 * interference;
    BallBody { position: V::new(pitch_radius + outwards, 0.0, 0.0), ..BallBody::default() }
}

/// dv/dt = 2 μ Q_i(v)/(1.4 m) until 90 % of the kinematic speed, Q_i unloaded by the centrifugal force: the time is within
/// 0.2 % of the integral, and longer than with Q_i at rest by the factors of a second engine.
///
/// At 600 rpm these are of the order of the creep that v₀ = 2.5 mm/s adds (1.0005 with 1 mm/s).
#[test]
fn balls_skid_until_they_roll() {
    for (speed, interference, factor) in
        [(600.0, 4e-6, 1.0011), (6000.0, 8e-6, 1.0049), (6000.0, 4e-6, 1.0135)]
    {
        let (friction, slip_speed) = (0.05, 2.5e-3);
        let ball = ball_bearing(geometry_6205(1, -interference));
        let (hertz, g) = (ball.hertz(), ball.geometry.clone());
        let balls = FreeBalls::new(free(ball, friction, slip_speed, SlipModel::Centre), 0.0).unwrap();
        let speed = rpm(speed);
        let [mass, _] = balls.ball_inertia(0);
        let body = resting_ball(&hertz, 0.5 * g.pitch_diameter, interference);
        let radius = body.position.x;
        let kinematic = g.characteristic_orders(0.0).ftf * speed * radius;
        let load = |v: f64| inner_load(&hertz, 0.5 * interference, mass * v * v / radius);
        let rate = |v: f64| 2.0 * friction * load(v) / (1.4 * mass);
        // ∫ dv/(dv/dt) by Simpson's rule.
        let (n, end) = (200, 0.9 * kinematic);
        let weight = |k: usize| {
            if k == 0 || k == n {
                1.0
            } else if k % 2 == 1 {
                4.0
            } else {
                2.0
            }
        };
        let time: f64 = (0..=n).map(|k| weight(k) / rate(end * k as f64 / n as f64)).sum();
        let expected = time * end / n as f64 / 3.0;
        let at_rest = end / rate(0.0);

        let mut state = FreeBallState::new(&[body], None);
        let step = 0.4 * balls.stable_friction_step(load(0.0), 2);
        let found = loop {
            let (t, v) = (state.time, state.ball(0).velocity.norm());
            let interval = at_rest / 400.0;
            let ring = |t: f64| rings(speed, t);
            balls.advance(&mut state, [&ring(t), &ring(t + interval)], interval, step).unwrap();
            let after = state.ball(0).velocity.norm();
            if after >= end {
                break t + interval * (end - v) / (after - v);
            }
        };
        println!(
            "{:.0} rad/s, {:.1} N: t90 over closed form at rest {:.4}, over the integral {:.5}",
            speed,
            load(0.0),
            found / at_rest,
            found / expected
        );
        assert!(off(found, expected) < 2e-3);
        assert!(off(found / at_rest, factor) < 3e-4);
    }
}

/// Cage held back by a drag moment of 2e-5 N m s/rad at 20000 rpm, without gravity and pocket friction: the balls slide on
/// the inner race, 2 μ Z Q_i(x) = c x ω_k/(D_pw/2), Q_o = Q_i + F_c x².
///
/// Within 0.1 % of this balance and of the figures of a second engine. Started 0.5 % below the balance, where a skidding
/// cage needs up to seconds to settle, and approached; with rolling balls (4 and 8 μm) the creep is below 1e-4.
#[test]
fn cage_with_drag_slips_behind_the_kinematic_speed() {
    let figures = [
        (0.5e-6, 0.2816, 0.3),
        (1e-6, 0.5020, 0.2),
        (2e-6, 0.8777, 0.2),
        (4e-6, 0.9995, 0.02),
        (8e-6, 0.9999, 0.02),
    ];
    for (interference, figure, duration) in figures {
        let (friction, drag, speed) = (0.06, 2e-5, rpm(20_000.0));
        let ball = ball_bearing(geometry_6205(9, -interference));
        let (hertz, g) = (ball.hertz(), ball.geometry.clone());
        let kinematic = g.characteristic_orders(0.0).ftf * speed;
        let mut bearing = free(ball, friction, 1e-2, SlipModel::Centre);
        // Damps the radial vibration of the start, which would raise the mean load.
        bearing.damping = 5.0;
        bearing.cage = Some(plastic_cage(Pocket::Spherical, Guidance::Balls, 0.0));
        bearing.drag = Drag { cage_moment: drag, ..Drag::default() };
        let balls = FreeBalls::new(bearing, 0.0).unwrap();
        let [mass, _] = balls.ball_inertia(0);
        // Drive less drag at the pitch radius; the sliding balls drive with all their friction.
        let surplus = |x: f64| {
            let force = mass * 0.5 * g.pitch_diameter * (x * kinematic).powi(2);
            let load = inner_load(&hertz, 0.5 * interference, force);
            2.0 * friction * g.balls as f64 * load - drag * x * kinematic / (0.5 * g.pitch_diameter)
        };
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..100 {
            let x = 0.5 * (low + high);
            if surplus(x) > 0.0 { low = x } else { high = x }
        }
        let start = 0.995 * low;
        let mut state = balls.initial_state(&rings(speed, 0.0)).unwrap();
        slow_down(&mut state, start);
        balls.advance(&mut state, [&rings(speed, 0.0), &rings(speed, duration)], duration, 2e-6).unwrap();
        let report = balls.report(&state, &rings(speed, duration));
        let ratio = report.iter().map(|ball| ball.orbital_speed).sum::<f64>() / (9.0 * kinematic);
        println!("{:.1} um: ratio {ratio:.4}, balance {low:.4}, second engine {figure}", interference * 1e6);
        assert!(off(ratio, figure) < 1e-3 && off(ratio, low) < 1e-3);
        assert!((ratio - low).abs() < 0.3 * (start - low).abs());
    }
}

/// Scales all velocities of balls and cage.
fn slow_down(state: &mut FreeBallState, ratio: f64) {
    let cage = 9 * state.balls;
    for (k, value) in state.values.iter_mut().enumerate() {
        let is_velocity = if k < cage { k % 9 >= 3 } else { (3..6).contains(&(k - cage)) || k - cage >= 10 };
        if is_velocity {
            *value *= ratio;
        }
    }
}

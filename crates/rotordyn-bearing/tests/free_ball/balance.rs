//! Theorems: action and reaction, momentum, energy, order of the integration.

use crate::bearings::{ball_bearing, free, geometry_6205, plastic_cage, rings, rpm, touch};
use rotordyn_bearing::Wave;
use rotordyn_bearing::contact::{Lubricant, Race, Traction};
use rotordyn_bearing::free_ball::{
    BallBody, CageBody, Drag, FilmShear, FreeBallBearing, FreeBallState, FreeBalls, FrictionLaw, Guidance,
    Land, Pocket, RingState, SlipModel, TractionCurve,
};

type V = nalgebra::Vector3<f64>;

/// Every mechanism at once; `pocket`, `race` of the land.
fn full_bearing(pocket: Pocket, race: Race, slip: SlipModel) -> FreeBallBearing {
    let mut ball = ball_bearing(geometry_6205(9, -4e-6));
    ball.imperfections.inner_waviness = vec![Wave { order: 5, amplitude: 3e-7, phase: 0.4 }];
    ball.imperfections.outer_waviness = vec![Wave { order: 8, amplitude: 2e-7, phase: -1.0 }];
    let mut bearing = free(ball, 0.08, 1e-2, slip);
    bearing.damping = 2.0;
    bearing.rolling_loss = 0.01;
    let radius = if race == Race::Inner { 17e-3 - 0.1e-3 } else { 21.5e-3 + 0.1e-3 };
    let land = Land { race, radius, clearance: 0.1e-3, width: 10e-3, contact: touch(1e6, 1.0, 0.1) };
    bearing.cage = Some(plastic_cage(pocket, Guidance::Land(land), 0.1));
    bearing.drag = Drag { density: 50.0, ball_force: 1.5, ball_moment: 0.05, cage_moment: 1e-6 };
    bearing
}

/// Rings and bodies in a motion without symmetry, the cage pressed on its land and on some balls.
fn general_motion(balls: &FreeBalls) -> (FreeBallState, [RingState; 2]) {
    let inner = RingState {
        position: [4e-6, -7e-6, 5e-6],
        velocity: [1e-3, 2e-3, -1e-3],
        tilt: [2e-4, -3e-4],
        tilt_rate: [0.3, 0.2],
        angle: 0.7,
        speed: 130.0,
    };
    let outer = RingState { position: [1e-6, 2e-6, 0.0], tilt: [-1e-4, 1e-4], speed: -20.0, ..inner };
    let rings = [inner, outer];
    let mut state = balls
        .initial_state(&[RingState { speed: 150.0, ..RingState::default() }, RingState::default()])
        .unwrap();
    for (k, value) in state.values.iter_mut().take(81).enumerate() {
        // Displacements of micrometres, speeds of centimetres and tens of rad a second.
        let size = [1e-6, 2e-2, 20.0][k % 9 / 3];
        *value += size * (1.7 * k as f64).sin();
    }
    let cage = CageBody {
        position: V::new(1.05e-4, -0.6e-4, 2e-5),
        velocity: V::new(0.02, 0.01, -0.03),
        orientation: [0.999_99, 1e-3, -2e-3, 3.9e-3],
        momentum: V::new(1e-6, 2e-6, 8e-5),
    };
    let bodies: Vec<BallBody> = (0..9).map(|j| state.ball(j)).collect();
    let mut out = FreeBallState::new(&bodies, Some(&cage));
    let orientation = &mut out.values[87..91];
    let length = orientation.iter().map(|q| q * q).sum::<f64>().sqrt();
    orientation.iter_mut().for_each(|q| *q /= length);
    (out, rings)
}

/// Forces on rings, balls and cage cancel, and so do their moments about one point, to 1e-12 of the forces.
#[test]
fn forces_and_moments_of_all_contacts_cancel() {
    let pockets = [Pocket::Cylindrical, Pocket::Spherical, Pocket::Closed { radial_clearance: 1e-5 }];
    for (pocket, race) in pockets.into_iter().flat_map(|p| [(p, Race::Inner), (p, Race::Outer)]) {
        let balls = FreeBalls::new(full_bearing(pocket, race, SlipModel::default()), 0.0).unwrap();
        let (state, rings) = general_motion(&balls);
        let sums = balls.forces(&state, &rings);
        let rate = balls.momentum_rate(&state, &rings);
        let (mut force, mut moment) = (rate.linear, rate.angular);
        let mut scale = 0.0;
        for (wrench, ring) in sums.rings.iter().zip(&rings) {
            force += wrench.force;
            moment += wrench.moment + V::from(ring.position).cross(&wrench.force);
        }
        let reports = balls.report(&state, &rings);
        for ball in &reports {
            scale += ball.races.iter().flatten().map(|contact| contact.load).sum::<f64>();
        }
        let contacts = reports.iter().filter(|ball| ball.pocket != 0.0).count();
        println!(
            "{pocket:?} {race:?}: force {:.1e}, moment {:.1e} of {scale:.0} N at 19 mm; {contacts} pockets touched",
            force.norm() / scale,
            moment.norm() / (scale * 19e-3)
        );
        assert!(contacts > 0 && sums.losses.iter().take(6).all(|loss| *loss > 0.0), "{:?}", sums.losses);
        assert!(force.norm() < 1e-12 * scale && moment.norm() < 1e-12 * scale * 19e-3);
    }
}

/// In a motion without symmetry, with tilting rings, the stored energy changes by the work of the rings less the losses: no
/// contact's force deviates from the slope of its energy.
#[test]
fn energy_follows_from_the_forces_in_a_general_motion() {
    let pockets = [Pocket::Cylindrical, Pocket::Spherical, Pocket::Closed { radial_clearance: 1e-5 }];
    for (pocket, race) in pockets.into_iter().flat_map(|p| [(p, Race::Inner), (p, Race::Outer)]) {
        let balls = FreeBalls::new(full_bearing(pocket, race, SlipModel::default()), 0.0).unwrap();
        let (mut state, start) = general_motion(&balls);
        let duration = 1e-6;
        let end = start.map(|ring| RingState {
            position: [0, 1, 2].map(|k| ring.position[k] + duration * ring.velocity[k]),
            tilt: [0, 1].map(|k| ring.tilt[k] + duration * ring.tilt_rate[k]),
            angle: ring.angle + duration * ring.speed,
            ..ring
        });
        let before = balls.energy(&state, &start).total();
        let run = balls.advance(&mut state, [&start, &end], duration, 1e-8).unwrap();
        let stored = balls.energy(&state, &end).total() - before;
        let given = run.ring_work.iter().sum::<f64>() - run.losses.iter().sum::<f64>();
        let scale = run.ring_work.iter().chain(&run.losses).map(|part| part.abs()).sum::<f64>();
        println!(
            "{pocket:?} {race:?}: stored {stored:.9e} J, off {:.1e} of {scale:.2e} J",
            (stored - given) / scale
        );
        assert!((stored - given).abs() < 1e-9 * scale);
    }
}

/// Without cage two balls that collide keep momentum and, without damping and friction, energy.
#[test]
fn colliding_balls_keep_momentum_and_energy() {
    let mut bearing = free(ball_bearing(geometry_6205(2, 1e-3)), 0.0, 1e-3, SlipModel::Centre);
    bearing.ball_friction.friction = 0.0;
    let balls = FreeBalls::new(bearing, 0.0).unwrap();
    let still = [RingState::default(); 2];
    let body = |angle: f64, speed: f64| BallBody {
        position: V::new(19.3e-3 * angle.cos(), 19.3e-3 * angle.sin(), 0.0),
        velocity: speed * V::new(-angle.sin(), angle.cos(), 0.0),
        rotation: V::zeros(),
    };
    let mut state = FreeBallState::new(&[body(0.0, 0.3), body(0.5, -0.2)], None);
    let start = balls.energy(&state, &still).total();
    let momentum = balls.momentum(&state).angular.z;
    let mut highest = 0.0_f64;
    for _ in 0..400 {
        balls.advance(&mut state, [&still; 2], 2e-5, 1e-7).unwrap();
        highest = highest.max(balls.energy(&state, &still).elastic);
    }
    let end = balls.energy(&state, &still).total();
    let speeds = [0, 1].map(|j| {
        let ball = state.ball(j);
        let out = ball.position / ball.position.norm();
        out.x * ball.velocity.y - out.y * ball.velocity.x
    });
    println!(
        "speeds after {speeds:?}, energy off {:.1e}, elastic {highest:.1e} of {start:.1e} J",
        end / start - 1.0
    );
    assert!(highest > 0.3 * start, "no collision");
    assert!(
        (end / start - 1.0).abs() < 1e-6 && (balls.momentum(&state).angular.z / momentum - 1.0).abs() < 1e-9
    );
    // Equal masses would exchange their speeds on a rigid groove; part of the energy remains in radial vibration.
    assert!(speeds[0] < -0.15 && speeds[1] > 0.25);
}

/// Energy balance over 10 ms, as a share of the energy given by the rings, and momentum balance over the same time, as a
/// share of the impulse.
fn imbalance(friction: &FrictionLaw, step: f64) -> [f64; 2] {
    let mut bearing = full_bearing(Pocket::Cylindrical, Race::Outer, SlipModel::default());
    bearing.friction = friction.clone();
    bearing.gravity = [0.0, -9.80665, 0.0];
    let mass = 9.0 * 7850.0 * std::f64::consts::PI / 6.0 * 7.938e-3_f64.powi(3) + bearing.cage.unwrap().mass;
    let balls = FreeBalls::new(bearing, 0.0).unwrap();
    let speed = rpm(1200.0);
    let ring = |t: f64| {
        let [inner, outer] = rings(speed, t);
        let position = [0.0, -1e-6 * (300.0 * t).sin(), 0.0];
        [RingState { position, velocity: [0.0, -3e-4 * (300.0 * t).cos(), 0.0], ..inner }, outer]
    };
    let mut state = balls.initial_state(&rings(speed, 0.0)).unwrap();
    let start = balls.energy(&state, &ring(0.0)).total();
    let momentum = balls.momentum(&state).linear;
    let (mut work, mut losses, mut given) = (0.0, 0.0, 0.0);
    let (mut impulse, mut pushed) = (V::zeros(), 0.0);
    for k in 0..50 {
        let t = 2e-4 * k as f64;
        let interval = balls.advance(&mut state, [&ring(t), &ring(t + 2e-4)], 2e-4, step).unwrap();
        work += interval.ring_work.iter().sum::<f64>();
        given += interval.ring_work.iter().map(|w| w.abs()).sum::<f64>();
        losses += interval.losses.iter().sum::<f64>();
        for force in interval.rings {
            let force = V::new(force[0], force[1], force[2]);
            impulse += 2e-4 * force;
            pushed += 2e-4 * force.norm();
        }
    }
    let stored = balls.energy(&state, &ring(0.01)).total() - start;
    let weight = V::new(0.0, -9.80665 * mass * 0.01, 0.0);
    let left = balls.momentum(&state).linear - momentum - weight + impulse;
    println!("step {step:.1e}: stored {stored:.6e}, work {work:.6e}, lost {losses:.6e} J");
    [((stored - work + losses) / given).abs(), left.norm() / pushed]
}

/// With friction, cage, land, waviness and a moving ring the energy balance closes to 1e-6 and improves with the step,
/// under every friction law; impulse and momentum agree to rounding.
#[test]
fn energy_and_momentum_balances_close() {
    let coulomb = FrictionLaw::Coulomb(Traction { friction: 0.08, slip_speed: 1e-2 });
    let curve = FrictionLaw::Curve(TractionCurve { limit: 0.05, slope: 0.2, decay: 20.0 });
    let film = FrictionLaw::Film(FilmShear {
        lubricant: Lubricant::grade("ISO VG 68", 330.0).unwrap(),
        eyring_stress: 5e6,
        limit: 0.08,
        slip_speed: 1e-2,
    });
    for law in [coulomb, curve, film] {
        let [[coarse, momentum], [fine, _]] = [1e-6, 5e-7].map(|step| imbalance(&law, step));
        println!("energy {coarse:.2e}, at half the step {fine:.2e}; momentum {momentum:.2e}");
        assert!(coarse < 1e-6 && fine < coarse && momentum < 1e-11);
    }
}

/// Fitted order of the integration while all contacts last: four.
#[test]
fn integration_is_of_fourth_order() {
    let mut bearing = free(ball_bearing(geometry_6205(3, -4e-6)), 0.06, 5e-2, SlipModel::default());
    bearing.damping = 2.0;
    let balls = FreeBalls::new(bearing, 0.0).unwrap();
    let speed = rpm(3000.0);
    let start = [RingState { velocity: [1e-3, 0.0, 0.0], ..rings(speed, 0.0)[0] }, RingState::default()];
    let end = [RingState { position: [1e-6, 0.0, 5e-7], ..rings(speed, 4e-4)[0] }, RingState::default()];
    let run = |steps: f64| {
        let mut state = balls.initial_state(&rings(speed, 0.0)).unwrap();
        state.values[4] *= 0.99;
        balls.advance(&mut state, [&start, &end], 4e-4, 4e-4 / steps).unwrap();
        state.values
    };
    let exact = run(12_800.0);
    let error = |steps: f64| {
        let found = run(steps);
        found.iter().zip(&exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    let errors = [400.0, 800.0, 1600.0].map(error);
    let orders = [errors[0] / errors[1], errors[1] / errors[2]].map(f64::log2);
    println!("errors {errors:?}, orders {orders:.2?}");
    assert!(orders.iter().all(|order| (order - 4.0).abs() < 0.3));
}

/// Two intervals in a row give the motion and the impulse of one over both.
#[test]
fn intervals_join() {
    let balls =
        FreeBalls::new(full_bearing(Pocket::Cylindrical, Race::Outer, SlipModel::Centre), 0.0).unwrap();
    let speed = rpm(3000.0);
    let start = balls.initial_state(&rings(speed, 0.0)).unwrap();
    let (mut once, mut twice) = (start.clone(), start);
    let ring = |t: f64| rings(speed, t);
    let whole = balls.advance(&mut once, [&ring(0.0), &ring(2e-3)], 2e-3, 1e-6).unwrap();
    let parts = [0.0, 1e-3]
        .map(|t| balls.advance(&mut twice, [&ring(t), &ring(t + 1e-3)], 1e-3, 1e-6).unwrap().rings[0]);
    for (a, b) in once.values.iter().zip(&twice.values) {
        assert!((a - b).abs() < 1e-10 * (1.0 + a.abs()), "{a} {b}");
    }
    assert!((once.time - twice.time).abs() < 1e-15);
    for ((whole, first), second) in whole.rings[0].iter().zip(&parts[0]).zip(&parts[1]) {
        let mean = 0.5 * (first + second);
        assert!((whole - mean).abs() < 1e-8, "{whole} {mean}");
    }
}

/// A cage without forces keeps its angular momentum exactly, and its axis precesses about it at L/I_t.
#[test]
fn free_cage_keeps_its_angular_momentum() {
    let mut bearing = free(ball_bearing(geometry_6205(1, 1e-5)), 0.0, 1e-3, SlipModel::Centre);
    let mut cage = plastic_cage(Pocket::Spherical, Guidance::Balls, 0.0);
    // Wide enough never to touch the ball.
    cage.pocket_diameter = 1.0;
    bearing.cage = Some(cage);
    let balls = FreeBalls::new(bearing, 0.0).unwrap();
    let still = [RingState::default(); 2];
    let mut body = CageBody::rotating(V::zeros(), V::zeros(), 0.0, 500.0, cage.polar_inertia);
    body.momentum.x = 0.3 * body.momentum.z;
    let resting = BallBody { position: V::new(19.2525e-3, 0.0, 0.0), ..BallBody::default() };
    let mut state = FreeBallState::new(&[resting], Some(&body));
    let energy = balls.energy(&state, &still).cage;
    let duration = 0.1;
    balls.advance(&mut state, [&still; 2], duration, 1e-5).unwrap();
    let after = state.cage().unwrap();
    assert_eq!(after.momentum, body.momentum);
    // The axis, at first along z, turned about the momentum.
    let axis = after.axes()[2];
    let momentum = body.momentum.norm();
    let turn = nalgebra::Rotation3::new(body.momentum / cage.transverse_inertia * duration);
    let expected = turn * V::z();
    let kept = balls.energy(&state, &still).cage / energy - 1.0;
    println!(
        "axis off by {:.1e} after {:.1} turns, energy off {kept:.1e}",
        (axis - expected).norm(),
        momentum / cage.transverse_inertia * duration / std::f64::consts::TAU
    );
    assert!((axis - expected).norm() < 1e-8 && kept.abs() < 1e-9);
}

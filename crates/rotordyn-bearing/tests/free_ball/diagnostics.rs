//! Bad input and runs that must stop: errors that name the cause.

use crate::bearings::{ball_bearing, free, geometry_6205, plastic_cage, touch};
use rotordyn_bearing::contact::Race;
use rotordyn_bearing::free_ball::{
    BallBody, Drag, FreeBallError, FreeBallState, FreeBalls, FreeCage, Guidance, Land, Pocket, RingState,
    SlipModel, StepLimit,
};
use rotordyn_bearing::{OffSize, Preload};

type V = nalgebra::Vector3<f64>;

const STILL: [RingState; 2] = [RingState {
    position: [0.0; 3],
    velocity: [0.0; 3],
    tilt: [0.0; 2],
    tilt_rate: [0.0; 2],
    angle: 0.0,
    speed: 0.0,
}; 2];

/// Message of the preparation of a bearing.
fn refusal(change: impl Fn(&mut rotordyn_bearing::free_ball::FreeBallBearing)) -> String {
    let mut bearing = free(ball_bearing(geometry_6205(9, 1e-5)), 0.06, 1e-2, SlipModel::Centre);
    bearing.cage = Some(plastic_cage(Pocket::Cylindrical, Guidance::Balls, 0.1));
    change(&mut bearing);
    FreeBalls::new(bearing, 0.0).unwrap_err().to_string()
}

#[test]
fn input_that_cannot_be_is_refused() {
    let cage = |bearing: &mut rotordyn_bearing::free_ball::FreeBallBearing,
                change: &dyn Fn(&mut rotordyn_bearing::free_ball::FreeCage)| {
        let mut cage = bearing.cage.unwrap();
        change(&mut cage);
        bearing.cage = Some(cage);
    };
    let land = |clearance: f64| {
        let contact = touch(1e6, 0.0, 0.1);
        Guidance::Land(Land { race: Race::Outer, radius: 21.6e-3, clearance, width: 1e-2, contact })
    };
    let messages = [
        refusal(|bearing| cage(bearing, &|cage| cage.pocket_diameter = 7.9e-3)),
        refusal(|bearing| {
            let large = OffSize { ball: 3, diameter_difference: 0.2e-3, row: None };
            bearing.ball.imperfections.off_size = vec![large];
        }),
        refusal(|bearing| cage(bearing, &|cage| cage.pocket_diameter = 14e-3)),
        refusal(|bearing| cage(bearing, &|cage| cage.mass = 0.0)),
        refusal(|bearing| cage(bearing, &|cage| cage.guidance = land(0.0))),
        refusal(|bearing| bearing.rolling_loss = -0.01),
        refusal(|bearing| bearing.slip = SlipModel::Ellipse { along: 0, across: 4 }),
        refusal(|bearing| bearing.ball.preload = Preload::Spring { stiffness: 1e5, force: 100.0 }),
    ];
    let expected = [
        "a cage pocket is not larger than the ball",
        "a cage pocket is not larger than the ball",
        "neighbouring cage pockets overlap",
        "mass or inertia of the cage is not positive",
        "the cage touches its guiding ring at rest: its clearance is not positive",
        "a damping, a loss factor or a drag is negative",
        "the contact ellipse needs at least one point in each direction",
        "free balls have rings of given motion, so no preload by a spring",
    ];
    assert_eq!(messages, expected);
}

/// Every number of the contacts of pockets, land and balls: out of range or not a number.
#[test]
fn contacts_that_cannot_be_are_refused() {
    const NAN: f64 = f64::NAN;
    let good = touch(1e6, 1.0, 0.1);
    let with = |k: usize, value: f64| {
        let mut law = good;
        *[&mut law.stiffness, &mut law.damping, &mut law.friction.friction, &mut law.friction.slip_speed]
            [k] = value;
        law
    };
    let wrong = [(0, 0.0), (0, NAN), (1, -1.0), (1, NAN), (2, -0.1), (2, NAN), (3, 0.0), (3, NAN)];
    let cage = |pocket: Pocket, guidance: Guidance| plastic_cage(pocket, guidance, 0.1);
    for (k, value) in wrong {
        let law = with(k, value);
        let pocket = refusal(|bearing| {
            bearing.cage =
                Some(FreeCage { pocket_contact: law, ..cage(Pocket::Cylindrical, Guidance::Balls) });
        });
        assert!(pocket.starts_with("contact of the cage pockets: "), "{k} {value}: {pocket}");
        let edge = refusal(|bearing| {
            let land =
                Land { race: Race::Outer, radius: 21.6e-3, clearance: 1e-4, width: 1e-2, contact: law };
            bearing.cage = Some(cage(Pocket::Cylindrical, Guidance::Land(land)));
        });
        assert!(edge.starts_with("contact of the cage's land: "), "{k} {value}: {edge}");
        if k > 1 {
            let balls = refusal(|bearing| (bearing.cage, bearing.ball_friction) = (None, law.friction));
            assert!(balls.starts_with("friction of balls that touch each other: "), "{k} {value}: {balls}");
        }
    }
    for value in [0.0, -1e-3, NAN] {
        for (k, expected) in ["the cage touches its", "radius or width", "radius or width"].iter().enumerate()
        {
            let message = refusal(|bearing| {
                let mut land =
                    Land { race: Race::Outer, radius: 21.6e-3, clearance: 1e-4, width: 1e-2, contact: good };
                *[&mut land.clearance, &mut land.radius, &mut land.width][k] = value;
                bearing.cage = Some(cage(Pocket::Cylindrical, Guidance::Land(land)));
            });
            assert!(message.starts_with(expected), "{k} {value}: {message}");
        }
        let closed = Pocket::Closed { radial_clearance: value };
        let message = refusal(|bearing| bearing.cage = Some(cage(closed, Guidance::Balls)));
        assert_eq!(message, "a closed pocket has no radial clearance");
        let message = refusal(|bearing| {
            bearing.cage =
                Some(FreeCage { pocket_diameter: value, ..cage(Pocket::Cylindrical, Guidance::Balls) });
        });
        assert_eq!(message, "a cage pocket is not larger than the ball");
    }
}

/// Balls that touch their pockets in the kinematic solution, or each other without cage.
#[test]
fn overlap_at_the_start_is_an_error() {
    let mut bearing = free(ball_bearing(geometry_6205(9, 1e-5)), 0.06, 1e-2, SlipModel::Centre);
    let mut cage = plastic_cage(Pocket::Closed { radial_clearance: 1e-6 }, Guidance::Balls, 0.1);
    cage.pocket_diameter = 8.1e-3;
    bearing.cage = Some(cage);
    let balls = FreeBalls::new(bearing, 0.0).unwrap();
    let error = balls.initial_state(&STILL).unwrap_err();
    assert_eq!(error.to_string(), "the cage touches ball 0 at the start, 1.500e-6 m deep");
    // Sixteen balls of 7.94 mm do not fit on a pitch circle of 38.5 mm.
    let full = free(ball_bearing(geometry_6205(16, 1e-5)), 0.06, 1e-2, SlipModel::Centre);
    let error = FreeBalls::new(full, 0.0).unwrap().initial_state(&STILL).unwrap_err();
    assert!(error.to_string().starts_with("ball 0 touches the next ball at the start"), "{error}");
}

/// The radial stop of a closed pocket presses on a ball without driving it; the pocket's wall drives it by its load.
#[test]
fn pocket_force_of_the_report_is_along_the_orbit() {
    let prepared = |pocket: Pocket| {
        let mut bearing = free(ball_bearing(geometry_6205(9, 1e-5)), 0.06, 1e-2, SlipModel::Centre);
        bearing.cage = Some(plastic_cage(pocket, Guidance::Balls, 0.0));
        FreeBalls::new(bearing, 0.0).unwrap()
    };
    let open = prepared(Pocket::Cylindrical);
    let closed = prepared(Pocket::Closed { radial_clearance: 1e-6 });
    let mut state = open.initial_state(&STILL).unwrap();
    // K δ^{3/2} of the stop, 1.5 μm deep.
    let stop = 1e8 * 1.5e-6_f64.powf(1.5);
    let reports = closed.report(&state, &STILL);
    assert!(closed.energy(&state, &STILL).elastic > open.energy(&state, &STILL).elastic);
    assert!(reports.iter().all(|ball| ball.pocket.abs() < 1e-9 * stop), "{reports:?}");
    // Ball 0 lies at x = r; its clearance of 81 μm and 4 μm more along the orbit. The cage's wall presses it back.
    state.values[1] += 85e-6;
    for balls in [&open, &closed] {
        let force = balls.report(&state, &STILL)[0].pocket;
        println!("pocket force {force:.4} N");
        assert!((force / (-1e8 * 4e-6_f64.powf(1.5)) - 1.0).abs() < 3e-3, "{force}");
    }
}

/// A ball on one or between two races, its spin disturbed; the share of the spin left after 60 steps of a share of the
/// stated limit.
fn disturbed(share: f64, races: usize) -> Result<f64, FreeBallError> {
    let clearance = if races == 2 { -4e-6 } else { 1e-3 };
    // Friction over slip so steep that it limits the step, not the contact.
    let (friction, slip_speed) = (0.3, if races == 2 { 1e-3 } else { 1e-5 });
    let mut bearing =
        free(ball_bearing(geometry_6205(1, clearance)), friction, slip_speed, SlipModel::Centre);
    bearing.gravity = if races == 2 { [0.0; 3] } else { [0.0, -9.80665, 0.0] };
    let hertz = bearing.ball.hertz();
    let balls = FreeBalls::new(bearing, 0.0).unwrap();
    let [mass, _] = balls.ball_inertia(0);
    let mut state = if races == 2 {
        balls.initial_state(&STILL)?
    } else {
        let depth = (mass * 9.80665 / hertz.outer.stiffness).powf(2.0 / 3.0);
        let position = V::new(0.0, -(19.25e-3 + 0.25e-3 + depth), 0.0);
        FreeBallState::new(&[BallBody { position, ..BallBody::default() }], None)
    };
    let load = balls.report(&state, &STILL)[0].races[1].unwrap().load;
    let limit = balls.stable_step(&state, &STILL).friction;
    let stated = 2.785 * slip_speed * mass / ((if races == 2 { 5.0 } else { 3.5 }) * friction * load);
    assert!((limit / stated - 1.0).abs() < 2e-2, "{limit:e} {stated:e}");
    assert!((balls.stable_friction_step(load, races) / stated - 1.0).abs() < 1e-3);
    let start = 1e-3 * slip_speed / 4e-3;
    state.values[8] = start;
    balls.advance(&mut state, [&STILL; 2], 60.0 * share * stated, share * stated)?;
    Ok(state.ball(0).rotation.norm() / start)
}

/// h < 2.785 v₀ m/(3.5 μ Q) for a ball on one race; between two races under equal loads 5 in place of 3.5.
///
/// Just below the limit a disturbance decays, above it the step is refused with the stable one.
#[test]
fn step_beyond_the_friction_limit_is_refused() {
    for races in [1, 2] {
        let left = disturbed(0.9, races).unwrap();
        let error = disturbed(1.05, races).unwrap_err();
        println!("{races} races: {left:.1e} of the disturbance left; {error}");
        // A ball on one race rolls on with 2/7 of its spin.
        assert!(if races == 1 { (left - 2.0 / 7.0).abs() < 1e-2 } else { left < 1e-3 });
        let FreeBallError::Step { step, stable, limit, .. } = error else { panic!("{error}") };
        assert_eq!(limit, StepLimit::Friction);
        assert!((step / stable / 1.05 - 1.0).abs() < 2e-2);
    }
}

#[test]
fn step_beyond_the_contact_limit_is_refused() {
    let ball = ball_bearing(geometry_6205(9, -4e-6));
    let hertz = ball.hertz();
    let balls = FreeBalls::new(free(ball, 0.0, 1e-2, SlipModel::Centre), 0.0).unwrap();
    let mut state = balls.initial_state(&STILL).unwrap();
    let load = balls.report(&state, &STILL)[0].races[0].unwrap().load;
    // Frequency of a ball between fixed races, dQ/dδ = 3/2 K^{2/3} Q^{1/3}; RK4 is stable up to h ω = 2 √2.
    let slope = |stiffness: f64| 1.5 * stiffness.powf(2.0 / 3.0) * load.cbrt();
    let stiffness = slope(hertz.inner.stiffness) + slope(hertz.outer.stiffness);
    let expected = 8_f64.sqrt() / (stiffness / balls.ball_inertia(0)[0]).sqrt();
    balls.advance(&mut state, [&STILL; 2], 1e-3, 0.95 * expected).unwrap();
    let before = state.clone();
    let error = balls.advance(&mut state, [&STILL; 2], 1e-2, 1e-4).unwrap_err();
    println!("{error}");
    assert_eq!(state, before, "a refused step changed the state");
    let FreeBallError::Step { stable, limit, .. } = error else { panic!("{error}") };
    assert!(limit == StepLimit::Contact && (stable / expected - 1.0).abs() < 1e-3, "{stable:e} {expected:e}");
}

/// Bearing with a cage of moment of drag c \[N m s/rad\] and its smaller moment of inertia \[kg m²\].
fn with_cage_drag(cage_moment: f64) -> (FreeBalls, f64) {
    let mut bearing = free(ball_bearing(geometry_6205(9, 1e-5)), 0.0, 1e-2, SlipModel::Centre);
    let cage = plastic_cage(Pocket::Cylindrical, Guidance::Balls, 0.0);
    bearing.cage = Some(cage);
    bearing.drag.cage_moment = cage_moment;
    (FreeBalls::new(bearing, 0.0).unwrap(), cage.polar_inertia.min(cage.transverse_inertia))
}

/// Drag of the cage: RK4 is stable up to h c/I = 2.785. Below it a disturbance decays, beyond it the step is refused.
#[test]
fn step_beyond_the_limit_of_the_cages_drag_is_refused() {
    let step = 1e-6;
    let (_, inertia) = with_cage_drag(0.0);
    let run = |product: f64| {
        let (balls, _) = with_cage_drag(product * inertia / step);
        let mut state = balls.initial_state(&STILL).unwrap();
        // Angular momentum about a diameter, with the smaller moment of inertia of this cage.
        let momentum = state.values.len() - 3;
        state.values[momentum] = 1e-3 * inertia;
        let run = balls.advance(&mut state, [&STILL; 2], 200.0 * step, step);
        run.map(|_| state.values[momentum] / (1e-3 * inertia))
    };
    let left = run(2.7).unwrap();
    let error = run(2.9).unwrap_err();
    println!("{left:.1e} of the disturbance left; {error}");
    assert!(left.abs() < 1e-3);
    let FreeBallError::Step { stable, limit, .. } = error else { panic!("{error}") };
    assert!(limit == StepLimit::Friction && (stable / step * 2.9 / 2.785 - 1.0).abs() < 1e-3, "{stable:e}");
}

/// Ball at rest on the outer race under its weight, without traction.
fn resting(rolling_loss: f64, drag: Drag) -> (FreeBalls, FreeBallState) {
    let weight = 9.80665;
    let mut bearing = free(ball_bearing(geometry_6205(1, 1e-3)), 0.0, 1e-5, SlipModel::Centre);
    bearing.gravity = [0.0, -weight, 0.0];
    (bearing.rolling_loss, bearing.drag) = (rolling_loss, drag);
    let stiffness = bearing.ball.hertz().outer.stiffness;
    let balls = FreeBalls::new(bearing, 0.0).unwrap();
    let [mass, _] = balls.ball_inertia(0);
    let depth = (mass * weight / stiffness).powf(2.0 / 3.0);
    let position = V::new(0.0, -(19.25e-3 + 0.25e-3 + depth), 0.0);
    (balls, FreeBallState::new(&[BallBody { position, ..BallBody::default() }], None))
}

/// Rolling resistance (3/16) η Q b ω/ω₀ at small ω, ω₀ = v₀/r: RK4 is stable up to h (3/16) η Q b/(ω₀ I) = 2.785.
#[test]
fn step_beyond_the_limit_of_rolling_resistance_is_refused() {
    let step = 1e-6;
    let (balls, start) = resting(0.0, Drag::default());
    let race = balls.report(&start, &STILL)[0].races[1].unwrap();
    let fading = 1e-5 / 3.969e-3;
    let unit = 3.0 / 16.0 * race.load * race.semi_axes[0] / (fading * balls.ball_inertia(0)[1]);
    let run = |product: f64| {
        let (balls, mut state) = resting(product / (unit * step), Drag::default());
        state.values[8] = 1e-3 * fading;
        let run = balls.advance(&mut state, [&STILL; 2], 200.0 * step, step);
        run.map(|_| state.values[8] / (1e-3 * fading))
    };
    let left = run(2.7).unwrap();
    let error = run(2.9).unwrap_err();
    println!("{left:.1e} of the disturbance left; {error}");
    assert!(left.abs() < 1e-3);
    let FreeBallError::Step { stable, limit, .. } = error else { panic!("{error}") };
    assert!(limit == StepLimit::Friction && (stable / step * 2.9 / 2.785 - 1.0).abs() < 1e-3, "{stable:e}");
}

/// Drag ½ ρ C_d π r² v² and ½ ρ C_n r⁵ ω²: the steeper of ρ C_d π r² v/m and ρ C_n r⁵ ω/I limits the step.
#[test]
fn drag_of_balls_limits_the_step() {
    let drag = Drag { density: 40.0, ball_force: 0.5, ball_moment: 0.02, cage_moment: 0.0 };
    let (balls, start) = resting(0.0, drag);
    let [mass, inertia] = balls.ball_inertia(0);
    let radius = 3.969e-3_f64;
    for (velocity, rotation) in [(30.0, 100.0), (0.1, 9000.0)] {
        let mut state = start.clone();
        (state.values[3], state.values[7]) = (velocity, rotation);
        let force = 40.0 * 0.5 * std::f64::consts::PI * radius * radius * velocity / mass;
        let moment = 40.0 * 0.02 * radius.powi(5) * rotation / inertia;
        let limit = balls.stable_step(&state, &STILL).friction;
        println!("by force {:.2e} s, by moment {:.2e} s: {limit:.2e} s", 2.785 / force, 2.785 / moment);
        assert!((limit * f64::max(force, moment) / 2.785 - 1.0).abs() < 1e-3);
    }
}

/// A cage that touches nothing any more ends the run: not a number, or its centre out of the bearing.
#[test]
fn lost_cage_ends_the_run() {
    let (balls, _) = with_cage_drag(0.0);
    let start = balls.initial_state(&STILL).unwrap();
    let run = |change: &dyn Fn(&mut FreeBallState)| {
        let mut state = start.clone();
        change(&mut state);
        balls.advance(&mut state, [&STILL; 2], 1e-6, 1e-6).unwrap_err()
    };
    let cage = 9 * 9;
    for k in 0..13 {
        let error = run(&|state| state.values[cage + k] = f64::NAN);
        assert!(
            matches!(&error, FreeBallError::CageLost { cause, .. } if cause.contains("diverged")),
            "{error}"
        );
    }
    let error = run(&|state| state.values[cage + 2] = 20e-3);
    println!("{error}");
    assert!(
        matches!(&error, FreeBallError::CageLost { cause, .. } if cause.contains("centre moved")),
        "{error}"
    );
}

#[test]
fn interval_without_positive_finite_times_is_refused() {
    let balls =
        FreeBalls::new(free(ball_bearing(geometry_6205(9, -4e-6)), 0.0, 1e-2, SlipModel::Centre), 0.0)
            .unwrap();
    let start = balls.initial_state(&STILL).unwrap();
    for wrong in [0.0, -1e-6, f64::NAN, f64::INFINITY] {
        for (duration, step) in [(1e-3, wrong), (wrong, 1e-6)] {
            let mut state = start.clone();
            let error = balls.advance(&mut state, [&STILL; 2], duration, step).unwrap_err();
            assert!(matches!(error, FreeBallError::Input(_)), "{error}");
            assert_eq!(state, start);
        }
    }
}

/// A ball pushed along the axis at 2 m/s stays between the shoulders with a clearance of 1 mm; with more clearance than
/// the height of both it leaves the bearing.
#[test]
fn ball_that_leaves_the_bearing_ends_the_run() {
    let pushed = |clearance: f64| {
        let bearing = free(ball_bearing(geometry_6205(2, clearance)), 0.0, 1e-2, SlipModel::Centre);
        let balls = FreeBalls::new(bearing, 0.0).unwrap();
        let mut state = balls.initial_state(&STILL).unwrap();
        state.values[9 + 5] = 2.0;
        let start = balls.energy(&state, &STILL).total();
        let run = balls.advance(&mut state, [&STILL; 2], 0.03, 1e-7).map(|_| ());
        (run, balls.energy(&state, &STILL).total() / start - 1.0)
    };
    let (run, drift) = pushed(1e-3);
    println!("kept between the shoulders, energy off {drift:.1e}");
    assert!(run.is_ok() && drift.abs() < 1e-4);
    let error = pushed(7e-3).0.unwrap_err();
    println!("{error}");
    let FreeBallError::BallLost { ball, time, cause } = error else { panic!("{error}") };
    assert!(ball == 1 && time > 1.5e-3 && time < 0.03, "{time}");
    assert!(cause.contains("axially out of the"), "{cause}");
}

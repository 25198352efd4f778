//! Settled under load without traction: the quasi-static bearing.

use crate::bearings::{ball_bearing, free, geometry_6205};
use rotordyn_bearing::free_ball::{FreeBallBearing, FreeBalls, RingState, SlipModel};
use rotordyn_bearing::{
    BallBearing, BallElement, BallGeometry, BallInertia, Defect, DefectForm, Imperfections, OffSize, Preload,
    Rotation, Shape, Surface, Wave,
};

/// Angle of the inner ring \[rad\].
const SHAFT_ANGLE: f64 = 0.7;

/// Inner ring displaced by x, y, z, θ_x, θ_y.
fn displaced(d: &[f64; 5]) -> [RingState; 2] {
    let inner = RingState {
        angle: SHAFT_ANGLE,
        position: [d[0], d[1], d[2]],
        tilt: [d[3], d[4]],
        ..RingState::default()
    };
    [inner, RingState::default()]
}

/// Force on the inner ring and loads of the balls, settled for a duration \[s\] of strong damping.
fn settled(bearing: &FreeBallBearing, d: &[f64; 5], duration: f64) -> ([f64; 5], Vec<f64>) {
    let balls = FreeBalls::new(bearing.clone(), 0.0).unwrap();
    let rings = displaced(d);
    let mut state = balls.initial_state(&rings).unwrap();
    balls.advance(&mut state, [&rings, &rings], duration, 1e-6).unwrap();
    let sums = balls.forces(&state, &rings);
    let [f, m] = [sums.rings[0].force, sums.rings[0].moment];
    let inner_load =
        |ball: &rotordyn_bearing::free_ball::BallReport| ball.races[0].map_or(0.0, |contact| contact.load);
    ([f.x, f.y, f.z, m.x, m.y], balls.report(&state, &rings).iter().map(inner_load).collect())
}

/// Largest deviation of a ball's load from the quasi-static bearing, over the largest load.
fn load_deviation(ball: &BallBearing, d: &[f64; 5], duration: f64) -> f64 {
    let full = [d[0], d[1], d[2], d[3], d[4], 0.0];
    let rotation = Rotation { shaft_angle: SHAFT_ANGLE, ..Rotation::default() };
    let loads = BallElement::new(ball).ball_loads(&full, &rotation);
    let (_, found) = settled(&damped(ball), d, duration);
    let largest = loads.iter().map(|load| load.load).fold(0.0, f64::max);
    let worst = found.iter().zip(&loads).map(|(a, b)| (a - b.load).abs()).fold(0.0, f64::max) / largest;
    println!("largest ball load {largest:.1} N: loads within {worst:.1e}");
    worst
}

/// The bearing without friction and with strong contact damping.
fn damped(ball: &BallBearing) -> FreeBallBearing {
    let mut bearing = free(ball.clone(), 0.0, 1e-2, SlipModel::Centre);
    bearing.damping = 3.0;
    bearing
}

/// Largest deviation of the 5 × 5 stiffness from the quasi-static bearing, over √(k_ii k_jj).
fn stiffness_deviation(ball: &BallBearing, d: [f64; 5], steps: [f64; 5]) -> f64 {
    let element = BallElement::new(ball);
    let full = [d[0], d[1], d[2], d[3], d[4], 0.0];
    let rotation = Rotation { shaft_angle: SHAFT_ANGLE, ..Rotation::default() };
    let mut expected = element.reaction(&full, &[0.0; 6], &rotation).stiffness;
    let loads = element.ball_loads(&full, &rotation);
    for load in &loads {
        let (sin, cos) = load.position.sin_cos();
        let geometric = load.load * load.contact_angle.cos() * ball.geometry.inner_centre_radius();
        for (i, a) in [(3, -sin), (4, cos)] {
            for (k, b) in [(3, -sin), (4, cos)] {
                expected[i][k] -= geometric * a * b;
            }
        }
    }
    let bearing = damped(ball);
    let mut deviation = 0.0_f64;
    for k in 0..5 {
        let force = |sign: f64| {
            let mut at = d;
            at[k] += sign * steps[k];
            settled(&bearing, &at, 3e-4).0
        };
        let (up, down) = (force(1.0), force(-1.0));
        for i in 0..5 {
            let stiffness = -(up[i] - down[i]) / (2.0 * steps[k]);
            let scale = (expected[i][i] * expected[k][k]).sqrt();
            deviation = deviation.max((stiffness - expected[i][k]).abs() / scale);
        }
    }
    println!("stiffness within {deviation:.1e} of the diagonal");
    deviation
}

/// Ball forces within 0.5 % of the largest, 5 × 5 stiffness within 0.5 % of √(k_ii k_jj): deep groove bearing with
/// clearance under combined load, and an angular contact bearing.
///
/// The quasi-static element is linear in the tilt; the tilted groove also moves −R_i (θ·t)²/2 radially (t along the ring),
/// which the exact geometry has: −Σ Q cos α R_i t tᵀ is added, 1 % of the tilting stiffness here. Without friction the
/// balls slide out of the load zone, which takes a hundred times longer than the contacts need to settle.
#[test]
fn settled_bearing_is_the_quasi_static_one() {
    let massless = |geometry: BallGeometry| {
        let mut ball = ball_bearing(geometry);
        ball.inertia = BallInertia::None;
        ball
    };
    let compare = |ball: BallBearing, d: [f64; 5]| {
        let steps = [5e-7, 5e-7, 5e-7, 2e-5, 2e-5];
        assert!(load_deviation(&ball, &d, 3e-4) < 5e-3 && stiffness_deviation(&ball, d, steps) < 5e-3);
    };
    compare(massless(geometry_6205(9, 10e-6)), [12e-6, -9e-6, 40e-6, 2e-4, -3e-4]);
    let mut geometry = geometry_6205(9, 0.0);
    geometry.contact_angle = 0.44;
    compare(massless(geometry.clone()), [3e-6, -4e-6, 15e-6, -2e-4, 1e-4]);
    geometry.thrust_direction = -1.0;
    let mut preloaded = massless(geometry);
    preloaded.preload = Preload::Interference(6e-6);
    compare(preloaded, [3e-6, -4e-6, -9e-6, -2e-4, 1e-4]);
}

/// Ball forces with waviness of both races, a dent in each and an off-size ball, at their places in the rings' own angles.
#[test]
fn imperfect_surfaces_load_the_balls_as_in_the_quasi_static_bearing() {
    let mut ball = ball_bearing(geometry_6205(9, 0.0));
    ball.inertia = BallInertia::None;
    let wave = |order, phase| Wave { order, amplitude: 1.5e-6, phase };
    let form = DefectForm::Dent { depth: Some(2e-6), shape: Shape::HalfSine };
    let dent = |surface, start| Defect { surface, row: None, start, width: 1e-3, form };
    ball.imperfections = Imperfections {
        inner_waviness: vec![wave(4, 0.3)],
        outer_waviness: vec![wave(5, -0.8)],
        off_size: vec![OffSize { ball: 2, diameter_difference: 2e-6, row: None }],
        // Balls 1 and 8 are at 40 and 320 deg.
        defects: vec![
            dent(Surface::Outer, 39_f64.to_radians()),
            dent(Surface::Inner, 319_f64.to_radians() - SHAFT_ANGLE),
        ],
        ..Imperfections::default()
    };
    let mut smooth = ball.clone();
    smooth.imperfections = Imperfections::default();
    let d = [5e-6, -3e-6, 10e-6, 1e-4, 0.0];
    // Briefly: without friction the balls slide into the dents.
    assert!(load_deviation(&ball, &d, 1e-4) < 5e-3);
    // Each imperfection changes a load by far more than the tolerance.
    let at = [d[0], d[1], d[2], d[3], d[4], 0.0];
    let rotation = Rotation { shaft_angle: SHAFT_ANGLE, ..Rotation::default() };
    let loads = |ball: &BallBearing| BallElement::new(ball).ball_loads(&at, &rotation);
    let changes =
        loads(&ball).iter().zip(loads(&smooth)).filter(|(a, b)| (a.load - b.load).abs() > 1.0).count();
    assert!(changes > 4, "{changes}");
}

//! Bearing with one radial DOF per ball: tangents compared with finite differences, momentum and power
//! balance, limit cases.

use crate::ball_bearing::Random;
use crate::bearing::rig_6205;
use rotordyn_bearing::internal::{InternalStep, Motion, NewmarkGain};
use rotordyn_bearing::radial_ball::Rings;
use rotordyn_bearing::{
    BallElement, BallWave, InternalCoordinates, OffSize, RadialBallBearing, RadialElement, Rotation, Wave,
};

const GRAVITY: [f64; 2] = [2.0, -9.0];

fn bearing() -> RadialBallBearing {
    RadialBallBearing {
        ball: rig_6205(),
        stiffness_damping: [1e-4, 0.7e-4],
        tensile_contact: false,
        gravity: GRAVITY,
    }
}

/// With waviness of races and balls, and an oversize ball.
fn with_defects() -> RadialBallBearing {
    let mut out = bearing();
    let wave = |order, amplitude| Wave { order, amplitude, phase: 0.4 * f64::from(order) };
    out.ball.imperfections.inner_waviness = vec![wave(7, 1e-6)];
    out.ball.imperfections.outer_waviness = vec![wave(5, 0.7e-6), wave(11, 0.2e-6)];
    out.ball.imperfections.ball_waviness = vec![BallWave { ball: None, wave: wave(6, 0.5e-6) }];
    out.ball.imperfections.off_size = vec![OffSize { ball: 2, diameter_difference: 1e-6, row: None }];
    out
}

/// Coordinates d_x d_y h_x h_y and of the balls, with their rates: deflections of micrometres, rates of a
/// vibrating rig.
#[derive(Clone)]
struct State {
    q: Vec<f64>,
    rate: Vec<f64>,
}

impl State {
    fn random(random: &mut Random, balls: usize) -> Self {
        let mut draw = |scale: f64, n: usize| (0..n).map(|_| scale * random.next()).collect::<Vec<f64>>();
        let q = [draw(8e-6, 4), draw(8e-6, balls)].concat();
        let rate = [draw(2e-3, 4), draw(2e-3, balls)].concat();
        Self { q, rate }
    }

    fn rings(&self) -> Rings {
        Rings::from_rows(&self.q[..4], &self.rate[..4])
    }

    /// Forces on all coordinates.
    fn forces(&self, element: &RadialElement, rotation: &Rotation) -> Vec<f64> {
        let mut on_balls = vec![0.0; element.balls()];
        let reaction =
            element.forces(&self.rings(), [&self.q[4..], &self.rate[4..]], rotation, &mut on_balls);
        [reaction.force[..4].to_vec(), on_balls].concat()
    }
}

fn spinning(random: &mut Random) -> Rotation {
    Rotation {
        cage_angle: 3.0 * random.next(),
        cage_speed: Some(200.0),
        shaft_angle: 3.0 * random.next(),
        shaft_speed: 520.0,
    }
}

/// Smallest |deflection| of all contacts: near zero a contact opens or closes within the difference step.
fn nearest_kink(
    element: &RadialElement,
    state: &State,
    rotation: &Rotation,
    bearing: &RadialBallBearing,
) -> f64 {
    let g = &bearing.ball.geometry;
    let rings = state.rings();
    (0..element.balls())
        .flat_map(|j| {
            let angle = rotation.cage_angle + std::f64::consts::TAU * j as f64 / g.balls as f64;
            let (sin, cos) = angle.sin_cos();
            let lift =
                state.q[4 + j] - rings.housing_displacement[0] * cos - rings.housing_displacement[1] * sin;
            let radius = 0.5 * g.pitch_diameter + 0.25 * g.radial_clearance + lift;
            let to = [
                radius * cos - rings.relative_displacement[0],
                radius * sin - rings.relative_displacement[1],
            ];
            [lift, 0.5 * g.pitch_diameter - 0.25 * g.radial_clearance - to[0].hypot(to[1])]
        })
        .fold(f64::INFINITY, |least, depth| depth.abs().min(least))
}

#[test]
fn tangents_match_finite_differences() {
    let mut random = Random(11);
    for pulls in [false, true] {
        let bearing = RadialBallBearing { tensile_contact: pulls, ..bearing() };
        let element = RadialElement::new(&bearing);
        let mut compared = 0;
        for _ in 0..60 {
            let state = State::random(&mut random, element.balls());
            let rotation = spinning(&mut random);
            // Within 0.2 um of a kink the √δ of the damping is too curved for a finite difference.
            if nearest_kink(&element, &state, &rotation, &bearing) < 2e-7 {
                continue;
            }
            compared += 1;
            let tangent = element.tangent(&state.rings(), [&state.q[4..], &state.rate[4..]], &rotation);
            for column in 0..state.q.len() {
                let difference = |step: f64, of_rate: bool| {
                    let at = |by: f64| {
                        let mut moved = state.clone();
                        (if of_rate { &mut moved.rate } else { &mut moved.q })[column] += by;
                        moved.forces(&element, &rotation)
                    };
                    let (plus, minus) = (at(step), at(-step));
                    plus.iter().zip(&minus).map(|(p, m)| -(p - m) / (2.0 * step)).collect::<Vec<f64>>()
                };
                let (k, c) = (difference(1e-10, false), difference(1e-6, true));
                for row in 0..state.q.len() {
                    // Stiffness is of 1e7 N/m here, damping of 1e3 N s/m. Loss of contact by the rate is a
                    // kink too, but few states are near it.
                    let (dk, dc) =
                        (k[row] - tangent.stiffness[row][column], c[row] - tangent.damping[row][column]);
                    assert!(
                        dk.abs() < 2e-6 * 1e7 + 2e-6 * k[row].abs(),
                        "K[{row}][{column}]: {} off by {dk}",
                        k[row]
                    );
                    assert!(
                        dc.abs() < 1e-4 + 1e-6 * c[row].abs(),
                        "C[{row}][{column}]: {} off by {dc}",
                        c[row]
                    );
                }
            }
        }
        assert!(compared > 20, "{compared}");
    }
}

#[test]
fn implicit_step_solves_balls_and_gives_ring_tangents() {
    let mut random = Random(5);
    let gain = NewmarkGain { position: 0.7 * 0.25 * 1e-5_f64.powi(2), velocity: 0.7 * 0.5e-5 };
    for pulls in [false, true] {
        let bearing = RadialBallBearing { tensile_contact: pulls, ..bearing() };
        let element = RadialElement::new(&bearing);
        for _ in 0..200 {
            let start = State::random(&mut random, element.balls());
            let rotation = spinning(&mut random);
            let step = |state: &State| {
                let mut at = state.clone();
                let (mut force, mut on_rows) = (vec![0.0; element.balls()], [0.0; 4]);
                let (mut force_tangent, mut stiffness) = (vec![0.0; 4 * element.balls()], vec![0.0; 16]);
                let balls = InternalStep {
                    position: &mut at.q[4..],
                    velocity: &mut at.rate[4..],
                    force: &mut force,
                    force_tangent: &mut force_tangent,
                    stiffness: &mut stiffness,
                };
                let rows = Motion { position: &state.q[..4], velocity: &state.rate[..4] };
                InternalCoordinates::step(&element, rows, balls, &rotation, &gain, &mut on_rows);
                (on_rows, at, force, [stiffness, force_tangent].concat())
            };
            let (on_rows, end, force, tangents) = step(&start);
            let found = end.forces(&element, &rotation);
            for j in 0..element.balls() {
                let acceleration = force[j] / element.ball_mass();
                assert!((end.q[4 + j] - start.q[4 + j] - gain.position * acceleration).abs() < 1e-19);
                assert!((end.rate[4 + j] - start.rate[4 + j] - gain.velocity * acceleration).abs() < 1e-15);
                // Q satisfies its equation to round-off: forces from coordinate errors of 1e-22 m.
                assert!(
                    (found[4 + j] - force[j]).abs() < 2e-10 * (1.0 + force[j].abs()),
                    "{} {}",
                    found[4 + j],
                    force[j]
                );
            }
            for (found, given) in found.iter().zip(&on_rows) {
                assert!((found - given).abs() < 1e-9 * (1.0 + found.abs()));
            }
            if nearest_kink(&element, &end, &rotation, &bearing) < 2e-7 {
                continue;
            }
            // Small step: rates of 2e-5 m/s would shift the kink of an opening contact by 3e-9 m.
            let by = 1e-12;
            let column = |column: usize| {
                let moved = |sign: f64| {
                    let mut state = start.clone();
                    state.q[column] += sign * by;
                    state.rate[column] += sign * by * gain.velocity / gain.position;
                    let (on_rows, _, force, _) = step(&state);
                    [on_rows.to_vec(), force].concat()
                };
                let (plus, minus) = (moved(1.0), moved(-1.0));
                let expected = tangents.chunks_exact(4).map(|row| row[column]);
                for ((plus, minus), expected) in plus.iter().zip(&minus).zip(expected) {
                    let k = -(plus - minus) / (2.0 * by);
                    assert!((k - expected).abs() < 1e-4 * 1e8, "{k} for {expected}");
                }
            };
            (0..4).for_each(column);
        }
    }
}

/// Linear momentum balance: forces among balls, rings and cage are internal; gravity is the only external
/// force.
#[test]
fn linear_momentum_balance_closes() {
    let mut random = Random(3);
    let bearing = bearing();
    let element = RadialElement::new(&bearing);
    let (mass, z) = (element.ball_mass(), element.balls());
    let outer = 0.5 * bearing.ball.geometry.pitch_diameter + 0.25 * bearing.ball.geometry.radial_clearance;
    for _ in 0..100 {
        let state = State::random(&mut random, z);
        let rotation = spinning(&mut random);
        let forces = state.forces(&element, &rotation);
        let h_accel = [3.0 * random.next(), 3.0 * random.next()];
        let (h, v) = (&state.q[2..4], &state.rate[2..4]);
        let w = rotation.cage_speed.unwrap();
        let (mut total, mut weight) = ([0.0; 2], 0.0);
        for j in 0..z {
            let (sin, cos) = (rotation.cage_angle + std::f64::consts::TAU * j as f64 / z as f64).sin_cos();
            let local = |a: &[f64]| [a[0] * cos + a[1] * sin, a[1] * cos - a[0] * sin];
            let (h, v, a) = (local(h), local(v), local(&h_accel));
            let radius = outer + state.q[4 + j] - h[0];
            let radial_rate = state.rate[4 + j] - v[0] - w * h[1];
            // ÿ = Q/m; ρ̈ from ÿ = ρ̈ + d²(h·e_r)/dt².
            let y_accel = forces[4 + j] / mass;
            let radial_accel = y_accel - a[0] - 2.0 * w * v[1] + w * w * h[0];
            let ball = [a[0] + radial_accel - radius * w * w, a[1] + 2.0 * radial_rate * w];
            total[0] += mass * (ball[0] * cos - ball[1] * sin);
            total[1] += mass * (ball[0] * sin + ball[1] * cos);
            weight += mass;
        }
        for k in 0..2 {
            // Force on the rings: Q_d − Q_d + Q_h, minus inertia and plus weight of the carried ball mass Z
            // m/2.
            let rings = forces[2 + k] - bearing.added_ball_mass() * (h_accel[k] - GRAVITY[k]);
            let left = total[k] + rings - weight * GRAVITY[k];
            assert!(left.abs() < 1e-9, "{left} N of {}", forces[k]);
        }
    }
}

#[test]
fn power_balance_closes() {
    let mut random = Random(8);
    for k in 0..100 {
        let element = RadialElement::new(&if k % 2 == 0 { bearing() } else { with_defects() });
        let state = State::random(&mut random, element.balls());
        let rotation = spinning(&mut random);
        let energy = |t: f64| {
            let q: Vec<f64> = state.q.iter().zip(&state.rate).map(|(q, v)| q + t * v).collect();
            let rotation = Rotation {
                cage_angle: rotation.cage_angle + t * rotation.cage_speed.unwrap(),
                shaft_angle: rotation.shaft_angle + t * rotation.shaft_speed,
                ..rotation
            };
            let rings = Rings::from_rows(&q[..4], &state.rate[..4]);
            let mut on_balls = vec![0.0; element.balls()];
            element.forces(&rings, [&q[4..], &state.rate[4..]], &rotation, &mut on_balls).elastic_energy
        };
        let step = 1e-7;
        let stored = (energy(step) - energy(-step)) / (2.0 * step);
        let mut on_balls = vec![0.0; element.balls()];
        let out = element.forces(&state.rings(), [&state.q[4..], &state.rate[4..]], &rotation, &mut on_balls);
        let given: f64 = out.force[..4].iter().chain(&on_balls).zip(&state.rate).map(|(f, v)| f * v).sum();
        let left = given + stored + out.dissipated_power - out.parametric_power;
        let size = given.abs() + stored.abs() + out.dissipated_power.abs();
        assert!(left.abs() < 1e-5 * size + 1e-9, "{left} W of {size}");
        assert!(out.dissipated_power >= 0.0);
    }
}

#[test]
fn rotated_state_gives_rotated_forces() {
    let mut random = Random(21);
    let element = RadialElement::new(&RadialBallBearing { gravity: [0.0; 2], ..bearing() });
    for _ in 0..50 {
        let state = State::random(&mut random, element.balls());
        let rotation = spinning(&mut random);
        let turn = 3.0 * random.next();
        let (sin, cos) = turn.sin_cos();
        let turned = |v: &[f64]| {
            let mut out = v.to_vec();
            for k in [0, 2] {
                (out[k], out[k + 1]) = (cos * v[k] - sin * v[k + 1], sin * v[k] + cos * v[k + 1]);
            }
            out
        };
        let other = State { q: turned(&state.q), rate: turned(&state.rate) };
        let rotated = Rotation {
            cage_angle: rotation.cage_angle + turn,
            shaft_angle: rotation.shaft_angle + turn,
            ..rotation
        };
        let expected = turned(&state.forces(&element, &rotation));
        for (a, b) in other.forces(&element, &rotated).iter().zip(&expected) {
            // Round-off of 1e-20 m on a contact of 1e7 N/m with damping of 1e-4 s.
            assert!((a - b).abs() < 1e-8 * (1.0 + b.abs()), "{a} {b}");
        }
    }
}

/// For zero ball mass the static solution equals the massless-ball model, except for balls off the load line:
/// their line of contact runs through the race centres here, and along e_r in the massless model.
#[test]
fn zero_ball_mass_equals_massless_ball_model() {
    let mut plain = rig_6205();
    let mut light = RadialBallBearing { gravity: GRAVITY, ..bearing() };
    light.ball.ball_material.density = 1e-6;
    plain.ball_material.density = 1e-6;
    let (massless, radial) = (BallElement::new(&plain), RadialElement::new(&light));
    let mut random = Random(2);
    for _ in 0..50 {
        let d = [12e-6 * random.next(), 12e-6 * random.next(), 0.0, 0.0, 0.0, 0.0];
        let rotation =
            Rotation { cage_angle: 3.0 * random.next(), shaft_speed: 520.0, ..Rotation::default() };
        let (a, b) = (massless.reaction(&d, &[0.0; 6], &rotation), radial.reaction(&d, &[0.0; 6], &rotation));
        // d_t²/(2 χ) of deflection: at most (17 um)²/(2 · 15 mm) = 1e-8 m.
        let bound = 1e-8 * (a.stiffness[0][0] + a.stiffness[1][1]) + 1e-6;
        for k in 0..2 {
            assert!((a.force[k] - b.force[k]).abs() < bound, "{} {}", a.force[k], b.force[k]);
        }
        let loads = (massless.ball_loads(&d, &rotation), radial.ball_loads(&d, &rotation));
        for (a, b) in loads.0.iter().zip(&loads.1) {
            // The outer load is the component of the inner load along e_r: 1 − n_r < 1e-6.
            assert!((b.load - b.outer_load).abs() <= 1e-6 * b.load + 1e-9, "{} {}", b.load, b.outer_load);
            let slope = 1.5 * (massless.contacts.stiffness.powi(2) * a.load).cbrt();
            assert!((a.load - b.load).abs() < 1e-8 * slope + 1e-3, "{} {}", a.load, b.load);
        }
    }
}

#[test]
fn ball_equilibrium_and_its_stiffness() {
    let bearing = bearing();
    let element = RadialElement::new(&bearing);
    let mass = element.ball_mass();
    let mut random = Random(4);
    let mut compared = 0;
    for _ in 0..100 {
        let d = [12e-6 * random.next(), 12e-6 * random.next(), 0.0, 0.0, 0.0, 0.0];
        let rotation =
            Rotation { cage_angle: 3.0 * random.next(), shaft_speed: 520.0, ..Rotation::default() };
        let w = element.cage_ratio() * rotation.shaft_speed;
        let mut carried = [0.0; 2];
        for ball in element.ball_loads(&d, &rotation) {
            let (sin, cos) = ball.position.sin_cos();
            let centrifugal = mass * w * w * 0.5 * bearing.ball.geometry.pitch_diameter;
            let weight = mass * (GRAVITY[0] * cos + GRAVITY[1] * sin);
            // ρ is within 15 um of half the pitch diameter: 1e-3 of the centrifugal force.
            assert!(
                (ball.outer_load - ball.load - centrifugal - weight).abs()
                    < 1e-3 * centrifugal + 1e-6 * ball.load
            );
            carried[0] += cos * (ball.outer_load - ball.load);
            carried[1] += sin * (ball.outer_load - ball.load);
        }
        let loads = element.ball_loads(&d, &rotation);
        let geometric: f64 =
            loads.iter().map(|b| b.load / (0.5 * bearing.ball.geometry.pitch_diameter) * 1.01).sum();
        let here = element.reaction(&d, &[0.0; 6], &rotation);
        for k in 0..2 {
            assert!((here.housing_force[k] - carried[k]).abs() < 1e-4);
            // The weight of half the balls crosses the contacts; the cage carries the other half.
            assert!((carried[k] - bearing.added_ball_mass() * GRAVITY[k]).abs() < 0.02);
        }
        for column in 0..2 {
            let at = |by: f64| {
                let mut d = d;
                d[column] += by;
                element.reaction(&d, &[0.0; 6], &rotation).force
            };
            let (plus, minus) = (at(1e-10), at(-1e-10));
            for row in 0..2 {
                let k = -(plus[row] - minus[row]) / 2e-10;
                let dk = k - here.stiffness[row][column];
                // The tangent omits the geometric stiffness −F/χ of every ball, χ half the pitch diameter
                // within 1e-3; an inner contact that opens within the difference changes K by up to 1e6.
                if dk.abs() < geometric + 2e-4 * 1e7 {
                    compared += 1;
                }
            }
        }
    }
    assert!(compared >= 390, "{compared} of 400");
}

//! Outer ring on a preload spring in motion: tangents and power balance against differences, and the ring's velocity.

use crate::ball_bearing::Random;
use crate::ball_combinations::{angular, film, lever, sample};
use rotordyn_bearing::contact::{ContactDamping, ContactLaw};
use rotordyn_bearing::{
    BallBearing, BallElement, BallInertia, BallWave, Imperfections, Preload, Rotation, Wave,
};

/// Bearings with all balls loaded and strong contact damping, so that the ring's own motion matters.
fn bearings() -> Vec<BallBearing> {
    let mut out = Vec::new();
    for contact in [ContactLaw::Hertz, film()] {
        for inertia in [
            BallInertia::None,
            BallInertia::OuterRaceControl,
            BallInertia::HarrisInnerRaceControl,
            BallInertia::Shared,
        ] {
            for damping in [
                ContactDamping::Constant { coefficient: 2e4, ramp: 1e-7 },
                ContactDamping::HuntCrossley { factor: 20.0 },
            ] {
                for direction in [1.0, -1.0] {
                    let mut bearing = angular();
                    bearing.geometry.thrust_direction = direction;
                    bearing.preload = Preload::Spring { stiffness: 5e6, force: 900.0 };
                    bearing.imperfections = Imperfections {
                        inner_waviness: vec![Wave { order: 5, amplitude: 3e-7, phase: 0.4 }],
                        ball_waviness: vec![BallWave {
                            ball: None,
                            wave: Wave { order: 2, amplitude: 1e-7, phase: 0.2 },
                        }],
                        ..Imperfections::default()
                    };
                    out.push(BallBearing { contact: contact.clone(), inertia, damping, ..bearing });
                }
            }
        }
    }
    out
}

/// A state with moderate tilts and displacements, all balls loaded.
fn state(random: &mut Random) -> ([f64; 6], [f64; 6], Rotation) {
    let (d, v, rotation) = sample(random);
    (d.map(|d| 0.25 * d), v, rotation)
}

fn shifted(mut v: [f64; 6], k: usize, by: f64) -> [f64; 6] {
    v[k] += by;
    v
}

#[test]
fn stiffness_and_damping_in_motion_match_differences() {
    let mut random = Random(8);
    let mut moved: f64 = 0.0;
    for bearing in bearings() {
        let name = format!("{:?} {:?} {:?}", bearing.contact, bearing.inertia, bearing.damping);
        let element = BallElement::new(&bearing);
        let (d, v, rotation) = state(&mut random);
        let here = element.reaction(&d, &v, &rotation);
        let still = element.reaction(&d, &[0.0; 6], &Rotation { cage_speed: None, ..rotation });
        for b in 0..5 {
            let (step, rate) = (1e-9 / lever(b), 1e-4 / lever(b));
            let at = |h: f64| element.reaction(&shifted(d, b, h), &v, &rotation).force;
            let along = |h: f64| element.reaction(&d, &shifted(v, b, h), &rotation).force;
            // Differences of fourth order.
            let (s1, s2) = ([at(step), at(-step)], [at(2.0 * step), at(-2.0 * step)]);
            let (r1, r2) = (along(rate), along(-rate));
            for a in 0..5 {
                let k = -(8.0 * (s1[0][a] - s1[1][a]) - (s2[0][a] - s2[1][a])) / (12.0 * step);
                let c = -(r1[a] - r2[a]) / (2.0 * rate);
                let size = |m: &[[f64; 6]; 6]| (m[a][a] * m[b][b]).abs().sqrt();
                let (dk, dc) = (k - here.stiffness[a][b], c - here.damping[a][b]);
                assert!(dk.abs() < 2e-6 * size(&here.stiffness), "{name} K[{a}][{b}]: {k} off by {dk}");
                assert!(dc.abs() < 1e-7 * size(&here.damping), "{name} C[{a}][{b}]: {c} off by {dc}");
                let motion = (here.stiffness[a][b] - still.stiffness[a][b]).abs();
                moved = moved.max(motion / size(&here.stiffness));
            }
        }
    }
    assert!(moved > 0.05, "the motion changes the stiffness by {moved} only: nothing is shown");
}

#[test]
fn power_balance_closes_in_motion() {
    let mut random = Random(9);
    for bearing in bearings() {
        let element = BallElement::new(&bearing);
        let (d, v, start) = state(&mut random);
        let at = |t: f64| {
            let q = std::array::from_fn(|k| d[k] + v[k] * t);
            let passed = |speed: f64| speed * t;
            let rotation = Rotation {
                cage_angle: start.cage_angle + passed(start.cage_speed.unwrap_or(0.0)),
                shaft_angle: start.shaft_angle + passed(start.shaft_speed),
                ..start
            };
            element.reaction(&q, &v, &rotation)
        };
        let h = 2e-8;
        let difference = |h: f64| (at(h).elastic_energy - at(-h).elastic_energy) / (2.0 * h);
        let rate = (4.0 * difference(h) - difference(2.0 * h)) / 3.0;
        let here = at(0.0);
        let work: f64 = here.force.iter().zip(&v).map(|(f, v)| f * v).sum();
        let residual = rate + here.dissipated_power + work - here.parametric_power;
        let size = work.abs() + here.parametric_power.abs() + here.dissipated_power.abs();
        assert!(
            residual.abs() < 1e-7 * size,
            "{:?} {:?} {:?}: {residual} of {size}",
            bearing.contact,
            bearing.inertia,
            bearing.damping
        );
    }
}

/// The damped part of the force is that of a bearing whose rigid ring moves with the velocity of the ring on the spring,
/// found from where the static ring is a moment before and after.
#[test]
fn damping_force_is_that_of_the_moving_ring() {
    let mut random = Random(10);
    for bearing in bearings().into_iter().filter(|b| b.geometry.thrust_direction > 0.0) {
        let (d, v, start) = state(&mut random);
        let element = BallElement::new(&bearing);
        let at = |t: f64| Rotation {
            cage_angle: start.cage_angle + start.cage_speed.unwrap_or(0.0) * t,
            shaft_angle: start.shaft_angle + start.shaft_speed * t,
            ..start
        };
        let place = |t: f64| -> [f64; 6] { std::array::from_fn(|k| d[k] + v[k] * t) };
        // Rigid ring: where the same axial force is reached without spring.
        let rigid = BallElement::new(&BallBearing { preload: Preload::None, ..bearing.clone() });
        let undamped = BallBearing {
            damping: ContactDamping::Constant { coefficient: 0.0, ramp: 1e-7 },
            ..bearing.clone()
        };
        let [soft, bare] = [bearing.preload, Preload::None]
            .map(|preload| BallElement::new(&BallBearing { preload, ..undamped.clone() }));
        let seat = |q: [f64; 6], rotation: &Rotation| {
            let target = soft.reaction(&q, &[0.0; 6], rotation).force[2];
            let mut shift = 0.0;
            for _ in 0..50 {
                let found = bare.reaction(&shifted(q, 2, shift), &[0.0; 6], rotation);
                shift += (found.force[2] - target) / found.stiffness[2][2];
            }
            shift
        };
        let ring = |t: f64| seat(place(t), &at(t));
        let h = 1e-7;
        let velocity = (ring(h) - ring(-h)) / (2.0 * h);
        let (moved, moving) = (shifted(d, 2, ring(0.0)), shifted(v, 2, velocity));
        let damped = rigid.reaction(&moved, &moving, &start);
        let elastic = bare.reaction(&moved, &moving, &start);
        let whole = soft.reaction(&d, &v, &start);
        let found = element.reaction(&d, &v, &start);
        let follow = |k: usize| {
            let step = 1e-9 / lever(k);
            let at = |by: f64| seat(shifted(d, k, by), &start);
            (at(step) - at(-step)) / (2.0 * step)
        };
        let axial = damped.force[2] - elastic.force[2];
        for k in 0..5 {
            let expected = whole.force[k] + damped.force[k] - elastic.force[k] + follow(k) * axial;
            let off = found.force[k] - expected;
            let size = axial.abs().max(1.0) * lever(k);
            assert!(off.abs() < 1e-4 * size, "{:?} {k}: {} for {expected}", bearing.inertia, found.force[k]);
        }
    }
}

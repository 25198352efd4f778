//! Invariants of every allowed combination of contact law, ball inertia, preload and pair arrangement.

use crate::ball_bearing::Random;
use crate::bearing::rig_6205;
use crate::ehl_table::tabulated;
use rotordyn_bearing::contact::{ContactDamping, ContactLaw, Lubricant};
use rotordyn_bearing::{
    Arrangement, BallBearing, BallElement, BallInertia, Duplex, Preload, Reaction, Rotation, Wave,
};

pub fn film() -> ContactLaw {
    let lubricant =
        Lubricant { name: "oil".into(), viscosity: 0.04, pressure_viscosity: 2.2e-8, density: 870.0 };
    ContactLaw::Film { lubricant, speed_factor: 1.0 }
}

const INERTIA: [BallInertia; 6] = [
    BallInertia::None,
    BallInertia::OuterRaceControl,
    BallInertia::InnerRaceControl,
    BallInertia::HarrisInnerRaceControl,
    BallInertia::Shared,
    BallInertia::Centrifugal,
];

const PRELOAD: [Preload; 5] = [
    Preload::None,
    Preload::Interference(8e-6),
    Preload::DryForce(300.0),
    Preload::Force(300.0),
    Preload::Spring { stiffness: 2e6, force: 300.0 },
];

/// The rig's bearing at a contact angle.
pub fn angular() -> BallBearing {
    let mut bearing = rig_6205();
    bearing.geometry.contact_angle = 0.4;
    bearing.geometry.radial_clearance = 0.0;
    bearing
}

/// Calls `visit` with every combination of the bearing's options.
pub fn for_each_combination(mut visit: impl FnMut(&str, &BallBearing)) {
    let pairs =
        [None, Some(Arrangement::BackToBack), Some(Arrangement::FaceToFace), Some(Arrangement::Tandem)];
    for law in [ContactLaw::Hertz, film(), tabulated(&angular().hertz())] {
        for inertia in INERTIA {
            for preload in PRELOAD {
                for arrangement in pairs {
                    for damping in [
                        ContactDamping::Constant { coefficient: 300.0, ramp: 1e-6 },
                        ContactDamping::HuntCrossley { factor: 0.05 },
                    ] {
                        let mut bearing = angular();
                        bearing.contact = law.clone();
                        bearing.inertia = inertia;
                        bearing.preload = preload;
                        bearing.duplex =
                            arrangement.map(|arrangement| Duplex { arrangement, spacing: 15e-3 });
                        bearing.damping = damping;
                        bearing.imperfections.inner_waviness =
                            vec![Wave { order: 7, amplitude: 2e-7, phase: 0.4 }];
                        bearing.imperfections.outer_waviness =
                            vec![Wave { order: 8, amplitude: 2e-7, phase: 0.3 }];
                        let name = format!("{law:?} {inertia:?} {preload:?} {arrangement:?} {damping:?}");
                        visit(&name, &bearing);
                    }
                }
            }
        }
    }
}

pub fn sample(random: &mut Random) -> ([f64; 6], [f64; 6], Rotation) {
    let d = random.scaled([4e-6, 4e-6, 6e-6, 2e-4, 2e-4, 0.0]);
    let v = random.scaled([3e-3, 3e-3, 3e-3, 0.2, 0.2, 0.0]);
    let rotation = Rotation {
        cage_angle: 3.0 * random.next(),
        cage_speed: Some(1000.0),
        shaft_angle: 3.0 * random.next(),
        shaft_speed: 2500.0,
    };
    (d, v, rotation)
}

/// Lever that makes moments and tilts comparable to forces and displacements.
pub fn lever(k: usize) -> f64 {
    if k < 3 { 1.0 } else { 0.02 }
}

fn largest(m: &[[f64; 6]; 6]) -> f64 {
    let mut most: f64 = 0.0;
    for (a, row) in m.iter().enumerate() {
        for (b, v) in row.iter().enumerate() {
            most = most.max(v.abs() / (lever(a) * lever(b)));
        }
    }
    most
}

#[test]
fn tangents_match_finite_differences() {
    let mut random = Random(31);
    let mut compared = 0;
    for_each_combination(|name, bearing| compared += compare_tangents(&mut random, name, bearing));
    assert!(compared > 10_000);
}

/// Compares both tangents with finite differences at four random states; returns the number of entries.
pub fn compare_tangents(random: &mut Random, name: &str, bearing: &BallBearing) -> usize {
    let mut compared = 0;
    let element = BallElement::new(bearing);
    for _ in 0..4 {
        let (d, v, rotation) = sample(random);
        let here = element.reaction(&d, &v, &rotation);
        let (k_size, c_size) = (largest(&here.stiffness), largest(&here.damping));
        for column in 0..5 {
            let (step, rate) = (1e-10 / lever(column), 1e-4 / lever(column));
            let shifted = |vector: [f64; 6], by: f64| {
                let mut w = vector;
                w[column] += by;
                w
            };
            let at = |by| element.reaction(&shifted(d, by), &v, &rotation);
            let (plus, minus) = (at(step), at(-step));
            let along = |by| element.reaction(&d, &shifted(v, by), &rotation);
            let (faster, slower) = (along(rate), along(-rate));
            // A ball that loses contact within the step has a kink; otherwise its damping is constant.
            let loses_contact = (0..5)
                .any(|a| (0..5).any(|b| (faster.damping[a][b] - slower.damping[a][b]).abs() > 1e-9 * c_size));
            for row in 0..5 {
                let scale = lever(row) * lever(column);
                let k = -(plus.force[row] - minus.force[row]) / (2.0 * step);
                // Mean of both ends, since the tangent changes within the step, e.g. where a ball unloads.
                let mean = 0.5 * (plus.stiffness[row][column] + minus.stiffness[row][column]);
                let c = -(faster.force[row] - slower.force[row]) / (2.0 * rate);
                let (dk, dc) = (k - mean, c - here.damping[row][column]);
                // A ball that unloads or meets a defect within the step: an error below half the change of K there.
                let change = (plus.stiffness[row][column] - minus.stiffness[row][column]).abs();
                assert!(
                    dk.abs() <= 2e-4 * k_size * scale + 0.5 * change,
                    "{name} K[{row}][{column}] {k} off by {dk}, change {change}"
                );
                assert!(
                    loses_contact || dc.abs() <= 1e-6 * c_size * scale,
                    "{name} C[{row}][{column}] {c} off by {dc}"
                );
                compared += 1;
            }
        }
    }
    compared
}

#[test]
fn power_balance_closes() {
    let mut random = Random(5);
    for_each_combination(|name, bearing| check_power_balance(&mut random, name, bearing));
}

/// d(energy)/dt + dissipation = −f·v + parametric power along a straight path with rotating cage.
pub fn check_power_balance(random: &mut Random, name: &str, bearing: &BallBearing) {
    let element = BallElement::new(bearing);
    let (d, v, start) = sample(random);
    let at = |t: f64| -> Reaction {
        let q = std::array::from_fn(|k| d[k] + v[k] * t);
        let rotation = Rotation {
            cage_angle: start.cage_angle + start.cage_speed.unwrap() * t,
            shaft_angle: start.shaft_angle + start.shaft_speed * t,
            ..start
        };
        element.reaction(&q, &v, &rotation)
    };
    let h = 2e-9;
    let rate = (at(h).elastic_energy - at(-h).elastic_energy) / (2.0 * h);
    let here = at(0.0);
    let work: f64 = here.force.iter().zip(&v).map(|(f, v)| f * v).sum();
    let residual = rate + here.dissipated_power + work - here.parametric_power;
    let size = work.abs() + here.parametric_power.abs() + here.dissipated_power.abs();
    assert!(residual.abs() <= 1e-5 * size, "{name}: {residual} of {size}");
}

#[test]
fn rotating_displacement_and_cage_rotates_force() {
    let mut random = Random(3);
    for_each_combination(|name, bearing| {
        let mut bearing = bearing.clone();
        bearing.imperfections.inner_waviness.clear();
        bearing.imperfections.outer_waviness.clear();
        let element = BallElement::new(&bearing);
        let (d, v, rotation) = sample(&mut random);
        let angle: f64 = random.next() * 3.0;
        let (s, c) = angle.sin_cos();
        let turn = |w: [f64; 6]| {
            [c * w[0] - s * w[1], s * w[0] + c * w[1], w[2], c * w[3] - s * w[4], s * w[3] + c * w[4], w[5]]
        };
        let turned = Rotation { cage_angle: rotation.cage_angle + angle, ..rotation };
        let plain = element.reaction(&d, &v, &rotation);
        let other = element.reaction(&turn(d), &turn(v), &turned);
        let expected = turn(plain.force);
        let size = plain.force.iter().enumerate().fold(0.0, |m: f64, (k, f)| m.max(f.abs() / lever(k)));
        for (k, (a, b)) in expected.into_iter().zip(other.force).enumerate() {
            assert!((a - b).abs() < 1e-9 * size * lever(k), "{name}");
        }
        // Averaged over the cage angle, rotating the displacement alone suffices, up to harmonics missed by
        // 12 angles.
        let plain = turn(element.cage_average(&d, &rotation, 12).force);
        let other = element.cage_average(&turn(d), &rotation, 12).force;
        for k in 0..5 {
            assert!((plain[k] - other[k]).abs() < 2e-3 * size * lever(k), "{name}: {plain:?} {other:?}");
        }
    });
}

#[test]
fn ball_inertia_has_no_effect_at_rest() {
    let mut random = Random(8);
    for_each_combination(|name, bearing| {
        let massless = BallElement::new(&BallBearing { inertia: BallInertia::None, ..bearing.clone() });
        let element = BallElement::new(bearing);
        let (d, v, _) = sample(&mut random);
        // At rest and at very low speed, where the centrifugal force is 1e-11 N on each of up to 18 balls.
        for (shaft_speed, tolerance) in [(0.0, 1e-15), (1e-3, 3e-10)] {
            let rotation = Rotation { cage_angle: 0.3, shaft_speed, ..Rotation::default() };
            let (a, b) = (element.reaction(&d, &v, &rotation), massless.reaction(&d, &v, &rotation));
            for k in 0..5 {
                let off = a.force[k] - b.force[k];
                assert!(off.abs() <= tolerance * (1.0 + b.force[k].abs()), "{name}: force {k} off by {off}");
                for m in 0..5 {
                    let (x, y) = (a.stiffness[k][m], b.stiffness[k][m]);
                    // Without load, the contacts under the balls' own force remain.
                    let size = 1e3 + largest(&b.stiffness);
                    assert!((x - y).abs() <= 1e3 * tolerance * size, "{name}: {x} {y}");
                }
            }
        }
    });
}

#[test]
fn dry_law_does_no_work_on_closed_path() {
    for duplex in [None, Some(Duplex { arrangement: Arrangement::BackToBack, spacing: 15e-3 })] {
        for preload in PRELOAD {
            let element = BallElement::new(&BallBearing { preload, duplex, ..angular() });
            let at = |t: f64| -> [f64; 6] {
                let (s, c) = (std::f64::consts::TAU * t).sin_cos();
                [6e-6 * c, 5e-6 * s, 4e-6 * s + 2e-6 * c, 2e-4 * c, 1e-4 * s, 0.0]
            };
            let rotation = Rotation { cage_angle: 0.2, ..Rotation::default() };
            let n = 4000;
            let (mut work, mut size) = (0.0, 0.0);
            for k in 0..n {
                let (a, b) = (at(f64::from(k) / f64::from(n)), at(f64::from(k + 1) / f64::from(n)));
                let middle = at((f64::from(k) + 0.5) / f64::from(n));
                let force = element.reaction(&middle, &[0.0; 6], &rotation).force;
                let step: f64 = (0..5).map(|k| force[k] * (b[k] - a[k])).sum();
                work += step;
                size += step.abs();
            }
            // Midpoint rule with 4000 steps; balls unload along the path.
            assert!(work.abs() < 1e-5 * size, "{preload:?}: {work} of {size}");
        }
    }
}

//! Bearings with waviness, off-size balls and defects: invariants of perfect bearings in every combination.

use crate::ball_bearing::Random;
use crate::ball_combinations::{
    angular, check_power_balance, compare_tangents, for_each_combination, lever, sample,
};
use crate::bearing::rig_6205;
use rotordyn_bearing::{
    BallBearing, BallElement, BallInertia, BallSpin, BallWave, BearingElement, Defect, DefectForm, DefectLaw,
    Imperfections, OffSize, Preload, Rotation, Shape, Surface, Wave,
};
use std::f64::consts::TAU;

/// Imperfections of every kind; defects wide enough to be under several balls at any time.
pub fn all_imperfections(law: DefectLaw) -> Imperfections {
    let defect = |on, start, width, form| Defect { surface: on, row: None, start, width, form };
    let dent = DefectForm::Dent { depth: Some(0.8e-6), shape: Shape::HalfSine };
    let bump = DefectForm::Bump { height: 0.6e-6, shape: Shape::Cap };
    let spall = DefectForm::Spall { depth: 1.5e-6, edge_radius: 0.3e-3 };
    Imperfections {
        inner_waviness: vec![Wave { order: 7, amplitude: 2e-7, phase: 0.4 }],
        outer_waviness: vec![Wave { order: 8, amplitude: 2e-7, phase: 0.3 }],
        ball_waviness: vec![
            BallWave { ball: None, wave: Wave { order: 2, amplitude: 1e-7, phase: 0.1 } },
            BallWave { ball: Some(3), wave: Wave { order: 5, amplitude: 1e-7, phase: 1.1 } },
        ],
        off_size: vec![
            OffSize { ball: 1, diameter_difference: 0.4e-6, row: None },
            OffSize { ball: 4, diameter_difference: -0.3e-6, row: Some(0) },
        ],
        defects: vec![
            defect(Surface::Outer, 0.2, 12e-3, dent),
            defect(Surface::Outer, 2.1, 20e-3, spall),
            defect(Surface::Inner, -1.0, 14e-3, bump),
            defect(Surface::Inner, 1.5, 10e-3, DefectForm::Spall { depth: 1e-6, edge_radius: 0.5e-3 }),
            defect(Surface::Ball(2), 0.0, 8e-3, DefectForm::Spall { depth: 0.7e-6, edge_radius: 0.2e-3 }),
            defect(Surface::Ball(5), 1.0, 9e-3, DefectForm::Dent { depth: Some(0.5e-6), shape: Shape::Cap }),
            Defect { row: Some(1), ..defect(Surface::Outer, 4.4, 9e-3, bump) },
        ],
        law,
        spin: BallSpin::Rolling,
    }
}

const LAWS: [DefectLaw; 4] = [
    DefectLaw::Displacement,
    DefectLaw::UndampedDisplacement,
    DefectLaw::Force { stiffness: None, loaded_only: false },
    DefectLaw::Force { stiffness: Some(5e9), loaded_only: true },
];

/// Calls `visit` with every combination that permits the defect law.
fn for_each_with_imperfections(mut visit: impl FnMut(&str, &BallBearing)) {
    for law in LAWS {
        for_each_combination(|name, bearing| {
            let bearing = BallBearing { imperfections: all_imperfections(law), ..bearing.clone() };
            if bearing.problems().is_empty() {
                visit(&format!("{law:?} {name}"), &bearing);
            }
        });
    }
}

#[test]
fn tangents_match_finite_differences() {
    let mut random = Random(77);
    let mut compared = 0;
    for_each_with_imperfections(|name, bearing| compared += compare_tangents(&mut random, name, bearing));
    assert!(compared > 100_000, "{compared}");
}

#[test]
fn power_balance_closes() {
    let mut random = Random(19);
    let mut damaged = 0;
    for_each_with_imperfections(|name, bearing| {
        check_power_balance(&mut random, name, bearing);
        damaged += 1;
    });
    assert!(damaged > 1000, "{damaged}");
}

/// The force for explicit integration equals the force evaluated with tangents.
#[test]
fn force_only_equals_force_with_tangents() {
    let mut random = Random(23);
    for_each_with_imperfections(|name, bearing| {
        let (d, v, rotation) = sample(&mut random);
        crate::force_only::compare(name, bearing, &d, &v, &rotation);
    });
}

#[test]
fn force_laws_are_rejected_where_undefined() {
    let forced = Imperfections { law: LAWS[2], ..Imperfections::default() };
    for (inertia, preload) in [
        (BallInertia::Shared, Preload::None),
        (BallInertia::None, Preload::Spring { stiffness: 1e6, force: 100.0 }),
    ] {
        let bearing = BallBearing { inertia, preload, imperfections: forced.clone(), ..angular() };
        assert_eq!(bearing.problems().len(), 1);
    }
    let lost = Imperfections {
        off_size: vec![OffSize { ball: 9, diameter_difference: 1e-6, row: None }],
        ..Default::default()
    };
    assert_eq!(BallBearing { imperfections: lost, ..rig_6205() }.problems().len(), 1);
}

#[test]
fn rotating_bearing_and_imperfections_rotates_force() {
    let mut random = Random(4);
    for_each_with_imperfections(|name, bearing| {
        let (d, v, rotation) = sample(&mut random);
        let angle = 3.0 * random.next();
        let (s, c) = angle.sin_cos();
        let turn = |w: [f64; 6]| {
            [c * w[0] - s * w[1], s * w[0] + c * w[1], w[2], c * w[3] - s * w[4], s * w[3] + c * w[4], w[5]]
        };
        // Rotate both rings with their imperfections and the cage with its balls, without ball spin.
        let mut turned = bearing.clone();
        turned.cage_angle += angle;
        let marks = &mut turned.imperfections;
        for wave in marks.inner_waviness.iter_mut().chain(&mut marks.outer_waviness) {
            wave.phase -= f64::from(wave.order) * angle;
        }
        for defect in &mut marks.defects {
            if !matches!(defect.surface, Surface::Ball(_)) {
                defect.start += angle;
            }
        }
        let plain = BallElement::new(bearing).reaction(&d, &v, &rotation);
        let there = Rotation { cage_angle: rotation.cage_angle + angle, ..rotation };
        let other = BallElement::new(&turned).reaction(&turn(d), &turn(v), &there);
        let size = plain.force.iter().enumerate().fold(0.0, |m: f64, (k, f)| m.max(f.abs() / lever(k)));
        for (k, (a, b)) in turn(plain.force).into_iter().zip(other.force).enumerate() {
            assert!((a - b).abs() < 1e-9 * size * lever(k), "{name}: {a} {b}");
        }
    });
}

#[test]
fn zero_size_imperfections_have_no_effect() {
    let mut random = Random(12);
    let defect = |on, width, form| Defect { surface: on, row: None, start: 0.3, width, form };
    let nothing = Imperfections {
        inner_waviness: vec![Wave { order: 7, amplitude: 0.0, phase: 0.4 }],
        ball_waviness: vec![BallWave { ball: None, wave: Wave { order: 2, amplitude: 0.0, phase: 0.0 } }],
        off_size: vec![OffSize { ball: 0, diameter_difference: 0.0, row: None }],
        defects: vec![
            defect(Surface::Outer, 0.0, DefectForm::Dent { depth: None, shape: Shape::HalfSine }),
            defect(Surface::Outer, 1e-3, DefectForm::Dent { depth: Some(0.0), shape: Shape::Cap }),
            defect(Surface::Inner, 1e-3, DefectForm::Bump { height: 0.0, shape: Shape::Cap }),
            defect(Surface::Ball(1), 1e-3, DefectForm::Spall { depth: 0.0, edge_radius: 0.0 }),
            defect(Surface::Outer, 0.0, DefectForm::Spall { depth: 1e-3, edge_radius: 0.0 }),
        ],
        ..Imperfections::default()
    };
    for law in LAWS {
        for_each_combination(|name, bearing| {
            let perfect = BallBearing { imperfections: Imperfections::default(), ..bearing.clone() };
            let marked =
                BallBearing { imperfections: Imperfections { law, ..nothing.clone() }, ..perfect.clone() };
            let (d, v, rotation) = sample(&mut random);
            let at = |bearing| BallElement::new(bearing).reaction(&d, &v, &rotation);
            assert_eq!(at(&perfect), at(&marked), "{name}");
        });
    }
}

#[test]
fn eccentric_race_equals_displaced_ring() {
    let mut random = Random(6);
    let d = [5e-6, -7e-6, 0.0, 0.0, 0.0, 0.0];
    let (by, towards) = (1.5e-6, 0.7_f64);
    for inner in [true, false] {
        let mut bearing = rig_6205();
        let marks = &mut bearing.imperfections;
        if inner {
            marks.inner_waviness.push(Wave::eccentric_inner(by, towards, 0.0));
        } else {
            marks.outer_waviness.push(Wave::eccentric_outer(by, towards, 0.0));
        }
        let rotation =
            Rotation { cage_angle: random.next(), shaft_angle: random.next(), ..Rotation::default() };
        let (way, sign) = if inner { (towards + rotation.shaft_angle, 1.0) } else { (towards, -1.0) };
        let moved = [d[0] + sign * by * way.cos(), d[1] + sign * by * way.sin(), 0.0, 0.0, 0.0, 0.0];
        let here = BallElement::new(&bearing).reaction(&d, &[0.0; 6], &rotation).force;
        let there = BallElement::new(&rig_6205()).reaction(&moved, &[0.0; 6], &rotation).force;
        for k in 0..2 {
            assert!((here[k] - there[k]).abs() < 1e-9 * there[0].hypot(there[1]), "{here:?} {there:?}");
        }
    }
}

#[test]
fn oversize_ball_increases_approach() {
    let mut bearing = rig_6205();
    let (d, rotation) = ([8e-6, 2e-6, 0.0, 0.0, 0.0, 0.0], Rotation::default());
    let before = BallElement::new(&bearing).ball_loads(&d, &rotation);
    bearing.imperfections.off_size = vec![OffSize { ball: 1, diameter_difference: 0.3e-6, row: None }];
    let after = BallElement::new(&bearing).ball_loads(&d, &rotation);
    for (j, (a, b)) in before.iter().zip(&after).enumerate() {
        let excess = if j == 1 { 0.3e-6 } else { 0.0 };
        assert!((b.deflection - a.deflection - excess).abs() < 1e-18, "{j}");
    }
    // The mean over cage angles is that of the nominal bearing.
    let mean = |b| BallElement::new(b).cage_average(&d, &rotation, 4);
    assert_eq!(mean(&bearing), mean(&rig_6205()));
}

#[test]
fn ball_defect_passes_each_race_once_per_spin_revolution() {
    let mut bearing = rig_6205();
    let form = DefectForm::Bump { height: 1e-6, shape: Shape::HalfSine };
    let width = 0.2e-3;
    bearing.imperfections.defects =
        vec![Defect { surface: Surface::Ball(0), row: None, start: 1.0, width, form }];
    let orders = bearing.geometry.characteristic_orders(0.0);
    for (spin, order) in [(BallSpin::Rolling, orders.bsf), (BallSpin::Shaft, 1.0)] {
        bearing.imperfections.spin = spin;
        let profile =
            rotordyn_bearing::Profile::new(&bearing.geometry, &bearing.imperfections, 0, 0.0, 1e10).unwrap();
        // Passages of the middle of the bump, in shaft revolutions.
        let turns = 40.0;
        let steps = 400_000;
        let mut passages = [const { Vec::new() }; 2];
        let mut before = [0.0; 2];
        for k in 0..steps {
            let shaft = std::f64::consts::TAU * turns * f64::from(k) / f64::from(steps);
            let rotation = Rotation {
                shaft_angle: shaft,
                shaft_speed: 1.0,
                cage_angle: orders.ftf * shaft,
                cage_speed: Some(orders.ftf),
            };
            let at = profile.at_rotation(&rotation).ball(0);
            for contact in 0..2 {
                if before[contact] > 0.0 && at.rate[contact] < 0.0 {
                    passages[contact].push(shaft / std::f64::consts::TAU);
                }
                before[contact] = at.rate[contact];
            }
        }
        let step = turns / f64::from(steps);
        let middle = (1.0 + 0.5 * width / (0.5 * bearing.geometry.ball_diameter)) / std::f64::consts::TAU;
        // The angle counts against the spin: the defect passes the outer race, half a revolution later the
        // inner race.
        for (contact, offset) in [(1, 0.0), (0, 0.5)] {
            let first = (middle + offset).rem_euclid(1.0);
            assert_eq!(passages[contact].len(), (turns * order - first).ceil() as usize);
            for (k, turn) in passages[contact].iter().enumerate() {
                let expected = (first + k as f64) / order;
                assert!((turn - expected).abs() <= step, "{spin:?} {contact} {k}: {turn} {expected}");
            }
        }
    }
}

/// A rotation meets a defect if a ball has a deviation at some time of it, and passes an edge where the first or last ball has one.
#[test]
fn passages_over_defects_are_where_balls_deviate() {
    let form = DefectForm::Dent { depth: Some(2e-6), shape: Shape::HalfSine };
    let defect = |surface, start, width| Defect { surface, row: None, start, width, form };
    let mut random = Random(11);
    for surface in [Surface::Outer, Surface::Inner, Surface::Ball(2)] {
        for speed in [1.0, -1.0] {
            let mut bearing = rig_6205();
            bearing.imperfections.defects = vec![defect(surface, 0.4, 0.6e-3), defect(surface, 5.9, 1.3e-3)];
            let element = BallElement::new(&bearing);
            let profile =
                rotordyn_bearing::Profile::new(&bearing.geometry, &bearing.imperfections, 0, 0.0, 1e10)
                    .unwrap();
            let at = |shaft: f64| Rotation {
                shaft_angle: speed * shaft,
                shaft_speed: speed,
                cage_angle: 0.4 * speed * shaft,
                cage_speed: Some(0.4 * speed),
            };
            // Contacts in a defect, 333 times in a degree of the shaft.
            let fine = |k: u32| TAU / 120e3 * f64::from(k);
            // One bit for each contact that is in a defect.
            let contacts: Vec<u32> = (0..360_000)
                .map(|k| {
                    let state = profile.at_rotation(&at(fine(k)));
                    (0..bearing.geometry.balls).fold(0, |bits, j| {
                        let [inner, outer] = state.ball(j).height.map(|height| u32::from(height != 0.0));
                        bits << 2 | inner << 1 | outer
                    })
                })
                .collect();
            let [mut with, mut edges] = [0, 0];
            let mut from = 0;
            while from < 357_000 {
                let to = from + 1 + (1500.0 * random.next().abs()) as usize;
                let within = &contacts[from..=to];
                let [start, end] = [from, to].map(|k| at(fine(k as u32)));
                assert_eq!(
                    element.meets_defect(&start, &end),
                    within.iter().any(|bits| *bits > 0),
                    "{surface:?} {speed} {from} {to}"
                );
                let mut parts = Vec::new();
                element.each_defect_edge(&start, &end, &mut |part| parts.push(part));
                let changes: Vec<usize> = (1..within.len())
                    .flat_map(|k| vec![k; (within[k] ^ within[k - 1]).count_ones() as usize])
                    .collect();
                parts.sort_by(f64::total_cmp);
                assert_eq!(parts.len(), changes.len(), "{surface:?} {speed} {from} {to}");
                for (part, change) in parts.iter().zip(&changes) {
                    let step = part * (to - from) as f64;
                    assert!(step <= *change as f64 + 1e-6 && step >= *change as f64 - 1.0 - 1e-6);
                }
                with += usize::from(element.meets_defect(&start, &end));
                edges += parts.len();
                from = to;
            }
            assert!(with > 20 && edges > 20, "{with} {edges}");
        }
    }
    assert!(!BallElement::new(&rig_6205()).has_defects());
}

/// At rest the reaction is the sum of the ball loads along their contact lines, and the mean cosine is weighted by load.
#[test]
fn reaction_at_rest_is_the_sum_of_ball_loads() {
    let mut random = Random(31);
    let mut negative = 0;
    for_each_with_imperfections(|name, bearing| {
        let (d, _, rotation) = sample(&mut random);
        let rotation = Rotation { cage_speed: None, shaft_speed: 0.0, ..rotation };
        let element = BallElement::new(bearing);
        let reaction = element.reaction(&d, &[0.0; 6], &rotation);
        let loads = element.ball_loads(&d, &rotation);
        let sum = |part: &dyn Fn(f64, f64) -> f64| -> f64 {
            loads.iter().map(|b| b.load * part(b.contact_angle, b.position)).sum()
        };
        let force = [
            -sum(&|alpha, psi| alpha.cos() * psi.cos()),
            -sum(&|alpha, psi| alpha.cos() * psi.sin()),
            -sum(&|alpha, _| alpha.sin()),
        ];
        let scale: f64 = loads.iter().map(|b| b.load.abs()).sum::<f64>().max(1e-3);
        negative += usize::from(loads.iter().any(|b| b.load < 0.0));
        for (k, expected) in force.into_iter().enumerate() {
            // Round-off of a sum over up to 18 balls.
            assert!(
                (reaction.force[k] - expected).abs() < 1e-12 * scale,
                "{name} {k}: {reaction:?} {force:?}"
            );
        }
        let total = sum(&|_, _| 1.0);
        if total > 1e-3 * scale {
            let mean = sum(&|alpha, _| alpha.cos()) / total;
            assert!((reaction.mean_cos - mean).abs() < 1e-12 * scale / total, "{name}: {mean}");
        }
    });
    // The published force law lets unloaded balls pull.
    assert!(negative > 10, "{negative}");
}

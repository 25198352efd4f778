//! One bearing: force and tangent stiffness of its balls; stiffness map.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use rotordyn::analysis::bearing_stiffness::{BearingSolver, Condition};
use rotordyn::analysis::equilibrium::CageTreatment;
use rotordyn::bearing::{BallBearing, BallElement, BallInertia, Preload, Rotation};

#[path = "../crates/rotordyn-bearing/tests/common/bearing.rs"]
mod bearing;

/// Displacement that loads four of the rig's nine balls.
const PLACE: [f64; 6] = [7.7e-6, -8.8e-6, 7.2e-6, 8.0e-4, -2.7e-4, 0.0];

fn reaction(c: &mut Criterion) {
    let dry = BallElement::new(&bearing::rig_6205());
    let still = Rotation { cage_angle: 0.3, ..Rotation::default() };
    let moving = Rotation { cage_angle: 0.3, cage_speed: Some(50.0), shaft_angle: 0.7, shaft_speed: 125.0 };
    // Thrust loads all nine balls.
    let thrust = [1e-6, 2e-6, 1e-4, 1e-5, 2e-5, 0.0];
    for (name, place) in [("some", PLACE), ("all", thrust)] {
        c.bench_function(&format!("dry_9_balls_{name}_loaded"), |b| {
            b.iter(|| dry.reaction(black_box(&place), &[0.0; 6], &still));
        });
    }
    c.bench_function("dry_9_balls_moving", |b| {
        b.iter(|| dry.reaction(black_box(&thrust), black_box(&[1e-4; 6]), &moving));
    });
    let fast = Rotation { cage_angle: 0.3, cage_speed: Some(600.0), shaft_angle: 0.7, shaft_speed: 1500.0 };
    for (name, inertia) in [
        ("outer_race_control", BallInertia::OuterRaceControl),
        ("inner_race_control", BallInertia::InnerRaceControl),
        ("shared", BallInertia::Shared),
    ] {
        let element = BallElement::new(&BallBearing { inertia, ..bearing::rig_6205() });
        c.bench_function(&format!("jones_9_balls_{name}"), |b| {
            b.iter(|| element.reaction(black_box(&thrust), black_box(&[1e-4; 6]), &fast));
        });
    }
    for (name, inertia) in [
        ("massless", BallInertia::None),
        ("jones", BallInertia::OuterRaceControl),
        ("shared", BallInertia::Shared),
    ] {
        let preload = Preload::Spring { stiffness: 2e6, force: 300.0 };
        let element = BallElement::new(&BallBearing { inertia, preload, ..bearing::rig_6205() });
        c.bench_function(&format!("{name}_9_balls_spring_preload"), |b| {
            b.iter(|| element.reaction(black_box(&thrust), black_box(&[1e-4; 6]), &fast));
        });
    }
}

/// 20 loads by 20 cage angles of one ball pitch: equilibrium and 5x5 stiffness of each.
fn stiffness_map(c: &mut Criterion) {
    let solver = BearingSolver::new("6205", &bearing::rig_6205());
    let at = |angle: usize, load: usize| Condition {
        load: [0.0, -100.0 * (load + 1) as f64, 20.0 * (load + 1) as f64, 0.2, 0.0],
        prescribed: [None; 5],
        speed: 0.0,
        cage: CageTreatment::FixedAngle,
        cage_angle: std::f64::consts::TAU / 9.0 * angle as f64 / 20.0,
    };
    let rows: Vec<Vec<Condition>> = (0..20).map(|a| (0..20).map(|l| at(a, l)).collect()).collect();
    c.bench_function("stiffness_map_400_points", |b| {
        b.iter(|| solver.map(black_box(&rows)).map(|m| m.len()))
    });
}

criterion_group!(benches, reaction, stiffness_map);
criterion_main!(benches);

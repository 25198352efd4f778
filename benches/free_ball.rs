//! CPU time of one simulated millisecond of a 6205 with free balls and cage at 1200 rpm: seconds per simulated second are
//! the times in milliseconds.

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use free_balls::{ball_bearing, free, geometry_6205, plastic_cage, rings, rpm};
use rotordyn::bearing::free_ball::{
    ClosedForms, Distances, FreeBallState, FreeBalls, Guidance, Pocket, SlipModel,
};
use rotordyn::geometry::parry::ParryDistances;
use rotordyn::geometry::rapier::BodyCollisions;

#[path = "../crates/rotordyn-bearing/tests/free_ball/bearings.rs"]
#[allow(dead_code)] // the tests of the bearing crate use the rest
mod free_balls;

const SPEED_RPM: f64 = 1200.0;
const DURATION: f64 = 1e-3;

fn bearing(slip: SlipModel) -> FreeBalls {
    let mut bearing = free(ball_bearing(geometry_6205(9, -4e-6)), 0.06, 1e-2, slip);
    bearing.damping = 1.0;
    bearing.gravity = [0.0, -9.80665, 0.0];
    bearing.cage = Some(plastic_cage(Pocket::Cylindrical, Guidance::Balls, 0.1));
    FreeBalls::new(bearing, rpm(SPEED_RPM)).expect("the bearing is valid")
}

fn simulated<D: Distances>(balls: &FreeBalls, distances: &D, start: &FreeBallState, step: f64) -> f64 {
    let mut state = start.clone();
    let at = [rings(rpm(SPEED_RPM), 0.0), rings(rpm(SPEED_RPM), DURATION)];
    let run = balls.advance_with(distances, &mut state, [&at[0], &at[1]], DURATION, step);
    run.expect("the step is stable").losses[0]
}

fn runs(c: &mut Criterion) {
    let mut group = c.benchmark_group("free_ball_bearing_1_ms");
    group.sample_size(20).warm_up_time(Duration::from_millis(500)).measurement_time(Duration::from_secs(3));
    for (name, slip) in [("centre", SlipModel::Centre), ("ellipse", SlipModel::default())] {
        let balls = bearing(slip);
        let at = rings(rpm(SPEED_RPM), 0.0);
        let start = balls.initial_state(&at).expect("no overlap");
        let stable = 0.9 * balls.stable_step(&start, &at).smallest();
        for (steps, step) in [("stable_step", stable), ("2_us", 2e-6)] {
            group.bench_function(BenchmarkId::new(format!("{name}_closed_forms"), steps), |b| {
                b.iter(|| simulated(&balls, &ClosedForms, black_box(&start), step));
            });
        }
        group.bench_function(BenchmarkId::new(format!("{name}_parry"), "2_us"), |b| {
            b.iter(|| simulated(&balls, &ParryDistances, black_box(&start), 2e-6));
        });
    }
    group.finish();
}

/// One search for near pairs by broad and narrow phase, and by the closed forms.
fn pairs(c: &mut Criterion) {
    let balls = bearing(SlipModel::Centre);
    let at = rings(rpm(SPEED_RPM), 0.0);
    let state = balls.initial_state(&at).expect("no overlap");
    let mut bodies = BodyCollisions::new(&balls, 1e-5);
    c.bench_function("near_pairs_rapier", |b| b.iter(|| bodies.detect(black_box(&state), &at)));
    c.bench_function("near_pairs_closed_forms", |b| {
        b.iter(|| balls.proximities(&ClosedForms, black_box(&state), &at, 1e-5));
    });
}

criterion_group!(benches, runs, pairs);
criterion_main!(benches);

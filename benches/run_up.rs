//! The rig's whole run-up, 13 s with 18 balls, on one core; and one evaluation of a ball bearing.

use std::hint::black_box;
use std::ops::ControlFlow;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use rotordyn::bearing::Rotation;
#[path = "common/rig.rs"]
mod rig;
use rig::rig;

fn run_up(c: &mut Criterion) {
    let mut group = c.benchmark_group("run_up");
    group.sample_size(10).warm_up_time(Duration::from_millis(1)).measurement_time(Duration::from_secs(40));
    for variant in [None, Some("wavy")] {
        let machine = rig(variant);
        let study = machine.model.studies.run_up.clone().expect("the rig has a run-up");
        let reduction = machine.reduce(&study).expect("the rig has modes");
        group.bench_function(format!("rig_13_s_{}", variant.unwrap_or("smooth")), |b| {
            b.iter(|| machine.run_up(&study, &reduction, |_| ControlFlow::Continue(())));
        });
    }
    group.finish();
}

fn bearing(c: &mut Criterion) {
    let machine = rig(None);
    let site = &machine.model.bearings[1];
    let element = site.bearing.element();
    let d = [7.7e-6, -8.8e-6, 7.2e-6, 8.0e-4, -2.7e-4, 0.0];
    let rotation = Rotation { cage_angle: 0.3, cage_speed: Some(50.0), shaft_angle: 0.7, shaft_speed: 125.0 };
    c.bench_function("ball_bearing_reaction", |b| {
        b.iter(|| element.reaction(black_box(&d), black_box(&[1e-4; 6]), &rotation));
    });
}

criterion_group!(benches, run_up, bearing);
criterion_main!(benches);

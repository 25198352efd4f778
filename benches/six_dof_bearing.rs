//! The six-degree-of-freedom bearing of models/atef_2022.toml with RK4 at 6 us: 0.1 s, to compare with 0.02 s.

use std::hint::black_box;
use std::ops::ControlFlow;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use rotordyn::bearing::{Reaction, Rotation};
use rotordyn::model::{Options, load};
use rotordyn::study::Machine;

fn machine(variant: Option<&str>) -> Machine {
    let options =
        Options { variant: variant.map(String::from), set: vec![("speed.duration".into(), "0.1 s".into())] };
    let text = include_str!("../models/atef_2022.toml");
    let loaded = load("atef_2022.toml", text, &options).expect("the file is valid");
    Machine::new(loaded.model).expect("the machine has an equilibrium")
}

fn runs(c: &mut Criterion) {
    let mut group = c.benchmark_group("six_degrees_of_freedom_0.1_s");
    group.sample_size(20).warm_up_time(Duration::from_millis(500)).measurement_time(Duration::from_secs(5));
    for variant in [None, Some("two_dents"), Some("random_defects")] {
        let machine = machine(variant);
        let study = machine.model.studies.run_up.clone().expect("the file has a run");
        let reduction = machine.reduce(&study).expect("the machine has modes");
        group.bench_function(variant.unwrap_or("sound"), |b| {
            b.iter(|| machine.run_up(&study, &reduction, |_| ControlFlow::Continue(())));
        });
    }
    group.finish();
}

fn force(c: &mut Criterion) {
    let d = [1.2e-6, 0.3e-6, 0.0, 0.0, 0.0, 0.0];
    let v = [1e-4, -2e-4, 0.0, 0.0, 0.0, 0.0];
    let rotation = Rotation { cage_angle: 0.3, cage_speed: Some(75.0), shaft_angle: 0.7, shaft_speed: 188.0 };
    for variant in [None, Some("two_dents")] {
        let element = machine(variant).model.bearings[0].bearing.element();
        let mut out = Reaction::default();
        c.bench_function(&format!("force_of_nine_balls_{}", variant.unwrap_or("sound")), |b| {
            b.iter(|| element.force(black_box(&d), black_box(&v), &rotation, &mut out));
        });
    }
}

criterion_group!(benches, runs, force);
criterion_main!(benches);

//! Speed of a bifurcation diagram: 200 speeds swept up, 300 ball passages each, on all cores.

use std::ops::ControlFlow;

use criterion::{Criterion, criterion_group, criterion_main};
use rotordyn::model::{Model, Options, load};
use rotordyn::study::bifurcation;

const MODEL: &str = include_str!("../models/varying_compliance.toml");

/// One machine per value, as the command line builds them.
fn family() -> Vec<Model> {
    let settings = [
        ("study.bifurcation.values", "{ from = \"500 rpm\", to = \"6000 rpm\", count = 200 }"),
        ("study.bifurcation.sweep", "up"),
        ("study.bifurcation.transient_periods", "200"),
        ("study.bifurcation.periods", "100"),
    ];
    let load = |more: &[(String, String)]| {
        let set = settings.iter().map(|(path, value)| ((*path).to_string(), (*value).to_string()));
        let options = Options { set: set.chain(more.iter().cloned()).collect(), ..Options::default() };
        load("varying_compliance.toml", MODEL, &options).expect("the model is valid").model
    };
    let base = load(&[]);
    let parameter = base.studies.bifurcation.as_ref().expect("a bifurcation study").parameter.clone();
    (0..parameter.values.len()).map(|k| load(&parameter.settings(k))).collect()
}

fn diagram(c: &mut Criterion) {
    let models = family();
    let mut group = c.benchmark_group("bifurcation");
    group.sample_size(10);
    group.bench_function("200_speeds_300_periods", |b| {
        b.iter(|| bifurcation(&models, &|_, _| ControlFlow::Continue(())).map(|d| d.sweeps.len()));
    });
    group.finish();
}

criterion_group!(benches, diagram);
criterion_main!(benches);

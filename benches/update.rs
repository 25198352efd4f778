//! Model updating of the rig with four free parameters, including reading the file; limit 5 s.

use criterion::{Criterion, criterion_group, criterion_main};
use rotordyn::model::parameter_paths::{all_values, resolve_parameter_path};
use rotordyn::model::{Model, Options, load};
use rotordyn::signal::record::Dof;
use rotordyn::update::parameter::{FreeParameter, ModelNumber, candidates};
use rotordyn::update::residual::Fitting;
use rotordyn::update::state::ModelState;
use rotordyn::update::target::{Target, TargetMode, sensors};
use rotordyn::update::{UpdateJob, update};
use std::hint::black_box;

const RIG: &str = include_str!("../models/overhung_rig.toml");
const FREE: [&str; 4] = ["housing.*.k_x", "housing.*.k_y", "belt.drive.k_x", "bearing.*.radial_clearance"];

fn rig(set: &[(String, String)]) -> Model {
    let options = Options { variant: None, set: set.to_vec() };
    load("overhung_rig.toml", RIG, &options).expect("a valid model").model
}

/// Modes of the rig with other housing stiffness, at both bearings and the disc.
fn measured() -> Target {
    let other = [("A", "4.2e6", "2.1e7"), ("B", "4.2e6", "2.1e7")];
    let set: Vec<(String, String)> = other
        .iter()
        .flat_map(|(h, x, y)| {
            [
                (format!("housing.{h}.k_x"), format!("{x} N/m")),
                (format!("housing.{h}.k_y"), format!("{y} N/m")),
            ]
        })
        .collect();
    let model = rig(&set);
    let node = |name: &str| {
        model.stations.iter().find(|s| s.name == name).expect("a station of the rig").node as i64 + 1
    };
    let dofs: Vec<Dof> =
        ["A", "B", "disc"].iter().flat_map(|n| [1, 2].map(|d| Dof::new(node(n), d))).collect();
    let sensors = sensors(&dofs, &Default::default(), &model).expect("points of the rig");
    let shape = vec![1.0.into(); sensors.len()];
    let wide = TargetMode {
        frequency_hz: 300.0,
        damping_ratio: None,
        frequency_error: 0.0,
        damping_error: 0.0,
        shape_error: 0.0,
        quality_warnings: Vec::new(),
        shape,
    };
    let target = Target { speed: 0.0, sensors, modes: vec![wide.clone(); 6], frfs: None };
    let state = ModelState::new(model, &target, None).expect("modes of the rig");
    let modes = state
        .modes
        .iter()
        .zip(&state.shapes)
        .filter(|(mode, shape)| mode.frequency_hz() < 300.0 && shape.iter().any(|v| v.norm() > 1e-3))
        .map(|(mode, shape)| TargetMode {
            frequency_hz: mode.frequency_hz(),
            shape: shape.clone(),
            ..wide.clone()
        })
        .collect();
    Target { modes, ..target }
}

fn four_parameters(c: &mut Criterion) {
    let target = measured();
    let parameters: Vec<FreeParameter> = FREE
        .iter()
        .map(|path| {
            let found =
                resolve_parameter_path(RIG.as_bytes(), &Options::default(), path).expect("a path of the rig");
            let place = |s: &rotordyn::model::parameter_paths::ParameterValue| {
                ModelNumber::read(&s.path, &s.text, s.quoted)
            };
            let places = found.iter().filter_map(place).collect();
            FreeParameter::new(path, places, true, None).expect("a positive number")
        })
        .collect();
    let mut group = c.benchmark_group("update");
    group.sample_size(10);
    let values = all_values(RIG.as_bytes(), &Options::default()).expect("numbers of the rig");
    let numbers: Vec<ModelNumber> =
        values.iter().filter_map(|v| ModelNumber::read(&v.path, &v.text, v.quoted)).collect();
    let fixed = candidates(&numbers, &parameters);
    for (name, fixed) in
        [("rig, four parameters", &[][..]), ("rig, four parameters, the fixed ones tried", &fixed)]
    {
        group.bench_function(name, |b| {
            b.iter(|| {
                let job = UpdateJob {
                    parameters: &parameters,
                    target: &target,
                    fitting: &Fitting::default(),
                    load: &|set| Ok(rig(set)),
                    max_iterations: 40,
                    fixed,
                };
                black_box(update(&job).expect("an update"))
            });
        });
    }
    group.finish();
}

criterion_group!(benches, four_parameters);
criterion_main!(benches);

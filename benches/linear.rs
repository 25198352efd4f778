//! Speed of the linear analyses on the 40-element rotor with two discs on which ROSS 3.1.0 was timed.
//!
//! ROSS there: six modes at one speed 37 ms, Campbell diagram of 40 speeds 2.1 s, 1000 FRF points 13 s.

use criterion::{Criterion, criterion_group, criterion_main};
use rotordyn::analysis::{campbell::campbell, frf::frf, modal};
use rotordyn::assembly::{Assembly, LinearSystem};
use rotordyn::element::Anchor;
use rotordyn::model::{Options, Quantity, load};
use rotordyn::study::Machine;
use std::hint::black_box;

#[path = "../tests/common/ross.rs"]
#[allow(dead_code)]
mod ross;

fn linear(c: &mut Criterion) {
    let model = ross::model(&ross::read("ross/bench_model_40.json"));
    let assembly = Assembly::new(&model).expect("the model is valid");
    let tangents = |speed: f64| Ok(ross::tangents(&model, speed));
    let system = |speed: f64| {
        LinearSystem::new(&assembly, &ross::tangents(&model, speed), speed).expect("the model is valid")
    };

    c.bench_function("assembly, 40 elements", |b| b.iter(|| Assembly::new(black_box(&model))));
    let running = system(400.0);
    c.bench_function("6 modes at one speed", |b| b.iter(|| modal::modes(&assembly, black_box(&running), 6)));
    let speeds: Vec<f64> = (0..40).map(|k| 1000.0 * f64::from(k) / 39.0).collect();
    c.bench_function("Campbell, 40 speeds, 6 modes", |b| {
        b.iter(|| campbell(&assembly, black_box(&speeds), 6, &tangents));
    });
    let hz: Vec<f64> = (1..=1000).map(|k| 0.3 * f64::from(k)).collect();
    let row = |node: usize, dof: usize| assembly.anchor_rows(&Anchor::node(node))[dof].clone();
    let excitations = [row(13, 0), row(27, 1)];
    let responses = [row(0, 0), row(13, 0), row(13, 1), row(27, 0), row(27, 1)];
    c.bench_function("1000 FRF points, 10 pairs", |b| {
        b.iter(|| frf(&assembly, &running, black_box(&hz), &excitations, &responses, Quantity::Acceleration));
    });
}

/// Campbell diagram of the Jeffcott rotor with 100 elements, with and without modal damping.
fn modal_damping(c: &mut Criterion) {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/models/jeffcott.toml");
    let text = std::fs::read_to_string(path).expect("the model file exists");
    let (start, end) = (text.find("[damping.modal]"), text.find("[drive]"));
    let undamped = start.zip(end).map(|(start, end)| format!("{}{}", &text[..start], &text[end..]));
    let undamped = undamped.expect("the file has modal damping");
    for (name, text) in [("with", &text), ("without", &undamped)] {
        let set = vec![("shaft.element_length".to_string(), "\"8 mm\"".to_string())];
        let loaded = load("jeffcott.toml", text.clone(), &Options { variant: None, set });
        let model = loaded.expect("the model is valid").model;
        c.bench_function(&format!("Campbell, 100 elements, {name} modal damping"), |b| {
            b.iter(|| {
                let machine = Machine::new(black_box(&model).clone()).expect("the model is valid");
                machine.campbell(model.studies.campbell.as_ref().expect("the file has a Campbell diagram"))
            });
        });
    }
}

criterion_group! { name = benches; config = Criterion::default().sample_size(10); targets = linear, modal_damping }
criterion_main!(benches);

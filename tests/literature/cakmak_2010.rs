//! The overhung rig of Cakmak & Sanliturk 2010 as reconstructed in rig.json: spherical and cylindrical joints.
//!
//! Its axes are ours: x horizontal, y up, z from the drive end to the disc.

use crate::ross::{number, numbers, read};
use rotordyn::analysis::{ModeKind, modal};
use rotordyn::assembly::{Assembly, LinearSystem};
use rotordyn::model::{self, Options};
use std::f64::consts::TAU;

fn modes(variant: &str, rpm: f64) -> Vec<modal::Mode> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/models/overhung_rig.toml");
    let text = std::fs::read_to_string(path).unwrap();
    let options = Options { variant: Some(variant.into()), ..Options::default() };
    let model = model::load(path, &text, &options).unwrap().model;
    let assembly = Assembly::new(&model).unwrap();
    let system = LinearSystem::new(&assembly, &[], rpm / 60.0 * TAU).unwrap();
    modal::undamped_modes(&assembly, &system, 6).unwrap()
}

#[test]
fn frequencies_on_joints() {
    let expected = &read("rig.json")["expected"];
    let mut torsion = Vec::new();
    for variant in ["spherical", "cylindrical"] {
        for (name, rpm) in [("0rpm", 0.0), ("1200rpm", 1200.0)] {
            let theirs = numbers(&expected[variant][name]);
            let ours = modes(variant, rpm);
            for (mode, theirs) in ours.iter().zip(&theirs) {
                let hz = mode.frequency_hz();
                println!("{variant} {name}: {hz:8.3} Hz, {theirs}, {}", mode.label);
                // The figures are printed to 0.01 Hz.
                assert!((hz - theirs).abs() < 0.001 * theirs, "{variant} {name}: {hz} {theirs}");
            }
            torsion.push(ours.iter().find(|m| m.kind == ModeKind::Torsional).unwrap().omega());
            let split = ours.iter().any(|m| m.kind == ModeKind::Forward);
            assert_eq!(split, rpm > 0.0);
        }
    }
    assert!(torsion.iter().all(|t| (t / torsion[0] - 1.0).abs() < 1e-9));
    assert!(number(&expected["cylindrical"]["0rpm"][3]) > number(&expected["spherical"]["0rpm"][3]));
}

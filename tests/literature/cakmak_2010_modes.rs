//! The overhung rig of Cakmak & Sanliturk 2010 as reconstructed in rig.json: on spherical and cylindrical
//! joints, and on the bearing stiffness printed there, with housings and belt.
//!
//! Same axes as here: x horizontal, y up, z from the drive end to the disc.

use crate::agree;
use crate::ross::{number, numbers, read};
use rotordyn::analysis::{ModeKind, modal};
use rotordyn::assembly::{Assembly, LinearSystem};
use rotordyn::bearing::SiteTangent;
use rotordyn::model::{self, Options};
use std::f64::consts::TAU;

fn modes(variant: Option<&str>, tangents: &[SiteTangent], rpm: f64, count: usize) -> Vec<modal::Mode> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/models/overhung_rig.toml");
    let text = std::fs::read_to_string(path).unwrap();
    let options = Options { variant: variant.map(Into::into), ..Options::default() };
    let model = model::load(path, &text, &options).unwrap().model;
    let assembly = Assembly::new(&model).unwrap();
    let system = LinearSystem::new(&assembly, tangents, rpm / 60.0 * TAU).unwrap();
    modal::undamped_modes(&assembly, &system, count).unwrap()
}

#[test]
fn frequencies_on_joints() {
    let expected = &read("rig.json")["expected"];
    let mut torsion = Vec::new();
    for variant in ["spherical", "cylindrical"] {
        for (name, rpm) in [("0rpm", 0.0), ("1200rpm", 1200.0)] {
            let theirs = numbers(&expected[variant][name]);
            let ours = modes(Some(variant), &[], rpm, 6);
            for (mode, theirs) in ours.iter().zip(&theirs) {
                let hz = mode.frequency_hz();
                println!("{variant} {name}: {hz:8.3} Hz, {theirs}, {}", mode.label);
                // The reference is printed to 0.01 Hz.
                agree::relative(format_args!("{variant} {name}: frequency [Hz]"), hz, *theirs, 0.001);
            }
            torsion.push(ours.iter().find(|m| m.kind == ModeKind::Torsional).unwrap().omega());
            let split = ours.iter().any(|m| m.kind == ModeKind::Forward);
            assert_eq!(split, rpm > 0.0);
        }
    }
    for here in &torsion[1..] {
        agree::relative("torsional frequency, any support and speed [rad/s]", *here, torsion[0], 1e-9);
    }
    assert!(number(&expected["cylindrical"]["0rpm"][3]) > number(&expected["spherical"]["0rpm"][3]));
}

/// The bearings' 5x5 stiffness at equilibrium as printed in rig.json, order x y z θ_x θ_y.
fn printed_stiffness() -> [SiteTangent; 2] {
    let printed = &read("rig.json")["expected"]["bearing_K5_at_equilibrium"];
    ["A", "B"].map(|name| {
        let mut tangent = SiteTangent::default();
        for (row, line) in tangent.stiffness.iter_mut().zip(printed[name].as_array().unwrap()) {
            row[..5].copy_from_slice(&numbers(line));
        }
        tangent
    })
}

#[test]
fn frequencies_on_the_printed_bearing_stiffness() {
    let expected = &read("rig.json")["expected"];
    let tangents = printed_stiffness();
    // The list of the finite bearings gives the axial mode and the third pair separately.
    for (name, rpm) in [("0rpm", 0.0), ("1200rpm", 1200.0)] {
        let mut theirs = numbers(&expected["finite"][name]);
        theirs.insert(2, number(&expected["finite"]["axial_mode"]));
        if rpm == 0.0 {
            theirs.extend(numbers(&expected["finite"]["third"]));
        }
        let ours = modes(None, &tangents, rpm, theirs.len());
        for (mode, theirs) in ours.iter().zip(&theirs) {
            let hz = mode.frequency_hz();
            println!("ball bearings {name}: {hz:8.3} Hz, {theirs}, {}", mode.label);
            agree::relative(format_args!("ball bearings {name}: frequency [Hz]"), hz, *theirs, 0.001);
        }
    }
    let theirs = numbers(&expected["finite_with_block_0rpm"]);
    let ours = modes(Some("block"), &tangents, 0.0, theirs.len());
    for (mode, theirs) in ours.iter().zip(&theirs) {
        let hz = mode.frequency_hz();
        println!("on the block: {hz:8.3} Hz, {theirs}, {}", mode.label);
        agree::relative("on the block: frequency [Hz]", hz, *theirs, 0.002);
    }
}

//! Campbell diagrams of ROSS itself beside those of this program, over twelve speeds.
//!
//! `tests/data/ross/rotors/make_campbell.py` says how they were made. ROSS finds its modes by ARPACK, to about 2e-6. It takes the
//! lowest modes of each speed by itself; a mode that is overdamped at low speed begins no branch here, and is looked for among
//! the modes of that speed.

use crate::agree;
use rotordyn::io::budget::Limits;
use rotordyn::io::ross;
use rotordyn::linalg::Complex64;
use rotordyn::model::study::{CampbellStudy, ModalStudy};
use rotordyn::model::{Options, load};
use rotordyn::study::Machine;
use serde_json::Value;
use std::f64::consts::TAU;
use std::path::Path;

/// Branches computed: more than those of the reference, of which heavily damped modes could take the place.
const BRANCHES: usize = 14;
/// Log decrement from which a mode may be overdamped at another speed: a damping ratio of 0.7.
const HEAVILY_DAMPED: f64 = 6.0;

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

/// λ of a damped natural frequency \[rad/s\] and a log decrement.
fn eigenvalue((frequency, decrement): (f64, f64)) -> Complex64 {
    Complex64::new(-decrement * frequency / TAU, frequency)
}

#[test]
fn campbell_diagrams_agree_at_every_speed() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/ross/rotors");
    let text = std::fs::read_to_string(folder.join("campbell.json")).unwrap();
    let all: Value = serde_json::from_str(&text).unwrap();
    for (file, reference) in all["rotors"].as_object().unwrap() {
        let found = ross::import(&folder.join(file), "imported", &Limits::default()).unwrap();
        let model = load(file, &found.text, &Options::default()).unwrap().model;
        let machine = Machine::new(model).unwrap();
        let speeds = numbers(&reference["speeds"]);
        let study =
            CampbellStudy { speeds, modes: BRANCHES, orders: Vec::new(), speed_dependent_bearings: true };
        let at_each = ModalStudy { speeds: study.speeds.clone(), modes: 2 * BRANCHES };
        let modes = machine.modal(&at_each).unwrap();
        let diagram = machine.campbell(&study).unwrap().diagram;
        let rows = reference["wd"].as_array().unwrap().iter().zip(reference["log_dec"].as_array().unwrap());
        let (mut worst, mut count, mut apart) = (0.0f64, 0, 0);
        for (k, (wd, decrements)) in rows.enumerate() {
            let branches = diagram.branches.iter().filter_map(|branch| branch.modes[k].as_ref());
            let above = |value: Complex64| Complex64::new(value.re, value.im.abs());
            let mut followed: Vec<_> = branches.map(|mode| above(mode.eigenvalue)).collect();
            let mut at_speed: Vec<_> = modes[k].modes.iter().map(|mode| above(mode.eigenvalue)).collect();
            for found in numbers(wd).into_iter().zip(numbers(decrements)) {
                let theirs = eigenvalue(found);
                let heavily = found.1.abs() > HEAVILY_DAMPED;
                let ours = if heavily { &mut at_speed } else { &mut followed };
                let off = |j: &usize| (ours[*j] - theirs).norm();
                let nearest = (0..ours.len()).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap();
                worst = worst.max(off(&nearest) / theirs.norm());
                ours.swap_remove(nearest);
                count += 1;
                apart += usize::from(heavily);
            }
        }
        println!("{file}: {count} eigenvalues, {apart} of them heavily damped, within {worst:.1e}");
        agree::curve(format_args!("{file}: Campbell diagram of ROSS"), worst, 1.0, 1e-5);
    }
}

//! Rotors that ROSS saved: each imported, and its figures compared with those of ROSS itself.
//!
//! `tests/data/ross/rotors/README.md` says where the files come from. Cones are integrated as ROSS does, by the mean of both
//! ends in torsion and along the axis; what the exact rule of this program changes is measured by itself.

use crate::agree;
use rotordyn::analysis::{frf, unbalance};
use rotordyn::assembly::{Assembly, LinearSystem, SpinUpForm};
use rotordyn::bearing::{Bearing, LinearElement, SiteTangent};
use rotordyn::element::Anchor;
use rotordyn::element::shaft_matrices::ConeRule;
use rotordyn::io::budget::Limits;
use rotordyn::io::ross::{self, Imported};
use rotordyn::linalg::{Complex64, krylov};
use rotordyn::model::{Loaded, Model, Options, Quantity, Unbalance, load};
use serde_json::Value;
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/ross/rotors")
}

/// A shaft without mass, of which the mass matrix is singular: written and named, but no machine here.
const MASSLESS: &str = "rotor_assembly_rotor3c.json";

/// A rotor on bearings of 1e20 N/m, which become joints.
const RIGID: &str = "rotor_assembly_rotor_conical.json";
/// Modes found beyond those of the reference, so that heavily damped ones do not take the place of one of them.
const MORE: usize = 4;

/// Every file with figures, of ROSS 3 and 2.
fn cases() -> Vec<(String, Value)> {
    let of = |name: &str| {
        let text = std::fs::read_to_string(folder().join(name)).unwrap();
        let all: Value = serde_json::from_str(&text).unwrap();
        all["rotors"].as_object().unwrap().clone().into_iter()
    };
    of("figures.json").chain(of("v2_figures.json")).filter(|(file, _)| file != MASSLESS).collect()
}

fn imported(file: &str) -> (Imported, Loaded) {
    let found = ross::import(&folder().join(file), "imported", &Limits::default())
        .unwrap_or_else(|error| panic!("{file}: {error}"));
    let loaded = load(file, &found.text, &Options::default())
        .unwrap_or_else(|error| panic!("{file}: {error}\n{}", found.text));
    (found, loaded)
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

fn complex(value: &Value) -> Vec<Complex64> {
    numbers(&value["re"])
        .into_iter()
        .zip(numbers(&value["im"]))
        .map(|(re, im)| Complex64::new(re, im))
        .collect()
}

/// Tangents of linear bearings at a speed, for motions of one frequency \[rad/s\].
fn tangents(model: &Model, speed: f64, whirl: f64) -> Vec<SiteTangent> {
    let tangent = |bearing: &Bearing| {
        let Bearing::Linear(bearing) = bearing else { panic!("import writes linear bearings only") };
        let (stiffness, damping) = LinearElement::new(bearing).matrices_at(speed, whirl);
        SiteTangent { stiffness, damping }
    };
    model.bearings.iter().map(|site| tangent(&site.bearing)).collect()
}

/// Node of this program at a node of ROSS.
fn node(model: &Model, number: &Value) -> usize {
    let name = format!("n{}", number.as_u64().unwrap());
    model.stations.iter().find(|station| station.name == name).unwrap().node
}

fn lowest(assembly: &Assembly, model: &Model, speed: f64, count: usize) -> Vec<Complex64> {
    let system = LinearSystem::new(assembly, &tangents(model, speed, speed), speed).unwrap();
    let [m, d, s] = [&system.mass, &system.damping, &system.stiffness];
    krylov::lowest_eigenpairs(m, d, s, count, 30.0).unwrap().iter().map(|pair| pair.value).collect()
}

/// Pairs of each reference value with the nearest of ours, each of ours used once.
fn pairs(ours: &[Complex64], theirs: &[Complex64]) -> Vec<[Complex64; 2]> {
    let mut left = ours.to_vec();
    let nearest = |t: &Complex64| {
        let best = (0..left.len()).min_by(|&a, &b| (left[a] - t).norm().total_cmp(&(left[b] - t).norm()));
        [left.swap_remove(best.expect("as many values as the reference")), *t]
    };
    theirs.iter().map(nearest).collect()
}

fn log_decrement(value: Complex64) -> f64 {
    -TAU * value.re / value.im.abs()
}

/// Largest deviation relative to the response itself, or to a millionth of the largest one: where it vanishes by
/// symmetry, or at a rigid support, both programs give round-off. `elsewhere`: the largest response of the rotor.
fn deviation(ours: &[Complex64], theirs: &[Complex64], elsewhere: f64) -> f64 {
    let floor = 1e-6 * theirs.iter().fold(elsewhere, |m: f64, v| m.max(v.norm()));
    let worst = |m: f64, (a, b): (&Complex64, &Complex64)| m.max((a - b).norm() / b.norm().max(floor));
    if floor == 0.0 { 0.0 } else { ours.iter().zip(theirs).fold(0.0, worst) }
}

/// The assembly with cones as in ROSS.
fn assembled(model: &Model) -> Assembly {
    Assembly::with_forms(model, SpinUpForm::Ross, ConeRule::ArithmeticMean).unwrap()
}

#[test]
fn eigenvalues_agree_at_every_speed() {
    for (file, case) in cases() {
        let (_, Loaded { model, .. }) = imported(&file);
        let assembly = assembled(&model);
        for modal in case["eigenvalues"].as_array().unwrap() {
            let speed = modal["speed"].as_f64().unwrap();
            let theirs = complex(modal);
            let ours = lowest(&assembly, &model, speed, theirs.len() + MORE);
            let found = pairs(&ours, &theirs);
            let worst = found.iter().map(|[a, b]| (a - b).norm() / b.norm()).fold(0.0, f64::max);
            let decrement = found
                .iter()
                .map(|[a, b]| {
                    (log_decrement(*a) - log_decrement(*b)).abs() / log_decrement(*b).abs().max(1.0)
                })
                .fold(0.0, f64::max);
            println!("{file} at {speed} rad/s: eigenvalues {worst:.1e}, log decrements {decrement:.1e}");
            agree::curve(format_args!("{file} at {speed} rad/s: eigenvalues"), worst, 1.0, 1e-6);
            agree::curve(format_args!("{file} at {speed} rad/s: log decrements"), decrement, 1.0, 1e-6);
        }
    }
}

#[test]
fn unbalance_responses_agree() {
    for (file, case) in cases() {
        let (_, Loaded { mut model, .. }) = imported(&file);
        let reference = &case["unbalance"];
        model.unbalances = vec![Unbalance {
            name: "own".into(),
            node: node(&model, &reference["node"]),
            magnitude: reference["magnitude"].as_f64().unwrap(),
            phase: reference["phase"].as_f64().unwrap(),
        }];
        let assembly = assembled(&model);
        let speeds = numbers(&reference["speeds"]);
        let at = |speed: f64| Ok(tangents(&model, speed, speed));
        let motions = unbalance::response(&assembly, &speeds, &at, |motion| motion).unwrap();
        let probes = reference["probes"].as_array().unwrap();
        let values = probes.iter().flat_map(|probe| [complex(&probe["x"]), complex(&probe["y"])]).flatten();
        let largest = values.map(|v| v.norm()).fold(0.0, f64::max);
        for probe in probes {
            let rows = assembly.anchor_rows(&Anchor::node(node(&model, &probe["node"])));
            for (row, axis) in rows.iter().zip(["x", "y"]) {
                let ours: Vec<Complex64> =
                    motions.iter().map(|m| m.amplitude_of(row, Quantity::Displacement)).collect();
                let worst = deviation(&ours, &complex(&probe[axis]), largest);
                println!("{file} node {} {axis}: unbalance {worst:.1e}", probe["node"]);
                let what = format_args!("{file} node {}: unbalance response along {axis}", probe["node"]);
                agree::curve(what, worst, 1.0, 1e-6);
            }
        }
    }
}

#[test]
fn frequency_responses_agree_at_a_speed() {
    for (file, case) in cases() {
        let (_, Loaded { model, .. }) = imported(&file);
        let assembly = assembled(&model);
        let reference = &case["frf"];
        let speed = reference["speed"].as_f64().unwrap();
        let [x, y, ..] = assembly.anchor_rows(&Anchor::node(node(&model, &reference["node"])));
        let frequencies = numbers(&reference["frequencies"]);
        for (pair, excitation, response) in [("xx", &x, &x), ("yx", &x, &y), ("yy", &y, &y)] {
            let one = |omega: &f64| {
                let system = LinearSystem::new(&assembly, &tangents(&model, speed, *omega), speed).unwrap();
                let [e, r] = [excitation, response].map(|row| [row.clone()]);
                frf::frf(&assembly, &system, &[omega / TAU], &e, &r, Quantity::Displacement).unwrap().values
                    [0][0][0]
            };
            let ours: Vec<Complex64> = frequencies.iter().map(one).collect();
            let worst = deviation(&ours, &complex(&reference[pair]), 0.0);
            println!("{file} {pair}: FRF {worst:.1e}");
            agree::curve(format_args!("{file}: FRF {pair} at {speed} rad/s"), worst, 1.0, 1e-6);
        }
    }
}

/// What exact cones change: nothing in bending, and up to a few per cent in torsion and along the axis.
#[test]
fn exact_cones_change_torsion_and_axial_modes_only() {
    for (file, moved) in [
        ("cone_hollow.toml", 0.2),
        ("rotor_assembly_rotor_conical.json", 0.2),
        ("rotor_assembly_rotor_tapered_housing.toml", 0.2),
    ] {
        let (_, Loaded { model, .. }) = imported(file);
        let exact = Assembly::new(&model).unwrap();
        let theirs = lowest(&assembled(&model), &model, 0.0, 14);
        let found = pairs(&lowest(&exact, &model, 0.0, 14), &theirs);
        let changes: Vec<f64> = found.iter().map(|[a, b]| (a - b).norm() / b.norm()).collect();
        let (same, changed): (Vec<f64>, Vec<f64>) = changes.iter().partition(|change| **change < 1e-9);
        let largest = changed.iter().copied().fold(0.0, f64::max);
        println!("{file}: {} modes unchanged, {} changed by up to {largest:.1e}", same.len(), changed.len());
        assert!(same.len() >= 6, "{file}: {changes:?}");
        assert!(largest < moved, "{file}: {changes:?}");
    }
}

/// Within springs of 1e20 N/m the digits of the shaft are lost, and with them those of its lowest modes.
#[test]
fn springs_that_stand_for_rigid_supports_become_joints() {
    let (found, Loaded { model, .. }) = imported(RIGID);
    assert_eq!(model.joints.len(), 2, "{}", found.text);
    assert!(model.joints.iter().all(|joint| joint.locked == [true, true, false, false, false, false]));
    assert!(model.bearings.is_empty(), "{}", found.text);
}

#[test]
fn a_shaft_without_mass_is_named() {
    let (found, Loaded { model, .. }) = imported(MASSLESS);
    let named =
        found.not_carried.iter().any(|lost| lost.item.ends_with("rho") && lost.why.contains("inertia"));
    assert!(named, "{:?}", found.not_carried);
    assert!(Assembly::new(&model).is_err());
}

//! Plausible machines, and the models of the project.

use crate::{codes, warnings_of};
use crate::{machines, unusual};
use rotordyn::model::{self, Options};
use rotordyn::study::Machine;
use std::collections::BTreeSet;

#[test]
fn plausible_machines_have_no_warning() {
    let mut failures = Vec::new();
    for machine in machines::all().into_iter().chain(unusual::all()) {
        for warning in warnings_of(&machine.text()) {
            failures.push(format!("{} [{}]: {warning}", machine.name, warning.code.name()));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// Warnings of the supports of models and variants, each deserved: model, variants, code, why.
const DESERVED: &[(&str, &[&str], &str, &str)] = &[
    (
        "atef_2022",
        &["clearance", "clearance_straddling"],
        "bearing-unloaded",
        "the clearance of the paper leaves bearing B without load",
    ),
    (
        "atef_2022",
        &["no_clearance"],
        "minimum-load",
        "the light resonator of the paper loads bearing B with 0.9 N",
    ),
    ("bal_2022", &["dry_20"], "minimum-load", "a preload of 20 N at 5000 rpm"),
    ("free_balls", &["base", "rolling"], "minimum-load", "a light spindle whose cage skids is its subject"),
    ("overhung_rig", &["block"], "belt-pull", "the block on soft springs gives way to the belt"),
    (
        "upadhyay_2009",
        &["massless"],
        "minimum-load",
        "9.6 N at 5000 rpm without the centrifugal force of the balls",
    ),
    (
        "zhang_2016",
        &["dry10", "ehl10", "dry30", "ehl30"],
        "fitted-law",
        "ball loads outside the range to which the paper fitted its law",
    ),
];

#[test]
fn models_have_only_the_warnings_they_deserve() {
    let mut found: BTreeSet<(String, String, &str)> = BTreeSet::new();
    for entry in std::fs::read_dir("models").unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "toml") {
            continue;
        }
        let (text, stem) =
            (std::fs::read_to_string(&path).unwrap(), path.file_stem().unwrap().to_str().unwrap());
        let variants = model::variants(&text).into_iter().map(Some);
        for variant in std::iter::once(None).chain(variants) {
            let name = variant.clone().unwrap_or("base".into());
            let options = Options { variant, ..Options::default() };
            let machine = Machine::new(model::load(stem, &text, &options).unwrap().model).unwrap();
            let warned = machine.support_warnings(&[machine.model.profile.top_speed()]);
            found.extend(warned.iter().map(|w| (stem.to_string(), name.clone(), w.code.name())));
        }
    }
    let deserved = DESERVED.iter().flat_map(|(model, variants, code, _)| {
        variants.iter().map(|variant| (model.to_string(), variant.to_string(), *code))
    });
    assert_eq!(found, deserved.collect());
}

/// Thrust on a preloaded pair unloads one row of it, as it should; the pair keeps its preload.
#[test]
fn thrust_on_a_preloaded_pair_is_no_loss_of_preload() {
    let mut spindle = machines::all().into_iter().find(|m| m.name == "spindle_large").unwrap();
    spindle.more = "[load.cut]\nat = \"disc.chuck\"\nforce = \"0, 0, 600 N\"\n".into();
    let found = warnings_of(&spindle.text());
    assert!(!codes(&found).contains("preload"), "{found:?}");
    let model = model::load("spindle.toml", spindle.text(), &Options::default()).unwrap().model;
    let machine = Machine::new(model).unwrap();
    let least = machine.mounted_preloads().iter().filter_map(|preload| preload.share()).fold(1.0, f64::min);
    assert!(least < 0.8, "{least}: the thrust unloads no row");
}

/// A machine that stands upright whose upper bearing has clearance and nothing to carry.
#[test]
fn a_vertical_rotor_on_clearance_is_told_that_its_bearings_carry_nothing() {
    let mut machine = machines::all().into_iter().find(|m| m.name == "vertical_small").unwrap();
    // The tighter bearing locates the shaft axially; the other one hangs in its clearance.
    let bearing =
        |class: &str| format!("model = \"ball\"\ndesignation = \"6306\"\nclearance = \"{class}\"\n");
    machine.bearings[0].2 = bearing("C2");
    machine.bearings[1].2 = bearing("C4");
    let found = warnings_of(&machine.text());
    assert!(codes(&found).contains("bearing-unloaded"), "{found:?}");
    // Without gravity neither carries, and the whole rotor is free.
    machine.gravity = "0 m/s^2";
    let found = warnings_of(&machine.text());
    let unloaded = found.iter().filter(|w| w.code.name() == "bearing-unloaded").count();
    let motions: Vec<&str> =
        found.iter().filter(|w| w.code.name().starts_with("free-")).map(|w| w.text.as_str()).collect();
    assert_eq!(unloaded, 2, "{found:?}");
    for motion in ["axial motion", "lateral motion of the shaft (u_x)", "lateral motion of the shaft (u_y)"] {
        assert!(motions.iter().any(|text| text.contains(motion)), "{motion}: {motions:?}");
    }
}

/// All six rigid-body motions of a shaft without supports are told apart, but for the rotation that a drive prescribes.
#[test]
fn the_motions_of_a_free_shaft_have_a_name_each() {
    let mut two = crate::spoiled::machine("two_discs_soft");
    two.bearings.clear();
    two.gravity = "0 m/s^2";
    let found = warnings_of(&two.text());
    let motions: BTreeSet<&str> =
        found.iter().filter(|w| w.code.name().starts_with("free-")).map(|w| w.text.as_str()).collect();
    for motion in ["(u_x)", "(u_y)", "(u_z)", "tilting of the shaft (θ_x)", "tilting of the shaft (θ_y)"] {
        assert!(motions.iter().any(|text| text.contains(motion)), "{motion}: {motions:?}");
    }
    assert_eq!(motions.len(), 6, "with that of the missing support: {motions:?}");
}

//! Exit codes and error messages.

use crate::rotordyn;

const RIG: &str = "models/overhung_rig.toml";

/// Runs a command that must fail; returns its standard error.
fn failure(arguments: &[&str], code: i32) -> String {
    let assert = rotordyn().args(arguments).assert().code(code);
    let output = assert.get_output();
    assert!(output.stdout.is_empty(), "{}", String::from_utf8_lossy(&output.stdout));
    String::from_utf8(output.stderr.clone()).unwrap()
}

fn assert_contains(text: &str, parts: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
}

#[test]
fn invalid_arguments() {
    failure(&["modal"], 2);
    failure(&["dance", RIG], 2);
    failure(&["check", RIG, "--set", "no_value"], 2);
    failure(&["check", RIG, "--threads", "0"], 2);
}

#[test]
fn missing_files() {
    assert_contains(&failure(&["check", "models/nowhere.toml"], 4), &["read the model file", "nowhere.toml"]);
    assert_contains(&failure(&["orders", "models"], 4), &["results.h5"]);
    assert_contains(&failure(&["spectrogram", RIG], 2), &["overhung_rig.toml"]);
    // The path of the results folder is an existing file.
    let out = ["modal", RIG, "--no-figures", "--out", "Cargo.toml"];
    assert_contains(&failure(&out, 4), &["Cargo.toml"]);
}

#[test]
fn invalid_settings_name_their_key() {
    let set = |assignment: &str| failure(&["check", RIG, "--set", assignment], 2);
    assert_contains(&set("bearing.B.radial_clearence=20 um"), &["radial_clearence", "radial_clearance"]);
    assert_contains(&set("bearing.C.radial_clearance=20 um"), &["the model has no `bearing.C`"]);
    assert_contains(&set("bearing.B.radial_clearance=20"), &["unit"]);
    assert_contains(&set("bearing.B.radial_clearance=20 kg"), &["mass"]);
    assert_contains(&set("speed.to=inf rpm"), &["finite"]);
    assert_contains(&failure(&["check", RIG, "--variant", "sperical"], 2), &["unknown variant", "spherical"]);
    assert_contains(&failure(&["modal", RIG, "--speed", "1200"], 2), &["study.modal.speeds", "unit"]);
}

#[test]
fn input_problems_are_listed_in_json() {
    let assert =
        rotordyn().args(["check", RIG, "--json", "--set", "disc.main.thickness=-20 mm"]).assert().code(2);
    let document: serde_json::Value = serde_json::from_slice(&assert.get_output().stdout).unwrap();
    assert_eq!(document["exit_code"], 2);
    let error = &document["errors"][0];
    assert_eq!(error["kind"], "input");
    assert_eq!(error["problems"][0]["kind"], "OutOfRange");
}

/// Grooves that cut through the ring: detected by the geometry check, reported at the bearing's table.
#[test]
fn overlapping_parts_of_a_bearing() {
    let text = failure(&["modal", RIG, "--set", "bearing.B.bore=30.56 mm", "--no-figures"], 2);
    assert_contains(
        &text,
        &["bearing.B", "overlap by", "the inner groove", "[bearing.B]", "models/overhung_rig.toml"],
    );
    assert!(!text.contains("bearing.A:"), "{text}");
    insta::assert_snapshot!("overlapping_parts", text.trim());
    let pockets = failure(&["check", RIG, "--variant", "wavy", "--set", "bearing.A.width=5 mm"], 2);
    assert_contains(&pockets, &["bearing.A", "cage pocket", "overlap by"]);
}

/// Unsupported rotor: the message names the rigid-body mode, not a matrix.
#[test]
fn free_motions_are_physics_errors() {
    let folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string("models/jeffcott.toml").unwrap();
    let (before, rest) = text.split_once("[bearing.A]").unwrap();
    let (_, after) = rest.split_once("[unbalance.disc]").unwrap();
    let write = |name: &str, bearings: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, format!("{before}{bearings}\n[unbalance.disc]{after}")).unwrap();
        path.to_str().unwrap().to_string()
    };
    let none = write("none.toml", "");
    let text = failure(&["check", &none], 3);
    insta::assert_snapshot!("singular_system", text.trim());
    assert_contains(&text, &["singular", "motion of the shaft", "unconstrained"]);
    // A single bearing: the shaft tilts about it.
    let one = write(
        "one.toml",
        "[bearing.A]\nstation = \"A\"\nmodel = \"linear\"\nk_xx = \"2e7 N/m\"\nk_yy = \"2e7 N/m\"\nk_zz = \"2e7 N/m\"",
    );
    assert_contains(&failure(&["run", &one, "--no-figures"], 3), &["singular", "shaft", "unconstrained"]);
    // Axial rigid-body mode without axial load: valid, but with a warning.
    let slides = "[bearing.A]\nstation = \"A\"\nmodel = \"linear\"\nk_xx = \"2e7 N/m\"\nk_yy = \"2e7 N/m\"\n\
                  [bearing.B]\nstation = \"B\"\nmodel = \"linear\"\nk_xx = \"2e7 N/m\"\nk_yy = \"2e7 N/m\"";
    let slides = write("slides.toml", slides);
    let assert = rotordyn().args(["check", &slides]).assert().success();
    let warning = String::from_utf8_lossy(&assert.get_output().stderr).to_string();
    assert_contains(&warning, &["unconstrained rigid-body mode: axial motion of the shaft (u_z)"]);
}

#[test]
fn cage_phases_without_balls_or_a_range() {
    let run = |model: &str, phases: &str| failure(&["run-up", model, "--cage-phases", phases], 2);
    assert_contains(
        &run("models/jeffcott.toml", "4"),
        &["study.run_up.cage_phases needs a bearing with balls"],
    );
    assert_contains(
        &run("models/overhung_rig.toml", "1"),
        &["study.run_up.cage_phases is 1", "2 phases or more"],
    );
}

//! Axial preload of bearings in the machine: printed beside the stated one, and stated by its mounted value.

use crate::{json_of, output_of, rotordyn};

/// A rigid rotor between two equal angular contact bearings of opposite thrust, without gravity.
fn model(a: &str, b: &str) -> String {
    format!(
        r#"[model]
name = "spindle"
gravity = "0 m/s^2"
[rotor]
length = "0.3 m"
outer_diameter = "30 mm"
mass = "4 kg"
centre = "0 m"
[station]
A = "-0.1 m"
B = "0.12 m"
[bearing.A]
model = "ball"
designation = "7205B"
station = "A"
thrust = "-z"
{a}
[bearing.B]
model = "ball"
designation = "7205B"
station = "B"
thrust = "+z"
{b}
[drive]
kind = "prescribed"
station = "A"
[study.static]
"#
    )
}

fn document(text: &str, command: &str, more: &[&str]) -> serde_json::Value {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("spindle.toml");
    std::fs::write(&path, text).unwrap();
    let mut run = rotordyn();
    run.arg(command).arg(&path).args(more);
    if command != "check" {
        run.args(["--no-figures", "--out"]).arg(folder.path().join("out"));
    }
    json_of(&mut run)
}

fn preload(found: &serde_json::Value, k: usize) -> (f64, f64) {
    let at = &found["preloads"][k];
    (at["axial_force_n"][0].as_f64().unwrap(), at["share"].as_f64().unwrap_or(f64::NAN))
}

/// With equal preloads the rings stay centred; with one of them the shaft yields by half its interference, and each
/// bearing, of force ∝ δ^{3/2} at small changes of the contact angle, carries 2^{-3/2} of it.
#[test]
fn one_preloaded_bearing_carries_a_third_of_its_force_and_says_so() {
    let force = "preload = { force = \"12 N\" }";
    let both = document(&model(force, force), "check", &[]);
    for k in 0..2 {
        let (carried, share) = preload(&both["variants"][0], k);
        assert!((carried - 12.0).abs() < 1e-6 && (share - 1.0).abs() < 1e-7, "{both}");
    }
    let text = model(force, "");
    let one = document(&text, "check", &[]);
    let (carried, share) = preload(&one["variants"][0], 0);
    println!("{carried} N, {share}");
    assert!((share - 0.125f64.sqrt()).abs() < 0.01, "{share}");
    let at_equilibrium = document(&text, "static", &[]);
    let force = at_equilibrium["equilibrium"]["bearings"][0]["force"][2].as_f64().unwrap();
    assert!((force - carried).abs() < 1e-6 * carried, "{force} {carried}");
    let warning = at_equilibrium["warnings"].to_string();
    assert!(warning.contains("bearing.A carries") && warning.contains("mounted_force"), "{warning}");
    assert!(!document(&model("", ""), "static", &[])["warnings"].to_string().contains("bearing.A carries"));
}

/// The interference of a mounted preload on one of two equal bearings is twice that of each with the same force.
#[test]
fn mounted_force_is_the_axial_force_in_the_machine() {
    let found = document(&model("preload = { mounted_force = \"180 N\" }", ""), "check", &[]);
    let (carried, share) = preload(&found["variants"][0], 0);
    assert!((carried - 180.0).abs() < 1e-6 && (share - 1.0).abs() < 1e-8, "{found}");
    let interference = found["variants"][0]["preloads"][0]["interference_m"].as_f64().unwrap();
    let alone = r#"[model]
name = "alone"
[bearing.A]
model = "ball"
designation = "7205B"
thrust = "-z"
preload = { dry_force = "180 N" }
"#;
    let alone = document(alone, "bearing", &[]);
    let offset = alone["bearings"][0]["preload"]["offset"].as_f64().unwrap();
    println!("{interference} {offset}");
    assert!((interference / offset - 2.0).abs() < 1e-8, "{interference} {offset}");
    // A load on the shaft is part of the axial force, and all studies have the same preload.
    let pushed = format!(
        "{}[load.push]\nat = \"station.A\"\nforce = \"0, 0, 60 N\"\n[study.modal]\nspeeds = \"0 rpm\"\n",
        model("preload = { mounted_force = \"180 N\" }", "")
    );
    let found = document(&pushed, "static", &[]);
    let force = |k: usize| found["equilibrium"]["bearings"][k]["force"][2].as_f64().unwrap();
    assert!((force(0) - 180.0).abs() < 1e-5 && (force(1) + 240.0).abs() < 1e-5, "{} {}", force(0), force(1));
    let modal = document(&pushed, "modal", &[]);
    let heavier = document(&pushed, "modal", &["--set", "bearing.A.preload.mounted_force=\"400 N\""]);
    let first = |found: &serde_json::Value| found["modal"][0]["modes"][0]["frequency_hz"].as_f64().unwrap();
    assert!(first(&heavier) > 1.05 * first(&modal));
}

#[test]
fn mounted_preloads_that_determine_nothing_are_refused() {
    let refused = |text: &str, command: &str| {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("spindle.toml");
        std::fs::write(&path, text).unwrap();
        let out = rotordyn().arg(command).arg(&path).output().unwrap();
        assert_eq!(out.status.code(), Some(2), "{}", String::from_utf8_lossy(&out.stderr));
        String::from_utf8_lossy(&out.stderr).into_owned()
    };
    let force = "preload = { mounted_force = \"100 N\" }";
    let both = refused(&model(force, force), "check");
    assert!(both.contains("both have a mounted_force"), "{both}");
    let pair = format!("arrangement = \"back_to_back\"\nrow_spacing = \"15 mm\"\n{force}");
    let pair = refused(&model(&pair, "").replace("thrust = \"-z\"\n", ""), "check");
    assert!(pair.contains("a matched pair is preloaded within"), "{pair}");
    let alone = format!(
        "[model]\nname = \"b\"\n[bearing.A]\nmodel = \"ball\"\ndesignation = \"7205B\"\nthrust = \"+z\"\n{force}\n"
    );
    let alone = refused(&alone, "bearing");
    assert!(alone.contains("needs the machine"), "{alone}");
}

/// A spring on the opposite bearing limits the axial force.
#[test]
fn unreachable_mounted_force() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("spindle.toml");
    let spring = "preload = { spring = \"1e3 N/m\", force = \"50 N\" }";
    std::fs::write(&path, model("preload = { mounted_force = \"180 N\" }", spring)).unwrap();
    let out = rotordyn().arg("check").arg(&path).output().unwrap();
    let text = String::from_utf8_lossy(&out.stderr);
    assert_eq!(out.status.code(), Some(3), "{text}");
    assert!(text.contains("bearing A") && text.contains("180.0"), "{text}");
    // The spring's own force is reported.
    std::fs::write(&path, model("", spring)).unwrap();
    let text = output_of(rotordyn().arg("check").arg(&path));
    assert!(text.contains("spring 1000 N/m, 50.00 N"), "{text}");
}

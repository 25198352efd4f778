//! Ball inertia in the output of every command; the assumed cage of a bearing.

use crate::{json_of, output_of, rotordyn};
use std::path::PathBuf;

const BEARING: &str = r#"
[model]
name = "b"
[bearing.b]
model = "ball"
balls = 10
ball_diameter = "20.07 mm"
pitch_diameter = "71.21 mm"
inner_osculation = 0.52
outer_osculation = 0.52
contact_angle = "25 deg"
thrust = "+z"
[study.bearing]
load = "0, -2000, 2000 N"
speed = "9000 rpm"
"#;

fn file(folder: &tempfile::TempDir, text: &str) -> PathBuf {
    let path = folder.path().join("b.toml");
    std::fs::write(&path, text).unwrap();
    path
}

#[test]
fn bearing_says_which_inertia_and_why() {
    let folder = tempfile::tempdir().unwrap();
    let run = |text: &str| {
        let mut command = rotordyn();
        command.arg("bearing").arg(file(&folder, text)).arg("--no-figures").arg("--out").arg(folder.path());
        command
    };
    let found = json_of(&mut run(BEARING));
    let used = &found["bearings"][0]["ball_inertia"];
    assert_eq!((&used["stated"], &used["used"]), (&"auto".into(), &"outer_race_control".into()));
    let number = |key: &str| used[key].as_f64().unwrap();
    let ratio = number("centrifugal_force_n") / number("largest_contact_load_n");
    assert!((number("ratio") / ratio - 1.0).abs() < 1e-12 && ratio > number("limit"));
    assert!((number("speed_rpm") - 9000.0).abs() < 1e-9);
    assert!(output_of(&mut run(BEARING)).contains("outer_race_control (auto),\n    centrifugal force"));

    let massless = BEARING.replace("thrust", "ball_inertia = \"none\"\nthrust");
    let found = json_of(&mut run(&massless));
    let warnings = found["warnings"].as_array().unwrap();
    let text = warnings.iter().filter_map(|w| w.as_str()).find(|w| w.contains("massless")).unwrap();
    assert!(text.contains("9000 rpm") && text.contains('%'), "{text}");
}

#[test]
fn machine_says_which_inertia_and_why() {
    let folder = tempfile::tempdir().unwrap();
    let mut command = rotordyn();
    command.args(["static", "models/overhung_rig.toml", "--set", "study.static.speed=\"1200 rpm\""]);
    let found = json_of(command.arg("--no-figures").arg("--out").arg(folder.path()));
    let used = found["ball_inertia"].as_array().unwrap();
    assert_eq!(used.len(), 2);
    for used in used {
        assert_eq!((&used["study"], &used["used"]), (&"static".into(), &"none".into()));
        assert!(used["ratio"].as_f64().unwrap() < used["limit"].as_f64().unwrap());
    }
}

#[test]
fn an_assumed_cage_refuses_no_bearing() {
    let folder = tempfile::tempdir().unwrap();
    let bearing = |text: &str| {
        let mut command = rotordyn();
        command.arg("bearing").arg(file(&folder, text)).arg("--no-figures").arg("--out").arg(folder.path());
        command
    };
    // The issue's bearing, and a fuller one with 0.1 mm between its balls.
    for pitch in ["71.21 mm", "65.28 mm"] {
        let text = BEARING.replace("71.21 mm", pitch).replace("25 deg", "15 deg");
        bearing(&text).assert().success();
    }
    let stated = BEARING.replace("thrust", "cage_pocket_diameter = \"21.9 mm\"\nthrust");
    bearing(&stated).assert().code(2);
}

//! `init`: starter machines, each of which runs every study without a warning; and a file without studies.

use crate::{json_of, output_of, rotordyn};
use serde_json::{Value, json};
use std::path::Path;

const KINDS: [&str; 6] = ["motor", "fan", "pump", "spindle", "vertical", "test-rig"];

/// Writes a starter machine into a folder.
fn init(kind: &str, folder: &Path) -> String {
    let file = folder.join(format!("{kind}.toml"));
    output_of(rotordyn().args(["init", kind, "-o"]).arg(&file));
    file.display().to_string()
}

/// A command that must succeed, print neither errors nor warnings, and have none in its document.
fn quiet_document(args: &[&str]) -> Value {
    let document = json_of(rotordyn().args(args).arg("--quiet"));
    assert_eq!(document["warnings"].as_array().map_or(0, Vec::len), 0, "{args:?}: {}", document["warnings"]);
    assert_eq!(document["exit_code"], 0, "{args:?}");
    let run = rotordyn().args(args).arg("--quiet").assert().success();
    let errors = String::from_utf8_lossy(&run.get_output().stderr).into_owned();
    assert_eq!(errors, "", "{args:?}");
    document
}

/// All studies of the file in one run, the commands that have settings of their own, and the bearings.
fn every_study(kind: &str) {
    let folder = tempfile::tempdir().unwrap();
    let file = init(kind, folder.path());
    let out = folder.path().join("out").display().to_string();
    let check = quiet_document(&["check", &file]);
    assert_eq!(check["variants"][0]["rigid_body_modes"], json!([]), "{kind}");
    let run = json_of(rotordyn().args(["run", &file, "--no-figures", "--quiet", "--out", &out]));
    assert_eq!(run["warnings"], json!([]), "{kind}");
    assert_eq!(run["errors"], json!([]), "{kind}");
    for study in [
        "equilibrium",
        "modal",
        "campbell",
        "critical_speeds",
        "frf",
        "unbalance",
        "run_up",
        "spectrograms",
        "orders",
        "poincare",
        "lyapunov",
        "bifurcation",
    ] {
        assert!(!run[study].is_null(), "{kind}: {study} is not in {:?}", run.as_object().unwrap().keys());
    }
    for command in ["bearing", "compare", "export"] {
        let args = [command, file.as_str(), "--out", &out, "--quiet"];
        let figures: &[&str] = if command == "export" { &[] } else { &["--no-figures"] };
        let run = rotordyn().args(args).args(figures).assert().success();
        let errors = String::from_utf8_lossy(&run.get_output().stderr).into_owned();
        assert_eq!(errors, "", "{kind}: {command}");
    }
}

#[test]
fn motor_runs_every_study_without_a_warning() {
    every_study("motor");
}

#[test]
fn fan_runs_every_study_without_a_warning() {
    every_study("fan");
}

#[test]
fn pump_runs_every_study_without_a_warning() {
    every_study("pump");
}

#[test]
fn spindle_runs_every_study_without_a_warning() {
    every_study("spindle");
}

#[test]
fn vertical_runs_every_study_without_a_warning() {
    every_study("vertical");
}

#[test]
fn test_rig_runs_every_study_without_a_warning() {
    every_study("test-rig");
}

#[test]
fn init_keeps_an_existing_file() {
    let folder = tempfile::tempdir().unwrap();
    let here = |args: &[&str]| {
        let mut command = rotordyn();
        command.current_dir(folder.path()).arg("init").args(args);
        command
    };
    let printed = output_of(&mut here(&["motor"]));
    assert!(printed.contains("motor.toml") && printed.contains("rotordyn run motor.toml"), "{printed}");
    let path = folder.path().join("motor.toml");
    std::fs::write(&path, "mine").unwrap();
    let refused = here(&["motor"]).assert().code(2);
    let message = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
    assert!(message.contains("motor.toml exists") && message.contains("--force"), "{message}");
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "mine");
    let document = json_of(&mut here(&["motor", "--force"]));
    assert_eq!(document["file"], "motor.toml");
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(text.starts_with("# A 2.2 kW"), "{text}");
    assert_eq!(output_of(&mut here(&["motor", "-o", "-"])).trim_end(), text.trim_end());
    let listed = output_of(&mut here(&[]));
    for kind in KINDS {
        assert!(listed.contains(kind), "{listed}");
    }
    let help = output_of(&mut here(&["--help"]));
    for kind in KINDS {
        assert!(help.contains(kind), "{help}");
    }
    assert_eq!(json_of(&mut here(&[]))["kinds"].as_array().unwrap().len(), KINDS.len());
    here(&["turbine"]).assert().code(2);
}

/// The README's machine without probes, excitations, unbalance and speed does every study.
#[test]
fn a_file_without_probes_and_unbalance_does_every_study() {
    let folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string("README.md").unwrap();
    let (_, rest) = text.split_once("```toml\n").unwrap();
    let (example, _) = rest.split_once("```").unwrap();
    let file = folder.path().join("fan.toml");
    std::fs::write(&file, example).unwrap();
    let run = |args: &[&str]| {
        let mut command = rotordyn();
        command.arg(args[0]).arg(&file).args(&args[1..]).args(["--quiet", "--no-figures", "--out"]);
        json_of(command.arg(folder.path()))
    };
    let frf = run(&["frf", "--max-frequency", "50 Hz"]);
    let functions = frf["frf"]["functions"].as_array().unwrap().iter();
    let pairs: Vec<String> = functions
        .map(|f| format!("{}/{}", f["response"].as_str().unwrap(), f["excitation"].as_str().unwrap()))
        .collect();
    for response in ["fan_x", "fan_y", "A_x", "A_y", "B_x", "B_y"] {
        assert!(
            pairs.contains(&format!("{response}/x")) && pairs.contains(&format!("{response}/y")),
            "{pairs:?}"
        );
    }
    assert_eq!(pairs.len(), 12);
    let unbalance = run(&["unbalance", "--max-speed", "1000 rpm"]);
    assert!(unbalance["unbalance"].is_object());
    for command in ["static", "modal", "campbell", "critical", "bearing"] {
        assert_eq!(run(&[command])["exit_code"], 0, "{command}");
    }
    let run_up =
        run(&["run-up", "--set", "speed={ profile = \"ramp\", to = \"600 rpm\", ramp = \"0.2 s\" }"]);
    assert!(run_up["run_up"].is_object());
    let short = ["--transient-periods", "2", "--periods", "8", "--speed", "3000 rpm"];
    for command in ["poincare", "lyapunov"] {
        let args: Vec<&str> = std::iter::once(command).chain(short).collect();
        assert_eq!(run(&args)["exit_code"], 0, "{command}");
    }
}

/// A message about a flag shows the flag, one about a value of the program shows no text.
#[test]
fn messages_point_to_the_command_line_as_it_was_written() {
    let rig = "models/overhung_rig.toml";
    let message = |args: &[&str]| {
        let run = rotordyn().args(args).assert().code(2);
        String::from_utf8_lossy(&run.get_output().stderr).into_owned()
    };
    let flag = message(&["modal", rig, "--speed", "3000"]);
    for part in ["command line", "--speed \"3000\"", "if rpm is meant, write \"3000 rpm\""] {
        assert!(flag.contains(part), "{part} is not in {flag}");
    }
    let set = message(&["modal", rig, "--set", "bearing.A.radial_clearance=10"]);
    for part in ["command line", "--set bearing.A.radial_clearance=10", "write \"10 um\""] {
        assert!(set.contains(part), "{part} is not in {set}");
    }
    let swept = message(&["campbell", rig, "--max-speed", "6000"]);
    assert!(swept.contains("--max-speed \"6000\"") && !swept.contains("count = 25"), "{swept}");
    let own = message(&[
        "run-up",
        "models/nelson_mcvaugh.toml",
        "--set",
        "drive={ kind = \"torque\", station = \"disc\" }",
    ]);
    assert!(!own.contains("study.run_up.step="), "{own}");
}

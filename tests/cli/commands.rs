//! Every command, with small settings.

use crate::{json_of, models, output_of, rotordyn};
use serde_json::Value;

const RIG: &str = "models/overhung_rig.toml";
const JEFFCOTT: &str = "models/jeffcott.toml";
const COMMANDS: [&str; 24] = [
    "init",
    "import",
    "run",
    "check",
    "static",
    "modal",
    "campbell",
    "critical",
    "frf",
    "unbalance",
    "run-up",
    "spectrogram",
    "orders",
    "bearing",
    "compare",
    "export",
    "update",
    "validate",
    "poincare",
    "lyapunov",
    "bifurcation",
    "signal",
    "trend",
    "identify",
];

#[test]
fn every_model_passes_check_with_all_its_variants() {
    for model in models() {
        let document = json_of(rotordyn().arg("check").arg(&model));
        let text = std::fs::read_to_string(&model).unwrap();
        let variants = document["variants"].as_array().unwrap();
        assert_eq!(variants.len(), 1 + rotordyn::model::variants(&text).len());
        for variant in variants {
            assert!(variant["mass"].as_f64().unwrap() > 0.0);
            assert_eq!(variant["rigid_body_modes"], serde_json::json!([]), "{model:?} {variant}");
        }
    }
}

#[test]
fn check_prints_the_machine_summary() {
    let text = output_of(rotordyn().args(["check", RIG]));
    // 6205: gamma = 7.938 / 38.5
    for part in ["total 17.51 kg", "3.5722", "5.4278", "disc.main, unbalance.residual", "cylindrical"] {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
    assert!(text.lines().all(|line| line.chars().count() <= 100), "{text}");
}

#[test]
fn help_has_examples_units_and_exit_codes() {
    let text = output_of(rotordyn().arg("--help"));
    for part in ["Examples:", "Exit codes:", "Units", "NO_COLOR", "--threads"] {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
    for command in COMMANDS.iter().chain(&["catalogue"]) {
        assert!(text.contains(command));
        let text = output_of(rotordyn().args([command, "--help"]));
        assert!(text.contains("Examples:") && text.contains("Usage:"), "{text}");
    }
}

#[test]
fn studies_print_tables_and_write_files() {
    let folder = tempfile::tempdir().unwrap();
    for (command, flags, part) in [
        ("static", &["--speed", "0 rpm"][..], "Bearing stiffness"),
        ("modal", &["--speed", "600 rpm", "--modes", "4"], "Modes at 600 rpm"),
        ("campbell", &["--max-speed", "600 rpm", "--modes", "4"], "Campbell diagram over 25 speeds"),
        ("critical", &["--max-speed", "2000 rpm", "--orders", "1"], "Critical speeds up to 2000 rpm"),
        (
            "frf",
            &["--max-frequency", "60 Hz", "--quantity", "mobility"],
            "mobility at 0 rpm, 237 frequencies",
        ),
        ("unbalance", &["--max-speed", "2000 rpm"], "Unbalance response (1x) over 200 speeds"),
    ] {
        let text = output_of(rotordyn().args([command, JEFFCOTT, "--out"]).arg(folder.path()).args(flags));
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
    // All commands add their results to one file; each writes its figures.
    let store = rotordyn::io::hdf5::Store::open(folder.path().join("results.h5")).unwrap();
    for group in ["/equilibrium", "/modes", "/campbell", "/critical_speeds", "/frf", "/unbalance"] {
        assert!(store.contains(group), "{group}");
    }
    for figure in ["campbell.svg", "campbell.png", "modes_600rpm.svg", "machine_layout.png"] {
        assert!(folder.path().join(figure).exists(), "{figure}");
    }
}

/// Printed frequency against the closed form: first bending pair of a Jeffcott rotor on stiff bearings.
#[test]
fn modal_prints_the_first_bending_frequency() {
    let folder = tempfile::tempdir().unwrap();
    let mut command = rotordyn();
    command.args(["modal", JEFFCOTT, "--no-figures", "--speed", "0 rpm", "--out"]).arg(folder.path());
    let text = output_of(&mut command);
    let first: f64 = text
        .lines()
        .find(|l| l.contains("1st bending x"))
        .and_then(|l| l.split_whitespace().nth(1))
        .unwrap()
        .parse()
        .unwrap();
    // The model file's estimate with rigid bearings is 1550 rpm; bearings of 2e7 N/m lower it by 0.1 %.
    assert!((first * 60.0 / 1550.0 - 1.0).abs() < 5e-3, "{first}");
}

#[test]
fn studies_missing_in_the_file_report_their_defaults() {
    let folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string(JEFFCOTT).unwrap();
    let studies = text.find("[study.static]").unwrap();
    let model = folder.path().join("bare.toml");
    std::fs::write(&model, &text[..studies]).unwrap();
    for command in ["static", "modal", "campbell", "critical", "frf", "unbalance"] {
        let mut command_line = rotordyn();
        command_line.arg(command).arg(&model).args(["--no-figures", "--out"]).arg(folder.path());
        let text = output_of(&mut command_line);
        assert!(text.contains(&format!("the file has no [study.{command}]")), "{text}");
    }
    let run = rotordyn().arg("run").arg(&model).assert().code(2);
    assert!(String::from_utf8_lossy(&run.get_output().stderr).contains("contains no study"));
}

#[test]
fn quiet_prints_nothing_and_json_only_json() {
    let folder = tempfile::tempdir().unwrap();
    let modal = |flag: &str| {
        let mut command = rotordyn();
        command.args(["modal", JEFFCOTT, "--no-figures", flag, "--out"]).arg(folder.path());
        command.assert().success().get_output().clone()
    };
    let quiet = modal("--quiet");
    assert!(quiet.stdout.is_empty() && quiet.stderr.is_empty());
    let json = modal("--json");
    assert!(json.stderr.is_empty());
    let document: Value = serde_json::from_slice(&json.stdout).unwrap();
    assert_eq!(document["command"], "modal");
    assert_eq!(document["exit_code"], 0);
    assert_eq!(document["schema"], "rotordyn-results-3");
    assert_eq!(document["errors"], serde_json::json!([]));
    let modes = document["modal"][0]["modes"].as_array().unwrap();
    assert_eq!(modes.len(), 10);
    assert!(modes.iter().all(|mode| mode["frequency_hz"].as_f64().unwrap() > 0.0));
}

#[test]
fn compare_lists_the_three_bearing_models() {
    let folder = tempfile::tempdir().unwrap();
    let mut command = rotordyn();
    command.args(["compare", RIG, "--variants", "spherical,cylindrical,base"]);
    command.args(["--set", "study.campbell.modes=4", "--out"]).arg(folder.path());
    let document = json_of(&mut command);
    let still = &document["speeds"][0];
    assert_eq!(still["rpm"].as_f64().unwrap(), 0.0);
    let modes = still["modes"].as_array().unwrap();
    let row = |label: &str| -> Vec<f64> {
        let mode =
            modes.iter().find(|m| m["label"] == label).unwrap_or_else(|| panic!("{label}: {modes:#?}"));
        let values = mode["frequency_hz"].as_array().unwrap();
        values.iter().map(|v| v.as_f64().expect("a mode in every variant")).collect()
    };
    // Second bending pair in descending frequency as in the paper: cylindrical, spherical, ball bearings.
    let second = row("2nd bending y");
    assert!(second[1] > second[0] && second[0] > second[2], "{second:?}");
    let torsion = row("1st torsional");
    assert!(torsion.iter().all(|f| (f / torsion[0] - 1.0).abs() < 1e-3), "{torsion:?}");
    assert!(document["files"].as_array().unwrap().iter().any(|f| f.as_str().unwrap().contains("frf")));
}

#[test]
fn catalogue_lists_all_bearings_and_one() {
    let all = json_of(rotordyn().arg("catalogue"));
    assert!(all["bearings"].as_array().unwrap().len() >= 40);
    let one = json_of(rotordyn().args(["catalogue", "6205"]));
    let bearing = &one["bearings"][0];
    // Z/2 (1 - D_w/D_pw) with the listed geometry.
    let [z, ball, pitch] = ["balls", "ball_diameter", "pitch_diameter"].map(|k| bearing[k].as_f64().unwrap());
    let expected = 0.5 * z * (1.0 - ball / pitch);
    assert!((bearing["orders"]["bpfo"].as_f64().unwrap() - expected).abs() < 1e-12);
    let sheet = output_of(rotordyn().args(["catalogue", "6205"]));
    assert!(sheet.contains("radial clearance C3") && sheet.contains("13 to 28 um"), "{sheet}");
    rotordyn().args(["catalogue", "nonsense"]).assert().code(2);
    // A size without suffix says which contact angle it means, and lists no other.
    let sheet = output_of(rotordyn().args(["catalogue", "7016"]));
    assert!(sheet.contains("30 deg without suffix (C 15 deg, AC 25 deg, B 40 deg)"), "{sheet}");
    assert!(
        sheet.contains("estimated from published ratings") && sheet.contains("NTN CAT. No. 2203/E"),
        "{sheet}"
    );
    let one = json_of(rotordyn().args(["catalogue", "7016ac"]));
    assert_eq!(
        (&one["bearings"][0]["estimated"], &one["bearings"][0]["designation"]),
        (&true.into(), &"7016AC".into())
    );
    let unknown = rotordyn().args(["catalogue", "6225"]).assert().code(2);
    let text = String::from_utf8_lossy(&unknown.get_output().stderr).to_string();
    assert!(text.contains("6224") && text.contains("6226"), "{text}");
}

/// The README's example model works, every command is mentioned and every link resolves.
#[test]
fn readme_example_commands_and_links_are_valid() {
    let folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string("README.md").unwrap();
    let (_, rest) = text.split_once("```toml\n").unwrap();
    let (example, _) = rest.split_once("```").unwrap();
    let model = folder.path().join("fan.toml");
    std::fs::write(&model, example).unwrap();
    let document = json_of(rotordyn().arg("check").arg(&model));
    let names: Vec<&str> =
        document["variants"].as_array().unwrap().iter().map(|v| v["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["base", "loose"]);
    output_of(rotordyn().arg("modal").arg(&model).args(["--variant", "loose", "--out"]).arg(folder.path()));
    for command in COMMANDS.iter().chain(&["catalogue"]) {
        assert!(text.contains(&format!("`{command}")), "the README does not mention {command}");
    }
    for link in text.split("](").skip(1).filter_map(|rest| rest.split_once(')')) {
        assert!(std::path::Path::new(link.0).exists(), "{} does not exist", link.0);
    }
}

//! What people change first in a starter machine, and how they mistype commands.

use crate::{json_of, output_of, rotordyn};
use std::path::{Path, PathBuf};

const RIG: &str = "models/overhung_rig.toml";

/// A folder with the starter `fan.toml`.
fn fan() -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fan.toml");
    rotordyn().args(["init", "fan", "-o"]).arg(&path).assert().success();
    (folder, path)
}

fn failure(arguments: &[&str], file: Option<&Path>) -> String {
    let mut command = rotordyn();
    command.args(arguments).args(file);
    String::from_utf8(command.assert().code(2).get_output().stderr.clone()).unwrap()
}

/// Orders of the starter are named without bearing: each bearing then has its line.
#[test]
fn another_bearing_at_one_end() {
    let (folder, fan) = fan();
    for designation in ["\"6308\"", "6308"] {
        let set = format!("bearing.A.designation={designation}");
        let document = json_of(rotordyn().arg("check").arg(&fan).args(["--set", &set]));
        assert_eq!(document["exit_code"], 0);
    }
    let out = folder.path().join("out");
    let mut command = rotordyn();
    command.arg("campbell").arg(&fan).args(["--no-figures", "--set", "bearing.A.designation=6308"]);
    command.args(["--set", "study.campbell.orders=[1, \"BPFO\"]", "--out"]).arg(&out);
    let document = json_of(&mut command).to_string();
    assert!(document.contains("A.BPFO") && document.contains("B.BPFO"), "{document}");
}

/// The warning of a file is not that of each of its variants.
#[test]
fn a_warning_of_the_file_is_printed_once() {
    let (_folder, fan) = fan();
    let mut command = rotordyn();
    command.arg("check").arg(&fan).args(["--set", "material.steel.density=7.85 kg/m^3"]);
    let output = command.assert().success().get_output().clone();
    let [text, tables] = [output.stderr, output.stdout].map(|bytes| String::from_utf8(bytes).unwrap());
    assert_eq!(text.matches("7.8500 kg/m^3").count(), 1, "{text}");
    assert!(tables.contains("3 bushings, 0 joints, 1 belt\n"), "{tables}");
}

/// The default excitation has the name of an axis: figure and table say where it acts.
#[test]
fn the_default_excitation_is_at_an_item() {
    let (folder, fan) = fan();
    let text = std::fs::read_to_string(&fan).unwrap();
    let cut =
        text.find("[study.frf.excitation.impeller_x]").unwrap()..text.find("[study.unbalance]").unwrap();
    std::fs::write(&fan, format!("{}{}", &text[..cut.start], &text[cut.end..])).unwrap();
    let out = folder.path().join("out");
    let tables = output_of(rotordyn().arg("frf").arg(&fan).arg("--out").arg(&out));
    assert!(tables.contains("  x at disc.impeller  "), "{tables}");
    let figure = std::fs::read_to_string(out.join("frf_x.svg")).unwrap();
    assert!(figure.contains("FRFs for a force along x at disc.impeller"), "{}", &figure[..2000]);
}

/// Each of the two commands on a stored run lists and takes the options that it has an effect for.
#[test]
fn options_without_effect_are_refused() {
    let listed = |command: &str| output_of(rotordyn().args([command, "--help"]));
    for (command, own, others) in [
        (
            "spectrogram",
            ["--length", "--max-frequency"].as_slice(),
            ["--max-order", "--resolution", "--bandwidth"].as_slice(),
        ),
        ("orders", &["--max-order", "--resolution", "--bandwidth"], &["--length", "--max-frequency"]),
    ] {
        let help = listed(command);
        assert!(own.iter().all(|option| help.contains(&format!("{option} <"))), "{help}");
        for option in others {
            assert!(!help.contains(&format!("{option} <")), "{help}");
            let message = failure(&[command, "out/nowhere", option, "1"], None);
            assert!(message.contains(&format!("unexpected argument '{option}'")), "{message}");
        }
    }
}

/// Defaults are shown as they can be typed, and no help text has the escapes of its source.
#[test]
fn help_can_be_copied() {
    for command in json_of(rotordyn().args(["help", "commands"]))["commands"].as_array().unwrap() {
        let name = command["name"].as_str().unwrap();
        let help = output_of(rotordyn().args([name, "--help"]));
        assert!(!help.contains("\\[") && !help.contains("\\]"), "{help}");
        let folder = match name {
            "validate" => "[default: out/NAME_validation or out/NAME_VARIANT_validation]",
            "update" => "[default: out/NAME_updated or out/NAME_VARIANT_updated]",
            "compare" => "[default: out/NAME_comparison]",
            _ => continue,
        };
        let words = help.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words.contains(folder), "{help}");
    }
    for (command, default) in [("update", "[default: frequency,mac]"), ("export", "[default: csv,uff,mat]")] {
        let help = output_of(rotordyn().args([command, "--help"]));
        assert!(help.split_whitespace().collect::<Vec<_>>().join(" ").contains(default), "{help}");
    }
}

#[test]
fn a_model_file_is_no_results_file() {
    let (folder, fan) = fan();
    let page = folder.path().join("x.html");
    std::fs::write(&page, "<p>").unwrap();
    for (command, file) in [("spectrogram", &fan), ("orders", &fan), ("report", &page)] {
        let message = failure(&[command], Some(file.as_path()));
        assert!(message.contains("not an HDF5 file; give results.h5 of a run or its folder"), "{message}");
    }
}

/// Wrong arguments give the same document as other failures, and their message on standard error as without `--json`.
#[test]
fn wrong_arguments_are_an_error_of_the_document() {
    for (arguments, message) in [
        (["modal", RIG, "--json", "--bogus"].as_slice(), "unexpected argument '--bogus' found"),
        (&["--json", "dance", RIG], "unrecognized subcommand 'dance'"),
        (&["modal", "--json"], "the following required arguments were not provided: <MODEL>"),
        (&["check", RIG, "--json", "--threads", "0"], "invalid value '0' for '--threads <N>'"),
    ] {
        let output = rotordyn().args(arguments).assert().code(2).get_output().clone();
        let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!((&document["exit_code"], &document["program"]), (&2.into(), &"rotordyn".into()));
        let error = &document["errors"][0];
        assert_eq!((&error["kind"], &error["exit_code"]), (&"input".into(), &2.into()));
        assert!(error["message"].as_str().unwrap().starts_with(message), "{error}");
        assert!(String::from_utf8_lossy(&output.stderr).starts_with("error: "));
    }
    let help = output_of(rotordyn().args(["modal", "--help", "--json"]));
    assert!(help.contains("Usage: rotordyn modal"), "{help}");
}

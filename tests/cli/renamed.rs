//! Former spellings of flags, flag values and keys: the same result, with a note on standard error.

use std::path::Path;

use crate::identify::{frfs, write};
use crate::rotordyn;
use crate::signal::{faulty_bearing_file, faulty_bearing_record};
use rotordyn::io::measured;
use rotordyn::signal::record::{MeasuredData, Record};
use serde_json::Value;

/// JSON document without computing times, and the notes on standard error.
fn run(folder: &Path, args: &[&str]) -> (Value, Vec<String>) {
    let mut command = rotordyn();
    command.args(args).args(["--no-figures", "--json", "--out"]).arg(folder);
    let output = command.assert().success().get_output().clone();
    let mut document: Value = serde_json::from_slice(&output.stdout).unwrap();
    for key in ["seconds", "wall_seconds", "cpu_seconds"] {
        document.as_object_mut().unwrap().remove(key);
    }
    (document, notes(&output.stderr))
}

fn notes(stderr: &[u8]) -> Vec<String> {
    let text = String::from_utf8_lossy(stderr);
    text.lines().filter_map(|line| line.strip_prefix("note: ")).map(String::from).collect()
}

/// Runs a command in the present and in the former spelling: same document, and one note for each change.
fn same_in_both_spellings(command: &[&str], present: &[&str], former: &[&str], expected: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    let (document, none) = run(folder.path(), &[command, present].concat());
    assert!(none.is_empty(), "{none:?}");
    let (other, notes) = run(folder.path(), &[command, former].concat());
    assert_eq!(document, other, "{command:?} {former:?}");
    assert_eq!(notes, expected);
    let mut quiet = rotordyn();
    quiet.args(command).args(former).args(["--no-figures", "--quiet", "--out"]).arg(folder.path());
    assert_eq!(
        String::from_utf8_lossy(&quiet.assert().success().get_output().stderr).matches("note:").count(),
        0
    );
}

#[test]
fn former_flags_of_machine_studies() {
    same_in_both_spellings(
        &["static", "models/overhung_rig.toml"],
        &["--fixed-cage-angle"],
        &["--cage-as-placed"],
        &["--cage-as-placed is now --fixed-cage-angle"],
    );
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("b.toml");
    let text = "[model]\nname = \"b\"\n[bearing.b]\nmodel = \"ball\"\ndesignation = \"6205\"\n";
    std::fs::write(&file, text).unwrap();
    same_in_both_spellings(
        &["bearing", file.to_str().unwrap(), "--load", "0, 0, 500 N"],
        &["--constrain", "x,y,theta_x,theta_y", "--cage-average"],
        &["--hold=x,y,theta_x,theta_y", "--averaged"],
        &["--hold is now --constrain", "--averaged is now --cage-average"],
    );
    let model = "models/varying_compliance.toml";
    let speed = ["--speed", "1600 rpm", "--periods", "20"];
    for command in ["poincare", "lyapunov"] {
        same_in_both_spellings(
            &[&[command, model][..], &speed].concat(),
            &["--transient-periods", "20"],
            &["--settle", "20"],
            &["--settle is now --transient-periods"],
        );
    }
    same_in_both_spellings(
        &["bifurcation", model, "--from", "1600 rpm", "--to", "1700 rpm", "--count", "2", "--periods", "20"],
        &["--transient-periods", "20", "--start", "continuation"],
        &["--settle", "20", "--start", "carried"],
        &["--settle is now --transient-periods", "--start carried is now --start continuation"],
    );
}

#[test]
fn former_flags_of_signal() {
    let folder = tempfile::tempdir().unwrap();
    let rate = 12_000.0;
    let samples = |seconds: f64| faulty_bearing_record((seconds * rate) as usize, rate, 30.0 * 3.58482);
    let x = samples(3.0);
    let y: Vec<f64> = x.iter().rev().copied().collect();
    // Two pulses per revolution at 30 Hz.
    let pulses =
        (0..x.len()).map(|k| if (60.0 * k as f64 / rate).fract() < 0.2 { 5.0 } else { 0.0 }).collect();
    let record = |name: &str, values: Vec<f64>, unit: &str| Record::samples(name, rate, 0.0, values, unit);
    let records = vec![record("x", x, "m/s^2"), record("y", y, "m/s^2"), record("tacho", pulses, "V")];
    let path = folder.path().join("record.h5");
    measured::write(&path, &MeasuredData { records, ..MeasuredData::default() }).unwrap();
    let record = ["signal", path.to_str().unwrap(), "--channel", "x", "--tacho", "tacho"];
    let orders = "BPFO=3.58482,BPFI=5.41518";
    same_in_both_spellings(
        &record,
        &[
            "--pulses-per-rev=2",
            "--bearing-orders",
            orders,
            "--quadrature-channel",
            "y",
            "--reference-time",
            "0.1 s",
            "--band",
            "full",
            "--analyses",
            "envelope,jerk,synchronous-average,cyclic-coherence",
        ],
        &[
            "--pulses-per-turn=2",
            "--rates",
            orders,
            "--beside",
            "y",
            "--datum",
            "0.1 s",
            "--band",
            "whole",
            "--analyses",
            "envelope,jerk,average,cyclic",
        ],
        &[
            "--pulses-per-turn is now --pulses-per-rev",
            "--rates is now --bearing-orders",
            "--beside is now --quadrature-channel",
            "--datum is now --reference-time",
            "--band whole is now --band full",
            "--analyses average is now --analyses synchronous-average",
            "--analyses cyclic is now --analyses cyclic-coherence",
        ],
    );
    let first = faulty_bearing_file(folder.path(), "first.h5", rate, "m/s^2");
    let table = folder.path().join("second.csv");
    let lines: Vec<String> = samples(2.0).iter().map(ToString::to_string).collect();
    std::fs::write(&table, format!("a\n{}\n", lines.join("\n"))).unwrap();
    let second = table.to_str().unwrap();
    let values = [second, "a", "12 kHz", "m/s^2", "1800 rpm", "0.1 s .."];
    let flags = |names: [&'static str; 6]| -> Vec<&str> {
        names.into_iter().zip(values).flat_map(|(name, value)| [name, value]).collect()
    };
    same_in_both_spellings(
        &["signal", first.to_str().unwrap(), "--bearing", "6205-2RS", "--analyses", "envelope"],
        &flags([
            "--compare-with",
            "--compare-channel",
            "--compare-rate",
            "--compare-unit",
            "--compare-speed",
            "--compare-time",
        ]),
        &flags([
            "--against",
            "--against-channel",
            "--against-rate",
            "--against-unit",
            "--against-speed",
            "--against-time",
        ]),
        &[
            "--against is now --compare-with",
            "--against-channel is now --compare-channel",
            "--against-rate is now --compare-rate",
            "--against-unit is now --compare-unit",
            "--against-speed is now --compare-speed",
            "--against-time is now --compare-time",
        ],
    );
}

#[test]
fn former_flag_of_identify() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), "frfs.uff", frfs(&[0]));
    let file = folder.path().join("frfs.uff");
    same_in_both_spellings(
        &["identify", file.to_str().unwrap()],
        &["--exponential-window", "20 s"],
        &["--window", "20 s"],
        &["--window is now --exponential-window"],
    );
}

#[test]
fn both_spellings_of_a_flag_are_an_error() {
    let bearing = ["bearing", "models/overhung_rig.toml", "--no-figures"];
    for (flags, part) in [
        (
            &["--hold", "x", "--constrain", "y"][..],
            "--hold is the former name of --constrain: give only --constrain",
        ),
        (&["--averaged", "--cage-average"], "--cage-average' cannot be used multiple times"),
    ] {
        let assert = rotordyn().args(bearing).args(flags).assert().code(2);
        let text = String::from_utf8_lossy(&assert.get_output().stderr).to_string();
        assert!(text.contains(part), "{text}");
    }
}

/// Keys of the model file, `--set` and `--free`: notes with the place, never a warning.
#[test]
fn former_keys_are_noted() {
    let folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string("models/varying_compliance.toml").unwrap();
    let line = 1 + text.lines().position(|line| line.starts_with("constrain =")).unwrap();
    let file = folder.path().join("former.toml");
    std::fs::write(&file, text.replace("\nconstrain =", "\nhold =")).unwrap();
    let file = file.to_str().unwrap();
    let set = ["--set", "study.lyapunov.settle=70"];
    let output = rotordyn().args(["check", file, "--json"]).args(set).assert().success().get_output().clone();
    let document: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(document["variants"][0]["warnings"], serde_json::json!([]));
    let found = notes(&output.stderr);
    assert_eq!(found.len(), 2, "{found:?}");
    assert!(found[0].starts_with(&format!("{file}:{line}: `joint.")), "{found:?}");
    assert!(found[0].ends_with(".constrain`; the old spelling still works"), "{found:?}");
    assert_eq!(
        found[1],
        "--set: `study.lyapunov.settle` is now `study.lyapunov.transient_periods`; the old spelling still works"
    );
    let output = rotordyn().args(["check", file, "--quiet"]).assert().success().get_output().clone();
    assert!(output.stderr.is_empty() && output.stdout.is_empty());
    // The path of a free parameter; the measured file does not exist.
    let free = ["--free", "study.lyapunov.settle", "--measured", "no_such_file.uff"];
    let output = rotordyn().args(["update", "models/varying_compliance.toml"]).args(free).output().unwrap();
    assert_eq!(
        notes(&output.stderr),
        [
            "--free: `study.lyapunov.settle` is now `study.lyapunov.transient_periods`; the old spelling still works"
        ]
    );
}

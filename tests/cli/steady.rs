//! Steady motions of the varying-compliance machine: Poincaré sections, Lyapunov exponents, bifurcation diagrams.

use crate::{json_of, output_of, rotordyn};
use rotordyn::io::hdf5::{Attribute, Store};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

const MODEL: &str = "models/varying_compliance.toml";
/// Few periods, for a run of about a second.
const SHORT: [&str; 4] = ["--transient-periods", "60", "--periods", "40"];

fn texts(store: &Store, path: &str) -> Vec<String> {
    store.read_texts(path).unwrap()
}

#[test]
fn help_of_steady_motion_commands_has_examples() {
    for command in ["poincare", "lyapunov", "bifurcation"] {
        let text = output_of(rotordyn().args([command, "--help"]));
        assert!(text.contains("Examples:") && text.contains(&format!("[study.{command}]")), "{text}");
    }
}

/// All three commands add their results to one file.
#[test]
fn steady_motions_are_computed_printed_and_stored() {
    let folder = tempfile::tempdir().unwrap();
    let run = |command: &str, flags: &[&str]| {
        output_of(rotordyn().args([command, MODEL, "--out"]).arg(folder.path()).args(flags))
    };
    // At 1600 rpm transients decay within 60 ball passages: a motion with the ball-passage period.
    let text = run("poincare", &["--speed", "1600 rpm", "--transient-periods", "300", "--periods", "40"]);
    for part in
        ["Motion at 1600.0 rpm, 40 section points", "ball passage of C (82.256 Hz)", "period 1", "x_rate"]
    {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
    let text = run("lyapunov", &["--speed", "1600 rpm", "--transient-periods", "300", "--periods", "200"]);
    assert!(text.contains("convergent: regular"), "{text}");
    let range = ["--from", "1600 rpm", "--to", "2300 rpm", "--count", "8"];
    let text = run("bifurcation", &[&range[..], &SHORT].concat());
    for part in
        ["Motion over speed rpm, sweep up", "Motion over speed rpm, sweep down", "not periodic", "period 1"]
    {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
    let store = Store::open(folder.path().join("results.h5")).unwrap();
    assert_eq!(store.read("/poincare/x_y/section_x").unwrap().data.len(), 40);
    assert_eq!(store.attribute("/poincare", "motion").unwrap(), Some(Attribute::Text("period 1".into())));
    let Some(Attribute::Number(exponent)) = store.attribute("/lyapunov", "exponent").unwrap() else {
        panic!()
    };
    let history = store.read("/lyapunov/exponent").unwrap().data;
    // The four exponents sum to −2c/m: the largest is at least −c/(2m) = −5 1/s.
    assert!(exponent < -2.0 && exponent > -10.0 && history.last() == Some(&exponent), "{exponent}");
    let section = store.read("/bifurcation/up/channels/x/section").unwrap();
    assert_eq!(section.shape, [8, 40]);
    let value = store.read("/bifurcation/down/value").unwrap().data;
    assert_eq!((value[0], value[7]), (2300.0, 1600.0));
    for figure in ["poincare_orbits", "poincare_sections", "lyapunov", "bifurcation_x", "bifurcation_y"] {
        assert!(folder.path().join(format!("{figure}.png")).exists(), "{figure}");
    }
}

/// Diagrams over clearance, over the number of balls (every integer), and over speed without a `[speed]` table.
#[test]
fn bifurcation_diagrams_over_any_parameter() {
    let folder = tempfile::tempdir().unwrap();
    let run = |flags: &[&str]| {
        let mut command = rotordyn();
        command
            .args(["bifurcation", MODEL, "--no-figures", "--speed", "1600 rpm", "--out"])
            .arg(folder.path());
        json_of(command.args(SHORT).args(flags))["bifurcation"].clone()
    };
    let clearance = ["--parameter", "bearing.C.radial_clearance", "--from", "0 um", "--to", "40 um"];
    let found = run(&[&clearance[..], &["--count", "5", "--sweep", "up", "--lyapunov"]].concat());
    assert_eq!(found["unit"], "um");
    let points = found["sweeps"][0]["points"].as_array().unwrap();
    assert_eq!((found["sweeps"].as_array().unwrap().len(), points.len()), (1, 5));
    assert!(points.iter().all(|p| p["exponent"]["value"].is_f64()), "{found}");
    // Clearance lowers the shaft by half its value, and further because fewer balls carry the load.
    let lowest = |k: usize| points[k]["extremes"][1][0].as_f64().unwrap();
    let lowering = lowest(0) - lowest(4);
    assert!((20e-6..26e-6).contains(&lowering), "{lowering}");
    let found =
        run(&["--parameter", "bearing.C.balls", "--from", "7", "--to", "9", "--start", "equilibrium"]);
    let points = found["sweeps"][0]["points"].as_array().unwrap();
    let balls: Vec<f64> = points.iter().map(|p| p["value"].as_f64().unwrap()).collect();
    assert_eq!(balls, [7.0, 8.0, 9.0]);
    // The section frequency is each machine's ball-passage frequency: Z times the cage speed.
    for (p, z) in points.iter().zip(balls) {
        let expected = z * 0.385_577 * 1600.0 / 60.0;
        assert!((p["frequency_hz"].as_f64().unwrap() / expected - 1.0).abs() < 1e-6, "{p}");
    }

    let text = std::fs::read_to_string(MODEL).unwrap();
    let speed = text.find("[speed]").unwrap();
    let studies = text.find("[study.bifurcation]").unwrap();
    let rest = text[studies..].split("[variant").next().unwrap();
    let bare = folder.path().join("bare.toml");
    std::fs::write(&bare, format!("{}{rest}", &text[..speed])).unwrap();
    let mut command = rotordyn();
    command.arg("bifurcation").arg(&bare).args(["--no-figures", "--count", "3", "--out"]).arg(folder.path());
    let found = json_of(command.args(SHORT));
    assert_eq!(found["bifurcation"]["sweeps"][0]["points"].as_array().unwrap().len(), 3);
}

/// Identical to the byte: parts of a sweep computed in parallel give the serial diagram.
#[test]
fn bifurcation_diagrams_do_not_depend_on_threads() {
    let folder = tempfile::tempdir().unwrap();
    let run = |threads: &str| {
        let out = folder.path().join(threads);
        let mut command = rotordyn();
        command.args(["bifurcation", MODEL, "--no-figures", "--quiet", "--threads", threads, "--lyapunov"]);
        command.args(["--from", "2000 rpm", "--to", "3800 rpm", "--count", "24", "--out"]).arg(&out);
        command.args(["--transient-periods", "20", "--periods", "20"]).assert().success();
        std::fs::read(out.join("results.h5")).unwrap()
    };
    assert!(run("1") == run("2"), "one and two threads differ");
}

#[test]
fn ctrl_c_keeps_the_computed_values() {
    let folder = tempfile::tempdir().unwrap();
    let mut child = Command::new(assert_cmd::cargo::cargo_bin("rotordyn"))
        .args(["bifurcation", MODEL, "--no-figures", "--threads", "1", "--json"])
        .args([
            "--from",
            "1600 rpm",
            "--to",
            "1700 rpm",
            "--count",
            "1000",
            "--transient-periods",
            "1000",
            "--out",
        ])
        .arg(folder.path())
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    // The folder is locked when the models are read; 20 s later some, but not all, of the 2000 values are computed.
    let begun = Instant::now();
    while !folder.path().join(".rotordyn.lock").exists() {
        assert!(begun.elapsed() < Duration::from_secs(300), "no file after five minutes");
        std::thread::sleep(Duration::from_millis(100));
    }
    std::thread::sleep(Duration::from_secs(20));
    assert!(child.try_wait().unwrap().is_none(), "the run had already finished");
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130));
    let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(document["errors"][0]["message"], "ended by Ctrl-C");
    let store = Store::open(folder.path().join("results.h5")).unwrap();
    assert_eq!(store.attribute("/bifurcation", "complete").unwrap(), Some(Attribute::Integer(0)));
    let motions = texts(&store, "/bifurcation/up/motion");
    assert_eq!(motions.len(), 1000);
    let done = motions.iter().filter(|m| *m != "none: stopped").count();
    assert!((1..1000).contains(&done), "{done}");
}

/// Invalid parameters are reported at their place in the file before any computation.
#[test]
fn invalid_parameter_is_rejected_before_the_run() {
    let error_text = |flags: &[&str]| {
        let output =
            rotordyn().args(["bifurcation", MODEL]).args(flags).assert().code(2).get_output().clone();
        String::from_utf8(output.stderr).unwrap()
    };
    let text = error_text(&["--parameter", "bearing.C.radial_clearence", "--from", "0 um", "--to", "9 um"]);
    assert!(text.contains("did you mean `radial_clearance`?"), "{text}");
    let text = error_text(&["--from", "1600 rpm", "--to", "1600 rpm"]);
    assert!(text.contains("must be above"), "{text}");
}

//! `validate` and `update` with modes of which `identify` warns, and with FRFs through an exponential window.

use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::{json_of, output_of, rotordyn};

/// The fan of `init` and noisy FRFs of it with a softer housing; two modes at 444 and 449 Hz are found as one.
fn fan(folder: &Path, noise: &str, seed: &str) -> [PathBuf; 2] {
    let model = folder.join("fan.toml");
    if !model.exists() {
        rotordyn().current_dir(folder).args(["init", "fan"]).assert().success();
    }
    let out = folder.join("measured");
    let mut frf = rotordyn();
    frf.arg("frf").arg(&model).args(["--set", "housing.B.k_x=3.5e7 N/m", "--noise", noise, "--seed", seed]);
    frf.arg("--no-figures").arg("--out").arg(&out).assert().success();
    [model, out.join("frf_noisy.uff")]
}

fn on(command: &str, [model, measured]: &[PathBuf; 2], out: &Path, more: &[&str]) -> assert_cmd::Command {
    let mut run = rotordyn();
    run.arg(command).arg(model).arg("--measured").arg(measured).args(more);
    run.arg("--no-figures").arg("--out").arg(out);
    run
}

/// Measured modes with a doubt, and the doubt.
fn doubted(modes: &Value) -> Vec<(f64, &str)> {
    fn of(mode: &Value) -> Option<(f64, &str)> {
        Some((mode["measured_hz"].as_f64()?, mode["quality_warnings"].as_str()?))
    }
    modes.as_array().unwrap().iter().filter_map(of).filter(|(_, text)| !text.is_empty()).collect()
}

/// An exact model is not called wrong for a shape that is a mixture of two.
#[test]
fn exact_model_explains_modes_that_are_not_separated() {
    let folder = tempfile::tempdir().unwrap();
    for (noise, seed) in [("40 dB", "1"), ("60 dB", "2")] {
        let files = fan(folder.path(), noise, seed);
        let out = folder.path().join("updated");
        let found = json_of(&mut on("update", &files, &out, &["--free", "housing.B.k_x"]));
        let (chi, degrees) = (&found["chi_squared"], &found["degrees_of_freedom"]);
        assert!(chi.as_f64().unwrap() < 1.5 * degrees.as_f64().unwrap(), "{noise}: {chi} of {degrees}");
        assert_eq!(found["parameters"][0]["identifiability"], "identifiable", "{}", found["parameters"]);
        let warned = found["warnings"].to_string();
        assert!(warned.contains("Hz (stable pole, not refined"), "{warned}");
    }
    // validate names the doubt, in its table and in its file.
    let files = fan(folder.path(), "60 dB", "2");
    let out = folder.path().join("validated");
    let found = json_of(&mut on("validate", &files, &out, &[]));
    let found_doubtful = doubted(&found["measured"][0]["modes"]);
    assert!(
        found_doubtful.iter().any(|(hz, text)| *hz > 430.0 && text.contains("not refined")),
        "{found_doubtful:?}"
    );
    let text = output_of(&mut on("validate", &files, &out, &[]));
    assert!(text.contains("doubt\n") && text.contains("stable pole, not refined"), "{text}");
}

/// The damping of the window is taken off the modes; FRFs that have it are not compared.
#[test]
fn damping_of_an_exponential_window_is_taken_off() {
    let folder = tempfile::tempdir().unwrap();
    let files = fan(folder.path(), "60 dB", "1");
    let out = folder.path().join("validated");
    let of = |more: &[&str]| json_of(&mut on("validate", &files, &out, more));
    let (plain, windowed) =
        (of(&["--band", "100 .. 250 Hz"]), of(&["--band", "100 .. 250 Hz", "--exponential-window", "20 s"]));
    let modes = |found: &Value| -> Vec<[f64; 2]> {
        let modes = found["measured"][0]["modes"].as_array().unwrap().iter();
        modes.map(|m| ["measured_hz", "measured_zeta"].map(|key| m[key].as_f64().unwrap())).collect()
    };
    let (plain_modes, windowed_modes) = (modes(&plain), modes(&windowed));
    assert_eq!(plain_modes.len(), 3, "{plain_modes:?}");
    for ([hz, zeta], [_, without]) in plain_modes.iter().zip(&windowed_modes) {
        let share = 1.0 / (20.0 * TAU * hz);
        assert!(((zeta - without) / share - 1.0).abs() < 0.02, "{hz} Hz: {zeta} {without}");
    }
    assert!(!plain["measured"][0]["frac"].is_null() && windowed["measured"][0]["frac"].is_null());
    let warned = windowed["warnings"].to_string();
    assert!(warned.contains("the FRFs themselves have it"), "{warned}");
}

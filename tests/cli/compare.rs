//! `compare`: cases by variants, repeated settings and names; measured FRFs and run-ups beside them.

use crate::{json_of, output_of, rotordyn};
use rotordyn::io::measured;
use rotordyn::signal::record::{Kind, Values};
use serde_json::Value;
use std::path::Path;

const RIG: &str = "models/overhung_rig.toml";
const MAGNITUDE: &str = "unbalance.residual.magnitude";

fn list<'v>(value: &'v Value, key: &str) -> &'v Vec<Value> {
    value[key].as_array().unwrap_or_else(|| panic!("{key} is no list in {value}"))
}

fn named<'v>(list: &'v [Value], key: &str, name: &str) -> &'v Value {
    list.iter().find(|item| item[key] == name).unwrap_or_else(|| panic!("no {key} {name}"))
}

fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().unwrap_or_else(|| panic!("{key} is no number in {value}"))
}

/// The response is proportional to the unbalance; the modes are the same.
#[test]
fn values_of_a_path_given_twice_are_cases() {
    let folder = tempfile::tempdir().unwrap();
    let mut command = rotordyn();
    command.args(["compare", RIG, "--no-figures", "--modes", "6", "--csv"]);
    command.args(["--set", "study.unbalance.speeds={ from = \"100 rpm\", to = \"1200 rpm\", count = 12 }"]);
    command.args(["--set", &format!("{MAGNITUDE}=0.5 kg mm"), "--set", &format!("{MAGNITUDE}=1.5 kg mm")]);
    let found = json_of(command.arg("--out").arg(folder.path()));
    assert_eq!(found["cases"], serde_json::json!(["magnitude 0.5 kg mm", "magnitude 1.5 kg mm"]));
    for mode in list(&found["speeds"][0], "modes") {
        let pair: Vec<f64> = list(mode, "frequency_hz").iter().map(|f| f.as_f64().unwrap()).collect();
        assert_eq!(pair[0], pair[1]);
    }
    let probes = list(&found["unbalance"], "probes");
    assert!(probes.len() >= 6);
    for probe in probes {
        let curves = list(probe, "curves");
        let points = [&curves[0], &curves[1]].map(|curve| list(curve, "points"));
        assert!(points[0].len() >= 12 && points[0].len() == points[1].len());
        for (a, b) in points[0].iter().zip(points[1]) {
            let ratio = number(b, "amplitude") / number(a, "amplitude");
            assert!((ratio - 3.0).abs() < 1e-9, "{}: {ratio}", probe["probe"]);
        }
    }
    let csv =
        std::fs::read_to_string(folder.path().join("csv/comparison_unbalance_probes_curves_points.csv"));
    let csv = csv.unwrap();
    assert!(csv.lines().next().unwrap().contains("amplitude") && csv.contains("magnitude 1.5 kg mm"));
}

/// What is not a comparison is refused, with the reason.
#[test]
fn nonsense_is_refused_by_name() {
    let refused = |args: &[&str], words: &str| {
        let mut command = rotordyn();
        let output = command.arg("compare").args(args).arg("--no-figures").assert().code(2);
        let text = String::from_utf8(output.get_output().stderr.clone()).unwrap();
        assert!(text.contains(words), "{args:?}: {text}");
    };
    let magnitude = |value: &str| format!("{MAGNITUDE}={value}");
    let (half, one) = (magnitude("0.5 kg mm"), magnitude("1 kg mm"));
    refused(&["models/atef_2022.toml", "--variants", "base"], "compare needs two cases or more");
    refused(&[RIG, "--variants", "wavy"], "such as --variants wavy,");
    refused(&[RIG, "--variant", "wavy"], "compare needs two cases or more");
    refused(&[RIG, "--variants", "wavy,wavy"], "two cases are named `wavy`");
    refused(&[RIG, "--variants", "wavy,wvy"], "wvy");
    refused(&[RIG, "--set", &half, "--set", &half], "two cases are named");
    refused(&[RIG, "--set", "bearing.A.clearence=C3", "--set", "bearing.A.clearence=C4"], "clearence");
    let three = ["--set", "speed.ramp=1 s", "--set", "speed.ramp=2 s", "--set", "speed.ramp=3 s"];
    let uneven = [&[RIG, "--set", &half, "--set", &one], &three[..]].concat();
    refused(&uneven, "is given 2 times and speed.ramp 3 times");
    refused(&[RIG, "--case", "tight bearing.A.radial_clearance=5 um"], "it has no name");
    refused(&[RIG, "--case", "a: x.y=1", "--case", "b: x.y=2"], "--case a: x.y=1");
    let same = ["--case", "a: speed.ramp=2 s", "--case", "b: speed.ramp=2 s"];
    refused(&[&[RIG], &same[..]].concat(), "the cases `a` and `b` are the same");
    refused(&[&[RIG, "--set", &half, "--set", &one], &same[..]].concat(), "beside --case");
    refused(&[RIG, "--case", "measured: speed.ramp=2 s", "--variants", "base"], "cannot be named `measured`");
    refused(&[RIG, "--variants", "base,wavy", "--time", "1 s .. 2 s"], "--measured");
    // No probe in common.
    let z = "{ at = \"disc.main\", direction = \"z\" }";
    let probes = ["a", "b"].map(|name| format!("{name}: probe={{ {name} = {z} }}"));
    let cases = ["--case", &probes[0], "--case", &probes[1], "--set", "study.unbalance.speeds=100 rpm"];
    refused(&[&["models/jeffcott.toml"], &cases[..]].concat(), "no probe with an excitation in common");
}

/// Three bearing models and a measurement: torsion at 46 Hz in all of them, as in figures 6 and 7 of the paper.
#[test]
fn three_bearing_models_beside_measured_frfs() {
    let folder = tempfile::tempdir().unwrap();
    let test = folder.path().join("test");
    let mut command = rotordyn();
    command.args(["frf", RIG, "--noise", "40 dB", "--seed", "5", "--no-figures", "--quiet", "--out"]);
    output_of(command.arg(&test));
    let out = folder.path().join("compared");
    let compare = |file: &Path, more: &[&str]| {
        let mut command = rotordyn();
        command.args(["compare", RIG, "--variants", "spherical,cylindrical,base", "--measured"]).arg(file);
        json_of(command.args(more).arg("--out").arg(&out))
    };
    let found = compare(&test.join("frf_noisy.uff"), &[]);
    let pairs = list(&found["frf"], "pairs");
    let curves_of = |pairs: &[Value], response: &str| -> Vec<Value> {
        let of_rim: Vec<Value> = pairs.iter().filter(|p| p["excitation"] == "rim").cloned().collect();
        list(named(&of_rim, "response", response), "curves").clone()
    };
    let peaks = |curve: &Value| -> Vec<f64> {
        list(curve, "peaks").iter().map(|peak| number(peak, "frequency_hz")).collect()
    };
    for response in ["disc_x", "disc_y", "disc_twist", "rim_y"] {
        let curves = curves_of(pairs, response);
        let names: Vec<&str> = curves.iter().map(|c| c["case"].as_str().unwrap()).collect();
        assert_eq!(names, ["measured", "spherical", "cylindrical", "base"]);
        assert!(curves[0]["frac"].is_null());
        // The measurement is of the model with ball bearings.
        let [spherical, _, base] = [1, 2, 3].map(|k| number(&curves[k], "frac"));
        assert!(base > 0.99 && number(&curves[3], "level_db").abs() < 0.5, "{response}: {base}");
        if response != "disc_twist" {
            assert!(spherical < 0.8, "{response}: {spherical}");
        }
        if response == "rim_y" || response == "disc_twist" {
            for curve in &curves {
                let torsion = peaks(curve).into_iter().find(|hz| (hz - 46.0).abs() < 0.5);
                assert!(torsion.is_some(), "{response} of {}: {:?}", curve["case"], peaks(curve));
            }
        }
    }
    let files: Vec<&str> = list(&found, "files").iter().map(|f| f.as_str().unwrap()).collect();
    for name in ["comparison_frf_rim_rim_y.svg", "comparison_unbalance_disc_x.svg", "comparison_campbell.svg"]
    {
        assert!(files.iter().any(|f| f.ends_with(name)), "{name}: {files:?}");
    }
    let svg = std::fs::read_to_string(out.join("comparison_frf_rim_rim_y.svg")).unwrap();
    assert!(["measured", "spherical", "cylindrical", "base"].iter().all(|name| svg.contains(name)));

    // The same in another quantity, order and sign, without the names of the export, by points or by --pair.
    let mut data = measured::read(&test.join("frf_noisy.uff")).unwrap();
    data.records.retain(|r| r.kind == Kind::Frf && ["disc_x/rim", "disc_y/housing_B"].contains(&&*r.name));
    assert_eq!(data.records.len(), 2);
    for (k, record) in data.records.iter_mut().enumerate() {
        record.name = format!("H{}", k + 1);
        let hz = record.axis.points(record.values.len()).unwrap();
        let Values::Complex(values) = &mut record.values else { panic!() };
        for (h, hz) in values.iter_mut().zip(&hz) {
            *h /= -(std::f64::consts::TAU * hz).powi(2);
        }
        record.unit = "m/N".into();
    }
    let y = &mut data.records[1];
    y.response.direction = -y.response.direction;
    if let Values::Complex(values) = &mut y.values {
        values.iter_mut().for_each(|h| *h = -*h);
    }
    let other = folder.path().join("other.uff");
    measured::write(&other, &data).unwrap();
    // Housings are in the base model only, and a hit between two axes has no direction in a file.
    let found = compare(&other, &["--pair", "H1=disc_x/rim", "--no-figures"]);
    let again = list(&found["frf"], "pairs");
    assert!(number(&curves_of(again, "disc_x")[3], "frac") > 0.99);
    let placed = again.iter().find(|p| p["response"] == "disc_y" && p["excitation"] == "housing_B");
    let placed = list(placed.unwrap(), "curves");
    assert_eq!((placed.len(), placed[0]["case"].as_str()), (2, Some("measured")));
    let base = number(&placed[1], "frac");
    assert!(base > 0.98, "{base}");
    let refused = |args: &[&str], words: &str| {
        let mut command = rotordyn();
        command.args(["compare", RIG, "--variants", "base,wavy", "--no-figures", "--measured"]).arg(&other);
        let output = command.args(args).assert().code(2);
        let text = String::from_utf8(output.get_output().stderr.clone()).unwrap();
        assert!(text.contains(words), "{args:?}: {text}");
    };
    refused(&["--pair", "H7=disc_x/rim"], "no FRF of this name");
    refused(&["--pair", "H1=disc_q/rim"], "there is no response `disc_q`");
    refused(&["--pair", "H1=disc_x"], "response and excitation");
    refused(&["--band", "900 .. 1000 Hz"], "no line in --band");
    refused(&["--run-up"], "other.uff: no run-up");
}

/// Run-ups with two unbalances beside a noisy record of one of them.
#[test]
fn run_ups_beside_a_measured_one() {
    let folder = tempfile::tempdir().unwrap();
    let short = [
        "speed.settle=0.5 s",
        "speed.ramp=4 s",
        "speed.hold=0.5 s",
        "study.run_up.step=100 us",
        "study.run_up.sample_rate=2 kHz",
        "study.orders.cuts=[1, 2, \"BPFO\"]",
    ];
    let with = |command: &mut assert_cmd::Command| {
        short.iter().for_each(|set| {
            command.args(["--set", set]);
        });
    };
    let run = folder.path().join("run");
    let mut command = rotordyn();
    command.args(["run-up", RIG, "--no-figures", "--quiet", "--out"]).arg(&run);
    with(&mut command);
    output_of(&mut command);
    let mut command = rotordyn();
    command.args(["export", RIG, "--formats", "csv", "--quiet", "--out"]).arg(&run);
    with(&mut command);
    output_of(&mut command);
    // Noise of a hundredth of each channel's RMS.
    let mut data = measured::read(&run.join("channels.csv")).unwrap();
    data.records.retain(|r| ["t", "time", "shaft_speed", "B_ax", "B_ay", "disc_x"].contains(&&*r.name));
    let mut state = 1u64;
    for record in data.records.iter_mut().filter(|r| !r.name.contains("shaft")) {
        let Values::Real(values) = &mut record.values else { panic!() };
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let rms = (values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / values.len() as f64).sqrt();
        for value in values {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            *value += 0.01 * rms * ((state >> 11) as f64 / (1u64 << 52) as f64 - 1.0);
        }
    }
    let record = folder.path().join("record.mat");
    measured::write(&record, &data).unwrap();
    let out = folder.path().join("compared");
    let mut command = rotordyn();
    command.args(["compare", RIG, "--run-up", "--csv", "--measured"]).arg(&record);
    command.args(["--set", &format!("{MAGNITUDE}=0.56 kg mm"), "--set", &format!("{MAGNITUDE}=1.12 kg mm")]);
    with(&mut command);
    let found = json_of(command.arg("--out").arg(&out));
    let names = ["measured", "magnitude 0.56 kg mm", "magnitude 1.12 kg mm"];
    assert_eq!(found["cases"], serde_json::json!(names));
    let channel = named(list(&found, "channels"), "channel", "disc_x");
    let runs = list(channel, "runs");
    let first_order: Vec<&Value> = runs.iter().map(|run| named(list(run, "orders"), "label", "1x")).collect();
    let [measured, own, double] = [0, 1, 2].map(|k| number(first_order[k], "peak_rms"));
    assert!((own / measured - 1.0).abs() < 0.03, "{own} {measured}");
    assert!((double / own - 2.0).abs() < 0.05, "{double} {own}");
    for k in [1, 2] {
        assert!(number(first_order[k], "correlation") > 0.99);
    }
    assert!(list(&found, "left_out").is_empty(), "{}", found["left_out"]);
    for name in
        ["comparison_spectrogram_disc_x", "comparison_waterfall_disc_x", "comparison_order_cuts_disc_x"]
    {
        let svg = std::fs::read_to_string(out.join(format!("{name}.svg"))).unwrap();
        assert!(names.iter().all(|name| svg.contains(name)), "{name}");
    }
    assert!(out.join("magnitude_0.56_kg_mm/results.h5").exists());
    assert!(out.join("csv/comparison_channels_runs_orders_points.csv").exists());
}

//! `validate` with run-ups: the simulated Jeffcott rotor as test rig, channels and tacho as a recorder stores them.

use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use rotordyn::io::measured;
use rotordyn::signal::record::{MeasuredData, Record, Values};
use serde_json::Value;

use crate::result_documents::column;
use crate::{json_of, output_of, rotordyn};

const MODEL: &str = "models/jeffcott.toml";
/// Difference between rig and model: a thicker shaft.
const THICKER: &str = "shaft.section=[{ length = \"800 mm\", outer_diameter = \"20.6 mm\" }]";

/// Deterministic noise between −1 and 1.
fn noise(seed: u64) -> impl Iterator<Item = f64> {
    let mut state = seed;
    std::iter::repeat_with(move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    })
}

/// Record of a run-up: displacements of the disc in um and a tacho signal, without the shaft angle.
fn record_run_up(folder: &Path, name: &str, settings: &[&str], floor: f64) -> PathBuf {
    let out = folder.join(format!("{name}_run"));
    let mut run = rotordyn();
    run.args(["run-up", MODEL, "--no-figures", "--out"]).arg(&out);
    settings.iter().for_each(|set| _ = run.args(["--set", set]));
    run.assert().success();
    let found = measured::read(&out.join("results.h5")).unwrap();
    let values = |name: &str| found.record(name).unwrap().time_samples().unwrap().to_vec();
    let rate = found.record("disc_x").unwrap().sample_rate().unwrap();
    let channel = |name: &str, of: &str, seed: u64| {
        let noisy = values(of).iter().zip(noise(seed)).map(|(v, n)| 1e6 * (v + floor * n)).collect();
        Record::samples(name, rate, 0.0, noisy, "")
    };
    // Keyphasor signal: one upward zero crossing per revolution.
    let theta = found.records.iter().find(|r| r.unit == "rad" && r.name.contains("theta")).unwrap();
    let Values::Real(theta) = &theta.values else { panic!() };
    let tacho = theta.iter().map(|a| 2.0 * (a - 0.7).sin()).collect();
    let records = vec![
        channel("ch1", "disc_x", 5),
        channel("ch2", "disc_y", 6),
        Record::samples("ch8", rate, 0.0, tacho, "V"),
    ];
    let path = folder.join(format!("{name}.mat"));
    measured::write(&path, &MeasuredData { records, ..MeasuredData::default() }).unwrap();
    path
}

const MAPPING: &str = "[channel.ch1]\nstation = \"disc\"\ndirection = \"x\"\nunit = \"um\"\n\n\
    [channel.ch2]\nstation = \"disc\"\ndirection = \"y\"\nunit = \"um\"\n";

/// The folder, the record of the rig as modelled, and the mapping.
static AS_MODELLED: LazyLock<(tempfile::TempDir, PathBuf, PathBuf)> = LazyLock::new(|| {
    let folder = tempfile::tempdir().unwrap();
    let record = record_run_up(folder.path(), "as_modelled", &[], 0.0);
    let mapping = folder.path().join("channels.toml");
    std::fs::write(&mapping, MAPPING).unwrap();
    (folder, record, mapping)
});

fn validate(record: &Path, out: &Path, flags: &[&str]) -> assert_cmd::Command {
    let mut command = rotordyn();
    command.args(["validate", MODEL, "--measured"]).arg(record).arg("--mapping").arg(&AS_MODELLED.2);
    command.args(["--tacho", "ch8", "--out"]).arg(out).args(flags);
    command
}

fn order<'a>(document: &'a Value, channel: usize, label: &str) -> &'a Value {
    let orders = document["run_ups"][0]["channels"][channel]["orders"].as_array().unwrap();
    orders.iter().find(|o| o["label"] == label).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

#[test]
fn run_up_of_the_unchanged_model_agrees() {
    let out = AS_MODELLED.0.path().join("same");
    let document = json_of(&mut validate(&AS_MODELLED.1, &out, &["--csv"]));
    let run = &document["run_ups"][0];
    assert!(number(&run["rpm"][1]) > 2950.0 && number(&run["rpm"][1]) < 3010.0, "{run}");
    // The simulation has the run-up's step and estimate of its error.
    let error = number(&run["step_error"]["largest_relative_error"]);
    assert!(
        error > 0.0 && error < 0.05 && number(&run["step_s"]) <= number(&run["requested_step_s"]),
        "{run}"
    );
    for channel in run["channels"].as_array().unwrap() {
        let level = 20.0 * (number(&channel["computed_rms"]) / number(&channel["measured_rms"])).log10();
        println!("{} {level:.4} dB", channel["channel"]);
        assert!(level.abs() < 0.1, "{channel}");
    }
    // The level of an order has its own column beside that of the channel.
    let orders = run["channels"].as_array().unwrap().iter().flat_map(|c| c["orders"].as_array().unwrap());
    let levels: Vec<f64> = orders.map(|order| number(&order["measured_rms"])).collect();
    let table = out.join("csv/run_ups_channels_orders.csv");
    assert!(!levels.is_empty());
    assert_eq!(column(&table, "orders_measured_rms"), levels);
    // The tacho's first revolution is unknown and the model starts from rest after it: otherwise the same run.
    for channel in 0..2 {
        let once = order(&document, channel, "1x");
        println!("{once}");
        assert!((number(&once["computed_rpm"]) / number(&once["measured_rpm"]) - 1.0).abs() < 2e-3, "{once}");
        assert!((number(&once["computed_rms"]) / number(&once["measured_rms"]) - 1.0).abs() < 1e-2, "{once}");
        assert!(number(&once["correlation"]) > 0.9999 && once["at_end"] == false, "{once}");
    }
    for file in
        ["run_up.h5", "run_up_spectrogram_ch1.png", "run_up_waterfall_ch2.svg", "run_up_computed/results.h5"]
    {
        assert!(out.join(file).exists(), "{file}");
    }
    // The computed run is a run like any other.
    output_of(rotordyn().arg("orders").arg(out.join("run_up_computed")).arg("--no-figures"));
}

#[test]
fn thicker_shaft_shifts_the_critical_speed() {
    let folder = tempfile::tempdir().unwrap();
    // Slow ramp, windows of five revolutions: each covers about 30 rpm.
    let record = record_run_up(folder.path(), "thicker", &[THICKER, "speed.ramp=20 s"], 2e-7);
    let out = folder.path().join("out");
    let flags = ["--no-figures", "--smooth-tacho", "--set", "study.orders.resolution=0.2"];
    let document = json_of(&mut validate(&record, &out, &flags));
    let critical = |settings: &[&str]| {
        let mut command = rotordyn();
        command.args(["critical", MODEL, "--no-figures", "--out"]).arg(folder.path().join("critical"));
        settings.iter().for_each(|set| _ = command.args(["--set", set]));
        let document = json_of(&mut command);
        number(&document["critical_speeds"]["speeds"][0]["speed_rpm"])
    };
    let ratio = critical(&[]) / critical(&[THICKER]);
    for channel in 0..2 {
        let once = order(&document, channel, "1x");
        // The ramp shifts both maxima upwards equally.
        let found = number(&once["computed_rpm"]) / number(&once["measured_rpm"]);
        println!("{found:.4} {ratio:.4} {once}");
        assert!((found / ratio - 1.0).abs() < 5e-3 && ratio < 0.97, "{found} {ratio}");
    }
}

/// Edges of a square-wave tacho fall between samples: the angle jitter must not excite the shaft. A speed channel
/// stored without unit gets it from the mapping.
#[test]
fn run_ups_with_coarse_tacho_or_speed_without_unit() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("run");
    let mut run = rotordyn();
    run.args(["run-up", MODEL, "--no-figures", "--sample-rate", "3 kHz", "--out"]).arg(&out);
    run.assert().success();
    let found = measured::read(&out.join("results.h5")).unwrap();
    let values = |name: &str| found.record(name).unwrap().time_samples().unwrap().to_vec();
    let theta = found.records.iter().find(|r| r.unit == "rad" && r.name.contains("theta")).unwrap();
    let theta = theta.time_samples().unwrap();
    let record = |name: &str, values: Vec<f64>, unit: &str| Record::samples(name, 3000.0, 0.0, values, unit);
    let square = theta.iter().map(|a| f64::from((4.0 * a + 0.3).sin() > 0.0)).collect();
    let speed = theta.windows(2).map(|w| (w[1] - w[0]) * 3000.0 * 30.0 / std::f64::consts::PI);
    let mut speed: Vec<f64> = speed.collect();
    speed.push(speed[speed.len() - 1]);
    let records =
        vec![record("x", values("disc_x"), "m"), record("pulses", square, "V"), record("speed", speed, "")];
    let path = folder.path().join("record.npz");
    measured::write(&path, &MeasuredData { records, ..MeasuredData::default() }).unwrap();
    let mapping = folder.path().join("map.toml");
    let text = "[channel.x]\nstation = \"disc\"\ndirection = \"x\"\n[channel.speed]\nunit = \"rpm\"\n";
    std::fs::write(&mapping, text).unwrap();
    for how in [&["--tacho", "pulses", "--pulses-per-rev", "4"][..], &[]] {
        let mut command = rotordyn();
        command.args(["validate", MODEL, "--no-figures", "--measured"]).arg(&path);
        command.arg("--mapping").arg(&mapping).args(how);
        let document = json_of(command.arg("--out").arg(folder.path().join("out")));
        let once = order(&document, 0, "1x");
        println!("{how:?} {once}");
        assert!(number(&once["correlation"]) > 0.999, "{how:?}: {once}");
        assert!((number(&once["computed_rms"]) / number(&once["measured_rms"]) - 1.0).abs() < 0.01, "{once}");
    }
}

#[test]
fn results_file_with_modes_and_a_run_up() {
    let folder = tempfile::tempdir().unwrap();
    let (run, out) = (folder.path().join("run"), folder.path().join("out"));
    rotordyn().args(["run", MODEL, "--no-figures", "--out"]).arg(&run).assert().success();
    let mut command = rotordyn();
    command.args(["validate", MODEL, "--no-figures", "--measured"]).arg(run.join("results.h5"));
    let document = json_of(command.arg("--out").arg(&out));
    assert!(document["measured"][0]["modes"].as_array().unwrap().len() > 5);
    assert_eq!(document["run_ups"][0]["channels"].as_array().unwrap().len(), 3);
    let once = order(&document, 0, "1x");
    assert!(number(&once["correlation"]) > 0.99999, "{once}");
    assert!((number(&once["computed_rms"]) / number(&once["measured_rms"]) - 1.0).abs() < 1e-3, "{once}");
}

/// Channels written by `export` contain the shaft rotation, and in UFF and CSV the measurement points.
#[test]
fn exported_channels_are_read_as_run_ups() {
    let folder = tempfile::tempdir().unwrap();
    let run = folder.path().join("run");
    rotordyn().args(["run-up", MODEL, "--no-figures", "--out"]).arg(&run).assert().success();
    rotordyn().args(["export", MODEL, "--formats", "csv,uff,mat,npz", "--out"]).arg(&run).assert().success();
    for file in ["channels.csv", "channels.uff", "channels.mat", "channels.npz"] {
        let mut command = rotordyn();
        command.args(["validate", MODEL, "--no-figures", "--measured"]).arg(run.join(file));
        // Array names of .mat and .npz files do not give the place: the mapping does.
        if !file.ends_with("uff") && !file.ends_with("csv") {
            let names = match file.ends_with("mat") {
                true => ["X001_disc_x_time", "X001_disc_y_time"],
                false => ["disc_x", "disc_y"],
            };
            let place = |(name, axis): (&str, &str)| {
                format!("[channel.{name}]\nstation = \"disc\"\ndirection = \"{axis}\"\n")
            };
            let text: String = names.into_iter().zip(["x", "y"]).map(place).collect();
            std::fs::write(folder.path().join("map.toml"), text).unwrap();
            command.arg("--mapping").arg(folder.path().join("map.toml"));
        }
        let document = json_of(command.arg("--out").arg(folder.path().join("out")));
        let once = order(&document, 0, "1x");
        println!("{file} {once}");
        assert!(number(&once["correlation"]) > 0.9999, "{file}: {once}");
        assert!(
            (number(&once["computed_rms"]) / number(&once["measured_rms"]) - 1.0).abs() < 5e-3,
            "{file}: {once}"
        );
    }
}

/// Standard error of `validate` for an invalid file, run inside the folder, with the model's path shortened.
fn error_text(folder: &Path, file: &str, flags: &[&str], code: i32) -> String {
    let mut command = rotordyn();
    let model = Path::new(env!("CARGO_MANIFEST_DIR")).join(MODEL);
    command.current_dir(folder).arg("validate").arg(&model).args(["--measured", file, "--no-figures"]);
    let assert = command.args(["--out", "out"]).args(flags).assert().code(code);
    String::from_utf8_lossy(&assert.get_output().stderr)
        .replace(&model.display().to_string(), MODEL)
        .trim()
        .to_string()
}

#[test]
fn bad_run_ups() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let n = 6000;
    let angle = |k: usize| {
        let t = k as f64 / 1000.0;
        std::f64::consts::TAU * (5.0 * t + 2.0 * t * t)
    };
    let x = || (0..n).map(|k| 1e-5 * angle(k).cos()).collect::<Vec<f64>>();
    let tacho = || Record::samples("tacho", 1000.0, 0.0, (0..n).map(|k| angle(k).sin()).collect(), "V");
    let channel = |name: &str, unit: &str| Record::samples(name, 1000.0, 0.0, x(), unit);
    let write = |name: &str, records: Vec<Record>| {
        measured::write(&folder.join(name), &MeasuredData { records, ..MeasuredData::default() }).unwrap();
    };
    write("good.h5", vec![channel("disc_x", "m"), tacho()]);
    write("elsewhere.h5", vec![channel("ch1", "m"), channel("ch2", "m"), tacho()]);
    write("no_unit.h5", vec![channel("disc_x", ""), tacho()]);
    write("force.h5", vec![channel("disc_x", "N"), tacho()]);
    let steady = (0..n).map(|k| (0.1 * k as f64).sin()).collect();
    write("steady.h5", vec![channel("disc_x", "m"), Record::samples("tacho", 1000.0, 0.0, steady, "V")]);
    let mut broken = x();
    broken[77] = f64::NAN;
    write("broken.h5", vec![Record::samples("disc_x", 1000.0, 0.0, broken, "m"), tacho()]);
    let slow = Record::samples("disc_y", 500.0, 0.0, x()[..3000].to_vec(), "m");
    write("two_rates.h5", vec![channel("disc_x", "m"), slow, tacho()]);
    write("some.h5", vec![channel("disc_x", "m"), channel("ch2", "m"), channel("ch3", ""), tacho()]);
    let bare: String = (0..n).map(|k| format!("{},{}\n", 1e-5 * angle(k).cos(), angle(k).sin())).collect();
    std::fs::write(folder.join("bare.csv"), format!("disc_x_m,tacho\n{bare}")).unwrap();
    std::fs::write(folder.join("wrong.toml"), "[channel.ch1]\nstation = \"dics\"\ndirection = \"q\"\n")
        .unwrap();
    std::fs::write(folder.join("rate.toml"), "rate = \"1 kHz\"\n[channel.disc_x]\nstation = \"disc\"\n")
        .unwrap();
    let tacho = ["--tacho", "tacho"];
    let with = |flags: &[&'static str]| [&tacho[..], flags].concat();
    let cases: Vec<(&str, &str, Vec<&str>, i32)> = vec![
        ("no speed", "good.h5", vec![], 2),
        ("no such tacho", "good.h5", vec!["--tacho", "taco"], 2),
        ("tacho and track", "good.h5", with(&["--track", "1=5 Hz .. 30 Hz"]), 2),
        ("speed does not change", "steady.h5", with(&[]), 2),
        ("no place", "elsewhere.h5", with(&[]), 2),
        ("no unit", "no_unit.h5", with(&[]), 2),
        ("no vibration", "force.h5", with(&[]), 2),
        ("no number", "broken.h5", with(&[]), 2),
        ("no rate", "bare.csv", with(&[]), 2),
        ("no direction", "bare.csv", with(&["--mapping", "rate.toml"]), 2),
        ("wrong mapping", "elsewhere.h5", with(&["--mapping", "wrong.toml"]), 2),
        ("no time left", "good.h5", with(&["--time", "9 s .. 10 s"]), 2),
        ("time without unit", "good.h5", with(&["--time", "1 .. 2"]), 2),
        ("too short for the window", "good.h5", with(&["--time", "1 s .. 1.3 s"]), 2),
        ("two rates", "two_rates.h5", with(&[]), 0),
        ("some left out, not from rest", "some.h5", with(&[]), 0),
    ];
    let outputs: Vec<String> = cases
        .iter()
        .map(|(name, file, flags, code)| format!("# {name}\n{}\n", error_text(folder, file, flags, *code)))
        .collect();
    insta::assert_snapshot!("bad_run_ups", outputs.join("\n"));
}

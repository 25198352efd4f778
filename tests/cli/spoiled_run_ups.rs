//! `validate` with run-ups as recorders store them: another rate and unit, offset, drift, noise, missing and false tacho
//! pulses, many pulses per revolution, a clipped channel, a wrong sensitivity.

use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use rotordyn::io::measured;
use rotordyn::linalg::spline::Spline;
use rotordyn::signal::record::{MeasuredData, Record};
use serde_json::Value;
use std::f64::consts::TAU;

use crate::{json_of, rotordyn};

const MODEL: &str = "models/jeffcott.toml";
const RATE: f64 = 2560.0;
/// Metres per mil.
const MIL: f64 = 25.4e-6;

/// Displacements of the disc and angle of the shaft over time, of a run of the model at 1 kHz.
struct Run {
    folder: tempfile::TempDir,
    duration: f64,
    disc: [Spline; 2],
    angle: Spline,
}

static RUN: LazyLock<Run> = LazyLock::new(|| {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("run");
    rotordyn().args(["run-up", MODEL, "--no-figures", "--out"]).arg(&out).assert().success();
    let found = measured::read(&out.join("results.h5")).unwrap();
    let theta = found.records.iter().find(|r| r.unit == "rad" && r.name.contains("theta")).unwrap();
    let rate = theta.sample_rate().unwrap();
    let times: Vec<f64> = (0..theta.values.len()).map(|k| k as f64 / rate).collect();
    let spline = |record: &Record| Spline::new(&times, record.time_samples().unwrap()).unwrap();
    let disc = ["disc_x", "disc_y"].map(|name| spline(found.record(name).unwrap()));
    Run { duration: times[times.len() - 1], disc, angle: spline(theta), folder }
});

/// Standard Gaussian numbers.
fn noise(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut uniform = move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        ((state >> 11) + 1) as f64 / (1u64 << 53) as f64
    };
    move || (-2.0 * uniform().ln()).sqrt() * (TAU * uniform()).cos()
}

/// How the recorder spoils the run.
struct Recorder {
    rate: f64,
    pulses: f64,
    /// Numbers of tacho pulses that are missing, and samples at which a false one begins.
    missing: &'static [i64],
    false_pulses: &'static [usize],
    /// Of each channel \[mil\]: what is added at a time \[s\], limits, factor, standard deviation of the noise.
    added: [fn(f64) -> f64; 2],
    limit: f64,
    factor: f64,
    noise: f64,
}

impl Default for Recorder {
    fn default() -> Self {
        let added: fn(f64) -> f64 = |_| 0.0;
        Recorder {
            rate: RATE,
            pulses: 1.0,
            missing: &[],
            false_pulses: &[],
            added: [added; 2],
            limit: f64::INFINITY,
            factor: 1.0,
            noise: 0.2,
        }
    }
}

impl Recorder {
    /// File with channels a, b \[mil\] and the tacho, and its mapping.
    fn write(&self, name: &str) -> (PathBuf, PathBuf) {
        let run = &*RUN;
        let count = (run.duration * self.rate) as usize;
        let at = |k: usize| k as f64 / self.rate;
        let channel = |name: &str, which: usize| {
            let mut noise = noise(which as u64 + 5);
            let factor = if which == 0 { self.factor } else { 1.0 };
            let sample = |k: usize| {
                let t = at(k);
                let value = run.disc[which].evaluate(t)[0] / MIL * factor
                    + self.noise * noise()
                    + self.added[which](t);
                if which == 0 { value.min(self.limit) } else { value }
            };
            Record::samples(name, self.rate, 0.0, (0..count).map(sample).collect(), "")
        };
        let pulse = |k: usize| {
            let turns = run.angle.evaluate(at(k))[0] / TAU * self.pulses;
            let number = turns.floor() as i64;
            let seen = number >= 1 && !self.missing.contains(&number) && turns - turns.floor() < 0.3;
            let is_false = self.false_pulses.iter().any(|at| (*at..at + 3).contains(&k));
            if seen || is_false { 5.0 } else { 0.0 }
        };
        let tacho = Record::samples("tacho", self.rate, 0.0, (0..count).map(pulse).collect(), "V");
        let records = vec![channel("a", 0), channel("b", 1), tacho];
        let path = run.folder.path().join(format!("{name}.mat"));
        measured::write(&path, &MeasuredData { records, ..MeasuredData::default() }).unwrap();
        let place = |(name, axis): (&str, &str)| {
            format!("[channel.{name}]\nstation = \"disc\"\ndirection = \"{axis}\"\nunit = \"mil\"\n")
        };
        let mapping = run.folder.path().join(format!("{name}.toml"));
        std::fs::write(&mapping, [("a", "x"), ("b", "y")].map(place).concat()).unwrap();
        (path, mapping)
    }

    /// JSON of `validate`.
    fn validate(&self, name: &str, flags: &[&str]) -> Value {
        let (record, mapping) = self.write(name);
        let mut command = rotordyn();
        command.args(["validate", MODEL, "--no-figures", "--tacho", "tacho", "--measured"]).arg(&record);
        command.args(["--pulses-per-rev", &self.pulses.to_string(), "--mapping"]).arg(&mapping).args(flags);
        json_of(command.arg("--out").arg(RUN.folder.path().join(format!("{name}_out"))))
    }
}

/// The row of an order of a channel.
fn order<'a>(document: &'a Value, channel: usize, label: &str) -> &'a Value {
    let orders = document["run_ups"][0]["channels"][channel]["orders"].as_array().unwrap();
    orders.iter().find(|o| o["label"] == label).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

/// Difference of the RMS over the run, computed over measured \[dB\].
fn level(document: &Value, channel: usize) -> f64 {
    let channel = &document["run_ups"][0]["channels"][channel];
    20.0 * (number(&channel["computed_rms"]) / number(&channel["measured_rms"])).log10()
}

fn warnings(document: &Value) -> Vec<(&str, &str)> {
    let all = document["warnings"].as_array().unwrap();
    all.iter().map(|w| (w["code"].as_str().unwrap(), w["text"].as_str().unwrap())).collect()
}

/// 1x agrees, and 2x, which the rotor does not have, is below the noise.
fn assert_agrees(document: &Value, name: &str) {
    for channel in 0..2 {
        let [once, twice] = ["1x", "2x"].map(|label| order(document, channel, label));
        assert_eq!(once["agreement"], "agrees", "{name}: {once}");
        assert!(number(&once["level_uncertainty_db"]) < 0.6, "{name}: {once}");
        assert_eq!(twice["agreement"], "below background", "{name}: {twice}");
        assert!(level(document, channel).abs() < 0.2, "{name}: {}", level(document, channel));
    }
}

#[test]
fn rate_unit_offset_and_drift_change_nothing() {
    let plain = Recorder::default();
    let drift = Recorder {
        added: [|t| 40.0 * t * t / 56.0, |t| -16.0 + 20.0 * (0.6 * t).sin()],
        ..Recorder::default()
    };
    let encoder = Recorder { rate: 20480.0, pulses: 60.0, ..Recorder::default() };
    for (name, recorder) in [("plain", plain), ("drift", drift), ("encoder", encoder)] {
        let document = recorder.validate(name, &[]);
        assert_agrees(&document, name);
        assert_eq!(warnings(&document), [], "{name}");
    }
}

#[test]
fn missing_and_false_pulses_are_mended_and_named() {
    let recorder =
        Recorder { missing: &[12, 40, 41, 97, 150], false_pulses: &[6950, 15030], ..Recorder::default() };
    let document = recorder.validate("pulses", &[]);
    assert_agrees(&document, "pulses");
    let [(code, text)] = warnings(&document)[..] else { panic!("{:?}", warnings(&document)) };
    let counts = "5 missing pulses added and 2 false pulses removed";
    assert!(code == "measured-data" && text.contains(counts), "{text}");
}

#[test]
fn clipped_channel_is_named_and_does_not_agree() {
    let document = Recorder { limit: 6.0, ..Recorder::default() }.validate("clipped", &[]);
    let [(code, text)] = warnings(&document)[..] else { panic!("{:?}", warnings(&document)) };
    assert!(code == "clipped-record" && text.contains("`a` is clipped"), "{text}");
    assert_eq!(order(&document, 0, "1x")["agreement"], "level differs");
    // What rings at twice the natural frequency of the clipped channel passes 2x and is no line of it.
    assert_ne!(order(&document, 0, "2x")["agreement"], "agrees");
    assert_eq!(order(&document, 1, "1x")["agreement"], "agrees");
}

/// A sensitivity 10 % off is 0.8 dB in a line known to 0.3 dB; behind noise of fifty times the displacement's scale it is
/// within the uncertainty. A dead sensor bounds nothing.
#[test]
fn level_that_differs_is_told_from_noise() {
    let of = |name: &str, factor: f64, noise: f64| {
        let document = Recorder { factor, noise, ..Recorder::default() }.validate(name, &[]);
        order(&document, 0, "1x").clone()
    };
    let wrong = of("sensitivity", 1.1, 0.2);
    assert_eq!(wrong["agreement"], "level differs", "{wrong}");
    let hidden = of("hidden", 1.1, 20.0);
    let difference = 20.0 * (number(&hidden["computed_rms"]) / number(&hidden["measured_rms"])).log10();
    assert!(number(&hidden["level_uncertainty_db"]) > 0.8 && difference.abs() < 3.0, "{hidden}");
    assert_ne!(hidden["agreement"], "level differs", "{hidden}");
    let dead = of("dead", 0.0, 0.2);
    assert_eq!(dead["agreement"], "level differs", "{dead}");
}

/// A shaft of Young's modulus 6 % higher than that of the record: its critical speed is 3 % higher.
#[test]
fn speed_that_differs_is_seen_with_short_windows() {
    let fine = ["--set", "study.orders.resolution=0.2", "--set", "study.orders.overlap=0.9"];
    let stiff = ["--set", "material.steel.young=222 GPa"];
    let recorder = Recorder { noise: 0.02, ..Recorder::default() };
    let same = recorder.validate("same_speed", &fine);
    assert_eq!(order(&same, 0, "1x")["agreement"], "agrees", "{}", order(&same, 0, "1x"));
    let other = recorder.validate("other_speed", &[&fine[..], &stiff].concat());
    let once = order(&other, 0, "1x");
    assert!(once["agreement"].as_str().unwrap().contains("speed"), "{once}");
}

/// The file of the comparison has the columns of the table.
#[test]
fn agreement_is_in_every_output() {
    let out = RUN.folder.path().join("csv_out");
    let (record, mapping) = Recorder::default().write("csv");
    let mut command = rotordyn();
    command.args(["validate", MODEL, "--no-figures", "--csv", "--tacho", "tacho", "--measured"]).arg(&record);
    let assert = command.arg("--mapping").arg(&mapping).arg("--out").arg(&out).assert().success();
    let text = String::from_utf8_lossy(&assert.get_output().stdout).to_string();
    assert!(text.contains("within +-") && text.contains("below background"), "{text}");
    let table = std::fs::read_to_string(Path::new(&out).join("csv/run_ups_channels_orders.csv")).unwrap();
    assert!(table.contains("agreement") && table.contains("agrees"), "{table}");
    // Counted from the right: a text on the left holds a comma.
    let cells = |line: &str| line.split(',').rev().map(String::from).collect::<Vec<_>>();
    let mut rows = table.lines().map(cells);
    let names = rows.next().unwrap();
    let column = |name: &str| names.iter().position(|own| own == name).unwrap();
    let [level, limit, agreement] = ["orders_measured_rms", "measured_noise_limit", "agreement"].map(column);
    let value = |cell: &str| cell.parse::<f64>().unwrap();
    for row in rows {
        let stands_out = row[agreement] != "below background";
        assert_eq!(value(&row[level]) > value(&row[limit]), stands_out, "{row:?}");
    }
}

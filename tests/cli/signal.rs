//! `signal` command: measured records, synthetic records in every file format, stored runs.

use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

use crate::{json_of, output_of, rotordyn};
use rotordyn::io::hdf5::Store;
use rotordyn::io::measured;
use rotordyn::signal::record::{MeasuredData, Record};
use serde_json::Value;

#[path = "../common/measured_data.rs"]
pub mod measured_data;

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is not a number"))
}

/// Uniform random numbers in −1..1.
fn noise(seed: u32, n: usize) -> impl Iterator<Item = f64> {
    let mut state = seed;
    (0..n).map(move |_| {
        state = state.wrapping_mul(1664525).wrapping_add(1013904223);
        f64::from(state) / 2f64.powi(31) - 1.0
    })
}

/// Noise and impulses exciting a 3.5 kHz resonance, `per_second` times per second.
pub fn faulty_bearing_record(n: usize, rate: f64, per_second: f64) -> Vec<f64> {
    let mut x: Vec<f64> = noise(7, n).collect();
    for k in 0..(n as f64 / rate * per_second) as usize {
        let start = k as f64 / per_second;
        let first = (start * rate).ceil() as usize;
        for (i, value) in x.iter_mut().enumerate().skip(first).take(80) {
            let t = i as f64 / rate - start;
            *value += 5.0 * (-1500.0 * t).exp() * (TAU * 3500.0 * t).sin();
        }
    }
    x
}

/// A file with one such record: 6205-2RS at 1800 rpm, outer race fault at BPFO, order 3.58482.
pub fn faulty_bearing_file(folder: &Path, name: &str, rate: f64, unit: &str) -> PathBuf {
    let mut record = Record::samples(
        "A_ax",
        rate,
        0.0,
        faulty_bearing_record((3.0 * rate) as usize, rate, 30.0 * 3.58482),
        unit,
    );
    record.speed_rpm = Some(1800.0);
    let path = folder.join(name);
    measured::write(&path, &MeasuredData { records: vec![record], ..MeasuredData::default() }).unwrap();
    path
}

fn signal(path: &Path, out: &Path, flags: &[&str]) -> Value {
    json_of(rotordyn().arg("signal").arg(path).arg("--out").arg(out).args(flags))
}

/// Records of Case Western Reserve University: diagnosis, fault frequencies and statistics as in their description.
#[test]
fn measured_race_faults_are_diagnosed() {
    for (file, diagnosis, line, hz, rms, kurtosis) in [
        ("cwru/105_IR007_0hp_12k.mat", "inner race", "BPFI", 161.68, 0.29153, 5.396),
        ("cwru/130_OR007at6_0hp_12k.mat", "outer race", "BPFO", 107.65, 0.66951, 7.649),
    ] {
        let Some(path) = measured_data::measured(file) else { return };
        let folder = tempfile::tempdir().unwrap();
        // Band selected by the bearing fault lines, by kurtosis, none, and the one of the description.
        for band in [None, Some("kurtosis"), Some("full"), Some("500 Hz .. 5.5 kHz")] {
            let mut flags = vec!["--rate", "12 kHz", "--bearing", "6205-2RS"];
            flags.extend(band.iter().flat_map(|band| ["--band", band]));
            // Figures for the first band only.
            if band.is_some() {
                flags.extend(["--no-figures", "--analyses", "envelope"]);
            }
            let document = signal(&path, folder.path(), &flags);
            let channel = &document["channels"][0];
            assert!(channel["channel"].as_str().unwrap().ends_with("_DE_time"));
            assert_eq!(channel["shaft"]["source"], "as the file states");
            // Four digits.
            assert!((number(&channel["statistics"]["rms"]) - rms).abs() < 5e-6, "{file}");
            assert!((number(&channel["statistics"]["kurtosis"]) - kurtosis).abs() < 5e-4, "{file}");
            let envelope = &channel["envelope"];
            assert_eq!(envelope["diagnosis"], diagnosis, "{file} {band:?}");
            let strongest = &envelope["strongest"];
            assert_eq!(strongest["line"], line, "{file} {band:?}");
            // Within 0.5 % of the catalogue, and equal to the description to the printed digit.
            let (at, expected) = (number(&strongest["measured"]), number(&strongest["expected"]));
            assert!((at / expected - 1.0).abs() < 5e-3, "{file} {band:?}: {at} {expected}");
            let harmonic = number(&strongest["harmonic"]);
            assert!((at / harmonic - hz).abs() < 0.05, "{file} {band:?}: {at}");
            // In the narrow band selected by the fault lines the second harmonic is as high as the first.
            assert!(band.is_none() || harmonic == 1.0);
        }
        let name = document_channel(&path);
        for figure in ["record", "spectrum", "psd", "envelope", "band_scores", "kurtogram", "cepstrum"] {
            for extension in ["svg", "png"] {
                assert!(
                    folder.path().join(format!("signal_{figure}_{name}.{extension}")).exists(),
                    "{figure}"
                );
            }
        }
        let store = Store::open(folder.path().join("signal.h5")).unwrap();
        assert!(store.read(&format!("/{name}/envelope/values")).unwrap().data.len() > 50_000);
    }
}

fn document_channel(path: &Path) -> String {
    let id = &path.file_name().unwrap().to_str().unwrap()[..3];
    format!("X{id}_DE_time")
}

/// The same record in every writable format gives the same diagnosis and RMS.
#[test]
fn all_file_formats_give_the_same_diagnosis() {
    let folder = tempfile::tempdir().unwrap();
    let mut levels: Vec<f64> = Vec::new();
    for name in ["a.csv", "a.mat", "a.npz", "a.uff", "a.h5", "a.wav"] {
        let path = faulty_bearing_file(folder.path(), name, 12_000.0, "m/s^2");
        let flags =
            ["--bearing", "6205-2RS", "--speed", "1800 rpm", "--no-figures", "--analyses", "envelope"];
        let document = signal(&path, &folder.path().join("out"), &flags);
        let channel = &document["channels"][0];
        assert_eq!(channel["envelope"]["diagnosis"], "outer race", "{name}");
        assert_eq!(number(&channel["sample_rate_hz"]), 12_000.0, "{name}");
        levels.push(number(&channel["statistics"]["rms"]));
    }
    for rms in &levels {
        // A WAV file holds 32-bit floats.
        assert!((rms / levels[0] - 1.0).abs() < 1e-6, "{levels:?}");
    }
}

/// A run-up from 10 to 40 rev/s in 12 s with a tacho: 1x and BPFO are lines in orders, not in Hz.
fn run_up_file(folder: &Path) -> (PathBuf, f64) {
    let rate = 5000.0;
    let n = 60_000;
    let turns = |t: f64| 10.0 * t + 1.25 * t * t;
    let bpfo = 3.58482;
    let at = |k: usize| TAU * turns(k as f64 / rate);
    let x: Vec<f64> = noise(3, n)
        .enumerate()
        .map(|(k, v)| 0.2 * v + 2.0 * at(k).cos() + (bpfo * at(k) + 0.3).cos())
        .collect();
    // Pulses of a tenth of a revolution, edges of one sample.
    let tacho: Vec<f64> =
        (0..n).map(|k| if turns(k as f64 / rate).fract() < 0.1 { 5.0 } else { 0.0 }).collect();
    let record = |name: &str, values: Vec<f64>, unit: &str| Record::samples(name, rate, 0.0, values, unit);
    let records = vec![record("A_ax", x, "m/s^2"), record("tacho", tacho, "V")];
    let path = folder.join("run_up.h5");
    measured::write(&path, &MeasuredData { records, ..MeasuredData::default() }).unwrap();
    (path, bpfo)
}

#[test]
fn order_tracking_sharpens_smeared_lines() {
    let folder = tempfile::tempdir().unwrap();
    let (path, bpfo) = run_up_file(folder.path());
    let out = folder.path().join("out");
    let by_line = "1=8 Hz .. 45 Hz";
    for how in [["--tacho", "tacho"], ["--track", by_line]] {
        let flags = [&how[..], &["--channel", "A_ax", "--bearing", "6205-2RS"]].concat();
        let document = signal(&path, &out, &flags);
        let channel = &document["channels"][0];
        let shaft = &channel["shaft"];
        assert_eq!(shaft["steady"], false);
        assert!((number(&shaft["min_rpm"]) - 600.0).abs() < 30.0, "{shaft}");
        // The tracked frequency is constant over the last half frame, 0.6 s at 150 rpm/s.
        let slack = if how[0] == "--track" { 100.0 } else { 30.0 };
        assert!((number(&shaft["max_rpm"]) - 2400.0).abs() < slack, "{shaft}");
        let cut = |label: &str| {
            let cuts = channel["orders"]["cuts"].as_array().unwrap();
            let cut = cuts.iter().find(|cut| cut["label"] == label).unwrap();
            cut["rms"].as_array().unwrap().iter().map(number).collect::<Vec<f64>>()
        };
        // Amplitudes 2 and 1: RMS = amplitude/√2 at every speed; with a tracked line not at the record's ends.
        for (label, amplitude) in [("1x", 2.0), ("BPFO", 1.0)] {
            let cut = cut(label);
            let ends = if how[0] == "--track" { cut.len() / 10 } else { 0 };
            for rms in &cut[ends..cut.len() - ends] {
                assert!((rms * 2f64.sqrt() / amplitude - 1.0).abs() < 0.05, "{how:?} {label}: {rms}");
            }
        }
        let store = Store::open(out.join("signal.h5")).unwrap();
        let orders = store.read("/A_ax/orders/order").unwrap().data;
        let average = store.read("/A_ax/orders/average").unwrap().data;
        // In the order spectrum the highest bin is the order's; in Hz the tone is smeared over a thousand lines.
        let highest = |from: f64, to: f64| {
            let inside = (0..orders.len()).filter(|&k| (from..to).contains(&orders[k]));
            inside.max_by(|&a, &b| average[a].total_cmp(&average[b])).unwrap()
        };
        for (order, amplitude) in [(1.0, 2.0), (bpfo, 1.0)] {
            let k = highest(order - 0.4, order + 0.4);
            assert!((orders[k] - order).abs() <= 0.5 * orders[1] + 1e-9, "{how:?}: {}", orders[k]);
            // Scalloping loss of a Hann window: up to 1.42 dB.
            assert!(
                average[k] > 0.84 * amplitude && average[k] < 1.03 * amplitude,
                "{how:?}: {}",
                average[k]
            );
        }
        let spectrum = store.read("/A_ax/spectrum/values").unwrap().data;
        let highest_in_hz = spectrum[1..].iter().copied().fold(0.0, f64::max);
        assert!(highest_in_hz < 0.3, "{highest_in_hz}");
        for figure in [
            "orders",
            "order_spectrum",
            "order_cuts",
            "synchronous_average",
            "spectrogram",
            "campbell",
            "waterfall",
        ] {
            assert!(out.join(format!("signal_{figure}_A_ax.png")).exists(), "{figure}");
        }
    }
}

/// Measured tacho pulses of a run-up and coast-down, with a synthetic tone of order 3.585.
#[test]
fn order_tracking_with_measured_tacho_pulses() {
    let Some(times) = measured_data::measured("tacho_run_up/time_s.csv") else { return };
    let pulses = match measured::read(&times).unwrap().records.remove(0).values {
        rotordyn::signal::record::Values::Real(values) => values,
        rotordyn::signal::record::Values::Complex(_) => unreachable!("the file holds times"),
    };
    // Linear between the pulses, unlike the interpolation of the command.
    let rate = 5120.0;
    let n = (pulses[pulses.len() - 1] * rate) as usize;
    let mut k = 0;
    let turns: Vec<f64> = (0..n)
        .map(|i| {
            let t = i as f64 / rate;
            while k + 2 < pulses.len() && pulses[k + 1] <= t {
                k += 1;
            }
            k as f64 + (t - pulses[k]) / (pulses[k + 1] - pulses[k])
        })
        .collect();
    let x =
        noise(5, n).zip(&turns).map(|(v, turn)| 0.1 * v + (TAU * turn).cos() + (3.585 * TAU * turn).cos());
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.h5");
    let records = vec![Record::samples("A_ax", rate, 0.0, x.collect(), "m/s^2")];
    measured::write(&path, &MeasuredData { records, ..MeasuredData::default() }).unwrap();
    let out = folder.path().join("out");
    let flags = ["--tacho", times.to_str().unwrap(), "--no-figures", "--max-order", "8"];
    let document = signal(&path, &out, &flags);
    let shaft = &document["channels"][0]["shaft"];
    // Speed range of the description: 208 to 2982 rpm.
    assert!(
        number(&shaft["min_rpm"]) < 450.0 && (number(&shaft["max_rpm"]) - 2982.0).abs() < 30.0,
        "{shaft}"
    );
    let store = Store::open(out.join("signal.h5")).unwrap();
    let orders = store.read("/A_ax/orders/order").unwrap().data;
    let average = store.read("/A_ax/orders/average").unwrap().data;
    for order in [1.0, 3.585] {
        let near = (0..orders.len()).filter(|&k| (orders[k] - order).abs() < 0.5);
        let k = near.max_by(|&a, &b| average[a].total_cmp(&average[b])).unwrap();
        assert!((orders[k] - order).abs() <= orders[1], "{order}: {}", orders[k]);
        // Scalloping loss up to 1.42 dB; cubic against linear interpolation of the angle costs some more at 3.585.
        assert!(average[k] > 0.7, "{order}: {}", average[k]);
    }
}

/// Two records of different sampling rates are compared in one figure over orders.
#[test]
fn two_records_are_compared() {
    let folder = tempfile::tempdir().unwrap();
    let first = faulty_bearing_file(folder.path(), "first.mat", 12_000.0, "m/s^2");
    let second = faulty_bearing_file(folder.path(), "second.h5", 20_000.0, "m/s^2");
    let out = folder.path().join("out");
    let flags =
        ["--bearing", "6205-2RS", "--analyses", "envelope", "--compare-with", second.to_str().unwrap()];
    let document = signal(&first, &out, &flags);
    assert_eq!(document["channels"][0]["envelope"]["diagnosis"], "outer race");
    assert_eq!(document["compared_record"]["envelope"]["diagnosis"], "outer race");
    assert_eq!(number(&document["compared_record"]["sample_rate_hz"]), 20_000.0);
    assert!(out.join("signal_envelope_A_ax_vs_A_ax.png").exists());
    let store = Store::open(out.join("signal.h5")).unwrap();
    assert!(store.contains("/compared_record/A_ax/envelope/values"));
}

/// A stored run contains its sampling rate, speed and shaft angle; results are written next to it.
#[test]
fn signal_analysis_of_a_stored_run() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path();
    let short = ["--set", "speed.settle=0.1 s", "--set", "speed.ramp=0.5 s", "--set", "speed.hold=0.3 s"];
    let rate = ["--set", "study.run_up.sample_rate=4 kHz", "--no-figures"];
    let mut run = rotordyn();
    run.args(["run-up", "models/overhung_rig.toml", "--set", "study.spectrogram.length=0.1 s"]);
    run.args(["--set", "study.orders.resolution=0.5", "--set", "study.orders.cuts=[1, 2]", "--out"]).arg(out);
    output_of(run.args(short).args(rate));
    let mut command = rotordyn();
    command.arg("signal").arg(out).args([
        "--order-resolution",
        "0.5",
        "--max-order",
        "10",
        "--channel",
        "B_ax",
    ]);
    let text = output_of(&mut command);
    for part in [
        "channel `theta`",
        "Statistics",
        "Orders of B_ax",
        "Time synchronous average of B_ax",
        "no bearing diagnosis",
    ] {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
    assert!(text.lines().all(|line| line.chars().count() <= 140), "{text}");
    assert!(out.join("signal.h5").exists() && out.join("signal_orders_B_ax.svg").exists());
    // A bearing of the stored model by its name; half a second contains too few cage revolutions.
    let assert = rotordyn().arg("signal").arg(out).args(["--bearing", "A", "--no-figures"]).assert().code(2);
    let text = String::from_utf8_lossy(&assert.get_output().stderr).to_string();
    assert!(text.contains("ten revolutions of the cage"), "{text}");
}

/// Fault frequencies given by `--bearing-orders` give the diagnosis of the catalogue's bearing; missing ones are derived.
#[test]
fn fault_frequencies_given_by_rates() {
    let folder = tempfile::tempdir().unwrap();
    let path = faulty_bearing_file(folder.path(), "a.h5", 12_000.0, "m/s^2");
    let flags = ["--no-figures", "--analyses", "envelope,jerk,cyclic-coherence", "--speed", "1800 rpm"];
    let document = signal(
        &path,
        &folder.path().join("out"),
        &[&flags[..], &["--bearing-orders", "BPFO=3.58482,BPFI=5.41518"]].concat(),
    );
    let channel = &document["channels"][0];
    assert_eq!(channel["envelope"]["diagnosis"], "outer race");
    assert_eq!(channel["bearing"]["balls"], 9);
    assert!((number(&channel["bearing"]["orders"]["bsf"]) - 2.3567).abs() < 1e-3);
    let lines = channel["cyclic_coherence"]["lines"].as_array().unwrap();
    // 3 BPFO is within the slip tolerance of 2 BPFI: first harmonics only.
    let firsts = lines.iter().filter(|l| l["harmonic"] == 1);
    let best = firsts.max_by(|a, b| number(&a["z_score"]).total_cmp(&number(&b["z_score"]))).unwrap();
    assert_eq!(best["line"], "BPFO", "{best}");
    assert!((number(&best["peak_hz"]) - 107.545).abs() < 0.4, "{best}");
}

/// Seven dents and bumps of a simulated outer race and two of an inner one, located from the jerk alone.
#[test]
fn race_defects_are_located_from_the_jerk() {
    const RANDOM: [(&str, f64, f64); 7] = [
        ("dent", 2.0, 0.12),
        ("bump", 6.3, 0.2),
        ("dent", 9.1, 0.1),
        ("bump", 15.8, 0.3),
        ("dent", 21.4, 0.17),
        ("bump", 27.9, 0.22),
        ("dent", 33.6, 0.15),
    ];
    const INNER: [(&str, f64, f64); 2] = [("bump", 270.0, 0.17), ("dent", 285.0, 0.17)];
    for (variant, race, expected) in
        [("random_defects", "outer", &RANDOM[..]), ("inner_bump_and_dent", "inner", &INNER[..])]
    {
        let folder = tempfile::tempdir().unwrap();
        let mut run = rotordyn();
        run.args(["run-up", "models/atef_2022.toml", "--variant", variant, "--no-figures", "--out"]);
        output_of(run.arg(folder.path()).args(["--set", "speed.duration=1 s", "--quiet"]));
        let flags =
            ["--channel", "ring_ax", "--quadrature-channel", "ring_ay", "--bearing", "B", "--race", race];
        let more = ["--time", "0.25 s ..", "--analyses", "jerk"];
        let document = signal(folder.path(), folder.path(), &[&flags[..], &more].concat());
        let jerk = &document["channels"][0]["jerk"];
        let found = jerk["defects"].as_array().unwrap();
        assert_eq!(found.len(), expected.len(), "{jerk}");
        for (defect, (kind, angle, width)) in found.iter().zip(expected) {
            assert_eq!(defect["kind"], *kind, "{defect}");
            // One sample is 0.026 deg of ball travel on the outer race, 0.039 deg on the inner.
            let off = number(&defect["angle"]).to_degrees() - angle;
            assert!(off.abs() < 0.1, "{variant} {angle}: off by {off} deg");
            // One sample is 10.6 um of the outer raceway, 10.5 um of the inner; jumps are interpolated between samples.
            let wide = number(&defect["width_m"]) * 1e3 - width;
            assert!(wide.abs() < 6e-3, "{variant} {angle}: off by {wide} mm");
        }
        assert!(folder.path().join("signal_jerk_folded_ring_ax.png").exists());
    }
}

/// Simulation of the measured rig: the same diagnosis, both envelope spectra in one figure.
#[test]
fn simulated_rig_gives_the_measured_diagnosis() {
    for (variant, diagnosis, line, file) in [
        ("inner_race", "inner race", "BPFI", "cwru/105_IR007_0hp_12k.mat"),
        ("outer_race", "outer race", "BPFO", "cwru/130_OR007at6_0hp_12k.mat"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let mut run = rotordyn();
        run.args(["run-up", "models/cwru_6205.toml", "--variant", variant, "--no-figures", "--out"]);
        // Eleven cage revolutions after the initial transient of 0.25 s.
        output_of(run.arg(folder.path()).args(["--set", "speed.duration=1.25 s", "--quiet"]));
        let measured = measured_data::measured(file);
        let mut flags =
            vec!["--channel", "DE", "--bearing", "drive", "--time", "0.25 s ..", "--analyses", "envelope"];
        if let Some(path) = &measured {
            flags.extend([
                "--compare-with",
                path.to_str().unwrap(),
                "--compare-rate",
                "12 kHz",
                "--compare-unit",
                "g",
            ]);
        }
        let document = signal(folder.path(), folder.path(), &flags);
        let envelope = &document["channels"][0]["envelope"];
        assert_eq!(envelope["diagnosis"], diagnosis, "{variant}");
        let strongest = &envelope["strongest"];
        assert_eq!(strongest["line"], line, "{variant}");
        // Cage speed as measured, 0.35 % off the kinematic rates of the geometry.
        let off = number(&strongest["measured"]) / number(&strongest["expected"]) - 1.0;
        assert!(off.abs() < 5e-3, "{variant}: {off}");
        if let Some(path) = &measured {
            assert_eq!(document["compared_record"]["envelope"]["diagnosis"], diagnosis, "{variant}");
            let other = document_channel(path);
            assert!(folder.path().join(format!("signal_envelope_DE_vs_{other}.png")).exists());
        }
    }
}

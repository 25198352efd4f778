//! `signal`: grade of the diagnosis, the record's own speed, warnings about speed and orders.

use std::f64::consts::TAU;

use crate::signal::{faulty_bearing_record, measured_data};
use crate::{json_of, output_of, rotordyn};
use rotordyn::io::measured;
use rotordyn::signal::record::{MeasuredData, Record};
use serde_json::Value;

const RATE: f64 = 12_000.0;

fn document(samples: Vec<f64>, flags: &[&str]) -> Value {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.h5");
    let record = Record::samples("A_ax", RATE, 0.0, samples, "m/s^2");
    measured::write(&path, &MeasuredData { records: vec![record], ..MeasuredData::default() }).unwrap();
    let out = folder.path().join("out");
    json_of(
        rotordyn()
            .arg("signal")
            .arg(&path)
            .args(["--no-figures", "--analyses", "envelope"])
            .arg("--out")
            .arg(&out)
            .args(flags),
    )
}

fn codes(document: &Value) -> Vec<&str> {
    document["warnings"].as_array().unwrap().iter().filter_map(|w| w["code"].as_str()).collect()
}

/// An outer race fault of a 6205 (BPFO 3.58482) and three shaft harmonics at a speed \[rev/s\].
fn machine(speed: f64) -> Vec<f64> {
    let mut x = faulty_bearing_record(60_000, RATE, 3.58482 * speed);
    for (k, value) in x.iter_mut().enumerate() {
        let angle = TAU * speed * k as f64 / RATE;
        *value += 0.2 * angle.cos() + 0.15 * (2.0 * angle).cos() + 0.1 * (3.0 * angle).cos();
    }
    x
}

/// "1000 rpm" that are 1015: the speed is found, the bearing's lines are multiples of it.
#[test]
fn speed_of_the_record_itself() {
    let found = document(machine(1015.0 / 60.0), &["--bearing", "6205-2RS", "--speed", "1000 rpm"]);
    let channel = &found["channels"][0];
    let speed = &channel["record_speed"];
    let (rpm, uncertainty) =
        (speed["found_rpm"].as_f64().unwrap(), speed["uncertainty_rpm"].as_f64().unwrap());
    // Cramér–Rao bound about 0.1 rpm: within two of the standard deviations that it states, which are no more than twice it.
    assert!((rpm - 1015.0).abs() < 2.0 * uncertainty && uncertainty < 0.2, "{speed}");
    let envelope = &channel["envelope"];
    assert_eq!(envelope["diagnosis"], "outer race", "{}", envelope["statement"]);
    let statement = envelope["statement"].as_str().unwrap();
    assert!(statement.starts_with("outer race, ") && statement.ends_with(" %"), "{statement}");
    assert!(envelope["probability"].as_f64().unwrap() > 0.5);
    let lines = envelope["strong_lines"].as_array().unwrap();
    assert!(lines.iter().any(|l| l["explained_by"] == "outer race"), "{lines:?}");
    assert!(!codes(&found).contains(&"shaft-speed-not-found"));
}

/// A shaft at a quarter of the stated speed: a record at 48 kHz read at 12 kHz.
#[test]
fn wrong_rate_is_a_warning() {
    let found = document(machine(7.5), &["--bearing", "6205-2RS", "--speed", "1800 rpm"]);
    assert!(codes(&found).contains(&"shaft-speed-not-found"), "{}", found["warnings"]);
    assert!(
        found["warnings"].to_string().contains("the sampling rate is 4.00 times the one used"),
        "{}",
        found["warnings"]
    );
    // The speed as stated: no search, no warning.
    let flags = ["--bearing", "6205-2RS", "--speed", "1800 rpm", "--speed-range", "0"];
    let found = document(machine(7.5), &flags);
    assert!(!codes(&found).contains(&"shaft-speed-not-found"), "{}", found["warnings"]);
}

/// Records whose shaft has its strongest lines at 4x, 8x, …: the bearing's own lines confirm the stated speed.
#[test]
fn named_part_confirms_the_speed() {
    for record in ["105_IR007_0hp_12k", "130_OR007at6_0hp_12k"] {
        let Some(path) = measured_data::measured(&format!("cwru/{record}.mat")) else { return };
        let out = tempfile::tempdir().unwrap();
        let mut command = rotordyn();
        command.arg("signal").arg(path).arg("--out").arg(out.path()).args([
            "--bearing",
            "6205-2RS",
            "--rate",
            "12 kHz",
            "--no-figures",
        ]);
        let found = json_of(&mut command);
        assert!(!codes(&found).contains(&"shaft-speed-not-found"), "{record}: {}", found["warnings"]);
    }
}

/// Orders that do not add up to the number of balls are taken as given, with a warning.
#[test]
fn inconsistent_orders_are_a_warning() {
    let flags = ["--speed", "1015 rpm", "--bearing-orders", "BPFO=3.585,BPFI=5.46"];
    let found = document(machine(1015.0 / 60.0), &flags);
    assert!(codes(&found).contains(&"bearing-orders-inconsistent"), "{}", found["warnings"]);
    let channel = &found["channels"][0];
    assert_eq!(channel["bearing"]["balls"], 9);
    assert_eq!(channel["envelope"]["diagnosis"], "outer race");
}

/// The computed lines of a perfect bearing at BPFO are its variable compliance; those of a dented one are not called so.
#[test]
fn variable_compliance_of_a_perfect_bearing_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let set = "speed={profile=\"ramp\", settle=\"0.3 s\", ramp=\"0.3 s\", hold=\"3 s\", to=\"1200 rpm\"}";
    let found = |variant: &[&str]| {
        let run = ["run-up", "models/overhung_rig.toml", "--set", set, "--no-figures", "--quiet", "--out"];
        output_of(rotordyn().args(run).arg(folder.path()).args(variant));
        let flags = ["--channel", "B_ay", "--bearing", "B", "--time", "1 s ..", "--analyses", "envelope"];
        let found = json_of(rotordyn().arg("signal").arg(folder.path()).args(flags).arg("--no-figures"));
        assert_eq!(found["channels"][0]["envelope"]["diagnosis"], "outer race", "{variant:?}");
        found["warnings"].to_string().contains("variable compliance")
    };
    assert!(found(&[]));
    assert!(!found(&["--variant", "dented"]));
}

/// Dents and bumps of the models, simulated and analysed by the same program.
#[test]
fn simulated_defects_are_named() {
    // Settled after a quarter of a second, and after the ramp to 1200 rpm. Eight defects at equal distances fill the
    // ball spacing: most of their lines are at 4 BPFO.
    let atef = ("atef_2022", "speed.duration=1.25 s", "ring_ax", "0.25 s ..");
    let rig = (
        "overhung_rig",
        "speed={profile=\"ramp\", settle=\"0.3 s\", ramp=\"0.3 s\", hold=\"3 s\", to=\"1200 rpm\"}",
        "B_ay",
        "1 s ..",
    );
    for ((model, set, channel, time), variant, part) in [
        (atef, "one_dent", "outer race"),
        (atef, "two_dents", "outer race"),
        (atef, "bump_and_dent", "outer race"),
        (atef, "four_defects", "outer race"),
        (atef, "six_defects", "outer race"),
        (atef, "eight_defects", "outer race"),
        (atef, "random_defects", "outer race"),
        (atef, "inner_dent", "inner race"),
        (atef, "two_inner_dents", "inner race"),
        (atef, "inner_bump_and_dent", "inner race"),
        (atef, "loaded_inner_dent", "inner race"),
        (rig, "dented", "outer race"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let model = format!("models/{model}.toml");
        let run = ["run-up", &model, "--variant", variant, "--set", set, "--no-figures", "--quiet", "--out"];
        output_of(rotordyn().args(run).arg(folder.path()));
        let flags = ["--channel", channel, "--bearing", "B", "--time", time, "--analyses", "envelope"];
        for band in ["lines", "full", "1 kHz .. 20 kHz"] {
            if band != "lines" && model.contains("overhung") {
                continue;
            }
            let found = json_of(
                rotordyn()
                    .arg("signal")
                    .arg(folder.path())
                    .args(flags)
                    .args(["--band", band, "--no-figures", "--out"])
                    .arg(folder.path()),
            );
            let envelope = &found["channels"][0]["envelope"];
            assert_eq!(envelope["diagnosis"], part, "{variant}, {band}: {}", envelope["statement"]);
            assert!(envelope["probability"].as_f64().unwrap() > 0.5, "{variant}: {envelope}");
        }
    }
}

//! `identify` of a record without a force: modes of a machine in operation, and no harmonic among them.

use std::f64::consts::TAU;
use std::path::Path;

use crate::identify::{noise, write};
use crate::{json_of, rotordyn};
use rotordyn::io::measured;
use rotordyn::signal::record::{Dof, Record};

/// Samples a second.
const RATE: f64 = 256.0;
/// Damped frequency [Hz], damping ratio, shape at three points.
const MODES: [(f64, f64, [f64; 3]); 2] = [(21.0, 0.012, [0.5, 1.0, 0.7]), (58.0, 0.008, [1.0, 0.2, -0.9])];
/// rev/s.
const SPEED: f64 = 29.3;

/// Velocities for 500 s under random forces, with 1x and 2x of the shaft.
fn record() -> Vec<Record> {
    let count = (500.0 * RATE) as usize;
    let mut channels = vec![Vec::new(); 3];
    let mut random = noise(5);
    let mut past = [[0.0f64; 2]; 2];
    for k in 0..count {
        let mut x = [0.0; 3];
        for (m, (hz, zeta, shape)) in MODES.iter().enumerate() {
            // q of a pole pair: q₊ = 2 e^{−aT} cos(ωT) q − e^{−2aT} q₋ + f.
            let decay = (-zeta * TAU * hz / (1.0 - zeta * zeta).sqrt() / RATE).exp();
            let f: f64 = random();
            let next = 2.0 * decay * (TAU * hz / RATE).cos() * past[m][0] - decay * decay * past[m][1] + f;
            past[m] = [next, past[m][0]];
            // Of similar size whatever the frequency.
            (0..3).for_each(|p| x[p] += next * shape[p] * (hz / 21.0));
        }
        let theta = TAU * SPEED * k as f64 / RATE;
        for (p, channel) in channels.iter_mut().enumerate() {
            channel.push(x[p] + 20.0 * (theta + p as f64).cos() + 8.0 * (2.0 * theta).sin() + 0.3 * random());
        }
    }
    let at = |(p, values): (usize, Vec<f64>)| Record {
        response: Dof::new(p as i64 + 1, 2),
        ..Record::samples(&format!("v{}", p + 1), RATE, 0.0, values, "m/s")
    };
    channels.into_iter().enumerate().map(at).collect()
}

fn identified(folder: &Path, flags: &[&str]) -> serde_json::Value {
    let mut command = rotordyn();
    json_of(command.current_dir(folder).args(["identify", "run.uff", "--out", "out"]).args(flags))
}

fn check(document: &serde_json::Value) {
    let modes = document["modes"].as_array().unwrap();
    let number = |m: &serde_json::Value, name: &str| m[name].as_f64().unwrap();
    println!("{modes:#?} {:#?} {:#?}", document["dropped"], document["warnings"]);
    assert_eq!(modes.len(), MODES.len());
    for (m, (hz, zeta, _)) in modes.iter().zip(MODES) {
        // Issue's bounds: frequency within 0.5 %, damping within 20 %; and both within four standard errors.
        let off = (number(m, "frequency_hz") - hz).abs();
        assert!(off < 0.005 * hz && off < 4.0 * number(m, "frequency_error_hz"), "{hz} Hz");
        let off = (number(m, "damping_ratio") - zeta).abs();
        assert!(off < 0.2 * zeta && off < 4.0 * number(m, "damping_ratio_error"), "{hz} Hz");
    }
    let lines = document["harmonics"]["frequency"].as_array().unwrap();
    for order in [1.0, 2.0] {
        assert!(lines.iter().any(|f| (f.as_f64().unwrap() - order * SPEED).abs() < 0.02), "{lines:?}");
    }
}

#[test]
fn modes_of_a_record_without_a_force() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    write(folder, "run.uff", record());
    check(&identified(folder, &["--no-figures"]));
    let stated = identified(folder, &["--speed", "1757 rpm", "--csv"]);
    check(&stated);
    assert!(stated["harmonics"]["treatment"].as_array().unwrap().iter().any(|t| t == "removed"));
    // Shapes for `validate` and `update`, figures and tables.
    let shapes = measured::read(&folder.join("out/modes.uff")).unwrap().shapes;
    assert_eq!(shapes.iter().map(|s| s.nodes.len()).collect::<Vec<_>>(), [3, 3]);
    let files: Vec<&str> = stated["files"].as_array().unwrap().iter().map(|f| f.as_str().unwrap()).collect();
    for name in ["results.h5", "modes.uff", "stabilisation.svg", "auto_mac.svg"] {
        assert!(files.iter().any(|f| f.ends_with(name)), "{name} in {files:?}");
    }
    let mut wrong = rotordyn();
    let wrong =
        wrong.current_dir(folder).args(["identify", "run.uff", "--orders", "3.57,zero"]).assert().failure();
    let text = String::from_utf8(wrong.get_output().stderr.clone()).unwrap();
    assert!(text.contains("--orders needs the shaft") && text.contains("--orders zero"), "{text}");
}

/// A rotor with its disc off the middle, so that the first bending modes whirl apart, at constant speed under random forces.
const JEFFCOTT: &str = r#"
[variant.operation]
remove = ["speed.settle", "speed.ramp", "speed.hold", "speed.to"]
speed = { profile = "constant", speed = "3000 rpm", duration = "120 s" }
station.disc = "700 mm"
load.x = { at = "disc.main", force = "0.2, 0, 0 N", moment = "0, 0.02, 0 N m", band = "2, 240 Hz" }
load.y = { at = "disc.main", force = "0, 0.2, 0 N", moment = "-0.02, 0, 0 N m", band = "2, 240 Hz" }
probe.tilt_x = { at = "disc.main", direction = "tx" }
probe.tilt_y = { at = "disc.main", direction = "ty" }
"#;

/// Runs a variant `operation` and identifies its modes and those of the linear model; both documents.
fn in_operation(
    folder: &Path,
    model: &str,
    variant: &str,
    speed: &str,
    flags: &[&str],
) -> [serde_json::Value; 2] {
    let text = std::fs::read_to_string(model).unwrap() + variant;
    std::fs::write(folder.join("machine.toml"), text).unwrap();
    let run = |arguments: &[&str]| {
        let mut command = rotordyn();
        json_of(command.current_dir(folder).args(arguments).args(["--no-figures"]))
    };
    let of = ["machine.toml", "--variant", "operation"];
    run(&[&["run-up"][..], &of, &["--out", "run"]].concat());
    let found = run(&[&["identify", "run/results.h5", "--out", "modes"][..], flags].concat());
    [found, run(&[&["modal"][..], &of, &["--speed", speed, "--modes", "14", "--out", "linear"]].concat())]
}

/// Every computed mode of the list is found within the bounds of the issue, turning the same way; nothing else is.
fn compare(found: &serde_json::Value, linear: &serde_json::Value, expected: &[usize], least_whirl: f64) {
    let modes = found["modes"].as_array().unwrap();
    let computed = linear["modal"][0]["modes"].as_array().unwrap();
    let number = |m: &serde_json::Value, name: &str| m[name].as_f64().unwrap_or(f64::NAN);
    for m in modes {
        println!(
            "{:.4} ± {:.4} Hz, {:.5} ± {:.5}, whirl {}",
            number(m, "frequency_hz"),
            number(m, "frequency_error_hz"),
            number(m, "damping_ratio"),
            number(m, "damping_ratio_error"),
            m["whirl"]
        );
    }
    println!("{:#?}", found["warnings"]);
    assert_eq!(modes.len(), expected.len(), "{:#?}", found["dropped"]);
    for (mode, &at) in modes.iter().zip(expected) {
        let own = &computed[at];
        let (hz, zeta) = (number(own, "frequency_hz"), number(own, "damping_ratio"));
        println!("computed {hz:.4} Hz, {zeta:.5}, {}", own["label"]);
        assert!((number(mode, "frequency_hz") / hz - 1.0).abs() < 0.005, "{hz} Hz");
        assert!((number(mode, "damping_ratio") / zeta - 1.0).abs() < 0.2, "{hz} Hz");
        let label = own["label"].as_str().unwrap();
        let way = if label.contains("forward") { 1.0 } else { -1.0 };
        let whirl = number(mode, "whirl");
        if label.contains("ward") && whirl.abs() > least_whirl {
            assert!(whirl * way > 0.0, "{label}: {whirl}");
        }
    }
}

#[test]
fn modes_of_a_simulated_machine() {
    let folder = tempfile::tempdir().unwrap();
    let flags = ["--band", "5 Hz .. 120 Hz"];
    let [found, linear] = in_operation(folder.path(), "models/jeffcott.toml", JEFFCOTT, "3000 rpm", &flags);
    // The second mode is torsion, which no probe sees.
    compare(&found, &linear, &[0, 2], 0.9);
    let whirl: Vec<f64> =
        found["modes"].as_array().unwrap().iter().map(|m| m["whirl"].as_f64().unwrap()).collect();
    assert!(whirl[0] < -0.95 && whirl[1] > 0.95, "{whirl:?}");
    // The unbalance is the only harmonic.
    let lines = found["harmonics"]["frequency"].as_array().unwrap();
    assert!(lines.iter().all(|f| (f.as_f64().unwrap() - 50.0).abs() < 0.1) && !lines.is_empty(), "{lines:?}");
}

/// The rig on its ball bearings, with unbalance and ball passes, under random forces at disc, pulley and housings.
const RIG: &str = r#"
[variant.operation]
remove = ["speed.settle", "speed.ramp", "speed.hold", "speed.to"]
study.run_up = { step = "50 us", sample_rate = "1100 Hz", cutoff = "500 Hz" }
study.orders.max_order = 10

[variant.operation.load]
disc_x = { at = "disc.main", force = "1, 0, 0 N", band = "2, 520 Hz" }
disc_y = { at = "disc.main", force = "0, 1, 0 N", band = "2, 520 Hz" }
disc_twist = { at = "disc.main", moment = "0, 0, 0.1 N m", band = "2, 520 Hz" }
pulley_x = { at = "disc.pulley", force = "1, 0, 0 N", band = "2, 520 Hz" }
A_x = { at = "housing.A", force = "1, 0, 0 N", band = "2, 520 Hz" }
A_y = { at = "housing.A", force = "0, 1, 0 N", band = "2, 520 Hz" }
B_x = { at = "housing.B", force = "1, 0, 0 N", band = "2, 520 Hz" }
B_y = { at = "housing.B", force = "0, 1, 0 N", band = "2, 520 Hz" }
"#;

fn rig_in_operation(speed: &str) {
    let folder = tempfile::tempdir().unwrap();
    let variant = format!("{RIG}\n[variant.operation.speed]\n{speed}\n");
    let flags = ["--band", "5 Hz .. 340 Hz"];
    let [found, linear] =
        in_operation(folder.path(), "models/overhung_rig.toml", &variant, "1200 rpm", &flags);
    assert_eq!(found["warnings"].as_array().map(Vec::len), Some(0));
    // Without the axial mode, which no probe sees.
    compare(&found, &linear, &[0, 1, 3, 4, 5, 6, 7, 8], 0.3);
}

#[test]
#[ignore = "five minutes of CPU"]
fn rig_in_operation_at_constant_speed() {
    rig_in_operation("profile = \"constant\"\nspeed = \"1200 rpm\"\nduration = \"600 s\"");
}

#[test]
#[ignore = "five minutes of CPU"]
fn rig_in_operation_with_a_run_up() {
    rig_in_operation(
        "profile = \"ramp\"\nto = \"1200 rpm\"\nsettle = \"1 s\"\nramp = \"10 s\"\nhold = \"589 s\"",
    );
}

/// A clipped channel, and one that stands for a time: modes of theirs are none of the machine's, and the channel is named.
#[test]
fn clipped_and_interrupted_channels_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let made = |change: &dyn Fn(&mut [f64])| {
        let mut records = record();
        let mut values = records[1].time_samples().unwrap().to_vec();
        change(&mut values);
        records[1] =
            Record { response: records[1].response, ..Record::samples("v2", RATE, 0.0, values, "m/s") };
        write(folder, "run.uff", records);
        let document = identified(folder, &["--no-figures"]);
        let warnings = document["warnings"].as_array().unwrap().iter();
        warnings.map(|w| format!("{} {}", w["code"], w["text"])).collect::<Vec<String>>()
    };
    assert!(!made(&|_| ()).iter().any(|w| w.contains("clipped-record") || w.contains("record-gap")));
    let clipped = made(&|values| values.iter_mut().for_each(|v| *v = v.clamp(-45.0, 45.0)));
    assert!(clipped.iter().any(|w| w.contains("clipped-record") && w.contains("`v2`")), "{clipped:?}");
    let held = made(&|values| values[10_000..20_000].fill(3.5));
    assert!(held.iter().any(|w| w.contains("record-gap") && w.contains("`v2`")), "{held:?}");
}

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

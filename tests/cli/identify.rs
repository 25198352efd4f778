//! `identify` as users meet it: a rig's noisy FRFs, results.h5, hammer records; and files that will not do.

use std::f64::consts::TAU;
use std::path::Path;

use rotordyn::edge::measured;
use rotordyn::signal::Complex;
use rotordyn::signal::record::{Axis, AxisQuantity, Dof, Kind, Measured, Record, Values};

use crate::{json_of, output_of, rotordyn};

const JEFFCOTT: &str = "models/jeffcott.toml";

fn path(folder: &Path, name: &str) -> String {
    folder.join(name).display().to_string()
}

#[test]
fn from_a_model_to_its_modes_by_way_of_noisy_frfs() {
    let folder = tempfile::tempdir().unwrap();
    let out = path(folder.path(), "jeffcott");
    let frf = ["frf", JEFFCOTT, "--noise", "40 dB", "--seed", "7", "--no-figures", "--out", &out];
    output_of(rotordyn().args(frf));
    let noisy = path(Path::new(&out), "frf_noisy.uff");
    let modes = path(folder.path(), "modes");
    let found = json_of(rotordyn().args(["identify", &noisy, "--band", "2, 200 Hz", "--out", &modes]));
    let truth =
        json_of(rotordyn().args(["modal", JEFFCOTT, "--speed", "0 rpm", "--no-figures", "--out", &out]));
    let first = found["modes"][0]["frequency_hz"].as_f64().unwrap();
    let computed: Vec<f64> = truth["modal"][0]["modes"]
        .as_array()
        .unwrap()
        .iter()
        .map(|m| m["frequency_hz"].as_f64().unwrap())
        .collect();
    assert!(computed.iter().any(|hz| (hz / first - 1.0).abs() < 2e-3), "{first} of {computed:?}");
    for file in ["results.h5", "modes.uff", "stabilisation.svg", "stabilisation.png"] {
        assert!(Path::new(&modes).join(file).exists(), "{file}");
    }
    let shapes = measured::read(&Path::new(&modes).join("modes.uff")).unwrap().shapes;
    assert_eq!(shapes.len(), found["modes"].as_array().unwrap().len());
    // Our own results file serves as well, without noise.
    let exact = path(Path::new(&out), "results.h5");
    let again = json_of(rotordyn().args([
        "identify",
        &exact,
        "--band",
        "2, 200 Hz",
        "--no-figures",
        "--out",
        &modes,
    ]));
    let own = again["modes"][0]["frequency_hz"].as_f64().unwrap();
    assert!(computed.iter().any(|hz| (hz / own - 1.0).abs() < 1e-5), "{own} of {computed:?}");
}

/// One mode's accelerance.
fn record(response: i64, hz: &[f64], value: impl Fn(f64) -> Complex<f64>) -> Record {
    let axis = Axis::through(AxisQuantity::Frequency, hz.to_vec());
    let values = Values::Complex(hz.iter().map(|f| value(*f)).collect());
    Record {
        response: Dof::new(response, 2),
        reference: Dof::new(1, 2),
        ..Record::new(&format!("H{response}"), Kind::Frf, axis, values, "(m/s^2)/N")
    }
}

fn resonant(f: f64) -> Complex<f64> {
    let (s, w) = (Complex::new(0.0, TAU * f), TAU * 40.0);
    s * s / (s * s + s * (0.02 * w) + w * w)
}

fn even(lines: usize, step: f64) -> Vec<f64> {
    (0..lines).map(|k| 5.0 + step * k as f64).collect()
}

/// What the command says to a file of these records.
fn said(folder: &Path, name: &str, records: Vec<Record>, more: &[&str], code: i32) -> String {
    let file = folder.join(format!("{}.h5", name.replace(' ', "_")));
    measured::write(&file, &Measured { records, ..Measured::default() }).unwrap();
    said_to(folder, name, &file, more, code)
}

fn said_to(folder: &Path, name: &str, file: &Path, more: &[&str], code: i32) -> String {
    let out = path(folder, "out");
    let run = rotordyn()
        .args(["identify", &file.display().to_string(), "--no-figures", "--quiet", "--out", &out])
        .args(more)
        .assert()
        .code(code);
    let text = String::from_utf8(run.get_output().stderr.clone()).unwrap();
    format!("# {name}\n{}\n", text.replace(&folder.display().to_string(), "."))
}

#[test]
fn bad_input_says_what_to_do() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let hz = even(400, 0.2);
    let good = || vec![record(1, &hz, resonant), record(2, &hz, |f| resonant(f) * 0.5)];
    let mut all = String::new();
    all += &said(here, "no coherence", good(), &[], 0);
    all += &said(here, "one FRF only", good()[..1].to_vec(), &[], 0);
    let other = even(400, 0.25);
    all +=
        &said(here, "axes that differ", vec![record(1, &hz, resonant), record(2, &other, resonant)], &[], 2);
    let mut unknown = good();
    unknown.iter_mut().for_each(|r| (r.unit, r.stated_unit) = (String::new(), String::new()));
    all += &said(here, "units unknown", unknown, &[], 0);
    let flat =
        vec![record(1, &hz, |f| Complex::new(1e-3, 1e-9 * f)), record(2, &hz, |_| Complex::new(2e-3, 0.0))];
    all += &said(here, "no mode in the band", flat, &[], 2);
    all += &said(here, "no mode beside the resonance", good(), &["--band", "60, 84 Hz"], 2);
    let nan =
        vec![record(
            1,
            &hz,
            |f| if f > 30.0 && f < 30.3 { Complex::new(f64::NAN, 0.0) } else { resonant(f) },
        )];
    all += &said(here, "not a number", nan, &[], 2);
    all += &said(here, "dead channel", vec![record(1, &hz, |_| Complex::new(0.0, 0.0))], &[], 2);
    all += &said(here, "too few lines", good(), &["--band", "35, 45 Hz", "--max-order", "60"], 2);
    all += &said(here, "too few lines for any order", good(), &["--band", "39, 41 Hz"], 2);
    all += &said(here, "a band elsewhere", good(), &["--band", "300, 400 Hz"], 2);
    all += &said(here, "a band without unit", good(), &["--band", "10, 80"], 2);
    all += &said(here, "an order too low", good(), &["--max-order", "3"], 2);
    let uneven: Vec<f64> = (0..200).map(|k| 5.0 * 1.01f64.powi(k)).collect();
    all += &said(here, "uneven lines", vec![record(1, &uneven, resonant)], &[], 2);
    let time = |name: &str, unit: &str| {
        Record::samples(name, 1000.0, 0.0, (0..1000).map(|n| f64::from(n % 7)).collect(), unit)
    };
    all += &said(here, "time records without a force", vec![time("a", "m/s^2"), time("b", "m/s^2")], &[], 2);
    let mapping = here.join("map.toml");
    std::fs::write(&mapping, "[channel.H3]\nstation = \"B\"\ndirection = \"x\"\n").unwrap();
    let mapping = mapping.display().to_string();
    all += &said(here, "missing channel in the mapping", good(), &["--mapping", &mapping], 2);
    // A binary universal file, cut off in the middle of its values.
    let whole = here.join("whole.uff");
    let options = rotordyn::edge::uff::Options { binary: true, ..Default::default() };
    rotordyn::edge::uff::write(&whole, &Measured { records: good(), ..Measured::default() }, options)
        .unwrap();
    let bytes = std::fs::read(&whole).unwrap();
    let cut = here.join("cut.uff");
    std::fs::write(&cut, &bytes[..bytes.len() * 2 / 3]).unwrap();
    all += &said_to(here, "truncated binary", &cut, &[], 2);
    insta::assert_snapshot!("bad_input", all.trim());
}

/// Three blows to a mode at 40 Hz, one of them double, as a recorder stores them.
#[test]
fn hammer_records_are_turned_into_frfs() {
    let folder = tempfile::tempdir().unwrap();
    let rate = 1024.0;
    let (n, block) = (3 * 4096, 4096);
    let mut force = vec![0.0; n];
    for (blow, size) in [60.0, 80.0, 50.0].into_iter().enumerate() {
        for k in 0..4 {
            force[blow * block + 40 + k] = size * (std::f64::consts::PI * (k as f64 + 0.5) / 4.0).sin();
        }
    }
    force[2 * block + 400] = 45.0;
    // Impulse invariant: each sample's force is an impulse f/rate.
    let (w, zeta) = (TAU * 40.0, 0.01);
    let wd = w * (1.0f64 - zeta * zeta).sqrt();
    let response = |gain: f64| -> Vec<f64> {
        let mut out = vec![0.0; n];
        for (at, f) in force.iter().enumerate().filter(|(_, f)| **f != 0.0) {
            for (k, value) in out[at..n.min(at + 6000)].iter_mut().enumerate() {
                let t = k as f64 / rate;
                *value += gain * f / rate * (-zeta * w * t).exp() * (wd * t).sin() / wd;
            }
        }
        out
    };
    let mut records = vec![Record::samples("hammer", rate, 0.0, force.clone(), "N")];
    for (k, gain) in [1.0, -0.6].into_iter().enumerate() {
        let mut own = Record::samples(&format!("x{k}"), rate, 0.0, response(gain), "m");
        own.response = Dof::new(k as i64 + 1, 2);
        records.push(own);
    }
    let file = folder.path().join("blows.h5");
    measured::write(&file, &Measured { records, ..Measured::default() }).unwrap();
    let out = path(folder.path(), "out");
    let run = ["identify", &file.display().to_string(), "--band", "5, 120 Hz", "--no-figures", "--out", &out];
    let found = json_of(rotordyn().args(run));
    let modes = found["modes"].as_array().unwrap();
    let near =
        modes.iter().find(|m| (m["frequency_hz"].as_f64().unwrap() / (wd / TAU) - 1.0).abs() < 1e-4).unwrap();
    assert!((near["damping_ratio"].as_f64().unwrap() / zeta - 1.0).abs() < 1e-2, "{near}");
    let warnings = found["warnings"].to_string();
    assert!(warnings.contains("blow 3") && warnings.contains("a second hit"), "{warnings}");
}

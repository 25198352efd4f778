//! `identify` from time records: hits that are measured and hits that are simulated give the modes back.

use std::f64::consts::TAU;
use std::path::Path;

use crate::identify::{MODES, Mode, accelerance, changed, noise, outputs_of_cases, pole, write};
use crate::{json_of, rotordyn, struck_rig};
use rotordyn::analysis::equilibrium::{CageTreatment, equilibrium};
use rotordyn::analysis::modal;
use rotordyn::assembly::{Assembly, LinearSystem};
use rotordyn::linalg::Complex64;
use rotordyn::model::{self, Options};
use rotordyn::signal::impact::{self, Estimator, ImpactTest};
use rotordyn::signal::record::{Axis, AxisQuantity, Kind, MeasuredData, Points, Record, Values};

/// Samples a second of the records of hits.
const RATE: f64 = 4096.0;
/// Steps of the simulation a sample.
const FINE: usize = 2;

/// One hit of the hammer: when \[s\], how hard \[N\].
#[derive(Clone, Copy)]
struct Pulse {
    at: f64,
    peak: f64,
}

/// Force, and accelerations of all points, of half-sine hits of 4 ms at a point, without noise.
fn impact_record(seconds: f64, point: usize, pulses: &[Pulse]) -> (Vec<f64>, [Vec<f64>; 4]) {
    let step = 1.0 / (RATE * FINE as f64);
    let width = 4e-3;
    let force = |t: f64| {
        let one = |s: &Pulse| {
            let x = (t - s.at) / width;
            if (0.0..1.0).contains(&x) { s.peak * (std::f64::consts::PI * x).sin() } else { 0.0 }
        };
        pulses.iter().map(one).sum::<f64>()
    };
    let mut out = (Vec::new(), [(); 4].map(|()| Vec::new()));
    let poles = MODES.map(pole);
    let turns = poles.map(|pole| (pole * step).exp());
    // q'' + 2 zeta omega q' + omega^2 q = phi f: z' = pole z + f has q = phi Im z / Im pole.
    let mut z = [Complex64::default(); 3];
    let mut before = force(0.0);
    for n in 0..(seconds * RATE) as usize * FINE {
        let now = force(n as f64 * step);
        for (k, z) in z.iter_mut().enumerate() {
            // Exact for a force that is linear over the step.
            let x = poles[k] * step;
            let full = (turns[k] - 1.0) / x;
            let late = (turns[k] - 1.0 - x) / (x * x);
            *z = turns[k] * *z + step * (before * (full - late) + now * late);
        }
        before = now;
        if n % FINE == 0 {
            out.0.push(now);
            for (r, samples) in out.1.iter_mut().enumerate() {
                let one = |k: usize| {
                    // z'' = pole^2 z + pole f + f'; the pulse's slope is real and shows in no imaginary part.
                    let own = poles[k] * poles[k] * z[k] + poles[k] * now;
                    MODES[k].2[r] * MODES[k].2[point] * own.im / poles[k].im
                };
                samples.push((0..3).map(one).sum());
            }
        }
    }
    out
}

/// What is on the channels of an impact test.
fn channels(force: Vec<f64>, responses: &[Vec<f64>]) -> Vec<Record> {
    let mut out = vec![Record::samples("hammer", RATE, 0.0, force, "N")];
    for (r, values) in responses.iter().enumerate() {
        out.push(Record::samples(&format!("y{}", r + 1), RATE, 0.0, values.clone(), "m/s^2"));
    }
    out
}

/// Adds noise of a share of each channel's largest value.
fn noisy(records: &mut [Record], share: [f64; 2], seed: u32) {
    let mut random = noise(seed);
    for (k, record) in records.iter_mut().enumerate() {
        let Values::Real(values) = &mut record.values else { continue };
        let largest = values.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        values.iter_mut().for_each(|v| *v += share[k.min(1)] * largest * random());
    }
}

/// Modes of a document: frequency, damping ratio.
fn modes(document: &serde_json::Value) -> Vec<(f64, f64)> {
    let value = |mode: &serde_json::Value, name: &str| mode[name].as_f64().unwrap();
    let all = document["modes"].as_array().unwrap();
    all.iter().map(|m| (value(m, "frequency_hz"), value(m, "damping_ratio"))).collect()
}

/// Damped frequency \[Hz\] of a mode that is known.
fn damped(mode: Mode) -> f64 {
    pole(mode).im / TAU
}

fn identified(folder: &Path, files: &[&str], flags: &[&str]) -> serde_json::Value {
    let mut command = rotordyn();
    command
        .current_dir(folder)
        .arg("identify")
        .args(files)
        .args(["--no-figures", "--out", "out"])
        .args(flags);
    json_of(&mut command)
}

fn warnings(document: &serde_json::Value) -> Vec<String> {
    document["warnings"].as_array().unwrap().iter().map(|w| w["text"].as_str().unwrap().into()).collect()
}

/// Eight hits six seconds apart, the fourth a double hit, the sixth clipped.
fn eight_hits() -> Vec<Record> {
    let mut pulses: Vec<Pulse> = (0..8u8)
        .map(|k| Pulse { at: 0.5 + 6.0137 * f64::from(k), peak: 80.0 + 7.0 * f64::from(k % 3) })
        .collect();
    pulses.push(Pulse { at: pulses[3].at + 0.05, peak: 40.0 });
    let (force, responses) = impact_record(49.0, 2, &pulses);
    let mut records = channels(force, &responses);
    noisy(&mut records, [2e-3, 2e-3], 5);
    if let Values::Real(force) = &mut records[0].values {
        let from = (pulses[5].at * RATE) as usize;
        force[from..from + 20].iter_mut().for_each(|f| *f = f.min(50.0));
    }
    records
}

/// What an impact test of two seconds a hit gives: an exponential window ends decays of a fifth, and its damping is
/// taken off again.
#[test]
fn impact_test_of_eight_hits() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let records = eight_hits();
    write(folder, "test.npz", records.clone());
    write(folder, "test.mat", records.clone());
    let flags = ["--block", "2 s", "--exponential-window", "0.4 s", "--band", "10 .. 110 Hz"];
    let document = identified(folder, &["test.npz"], &flags);
    let found = modes(&document);
    assert_eq!(found.len(), 3, "{found:?}");
    for (mode, (hz, zeta)) in MODES.iter().zip(&found) {
        let off = [hz / damped(*mode) - 1.0, zeta / mode.1 - 1.0];
        println!(
            "{hz:.4} Hz off by {:.4} %, damping {zeta:.6} off by {:.2} %",
            100.0 * off[0],
            100.0 * off[1]
        );
        assert!(off[0].abs() < 1e-3 && off[1].abs() < 0.02, "{mode:?} {off:?}");
    }
    let warned = warnings(&document);
    assert_eq!(warned.len(), 2, "{warned:#?}");
    assert!(warned[0].starts_with("hit 4 of `hammer` at 18.5"), "{warned:#?}");
    assert!(warned[0].contains("double hit, the other 0.049 s after it"), "{warned:#?}");
    assert!(
        warned[1].starts_with("hit 6 of `hammer` at 30.") && warned[1].contains("the force stays at 50 N"),
        "{warned:#?}"
    );
    // Formats hold the same samples.
    assert_eq!(modes(&identified(folder, &["test.mat"], &flags)), found);

    // The same FRFs without a word on their window are damped by 1/(tau omega) more.
    let test = ImpactTest { block: Some(2.0), time_constant: Some(0.4), ..ImpactTest::default() };
    let measured = MeasuredData { records, ..MeasuredData::default() };
    let (windowed, _) = impact::frfs(&[measured], &test).unwrap();
    write(folder, "windowed.uff", windowed);
    let corrected = modes(&identified(
        folder,
        &["windowed.uff"],
        &["--exponential-window", "0.4 s", "--band", "10 .. 110 Hz"],
    ));
    let uncorrected = modes(&identified(folder, &["windowed.uff"], &["--band", "10 .. 110 Hz"]));
    for (k, mode) in MODES.iter().enumerate() {
        let share = 1.0 / (0.4 * TAU * mode.0);
        assert!(
            ((uncorrected[k].1 - corrected[k].1) / share - 1.0).abs() < 0.01,
            "{uncorrected:?} {corrected:?}"
        );
        assert!(uncorrected[k].1 / mode.1 > 1.3, "{uncorrected:?}");
        assert!((corrected[k].1 / found[k].1 - 1.0).abs() < 1e-3, "{corrected:?} {found:?}");
    }
}

/// Records through an exponential window of the analyser: its damping is taken off once, and it is not applied again.
#[test]
fn records_that_are_windowed_already() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let tau = 0.4;
    let pulses: Vec<Pulse> = (0..6u8).map(|k| Pulse { at: 0.5 + 4.0 * f64::from(k), peak: 80.0 }).collect();
    let (force, responses) = impact_record(24.5, 2, &pulses);
    let mut records = channels(force, &responses);
    for record in &mut records {
        let Values::Real(values) = &mut record.values else { continue };
        for (n, value) in values.iter_mut().enumerate() {
            let since = n as f64 / RATE - pulses[0].at;
            if since >= 0.0 {
                *value *= (-(since % 4.0) / tau).exp();
            }
        }
    }
    write(folder, "test.npz", records);
    let flags = ["--block", "3 s", "--exponential-window", "0.4 s", "--band", "10 .. 110 Hz"];
    let found = modes(&identified(folder, &["test.npz"], &[&flags[..], &["--already-windowed"]].concat()));
    assert_eq!(found.len(), 3, "{found:?}");
    let twice = modes(&identified(folder, &["test.npz"], &flags));
    for (k, mode) in MODES.iter().enumerate() {
        let (hz, zeta) = found[k];
        assert!((hz / damped(*mode) - 1.0).abs() < 1e-3, "{mode:?} {hz}");
        // Asked for: 3 %.
        assert!((zeta / mode.1 - 1.0).abs() < 0.03, "{mode:?} {zeta}");
        // Applied again, the window's damping is left in.
        let share = 1.0 / (tau * TAU * mode.0);
        assert!(((twice[k].1 - mode.1) / share - 1.0).abs() < 0.1, "{mode:?} {twice:?}");
    }
}

/// H1 bears noise of the responses, H2 noise of the force; Hv lies between.
#[test]
fn estimators() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let pulses: Vec<Pulse> = (0..6u8).map(|k| Pulse { at: 0.5 + 8.0 * f64::from(k), peak: 80.0 }).collect();
    let (mut force, responses) = impact_record(48.5, 2, &pulses);
    // A fifth more and a fifth less in turn is noise of 0.04 over the force's power; none of it is in the responses.
    for (k, f) in force.iter_mut().enumerate() {
        *f *= if (k as f64 / RATE / 8.0) % 2.0 < 1.0 { 1.2 } else { 0.8 };
    }
    let records = channels(force, &responses);
    write(folder, "test.npz", records.clone());
    let measured = MeasuredData { records, ..MeasuredData::default() };
    for (estimator, name, expected) in [
        (Estimator::H1, "h1", 1.0 / 1.04),
        (Estimator::Hv, "hv", 1.0 / 1.04_f64.sqrt()),
        (Estimator::H2, "h2", 1.0),
    ] {
        let test = ImpactTest { estimator, ..ImpactTest::default() };
        let (frfs, warned) = impact::frfs(std::slice::from_ref(&measured), &test).unwrap();
        assert!(warned.is_empty(), "{warned:#?}");
        let frf = frfs.iter().find(|r| r.kind == Kind::Frf).unwrap();
        let lines = frf.axis.points(frf.values.len()).unwrap();
        let at = lines.iter().position(|hz| *hz >= 35.0).unwrap();
        let ratio = frf.frf().unwrap()[at] / accelerance(0, 2, lines[at]);
        println!("{name}: {ratio}");
        // Before the next hit 0.2 % of the decay is left.
        assert!((ratio / expected - 1.0).norm() < 5e-3, "{name}: {ratio} for {expected}");

        let document = identified(folder, &["test.npz"], &["--estimator", name, "--band", "10 .. 110 Hz"]);
        let found = &document["modes"];
        assert_eq!(found.as_array().unwrap().len(), 3);
        for (k, mode) in MODES.iter().enumerate() {
            let value = |name: &str, at: usize| {
                let pair = &found[k][name][at];
                Complex64::new(pair[0].as_f64().unwrap(), pair[1].as_f64().unwrap())
            };
            let residue = value("shape", 1) * value("participation", 0);
            let own = Complex64::from(mode.2[1] * mode.2[2]) / (2.0 * Complex64::i() * pole(*mode).im);
            assert!((residue / own / expected - 1.0).norm() < 0.02, "{name}: {residue} for {own}");
        }
    }
}

/// Hits of several files at stated points are averaged; a bounce after a third of a second is one hit's fault
/// and shortens no other block.
#[test]
fn hits_of_several_files() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for k in 0..3u32 {
        let mut pulses = vec![Pulse { at: 0.3, peak: 60.0 }, Pulse { at: 8.3, peak: 70.0 }];
        if k == 1 {
            pulses.push(Pulse { at: 8.63, peak: 50.0 });
        }
        let (force, responses) = impact_record(16.5, 2, &pulses);
        let mut records = channels(force, &responses);
        noisy(&mut records, [1e-3, 2e-3], 10 + k);
        write(folder, &format!("hit_{k}.mat"), records);
    }
    let mut mapping = "[channel.hammer]\nstation = \"P3\"\ndirection = \"y\"\n".to_string();
    for r in 1..=4 {
        mapping += &format!("[channel.y{r}]\nstation = \"P{r}\"\ndirection = \"y\"\n");
    }
    std::fs::write(folder.join("points.toml"), mapping).unwrap();
    let files = ["hit_0.mat", "hit_1.mat", "hit_2.mat"];
    let document = identified(folder, &files, &["--mapping", "points.toml", "--band", "10 .. 110 Hz"]);
    let found = modes(&document);
    assert_eq!(found.len(), 3, "{found:?}");
    for (mode, (hz, zeta)) in MODES.iter().zip(&found) {
        assert!((hz / damped(*mode) - 1.0).abs() < 5e-4 && (zeta / mode.1 - 1.0).abs() < 0.03, "{found:?}");
    }
    let warned = warnings(&document);
    assert!(
        warned[0].starts_with("hit 4 of `hammer` at 8.3") && warned[0].contains("0.328 s after it"),
        "{warned:#?}"
    );
    // Blocks of eight seconds.
    let lines = document["lines"].as_u64().unwrap();
    assert!((780..=803).contains(&lines), "{lines} lines in 100 Hz");
    assert_eq!(document["references"][0], "1:+y", "{}", document["references"]);
}

/// Time records that are no impact test.
#[test]
fn bad_hits_are_reported() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let pulses = [Pulse { at: 0.3, peak: 60.0 }, Pulse { at: 8.3, peak: 70.0 }];
    let (force, responses) = impact_record(16.5, 2, &pulses);
    let good = || channels(force.clone(), &responses[..2]);
    let silent = |r: &mut Record| r.values = Values::Real(vec![0.0; r.values.len()]);
    let random = |r: &mut Record| {
        let mut random = noise(9);
        r.values = Values::Real((0..r.values.len()).map(|_| random()).collect());
    };
    write(folder, "good.npz", good());
    write(folder, "no_force.npz", good().split_off(1));
    let volts = |r: &mut Vec<Record>| (r[0].unit, r[0].file_unit) = ("V".into(), "V".into());
    write(folder, "volts.npz", changed(good(), volts));
    let two = |r: &mut Vec<Record>| r.push(Record { name: "cell".into(), ..r[0].clone() });
    write(folder, "two_forces.npz", changed(good(), two));
    write(folder, "force_only.npz", good().into_iter().take(1).collect());
    write(folder, "silent.npz", changed(good(), |r| silent(&mut r[0])));
    write(folder, "noise.npz", changed(good(), |r| random(&mut r[0])));
    let spoilt = |r: &mut Vec<Record>| {
        if let Values::Real(values) = &mut r[1].values {
            values[700] = f64::NAN;
        }
    };
    write(folder, "nan.npz", changed(good(), spoilt));
    let slow = |r: &mut Vec<Record>| r[2].axis = Axis::uniform(AxisQuantity::Time, 0.0, 1.0 / 2048.0);
    write(folder, "rates.npz", changed(good(), slow));
    let unknown_rate = |r: &mut Vec<Record>| r.iter_mut().for_each(|r| r.axis.points = Points::Unknown);
    write(folder, "no_rate.npz", changed(good(), unknown_rate));
    let (force, responses) = impact_record(8.2, 2, &[pulses[0], Pulse { at: 0.35, peak: 40.0 }]);
    write(folder, "double.npz", channels(force, &responses[..2]));
    let (force, responses) = impact_record(8.2, 2, &pulses[..1]);
    write(folder, "once.npz", channels(force, &responses[..2]));
    let clip = |r: &mut Vec<Record>| {
        if let Values::Real(values) = &mut r[2].values {
            values[(7.0 * RATE) as usize..].iter_mut().for_each(|v| *v = v.clamp(-10.0, 10.0));
        }
    };
    write(folder, "clipped.npz", changed(good(), clip));
    std::fs::write(folder.join("rate.toml"), "rate = \"4096 Hz\"\n").unwrap();
    let cases: Vec<(&str, Vec<&str>, Vec<&str>)> = vec![
        ("all is well", vec!["good.npz"], vec![]),
        ("no force", vec!["no_force.npz"], vec!["--block", "2 s"]),
        ("a force in volts", vec!["volts.npz"], vec![]),
        ("the force named", vec!["volts.npz"], vec!["--force", "hammer"]),
        ("no such force", vec!["volts.npz"], vec!["--force", "hamer"]),
        ("two forces", vec!["two_forces.npz"], vec![]),
        ("a force alone", vec!["force_only.npz"], vec![]),
        ("no hit", vec!["silent.npz"], vec![]),
        ("no hit but noise", vec!["noise.npz"], vec![]),
        ("a value that is no number", vec!["nan.npz"], vec![]),
        ("rates that differ", vec!["rates.npz"], vec![]),
        ("no rate", vec!["no_rate.npz"], vec![]),
        ("the rate given", vec!["no_rate.npz"], vec!["--rate", "4096 Hz"]),
        ("the rate in a mapping", vec!["no_rate.npz"], vec!["--mapping", "rate.toml"]),
        ("a rate without unit", vec!["no_rate.npz"], vec!["--rate", "4096"]),
        ("one hit, a double hit", vec!["double.npz"], vec![]),
        ("one hit", vec!["once.npz"], vec![]),
        ("a response beyond its range", vec!["clipped.npz"], vec![]),
        ("a block longer than the record", vec!["good.npz"], vec!["--block", "20 s"]),
        ("a block of no length", vec!["good.npz"], vec!["--block", "0 s"]),
        ("a block that cuts the decay", vec!["good.npz"], vec!["--block", "0.5 s", "--band", "10 .. 110 Hz"]),
        ("two tests of the same points", vec!["good.npz", "once.npz"], vec![]),
    ];
    insta::assert_snapshot!("bad_hits", outputs_of_cases(folder, &cases));
}

/// A simulated impact test: the stored run of the rig at rest under a hit gives the modes of `modal` that it moves.
#[test]
fn simulated_impact_test() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let text = struck_rig();
    std::fs::write(folder.join("hammer.toml"), &text).unwrap();
    let mut command = rotordyn();
    command.current_dir(folder).args([
        "run-up",
        "hammer.toml",
        "--no-figures",
        "--step",
        "50 us",
        "--out",
        "tap",
    ]);
    command.assert().success();
    // The cage stands where it was placed; `modal` averages over its places, which is 0.4 % at most.
    let machine = model::load("hammer.toml", text, &Options::default()).unwrap().model;
    let assembly = Assembly::new(&machine).unwrap();
    let rest = equilibrium(&machine, &assembly, 0.0, CageTreatment::FixedAngle, None).unwrap();
    let system = LinearSystem::new(&assembly, &rest.tangents(), 0.0).unwrap();
    let own: Vec<Complex64> =
        modal::modes(&assembly, &system, 9).unwrap().iter().map(|m| m.eigenvalue).collect();
    for window in [None, Some("0.5 s")] {
        let mut flags = vec!["--band", "5 .. 300 Hz"];
        flags.extend(window.iter().flat_map(|tau| ["--exponential-window", tau]));
        let document = identified(folder, &["tap/results.h5"], &flags);
        assert_eq!(warnings(&document), Vec::<String>::new());
        let found = modes(&document);
        // The hit along y hardly moves the shaft along itself, nor about.
        assert_eq!(found.len(), 7, "{found:?}");
        let stated = document["modes"].as_array().unwrap();
        let errors = stated.iter().map(|mode| mode["damping_ratio_error"].as_f64().unwrap());
        for ((hz, zeta), error) in found.iter().zip(errors) {
            let off = |pole: &&Complex64| (pole.im / TAU / hz - 1.0).abs();
            let near = own.iter().min_by(|a, b| off(a).total_cmp(&off(b))).unwrap();
            let damping = zeta / (-near.re / near.norm()) - 1.0;
            println!(
                "{hz:.4} Hz off by {:.4} %, damping {zeta:.6} by {:.2} %",
                100.0 * off(&near),
                100.0 * damping
            );
            assert!(off(&near) < 1e-3, "{hz} Hz for {}", near.im / TAU);
            // The hit hardly moves the mode at 44.97 Hz: with the window it states an error of 8 % (and is off by -14 to
            // +4 % with windows of 0.25 to 1 s); all others are known better than 3 %.
            let weak = window.is_some() && (hz - 44.97).abs() < 0.1;
            let allowed = if weak { 0.03_f64.max(error / zeta) } else { 0.03 };
            assert!(damping.abs() < allowed, "{hz} Hz: damping off by {damping}, error {}", error / zeta);
        }
    }
}

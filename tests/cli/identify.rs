//! `identify` command: error messages for files, mappings and flags; results do not depend on threads.

use std::f64::consts::TAU;
use std::path::Path;

use crate::{json_of, rotordyn};
use rotordyn::io::{measured, uff};
use rotordyn::linalg::Complex64;
use rotordyn::signal::record::{Axis, AxisQuantity, Dof, Kind, MeasuredData, Record, Values};

/// Natural frequency \[Hz\], damping ratio, shape of unit modal mass.
pub type Mode = (f64, f64, [f64; 4]);

/// A structure with three modes, measured at four points.
pub const MODES: [Mode; 3] = [
    (21.0, 0.006, [0.5, 0.9, 1.2, 0.3]),
    (48.0, 0.009, [1.1, 0.3, -0.8, 0.6]),
    (83.0, 0.012, [0.7, -1.0, 0.6, -0.9]),
];

/// Pole λ of a mode.
pub fn pole((hz, zeta, _): Mode) -> Complex64 {
    TAU * hz * Complex64::new(-zeta, (1.0 - zeta * zeta).sqrt())
}

/// Accelerance of point `r` for a force at point `e`.
pub fn accelerance(r: usize, e: usize, hz: f64) -> Complex64 {
    let s = Complex64::new(0.0, TAU * hz);
    let one = |mode: &Mode| {
        let pole = pole(*mode);
        s * s * mode.2[r] * mode.2[e] / ((s - pole) * (s - pole.conj()))
    };
    MODES.iter().map(one).sum()
}

/// FRFs of the first three points along y for forces at `references`, 5 to 110 Hz.
pub fn frfs(references: &[usize]) -> Vec<Record> {
    let lines: Vec<f64> = (0..421).map(|k| 5.0 + 0.25 * f64::from(k)).collect();
    let mut out = Vec::new();
    for &e in references {
        for r in 0..3 {
            let values = lines.iter().map(|f| accelerance(r, e, *f)).collect();
            let axis = Axis::uniform(AxisQuantity::Frequency, 5.0, 0.25);
            let name = format!("y{}/f{}", r + 1, e + 1);
            let mut record = Record::new(&name, Kind::Frf, axis, Values::Complex(values), "(m/s^2)/N");
            record.response = Dof::new(r as i64 + 1, 2);
            record.reference = Dof::new(e as i64 + 1, 2);
            out.push(record);
        }
    }
    out
}

/// Adds the coherence of each FRF.
fn with_coherence(frfs: Vec<Record>) -> Vec<Record> {
    let coherence = |frf: &Record| {
        let name = format!("coherence {}", frf.name);
        let values = Values::Real(vec![0.999; frf.values.len()]);
        let record = Record::new(&name, Kind::Coherence, frf.axis.clone(), values, "1");
        Record { response: frf.response, reference: frf.reference, ..record }
    };
    let own: Vec<Record> = frfs.iter().map(coherence).collect();
    frfs.into_iter().chain(own).collect()
}

pub fn changed(mut records: Vec<Record>, change: impl FnOnce(&mut Vec<Record>)) -> Vec<Record> {
    change(&mut records);
    records
}

fn complex(record: &mut Record) -> &mut Vec<Complex64> {
    match &mut record.values {
        Values::Complex(values) => values,
        Values::Real(_) => panic!("{} is real", record.name),
    }
}

pub fn write(folder: &Path, name: &str, records: Vec<Record>) {
    measured::write(&folder.join(name), &MeasuredData { records, ..MeasuredData::default() }).unwrap();
}

/// Uniform random numbers in −1..1.
pub fn noise(seed: u32) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state) / 2f64.powi(31) - 1.0
    }
}

fn cut(folder: &Path, from: &str, to: &str, share: f64) {
    let bytes = std::fs::read(folder.join(from)).unwrap();
    let length = (share * bytes.len() as f64) as usize;
    std::fs::write(folder.join(to), &bytes[..length]).unwrap();
}

/// Exit code and standard error.
fn exit_code_and_stderr(folder: &Path, files: &[&str], flags: &[&str]) -> String {
    let mut command = rotordyn();
    command
        .current_dir(folder)
        .arg("identify")
        .args(files)
        .args(["--no-figures", "--out", "out"])
        .args(flags);
    let output = command.output().unwrap();
    assert!(output.status.success() || output.stdout.is_empty());
    let code = output.status.code().unwrap();
    format!("exit code {code}\n{}", String::from_utf8_lossy(&output.stderr).trim())
}

pub fn outputs_of_cases(folder: &Path, cases: &[(&str, Vec<&str>, Vec<&str>)]) -> String {
    let one = |(name, files, flags): &(&str, Vec<&str>, Vec<&str>)| {
        format!("# {name}\n{}\n", exit_code_and_stderr(folder, files, flags))
    };
    cases.iter().map(one).collect::<Vec<_>>().join("\n")
}

/// Valid and invalid FRF files.
fn frf_files(folder: &Path) {
    let good = || with_coherence(frfs(&[0, 2]));
    write(folder, "good.uff", good());
    write(folder, "bare.uff", frfs(&[0, 2]));
    write(folder, "half.uff", changed(good(), |r| drop(r.pop())));
    write(folder, "one.npz", frfs(&[1]).into_iter().take(1).collect());
    let other_axis = |r: &mut Vec<Record>| r[4].axis = Axis::uniform(AxisQuantity::Frequency, 5.0, 0.5);
    write(folder, "axes.uff", changed(good(), other_axis));
    write(folder, "missing.uff", changed(frfs(&[0, 2]), |r| drop(r.remove(4))));
    write(folder, "double.uff", changed(frfs(&[0]), |r| r[1].response = r[0].response));
    let bare = |r: &mut Record| (r.unit, r.file_unit) = (String::new(), String::new());
    write(folder, "no_unit.npz", changed(frfs(&[0]), |r| r.iter_mut().for_each(bare)));
    write(folder, "unit_of_one.npz", changed(with_coherence(frfs(&[0])), |r| bare(&mut r[0])));
    let strange = |r: &mut Vec<Record>| {
        r[1].unit = String::new();
        r[1].file_unit = "counts/EU".into();
    };
    write(folder, "strange_unit.npz", changed(frfs(&[0]), strange));
    write(folder, "nan.npz", changed(frfs(&[0]), |r| complex(&mut r[2])[130].re = f64::NAN));
    write(folder, "dead.uff", changed(frfs(&[0]), |r| complex(&mut r[1]).fill(Complex64::default())));
    let mut random = noise(1);
    let drown = |r: &mut Vec<Record>| {
        for frf in r.iter_mut() {
            complex(frf).iter_mut().for_each(|h| *h = Complex64::new(random(), random()));
        }
    };
    write(folder, "noise.uff", changed(frfs(&[0]), drown));
    let mut random = noise(2);
    let drown = |r: &mut Vec<Record>| {
        complex(&mut r[1]).iter_mut().for_each(|h| *h = 0.01 * Complex64::new(random(), random()));
    };
    write(folder, "one_of_noise.uff", changed(good(), drown));
    write(folder, "good.mat", good());
    cut(folder, "good.mat", "cut.mat", 0.6);
    cut(folder, "good.uff", "cut.uff", 0.33);
    let binary = uff::Options { binary: true, ..uff::Options::default() };
    uff::write(
        &folder.join("binary.uff"),
        &MeasuredData { records: good(), ..MeasuredData::default() },
        binary,
    )
    .unwrap();
    cut(folder, "binary.uff", "cut_binary.uff", 0.36);
    let psd = Record::new("A", Kind::Psd, frfs(&[0])[0].axis.clone(), Values::Real(vec![1.0; 421]), "");
    write(folder, "psd.uff", vec![psd]);
    std::fs::write(folder.join("empty.uff"), "").unwrap();
    std::fs::write(folder.join("prose.txt"), "Dear colleague,\nthe FRFs follow by post.\n").unwrap();
    for (name, text) in [
        ("no_such_channel.toml", "[channel.\"y1/f4\"]\nstation = \"disc\"\ndirection = \"y\"\n"),
        (
            "direction.toml",
            "[channel.\"y1/f1\"]\nstation = \"disc\"\ndirection = \"up\"\nreference = { station = \"disc\", direction = \"y\" }\n",
        ),
        (
            "unit.toml",
            "[point.1]\nstation = \"disc\"\nunit = \"g/lbf/furlong\"\n[point.3]\nstation = \"B\"\n",
        ),
        ("other_unit.toml", "[point.1]\nstation = \"disc\"\nunit = \"m/N\"\n[point.3]\nstation = \"B\"\n"),
        (
            "own_unit.toml",
            "[point.1]\nstation = \"1\"\nunit = \"(m/s^2)/N\"\n[point.2]\nstation = \"2\"\n[point.3]\nstation = \"3\"\n",
        ),
        ("point.toml", "[point.7]\nstation = \"disc\"\n"),
        ("some.toml", "[point.1]\nstation = \"disc\"\n[point.3]\nstation = \"B\"\n"),
        ("none.toml", ""),
        ("syntax.toml", "[channel.y1]\nplace = \"disc\"\n"),
        ("station.toml", "[point.1]\nstation = \"dics\"\n[point.3]\nstation = \"B\"\n"),
    ] {
        std::fs::write(folder.join(name), text).unwrap();
    }
}

#[test]
fn bad_frfs_are_reported() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    frf_files(folder);
    let model = concat!(env!("CARGO_MANIFEST_DIR"), "/models/overhung_rig.toml");
    let cases: Vec<(&str, Vec<&str>, Vec<&str>)> = vec![
        ("all is well", vec!["good.uff"], vec![]),
        ("no coherence", vec!["bare.uff"], vec![]),
        ("coherence of some", vec!["half.uff"], vec![]),
        ("one FRF", vec!["one.npz"], vec![]),
        ("frequencies that differ", vec!["axes.uff"], vec![]),
        ("frequencies that differ between files", vec!["good.uff", "axes.uff"], vec![]),
        ("an FRF missing", vec!["missing.uff"], vec![]),
        ("an FRF twice", vec!["double.uff"], vec![]),
        ("the same file twice", vec!["bare.uff", "bare.uff"], vec![]),
        ("no unit", vec!["no_unit.npz"], vec![]),
        ("a unit of one that is not known", vec!["strange_unit.npz"], vec![]),
        ("the quantity given", vec!["no_unit.npz"], vec!["--quantity", "mobility"]),
        ("no such quantity", vec!["good.uff"], vec!["--quantity", "receptence"]),
        ("a value that is no number", vec!["nan.npz"], vec![]),
        ("a dead channel", vec!["dead.uff"], vec![]),
        ("a channel of noise", vec!["one_of_noise.uff"], vec![]),
        ("noise alone", vec!["noise.uff"], vec!["--band", "10 .. 100 Hz"]),
        ("no mode in the band", vec!["good.uff"], vec!["--band", "55 .. 70 Hz"]),
        ("few lines", vec!["good.uff"], vec!["--band", "47 .. 49 Hz"]),
        (
            "an order that needs more lines",
            vec!["good.uff"],
            vec!["--band", "40 .. 60 Hz", "--max-order", "60"],
        ),
        ("an order too low", vec!["good.uff"], vec!["--max-order", "4"]),
        ("a band beside the lines", vec!["good.uff"], vec!["--band", "200 .. 300 Hz"]),
        ("a band the wrong way", vec!["good.uff"], vec!["--band", "90 Hz .. 10 Hz"]),
        ("a band without unit", vec!["good.uff"], vec!["--band", "10, 90"]),
        ("a band of one end", vec!["good.uff"], vec!["--band", "90 Hz"]),
        ("a window without unit", vec!["good.uff"], vec!["--exponential-window", "0.5"]),
        ("a window that is not that of the test", vec!["good.uff"], vec!["--exponential-window", "0.5 s"]),
        ("flags of time records", vec!["good.uff"], vec!["--force", "f1", "--estimator", "h2"]),
        ("no such estimator", vec!["good.uff"], vec!["--estimator", "h3"]),
        ("cut off", vec!["cut.uff"], vec![]),
        ("cut off in binary data", vec!["cut_binary.uff"], vec![]),
        ("cut off .mat", vec!["cut.mat"], vec![]),
        ("no FRF", vec!["psd.uff"], vec![]),
        ("an empty file", vec!["empty.uff"], vec![]),
        ("no file", vec!["nowhere.uff"], vec![]),
        ("text", vec!["prose.txt"], vec![]),
        ("mapping: no such channel", vec!["good.uff"], vec!["--mapping", "no_such_channel.toml"]),
        ("mapping: no such point", vec!["good.uff"], vec!["--mapping", "point.toml"]),
        ("mapping: no such direction", vec!["good.uff"], vec!["--mapping", "direction.toml"]),
        ("mapping: no such unit", vec!["no_unit.npz"], vec!["--mapping", "unit.toml"]),
        ("mapping: the unit of one", vec!["unit_of_one.npz"], vec!["--mapping", "own_unit.toml"]),
        ("mapping: another unit than the file", vec!["good.uff"], vec!["--mapping", "other_unit.toml"]),
        ("mapping of some points", vec!["good.uff"], vec!["--mapping", "some.toml"]),
        ("mapping of nothing", vec!["good.uff"], vec!["--mapping", "none.toml"]),
        ("mapping: not as described", vec!["good.uff"], vec!["--mapping", "syntax.toml"]),
        ("mapping: no such station", vec!["good.uff"], vec!["--mapping", "station.toml", "--model", model]),
        ("no mapping file", vec!["good.uff"], vec!["--mapping", "nowhere.toml"]),
    ];
    insta::assert_snapshot!("bad_frfs", outputs_of_cases(folder, &cases));
}

/// Peaks of force over motion are antiresonances.
#[test]
fn dynamic_stiffness_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let model = concat!(env!("CARGO_MANIFEST_DIR"), "/models/overhung_rig.toml");
    for unit in ["N/m", "N/(m/s^2)"] {
        let of_unit = changed(frfs(&[0]), |all| all.iter_mut().for_each(|frf| frf.unit = unit.into()));
        write(folder, "stiffness.uff", of_unit);
        let commands: [&[&str]; 3] = [
            &["identify", "stiffness.uff"],
            &["validate", model, "--measured", "stiffness.uff"],
            &["update", model, "--measured", "stiffness.uff", "--free", "housing.*.k_x"],
        ];
        for command in commands {
            let output = rotordyn().current_dir(folder).args(command).output().unwrap();
            let text = String::from_utf8_lossy(&output.stderr).into_owned();
            assert!(!output.status.success(), "{command:?}");
            assert!(text.contains("force over motion") && text.contains("reciprocal"), "{command:?}: {text}");
            assert!(!text.contains("have no unit"), "{text}");
        }
    }
}

/// Results are the same to the byte whatever the number of threads.
#[test]
fn results_do_not_depend_on_threads() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let lines: Vec<f64> = (0..421).map(|k| 5.0 + 0.25 * f64::from(k)).collect();
    let mut random = noise(4);
    let mut records = Vec::new();
    for e in 0..3 {
        for r in 0..4 {
            let value = |f: &f64| accelerance(r, e, *f) + 0.02 * Complex64::new(random(), random());
            let values = Values::Complex(lines.iter().map(value).collect());
            let axis = Axis::uniform(AxisQuantity::Frequency, 5.0, 0.25);
            let mut record = Record::new(&format!("y{r}/f{e}"), Kind::Frf, axis, values, "(m/s^2)/N");
            (record.response, record.reference) = (Dof::new(r as i64 + 1, 2), Dof::new(e as i64 + 1, 2));
            records.push(record);
        }
    }
    write(folder, "twelve.uff", records);
    let run = |threads: &str| {
        let out = folder.join(format!("out_{threads}"));
        let mut command = rotordyn();
        command.current_dir(folder).env("RAYON_NUM_THREADS", threads);
        command.args(["identify", "twelve.uff", "--no-figures", "--out"]).arg(&out);
        let mut document = json_of(&mut command);
        for own in ["seconds", "files"] {
            document.as_object_mut().unwrap().remove(own).unwrap();
        }
        let bytes = |name: &str| std::fs::read(out.join(name)).unwrap();
        (document, bytes("results.h5"), bytes("modes.uff"))
    };
    let (one, two, three) = (run("1"), run("2"), run("3"));
    assert_eq!(one.0["modes"].as_array().unwrap().len(), 3);
    for other in [&two, &three] {
        assert_eq!(one.0, other.0);
        assert!(one.1 == other.1, "results.h5 differs");
        assert!(one.2 == other.2, "modes.uff differs");
    }
}

/// A hammer that moves over four points with one sensor: named in the output, and not if the sensor moves.
#[test]
fn a_roving_hammer_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let of = |hammer: &[usize]| frfs(hammer).into_iter().filter(|frf| frf.response.node == 2).collect();
    write(folder, "hammer.uff", of(&[0, 1, 2, 3]));
    write(folder, "sensor.uff", frfs(&[1]));
    let output = |file: &str| {
        let mut command = rotordyn();
        let output = command.current_dir(folder).args(["identify", file, "--no-figures"]).output().unwrap();
        assert!(output.status.success());
        String::from_utf8(output.stdout).unwrap()
    };
    let named = "Roving hammer: 4 references, 1 response; mode shapes are over the references.";
    assert!(output("hammer.uff").contains(named));
    assert!(!output("sensor.uff").contains("Roving hammer"));
}

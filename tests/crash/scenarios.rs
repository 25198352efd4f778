//! Commands that write results, and what they find in their folder.

use crate::{MODEL, SHORT, rotordyn};
use rotordyn::io::measured;
use rotordyn::linalg::Complex64;
use rotordyn::signal::record::{Axis, AxisQuantity, Dof, Kind, MeasuredData, Record, Values};
use std::f64::consts::TAU;
use std::path::Path;
use std::process::Command;

/// A command on a folder.
pub struct Scenario {
    pub name: &'static str,
    /// Makes what the command finds.
    pub prepare: fn(&Path),
    pub command: fn(&Path) -> Command,
    /// Files that must afterwards be as before or as the command writes them, with the folder's other files.
    pub whole: &'static [&'static str],
}

pub const ALL: [Scenario; 6] = [
    Scenario { name: "fresh run", prepare: |_| {}, command: run, whole: &["out/results.h5"] },
    Scenario {
        name: "run over finished results",
        prepare: finished_results,
        command: rerun,
        whole: &["out/results.h5"],
    },
    Scenario {
        name: "modal added to a run",
        prepare: finished_results,
        command: modal,
        whole: &["out/results.h5"],
    },
    Scenario { name: "bifurcation", prepare: |_| {}, command: bifurcation, whole: &["out/results.h5"] },
    Scenario {
        name: "identify",
        prepare: identified,
        command: identify,
        whole: &["out/results.h5", "out/modes.uff"],
    },
    Scenario {
        name: "update over the model itself",
        prepare: own_model,
        command: update,
        whole: &["model.toml", "out/update.h5"],
    },
];

/// Runs a command that must succeed.
pub fn succeed(mut command: Command) -> String {
    let output = command.output().unwrap();
    assert!(output.status.success(), "{command:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

pub fn run(folder: &Path) -> Command {
    let mut command = rotordyn();
    command.args(["run", MODEL, "--no-figures", "--out"]).arg(folder.join("out")).args(SHORT);
    command
}

/// The same run of a heavier disc.
pub fn rerun(folder: &Path) -> Command {
    let mut command = run(folder);
    command.args(["--set", "disc.main.thickness=25 mm"]);
    command
}

pub fn finished_results(folder: &Path) {
    succeed(run(folder));
}

fn modal(folder: &Path) -> Command {
    let mut command = rotordyn();
    command.args(["modal", MODEL, "--no-figures", "--modes", "4", "--out"]).arg(folder.join("out"));
    command.args(SHORT);
    command
}

fn bifurcation(folder: &Path) -> Command {
    let mut command = rotordyn();
    command.args(["bifurcation", "models/varying_compliance.toml", "--no-figures", "--out"]);
    command.arg(folder.join("out")).args(["--from", "1600 rpm", "--to", "1700 rpm", "--count", "2"]);
    command.args(["--transient-periods", "10", "--periods", "8"]);
    command
}

/// Accelerance of three points of a structure with two modes.
fn measure(folder: &Path) {
    let lines: Vec<f64> = (0..221).map(|k| 5.0 + 0.5 * f64::from(k)).collect();
    let modes = [(30.0, 0.01, [0.5, 1.0, 0.7]), (80.0, 0.012, [1.0, -0.4, -0.8])];
    let value = |r: usize, hz: f64| -> Complex64 {
        let s = Complex64::new(0.0, TAU * hz);
        let one = |(own, zeta, shape): &(f64, f64, [f64; 3])| {
            let omega = TAU * own;
            s * s * shape[r] * shape[0] / (s * s + 2.0 * zeta * omega * s + omega * omega)
        };
        modes.iter().map(one).sum()
    };
    let record = |r: usize| {
        let values = Values::Complex(lines.iter().map(|hz| value(r, *hz)).collect());
        let axis = Axis::uniform(AxisQuantity::Frequency, 5.0, 0.5);
        let mut record = Record::new(&format!("y{}/f1", r + 1), Kind::Frf, axis, values, "(m/s^2)/N");
        record.response = Dof::new(r as i64 + 1, 2);
        record.reference = Dof::new(1, 2);
        record
    };
    let measured = MeasuredData { records: (0..3).map(record).collect(), ..MeasuredData::default() };
    measured::write(&folder.join("frf.uff"), &measured).unwrap();
}

fn identified(folder: &Path) {
    measure(folder);
    let mut command = identify(folder);
    command.args(["--max-order", "8"]);
    succeed(command);
}

fn identify(folder: &Path) -> Command {
    let mut command = rotordyn();
    command.arg("identify").arg(folder.join("frf.uff")).args(["--no-figures", "--out"]);
    command.arg(folder.join("out"));
    command
}

/// A model that is to be overwritten, and the modes of one with other bearings.
fn own_model(folder: &Path) {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join(MODEL);
    std::fs::copy(source, folder.join("model.toml")).unwrap();
    let mut truth = rotordyn();
    truth.arg("modal").arg(folder.join("model.toml")).args(["--no-figures", "--speed", "0 rpm", "--out"]);
    truth.arg(folder.join("truth")).args(["--set", "disc.main.thickness=22 mm"]);
    succeed(truth);
}

fn update(folder: &Path) -> Command {
    let mut command = rotordyn();
    command.arg("update").arg(folder.join("model.toml")).args(["--no-figures", "--free"]);
    command.args(["disc.main.thickness", "--measured"]).arg(folder.join("truth/results.h5"));
    command.arg("--write").arg(folder.join("model.toml")).arg("--out").arg(folder.join("out"));
    command
}

//! Forecast of steps, time and file size: absurd requests are refused before anything is computed.

use crate::{json_of, output_of, rotordyn};
use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};

/// A shaft on two springs with a disc and a ball bearing, each with other settings than the shipped models.
const MACHINE: &str = r#"[model]
name = "machine"
[material.steel]
young = "200 GPa"
poisson = 0.3
density = "7800 kg/m^3"
[shaft]
material = "steel"
element_length = "100 mm"
section = [{ length = "500 mm", outer_diameter = "30 mm" }]
[station]
A = "0 mm"
B = "400 mm"
C = "500 mm"
[disc.wheel]
station = "C"
mass = "3 kg"
polar_inertia = "8e-3 kg m^2"
diametral_inertia = "4e-3 kg m^2"
[bearing.A]
station = "A"
model = "linear"
k_xx = "3e7 N/m"
k_yy = "3e7 N/m"
k_zz = "3e7 N/m"
c_xx = "900 N s/m"
c_yy = "900 N s/m"
[bearing.B]
station = "B"
model = "linear"
k_xx = "3e7 N/m"
k_yy = "3e7 N/m"
c_xx = "900 N s/m"
c_yy = "900 N s/m"
[unbalance.wheel]
station = "C"
magnitude = "40 g mm"
[drive]
kind = "prescribed"
station = "A"
[speed]
profile = "ramp"
ramp = "0.37 s"
to = "1500 rpm"
[probe.x]
at = "disc.wheel"
direction = "x"
[probe.y]
at = "disc.wheel"
direction = "y"
[study.run_up]
integrator = "newmark"
step = "70 us"
sample_rate = "3 kHz"
cutoff = "2 kHz"
[study.poincare]
speed = "1100 rpm"
transient_periods = 30
periods = 12
transient_limit = 0
step = "90 us"
cutoff = "2 kHz"
[study.frf]
frequencies = { from = "1 Hz", to = "100 Hz", count = 57 }
[study.frf.excitation.wheel]
at = "disc.wheel"
direction = "x"
"#;

struct Case {
    folder: tempfile::TempDir,
}

impl Case {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("machine.toml"), MACHINE).unwrap();
        Self { folder }
    }

    fn command(&self, name: &str, flags: &[&str]) -> assert_cmd::Command {
        let mut command = rotordyn();
        command.arg(name).arg(self.folder.path().join("machine.toml"));
        if name != "check" {
            command.args(["--no-figures", "--out"]).arg(self.folder.path().join("out"));
        }
        command.args(flags);
        command
    }

    /// Messages of a request that must be refused with this exit code, before a results folder exists.
    fn refused(&self, name: &str, flags: &[&str], code: i32) -> String {
        let output = self.command(name, flags).assert().code(code).get_output().clone();
        assert!(!self.folder.path().join("out").exists(), "{flags:?} has written a file");
        String::from_utf8(output.stderr).unwrap()
    }
}

#[test]
fn impossible_steps_and_rates_are_refused_by_key() {
    let case = Case::new();
    for (command, flags, parts) in [
        ("run-up", ["--step", "1e-30 s"], ["study.run_up.step", "below the round-off of the time"]),
        ("run-up", ["--step", "2e-13 s"], ["study.run_up.step", "steps in 0.37"]),
        ("run-up", ["--sample-rate", "1e12 Hz"], ["study.run_up.sample_rate", "samples in 0.37 s"]),
        (
            "run",
            ["--set", "study.run_up.sample_rate=\"4e10 Hz\""],
            ["study.run_up.sample_rate", "lower sample_rate"],
        ),
        ("run-up", ["--set", "speed.ramp=\"1e9 s\""], ["study.run_up.sample_rate", "shorten the run"]),
        ("poincare", ["--step", "1e-25 s"], ["study.poincare.step", "below the round-off"]),
        ("poincare", ["--step", "1e-13 s"], ["study.poincare.step", "raise step"]),
        ("lyapunov", ["--step", "1e-14 s"], ["study.lyapunov.step", "raise step"]),
        ("frf", ["--noise=40 dB", "--averages=100000000000"], ["--averages", "1000000"]),
        ("check", ["--set", "study.run_up.step=\"1e-20 s\""], ["study.run_up.step", "raise step"]),
    ] {
        let text = case.refused(command, &flags, 2);
        for part in parts {
            assert!(text.contains(part), "{command} {flags:?}: {part} is not in\n{text}");
        }
    }
}

/// Free bytes of a folder's file system, by df.
fn free_bytes(folder: &std::path::Path) -> f64 {
    let output = Command::new("df").args(["-P", "-k"]).arg(folder).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    text.lines().nth(1).unwrap().split_whitespace().nth(3).unwrap().parse::<f64>().unwrap() * 1024.0
}

/// 1e10 samples, the most that is accepted, of 21 channels: 1.7 TB.
#[test]
fn results_beyond_the_free_disk_are_refused() {
    let case = Case::new();
    if free_bytes(case.folder.path()) > 1.6e12 {
        println!("skipped: more than 1.6 TB are free");
        return;
    }
    let text = case.refused("run-up", &["--sample-rate", "2.6e10 Hz"], 4);
    for part in ["run-up would write 1.6", "TB", "are free", "study.run_up: step, sample_rate"] {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
}

/// The forecast of `check` is the work done.
#[test]
fn forecast_is_the_work_done() {
    let case = Case::new();
    let check = json_of(&mut case.command("check", &[]));
    let forecast = |study: &str, key: &str| {
        let all = check["variants"][0]["forecast"].as_array().unwrap();
        all.iter().find(|f| f["study"] == study).unwrap_or_else(|| panic!("{study}: {check}"))[key]
            .as_f64()
            .unwrap()
    };
    let run = json_of(&mut case.command("run-up", &[]));
    let steps = run["run_up"]["steps"].as_f64().unwrap();
    // The forecast counts the steps of the first sample too: five.
    assert!(
        (forecast("run-up", "count") - steps - 5.0).abs() < 0.5,
        "{} for {steps}",
        forecast("run-up", "count")
    );
    let size = std::fs::metadata(case.folder.path().join("out/results.h5")).unwrap().len() as f64;
    let bytes = forecast("run-up", "bytes");
    // Channels of 1111 samples, written in chunks of 4096 with lossless compression.
    assert_eq!(bytes, 8.0 * 1111.0 * (11.0 + 2.0 + 2.0 * 4.0));
    assert!(size > 0.2 * bytes && size < 2.0 * bytes + 3e5, "{size} bytes, {bytes} forecast");
    // 60/1100 s by 90 us: 607 steps a revolution.
    assert_eq!(forecast("poincare", "count"), 42.0 * 607.0);
    assert_eq!(forecast("frf", "count"), 57.0);
    assert_eq!(forecast("frf", "bytes"), 57.0 * 2.0 * 16.0);
    let text = output_of(&mut case.command("check", &[]));
    assert!(text.contains("Forecast of the studies") && text.contains("poincare"), "{text}");
}

/// A run of hours is announced at its start, a plausible one is not.
#[test]
fn long_runs_are_announced() {
    let case = Case::new();
    let plausible = case.command("run-up", &[]).assert().success().get_output().clone();
    assert!(!String::from_utf8(plausible.stderr).unwrap().contains("takes about"));
    for (command, flags) in [("run-up", ["--step", "1e-12 s"]), ("lyapunov", ["--step", "1e-9 s"])] {
        let mut child = Command::new(assert_cmd::cargo::cargo_bin("rotordyn"))
            .args([command, "machine.toml", "--no-figures", "--out", command])
            .args(flags)
            .current_dir(case.folder.path())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut line = String::new();
        BufReader::new(child.stderr.take().unwrap()).read_line(&mut line).unwrap();
        child.kill().unwrap();
        child.wait().unwrap();
        assert!(line.contains("the computation takes about") && line.contains("steps of"), "{line}");
        assert!(line.contains("hours") || line.contains("days"), "{line}");
    }
}

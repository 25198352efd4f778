//! Runs stopped at random moments by SIGKILL and SIGTERM, resumed each time, end in the results of a run never stopped.
//!
//! `ROTORDYN_STOPS` sets how often each run is stopped.

use crate::{output_of, rotordyn};
use rotordyn::io::hdf5::{ObjectKind, Store};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Stops of a run without `ROTORDYN_STOPS`.
const STOPS: usize = 4;
/// Longest wait for a checkpoint on a busy machine.
const PATIENCE: Duration = Duration::from_secs(120);

/// A run that takes some seconds, with many checkpoints.
struct Case {
    name: &'static str,
    command: &'static [&'static str],
}

const RUN_UP: Case = Case {
    name: "run-up",
    command: &[
        "run-up",
        "models/overhung_rig.toml",
        "--motion-rate",
        "50 Hz",
        "--set",
        "speed.settle=\"0.1 s\"",
        "--set",
        "speed.ramp=\"4 s\"",
        "--set",
        "speed.hold=\"0.5 s\"",
        "--set",
        "study.orders.channels=[\"B_ax\"]",
        "--set",
        "study.spectrogram.channels=[\"B_ax\"]",
    ],
};

const POINCARE: Case = Case {
    name: "poincare",
    command: &[
        "poincare",
        "models/varying_compliance.toml",
        "--speed",
        "2300 rpm",
        "--transient-periods",
        "1000",
        "--periods",
        "2000",
    ],
};

const LYAPUNOV: Case = Case {
    name: "lyapunov",
    command: &[
        "lyapunov",
        "models/varying_compliance.toml",
        "--speed",
        "2300 rpm",
        "--transient-periods",
        "500",
        "--periods",
        "1500",
    ],
};

const BIFURCATION: Case = Case {
    name: "bifurcation",
    command: &[
        "bifurcation",
        "models/varying_compliance.toml",
        "--from",
        "2000 rpm",
        "--to",
        "2600 rpm",
        "--count",
        "24",
        "--transient-periods",
        "60",
        "--periods",
        "40",
        "--lyapunov",
    ],
};

impl Case {
    fn start(&self, folder: &Path, flags: &[&str]) -> Command {
        let mut command = Command::new(assert_cmd::cargo::cargo_bin("rotordyn"));
        command.args(self.command).arg("--no-figures").args(flags).arg("--out").arg(folder);
        command.current_dir(env!("CARGO_MANIFEST_DIR")).stdout(Stdio::null()).stderr(Stdio::piped());
        command
    }

    /// Resumes it, stops it by a signal at a random moment; its messages if it was stopped.
    fn stop_once(&self, folder: &Path, random: &mut Random, stop: usize) -> Option<String> {
        let flags = ["--resume", "--checkpoint", "5 ms"];
        let begun = Instant::now();
        let before = modified(folder);
        let mut child = self.start(folder, &flags).spawn().unwrap();
        // Anywhere, or some time after the next checkpoint.
        if stop % 4 != 3 {
            while modified(folder) == before && child.try_wait().unwrap().is_none() {
                assert!(begun.elapsed() < PATIENCE, "{}: no checkpoint", self.name);
                std::thread::sleep(Duration::from_millis(1));
            }
        }
        std::thread::sleep(Duration::from_millis(random.below(150)));
        signal(&mut child, if stop.is_multiple_of(2) { "KILL" } else { "TERM" });
        let output = child.wait_with_output().unwrap();
        let messages = String::from_utf8_lossy(&output.stderr).into_owned();
        match output.status.code() {
            Some(0) => None,
            None | Some(143) => Some(messages),
            Some(code) => panic!("{}: exit code {code}\n{messages}", self.name),
        }
    }

    fn equals_a_run_that_was_never_stopped(&self) {
        let stops = std::env::var("ROTORDYN_STOPS").ok().and_then(|text| text.parse().ok()).unwrap_or(STOPS);
        let [whole, stopped] = [(), ()].map(|()| tempfile::tempdir().unwrap());
        let output = self.start(whole.path(), &["--checkpoint", "off"]).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let mut random = Random(self.name.len() as u64);
        let (mut taken, mut places) = (0, Vec::new());
        for stop in 0..stops {
            let Some(messages) = self.stop_once(stopped.path(), &mut random, stop) else { break };
            taken += 1;
            places.extend(
                messages.lines().find_map(|line| line.split_once("goes on from ")).map(|p| p.1.to_string()),
            );
        }
        let output = self.start(stopped.path(), &["--resume"]).output().unwrap();
        let messages = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "{messages}");
        println!("{}: stopped {taken} times, went on from {places:?}", self.name);
        assert!(taken > 0 && messages.contains("goes on from"), "{messages}");
        assert_eq!(files(stopped.path()), files(whole.path()));
        let [a, b] = [&whole, &stopped].map(|folder| Store::open(folder.path().join("results.h5")).unwrap());
        let compared = compare(&a, &b, "");
        println!("{}: {compared} data sets are equal", self.name);
        assert!(compared > 5);
    }
}

/// Numbers that are the same in every run of the test (splitmix64).
struct Random(u64);

impl Random {
    fn below(&mut self, limit: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) % limit
    }
}

fn modified(folder: &Path) -> Option<std::time::SystemTime> {
    std::fs::metadata(folder.join("checkpoint.bin")).and_then(|found| found.modified()).ok()
}

fn signal(child: &mut Child, name: &str) {
    let mut kill = Command::new("kill");
    kill.arg(format!("-{name}")).arg(child.id().to_string()).stderr(Stdio::null());
    // It may have ended by itself.
    let _ = kill.status();
}

/// Names of the files of a folder, but for those that a killed program left.
fn files(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name());
    let mut names: Vec<String> = entries.map(|name| name.into_string().unwrap()).collect();
    // Finished results of a stopped run, and temporary and lock files.
    names.retain(|name| !name.starts_with('.') && !name.contains("previous"));
    names.sort();
    names
}

/// Compares all data sets below a group bit by bit; their number.
fn compare(a: &Store, b: &Store, group: &str) -> usize {
    let members = a.members(if group.is_empty() { "/" } else { group }).unwrap();
    assert_eq!(members, b.members(if group.is_empty() { "/" } else { group }).unwrap(), "{group}");
    let mut compared = 0;
    for name in members {
        let path = format!("{group}/{name}");
        let bits =
            |store: &Store| store.read(&path).unwrap().data.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
        match a.object_kind(&path).unwrap() {
            ObjectKind::Group => {
                compared += compare(a, b, &path);
                continue;
            }
            ObjectKind::Real(_) => assert_eq!(bits(a), bits(b), "{path}"),
            ObjectKind::Text(_) => {
                assert_eq!(a.read_texts(&path).unwrap(), b.read_texts(&path).unwrap(), "{path}");
            }
            ObjectKind::Complex(_) => {
                let complex = |store: &Store| {
                    let read = store.read_complex(&path).unwrap().data.into_iter();
                    read.map(|v| [v.re.to_bits(), v.im.to_bits()]).collect::<Vec<_>>()
                };
                assert_eq!(complex(a), complex(b), "{path}");
            }
            other => panic!("{path}: {other:?}"),
        }
        compared += 1;
    }
    compared
}

#[test]
fn a_stopped_run_up_is_resumed_to_the_same_bits() {
    RUN_UP.equals_a_run_that_was_never_stopped();
}

#[test]
fn a_stopped_poincare_section_is_resumed_to_the_same_bits() {
    POINCARE.equals_a_run_that_was_never_stopped();
}

#[test]
fn a_stopped_lyapunov_exponent_is_resumed_to_the_same_bits() {
    LYAPUNOV.equals_a_run_that_was_never_stopped();
}

#[test]
fn a_stopped_bifurcation_diagram_is_resumed_to_the_same_bits() {
    BIFURCATION.equals_a_run_that_was_never_stopped();
}

/// A folder with the checkpoint of a run that was stopped by SIGTERM.
fn stopped(case: &Case, folder: &Path) -> PathBuf {
    let mut child = case.start(folder, &["--checkpoint", "5 ms"]).spawn().unwrap();
    let begun = Instant::now();
    while modified(folder).is_none() {
        assert!(begun.elapsed() < PATIENCE, "no checkpoint");
        std::thread::sleep(Duration::from_millis(5));
    }
    signal(&mut child, "TERM");
    assert_eq!(child.wait().unwrap().code(), Some(143));
    folder.join("checkpoint.bin")
}

/// A changed model, setting or command is refused with what differs; the checkpoint stays.
#[test]
fn another_run_is_not_resumed() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let model = folder.path().join("machine.toml");
    let text = std::fs::read_to_string("models/varying_compliance.toml").unwrap();
    std::fs::write(&model, &text).unwrap();
    let flags = ["--speed", "2300 rpm", "--periods", "20000", "--no-figures"];
    let lyapunov = |flags: &[&str]| {
        let mut command = rotordyn();
        command.arg("lyapunov").arg(&model).arg("--out").arg(&out).args(flags);
        command
    };
    let mut child = Command::new(assert_cmd::cargo::cargo_bin("rotordyn"));
    let child = child.arg("lyapunov").arg(&model).arg("--out").arg(&out).args(flags);
    let mut child =
        child.args(["--checkpoint", "5 ms"]).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let begun = Instant::now();
    while modified(&out).is_none() {
        assert!(begun.elapsed() < PATIENCE, "no checkpoint");
        std::thread::sleep(Duration::from_millis(5));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let checkpoint = std::fs::read(out.join("checkpoint.bin")).unwrap();

    let refused = |command: &mut assert_cmd::Command, parts: &[&str]| {
        let output = command.arg("--resume").assert().code(2).get_output().clone();
        let message = String::from_utf8(output.stderr).unwrap();
        for part in parts {
            assert!(message.contains(part), "{part} is not in\n{message}");
        }
        assert_eq!(std::fs::read(out.join("checkpoint.bin")).unwrap(), checkpoint);
    };
    let speed = ["--speed", "2400 rpm", "--periods", "20000", "--no-figures"];
    let was = "study.lyapunov.speed was \"2300 rpm\", is \"2400 rpm\"";
    refused(&mut lyapunov(&speed), &["belongs to another run", was, "start afresh without --resume"]);
    refused(&mut lyapunov(&flags[2..]), &["study.lyapunov.speed was \"2300 rpm\", is not set"]);
    let mut poincare = rotordyn();
    refused(
        poincare.arg("poincare").arg(&model).arg("--out").arg(&out).args(flags),
        &["the command was `lyapunov`, is `poincare`"],
    );
    std::fs::write(&model, text.replacen("title = ", "title = \"other\" # ", 1)).unwrap();
    refused(&mut lyapunov(&flags), &["the model file has changed:", "- line", "+ line", "title"]);
    std::fs::write(&model, &text).unwrap();

    // A damaged checkpoint is no run.
    let mut damaged = checkpoint.clone();
    let middle = damaged.len() / 2;
    damaged[middle] ^= 1;
    std::fs::write(out.join("checkpoint.bin"), damaged).unwrap();
    let output = lyapunov(&flags).arg("--resume").assert().code(2).get_output().clone();
    let message = String::from_utf8(output.stderr).unwrap();
    assert!(message.contains("damaged") && message.contains("start afresh"), "{message}");
}

/// Without a checkpoint a run starts afresh and says so; the place where one went on is in the JSON document.
#[test]
fn what_is_resumed_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let short = ["--transient-periods", "20", "--periods", "20", "--no-figures", "--speed", "1600 rpm"];
    let run = |flags: &[&str]| {
        let mut command = rotordyn();
        command.args(["poincare", "models/varying_compliance.toml", "--json", "--out"]).arg(folder.path());
        let output = command.args(short).args(flags).assert().success().get_output().clone();
        let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        (document["checkpoints"].clone(), String::from_utf8(output.stderr).unwrap())
    };
    let (found, messages) = run(&["--resume"]);
    assert!(messages.contains("nothing to resume"), "{messages}");
    assert!(found["resumed_from"].is_null() && found["written"] == 0, "{found}");
    assert!(run(&["--checkpoint", "0 s"]).0["written"].as_u64().unwrap() > 10);
    assert_eq!(run(&["--checkpoint", "off"]).0["written"], 0);
    // A run that ended leaves no checkpoint.
    assert!(!folder.path().join("checkpoint.bin").exists());
    let text = output_of(rotordyn().args(["run", "--help"]));
    assert!(text.contains("--resume") && text.contains("--checkpoint"), "{text}");
    let wrong = rotordyn().args(["run", "models/jeffcott.toml", "--checkpoint", "5"]).assert().code(2);
    let message = String::from_utf8(wrong.get_output().stderr.clone()).unwrap();
    assert!(message.contains("or off"), "{message}");
}

/// Periods recorded before a signal are kept, and say that they are not all.
#[test]
fn partial_results_of_a_stopped_run_are_kept_and_marked() {
    let folder = tempfile::tempdir().unwrap();
    let long = Case {
        name: "poincare",
        command: &[
            "poincare",
            "models/varying_compliance.toml",
            "--speed",
            "2300 rpm",
            "--transient-periods",
            "10",
            "--periods",
            "100000",
        ],
    };
    let mut command = long.start(folder.path(), &["--checkpoint", "100 ms", "--json"]);
    let mut child = command.stdout(Stdio::piped()).spawn().unwrap();
    let begun = Instant::now();
    while modified(folder.path()).is_none() {
        assert!(begun.elapsed() < PATIENCE, "no checkpoint");
        std::thread::sleep(Duration::from_millis(5));
    }
    std::thread::sleep(Duration::from_millis(300));
    signal(&mut child, "TERM");
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(143));
    let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let partial = &document["poincare"]["partial"];
    let recorded = partial["recorded"].as_u64().unwrap();
    assert!((8..100_000).contains(&recorded) && partial["requested"] == 100_000, "{partial}");
    let messages = String::from_utf8(output.stderr).unwrap();
    assert!(messages.contains(&format!("stopped after {recorded} of 100000 periods")), "{messages}");
    let store = Store::open(folder.path().join("results.h5")).unwrap();
    assert_eq!(store.read("/poincare/x_y/section_x").unwrap().data.len() as u64, recorded);
    assert!(store.contains("/poincare/partial"));
    assert!(stopped(&LYAPUNOV, &folder.path().join("lyapunov")).exists());
}

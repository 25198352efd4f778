//! Files made to harm: refused with exit code 2, or read with what was left out named; each within a second of computing
//! time and 200 MB of memory, the process that reads HDF5 included.
#![cfg(unix)]

mod archives;
mod hdf5_files;
mod hdf5_results;
mod matlab;
mod matlab_73;
mod models;
mod rotors;
mod tables;
mod universal;
mod wav_files;

use std::path::Path;
use std::process::{Command, Stdio};
use wait4::Wait4;

/// What the program did with a file.
struct Outcome {
    code: Option<i32>,
    /// Standard error.
    reported: String,
    /// Of the program and the processes it started \[s\].
    cpu: f64,
    /// Of the largest of these processes \[bytes\].
    memory: u64,
}

/// Runs `rotordyn` with arguments in a folder of its own. Other programs on a shared machine lengthen its computing time:
/// the least of three counts where the first is long.
fn run(arguments: &[&str]) -> Outcome {
    let mut outcome = run_once(arguments);
    for _ in 0..2 {
        if outcome.cpu > MAX_CPU {
            outcome.cpu = outcome.cpu.min(run_once(arguments).cpu);
        }
    }
    outcome
}

fn run_once(arguments: &[&str]) -> Outcome {
    let folder = tempfile::tempdir().unwrap();
    let errors = folder.path().join("errors");
    let mut command = Command::new(env!("CARGO_BIN_EXE_rotordyn"));
    command.args(arguments).args(["--quiet", "--threads", "1"]);
    if arguments[0] != "import" {
        command.arg("--no-figures");
    }
    // Analyses of a stored run go to its folder, and an import to a file.
    if !["spectrogram", "orders", "import"].contains(&arguments[0]) {
        command.arg("--out").arg(folder.path().join("out"));
    }
    command.current_dir(folder.path());
    command.env("NO_COLOR", "1").env("RUST_BACKTRACE", "0").stdin(Stdio::null()).stdout(Stdio::null());
    command.stderr(std::fs::File::create(&errors).unwrap());
    let used = command.spawn().unwrap().wait4().unwrap();
    Outcome {
        code: used.status.code(),
        reported: String::from_utf8_lossy(&std::fs::read(errors).unwrap()).into_owned(),
        cpu: (used.rusage.utime + used.rusage.stime).as_secs_f64(),
        memory: used.rusage.maxrss,
    }
}

/// Most computing time of a file \[s\]: the program is compiled with little optimisation in tests.
const MAX_CPU: f64 = 1.0;
/// Most memory of a file \[bytes\]. The system counts the memory of this process, from which the program is started, as
/// well: the tests keep theirs small.
const MAX_MEMORY: u64 = 200_000_000;

#[track_caller]
fn is_cheap(seen: &Outcome) {
    assert!(seen.cpu < MAX_CPU, "{} s: {}", seen.cpu, seen.reported);
    assert!(seen.memory < MAX_MEMORY, "{} bytes: {}", seen.memory, seen.reported);
}

/// `rotordyn signal` refuses a file cheaply, with a message that contains all parts.
#[track_caller]
fn refused(path: &Path, parts: &[&str]) {
    let seen = run(&["signal", path.to_str().unwrap()]);
    assert_eq!(seen.code, Some(2), "{}", seen.reported);
    for part in parts {
        assert!(seen.reported.contains(part), "`{part}` is not in: {}", seen.reported);
    }
    // A message is a message, not the file.
    assert!(seen.reported.len() < 5000, "{} bytes", seen.reported.len());
    is_cheap(&seen);
}

/// As [`refused`], for a file of these bytes.
#[track_caller]
fn bytes_refused(name: &str, bytes: &[u8], parts: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    refused(&path, parts);
}

/// `rotordyn signal` reads a file cheaply, with a warning of what was left out that contains all parts.
#[track_caller]
fn read_without(path: &Path, parts: &[&str]) {
    let seen = run(&["signal", path.to_str().unwrap()]);
    assert_eq!(seen.code, Some(0), "{}", seen.reported);
    let warning = seen.reported.lines().find(|line| line.contains("warning[left-out]")).unwrap_or_default();
    for part in parts {
        assert!(warning.contains(part), "`{part}` is not in: {}", seen.reported);
    }
    is_cheap(&seen);
}

/// A budget that the file keeps is no hindrance, and the flag raises it.
#[test]
fn the_flag_raises_the_budget() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("constant.npz");
    // 80 MB of a wave that repeats, packed into a hundredth.
    let period: Vec<u8> =
        (0..100).flat_map(|k| (std::f64::consts::TAU / 100.0 * f64::from(k)).sin().to_le_bytes()).collect();
    let entry =
        archives::Entry::repeated("a.npy", &archives::npy("<f8", "(10000000,)", b""), &period, 100_000);
    std::fs::write(&path, archives::zip(&[entry])).unwrap();
    let file = path.to_str().unwrap();
    let seen = run(&["signal", file, "--rate", "1 kHz", "--time", "0 s .. 1 s"]);
    assert_eq!(seen.code, Some(2), "{}", seen.reported);
    let advice = seen.reported.split("--read-limit ").nth(1).unwrap_or_default();
    let advised = advice.split(|c: char| !(c.is_ascii_alphanumeric() || c == '.')).next().unwrap();
    assert!(advised.ends_with("MB"), "{}", seen.reported);
    let seen = run(&["signal", file, "--rate", "1 kHz", "--time", "0 s .. 1 s", "--read-limit", "1GB"]);
    assert_eq!(seen.code, Some(0), "{}", seen.reported);
}

/// What never ends is no file.
#[test]
fn devices_and_folders_are_refused() {
    refused(Path::new("/dev/zero"), &["it is a device or a pipe"]);
    let seen = run(&["modal", "/dev/zero"]);
    assert_eq!(seen.code, Some(2), "{}", seen.reported);
    is_cheap(&seen);
}

//! One command at a time writes to a folder.

use crate::scenarios::{run, succeed};
use crate::{MODEL, SHORT, names, rotordyn};
use rotordyn::io::hdf5::{Store, recorded_samples};
use rotordyn::io::results_file::results_state;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// A run-up that takes longer than any test waits.
pub fn long_run(out: &Path) -> Command {
    let mut command = rotordyn();
    command.args(["run", MODEL, "--no-figures", "--out"]).arg(out).args(SHORT);
    // At 1 kHz, for less space on the disk.
    let rates = ["study.run_up.sample_rate=1 kHz", "study.run_up.step=50 us", "speed.hold=2000 s"];
    for set in rates {
        command.args(["--set", set]);
    }
    command.stdout(Stdio::null());
    command
}

/// Waits for the first samples of a run.
pub fn wait_for_samples(out: &Path) {
    let begun = Instant::now();
    let file = out.join("results_unfinished.h5");
    let samples = || Store::open(&file).and_then(|store| recorded_samples(&store, "")).unwrap_or(0);
    while samples() == 0 {
        assert!(begun.elapsed() < Duration::from_secs(300), "no samples after five minutes");
        std::thread::sleep(Duration::from_millis(50));
    }
}

pub fn signal(name: &str, process: u32) {
    let sent = Command::new("kill").args([&format!("-{name}"), &process.to_string()]).status().unwrap();
    assert!(sent.success());
}

#[cfg(unix)]
#[test]
fn the_second_command_names_the_first() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let mut first = long_run(&out).stderr(Stdio::null()).spawn().unwrap();
    wait_for_samples(&out);
    let begun = Instant::now();
    let commands = [
        run(folder.path()),
        {
            let mut command = rotordyn();
            command.args(["modal", MODEL, "--no-figures", "--out"]).arg(&out);
            command
        },
        {
            let mut command = rotordyn();
            command.args(["export", MODEL, "--out"]).arg(&out);
            command
        },
    ];
    for mut second in commands {
        let output = second.output().unwrap();
        let text = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(4), "{text}");
        let holder = format!("another command writes there: process {} on ", first.id());
        assert!(text.contains(&holder) && text.contains(": rotordyn run models/jeffcott.toml"), "{text}");
    }
    // It does not wait for the first; a start of the program takes some ms.
    assert!(begun.elapsed() < Duration::from_secs(60));
    // What only reads needs no lock.
    let mut check = rotordyn();
    check.args(["check", MODEL]);
    succeed(check);
    signal("TERM", first.id());
    assert_eq!(first.wait().unwrap().code(), Some(143));
    let store = Store::open(out.join("results.h5")).unwrap();
    assert!(store.contains("/modes/omega") && recorded_samples(&store, "").unwrap() > 0);
    // A run that was stopped can be resumed from its checkpoint.
    assert_eq!(names(&out), ["checkpoint.bin", "checkpoint_samples.h5", "results.h5"]);
}

#[cfg(unix)]
#[test]
fn the_lock_of_a_killed_command_is_taken_over() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let mut first = long_run(&out).stderr(Stdio::null()).spawn().unwrap();
    wait_for_samples(&out);
    signal("KILL", first.id());
    first.wait().unwrap();
    assert!(names(&out).contains(&".rotordyn.lock".to_string()));
    let output = run(folder.path()).output().unwrap();
    let text = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{text}");
    assert!(text.contains(&format!("took over the lock of process {}", first.id())), "{text}");
    assert_eq!(names(&out), ["results.h5", "results_unfinished_previous.h5"]);
    assert_eq!(results_state(&Store::open(out.join("results.h5")).unwrap()).unwrap(), "complete");
}

/// Of two commands started at once, one writes; the results are its own, whichever it is.
#[cfg(unix)]
#[test]
fn of_two_commands_started_at_once_one_writes() {
    let folder = tempfile::tempdir().unwrap();
    let mut codes: Vec<_> = (0..3)
        .map(|_| run(folder.path()).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap())
        .collect::<Vec<_>>()
        .into_iter()
        .map(|mut child| child.wait().unwrap().code())
        .collect();
    codes.sort();
    assert!(
        codes.contains(&Some(0)) && codes.iter().all(|code| [Some(0), Some(4)].contains(code)),
        "{codes:?}"
    );
    let alone = tempfile::tempdir().unwrap();
    succeed(run(alone.path()));
    let read = |folder: &Path| std::fs::read(folder.join("out/results.h5")).unwrap();
    assert!(read(folder.path()) == read(alone.path()));
}

/// A command that fails before it writes leaves no folder.
#[test]
fn a_refused_command_leaves_no_folder() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("a/b");
    let mut command = rotordyn();
    // 8e9 samples of six values: 400 GB.
    command.args(["run-up", MODEL, "--out"]).arg(&out).args(["--set", "speed.hold=8e6 s"]);
    let output = command.output().unwrap();
    assert_eq!(output.status.code(), Some(4), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(names(folder.path()), [""; 0]);
}

//! SIGINT, SIGTERM and SIGHUP end a command and keep its results and the earlier ones.

use crate::locks::{long_run, signal, wait_for_samples};
use crate::scenarios::{finished_results, succeed};
use crate::{names, rotordyn};
use rotordyn::io::hdf5::{COMPLETE, Store};
use rotordyn::io::results_file::results_state;
use std::path::Path;
use std::process::{Command, Stdio};

fn state(file: &Path) -> String {
    results_state(&Store::open(file).unwrap()).unwrap()
}

/// Whether this process was started with SIGHUP, number 1, ignored.
#[cfg(unix)]
fn hangup_is_ignored() -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.is_some_and(|digits| u64::from_str_radix(digits.trim(), 16).unwrap() & 1 == 1)
}

#[cfg(unix)]
#[test]
fn signals_end_a_run_and_keep_the_earlier_one() {
    let signals = [("INT", 130, "Ctrl-C"), ("TERM", 143, "SIGTERM"), ("HUP", 129, "SIGHUP")];
    // Tests started by `nohup` pass the ignored SIGHUP on to the program, which then ignores it as well.
    for (name, code, cause) in signals.into_iter().filter(|(name, ..)| *name != "HUP" || !hangup_is_ignored())
    {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("out");
        finished_results(folder.path());
        let earlier = std::fs::read(out.join("results.h5")).unwrap();
        let mut child = long_run(&out).stderr(Stdio::piped()).spawn().unwrap();
        wait_for_samples(&out);
        signal(name, child.id());
        let mut text = String::new();
        std::io::Read::read_to_string(&mut child.stderr.take().unwrap(), &mut text).unwrap();
        assert_eq!(child.wait().unwrap().code(), Some(code), "{text}");
        assert!(text.contains(&format!("run-up: ended by {cause}")), "{text}");
        let results = out.join("results.h5");
        assert!(
            state(&results).starts_with(&format!("stopped: ended by {cause} at t = ")),
            "{}",
            state(&results)
        );
        // With the checkpoint from which the run can be resumed.
        let expected = ["checkpoint.bin", "checkpoint_samples.h5", "results.h5", "results_previous.h5"];
        assert_eq!(names(&out), expected);
        // A complete run is never lost to one that was stopped.
        assert!(std::fs::read(out.join("results_previous.h5")).unwrap() == earlier);
        assert_eq!(state(&out.join("results_previous.h5")), COMPLETE);
    }
}

/// A fit that takes minutes ends at the first signal, before anything is written.
#[cfg(unix)]
#[test]
fn a_signal_ends_an_update() {
    let folder = tempfile::tempdir().unwrap();
    let (measured, out) = (folder.path().join("measured"), folder.path().join("out"));
    let rig = "models/overhung_rig.toml";
    let mut modal = rotordyn();
    modal.args(["modal", rig, "--speed", "0 rpm", "--no-figures", "--quiet", "--out"]).arg(&measured);
    succeed(modal);
    let mut update = rotordyn();
    update.args(["update", rig, "--no-figures", "--out"]).arg(&out);
    update.arg("--measured").arg(measured.join("results.h5"));
    for name in ["disc.main.thickness", "disc.pulley.mass", "material.steel.young", "material.steel.density"]
    {
        update.args(["--free", name, "--profile", name]);
    }
    let mut child = update.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    while !out.exists() {
        std::thread::sleep(std::time::Duration::from_millis(5));
        assert!(child.try_wait().unwrap().is_none());
    }
    signal("INT", child.id());
    let mut text = String::new();
    std::io::Read::read_to_string(&mut child.stderr.take().unwrap(), &mut text).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(130), "{text}");
    assert!(text.contains("ended by Ctrl-C"), "{text}");
    assert!(!out.join("update.h5").exists());
}

/// Two signals that arrive together: the second does not wait for what the first has requested.
#[cfg(unix)]
#[test]
fn a_second_signal_ends_the_program_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let mut child = long_run(&out).stderr(Stdio::null()).spawn().unwrap();
    wait_for_samples(&out);
    for name in ["STOP", "INT", "TERM", "CONT"] {
        signal(name, child.id());
    }
    let code = child.wait().unwrap().code();
    assert!([Some(130), Some(143)].contains(&code), "{code:?}");
    assert_eq!(names(&out), [".rotordyn.lock", "results_unfinished.h5"]);
    assert_eq!(state(&out.join("results_unfinished.h5")), "running");
}

/// `nohup` starts a command with SIGHUP ignored; it stays ignored.
#[cfg(target_os = "linux")]
#[test]
fn an_ignored_hangup_stays_ignored() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let run = long_run(&out);
    let mut shell = Command::new("sh");
    shell.args(["-c", "trap '' HUP; exec \"$0\" \"$@\""]).arg(run.get_program()).args(run.get_args());
    shell.current_dir(env!("CARGO_MANIFEST_DIR")).stdout(Stdio::null()).stderr(Stdio::null());
    let mut child = shell.spawn().unwrap();
    wait_for_samples(&out);
    signal("HUP", child.id());
    let begun =
        rotordyn::io::hdf5::recorded_samples(&Store::open(out.join("results_unfinished.h5")).unwrap(), "");
    let begun = begun.unwrap();
    let samples = || {
        let store = Store::open(out.join("results_unfinished.h5"));
        store.and_then(|store| rotordyn::io::hdf5::recorded_samples(&store, ""))
    };
    while samples().unwrap() <= begun {
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    assert_eq!(child.try_wait().unwrap(), None, "it goes on");
    signal("TERM", child.id());
    assert_eq!(child.wait().unwrap().code(), Some(143));
}

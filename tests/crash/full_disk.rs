//! Output that cannot be written: exit code 4 and what was lost; earlier results stay.

use crate::killed::{Whole, copy_folder, results_below, wanted};
use crate::locks::{long_run, wait_for_samples};
use crate::scenarios::{ALL, finished_results, run, succeed};
use crate::strace::{can_trace, points, sample, without_space_from};
use crate::{MODEL, SHORT, rotordyn};
use rotordyn::io::hdf5::Store;
use std::fs::{self, File};
use std::process::{Command, Stdio};

#[test]
fn a_full_disk_loses_nothing() {
    if !can_trace() {
        return;
    }
    let top = tempfile::tempdir().unwrap();
    let mut checked = 0;
    for scenario in
        ALL.iter().filter(|s| ["run over finished results", "update over the model itself"].contains(&s.name))
    {
        let [before, after, place] =
            ["before", "after", "place"].map(|name| top.path().join(scenario.name).join(name));
        fs::create_dir_all(&before).unwrap();
        (scenario.prepare)(&before);
        copy_folder(&before, &place);
        let all = points(&(scenario.command)(&place), &top.path().join("strace.log"));
        fs::rename(&place, &after).unwrap();
        let whole = Whole::of(scenario, &before, &after);
        for point in sample(all, wanted()) {
            let what = format!("{}, no space from {} {}", scenario.name, point.0, point.1);
            copy_folder(&before, &place);
            let output = without_space_from(&(scenario.command)(&place), &point);
            let text = String::from_utf8_lossy(&output.stderr);
            // What only tidies up, such as removing the lock, may fail unnoticed; what was to be written is then there.
            let complete = Whole::of(scenario, &after, &place).is_after();
            assert!(output.status.code() == Some(4) || complete, "{what}: {:?} {text}", output.status);
            // Where `write` fails, the message has no way out either.
            let reported = text.contains("No space left on device") || point.0 == "write";
            assert!(complete || reported, "{what}: {text}");
            whole.assert(&place, &what);
            for path in results_below(&place) {
                Store::open(&path).unwrap_or_else(|error| panic!("{what}: {error}"));
            }
            fs::remove_dir_all(&place).unwrap();
            checked += 1;
        }
    }
    eprintln!("{checked} points without space");
}

/// A limit on the size of files is an error of the write, not a signal that kills.
#[cfg(unix)]
#[test]
fn a_limit_on_the_size_of_files_is_an_error() {
    let folder = tempfile::tempdir().unwrap();
    finished_results(folder.path());
    let results = folder.path().join("out/results.h5");
    let before = fs::read(&results).unwrap();
    // Blocks of 512 bytes: half of what the results need.
    let limit = (before.len() / 1024).to_string();
    let run = run(folder.path());
    let mut command = Command::new("sh");
    command.args(["-c", "ulimit -f \"$0\"; exec \"$@\"", &limit]).arg(run.get_program()).args(run.get_args());
    let output = command.current_dir(env!("CARGO_MANIFEST_DIR")).output().unwrap();
    let text = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(4), "{text}");
    assert!(text.contains("File too large"), "{text}");
    let lost = ["; the run-up is not computed", "; the samples so far are kept"];
    assert!(lost.iter().any(|lost| text.contains(lost)), "{text}");
    // Half of the space is enough for the linear studies; the complete results stay beside them.
    let kept = ["results.h5", "results_previous.h5"].map(|name| folder.path().join("out").join(name));
    assert!(kept.iter().any(|path| fs::read(path).is_ok_and(|now| now == before)), "{text}");
    assert!(kept.iter().filter(|path| path.exists()).all(|path| Store::open(path).is_ok()));
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_standard_output_is_an_error_and_a_closed_one_is_not() {
    let folder = tempfile::tempdir().unwrap();
    let modal = |more: &[&str]| {
        let mut command = rotordyn();
        command.args(["modal", MODEL, "--no-figures", "--out"]).arg(folder.path()).args(SHORT).args(more);
        command
    };
    for more in [&[][..], &["--json"]] {
        let full = File::options().write(true).open("/dev/full").unwrap();
        let output = modal(more).stdout(full).output().unwrap();
        let text = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(4), "{more:?}: {text}");
        assert!(text.contains("standard output: No space left on device"), "{more:?}: {text}");
        assert!(Store::open(folder.path().join("results.h5")).unwrap().contains("/modes"));
        let mut child = modal(more).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert_eq!((output.status.code(), output.stderr), (Some(0), Vec::new()), "{more:?}");
    }
}

/// Noticed at the next sync of the samples, not only at the end of a run of hours.
#[test]
fn a_folder_removed_during_a_run_ends_it() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let mut child = long_run(&out).stderr(Stdio::piped()).spawn().unwrap();
    wait_for_samples(&out);
    while out.exists() {
        // The program may create a file in it while it is removed.
        let _ = fs::remove_dir_all(&out);
    }
    let output = child.wait_with_output_of_stderr();
    assert_eq!(output.0, Some(4), "{}", output.1);
    assert!(output.1.contains("removed during the run"), "{}", output.1);
    assert!(!out.exists());
}

trait StandardError {
    fn wait_with_output_of_stderr(&mut self) -> (Option<i32>, String);
}

impl StandardError for std::process::Child {
    fn wait_with_output_of_stderr(&mut self) -> (Option<i32>, String) {
        let mut text = String::new();
        std::io::Read::read_to_string(&mut self.stderr.take().unwrap(), &mut text).unwrap();
        (self.wait().unwrap().code(), text)
    }
}

/// A device in place of a model file is written to, and its failure reported.
#[cfg(target_os = "linux")]
#[test]
fn a_file_on_a_full_device_is_an_error() {
    let output = rotordyn().args(["init", "fan", "--force", "-o", "/dev/full"]).output().unwrap();
    let text = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(4), "{text}");
    assert!(text.contains("/dev/full: No space left on device"), "{text}");
    succeed({
        let mut command = rotordyn();
        command.args(["init", "fan", "--force", "-o", "/dev/null"]);
        command
    });
}

//! Commands killed at the system calls that change files: nothing earlier is lost, nothing is left that cannot be read.

use crate::scenarios::{ALL, Scenario, finished_results, rerun, succeed};
use crate::strace::{Point, can_trace, killed_at, points, sample};
use rotordyn::io::hdf5::Store;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Points of every scenario in a normal test run; `ROTORDYN_CRASH_POINTS=all` takes every one.
const POINTS: usize = 7;

/// Number of points of every scenario; `None`: all.
pub fn wanted() -> Option<usize> {
    match std::env::var("ROTORDYN_CRASH_POINTS") {
        Ok(all) if all == "all" => None,
        Ok(count) => Some(count.parse().unwrap()),
        Err(_) => Some(POINTS),
    }
}

pub fn copy_folder(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let path = entry.unwrap().path();
        let copy = to.join(path.file_name().unwrap());
        match path.is_dir() {
            true => copy_folder(&path, &copy),
            false => assert!(fs::copy(&path, &copy).is_ok(), "{copy:?}"),
        }
    }
}

/// All HDF5 files below a folder, without temporary ones.
pub fn results_below(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).into_iter().flatten() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(results_below(&path));
        } else if path.extension().is_some_and(|e| e == "h5") {
            found.push(path);
        }
    }
    found
}

/// Reads every data set that a file names.
fn read_all(store: &Store, group: &str) {
    use rotordyn::io::hdf5::ObjectKind;
    for name in store.members(if group.is_empty() { "/" } else { group }).unwrap() {
        let at = format!("{group}/{name}");
        match store.object_kind(&at).unwrap() {
            ObjectKind::Group => read_all(store, &at),
            ObjectKind::Real(_) => drop(store.read(&at).unwrap()),
            ObjectKind::Complex(_) => drop(store.read_complex(&at).unwrap()),
            ObjectKind::Text(_) => drop(store.read_texts(&at).unwrap()),
            ObjectKind::References(_) | ObjectKind::Other => panic!("{at}"),
        }
    }
}

/// Whether each file is as before or as the command writes it.
pub struct Whole {
    before: BTreeMap<&'static str, Option<Vec<u8>>>,
    after: BTreeMap<&'static str, Option<Vec<u8>>>,
}

impl Whole {
    pub fn of(scenario: &Scenario, before: &Path, after: &Path) -> Self {
        let read = |folder: &Path| {
            scenario.whole.iter().map(|name| (*name, fs::read(folder.join(name)).ok())).collect()
        };
        Self { before: read(before), after: read(after) }
    }

    /// Whether all files are as the command writes them.
    pub fn is_after(&self) -> bool {
        self.before == self.after
    }

    pub fn assert(&self, folder: &Path, what: &str) {
        for (name, before) in &self.before {
            let now = fs::read(folder.join(name)).ok();
            // Results of a command that failed leave complete ones as the previous ones.
            let previous = folder.join(name).with_file_name("results_previous.h5");
            let kept = before.is_some() && fs::read(previous).ok() == *before;
            assert!(
                now == *before || now == self.after[name] || kept,
                "{what}: {name} is neither the former nor the new file"
            );
        }
    }
}

/// The studies in a results file that were finished: of the tables printed, all but the last are of saved studies.
const STUDIES: [(&str, &str); 8] = [
    ("Bearing forces on the shaft", "/equilibrium"),
    ("Modes at", "/modes"),
    ("Campbell diagram over", "/campbell"),
    ("Critical speeds", "/critical_speeds"),
    ("peak magnitude", "/frf"),
    ("Unbalance response", "/unbalance"),
    ("Energy balance of the run-up", "/run_up"),
    ("Order cuts", "/spectra"),
];

fn assert_finished_studies(folder: &Path, printed: &str, what: &str) {
    let seen: Vec<&str> =
        STUDIES.iter().filter(|(title, _)| printed.contains(title)).map(|(_, group)| *group).collect();
    let Some((_, saved)) = seen.split_last() else { return };
    let files = results_below(&folder.join("out"));
    let stores: Vec<Store> = files.iter().map(|path| Store::open(path).unwrap()).collect();
    for group in saved {
        assert!(stores.iter().any(|store| store.contains(group)), "{what}: {group} is in none of {files:?}");
    }
}

#[test]
fn a_killed_command_loses_nothing() {
    if !can_trace() {
        return;
    }
    let top = tempfile::tempdir().unwrap();
    let all_files = top.path().join("files");
    fs::create_dir(&all_files).unwrap();
    let mut checked = 0;
    for scenario in &ALL {
        let [before, after] = ["before", "after"].map(|name| top.path().join(scenario.name).join(name));
        fs::create_dir_all(&before).unwrap();
        (scenario.prepare)(&before);
        copy_folder(&before, &after);
        // Names of files are part of a command and of what it writes: every run happens in a folder of the same name.
        let place = top.path().join("place");
        let enter = |from: &Path| {
            let _ = fs::remove_dir_all(&place);
            copy_folder(from, &place);
        };
        enter(&before);
        let all = points(&(scenario.command)(&place), &top.path().join("strace.log"));
        let _ = fs::remove_dir_all(&after);
        copy_folder(&place, &after);
        let whole = Whole::of(scenario, &before, &after);
        assert!(whole.after.values().all(Option::is_some), "{}: not written", scenario.name);
        let count = all.len();
        let chosen: Vec<Point> = sample(all, wanted());
        for (k, point) in chosen.iter().enumerate() {
            let what = format!("{}, killed at {} {}", scenario.name, point.0, point.1);
            enter(&before);
            let output = killed_at(&(scenario.command)(&place), point);
            assert!(!output.status.success(), "{what}: not killed");
            whole.assert(&place, &what);
            assert_finished_studies(&place, &String::from_utf8_lossy(&output.stdout), &what);
            for path in results_below(&place) {
                read_all(&Store::open(&path).unwrap_or_else(|error| panic!("{what}: {error}")), "");
                let name = format!("{checked}_{}", path.file_name().unwrap().to_string_lossy());
                fs::copy(&path, all_files.join(name)).unwrap();
            }
            // The command can be repeated, and then writes what it would have written.
            if k % 5 == 0 {
                let untouched = Whole::of(scenario, &before, &place).is_after();
                succeed((scenario.command)(&place));
                let again = Whole::of(scenario, &after, &place);
                // A command killed after it wrote a file starts from that one.
                assert!(!untouched || again.is_after(), "{what}: another result when repeated");
                let out = crate::names(&place.join("out"));
                assert!(
                    !out.iter().any(|name| name.ends_with("part") || name.ends_with("lock")),
                    "{what}: {out:?}"
                );
            }
            checked += 1;
        }
        eprintln!("{}: {} of {count} points", scenario.name, chosen.len());
    }
    let files = open_with_h5py(&all_files);
    eprintln!("{checked} points, {files:?} files opened by h5py");
}

/// Opens all files of a folder with h5py and reads all their data sets; `None` where it is not there.
fn open_with_h5py(folder: &Path) -> Option<usize> {
    let python = std::env::var("ROTORDYN_PYTHON").unwrap_or_else(|_| "python3".into());
    let has = Command::new(&python).args(["-c", "import h5py"]).output();
    if !has.is_ok_and(|output| output.status.success()) {
        let must_run = std::env::var_os("CI").is_some() && std::env::var_os("ROTORDYN_ALLOW_SKIP").is_none();
        assert!(!must_run, "{python} with h5py not found; set ROTORDYN_ALLOW_SKIP to skip the test");
        return None;
    }
    let script = "import sys, pathlib, h5py\n\
                  files = sorted(pathlib.Path(sys.argv[1]).iterdir())\n\
                  for path in files:\n\
                  \x20   with h5py.File(path) as file:\n\
                  \x20       file.visititems(lambda name, item: item[()] if isinstance(item, h5py.Dataset) else None)\n\
                  print(len(files))";
    let output = Command::new(python).args(["-c", script]).arg(folder).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8_lossy(&output.stdout).trim().parse().ok()
}

/// What a killed run left is found and named, and the run after it keeps it.
#[test]
fn a_killed_run_is_read_and_kept() {
    if !can_trace() {
        return;
    }
    let top = tempfile::tempdir().unwrap();
    let (folder, out) = (top.path(), top.path().join("out"));
    finished_results(folder);
    // The last sync of samples: the run has ended, its compressed copy is not written.
    let all = points(&rerun(&folder.join("other")), &folder.join("strace.log"));
    let last = all.iter().rfind(|(call, _)| call == "fdatasync").unwrap();
    killed_at(&rerun(folder), last);
    let unfinished = out.join("results_unfinished.h5");
    let output = crate::rotordyn()
        .arg("spectrogram")
        .arg(&out)
        .args(["--no-figures", "--length", "0.2 s"])
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{text}");
    assert!(text.contains("results_unfinished.h5 instead of results.h5, which is older"), "{text}");
    assert!(text.contains("the stored run is incomplete: running"), "{text}");
    let store = Store::open(&unfinished).unwrap();
    assert!(rotordyn::io::hdf5::recorded_samples(&store, "").unwrap() > 1000);
    drop(store);
    // It is a run of another disc; the next command keeps it until its own first results are saved.
    let text = String::from_utf8(rerun(folder).output().unwrap().stderr).unwrap();
    assert!(text.contains("results_unfinished_previous.h5"), "{text}");
    assert!(out.join("results_unfinished_previous.h5").exists() && !unfinished.exists());
}

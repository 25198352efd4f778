//! Names of a model or a measured file that become paths: nothing is written outside the folder of results.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use crate::{json_of, rotordyn};

const JEFFCOTT: &str = include_str!("../../models/jeffcott.toml");

/// Every file below a folder, by its path from there.
fn files_below(folder: &Path) -> BTreeSet<PathBuf> {
    let mut found = BTreeSet::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(next) = folders.pop() {
        for entry in std::fs::read_dir(next).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else {
                found.insert(path.strip_prefix(folder).unwrap().to_path_buf());
            }
        }
    }
    found
}

/// Standard error of a command that must be refused, on one line.
fn refusal(folder: &Path, arguments: &[&str]) -> String {
    let refused = rotordyn().current_dir(folder).args(arguments).assert().code(2);
    let text = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
    text.split_whitespace().filter(|word| *word != "\u{2502}").collect::<Vec<_>>().join(" ")
}

/// A quoted TOML key.
fn quoted(name: &str) -> String {
    serde_json::to_string(name).unwrap()
}

#[test]
fn variants_that_lead_elsewhere_are_refused() {
    let long = "x".repeat(300);
    let names = [
        "/../../../escaped",
        "../escaped",
        "..",
        ".",
        "",
        "a/b",
        "C:\\escaped",
        "CON",
        "nul.old",
        "a.",
        "a\u{0}b",
        "a\nb",
        " a",
        &long,
    ];
    let top = tempfile::tempdir().unwrap();
    let work = top.path().join("a/b/c");
    std::fs::create_dir_all(&work).unwrap();
    for name in names {
        let model = work.join("machine.toml");
        std::fs::write(&model, format!("{JEFFCOTT}\n[variant.{}]\n", quoted(name))).unwrap();
        let before = files_below(top.path());
        let mut commands = vec![vec!["check", "machine.toml"], vec!["modal", "machine.toml"]];
        // An argument cannot contain NUL.
        if !name.contains('\u{0}') {
            commands.push(vec!["modal", "machine.toml", "--no-figures", "--variant", name]);
        }
        for arguments in commands {
            let text = refusal(&work, &arguments);
            assert!(text.contains("cannot be the name of a variant"), "{name:?}: {text}");
            assert!(text.contains("out/NAME_VARIANT"), "{name:?}: {text}");
        }
        assert_eq!(files_below(top.path()), before, "{name:?}");
    }
}

#[test]
fn variants_that_share_a_folder_where_case_is_ignored_are_refused() {
    let work = tempfile::tempdir().unwrap();
    let model = format!("{JEFFCOTT}\n[variant.loose]\n[variant.Loose]\n");
    std::fs::write(work.path().join("machine.toml"), model).unwrap();
    let text = refusal(work.path(), &["check", "machine.toml"]);
    assert!(text.contains("differs from `loose` only in upper and lower case"), "{text}");
}

#[test]
fn items_whose_names_are_paths_are_refused() {
    let work = tempfile::tempdir().unwrap();
    for name in ["../x", "/a", "a//b", "..", "", "a/./b", "a\u{7}"] {
        for item in ["probe", "study.frf.excitation"] {
            let added = format!("[{item}.{}]\nat = \"disc.main\"\ndirection = \"x\"\n", quoted(name));
            std::fs::write(work.path().join("machine.toml"), format!("{JEFFCOTT}\n{added}")).unwrap();
            let text = refusal(work.path(), &["check", "machine.toml"]);
            assert_eq!(text.matches("cannot be the name of").count(), 1, "{item} {name:?}: {text}");
        }
    }
}

/// Channels of a measured file may have any name: each has files and a group of its own, all below the folder.
#[test]
fn channels_with_similar_names_are_kept_apart() {
    let work = tempfile::tempdir().unwrap();
    let names = ["a/b", "a_b", "A_b", "../../up", "a b", "."];
    let mut text = format!("t [s],{}\n", names.map(|name| format!("\"{name} [m/s^2]\"")).join(","));
    for k in 0..512 {
        let t = f64::from(k) / 512.0;
        // A frequency of its own for each channel.
        let values =
            (0..names.len()).map(|c| ((c + 20) as f64 * std::f64::consts::TAU * t).sin().to_string());
        text += &format!("{t},{}\n", values.collect::<Vec<_>>().join(","));
    }
    let folder = work.path().join("in/here");
    std::fs::create_dir_all(&folder).unwrap();
    // The name without its extension is that of the folder above.
    std::fs::write(folder.join("...csv"), text).unwrap();
    let found =
        json_of(rotordyn().current_dir(&folder).args(["signal", "...csv", "--channel", "all", "--csv"]));
    assert_eq!(found["channels"].as_array().unwrap().len(), names.len());
    let outside =
        files_below(work.path()).into_iter().filter(|path| !path.starts_with("in/here/out")).count();
    assert_eq!(outside, 1, "{:?}", files_below(work.path()));

    let written: Vec<&str> = found["files"].as_array().unwrap().iter().map(|f| f.as_str().unwrap()).collect();
    let different: BTreeSet<String> = written.iter().map(|file| file.to_lowercase()).collect();
    assert_eq!(different.len(), written.len(), "{written:?}");
    let results = written.iter().find(|file| file.ends_with("signal.h5")).unwrap();
    let store = rotordyn::io::hdf5::Store::open(folder.join(results)).unwrap();
    let groups: Vec<String> =
        store.members("/").unwrap().into_iter().filter(|group| group != "meta").collect();
    assert_eq!(groups.len(), names.len(), "{groups:?}");
    for group in groups {
        let channel = store.attribute(&format!("/{group}"), "channel").unwrap().unwrap();
        let rotordyn::io::hdf5::Attribute::Text(channel) = channel else { panic!("{channel:?}") };
        let own = names.iter().position(|name| *name == channel).unwrap();
        let record = store.read(&format!("/{group}/record")).unwrap_or_else(|error| panic!("{error}")).data;
        let expected = ((own + 20) as f64 * std::f64::consts::TAU / 512.0).sin();
        // One sample after the start, in text with all digits.
        assert!((record[1] - expected).abs() < 1e-12, "{channel}: {} instead of {expected}", record[1]);
    }
}

#[test]
fn check_lists_the_files_that_a_model_reads() {
    let work = tempfile::tempdir().unwrap();
    let speed: String = (0..50).map(|k| format!("{},{}\n", f64::from(k) / 10.0, 20 * k)).collect();
    let table = format!("time [s],speed [rpm]\n{speed}");
    std::fs::write(work.path().join("speed.csv"), &table).unwrap();
    let (start, end) = (JEFFCOTT.find("[speed]").unwrap(), JEFFCOTT.find("[probe.").unwrap());
    let measured = "[speed]\nprofile = \"measured\"\nfile = \"speed.csv\"\n\n";
    let model = format!("{}{measured}{}", &JEFFCOTT[..start], &JEFFCOTT[end..]);
    std::fs::write(work.path().join("machine.toml"), model).unwrap();
    let found = json_of(rotordyn().current_dir(&work).args(["check", "machine.toml"]));
    let listed = &found["variants"][0]["side_files"][0];
    assert_eq!(listed["path"], "speed.csv");
    assert_eq!(listed["bytes"], table.len());
    let printed = rotordyn().current_dir(&work).args(["check", "machine.toml"]).assert().success();
    let printed = String::from_utf8_lossy(&printed.get_output().stdout).into_owned();
    assert!(printed.contains("Files that the model reads") && printed.contains("speed.csv"), "{printed}");
}

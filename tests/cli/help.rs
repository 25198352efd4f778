//! `help`: tables and keys of the model file, and commands.

use crate::{json_of, output_of, rotordyn};
use std::collections::BTreeSet;

fn help(path: &str) -> String {
    output_of(rotordyn().args(["help", path]))
}

#[test]
fn help_lists_tables_keys_and_one_key() {
    let file = output_of(rotordyn().arg("help"));
    for table in ["model", "material", "shaft", "bearing", "study", "variant"] {
        assert!(file.lines().any(|line| line.starts_with(&format!("  {table} "))), "{table}: {file}");
    }
    let bearing = help("bearing");
    for part in [
        "[bearing.NAME]",
        "with model = \"ball\" or model = \"radial_ball\" or model = \"free_ball\":",
        "k_tilt ",
        "stiffness_damping",
    ] {
        assert!(bearing.contains(part), "{part} is not in\n{bearing}");
    }
    assert!(bearing.contains("rotordyn bearing --help"), "{bearing}");
    let key = help("bearing.B.preload.force");
    for part in ["bearing.preload.force", "force [N], greater than zero", "example: force = \"150 N\""] {
        assert!(key.contains(part), "{part} is not in\n{key}");
    }
    let step = help("study.run_up.step");
    assert!(step.contains("without it: 100 us, less at high speed"), "{step}");
    for path in ["", "bearing", "bearing.preload", "study.run_up", "housing", "speed", "study.bifurcation"] {
        let text = if path.is_empty() { file.clone() } else { help(path) };
        assert!(text.lines().all(|line| line.chars().count() <= 118), "{text}");
    }
}

/// `help TABLE` lists every key that the reader accepts in it: by its name, or between the first and the last of several
/// alike.
#[test]
fn every_key_is_listed_by_its_table() {
    let all = rotordyn::model::keys::all();
    let tables: BTreeSet<&str> =
        all.iter().map(|key| key.path.rsplit_once('.').map_or("", |(table, _)| table)).collect();
    let mut count = 0;
    for table in tables {
        let text = if table.is_empty() { output_of(rotordyn().arg("help")) } else { help(table) };
        let words: BTreeSet<&str> = text
            .lines()
            .filter_map(|line| line.strip_prefix("  ").filter(|rest| !rest.starts_with(' ')))
            .flat_map(|line| line.split("  ").take(1).flat_map(str::split_whitespace))
            .collect();
        // A row "k_x ... k_spin   6 components" stands for those between its two names.
        let in_ranges = |line: &str| {
            let number = line.split("  ").map(str::trim).find_map(|part| part.split_once(" components"))?.0;
            Some(number.parse::<usize>().unwrap() - 2)
        };
        let mut between: usize =
            text.lines().filter(|line| line.contains(" ... ")).filter_map(in_ranges).sum();
        let members = all.iter().filter(|key| key.path.rsplit_once('.').map_or("", |(of, _)| of) == table);
        for key in members {
            if !words.contains(key.name) {
                assert!(between > 0, "{} is not in `help {table}`:\n{text}", key.path);
                between -= 1;
            }
            count += 1;
        }
        assert_eq!(between, 0, "`help {table}` has more components than there are keys:\n{text}");
    }
    assert_eq!(count, all.len());
}

#[test]
fn help_of_a_command_a_former_name_and_an_unknown_path() {
    assert!(help("modal").contains("Usage:"));
    let former = rotordyn().args(["help", "bearing.contacts_pull"]).output().unwrap();
    let note = String::from_utf8(former.stderr).unwrap();
    assert!(note.contains("`bearing.contacts_pull` is now `bearing.tensile_contact`"), "{note}");
    let unknown = rotordyn().args(["help", "bearing.prelod"]).output().unwrap();
    assert_eq!(unknown.status.code(), Some(2));
    let message = String::from_utf8(unknown.stderr).unwrap();
    assert!(message.contains("did you mean bearing.preload?"), "{message}");
    for (word, code) in [("fittd-law", "fitted-law"), ("unloaded", "bearing-unloaded")] {
        let unknown = rotordyn().args(["help", word]).output().unwrap();
        let message = String::from_utf8(unknown.stderr).unwrap();
        assert!(message.contains(&format!("did you mean the warning {code}?")), "{message}");
    }
}

#[test]
fn help_as_data() {
    let document = json_of(rotordyn().args(["help", "study.modal"]));
    let modes = document["members"].as_array().unwrap().iter().find(|key| key["name"] == "modes").unwrap();
    assert_eq!(modes["path"], "study.modal.modes");
    assert_eq!((&modes["default"], &modes["range"]), (&"12".into(), &"from 1 to 10000".into()));
    let speeds = json_of(rotordyn().args(["help", "study.modal.speeds"]));
    assert_eq!(speeds["keys"][0]["unit"], "rad/s");
    assert_eq!(speeds["members"].as_array().unwrap().len(), 5);
}

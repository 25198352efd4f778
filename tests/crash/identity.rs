//! Results, figures and JSON of one run carry one identity; those of an earlier run do not lie beside them.

use crate::{MODEL, SHORT, names, rotordyn};
use rotordyn::io::hdf5::{Attribute, Store};
use std::fs;
use std::path::Path;

fn run(out: &Path, command: &str, more: &[&str]) -> serde_json::Value {
    let mut command_line = rotordyn();
    command_line.args([command, MODEL, "--json", "--out"]).arg(out).args(SHORT).args(more);
    let output = command_line.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

fn stored(out: &Path, name: &str) -> Attribute {
    Store::open(out.join("results.h5")).unwrap().attribute("/meta", name).unwrap().unwrap()
}

#[test]
fn figures_carry_the_identity_of_their_results() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path();
    let document = run(out, "run", &["--csv"]);
    let identity = document["identity"].as_str().unwrap();
    assert_eq!((identity.len(), stored(out, "identity")), (32, Attribute::Text(identity.into())));
    let Attribute::Texts(listed) = stored(out, "files") else { panic!() };
    let mut found: Vec<String> = names(out).into_iter().filter(|name| name.contains('.')).collect();
    found.retain(|name| name != "results.h5");
    found.extend(names(&out.join("csv")).into_iter().map(|name| format!("csv/{name}")));
    found.sort();
    assert_eq!(listed, found);
    for name in found.iter().filter(|name| !name.starts_with("csv/")) {
        let bytes = fs::read(out.join(name)).unwrap();
        let text = format!("rotordyn run {identity}");
        assert!(bytes.windows(text.len()).any(|part| part == text.as_bytes()), "{name}");
    }
    // The same input has the same identity and the same bytes, another has another.
    let figure = fs::read(out.join("campbell.png")).unwrap();
    assert_eq!(run(out, "run", &["--csv"])["identity"], identity);
    assert!(fs::read(out.join("campbell.png")).unwrap() == figure);
    assert!(!out.join("previous").exists());
    let other = run(&out.join("other"), "modal", &["--set", "disc.main.thickness=25 mm"]);
    assert_ne!(other["identity"], identity);
}

#[test]
fn figures_of_an_earlier_run_are_moved_and_other_files_stay() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path();
    run(out, "run", &["--csv"]);
    let Attribute::Texts(earlier) = stored(out, "files") else { panic!() };
    fs::write(out.join("notes.svg"), "of a person").unwrap();
    // A study added to the same results leaves their figures.
    run(out, "modal", &["--no-figures"]);
    assert!(!out.join("previous").exists());
    // Another disc: the results, and the figures that this command draws, are of another machine.
    let heavier = ["--set", "disc.main.thickness=25 mm"];
    run(out, "modal", &heavier);
    assert!(out.join("results_previous.h5").exists());
    let Attribute::Texts(now) = stored(out, "files") else { panic!() };
    assert!(now.iter().any(|name| name.starts_with("modes_")), "{now:?}");
    for name in &earlier {
        let (stays, moved) = (out.join(name).exists(), out.join("previous").join(name).exists());
        assert_eq!((stays, moved), (now.contains(name), !now.contains(name)), "{name}");
    }
    assert_eq!(fs::read_to_string(out.join("notes.svg")).unwrap(), "of a person");
}

//! Model files with more of something than any machine has.

use crate::run;
use std::fmt::Write;

/// Most computing time \[s\]: 100 000 lines are 20 times the longest of our models in parsing alone.
const MAX_CPU: f64 = 3.0;
/// Most memory \[bytes\]: 100 000 tables take 2.6 kB each, in the tree of the parser and in that with places in the text.
const MAX_MEMORY: u64 = 400_000_000;
const MANY: usize = 100_000;

/// What `modal` reports of the Jeffcott rotor with `before` and `after` its text.
fn reported(before: &str, after: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("model.toml");
    let text = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/models/jeffcott.toml")).unwrap();
    std::fs::write(&path, format!("{before}\n{text}\n{after}")).unwrap();
    let seen = run(&["modal", path.to_str().unwrap()]);
    println!(
        "{:.2} s, {:.0} MB: {}",
        seen.cpu,
        1e-6 * seen.memory as f64,
        seen.reported.lines().next().unwrap_or("")
    );
    assert_eq!(seen.code, Some(2), "{}", seen.reported);
    assert!(seen.cpu < MAX_CPU && seen.memory < MAX_MEMORY, "{} s, {} bytes", seen.cpu, seen.memory);
    seen.reported
}

/// Text of many lines, each with its number.
fn many(line: impl Fn(usize) -> String) -> String {
    (0..MANY).fold(String::new(), |mut text, k| {
        writeln!(text, "{}", line(k)).unwrap();
        text
    })
}

/// Each unknown key was compared with all known ones and looked up among all keys: minutes.
#[test]
fn unknown_keys() {
    let found = reported(&many(|k| format!("key{k} = {k}")), "");
    assert!(
        found.contains("unknown key key0") && found.contains("99980 more unknown keys in the file"),
        "{found}"
    );
}

#[test]
fn unknown_tables() {
    let found = reported("", &many(|k| format!("[housin{k}]\nmass = \"1 kg\"")));
    assert!(found.contains("unknown key housin0") && found.contains("did you mean `housing`"), "{found}");
}

#[test]
fn items_without_what_they_need() {
    let found = reported("", &many(|k| format!("[material.m{k}]\nyoung = \"210 GPa\"")));
    assert!(found.contains("material.m0.") && found.contains("is missing"), "{found}");
    let found = reported("", &many(|k| format!("[disc.\"d/{k}\"]\nmass = \"1 kg\"")));
    assert!(found.contains("disc.d/0.station is missing"), "{found}");
}

#[test]
fn variants_that_differ_in_case() {
    let found = reported("", &many(|k| format!("[variant.v{k}]\n[variant.V{k}]")));
    assert!(found.contains("differs from `v0` only in upper and lower case"), "{found}");
}

//! Model files with more of something than any machine has.

use crate::run;
use std::fmt::Write;

/// Most computing time \[s\]: one pass over the items takes 0.1 to 0.5 s; a comparison of all pairs, minutes with 100 000 of
/// them, takes more than ten seconds.
const MAX_CPU: f64 = 6.0;
/// Most memory \[bytes\]: a table takes 2.3 kB, in the tree of the parser and in that with places in the text, and variants
/// with a changed value are two tables each: 140 MB for 30 000.
const MAX_MEMORY: u64 = 250_000_000;
const MANY: usize = 30_000;

/// What `modal` reports of the Jeffcott rotor with `before` and `after` its text.
fn reported(before: &str, after: &str) -> String {
    let text = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/models/jeffcott.toml")).unwrap();
    reported_of(&format!("{before}\n{text}\n{after}"), Some(2))
}

/// What `modal` reports of a model.
fn reported_of(text: &str, code: Option<i32>) -> String {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("model.toml");
    std::fs::write(&path, text).unwrap();
    let seen = run(&["modal", path.to_str().unwrap()]);
    println!(
        "{:.2} s, {:.0} MB: {}",
        seen.cpu,
        1e-6 * seen.memory as f64,
        seen.reported.lines().next().unwrap_or("")
    );
    assert_eq!(seen.code, code, "{}", seen.reported);
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
        found.contains("unknown key key0") && found.contains("29980 more unknown keys in the file"),
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

/// Each looked for the missing keys of all before it, in minutes.
#[test]
fn housings_with_unknown_keys() {
    let found = reported("", &many(|k| format!("[housing.h{k}]\nstaton = \"A\"")));
    assert!(found.contains("did you mean `station`"), "{found}");
}

/// Misspellings of a key that is missing: the first of them take its place.
#[test]
fn misspellings_of_a_missing_key() {
    let disc = many(|k| format!("thicknes{k} = 1"));
    let found = reported("", &format!("[disc.second]\nstation = \"A\"\nouter_diameter = \"0.1 m\"\n{disc}"));
    assert!(found.contains("29980 more unknown keys in disc.second"), "{found}");
    assert!(!found.contains("disc.second.thickness is missing"), "{found}");
}

/// Every kind of item, each naming a place that is not there: each was compared with all places.
#[test]
fn items_at_unknown_places() {
    for (kind, content) in [
        ("disc", "station = \"nowhere\"\nmass = \"1 kg\""),
        ("body", "station = \"nowhere\"\nmass = \"1 kg\"\ninertia = \"1 kg m^2\""),
        ("bearing", "station = \"nowhere\"\nmodel = \"linear\""),
        ("bushing", "between = [\"nowhere\", \"ground\"]"),
        ("joint", "between = [\"nowhere\", \"ground\"]"),
        ("belt", "station = \"nowhere\""),
        ("sensor", "at = \"nowhere\"\nmass = \"1 g\""),
        ("load", "at = \"nowhere\""),
        ("unbalance", "station = \"nowhere\"\nmass = \"1 g\"\nradius = \"1 mm\""),
        ("probe", "at = \"nowhere\"\ndirection = \"x\""),
    ] {
        let found = reported("", &many(|k| format!("[{kind}.n{k}]\n{content}")));
        assert!(found.contains("`nowhere`"), "{kind}: {found}");
    }
}

/// Items without a fault are refused for their number alone, and as many as allowed are read: pairs were compared by
/// reading all items again, and a list of their names was too long to print.
#[test]
fn sound_items() {
    let text = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/models/jeffcott.toml")).unwrap();
    let probe = |k: usize| format!("[probe.n{k}]\nat = \"disc.main\"\ndirection = \"x\"");
    let found = reported("", &many(probe));
    assert!(found.contains("probe has 30003 items"), "{found}");
    let as_many = |line: fn(usize) -> String, less: usize| {
        let items: Vec<String> = (0..5000 - less).map(line).collect();
        reported_of(&format!("{text}\n{}", items.join("\n")), Some(0))
    };
    as_many(|k| format!("[probe.n{k}]\nat = \"disc.main\"\ndirection = \"x\""), 3);
    as_many(
        |k| {
            let inertia = "polar_inertia = \"2 g m^2\"\ndiametral_inertia = \"1 g m^2\"";
            format!("[disc.n{k}]\nstation = \"A\"\nmass = \"1 g\"\n{inertia}")
        },
        1,
    );
    as_many(|k| format!("[material.n{k}]\nyoung = \"210 GPa\"\npoisson = 0.3\ndensity = \"7850 kg/m^3\""), 1);
}

#[test]
fn lists() {
    let sections = many(|_| "[[shaft.section]]\nlength = \"1 um\"\nouter_diameter = \"20 mm\"".into());
    let text = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/models/jeffcott.toml")).unwrap();
    let line = "section = [{ length = \"800 mm\", outer_diameter = \"20 mm\" }]";
    assert!(text.contains(line));
    let found = reported_of(&text.replace(line, &sections), Some(2));
    assert!(found.contains("section has 30000 items"), "{found}");
    let found = reported("", &many(|k| format!("[variant.v{k}]\nspeed.to = \"{k} rpm\"")));
    assert!(found.contains("the file has 30000 variants"), "{found}");
}

//! Rotors of ROSS with more of something than any machine has.

use crate::{MAX_CPU, MAX_MEMORY, run};

/// What `import` reports of a file, which it must refuse cheaply.
fn refused(name: &str, text: &str, part: &str) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, text).unwrap();
    let seen =
        run(&["import", path.to_str().unwrap(), "-o", folder.path().join("out.toml").to_str().unwrap()]);
    assert_eq!(seen.code, Some(2), "{}", seen.reported);
    assert!(seen.reported.contains(part), "`{part}` is not in: {}", seen.reported);
    assert!(seen.reported.len() < 20_000, "{} bytes", seen.reported.len());
    assert!(seen.cpu < MAX_CPU && seen.memory < MAX_MEMORY, "{} s, {} bytes", seen.cpu, seen.memory);
}

#[test]
fn nested_lists_are_refused() {
    refused("deep.json", &format!("{{\"a\": {}", "[".repeat(1_000_000)), "not JSON");
    refused("deep.toml", &format!("a = {}", "[".repeat(100_000)), "not TOML");
}

#[test]
fn tables_whose_sizes_multiply_are_refused() {
    let axis: Vec<String> = (0..3000).map(|k| k.to_string()).collect();
    let axis = axis.join(",");
    let text = format!(
        "{{\"BearingElement_a\": {{\"n\": 0, \"kxx\": 1, \"cxx\": 0, \"speed\": [{axis}], \"frequency\": [{axis}]}}, \
         \"ross_version\": \"3.1.0\"}}"
    );
    refused("grid.json", &text, "speeds times");
}

#[test]
fn a_hundred_thousand_empty_elements_are_refused() {
    let text: String = (0..100_000).map(|k| format!("[\"PointMass_{k}\"]\n")).collect();
    refused("many.toml", &text, "the file has 100000 tables");
}

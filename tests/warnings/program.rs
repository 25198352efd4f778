//! Warnings of a command, by the program's own document.

use assert_cmd::Command;
use std::collections::BTreeSet;
use std::path::Path;

/// Codes of the warnings of a command in a folder, once each, with their texts; `exit`: its exit code.
pub fn codes(folder: &Path, arguments: &[&str], exit: i32) -> BTreeSet<String> {
    let mut command = Command::cargo_bin("rotordyn").unwrap();
    let run = command.args(arguments).args(["--json", "--quiet"]).current_dir(folder).assert().code(exit);
    codes_of(&run.get_output().stdout)
}

/// Codes of the warnings in a document.
pub fn codes_of(document: &[u8]) -> BTreeSet<String> {
    let document: serde_json::Value = serde_json::from_slice(document).unwrap();
    let warnings = document["warnings"].as_array().unwrap();
    warnings.iter().map(|warning| warning["code"].as_str().unwrap().to_string()).collect()
}

/// A folder with files, by name and content.
pub fn folder(files: &[(&str, String)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, content) in files {
        std::fs::write(folder.path().join(name), content).unwrap();
    }
    folder
}

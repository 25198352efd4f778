//! The builder as a program: what it refuses, with which words.

use std::process::Command;

#[test]
fn a_missing_program_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let none = folder.path().join("rotordyn");
    let mut command = Command::new(env!("CARGO_BIN_EXE_book"));
    let done = command.arg("--program").arg(&none).arg("--out").arg(folder.path()).output().unwrap();
    assert_eq!(done.status.code(), Some(1));
    let words = String::from_utf8(done.stderr).unwrap();
    assert!(words.contains(&format!("no program at {}", none.display())), "{words}");
}

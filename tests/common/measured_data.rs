//! Third-party measured records, which are not part of this repository.

use std::path::{Path, PathBuf};

/// A file of the measured data: below `ROTORDYN_DATA`, or `shared/data` next to the repository.
///
/// If it is missing, the test is skipped with a message; with `CI` set it fails.
pub fn measured(file: &str) -> Option<PathBuf> {
    let default = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join("shared").join("data");
    let folder = std::env::var_os("ROTORDYN_DATA").map_or(default, PathBuf::from);
    let path = folder.join(file);
    if path.exists() {
        return Some(path);
    }
    let message = format!("measured data {} not found; set ROTORDYN_DATA to its folder", path.display());
    let must_run = std::env::var_os("CI").is_some() && std::env::var_os("ROTORDYN_ALLOW_SKIP").is_none();
    assert!(!must_run, "{message}; set ROTORDYN_ALLOW_SKIP to skip the test");
    eprintln!("SKIPPED: {message}");
    None
}

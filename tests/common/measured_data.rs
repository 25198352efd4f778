//! Measured records of others, which are not part of this repository.

use std::path::{Path, PathBuf};

/// A file of the measured data: below `ROTORDYN_DATA`, or `shared/data` beside the repository.
///
/// Without it the test is skipped and says so; where everything must run (`CI` set) that is a failure.
pub fn measured(file: &str) -> Option<PathBuf> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join("shared").join("data");
    let folder = std::env::var_os("ROTORDYN_DATA").map_or(beside, PathBuf::from);
    let path = folder.join(file);
    if path.exists() {
        return Some(path);
    }
    let message = format!("measured data {} is not there; ROTORDYN_DATA names its folder", path.display());
    let must_run = std::env::var_os("CI").is_some() && std::env::var_os("ROTORDYN_ALLOW_SKIP").is_none();
    assert!(!must_run, "{message}; set ROTORDYN_ALLOW_SKIP to go on without it");
    eprintln!("SKIPPED: {message}");
    None
}

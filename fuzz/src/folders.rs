//! Files of the repository that this program was built from.

use std::path::{Path, PathBuf};

/// Top folder of the repository that this program was built from.
pub fn top() -> &'static Path {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    own.parent().unwrap_or(own)
}

/// Files of a folder with an extension, or all for "*", by their names; none if there is no such folder.
pub fn files(folder: &Path, extension: &str) -> Vec<(PathBuf, Vec<u8>)> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let mut paths: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    paths.sort();
    paths.retain(|path| {
        path.is_file() && (extension == "*" || path.extension().is_some_and(|e| e == extension))
    });
    paths.into_iter().filter_map(|path| Some((path.clone(), std::fs::read(path).ok()?))).collect()
}

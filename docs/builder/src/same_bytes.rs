//! Whether two builds of the book have the same bytes.

use std::collections::BTreeMap;
use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::Path;

/// Digest of every file below a folder, by its path.
pub type Digests = BTreeMap<String, u64>;

/// Digests of all files below a folder.
///
/// # Errors
/// A file that cannot be read.
pub fn digests(root: &Path) -> Result<Digests, String> {
    let mut out = Digests::new();
    let mut folders = vec![root.to_path_buf()];
    while let Some(folder) = folders.pop() {
        let told = |error: std::io::Error| format!("{}: {error}", folder.display());
        for entry in fs::read_dir(&folder).map_err(told)? {
            let path = entry.map_err(told)?.path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let bytes = fs::read(&path).map_err(|error| format!("{}: {error}", path.display()))?;
            let mut hasher = DefaultHasher::new();
            bytes.hash(&mut hasher);
            let name = path.strip_prefix(root).unwrap_or(&path).to_string_lossy().into_owned();
            out.insert(name, hasher.finish());
        }
    }
    Ok(out)
}

/// Paths of files that differ or are in one of two builds only.
pub fn differences(first: &Digests, second: &Digests) -> Vec<String> {
    let names = first.keys().chain(second.keys().filter(|name| !first.contains_key(*name)));
    names.filter(|name| first.get(*name) != second.get(*name)).cloned().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changed_added_and_missing_files_are_found() {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path();
        fs::create_dir(root.join("sub")).unwrap();
        for (name, text) in [("a", "1"), ("sub/b", "2"), ("sub/c", "3")] {
            fs::write(root.join(name), text).unwrap();
        }
        let first = digests(root).unwrap();
        assert!(differences(&first, &digests(root).unwrap()).is_empty());
        fs::write(root.join("a"), "9").unwrap();
        fs::rename(root.join("sub/b"), root.join("sub/d")).unwrap();
        assert_eq!(differences(&first, &digests(root).unwrap()), ["a", "sub/b", "sub/d"]);
    }
}

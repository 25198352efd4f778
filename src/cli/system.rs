//! Questions to the operating system: free disk space.

use std::path::Path;

/// Free bytes of the file system of a folder that may not exist yet; `None` where it cannot be asked.
#[cfg(unix)]
pub fn free_space(folder: &Path) -> Option<f64> {
    let full = std::path::absolute(folder).ok()?;
    let existing = full.ancestors().find(|path| path.exists())?;
    let found = rustix::fs::statvfs(existing).ok()?;
    Some(found.f_bavail as f64 * found.f_frsize as f64)
}

#[cfg(not(unix))]
pub fn free_space(_: &Path) -> Option<f64> {
    None
}

//! Questions to the operating system: free disk space, processor time.

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

/// Processor time of all threads of the program so far \[s\]; `None` where it cannot be asked.
#[cfg(unix)]
pub fn cpu_seconds() -> Option<f64> {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    Some(time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64)
}

#[cfg(not(unix))]
pub fn cpu_seconds() -> Option<f64> {
    None
}

//! Files replaced as a whole: whoever opens one finds the former file or the complete new one, whatever happens between.
//!
//! The new content goes to a temporary file in the same folder, is synced to the disk and renamed over the former file.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Extension of temporary files, `.PID-NUMBER.rotordyn-part`; those of a program that was killed can be deleted.
pub const PART: &str = "rotordyn-part";

/// A file under its temporary name; deleted unless it is published.
#[derive(Debug)]
pub struct NewFile {
    target: PathBuf,
    part: PathBuf,
}

impl NewFile {
    /// A name in the folder of `path` for the file that is to replace it; a symbolic link stays, and the file that it
    /// leads to is replaced.
    pub fn replacing(path: &Path) -> Self {
        static NUMBER: AtomicUsize = AtomicUsize::new(0);
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        let linked = fs::symlink_metadata(path).is_ok_and(|found| found.is_symlink());
        let target = linked.then(|| fs::canonicalize(path).ok()).flatten().unwrap_or_else(|| path.into());
        let part = target.with_file_name(format!(".{}-{number}.{PART}", std::process::id()));
        Self { target, part }
    }

    /// The temporary file.
    pub fn part(&self) -> &Path {
        &self.part
    }

    /// Syncs the closed temporary file to the disk.
    ///
    /// # Errors
    /// What it contains cannot be written.
    pub fn sync(&self) -> io::Result<()> {
        // Opened for writing, which Windows needs to sync a file.
        File::options().write(true).open(&self.part)?.sync_all()
    }

    /// Gives the temporary file its name, in place of the former file, whose permissions it takes.
    ///
    /// # Errors
    /// It cannot be renamed.
    pub fn publish(self) -> io::Result<()> {
        if let Ok(former) = fs::metadata(&self.target) {
            fs::set_permissions(&self.part, former.permissions())?;
        }
        fs::rename(&self.part, &self.target)?;
        sync_folder_of(&self.target);
        Ok(())
    }
}

impl Drop for NewFile {
    fn drop(&mut self) {
        // After `publish` there is no such file.
        let _ = fs::remove_file(&self.part);
    }
}

/// Syncs the entries of the folder of a file, where the system can: a rename then survives a loss of power.
pub fn sync_folder_of(path: &Path) {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    // Network and foreign file systems may refuse this; the files themselves are synced.
    let _ = File::open(folder).and_then(|folder| folder.sync_all());
}

/// Replaces a file that must not be lost, synced to the disk.
///
/// # Errors
/// It cannot be written; the former file is unchanged.
pub fn write(path: &Path, content: &[u8]) -> io::Result<()> {
    write_with(path, |out| out.write_all(content))
}

/// As [`write()`], with content that a function writes.
///
/// # Errors
/// It cannot be written, or that of the function; the former file is unchanged.
pub fn write_with(
    path: &Path,
    content: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> io::Result<()> {
    replace(path, content, true)
}

/// Replaces a file that can be made again (a figure, a table): atomic, but not waited for until it is on the disk.
///
/// # Errors
/// It cannot be written; the former file is unchanged.
pub fn write_derived(path: &Path, content: &[u8]) -> io::Result<()> {
    replace(path, |out| out.write_all(content), false)
}

fn replace(
    path: &Path,
    content: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
    synced: bool,
) -> io::Result<()> {
    // A device or pipe cannot be replaced.
    if fs::metadata(path).is_ok_and(|found| !found.is_file() && !found.is_dir()) {
        let mut out = BufWriter::new(File::options().write(true).open(path)?);
        content(&mut out)?;
        return out.flush();
    }
    let new = NewFile::replacing(path);
    let mut out = BufWriter::new(File::create_new(new.part())?);
    content(&mut out)?;
    let file = out.into_inner().map_err(io::IntoInnerError::into_error)?;
    if synced {
        file.sync_all()?;
    }
    drop(file);
    new.publish()
}

/// Deletes the temporary files of programs that have ended, in a folder that no other program writes to.
pub fn remove_abandoned_parts(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        let name = entry.file_name();
        let Some(stem) = name.to_str().and_then(|name| name.strip_suffix(PART)) else { continue };
        let process = stem.trim_start_matches('.').split('-').next().and_then(|id| id.parse::<u32>().ok());
        let alive = |id: u32| id == std::process::id() || Path::new("/proc").join(id.to_string()).exists();
        if process.is_some_and(|id| !alive(id)) {
            // One that cannot be deleted does no harm.
            let _ = fs::remove_file(entry.path());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<_> =
            fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn a_failed_write_leaves_the_former_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("model.toml");
        write(&path, b"former").unwrap();
        let failed = write_with(&path, |out| {
            out.write_all(b"half")?;
            out.flush()?;
            Err(io::Error::other("disk full"))
        });
        assert_eq!(failed.unwrap_err().to_string(), "disk full");
        assert_eq!(fs::read(&path).unwrap(), b"former");
        assert_eq!(names(folder.path()), ["model.toml"]);
        write_derived(&path, b"new").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert_eq!(names(folder.path()), ["model.toml"]);
    }

    #[cfg(unix)]
    #[test]
    fn links_and_permissions_stay_and_devices_are_written_to() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let (path, link) = (folder.path().join("model.toml"), folder.path().join("link.toml"));
        write(&path, b"former").unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).unwrap();
        std::os::unix::fs::symlink(&path, &link).unwrap();
        write(&link, b"new").unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert_eq!(fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o640);
        write(Path::new("/dev/null"), b"text").unwrap();
        assert!(!fs::metadata("/dev/null").unwrap().is_file());
    }

    #[test]
    fn only_parts_of_ended_programs_are_removed() {
        let folder = tempfile::tempdir().unwrap();
        let own = format!(".{}-1.{PART}", std::process::id());
        // Above the largest process number of Linux.
        let ended = format!(".99999999-1.{PART}");
        for name in [&own, &ended, &format!("mine.{PART}"), "results.h5"] {
            fs::write(folder.path().join(name), b"x").unwrap();
        }
        remove_abandoned_parts(folder.path());
        assert_eq!(names(folder.path()), [own, format!("mine.{PART}"), "results.h5".into()]);
    }
}

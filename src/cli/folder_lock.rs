//! Lock of an output folder: one command at a time writes there.

use std::fs::{self, File, TryLockError};
use std::io::{Read, Seek, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use rotordyn::error::Error;
use rotordyn::io::atomic_file::remove_abandoned_parts;

use super::failure::Failure;
use super::system::{host_name, is_same_file};
use super::terminal::Terminal;

/// Name of the lock in the folder; it exists while a command writes there.
const NAME: &str = ".rotordyn.lock";

/// The lock of an output folder, released when dropped.
///
/// The operating system keeps it (`flock`, `LockFileEx`), so that the lock of a program that was killed is free; the
/// file says who holds it.
#[derive(Debug)]
pub struct FolderLock {
    path: PathBuf,
    /// Folders that did not exist before, the outermost first.
    created: Vec<PathBuf>,
    /// `None` on a file system without locks.
    file: Option<File>,
}

impl FolderLock {
    /// Takes the lock of a folder, which is created.
    ///
    /// # Errors
    /// Another command holds it, which the message names; the folder cannot be written to.
    pub fn take(folder: &Path, terminal: &Terminal) -> Result<Self, Failure> {
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        let mut missing: Vec<PathBuf> =
            folder.ancestors().take_while(|path| !path.exists()).map(Path::to_path_buf).collect();
        missing.reverse();
        let path = folder.join(NAME);
        let mut lock = Self { path, created: missing, file: None };
        loop {
            fs::create_dir_all(folder).map_err(|e| Failure::environment("create folder", folder, e))?;
            let failed = |error| Failure::environment("lock", folder, error);
            let file = File::options().read(true).write(true).create(true).truncate(false).open(&lock.path);
            let mut file = file.map_err(failed)?;
            match file.try_lock() {
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => return Err(held(folder, &mut file)),
                Err(TryLockError::Error(error)) => {
                    terminal.note(&format!("{} cannot be locked: {error}", folder.display()));
                    break;
                }
            }
            // Its former holder may have removed it after it was opened here.
            if !is_same_file(&file, &lock.path) {
                continue;
            }
            if let Some(former) = holder(&mut file) {
                terminal.note(&format!(
                    "{}: took over the lock of {former}, which did not end by itself",
                    folder.display()
                ));
            }
            file.set_len(0)
                .and_then(|()| file.rewind())
                .and_then(|()| file.write_all(own_line().as_bytes()))
                .map_err(failed)?;
            lock.file = Some(file);
            break;
        }
        [folder.to_path_buf(), folder.join("csv")].iter().for_each(|folder| remove_abandoned_parts(folder));
        Ok(lock)
    }
}

impl Drop for FolderLock {
    fn drop(&mut self) {
        if self.file.is_some() {
            // Removed while it is locked; whoever has opened it before sees that it is gone. What cannot be removed is
            // a free lock.
            let _ = fs::remove_file(&self.path);
        }
        // Folders that stayed empty, because of an error before anything was written.
        self.created.iter().rev().for_each(|folder| drop(fs::remove_dir(folder)));
    }
}

/// "process 4711 on HOST since 2026-01-31T12:00:00Z: rotordyn run model.toml".
fn own_line() -> String {
    let command: Vec<String> = std::env::args().skip(1).collect();
    format!(
        "process {} on {} since {}: rotordyn {}\n",
        std::process::id(),
        host_name(),
        humantime::format_rfc3339_seconds(SystemTime::now()),
        command.join(" ")
    )
}

/// What a lock says of its holder.
fn holder(file: &mut File) -> Option<String> {
    let mut text = String::new();
    // One that cannot be read names nobody.
    let _ = file.rewind().and_then(|()| file.read_to_string(&mut text));
    Some(text.trim().to_string()).filter(|text| !text.is_empty())
}

fn held(folder: &Path, file: &mut File) -> Failure {
    // The holder writes its name right after it has taken the lock.
    let named = (0..20).find_map(|attempt| {
        std::thread::sleep(Duration::from_millis(if attempt == 0 { 0 } else { 10 }));
        holder(file)
    });
    let who = named.unwrap_or_else(|| "an unnamed process".into());
    let message = format!(
        "another command writes there: {who}; wait until it ends, or choose another folder with --out"
    );
    Error::of_file("write to", folder)(message).into()
}

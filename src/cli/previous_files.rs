//! Figures and tables of earlier results: those that new results do not replace go to a folder of their own.

use std::path::{Path, PathBuf};

use rotordyn::error::Error;
use rotordyn::io::hdf5::open_reader;
use rotordyn::io::results_file;

use super::failure::Failure;
use super::limits::limits;
use super::terminal::Terminal;

/// Folder of the figures and tables that are not of the results beside it.
const FOLDER: &str = "previous";

/// Files that earlier results list, relative to their folder; no others are ever moved.
#[derive(Clone, Debug, Default)]
pub struct EarlierFiles {
    files: Vec<String>,
}

/// The files listed in a results file.
pub fn of(results: &Path) -> Result<EarlierFiles, Error> {
    Ok(EarlierFiles { files: results_file::stored_files(&*open_reader(results, limits())?)? })
}

impl EarlierFiles {
    /// Moves the files that are not among the new ones to the folder `previous`, and says so.
    ///
    /// # Errors
    /// A file cannot be moved.
    pub fn move_aside(&self, folder: &Path, new: &[String], terminal: &Terminal) -> Result<(), Failure> {
        let mut moved = 0;
        for name in self.files.iter().filter(|name| !new.contains(name)) {
            let (from, to) = (folder.join(name), folder.join(FOLDER).join(name));
            // A name from a file is followed only downwards.
            let below =
                Path::new(name).components().all(|part| matches!(part, std::path::Component::Normal(_)));
            if !below || !from.is_file() {
                continue;
            }
            if let Some(parent) = to.parent() {
                std::fs::create_dir_all(parent)
                    .map_err(|e| Failure::environment("create folder", parent, e))?;
            }
            std::fs::rename(&from, free_name(&to)).map_err(|e| Failure::environment("move", &from, e))?;
            moved += 1;
        }
        if moved > 0 {
            let place = folder.join(FOLDER);
            terminal.print(&format!(
                "{moved} figures and tables of earlier results moved to {}",
                place.display()
            ));
        }
        Ok(())
    }
}

/// A path that no file has: "campbell.svg", "campbell~2.svg" ...
fn free_name(path: &Path) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let extension = path.extension().map_or(String::new(), |e| format!(".{}", e.to_string_lossy()));
    let numbered = (2..).map(|k| path.with_file_name(format!("{stem}~{k}{extension}")));
    // The numbers do not end.
    std::iter::once(path.to_path_buf()).chain(numbered).find(|path| !path.exists()).unwrap_or_default()
}

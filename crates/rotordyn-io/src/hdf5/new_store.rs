//! Files written under a temporary name and renamed when they are complete.

use super::Store;
use crate::atomic_file::NewFile;
use crate::error::Error;
use hdf5::OpenMode;
use std::path::Path;

impl Store {
    /// A new file that takes the place of `path` when it is [committed](Self::commit); its folder is created.
    ///
    /// # Errors
    /// It cannot be created.
    pub fn replace(path: impl AsRef<Path>) -> Result<Store, Error> {
        let path = path.as_ref();
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder).map_err(Error::of_file("create the folder of", path))?;
        }
        Store::under_temporary_name(path, OpenMode::CreateExcl)
    }

    /// A copy of the file `from`, open for changes, that takes the place of `path` when it is
    /// [committed](Self::commit); the two may be the same.
    ///
    /// # Errors
    /// `from` cannot be read, or the copy not be written.
    pub fn replace_with_copy(path: impl AsRef<Path>, from: &Path) -> Result<Store, Error> {
        let path = path.as_ref();
        let new = NewFile::replacing(path);
        std::fs::copy(from, new.part()).map_err(Error::of_file("copy", from))?;
        Store::opened(path, new, OpenMode::ReadWrite)
    }

    fn under_temporary_name(path: &Path, mode: OpenMode) -> Result<Store, Error> {
        Store::opened(path, NewFile::replacing(path), mode)
    }

    fn opened(path: &Path, new: NewFile, mode: OpenMode) -> Result<Store, Error> {
        let mut store = Store::open_as(new.part(), mode, "create")
            .map_err(|error| Error::of_file("create", path)(cause(error)))?;
        store.path = path.into();
        store.new = Some(new);
        Ok(store)
    }

    /// Closes the file, syncs it to the disk and gives it its name; `before` is called when all of it is on the disk.
    ///
    /// # Errors
    /// It cannot be written; the former file is unchanged. That of `before`.
    pub fn commit_after(self, before: impl FnOnce() -> Result<(), Error>) -> Result<(), Error> {
        let Store { file, path, new } = self;
        let failed = |error: &dyn std::fmt::Display| Error::of_file("write", &path)(error.to_string());
        file.close().map_err(|error| failed(&error))?;
        let Some(new) = new else { return before() };
        new.sync().map_err(|error| failed(&error))?;
        before()?;
        new.publish().map_err(|error| failed(&error))
    }

    /// Closes the file, syncs it to the disk and gives it its name.
    ///
    /// # Errors
    /// It cannot be written; the former file is unchanged.
    pub fn commit(self) -> Result<(), Error> {
        self.commit_after(|| Ok(()))
    }
}

/// What failed, without the temporary name.
fn cause(error: Error) -> Box<dyn std::error::Error + Send + Sync> {
    match error {
        Error::Environment { source, .. } => source,
        other => Box::new(other),
    }
}

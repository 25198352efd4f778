//! The library's handle of an open file.

use hdf5::{Dataset, File};
use std::ops::Deref;
use std::sync::atomic::{AtomicBool, Ordering};

/// An open file that is not closed after a failed write.
///
/// What could not be written stays in the library's memory; when a data set is closed with it, the next flush of any file
/// follows a null pointer. So the handles of a file whose disk is full are left open until the program ends.
#[derive(Debug)]
pub(super) struct Handle {
    /// `None` only while it is dropped or closed.
    file: Option<File>,
    failed: AtomicBool,
}

impl Handle {
    pub fn new(file: File) -> Self {
        Self { file: Some(file), failed: AtomicBool::new(false) }
    }

    /// Writes what is in memory while `datasets` are open, which then are closed if that succeeds.
    pub fn flush_open(&self, datasets: Vec<Dataset>, written: hdf5::Result<()>) -> hdf5::Result<()> {
        let flushed = written.and_then(|()| self.flush());
        if flushed.is_err() {
            self.keep_open();
            datasets.into_iter().for_each(std::mem::forget);
        }
        flushed
    }

    /// Leaves the file open until the program ends: something could not be written.
    pub fn keep_open(&self) {
        self.failed.store(true, Ordering::Relaxed);
    }

    /// Writes what is in memory and closes the file.
    pub fn close(mut self) -> hdf5::Result<()> {
        self.flush_open(Vec::new(), Ok(()))?;
        // Nothing has failed since it was opened.
        self.file.take().map_or(Ok(()), File::close)
    }
}

impl Deref for Handle {
    type Target = File;

    fn deref(&self) -> &File {
        self.file.as_ref().expect("a handle has its file until it is dropped")
    }
}

impl Drop for Handle {
    fn drop(&mut self) {
        if self.failed.load(Ordering::Relaxed) {
            std::mem::forget(self.file.take());
        }
    }
}

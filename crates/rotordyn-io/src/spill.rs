//! Numbers that a long computation keeps on disk instead of in memory, in a temporary file that vanishes with the program.

use rotordyn_core::series::{Series, SeriesError, SeriesSource};
use std::fs::File;
use std::io::{Read, Seek, SeekFrom, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Numbers below which memory is not worth a file: 1 MB.
const SMALL: usize = 131_072;
/// Bytes of a number.
const BYTES: u64 = 8;

/// A temporary file of numbers, created when it is needed.
#[derive(Debug)]
pub struct Spill {
    folder: PathBuf,
    file: Option<Arc<Mutex<File>>>,
    /// Numbers written.
    length: u64,
}

impl Spill {
    /// A file in a folder, which must exist when the first numbers are kept.
    pub fn new(folder: &Path) -> Self {
        Self { folder: folder.into(), file: None, length: 0 }
    }

    /// Keeps numbers: few in memory, many in the file.
    ///
    /// # Errors
    /// The file cannot be created or written.
    pub fn keep(&mut self, values: Vec<f64>) -> Result<Series, SeriesError> {
        if values.len() < SMALL {
            return Ok(values.into());
        }
        let place = format!("temporary file in {}", self.folder.display());
        let failed = |error: std::io::Error| SeriesError { place: place.clone(), reason: error.to_string() };
        let file = match &self.file {
            Some(file) => file.clone(),
            None => {
                let file = tempfile::tempfile_in(&self.folder).map_err(failed)?;
                self.file.insert(Arc::new(Mutex::new(file))).clone()
            }
        };
        let first = self.length;
        let mut open = locked(&file);
        open.seek(SeekFrom::Start(BYTES * first)).map_err(failed)?;
        for block in values.chunks(SMALL) {
            let bytes: Vec<u8> = block.iter().flat_map(|value| value.to_ne_bytes()).collect();
            open.write_all(&bytes).map_err(failed)?;
        }
        drop(open);
        self.length += values.len() as u64;
        Ok(Series::stored(Kept { file, place, first, length: values.len() }))
    }
}

/// Numbers of a temporary file.
struct Kept {
    file: Arc<Mutex<File>>,
    place: String,
    first: u64,
    length: usize,
}

impl SeriesSource for Kept {
    fn len(&self) -> usize {
        self.length
    }

    fn read(&self, range: Range<usize>) -> Result<Vec<f64>, SeriesError> {
        let mut bytes = vec![0; range.len() * BYTES as usize];
        let mut file = locked(&self.file);
        file.seek(SeekFrom::Start(BYTES * (self.first + range.start as u64)))
            .and_then(|_| file.read_exact(&mut bytes))
            .map_err(|error| SeriesError { place: self.place.clone(), reason: error.to_string() })?;
        let (values, _) = bytes.as_chunks();
        Ok(values.iter().map(|value| f64::from_ne_bytes(*value)).collect())
    }
}

/// The file; every use sets its position anew, so that one that was interrupted leaves nothing wrong.
fn locked(file: &Mutex<File>) -> MutexGuard<'_, File> {
    file.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kept_numbers_come_back_bit_for_bit_and_leave_no_file() {
        let folder = tempfile::tempdir().unwrap();
        let mut spill = Spill::new(folder.path());
        let first: Vec<f64> = (0..SMALL + 3).map(|k| (k as f64).sqrt()).chain([f64::NAN, -0.0]).collect();
        let second: Vec<f64> = (0..2 * SMALL).map(|k| 1.0 / k as f64).collect();
        let kept = [spill.keep(first.clone()).unwrap(), spill.keep(second.clone()).unwrap()];
        assert!(kept.iter().all(|kept| kept.in_memory().is_none()));
        assert!(spill.keep(vec![1.0]).unwrap().in_memory().is_some());
        drop(spill);
        for (kept, expected) in kept.iter().zip([&first, &second]) {
            let bits = |values: &[f64]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(&kept.all().unwrap()), bits(expected));
            assert_eq!(kept.read(SMALL - 1..SMALL + 1).unwrap(), &expected[SMALL - 1..SMALL + 1]);
        }
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }

    #[test]
    fn a_missing_folder_is_an_error() {
        let folder = tempfile::tempdir().unwrap();
        let error = Spill::new(&folder.path().join("none")).keep(vec![0.0; SMALL]).unwrap_err();
        assert!(error.place.contains("none"), "{error}");
    }
}

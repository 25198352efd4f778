//! What reading a foreign file may cost: its bytes, the memory of its contents, the number of its objects.
//!
//! Sizes that a file states are held against the bytes that are there and against the budget before anything is
//! allocated. The memory allowed follows from the file's size, so that a small file cannot ask for much: this bounds the
//! ratio by which compressed data may grow, too. A stated limit replaces it.

use std::cell::Cell;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use crate::error::Error;

/// Memory for the contents of a file of any size \[bytes\].
const BASE_MEMORY: u64 = 64_000_000;
/// Memory per byte of the file: text of one digit and a separator becomes 8 bytes, 8-bit samples 8, and records are
/// copies of the arrays that were read.
const MEMORY_PER_BYTE: u64 = 32;
/// Memory that only a stated limit exceeds \[bytes\].
const MAX_MEMORY: u64 = 8_000_000_000;
/// Channels, arrays or shapes of a file; more are no measurement.
const MAX_OBJECTS: u64 = 100_000;
/// Memory of a stated limit that allows one object more \[bytes\].
const MEMORY_PER_OBJECT: u64 = 10_000;
/// Levels of groups, structures or cells within each other.
pub const MAX_DEPTH: usize = 64;
/// Dimensions of an array (NumPy allows 64, HDF5 32).
pub const MAX_DIMENSIONS: usize = 64;

/// Limits for reading foreign files, and how HDF5 files are read.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Limits {
    /// Memory for the contents of one file \[bytes\]; `None`: 64 MB and 32 times the size of the file, at most 8 GB.
    pub memory: Option<u64>,
    /// Program that reads HDF5 files in a process of its own, so that a crash of the HDF5 library is an error: the
    /// executable of rotordyn. `None`: they are read in this process.
    pub hdf5_program: Option<PathBuf>,
}

impl Limits {
    /// Memory for the contents of a file of `size` bytes \[bytes\].
    pub fn memory_of(&self, size: u64) -> u64 {
        let usual = BASE_MEMORY.saturating_add(size.saturating_mul(MEMORY_PER_BYTE)).min(MAX_MEMORY);
        self.memory.unwrap_or(usual)
    }
}

/// A request beyond the budget of a file: what it is for, and how much is needed and allowed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{what} would need {needed}, more than the {allowed} allowed for this file")]
pub struct Exceeded {
    what: String,
    needed: String,
    allowed: String,
    raised_by: u64,
}

impl Exceeded {
    /// How to allow it.
    pub fn advice(&self) -> String {
        format!(
            "if the file is sound, allow it with --read-limit {}",
            bytes_text(self.raised_by).replace(' ', "")
        )
    }

    /// The error of a file.
    pub fn of_file(self, path: &Path) -> Error {
        Error::Content { path: path.into(), advice: self.advice(), problem: self.to_string() }
    }
}

/// What is left for reading one file.
#[derive(Debug)]
pub struct Budget {
    memory: u64,
    used: Cell<u64>,
    max_objects: u64,
    objects: Cell<u64>,
}

impl Budget {
    /// The budget of a file of `size` bytes.
    pub fn new(limits: &Limits, size: u64) -> Self {
        let memory = limits.memory_of(size);
        let max_objects = MAX_OBJECTS.max(limits.memory.unwrap_or(0) / MEMORY_PER_OBJECT);
        Self { memory, used: Cell::new(0), max_objects, objects: Cell::new(0) }
    }

    /// A budget of `memory` bytes.
    pub fn of_memory(memory: u64) -> Self {
        Self::new(&Limits { memory: Some(memory), hdf5_program: None }, 0)
    }

    /// Takes `bytes` for `what` ("the array `x`").
    ///
    /// # Errors
    /// More than is left.
    pub fn take(&self, what: impl Fn() -> String, bytes: u64) -> Result<(), Exceeded> {
        let total = self.used.get().saturating_add(bytes);
        if total > self.memory {
            return Err(self.exceeded(what(), bytes));
        }
        self.used.set(total);
        Ok(())
    }

    /// Takes the memory of `count` values of type `T`.
    ///
    /// # Errors
    /// As [`Budget::take`].
    pub fn take_values<T>(&self, what: impl Fn() -> String, count: usize) -> Result<(), Exceeded> {
        let bytes = (count as u64).saturating_mul(size_of::<T>() as u64);
        self.take(what, bytes)
    }

    /// Returns memory that is no longer used.
    pub fn give_back(&self, bytes: usize) {
        self.used.set(self.used.get().saturating_sub(bytes as u64));
    }

    /// An empty list for `count` values, taken from the budget.
    ///
    /// # Errors
    /// As [`Budget::take`], or the system has not as much memory.
    pub fn list<T>(&self, what: impl Fn() -> String, count: usize) -> Result<Vec<T>, Exceeded> {
        self.take_values::<T>(&what, count)?;
        let mut list = Vec::new();
        let bytes = (count as u64).saturating_mul(size_of::<T>() as u64);
        list.try_reserve_exact(count).map_err(|_| self.exceeded(what(), bytes))?;
        Ok(list)
    }

    /// Counts `count` channels, arrays or other objects.
    ///
    /// # Errors
    /// More than are allowed.
    pub fn objects(&self, what: &str, count: usize) -> Result<(), Exceeded> {
        self.check_objects(what, count)?;
        self.objects.set(self.objects.get() + count as u64);
        Ok(())
    }

    /// Whether `count` objects more are allowed.
    ///
    /// # Errors
    /// As [`Budget::objects`].
    pub fn check_objects(&self, what: &str, count: usize) -> Result<(), Exceeded> {
        let total = self.objects.get().saturating_add(count as u64);
        if total > self.max_objects {
            return Err(Exceeded {
                what: "it".into(),
                needed: format!("{total} {what} or more"),
                allowed: self.max_objects.to_string(),
                raised_by: total.saturating_mul(MEMORY_PER_OBJECT),
            });
        }
        Ok(())
    }

    /// Memory that is left \[bytes\].
    pub fn left(&self) -> u64 {
        self.memory.saturating_sub(self.used.get())
    }

    fn exceeded(&self, what: String, bytes: u64) -> Exceeded {
        let total = self.used.get().saturating_add(bytes);
        Exceeded {
            what,
            needed: bytes_text(total),
            allowed: bytes_text(self.memory),
            raised_by: total.saturating_add(total / 4),
        }
    }
}

/// Bytes with a unit and three digits, rounded up: "1.21 GB".
pub fn bytes_text(bytes: u64) -> String {
    let units = ["B", "kB", "MB", "GB", "TB", "PB", "EB"];
    let (mut value, mut unit) = (bytes as f64, 0);
    while value >= 999.5 && unit + 1 < units.len() {
        value /= 1e3;
        unit += 1;
    }
    let digits = if value >= 99.5 || unit == 0 {
        0
    } else if value >= 9.95 {
        1
    } else {
        2
    };
    let scale = 10_f64.powi(digits);
    // Some bytes more than a round size do not make it the next one.
    // Nor has zero a sign.
    format!("{} {}", ((value * scale - 1e-3).ceil() + 0.0) / scale, units[unit])
}

/// A file as bytes, with the budget of its contents, from which they are taken.
///
/// # Errors
/// The file cannot be read, is no regular file (a device or a pipe never ends), or is larger than the budget.
pub fn read_file(path: &Path, limits: &Limits) -> Result<(Vec<u8>, Budget), Error> {
    let read_error = Error::of_file::<std::io::Error>("read", path);
    let file = File::open(path).map_err(&read_error)?;
    let size = regular_size(path, &file)?;
    let budget = Budget::new(limits, size);
    let stated = usize::try_from(size).unwrap_or(usize::MAX);
    let mut bytes = budget.list(|| "the file".into(), stated).map_err(|e| e.of_file(path))?;
    // Files of /proc have no size, others may grow while they are read.
    let limit = budget.left().saturating_add(size);
    file.take(limit.saturating_add(1)).read_to_end(&mut bytes).map_err(&read_error)?;
    let more = (bytes.len() as u64).saturating_sub(size);
    budget.take(|| "the file".into(), more).map_err(|e| e.of_file(path))?;
    Ok((bytes, budget))
}

/// Size of an open file \[bytes\].
///
/// # Errors
/// It cannot be asked, or the file is a folder, a device or a pipe.
pub fn regular_size(path: &Path, file: &File) -> Result<u64, Error> {
    let about = file.metadata().map_err(Error::of_file("read", path))?;
    if about.is_file() {
        return Ok(about.len());
    }
    Err(Error::Content {
        path: path.into(),
        problem: if about.is_dir() { "it is a folder".into() } else { "it is a device or a pipe".into() },
        advice: "give a regular file".into(),
    })
}

/// A text file in UTF-8.
///
/// # Errors
/// As [`read_file`], or the file is not text in UTF-8.
pub fn read_text(path: &Path, limits: &Limits) -> Result<String, Error> {
    let (bytes, _) = read_file(path, limits)?;
    String::from_utf8(bytes).map_err(|error| Error::Content {
        path: path.into(),
        problem: format!("byte {} is not UTF-8 text", error.utf8_error().valid_up_to() + 1),
        advice: "save it as UTF-8".into(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn budget_follows_the_size_of_the_file_or_the_stated_limit() {
        let usual = Limits::default();
        assert_eq!(usual.memory_of(0), 64_000_000);
        assert_eq!(usual.memory_of(1_000_000), 96_000_000);
        assert_eq!(usual.memory_of(u64::MAX), 8_000_000_000);
        let stated = Limits { memory: Some(10), ..Limits::default() };
        assert_eq!(stated.memory_of(u64::MAX), 10);
    }

    #[test]
    fn exceeded_budget_names_what_and_the_flag() {
        let budget = Budget::new(&Limits { memory: Some(1000), ..Limits::default() }, 5);
        budget.take_values::<f64>(|| "a".into(), 100).unwrap();
        budget.give_back(400);
        budget.take_values::<f64>(|| "a".into(), 75).unwrap();
        let error = budget.take(|| "the array `x`".into(), 1).unwrap_err();
        assert_eq!(
            error.to_string(),
            "the array `x` would need 1.01 kB, more than the 1 kB allowed for this file"
        );
        assert_eq!(error.advice(), "if the file is sound, allow it with --read-limit 1.26kB");
        // A count whose size overflows is as good as any other that is too large.
        assert!(budget.take_values::<f64>(|| "x".into(), usize::MAX).is_err());
        assert!(budget.list::<[u64; 4]>(|| "x".into(), usize::MAX / 2).is_err());
        let error = budget.objects("channels", 100_001).unwrap_err();
        assert!(
            error.to_string().starts_with("it would need 100001 channels or more, more than the 100000"),
            "{error}"
        );
        // What the advice says is enough.
        let raised = Limits { memory: Some(error.raised_by), ..Limits::default() };
        Budget::new(&raised, 5).objects("channels", 100_001).unwrap();
    }

    #[test]
    fn sizes_have_three_digits_and_are_rounded_up() {
        let texts = [
            (0, "0 B"),
            (999, "999 B"),
            (1000, "1 kB"),
            (1001, "1.01 kB"),
            (96_000_000, "96 MB"),
            (999_600, "1 MB"),
            (8_123_456_789, "8.13 GB"),
            (u64::MAX, "18.5 EB"),
        ];
        for (bytes, text) in texts {
            assert_eq!(bytes_text(bytes), text);
        }
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_device_is_no_file_and_a_file_without_size_is_read() {
        let error = read_file(Path::new("/dev/zero"), &Limits::default()).unwrap_err();
        assert!(error.to_string().contains("it is a device or a pipe"), "{error}");
        let error = read_file(Path::new("/"), &Limits::default()).unwrap_err();
        assert!(error.to_string().contains("it is a folder"), "{error}");
        let (bytes, _) = read_file(Path::new("/proc/self/status"), &Limits::default()).unwrap();
        assert!(bytes.starts_with(b"Name:"));
    }
}

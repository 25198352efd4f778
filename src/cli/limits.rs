//! Limits for reading files of others (`--read-limit`), and how HDF5 files are read: by this program, started again.

use std::path::PathBuf;
use std::sync::OnceLock;

use rotordyn::io::budget::Limits;

static LIMITS: OnceLock<Limits> = OnceLock::new();

/// Sets the limits for the whole run of the program, at its start; `memory` \[bytes\] is that of the flag.
pub fn set(memory: Option<u64>, hdf5_program: Option<PathBuf>) {
    // Only the first call sets them, and there is one.
    let _ = LIMITS.set(Limits { memory, hdf5_program });
}

/// The limits for reading files.
pub fn limits() -> &'static Limits {
    LIMITS.get_or_init(|| Limits { memory: None, hdf5_program: program() })
}

/// This program. On Linux it is found even if its file was replaced since it was started.
pub fn program() -> Option<PathBuf> {
    let running = PathBuf::from("/proc/self/exe");
    if cfg!(target_os = "linux") && running.exists() { Some(running) } else { std::env::current_exe().ok() }
}

/// Parses a size, "500 MB", "8GB", "2 GiB", as bytes.
pub fn size(text: &str) -> Result<u64, String> {
    let text = text.trim();
    let end = text.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(text.len());
    let (number, unit) = text.split_at(end);
    let factor = match unit.trim().to_ascii_lowercase().as_str() {
        "b" => 1.0,
        "kb" => 1e3,
        "mb" => 1e6,
        "gb" => 1e9,
        "tb" => 1e12,
        "pb" => 1e15,
        "eb" => 1e18,
        "kib" => f64::from(1 << 10),
        "mib" => f64::from(1 << 20),
        "gib" => f64::from(1 << 30),
        _ => return Err("give a size with its unit, such as 500MB, 8GB or 2GiB".into()),
    };
    match number.parse::<f64>() {
        Ok(number) if number > 0.0 => Ok((number * factor) as u64),
        _ => Err("give a size greater than zero, such as 8GB".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::size;

    #[test]
    fn sizes_have_units() {
        for (text, bytes) in [("8GB", 8_000_000_000), ("1.5 kb", 1500), ("2 GiB", 2 << 30), ("7B", 7)] {
            assert_eq!(size(text), Ok(bytes), "{text}");
        }
        for wrong in ["", "8", "GB", "0 GB", "-1 GB", "1e3 MB", "1..2 MB", "8 Gb/s"] {
            assert!(size(wrong).is_err(), "{wrong}");
        }
    }
}

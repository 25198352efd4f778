//! Results saved by programs that use the library, and loaded again without any loss.
//!
//! Any result, [`Results`](rotordyn_core::study::Results) as well as that of one study. The file holds two MessagePack
//! values: a header and the result, structures as maps by field names. NaN and infinite values keep their bits. Results
//! for other programs are in JSON and HDF5.

use crate::atomic_file;
use crate::error::Error;
use rmp_serde::decode::Error as DecodeError;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::fs::File;
use std::io::{BufReader, BufWriter};
use std::path::Path;

/// Name and version of the format.
const FORMAT: &str = "rotordyn-saved-results-2";

#[derive(Serialize, Deserialize)]
struct Header {
    format: String,
    /// Version of the program that wrote the file.
    version: String,
}

/// Saves a result; an existing file is replaced when the new one is complete.
///
/// # Errors
/// The file cannot be written.
pub fn save<T: Serialize>(path: impl AsRef<Path>, result: &T) -> Result<(), Error> {
    let path = path.as_ref();
    let header = Header { format: FORMAT.into(), version: env!("CARGO_PKG_VERSION").into() };
    let write = |out: &mut BufWriter<File>| -> Result<(), rmp_serde::encode::Error> {
        rmp_serde::encode::write_named(out, &header)?;
        rmp_serde::encode::write_named(out, result)
    };
    atomic_file::write_with(path, |out| write(out).map_err(std::io::Error::other))
        .map_err(Error::of_file("write", path))
}

/// A value as MessagePack, without the header of a file.
///
/// # Errors
/// A value that has no such form.
pub fn to_bytes<T: Serialize>(value: &T) -> Result<Vec<u8>, String> {
    rmp_serde::to_vec_named(value).map_err(|error| error.to_string())
}

/// The value of [`to_bytes`].
///
/// # Errors
/// Bytes of another value: the place in it and the reason.
pub fn from_bytes<T: DeserializeOwned>(bytes: &[u8]) -> Result<T, String> {
    let mut from = rmp_serde::Deserializer::from_read_ref(bytes);
    serde_path_to_error::deserialize(&mut from)
        .map_err(|error| format!("{}: {}", error.path(), error.inner()))
}

/// Loads a result saved by [`save`] from the same type.
///
/// # Errors
/// The file cannot be read, or holds another format or another result; names the place in the result.
pub fn load<T: DeserializeOwned>(path: impl AsRef<Path>) -> Result<T, Error> {
    let path = path.as_ref();
    let file = File::open(path).map_err(Error::of_file("open", path))?;
    let mut reader = rmp_serde::Deserializer::new(BufReader::new(file));
    match Header::deserialize(&mut reader) {
        Ok(header) if header.format == FORMAT => {}
        Ok(header) => {
            let message = format!("its format is {:?} instead of {FORMAT:?}", header.format);
            return Err(Error::of_file("read", path)(message));
        }
        Err(DecodeError::InvalidMarkerRead(e) | DecodeError::InvalidDataRead(e))
            if e.kind() != std::io::ErrorKind::UnexpectedEof =>
        {
            return Err(Error::of_file("read", path)(e));
        }
        Err(_) => return Err(Error::of_file("read", path)("it contains no results saved by rotordyn")),
    }
    serde_path_to_error::deserialize(&mut reader)
        .map_err(|e| Error::of_file("read", path)(format!("at {}: {}", e.path(), e.inner())))
}

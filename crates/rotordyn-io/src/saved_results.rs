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
use serde_path_to_error::Track;
use std::fs::File;
use std::io::{BufReader, Read, Write};
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
    atomic_file::write_with(path, |out| {
        encode(out, &header).and_then(|()| encode(out, result)).map_err(std::io::Error::other)
    })
    .map_err(Error::of_file("write", path))
}

/// A value as MessagePack, without the header of a file.
///
/// # Errors
/// A value that has no such form.
pub fn to_bytes<T: Serialize>(value: &T) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    encode(&mut bytes, value).map_err(|error| error.to_string())?;
    Ok(bytes)
}

/// The value of [`to_bytes`].
///
/// # Errors
/// Bytes of another value: the place in it and the reason.
pub fn from_bytes<T: DeserializeOwned>(mut bytes: &[u8]) -> Result<T, String> {
    let bytes: &mut dyn Read = &mut bytes;
    decode(&mut rmp_serde::Deserializer::new(bytes)).map_err(|(place, why)| format!("{place}: {why}"))
}

/// Loads a result saved by [`save`] from the same type.
///
/// # Errors
/// The file cannot be read, or holds another format or another result; names the place in the result.
pub fn load<T: DeserializeOwned>(path: impl AsRef<Path>) -> Result<T, Error> {
    let path = path.as_ref();
    let mut file = BufReader::new(File::open(path).map_err(Error::of_file("open", path))?);
    let file: &mut dyn Read = &mut file;
    let mut reader = rmp_serde::Deserializer::new(file);
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
    decode(&mut reader).map_err(|(place, why)| Error::of_file("read", path)(format!("at {place}: {why}")))
}

type Reader<'a> = rmp_serde::Deserializer<rmp_serde::decode::ReadReader<&'a mut dyn Read>>;

// Both go through trait objects, so that the many types of a result are compiled for one serializer and one
// deserializer: compiled for each reader and for the tracking of places, they took four minutes.

fn encode(out: &mut dyn Write, value: &dyn erased_serde::Serialize) -> Result<(), rmp_serde::encode::Error> {
    rmp_serde::encode::write_named(&mut { out }, value)
}

/// The next value, or the place in it and the reason why there is none.
fn decode<T: DeserializeOwned>(reader: &mut Reader<'_>) -> Result<T, (String, String)> {
    let mut track = Track::new();
    let tracked = serde_path_to_error::Deserializer::new(reader, &mut track);
    let value = erased_serde::deserialize(&mut <dyn erased_serde::Deserializer>::erase(tracked));
    value.map_err(|why| (track.path().to_string(), why.to_string()))
}

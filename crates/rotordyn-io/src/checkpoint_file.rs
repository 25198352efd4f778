//! The checkpoint of a run that is under way, in one file that is replaced as a whole.
//!
//! A line with the format, then blocks of bytes, each after its length, then a check sum over all. A block is a value as
//! MessagePack, in which NaN and infinite values keep their bits.

use crate::error::Error;
use crate::inflate::crc32;
use crate::{atomic_file, saved_results};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::path::Path;

/// First line of the file.
const FORMAT: &[u8] = b"rotordyn-checkpoint-2\n";
const LENGTH_BYTES: usize = size_of::<u64>();
const SUM_BYTES: usize = size_of::<u32>();

/// A value as a block of bytes.
///
/// # Errors
/// A value that MessagePack cannot hold.
pub fn encode<T: Serialize>(value: &T) -> Result<Vec<u8>, Error> {
    saved_results::to_bytes(value).map_err(Error::of_file("encode", Path::new("the checkpoint")))
}

/// The value of a block; `path` is that of its file, for messages.
///
/// # Errors
/// A block of another value; names the place in it.
pub fn decode<T: DeserializeOwned>(path: &Path, block: &[u8]) -> Result<T, Error> {
    saved_results::from_bytes(block).map_err(|why| content(path, format!("it cannot be read at {why}")))
}

/// Writes blocks to a file, synced to the disk; until then the former file is unchanged.
///
/// # Errors
/// The file cannot be written.
pub fn save(path: &Path, blocks: &[&[u8]]) -> Result<(), Error> {
    let mut bytes = FORMAT.to_vec();
    for block in blocks {
        bytes.extend((block.len() as u64).to_le_bytes());
        bytes.extend(*block);
    }
    bytes.extend(crc32(&bytes).to_le_bytes());
    atomic_file::write(path, &bytes).map_err(Error::of_file("write", path))
}

/// Reads the blocks of a file; `None` if there is no such file.
///
/// # Errors
/// The file cannot be read, is none of this format or is damaged.
pub fn load(path: &Path) -> Result<Option<Vec<Vec<u8>>>, Error> {
    let bytes = match std::fs::read(path) {
        Ok(bytes) => bytes,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(Error::of_file("read", path)(error)),
    };
    let Some(rest) = bytes.strip_prefix(FORMAT) else {
        return Err(content(path, "it is no checkpoint of this version of rotordyn".into()));
    };
    let damaged = || content(path, "it is damaged: its check sum is another one".into());
    let (rest, stored) = rest.split_last_chunk::<SUM_BYTES>().ok_or_else(damaged)?;
    if crc32(&bytes[..bytes.len() - SUM_BYTES]) != u32::from_le_bytes(*stored) {
        return Err(damaged());
    }
    let (mut blocks, mut rest) = (Vec::new(), rest);
    while let Some((length, behind)) = rest.split_first_chunk::<LENGTH_BYTES>() {
        let length = usize::try_from(u64::from_le_bytes(*length)).map_err(|_| damaged())?;
        let (block, behind) = behind.split_at_checked(length).ok_or_else(damaged)?;
        blocks.push(block.to_vec());
        rest = behind;
    }
    Ok(Some(blocks))
}

fn content(path: &Path, problem: String) -> Error {
    Error::Content { path: path.into(), problem, advice: "start afresh without --resume".into() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_come_back_and_every_changed_byte_is_noticed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("checkpoint.bin");
        assert_eq!(load(&path).unwrap(), None);
        let values = vec![f64::from_bits(0x7ff8_0000_0000_1234), -0.0, f64::INFINITY, 0.1];
        let blocks = [encode(&values).unwrap(), encode(&"text").unwrap(), Vec::new()];
        save(&path, &blocks.each_ref().map(Vec::as_slice)).unwrap();
        let found = load(&path).unwrap().unwrap();
        assert_eq!(found, blocks);
        let back: Vec<f64> = decode(&path, &found[0]).unwrap();
        assert!(back.iter().zip(&values).all(|(a, b)| a.to_bits() == b.to_bits()), "{back:?}");
        let error = decode::<Vec<f64>>(&path, &found[1]).unwrap_err().to_string();
        assert!(error.contains("cannot be read at"), "{error}");

        let whole = std::fs::read(&path).unwrap();
        for place in 0..whole.len() {
            let mut damaged = whole.clone();
            damaged[place] ^= 4;
            std::fs::write(&path, &damaged).unwrap();
            assert!(load(&path).is_err(), "byte {place}");
            std::fs::write(&path, &whole[..place]).unwrap();
            assert!(load(&path).is_err(), "cut after {place} bytes");
        }
    }
}

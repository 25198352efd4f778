//! Decompression (inflate) of the zlib streams in .mat files.
//!
//! The only module that uses the flate2 crate.

use flate2::read::ZlibDecoder;
use std::io::Read;

/// Inflates a zlib stream.
///
/// # Errors
/// The bytes are damaged or cut off.
pub fn zlib(bytes: &[u8]) -> std::io::Result<Vec<u8>> {
    let mut out = Vec::new();
    ZlibDecoder::new(bytes).read_to_end(&mut out).map(|_| out)
}

//! Decompression (inflate) of zlib and raw deflate streams in .npz and .mat files.
//!
//! The only module that uses the flate2 crate.

use flate2::read::{DeflateDecoder, ZlibDecoder};
use std::io::Read;

/// Inflates a zlib stream.
///
/// # Errors
/// The bytes are damaged or cut off.
pub fn zlib(bytes: &[u8]) -> std::io::Result<Vec<u8>> {
    let mut out = Vec::new();
    ZlibDecoder::new(bytes).read_to_end(&mut out).map(|_| out)
}

/// Inflates a raw deflate stream.
///
/// # Errors
/// The bytes are damaged or cut off.
pub fn raw(bytes: &[u8]) -> std::io::Result<Vec<u8>> {
    let mut out = Vec::new();
    DeflateDecoder::new(bytes).read_to_end(&mut out).map(|_| out)
}

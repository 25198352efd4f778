//! Decompression (inflate) of the zlib streams in .mat files, checksums of archives, and how far bytes can be compressed.
//!
//! The only module that uses the flate2 crate.

use std::io::{Read, Write};

use flate2::read::ZlibDecoder;
use flate2::write::ZlibEncoder;
use flate2::{Compression, Crc};

/// The first `count` bytes of a zlib stream.
///
/// # Errors
/// The bytes are damaged or cut off, or contain less.
pub fn zlib_start(bytes: &[u8], count: usize) -> std::io::Result<Vec<u8>> {
    let mut out = vec![0; count];
    ZlibDecoder::new(bytes).read_exact(&mut out).map(|()| out)
}

/// Bytes behind the data of a stream that are taken for padding.
const PADDING: usize = 8;

/// Inflates a zlib stream of `size` bytes into `out`, which has room for them, and verifies its checksum.
///
/// # Errors
/// The bytes are damaged or cut off, or contain less than `size`, or more than that and some padding.
pub fn zlib(bytes: &[u8], size: usize, out: &mut Vec<u8>) -> std::io::Result<()> {
    // The decoder verifies the checksum at the end, which must be reached.
    let found = ZlibDecoder::new(bytes).take((size + PADDING) as u64 + 1).read_to_end(out)?;
    if !(size..=size + PADDING).contains(&found) {
        return Err(std::io::Error::other("its size is not the stated one"));
    }
    out.truncate(size);
    Ok(())
}

/// Finds how far bytes can be compressed; its memory serves every trial.
#[derive(Debug)]
pub struct CompressionTrial(ZlibEncoder<Vec<u8>>);

impl CompressionTrial {
    /// `level`: from 0 to 9.
    pub fn new(level: u8) -> Self {
        Self(ZlibEncoder::new(Vec::new(), Compression::new(level.into())))
    }

    /// Number of bytes of a zlib stream of the given ones.
    pub fn size(&mut self, bytes: &[u8]) -> usize {
        // Writing to memory does not fail.
        let stream = self.0.write_all(bytes).and_then(|()| self.0.reset(Vec::new()));
        stream.map_or(bytes.len(), |stream| stream.len())
    }
}

/// CRC-32 of bytes, as in ZIP archives.
pub fn crc32(bytes: &[u8]) -> u32 {
    let mut crc = Crc::new();
    crc.update(bytes);
    crc.sum()
}

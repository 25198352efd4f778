//! Features of an execution: kinds of messages, and edges of the code with how often they were taken.

use std::fs::{File, OpenOptions};
use std::io;
use std::path::Path;

/// A kind of message, or an edge with the size of its count.
pub type Feature = u32;

/// Marks features of messages; edges have smaller numbers.
const MESSAGE: u32 = 1 << 31;

/// The environment variable with the file of edge counts, read by `edges.c`.
pub const EDGES_VARIABLE: &str = "ROTORDYN_FUZZ_EDGES";

/// Words at the beginning of a message that tell its kind.
const WORDS: usize = 3;

/// Words behind them; they may be parts of the input, and tell apart no more than 16 kinds of one beginning.
const MORE_WORDS: usize = 2;

/// The kind of a message: its first words, without numbers and the names quoted in it.
pub fn of_message(message: &str) -> Feature {
    let is_word = |word: &&str| word.len() > 1 && word.bytes().all(|c| c.is_ascii_lowercase());
    // Every second part is quoted.
    let unquoted = message.split(['`', '"']).step_by(2);
    let mut words = unquoted.flat_map(|part| part.split(|c: char| !c.is_alphanumeric())).filter(is_word);
    // FNV-1a
    let hash = |hash: u32, byte: u8| (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193);
    let hash_word = |before: u32, word: &str| word.bytes().chain([b' ']).fold(before, hash);
    let beginning = words.by_ref().take(WORDS).fold(0x811c_9dc5, hash_word);
    let more = words.take(MORE_WORDS).fold(beginning, hash_word);
    MESSAGE | (beginning << 4) | (more >> 28)
}

/// Counts of taken edges, in the file that `edges.c` maps.
pub struct EdgeCounts {
    file: File,
    counts: Vec<u8>,
    zeros: Vec<u8>,
    /// Sizes of the counts of every edge that have been reported, one bit each.
    seen: Vec<u8>,
}

impl EdgeCounts {
    /// Opens the file; `None` if the program is not instrumented.
    pub fn open(path: &Path) -> io::Result<Option<Self>> {
        let file = OpenOptions::new().read(true).write(true).open(path)?;
        if file.metadata()?.len() < 4 {
            return Ok(None);
        }
        let mut edges = [0; 4];
        read_at(&file, &mut edges, 0)?;
        let edges = u32::from_le_bytes(edges) as usize;
        Ok((edges > 0).then(|| EdgeCounts {
            file,
            counts: vec![0; edges],
            zeros: vec![0; edges],
            seen: vec![0; edges],
        }))
    }

    pub fn clear(&mut self) -> io::Result<()> {
        write_at(&self.file, &self.zeros, 4)
    }

    /// Features of the execution since [`clear`](Self::clear) that this process has not reported yet.
    pub fn new_features(&mut self, into: &mut Vec<Feature>) -> io::Result<()> {
        read_at(&self.file, &mut self.counts, 4)?;
        const BLOCK: usize = 16;
        for (block, counts) in self.counts.chunks(BLOCK).enumerate() {
            // Most edges are not taken: they are passed by many at a time.
            if <[u8; BLOCK]>::try_from(counts).is_ok_and(|counts| u128::from_ne_bytes(counts) == 0) {
                continue;
            }
            for (k, &count) in counts.iter().enumerate().filter(|(_, count)| **count > 0) {
                let edge = block * BLOCK + k;
                // 1, 2, 3 to 4, 5 to 8, ... to 129 and more: a loop that runs once more is no news.
                let size = if count == 1 { 0 } else { 8 - (count - 1).leading_zeros() };
                let size = size.min(7);
                if (self.seen[edge] >> size) & 1 == 0 {
                    self.seen[edge] |= 1 << size;
                    into.push(((edge as u32) << 3) | size);
                }
            }
        }
        Ok(())
    }
}

#[cfg(unix)]
fn read_at(file: &File, into: &mut [u8], at: u64) -> io::Result<()> {
    std::os::unix::fs::FileExt::read_exact_at(file, into, at)
}

#[cfg(unix)]
fn write_at(file: &File, bytes: &[u8], at: u64) -> io::Result<()> {
    std::os::unix::fs::FileExt::write_all_at(file, bytes, at)
}

#[cfg(not(unix))]
fn read_at(_: &File, _: &mut [u8], _: u64) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}

#[cfg(not(unix))]
fn write_at(_: &File, _: &[u8], _: u64) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_of_messages_ignore_numbers_and_names() {
        let kind = of_message("`A` has 3 values of 12 at line 7");
        assert_eq!(kind, of_message("`another one` has 444 values of 1 at line 99"));
        assert_eq!(kind, of_message("`A` has 3 values of 1 at line 7 that are not finite"));
        assert_ne!(kind, of_message("`A` has 3 cells of 12 at line 7"));
        assert!(kind & MESSAGE != 0);
    }
}

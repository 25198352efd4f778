//! Questions to the process that reads an HDF5 file, and its answers, over pipes.
//!
//! A message is its length in four bytes and MessagePack; numbers follow their answer as raw bytes, little endian.

use std::io::{Error, ErrorKind, Read, Result, Write};
use std::ops::Range;

use nalgebra::Complex;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::Attribute;
use super::reader::Links;

/// Longest question \[bytes\].
pub(super) const MAX_QUESTION: u64 = 1_000_000;
/// Values per block on their way.
const BLOCK: usize = 8192;

/// What is asked of a file; names are absolute paths.
#[derive(Debug, Serialize, Deserialize)]
pub(super) enum Question {
    Contains(String),
    Members(String),
    Links(String),
    Attribute(String, String),
    Attributes(String),
    Read(String),
    ReadRange(String, Range<usize>),
    ReadComplex(String),
    ReadTexts(String),
    References(String),
}

/// Answer to a question of the same name.
#[derive(Debug, Serialize, Deserialize)]
pub(super) enum Answer {
    /// The file is open: the first answer, to no question.
    Open,
    Contains(bool),
    Names(Vec<String>),
    Links(Links),
    Attribute(Option<Attribute>),
    Attributes(Vec<(String, Attribute)>),
    /// Shape of numbers, which follow.
    Numbers(Vec<usize>),
    /// Shape of complex numbers, which follow.
    ComplexNumbers(Vec<usize>),
    /// The file does not give the answer: problem and advice.
    Failed(String, String),
}

/// Writes a message.
pub(super) fn send<T: Serialize>(out: &mut impl Write, message: &T) -> Result<()> {
    let bytes = rmp_serde::to_vec(message).map_err(Error::other)?;
    let length = u32::try_from(bytes.len()).map_err(|_| Error::other("a message is too long"))?;
    out.write_all(&length.to_le_bytes())?;
    out.write_all(&bytes)
}

/// Reads a message of at most `limit` bytes.
pub(super) fn receive<T: DeserializeOwned>(from: &mut impl Read, limit: u64) -> Result<T> {
    let mut length = [0; 4];
    from.read_exact(&mut length)?;
    let length = u32::from_le_bytes(length);
    if u64::from(length) > limit {
        return Err(Error::new(ErrorKind::InvalidData, "a message is too long"));
    }
    let mut bytes = Vec::new();
    from.take(length.into()).read_to_end(&mut bytes)?;
    if bytes.len() < length as usize {
        return Err(ErrorKind::UnexpectedEof.into());
    }
    rmp_serde::from_slice(&bytes).map_err(|error| Error::new(ErrorKind::InvalidData, error))
}

/// Writes numbers.
pub(super) fn send_numbers(out: &mut impl Write, values: &[f64]) -> Result<()> {
    let mut bytes = vec![0; 8 * BLOCK.min(values.len())];
    for block in values.chunks(BLOCK) {
        let bytes = &mut bytes[..8 * block.len()];
        for (place, value) in bytes.chunks_exact_mut(8).zip(block) {
            place.copy_from_slice(&value.to_le_bytes());
        }
        out.write_all(bytes)?;
    }
    Ok(())
}

/// Writes complex numbers.
pub(super) fn send_complex(out: &mut impl Write, values: &[Complex<f64>]) -> Result<()> {
    let mut bytes = vec![0; 16 * BLOCK.min(values.len())];
    for block in values.chunks(BLOCK) {
        let bytes = &mut bytes[..16 * block.len()];
        for (place, value) in bytes.chunks_exact_mut(16).zip(block) {
            place[..8].copy_from_slice(&value.re.to_le_bytes());
            place[8..].copy_from_slice(&value.im.to_le_bytes());
        }
        out.write_all(bytes)?;
    }
    Ok(())
}

/// Reads as many numbers as fit into `values` without growing.
pub(super) fn receive_numbers(from: &mut impl Read, values: &mut Vec<f64>, count: usize) -> Result<()> {
    receive_blocks::<8>(from, count, |bytes| values.push(f64::from_le_bytes(*bytes)))
}

/// Reads complex numbers.
pub(super) fn receive_complex(
    from: &mut impl Read,
    values: &mut Vec<Complex<f64>>,
    count: usize,
) -> Result<()> {
    receive_blocks::<16>(from, count, |bytes| {
        let (re, im) = bytes.split_at(8);
        let number = |half: &[u8]| f64::from_le_bytes(std::array::from_fn(|k| half[k]));
        values.push(Complex::new(number(re), number(im)));
    })
}

fn receive_blocks<const N: usize>(
    from: &mut impl Read,
    count: usize,
    mut take: impl FnMut(&[u8; N]),
) -> Result<()> {
    let mut bytes = vec![0; N * BLOCK.min(count)];
    let mut left = count;
    while left > 0 {
        let block = &mut bytes[..N * BLOCK.min(left)];
        from.read_exact(block)?;
        let (elements, _) = block.as_chunks::<N>();
        elements.iter().for_each(&mut take);
        left -= elements.len();
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_their_bits_over_block_ends() {
        let values: Vec<f64> = (0..2 * BLOCK + 3)
            .map(|k| f64::from_bits((k as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15)))
            .collect();
        let complex: Vec<_> = values.windows(2).map(|v| Complex::new(v[0], v[1])).collect();
        let mut bytes = Vec::new();
        send_numbers(&mut bytes, &values).unwrap();
        send_complex(&mut bytes, &complex).unwrap();
        let (mut found, mut found_complex) = (Vec::new(), Vec::new());
        let mut from = &bytes[..];
        receive_numbers(&mut from, &mut found, values.len()).unwrap();
        receive_complex(&mut from, &mut found_complex, complex.len()).unwrap();
        assert!(from.is_empty());
        assert!(values.iter().zip(&found).all(|(a, b)| a.to_bits() == b.to_bits()));
        let bits = |z: &Complex<f64>| (z.re.to_bits(), z.im.to_bits());
        assert!(complex.iter().map(bits).eq(found_complex.iter().map(bits)));
    }

    #[test]
    fn messages_are_bounded_and_complete() {
        let mut bytes = Vec::new();
        send(&mut bytes, &Question::Members("/a".into())).unwrap();
        assert!(matches!(receive(&mut &bytes[..], 100), Ok(Question::Members(name)) if name == "/a"));
        let too_long = receive::<Question>(&mut &bytes[..], 3).unwrap_err();
        assert_eq!(too_long.kind(), ErrorKind::InvalidData);
        let cut_off = receive::<Question>(&mut &bytes[..bytes.len() - 1], 100).unwrap_err();
        assert_eq!(cut_off.kind(), ErrorKind::UnexpectedEof);
        // A length without its bytes asks for no memory.
        assert!(receive::<Question>(&mut &u32::MAX.to_le_bytes()[..], u64::MAX).is_err());
    }
}

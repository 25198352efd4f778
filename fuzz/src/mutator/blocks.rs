//! Changes of blocks of bytes: deleted, copied, repeated, taken from another input.

use fastrand::Rng;

use super::block;

pub fn delete(rng: &mut Rng, input: &mut Vec<u8>) {
    let length = input.len();
    input.drain(block(rng, length, length / 2));
}

/// Cuts the end off.
pub fn cut(rng: &mut Rng, input: &mut Vec<u8>) {
    let end = rng.usize(0..=input.len());
    input.truncate(end.max(input.len().min(4)));
}

/// Copies a block over another place, or inserts it there.
pub fn copy_within(rng: &mut Rng, input: &mut Vec<u8>) {
    let length = input.len();
    let from = input[block(rng, length, length / 4)].to_vec();
    insert_or_overwrite(rng, input, &from);
}

/// Repeats a block, sometimes very often.
pub fn repeat(rng: &mut Rng, input: &mut Vec<u8>, max_length: usize) {
    let range = block(rng, input.len(), input.len() / 8);
    let times = if rng.u8(0..4) == 0 { 1 << rng.u32(4..13) } else { rng.usize(1..5) };
    let room = max_length.saturating_sub(input.len()) / range.len().max(1);
    let copies = input[range.clone()].repeat(times.min(room));
    input.splice(range.end..range.end, copies);
}

/// A block of another input.
pub fn insert_from(rng: &mut Rng, input: &mut Vec<u8>, other: &[u8]) {
    let from = &other[block(rng, other.len(), other.len() / 2)];
    insert_or_overwrite(rng, input, from);
}

/// The beginning of one input and the end of another.
pub fn splice(rng: &mut Rng, input: &mut Vec<u8>, other: &[u8]) {
    let here = rng.usize(0..=input.len());
    // At the same place headers still fit; elsewhere they do not.
    let there = if rng.bool() { here.min(other.len()) } else { rng.usize(0..=other.len()) };
    input.truncate(here);
    input.extend(&other[there..]);
}

/// A word of the format, over what is there or between.
pub fn overwrite(rng: &mut Rng, input: &mut Vec<u8>, dictionary: &[Vec<u8>]) {
    if let Some(word) = rng.choice(dictionary) {
        insert_or_overwrite(rng, input, word);
    }
}

fn insert_or_overwrite(rng: &mut Rng, input: &mut Vec<u8>, block: &[u8]) {
    let at = rng.usize(0..=input.len());
    let end = if rng.bool() { (at + block.len()).min(input.len()) } else { at };
    input.splice(at..end, block.iter().copied());
}

//! Text of any usual encoding: UTF-8, UTF-16 of either byte order, Latin-1.

use crate::budget::{Budget, Exceeded};

/// Bytes from the start by which UTF-16 without a byte order mark is recognised.
const DETECTION_BYTES: usize = 512;
/// Least bytes that tell.
const MIN_BYTES: usize = 8;

/// Byte order of a text in UTF-16: by its byte order mark, or because every second byte of plain text is zero.
pub(crate) fn utf_16(head: &[u8]) -> Option<fn([u8; 2]) -> u16> {
    match head {
        [0xff, 0xfe, ..] => return Some(u16::from_le_bytes),
        [0xfe, 0xff, ..] => return Some(u16::from_be_bytes),
        _ => {}
    }
    let head = &head[..head.len().min(DETECTION_BYTES)];
    let (pairs, _) = head.as_chunks::<2>();
    let letter = |b: u8| b >= 0x20 || matches!(b, b'\t' | b'\n' | b'\r');
    let plain = |high: usize| {
        let zeros = pairs.iter().filter(|pair| pair[high] == 0).count();
        // Some letters, such as Ω, are beyond the first 256.
        let texts = pairs.iter().all(|pair| pair[high] != 0 || letter(pair[1 - high]));
        texts && 10 * zeros >= 9 * pairs.len()
    };
    match () {
        () if head.len() < MIN_BYTES => None,
        () if plain(1) => Some(u16::from_le_bytes),
        () if plain(0) => Some(u16::from_be_bytes),
        () => None,
    }
}

/// Text in UTF-8 or UTF-16, else in Latin-1, which has degree signs.
pub(super) fn decoded(bytes: Vec<u8>, budget: &Budget, notes: &mut Vec<String>) -> Result<String, Exceeded> {
    let text = || "the text".to_owned();
    let Some(unit) = utf_16(&bytes) else {
        return String::from_utf8(bytes).or_else(|error| {
            budget.take(text, 2 * error.as_bytes().len() as u64)?;
            Ok(error.as_bytes().iter().map(|&b| char::from(b)).collect())
        });
    };
    // Two bytes become three at most.
    let mut out = String::from_utf8(budget.list(text, bytes.len() / 2 * 3)?).unwrap_or_default();
    let (pairs, rest) = bytes.as_chunks::<2>();
    let mut damaged = rest.len();
    for letter in char::decode_utf16(pairs.iter().map(|pair| unit(*pair))) {
        damaged += usize::from(letter.is_err());
        out.push(letter.unwrap_or(char::REPLACEMENT_CHARACTER));
    }
    if damaged > 0 {
        notes.push(format!("the text is damaged: {damaged} characters are not valid UTF-16"));
    }
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn utf_16_is_recognised_with_and_without_mark() {
        let text = "time [s];a [µm]\n0;1\n";
        let little: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
        let big: Vec<u8> = text.encode_utf16().flat_map(u16::to_be_bytes).collect();
        let decode = |bytes: &[u8]| {
            let mut notes = Vec::new();
            let text = decoded(bytes.to_vec(), &Budget::of_memory(10_000), &mut notes).unwrap();
            assert!(notes.is_empty(), "{notes:?}");
            text.trim_start_matches('\u{feff}').to_owned()
        };
        for bytes in
            [&little, &big, &[&[0xff, 0xfe], &little[..]].concat(), &[&[0xfe, 0xff], &big[..]].concat()]
        {
            assert_eq!(decode(bytes), text);
        }
        assert_eq!(decode(text.as_bytes()), text);
        assert_eq!(decode(b"a [m/s\xb2]"), "a [m/s²]");
        // Small numbers of 16 bits are no text.
        let numbers: Vec<u8> = (0..50_u16).flat_map(u16::to_le_bytes).collect();
        assert!(utf_16(&numbers).is_none());
    }
}

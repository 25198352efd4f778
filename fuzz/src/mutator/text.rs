//! Changes of text: numbers, words, lines, values after `=`. Bytes that are no UTF-8 are left as they are.

use fastrand::Rng;
use std::ops::Range;

/// Numbers at the ends of what programs expect, as text.
const NUMBERS: [&str; 34] = [
    "0",
    "-0",
    "1",
    "-1",
    "2",
    "3",
    "7",
    "100",
    "1000000",
    "2147483647",
    "2147483648",
    "-2147483649",
    "4294967296",
    "9223372036854775807",
    "-9223372036854775808",
    "9223372036854775808",
    "18446744073709551616",
    "99999999999999999999999999",
    "1e9",
    "1e18",
    "1e308",
    "1e309",
    "-1e308",
    "1e-308",
    "5e-324",
    "1e-3",
    "0.5",
    "0.9999999999999999",
    "nan",
    "inf",
    "-inf",
    ".",
    "1.5.2",
    "0x10",
];

/// Pieces with which values of a model file are made.
const PIECES: [&str; 22] = [
    "true",
    "\"\"",
    "[]",
    "{}",
    "[{}]",
    "[[]]",
    "\"0\"",
    "\"-1 mm\"",
    "\"1e308 m\"",
    "\"1e-300 m\"",
    "\"nan\"",
    "\"inf N\"",
    "\"1 mm, 2 mm\"",
    "\"0, 3000 rpm\"",
    "{ from = \"0 rpm\", to = \"3000 rpm\", count = 3 }",
    "{ from = \"1 Hz\", to = \"2 Hz\", step = \"1e-12 Hz\" }",
    "[\"1 mm\", \"2 mm\"]",
    "[0, 1, 2]",
    "[1, \"a\"]",
    "1979-05-27",
    "\"\u{b5}m \u{301}\u{1F600}\"",
    "'''\n'''",
];

/// Characters that mean something in one of the formats, or nothing in all of them.
const CHARACTERS: [&str; 24] = [
    "\n",
    "\r",
    "\t",
    " ",
    ",",
    ";",
    "\"",
    "'",
    "[",
    "]",
    "{",
    "}",
    "=",
    "#",
    ".",
    "-",
    "+",
    "e",
    "/",
    "\\",
    "\0",
    "\u{feff}",
    "\u{b2}",
    "\u{1F600}",
];

/// Replaces a number.
pub fn replace_number(rng: &mut Rng, input: &mut Vec<u8>) {
    let Some(range) =
        run_from(rng, input, |c| c.is_ascii_digit() || matches!(c, b'.' | b'-' | b'+' | b'e' | b'E'))
    else {
        return;
    };
    // The e of a word is none.
    if !input[range.clone()].iter().any(u8::is_ascii_digit) {
        return;
    }
    let old = String::from_utf8_lossy(&input[range.clone()]).into_owned();
    let new = match rng.u8(0..6) {
        0 => format!("-{old}"),
        1 => format!("{old}{}", rng.u8(0..10)),
        2 => format!("{old}e{}", rng.i16(-400..400)),
        3 => rng.i64(-20..200).to_string(),
        _ => (*rng.choice(&NUMBERS).unwrap_or(&"0")).to_string(),
    };
    input.splice(range, new.bytes());
}

/// Replaces a word by one of the dictionary.
pub fn replace_word(rng: &mut Rng, input: &mut Vec<u8>, dictionary: &[Vec<u8>]) {
    let Some(range) = run_from(rng, input, |c| c.is_ascii_alphanumeric() || c == b'_') else { return };
    if let Some(word) = rng.choice(dictionary) {
        input.splice(range, word.iter().copied());
    }
}

/// Inserts a word of the dictionary.
pub fn insert_word(rng: &mut Rng, input: &mut Vec<u8>, dictionary: &[Vec<u8>]) {
    let at = rng.usize(0..=input.len());
    if let Some(word) = rng.choice(dictionary) {
        input.splice(at..at, word.iter().copied());
    }
}

/// Inserts, replaces or removes a character.
pub fn replace_character(rng: &mut Rng, input: &mut Vec<u8>) {
    let at = rng.usize(0..=input.len());
    let end = (at + rng.usize(0..2)).min(input.len());
    let new = if rng.u8(0..3) == 0 { "" } else { rng.choice(&CHARACTERS).unwrap_or(&"") };
    input.splice(at..end, new.bytes());
}

/// Removes, repeats, moves or takes a line from another input.
pub fn change_line(rng: &mut Rng, input: &mut Vec<u8>, other: &[u8]) {
    let Some(line) = line_range(rng, input) else { return };
    match rng.u8(0..5) {
        0 => drop(input.drain(line)),
        1 => {
            let copy = input[line.clone()].to_vec();
            input.splice(line.start..line.start, copy);
        }
        2 => {
            let moved: Vec<u8> = input.drain(line).collect();
            let at = line_range(rng, input).map_or(0, |to| to.start);
            input.splice(at..at, moved);
        }
        _ => {
            let Some(from) = line_range(rng, other) else { return };
            let end = if rng.bool() { line.end } else { line.start };
            input.splice(line.start..end, other[from].iter().copied());
        }
    }
}

/// Replaces what follows `=` in a line: by a piece, a word or the value of another line.
pub fn replace_value(rng: &mut Rng, input: &mut Vec<u8>, other: &[u8], dictionary: &[Vec<u8>]) {
    let Some(range) = value_range(rng, input) else { return };
    let new: Vec<u8> = match rng.u8(0..6) {
        0 | 1 => rng.choice(&PIECES).map(|piece| piece.as_bytes().to_vec()).unwrap_or_default(),
        2 => rng.choice(dictionary).cloned().unwrap_or_default(),
        3 => match value_range(rng, other) {
            Some(from) => other[from].to_vec(),
            None => return,
        },
        4 => [&b"["[..], &input[range.clone()], b", ", &input[range.clone()], b"]"].concat(),
        _ => {
            let number = rng.choice(&NUMBERS).unwrap_or(&"0");
            match rng.bool() {
                true => number.as_bytes().to_vec(),
                false => {
                    // The number with the unit that is there.
                    let old = String::from_utf8_lossy(&input[range.clone()]).into_owned();
                    let unit = old.split_once(' ').map_or("\"", |(_, unit)| unit);
                    format!("\"{number} {unit}").into_bytes()
                }
            }
        }
    };
    input.splice(range, new);
}

/// A run of bytes of a class, from a random place on.
fn run_from(rng: &mut Rng, input: &[u8], of_class: impl Fn(u8) -> bool) -> Option<Range<usize>> {
    let from = rng.usize(0..input.len().max(1));
    let first = |range: Range<usize>| {
        input.get(range.clone())?.iter().position(|&c| of_class(c)).map(|k| k + range.start)
    };
    let start = first(from..input.len()).or_else(|| first(0..from))?;
    let start = start - input[..start].iter().rev().take_while(|&&c| of_class(c)).count();
    let length = input[start..].iter().take_while(|&&c| of_class(c)).count();
    Some(start..start + length)
}

/// A random line with its end.
fn line_range(rng: &mut Rng, text: &[u8]) -> Option<Range<usize>> {
    if text.is_empty() {
        return None;
    }
    let at = rng.usize(0..text.len());
    let start = text[..at].iter().rposition(|&c| c == b'\n').map_or(0, |k| k + 1);
    let end = text[at..].iter().position(|&c| c == b'\n').map_or(text.len(), |k| at + k + 1);
    Some(start..end)
}

/// What follows `=` in a random line, without spaces and the comment.
fn value_range(rng: &mut Rng, text: &[u8]) -> Option<Range<usize>> {
    // Most lines of a model file have one; a few tries find it.
    for _ in 0..4 {
        let line = line_range(rng, text)?;
        let Some(equals) = text[line.clone()].iter().position(|&c| c == b'=') else { continue };
        let from = line.start + equals + 1;
        let comment = text[from..line.end].iter().position(|&c| c == b'#').map_or(line.end, |k| from + k);
        let value = text[from..comment].trim_ascii();
        let start = from + (text[from..comment].len() - text[from..comment].trim_ascii_start().len());
        return Some(start..start + value.len());
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_values_are_replaced_whole() {
        let text = b"length = \"400 mm\"  # of the shaft\n";
        let mut rng = Rng::with_seed(3);
        for _ in 0..500 {
            let mut input = text.to_vec();
            replace_number(&mut rng, &mut input);
            let new = String::from_utf8(input).unwrap();
            assert!(new.starts_with("length = \"") && new.ends_with(" mm\"  # of the shaft\n"), "{new}");
            let range = value_range(&mut rng, text).unwrap();
            assert_eq!(&text[range], b"\"400 mm\"");
        }
    }
}

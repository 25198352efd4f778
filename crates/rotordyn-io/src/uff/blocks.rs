//! The blocks of a universal file.

use super::binary::Binary;
use super::block::{Block, is_delimiter};
use super::{ParseError, binary};
use crate::budget::Budget;
use crate::error::snippet;
use std::borrow::Cow;

/// Iterates over the blocks of a file.
pub(super) struct Blocks<'a> {
    bytes: &'a [u8],
    position: usize,
    line: usize,
    /// Start of the blanks and zeros at the end of the file.
    blank_from: usize,
    budget: &'a Budget,
}

impl<'a> Blocks<'a> {
    pub fn new(bytes: &'a [u8], budget: &'a Budget) -> Self {
        let last = bytes.iter().rposition(|b| !(b.is_ascii_whitespace() || *b == 0));
        Blocks { bytes, position: 0, line: 0, blank_from: last.map_or(0, |last| last + 1), budget }
    }

    /// The next block; `None` at the end of the file.
    pub fn next(&mut self) -> Result<Option<Block<'a>>, ParseError> {
        // Text between two blocks is ignored.
        loop {
            match self.next_line() {
                None => return Ok(None),
                Some(line) if is_delimiter(line) => break,
                Some(_) => {}
            }
        }
        let header = loop {
            match self.next_line() {
                None => return Ok(None),
                Some(line) if is_delimiter(line) || line.trim_ascii().is_empty() => {}
                Some(line) => break decode(line),
            }
        };
        let line = self.line;
        let name = header.trim_start();
        let digits = name.bytes().take_while(u8::is_ascii_digit).count();
        let set = name[..digits].parse().map_err(|_| ParseError {
            line,
            problem: format!("`{}` is expected to be the number of a data set", snippet(name.trim_end())),
            advice: "is this a universal file? export it again as one".into(),
        })?;
        let mut block = Block { set, line, lines: Vec::new(), binary: None, terminated: false };
        if set == 58 && name[digits..].starts_with(['b', 'B']) {
            let form = binary::BinaryHeader::of_header(&name[digits + 1..], line)?;
            for _ in 0..form.header_lines {
                // The header may promise any number of lines.
                let Some(line) = self.next_line() else { break };
                self.push(&mut block, line)?;
            }
            let blank_from = self.blank_from.saturating_sub(self.position);
            let (data, used, closed) = form.locate_data(&block, &self.bytes[self.position..], blank_from)?;
            block.binary = Some(Binary { header: form, data });
            block.terminated = closed;
            self.line +=
                self.bytes[self.position..self.position + used].iter().filter(|&&b| b == b'\n').count();
            self.position += used;
            return Ok(Some(block));
        }
        while let Some(line) = self.next_line() {
            if is_delimiter(line) {
                block.terminated = true;
                break;
            }
            self.push(&mut block, line)?;
        }
        Ok(Some(block))
    }

    /// Adds a line to a block, at the cost of its place in the list and, in Latin-1, of its copy.
    fn push(&self, block: &mut Block<'a>, line: &'a [u8]) -> Result<(), ParseError> {
        let text = decode(line);
        let copy = if matches!(text, Cow::Owned(_)) { text.len() } else { 0 };
        let lines = || format!("the lines of data set {}", block.set);
        block.within(self.budget.take(lines, (size_of::<Cow<str>>() + copy) as u64))?;
        block.lines.push(text);
        Ok(())
    }

    fn next_line(&mut self) -> Option<&'a [u8]> {
        let rest = &self.bytes[self.position..];
        if rest.is_empty() {
            return None;
        }
        let end = rest.iter().position(|&b| b == b'\n');
        self.position += end.map_or(rest.len(), |end| end + 1);
        self.line += 1;
        let line = &rest[..end.unwrap_or(rest.len())];
        Some(line.strip_suffix(b"\r").unwrap_or(line))
    }
}

/// UTF-8, else Latin-1, which older programs write.
pub(super) fn decode(line: &[u8]) -> Cow<'_, str> {
    match std::str::from_utf8(line) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => Cow::Owned(line.iter().map(|&b| char::from(b)).collect()),
    }
}

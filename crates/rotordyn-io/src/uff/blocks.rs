//! The blocks of a universal file.

use super::binary::Binary;
use super::block::{Block, is_delimiter};
use super::{ParseError, binary};
use std::borrow::Cow;

/// Iterates over the blocks of a file.
pub(super) struct Blocks<'a> {
    bytes: &'a [u8],
    position: usize,
    line: usize,
}

impl<'a> Blocks<'a> {
    pub fn new(bytes: &'a [u8]) -> Self {
        Blocks { bytes, position: 0, line: 0 }
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
            problem: format!("`{}` is expected to be the number of a data set", name.trim_end()),
            advice: "is this a universal file? export it again as one",
        })?;
        let mut block = Block { set, line, lines: Vec::new(), binary: None, terminated: false };
        if set == 58 && name[digits..].starts_with(['b', 'B']) {
            let form = binary::BinaryHeader::of_header(&name[digits + 1..], line)?;
            for _ in 0..form.header_lines {
                block.lines.extend(self.next_line().map(decode));
            }
            let (data, used, closed) = form.locate_data(&block, &self.bytes[self.position..])?;
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
            block.lines.push(decode(line));
        }
        Ok(Some(block))
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

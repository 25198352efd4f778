//! A universal file as blocks: text between two lines of -1, and binary data within.

use std::borrow::Cow;

use super::binary::{self, Binary};
use super::{ParseError, field};

/// One data set.
pub(super) struct Block<'a> {
    /// Number of the data set, 58 for 58b too.
    pub set: u32,
    /// Line of the set's number, from 1.
    pub line: usize,
    /// Lines after the set's number; the header lines alone if there is binary data.
    pub lines: Vec<Cow<'a, str>>,
    pub binary: Option<Binary<'a>>,
    /// Whether it is terminated by a line of -1.
    pub terminated: bool,
}

impl Block<'_> {
    /// Line k after the set's number, trimmed.
    pub fn text(&self, k: usize) -> Option<&str> {
        self.lines.get(k).map(|line| line.trim())
    }

    /// Line k, which must exist.
    pub fn record(&self, k: usize) -> Result<&str, ParseError> {
        self.lines.get(k).map(|line| line.as_ref()).ok_or_else(|| {
            self.error_at(
                k,
                format!("data set {} ends after {} lines", self.set, self.lines.len()),
                CUT_OFF_HINT,
            )
        })
    }

    /// Integers of line k.
    pub fn integers(&self, k: usize) -> Result<Vec<i64>, ParseError> {
        let line = self.record(k)?;
        line.split_whitespace().map(|word| word.parse().ok()).collect::<Option<Vec<i64>>>().ok_or_else(|| {
            self.error_at(k, format!("integers are expected in `{}`", line.trim()), DAMAGED_HINT)
        })
    }

    /// Numbers of line k.
    pub fn numbers(&self, k: usize) -> Result<Vec<f64>, ParseError> {
        let line = self.record(k)?;
        field::numbers(line)
            .map_err(|word| self.error_at(k, format!("`{word}` is expected to be a number"), DAMAGED_HINT))
    }

    /// Error at line k.
    pub fn error_at(&self, k: usize, problem: String, advice: &'static str) -> ParseError {
        ParseError { line: self.line + 1 + k.min(self.lines.len()), problem, advice }
    }
}

pub(super) const CUT_OFF_HINT: &str = "the file is cut off: copy or export it again";
pub(super) const DAMAGED_HINT: &str = "the file is damaged: copy or export it again";

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

/// Whether a line is the -1 that opens and closes a block.
pub(super) fn is_delimiter(line: &[u8]) -> bool {
    line.trim_ascii() == b"-1"
}

/// UTF-8, else Latin-1, which older programs write.
fn decode(line: &[u8]) -> Cow<'_, str> {
    match std::str::from_utf8(line) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => Cow::Owned(line.iter().map(|&b| char::from(b)).collect()),
    }
}

//! A universal file as blocks: text between two lines of -1, and binary data within.

use std::borrow::Cow;

use super::binary::Binary;
use super::{ParseError, field};
use crate::budget::Exceeded;
use crate::error::snippet;

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
            self.error_at(k, format!("integers are expected in `{}`", snippet(line.trim())), DAMAGED_HINT)
        })
    }

    /// Numbers of line k.
    pub fn numbers(&self, k: usize) -> Result<Vec<f64>, ParseError> {
        let line = self.record(k)?;
        field::numbers(line).map_err(|word| {
            self.error_at(k, format!("`{}` is expected to be a number", snippet(&word)), DAMAGED_HINT)
        })
    }

    /// Error at line k.
    pub fn error_at(&self, k: usize, problem: String, advice: &str) -> ParseError {
        ParseError { line: self.line + 1 + k.min(self.lines.len()), problem, advice: advice.into() }
    }

    /// A request to the budget, with the block's line if it is exceeded.
    pub fn within<T>(&self, request: Result<T, Exceeded>) -> Result<T, ParseError> {
        request.map_err(|exceeded| self.error_at(0, exceeded.to_string(), &exceeded.advice()))
    }

    /// Memory of the list of lines \[bytes\].
    pub fn memory(&self) -> usize {
        self.lines.len() * size_of::<Cow<str>>()
    }
}

pub(super) const CUT_OFF_HINT: &str = "the file is cut off: copy or export it again";
pub(super) const DAMAGED_HINT: &str = "the file is damaged: copy or export it again";

/// Whether a line is the -1 that opens and closes a block.
pub(super) fn is_delimiter(line: &[u8]) -> bool {
    line.trim_ascii() == b"-1"
}

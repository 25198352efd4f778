//! What a target did wrong, and the input that made it do so.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

use crate::worker::Answer;

/// Kinds of wrong behaviour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    Panic,
    /// The process ended: a failed allocation, a stack overflow, a crash inside a C library.
    Abort,
    /// More processor time than the limit.
    Slow,
}

impl Kind {
    pub fn name(self) -> &'static str {
        match self {
            Kind::Panic => "panic",
            Kind::Abort => "abort",
            Kind::Slow => "slow",
        }
    }
}

/// One wrong behaviour.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    pub kind: Kind,
    /// Place and message of a panic, the last words of a worker.
    pub text: String,
    /// Processor time \[s\] of an input that ended.
    pub seconds: Option<f64>,
}

impl Finding {
    /// What is the same for findings with one cause: the place of a panic, else the words without numbers.
    pub fn cause(&self) -> String {
        let first = match self.kind {
            // "thread 'main' panicked at FILE:LINE:COLUMN:" or "panicked at ..."
            Kind::Panic => self.text.lines().next().unwrap_or_default().to_owned(),
            Kind::Abort | Kind::Slow => self.text.lines().take(2).collect::<Vec<_>>().join(" "),
        };
        match self.kind {
            Kind::Panic => first,
            Kind::Abort | Kind::Slow => {
                format!("{} {}", self.kind.name(), first.replace(|c: char| c.is_ascii_digit(), ""))
            }
        }
    }
}

/// Answer of a worker, or how it ended instead of one.
#[derive(Clone, Debug, PartialEq)]
pub enum Execution {
    Sound(Answer),
    Wrong(Finding),
}

/// The findings of a run by cause, each with the first input and the number of inputs.
#[derive(Debug, Default)]
pub struct Findings {
    causes: BTreeMap<String, (Finding, Vec<u8>, usize)>,
}

impl Findings {
    /// Counts a finding; true if its cause is new.
    pub fn add(&mut self, finding: Finding, input: &[u8]) -> bool {
        let mut new = false;
        let entry = self.causes.entry(finding.cause()).or_insert_with(|| {
            new = true;
            (finding, input.to_vec(), 0)
        });
        entry.2 += 1;
        new
    }

    pub fn is_empty(&self) -> bool {
        self.causes.is_empty()
    }

    /// Inputs with a finding of a kind.
    pub fn count(&self, kind: Kind) -> usize {
        self.causes.values().filter(|(finding, ..)| finding.kind == kind).map(|(.., count)| count).sum()
    }

    /// Writes the first input of every cause, with a text beside it that says what happened; their paths.
    ///
    /// # Errors
    /// The folder cannot be written.
    pub fn write(&self, folder: &Path) -> io::Result<Vec<PathBuf>> {
        let mut paths = Vec::new();
        for (finding, input, count) in self.causes.values() {
            std::fs::create_dir_all(folder)?;
            let path = folder.join(format!("{}-{:08x}", finding.kind.name(), crc32fast::hash(input)));
            std::fs::write(&path, input)?;
            let text = format!("{}\n{count} inputs\n", finding.text);
            std::fs::write(path.with_extension("txt"), text)?;
            paths.push(path);
        }
        Ok(paths)
    }
}

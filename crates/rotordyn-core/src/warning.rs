//! Warnings: what restricts a result, as data with a code that never changes.

mod code;

pub use code::Code;

use crate::document::{Rows, Value};
use serde::{Deserialize, Serialize};
use std::fmt::{self, Display, Formatter};

/// How far a warning reaches.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// A figure holds with a restriction.
    Caution,
    /// The results are not those of the machine that was meant, or do not hold at all.
    Serious,
}

impl Severity {
    pub fn name(self) -> &'static str {
        match self {
            Self::Caution => "caution",
            Self::Serious => "serious",
        }
    }
}

/// One warning.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Warning {
    pub code: Code,
    /// What it concerns, as in the model file: `bearing.B`, `study.frf`; empty for the whole machine.
    pub item: String,
    /// What was found, with its figures.
    pub text: String,
    /// What to do in this case; empty where `text` or the code says it.
    pub advice: String,
}

impl Warning {
    pub fn new(code: Code, item: impl Into<String>, text: impl Into<String>) -> Self {
        Self { code, item: item.into(), text: text.into(), advice: String::new() }
    }

    /// With what to do in this case.
    pub fn advise(mut self, advice: impl Into<String>) -> Self {
        self.advice = advice.into();
        self
    }

    /// With words before the text, such as the name of a variant or file.
    pub fn prefixed(mut self, words: impl Display) -> Self {
        self.text = format!("{words}: {}", self.text);
        self
    }

    /// What to do: in this case, else in general.
    pub fn what_to_do(&self) -> &str {
        if self.advice.is_empty() { self.code.advice() } else { &self.advice }
    }

    /// A list of warnings for files.
    pub fn list(warnings: &[Self]) -> Value<'_> {
        let rows = Rows::of(warnings)
            .text("code", |w| w.code.name())
            .text("severity", |w| w.code.severity().name())
            .text("item", |w| &w.item)
            .text("text", |w| &w.text)
            .text("advice", Self::what_to_do);
        Value::Table(rows.table())
    }
}

/// The text, with what to do in this case.
impl Display for Warning {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)?;
        if !self.advice.is_empty() {
            write!(f, "; {}", self.advice)?;
        }
        Ok(())
    }
}

//! Shared by the cases: a valid model file, changed in one place, and the resulting message.

use crate::render::render;
use rotordyn::model::{self, Options};

/// A valid model file.
pub struct Sample {
    pub file: &'static str,
    pub text: &'static str,
}

impl Sample {
    /// Error message for a text in place of this file's.
    pub fn refused(&self, text: impl AsRef<[u8]>) -> String {
        self.refused_with(text, &Options::default())
    }

    pub fn refused_with(&self, text: impl AsRef<[u8]>, options: &Options) -> String {
        let errors = model::load(self.file, text, options).expect_err("the input is bad");
        assert!(!errors.diagnostics.is_empty());
        render(&errors.diagnostics, &errors.sources, miette::Severity::Error, false)
    }

    /// Error message with every occurrence of `from` replaced.
    pub fn changed(&self, from: &str, to: &str) -> String {
        self.refused(self.with(from, to))
    }

    /// Warnings of a valid but questionable text.
    #[allow(dead_code)] // not every kind of input has cases with warnings
    pub fn warned(&self, from: &str, to: &str) -> String {
        let loaded = model::load(self.file, self.with(from, to), &Options::default());
        let loaded = loaded.unwrap_or_else(|errors| panic!("{errors:?}"));
        assert!(!loaded.warnings.is_empty());
        render(&loaded.warnings, &loaded.sources, miette::Severity::Warning, false)
    }

    /// The text with every occurrence of `from` replaced.
    pub fn with(&self, from: &str, to: &str) -> String {
        assert!(self.text.contains(from), "`{from}`");
        self.text.replace(from, to)
    }
}

/// One snapshot test per line, `name: message;`.
macro_rules! cases {
    ($($name:ident: $message:expr;)*) => {
        $(#[test]
        fn $name() {
            insta::assert_snapshot!($message);
        })*
    };
}

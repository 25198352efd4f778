//! Why the contents of a file are refused.

use std::path::Path;

use crate::budget::Exceeded;
use crate::error::Error;

/// A problem of a file's contents, and a hint how to correct it.
#[derive(Debug)]
pub(crate) struct ContentProblem {
    pub problem: String,
    pub advice: String,
}

impl ContentProblem {
    pub fn new(problem: impl Into<String>, advice: impl Into<String>) -> Self {
        Self { problem: problem.into(), advice: advice.into() }
    }

    pub fn of_file(self, path: &Path) -> Error {
        Error::Content { path: path.into(), problem: self.problem, advice: self.advice }
    }
}

impl From<Exceeded> for ContentProblem {
    fn from(exceeded: Exceeded) -> Self {
        Self::new(exceeded.to_string(), exceeded.advice())
    }
}

//! What a target made of an input.

/// Whether an input was accepted, with what the program would print on it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outcome {
    pub accepted: bool,
    /// Errors and warnings, and what was read; words of a kind not seen before make an input worth keeping.
    pub messages: Vec<String>,
}

impl Outcome {
    pub fn accepted(message: impl Into<String>) -> Self {
        Outcome { accepted: true, messages: vec![message.into()] }
    }

    pub fn refused(error: impl std::fmt::Display) -> Self {
        Outcome { accepted: false, messages: vec![error.to_string()] }
    }

    /// Adds what another part of the program made of the same input.
    pub fn and(mut self, other: Outcome) -> Self {
        self.accepted &= other.accepted;
        self.messages.extend(other.messages);
        self
    }

    /// Adds the error of a further step; its success says nothing new.
    pub fn after<T, E: std::fmt::Display>(&mut self, step: &str, result: Result<T, E>) -> Option<T> {
        result.map_err(|error| self.messages.push(format!("{step}: {error}"))).ok()
    }
}

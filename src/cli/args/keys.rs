//! Help texts of flags that set a key of the model file, from the declaration of the key.

use rotordyn::model::keys::{self, KeyDescription};

/// A declared key.
///
/// # Panics
/// The path is not declared; a test builds every help text.
pub fn key(path: &str) -> KeyDescription {
    let found = keys::describe_key(path).unwrap_or_else(|unknown| panic!("{unknown}"));
    found.unwrap_or_else(|| panic!("{path} is the whole file"))
}

/// Default of a key as it is written in a file.
///
/// # Panics
/// The key has no fixed default; the tests of the settings use every one.
pub fn default(path: &str) -> String {
    key(path).default.unwrap_or_else(|| panic!("{path} has no fixed default"))
}

/// Default of a key as plain text, without quotes.
pub fn default_words(path: &str) -> String {
    default(path).trim_matches('"').to_string()
}

/// Help of a flag: meaning of its key, words or an example, and what holds without it.
pub fn help(path: &str) -> String {
    help_with(path, "")
}

/// [`help`] with a note on the flag itself, such as "can be repeated".
pub fn help_with(path: &str, note: &str) -> String {
    let key = key(path);
    let meaning = key.meaning.trim_end_matches('.');
    let accepted = match key.words.is_empty() {
        false => format!(": {}", key.words.join(", ")),
        true if key.unit.is_empty() => String::new(),
        true => format!(", such as {}", key.example),
    };
    let note = if note.is_empty() { String::new() } else { format!("; {note}") };
    let default = match key.absent.trim_matches('"') {
        "" | "false" => String::new(),
        required if required.starts_with("required") => String::new(),
        words => format!(" [default: {words}]"),
    };
    format!("{meaning}{accepted}{note}{default}")
}

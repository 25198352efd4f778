//! The text of a file as a tree, TOML or JSON, and problems with their places in it.

use crate::budget::{Budget, Exceeded};
use rotordyn_model::{Diagnostic, Kind, ModelErrors, Source};
use serde_json::{Map, Value};
use std::cell::RefCell;
use std::ops::Range;

/// Memory of the tree per byte of text: a digit with its separator becomes a value of 32 bytes in a growing list.
const TREE_PER_BYTE: u64 = 30;

/// Problems that are told at once.
const MAX_PROBLEMS: usize = 20;

/// A parsed file.
pub(super) struct Tree {
    name: String,
    text: String,
    pub root: Map<String, Value>,
    problems: RefCell<Vec<Diagnostic>>,
}

pub(super) enum Unreadable {
    Content(ModelErrors),
    TooLarge(Exceeded),
}

impl Tree {
    /// JSON if the text starts with a brace, else TOML.
    pub fn read(name: &str, bytes: &[u8], budget: &Budget) -> Result<Self, Unreadable> {
        let bytes_of_tree = (bytes.len() as u64).saturating_mul(TREE_PER_BYTE);
        budget.take(|| "its values".into(), bytes_of_tree).map_err(Unreadable::TooLarge)?;
        let text = String::from_utf8_lossy(bytes);
        let text = text.strip_prefix('\u{feff}').unwrap_or(&text).to_string();
        let tree = Self { name: name.into(), text, root: Map::new(), problems: RefCell::default() };
        if let Err(error) = std::str::from_utf8(bytes) {
            // In the text that is shown a replacement character stands there, and no byte order mark at the start.
            let mark = if bytes.starts_with("\u{feff}".as_bytes()) { '\u{feff}'.len_utf8() } else { 0 };
            let at = error.valid_up_to() - mark;
            tree.report(
                Kind::Syntax,
                at..at + '\u{fffd}'.len_utf8(),
                "not UTF-8 text",
                "a file saved by ROSS, TOML or JSON",
                "",
            );
            return Err(Unreadable::Content(tree.errors()));
        }
        let parsed = if tree.text.trim_start().starts_with('{') { tree.json() } else { tree.toml() };
        match parsed {
            Ok(root) => Ok(Self { root, ..tree }),
            Err((span, message)) => {
                let expected = "a file saved by ROSS (`Rotor.save`), TOML or JSON";
                tree.report(
                    Kind::Syntax,
                    span,
                    message,
                    expected,
                    "save the rotor again with rotor.save(\"rotor.toml\")",
                );
                Err(Unreadable::Content(tree.errors()))
            }
        }
    }

    fn json(&self) -> Result<Map<String, Value>, (Range<usize>, String)> {
        serde_json::from_str(&self.text).map_err(|error| {
            let line = error.line().saturating_sub(1);
            let start: usize = self.text.split_inclusive('\n').take(line).map(str::len).sum();
            let at = self.boundary(start + error.column().saturating_sub(1));
            let message = error.to_string();
            let message = message.split(" at line ").next().unwrap_or_default();
            (at..at, format!("not JSON: {message}"))
        })
    }

    fn toml(&self) -> Result<Map<String, Value>, (Range<usize>, String)> {
        toml::from_str(&self.text).map_err(|error| {
            let message = error.message().lines().next().unwrap_or("unreadable").to_string();
            (error.span().unwrap_or(0..0), format!("not TOML: {message}"))
        })
    }

    /// The last boundary of characters up to a byte.
    fn boundary(&self, at: usize) -> usize {
        let at = at.min(self.text.len());
        (0..=at).rev().find(|k| self.text.is_char_boundary(*k)).unwrap_or(0)
    }

    /// Place of an element's name, and of one of its keys where that is written behind it.
    fn place(&self, element: &str, key: &str) -> Range<usize> {
        let quoted = format!("\"{element}\"");
        let bare = format!("[{element}]");
        let found =
            self.text.find(&quoted).map(|at| at + 1).or_else(|| self.text.find(&bare).map(|at| at + 1));
        let Some(at) = found else { return 0..0 };
        let element = at..at + element.len();
        if key.is_empty() {
            return element;
        }
        let body = &self.text[element.end..];
        let end = ["\n[", "\n  },"].iter().filter_map(|mark| body.find(mark)).min().unwrap_or(body.len());
        let of_json = format!("\"{key}\":");
        let of_toml = format!("\n{key} =");
        let own =
            body[..end].find(&of_json).or_else(|| body[..end].find(&of_toml)).map(|k| element.end + k + 1);
        own.map_or(element, |at| at..at + key.len())
    }

    fn report(&self, kind: Kind, span: Range<usize>, message: impl Into<String>, expected: &str, hint: &str) {
        if self.problems.borrow().len() >= MAX_PROBLEMS {
            return;
        }
        let given = |text: &str| (!text.is_empty()).then(|| text.to_string());
        self.problems.borrow_mut().push(Diagnostic {
            kind,
            warning: None,
            source: 0,
            span,
            message: message.into(),
            expected: given(expected),
            hint: given(hint),
        });
    }

    /// Remembers a problem of an element, or of one of its keys.
    pub fn problem(
        &self,
        [element, key]: [&str; 2],
        kind: Kind,
        message: String,
        expected: &str,
        hint: &str,
    ) {
        if self.problems.borrow().len() < MAX_PROBLEMS {
            self.report(kind, self.place(element, key), message, expected, hint);
        }
    }

    /// All problems found so far.
    pub fn errors(&self) -> ModelErrors {
        let sources = vec![Source { name: self.name.clone(), text: self.text.clone() }];
        ModelErrors { sources, diagnostics: self.problems.borrow().clone() }
    }

    pub fn has_problems(&self) -> bool {
        !self.problems.borrow().is_empty()
    }

    /// Keys of an element.
    pub fn element<'a>(&'a self, name: &'a str) -> Option<Fields<'a>> {
        let map = self.root.get(name)?.as_object()?;
        Some(Fields { tree: self, name, inner: "", map })
    }
}

/// Keys of one element, or of a table within it.
#[derive(Clone, Copy)]
pub(super) struct Fields<'a> {
    tree: &'a Tree,
    /// Name of the element.
    pub name: &'a str,
    /// Name of the table within it, or nothing.
    inner: &'a str,
    map: &'a Map<String, Value>,
}

impl<'a> Fields<'a> {
    /// A value, unless it is null (as `None` is written in JSON).
    pub fn value(&self, key: &str) -> Option<&'a Value> {
        self.map.get(key).filter(|value| !value.is_null())
    }

    pub fn keys(&self) -> impl Iterator<Item = &'a str> {
        self.map.keys().map(String::as_str)
    }

    fn path(&self, key: &str) -> String {
        if self.inner.is_empty() { key.into() } else { format!("{}.{key}", self.inner) }
    }

    fn wrong(&self, key: &str, found: &Value, expected: &str) {
        let text = found.to_string();
        let shown: String = text.chars().take(40).collect();
        let message = format!("{}: {} is {shown}", self.name, self.path(key));
        self.tree.problem([self.name, key], Kind::WrongType, message, expected, "");
    }

    /// A problem that is no wrong type.
    pub fn refuse(&self, key: &str, message: String, expected: &str) {
        let message = format!("{}: {message}", self.name);
        self.tree.problem([self.name, key], Kind::OutOfRange, message, expected, "");
    }

    fn missing(&self, key: &str, expected: &str) {
        let message = format!("{}: {} is missing", self.name, self.path(key));
        let hint = "the file was changed or comes from another version; save the rotor again with rotor.save";
        self.tree.problem([self.name, ""], Kind::MissingKey, message, expected, hint);
    }

    /// A finite number, if it is there.
    pub fn optional(&self, key: &str) -> Option<f64> {
        let value = self.value(key)?;
        let number = value.as_f64().filter(|number| number.is_finite());
        if number.is_none() {
            self.wrong(key, value, "a finite number");
        }
        number
    }

    /// A finite number; 0 after an error.
    pub fn number(&self, key: &str) -> f64 {
        if self.value(key).is_none() {
            self.missing(key, "a number");
        }
        self.optional(key).unwrap_or(0.0)
    }

    /// A number greater than zero; 1 after an error.
    pub fn positive(&self, key: &str) -> f64 {
        let number = self.number(key);
        if number <= 0.0 && self.value(key).is_some() {
            self.refuse(key, format!("{} is {number}", self.path(key)), "a number greater than zero");
        }
        if number > 0.0 { number } else { 1.0 }
    }

    /// The number of a node.
    pub fn node(&self, key: &str) -> Option<usize> {
        let value = self.value(key)?;
        let node = value
            .as_u64()
            .or_else(|| value.as_f64().filter(|v| v.fract() == 0.0 && *v >= 0.0).map(|v| v as u64));
        if node.is_none() {
            self.wrong(key, value, "the number of a node, 0 or more");
        }
        node.and_then(|node| usize::try_from(node).ok())
    }

    /// The number of a node that must be there.
    pub fn need_node(&self, key: &str) -> usize {
        if self.value(key).is_none() {
            self.missing(key, "the number of a node, 0 or more");
        }
        self.node(key).unwrap_or(0)
    }

    pub fn flag(&self, key: &str, default: bool) -> bool {
        let Some(value) = self.value(key) else { return default };
        if value.as_bool().is_none() {
            self.wrong(key, value, "true or false");
        }
        value.as_bool().unwrap_or(default)
    }

    pub fn text(&self, key: &str) -> Option<&'a str> {
        let value = self.value(key)?;
        if !value.is_string() {
            self.wrong(key, value, "a text");
        }
        value.as_str()
    }

    /// A list of numbers, or one number alone.
    pub fn list(&self, key: &str) -> Option<Vec<f64>> {
        let value = self.value(key)?;
        let numbers = match value {
            Value::Array(list) => list.iter().map(|v| v.as_f64().filter(|v| v.is_finite())).collect(),
            other => other.as_f64().map(|number| vec![number]),
        };
        if numbers.is_none() {
            self.wrong(key, value, "a list of finite numbers");
        }
        numbers
    }

    /// Rows of numbers; `None` if the value is no list of lists.
    pub fn rows(&self, key: &str) -> Option<Vec<Vec<f64>>> {
        let list = self.value(key)?.as_array()?;
        let row = |value: &Value| -> Option<Vec<f64>> {
            value.as_array()?.iter().map(|v| v.as_f64().filter(|v| v.is_finite())).collect()
        };
        list.iter().map(row).collect()
    }

    /// A table within the element.
    pub fn table(&self, key: &'a str) -> Option<Self> {
        match self.value(key) {
            Some(Value::Object(map)) => Some(Self { inner: key, map, ..*self }),
            Some(other) => {
                self.wrong(key, other, "a table");
                None
            }
            None => {
                self.missing(key, "a table");
                None
            }
        }
    }
}

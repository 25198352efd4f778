//! Typed access to one table of the file: every problem is logged with its span and reading continues.
//!
//! A method that must return a value returns a placeholder after an error; a model with errors is never
//! returned.
//! Every requested key is recorded as known, so [`Reader::finish`] can report unknown keys with a suggestion.

use super::diagnostic::{Kind, Log, Problem};
use super::tree::{Entry, Node, Table, Value};
use rotordyn_units::names::nearest;
use rotordyn_units::{self as units, Dimension, NUMBER, UnitError};
use std::cell::RefCell;
use std::ops::Range;

/// A dimension with the range its value must be in.
#[derive(Clone, Copy)]
pub(crate) struct Spec {
    dimension: Dimension,
    bound: Bound,
}

#[derive(Clone, Copy, PartialEq)]
enum Bound {
    Any,
    Positive,
    NotNegative,
}

pub(crate) const fn any(dimension: Dimension) -> Spec {
    Spec { dimension, bound: Bound::Any }
}

pub(crate) const fn positive(dimension: Dimension) -> Spec {
    Spec { dimension, bound: Bound::Positive }
}

pub(crate) const fn not_negative(dimension: Dimension) -> Spec {
    Spec { dimension, bound: Bound::NotNegative }
}

/// One table of the file.
pub(crate) struct Reader<'a> {
    table: &'a Table,
    /// Span of the table's key.
    pub span: Range<usize>,
    /// Path of the table: "bearing.B".
    pub path: String,
    pub log: &'a Log,
    errors_before: usize,
    requested_keys: RefCell<Vec<String>>,
}

static EMPTY_TABLE: Table = Table { entries: Vec::new() };

impl<'a> Reader<'a> {
    pub fn new(table: &'a Table, path: impl Into<String>, span: Range<usize>, log: &'a Log) -> Self {
        Self {
            table,
            span,
            path: path.into(),
            log,
            errors_before: log.error_count(),
            requested_keys: RefCell::default(),
        }
    }

    /// Whether no error has been logged since this table was opened.
    pub fn has_no_errors(&self) -> bool {
        self.log.error_count() == self.errors_before
    }

    pub fn entry(&self, key: &str) -> Option<&'a Entry> {
        if !self.requested_keys.borrow().iter().any(|k| k == key) {
            self.requested_keys.borrow_mut().push(key.into());
        }
        self.table.get(key)
    }

    pub fn has(&self, key: &str) -> bool {
        self.entry(key).is_some()
    }

    /// Span of the key's value, or of the table if the key is absent.
    pub fn span_of(&self, key: &str) -> Range<usize> {
        self.table.get(key).map_or_else(|| self.span.clone(), |e| e.node.span.clone())
    }

    /// Name of a key for messages, as written in the file: "bearing.B.balls".
    pub fn name(&self, key: &str) -> String {
        let key = self.table.get(key).map_or(key, Entry::written_key);
        if self.path.is_empty() { key.into() } else { format!("{}.{key}", self.path) }
    }

    /// Log an error at a key's value (or at the table).
    pub fn error(&self, kind: Kind, key: &str, message: impl Into<String>) {
        self.log.error(Problem::new(kind, &self.span_of(key), message));
    }

    pub fn missing(&self, key: &str, example: &str) {
        let problem = Problem::new(Kind::MissingKey, &self.span, self.missing_message(key));
        self.log.error(problem.hint(format!("add {key} = {example}")));
    }

    fn missing_message(&self, key: &str) -> String {
        format!("{} is missing", self.name(key))
    }

    fn wrong_type(&self, key: &str, node: &Node, expected: &str) {
        let message = format!("{} is {}", self.name(key), node.value.type_name());
        self.log.error(Problem::new(Kind::WrongType, &node.span, message).expected(expected));
    }

    /// Log an error if more than one of these mutually exclusive keys is given; returns the first one given.
    pub fn one_of<'k>(&self, keys: &[&'k str]) -> Option<&'k str> {
        let given: Vec<&'k str> = keys.iter().copied().filter(|k| self.has(k)).collect();
        if let [first, second, ..] = given[..] {
            let message = format!("{} and `{second}` are mutually exclusive", self.name(first));
            let problem = Problem::new(Kind::Conflict, &self.span_of(second), message);
            self.log.error(problem.hint(format!("give one of {}", keys.join(", "))));
        }
        given.first().copied()
    }

    // --- quantities ---

    pub fn get(&self, key: &str, spec: Spec) -> Option<f64> {
        let entry = self.entry(key)?;
        let values = self.quantities(key, &entry.node, spec)?;
        if values.len() > 1 {
            let message = format!("{} must be a single value, but has {}", self.name(key), values.len());
            self.error(Kind::WrongType, key, message);
        }
        values.first().copied()
    }

    pub fn or(&self, key: &str, spec: Spec, default: f64) -> f64 {
        self.get(key, spec).unwrap_or(default)
    }

    pub fn need(&self, key: &str, spec: Spec) -> f64 {
        if !self.has(key) {
            self.missing(key, &quoted_example(spec.dimension));
        }
        self.get(key, spec).unwrap_or(1.0)
    }

    /// A list of quantities: `"0, 600 rpm"` or `["0 rpm", "600 rpm"]`.
    pub fn list(&self, key: &str, spec: Spec) -> Option<Vec<f64>> {
        let entry = self.entry(key)?;
        self.quantities(key, &entry.node, spec)
    }

    pub fn need_list(&self, key: &str, spec: Spec) -> Vec<f64> {
        if !self.has(key) {
            self.missing(key, &quoted_example(spec.dimension));
        }
        self.list(key, spec).unwrap_or_else(|| vec![1.0])
    }

    /// Three components.
    pub fn vector(&self, key: &str, dimension: Dimension) -> Option<[f64; 3]> {
        let values = self.list(key, any(dimension))?;
        let vector = values.as_slice().try_into().ok();
        if vector.is_none() {
            let message =
                format!("{} has {} components instead of three (x, y, z)", self.name(key), values.len());
            self.error(Kind::WrongType, key, message);
        }
        vector
    }

    fn quantities(&self, key: &str, node: &Node, spec: Spec) -> Option<Vec<f64>> {
        let values = match &node.value {
            Value::List(items) => {
                let mut values = Vec::new();
                let mut failed = false;
                for item in items {
                    match self.quantities(key, item, spec) {
                        Some(one) => values.extend(one),
                        None => failed = true,
                    }
                }
                if values.is_empty() && !failed {
                    self.error(Kind::OutOfRange, key, format!("{} is an empty list", self.name(key)));
                }
                return (!failed && !values.is_empty()).then_some(values);
            }
            Value::Text(text) => match units::parse_list(text, spec.dimension) {
                Ok(values) => values,
                Err(error) => {
                    self.log.error(self.unit_problem(key, node, spec.dimension, &error));
                    return None;
                }
            },
            #[allow(clippy::cast_precision_loss)] // integers in a model file are small
            Value::Integer(i) => vec![self.bare_number(key, node, spec.dimension, *i as f64)?],
            Value::Float(f) => vec![self.bare_number(key, node, spec.dimension, *f)?],
            _ => {
                self.wrong_type(key, node, &expected_quantity(spec.dimension));
                return None;
            }
        };
        for value in &values {
            let (fits, must) = match spec.bound {
                Bound::Any => (true, ""),
                Bound::Positive => (*value > 0.0, "greater than zero"),
                Bound::NotNegative => (*value >= 0.0, "zero or greater"),
            };
            if !fits {
                let what = if *value < 0.0 { "negative" } else { "zero" };
                let message = format!("{} is {what}", self.name(key));
                let problem = Problem::new(Kind::OutOfRange, &node.span, message);
                self.log.error(problem.expected(format!("{} {must}", with_article(spec.dimension.name))));
                return None;
            }
        }
        Some(values)
    }

    fn bare_number(&self, key: &str, node: &Node, dimension: Dimension, value: f64) -> Option<f64> {
        let name = self.name(key);
        let problem = if !value.is_finite() {
            Problem::new(Kind::OutOfRange, &node.span, format!("{name} is not a finite number"))
                .expected(expected_quantity(dimension))
        } else if dimension == NUMBER {
            return Some(value);
        } else {
            Problem::new(Kind::MissingUnit, &node.span, format!("{name} has no unit"))
                .expected(expected_quantity(dimension))
                .hint(format!("if {} is meant, write \"{value} {}\"", dimension.unit, dimension.unit))
        };
        self.log.error(problem);
        None
    }

    fn unit_problem(&self, key: &str, node: &Node, dimension: Dimension, error: &UnitError) -> Problem {
        let name = self.name(key);
        let expected = expected_quantity(dimension);
        let problem = |kind, message: String| Problem::new(kind, &node.span, message).expected(&expected);
        match error {
            UnitError::NoUnit(text) => problem(Kind::MissingUnit, format!("{name} has no unit"))
                .hint(format!("if {} is meant, write \"{text} {}\"", dimension.unit, dimension.unit)),
            UnitError::WrongDimension { unit, found, expected: dimension } => {
                let p = problem(
                    Kind::WrongDimension,
                    format!("{name} must be {}; {unit} is {}", with_article(dimension), with_article(found)),
                );
                if *dimension == units::FORCE.name && unit.contains("lb") {
                    p.hint("lb is a mass; write lbf for the force")
                } else if unit == "1/s" {
                    p.hint("1/s is ambiguous (revolutions or radians): write Hz, rpm or rad/s")
                } else {
                    p
                }
            }
            UnitError::UnknownUnit(unit) => {
                problem(Kind::BadQuantity, format!("{name}: unknown unit `{unit}`"))
                    .suggest(unit, units::unit_names())
            }
            UnitError::ScaleOfTemperature(_) => problem(Kind::WrongDimension, format!("{name}: {error}"))
                .hint("write K: a temperature difference has the same value in K and degC"),
            UnitError::NotFinite(_) => problem(Kind::OutOfRange, format!("{name} is not a finite number")),
            _ => problem(Kind::BadQuantity, format!("{name}: {error}")),
        }
    }

    /// Values as a list, or spaced evenly: `{ from = "0 rpm", to = "1200 rpm", count = 25 }` or `step = "50 rpm"`;
    /// `spacing = "log"` for equal ratios.
    pub fn sweep(&self, key: &str, spec: Spec) -> Option<Vec<f64>> {
        let entry = self.entry(key)?;
        let Value::Table(table) = &entry.node.value else { return self.list(key, spec) };
        let r = Reader::new(table, self.name(key), entry.key_span.clone(), self.log);
        let (from, to) = (r.need("from", spec), r.need("to", spec));
        let logarithmic = r.choice("spacing", &[("linear", false), ("log", true)]).unwrap_or(false);
        let count = match r.one_of(&["count", "step"]) {
            Some("step") => {
                let step = r.need("step", positive(spec.dimension));
                let steps = (to - from) / step;
                if !(1.0..1e6).contains(&steps) {
                    r.error(Kind::OutOfRange, "step", format!("{} gives {steps:.0} steps", r.name("step")));
                    2
                } else {
                    steps.round() as usize + 1
                }
            }
            Some(_) => r.count("count", 2, 2..=1_000_000),
            None => {
                r.missing("count", "25");
                2
            }
        };
        if to <= from && r.has_no_errors() {
            r.error(Kind::OutOfRange, "to", format!("{} must be above {}", r.name("to"), r.name("from")));
        }
        if logarithmic && from <= 0.0 && r.has_no_errors() {
            r.error(
                Kind::OutOfRange,
                "from",
                format!("{} must be above zero for equal ratios", r.name("from")),
            );
        }
        let sound = r.has_no_errors();
        r.finish();
        let part = |k: usize| k as f64 / (count - 1) as f64;
        let value = |k| match k {
            0 => from,
            k if k + 1 == count => to,
            k if logarithmic => from * (to / from).powf(part(k)),
            k => from + (to - from) * part(k),
        };
        sound.then(|| (0..count).map(value).collect())
    }

    // --- words and counts ---

    pub fn text(&self, key: &str) -> Option<&'a str> {
        let entry = self.entry(key)?;
        match &entry.node.value {
            Value::Text(text) => Some(text),
            _ => {
                self.wrong_type(key, &entry.node, "a string in quotes");
                None
            }
        }
    }

    pub fn need_text(&self, key: &str, example: &str) -> Option<&'a str> {
        if !self.has(key) {
            self.missing(key, example);
        }
        self.text(key)
    }

    /// A list of strings, each with its span; a single string counts as a list of one.
    pub fn texts(&self, key: &str) -> Option<Vec<(&'a str, Range<usize>)>> {
        let entry = self.entry(key)?;
        let items = match &entry.node.value {
            Value::List(items) => items.as_slice(),
            _ => std::slice::from_ref(&entry.node),
        };
        let mut texts = Vec::new();
        for item in items {
            match &item.value {
                Value::Text(text) => texts.push((text.as_str(), item.span.clone())),
                _ => self.wrong_type(key, item, "a string in quotes"),
            }
        }
        Some(texts)
    }

    pub fn flag(&self, key: &str, default: bool) -> bool {
        let Some(entry) = self.entry(key) else { return default };
        match entry.node.value {
            Value::Boolean(b) => b,
            _ => {
                self.wrong_type(key, &entry.node, "true or false");
                default
            }
        }
    }

    pub fn count(&self, key: &str, default: usize, range: std::ops::RangeInclusive<usize>) -> usize {
        let Some(entry) = self.entry(key) else { return default };
        let expected = format!("a whole number from {} to {}", range.start(), range.end());
        match entry.node.value {
            Value::Integer(i) => match usize::try_from(i) {
                Ok(n) if range.contains(&n) => return n,
                _ => {
                    let message = format!("{} is out of range", self.name(key));
                    self.log
                        .error(Problem::new(Kind::OutOfRange, &entry.node.span, message).expected(expected));
                }
            },
            _ => self.wrong_type(key, &entry.node, &expected),
        }
        default
    }

    /// One of several keywords.
    pub fn choice<T: Copy>(&self, key: &str, choices: &[(&str, T)]) -> Option<T> {
        let word = self.text(key)?;
        let found = choices.iter().find(|c| c.0 == word).map(|c| c.1);
        if found.is_none() {
            let message = format!("{} cannot be `{word}`", self.name(key));
            let problem = Problem::new(Kind::UnknownName, &self.span_of(key), message)
                .expected(format!("one of {}", choices.iter().map(|c| c.0).collect::<Vec<_>>().join(", ")));
            self.log.error(problem.suggest_near(word, choices.iter().map(|c| c.0)));
        }
        found
    }

    // --- tables ---

    /// The table of this key, if present.
    pub fn table(&self, key: &str) -> Option<Reader<'a>> {
        let entry = self.entry(key)?;
        match &entry.node.value {
            Value::Table(table) => Some(Reader::new(table, self.name(key), entry.key_span.clone(), self.log)),
            _ => {
                self.wrong_type(key, &entry.node, &format!("a table [{}]", self.name(key)));
                None
            }
        }
    }

    /// The table of this key, or an empty one.
    pub fn table_or_empty(&self, key: &str) -> Reader<'a> {
        self.table(key)
            .unwrap_or_else(|| Reader::new(&EMPTY_TABLE, self.name(key), self.span.clone(), self.log))
    }

    /// The named tables under a key, `[disc.a]`, `[disc.b]`, in file order.
    pub fn items(&self, key: &str) -> Vec<(&'a str, Reader<'a>)> {
        let Some(all) = self.table(key) else { return Vec::new() };
        let mut items = Vec::new();
        for entry in &all.table.entries {
            let path = all.name(&entry.key);
            match &entry.node.value {
                Value::Table(table) => {
                    let reader = Reader::new(table, path, entry.key_span.clone(), self.log);
                    items.push((entry.key.as_str(), reader));
                }
                _ => all.wrong_type(&entry.key, &entry.node, &format!("a table [{path}]")),
            }
        }
        items
    }

    /// The tables of a list, `[[shaft.section]]`.
    pub fn tables(&self, key: &str) -> Vec<Reader<'a>> {
        let Some(entry) = self.entry(key) else { return Vec::new() };
        let items = match &entry.node.value {
            Value::List(items) => items.as_slice(),
            _ => std::slice::from_ref(&entry.node),
        };
        let mut readers = Vec::new();
        for (k, item) in items.iter().enumerate() {
            match &item.value {
                Value::Table(table) => {
                    let path = format!("{}[{k}]", self.name(key));
                    readers.push(Reader::new(table, path, item.span.clone(), self.log));
                }
                _ => self.wrong_type(key, item, &format!("tables [[{}]]", self.name(key))),
            }
        }
        readers
    }

    /// All entries of this table, marked as known.
    pub fn entries(&self) -> &'a [Entry] {
        for entry in &self.table.entries {
            self.entry(&entry.key);
        }
        &self.table.entries
    }

    /// Report every unknown key (never requested); the missing key that it misspells is no longer reported.
    pub fn finish(self) {
        let requested = self.requested_keys.borrow();
        let known: Vec<&str> = requested.iter().map(String::as_str).collect();
        for entry in self.table.entries.iter().filter(|e| !known.contains(&e.key.as_str())) {
            if let Some(meant) = nearest(&entry.key, known.iter().copied()) {
                self.log.retract_missing(&self.span, &self.missing_message(meant));
            }
            let message = format!("unknown key {}", self.name(&entry.key));
            let problem = Problem::new(Kind::UnknownKey, &entry.key_span, message);
            self.log.error(problem.suggest(&entry.key, known.iter().copied()));
        }
    }
}

/// Example of a quantity as it is written in the file.
fn quoted_example(dimension: Dimension) -> String {
    if dimension == NUMBER { dimension.example.into() } else { format!("\"{}\"", dimension.example) }
}

fn expected_quantity(dimension: Dimension) -> String {
    format!("{} such as {}", with_article(dimension.name), quoted_example(dimension))
}

fn with_article(noun: &str) -> String {
    let article = if noun.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" };
    format!("{article} {noun}")
}

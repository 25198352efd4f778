//! Typed access to one table of the file: every problem is logged with its span and reading continues.
//!
//! A reader takes declared keys only. A method that must return a value returns a placeholder after an error; a
//! model with errors is never returned.
//! Every requested key is recorded as known, so [`Reader::finish`] can report unknown keys with a suggestion.

use super::diagnostic::{Kind, Log, Problem};
use super::key::{Absent, Count, Declared, Flag, Key, SubTable, Table as Declaration, Text, Texts, Words};
use super::synonyms::key_of_synonym;
use super::tree::{Entry, Node, Table, Value};
use rotordyn_units::names::nearest;
use std::cell::RefCell;
use std::collections::HashSet;
use std::ops::Range;
use std::sync::LazyLock;

/// One table of the file.
pub(crate) struct Reader<'a> {
    pub(super) table: &'a Table,
    /// Keys that may be read.
    declared: &'static Declaration,
    /// Span of the table's key.
    pub span: Range<usize>,
    /// Path of the table: "bearing.B".
    pub path: String,
    /// Path without names of items, of the declaration: "bearing".
    pub(super) declared_path: String,
    pub log: &'a Log,
    errors_before: usize,
    requested_keys: RefCell<Requested>,
    /// Keys of which one had to be chosen and none is given.
    open_choices: RefCell<Vec<&'static str>>,
}

/// Keys in the order in which they were first asked for.
#[derive(Default)]
struct Requested {
    names: Vec<String>,
    known: HashSet<String>,
}

/// Most unknown keys of a table that are reported one by one: fewer than a person reads, and than the program prints.
const MAX_UNKNOWN: usize = 20;

static EMPTY_TABLE: LazyLock<Table> = LazyLock::new(Table::default);

impl<'a> Reader<'a> {
    /// The whole file.
    pub fn root(table: &'a Table, declared: &'static Declaration, log: &'a Log) -> Self {
        Self::new(table, declared, [String::new(), String::new()], 0..0, log)
    }

    pub(super) fn new(
        table: &'a Table,
        declared: &'static Declaration,
        [path, declared_path]: [String; 2],
        span: Range<usize>,
        log: &'a Log,
    ) -> Self {
        Self {
            table,
            declared,
            span,
            path,
            declared_path,
            log,
            errors_before: log.error_count(),
            requested_keys: RefCell::default(),
            open_choices: RefCell::default(),
        }
    }

    /// Whether no error has been logged since this table was opened.
    pub fn has_no_errors(&self) -> bool {
        self.log.error_count() == self.errors_before
    }

    pub fn entry(&self, key: &dyn Declared) -> Option<&'a Entry> {
        let is_declared = self.declared.keys().any(|declared| declared.is(key));
        debug_assert!(is_declared, "the key `{}` is not declared for {}", key.name(), self.path);
        self.mark_known(key.name());
        self.table.get(key.name())
    }

    fn mark_known(&self, name: &str) {
        let mut requested = self.requested_keys.borrow_mut();
        if !requested.known.contains(name) {
            requested.known.insert(name.into());
            requested.names.push(name.into());
        }
    }

    pub fn has(&self, key: &dyn Declared) -> bool {
        self.entry(key).is_some()
    }

    /// Whether the key's value is a table.
    pub fn has_table(&self, key: &dyn Declared) -> bool {
        matches!(self.entry(key).map(|e| &e.node.value), Some(Value::Table(_)))
    }

    /// The key's value if it is a text; not checked otherwise.
    pub fn given_text(&self, key: &dyn Declared) -> Option<&'a str> {
        match self.entry(key).map(|e| &e.node.value) {
            Some(Value::Text(text)) => Some(text),
            _ => None,
        }
    }

    /// Span of the key's value, or of the table if the key is absent.
    pub fn span_of(&self, key: &dyn Declared) -> Range<usize> {
        self.entry_span(key.name())
    }

    /// Span of the value of a name that the user chose.
    pub fn entry_span(&self, name: &str) -> Range<usize> {
        self.table.get(name).map_or_else(|| self.span.clone(), |e| e.node.span.clone())
    }

    /// Name of a key for messages, as written in the file: "bearing.B.balls".
    pub fn name(&self, key: &dyn Declared) -> String {
        self.entry_name(key.name())
    }

    pub(super) fn entry_name(&self, key: &str) -> String {
        let key = self.table.get(key).map_or(key, Entry::written_key);
        if self.path.is_empty() { key.into() } else { format!("{}.{key}", self.path) }
    }

    /// Path of a key in the file and in the declaration.
    pub(super) fn paths(&self, key: &dyn Declared) -> [String; 2] {
        let dot = if self.declared_path.is_empty() { "" } else { "." };
        [self.name(key), format!("{}{dot}{}", self.declared_path, key.name())]
    }

    /// Log an error at a key's value (or at the table).
    pub fn error(&self, kind: Kind, key: &dyn Declared, message: impl Into<String>) {
        self.log.error(Problem::new(kind, &self.span_of(key), message));
    }

    /// Whether a key is given by a setting of the command line.
    pub fn is_setting(&self, key: &dyn Declared) -> bool {
        self.entry(key).is_some_and(|entry| self.log.is_setting(&entry.key_span))
    }

    /// Record the value of a key that the file does not give, in words.
    pub fn taken_by_default(&self, key: &dyn Declared, value: impl Into<String>) {
        // as in the path of a setting, an item of a list by its number
        let path = self.name(key).replace('[', ".").replace(']', "");
        self.log.taken_by_default(path, value.into());
    }

    /// Record the declared default of a key, if the file does not give it.
    pub(super) fn note_default(&self, key: &dyn Declared) {
        if !self.has(key)
            && let Some(value) = key.default_text()
        {
            self.taken_by_default(key, value);
        }
    }

    /// Log that a key is missing, with its example.
    pub fn missing(&self, key: &dyn Declared) {
        self.missing_or(key, "");
    }

    /// [`missing`](Self::missing), with what may be given instead.
    pub fn missing_or(&self, key: &dyn Declared, instead: &str) {
        self.missing_as(key, &format!("{}{instead}", key.example()));
    }

    /// [`missing`](Self::missing) with an example that depends on the model.
    pub fn missing_as(&self, key: &dyn Declared, example: &str) {
        let add = format!("{} = {example}", key.name());
        let Some(others) = self.log.others_of_added_item(self.span.start) else {
            let problem = Problem::new(Kind::MissingKey, &self.span, self.missing_message(key.name()));
            return self.log.error(problem.hint(format!("add {add}")));
        };
        // an item that only the variant has is rather a misspelt one than one without its keys
        let (kind, name) = self.path.split_once('.').unwrap_or(("item", &self.path));
        let problem = Problem::new(Kind::UnknownName, &self.span, format!("unknown {kind} `{name}`"));
        self.log.error_once(problem.hint(format!("known here: {others}; a new {kind} needs {add}")));
    }

    fn missing_message(&self, key: &str) -> String {
        format!("{} is missing", self.entry_name(key))
    }

    pub(super) fn wrong_type(&self, name: &str, node: &Node, expected: &str) {
        let message = format!("{} is {}", self.entry_name(name), node.value.type_name());
        self.log.error(Problem::new(Kind::WrongType, &node.span, message).expected(expected));
    }

    /// Log an error if more than one of these mutually exclusive keys is given; returns the first one given. A key of a
    /// variant takes the place of those that it overrides, a key of the command line that of all of the file.
    pub fn one_of<'k>(&self, keys: &[&'k dyn Declared]) -> Option<&'k dyn Declared> {
        let mut given: Vec<&'k dyn Declared> = keys.iter().copied().filter(|k| self.has(*k)).collect();
        let precedence =
            |key: &&dyn Declared| self.entry(*key).map_or(0, |entry| self.log.precedence(&entry.key_span));
        let last = given.iter().map(precedence).max().unwrap_or(0);
        given.retain(|key| precedence(key) == last);
        if let [first, second, ..] = given[..] {
            let message = format!("{} and `{}` are mutually exclusive", self.name(first), second.name());
            let problem = Problem::new(Kind::Conflict, &self.span_of(second), message);
            let names: Vec<&str> = keys.iter().map(|key| key.name()).collect();
            self.log.error(problem.hint(format!("give one of {}", names.join(", "))));
        }
        if given.is_empty() {
            self.open_choices.borrow_mut().extend(keys.iter().map(|key| key.name()));
        }
        given.first().copied()
    }

    // --- words and counts ---

    /// The text of a key, or its default.
    pub fn text(&self, key: &Key<Text>) -> Option<&'a str> {
        self.note_default(key);
        let default = match key.about.absent {
            Absent::Default(text) => Some(text),
            _ => None,
        };
        self.entry(key).map_or(default, |entry| self.text_of(key, entry).or(default))
    }

    fn text_of(&self, key: &dyn Declared, entry: &'a Entry) -> Option<&'a str> {
        match &entry.node.value {
            Value::Text(text) => Some(text),
            value => {
                let message = format!("{} is {}", self.name(key), value.type_name());
                let problem = Problem::new(Kind::WrongType, &entry.node.span, message);
                let problem = problem.expected("a string in quotes");
                self.log.error(match value {
                    Value::Integer(number) => problem.hint(format!("write \"{number}\"")),
                    _ => problem,
                });
                None
            }
        }
    }

    /// The text of a key that must be given.
    pub fn need_text(&self, key: &Key<Text>) -> Option<&'a str> {
        if !self.has(key) {
            self.missing(key);
        }
        self.text(key)
    }

    /// A list of strings, each with its span; a single string counts as a list of one.
    pub fn texts(&self, key: &Key<Texts>) -> Option<Vec<(&'a str, Range<usize>)>> {
        let entry = self.entry(key)?;
        let items = match &entry.node.value {
            Value::List(items) => items.as_slice(),
            _ => std::slice::from_ref(&entry.node),
        };
        let mut texts = Vec::new();
        for item in items {
            match &item.value {
                Value::Text(text) => texts.push((text.as_str(), item.span.clone())),
                _ => self.wrong_type(key.name(), item, "a string in quotes"),
            }
        }
        Some(texts)
    }

    /// True or false as given, else the default.
    pub fn flag(&self, key: &Key<Flag>) -> bool {
        self.note_default(key);
        self.flag_or(key, matches!(key.about.absent, Absent::Default("true")))
    }

    /// [`flag`](Self::flag) with a computed default.
    pub fn flag_or(&self, key: &Key<Flag>, default: bool) -> bool {
        let Some(entry) = self.entry(key) else { return default };
        match entry.node.value {
            Value::Boolean(b) => b,
            _ => {
                self.wrong_type(key.name(), &entry.node, "true or false");
                default
            }
        }
    }

    /// A whole number as given, else the default; the least number as placeholder.
    pub fn count(&self, key: &Key<Count>) -> usize {
        self.note_default(key);
        let default = match key.about.absent {
            Absent::Default(text) => text.parse().ok(),
            Absent::DefaultCount(value) => Some(value),
            _ => None,
        };
        if default.is_none() && !self.has(key) {
            self.missing(key);
        }
        self.count_or(key, default.unwrap_or(key.value.least))
    }

    /// [`count`](Self::count) with a computed default.
    pub fn count_or(&self, key: &Key<Count>, default: usize) -> usize {
        self.count_up_to(key, key.value.greatest).unwrap_or(default)
    }

    /// A whole number of at most `greatest`; `None` without the key and after an error.
    pub fn count_up_to(&self, key: &Key<Count>, greatest: usize) -> Option<usize> {
        let entry = self.entry(key)?;
        let range = key.value.least..=greatest;
        let expected = format!("a whole number from {} to {}", range.start(), range.end());
        match entry.node.value {
            Value::Integer(i) => match usize::try_from(i) {
                Ok(n) if range.contains(&n) => return Some(n),
                _ => {
                    let message = format!("{} is out of range", self.name(key));
                    self.log
                        .error(Problem::new(Kind::OutOfRange, &entry.node.span, message).expected(expected));
                }
            },
            _ => self.wrong_type(key.name(), &entry.node, &expected),
        }
        None
    }

    /// What the given word stands for; `None` without the key and after an error.
    pub fn choice<T: Copy + Sync + std::fmt::Debug>(&self, key: &Key<Words<T>>) -> Option<T> {
        let entry = self.entry(key)?;
        let word = self.text_of(key, entry)?;
        let choices = key.value.0;
        let found = choices.iter().find(|c| c.0 == word).map(|c| c.1);
        if found.is_none() {
            let message = format!("{} cannot be `{word}`", self.name(key));
            let problem = Problem::new(Kind::UnknownName, &self.span_of(key), message)
                .expected(format!("one of {}", choices.iter().map(|c| c.0).collect::<Vec<_>>().join(", ")));
            self.log.error(problem.suggest_near(word, choices.iter().map(|c| c.0)));
        }
        found
    }

    /// What the given word or the default stands for.
    pub fn word<T: Copy + Sync + std::fmt::Debug>(&self, key: &Key<Words<T>>) -> T {
        self.note_default(key);
        self.choice(key).unwrap_or_else(|| key.default_word())
    }

    // --- tables ---

    /// The table of this key, if present.
    pub fn table(&self, key: &Key<SubTable>) -> Option<Reader<'a>> {
        self.table_of(key, key.value.0)
    }

    pub(super) fn table_of(&self, key: &dyn Declared, declared: &'static Declaration) -> Option<Reader<'a>> {
        let entry = self.entry(key)?;
        match &entry.node.value {
            Value::Table(table) => {
                Some(Reader::new(table, declared, self.paths(key), entry.key_span.clone(), self.log))
            }
            value => {
                let message = format!("{} is {}", self.name(key), value.type_name());
                let problem = Problem::new(Kind::WrongType, &entry.node.span, message);
                let names: Vec<&str> = declared.keys().map(|key| key.name()).collect();
                let problem = problem.expected(format!("a table [{}]", self.name(key)));
                self.log.error(match (value, names.first()) {
                    (Value::Text(text), Some(first)) => problem.hint(format!(
                        "write {} = {{ {first} = \"{text}\" }}; its keys are {}",
                        key.name(),
                        names.join(", ")
                    )),
                    _ => problem,
                });
                None
            }
        }
    }

    /// The table of this key, or an empty one.
    pub fn table_or_empty(&self, key: &Key<SubTable>) -> Reader<'a> {
        self.table(key).unwrap_or_else(|| {
            Reader::new(&EMPTY_TABLE, key.value.0, self.paths(key), self.span.clone(), self.log)
        })
    }

    /// All entries of this table, marked as known.
    pub fn entries(&self) -> &'a [Entry] {
        for entry in self.table.entries() {
            self.mark_known(&entry.key);
        }
        self.table.entries()
    }

    /// Names of all declared keys, each once.
    fn declared_names(&self) -> Vec<&'static str> {
        let mut names: Vec<&str> = Vec::new();
        for key in self.declared.keys() {
            if !names.contains(&key.name()) {
                names.push(key.name());
            }
        }
        names
    }

    /// Report every unknown key (never requested); the missing key that it misspells is no longer reported, nor are keys that
    /// depend on a choice that is missing.
    pub fn finish(self) {
        let requested = self.requested_keys.borrow();
        let unknown: Vec<&Entry> =
            self.table.entries().iter().filter(|e| !requested.known.contains(&e.key)).collect();
        if unknown.is_empty() {
            return;
        }
        let known: Vec<&str> = requested.names.iter().map(String::as_str).collect();
        let declared = self.declared_names();
        let choices = self.open_choices.borrow();
        let is_open = !choices.is_empty()
            && (!self.has_no_errors() || unknown.iter().any(|e| !declared.contains(&e.key.as_str())));
        let mut unknown = unknown.into_iter().filter(|e| !is_open || !declared.contains(&e.key.as_str()));
        for entry in unknown.by_ref().take(MAX_UNKNOWN) {
            let synonym = key_of_synonym(&entry.key, &known);
            let meant = synonym.or_else(|| nearest(&entry.key, known.iter().copied()));
            if let Some(meant) = meant {
                self.retract_missing(meant, &choices);
            }
            let message = format!("unknown key {}", self.entry_name(&entry.key));
            let problem = Problem::new(Kind::UnknownKey, &entry.key_span, message);
            let command = format!("rotordyn help {}", self.declared_path);
            let all_keys = format!("; `{}` explains them", command.trim_end());
            let problem = match (synonym, &entry.node.value) {
                (Some(key), _) => problem.hint(format!("did you mean `{key}`?")),
                (None, Value::Table(_) | Value::List(_)) if self.path.is_empty() => {
                    problem.suggest_all(&entry.key, &declared)
                }
                _ => problem.suggest(self.log, &entry.key, known.iter().copied()),
            };
            self.log.error(problem.after_list(&all_keys));
        }
        if let Some(next) = unknown.next() {
            let place = if self.path.is_empty() { "the file" } else { &self.path };
            let message = format!("{} more unknown keys in {place}", 1 + unknown.count());
            let problem = Problem::new(Kind::UnknownKey, &next.key_span, message);
            self.log.error(problem.hint(format!("the first {MAX_UNKNOWN} are reported one by one")));
        }
    }

    /// Takes back that a key is missing, or another one of the keys of which one had to be chosen, and at the root what follows
    /// from a table that is missing.
    fn retract_missing(&self, meant: &str, choices: &[&str]) {
        let retract = |message| self.log.retract_missing(self.errors_before, &self.span, message);
        retract(self.missing_message(meant));
        if choices.contains(&meant) {
            choices.iter().for_each(|choice| retract(self.missing_message(choice)));
        }
        if self.path.is_empty() {
            retract(missing_table(meant));
            self.log.add_cause(meant);
        }
    }
}

/// Message of a table that the file lacks.
fn missing_table(name: &str) -> String {
    format!("the file has no [{name}] table")
}

/// The error of a file without a table that it needs; once, and not beside a misspelling of it.
pub(crate) fn missing_table_problem(name: &str) -> Problem {
    Problem::new(Kind::MissingKey, &(0..0), missing_table(name))
}

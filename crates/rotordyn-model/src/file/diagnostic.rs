//! Diagnostics (errors and warnings) of a model file: plain data with spans into its text.

use rotordyn_core::warning::{Code, Warning};
use rotordyn_units::names::nearest;
use std::cell::{Cell, RefCell};
use std::collections::{HashMap, HashSet};
use std::ops::Range;
use std::rc::Rc;

/// A text that was read: the model file, or one `--set` argument.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    pub name: String,
    pub text: String,
}

/// Kind of a problem, machine-readable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Not TOML, or not text at all.
    Syntax,
    UnknownKey,
    MissingKey,
    WrongType,
    MissingUnit,
    /// Unknown unit or malformed quantity.
    BadQuantity,
    WrongDimension,
    /// Negative, zero, infinite or NaN where not allowed.
    OutOfRange,
    /// A station, body, material, designation, variant or other item that does not exist.
    UnknownName,
    /// Mutually exclusive keys, or a duplicate name.
    Conflict,
    /// Incompatible dimensions.
    Geometry,
    /// A body or shaft without the supports or connections it needs.
    Disconnected,
    /// A `--set` argument whose path does not exist.
    BadPath,
    /// Former spelling of a renamed key or keyword: only a hint.
    FormerName,
    /// A key that a setting of the command line makes ineffective: only a hint.
    Ineffective,
}

/// A value that the file does not give.
#[derive(Clone, Debug, PartialEq)]
pub struct DefaultValue {
    /// Path of the key that sets it: "bearing.A.contact_damping".
    pub path: String,
    /// Value as it would be written in the file, or in words.
    pub value: String,
}

/// One problem with its location.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    pub kind: Kind,
    /// Code and item of a warning; `None` for an error or hint.
    pub warning: Option<(Code, String)>,
    /// Index of the source that the span refers to.
    pub source: usize,
    /// Byte range in the source's text.
    pub span: Range<usize>,
    pub message: String,
    /// Expected content; shown at the span.
    pub expected: Option<String>,
    /// How to fix it.
    pub hint: Option<String>,
}

impl Diagnostic {
    /// The warning as data, without its place in the file; `None` for an error or hint.
    pub fn to_warning(&self) -> Option<Warning> {
        let (code, item) = self.warning.clone()?;
        let expected = self.expected.as_ref().map_or(String::new(), |expected| format!(": {expected}"));
        let text = format!("{}{expected}", self.message);
        Some(Warning::new(code, item, text).advise(self.hint.clone().unwrap_or_default()))
    }
}

/// All errors of a model file.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}", summary(.diagnostics))]
pub struct ModelErrors {
    pub sources: Vec<Source>,
    pub diagnostics: Vec<Diagnostic>,
}

fn summary(diagnostics: &[Diagnostic]) -> String {
    diagnostics.iter().map(|d| d.message.as_str()).collect::<Vec<_>>().join("; ")
}

/// A problem under construction: its span is an offset over all sources.
#[derive(Clone, Debug)]
pub(crate) struct Problem {
    kind: Kind,
    warning: Option<Box<(Code, String)>>,
    span: Range<usize>,
    message: String,
    expected: Option<String>,
    hint: Option<String>,
    /// Table of the file without whose own errors there would perhaps be no such problem.
    follows: Option<&'static str>,
}

impl Problem {
    pub fn new(kind: Kind, span: &Range<usize>, message: impl Into<String>) -> Self {
        Self {
            kind,
            warning: None,
            span: span.clone(),
            message: message.into(),
            expected: None,
            hint: None,
            follows: None,
        }
    }

    pub fn expected(mut self, text: impl Into<String>) -> Self {
        self.expected = Some(text.into());
        self
    }

    pub fn hint(mut self, text: impl Into<String>) -> Self {
        self.hint = Some(text.into());
        self
    }

    /// Not reported beside an error of this table of the file, of which it may be a consequence.
    pub fn follows(mut self, table: &'static str) -> Self {
        self.follows = Some(table);
        self
    }

    /// Suggest the nearest known name, if any is close.
    pub fn suggest_near<'n>(self, word: &str, known: impl IntoIterator<Item = &'n str>) -> Self {
        match nearest(word, known) {
            Some(near) => self.hint(format!("did you mean `{near}`?")),
            None => self,
        }
    }

    /// Suggest the nearest known name, if any is close, and list all.
    pub fn suggest_all(self, word: &str, known: &[&str]) -> Self {
        let near = nearest(word, known.iter().copied());
        let meant = near.map_or(String::new(), |near| format!("did you mean `{near}`? "));
        self.hint(format!("{meant}known here: {}", known.join(", ")))
    }

    /// Append to a hint that lists names.
    pub fn after_list(mut self, text: &str) -> Self {
        if let Some(hint) = self.hint.as_mut().filter(|hint| hint.contains("known here")) {
            hint.push_str(text);
        }
        self
    }

    /// Suggest the nearest known name, or list the known names if none is close; not beside [`MAX_SUGGESTIONS`] errors.
    pub fn suggest<'n>(self, log: &Log, word: &str, known: impl IntoIterator<Item = &'n str>) -> Self {
        if !log.suggests() {
            return self;
        }
        let known: Vec<&str> = known.into_iter().collect();
        if let Some(near) = nearest(word, known.iter().copied()) {
            return self.hint(format!("did you mean `{near}`?"));
        }
        match known.len() {
            0 => self,
            1..=12 => self.hint(format!("known here: {}", known.join(", "))),
            n => self.hint(format!("known here: {} and {} more", known[..12].join(", "), n - 12)),
        }
    }
}

/// Errors that are reported with names that may be meant: more than a person reads, and than the program prints. Every name
/// of the file is compared with the unknown one.
const MAX_SUGGESTIONS: usize = 100;

/// All texts that were read, concatenated so that one offset identifies a location in any of them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sources {
    sources: Vec<Source>,
    starts: Vec<usize>,
}

impl Sources {
    /// Add a text; returns the offset at which its spans start.
    pub fn push(&mut self, name: impl Into<String>, text: impl Into<String>) -> usize {
        let start = self.starts.last().map_or(0, |s| s + self.sources[self.sources.len() - 1].text.len() + 1);
        self.starts.push(start);
        self.sources.push(Source { name: name.into(), text: text.into() });
        start
    }

    /// Finished diagnostics, in the order of the texts.
    pub fn locate(&self, mut problems: Vec<Problem>) -> Vec<Diagnostic> {
        problems.sort_by_key(|p| (p.span.start, p.span.end));
        let locate = |p: Problem| {
            let source = self.starts.iter().rposition(|&s| s <= p.span.start).unwrap_or(0);
            let start = self.starts.get(source).copied().unwrap_or(0);
            let length = self.sources.get(source).map_or(0, |s| s.text.len());
            let local = |at: usize| at.saturating_sub(start).min(length);
            Diagnostic {
                kind: p.kind,
                warning: p.warning.map(|warning| *warning),
                source,
                span: local(p.span.start)..local(p.span.end),
                message: p.message,
                expected: p.expected,
                hint: p.hint,
            }
        };
        problems.into_iter().map(locate).collect()
    }

    pub fn into_vec(self) -> Vec<Source> {
        self.sources
    }
}

/// What is reported once.
#[derive(PartialEq, Eq, Hash)]
enum Reported {
    Error(Range<usize>, String),
    Hint(String),
    Default(String),
}

/// Span of a table, and the message of a key that it lacks.
type PlaceAndMessage = (Range<usize>, String);

/// Problems found so far; reading continues after each.
#[derive(Default)]
pub(crate) struct Log {
    errors: RefCell<Vec<Problem>>,
    /// Places in `errors` of missing keys, by the span of their table and their message.
    missing: RefCell<HashMap<PlaceAndMessage, Vec<usize>>>,
    /// Places in `errors` of those that are not reported.
    retracted: RefCell<HashSet<usize>>,
    /// Tables of the file with errors, whose consequences are not reported.
    causes: RefCell<HashSet<String>>,
    /// Starts of the items that a variant adds, with the names of the others of the kind.
    added_items: RefCell<HashMap<usize, Rc<str>>>,
    warnings: RefCell<Vec<Problem>>,
    hints: RefCell<Vec<Problem>>,
    conflicts: RefCell<Vec<Problem>>,
    defaults: RefCell<Vec<DefaultValue>>,
    /// What was reported already, of what is reported once.
    seen: RefCell<HashSet<Reported>>,
    /// Where the spans of the file end and those of settings of the command line start.
    file_end: Cell<usize>,
    /// Starts of the keys that each variant sets, in the order in which the variants apply.
    variant_keys: RefCell<Vec<HashSet<usize>>>,
}

impl Log {
    pub fn error(&self, problem: Problem) {
        let mut errors = self.errors.borrow_mut();
        if problem.kind == Kind::MissingKey {
            let key = (problem.span.clone(), problem.message.clone());
            self.missing.borrow_mut().entry(key).or_default().push(errors.len());
        }
        errors.push(problem);
    }

    /// Names a table of the file that has errors: what follows from them is not reported.
    pub fn add_cause(&self, table: &str) {
        self.causes.borrow_mut().insert(table.into());
    }

    /// Record an item that a variant adds to others, of which it may be a misspelling.
    pub fn add_item(&self, start: usize, others: Rc<str>) {
        self.added_items.borrow_mut().insert(start, others);
    }

    /// Names of the other items of the kind, if a variant adds the item whose name starts there.
    pub fn others_of_added_item(&self, start: usize) -> Option<Rc<str>> {
        self.added_items.borrow().get(&start).cloned()
    }

    /// Whether names that may be meant are still looked for.
    pub fn suggests(&self) -> bool {
        self.error_count() <= MAX_SUGGESTIONS
    }

    fn is_first(&self, report: Reported) -> bool {
        self.seen.borrow_mut().insert(report)
    }

    /// Add an error of a place that is read more than once.
    pub fn error_once(&self, problem: Problem) {
        if self.is_first(Reported::Error(problem.span.clone(), problem.message.clone())) {
            self.error(problem);
        }
    }

    /// Remove the report of a missing key whose misspelt form was found, which is not among the first `before` errors.
    pub fn retract_missing(&self, before: usize, span: &Range<usize>, message: String) {
        let missing = self.missing.borrow();
        let places = missing.get(&(span.clone(), message)).into_iter().flatten();
        self.retracted.borrow_mut().extend(places.filter(|place| **place >= before));
    }

    /// Add a warning about an item of the file, such as `bearing.B`.
    pub fn warn(&self, code: Code, item: impl Into<String>, problem: Problem) {
        self.warnings.borrow_mut().push(Problem { warning: Some(Box::new((code, item.into()))), ..problem });
    }

    /// Add a conflict of a study with the run: of no concern to the other studies.
    pub fn conflict(&self, problem: Problem) {
        self.conflicts.borrow_mut().push(problem);
    }

    /// Add a hint, once per message.
    pub fn hint(&self, problem: Problem) {
        if self.is_first(Reported::Hint(problem.message.clone())) {
            self.hints.borrow_mut().push(problem);
        }
    }

    /// Record a value that the file does not give, once per path.
    pub fn taken_by_default(&self, path: String, value: String) {
        if self.is_first(Reported::Default(path.clone())) {
            self.defaults.borrow_mut().push(DefaultValue { path, value });
        }
    }

    /// Values that the file does not give, in the order in which they were read.
    pub fn defaults(&self) -> Vec<DefaultValue> {
        self.defaults.borrow().clone()
    }

    /// Set the end of the file: spans beyond it are those of settings.
    pub fn set_file_end(&self, end: usize) {
        self.file_end.set(end);
    }

    /// End of the file.
    pub fn file_end(&self) -> usize {
        self.file_end.get()
    }

    /// Whether a span lies in a setting of the command line.
    pub fn is_setting(&self, span: &Range<usize>) -> bool {
        span.start > self.file_end.get()
    }

    /// Record the starts of the keys that a variant sets.
    pub fn add_variant(&self, keys: Vec<usize>) {
        self.variant_keys.borrow_mut().push(keys.into_iter().collect());
    }

    /// Which of two keys overrides the other: 0 in the file itself, then the variants in order, then the command line.
    pub fn precedence(&self, span: &Range<usize>) -> usize {
        let variants = self.variant_keys.borrow();
        if self.is_setting(span) {
            return variants.len() + 1;
        }
        variants.iter().rposition(|keys| keys.contains(&span.start)).map_or(0, |of| of + 1)
    }

    /// Number of errors so far, with those retracted; a check that needs valid values compares it with the number before.
    pub fn error_count(&self) -> usize {
        self.errors.borrow().len()
    }

    pub fn into_errors(self) -> Vec<Problem> {
        let (retracted, causes) = (self.retracted.into_inner(), self.causes.into_inner());
        let errors = self.errors.into_inner().into_iter().enumerate();
        let errors = errors.filter(|(place, _)| !retracted.contains(place)).map(|(_, problem)| problem);
        let follows = |problem: &Problem| problem.follows.is_some_and(|table| causes.contains(table));
        let (consequences, errors): (Vec<_>, Vec<_>) = errors.partition(follows);
        // a cause is an error too, but what has errors must report one
        if errors.is_empty() { consequences } else { errors }
    }

    /// Warnings, hints and conflicts.
    pub fn into_notes(self) -> [Vec<Problem>; 3] {
        [self.warnings, self.hints, self.conflicts].map(RefCell::into_inner)
    }
}

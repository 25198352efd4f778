//! Quantities of a table: single values, lists, vectors, and values spaced evenly.

use super::diagnostic::{Kind, Problem};
use super::key::{
    Absent, Count, Declared, Key, NamedQuantities, Quantities, Quantity, Range, Spaced, Special, Table,
    Words, any, count, keys, positive, quantity, words,
};
use super::reader::Reader;
use super::tree::{Entry, Node, Value};
use rotordyn_units::{self as units, Dimension, NUMBER, TEMPERATURE, UnitError};
use std::ops::Range as Span;

/// Of a table whose names the user chooses.
const NO_KEYS: &Table = &Table { meaning: "", groups: &[] };

keys! {
    /// Values spaced evenly; ends and step have the dimension of the key they belong to.
    pub(crate) static SPACED: SpacedKeys = "Values spaced evenly, or by equal ratios." {
        from: Quantity = quantity(any(NUMBER), "First value.");
        to: Quantity = quantity(any(NUMBER), "Last value; the step is rounded to end there.");
        count: Count = count([2, 1_000_000], "Number of values; or give step.").required("or step").example("25");
        step: Quantity = quantity(positive(NUMBER), "Distance of the values; or give count.").required("or count");
        spacing: Words<bool> = words(&[("linear", false), ("log", true)], "Equal distances or equal ratios.")
            .default("linear");
    }
}

impl<'a> Reader<'a> {
    /// The given value; `None` without the key and after an error.
    pub fn get(&self, key: &Key<Quantity>) -> Option<f64> {
        let entry = self.entry(key)?;
        self.single(key.about.name, &entry.node, key.value)
    }

    fn single(&self, key: &str, node: &Node, quantity: Quantity) -> Option<f64> {
        let values = self.quantities(key, node, quantity)?;
        if values.len() > 1 {
            let message =
                format!("{} must be a single value, but has {}", self.entry_name(key), values.len());
            let problem = Problem::new(Kind::WrongType, &node.span, message);
            self.log.error(match &node.value {
                Value::Text(text) if values.len() == 2 => match with_decimal_point(text) {
                    Some(number) => problem.hint(format!("the decimal sign is a point: \"{number}\"")),
                    None => problem,
                },
                _ => problem,
            });
        }
        values.first().copied()
    }

    /// The given value, or a computed default.
    pub fn or(&self, key: &Key<Quantity>, default: f64) -> f64 {
        self.get(key).unwrap_or(default)
    }

    /// The given value, or the key's default; a key without default must be given.
    pub fn value(&self, key: &Key<Quantity>) -> f64 {
        self.note_default(key);
        let default = default_value(key);
        if default.is_none() && !self.has(key) {
            self.missing(key);
        }
        self.or(key, default.unwrap_or(1.0))
    }

    /// A list of quantities, `"0, 600 rpm"` or `["0 rpm", "600 rpm"]`, or the default; `None` after an error.
    pub fn list(&self, key: &Key<Quantities>) -> Option<Vec<f64>> {
        self.list_of(key, key.value.each)
    }

    fn list_of(&self, key: &dyn Declared, each: Quantity) -> Option<Vec<f64>> {
        self.note_default(key);
        match (self.entry(key), key.about().absent) {
            (Some(entry), _) => self.quantities(key.name(), &entry.node, each),
            (None, Absent::Default(text)) => Some(declared_list(text, each.dimension)),
            (None, _) => None,
        }
    }

    /// A list of quantities that must be given.
    pub fn need_list(&self, key: &Key<Quantities>) -> Vec<f64> {
        if !self.has(key) {
            self.missing(key);
        }
        self.list(key).unwrap_or_else(|| vec![1.0])
    }

    /// Three components.
    pub fn vector(&self, key: &Key<Quantities>) -> Option<[f64; 3]> {
        let values = self.list(key)?;
        let vector = values.as_slice().try_into().ok();
        if vector.is_none() {
            let message =
                format!("{} has {} components instead of three (x, y, z)", self.name(key), values.len());
            self.error(Kind::WrongType, key, message);
        }
        vector
    }

    /// The entries of a table whose names the user chose; the value is `None` after an error.
    pub fn named_quantities(&self, key: &Key<NamedQuantities>) -> Vec<(&'a Entry, Option<f64>)> {
        let Some(all) = self.table_of(key, NO_KEYS) else { return Vec::new() };
        let value = |entry: &'a Entry| {
            let before = self.log.error_count();
            self.check_item_name(key.about.name, entry);
            let value = all.single(&entry.key, &entry.node, key.value.0);
            value.filter(|_| self.log.error_count() == before)
        };
        all.entries().iter().map(|entry| (entry, value(entry))).collect()
    }

    /// Span of one of these entries, or of their table if it is absent.
    pub fn named_span(&self, key: &Key<NamedQuantities>, name: &str) -> Span<usize> {
        self.table_of(key, NO_KEYS).map_or(0..0, |all| all.entry_span(name))
    }

    fn quantities(&self, key: &str, node: &Node, quantity: Quantity) -> Option<Vec<f64>> {
        let values = match &node.value {
            Value::List(items) => {
                let mut values = Vec::new();
                let mut failed = false;
                for item in items {
                    match self.quantities(key, item, quantity) {
                        Some(one) => values.extend(one),
                        None => failed = true,
                    }
                }
                if values.is_empty() && !failed {
                    let message = format!("{} is an empty list", self.entry_name(key));
                    self.log.error(Problem::new(Kind::OutOfRange, &node.span, message));
                }
                return (!failed && !values.is_empty()).then_some(values);
            }
            Value::Text(text) => match units::parse_list(text, quantity.dimension) {
                Ok(values) => values,
                Err(error) => {
                    self.log.error(self.unit_problem(key, node, quantity.dimension, &error));
                    return None;
                }
            },
            #[allow(clippy::cast_precision_loss)] // integers in a model file are small
            Value::Integer(i) => vec![self.bare_number(key, node, quantity.dimension, *i as f64)?],
            Value::Float(f) => vec![self.bare_number(key, node, quantity.dimension, *f)?],
            _ => {
                self.wrong_type(key, node, &expected_quantity(quantity.dimension));
                return None;
            }
        };
        match values.iter().find_map(|value| out_of_range(*value, quantity)) {
            Some((what, expected)) => {
                let message = format!("{} is {what}", self.entry_name(key));
                self.log.error(Problem::new(Kind::OutOfRange, &node.span, message).expected(expected));
                None
            }
            None => Some(values),
        }
    }

    fn bare_number(&self, key: &str, node: &Node, dimension: Dimension, value: f64) -> Option<f64> {
        let name = self.entry_name(key);
        let problem = if !value.is_finite() {
            Problem::new(Kind::OutOfRange, &node.span, format!("{name} is not a finite number"))
                .expected(expected_quantity(dimension))
        } else if dimension == NUMBER {
            return Some(value);
        } else {
            Problem::new(Kind::MissingUnit, &node.span, format!("{name} has no unit"))
                .expected(expected_quantity(dimension))
                .hint(unit_hint(key, &value.to_string(), value, dimension))
        };
        self.log.error(problem);
        None
    }

    fn unit_problem(&self, key: &str, node: &Node, dimension: Dimension, error: &UnitError) -> Problem {
        let name = self.entry_name(key);
        let expected = expected_quantity(dimension);
        let problem = |kind, message: String| Problem::new(kind, &node.span, message).expected(&expected);
        match error {
            UnitError::NoUnit(text) => problem(Kind::MissingUnit, format!("{name} has no unit")).hint({
                let last = text.rsplit([',', ' ']).find_map(|word| word.parse().ok()).unwrap_or_default();
                unit_hint(key, text, last, dimension)
            }),
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
            UnitError::UnknownUnit(unit) if unit.ends_with(',') => {
                problem(Kind::BadQuantity, format!("{name}: a unit between the numbers"))
                    .hint("write the unit once, behind the last number, such as \"100, 0 N\"")
            }
            UnitError::UnknownUnit(unit) => problem(
                Kind::BadQuantity,
                format!("{name}: unknown unit `{unit}`"),
            )
            .suggest(self.log, unit, units::unit_names()),
            UnitError::ScaleOfTemperature(_) => problem(Kind::WrongDimension, format!("{name}: {error}"))
                .hint("write K: a temperature difference has the same value in K and degC"),
            UnitError::NotFinite(_) => problem(Kind::OutOfRange, format!("{name} is not a finite number")),
            _ => problem(Kind::BadQuantity, format!("{name}: {error}")),
        }
    }

    /// Values as a list, or spaced evenly: `{ from = "0 rpm", to = "1200 rpm", count = 25 }` or
    /// `step = "50 rpm"`; `spacing = "log"` for equal ratios.
    pub fn spaced(&self, key: &Key<Spaced>) -> Option<Vec<f64>> {
        self.spaced_of(key, key.value.0)
    }

    /// [`spaced`](Self::spaced) with a dimension that depends on other keys.
    pub fn spaced_of(&self, key: &Key<Spaced>, each: Quantity) -> Option<Vec<f64>> {
        if !self.has_table(key) {
            return self.list_of(key, each);
        }
        let r = self.table_of(key, SpacedKeys::TABLE)?;
        let of = |end: Key<Quantity>, value: Quantity| Key { value, ..end };
        let (from, to) = (r.value(&of(SPACED.from, each)), r.value(&of(SPACED.to, each)));
        let logarithmic = r.word(&SPACED.spacing);
        if to <= from && r.has_no_errors() {
            let word = if to < from { "above" } else { "equal to" };
            let message = format!("{} is {word} {}", r.name(&SPACED.from), r.name(&SPACED.to));
            let problem = Problem::new(Kind::OutOfRange, &r.span_of(&SPACED.from), message);
            r.log.error(problem.expected("the lowest value, and the highest in `to`"));
        }
        let count = match r.one_of(&[&SPACED.count, &SPACED.step]) {
            Some(given) if given.is(&SPACED.step) => {
                let step = r.value(&of(SPACED.step, positive(each.dimension)));
                let steps = (to - from) / step;
                if !(1.0..1e6).contains(&steps) && !r.has_no_errors() {
                    2
                } else if !(1.0..1e6).contains(&steps) {
                    let message = format!("{} gives {steps:.0} steps", r.name(&SPACED.step));
                    r.error(Kind::OutOfRange, &SPACED.step, message);
                    2
                } else {
                    steps.round() as usize + 1
                }
            }
            _ => r.count(&SPACED.count),
        };
        if logarithmic && from <= 0.0 && r.has_no_errors() {
            let message = format!("{} must be above zero for equal ratios", r.name(&SPACED.from));
            r.error(Kind::OutOfRange, &SPACED.from, message);
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
}

/// A text whose only comma stands between digits, `9,5 kg`, with a point in its place.
fn with_decimal_point(text: &str) -> Option<String> {
    let (whole, rest) = text.split_once(',')?;
    let is_decimal = whole.ends_with(|c: char| c.is_ascii_digit())
        && rest.starts_with(|c: char| c.is_ascii_digit())
        && !rest.contains(',');
    is_decimal.then(|| format!("{whole}.{rest}"))
}

/// Numbers that a key has by default.
pub(crate) fn default_numbers(key: &Key<Special>) -> Vec<f64> {
    match key.about.absent {
        Absent::Default(text) => declared_list(text, NUMBER),
        _ => Vec::new(),
    }
}

/// Default of a key that has one, in SI units.
pub(crate) fn declared_default(key: &Key<Quantity>) -> f64 {
    default_value(key).expect("the key is declared with a default")
}

/// Default of a key in SI units; `None` without a fixed default.
fn default_value(key: &Key<Quantity>) -> Option<f64> {
    match key.about.absent {
        Absent::Default(text) => declared_list(text, key.value.dimension).first().copied(),
        Absent::DefaultSi(value) => Some(value),
        _ => None,
    }
}

fn declared_list(text: &str, dimension: Dimension) -> Vec<f64> {
    units::parse_list(text, dimension).expect("a test reads every declared default")
}

/// What is wrong with a value, and what is expected instead; `None` in the range.
fn out_of_range(value: f64, quantity: Quantity) -> Option<(&'static str, String)> {
    let name = with_article(quantity.dimension.name);
    let sign = if value < 0.0 { "negative" } else { "zero" };
    match quantity.range {
        Range::Any => None,
        Range::Positive => (value <= 0.0).then(|| (sign, format!("{name} greater than zero"))),
        Range::NotNegative => (value < 0.0).then(|| (sign, format!("{name} zero or greater"))),
        Range::Within(least, greatest) => (!(least..=greatest).contains(&value))
            .then(|| ("out of range", format!("{name} {}", range_words(quantity)))),
        Range::Below(least, limit) => (!(least..limit).contains(&value))
            .then(|| ("out of range", format!("{name} {}", range_words(quantity)))),
    }
}

/// The range of a quantity in words: "greater than zero", "from 0 to 1"; empty if it has none.
pub(crate) fn range_words(quantity: Quantity) -> String {
    let (zero, unit) = match quantity.dimension {
        TEMPERATURE => (273.15, "degC"),
        other => (0.0, other.unit),
    };
    let ends = |word: &str, least: f64, greatest: f64| {
        // the difference of temperatures has round-off
        let [least, greatest] = [least, greatest].map(|end| ((end - zero) * 1e6).round() / 1e6);
        format!("from {least} to {word}{greatest} {unit}").trim_end().to_string()
    };
    match quantity.range {
        Range::Any => String::new(),
        Range::Positive => "greater than zero".into(),
        Range::NotNegative => "zero or greater".into(),
        Range::Within(least, greatest) => ends("", least, greatest),
        Range::Below(least, limit) => ends("below ", least, limit),
    }
}

/// What to write for a number without its unit.
fn unit_hint(key: &str, text: &str, value: f64, dimension: Dimension) -> String {
    let unit = units::likely_unit(dimension, value, key);
    format!("if {unit} is meant, write \"{text} {unit}\"")
}

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

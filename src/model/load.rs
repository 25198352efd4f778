//! One call from the text of a model file to the checked model.

use super::Model;
use super::check;
use super::file::diagnostic::{Log, Problem, Sources};
use super::file::overlay::{apply_set, apply_variant};
use super::file::tree::{Table, Value};
use super::file::{Diagnostic, Kind, ModelErrors, Source};
use std::ops::Range;

/// What is laid over a model file before it is checked.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// Name of a `[variant.NAME]` of the file.
    pub variant: Option<String>,
    /// Path and value of each `--set`, such as ("bearing.B.radial_clearance", "20 um"); applied after the variant.
    pub set: Vec<(String, String)>,
}

/// A model with what was said about it while it was read.
#[derive(Clone, Debug, PartialEq)]
pub struct Loaded {
    pub model: Model,
    pub warnings: Vec<Diagnostic>,
    /// The texts that the warnings point into: the file, then every `--set`.
    pub sources: Vec<Source>,
    /// Text of the model file.
    pub text: String,
}

impl Loaded {
    /// Where the file states an item, such as `["bearing", "B"]`: in the model itself, else in a variant; the start of
    /// the file when it is nowhere (set by `--set`).
    pub fn place_of(&self, path: &[&str]) -> Range<usize> {
        let root = Table::parse(&self.text, 0).unwrap_or_default();
        let variants = match root.get("variant").map(|e| &e.node.value) {
            Some(Value::Table(variants)) => variants.entries.as_slice(),
            _ => &[],
        };
        let tables = variants.iter().filter_map(|e| match &e.node.value {
            Value::Table(table) => Some(table),
            _ => None,
        });
        std::iter::once(&root).chain(tables).find_map(|table| place_in(table, path)).unwrap_or(0..0)
    }
}

fn place_in(table: &Table, path: &[&str]) -> Option<Range<usize>> {
    let (first, rest) = path.split_first()?;
    let entry = table.get(first)?;
    match (rest, &entry.node.value) {
        ([], _) => Some(entry.key_span.clone()),
        (_, Value::Table(inner)) => place_in(inner, rest),
        _ => None,
    }
}

/// Read, vary and check a model; `name` is what messages call the file.
///
/// # Errors
/// Every problem of the file at once, each with its place.
///
/// ```
/// let text = r#"
///     [model]
///     name = "pin"
///     [material.steel]
///     young = "207 GPa"
///     poisson = 0.3
///     density = "7850 kg/m^3"
///     [shaft]
///     element_length = "50 mm"
///     section = [{ length = "0.4 m", outer_diameter = "20 mm" }]
///     [station]
///     A = "0 m"
///     [bearing.A]
///     model = "linear"
///     station = "A"
///     k_xx = "1e7 N/m"
///     k_yy = "1e7 N/m"
/// "#;
/// let model = rotordyn::model::load("pin.toml", text, &Default::default()).unwrap().model;
/// assert_eq!(model.shaft.len(), 8);
/// ```
pub fn load(name: &str, text: impl AsRef<[u8]>, options: &Options) -> Result<Loaded, ModelErrors> {
    let mut sources = Sources::default();
    let log = Log::default();
    let bytes = text.as_ref();
    let text = match std::str::from_utf8(bytes) {
        Ok(text) => text,
        Err(error) => {
            let at = error.valid_up_to();
            sources.push(name, String::from_utf8_lossy(bytes));
            let problem = Problem::new(
                Kind::Syntax,
                &(at..at + '\u{fffd}'.len_utf8()),
                format!("not a text: byte {at} is not UTF-8"),
            );
            log.error(problem.hint("a model file is TOML, saved as UTF-8"));
            return Err(failed(sources, log));
        }
    };
    // editors on Windows put a byte order mark in front
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    sources.push(name, text);
    if text.trim().is_empty() {
        let problem = Problem::new(Kind::Syntax, &(0..0), "the file is empty");
        log.error(problem.hint("start from one of models/*.toml"));
        return Err(failed(sources, log));
    }
    let mut root = match Table::parse(text, 0) {
        Ok(root) => root,
        Err(error) => {
            let span = error.span().unwrap_or(0..0);
            let message = error.message().lines().next().unwrap_or("not TOML").to_string();
            let problem = Problem::new(Kind::Syntax, &span, format!("not TOML: {message}"));
            log.error(problem.hint(match message.as_str() {
                "duplicate key" => "a name can stand only once; to change it in a variant use [variant.NAME]",
                _ => "TOML is described at https://toml.io",
            }));
            return Err(failed(sources, log));
        }
    };
    apply_variant(&mut root, options.variant.as_deref(), &log);
    for (path, value) in &options.set {
        apply_set(&mut root, path, value, &mut sources, &log);
    }
    if log.count() > 0 {
        return Err(failed(sources, log));
    }
    let model = check::build(&root, &log);
    if log.count() > 0 {
        return Err(failed(sources, log));
    }
    let (_, warnings) = log.into_parts();
    let warnings = sources.locate(warnings);
    Ok(Loaded { model, warnings, sources: sources.into_vec(), text: text.to_string() })
}

fn failed(sources: Sources, log: Log) -> ModelErrors {
    let diagnostics = sources.locate(log.into_parts().0);
    ModelErrors { sources: sources.into_vec(), diagnostics }
}

/// Names of the variants of a model file, in file order; none when it is not TOML.
pub fn variants(text: &str) -> Vec<String> {
    let root = Table::parse(text, 0).unwrap_or_default();
    match root.get("variant").map(|e| &e.node.value) {
        Some(Value::Table(variants)) => variants.keys().map(String::from).collect(),
        _ => Vec::new(),
    }
}

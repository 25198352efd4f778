//! Loading: from the text of a model file to the validated model.

mod parameter_range;

use super::build;
use super::file::diagnostic::{Log, Problem, Sources};
use super::file::given::given_values;
use super::file::overlay::{apply_set, apply_variant};
use super::file::renamed;
use super::file::tree::{Entry, Table, Value};
use super::file::{DefaultValue, Diagnostic, GivenValue, Kind, ModelErrors, Source};
use super::keys::{self, KindName};
use super::study::Studies;
use super::{ExternalFile, Model};
use rotordyn_bearing::free_ball::FreeBallBearing;
use rotordyn_bearing::{BallBearing, Bearing};
use std::ops::Range;

/// Overrides applied to a model file before it is validated.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// Name of a `[variant.NAME]` of the file.
    pub variant: Option<String>,
    /// Path and value of each `--set`, such as ("bearing.B.radial_clearance", "20 um"); applied after the variant.
    pub set: Vec<(String, String)>,
}

/// A validated model with the warnings of its file.
#[derive(Clone, Debug, PartialEq)]
pub struct Loaded {
    pub model: Model,
    pub warnings: Vec<Diagnostic>,
    /// Former spellings of renamed keys and keywords; the file is valid and means the same.
    pub hints: Vec<Diagnostic>,
    /// What spectrograms and orders of the run-up ask of it that it does not give: they fail, the other studies do not.
    pub conflicts: Vec<Diagnostic>,
    /// Values that the file gives, after variant and overrides.
    pub given: Vec<GivenValue>,
    /// Values that the file does not give.
    pub defaults: Vec<DefaultValue>,
    /// Texts that the spans of warnings and hints refer to: the file, then every `--set`.
    pub sources: Vec<Source>,
    /// Text of the model file.
    pub text: String,
}

impl Loaded {
    /// For who is about to make spectrograms and orders of the run-up.
    ///
    /// # Errors
    /// The conflicts, if there are any.
    pub fn refuse_conflicts(&self) -> Result<(), ModelErrors> {
        if self.conflicts.is_empty() {
            return Ok(());
        }
        Err(ModelErrors { sources: self.sources.clone(), diagnostics: self.conflicts.clone() })
    }

    /// Span of an item's definition, such as `["bearing", "B"]`: in the model itself, else in a variant; 0..0
    /// if the file does not contain it (set by `--set`).
    pub fn item_span(&self, path: &[&str]) -> Range<usize> {
        item_span(&self.text, path)
    }
}

/// Span of an item's definition in the text of a model file, see [`Loaded::item_span`].
pub fn item_span(text: &str, path: &[&str]) -> Range<usize> {
    let root = Table::parse(text, 0).unwrap_or_default();
    let variants = match root.get("variant").map(|e| &e.node.value) {
        Some(Value::Table(variants)) => variants.entries(),
        _ => &[],
    };
    let tables = variants.iter().filter_map(|e| match &e.node.value {
        Value::Table(table) => Some(table),
        _ => None,
    });
    std::iter::once(&root).chain(tables).find_map(|table| find_item_span(table, path)).unwrap_or(0..0)
}

fn find_item_span(table: &Table, path: &[&str]) -> Option<Range<usize>> {
    let (first, rest) = path.split_first()?;
    let entry = table.get(first)?;
    match (rest, &entry.node.value) {
        ([], _) => Some(entry.key_span.clone()),
        (_, Value::Table(inner)) => find_item_span(inner, rest),
        _ => None,
    }
}

/// Read a model, apply its variant and `--set` overrides, and validate it; `name` is the file name in
/// messages.
///
/// # Errors
/// All problems of the file at once, each with its location.
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
/// let model = rotordyn_model::load("pin.toml", text, &Default::default()).unwrap().model;
/// assert_eq!(model.shaft.len(), 8);
/// ```
pub fn load(name: &str, text: impl AsRef<[u8]>, options: &Options) -> Result<Loaded, ModelErrors> {
    load_with(name, text, options, &[])
}

/// [`load`] with the external data files that the model refers to (see [`external_files`]).
///
/// # Errors
/// As [`load`]; a missing data file or unsuitable columns in it.
pub fn load_with(
    name: &str,
    text: impl AsRef<[u8]>,
    options: &Options,
    files: &[ExternalFile],
) -> Result<Loaded, ModelErrors> {
    let Document { root, sources, log, text } = Document::read(name, text.as_ref(), options)?;
    let model = build::build_model(&root, files, &log);
    if log.error_count() == 0 {
        parameter_range::check(&root, files, &model, &log);
        build::check_unused(&root, &text, &log);
    }
    let defaults = log.defaults();
    let (sources, [warnings, hints, conflicts]) = sources_and_notes(sources, log)?;
    Ok(Loaded { model, warnings, hints, conflicts, given: given_values(&root), defaults, sources, text })
}

/// The ball bearings of a machine file or of a bearing-only file.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadedBearings {
    /// Name and title of the file's `[model]`.
    pub name: String,
    pub title: String,
    /// Ball bearings with their names, in file order; never empty.
    pub bearings: Vec<(String, BallBearing)>,
    /// Those of them whose balls and cage are free bodies.
    pub free_balls: Vec<(String, FreeBallBearing)>,
    pub studies: Studies,
    /// The machine; `None` for a bearing-only file.
    pub model: Option<Model>,
    pub warnings: Vec<Diagnostic>,
    /// Former spellings of renamed keys and keywords.
    pub hints: Vec<Diagnostic>,
    /// Texts that the spans of warnings and hints refer to: the file, then every `--set`.
    pub sources: Vec<Source>,
    /// Text of the file.
    pub text: String,
}

/// [`load`] for the ball bearings of a machine file or of a bearing-only file.
///
/// A bearing-only file has `[model]`, `[material.X]`, `[lubricant.X]`, `[bearing.X]` without station and
/// housing, and `[study.bearing]`; a file with `[shaft]`, `[rotor]` or `[station]` is read as a machine.
///
/// # Errors
/// All problems of the file at once, each with its location; a file without ball bearings.
///
/// ```
/// let text = r#"
///     [model]
///     name = "spindle_bearing"
///     [bearing.front]
///     model = "ball"
///     designation = "7205C"
///     thrust = "+z"
/// "#;
/// let file = rotordyn_model::load_bearings("spindle.toml", text, &Default::default()).unwrap();
/// assert_eq!(file.bearings[0].1.geometry.balls, 13);
/// ```
pub fn load_bearings(
    name: &str,
    text: impl AsRef<[u8]>,
    options: &Options,
) -> Result<LoadedBearings, ModelErrors> {
    load_bearings_with(name, text, options, &[])
}

/// [`load_bearings`] with the external data files that a machine refers to.
///
/// # Errors
/// As [`load_bearings`] and [`load_with`].
pub fn load_bearings_with(
    name: &str,
    text: impl AsRef<[u8]>,
    options: &Options,
    files: &[ExternalFile],
) -> Result<LoadedBearings, ModelErrors> {
    let Document { root, sources, log, text } = Document::read(name, text.as_ref(), options)?;
    let is_machine = ["shaft", "rotor", "station"].iter().any(|key| root.get(key).is_some());
    let (sites, name, title, studies, model);
    if is_machine {
        let machine = build::build_model(&root, files, &log);
        sites = machine.bearings.iter().map(|b| (b.name.clone(), b.bearing.clone())).collect();
        (name, title, studies) = (machine.name.clone(), machine.title.clone(), machine.studies.clone());
        model = Some(machine);
    } else {
        (name, title, sites, studies) = build::build_bearings(&root, &log);
        model = None;
    }
    let sites: Vec<(String, Bearing)> = sites;
    let other = sites.iter().map(|(_, bearing)| bearing).find(|bearing| bearing.cage().is_some());
    let ball = |(name, bearing): &(String, Bearing)| Some((name.clone(), bearing.static_balls()?.clone()));
    let bearings: Vec<_> = sites.iter().filter_map(ball).collect();
    let free = |(name, bearing): &(String, Bearing)| Some((name.clone(), bearing.free_balls()?.clone()));
    let free_balls = sites.iter().filter_map(free).collect();
    if bearings.is_empty() && log.error_count() == 0 {
        let problem = Problem::new(Kind::MissingKey, &(0..0), "the file has no ball bearing");
        log.error(match other {
            Some(other) => problem.expected("a bearing of model = \"ball\"").hint(format!(
                "a {} bearing needs a machine model: study.static gives its loads",
                other.keyword()
            )),
            None => problem.hint("add [bearing.NAME] with model = \"ball\" and designation or geometry"),
        });
    }
    let (sources, [warnings, hints, _]) = sources_and_notes(sources, log)?;
    Ok(LoadedBearings { name, title, bearings, free_balls, studies, model, warnings, hints, sources, text })
}

/// Parsed file with its overrides applied, not yet validated.
pub(super) struct Document {
    pub(super) root: Table,
    sources: Sources,
    log: Log,
    text: String,
}

impl Document {
    pub(super) fn read(name: &str, bytes: &[u8], options: &Options) -> Result<Self, ModelErrors> {
        let mut sources = Sources::default();
        let log = Log::default();
        let text = match std::str::from_utf8(bytes) {
            Ok(text) => text,
            Err(error) => {
                let at = error.valid_up_to();
                sources.push(name, String::from_utf8_lossy(bytes));
                let problem = Problem::new(
                    Kind::Syntax,
                    &(at..at + '\u{fffd}'.len_utf8()),
                    format!("not valid UTF-8 at byte {at}"),
                );
                log.error(problem.hint("a model file is TOML, saved as UTF-8"));
                return Err(model_errors(sources, log));
            }
        };
        // skip a UTF-8 byte order mark (BOM)
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        sources.push(name, text);
        if text.trim().is_empty() {
            let problem = Problem::new(Kind::Syntax, &(0..0), "the file is empty");
            log.error(problem.hint("start from one of models/*.toml"));
            return Err(model_errors(sources, log));
        }
        let mut root = match Table::parse(text, 0) {
            Ok(root) => root,
            Err(error) => {
                let span = error.span().unwrap_or(0..0);
                let message = error.message().lines().next().unwrap_or("not TOML").to_string();
                let problem = Problem::new(Kind::Syntax, &span, format!("not TOML: {message}"));
                if let Some(number) = decimal_comma(text, span.start) {
                    let hint = format!("the decimal sign is a point: {number}");
                    log.error(problem.hint(hint));
                    return Err(model_errors(sources, log));
                }
                log.error(problem.hint(match message.as_str() {
                    "duplicate key" => {
                        "a key can be defined only once; to change it in a variant use [variant.NAME]"
                    }
                    _ => "TOML is described at https://toml.io",
                }));
                return Err(model_errors(sources, log));
            }
        };
        log.set_file_end(text.len());
        renamed::translate(&mut root, &log);
        apply_variant(&mut root, options.variant.as_deref(), &log);
        for (path, value) in &options.set {
            apply_set(&mut root, [path, value], is_text(path), &mut sources, &log);
        }
        if log.error_count() > 0 {
            return Err(model_errors(sources, log));
        }
        Ok(Self { root, sources, log, text: text.to_string() })
    }
}

/// Whether the key of a path, in each of its forms, is a text.
fn is_text(path: &str) -> bool {
    let found = keys::find(path);
    found.is_ok_and(|found| !found.keys.is_empty() && found.keys.iter().all(|key| key.kind == KindName::Text))
}

/// The number of an assignment `x = 0,3` whose comma is before or at a place in the text, with a point.
fn decimal_comma(text: &str, at: usize) -> Option<String> {
    let line_start = text.get(..at)?.rfind('\n').map_or(0, |end| end + 1);
    let line = text[line_start..].lines().next()?;
    let mut commas = line.match_indices(',').map(|(place, _)| place);
    let is_digit = |c: char| c.is_ascii_digit();
    commas.rfind(|place| line_start + place <= at).and_then(|place| {
        let (before, after) = (&line[..place], &line[place + 1..]);
        let whole = &before[before.trim_end_matches(is_digit).len()..];
        let decimals = &after[..after.len() - after.trim_start_matches(is_digit).len()];
        let head = &before[..before.len() - whole.len()];
        let sign = if head.ends_with('-') { "-" } else { "" };
        let assignment = head[..head.len() - sign.len()].trim_end();
        let is_number = !whole.is_empty() && !decimals.is_empty() && assignment.ends_with('=');
        is_number.then(|| format!("{sign}{whole}.{decimals}"))
    })
}

/// Sources, warnings and hints of a file without errors, otherwise its errors.
fn sources_and_notes(sources: Sources, log: Log) -> Result<(Vec<Source>, [Vec<Diagnostic>; 3]), ModelErrors> {
    if log.error_count() > 0 {
        return Err(model_errors(sources, log));
    }
    let located = log.into_notes().map(|found| sources.locate(found));
    Ok((sources.into_vec(), located))
}

fn model_errors(sources: Sources, log: Log) -> ModelErrors {
    let diagnostics = sources.locate(log.into_errors());
    ModelErrors { sources: sources.into_vec(), diagnostics }
}

/// Paths of the external data files that a model refers to, as written in it; empty if it cannot be parsed.
///
/// The caller reads them, relative to the model file, and passes them to [`load_with`].
pub fn external_files(text: impl AsRef<[u8]>, options: &Options) -> Vec<String> {
    let Ok(document) = Document::read("", text.as_ref(), options) else { return Vec::new() };
    let speed = document.root.get("speed").map(|e| &e.node.value);
    match speed {
        Some(Value::Table(speed)) => match speed.get("file").map(|e| &e.node.value) {
            Some(Value::Text(path)) => vec![path.clone()],
            _ => Vec::new(),
        },
        _ => Vec::new(),
    }
}

/// Whether a model file states bearings alone: none of its tables is one of a machine, and no bearing has a station.
pub fn has_bearings_only(text: impl AsRef<[u8]>, options: &Options) -> bool {
    let Ok(document) = Document::read("", text.as_ref(), options) else { return false };
    let Some(Value::Table(bearings)) = document.root.get("bearing").map(|e| &e.node.value) else {
        return false;
    };
    let is_placed =
        |entry: &Entry| matches!(&entry.node.value, Value::Table(t) if t.get("station").is_some());
    let is_of_bearings = |key: &str| {
        ["$schema", "model", "material", "lubricant", "bearing", "study", "variant"].contains(&key)
    };
    document.root.keys().all(is_of_bearings) && !bearings.entries().iter().any(is_placed)
}

/// Names of the variants of a model file, in file order; empty if it is not valid TOML.
pub fn variants(text: &str) -> Vec<String> {
    let root = Table::parse(text, 0).unwrap_or_default();
    match root.get("variant").map(|e| &e.node.value) {
        Some(Value::Table(variants)) => variants.keys().map(String::from).collect(),
        _ => Vec::new(),
    }
}

//! Results file of a folder: new, or extended if it belongs to the same model.

use std::path::{Path, PathBuf};

use rotordyn::io::hdf5::{Attribute, COMPLETE, Reader, open_reader};
use rotordyn::io::results_file::{
    self, PREVIOUS, Provenance, ResultsWriter, UNFINISHED_PREVIOUS, newest_results,
};
use rotordyn::model::{Loaded, Options};
use rotordyn::warning::Code;

use super::failure::Failure;
use super::limits::limits;
use super::machine::ModelSource;
use super::previous_files::{self, EarlierFiles};
use super::terminal::Terminal;

pub use rotordyn::io::results_file::{FINISHED as FILE, UNFINISHED};

/// Title of a model and where its data come from, stored in a results file.
#[derive(Clone)]
pub struct ModelText<'a> {
    pub title: &'a str,
    /// Bearings with estimated internal geometry, "name: how" a line.
    pub estimated: String,
    /// Source of a measured speed that drives the model.
    pub measured_speed: Option<String>,
}

/// One line "name: how" for every bearing with estimated internal geometry.
pub fn estimated_lines<'b>(bearings: impl Iterator<Item = (&'b str, &'b str)>) -> String {
    bearings.map(|(name, how)| format!("{name}: {how}")).collect::<Vec<_>>().join("\n")
}

impl<'a> From<&'a Loaded> for ModelText<'a> {
    fn from(loaded: &'a Loaded) -> Self {
        let estimated = estimated_lines(loaded.model.estimated_geometries());
        Self { title: &loaded.model.title, estimated, measured_speed: None }
    }
}

/// Results of a command on their way to a folder, and the files of earlier results that they replace.
#[derive(Debug)]
pub struct Output {
    pub writer: ResultsWriter,
    pub earlier: EarlierFiles,
}

/// The results file of a folder: extended if it belongs to the same model and schema, otherwise replaced when the
/// command ends; one of another version of the model is then kept as results_previous.h5.
pub fn open(
    folder: &Path,
    text: ModelText,
    origin: &ModelSource,
    overwrite: bool,
    terminal: &Terminal,
) -> Result<Output, Failure> {
    let path = folder.join(FILE);
    let provenance = Provenance {
        title: text.title.into(),
        estimated_geometry: text.estimated,
        measured_speed: text.measured_speed,
        ..provenance(origin)
    };
    if !path.exists() {
        note_unfinished(folder, terminal);
        let writer = ResultsWriter::create(&path, provenance, false);
        return Ok(Output { writer, earlier: EarlierFiles::default() });
    }
    if overwrite {
        note_unfinished(folder, terminal);
        // A damaged file is replaced as well; it lists no files.
        let earlier = previous_files::of(&path).unwrap_or_default();
        return Ok(Output { writer: ResultsWriter::create(&path, provenance, false), earlier });
    }
    // Whatever the file is, reading it comes first, in a process of its own.
    let stored = open_reader(&path, limits())?;
    let same = is_of(&*stored, origin);
    let identity = results_file::stored_identity(&*stored)?;
    let current = results_file::schema(&*stored).is_ok_and(|schema| schema == results_file::SCHEMA);
    let reason = match (same, current, identity) {
        (false, ..) => "belongs to another version of the model",
        (true, false, _) => "has another schema",
        (true, true, Some(stored)) if stored != provenance.identity() => {
            "belongs to other side files or another version of the program"
        }
        (true, true, _) => {
            drop(stored);
            let writer = ResultsWriter::extend(&path, provenance);
            return Ok(Output { writer, earlier: EarlierFiles::default() });
        }
    };
    drop(stored);
    let previous = folder.join(PREVIOUS);
    terminal.print(&format!("{} {reason}: renamed to {}", path.display(), previous.display()));
    let earlier = previous_files::of(&path)?;
    Ok(Output { writer: ResultsWriter::create(&path, provenance, true), earlier })
}

/// The results of a stored run, to which others are added.
pub fn extend(path: &Path, origin: &ModelSource) -> Result<Output, Failure> {
    let writer = ResultsWriter::extend(path, provenance(origin));
    Ok(Output { writer, earlier: EarlierFiles::default() })
}

/// Whether stored results are those of a model with its settings.
pub fn is_of(stored: &dyn Reader, origin: &ModelSource) -> bool {
    stored_origin(stored).is_ok_and(|other| other.text == origin.text && other.options == origin.options)
}

/// What the results of a model follow from.
fn provenance(origin: &ModelSource) -> Provenance {
    let set = origin.options.set.iter();
    Provenance {
        model: String::from_utf8_lossy(&origin.text).into_owned(),
        variant: origin.options.variant.clone().unwrap_or_default(),
        settings: set.map(|(path, value)| format!("{path} = {value}")).collect(),
        files: origin.side_files(&origin.options),
        ..Provenance::default()
    }
}

/// Says what happens to the results that a killed command left.
fn note_unfinished(folder: &Path, terminal: &Terminal) {
    let unfinished = folder.join(UNFINISHED);
    if unfinished.exists() {
        terminal.note(&format!(
            "{} is of a command that did not end; it is kept as {UNFINISHED_PREVIOUS} when this one saves its first results",
            unfinished.display()
        ));
    }
}

/// The results file of a folder, or the file itself; says so if it is unfinished.
pub fn find(path: &Path, terminal: &Terminal) -> PathBuf {
    if !path.is_dir() {
        return path.into();
    }
    let found = newest_results(path);
    if found.ends_with(UNFINISHED) {
        let finished = if path.join(FILE).exists() { ", which is older" } else { ", which does not exist" };
        terminal.note(&format!("reading {} instead of {FILE}{finished}", found.display()));
    }
    found
}

/// Warns if the results of a file did not come to their end.
pub fn warn_if_incomplete(store: &dyn Reader, terminal: &Terminal) -> Result<(), Failure> {
    let state = results_file::results_state(store)?;
    if state != COMPLETE {
        let text = format!("the stored run is incomplete: {state} ({})", store.path().display());
        terminal.warn_of(Code::IncompleteRun, text);
    }
    Ok(())
}

/// Model text, variant and settings stored in a results file.
pub fn stored_origin(store: &dyn Reader) -> Result<ModelSource, Failure> {
    let text = |name: &str| match store.attribute("/meta", name) {
        Ok(Some(Attribute::Text(text))) => Ok(text),
        _ => Err(Failure::Input(format!("{} contains no rotordyn run", store.path().display()))),
    };
    let setting = |line: &str| line.split_once(" = ").map(|(path, value)| (path.into(), value.into()));
    let variant = Some(text("variant")?).filter(|name| !name.is_empty());
    let set = text("settings")?.lines().filter_map(setting).collect();
    Ok(ModelSource {
        name: format!("{} /meta model", store.path().display()),
        text: text("model")?.into_bytes(),
        options: Options { variant, set },
        folder: store.path().parent().map(Path::to_path_buf).unwrap_or_default(),
        files: Some(results_file::read_external_files(store)?),
    })
}

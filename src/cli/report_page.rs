//! `report`: the page of a run's results, also written by `run`.

use std::path::{Path, PathBuf};

use rotordyn::error::Error;
use rotordyn::io::budget;
use rotordyn::io::hdf5::open_reader;
use rotordyn::io::results_file::stored_files;
use rotordyn::model::{DefaultValue, GivenValue, Loaded};
use rotordyn::report_page::{self, Report, ReportError};
use rotordyn::study::Machine;
use serde_json::{Value, json};

use super::args::ReportArgs;
use super::failure::Failure;
use super::folder_lock::FolderLock;
use super::limits::limits;
use super::store::{self, stored_origin};
use super::terminal::Terminal;

/// Name of the page in a results folder.
pub const FILE: &str = "report.html";

/// Values of a model as its file gives them and as taken by default.
#[derive(Clone, Debug, Default)]
pub struct ModelValues {
    pub given: Vec<GivenValue>,
    pub defaults: Vec<DefaultValue>,
}

impl From<&Loaded> for ModelValues {
    fn from(loaded: &Loaded) -> Self {
        Self { given: loaded.given.clone(), defaults: loaded.defaults.clone() }
    }
}

impl From<ReportError> for Failure {
    fn from(error: ReportError) -> Self {
        match error {
            ReportError::File(error) => error.into(),
            ReportError::Data(error) => Self::environment("write", Path::new(FILE), error),
        }
    }
}

/// Writes the page of stored results.
pub fn run(args: &ReportArgs, terminal: &Terminal) -> Result<Value, Failure> {
    let results = store::find(&args.file, terminal);
    let folder = results.parent().map(PathBuf::from).unwrap_or_default();
    let out = args.out.clone().unwrap_or_else(|| folder.join(FILE));
    let stored = open_reader(&results, limits())?;
    let origin = stored_origin(&*stored)?;
    store::warn_if_incomplete(&*stored, terminal)?;
    drop(stored);
    let _lock = FolderLock::take(&folder, terminal)?;
    let mut notes = Vec::new();
    // The model of an older version, or of bearings alone, need not be a machine of this one.
    let machine = origin.load(&[]).and_then(|loaded| {
        let values = ModelValues::from(&loaded);
        Ok((Machine::new(loaded.model)?, values))
    });
    let (machine, values) = match machine {
        Ok((machine, values)) => (Some(machine), values),
        Err(failure) => {
            let reason = failure.message();
            notes.push(format!(
                "The machine is not drawn, since its model is not read by this version: {reason}"
            ));
            terminal.note(&notes[0]);
            (None, ModelValues::default())
        }
    };
    write(&results, &out, machine.as_ref(), &values, notes)?;
    terminal.print(&format!("written: {}", out.display()));
    Ok(json!({ "command": "report", "files": [out] }))
}

/// Writes the page of a results file, with the figures beside it that it lists.
pub fn write(
    results: &Path,
    out: &Path,
    machine: Option<&Machine>,
    values: &ModelValues,
    notes: Vec<String>,
) -> Result<(), Failure> {
    let reader = open_reader(results, limits())?;
    let folder = results.parent().unwrap_or(Path::new(""));
    let figures = drawn_figures(&stored_files(&*reader)?, folder)?;
    let page = Report {
        reader: &*reader,
        machine,
        given: &values.given,
        defaults: &values.defaults,
        figures: &figures,
        notes,
    };
    report_page::write(out, &page)?;
    Ok(())
}

/// The figures that the page shows as they are drawn: names and SVG documents.
fn drawn_figures(files: &[String], folder: &Path) -> Result<Vec<(String, String)>, Error> {
    let names = files.iter().filter_map(|file| file.strip_suffix(".svg"));
    // A name from a file is no path.
    let plain = |name: &&str| !name.contains(['/', '\\']);
    let shown = names.filter(plain).filter(|name| report_page::caption(name).is_some());
    let mut out = Vec::new();
    for name in shown {
        let path = folder.join(format!("{name}.svg"));
        if path.is_file() {
            let (bytes, _) = budget::read_file(&path, limits())?;
            out.push((name.to_string(), String::from_utf8_lossy(&bytes).into_owned()));
        }
    }
    Ok(out)
}

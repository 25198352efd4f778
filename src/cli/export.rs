//! `export`: geometry as glTF, mode shapes as VTK, time histories, modes and FRFs for measurement programs.

use std::path::{Path, PathBuf};

use rotordyn::edge::export::{export_geometry, export_modes};
use rotordyn::edge::hdf5::Store;
use rotordyn::edge::{exchange, measured, results_file};
use rotordyn::error::Error;
use rotordyn::results::Results;
use rotordyn::signal::record::{Measured, RecordError};
use rotordyn::study::Machine;
use serde_json::{Value, json};

use super::args::{ChannelFormat, ExportArgs};
use super::failure::Failure;
use super::machine::Origin;
use super::terminal::Terminal;
use super::{films, settings, store, written};

pub fn run(args: &ExportArgs, terminal: &Terminal) -> Result<Value, Failure> {
    let origin = Origin::read(&args.study.model)?;
    let base = origin.load(&[])?;
    let mut loaded = origin.load(&settings::modal(&base.model, None, None).set)?;
    let folder = origin.folder(args.study.out.as_ref(), &loaded.model.name);
    films::of_machine(&mut loaded.model, &folder, terminal)?;
    let machine = Machine::new(loaded.model)?;
    let mut files = export_geometry(&machine, &folder)?;
    let modal = machine.model.studies.modal.as_ref().map(|s| machine.modal(s)).transpose()?;
    let results = Results { modal: modal.unwrap_or_default(), ..Results::default() };
    files.extend(export_modes(&results, &machine, &folder)?);
    if args.formats.contains(&ChannelFormat::Uff) {
        let mut write = |name: &str, content: &Measured| {
            let path = folder.join(name);
            files.push(path.clone());
            measured::write(&path, content)
        };
        write("modes.uff", &exchange::modes(&results.modal, &machine))?;
        if let Some(study) = &machine.model.studies.frf {
            write("frf.uff", &exchange::frf(&machine.frf(study)?, &machine))?;
        }
    }
    let stored = folder.join(store::FILE);
    if stored.exists() {
        let file = Store::open(&stored)?;
        if file.contains("/time/t") {
            let history = results_file::read_history(&file)?;
            let run = exchange::run(&history, &machine.model);
            for format in &args.formats {
                files.extend(channels(&run, *format, args.number, &folder)?);
            }
        }
    }
    written(terminal, &folder, &files);
    Ok(json!({ "command": "export", "files": files }))
}

/// Writes the channels of a run in one format; WAV has one file per channel.
fn channels(
    run: &Measured,
    format: ChannelFormat,
    number: u32,
    folder: &Path,
) -> Result<Vec<PathBuf>, Error> {
    let named = |extension: &str| folder.join(format!("channels.{extension}"));
    let (path, content) = match format {
        ChannelFormat::Csv => (named("csv"), run.clone()),
        ChannelFormat::Uff => (named("uff"), run.clone()),
        ChannelFormat::Npz => (named("npz"), run.clone()),
        ChannelFormat::Mat => (named("mat"), exchange::numbered(run, number)),
        ChannelFormat::Wav => {
            let audible: Vec<_> = run.records.iter().filter(|r| exchange::is_audible(r)).collect();
            if audible.is_empty() {
                return Err(RecordError::NoChannel { name: "vibration".into(), known: "none".into() }.into());
            }
            let mut files = Vec::new();
            for record in audible {
                let path = folder.join(format!("{}.wav", record.name));
                let one = Measured { records: vec![record.clone()], ..Measured::default() };
                measured::write(&path, &one)?;
                files.push(path);
            }
            return Ok(files);
        }
    };
    measured::write(&path, &content)?;
    Ok(vec![path])
}

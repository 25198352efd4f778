//! `export`: geometry as glTF, mode shapes as VTK, time histories, modes and FRFs for measurement programs.

use rotordyn::io::export_3d::{export_geometry, export_mode_motion, export_modes, export_motion};
use rotordyn::io::hdf5::open_reader;
use rotordyn::io::run_export::Options;
use rotordyn::io::{machine_records, measured, results_file};
use rotordyn::results::Results;
use rotordyn::signal::record::MeasuredData;
use rotordyn::study::Machine;
use serde_json::{Value, json};
use std::f64::consts::TAU;

use super::args::ExportArgs;
use super::csv_files::write_csv;
use super::failure::Failure;
use super::folder_lock::FolderLock;
use super::limits::limits;
use super::machine::ModelSource;
use super::terminal::Terminal;
use super::{ehl_films, print_written_files, settings, store};

pub fn run(args: &ExportArgs, terminal: &Terminal) -> Result<Value, Failure> {
    let origin = ModelSource::read(&args.study.model)?;
    let base = origin.load(&[])?;
    let mut loaded = origin.load(&settings::modal(&base.model, None, None).set)?;
    let folder = origin.results_folder(args.study.out.as_ref(), &loaded.model.name);
    let _lock = FolderLock::take(&folder, terminal)?;
    ehl_films::prepare_machine_films(&mut loaded.model, &folder, terminal)?;
    let machine = Machine::new(loaded.model)?;
    let mut files = export_geometry(&machine, &folder)?;
    let modal = machine.model.studies.modal.as_ref().map(|s| machine.modal(s)).transpose()?;
    let with_frf = args.study.csv || args.formats.iter().any(|format| format.name == "uff");
    let frf = machine.model.studies.frf.as_ref().filter(|_| with_frf).map(|s| machine.frf(s)).transpose()?;
    let results = Results { modal: modal.unwrap_or_default(), frf, ..Results::default() };
    files.extend(export_modes(&results, &machine, &folder)?);
    if let Some(frames) = args.mode_frames {
        files.extend(export_mode_motion(&results, &machine, frames.into(), &folder)?);
    }
    if args.formats.iter().any(|format| format.name == "uff") {
        let mut write = |name: &str, content: &MeasuredData| {
            let path = folder.join(name);
            files.push(path.clone());
            measured::write(&path, content)
        };
        write("modes.uff", &machine_records::mode_shapes(&results.modal, &machine))?;
        if let Some(frf) = &results.frf {
            write("frf.uff", &machine_records::frf_records(frf, &machine))?;
        }
    }
    if args.study.csv {
        files.extend(write_csv(&folder, &results.sections(&machine.assembly.dofs))?);
    }
    let stored = store::find(&folder, terminal);
    if stored.exists() {
        let file = open_reader(&stored, limits())?;
        if file.contains("/time/t")? {
            store::warn_if_incomplete(&*file, terminal)?;
            if !store::is_of(&*file, &origin) {
                terminal.note(&format!(
                    "the stored run ({}) belongs to another version of the model than the geometry, modes and FRFs beside it",
                    stored.display()
                ));
            }
            let history = results_file::read_history(&stored, limits())?;
            let run = machine_records::run_records(&history, &machine.model)?;
            let options = Options { folder: &folder, number: args.number };
            for format in &args.formats {
                files.extend(format.write(&run, &options)?);
            }
            if let Some(motion) = results_file::read_motion(&*file)? {
                // One turn a second at the highest speed of the frames.
                let fastest = history.speed.fold(0.0, |top: f64, speed| top.max(speed.abs()))?;
                let slow_motion = args.slow_motion.unwrap_or((fastest / TAU).max(1.0));
                files.extend(export_motion(&motion, &machine.model, slow_motion, &folder)?);
            }
        }
    }
    print_written_files(terminal, &folder, &files);
    Ok(json!({ "command": "export", "files": files }))
}

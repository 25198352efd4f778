//! `export`: the machine for viewers, its modes for ParaView, a stored run-up as CSV.

use rotordyn::edge::csv::{self, Column};
use rotordyn::edge::export::{export_geometry, export_modes};
use rotordyn::edge::hdf5::Store;
use rotordyn::edge::results_file;
use rotordyn::results::Results;
use rotordyn::study::Machine;
use serde_json::{Value, json};

use super::args::StudyArgs;
use super::failure::Failure;
use super::machine::Origin;
use super::terminal::Terminal;
use super::{settings, store, written};

pub fn run(args: &StudyArgs, terminal: &Terminal) -> Result<Value, Failure> {
    let origin = Origin::read(&args.model)?;
    let base = origin.load(&[])?;
    let loaded = origin.load(&settings::modal(&base.model, None, None).set)?;
    let machine = Machine::new(loaded.model)?;
    let folder = origin.folder(args.out.as_ref(), &machine.model.name);
    let mut files = export_geometry(&machine, &folder)?;
    let modal = machine.model.studies.modal.as_ref().map(|s| machine.modal(s)).transpose()?;
    let results = Results { modal: modal.unwrap_or_default(), ..Results::default() };
    files.extend(export_modes(&results, &machine, &folder)?);
    let stored = folder.join(store::FILE);
    if stored.exists() {
        let file = Store::open(&stored)?;
        if file.contains("/time/t") {
            let history = results_file::read_history(&file)?;
            let columns: Vec<Column> = history
                .channels
                .iter()
                .map(|c| Column { name: &c.name, unit: &c.unit, values: &c.values })
                .collect();
            let path = folder.join("channels.csv");
            csv::write_series(&path, history.sample_rate, 0.0, &columns)?;
            files.push(path);
        }
    }
    written(terminal, &folder, &files);
    Ok(json!({ "command": "export", "files": files }))
}

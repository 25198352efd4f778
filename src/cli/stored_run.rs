//! `spectrogram` and `orders`: analyses of a stored run-up.

use std::path::PathBuf;

use rotordyn::io::hdf5::{Attribute, Store};
use rotordyn::io::results_file;
use rotordyn::study::Machine;
use rotordyn::warning::Code;

use super::args::StoredArgs;
use super::failure::Failure;
use super::store::{self, stored_origin};
use super::studies::{Job, Study};
use super::terminal::Terminal;
use super::{Outcome, ehl_films, finish, settings, tables};

pub fn run(args: &StoredArgs, terminal: &Terminal, study: Study) -> Result<Outcome, Failure> {
    let path = if args.file.is_dir() { args.file.join(store::FILE) } else { args.file.clone() };
    let stored = Store::open(&path)?;
    let origin = stored_origin(&stored)?;
    if !stored.contains("/time/t") {
        let message = format!("{} contains no run-up; compute one with `rotordyn run-up`", path.display());
        return Err(Failure::Input(message));
    }
    let history = results_file::read_history(&stored)?;
    let end = stored.attribute("/time", "run_state")?;
    drop(stored);

    let base = origin.load(&[])?;
    let settings = match study {
        Study::Orders => settings::orders(&base.model, args),
        _ => settings::spectrogram(&base.model, args),
    };
    let mut loaded = origin.load_with(&settings)?;
    if let Some(note) = &settings.note {
        terminal.print(note);
    }
    let folder = path.parent().map(PathBuf::from).unwrap_or_default();
    ehl_films::prepare_machine_films(&mut loaded.model, &folder, terminal)?;
    let machine = Machine::new(loaded.model.clone())?;
    let mut job = Job::new(terminal, machine, folder, Store::append(&path)?);
    let start = std::time::Instant::now();
    let studies = &job.machine.model.studies;
    if let (Study::Orders, Some(wanted)) = (study, &studies.orders) {
        job.results.orders = job.machine.orders(wanted, &history)?;
        tables::orders(terminal, &job.results.orders);
    } else if let Some(wanted) = &studies.spectrogram {
        // The Campbell lines are drawn over the spectrogram.
        job.results.campbell = studies.campbell.as_ref().map(|c| job.machine.campbell(c)).transpose()?;
        job.results.spectrograms = job.machine.spectrograms(wanted, &history)?;
        tables::spectrograms(terminal, &job.results.spectrograms);
    }
    job.seconds.push((study.name(), start.elapsed().as_secs_f64()));
    let outcome = finish(job, &[], args.into(), study.name())?;
    if let Some(Attribute::Text(end)) = end.filter(|end| *end != Attribute::Text("complete".into())) {
        terminal.warn_of(Code::IncompleteRun, format!("the stored run is incomplete: {end}"));
    }
    Ok(outcome)
}

//! `spectrogram` and `orders`: analyses of a stored run-up.

use std::path::PathBuf;

use rotordyn::io::hdf5::open_reader;
use rotordyn::io::results_file;
use rotordyn::model::Model;
use rotordyn::study::Machine;

use super::args::{OrdersArgs, SpectrogramArgs, StoredArgs};
use super::failure::Failure;
use super::folder_lock::FolderLock;
use super::limits::limits;
use super::settings::{self, Settings};
use super::store::{self, stored_origin};
use super::studies::{Job, Study};
use super::terminal::Terminal;
use super::{Outcome, ehl_films, finish, tables};

pub fn spectrogram(args: &SpectrogramArgs, terminal: &Terminal) -> Result<Outcome, Failure> {
    run(&args.stored, terminal, Study::Spectrogram, |model| settings::spectrogram(model, args))
}

pub fn orders(args: &OrdersArgs, terminal: &Terminal) -> Result<Outcome, Failure> {
    run(&args.stored, terminal, Study::Orders, |model| settings::orders(model, args))
}

fn run(
    args: &StoredArgs,
    terminal: &Terminal,
    study: Study,
    of_flags: impl Fn(&Model) -> Settings,
) -> Result<Outcome, Failure> {
    let path = store::find(&args.file, terminal);
    let folder = path.parent().map(PathBuf::from).unwrap_or_default();
    let stored = open_reader(&path, limits())?;
    let _lock = FolderLock::take(&folder, terminal)?;
    let origin = stored_origin(&*stored)?;
    if !stored.contains("/time/t")? {
        let message = format!("{} contains no run-up; compute one with `rotordyn run-up`", path.display());
        return Err(Failure::Input(message));
    }
    let history = results_file::read_history(&path, limits())?;
    store::warn_if_incomplete(&*stored, terminal)?;
    drop(stored);

    let base = origin.load(&[])?;
    let mut settings = of_flags(&base.model);
    // The orders fit the rate that the run has, not it theirs.
    let rate = "study.run_up.sample_rate";
    if base.defaults.iter().any(|default| default.path == rate) {
        settings.set.insert(0, (rate.into(), settings::toml_string(&format!("{} Hz", history.sample_rate))));
    }
    let mut loaded = origin.load_with(&settings)?;
    if let Some(note) = &settings.note {
        terminal.print(note);
    }
    ehl_films::prepare_machine_films(&mut loaded.model, &folder, terminal)?;
    let machine = Machine::new(loaded.model.clone())?;
    let mut job = Job::new(terminal, machine, folder, store::extend(&path, &origin)?);
    let start = std::time::Instant::now();
    let studies = &job.machine.model.studies;
    if let (Study::Orders, Some(wanted)) = (study, &studies.orders) {
        job.results.orders = job.machine.orders_kept(wanted, &history, &mut |map| job.spill.keep(map))?;
        tables::orders(terminal, &job.results.orders);
    } else if let Some(wanted) = &studies.spectrogram {
        // The Campbell lines are drawn over the spectrogram.
        job.results.campbell = studies.campbell.as_ref().map(|c| job.machine.campbell(c)).transpose()?;
        job.results.spectrograms =
            job.machine.spectrograms_kept(wanted, &history, &mut |map| job.spill.keep(map))?;
        tables::spectrograms(terminal, &job.results.spectrograms)?;
    }
    job.seconds.push((study.name(), start.elapsed().as_secs_f64()));
    finish(job, &[], args.into(), study.name())
}

//! `frf --noise`: FRFs with simulated measurement noise, as estimated in an impact test.

use rotordyn::io::{machine_records, measured};
use rotordyn::model::Model;
use rotordyn::signal::record::MeasurementNoise;
use rotordyn::study::Machine;

use super::args::{NoiseArgs, StudyArgs};
use super::ehl_films;
use super::failure::Failure;
use super::machine::ModelSource;
use super::settings::Settings;
use super::terminal::{Terminal, counted};

/// Largest number of averages: more take away only noise that no longer matters.
const MAX_AVERAGES: usize = 1_000_000;

/// Refuses a number of averages that cannot be meant, before the FRFs are computed.
///
/// # Errors
/// More than [`MAX_AVERAGES`].
pub fn check(test: &NoiseArgs) -> Result<(), Failure> {
    if test.averages > MAX_AVERAGES {
        return Err(Failure::Input(format!("--averages {} is above {MAX_AVERAGES}", test.averages)));
    }
    Ok(())
}

/// Writes frf_noisy.uff with FRFs and coherence, if a signal-to-noise ratio is given.
pub fn run(
    study: &StudyArgs,
    test: &NoiseArgs,
    settings: &dyn Fn(&Model) -> Settings,
    terminal: &Terminal,
) -> Result<(), Failure> {
    let Some(text) = &test.noise else { return Ok(()) };
    let level = text.trim().strip_suffix("dB").and_then(|level| level.trim().parse::<f64>().ok());
    let Some(signal_to_noise_db) = level else {
        return Err(Failure::Input(format!("--noise \"{text}\" is not a level in dB; write \"40 dB\"")));
    };
    let origin = ModelSource::read(&study.model)?;
    let base = origin.load(&[])?;
    let mut loaded = origin.load_with(&settings(&base.model))?;
    let folder = origin.results_folder(study.out.as_ref(), &loaded.model.name);
    ehl_films::prepare_machine_films(&mut loaded.model, &folder, terminal)?;
    let machine = Machine::new(loaded.model)?;
    let Some(study) = machine.model.studies.frf.clone() else { return Ok(()) };
    let exact = machine_records::frf_records(&machine.frf(&study)?, &machine);
    let noisy = MeasurementNoise { signal_to_noise_db, averages: test.averages, seed: test.seed };
    let path = folder.join("frf_noisy.uff");
    measured::write(&path, &machine_records::with_measurement_noise(&exact, &noisy)?)?;
    let averages = counted(test.averages, "average", "averages");
    terminal.print(&format!("  {} ({averages}, seed {})", path.display(), test.seed));
    Ok(())
}

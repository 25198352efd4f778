//! `frf --noise`: FRFs with simulated measurement noise, as estimated in an impact test.

use rotordyn::edge::{exchange, measured};
use rotordyn::model::Model;
use rotordyn::signal::record::NoisyTest;
use rotordyn::study::Machine;

use super::args::{NoiseArgs, StudyArgs};
use super::failure::Failure;
use super::films;
use super::machine::Origin;
use super::settings::Settings;
use super::terminal::Terminal;

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
    let origin = Origin::read(&study.model)?;
    let base = origin.load(&[])?;
    let mut loaded = origin.load(&settings(&base.model).set)?;
    let folder = origin.folder(study.out.as_ref(), &loaded.model.name);
    films::of_machine(&mut loaded.model, &folder, terminal)?;
    let machine = Machine::new(loaded.model)?;
    let Some(study) = machine.model.studies.frf.clone() else { return Ok(()) };
    let exact = exchange::frf(&machine.frf(&study)?, &machine);
    let noisy = NoisyTest { signal_to_noise_db, averages: test.averages, seed: test.seed };
    let path = folder.join("frf_noisy.uff");
    measured::write(&path, &exchange::noisy(&exact, &noisy)?)?;
    terminal.say(&format!("  {} ({} averages, seed {})", path.display(), test.averages, test.seed));
    Ok(())
}

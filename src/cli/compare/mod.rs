//! `compare`: cases of one machine beside each other and beside a measurement.

mod cases;
mod frf_places;
mod linear;
mod output;
mod run_ups;
mod tables;

use super::Outcome;
use super::args::CompareArgs;
use super::failure::Failure;
use super::machine::ModelSource;
use super::terminal::Terminal;
use cases::cases;

pub fn run(args: &CompareArgs, terminal: &Terminal) -> Result<Outcome, Failure> {
    if !(0.0..=1.0).contains(&args.min_mac) {
        return Err(Failure::Input(format!("--min-mac {} is not between 0 and 1", args.min_mac)));
    }
    let of_run_ups = args.shaft.tacho.is_some() || args.shaft.track.is_some() || args.time.is_some();
    if of_run_ups && !(args.run_up && args.measured.is_some()) {
        let text =
            "--tacho, --track and --time belong to a measured run-up: give --run-up and --measured FILE";
        return Err(Failure::Input(text.into()));
    }
    let source = ModelSource::read(&args.study.model)?;
    let cases = cases(args, &source)?;
    match args.run_up {
        true => run_ups::run(args, &cases, terminal),
        false => linear::run(args, &cases, terminal),
    }
}

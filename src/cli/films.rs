//! EHL film tables of bearings: read from the cache, or computed with a progress bar.

use std::path::Path;

use rotordyn::bearing::{BallBearing, Bearing};
use rotordyn::edge::film_tables;
use rotordyn::model::Model;

use super::failure::Failure;
use super::terminal::Terminal;

/// Prepares the film tables of all bearings of a machine.
pub fn of_machine(model: &mut Model, folder: &Path, terminal: &Terminal) -> Result<(), Failure> {
    for site in &mut model.bearings {
        if let Bearing::Ball(ball) = &mut site.bearing {
            of_bearing(&site.name, ball, folder, terminal)?;
        }
    }
    Ok(())
}

/// Prepares the film tables of one bearing; fields of a contact that does not converge are written to
/// `folder`.
pub fn of_bearing(
    name: &str,
    bearing: &mut BallBearing,
    folder: &Path,
    terminal: &Terminal,
) -> Result<(), Failure> {
    let bar = terminal.count_bar();
    let progress = |race: &str, done: usize, total: usize| {
        bar.set_message(format!("EHL film of bearing {name}, {race} race"));
        bar.set_length(total as u64);
        bar.set_position(done as u64);
    };
    let last = folder.join(format!("film_{name}_not_converged.csv"));
    let done = film_tables::prepare(name, bearing, film_tables::cache_folder().as_deref(), &last, &progress);
    bar.finish_and_clear();
    Ok(done?)
}

//! EHL film tables of bearings: read from the cache, or computed with a progress bar.

use std::path::Path;

use rotordyn::bearing::BallBearing;
use rotordyn::io::film_table_cache;
use rotordyn::model::Model;
use rotordyn::names::file_name;

use super::failure::Failure;
use super::terminal::Terminal;

/// Prepares the film tables of all bearings of a machine.
pub fn prepare_machine_films(model: &mut Model, folder: &Path, terminal: &Terminal) -> Result<(), Failure> {
    for site in &mut model.bearings {
        if let Some(ball) = site.bearing.static_balls_mut() {
            prepare_bearing_films(&site.name, ball, folder, terminal)?;
        }
    }
    Ok(())
}

/// Prepares the film tables of one bearing; fields of a contact that does not converge are written to
/// `folder`.
pub fn prepare_bearing_films(
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
    let unconverged_csv = folder.join(format!("film_{}_not_converged.csv", file_name(name)));
    let done = film_table_cache::load_or_compute(
        name,
        bearing,
        film_table_cache::cache_folder().as_deref(),
        &unconverged_csv,
        &progress,
    );
    bar.finish_and_clear();
    Ok(done?)
}

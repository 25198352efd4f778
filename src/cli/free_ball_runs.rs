//! Ball bearings with free balls: their runs with a progress bar, and the tables of all analysed bearings.

use rotordyn::bearing::free_ball::FreeBallBearing;
use rotordyn::model::study::BearingStudy;
use rotordyn::results::BearingResult;
use rotordyn::study::free_ball::add_free_balls;

use super::interrupt::continue_unless_interrupted;
use super::terminal::Terminal;
use super::{bearing_tables, free_ball_tables};

/// Runs the free balls of the analysed bearings with a progress bar; returns whether all is done before Ctrl-C.
pub fn run(
    found: &mut [BearingResult],
    free: &[(String, FreeBallBearing)],
    study: &BearingStudy,
    terminal: &Terminal,
) -> bool {
    let bar = terminal.count_bar();
    bar.set_message("free balls");
    let complete = add_free_balls(found, free, study, &|done, all| {
        bar.set_length(all as u64);
        bar.set_position(done as u64);
        continue_unless_interrupted()
    });
    bar.finish_and_clear();
    complete
}

/// Tables of the analysed bearings.
pub fn print(terminal: &Terminal, found: &[BearingResult]) {
    for bearing in found {
        bearing_tables::bearing(terminal, bearing);
        if let Some(free) = &bearing.free_balls {
            free_ball_tables::print(terminal, free);
        }
        if let Some(map) = &bearing.skidding {
            free_ball_tables::skidding(terminal, map);
        }
    }
}

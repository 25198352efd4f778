//! Tables of a run-up with free balls beside cages that roll without slip.

use rotordyn::results::RollingCageComparison;

use super::terminal::{Terminal, number};

/// Speeds of the cages, levels of the order lines, and whether a rolling cage was good enough.
pub fn comparison(terminal: &Terminal, found: &RollingCageComparison) {
    let percent = |share: f64| number(100.0 * share, 3);
    let cages = found.cages.iter().map(|cage| {
        vec![
            cage.bearing.clone(),
            number(cage.order, 6),
            number(cage.rolling_order, 6),
            number(cage.bpfo, 6),
            number(cage.rolling_bpfo, 6),
            percent(cage.slip()),
            percent(cage.largest_slip),
            number(cage.pocket_force, 3),
            number(1e3 * cage.friction_torque, 3),
            number(cage.friction_power, 3),
        ]
    });
    let title = format!(
        "Free balls beside cages that roll without slip, {:.3} to {:.3} s, {:.1} revolutions",
        found.stretch[0], found.stretch[1], found.revolutions
    );
    let header = [
        "bearing",
        "FTF",
        "rolling",
        "BPFO",
        "rolling",
        "slip %",
        "largest %",
        "pocket N",
        "torque N mm",
        "losses W",
    ];
    terminal.table(&title, &header, &cages.collect::<Vec<_>>());
    let lines = found.lines.iter().map(|line| {
        // Of two levels within the noise the ratio says nothing.
        let above_noise = |other: f64, difference: f64| match line.free.max(other) > line.noise {
            true => percent(difference),
            false => "-".into(),
        };
        vec![
            line.channel.clone(),
            line.line.label.clone(),
            number(line.free, 4),
            number(line.rolling, 4),
            number(line.driven, 4),
            number(line.spaced, 4),
            number(line.noise, 2),
            line.unit.clone(),
            above_noise(line.rolling, line.difference()),
            above_noise(line.driven, line.difference_driven()),
            above_noise(line.spaced, line.difference_spaced()),
        ]
    });
    let header = [
        "channel",
        "line",
        "free balls",
        "rolling",
        "mean angle",
        "every ball",
        "noise",
        "unit",
        "to rolling %",
        "to mean angle %",
        "to every ball %",
    ];
    let title = "Levels of the order lines (RMS): free balls; kinematic ones in a rolling cage, at the balls' mean angle, \
                 each at its own angle";
    terminal.table(title, &header, &lines.collect::<Vec<_>>());
    terminal.print(&format!("  {}", found.conclusion()));
}

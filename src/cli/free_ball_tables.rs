//! Tables of a bearing with free balls: cage speed, comparison with the kinematic cage, heat, skidding map.

use super::terminal::{Terminal, number, rpm, table};
use rotordyn::results::{FreeBallResult, LOSS_NAMES, SkiddingMap};

pub fn print(terminal: &Terminal, found: &FreeBallResult) {
    let c = &found.comparison;
    terminal.heading(&format!(
        "Free balls and cage of bearing {} at {:.0} rpm",
        found.name,
        rpm(found.speed)
    ));
    let [x, y, z] = found.load.map(|force| number(force, 4));
    terminal.print_wrapped(&format!(
        "settled under {x}, {y}, {z} N after {} s; means over {} s, steps of {} us",
        number(found.settling_time, 3),
        number(found.duration, 3),
        number(1e6 * found.step, 3)
    ));
    let row = |name: &str, free: f64, kinematic: f64, unit: &str| {
        let deviation = format!("{:+.4} %", 100.0 * (free / kinematic - 1.0));
        vec![name.to_string(), number(free, 6), number(kinematic, 6), unit.to_string(), deviation]
    };
    let rows = [
        row("cage speed", rpm(found.cage_speed), rpm(found.speed * c.kinematic.ftf), "rpm"),
        row("FTF", c.ftf, c.kinematic.ftf, "1/revolution"),
        row("BPFO", c.bpfo, c.kinematic.bpfo, "1/revolution"),
    ];
    terminal.print(table(&["", "free", "kinematic", "", "deviation"], &rows).trim_end());
    terminal.print_wrapped(&format!(
        "{}: BPFO differs by {} Hz, limit {} Hz",
        c.assessment(),
        number(c.shift_hz, 3),
        number(c.limit_hz, 3)
    ));
    terminal.print_wrapped(&format!(
        "pocket forces up to {} N, RMS {} N; friction torque {} N m",
        number(found.pocket_peak, 3),
        number(found.pocket_rms, 3),
        number(found.friction_torque, 3)
    ));
    let sources = LOSS_NAMES.iter().zip(found.losses).filter(|(_, heat)| *heat > 0.0);
    let heat: Vec<String> =
        sources.map(|(name, heat)| format!("{} {} W", name.replace('_', " "), number(heat, 3))).collect();
    terminal.print_wrapped(&format!("heat {} W: {}", number(found.losses.iter().sum(), 3), heat.join(", ")));
    let degrees =
        |angle: f64| if angle.is_finite() { format!("{:.2}", angle.to_degrees()) } else { String::new() };
    let rows: Vec<Vec<String>> = found
        .balls
        .iter()
        .enumerate()
        .map(|(j, ball)| {
            vec![
                (j + 1).to_string(),
                number(ball.loads[0], 4),
                number(ball.loads[1], 4),
                degrees(ball.angles[0]),
                degrees(ball.angles[1]),
                degrees(ball.pitch_angle),
            ]
        })
        .collect();
    let header = [
        "ball",
        "inner load [N]",
        "outer load [N]",
        "inner angle [deg]",
        "outer angle [deg]",
        "spin axis [deg]",
    ];
    terminal.print(table(&header, &rows).trim_end());
}

/// Slip of the cage, a row for each load and a column for each speed.
pub fn skidding(terminal: &Terminal, map: &SkiddingMap) {
    let title = format!("Cage slip of bearing {} in %, over load and speed", map.name);
    let speeds: Vec<String> = map.speeds.iter().map(|speed| format!("{:.0} rpm", rpm(*speed))).collect();
    let header: Vec<&str> = std::iter::once("load [N]").chain(speeds.iter().map(String::as_str)).collect();
    let slip = |load: usize, speed: usize| match map.slip_at(load, speed) {
        slip if slip.is_finite() => number(100.0 * slip, 3),
        _ => String::new(),
    };
    let row = |(k, load): (usize, &f64)| {
        std::iter::once(number(*load, 4)).chain((0..speeds.len()).map(|j| slip(k, j))).collect()
    };
    let rows: Vec<Vec<String>> = map.loads.iter().enumerate().map(row).collect();
    terminal.table(&title, &header, &rows);
}

//! Tables of the critical speed map, of torsional modes and of the stability of a Campbell diagram.

use rotordyn::results::{CampbellResult, CriticalMap, TorsionalResult};

use super::printed;
use super::terminal::{Terminal, number, rpm};

/// Critical speeds at a few stiffnesses, and the crossings with the bearings' own.
pub fn critical_map(terminal: &Terminal, found: &CriticalMap) {
    let text = |speed: f64| if speed.is_nan() { "-".into() } else { format!("{:.1}", rpm(speed)) };
    let count = found.stiffness.len();
    // About ten rows; the curves are in results.h5.
    let step = count.div_ceil(10).max(1);
    let rows: Vec<Vec<String>> = (0..count)
        .filter(|k| k % step == 0 || k + 1 == count)
        .map(|k| {
            let speeds = found.curves.iter().map(|curve| text(curve.speeds[k]));
            std::iter::once(number(found.stiffness[k], 3)).chain(speeds).collect()
        })
        .collect();
    let header: Vec<String> = std::iter::once("stiffness N/m".to_string())
        .chain(found.curves.iter().map(|curve| format!("{} rpm", curve.label)))
        .collect();
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    let title =
        format!("Undamped critical speeds up to {:.0} rpm, over bearing stiffness", rpm(found.max_speed));
    if found.curves.is_empty() {
        terminal.heading(&format!("{title}: none"));
        terminal.print(
            "  every lateral mode lies above that speed at every stiffness of the map: raise --max-speed, or check the masses \
             of shaft and discs",
        );
        return;
    }
    terminal.table(&title, &header, &rows);
    match found.crossings.is_empty() {
        true => terminal.print("  no curve meets the bearings' own stiffness in this range"),
        false => printed::tables(terminal, &found.document()),
    }
}

/// Torsional modes and the speeds at which orders meet them.
pub fn torsional(terminal: &Terminal, found: &TorsionalResult) {
    if found.found.modes.is_empty() {
        terminal.heading("Torsional modes: none, the shaft turns as a whole");
        return;
    }
    printed::tables(terminal, &found.document());
    if found.interferences.is_empty() {
        terminal.print(&format!("  no order meets a torsional mode up to {:.0} rpm", rpm(found.max_speed)));
    }
    if found.found.rigid_rotations == 0 {
        terminal.print("  the rotation of the driven station is fixed");
    }
    if found.found.coupled {
        terminal.print(
            "  torsion is coupled with other motions of this machine, which these modes neglect; see 'modal'",
        );
    }
    if let Some([low, high]) = found.operating_speeds.map(|speeds| speeds.map(rpm)) {
        terminal.print(&format!(
            "  operating speeds {low:.0} to {high:.0} rpm; API 684 asks for a separation of 10 %"
        ));
    }
}

/// The least damped mode over the speeds of a Campbell diagram.
pub fn stability(terminal: &Terminal, found: &CampbellResult) {
    let points = found.least_damped();
    let Some(least) = points.iter().min_by(|a, b| a.log_decrement.total_cmp(&b.log_decrement)) else {
        return;
    };
    terminal.print(&format!(
        "  least damped: {} at {:.0} rpm, log decrement {:.4}",
        least.label,
        rpm(least.speed),
        least.log_decrement
    ));
}

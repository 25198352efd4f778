//! Tables of `identify` for a machine in operation: modes, harmonics, what was dropped.

use rotordyn::identify::operational::OperationalModes;

use super::identify_tables::{print_rejected, strongest, whirl_text};
use super::terminal::{Terminal, number};

/// Most harmonics in the printed table.
const MAX_HARMONICS: usize = 24;

/// Table of modes, harmonics and dropped poles.
pub fn tables(terminal: &Terminal, found: &OperationalModes) {
    let rows: Vec<Vec<String>> = found
        .modes
        .iter()
        .enumerate()
        .map(|(k, m)| {
            vec![
                (k + 1).to_string(),
                format!("{:.4}", m.frequency_hz()),
                number(m.frequency_error, 2),
                format!("{:.4}", 100.0 * m.damping_ratio()),
                number(100.0 * m.damping_error, 2),
                format!("{:.3}", m.collinearity),
                found.dofs[strongest(&m.shape)].to_string(),
                whirl_text(m.whirl),
            ]
        })
        .collect();
    let title = format!(
        "Modes in operation from {} channels without force, {:.3} to {:.3} Hz, {:.1} s, state-space order {}",
        found.dofs.len(),
        found.band[0],
        found.band[1],
        found.duration,
        found.orders.last().unwrap_or(&0)
    );
    let header = ["", "damped Hz", "+-", "zeta %", "+-", "MPC", "channel", "whirl"];
    terminal.table(&title, &header, &rows);
    terminal.print(&format!(
        "  +- is one standard error from {} blocks of {:.2} s; MPC (modal phase collinearity) is 1 for a real mode.",
        found.blocks, found.block_length
    ));
    if found.left_out > 0.0 {
        terminal.print(&format!(
            "  The first {} s are left out: a transient, such as that of a start.",
            number(found.left_out, 3)
        ));
    }
    for (k, mode) in found.modes.iter().enumerate() {
        mode.notes.iter().for_each(|note| terminal.print(&format!("  {}: {note}", k + 1)));
    }
    harmonics(terminal, found);
    print_rejected(terminal, &found.dropped);
}

fn harmonics(terminal: &Terminal, found: &OperationalModes) {
    if found.harmonics.is_empty() {
        return;
    }
    let rows: Vec<Vec<String>> = found
        .harmonics
        .iter()
        .take(MAX_HARMONICS)
        .map(|h| {
            vec![
                format!("{:.4}", h.frequency),
                h.order.map_or("-".into(), |order| format!("{}x", number(order, 6))),
                format!("{:.2}", h.kurtosis),
                if h.removed { "subtracted" } else { "recognised" }.into(),
            ]
        })
        .collect();
    let title = match found.shaft_speed {
        Some(speed) => format!("Harmonics, mean speed {} rpm", number(60.0 * speed, 6)),
        None => "Harmonics (a sine has an excess kurtosis of -1.5, noise of 0)".into(),
    };
    terminal.table(&title, &["Hz", "order", "kurtosis", ""], &rows);
    if found.harmonics.len() > MAX_HARMONICS {
        terminal.print(&format!("  ... and {} more in results.h5", found.harmonics.len() - MAX_HARMONICS));
    }
}

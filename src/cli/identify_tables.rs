//! Tables of `identify`: modes with standard errors, and single-degree-of-freedom (SDOF) fits for comparison.

use rotordyn::identify::sdof::{circle_fit, half_power_fit};
use rotordyn::identify::{ModalIdentification, quantity_of};
use rotordyn::io::identified_modes::noise_only_names;
use rotordyn::signal::Complex;
use rotordyn::signal::record::FrfMatrix;

use super::terminal::{Terminal, counted, number};

/// FRFs of noise that are named.
const SHOWN: usize = 4;

/// Table of modes, dropped modes and SDOF fits.
pub fn tables(terminal: &Terminal, found: &ModalIdentification, frfs: &FrfMatrix) {
    let rows: Vec<Vec<String>> = found
        .modes
        .iter()
        .enumerate()
        .map(|(k, m)| {
            vec![
                (k + 1).to_string(),
                format!("{:.4}", m.frequency_hz()),
                number(m.frequency_error, 2),
                format!("{:.4}", m.natural_frequency_hz()),
                format!("{:.4}", 100.0 * m.damping_ratio()),
                number(100.0 * m.damping_error, 2),
                format!("{:.3}", m.collinearity),
                found.responses[strongest(&m.shape)].to_string(),
                found.references[strongest(&m.participation)].to_string(),
                whirl_text(m.whirl),
                m.quality_warnings.iter().map(|doubt| doubt.label()).collect::<Vec<_>>().join("; "),
            ]
        })
        .collect();
    let count = found.responses.len() * found.references.len();
    let title = format!(
        "Modes from {count} FRFs, {:.3} to {:.3} Hz, model order {}",
        found.frequencies[0],
        found.frequencies[found.frequencies.len() - 1],
        found.orders.last().unwrap_or(&0)
    );
    let header = [
        "",
        "damped Hz",
        "+-",
        "natural Hz",
        "zeta %",
        "+-",
        "MPC",
        "response",
        "reference",
        "whirl",
        "doubt",
    ];
    terminal.table(&title, &header, &rows);
    let noise = noise_only_names(found);
    let mut errors: Vec<f64> = found.errors.iter().flatten().copied().collect();
    if noise.len() < errors.len() {
        let columns = found.references.len();
        found.noise_only().iter().for_each(|(r, e)| errors[r * columns + e] = 0.0);
    }
    let worst = errors.iter().copied().fold(0.0, f64::max);
    let counts = match noise.len() {
        0 => "all FRFs".to_string(),
        count if count == errors.len() => {
            format!("all {count} FRFs, which are noise for more than half of their power")
        }
        count => format!(
            "the {} FRFs above noise ({count} are noise for more than half of their power: {}{})",
            errors.len() - count,
            noise[..count.min(SHOWN)].join(", "),
            if count > SHOWN { ", ..." } else { "" }
        ),
    };
    terminal.print(&format!(
        "  +- is one standard error, with the error of the model; damped Hz is Im(pole)/2pi, natural Hz |pole|/2pi.\n  MPC (modal phase collinearity) is 1 for a real mode.\n  Fit error {:.2} % over {counts}, {:.2} % for the \
         worst FRF.",
        100.0 * found.total_error,
        100.0 * worst
    ));
    let (responses, references) = (found.responses.len(), found.references.len());
    if references > responses {
        terminal.print(&format!(
            "  Roving hammer: {references} references, {}; mode shapes are over the references.",
            counted(responses, "response", "responses")
        ));
    }
    if found.bands.len() > 1 {
        let text: Vec<String> =
            found.bands.iter().map(|[from, to]| format!("{from:.1} .. {to:.1}")).collect();
        terminal.print(&format!("  Identified in {} bands by itself: {} Hz.", text.len(), text.join(", ")));
    }
    let dropped: Vec<String> = found.dropped.iter().map(ToString::to_string).collect();
    print_rejected(terminal, &dropped);
    sdof_table(terminal, found, frfs);
}

/// Index of the largest entry of a shape.
pub fn strongest(values: &[Complex<f64>]) -> usize {
    (0..values.len()).fold(0, |b, k| if values[k].norm() > values[b].norm() { k } else { b })
}

/// Direction of whirl, and how round the orbit is from 0 to 1.
pub fn whirl_text(whirl: Option<f64>) -> String {
    match whirl {
        Some(w) if w > 0.1 => format!("forward {w:.2}"),
        Some(w) if w < -0.1 => format!("backward {:.2}", -w),
        Some(_) => "straight".into(),
        None => "-".into(),
    }
}

/// Stable poles that are no modes, with the reasons.
pub fn print_rejected(terminal: &Terminal, reasons: &[String]) {
    if !reasons.is_empty() {
        terminal.print("\n  Stable poles left out of the table:");
        reasons.iter().for_each(|reason| terminal.print(&format!("    {reason}")));
    }
}

/// SDOF check of each mode: half-power peak fit and circle fit of the FRF with its largest residue.
fn sdof_table(terminal: &Terminal, found: &ModalIdentification, frfs: &FrfMatrix) {
    let rows: Vec<Vec<String>> = found
        .modes
        .iter()
        .enumerate()
        .map(|(k, m)| {
            let mut best = (0, 0);
            for r in 0..m.shape.len() {
                for e in 0..m.participation.len() {
                    let size = |(r, e): (usize, usize)| (m.shape[r] * m.participation[e]).norm();
                    if size((r, e)) > size(best) {
                        best = (r, e);
                    }
                }
            }
            let frf = &frfs.values[best.0][best.1];
            let quantity = quantity_of(&frfs.units[best.0][best.1]).unwrap_or(found.quantity);
            let (hz, zeta) = (m.frequency_hz(), m.damping_ratio());
            let step = found.frequencies[1] - found.frequencies[0];
            let around = |widths: f64| (widths * zeta * hz).max(3.0 * step);
            let band = |half: f64| [hz - half, hz + half];
            let fits = [
                half_power_fit(&frfs.frequencies, frf, band(around(4.0))),
                circle_fit(&frfs.frequencies, frf, band(around(1.5)), quantity),
            ];
            let mut row = vec![
                (k + 1).to_string(),
                format!("{}/{}", found.responses[best.0], found.references[best.1]),
                format!("{hz:.3}"),
                format!("{:.3}", 100.0 * zeta),
            ];
            for fit in fits {
                row.push(fit.map_or("-".into(), |f| format!("{:.3}", f.frequency_hz)));
                row.push(fit.map_or("-".into(), |f| format!("{:.3}", 100.0 * f.damping_ratio)));
            }
            row
        })
        .collect();
    let header = ["", "FRF", "Hz", "zeta %", "peak Hz", "zeta %", "circle Hz", "zeta %"];
    terminal.table(
        "SDOF check: peak and circle fit of the FRF with the largest residue of each mode",
        &header,
        &rows,
    );
}

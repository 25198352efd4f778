//! Measured and computed run-up: spectrogram maps and waterfalls next to each other, order cuts on common
//! axes.

use super::Named;
use super::display_unit::{quantity, unit};
use super::run::{SpectraOfRun, spectrograms};
use crate::{Curve, Figure, Grid, GridPanel};
use rotordyn_core::results::{Agreement, CampbellResult, ChannelPair, CutPair, OrderResult};
use rotordyn_core::series::SeriesError;
use rotordyn_core::study::Machine;

/// # Errors
/// Amplitudes that cannot be read.
pub fn figures(
    prefix: &str,
    pairs: &[ChannelPair],
    campbell: Option<&CampbellResult>,
    machine: &Machine,
) -> Result<Vec<Named>, SeriesError> {
    let mut figures = Vec::new();
    for pair in pairs {
        let [measured, computed] = &pair.spectrograms;
        let title = format!("Run-up, {}: measured and computed", pair.channel);
        let runs = [("measured", measured), ("computed", computed)];
        let maps =
            spectrograms(&runs.map(|(name, found)| SpectraOfRun { name, found, campbell }), &title, machine)?;
        let cuts = ("order_cuts", Figure::Grid(cuts(pair, machine)));
        let named = |(kind, figure)| (format!("{prefix}_{kind}_{}", pair.channel), figure);
        figures.extend(maps.into_iter().chain([cuts]).map(named));
    }
    Ok(figures)
}

/// Order cuts (RMS over speed), one panel per order.
fn cuts(pair: &ChannelPair, machine: &Machine) -> Grid {
    let shown = unit(&pair.unit);
    let curve = |of: &OrderResult, k: usize| Curve {
        label: String::new(),
        x: of.cuts[k].1.rpm.clone(),
        y: of.cuts[k].1.rms.iter().map(|v| v * shown.factor).collect(),
        points: false,
    };
    let panel = |(k, cut): (usize, &CutPair)| GridPanel {
        name: format!("{}, RMS", cut.line.label),
        unit: shown.name.into(),
        curves: pair.orders.iter().map(|of| curve(of, k)).collect(),
        from_zero: true,
        log_y: false,
    };
    Grid {
        title: format!(
            "Order cuts of the {}, {}: {}",
            quantity(&pair.unit),
            pair.channel,
            machine.model.title
        ),
        note: agreement_note(&pair.cuts),
        x_name: "shaft speed".into(),
        x_unit: "rpm".into(),
        legend: vec!["measured".into(), "computed".into()],
        panels: pair.cuts.iter().enumerate().map(panel).collect(),
        columns: 2,
        mark: None,
    }
}

/// "agrees: 1x, 7x; below background: 2x", within the uncertainty of the lines.
fn agreement_note(cuts: &[CutPair]) -> String {
    let mut groups: Vec<(Agreement, Vec<&str>)> = Vec::new();
    for cut in cuts {
        let finding = cut.agreement.finding;
        match groups.iter_mut().find(|(own, _)| *own == finding) {
            Some((_, labels)) => labels.push(&cut.line.label),
            None => groups.push((finding, vec![&cut.line.label])),
        }
    }
    let texts: Vec<String> =
        groups.iter().map(|(finding, labels)| format!("{}: {}", finding.name(), labels.join(", "))).collect();
    texts.join("; ")
}

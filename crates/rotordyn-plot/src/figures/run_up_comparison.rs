//! Run-ups of several cases of a machine, and a measured one: spectrogram maps and waterfalls side by side on one
//! scale, order cuts on common axes.

use super::Named;
use super::display_unit::{quantity, unit};
use super::run::{SpectraOfRun, spectrograms};
use crate::{Curve, Figure, Grid, GridPanel};
use rotordyn_core::results::{CampbellResult, CaseRun, ComparedChannel, RunUpComparison};
use rotordyn_core::series::SeriesError;
use rotordyn_core::study::Machine;

/// `campbell`: linear natural frequencies of every run in the order of the cases.
///
/// # Errors
/// Amplitudes that cannot be read.
pub fn figures(
    found: &RunUpComparison,
    campbell: &[Option<&CampbellResult>],
    machine: &Machine,
) -> Result<Vec<Named>, SeriesError> {
    let mut figures = Vec::new();
    for channel in &found.channels {
        let title = format!("Run-ups, {}", channel.channel);
        let with_spectra = channel.runs.iter().zip(campbell).filter_map(|(run, campbell)| {
            Some(SpectraOfRun { name: &run.case, found: run.spectrogram.as_ref()?, campbell: *campbell })
        });
        let maps = spectrograms(&with_spectra.collect::<Vec<_>>(), &title, machine)?;
        let labels = channel.labels();
        let cuts =
            (!labels.is_empty()).then(|| ("order_cuts", Figure::Grid(cuts(channel, &labels, machine))));
        let named = |(kind, figure)| (format!("comparison_{kind}_{}", channel.channel), figure);
        figures.extend(maps.into_iter().chain(cuts).map(named));
    }
    Ok(figures)
}

/// Order cuts (RMS over speed), one panel per order.
fn cuts(channel: &ComparedChannel, labels: &[&str], machine: &Machine) -> Grid {
    let shown = unit(&channel.unit);
    let curve = |run: &CaseRun, label: &str| {
        let points = || run.cut(label).into_iter().flat_map(|cut| &cut.points);
        Curve {
            x: points().map(|p| p.rpm).collect(),
            y: points().map(|p| p.rms * shown.factor).collect(),
            ..Curve::default()
        }
    };
    let panel = |label: &str| GridPanel {
        name: format!("{label}, RMS"),
        unit: shown.name.into(),
        curves: channel.runs.iter().map(|run| curve(run, label)).collect(),
        from_zero: true,
        log_y: false,
    };
    Grid {
        title: format!("Order cuts of the {}, {}", quantity(&channel.unit), channel.channel),
        note: machine.model.title.clone(),
        x_name: "shaft speed".into(),
        x_unit: "rpm".into(),
        legend: channel.runs.iter().map(|run| run.case.clone()).collect(),
        panels: labels.iter().copied().map(panel).collect(),
        columns: 2,
        mark: None,
    }
}

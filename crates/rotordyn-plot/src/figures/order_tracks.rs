//! Figure of orders tracked by the Vold-Kalman filter: amplitude and phase over speed, or over time at steady speed.

use crate::{Bode, BodeCurve, Curve, Figure, Lines};
use rotordyn_core::document::number;
use rotordyn_core::results::OrderLine;
use rotordyn_signal::order_tracks::OrderTracks;

/// Speed range over its mean below which the tracks are drawn over time.
const STEADY: f64 = 0.02;

/// Quantity and display unit of a channel; values in the unit are SI values times `factor`.
#[derive(Clone, Copy)]
pub(super) struct Shown<'a> {
    pub quantity: &'a str,
    pub unit: &'a str,
    pub factor: f64,
}

/// `lines` as many as tracks.
pub(super) fn order_tracks(
    found: &OrderTracks,
    lines: &[&OrderLine],
    title: &str,
    note: &str,
    shown: Shown,
) -> Figure {
    let bandwidth = format!("Vold-Kalman filter, bandwidth {} orders", number(found.bandwidth, 3));
    let note = if note.is_empty() { bandwidth } else { format!("{note}; {bandwidth}") };
    let title = title.to_string();
    let tracks = || lines.iter().zip(&found.tracks);
    let scaled = |amplitude: &[f64]| amplitude.iter().map(|v| v * shown.factor).collect();
    let quantity = format!("{}, peak", shown.quantity);
    let [low, high] = [f64::min, f64::max].map(|of| found.rpm.iter().copied().reduce(of).unwrap_or(0.0));
    if high - low <= STEADY * high {
        let curves = tracks().map(|(line, track)| Curve {
            label: line.label.clone(),
            x: found.times.clone(),
            y: scaled(&track.amplitude),
            points: false,
        });
        return Figure::Lines(Lines {
            title,
            note,
            x_name: "time".into(),
            x_unit: "s".into(),
            y_name: quantity,
            y_unit: shown.unit.into(),
            curves: curves.collect(),
            log_y: true,
            ..Lines::default()
        });
    }
    let curves = tracks().map(|(line, track)| BodeCurve {
        label: line.label.clone(),
        rpm: found.rpm.clone(),
        amplitude: scaled(&track.amplitude),
        phase_deg: track.phase.iter().map(|phase| phase.to_degrees()).collect(),
    });
    Figure::Bode(Bode {
        title,
        note,
        quantity,
        unit: shown.unit.into(),
        curves: curves.collect(),
        log: true,
        criticals: Vec::new(),
    })
}

//! Document of the amplitudes and phases of orders that the Vold-Kalman filter tracks.

use super::OrderLine;
use crate::document::{Array, Document, Rows, in_hdf5, in_json, number};
use rotordyn_signal::order_tracks::{OrderTrack, OrderTracks};

/// What is written of the tracks of a channel; `lines` as many as tracks.
pub(super) fn tracks_document<'a>(
    channel: &str,
    lines: impl IntoIterator<Item = &'a OrderLine>,
    found: &'a OrderTracks,
    unit: &str,
) -> Document<'a> {
    let rows: Vec<(&OrderLine, &OrderTrack, f64, f64)> = lines
        .into_iter()
        .zip(&found.tracks)
        .map(|(line, track)| {
            let at = highest(&track.amplitude);
            (line, track, track.amplitude[at], found.rpm[at])
        })
        .collect();
    let [tracks, times] = [rows.len(), found.times.len()];
    let all = |part: fn(&OrderTrack) -> &[f64]| -> Vec<f64> {
        found.tracks.iter().flat_map(|track| part(track).iter().copied()).collect()
    };
    let amplitude = Array::real(&[tracks, times], unit, all(|track| &track.amplitude)).over(1, "rpm");
    let phase = Array::real(&[tracks, times], "rad", all(|track| &track.phase)).over(1, "rpm");
    let table = Rows::of(&rows)
        .heading(format!(
            "Vold-Kalman order tracks of {channel}, bandwidth {} orders",
            number(found.bandwidth, 3)
        ))
        .text("label", |(line, ..)| &line.label)
        .number("order", "1/revolution", |(_, track, ..)| track.order)
        .number("highest_amplitude", unit, |(.., amplitude, _)| *amplitude)
        .number("at_rpm", "", |(.., rpm)| *rpm)
        .series("amplitude", unit, |(_, track, ..)| &track.amplitude)
        .series("phase_rad", "rad", |(_, track, ..)| &track.phase);
    Document::new()
        .number("bandwidth", "1/revolution", found.bandwidth)
        .number("min_bandwidth", "Hz", found.min_bandwidth_hz)
        .number("rms", unit, found.rms[0])
        .number("remainder_rms", unit, found.rms[1])
        .table(in_json("tracks"), table)
        .array(in_hdf5("amplitude"), amplitude)
        .array(in_hdf5("phase"), phase)
        .texts(in_hdf5("label"), rows.iter().map(|(line, ..)| &line.label))
        .numbers(
            in_hdf5("order"),
            "1/revolution",
            found.tracks.iter().map(|track| track.order).collect::<Vec<_>>(),
        )
        .numbers("rpm", "rpm", &found.rpm)
        .numbers("time", "s", &found.times)
}

/// Place of the highest value.
fn highest(values: &[f64]) -> usize {
    (0..values.len()).max_by(|&a, &b| values[a].total_cmp(&values[b])).unwrap_or(0)
}

//! Order tracking of a record.

use crate::document::{Array, Document, Rows, in_hdf5, in_json};
use crate::results::OrderLine;
use crate::results::order_tracks::tracks_document;
use rotordyn_signal::order::{OrderCut, OrderSpectrogram};
use rotordyn_signal::order_tracks::OrderTracks;
use rotordyn_signal::tacho_jitter::JitterLeak;
use serde::{Deserialize, Serialize};

/// Order tracking: map, mean order spectrum and cuts.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct ShaftOrders {
    pub map: OrderSpectrogram,
    /// Power average over all speeds.
    pub average: Vec<f64>,
    pub cuts: Vec<(OrderLine, OrderCut)>,
    /// Amplitude and phase of the cuts' orders by the Vold-Kalman filter, if asked for.
    pub tracks: Option<OrderTracks>,
    /// Tracked orders that the tacho's jitter makes of a stronger one beside them.
    pub jitter_leaks: Vec<JitterLeak>,
}

impl ShaftOrders {
    pub(super) fn document(&self, channel: &str, unit: &str) -> Document<'_> {
        let map = &self.map;
        let (windows, bins) = (map.times.len(), map.orders.len());
        let amplitude = Array::real(&[windows, bins], unit, &map.amplitude);
        let cuts = Rows::of(&self.cuts)
            .text("label", |(line, _)| &line.label)
            .number("order", "1/revolution", |(line, _)| line.order)
            .series("rpm", "rpm", |(_, cut)| &cut.rpm)
            .series("rms", unit, |(_, cut)| &cut.rms);
        Document::new()
            .table(in_json("cuts"), cuts)
            .array(in_hdf5("amplitude"), amplitude.over(0, "rpm").over(0, "time").over(1, "order"))
            .numbers(in_hdf5("rpm"), "rpm", &map.rpm)
            .numbers(in_hdf5("time"), "s", &map.times)
            .numbers(in_hdf5("order"), "1/revolution", &map.orders)
            .array(in_hdf5("average"), Array::real(&[bins], unit, &self.average).over(0, "order"))
            .and_if((!self.jitter_leaks.is_empty()).then_some(()), |out, ()| {
                let label = |track: usize| &self.cuts[track].0.label;
                let leaks = Rows::of(&self.jitter_leaks)
                    .text("label", |l| label(l.track))
                    .text("beside", |l| label(l.neighbour))
                    .number("amplitude_rms", unit, |l| l.amplitude)
                    .number("leak_rms", unit, |l| l.leak);
                out.table(in_json("tacho_jitter"), leaks)
            })
            .and_if(self.tracks.as_ref(), |out, found| {
                let lines = self.cuts.iter().map(|(line, _)| line);
                out.group("vold_kalman", tracks_document(channel, lines, found, unit))
            })
    }
}

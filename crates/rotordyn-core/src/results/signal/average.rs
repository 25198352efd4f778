//! Time-synchronous average.

use crate::document::{Array, Document, in_hdf5, in_json};
use rotordyn_signal::synchronous::SynchronousAverage;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Time synchronous average (TSA) over shaft revolutions.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ShaftAverage {
    pub average: SynchronousAverage,
    /// RMS (means removed) of the record resampled in angle, of the average, and of the residual.
    pub rms: [f64; 3],
}

impl ShaftAverage {
    pub(super) fn document(&self, unit: &str) -> Document<'_> {
        let ([record, average, residual], found) = (self.rms, &self.average);
        let count = found.mean.len();
        let angle: Vec<f64> = (0..count).map(|k| TAU * k as f64 / count as f64).collect();
        let over = |values: &'_ [f64]| Array::real(&[count], unit, values.to_vec()).over(0, "angle");
        let rms = Document::new()
            .number("record", unit, record)
            .number("synchronous_average", unit, average)
            .number("residual", unit, residual);
        Document::new()
            .integer("revolutions", found.periods)
            .group(in_json("rms"), rms)
            .array(in_hdf5("mean"), over(&found.mean))
            .array(in_hdf5("deviation"), over(&found.deviation))
            .numbers(in_hdf5("angle"), "rad", angle)
    }
}

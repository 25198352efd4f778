//! Curves and peaks, as several analyses write them.

use crate::document::{Array, Document, Rows, Value, in_hdf5};
use rotordyn_signal::kurtogram::Kurtogram;
use rotordyn_signal::ridge::find_peaks;
use rotordyn_signal::spectrum::Spectrum;

/// Number of spectral peaks listed.
const MAX_PEAKS: usize = 20;

/// Position and amplitude of the highest local maxima beyond the first bin.
pub(super) fn highest_peaks(axis: &[f64], values: &[f64]) -> Vec<(f64, f64)> {
    let mut found = find_peaks(axis, values, f64::NEG_INFINITY).unwrap_or_default();
    found.sort_by(|a, b| b.amplitude.total_cmp(&a.amplitude));
    found.iter().take(MAX_PEAKS).map(|peak| (peak.position, peak.amplitude)).collect()
}

pub(super) fn peak_rows<'a>(peaks: &[(f64, f64)], position: &str, amplitude: &str) -> Value<'a> {
    let rows = Rows::of(peaks).number(position, "", |peak| peak.0).number(amplitude, "", |peak| peak.1);
    Value::Table(rows.table())
}

/// A spectrum over its axis, HDF5 only.
pub(super) fn over_axis<'a>(spectrum: &'a Spectrum, axis: &str, axis_unit: &str, unit: &str) -> Document<'a> {
    let values = Array::real(&[spectrum.values.len()], unit, &spectrum.values).over(0, axis);
    Document::new()
        .number(in_hdf5("noise_bandwidth"), "Hz", spectrum.noise_bandwidth_hz)
        .array(in_hdf5("values"), values)
        .numbers(in_hdf5(axis), axis_unit, &spectrum.frequencies)
}

/// Every band of a kurtogram, HDF5 only.
pub(super) fn bands<'a>(kurtogram: &Kurtogram, unit: &str) -> Value<'a> {
    let bands: Vec<_> = kurtogram.bands().collect();
    let rows = Rows::of(&bands)
        .number(in_hdf5("low"), "Hz", |b| b.low)
        .number(in_hdf5("high"), "Hz", |b| b.high)
        .number(in_hdf5("level"), "1", |b| b.level)
        .number(in_hdf5("value"), unit, |b| b.value);
    Value::Table(rows.table())
}

//! The plain way: the band of highest kurtosis, its envelope spectrum, a threshold at the defect frequencies.

use rotordyn_signal::WindowKind;
use rotordyn_signal::bearing_lines::{BearingPart, DefectFrequencies};
use rotordyn_signal::envelope::squared_envelope_spectrum;
use rotordyn_signal::kurtogram::fast_kurtogram;
use rotordyn_signal::spectrum::Level;

use super::RATE;

/// Line over the median of the spectrum up to 3 BPFI from which a part is named: noise exceeds it among the
/// bins of the four windows in about one record of a hundred.
pub const THRESHOLD: f64 = 4.2;
/// Search window, relative to the defect frequency.
const SLIP: f64 = 0.02;

/// The part with the highest line in its window, and that line over the median.
pub fn plain_diagnosis(record: &[f64], rates: &DefectFrequencies) -> (BearingPart, f64) {
    // Bands at least 2.5 times the highest defect frequency wide.
    let highest = rates.inner.max(2.0 * rates.ball);
    let depth = ((0.5 * RATE / (2.5 * highest)).log2().floor() as usize).clamp(1, 6);
    let band = fast_kurtogram(record, RATE, depth).unwrap().best();
    let band = Some((band.low, band.high));
    let spectrum = squared_envelope_spectrum(record, RATE, band, WindowKind::Hann, Level::Peak).unwrap();
    let step = spectrum.frequencies[1];
    let bins = |low: f64, high: f64| (low / step).floor() as usize..=(high / step).ceil() as usize;
    let mut floor = spectrum.values[bins(2.0 * step, 3.0 * rates.inner)].to_vec();
    floor.sort_by(f64::total_cmp);
    let median = floor[floor.len() / 2];
    let level = |part: BearingPart| {
        let line = part.defect_frequency(rates);
        let window = &spectrum.values[bins(line * (1.0 - SLIP), line * (1.0 + SLIP))];
        window.iter().copied().fold(0.0, f64::max) / median
    };
    let levels = BearingPart::ALL.map(|part| (level(part), part));
    let best = levels.into_iter().max_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
    (best.1, best.0)
}

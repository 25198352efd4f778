//! Parts of the band around peaks that no mode explains, identified by themselves.
//!
//! Over a wide band the correlations reach over few cycles of the lowest modes, and the strongest modes take most of the state
//! space. A part of the band is sampled at a lower rate: its correlations are longer in time and hold fewer modes.

use super::band::identify_band;
use super::result::{OperationalMode, OperationalModes, SpectralPeak};
use super::settings::{OperationalSettings, OutputRecord};

/// Ratio of neighbouring peaks up to which they belong to one part.
const NEIGHBOURS: f64 = 1.5;
/// Ends of a part beyond its peaks, and of the range in which its modes replace those of the whole band.
const MARGIN: f64 = 1.6;
const INNER: f64 = 1.25;
/// Upper end of a part over that of the band above which nothing would be gained.
const LARGEST_PART: f64 = 0.7;

/// Replaces modes near unexplained peaks by those of their part of the band, where these explain more peaks.
pub(super) fn resolve(record: &OutputRecord, settings: &OperationalSettings, found: &mut OperationalModes) {
    let mut groups: Vec<[f64; 2]> = Vec::new();
    for peak in unexplained_peaks(found) {
        match groups.last_mut() {
            Some([_, to]) if peak.frequency < NEIGHBOURS * *to => *to = peak.frequency,
            _ => groups.push([peak.frequency; 2]),
        }
    }
    for [from, to] in groups {
        let band = [(from / MARGIN).max(found.band[0]), (to * MARGIN).min(found.band[1])];
        if band[1] > LARGEST_PART * found.band[1] {
            continue;
        }
        let settings = OperationalSettings { band: Some(band), max_order: None, ..settings.clone() };
        // A part that is too short a record for its band leaves the modes as they are.
        let Ok(part) = identify_band(record, &settings) else { continue };
        let inside = |mode: &OperationalMode| (from / INNER..=to * INNER).contains(&mode.frequency_hz());
        let mut tried = found.clone();
        tried.modes.retain(|mode| !inside(mode));
        tried.modes.extend(part.modes.into_iter().filter(inside));
        tried.modes.sort_by(|a, b| a.pole.im.total_cmp(&b.pole.im));
        if unexplained_peaks(&tried).len() < unexplained_peaks(found).len() {
            tried.warnings.extend(part.warnings);
            tried.warnings.sort();
            tried.warnings.dedup();
            tried.dropped.extend(part.dropped);
            *found = tried;
        }
    }
}

/// Least height of a peak that a mode must explain \[dB\].
const CLEAR_PEAK_DB: f64 = 10.0;

/// Peaks of the spectrum that are neither a mode nor a harmonic.
pub(super) fn unexplained_peaks(found: &OperationalModes) -> Vec<SpectralPeak> {
    let step = match found.spectrum.frequencies[..] {
        [a, b, ..] => b - a,
        _ => return Vec::new(),
    };
    let explained = |peak: &SpectralPeak| {
        let near = |m: &OperationalMode| {
            let width = m.damping_ratio() * m.frequency_hz() + 3.0 * m.frequency_error + 2.0 * step;
            (m.frequency_hz() - peak.frequency).abs() < width
        };
        peak.harmonic || found.modes.iter().any(near)
    };
    found.spectrum.peaks.iter().filter(|p| p.height_db > CLEAR_PEAK_DB && !explained(p)).cloned().collect()
}

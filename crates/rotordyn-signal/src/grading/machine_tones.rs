//! Lines of shaft and mains in a record itself: what lies in a demodulated band beats in its envelope.

use std::ops::Range;

use super::super::spectrum::Spectrum;
use super::line_spectrum::LineSpectrum;
use super::rival_kind::MAINS;

/// Highest shaft order and highest frequency of the mains' harmonics \[Hz\] that are looked for.
const SHAFT_ORDERS: usize = 30;
const MAINS_END: f64 = 1000.0;
/// Orders of a shaft that may run off the speed given, and by how much.
const STRONG_ORDERS: usize = 3;
const SPEED_ERROR: f64 = 0.02;
/// Evidence from which a line stands.
const STANDS: f64 = 9.0;
/// Amplitude over the background down to which bins belong to a line, and the least and most of them on a side: more of
/// a tone between two bins lies farther off than one in fifty of its power; a speed that wanders widens lines.
const SKIRT: f64 = 3.0;
const LEAST_HALF_WIDTH: usize = 4;
const RELATIVE_HALF_WIDTH: f64 = 0.01;

/// Bins of the standing lines of shaft and mains in a record's amplitude spectrum (Hann).
///
/// `shaft` \[Hz\]; 1x to 3x are found within ± 2 % of it.
pub(crate) fn machine_tones(spectrum: &Spectrum, shaft: f64) -> Vec<Range<usize>> {
    // And the background about the highest.
    let end = (1.1 * MAINS_END).max((SHAFT_ORDERS + 1) as f64 * shaft);
    let lines = LineSpectrum::new(&spectrum.up_to(end), shaft, Some(1.0), None);
    let step = lines.step;
    let orders = (1..=SHAFT_ORDERS).map(|n| {
        let place = n as f64 * shaft;
        let error = if n <= STRONG_ORDERS { SPEED_ERROR } else { 7e-4 };
        (place, step + error * place)
    });
    let mains = MAINS.into_iter().flat_map(|rate| {
        (1..=(MAINS_END / rate) as usize).map(move |n| (n as f64 * rate, step + 3e-4 * n as f64 * rate))
    });
    let line = |(place, reach): (f64, f64)| {
        let (frequency, _) = lines.highest(place, reach).filter(|(f, _)| lines.evidence(*f) >= STANDS)?;
        let top = (frequency / step).round() as usize;
        let most = LEAST_HALF_WIDTH.max((RELATIVE_HALF_WIDTH * top as f64) as usize);
        let belongs = |k: &usize| lines.power_ratio(*k, lines.amplitude[*k]) > SKIRT * SKIRT;
        let below = (top.saturating_sub(most)..top).rev().take_while(belongs).count().max(LEAST_HALF_WIDTH);
        let end = lines.amplitude.len();
        let above = (top + 1..(top + most + 1).min(end)).take_while(belongs).count().max(LEAST_HALF_WIDTH);
        Some(top.saturating_sub(below)..(top + above + 1).min(end))
    };
    let mut found: Vec<Range<usize>> = orders.chain(mains).filter_map(line).collect();
    found.sort_by_key(|bins| bins.start);
    let mut apart: Vec<Range<usize>> = Vec::new();
    for bins in found {
        match apart.last_mut() {
            Some(last) if bins.start <= last.end => last.end = last.end.max(bins.end),
            _ => apart.push(bins),
        }
    }
    apart
}

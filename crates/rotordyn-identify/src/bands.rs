//! Records that hold too much for one band: split by the peaks that they hold, identified band by band.
//!
//! One fit over a wide range has few orders left for each mode, and its error is that of the strongest modes. The
//! peaks of the mode indicator (sum of |H|² of all FRFs, each over its mean) are counted from below; a band ends in the
//! valley before the peak that would be one too many or too high over the band's first. Every band is fitted with the next
//! peak on either side, which is a mode of its neighbour.

use std::f64::consts::TAU;

use super::data::{Data, highest_order};
use super::frf_power::noise_rms;
use super::one_band::identify_band;
use super::result::{ModalIdentification, fit_error, total_error};
use super::{IdentifyError, Settings};
use rotordyn_linalg::Complex64;
use rotordyn_signal::record::FrfMatrix;

/// A record is split if its highest frequency is this many times its lowest peak, or if it has more peaks.
const MAX_RANGE: f64 = 60.0;
const MAX_PEAKS: usize = 24;
/// The same for a band of a split record: highest over lowest peak, and peaks.
const MAX_BAND_RANGE: f64 = 6.0;
const MAX_BAND_PEAKS: usize = 7;
/// Height of a peak over the valleys on both sides, as a ratio of |H|²: 6 dB.
const PROMINENCE: f64 = 4.0;
/// Least lines of a band.
const MIN_LINES: usize = 80;

/// A band: the lines of which modes are taken, and those that are fitted; last lines included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Band {
    core: [usize; 2],
    fitted: [usize; 2],
}

/// The bands of a record, in order; one if it need not be split.
pub(super) fn split(data: &Data) -> Vec<Band> {
    let lines = data.lines();
    let whole = [0, lines - 1];
    let one = vec![Band { core: whole, fitted: whole }];
    let peaks = peaks(&indicator(data));
    let hz = |k: usize| data.frequencies[k];
    let Some(first) = peaks.first() else { return one };
    if peaks.len() < 2 || (hz(lines - 1) < MAX_RANGE * hz(first.top) && peaks.len() <= MAX_PEAKS) {
        return one;
    }
    // Places of the first peak of every band.
    let mut starts = vec![0];
    for k in 1..peaks.len() {
        let start = starts[starts.len() - 1];
        let wide = hz(peaks[k].top) > MAX_BAND_RANGE * hz(peaks[start].top);
        let lines = peaks[k].valley - if start == 0 { 0 } else { peaks[start].valley };
        if (k - start >= MAX_BAND_PEAKS || wide) && lines >= MIN_LINES {
            starts.push(k);
        }
    }
    // The valley before peak k; the ends of the record before the first and behind the last.
    let valley = |k: usize| match k {
        0 => 0,
        k if k < peaks.len() => peaks[k].valley,
        _ => lines - 1,
    };
    starts
        .iter()
        .enumerate()
        .map(|(b, &start)| {
            let end = starts.get(b + 1).copied().unwrap_or(peaks.len());
            let last = if end < peaks.len() { valley(end) - 1 } else { lines - 1 };
            Band {
                core: [valley(start), last],
                fitted: [valley(start.saturating_sub(1)), valley(end + 1).max(last).min(lines - 1)],
            }
        })
        .collect()
}

/// A peak of the indicator and the deepest line between the previous peak and this one.
#[derive(Clone, Copy, Debug)]
struct Peak {
    top: usize,
    valley: usize,
}

/// Half width of the moving average of the indicator, relative to the frequency.
const SMOOTHING: f64 = 0.002;

/// Mode indicator and the level that noise alone stays below.
///
/// The mean square of noise is that of the third differences; of n FRFs its sum scatters by 1/√n.
fn indicator(data: &Data) -> (Vec<f64>, f64) {
    let mut sum = vec![0.0; data.lines()];
    let (mut noise, mut count) = (0.0, 0.0f64);
    for frf in data.values.iter().flatten() {
        let mean = frf.iter().map(|h| h.norm_sqr()).sum::<f64>() / frf.len() as f64;
        if mean > 0.0 {
            sum.iter_mut().zip(frf).for_each(|(sum, h)| *sum += h.norm_sqr() / mean);
            noise += noise_rms(frf).powi(2) / mean;
            count += 1.0;
        }
    }
    let total: Vec<f64> = std::iter::once(0.0)
        .chain(sum.iter().scan(0.0, |total, value| {
            *total += value;
            Some(*total)
        }))
        .collect();
    let smooth = |k: usize| {
        let half = (SMOOTHING * data.frequencies[k] / data.step) as usize;
        let (from, to) = (k.saturating_sub(half), (k + half + 1).min(sum.len()));
        (total[to] - total[from]) / (to - from) as f64
    };
    ((0..sum.len()).map(smooth).collect(), noise * (1.0 + 8.0 / count.max(1.0).sqrt()))
}

/// Peaks that rise above noise, and over the valleys on both sides by the prominence, from below.
fn peaks((indicator, noise): &(Vec<f64>, f64)) -> Vec<Peak> {
    let mut out = Vec::new();
    // Highest line since the last valley, lowest since the last peak.
    let (mut top, mut bottom) = (0, 0);
    let mut rising = true;
    for (k, value) in indicator.iter().enumerate() {
        if rising {
            if *value > indicator[top] {
                top = k;
            }
            if *value * PROMINENCE < indicator[top] {
                // A fall from the first line is the flank of what lies below the record.
                if top > 0 && indicator[top] > *noise {
                    out.push(Peak { top, valley: bottom });
                    bottom = k;
                }
                rising = false;
            }
        }
        if !rising {
            if *value < indicator[bottom] {
                bottom = k;
            }
            if *value > PROMINENCE * indicator[bottom] {
                (rising, top) = (true, k);
            }
        }
    }
    out
}

/// Identifies every band by itself; the modes, FRFs and poles of the cores together.
pub(super) fn identify_bands(
    frfs: &FrfMatrix,
    settings: &Settings,
    bands: &[Band],
) -> Result<ModalIdentification, IdentifyError> {
    let whole = Data::new(frfs, settings)?.frequencies;
    let mut all: Option<ModalIdentification> = None;
    let (mut none, mut most, mut dropped) = (0, 0, Vec::new());
    for band in bands {
        let range = |[from, to]: [usize; 2]| [whole[from], whole[to]];
        // The neighbours of an inner end hold modes, whatever lies outside the record.
        let [upper, lower] = [band.fitted[1] < whole.len() - 1, band.fitted[0] > 0];
        let own = Settings {
            band: Some(range(band.fitted)),
            max_order: None,
            residual_terms: settings.residual_terms.with(upper, lower),
            ..settings.clone()
        };
        let data = Data::new(frfs, &own)?;
        let possible = highest_order(data.lines());
        let own = Settings { max_order: settings.max_order.map(|order| order.min(possible)), ..own };
        match identify_band(frfs, &own, data) {
            Ok(found) => {
                let part = only_core(found, range(band.core));
                all = Some(match all {
                    None => part,
                    Some(below) => joined(below, part),
                });
            }
            Err(IdentifyError::NoMode { poles, orders, dropped: own, .. }) => {
                let inside = core_of(range(band.core), whole[1] - whole[0]);
                dropped.extend(own.into_iter().filter(|pole| inside(&pole.value)));
                none += poles;
                most = most.max(orders);
            }
            Err(error) => return Err(error),
        }
    }
    let (from, to) = (whole[0], whole[whole.len() - 1]);
    let mut all = all.filter(|all| !all.modes.is_empty()).ok_or(IdentifyError::NoMode {
        from,
        to,
        poles: none,
        orders: most,
        dropped,
    })?;
    finish(&mut all);
    Ok(all)
}

/// Whether the frequency of a pole lies between two lines, those included, of a record with such a step \[Hz\].
fn core_of([from, to]: [f64; 2], step: f64) -> impl Fn(&Complex64) -> bool {
    move |pole| is_within(pole.im / TAU, [from, to], step)
}

fn is_within(hz: f64, [from, to]: [f64; 2], step: f64) -> bool {
    hz > from - 0.5 * step && hz <= to + 0.5 * step
}

/// The part of a result that lies between two lines.
fn only_core(mut found: ModalIdentification, [from, to]: [f64; 2]) -> ModalIdentification {
    let step = found.frequencies[1] - found.frequencies[0];
    let inside = core_of([from, to], step);
    found.modes.retain(|m| inside(&m.pole));
    found.diagram.retain(|p| inside(&p.value));
    found.dropped.retain(|p| inside(&p.value));
    let lines: Vec<bool> = found.frequencies.iter().map(|hz| is_within(*hz, [from, to], step)).collect();
    for frf in found.measured.iter_mut().chain(&mut found.synthesised).flatten() {
        let mut line = lines.iter();
        frf.retain(|_| line.next().is_some_and(|inside| *inside));
    }
    let mut line = lines.iter();
    found.frequencies.retain(|_| line.next().is_some_and(|inside| *inside));
    found.bands = vec![[from, to]];
    found
}

/// Two results, the second above the first.
fn joined(mut below: ModalIdentification, above: ModalIdentification) -> ModalIdentification {
    below.modes.extend(above.modes);
    below.diagram.extend(above.diagram);
    below.dropped.extend(above.dropped);
    below.bands.extend(above.bands);
    below.frequencies.extend(above.frequencies);
    let own = below.measured.iter_mut().flatten().zip(above.measured.into_iter().flatten());
    own.for_each(|(own, more)| own.extend(more));
    let own = below.synthesised.iter_mut().flatten().zip(above.synthesised.into_iter().flatten());
    own.for_each(|(own, more)| own.extend(more));
    if above.orders.len() > below.orders.len() {
        below.orders = above.orders;
    }
    // Residual terms of the highest band: those of the modes above the record.
    below.upper = above.upper;
    below
}

/// Fit errors over all bands.
fn finish(all: &mut ModalIdentification) {
    for (row, (measured, model)) in all.errors.iter_mut().zip(all.measured.iter().zip(&all.synthesised)) {
        for (error, (measured, model)) in row.iter_mut().zip(measured.iter().zip(model)) {
            *error = fit_error(measured, model);
        }
    }
    all.total_error = total_error(&all.errors, &all.measured);
}

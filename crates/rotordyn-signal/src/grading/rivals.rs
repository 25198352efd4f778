//! Rivals of a bearing part: other periodic families that explain the same lines.

use serde::{Deserialize, Serialize};

use super::line_spectrum::{LinePeak, LineSpectrum};
use super::rival_kind::{MAINS, RivalKind};

/// Harmonic numbers tried for each peak in the search of free rates.
const MAX_NUMBER: usize = 12;
/// Peaks of which each may be a harmonic of a free rate.
const SEED_PEAKS: usize = 24;
/// Log-odds of a family against chance from which it is taken as present.
const LOG_ODDS: f64 = 7.0;
/// Families taken from one spectrum.
const MAX_RIVALS: usize = 4;
/// Share of a line's amplitude that a neighbouring harmonic of the family must have to explain the line.
const NEIGHBOUR: f64 = 1.0 / 3.0;

/// Share of the axis that the tolerances of a family may cover where it explains a line: denser ones explain anything.
const DENSE: f64 = 0.35;

/// Turns from one impact to the next of a rival at a fraction of the shaft speed, and its lowest line over that of the part.
const TURNS: [usize; 3] = [2, 3, 4];
const LOWEST: f64 = 0.7;

/// A family of harmonics of one rate.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rival {
    pub kind: RivalKind,
    /// Repetition rate \[Hz\].
    pub rate: f64,
    /// Highest harmonic among the peaks.
    pub highest: usize,
    /// Number of peaks it explains.
    pub lines: usize,
    /// Amplitude of the highest of them.
    pub amplitude: f64,
    /// Log-odds against a chance coincidence of its peaks.
    pub log_odds: f64,
}

/// Tolerance of a line at `frequency`: a bin, and the uncertainty of the rate or the wander of the source.
fn tolerance(kind: RivalKind, frequency: f64, step: f64) -> f64 {
    match kind {
        RivalKind::Shaft => step + 7e-4 * frequency,
        RivalKind::Mains => step + 3e-4 * frequency,
        RivalKind::Periodic => 1.2 * step + 1e-3 * frequency,
    }
}

impl Rival {
    /// Whether `frequency` is one of its harmonics, up to one and a half times the highest found.
    pub fn explains(&self, frequency: f64, step: f64) -> bool {
        let number = (frequency / self.rate).round();
        number >= 1.0
            && number <= 1.5 * self.highest as f64 + 1.0
            && (frequency - number * self.rate).abs()
                <= tolerance(self.kind, frequency, step) + self.wander() * frequency
    }

    /// Whether its rate is so high that its harmonics leave most of the axis free: a slower one has every line.
    pub(super) fn is_resolved(&self, step: f64) -> bool {
        2.0 * tolerance(self.kind, self.rate, step) <= DENSE * self.rate
    }

    /// Whether `frequency` is a multiple of its free rate, which is not so low that any frequency is.
    pub(crate) fn is_family_of(&self, frequency: f64, step: f64) -> bool {
        let near = tolerance(self.kind, frequency, step);
        self.kind == RivalKind::Periodic && 2.0 * near <= DENSE * self.rate && self.explains(frequency, step)
    }

    /// Whether it explains a line of this amplitude: a free family also needs comparable harmonics beside it.
    ///
    /// The lines h f + n f_r of a damaged part lie near the multiples of a fraction of f_r wherever f/f_r is
    /// nearly a ratio of small numbers (BPFO 3.597 f_r: multiples of f_r/5). Impacts at such a low rate would
    /// have lines at all of these multiples, of heights that change slowly from one to the next.
    /// `of_part`: whether a frequency is one of the part's own lines, which support no other family.
    pub(super) fn claims(
        &self,
        frequency: f64,
        amplitude: f64,
        spectrum: &LineSpectrum,
        of_part: impl Fn(f64) -> bool,
    ) -> bool {
        let half_width = tolerance(self.kind, frequency, spectrum.step) + self.wander() * frequency;
        if !self.explains(frequency, spectrum.step) || 2.0 * half_width > DENSE * self.rate {
            return false;
        }
        let number = (frequency / self.rate).round();
        let stands = |n: f64| {
            let place = n * self.rate;
            let reach = tolerance(self.kind, place, spectrum.step);
            let highest = spectrum.highest(place, reach).map_or(0.0, |(_, a)| a);
            n >= 1.0 && !of_part(place) && highest >= NEIGHBOUR * amplitude
        };
        match number {
            _ if self.kind != RivalKind::Periodic => true,
            n if n < 3.0 => stands(n - 1.0) || stands(n + 1.0),
            n => stands(n - 1.0) && stands(n + 1.0),
        }
    }

    /// Free sources may wander: their high harmonics are wide.
    fn wander(&self) -> f64 {
        if self.kind == RivalKind::Periodic { 2e-3 } else { 0.0 }
    }
}

/// Families of shaft, mains and free rates that chance does not explain, among `peaks` (strongest first).
pub(super) fn find_rivals(
    peaks: &[LinePeak],
    shaft: f64,
    hz_per_unit: Option<f64>,
    step: f64,
    excluded: impl Fn(f64) -> bool,
) -> Vec<Rival> {
    let mut open: Vec<LinePeak> = peaks.to_vec();
    let mut found: Vec<Rival> = Vec::new();
    let mut known = vec![(RivalKind::Shaft, shaft)];
    if let Some(unit) = hz_per_unit {
        known.extend(MAINS.map(|rate| (RivalKind::Mains, rate / unit)));
    }
    for (kind, rate) in known {
        if let Some(rival) = supported(kind, rate, &open, step, 2, LOG_ODDS - 4.0) {
            open.retain(|peak| !rival.explains(peak.frequency, step));
            found.push(rival);
        }
    }
    while found.len() < MAX_RIVALS && open.len() >= 3 {
        let seeds = open.iter().take(SEED_PEAKS);
        let trials = (seeds.len() * MAX_NUMBER) as f64;
        let best = seeds
            .flat_map(|peak| (1..=MAX_NUMBER).map(move |n| peak.frequency / n as f64))
            .filter(|rate| *rate > 4.0 * step && !excluded(*rate))
            .filter_map(|rate| {
                let rate = refined(rate, &open, step);
                supported(RivalKind::Periodic, rate, &open, step, 3, LOG_ODDS + trials.ln())
            })
            .filter(|rival| !excluded(rival.rate))
            // Equal support: the highest rate, of which the others are fractions.
            .max_by(|a, b| a.log_odds.total_cmp(&b.log_odds).then(a.rate.total_cmp(&b.rate)));
        let Some(rival) = best else { break };
        open.retain(|peak| !rival.explains(peak.frequency, step));
        found.push(rival);
    }
    found
}

/// Impacts every second, third or fourth turn, of which a line of a part at such a multiple is a harmonic.
///
/// The lines h f ± n f_r of an inner race are all at multiples of f_r/m if f is; impacts at f_r/m have the lowest of them too, and
/// none is much higher than those below it.
pub(super) fn fraction_of_shaft(base: f64, spectrum: &LineSpectrum, shaft: f64) -> Option<Rival> {
    TURNS.into_iter().find_map(|turns| {
        let rate = shaft / turns as f64;
        let near = |place: f64| tolerance(RivalKind::Periodic, place, spectrum.step);
        let number = (base / rate).round() as usize;
        if number.is_multiple_of(turns) || (base - number as f64 * rate).abs() > near(base) {
            return None;
        }
        let level = |n: usize| {
            let place = n as f64 * rate;
            spectrum.highest(place, near(place)).map_or(0.0, |(_, amplitude)| amplitude)
        };
        let own = level(number);
        let below = (1..number).filter(|n| !n.is_multiple_of(turns));
        if below.clone().any(|n| level(n) < NEIGHBOUR * own) || level(1) < LOWEST * own {
            return None;
        }
        let matched: Vec<usize> = spectrum
            .free_peaks()
            .map(|peak| (peak.frequency, (peak.frequency / rate).round()))
            .filter(|(place, n)| *n >= 1.0 && (place - n * rate).abs() <= near(*place))
            .map(|(_, n)| n as usize)
            .collect();
        Some(Rival {
            kind: RivalKind::Periodic,
            rate,
            highest: matched.iter().copied().max()?,
            lines: matched.len(),
            amplitude: below.map(level).fold(own, f64::max),
            log_odds: LOG_ODDS,
        })
    })
}

/// Rate that fits the peaks near its harmonics best (least squares, weighted by harmonic number).
fn refined(rate: f64, peaks: &[LinePeak], step: f64) -> f64 {
    let (mut over, mut under) = (0.0, 0.0);
    for peak in peaks {
        let number = nearest_number(peak.frequency / rate);
        let near = tolerance(RivalKind::Periodic, peak.frequency, step);
        if number >= 1.0 && (peak.frequency - number * rate).abs() <= near {
            over += number * peak.frequency;
            under += number * number;
        }
    }
    if under > 0.0 { over / under } else { rate }
}

/// The family at `rate`, if so many peaks at its harmonics are no chance.
///
/// K peaks of which M lie within the tolerance of a harmonic, with chance π each: log-odds
/// M ln(M/Kπ) + (K − M) ln((1 − M/K)/(1 − π)) (Chernoff bound of the binomial tail).
fn supported(
    kind: RivalKind,
    rate: f64,
    peaks: &[LinePeak],
    step: f64,
    least: usize,
    needed: f64,
) -> Option<Rival> {
    let (mut matched, mut chance, mut highest, mut amplitude) = (0usize, 0.0, 0usize, 0.0f64);
    let mut distinct: Vec<usize> = Vec::new();
    for peak in peaks {
        let near = tolerance(kind, peak.frequency, step);
        chance += (2.0 * near / rate).min(1.0);
        let number = nearest_number(peak.frequency / rate);
        if number >= 1.0 && (peak.frequency - number * rate).abs() <= near {
            matched += 1;
            highest = highest.max(number as usize);
            amplitude = amplitude.max(peak.amplitude);
            if !distinct.contains(&(number as usize)) {
                distinct.push(number as usize);
            }
        }
    }
    // Multiples of one number are harmonics of a higher rate.
    let divisor = distinct.iter().fold(0, |a, &b| greatest_common_divisor(a, b));
    if distinct.len() < least || divisor != 1 && kind == RivalKind::Periodic {
        return None;
    }
    let (count, matched_count) = (peaks.len() as f64, matched as f64);
    let chance = (chance / count).clamp(1e-6, 1.0 - 1e-6);
    let share = matched_count / count;
    if share <= chance {
        return None;
    }
    let missed = if matched < peaks.len() {
        (count - matched_count) * ((1.0 - share) / (1.0 - chance)).ln()
    } else {
        0.0
    };
    let log_odds = matched_count * (share / chance).ln() + missed;
    (log_odds > needed).then_some(Rival { kind, rate, highest, lines: matched, amplitude, log_odds })
}

/// The nearest whole number of a positive ratio; `round` is a library call, too slow for this many.
fn nearest_number(ratio: f64) -> f64 {
    (ratio + 0.5) as i64 as f64
}

/// Greatest common divisor; that of 0 and a number is the number.
pub(super) fn greatest_common_divisor(a: usize, b: usize) -> usize {
    if b == 0 { a } else { greatest_common_divisor(b, a % b) }
}

//! The shaft speed that a record itself shows, near the stated one.

use serde::{Deserialize, Serialize};

use super::super::SignalError;
use super::super::bearing_lines::DefectFrequencies;
use super::super::error::{check, check_rate, check_record};
use super::super::spectrum::{Level, amplitude_spectrum};
use super::super::window::WindowKind;
use super::line_spectrum::LineSpectrum;
use super::rival_kind::MAINS;
use super::rivals::greatest_common_divisor;
use super::zoom::{WindowedRecord, Zoom};

/// Harmonics of the shaft speed that are searched.
const HARMONICS: usize = 10;
/// Evidence from which a harmonic stands.
const STANDS: f64 = 9.0;
/// Evidence of one harmonic that counts fully; more counts as its amplitude does, so that high lines weigh more than
/// many low ones.
const LIMIT: f64 = 40.0;
/// Standard deviation of a line's frequency times √q in bins, q its power over the noise's, behind a Hann window.
///
/// σ² q = ∫w²t² / (32 π² ∫w² (∫wt²)²) with w = cos² πt on −½..½; without a window it would be the Cramér–Rao bound.
const HANN_DEVIATION: f64 = 0.487;
/// Harmonics that make a family: chance gives three within a bin of one comb in fewer than 1 of 1000 noise
/// records (each stands with probability 3 × 10⁻⁵ per trial, some thousand independent trials).
const FAMILY: usize = 3;
/// Evidence of a line at 1x, and of one at an exact multiple of it, from which two confirm a speed; bins within which a
/// multiple is exact beside the deviations of both.
const STRONG: f64 = 30.0;
const PAIR: usize = 2;
const EXACT: f64 = 0.1;
/// Weight of harmonics where the bearing may have lines, and how many others have to stand.
const OF_BEARING: f64 = 0.15;
/// Weight of what harmonics add where mains may have lines.
const OF_MAINS: f64 = 0.7;
const LEAST_OWN: usize = 2;
/// Harmonics of the bearing's lines, and their slip.
const BEARING_HARMONICS: u32 = 3;
const SLIP: f64 = 0.02;
/// Ratios at which a family elsewhere suggests a wrong sampling rate.
const OTHER_RATIOS: [f64; 4] = [0.25, 0.5, 2.0, 4.0];

/// Speed of a family of shaft harmonics in a record.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RecordSpeed {
    /// \[rev/s\].
    pub speed: f64,
    /// Standard deviation \[rev/s\].
    pub uncertainty: f64,
    /// Number of harmonics that stand.
    pub harmonics: usize,
}

/// Result of the search for a shaft speed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum SpeedFinding {
    /// Near the stated speed.
    Found(RecordSpeed),
    /// Not there, but at a ratio of the stated speed that a wrong sampling rate gives.
    Elsewhere { speed: RecordSpeed, ratio: f64 },
    /// No family of harmonics.
    NotFound,
}

/// Shaft speed from the harmonics 1x to 10x in a record's spectrum, within ± `range` of the stated speed.
///
/// Maximises Σ evidence(n f) over f, large evidence counted by its root, none more than the second highest, then
/// Σ ln(1 + q(n f)) between the bins, q = A² over the noise's. Then f = Σ w f_n/n over the harmonics' own maxima f_n, w = (n/σ_n)² and
/// σ_n = 0.487 Δf/√q_n, which is 1.53 times the Cramér–Rao bound: the price of the Hann window. `record`
/// \[any unit\], `sample_rate` \[Hz\], `stated` \[rev/s\], `range` relative, 0 to 0.2. Where the f_n/n scatter more than
/// noise explains the uncertainty is that of their scatter. A strong line at 1x with one at an exact multiple of it
/// suffices; it is preferred where more of its harmonics are the shaft's own. Where mains may have lines a harmonic counts less, and where
/// they have them it says nothing of the exact speed; where the `bearing` (at the stated speed) may have them it counts
/// for a seventh, and two others have to stand; a family of even harmonics alone is one of twice the speed. Errors: NaN, a speed or range out of range, fewer than
/// ten revolutions. Source for σ_n: Rife and Boorstyn, Bell Syst. Tech. J. 55 (1976).
pub fn shaft_speed(
    record: &[f64],
    sample_rate: f64,
    stated: f64,
    range: f64,
    bearing: Option<&DefectFrequencies>,
) -> Result<SpeedFinding, SignalError> {
    check_record("record", record)?;
    check_rate(sample_rate)?;
    check(stated > 0.0 && stated.is_finite(), "shaft speed", "a positive number of rev/s", stated)?;
    check((0.0..=0.2).contains(&range), "range of the shaft speed", "0 to 0.2 of the speed", range)?;
    let turns = stated * record.len() as f64 / sample_rate;
    if turns < 10.0 {
        let purpose = "shaft harmonics in a spectrum";
        return Err(SignalError::TooFewRevolutions { needed: 10.0, given: turns, purpose });
    }
    let mean = record.iter().sum::<f64>() / record.len() as f64;
    let centred: Vec<f64> = record.iter().map(|x| x - mean).collect();
    let spectrum = amplitude_spectrum(&centred, sample_rate, WindowKind::Hann, Level::Peak)?;
    let windowed = WindowedRecord::new(&centred);
    let near = |speed: f64, new: &dyn Fn(usize) -> bool| {
        let lines = LineSpectrum::new(&spectrum, speed, None, None);
        let foreign = Foreign { step: lines.step, range, bearing, speed };
        family(&windowed, &lines, speed, range, &foreign, new)
    };
    let lines = LineSpectrum::new(&spectrum, stated, None, None);
    let foreign = Foreign { step: lines.step, range, bearing, speed: stated };
    let first_order = family_of_first_order(&windowed, &lines, &foreign);
    let found = match (near(stated, &|_| true), first_order) {
        // Lines of mains and bearing beside the shaft's may draw the search away from these.
        (Some(family), Some(exact)) => {
            let own = foreign.own_harmonics(&lines, family.speed);
            Some(if own.len() < exact.harmonics { exact } else { family })
        }
        (family, exact) => family.or(exact),
    };
    if let Some(speed) = found {
        return Ok(SpeedFinding::Found(speed));
    }
    let elsewhere = OTHER_RATIOS.iter().filter_map(|ratio| {
        let turns_enough = turns * ratio >= 10.0;
        // Of a slower shaft those harmonics speak that the stated speed does not have.
        let is_new = |n: usize| *ratio > 1.0 || (n as f64 * ratio).fract() != 0.0;
        Some((*ratio, turns_enough.then(|| near(stated * ratio, &is_new)).flatten()?))
    });
    let most = elsewhere.max_by_key(|(_, speed)| speed.harmonics);
    Ok(most.map_or(SpeedFinding::NotFound, |(ratio, speed)| SpeedFinding::Elsewhere { speed, ratio }))
}

/// The highest line at 1x that is neither of mains nor bearing, with others at exact multiples of it.
///
/// Two strong lines suffice, since one of another source is so near a multiple of the first in a few of a hundred records
/// with dozens of lines, and near the stated speed in fewer.
fn family_of_first_order(
    record: &WindowedRecord,
    lines: &LineSpectrum,
    foreign: &Foreign,
) -> Option<RecordSpeed> {
    let step = lines.step;
    let reach = foreign.range * foreign.speed + step;
    let first_bin = ((foreign.speed - reach) / step).ceil() as usize;
    let bins = first_bin..=((foreign.speed + reach) / step).floor() as usize;
    let count = HARMONICS.min((lines.end() / (foreign.speed + reach)) as usize);
    let of_bearing = foreign.shared(count).of_bearing;
    // Frequency and deviation of the top of a line.
    let top = |place: f64| {
        let (bin, amplitude) = record.zoom(place / step).peak(1.0)?;
        let frequency = bin * step;
        let deviation = HANN_DEVIATION * step / lines.power_ratio(bin.round() as usize, amplitude).sqrt();
        let strong = lines.evidence(frequency) >= STRONG && !foreign.is_exactly_of_mains(frequency);
        strong.then_some((frequency, deviation))
    };
    let is_top = |k: &usize| {
        let a = |k: usize| lines.amplitude.get(k).copied().unwrap_or(0.0);
        *k > 2 && a(*k) >= a(*k - 1) && a(*k) > a(*k + 1)
    };
    let of_first = |first: (f64, f64)| {
        let higher = (2..=count).filter(|n| !of_bearing.contains(n)).filter_map(|n| {
            let order = n as f64;
            let (frequency, deviation) = top(order * first.0)?;
            let exact =
                (frequency - order * first.0).abs() <= 4.0 * (deviation + order * first.1) + EXACT * step;
            exact.then_some((frequency / order, deviation / order))
        });
        std::iter::once(first).chain(higher).collect::<Vec<(f64, f64)>>()
    };
    let candidates = bins.filter(is_top).filter_map(|k| top(k as f64 * step));
    let of_range = candidates.filter(|(f, _)| (f - foreign.speed).abs() <= reach);
    let best = of_range.map(of_first).filter(|found| found.len() >= PAIR).max_by_key(Vec::len)?;
    Some(mean_speed(&best))
}

/// Mean of the speeds f_n/n that harmonics show, weighted by their deviations.
fn mean_speed(found: &[(f64, f64)]) -> RecordSpeed {
    let weights: f64 = found.iter().map(|(_, s)| 1.0 / (s * s)).sum();
    let mean = found.iter().map(|(f, s)| f / (s * s)).sum::<f64>() / weights;
    let scatter = found.iter().map(|(f, s)| ((f - mean) / s).powi(2)).sum::<f64>();
    let free = (found.len() - 1) as f64;
    // Lines that scatter more than their noise: the speed is not as constant as that.
    let excess = if scatter > likely_scatter(free) { scatter / free } else { 1.0 };
    RecordSpeed { speed: mean, uncertainty: (excess / weights).sqrt(), harmonics: found.len() }
}

/// The family of harmonics within ± `range` of a speed, if enough of those that count stand.
fn family(
    record: &WindowedRecord,
    lines: &LineSpectrum,
    stated: f64,
    range: f64,
    foreign: &Foreign,
    counts: &dyn Fn(usize) -> bool,
) -> Option<RecordSpeed> {
    let step = lines.step;
    let count = HARMONICS.min((lines.end() / (stated * (1.0 + range))) as usize);
    let Shared { of_bearing, of_mains } = foreign.shared(count);
    let score = |speed: f64| {
        let sum = |kept: &dyn Fn(&usize) -> bool| {
            let numbers = (1..=count).filter(|n| kept(n));
            joint(numbers.map(|n| limited(lines.evidence(n as f64 * speed))))
        };
        let without_mains = sum(&|n| !of_bearing.contains(n) && !of_mains.contains(n));
        let with_mains = sum(&|n| !of_bearing.contains(n));
        without_mains
            + OF_MAINS * (with_mains - without_mains).max(0.0)
            + OF_BEARING * sum(&|n| of_bearing.contains(n))
    };
    let trials = (range * stated * HARMONICS as f64 / step).ceil() as i64;
    let coarse = best_of(stated, step / HARMONICS as f64, trials, score);
    let mut standing: Vec<usize> =
        (1..=count).filter(|n| lines.evidence(*n as f64 * coarse) >= STANDS).collect();
    let counted = standing.iter().filter(|n| counts(**n)).count();
    if counted < FAMILY || standing.iter().all(|n| *n > 2) {
        return None;
    }
    // A family that the bearing explains is no shaft.
    let free: Vec<usize> = standing.iter().copied().filter(|n| !of_bearing.contains(n)).collect();
    if free.len() < LEAST_OWN {
        return None;
    }
    // Multiples of one number are harmonics of another rate: of a bearing, or of a shaft at that number of speeds.
    let deciding = if free.len() < FAMILY { &standing } else { &free };
    if deciding.iter().fold(0, |a, b| greatest_common_divisor(a, *b)) != 1 {
        return None;
    }
    // Lines of the mains may be those of the shaft; their places say nothing of its speed.
    let own = |n: &usize| !foreign.is_of_mains(*n as f64 * coarse, 3e-4) && !of_bearing.contains(n);
    if standing.iter().filter(|n| own(n)).count() >= FAMILY {
        standing.retain(own);
    }
    // Power over the noise's of an amplitude near harmonic n.
    let ratio =
        |n: usize, amplitude: f64| lines.power_ratio((n as f64 * coarse / step).round() as usize, amplitude);
    let zooms: Vec<(usize, Zoom)> =
        standing.iter().map(|&n| (n, record.zoom(n as f64 * coarse / step))).collect();
    let likelihood = |speed: f64| {
        let at = |(n, zoom): &(usize, Zoom)| ratio(*n, zoom.amplitude(*n as f64 * speed / step)).ln_1p();
        zooms.iter().map(at).sum::<f64>()
    };
    // A bin of the highest harmonic on either side, in twentieths of it.
    let highest = standing.last().copied().unwrap_or(1) as f64;
    let speed = best_of(coarse, step / (20.0 * highest), 20, likelihood);
    let maximum = |&n: &usize| {
        let (bin, amplitude) = record.zoom(n as f64 * speed / step).peak(1.0)?;
        let power = ratio(n, amplitude);
        (power > 1.0).then(|| (bin * step / n as f64, HANN_DEVIATION * step / (power.sqrt() * n as f64)))
    };
    let found: Vec<(f64, f64)> = standing.iter().filter_map(maximum).collect();
    if found.len() < FAMILY {
        return None;
    }
    Some(mean_speed(&found))
}

/// Evidence that counts in the first search: the top of a strong line is preferred to its skirts.
fn limited(evidence: f64) -> f64 {
    if evidence <= LIMIT { evidence } else { (LIMIT * evidence).sqrt() }
}

/// Σ min(e, e₂) with the second highest, e₂: no line alone decides.
fn joint(values: impl Iterator<Item = f64> + Clone) -> f64 {
    let (mut first, mut second) = (0.0f64, 0.0f64);
    for value in values.clone() {
        if value > first {
            (first, second) = (value, first);
        } else {
            second = second.max(value);
        }
    }
    values.map(|value| value.min(second)).sum()
}

/// Numbers of harmonics whose places others may have too.
struct Shared {
    of_bearing: Vec<usize>,
    of_mains: Vec<usize>,
}

/// What else may have lines at harmonics of a shaft.
struct Foreign<'a> {
    step: f64,
    /// Relative range of the search.
    range: f64,
    bearing: Option<&'a DefectFrequencies>,
    /// Speed about which is searched \[Hz\].
    speed: f64,
}

impl Foreign<'_> {
    /// The shared ones of the first harmonics; none where too few would be left to tell the speed, as at the speed of the mains.
    fn shared(&self, count: usize) -> Shared {
        let leaves_family = |found: &Vec<usize>| count >= FAMILY + found.len();
        let bearing: Vec<usize> = (1..=count).filter(|n| self.bearing_has(*n)).collect();
        let of_bearing = Some(bearing).filter(leaves_family).unwrap_or_default();
        let mains: Vec<usize> =
            (1..=count).filter(|n| self.mains_have(*n) && !of_bearing.contains(n)).collect();
        let leave_family = |mains: &Vec<usize>| count >= FAMILY + mains.len() + of_bearing.len();
        let of_mains = Some(mains).filter(leave_family).unwrap_or_default();
        Shared { of_bearing, of_mains }
    }

    /// Whether mains have a harmonic at n times a speed in the range.
    fn mains_have(&self, n: usize) -> bool {
        self.is_of_mains(n as f64 * self.speed, self.range)
    }

    /// Whether mains have a harmonic at a frequency, within two bins and a share of it.
    fn is_of_mains(&self, frequency: f64, share: f64) -> bool {
        MAINS.iter().any(|rate| {
            let number = (frequency / rate).round();
            number >= 1.0 && (frequency - number * rate).abs() <= 2.0 * self.step + share * frequency
        })
    }

    /// Whether a frequency is that of the mains within a fifth of a bin: a line beside it is resolved from theirs.
    fn is_exactly_of_mains(&self, frequency: f64) -> bool {
        MAINS.iter().any(|rate| {
            let number = (frequency / rate).round();
            number >= 1.0 && (frequency - number * rate).abs() <= 0.2 * self.step + 3e-4 * frequency
        })
    }

    /// Harmonics of a speed that stand and are no lines of mains or bearing.
    fn own_harmonics(&self, lines: &LineSpectrum, speed: f64) -> Vec<usize> {
        let count = HARMONICS.min((lines.end() / speed) as usize);
        let of_bearing = self.shared(count).of_bearing;
        let own = |n: &usize| {
            let place = *n as f64 * speed;
            let top = lines.top_near(place, 1);
            lines.evidence(place) >= STANDS
                && !of_bearing.contains(n)
                && top.is_some_and(|f| (f - place).abs() <= self.step && !self.is_exactly_of_mains(f))
        };
        (1..=count).filter(own).collect()
    }

    /// Whether the bearing may have a line at n times a speed in the range: one of its harmonics, side bands included,
    /// as far from n times the speed given as range and slip go.
    fn bearing_has(&self, n: usize) -> bool {
        let Some(DefectFrequencies { shaft, cage, outer, inner, ball }) = self.bearing else { return false };
        let near = |line: f64| {
            let order = line * self.speed.recip();
            (order - n as f64).abs() <= (self.range + SLIP) * order + self.step / self.speed
        };
        (1..=BEARING_HARMONICS).any(|h| {
            let h = f64::from(h);
            near(h * outer)
                || (-2..=2).any(|m| {
                    near(h * inner + f64::from(m) * shaft) || near(2.0 * h * ball + f64::from(m) * cage)
                })
        })
    }
}

/// The trial centre + k step, |k| ≤ `trials`, of the highest value; of equal ones the nearest to the centre.
fn best_of(centre: f64, step: f64, trials: i64, value: impl Fn(f64) -> f64) -> f64 {
    let mut best = (f64::NEG_INFINITY, centre);
    for trial in (0..=trials).flat_map(|t| [t, -t]) {
        let place = centre + trial as f64 * step;
        let found = value(place);
        if found > best.0 {
            best = (found, place);
        }
    }
    best.1
}

/// What χ² of ν degrees of freedom exceeds once in a thousand times (Wilson and Hilferty, Proc. Natl. Acad. Sci. 17 (1931)).
fn likely_scatter(free: f64) -> f64 {
    const NORMAL: f64 = 3.090;
    let part = 2.0 / (9.0 * free);
    free * (1.0 - part + NORMAL * part.sqrt()).powi(3)
}

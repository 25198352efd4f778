//! Trend of several records of one machine: what changes along their axis, what is named, what is not comparable.

use crate::document::number;
use crate::results::{
    Change, LineLevel, RecordDiagnosis, RecordState, SignalResult, TrendAxis, TrendRecord, TrendResult,
};
use rotordyn_signal::SignalError;
use rotordyn_signal::bearing_lines::BearingPart;
use rotordyn_signal::statistics::band_rms;
use rotordyn_signal::trend::trend;

/// Family-wise error of the changes that are stated.
const SIGNIFICANCE: f64 = 0.05;
/// Shares of healthy records in which a part is named, and named at 95 % or above (table of `grading`).
const FALSE_NAMES: [(f64, f64); 2] = [(0.5, 0.04), (0.95, 0.004)];
/// Probability of as many names by chance below which nothing is said of it.
const CHANCE: f64 = 0.05;
/// Most names of records in a sentence.
const MAX_NAMES: usize = 6;

/// State of the machine in one analysed record, without its line levels.
///
/// `rms_bands` \[Hz\]. Errors: a band without a bin of the record.
pub fn record_state(found: &SignalResult, rms_bands: &[[f64; 2]]) -> Result<RecordState, SignalError> {
    let half = 0.5 * found.sample_rate;
    let level = |&[low, high]: &[f64; 2]| match high <= half {
        true => band_rms(&found.samples, found.sample_rate, (low, high)),
        false => Ok(f64::NAN),
    };
    let band_rms: Result<Vec<f64>, SignalError> = rms_bands.iter().map(level).collect();
    let envelope = found.envelope.as_ref();
    let diagnosis = envelope.and_then(|envelope| {
        let graded = envelope.graded.as_ref()?;
        Some(RecordDiagnosis {
            statement: graded.statement(envelope.frequency_unit()),
            part: graded.part(),
            candidate: graded.candidate,
            probability: graded.probability,
            band: envelope.band,
            lines: None,
        })
    });
    Ok(RecordState {
        channel: found.channel.clone(),
        unit: found.unit.clone(),
        sample_rate: found.sample_rate,
        samples: found.samples.len(),
        statistics: found.statistics,
        band_rms: band_rms?,
        speed: found.shaft_speed(),
        speed_source: found.shaft.as_ref().map_or_else(String::new, |s| s.source.clone()),
        diagnosis,
    })
}

/// Levels of the lines of every part in an envelope spectrum; `None` without a bearing.
pub fn line_levels(found: &SignalResult) -> Option<[LineLevel; 4]> {
    let lines = found.envelope.as_ref()?.lines.as_ref()?;
    Some(BearingPart::ALL.map(|part| {
        let family = lines.family(part);
        let harmonics = family.lines.iter().filter(|line| line.modulation.is_none() && !line.shared);
        let level_db = harmonics.map(|line| line.level_db).reduce(f64::max).unwrap_or(f64::NAN);
        // The sum of no lines is −0.
        LineLevel { strength: family.strength + 0.0, level_db }
    }))
}

/// One demodulation band for the line amplitudes of all records: that of the named record of the highest
/// probability, without any the widest that all records contain.
pub fn common_band(records: &[TrendRecord]) -> Option<(f64, f64)> {
    let states = || records.iter().filter_map(|r| r.state.as_ref());
    let half = states().map(|s| 0.5 * s.sample_rate).reduce(f64::min)?;
    let named = states().filter_map(|s| s.diagnosis.as_ref()).filter(|found| found.part.is_some());
    // The first of equal ones.
    let best = named.reduce(|best, found| if found.probability > best.probability { found } else { best });
    Some(best.map_or((0.0, half), |found| found.band))
}

/// Sorts the records along the axis, those without a position at the end, and tests every quantity for a trend.
///
/// A change is stated if it is significant among all quantities together (Holm's step-down procedure, 5 %).
pub fn complete(mut out: TrendResult) -> TrendResult {
    out.records.sort_by(|a, b| a.position.total_cmp(&b.position));
    let states = || out.records.iter().filter_map(|r| r.state.as_ref());
    out.unit = match (out.has_one_unit(), states().next()) {
        (true, Some(first)) => first.unit.clone(),
        _ => String::new(),
    };
    out.changes = changes(&out);
    out.statements = statements(&out);
    out
}

fn changes(of: &TrendResult) -> Vec<Change> {
    let positions: Vec<f64> = of.records.iter().map(|r| r.position).collect();
    let mut found: Vec<Change> = Vec::new();
    for quantity in of.quantities() {
        let known = positions.iter().zip(&quantity.values).filter(|(x, y)| x.is_finite() && y.is_finite());
        let (x, y): (Vec<f64>, Vec<f64>) = known.map(|(x, y)| (*x, *y)).unzip();
        // Finite values of equal number are no error.
        if let Ok(Some(trend)) = trend(&x, &y) {
            let (quantity, unit) = (quantity.name, quantity.unit);
            found.push(Change { quantity, unit, trend, significant: false });
        }
    }
    let mut order: Vec<usize> = (0..found.len()).collect();
    order.sort_by(|&a, &b| found[a].trend.p_value.total_cmp(&found[b].trend.p_value));
    for (rank, &k) in order.iter().enumerate() {
        if found[k].trend.p_value > SIGNIFICANCE / (order.len() - rank) as f64 {
            break;
        }
        found[k].significant = true;
    }
    found
}

fn statements(of: &TrendResult) -> Vec<String> {
    let mut out: Vec<String> = of
        .changes
        .iter()
        .filter(|change| change.significant)
        .map(|c| change_statement(c, &of.axis))
        .collect();
    let judged = of.records.iter().filter(|r| r.state.is_some() && r.position.is_finite()).count();
    let needed = records_needed(of.changes.len().max(1));
    if judged < needed {
        let plural = if judged == 1 { "" } else { "s" };
        out.push(format!(
            "{judged} record{plural}: too few to tell a trend from chance ({needed} or more are needed)"
        ));
    } else if out.is_empty() {
        out.push(format!(
            "no quantity has a significant trend over {} ({judged} records, Mann-Kendall test at 5 % for all together)",
            of.axis.name
        ));
    }
    out.extend(named_parts(of));
    out
}

/// Fewest records whose strictly monotonic order is significant among `tests` quantities: 2/n! < 5 %/tests.
fn records_needed(tests: usize) -> usize {
    let mut factorial = 6.0;
    (4..)
        .find(|&n| {
            factorial *= n as f64;
            2.0 / factorial < SIGNIFICANCE / tests as f64
        })
        .unwrap_or(usize::MAX)
}

fn change_statement(change: &Change, axis: &TrendAxis) -> String {
    let Change { quantity, unit, trend, .. } = change;
    let verb = if trend.tau > 0.0 { "rises" } else { "falls" };
    let ends = trend.ends.map(|value| number(value, 3));
    let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
    let [first, last] = trend.end_counts;
    let [low, high] = trend.slope_interval.map(|slope| number(slope, 2));
    let per = if axis.unit.is_empty() { axis.name.as_str() } else { axis.unit.as_str() };
    let chance = if trend.p_value < 1e-4 {
        "p below 0.0001".to_string()
    } else {
        format!("p = {}", number(trend.p_value, 2))
    };
    format!(
        "{quantity} {verb} from {} to {}{unit} (medians of the first {first} and the last {last} records): {} per {per}, 95 %: \
         {low} to {high}, {chance}",
        ends[0],
        ends[1],
        number(trend.slope, 2)
    )
}

/// In which records each part is named.
fn named_parts(of: &TrendResult) -> Vec<String> {
    let judged: Vec<(&TrendRecord, &RecordDiagnosis)> =
        of.records.iter().filter_map(|r| Some((r, r.state.as_ref()?.diagnosis.as_ref()?))).collect();
    let all = judged.len();
    let mut out = Vec::new();
    for part in BearingPart::ALL {
        let named: Vec<usize> = (0..all).filter(|&k| judged[k].1.part == Some(part)).collect();
        let (Some(&first), Some(&last)) = (named.first(), named.last()) else { continue };
        let count = named.len();
        let highest = named.iter().map(|&k| judged[k].1.probability).fold(0.0, f64::max);
        let highest = if count == 1 && highest <= 0.99 {
            format!("{:.0} %", 100.0 * highest)
        } else if highest > 0.99 {
            "above 99 %".to_string()
        } else {
            format!("up to {:.0} %", 100.0 * highest)
        };
        let name = |k: usize| &judged[k].0.name;
        let without = named.iter().rev().enumerate().take_while(|(back, k)| **k == all - 1 - back).count();
        let place = if count == all {
            if all == 1 { format!("in {}", name(first)) } else { format!("in all {all} records") }
        } else if last + 1 == all && count == 1 {
            format!("in the last record only ({})", name(last))
        } else if last + 1 == all {
            let from = all - without;
            let before = match count - without {
                0 => String::new(),
                1 => format!(", once before ({})", name(first)),
                n => format!(", {n} times before (first in {})", name(first)),
            };
            format!("from record {} ({}) on{before}", from + 1, name(from))
        } else if count == 1 {
            format!("in 1 of {all} records ({}), not in the last", name(first))
        } else {
            format!(
                "in {count} of {all} records (first {}, last {}), not in the last",
                name(first),
                name(last)
            )
        };
        let grades: Vec<f64> = named.iter().map(|&k| judged[k].1.probability).collect();
        let chance = chance_of_names(&grades, all);
        let chance = match all > 1 && chance > CHANCE {
            true => {
                format!(
                    "; {all} healthy records give as many with a probability of up to {:.0} %",
                    100.0 * chance
                )
            }
            false => String::new(),
        };
        out.push(format!("{} named {place}, {highest}{chance}", part.name()));
    }
    if out.is_empty() && all > 0 {
        out.push(format!("no part is named in {all} judged record{}", if all == 1 { "" } else { "s" }));
    }
    out
}

/// Probability that healthy records give as many names of these grades, the smaller one of both limits (Bonferroni).
fn chance_of_names(grades: &[f64], records: usize) -> f64 {
    let tail = |(limit, share): (f64, f64)| {
        let named = grades.iter().filter(|grade| **grade >= limit).count();
        1.0 - (0..named).map(|k| binomial(records, k, share)).sum::<f64>()
    };
    let least = FALSE_NAMES.into_iter().map(tail).fold(1.0, f64::min);
    (FALSE_NAMES.len() as f64 * least).min(1.0)
}

/// Probability of k of n events of probability p.
fn binomial(n: usize, k: usize, p: f64) -> f64 {
    let ways: f64 = (0..k).map(|i| ((n - i) as f64 / (k - i) as f64).ln()).sum();
    (ways + k as f64 * p.ln() + (n - k) as f64 * (-p).ln_1p()).exp()
}

/// What keeps the records from being comparable, one sentence each.
pub fn differences(records: &[TrendRecord], plain_channel: impl Fn(&str) -> String) -> Vec<String> {
    let mut out = Vec::new();
    let states: Vec<(&str, &RecordState)> =
        records.iter().filter_map(|r| Some((r.name.as_str(), r.state.as_ref()?))).collect();
    let mut compare = |what: &str, consequence: &str, of: &dyn Fn(&RecordState) -> String| {
        let mut groups: Vec<(String, Vec<&str>)> = Vec::new();
        for (name, state) in &states {
            let value = of(state);
            match groups.iter_mut().find(|(known, _)| *known == value) {
                Some((_, names)) => names.push(name),
                None => groups.push((value, vec![name])),
            }
        }
        if groups.len() < 2 {
            return;
        }
        groups.sort_by_key(|(_, names)| std::cmp::Reverse(names.len()));
        let mut texts: Vec<String> =
            groups.iter().take(MAX_NAMES).map(|(value, names)| format!("{value} ({})", few(names))).collect();
        if groups.len() > MAX_NAMES {
            texts.push(format!("{} more", groups.len() - MAX_NAMES));
        }
        out.push(format!("{what} differ between the records: {}; {consequence}", texts.join(", ")));
    };
    compare("sampling rates", "crest factor, kurtosis, RMS and line amplitudes depend on them", &|s| {
        format!("{} Hz", s.sample_rate)
    });
    compare("units", "levels are not compared", &|s| {
        if s.unit.is_empty() { "no unit".into() } else { s.unit.clone() }
    });
    compare("channels", "each place has its own level", &|s| plain_channel(&s.channel));
    let durations: Vec<f64> = states.iter().map(|(_, s)| s.samples as f64 / s.sample_rate).collect();
    let [shortest, longest] = [f64::min, f64::max].map(|of| durations.iter().copied().reduce(of));
    if let (Some(shortest), Some(longest)) = (shortest, longest)
        && longest > LENGTH_RATIO * shortest
    {
        let at = |length: f64| durations.iter().position(|d| *d == length).map_or("", |k| states[k].0);
        out.push(format!(
            "durations differ between the records: {} s ({}) to {} s ({}); peak, crest factor and the height of lines over the \
             background grow with them",
            number(shortest, 4),
            at(shortest),
            number(longest, 4),
            at(longest)
        ));
    }
    out
}

/// Ratio of durations from which they matter: 1 dB of a line over the background of noise.
const LENGTH_RATIO: f64 = 1.26;

/// A few names, and the number of the others.
fn few(names: &[&str]) -> String {
    match names.len() {
        n if n > MAX_NAMES => format!("{} and {} more", names[..2].join(", "), n - 2),
        _ => names.join(", "),
    }
}

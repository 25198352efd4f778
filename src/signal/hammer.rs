//! FRFs of a hammer test from its time records: blows found and judged, averaged, windowed.

use std::ops::Range;

use super::blow::{Inspection, Limits, Trigger, inspect};
use super::impact::{Blow, Estimator, FrfEstimate, ImpactWindows, frf_from_blows};
use super::record::{Axis, AxisQuantity, Dof, Kind, Measured, Record, RecordError, Values};
use crate::error::Error;

/// How the records are cut.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HammerTest {
    /// Name of the force's channel; the one in newtons if `None`.
    pub force: Option<String>,
    /// Length of a blow's block \[s\]; up to the next blow if `None`.
    pub block: Option<f64>,
    /// Time constant of an exponential window \[s\].
    pub time_constant: Option<f64>,
    pub estimator: Estimator,
}

/// A blow begins where the force passes this share of its largest value.
const LEVEL: f64 = 0.25;
/// Time kept before it \[s\], at most a tenth of the block.
const BEFORE: f64 = 0.01;
/// Blows nearer to each other are one double hit \[s\].
const APART: f64 = 0.2;
/// So are those nearer than this share of the median gap.
const OF_MEDIAN: f64 = 0.5;
/// A blow is so many times larger than the median |force|: noise and shakers stay below.
const STANDS_OUT: f64 = 10.0;
/// The force counts for at least so long after the contact \[s\], in which filters ring.
const AFTER: f64 = 0.01;

/// FRFs of every response to the force, with coherence where there are several blows; and what deserves a warning.
///
/// `files` hold the same channels at the same points: their blows are averaged. Bad blows (double hits, overloads)
/// are left out, an overloaded response only where it is. Beyond the contact the force is noise and set to zero.
///
/// # Errors
/// No force, records of different rates or lengths, no good blow, NaN.
pub fn frfs(files: &[Measured], test: &HammerTest) -> Result<(Vec<Record>, Vec<String>), Error> {
    let Some(first) = files.first() else { return Ok((Vec::new(), Vec::new())) };
    let time = time_records(first);
    let force = force(first, &time, test)?;
    let rate = force.sample_rate()?;
    let mut warnings = Vec::new();
    let mut blocks = Vec::new();
    for file in files {
        let own = file.record(&force.name)?;
        same_rate(force, own)?;
        finite(own)?;
        blocks.push(self::blocks(own, rate, test, &mut warnings)?);
    }
    // Blocks of all files are of one length.
    let length = blocks.iter().flatten().map(|b| b.len()).min().unwrap_or(0);
    blocks.iter_mut().flatten().for_each(|block| block.end = block.start + length);
    let blows = blocks.iter().map(|own| own.len()).sum();

    let mut out = Vec::new();
    if force.unit != "N" && !force.unit.is_empty() {
        let unit = &force.unit;
        warnings.push(format!(
            "`{}` is in {unit}, not in N: frequencies and damping are right, shapes are for each {unit}",
            force.name
        ));
    }
    let mut forces_said = false;
    let mut single = Vec::new();
    let responses = time.iter().filter(|r| r.name != force.name);
    for (number, response) in responses.enumerate() {
        let windows = ImpactWindows { force_length: None, time_constant: test.time_constant };
        let (_, window) = windows.samples(length, rate)?;
        let Judged { good, faults, contact, left_over } = judged(files, &blocks, force, response, &window)?;
        let of_force = faults.iter().filter_map(|f| force_fault(f, force, rate));
        let of_response = faults.iter().filter_map(response_fault);
        let said: Vec<String> = if forces_said && !good.is_empty() {
            of_response.collect()
        } else {
            of_force.chain(of_response).collect()
        };
        forces_said = true;
        if good.is_empty() {
            let channel = force.name.clone();
            return Err(RecordError::NoGoodBlow { channel, blows, faults: said.join("; ") }.into());
        }
        warnings.extend(said);
        if good.len() == 1 {
            single.push(format!("`{}`", response.name));
        }
        if left_over > 0.0 {
            warnings.push(format!(
                "`{}` has not died away: {:.0} % of its peak is left at the end of a block; take longer blocks \
                 (--block), or an exponential window (--window)",
                response.name,
                100.0 * left_over
            ));
        }
        let after = (AFTER * rate).round() as usize;
        let windows = ImpactWindows { force_length: Some(2 * contact + after), ..windows };
        let estimate = frf_from_blows(&good, rate, windows)?;
        out.extend(records(force, response, number, estimate, good.len(), test.estimator));
    }
    if out.is_empty() {
        let found = time.iter().map(|r| r.name.as_str()).collect::<Vec<_>>().join(", ");
        return Err(RecordError::NoResponse { found }.into());
    }
    if !single.is_empty() {
        warnings.push(format!(
            "there is one good blow only for {}, which tells no coherence and averages no noise; strike several times",
            single.join(", ")
        ));
    }
    Ok((out, warnings))
}

/// The blows of one response.
#[derive(Default)]
struct Judged<'a> {
    good: Vec<Blow<'a>>,
    faults: Vec<Seen<'a>>,
    /// Samples of a block up to the end of the longest contact.
    contact: usize,
    /// Largest share of a good blow's peak at its end, where it is too much.
    left_over: f64,
}

fn judged<'a>(
    files: &'a [Measured],
    blocks: &[Vec<Range<usize>>],
    force: &Record,
    response: &'a Record,
    window: &[f64],
) -> Result<Judged<'a>, Error> {
    let mut out = Judged::default();
    let rate = force.sample_rate()?;
    for (file, blocks) in files.iter().zip(blocks) {
        let (force, own) = (file.record(&force.name)?, file.record(&response.name)?);
        same_rate(force, own)?;
        if force.values.len() != own.values.len() {
            return Err(RecordError::axes_differ(force, own).into());
        }
        finite(own)?;
        let (samples, values) = (force.time_samples()?, own.time_samples()?);
        for block in blocks {
            let blow = Blow { force: &samples[block.clone()], response: &values[block.clone()] };
            let seen = inspect(&blow, &Limits::default(), Some(window))?;
            if seen.is_good() {
                out.contact = out.contact.max(seen.contact.end);
                out.left_over = out.left_over.max(if seen.cut_off { seen.left_over } else { 0.0 });
                out.good.push(blow);
            }
            let start = force.axis.start() + block.start as f64 / rate;
            out.faults.push((out.faults.len() + 1, start, seen, &response.name));
        }
    }
    Ok(out)
}

/// Number of a blow, time of its block's start \[s\], what it is like, and the response.
type Seen<'a> = (usize, f64, Inspection, &'a str);

fn force_fault(&(number, start, ref seen, _): &Seen, force: &Record, rate: f64) -> Option<String> {
    let at = start + seen.peak.0 as f64 / rate;
    let blow = format!("blow {number} of `{}` at {at:.3} s is left out", force.name);
    if seen.overload[0].is_some() {
        return Some(format!(
            "{blow}: the force is beyond its range, it stays at {} {}; strike softer, or choose a larger range",
            digits(seen.peak.1),
            force.unit
        ));
    }
    let second = seen.double_hit? as f64 / rate + start - at;
    let word = if second > 0.0 { "after" } else { "before" };
    Some(format!("{blow}: a double hit, there is another {:.3} s {word} it; strike again", second.abs()))
}

fn response_fault(&(number, start, ref seen, name): &Seen) -> Option<String> {
    let own = seen.overload[1].is_some() && seen.overload[0].is_none() && seen.double_hit.is_none();
    own.then(|| {
        format!(
            "blow {number} at {start:.3} s is left out for `{name}`: it is beyond its range; strike softer, or choose \
             a larger range"
        )
    })
}

fn time_records(measured: &Measured) -> Vec<&Record> {
    measured.records.iter().filter(|r| r.kind == Kind::Time).collect()
}

/// Refuses two channels of different rates.
fn same_rate(first: &Record, other: &Record) -> Result<(), RecordError> {
    match (other.sample_rate()? / first.sample_rate()? - 1.0).abs() > 1e-9 {
        true => Err(RecordError::axes_differ(first, other)),
        false => Ok(()),
    }
}

fn finite(record: &Record) -> Result<(), RecordError> {
    match record.values.not_finite() {
        Some((_, index)) => Err(RecordError::NotFinite { channel: record.name.clone(), index }),
        None => Ok(()),
    }
}

fn force<'a>(
    measured: &'a Measured,
    time: &[&'a Record],
    test: &HammerTest,
) -> Result<&'a Record, RecordError> {
    if let Some(name) = &test.force {
        return measured.record(name);
    }
    let forces: Vec<&Record> = time.iter().copied().filter(|r| r.unit == "N").collect();
    match forces[..] {
        [force] => Ok(force),
        [] => {
            let describe = |r: &&Record| {
                let unit = if r.unit.is_empty() { "unit unknown" } else { r.unit.as_str() };
                format!("{} [{unit}]", r.name)
            };
            Err(RecordError::NoForce { found: time.iter().map(describe).collect::<Vec<_>>().join(", ") })
        }
        _ => {
            let found: Vec<&str> = forces.iter().map(|r| r.name.as_str()).collect();
            Err(RecordError::SeveralForces { found: found.join(", ") })
        }
    }
}

/// Ranges of samples of the blows, all of one length.
fn blocks(
    record: &Record,
    rate: f64,
    test: &HammerTest,
    warnings: &mut Vec<String>,
) -> Result<Vec<Range<usize>>, Error> {
    let force = record.time_samples()?;
    let samples = |seconds: f64| (seconds * rate).round().max(1.0) as usize;
    let largest = force.iter().fold(0.0, |m: f64, f| m.max(f.abs()));
    let median = median(force.iter().map(|f| f.abs()).collect());
    if largest <= STANDS_OUT * median {
        let (channel, unit) = (record.name.clone(), record.unit.clone());
        let (largest, median) = (digits(largest), digits(median));
        return Err(RecordError::NoBlow { channel, largest, median, unit }.into());
    }
    // Second hits belong to the first.
    let starts = starts(force, LEVEL * largest, samples(APART));
    let gaps: Vec<f64> = starts.windows(2).map(|pair| (pair[1] - pair[0]) as f64).collect();
    let least = OF_MEDIAN * self::median(gaps.clone());
    let rest = starts.last().map_or(0, |last| force.len() - last) as f64;
    let usual = gaps.iter().copied().filter(|gap| *gap >= least).fold(f64::INFINITY, f64::min);
    let length = match test.block {
        Some(seconds) => samples(seconds),
        None if rest >= least => usual.min(rest) as usize,
        None => usual as usize,
    };
    let before = samples(BEFORE).min(length / 10).min(starts[0]);
    if starts[0] - before + length > force.len() {
        let (channel, seconds) = (record.name.clone(), (force.len() - starts[0]) as f64 / rate);
        return Err(RecordError::ShortRecord { channel, block: length as f64 / rate, seconds }.into());
    }
    let blocks = Trigger { level: LEVEL, before, length }.find(force)?;
    let end = blocks.last().map_or(0, |b| b.end);
    if let Some(start) = starts.iter().find(|start| **start >= end) {
        warnings.push(format!(
            "the blow of `{}` at {:.3} s is left out: the record ends before its block of {:.3} s",
            record.name,
            record.axis.start() + *start as f64 / rate,
            length as f64 / rate
        ));
    }
    Ok(blocks)
}

/// Samples where |force| passes the level, `apart` or more from each other.
fn starts(force: &[f64], level: f64, apart: usize) -> Vec<usize> {
    let mut found: Vec<usize> = Vec::new();
    for (n, f) in force.iter().enumerate() {
        if f.abs() >= level && found.last().is_none_or(|last| n >= last + apart) {
            found.push(n);
        }
    }
    found
}

/// A number to four digits.
fn digits(value: f64) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return value;
    }
    let scale = 10f64.powi(3 - value.abs().log10().floor() as i32);
    (value * scale).round() / scale
}

/// The middle value; 0 of none.
fn median(mut values: Vec<f64>) -> f64 {
    let middle = values.len() / 2;
    if values.is_empty() { 0.0 } else { *values.select_nth_unstable_by(middle, f64::total_cmp).1 }
}

fn records(
    force: &Record,
    response: &Record,
    number: usize,
    found: FrfEstimate,
    blows: usize,
    estimator: Estimator,
) -> Vec<Record> {
    let step = found.frequencies.get(1).copied().unwrap_or(1.0);
    let axis = Axis::even(AxisQuantity::Frequency, 0.0, step);
    let name = format!("{}/{}", response.name, force.name);
    let unit = match (response.unit.as_str(), force.unit.as_str()) {
        ("", _) | (_, "") => String::new(),
        (moved, pushed) if moved.contains('/') => format!("({moved})/{pushed}"),
        (moved, pushed) => format!("{moved}/{pushed}"),
    };
    let own = |record: &Record, number: usize| match record.response {
        Dof::NONE => Dof::new(number as i64, 0),
        dof => dof,
    };
    let place = |record: Record| Record {
        response: own(response, number + 1),
        reference: own(force, 0),
        speed_rpm: response.speed_rpm,
        date: response.date.clone(),
        ..record
    };
    let values = match estimator {
        Estimator::H1 => found.h1,
        Estimator::H2 => found.h2,
        Estimator::Hv => found.hv,
    };
    let mut out = vec![place(Record::new(&name, Kind::Frf, axis.clone(), Values::Complex(values), &unit))];
    if blows > 1 {
        let name = format!("coherence {name}");
        out.push(place(Record::new(&name, Kind::Coherence, axis, Values::Real(found.coherence), "1")));
    }
    out
}

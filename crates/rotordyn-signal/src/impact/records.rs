//! FRFs of an impact test from its time records: detection of hits, rejection, windows, averaging.

use std::ops::Range;

use super::frf::{Estimator, FrfEstimate, ImpactWindows, frf_from_hits};
use super::quality::{HitQuality, Limits, inspect};
use super::{Hit, Trigger};
use crate::record::{Axis, AxisQuantity, Dof, Kind, MeasuredData, Record, RecordError, Values};
use crate::statistics::median;

/// Settings of an impact test.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ImpactTest {
    /// Name of the force channel; `None`: the channel in newtons.
    pub force: Option<String>,
    /// Block length after a hit \[s\]; `None`: up to the next hit.
    pub block: Option<f64>,
    /// Time constant of an exponential window \[s\].
    pub time_constant: Option<f64>,
    pub estimator: Estimator,
}

/// Trigger level, as a fraction of the largest force.
const LEVEL: f64 = 0.25;
/// Pre-trigger time \[s\], at most a tenth of the block.
const BEFORE: f64 = 0.01;
/// Smallest spacing of two hits \[s\]; closer ones are a double hit.
const APART: f64 = 0.2;
/// The same, as a fraction of the median spacing.
const OF_MEDIAN: f64 = 0.5;
/// Smallest ratio of a hit to the median |force|; noise and shaker excitation stay below.
const STANDS_OUT: f64 = 10.0;
/// Shortest force window after the contact \[s\], to include filter ringing.
const AFTER: f64 = 0.01;

/// FRFs of all responses to the force, with coherence for several hits, and quality warnings.
///
/// `files` have the same channels at the same points: their hits are averaged. Double hits and hits with force
/// overload are rejected, hits with response overload only for that response. After the contact the force is set
/// to zero (force window), unless it has the undershoot of an AC-coupled input. Offsets of the channels, what they read before the
/// hits, are removed.
///
/// # Errors
/// No force, records of different rates or lengths, no usable hit, NaN.
pub fn frfs(files: &[MeasuredData], test: &ImpactTest) -> Result<(Vec<Record>, Vec<String>), RecordError> {
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
    // One block length for all files.
    let length = blocks.iter().flatten().map(|b| b.len()).min().unwrap_or(0);
    blocks.iter_mut().flatten().for_each(|block| block.end = block.start + length);
    let hits = blocks.iter().map(|own| own.len()).sum();

    let mut out = Vec::new();
    if force.unit != "N" && !force.unit.is_empty() {
        let unit = &force.unit;
        warnings.push(format!(
            "`{}` is in {unit}, not in N: frequencies and damping are not affected, shapes are per {unit}",
            force.name
        ));
    }
    let mut force_reported = false;
    let mut undershoot_reported = false;
    let mut single = Vec::new();
    let responses = time.iter().filter(|r| r.name != force.name);
    for (number, response) in responses.enumerate() {
        let windows = ImpactWindows { force_length: None, time_constant: test.time_constant };
        let (_, window) = windows.samples(length, rate)?;
        let HitSet { good, inspected, contact, residual } =
            inspect_all(files, &blocks, force, response, &window)?;
        let of_force = inspected.iter().filter_map(|hit| hit.force_fault(force, rate));
        let of_response = inspected.iter().filter_map(Inspected::response_fault);
        let faults: Vec<String> = if force_reported && !good.is_empty() {
            of_response.collect()
        } else {
            of_force.chain(of_response).collect()
        };
        force_reported = true;
        if good.is_empty() {
            let channel = force.name.clone();
            return Err(RecordError::NoGoodHit { channel, hits, faults: faults.join("; ") });
        }
        warnings.extend(faults);
        if good.len() == 1 {
            single.push(format!("`{}`", response.name));
        }
        if residual > 0.0 {
            warnings.push(format!(
                "`{}` is truncated: {:.0} % of its motion is left at the end of a block; take longer blocks (--block), or \
                 an exponential window (--exponential-window)",
                response.name,
                100.0 * residual
            ));
        }
        let after = (AFTER * rate).round() as usize;
        let kept = 2 * contact + after;
        // The part of an undershoot that a window cuts off belongs to the force: all channels of an AC-coupled recorder have it.
        let undershoot = median_undershoot(&good, kept, rate);
        if let Some(share) = undershoot.filter(|_| !undershoot_reported) {
            undershoot_reported = true;
            warnings.push(format!(
                "`{}` swings below zero after the hits by {:.0} % of their impulse, as AC-coupled inputs do: no force window is \
                 applied; with DC coupling, or a lower corner frequency, the FRFs have less noise",
                force.name,
                100.0 * share
            ));
        }
        let force_length = undershoot.is_none().then_some(kept);
        let windows = ImpactWindows { force_length, ..windows };
        let hits: Vec<Hit> = good.iter().map(OwnHit::as_hit).collect();
        let estimate = frf_from_hits(&hits, rate, windows)?;
        out.extend(records(force, response, number, estimate, good.len(), test.estimator));
    }
    if out.is_empty() {
        let found = time.iter().map(|r| r.name.as_str()).collect::<Vec<_>>().join(", ");
        return Err(RecordError::NoResponse { found });
    }
    if !single.is_empty() {
        warnings.push(format!(
            "only one usable hit for {}: no coherence and no averaging of noise; take several hits",
            single.join(", ")
        ));
    }
    Ok((out, warnings))
}

/// Time after the hit \[s\] in which an undershoot is looked for, the share of the impulse from which it matters, and its least
/// distance from 0 in standard errors.
const UNDERSHOOT_TIME: f64 = 0.5;
const UNDERSHOOT: f64 = 0.02;
const CLEAR_UNDERSHOOT: f64 = 6.0;

/// Share of the impulse of the hits that is undershoot after their first `kept` samples, of the median hit; `None` without one.
fn median_undershoot(hits: &[OwnHit], kept: usize, rate: f64) -> Option<f64> {
    let share = |hit: &OwnHit| {
        let (pulse, after) = hit.force.split_at(kept.min(hit.force.len()));
        let after = &after[..after.len().min((UNDERSHOOT_TIME * rate).round() as usize)];
        let count = after.len().max(1) as f64;
        // Noise from the differences of neighbours, to which a slow swing adds nothing; with that of the offset taken off.
        let noise = (after.windows(2).map(|w| 0.5 * (w[1] - w[0]).powi(2)).sum::<f64>() / count).sqrt();
        let of_offset = MEDIAN_ERROR * noise / (QUIET * rate).max(1.0).sqrt();
        let error = noise * count.sqrt() + of_offset * count;
        let (impulse, swing) = (pulse.iter().sum::<f64>(), after.iter().sum::<f64>());
        if swing.abs() > CLEAR_UNDERSHOOT * error && impulse != 0.0 { -swing / impulse } else { 0.0 }
    };
    let share = median(hits.iter().map(share).collect());
    (share > UNDERSHOOT).then_some(share)
}

/// A hit without the offsets of its channels.
struct OwnHit {
    force: Vec<f64>,
    response: Vec<f64>,
}

impl OwnHit {
    fn as_hit(&self) -> Hit<'_> {
        Hit { force: &self.force, response: &self.response }
    }
}

/// Time before a block \[s\] in which a channel rests, and the least number of samples there.
const QUIET: f64 = 0.2;
const MIN_QUIET: usize = 16;

/// Offset of a force over its standard error, and of a response over the deviation of its motion, from which it is one.
const OF_FORCE: f64 = 6.0;
const OF_RESPONSE: f64 = 3.0;

/// Standard error of a median of normal deviates over that of their mean.
const MEDIAN_ERROR: f64 = 1.2533;

/// Median of samples at rest, and the deviation about it.
fn rest(quiet: &[f64]) -> [f64; 2] {
    let middle = median(quiet.to_vec());
    [middle, 1.4826 * median(quiet.iter().map(|v| (v - middle).abs()).collect())]
}

/// Offset of a force at rest; 0 if noise may have made it.
fn force_offset(quiet: &[f64]) -> f64 {
    let [middle, deviation] = rest(quiet);
    let error = MEDIAN_ERROR * deviation / (quiet.len().max(1) as f64).sqrt();
    if middle.abs() > OF_FORCE * error { middle } else { 0.0 }
}

/// Offset of a response; 0 if it may be of the motion that the hit before has left.
fn response_offset(quiet: &[f64]) -> f64 {
    let [middle, deviation] = rest(quiet);
    if middle.abs() > OF_RESPONSE * deviation { middle } else { 0.0 }
}

/// A block without the offset of its channel, what it reads before the block; that of the record if it begins there.
///
/// The force window keeps an offset over its length only: the force would have another spectrum. An exponential window turns
/// that of a response into a decay.
fn without_offset(
    samples: &[f64],
    block: &Range<usize>,
    rate: f64,
    offset: impl Fn(&[f64]) -> f64,
) -> Vec<f64> {
    let quiet = block.start.saturating_sub((QUIET * rate).round() as usize)..block.start;
    let offset = offset(if quiet.len() < MIN_QUIET { samples } else { &samples[quiet] });
    samples[block.clone()].iter().map(|v| v - offset).collect()
}

/// The hits of one response.
#[derive(Default)]
struct HitSet<'a> {
    good: Vec<OwnHit>,
    inspected: Vec<Inspected<'a>>,
    /// Samples of a block up to the end of the longest contact.
    contact: usize,
    /// Largest residual of the usable hits that exceeds the limit; else 0.
    residual: f64,
}

fn inspect_all<'a>(
    files: &'a [MeasuredData],
    blocks: &[Vec<Range<usize>>],
    force: &Record,
    response: &'a Record,
    window: &[f64],
) -> Result<HitSet<'a>, RecordError> {
    let mut out = HitSet::default();
    let rate = force.sample_rate()?;
    for (file, blocks) in files.iter().zip(blocks) {
        let (force, own) = (file.record(&force.name)?, file.record(&response.name)?);
        same_rate(force, own)?;
        if force.values.len() != own.values.len() {
            return Err(RecordError::axes_differ(force, own));
        }
        finite(own)?;
        let (samples, values) = (force.time_samples()?, own.time_samples()?);
        for block in blocks {
            let hit = OwnHit {
                force: without_offset(samples, block, rate, force_offset),
                response: without_offset(values, block, rate, response_offset),
            };
            let quality = inspect(&hit.as_hit(), &Limits::default(), Some(window))?;
            if quality.is_good() {
                out.contact = out.contact.max(quality.contact.end);
                out.residual = out.residual.max(if quality.truncated { quality.residual } else { 0.0 });
                out.good.push(hit);
            }
            out.inspected.push(Inspected {
                number: out.inspected.len() + 1,
                start: force.axis.start() + block.start as f64 / rate,
                quality,
                response: &response.name,
            });
        }
    }
    Ok(out)
}

/// A hit with its quality in one response.
struct Inspected<'a> {
    number: usize,
    /// Start of its block \[s\].
    start: f64,
    quality: HitQuality,
    response: &'a str,
}

impl Inspected<'_> {
    fn force_fault(&self, force: &Record, rate: f64) -> Option<String> {
        let at = self.start + self.quality.peak.0 as f64 / rate;
        let hit = format!("hit {} of `{}` at {at:.3} s is left out", self.number, force.name);
        if self.quality.overload[0].is_some() {
            return Some(format!(
                "{hit}: overload, the force stays at {} {}; hit more softly, or choose a larger range",
                digits(self.quality.peak.1),
                force.unit
            ));
        }
        let second = self.quality.double_hit? as f64 / rate + self.start - at;
        let side = if second > 0.0 { "after" } else { "before" };
        Some(format!("{hit}: double hit, the other {:.3} s {side} it; repeat the hit", second.abs()))
    }

    fn response_fault(&self) -> Option<String> {
        let HitQuality { overload, double_hit, .. } = &self.quality;
        let own = overload[1].is_some() && overload[0].is_none() && double_hit.is_none();
        own.then(|| {
            format!(
                "hit {} at {:.3} s is left out for `{}`: overload; hit more softly, or choose a larger range",
                self.number, self.start, self.response
            )
        })
    }
}

fn time_records(measured: &MeasuredData) -> Vec<&Record> {
    measured.records.iter().filter(|r| r.kind == Kind::Time).collect()
}

/// Error for two channels with different sampling rates.
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
    measured: &'a MeasuredData,
    time: &[&'a Record],
    test: &ImpactTest,
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

/// Sample ranges of the hits, all of the same length.
fn blocks(
    record: &Record,
    rate: f64,
    test: &ImpactTest,
    warnings: &mut Vec<String>,
) -> Result<Vec<Range<usize>>, RecordError> {
    let force = record.time_samples()?;
    let offset = force_offset(force);
    let force: &[f64] = &force.iter().map(|f| f - offset).collect::<Vec<_>>();
    let samples = |seconds: f64| (seconds * rate).round().max(1.0) as usize;
    let largest = force.iter().fold(0.0, |m: f64, f| m.max(f.abs()));
    let usual_size = median(force.iter().map(|f| f.abs()).collect());
    if largest <= STANDS_OUT * usual_size {
        let (channel, unit) = (record.name.clone(), record.unit.clone());
        let (largest, median) = (digits(largest), digits(usual_size));
        return Err(RecordError::NoHit { channel, largest, median, unit });
    }
    // A double hit counts as one.
    let starts = starts(force, LEVEL * largest, samples(APART));
    let gaps: Vec<f64> = starts.windows(2).map(|pair| (pair[1] - pair[0]) as f64).collect();
    let least = OF_MEDIAN * median(gaps.clone());
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
        return Err(RecordError::ShortRecord { channel, block: length as f64 / rate, seconds });
    }
    let blocks = Trigger { level: LEVEL, before, length }.find(force)?;
    let end = blocks.last().map_or(0, |b| b.end);
    if let Some(start) = starts.iter().find(|start| **start >= end) {
        warnings.push(format!(
            "the hit of `{}` at {:.3} s is left out: the record ends before its block of {:.3} s",
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

/// Number with four digits.
fn digits(value: f64) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return value;
    }
    let scale = 10f64.powi(3 - value.abs().log10().floor() as i32);
    (value * scale).round() / scale
}

fn records(
    force: &Record,
    response: &Record,
    number: usize,
    found: FrfEstimate,
    hits: usize,
    estimator: Estimator,
) -> Vec<Record> {
    let step = found.frequencies.get(1).copied().unwrap_or(1.0);
    let axis = Axis::uniform(AxisQuantity::Frequency, 0.0, step);
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
    if hits > 1 {
        let name = format!("coherence {name}");
        out.push(place(Record::new(&name, Kind::Coherence, axis, Values::Real(found.coherence), "1")));
    }
    out
}

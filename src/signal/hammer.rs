//! FRFs of a hammer test from its time records: blows found and judged, averaged, windowed.

use super::blow::{Limits, Trigger, inspect};
use super::impact::{Blow, FrfEstimate, ImpactWindows, frf_from_blows};
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
}

/// A blow begins where the force passes this share of its largest value.
const LEVEL: f64 = 0.25;
/// Time kept before it \[s\], at most a tenth of the block.
const BEFORE: f64 = 0.01;
/// Blows nearer to each other are one double hit \[s\].
const APART: f64 = 0.2;

/// H₁ of every response to the force, with coherence where there are several blows; and what deserves a warning.
///
/// Bad blows (double hits, overloads) are left out.
///
/// # Errors
/// No force, records of different rates or lengths, no good blow, NaN.
pub fn frfs(measured: &Measured, test: &HammerTest) -> Result<(Vec<Record>, Vec<String>), Error> {
    let time: Vec<&Record> = measured.records.iter().filter(|r| r.kind == Kind::Time).collect();
    let force = force(measured, &time, test)?;
    let rate = force.sample_rate()?;
    let samples = force.time_samples()?;
    let blocks = blocks(samples, rate, test)?;
    let mut warnings = Vec::new();
    let mut out = Vec::new();
    let responses = time.iter().filter(|r| r.name != force.name);
    for (number, response) in responses.enumerate() {
        let values = response.time_samples()?;
        if values.len() != samples.len() || (response.sample_rate()? / rate - 1.0).abs() > 1e-9 {
            return Err(RecordError::axes_differ(force, response).into());
        }
        let mut good = Vec::new();
        let mut faults = Vec::new();
        let mut contact = 0;
        let windows = ImpactWindows { force_length: None, time_constant: test.time_constant };
        for (k, block) in blocks.iter().enumerate() {
            let blow = Blow { force: &samples[block.clone()], response: &values[block.clone()] };
            let (_, window) = windows.samples(block.len(), rate)?;
            let seen = inspect(&blow, &Limits::default(), Some(&window))?;
            let own = seen
                .faults()
                .into_iter()
                .map(|fault| format!("blow {} to `{}`: {fault}", k + 1, response.name));
            faults.extend(own);
            if seen.is_good() {
                contact = contact.max(seen.contact.end);
                good.push(blow);
            }
        }
        if good.is_empty() {
            let (channel, blows) = (force.name.clone(), blocks.len());
            let faults = if faults.is_empty() { "none was found".into() } else { faults.join("; ") };
            return Err(RecordError::NoGoodBlow { channel, blows, faults }.into());
        }
        warnings.extend(faults);
        // What the hammer's channel holds after the blow is noise.
        let windows = ImpactWindows { force_length: test.time_constant.map(|_| 2 * contact), ..windows };
        let estimate = frf_from_blows(&good, rate, windows)?;
        out.extend(records(force, response, number, estimate, good.len()));
    }
    if out.is_empty() {
        let found = time.iter().map(|r| r.name.as_str()).collect::<Vec<_>>().join(", ");
        return Err(RecordError::NoChannel { name: "response".into(), known: found }.into());
    }
    Ok((out, warnings))
}

fn force<'a>(
    measured: &'a Measured,
    time: &[&'a Record],
    test: &HammerTest,
) -> Result<&'a Record, RecordError> {
    if let Some(name) = &test.force {
        return measured.record(name);
    }
    let mut forces = time.iter().filter(|r| r.unit == "N");
    match (forces.next(), forces.next()) {
        (Some(force), None) => Ok(force),
        _ => {
            let describe = |r: &&Record| {
                let unit = if r.unit.is_empty() { "unit unknown" } else { r.unit.as_str() };
                format!("{} [{unit}]", r.name)
            };
            Err(RecordError::NoForce { found: time.iter().map(describe).collect::<Vec<_>>().join(", ") })
        }
    }
}

/// Ranges of samples of the blows, all of one length.
fn blocks(force: &[f64], rate: f64, test: &HammerTest) -> Result<Vec<std::ops::Range<usize>>, Error> {
    let samples = |seconds: f64| (seconds * rate).round().max(1.0) as usize;
    let length = match test.block {
        Some(seconds) => samples(seconds),
        None => {
            // Blows apart, and from the last one to the end of the record.
            let short = Trigger { level: LEVEL, before: 0, length: samples(APART).min(force.len()) };
            let starts: Vec<usize> = short.find(force)?.iter().map(|r| r.start).collect();
            let gaps = starts.windows(2).map(|pair| pair[1] - pair[0]);
            let last = starts.last().map(|last| force.len() - last);
            gaps.chain(last).min().unwrap_or(force.len())
        }
    };
    let first =
        force.iter().position(|f| f.abs() >= LEVEL * force.iter().fold(0.0, |m: f64, f| m.max(f.abs())));
    let before = samples(BEFORE).min(length / 10).min(first.unwrap_or(0));
    Ok(Trigger { level: LEVEL, before, length: length.min(force.len()) }.find(force)?)
}

fn records(
    force: &Record,
    response: &Record,
    number: usize,
    found: FrfEstimate,
    blows: usize,
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
    let mut out = vec![place(Record::new(&name, Kind::Frf, axis.clone(), Values::Complex(found.h1), &unit))];
    if blows > 1 {
        let name = format!("coherence {name}");
        out.push(place(Record::new(&name, Kind::Coherence, axis, Values::Real(found.coherence), "1")));
    }
    out
}

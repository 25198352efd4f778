//! Shaft angle and speed of a record: from flags, a tachometer, an order line of the record, or the file.

use std::f64::consts::TAU;
use std::path::Path;

use rotordyn::signal::record::{Points, Record};
use rotordyn::signal::tacho::alias::aliased_speed;
use rotordyn::signal::tacho::{PulseTrain, lie_on_the_grid, rising_edges};
use rotordyn::signal::tacho_jitter::Jitter;
use rotordyn::study::signal::{ShaftMotion, SignalChannel};
use rotordyn::units::FREQUENCY;
use rotordyn::warning::Code;

use super::super::args::ShaftArgs;
use super::super::terminal::number;
use super::input::{File, InputProblems, plain_name};
use super::{shared_rate, tacho_marks};

/// Pulses on either side used to smooth tacho jitter, if requested.
const SMOOTHING: usize = 4;
/// Jitter of the shaft angle \[rad\] by the grid of the samples above which it is smoothed unasked: an error of 5 % at 10x.
const GRID_JITTER: f64 = 0.04;
/// Jitter over that of times rounded to samples, up to which it is that.
const OVER_GRID: f64 = 2.0;
/// Share of a record outside the pulses that is named.
const UNCOVERED: f64 = 0.02;
/// Records whose shaft orders are compared with the pulses.
const COMPARED: usize = 4;
/// Trigger hysteresis as a fraction of the tacho signal's range.
const HYSTERESIS: f64 = 0.2;

/// Source of the shaft angle; times are those of the record's file.
pub enum ShaftSource {
    Unknown,
    /// rev/s.
    Steady(f64, String),
    Pulses {
        train: PulseTrain,
        per_revolution: usize,
        /// Pulses on either side over which jitter is smoothed.
        smoothing: Option<usize>,
        source: String,
    },
    Line {
        order: f64,
        range: (f64, f64),
        source: String,
    },
    /// A channel of angles \[rad\] or speeds \[rad/s\].
    Sampled {
        values: Vec<f64>,
        rate: f64,
        start: f64,
        is_angle: bool,
        source: String,
    },
}

impl ShaftSource {
    /// Source from the flags, else from the file; `rate` is used for records without a stated rate.
    pub fn of(
        args: &ShaftArgs,
        rate: Option<&str>,
        file: &File,
        findings: &mut InputProblems,
    ) -> ShaftSource {
        let known = if let Some(name) = &args.tacho {
            tacho(args, name, rate, file, findings)
        } else if let Some(text) = &args.track {
            tracked_line(text, findings)
        } else {
            let channel = stated_channel(file).and_then(|(record, ..)| shared_rate::warning(file, record));
            channel.into_iter().for_each(|text| findings.warn_of(Code::MeasuredData, text));
            stated_in_file(file)
        };
        known.unwrap_or(ShaftSource::Unknown)
    }

    /// The same with the jitter of pulses smoothed over `revolutions` on either side, and four pulses at least.
    pub fn smoothed_over(mut self, revolutions: usize) -> Self {
        if let ShaftSource::Pulses { per_revolution, smoothing, .. } = &mut self {
            *smoothing = Some(SMOOTHING.max(revolutions * *per_revolution));
        }
        self
    }

    /// Whether the shaft speed is known.
    pub fn is_known(&self) -> bool {
        !matches!(self, ShaftSource::Unknown)
    }

    /// Shaft motion at the samples of a channel.
    pub fn motion(&self, channel: &SignalChannel) -> Result<Option<ShaftMotion>, String> {
        let (rate, samples) = (channel.sample_rate, &channel.samples);
        let message = |error: rotordyn::signal::SignalError| error.to_string();
        Ok(Some(match self {
            ShaftSource::Unknown => return Ok(None),
            ShaftSource::Steady(speed, source) => ShaftMotion::constant(*speed, source.clone()),
            ShaftSource::Pulses { train, smoothing, source, .. } => {
                let times = train.times.iter().map(|t| t - channel.start).collect();
                let train = PulseTrain { times, ..train.clone() };
                let source = format!("{source}{}", coverage(&train.times, channel));
                ShaftMotion::from_pulses(&train, rate, samples.len(), *smoothing, source).map_err(message)?
            }
            ShaftSource::Line { order, range, source } => {
                ShaftMotion::from_order_line(samples, rate, *order, *range, source.clone())
                    .map_err(message)?
            }
            ShaftSource::Sampled { values, rate: own, start, is_angle, source } => {
                if values.len() < 2 {
                    return Ok(None);
                }
                // The shaft channel is interpolated linearly unless its samples coincide with those of the
                // record.
                let last = (values.len() - 1) as f64;
                let at = |n: usize| {
                    let place = (channel.start + n as f64 / rate - start) * own;
                    let place = if (place - place.round()).abs() < 1e-6 { place.round() } else { place };
                    let low = place.clamp(0.0, last - 1.0).floor();
                    let part = place.clamp(0.0, last) - low;
                    let (a, b) = (values[low as usize], values[low as usize + 1]);
                    if part == 0.0 { a } else { a + part * (b - a) }
                };
                let values: Vec<f64> = (0..samples.len()).map(at).collect();
                let motion = if *is_angle {
                    ShaftMotion::from_angle(values, 0, rate, source.clone())
                } else {
                    ShaftMotion::from_speed(&values, rate, source.clone()).map_err(message)?
                };
                if motion.summary.mean == 0.0 {
                    return Ok(None);
                }
                motion
            }
        }))
    }
}

/// Which part of a record the pulses cover, if not nearly all of it; `times` from its first sample.
fn coverage(times: &[f64], channel: &SignalChannel) -> String {
    let duration = channel.samples.len() as f64 / channel.sample_rate;
    let [from, to] = [times.first(), times.last()].map(|t| t.copied().unwrap_or(0.0).clamp(0.0, duration));
    // A pulse more might lie at either end.
    let pitch = (to - from) / times.len().max(2) as f64;
    if duration - (to - from) <= (UNCOVERED * duration).max(2.5 * pitch) {
        return String::new();
    }
    let [from, to, start, end] = [from, to, 0.0, duration].map(|t| number(channel.start + t, 4));
    format!("; they cover {from} to {to} s only of the record from {start} to {end} s, the rest is left out")
}

/// Order line to track in the record, `ORDER=LOW .. HIGH`.
fn tracked_line(text: &str, findings: &mut InputProblems) -> Option<ShaftSource> {
    let parts =
        text.split_once('=').and_then(|(order, range)| Some((order.trim().parse::<f64>().ok()?, range)));
    let Some((order, range)) = parts.filter(|(order, _)| *order > 0.0) else {
        findings
            .problem(format!("--track {text}: expected an order and its range, such as 1=\"5 Hz .. 50 Hz\""));
        return None;
    };
    let [low, high] = findings.range("--track", range, FREQUENCY, [0.0, f64::INFINITY])?;
    let source = format!("order {order} tracked between {low} and {high} Hz");
    Some(ShaftSource::Line { order, range: (low, high), source })
}

/// Tacho pulses from a channel of the record or from a separate file.
fn tacho(
    args: &ShaftArgs,
    name: &str,
    rate: Option<&str>,
    file: &File,
    findings: &mut InputProblems,
) -> Option<ShaftSource> {
    let own = file.measured.records.iter().find(|r| r.name == name);
    let other;
    let (record, source) = match own {
        Some(record) => (record, format!("pulses of `{name}`")),
        None if Path::new(name).exists() => {
            other = match File::read(Path::new(name), rate) {
                Ok(other) => other,
                Err(failure) => {
                    findings.problem(format!("--tacho: {}", failure.message()));
                    return None;
                }
            };
            match other.measured.records.as_slice() {
                [record] => (record, format!("pulses in {name}")),
                records => {
                    findings.problem(format!(
                        "--tacho {name}: expected a file with one channel, it has {}",
                        records.len()
                    ));
                    return None;
                }
            }
        }
        None => {
            let problem = file.record(name).err().unwrap_or_default();
            findings.problem(format!("--tacho: there is no such file, and {problem}"));
            return None;
        }
    };
    let (times, sampled_at) = pulse_times(record, rate, findings)?;
    let assumed = own.filter(|_| sampled_at.is_some()).and_then(|record| shared_rate::warning(file, record));
    assumed.into_iter().for_each(|text| findings.warn_of(Code::MeasuredData, text));
    if times.len() < 3 {
        findings.problem(format!(
            "--tacho: `{}` has {} pulses, at least 3 are needed for a speed; check that it is the tacho channel",
            record.name,
            times.len()
        ));
        return None;
    }
    let train = findings.value_or_problem("--tacho: ", PulseTrain::new(&times, args.pulses_per_rev))?;
    if train.missing + train.dropped > 0 {
        findings.warnings.push(format!(
            "tacho: {} missing pulses added and {} false pulses removed, of {}",
            train.missing,
            train.dropped,
            times.len()
        ));
    }
    let marks = tacho_marks::warning(&times, &train, args.pulses_per_rev);
    marks.into_iter().for_each(|text| findings.warn_of(Code::TachoJitter, text));
    for ([from, to], turns) in train.gaps() {
        findings.warn_of(
            Code::RecordGap,
            format!(
                "tacho: no pulses from {} to {} s: the shaft angle there follows the speeds before and behind, {} turns by them; \
                 phases before and behind are no longer one",
                number(from, 5),
                number(to, 5),
                number(turns, 4)
            ),
        );
    }
    if let Some(problem) = train.implausible(times.len()) {
        findings.problem(format!("--tacho `{}`: {problem}; check that it is the tacho channel", record.name));
        return None;
    }
    let mut smoothing = args.smooth_tacho.then_some(SMOOTHING);
    if let Some(pulse_rate) = sampled_at {
        if let Some(samples) = train.unresolved(pulse_rate) {
            findings.problem(format!(
                "--tacho `{}`: its pulses are {samples:.2} samples apart, they are not resolved (at least 3 are needed); sample it \
                 faster, or use fewer pulses per revolution",
                record.name
            ));
            return None;
        }
        let others = file.time_records().filter(|other| other.name != record.name).take(COMPARED);
        let speeds = others.filter_map(|other| true_speed(other, &train, pulse_rate, args.pulses_per_rev));
        if let Some((name, speed)) = speeds.last() {
            findings.warn_of(
                Code::TachoJitter,
                format!(
                    "tacho: its pulses may be aliased: `{name}` has the shaft orders of {} rpm, not those of the pulses; at that \
                     speed there are {} pulses per second, more than half the {} samples per second of the tacho",
                    number(60.0 * speed, 4),
                    number(speed * args.pulses_per_rev as f64, 4),
                    number(pulse_rate, 4)
                ),
            );
        }
        let jitter = Jitter::of_pulses(&train).filter(|jitter| jitter.angle > GRID_JITTER);
        let on_grid = lie_on_the_grid(&train.times, pulse_rate);
        let coarse =
            jitter.filter(|jitter| on_grid && jitter.angle < OVER_GRID * grid_jitter(&train, pulse_rate));
        if let Some(jitter) = coarse.filter(|_| smoothing.is_none()) {
            smoothing = Some(SMOOTHING);
            findings.warn_of(
                Code::TachoJitter,
                format!(
                    "tacho: its pulses are known to a sample of {} ms only, so that the shaft angle jitters by {} deg; it is \
                     smoothed over {SMOOTHING} pulses on either side, to {} deg",
                    number(1000.0 / pulse_rate, 3),
                    number(jitter.angle.to_degrees(), 2),
                    number(jitter.smoothed_angle(SMOOTHING).to_degrees(), 2)
                ),
            );
        }
    }
    let source = format!("{source}, {}", tacho_marks::described(&train, args.pulses_per_rev));
    Some(ShaftSource::Pulses { train, per_revolution: args.pulses_per_rev, smoothing, source })
}

/// Name of a record with the shaft orders of another speed, of which the pulses are an alias, and that speed.
fn true_speed(
    record: &Record,
    train: &PulseTrain,
    pulse_rate: f64,
    per_revolution: usize,
) -> Option<(String, f64)> {
    let (values, rate) = (record.time_samples().ok()?, record.sample_rate().ok()?);
    let start = match record.axis.points {
        Points::Uniform { start, .. } => start,
        _ => 0.0,
    };
    let times: Vec<f64> = train.times.iter().map(|t| t - start).collect();
    let speed = aliased_speed(values, rate, [&times, &train.revolutions], pulse_rate, per_revolution)?;
    Some((record.name.clone(), speed))
}

/// Deviation of the shaft angle \[rad\] at pulses that are known to a sample: ω/(f_s √12) at the highest speed.
fn grid_jitter(train: &PulseTrain, rate: f64) -> f64 {
    let highest = train.speeds_rpm().1.into_iter().fold(0.0, f64::max);
    TAU * highest / 60.0 / rate / 12f64.sqrt()
}

/// Pulse times \[s\]: given as values, or the rising edges of a channel, with its sampling rate \[Hz\].
fn pulse_times(
    record: &Record,
    rate: Option<&str>,
    findings: &mut InputProblems,
) -> Option<(Vec<f64>, Option<f64>)> {
    let values = findings.value_or_problem("--tacho: ", record.time_samples())?;
    let rising = values.windows(2).all(|w| w[1] > w[0]);
    if record.axis.points == Points::Unknown && rising {
        return Some((values.to_vec(), None));
    }
    let rate = match (record.sample_rate(), rate) {
        (Ok(rate), _) => rate,
        (Err(_), Some(text)) => findings.positive("--rate", text, FREQUENCY)?,
        (Err(error), None) => {
            findings.problem(format!("--tacho: {error}"));
            return None;
        }
    };
    let start = match record.axis.points {
        Points::Uniform { start, .. } => start,
        _ => 0.0,
    };
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if low == high {
        findings.problem(format!("--tacho: `{}` is constant ({low}): it contains no pulses", record.name));
        return None;
    }
    let edges = findings.value_or_problem("--tacho: ", rising_edges(values, rate, None, HYSTERESIS))?;
    Some((edges.into_iter().map(|t| t + start).collect(), Some(rate)))
}

/// The channel of the shaft's angle or speed, its factor to rad or rad/s, and whether it is the angle.
fn stated_channel(file: &File) -> Option<(&Record, f64, bool)> {
    let sampled = |unit: &str, names: &[&str]| {
        file.time_records().find(|r| r.unit == unit && names.contains(&plain_name(&r.name).as_str()))
    };
    let names = ["speed", "rpm", "shaft_speed", "shaft speed"];
    let angle = sampled("rad", &["theta", "angle", "shaft_angle"]).map(|r| (r, 1.0, true));
    let speed = || sampled("rad/s", &names).map(|r| (r, 1.0, false));
    angle.or_else(speed).or_else(|| sampled("rpm", &names).map(|r| (r, TAU / 60.0, false)))
}

/// Shaft angle, speed over time or constant speed stated in the file.
pub fn stated_in_file(file: &File) -> Option<ShaftSource> {
    let of = |(record, factor, is_angle): (&Record, f64, bool)| {
        let rate = record.sample_rate().ok()?;
        let start = match record.axis.points {
            Points::Uniform { start, .. } => start,
            _ => 0.0,
        };
        let values = record.time_samples().ok()?.iter().map(|v| v * factor).collect();
        let source = format!("channel `{}`", record.name);
        Some(ShaftSource::Sampled { values, rate, start, is_angle, source })
    };
    let stated = || {
        let of_record = file.time_records().find_map(|r| r.speed_rpm);
        let scalar = |(name, value): &(String, f64)| name.to_lowercase().ends_with("rpm").then_some(*value);
        let rpm = of_record.or_else(|| file.measured.scalars.iter().find_map(scalar))?;
        (rpm > 0.0).then(|| ShaftSource::Steady(rpm / 60.0, "as the file states".into()))
    };
    stated_channel(file).and_then(of).or_else(stated)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pulses that leave out an end of a record say so; those of nearly all of it do not.
    #[test]
    fn pulses_that_cover_a_part_are_named() {
        let channel = SignalChannel {
            name: "a".into(),
            unit: String::new(),
            sample_rate: 1000.0,
            start: 5.0,
            samples: vec![0.0; 10_000],
            orthogonal: None,
        };
        let pulses = |from: f64, to: f64| -> Vec<f64> {
            (0..=200).map(|k| from + (to - from) * f64::from(k) / 200.0).collect()
        };
        assert_eq!(coverage(&pulses(0.04, 9.97), &channel), "");
        assert_eq!(coverage(&pulses(-3.0, 12.0), &channel), "");
        assert_eq!(
            coverage(&pulses(0.04, 6.0), &channel),
            "; they cover 5.040 to 11.00 s only of the record from 5.000 to 15.00 s, the rest is left out"
        );
        assert!(coverage(&pulses(2.0, 9.99), &channel).contains("7.000 to 14.99 s only"));
    }
}

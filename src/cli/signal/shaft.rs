//! How the shaft turned: by flags, by a tacho, by the record itself, or as the file tells.

use std::f64::consts::TAU;
use std::path::Path;

use rotordyn::signal::record::{Points, Record};
use rotordyn::signal::tacho::{PulseTrain, rising_edges};
use rotordyn::study::signal::{ShaftMotion, SignalChannel};
use rotordyn::units::FREQUENCY;

use super::super::args::ShaftArgs;
use super::input::{File, Findings};

/// Fraction of a tacho's span by which it must fall before the next pulse counts.
const HYSTERESIS: f64 = 0.2;

/// What tells of the shaft; times are those of the record's file.
pub enum Shaft {
    Unknown,
    /// rev/s.
    Steady(f64, String),
    Pulses {
        train: PulseTrain,
        smooth: bool,
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

impl Shaft {
    /// By the flags, else as the file tells; `rate` is that of records that state none.
    pub fn of(args: &ShaftArgs, rate: Option<&str>, file: &File, findings: &mut Findings) -> Shaft {
        let known = if let Some(name) = &args.tacho {
            tacho(args, name, rate, file, findings)
        } else if let Some(text) = &args.track {
            line(text, findings)
        } else {
            told(file)
        };
        known.unwrap_or(Shaft::Unknown)
    }

    /// Whether anything is known of the shaft.
    pub fn is_known(&self) -> bool {
        !matches!(self, Shaft::Unknown)
    }

    /// The motion at a channel's samples.
    pub fn motion(&self, channel: &SignalChannel) -> Result<Option<ShaftMotion>, String> {
        let (rate, samples) = (channel.sample_rate, &channel.samples);
        let said = |error: rotordyn::signal::SignalError| error.to_string();
        Ok(Some(match self {
            Shaft::Unknown => return Ok(None),
            Shaft::Steady(speed, source) => ShaftMotion::steady(*speed, source.clone()),
            Shaft::Pulses { train, smooth, source } => {
                let times = train.times.iter().map(|t| t - channel.start).collect();
                let train = PulseTrain { times, ..train.clone() };
                ShaftMotion::of_pulses(&train, rate, samples.len(), *smooth, source.clone()).map_err(said)?
            }
            Shaft::Line { order, range, source } => {
                ShaftMotion::of_line(samples, rate, *order, *range, source.clone()).map_err(said)?
            }
            Shaft::Sampled { values, rate: own, start, is_angle, source } => {
                if values.len() < 2 {
                    return Ok(None);
                }
                // The shaft's channel has the record's clock, or is taken between its samples.
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
                    ShaftMotion::of_angle(values, 0, rate, source.clone())
                } else {
                    ShaftMotion::of_speed(&values, rate, source.clone()).map_err(said)?
                };
                if motion.summary.mean == 0.0 {
                    return Ok(None);
                }
                motion
            }
        }))
    }
}

/// A line of the record, `ORDER=LOW .. HIGH`.
fn line(text: &str, findings: &mut Findings) -> Option<Shaft> {
    let parts =
        text.split_once('=').and_then(|(order, range)| Some((order.trim().parse::<f64>().ok()?, range)));
    let Some((order, range)) = parts.filter(|(order, _)| *order > 0.0) else {
        findings
            .problem(format!("--track {text}: expected an order and its range, such as 1=\"5 Hz .. 50 Hz\""));
        return None;
    };
    let [low, high] = findings.range("--track", range, FREQUENCY, [0.0, f64::INFINITY])?;
    let source = format!("the record's line of order {order} between {low} and {high} Hz");
    Some(Shaft::Line { order, range: (low, high), source })
}

/// A channel of the file, or a file of its own.
fn tacho(
    args: &ShaftArgs,
    name: &str,
    rate: Option<&str>,
    file: &File,
    findings: &mut Findings,
) -> Option<Shaft> {
    let own = file.measured.records.iter().find(|r| r.name == name);
    let other;
    let (record, source) = match own {
        Some(record) => (record, format!("pulses of `{name}`")),
        None if Path::new(name).exists() => {
            other = match File::read(Path::new(name)) {
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
                        "--tacho {name}: one channel is expected, it holds {}",
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
    let times = pulse_times(record, rate, findings)?;
    if times.len() < 3 {
        findings.problem(format!(
            "--tacho: `{}` has {} pulses, three at least are needed for a speed; is it the tacho?",
            record.name,
            times.len()
        ));
        return None;
    }
    let train = findings.keep("--tacho: ", PulseTrain::new(&times, args.pulses_per_turn))?;
    if train.missing + train.dropped > 0 {
        findings.warnings.push(format!(
            "tacho: {} missing pulses were added and {} false ones dropped, of {}",
            train.missing,
            train.dropped,
            times.len()
        ));
    }
    let source = format!("{source}, {} a turn", args.pulses_per_turn);
    Some(Shaft::Pulses { train, smooth: args.smooth_tacho, source })
}

/// Pulse times \[s\]: values that are times, or the rising edges of a channel.
fn pulse_times(record: &Record, rate: Option<&str>, findings: &mut Findings) -> Option<Vec<f64>> {
    let values = findings.keep("--tacho: ", record.time_samples())?;
    let rising = values.windows(2).all(|w| w[1] > w[0]);
    if record.axis.points == Points::Unknown && rising {
        return Some(values.to_vec());
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
        Points::Even { start, .. } => start,
        _ => 0.0,
    };
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if low == high {
        findings.problem(format!("--tacho: `{}` is {low} all along: there are no pulses in it", record.name));
        return None;
    }
    let edges = findings.keep("--tacho: ", rising_edges(values, rate, None, HYSTERESIS))?;
    Some(edges.into_iter().map(|t| t + start).collect())
}

/// What the file tells: angle, speed over time, speed.
pub fn told(file: &File) -> Option<Shaft> {
    // "X105_DE_time" of files with CWRU's names is "de".
    let plain = |name: &str| {
        let name = name.to_lowercase();
        let bare = match name.split_once('_') {
            Some((id, rest)) if id.starts_with('x') && id[1..].bytes().all(|b| b.is_ascii_digit()) => rest,
            _ => &name,
        };
        bare.strip_suffix("_time").unwrap_or(bare).to_string()
    };
    let sampled = |unit: &str, names: &[&str]| {
        file.time_records().find(|r| r.unit == unit && names.contains(&plain(&r.name).as_str()))
    };
    let of = |record: &Record, factor: f64, is_angle: bool| {
        let rate = record.sample_rate().ok()?;
        let start = match record.axis.points {
            Points::Even { start, .. } => start,
            _ => 0.0,
        };
        let values = record.time_samples().ok()?.iter().map(|v| v * factor).collect();
        let source = format!("channel `{}`", record.name);
        Some(Shaft::Sampled { values, rate, start, is_angle, source })
    };
    let angle = sampled("rad", &["theta", "angle", "shaft_angle"]).and_then(|r| of(r, 1.0, true));
    let names = ["speed", "rpm", "shaft_speed", "shaft speed"];
    let speed = || sampled("rad/s", &names).and_then(|r| of(r, 1.0, false));
    let rpm = || sampled("rpm", &names).and_then(|r| of(r, TAU / 60.0, false));
    let stated = || {
        let of_record = file.time_records().find_map(|r| r.speed_rpm);
        let scalar = |(name, value): &(String, f64)| name.to_lowercase().ends_with("rpm").then_some(*value);
        let rpm = of_record.or_else(|| file.measured.scalars.iter().find_map(scalar))?;
        (rpm > 0.0).then(|| Shaft::Steady(rpm / 60.0, "as the file states".into()))
    };
    angle.or_else(speed).or_else(rpm).or_else(stated)
}

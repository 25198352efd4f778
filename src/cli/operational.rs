//! `identify` of a record without a force: modes of a machine in operation.

use std::path::Path;

use rotordyn::error::Error;
use rotordyn::identify::operational::{OperationalSettings, OutputRecord, Shaft, identify_operational};
use rotordyn::io::measured::run_up::{is_rotation_signal, quantity};
use rotordyn::signal::Quantity;
use rotordyn::signal::record::{Dof, Kind, MeasuredData, Points, Record};
use rotordyn::study::signal::SignalChannel;
use rotordyn::units::SPEED;
use rotordyn::warning::Code;

use super::args::IdentifyArgs;
use super::failure::Failure;
use super::identified_file::{Identified, Modes};
use super::signal::input::{File, InputProblems, clipping_text, dropout_texts, is_stored_run};
use super::signal::shaft_source::ShaftSource;
use super::terminal::Terminal;

/// Whether a file holds responses only: time records in units of motion, none in N or named like a hammer.
pub fn is_without_force(file: &MeasuredData) -> bool {
    let mut vibrations =
        file.records.iter().filter(|r| r.kind == Kind::Time && !is_rotation_signal(r)).peekable();
    let moves = |r: &Record| {
        let name = r.name.to_lowercase();
        let named = ["force", "hammer", "impact", "kraft"].iter().any(|word| name.contains(word));
        (quantity(&r.unit).is_some() || matches!(r.unit.as_str(), "" | "1")) && !named
    };
    vibrations.peek().is_some() && vibrations.all(moves)
}

/// Modes in the responses of one file.
pub fn compute(
    args: &IdentifyArgs,
    path: &Path,
    measured: MeasuredData,
    mut settings: OperationalSettings,
    terminal: &Terminal,
) -> Result<Identified, Failure> {
    let stem = super::measured::stem(path);
    let file = File { path: path.into(), stem: stem.clone(), measured, stored_run: is_stored_run(path) };
    let mut findings = InputProblems::default();
    let shaft = match &args.speed {
        Some(text) => findings.positive("--speed", text, SPEED).map_or(ShaftSource::Unknown, |speed| {
            ShaftSource::Steady(speed / std::f64::consts::TAU, "as given".into())
        }),
        None => ShaftSource::of(&args.shaft, args.rate.as_deref(), &file, &mut findings),
    };
    let stated = std::mem::take(&mut settings.orders);
    settings.orders = match &args.orders[..] {
        [] if shaft.is_known() => stated,
        _ => orders(args, &shaft, &mut findings),
    };
    let record = channels(args, &file, &mut findings);
    findings.to_result()?;
    let Some((mut record, start_time)) = record else {
        return Err(Failure::Input("no channel to identify".into()));
    };
    settings.shaft = shaft_of(&shaft, &mut record, start_time).map_err(Failure::Input)?;
    let spinner = terminal.spinner("identify");
    let found = identify_operational(&record, &settings);
    spinner.finish_and_clear();
    findings.warnings.iter().for_each(|text| terminal.warn_of(Code::MeasuredData, text.clone()));
    findings.coded.into_iter().for_each(|(code, text)| terminal.warn_of(code, text));
    let found = terminal.unless_stopped(
        found.map_err(|error| Failure::Input(format!("{}: {}", path.display(), Error::from(error)))),
    )?;
    let warnings = found.warnings.clone();
    Ok(Identified { stem, measured: file.measured, modes: Modes::InOperation(found), warnings })
}

/// Orders of `--orders`, which need a shaft.
fn orders(args: &IdentifyArgs, shaft: &ShaftSource, findings: &mut InputProblems) -> Vec<f64> {
    if !args.orders.is_empty() && !shaft.is_known() {
        findings.problem("--orders needs the shaft: give --speed \"1500 rpm\", --tacho CHANNEL or --track");
    }
    let mut list = Vec::new();
    for word in &args.orders {
        match word.trim().trim_end_matches(['x', 'X']).parse::<f64>() {
            Ok(order) if order > 0.0 && order.is_finite() => list.push(order),
            _ => findings.problem(format!("--orders {word}: expected positive numbers, such as 3.57,5.43")),
        }
    }
    list
}

/// The chosen channels, or all vibration channels, of the file.
fn chosen<'a>(args: &IdentifyArgs, file: &'a File, findings: &mut InputProblems) -> Vec<&'a Record> {
    let tacho = args.shaft.tacho.as_deref();
    if !args.channels.is_empty() {
        let find = |name: &String| findings.value_or_problem("--channels: ", file.record(name.trim()));
        return args.channels.iter().filter_map(find).collect();
    }
    let (rotation, vibration): (Vec<&Record>, Vec<&Record>) =
        file.time_records().filter(|r| Some(r.name.as_str()) != tacho).partition(|r| is_rotation_signal(r));
    // Torsional vibration in rad/s has the unit of a speed.
    let names: Vec<&str> =
        rotation.iter().filter(|r| r.response.is_rotation()).map(|r| r.name.as_str()).collect();
    if !names.is_empty() {
        findings.warnings.push(format!(
            "taken for the rotation of the shaft and left out: {}; --channels takes them as vibrations",
            names.join(", ")
        ));
    }
    vibration
}

/// What is said of a channel that is clipped, dead, or has gaps: combinations of its modes are taken for modes.
fn faults(record: &Record, sample_rate: f64, samples: &[f64]) -> Vec<(Code, String)> {
    if samples.iter().any(|v| !v.is_finite()) {
        // Refused by the identification.
        return Vec::new();
    }
    let channel = SignalChannel {
        name: record.name.clone(),
        unit: record.unit.clone(),
        sample_rate,
        start: start_of(record),
        samples: samples.to_vec(),
        orthogonal: None,
    };
    let clipped = clipping_text(&channel)
        .map(|text| (Code::ClippedRecord, format!("{text}, and combinations of modes are taken for modes")));
    let gaps = dropout_texts(&channel).into_iter().map(|(code, text)| match code {
        Code::RecordGap => {
            (code, format!("{text}: modes may be found twice; leave the channel out, or cut the record"))
        }
        _ => (code, text),
    });
    clipped.into_iter().chain(gaps).collect()
}

/// Time of the first sample \[s\].
fn start_of(record: &Record) -> f64 {
    match record.axis.points {
        Points::Uniform { start, .. } => start,
        _ => 0.0,
    }
}

/// The vibration channels, recorded together, and the time of the first sample.
fn channels(args: &IdentifyArgs, file: &File, findings: &mut InputProblems) -> Option<(OutputRecord, f64)> {
    let list = chosen(args, file, findings);
    let (mut samples, mut dofs, mut numbered) = (Vec::new(), Vec::new(), Vec::new());
    let mut rate: Option<(f64, &str)> = None;
    // Channels without a point get numbers beyond those of the file.
    let mut next = file.measured.records.iter().map(|r| r.response.node).max().unwrap_or(0).max(0);
    for record in &list {
        let own = findings.value_or_problem("", record.sample_rate())?;
        match rate {
            Some((first, name))
                if (own / first - 1.0).abs() > 1e-9 || record.values.len() != list[0].values.len() =>
            {
                findings.problem(format!(
                    "`{}` is not sampled together with `{name}`; choose others with --channels",
                    record.name
                ));
            }
            Some(_) => {}
            None => rate = Some((own, &record.name)),
        }
        let own_samples = findings.value_or_problem("", record.time_samples())?.to_vec();
        // What is computed has no sensors.
        if !file.stored_run {
            findings.coded.extend(faults(record, own, &own_samples));
        }
        samples.push(own_samples);
        dofs.push(match record.response.node {
            0 => {
                next += 1;
                numbered.push(format!("{next} is {}", record.name));
                Dof::new(next, record.response.direction)
            }
            _ => record.response,
        });
    }
    let quantities = quantities(&list, findings)?;
    if !numbered.is_empty() {
        findings.warnings.push(format!(
            "channels without a point in the file are numbered: {}; give --mapping for shapes at stations",
            numbered.join(", ")
        ));
    }
    let start = start_of(list.first()?);
    Some((OutputRecord { samples, sample_rate: rate?.0, dofs, quantities }, start))
}

/// Quantities of the channels; equal unknown units are taken for one quantity.
fn quantities(list: &[&Record], findings: &mut InputProblems) -> Option<Vec<Quantity>> {
    let first = list.first()?;
    if list.iter().all(|r| r.unit == first.unit) {
        return Some(vec![quantity(&first.unit).unwrap_or(Quantity::Acceleration); list.len()]);
    }
    let unknown: Vec<String> = list
        .iter()
        .filter(|r| quantity(&r.unit).is_none())
        .map(|r| match r.unit.as_str() {
            "" => format!("{} (none)", r.name),
            unit => format!("{} ({unit})", r.name),
        })
        .collect();
    if !unknown.is_empty() {
        findings.problem(format!(
            "the channels have different units, and these are none of a displacement, velocity or acceleration: {}; choose \
             others with --channels, or state the units in a mapping",
            unknown.join(", ")
        ));
        return None;
    }
    Some(list.iter().filter_map(|r| quantity(&r.unit)).collect())
}

/// Motion of the shaft over the record, which is cut to the samples that it covers.
fn shaft_of(shaft: &ShaftSource, record: &mut OutputRecord, start: f64) -> Result<Shaft, String> {
    if let ShaftSource::Steady(speed, _) = shaft {
        return Ok(Shaft::Steady(*speed));
    }
    let channel = SignalChannel {
        name: record.dofs[0].to_string(),
        unit: String::new(),
        sample_rate: record.sample_rate,
        start,
        samples: record.samples[0].clone(),
        orthogonal: None,
    };
    let Some(motion) = shaft.motion(&channel)? else { return Ok(Shaft::Unknown) };
    if motion.angle.is_empty() {
        return Ok(Shaft::Steady(motion.summary.mean));
    }
    let covered = motion.first..motion.first + motion.angle.len();
    record.samples.iter_mut().for_each(|channel| *channel = channel[covered.clone()].to_vec());
    Ok(Shaft::Angle(motion.angle))
}

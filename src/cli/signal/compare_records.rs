//! Second record of `--compare-with`, whose envelope spectrum is compared with the first.

use std::f64::consts::TAU;

use rotordyn::results::SignalResult;
use rotordyn::study::signal::{Analysis, AnalysisSelection, SignalSettings};
use rotordyn::units::SPEED;
use rotordyn::warning::Code;

use super::super::failure::Failure;
use super::analyse_channel;
use super::args::SignalArgs;
use super::input::{ChannelSelection, File, InputProblems, channels, clipping_text, dropout_texts};
use super::shaft_source::{ShaftSource, stated_in_file};

/// Envelope analysis of the second record and its name; `None` without `--compare-with`.
pub fn second_record(
    args: &SignalArgs,
    first: &SignalResult,
    settings: &SignalSettings,
    reported: &mut InputProblems,
) -> Result<Option<(SignalResult, String)>, Failure> {
    let Some(path) = &args.compare_with else { return Ok(None) };
    let of_file = |failure: Failure| match failure {
        Failure::Input(text) => Failure::Input(format!("{}: {text}", path.display())),
        other => other,
    };
    let file = File::read(path, args.compare_rate.as_deref())?;
    let named = |text: String| format!("{}: {text}", path.display());
    let mut notes = file.measured.notes.clone();
    // A rate given by a flag is no longer missing.
    notes.retain(|note| args.compare_rate.is_none() || !note.starts_with("no sampling rate"));
    reported.warnings.extend(file.measured.left_out_text().into_iter().chain(notes).map(named));
    let mut findings = InputProblems::default();
    let names: Vec<String> = args.compare_channel.iter().cloned().collect();
    let choice = ChannelSelection {
        names: &names,
        excluded: &[],
        quadrature: None,
        rate: args.compare_rate.as_deref(),
        unit: args.compare_unit.as_deref(),
        time: args.compare_time.as_deref(),
        flag_prefix: "--compare-",
    };
    let found = channels(&file, &choice, &mut findings);
    let given =
        args.compare_speed.as_ref().and_then(|text| findings.positive("--compare-speed", text, SPEED));
    let shaft = match (given, stated_in_file(&file), &first.shaft) {
        (Some(speed), ..) => ShaftSource::Steady(speed / TAU, "as given".into()),
        (None, Some(known), _) => known,
        (None, None, Some(s)) => ShaftSource::Steady(s.mean, "as in the first record".into()),
        (None, None, None) => ShaftSource::Unknown,
    };
    findings.to_result().map_err(of_file)?;
    reported.warnings.append(&mut findings.warnings);
    reported.coded.append(&mut findings.coded);
    let settings =
        SignalSettings { analyses: AnalysisSelection::Only(vec![Analysis::Envelope]), ..settings.clone() };
    let Some(channel) = found.first() else { return Ok(None) };
    let faults = clipping_text(channel).map(|text| (Code::ClippedRecord, text));
    // What is computed has no sensors.
    let dropouts = if file.stored_run { Vec::new() } else { dropout_texts(channel) };
    reported.coded.extend(faults.into_iter().chain(dropouts).map(|(code, text)| (code, named(text))));
    let result = analyse_channel(channel, &shaft, first.bearing.as_ref(), &settings).map_err(of_file)?;
    Ok(Some((result, file.stem)))
}

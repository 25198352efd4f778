//! Second record of `--compare-with`, whose envelope spectrum is compared with the first.

use std::f64::consts::TAU;

use rotordyn::results::SignalResult;
use rotordyn::study::signal::{Analysis, AnalysisSelection, SignalSettings};
use rotordyn::units::SPEED;

use super::super::failure::Failure;
use super::analyse_channel;
use super::args::SignalArgs;
use super::input::{ChannelSelection, File, InputProblems, channels};
use super::shaft_source::{ShaftSource, stated_in_file};

/// Envelope analysis of the second record and its name; `None` without `--compare-with`.
pub fn second_record(
    args: &SignalArgs,
    first: &SignalResult,
    settings: &SignalSettings,
    warnings: &mut Vec<String>,
) -> Result<Option<(SignalResult, String)>, Failure> {
    let Some(path) = &args.compare_with else { return Ok(None) };
    let of_file = |failure: Failure| match failure {
        Failure::Input(text) => Failure::Input(format!("{}: {text}", path.display())),
        other => other,
    };
    let file = File::read(path, args.compare_rate.as_deref())?;
    warnings.extend(file.measured.left_out_text().map(|text| format!("{}: {text}", path.display())));
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
    warnings.extend(findings.warnings);
    let settings =
        SignalSettings { analyses: AnalysisSelection::Only(vec![Analysis::Envelope]), ..settings.clone() };
    let Some(channel) = found.first() else { return Ok(None) };
    let result = analyse_channel(channel, &shaft, first.bearing.as_ref(), &settings).map_err(of_file)?;
    Ok(Some((result, file.stem)))
}

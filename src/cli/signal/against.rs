//! Second record of `--against`, whose envelope spectrum is compared with the first.

use std::f64::consts::TAU;

use rotordyn::results::SignalResult;
use rotordyn::study::signal::{Analysis, SignalSettings, Wanted};
use rotordyn::units::SPEED;

use super::super::failure::Failure;
use super::args::SignalArgs;
use super::input::{Choice, File, Findings, channels};
use super::look;
use super::shaft::{Shaft, told};

/// Envelope analysis of the second record and its name; `None` without `--against`.
pub fn find(
    args: &SignalArgs,
    first: &SignalResult,
    settings: &SignalSettings,
    warnings: &mut Vec<String>,
) -> Result<Option<(SignalResult, String)>, Failure> {
    let Some(path) = &args.against else { return Ok(None) };
    let of_file = |failure: Failure| match failure {
        Failure::Input(text) => Failure::Input(format!("{}: {text}", path.display())),
        other => other,
    };
    let file = File::read(path)?;
    let mut findings = Findings::default();
    let names: Vec<String> = args.against_channel.iter().cloned().collect();
    let choice = Choice {
        names: &names,
        without: &[],
        beside: None,
        rate: args.against_rate.as_deref(),
        unit: args.against_unit.as_deref(),
        time: args.against_time.as_deref(),
        flag: "--against-",
    };
    let found = channels(&file, &choice, &mut findings);
    let given =
        args.against_speed.as_ref().and_then(|text| findings.positive("--against-speed", text, SPEED));
    let shaft = match (given, told(&file), &first.shaft) {
        (Some(speed), ..) => Shaft::Steady(speed / TAU, "as given".into()),
        (None, Some(known), _) => known,
        (None, None, Some(s)) => Shaft::Steady(s.mean, "as in the first record".into()),
        (None, None, None) => Shaft::Unknown,
    };
    findings.settle().map_err(of_file)?;
    warnings.extend(findings.warnings);
    let settings = SignalSettings { analyses: Wanted::These(vec![Analysis::Envelope]), ..settings.clone() };
    let Some(channel) = found.first() else { return Ok(None) };
    let result = look(channel, &shaft, first.bearing.as_ref(), &settings).map_err(of_file)?;
    Ok(Some((result, file.stem)))
}

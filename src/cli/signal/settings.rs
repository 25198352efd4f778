//! Settings of the signal analyses from the flags.

use rotordyn::names::nearest;
use rotordyn::results::BearingWithOrders;
use rotordyn::signal::bearing_lines::LineSettings;
use rotordyn::signal::diagnosis::BandRule;
use rotordyn::study::signal::{Analysis, AnalysisSelection, Race, SignalSettings};
use rotordyn::units::{self, FREQUENCY, NUMBER, TIME};

use super::args::{DiagnosisArgs, SignalArgs};
use super::input::InputProblems;
use super::orders;

/// Settings from the flags; `bearing` if one is known.
pub fn from_flags(
    args: &SignalArgs,
    bearing: Option<&BearingWithOrders>,
    findings: &mut InputProblems,
) -> SignalSettings {
    let frequency = |findings: &mut InputProblems, flag: &str, text: &Option<String>| {
        text.as_ref().and_then(|text| findings.positive(flag, text, FREQUENCY))
    };
    let race = match args.race.to_lowercase().as_str() {
        "outer" => Race::Outer,
        "inner" => Race::Inner,
        other => {
            findings.problem(format!("--race {other}: expected outer or inner"));
            Race::Outer
        }
    };
    SignalSettings {
        analyses: analyses(&args.analyses, findings),
        resolution: frequency(findings, "--resolution", &args.resolution),
        max_frequency: frequency(findings, "--max-frequency", &args.max_frequency),
        order_resolution: args.order_resolution,
        max_order: args.max_order,
        orders: orders::lines(&args.orders, bearing, findings),
        bandwidth: args.bandwidth,
        race,
        datum: findings.quantity("--reference-time", &args.reference_time, TIME).unwrap_or(0.0),
        ..diagnosis(&args.diagnosis, bearing, findings)
    }
}

/// Settings of the diagnosis; the others as by default.
pub fn diagnosis(
    args: &DiagnosisArgs,
    bearing: Option<&BearingWithOrders>,
    findings: &mut InputProblems,
) -> SignalSettings {
    let defaults = SignalSettings::default();
    let slip = findings
        .value_or_problem("--slip: ", units::parse(&args.slip, NUMBER))
        .unwrap_or(defaults.lines.slip);
    let speed_range = findings
        .value_or_problem("--speed-range: ", units::parse(&args.speed_range, NUMBER))
        .unwrap_or(defaults.speed_range);
    if !(0.0..=0.2).contains(&speed_range) {
        findings.problem(format!("--speed-range {}: expected 0 to 20 %", args.speed_range));
    }
    SignalSettings {
        band: args.band.as_ref().and_then(|text| band(text, bearing.is_some(), findings)),
        lines: LineSettings { slip, harmonics: args.harmonics, ..defaults.lines },
        speed_range,
        ..defaults
    }
}

fn analyses(words: &[String], findings: &mut InputProblems) -> AnalysisSelection {
    match words {
        [] => return AnalysisSelection::Suitable,
        [all] if all == "all" => return AnalysisSelection::All,
        _ => {}
    }
    let known = || Analysis::ALL.iter().map(|(_, word)| *word);
    let mut wanted = Vec::new();
    for word in words {
        match Analysis::ALL.iter().find(|(_, known)| known == word) {
            Some((analysis, _)) if wanted.contains(analysis) => {}
            Some((analysis, _)) => wanted.push(*analysis),
            None => {
                let hint = match nearest(word, known()) {
                    Some(near) => format!("did you mean `{near}`?"),
                    None => format!("there are {}", known().collect::<Vec<_>>().join(", ")),
                };
                findings.problem(format!("--analyses: there is no analysis `{word}`; {hint}"));
            }
        }
    }
    AnalysisSelection::Only(wanted)
}

fn band(text: &str, bearing: bool, findings: &mut InputProblems) -> Option<BandRule> {
    match text.trim() {
        "lines" if !bearing => {
            findings.problem(
                "--band lines: needs --bearing or --bearing-orders to score the bands by their bearing lines",
            );
            None
        }
        "lines" => Some(BandRule::Lines),
        "kurtosis" => Some(BandRule::Kurtosis),
        "full" => Some(BandRule::Whole),
        range if range.contains("..") => {
            let [low, high] = findings.range("--band", range, FREQUENCY, [0.0, f64::MAX])?;
            Some(BandRule::Given(low, high))
        }
        other => {
            findings.problem(format!(
                "--band {other}: expected lines, kurtosis, full or a range such as \"500 Hz .. 5.5 kHz\""
            ));
            None
        }
    }
}

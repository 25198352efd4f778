//! Diagnosis of measured records: the analyses of the command `signal` on an array.

use numpy::PyReadonlyArray1;
use pyo3::prelude::*;
use pyo3::types::PyList;
use rotordyn::figures;
use rotordyn::results::SignalResult;
use rotordyn::study::signal::SignalChannel;
use rotordyn::units::SPEED;
use rotordyn::warning::{Code, Warning};
use serde_json::Value;

use crate::cli::args::Command;
use crate::cli::failure::Failure;
use crate::cli::signal::channel::analyse_channel;
use crate::cli::signal::input::InputProblems;
use crate::cli::signal::shaft_source::ShaftSource;
use crate::cli::signal::{bearing, orders, record_speed, settings};
use crate::failure::{Stop, interruptible};
use crate::reading::use_default_limits;
use crate::source::{WarningTexts, warning_texts};
use crate::study::parsed;
use crate::tree;

/// Fields, JSON, figures and warnings of a record.
type Found<'py> = (Bound<'py, PyList>, String, Vec<(String, String)>, Vec<WarningTexts>);

/// Analyses of a record \[unit\] sampled at a rate \[Hz\]; `flags` are those of the command `signal`.
#[pyfunction]
#[pyo3(signature = (samples, sample_rate, unit, name, flags))]
pub fn diagnose<'py>(
    py: Python<'py>,
    samples: PyReadonlyArray1<'py, f64>,
    sample_rate: f64,
    unit: String,
    name: String,
    flags: Vec<String>,
) -> PyResult<Found<'py>> {
    use_default_limits();
    let samples = samples.as_array().to_vec();
    let channel = SignalChannel { name, unit, sample_rate, start: 0.0, samples, orthogonal: None };
    let (found, json, figures, warnings) = interruptible(py, move |_| {
        let (found, warnings) = analysed(&channel, flags)?;
        let document = rotordyn::io::json::signal_to_json(std::slice::from_ref(&found), None);
        let json = document.get("channels").and_then(|all| all.get(0)).unwrap_or(&Value::Null).to_string();
        let figures = figures::of_signal(std::slice::from_ref(&found), &channel.name)
            .into_iter()
            .map(|(name, figure)| Ok((name, figure.svg().map_err(Failure::from)?)))
            .collect::<Result<Vec<_>, Stop>>()?;
        Ok((found, json, figures, warnings))
    })?;
    Ok((tree::document(py, &found.document())?, json, figures, warnings))
}

fn analysed(channel: &SignalChannel, flags: Vec<String>) -> Result<(SignalResult, Vec<WarningTexts>), Stop> {
    let words: Vec<String> = std::iter::once("signal".into()).chain(flags).collect();
    let Command::Signal(args) = parsed(&words)? else {
        return Err(Failure::Input("this command analyses no record".into()).into());
    };
    let mut findings = InputProblems::default();
    let shaft = args.speed.as_ref().and_then(|text| findings.positive("speed", text, SPEED));
    let shaft = shaft.map_or(ShaftSource::Unknown, |speed| {
        ShaftSource::Steady(speed / std::f64::consts::TAU, "as given".into())
    });
    let rated = bearing::find(&args.diagnosis, None, &mut findings)?;
    let settings = settings::from_flags(&args, rated.as_ref(), &mut findings);
    if rated.is_some() && !shaft.is_known() && findings.problems.is_empty() {
        findings.problem("bearing defect frequencies need the shaft speed: speed=\"1797 rpm\"");
    }
    findings.to_result()?;
    let found = analyse_channel(channel, &shaft, rated.as_ref(), &settings)?;
    let mut texts: Vec<(Code, String)> = Vec::new();
    let of_analysis = findings.warnings.into_iter().chain(found.warnings.iter().cloned());
    texts.extend(of_analysis.map(|text| (Code::SignalAnalysis, text)));
    texts.extend(findings.coded);
    let speed = record_speed::warning(&found, settings.speed_range);
    texts.extend(speed.map(|text| (Code::ShaftSpeedNotFound, text)));
    texts.extend(orders::one_band_warnings(&found).into_iter().map(|text| (Code::OrdersInOneBand, text)));
    texts.extend(orders::jitter_warnings(&found).into_iter().map(|text| (Code::TachoJitter, text)));
    let mut warnings: Vec<WarningTexts> = Vec::new();
    for (code, text) in texts {
        let warning = warning_texts(&Warning::new(code, "", text));
        if !warnings.contains(&warning) {
            warnings.push(warning);
        }
    }
    Ok((found, warnings))
}

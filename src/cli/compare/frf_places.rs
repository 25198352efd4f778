//! Measured FRFs at the named points of the model.

use std::path::Path;

use rotordyn::element::Anchor;
use rotordyn::identify::quantity_of;
use rotordyn::io::machine_records::point_number;
use rotordyn::io::measured::{self, mapping};
use rotordyn::model::Model;
use rotordyn::model::study::FrfStudy;
use rotordyn::names::nearest;
use rotordyn::signal::record::{Dof, Kind, MeasuredData, Record};
use rotordyn::study::MeasuredFrf;
use rotordyn::update::target::{Sensor, sensors};
use rotordyn::warning::Code;

use super::super::args::CompareArgs;
use super::super::failure::Failure;
use super::super::limits::limits;
use super::super::measured::range;
use super::super::terminal::Terminal;

/// Largest difference of offsets \[m\] and direction cosines of a measured point and one of the model: the digits of a
/// universal file.
const SAME_POINT: f64 = 1e-5;
/// Most names listed in a message.
const MAX_NAMES: usize = 8;

/// Measured FRFs that are between a response and an excitation of one of the cases, and the speed \[rad/s\] that the
/// file states.
///
/// # Errors
/// A file or mapping that cannot be read, no FRF, none between points of the model, unknown names in `--pair`.
pub fn read(
    path: &Path,
    args: &CompareArgs,
    models: &[&Model],
    terminal: &Terminal,
) -> Result<(Vec<MeasuredFrf>, Option<f64>), Failure> {
    let file = path.display();
    let band = args.band.as_deref().map(|text| range(text, "--band")).transpose()?;
    let mut data = measured::read_within(path, limits())?;
    let mut warnings = std::mem::take(&mut data.notes);
    warnings.extend(data.left_out_text());
    if !data.records.iter().any(|r| r.kind == Kind::Frf) {
        let advice = match data.records.iter().any(|r| r.time_samples().is_ok()) {
            true => {
                "it holds records over time: add --run-up for a run-up, or make FRFs of hits with `rotordyn identify`"
            }
            false => "`rotordyn validate` compares modes",
        };
        return Err(Failure::Input(format!("{file} holds no FRFs; {advice}")));
    }
    // A case may leave out what another one has.
    let studies: Vec<(&Model, &FrfStudy)> =
        models.iter().filter_map(|model| Some((*model, model.studies.frf.as_ref()?))).collect();
    let Some((model, study)) = studies.first().copied() else { return Ok((Vec::new(), None)) };
    // Names of the file, before a mapping leaves some out.
    let pairs = stated_pairs(args, &data, &studies)?;
    if let Some(file) = &args.mapping {
        let place = |name: &str| point_number(model, name);
        warnings.extend(mapping::read(file)?.apply(&mut data, &place, file)?);
    }
    let (mut found, mut unplaced) = (Vec::new(), Vec::new());
    for record in data.records.iter().filter(|r| r.kind == Kind::Frf) {
        let stated = pairs.iter().find(|(name, _)| *name == record.name).map(|(_, ends)| (ends.clone(), 1.0));
        let ends = stated
            .or_else(|| studies.iter().find_map(|(_, study)| named(record, study)))
            .or_else(|| studies.iter().find_map(|(model, study)| placed(record, &data, study, model)));
        let Some(((response, excitation), sign)) = ends else {
            unplaced.push(record.name.as_str());
            continue;
        };
        let name = format!("{response}/{excitation}");
        let wrong = |why: String| Failure::Input(format!("{file}: `{}`: {why}", record.name));
        if found.iter().any(|m: &MeasuredFrf| m.response == response && m.excitation == excitation) {
            let advice = "say with --pair which is meant, or leave one out with --mapping";
            return Err(wrong(format!("the second FRF of {name}; {advice}")));
        }
        let unit = record.si_unit().map_err(|error| wrong(format!("{error}; give it with --mapping")))?;
        let quantity =
            quantity_of(unit).ok_or_else(|| wrong(format!("its unit {unit} is that of no FRF")))?;
        let values = record.frf()?;
        let hz =
            record.axis.points(values.len()).ok_or_else(|| wrong("its frequencies are not known".into()))?;
        let coherence = coherence(&data, record);
        let inside = |hz: f64| band.is_none_or(|[low, high]| (low..=high).contains(&hz));
        let kept: Vec<usize> = (0..hz.len()).filter(|&k| inside(hz[k])).collect();
        if kept.is_empty() {
            return Err(wrong("it has no line in --band".into()));
        }
        found.push(MeasuredFrf {
            response,
            excitation,
            values: kept.iter().map(|&k| sign * values[k]).collect(),
            coherence: kept.iter().filter_map(|&k| coherence.get(k).copied()).collect(),
            hz: kept.iter().map(|&k| hz[k]).collect(),
            quantity,
        });
    }
    if found.is_empty() {
        return Err(Failure::Input(nothing_placed(path, &unplaced, study)));
    }
    if !unplaced.is_empty() {
        warnings.push(format!(
            "not compared, between no probe and excitation of the model: {}",
            listed(&unplaced)
        ));
    }
    for warning in warnings {
        terminal.warn_of(Code::MeasuredData, format!("{file}: {warning}"));
    }
    let rpm = data.records.iter().filter(|r| r.kind == Kind::Frf).find_map(|r| r.speed_rpm);
    Ok((found, rpm.map(|rpm| rpm * std::f64::consts::TAU / 60.0)))
}

/// Names of response and excitation.
type Ends = (String, String);

/// Records named by `--pair` with their places in the study.
fn stated_pairs(
    args: &CompareArgs,
    data: &MeasuredData,
    studies: &[(&Model, &FrfStudy)],
) -> Result<Vec<(String, Ends)>, Failure> {
    let known: Vec<&str> =
        data.records.iter().filter(|r| r.kind == Kind::Frf).map(|r| r.name.as_str()).collect();
    let mut out = Vec::new();
    for (name, text) in &args.pair {
        let wrong = |why: String| Failure::Input(format!("--pair {name}={text}: {why}"));
        // A number counts the file's FRFs from 1.
        let by_number = name.parse::<usize>().ok().and_then(|n| known.get(n.checked_sub(1)?).copied());
        let record = known.iter().find(|own| *own == name).copied().or(by_number);
        let record = record.ok_or_else(|| {
            let near = nearest(name, known.iter().copied());
            let hint =
                near.map_or_else(|| format!("it has {}", listed(&known)), |near| format!("but `{near}`"));
            wrong(format!("the file has no FRF of this name, {hint}"))
        })?;
        let (response, excitation) = text
            .trim_matches('"')
            .split_once('/')
            .ok_or_else(|| wrong("write the model's response and excitation, such as disc_x/rim".into()))?;
        let (response, excitation) = (response.trim(), excitation.trim());
        let of_cases: Vec<_> =
            studies.iter().map(|(_, study)| ends_of(response, excitation, study)).collect();
        let ends = match of_cases.iter().find_map(|ends| ends.as_ref().ok()) {
            Some(ends) => ends.clone(),
            // What the first case lacks.
            None => of_cases
                .into_iter()
                .next()
                .unwrap_or_else(|| Err("there are no FRFs".into()))
                .map_err(wrong)?,
        };
        out.push((record.to_string(), ends));
    }
    Ok(out)
}

fn ends_of(response: &str, excitation: &str, study: &FrfStudy) -> Result<Ends, String> {
    let responses: Vec<&str> = study.responses.iter().map(|p| p.name.as_str()).collect();
    let excitations: Vec<&str> = study.excitations.iter().map(|e| e.name.as_str()).collect();
    let place = |what: &str, name: &str, known: &[&str]| {
        let is_known = known.contains(&name).then(|| name.to_string());
        is_known.ok_or_else(|| {
            format!("there is no {what} `{name}` in the model's FRFs, which have {}", listed(known))
        })
    };
    Ok((place("response", response, &responses)?, place("excitation", excitation, &excitations)?))
}

/// Ends of a record that is named as `frf` exports it, `response/excitation`.
fn named(record: &Record, study: &FrfStudy) -> Option<(Ends, f64)> {
    let (response, excitation) = record.name.split_once('/')?;
    ends_of(response, excitation, study).ok().map(|ends| (ends, 1.0))
}

/// Ends of a record by the points and directions of its file, and its sign.
fn placed(record: &Record, data: &MeasuredData, study: &FrfStudy, model: &Model) -> Option<(Ends, f64)> {
    let at = |dof: Dof| sensors(&[dof], &data.geometry, model).ok()?.pop();
    let (response, reference) = (at(record.response)?, at(record.reference)?);
    let mut responses = study.responses.iter();
    let mut excitations = study.excitations.iter();
    let (p, of_response) = responses.find_map(|p| Some((p, sign(&response, &p.at, &p.direction)?)))?;
    let (x, of_force) = excitations.find_map(|x| Some((x, sign(&reference, &x.at, &x.direction)?)))?;
    Some(((p.name.clone(), x.name.clone()), of_response * of_force))
}

/// 1 or -1 if a sensor is at a point of the model along or against its direction.
fn sign(sensor: &Sensor, at: &Anchor, direction: &[f64; 6]) -> Option<f64> {
    let near = |a: f64, b: f64| (a - b).abs() < SAME_POINT;
    let own = &sensor.anchor;
    let same_place = own.node == at.node && own.offset.iter().zip(&at.offset).all(|(a, b)| near(*a, *b));
    // Weights of rotations are radii.
    let own = sensor.direction.map(|d| if d == 0.0 { 0.0 } else { d.signum() });
    let along = |sign: f64| own.iter().zip(direction).all(|(a, b)| near(sign * a, *b));
    same_place.then(|| [1.0, -1.0].into_iter().find(|sign| along(*sign))).flatten()
}

/// Coherence of an FRF; empty without one.
fn coherence(data: &MeasuredData, of: &Record) -> Vec<f64> {
    let own = data.records.iter().find(|r| {
        r.kind == Kind::Coherence
            && r.response == of.response
            && r.reference == of.reference
            && r.axis == of.axis
    });
    match own.map(|r| &r.values) {
        Some(rotordyn::signal::record::Values::Real(values)) => values.clone(),
        _ => Vec::new(),
    }
}

fn listed(names: &[&str]) -> String {
    let more = if names.len() > MAX_NAMES { ", ..." } else { "" };
    format!("{}{more}", names[..names.len().min(MAX_NAMES)].join(", "))
}

fn nothing_placed(path: &Path, unplaced: &[&str], study: &FrfStudy) -> String {
    let responses: Vec<&str> = study.responses.iter().map(|p| p.name.as_str()).collect();
    let excitations: Vec<&str> = study.excitations.iter().map(|e| e.name.as_str()).collect();
    format!(
        "{}: none of its FRFs ({}) is between a response ({}) and an excitation ({}) of the model; give their places with \
         --mapping, or say which is which: --pair \"{}\"={}/{}",
        path.display(),
        listed(unplaced),
        listed(&responses),
        listed(&excitations),
        unplaced.first().unwrap_or(&"1"),
        responses.first().unwrap_or(&"RESPONSE"),
        excitations.first().unwrap_or(&"EXCITATION")
    )
}

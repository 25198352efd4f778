//! `identify`: experimental modal analysis of measured FRFs or of impact-test time records.

use std::cell::RefCell;
use std::path::{Path, PathBuf};
use std::time::Instant;

use rotordyn::error::Error;
use rotordyn::identify::operational::OperationalSettings;
use rotordyn::identify::{
    ModalIdentification, ResidualTerms, Settings, driving_point_faults, frfs_without_unit, identify,
    low_coherence, single_lines_text, without_single_lines,
};
use rotordyn::io::hdf5::open_reader;
use rotordyn::io::measured::impact_run;
use rotordyn::io::measured::mapping::{self, Mapping};
use rotordyn::io::measured::operating_run;
use rotordyn::io::{json, machine_records, measured};
use rotordyn::model::{Model, Quantity};
use rotordyn::signal::impact::{self, Estimator, ImpactTest, ImpactWindows};
use rotordyn::signal::record::{FrfMatrix, Kind, MeasuredData, Points, Record, RecordError};
use rotordyn::units;
use rotordyn::warning::Code;
use serde_json::json;

use super::args::{EstimatorName, IdentifyArgs, ResidualTermsName};
use super::failure::Failure;
use super::folder_lock::FolderLock;
use super::identified_file::{Identified, Modes};
use super::limits::limits;
use super::machine::ModelSource;
use super::measured::{parse_positive, range};
use super::operational;
use super::terminal::Terminal;
use super::{Outcome, print_written_files};

pub fn run(args: &IdentifyArgs, terminal: &Terminal) -> Result<Outcome, Failure> {
    let start = Instant::now();
    let found = compute(args, &InMemory::default(), terminal)?;
    let seconds = start.elapsed().as_secs_f64();
    found.print(terminal);
    let folder = args.out.clone();
    let folder = folder.unwrap_or_else(|| Path::new("out").join(format!("identify_{}", found.stem)));
    let _lock = FolderLock::take(&folder, terminal)?;
    let files = found.write(&folder, args.csv, !args.no_figures, terminal)?;
    print_written_files(terminal, &folder, &files);
    found.warnings.iter().for_each(|text| terminal.warn_of(Code::Identification, text.clone()));
    let mut document = json::document(&found.section().content);
    document["command"] = json!("identify");
    document["seconds"] = json!({ "identify": seconds });
    document["files"] = json!(files);
    Ok(document.into())
}

/// What is in memory and takes the place of a file.
#[derive(Clone, Debug, Default)]
pub struct InMemory {
    /// Content of the only file of `files`.
    pub measured: Option<MeasuredData>,
    /// The machine that defines the stations of the mapping.
    pub model: Option<Model>,
}

/// Modes in the files; the warnings of reading are given, those about the modes are in the result.
pub fn compute(
    args: &IdentifyArgs,
    in_memory: &InMemory,
    terminal: &Terminal,
) -> Result<Identified, Failure> {
    let settings = Settings { stop: terminal.stop.clone(), ..settings(args)? };
    let test = ImpactTest {
        force: args.force.clone(),
        block: parse_positive("--block", args.block.as_ref(), units::TIME)?,
        // Records that are windowed already are taken as they are; the damping is taken off in any case.
        time_constant: match args.already_windowed {
            true => None,
            false => parse_positive("--exponential-window", args.exponential_window.as_ref(), units::TIME)?,
        },
        estimator: match args.estimator {
            EstimatorName::H1 => Estimator::H1,
            EstimatorName::H2 => Estimator::H2,
            EstimatorName::Hv => Estimator::Hv,
        },
    };
    let spinner = terminal.spinner("identify");
    let (mut warnings, mut left_out) = (Vec::new(), Vec::new());
    let outcome = match read_measured(args, in_memory, &test, &mut warnings, &mut left_out) {
        Ok(Measured::Responses { path, file, orders }) => {
            spinner.finish_and_clear();
            if args.quantity.is_some() || args.residual_terms != ResidualTermsName::Both {
                warnings.push("--quantity and --residual-terms apply to FRFs; they are not used".into());
            }
            left_out.into_iter().for_each(|text| terminal.warn_of(Code::LeftOut, text));
            warnings.into_iter().for_each(|warning| terminal.warn_of(Code::Identification, warning));
            let settings = OperationalSettings {
                band: settings.band,
                max_order: settings.max_order,
                orders,
                stop: settings.stop,
                ..OperationalSettings::default()
            };
            return operational::compute(args, &path, file, settings, terminal);
        }
        Ok(Measured::Frfs(all, from_hits)) => identify_modes(args, all, from_hits, &settings, &mut warnings),
        Err(failure) => Err(failure),
    };
    spinner.finish_and_clear();
    left_out.into_iter().for_each(|text| terminal.warn_of(Code::LeftOut, text));
    let (measured, frfs, found) = match terminal.unless_stopped(outcome) {
        Ok(found) => found,
        Err(failure) => {
            warnings.into_iter().for_each(|warning| terminal.warn_of(Code::Identification, warning));
            return Err(failure);
        }
    };
    let stem = super::measured::stem(&args.files[0]);
    Ok(Identified { stem, measured, modes: Modes::OfFrfs { frfs, found }, warnings })
}

/// FRF matrix of the files and its modes; warnings are also collected on failure.
fn identify_modes(
    args: &IdentifyArgs,
    all: MeasuredData,
    from_hits: bool,
    settings: &Settings,
    warnings: &mut Vec<String>,
) -> Result<(MeasuredData, FrfMatrix, ModalIdentification), Failure> {
    // With several files the channel names already contain the file name.
    let with_context = |error: Error| match &args.files[..] {
        [only] => with_file_name(only, error),
        _ => error.into(),
    };
    let mut frfs = all.frf_matrix().map_err(|error| with_context(error.into()))?;
    if let Some((repaired, at)) = without_single_lines(&frfs) {
        warnings.push(single_lines_text(&at));
        frfs = repaired;
    }
    quality_warnings(&frfs, args, from_hits, warnings);
    let found = identify(&frfs, settings).map_err(|error| with_context(error.into()))?;
    warnings.extend(low_coherence(&frfs, &found));
    warnings.extend(driving_point_faults(&found));
    for mode in found.modes.iter().filter(|m| m.damping_ratio() <= 0.0) {
        warnings.push(format!(
            "without the damping of the exponential window the mode at {:.3} Hz has a damping ratio of {:.3} %: \
             --exponential-window is not the time constant of the window used, or it is too short for such light damping; FRFs \
             and records with --already-windowed must have been measured with this window",
            mode.frequency_hz(),
            100.0 * mode.damping_ratio()
        ));
    }
    fit_error_warnings(&found, warnings);
    Ok((all, frfs, found))
}

/// Relative fit error of an FRF above which a warning is issued.
const FIT_ERROR_LIMIT: f64 = 0.5;

/// Warns about FRFs with a large fit error.
fn fit_error_warnings(found: &ModalIdentification, warnings: &mut Vec<String>) {
    let mut worst: Vec<(f64, String)> = Vec::new();
    for (response, row) in found.responses.iter().zip(&found.errors) {
        let own = found.references.iter().zip(row).filter(|(_, error)| **error > FIT_ERROR_LIMIT);
        worst.extend(own.map(|(reference, error)| (*error, format!("{response}/{reference}"))));
    }
    worst.sort_by(|a, b| b.0.total_cmp(&a.0));
    let (count, all) = (worst.len(), found.responses.len() * found.references.len());
    let some: Vec<String> =
        worst.iter().take(4).map(|(error, name)| format!("{name} by {:.0} %", 100.0 * error)).collect();
    if count > 0 {
        warnings.push(format!(
            "{count} of {all} FRFs have a large fit error ({}{}): bad hit, wrong point or direction, low response, or lines \
             above what the hits excite; check their coherence, restrict --band, repeat the measurement or exclude them",
            some.join(", "),
            if count > 4 { ", ..." } else { "" }
        ));
    }
}

/// Adds the file name to an error.
fn with_file_name(path: &Path, error: Error) -> Failure {
    match error {
        error @ (Error::Content { .. } | Error::Environment { .. }) => error.into(),
        Error::Record(RecordError::NoRate { channel }) => Failure::Input(format!(
            "{}: `{channel}` does not state its sampling rate; give it with --rate RATE",
            path.display()
        )),
        error => Failure::Input(format!("{}: {error}", path.display())),
    }
}

fn settings(args: &IdentifyArgs) -> Result<Settings, Failure> {
    let band = args.band.as_deref().map(|text| range(text, "--band")).transpose()?;
    let quantity = match args.quantity.as_deref() {
        None => None,
        Some("receptance") => Some(Quantity::Displacement),
        Some("mobility") => Some(Quantity::Velocity),
        Some("accelerance") => Some(Quantity::Acceleration),
        Some(other) => {
            return Err(Failure::Input(format!(
                "--quantity {other}: expected receptance, mobility or accelerance"
            )));
        }
    };
    let window = parse_positive("--exponential-window", args.exponential_window.as_ref(), units::TIME)?;
    Ok(Settings {
        band,
        max_order: args.max_order,
        quantity,
        residual_terms: match args.residual_terms {
            ResidualTermsName::Both => ResidualTerms::Both,
            ResidualTermsName::Upper => ResidualTerms::Upper,
            ResidualTermsName::Lower => ResidualTerms::Lower,
            ResidualTermsName::None => ResidualTerms::None,
        },
        added_decay: window.map_or(0.0, |tau| 1.0 / tau),
        ..Settings::default()
    })
}

/// What the files hold.
enum Measured {
    /// FRFs, also of hits, and whether any comes from hits.
    Frfs(MeasuredData, bool),
    /// A record of responses without a force, and orders of its sines that the file states.
    Responses { path: PathBuf, file: MeasuredData, orders: Vec<f64> },
}

/// Reads all files, converts time records of hits to FRFs.
fn read_measured(
    args: &IdentifyArgs,
    in_memory: &InMemory,
    test: &ImpactTest,
    warnings: &mut Vec<String>,
    left_out: &mut Vec<String>,
) -> Result<Measured, Failure> {
    let mapping = args.mapping.as_ref().map(|path| mapping::read(path)).transpose()?;
    let model = match &args.model {
        None => in_memory.model.clone(),
        Some(path) => {
            let args = super::args::ModelArgs { model: path.clone(), variant: None, set: Vec::new() };
            Some(ModelSource::read(&args)?.load(&[])?.model)
        }
    };
    let rate = parse_positive("--rate", args.rate.as_ref(), units::FREQUENCY)?;
    let names = RefCell::new(Vec::new());
    // Without a model, stations are numbered in order of appearance.
    let place = |name: &str| match (&model, name.parse::<i64>()) {
        (Some(model), _) => machine_records::point_number(model, name),
        (None, Ok(number)) => Some(number),
        (None, Err(_)) => {
            let mut names = names.borrow_mut();
            let known = names.iter().position(|n| n == name);
            Some(
                known.unwrap_or_else(|| {
                    names.push(name.to_string());
                    names.len() - 1
                }) as i64
                    + 1,
            )
        }
    };
    let mut all = MeasuredData::default();
    let mut tests: Vec<(&Path, Vec<MeasuredData>)> = Vec::new();
    let mut simulated = false;
    for path in &args.files {
        let (mut file, orders) = match read_stored_run(args, path, test, warnings)? {
            Some(StoredRun::Hit(frfs)) => {
                simulated = true;
                (frfs, None)
            }
            Some(StoredRun::Operation(records, orders)) => (records, Some(orders)),
            None => match &in_memory.measured {
                Some(measured) => (measured.clone(), None),
                None => (measured::read_at_rate(path, limits(), rate)?, None),
            },
        };
        left_out.extend(file.left_out_text().map(|text| format!("{}: {text}", path.display())));
        let notes = std::mem::take(&mut file.notes);
        rate.into_iter().for_each(|rate| file.set_missing_rate(rate));
        if let (Some(mapping), Some(of)) = (&mapping, &args.mapping) {
            warnings.extend(Mapping::apply(mapping, &mut file, &place, of)?);
        }
        // The mapping or --rate may have supplied what the file lacks.
        let abscissa_unknown = file.records.iter().any(|r| r.axis.points == Points::Unknown);
        warnings.extend(
            notes
                .into_iter()
                .filter(|note| abscissa_unknown || !note.starts_with(measured::MISSING_AXIS_NOTE)),
        );
        if all.title.is_empty() {
            all.title = std::mem::take(&mut file.title);
        }
        if all.geometry.nodes.is_empty() {
            all.geometry = std::mem::take(&mut file.geometry);
        }
        let has_frf = file.records.iter().any(|r| r.kind == Kind::Frf);
        let has_time = file.records.iter().any(|r| r.kind == Kind::Time);
        let of_hits = test.force.is_some() || test.block.is_some() || args.exponential_window.is_some();
        let responses = !args.channels.is_empty() || operational::is_without_force(&file);
        if orders.is_some() || (!has_frf && args.files.len() == 1 && !of_hits && responses) {
            return Ok(Measured::Responses { path: path.clone(), file, orders: orders.unwrap_or_default() });
        }
        if has_frf || !has_time {
            add_records(args, path, file.records, &mut all);
        } else {
            // Hits of several files are averaged if their points are known to be the same.
            match tests.iter_mut().find(|(_, files)| same_test(&files[0], &file)) {
                Some((_, files)) => files.push(file),
                None => tests.push((path, vec![file])),
            }
        }
    }
    if tests.is_empty() && (test.force.is_some() || test.block.is_some() || test.estimator != Estimator::H1) {
        warnings.push(
            "--force, --block and --estimator apply to time records, but the files contain only FRFs".into(),
        );
    }
    let from_hits = simulated || !tests.is_empty();
    for (path, files) in tests {
        let (records, quality_warnings) =
            impact::frfs(&files, test).map_err(|error| with_file_name(path, error.into()))?;
        warnings.extend(quality_warnings);
        add_records(args, path, records, &mut all);
    }
    let named: Vec<String> =
        names.into_inner().iter().enumerate().map(|(k, name)| format!("{} is {name}", k + 1)).collect();
    if !named.is_empty() {
        warnings
            .push(format!("without --model the stations of the mapping are numbered: {}", named.join(", ")));
    }
    if args.speed.is_some()
        || args.shaft.tacho.is_some()
        || args.shaft.track.is_some()
        || !args.orders.is_empty()
        || !args.channels.is_empty()
    {
        warnings.push(
            "--speed, --tacho, --track, --orders and --channels apply to a record without a force; they are not used"
                .into(),
        );
    }
    Ok(Measured::Frfs(all, from_hits))
}

/// What a run of this program is for `identify`.
enum StoredRun {
    /// FRFs of a simulated impact test.
    Hit(MeasuredData),
    /// Responses of the machine in operation, and the ball-pass orders of its bearings.
    Operation(MeasuredData, Vec<f64>),
}

/// The run in a results file: a simulated impact test, or responses of the machine in operation where a random force acts, where
/// channels are chosen or where the file has no FRFs.
fn read_stored_run(
    args: &IdentifyArgs,
    path: &Path,
    test: &ImpactTest,
    warnings: &mut Vec<String>,
) -> Result<Option<StoredRun>, Failure> {
    if measured::Format::of_extension(path) != Some(measured::Format::Hdf5) || !path.exists() {
        return Ok(None);
    }
    let windows = ImpactWindows { force_length: None, time_constant: test.time_constant };
    let store = open_reader(path, limits())?;
    if let Some(frfs) = impact_run::impact_frfs_windowed(&*store, windows)? {
        return Ok(Some(StoredRun::Hit(frfs)));
    }
    let Some(run) = operating_run::operating_run(&*store)? else { return Ok(None) };
    if args.files.len() > 1 || (run.has_frfs && !run.is_random && args.channels.is_empty()) {
        return Ok(None);
    }
    if !run.is_random {
        warnings.push(
            "no random force acts in this run, so that its responses without the orders of the shaft are no response to \
             random forces and poles found in them may be no modes; add a load with a `band`, see `rotordyn help load.NAME.band`"
                .into(),
        );
    }
    Ok(Some(StoredRun::Operation(run.records, run.orders)))
}

/// Whether two files contain the same channels, all at known points.
fn same_test(first: &MeasuredData, other: &MeasuredData) -> bool {
    let channels = |file: &MeasuredData| -> Vec<_> {
        let time = file.records.iter().filter(|r| r.kind == Kind::Time);
        time.map(|r| (r.name.clone(), r.response, r.unit.clone())).collect()
    };
    let own = channels(first);
    own == channels(other) && own.iter().all(|(_, dof, _)| dof.node != 0)
}

/// Adds records; with several files their names are prefixed by the file name.
fn add_records(args: &IdentifyArgs, path: &Path, mut records: Vec<Record>, all: &mut MeasuredData) {
    if args.files.len() > 1 {
        let file = path.file_name().unwrap_or_default().to_string_lossy();
        records.iter_mut().for_each(|r| r.name = format!("{file}: {}", r.name));
    }
    all.records.extend(records);
}

fn quality_warnings(frfs: &FrfMatrix, args: &IdentifyArgs, from_hits: bool, warnings: &mut Vec<String>) {
    if frfs.coherence.is_none() && !from_hits {
        warnings.push(
            "not all FRFs have a coherence function, so noisy frequency ranges are not known; export the coherence with \
             the FRFs"
            .into(),
        );
    }
    if let Some(text) = frfs_without_unit(frfs).filter(|_| args.quantity.is_none()) {
        warnings.push(format!("{text}; give the unit in a mapping, or --quantity"));
    }
    if frfs.responses.len() * frfs.references.len() == 1 {
        warnings.push(
            "there is only one FRF: it gives poles but no mode shapes, and close modes may appear as one; measure at \
             more points"
                .into(),
        );
    }
}

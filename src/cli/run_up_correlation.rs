//! Comparison of a measured run-up with a simulated run-up driven by the measured speed.

use std::path::{Path, PathBuf};

use rotordyn::document::{Document, Section, in_json};
use rotordyn::error::Error;
use rotordyn::figures;
use rotordyn::io::hdf5::Store;
use rotordyn::io::measured::{mapping, run_up};
use rotordyn::io::{machine_records, results_file};
use rotordyn::model::Model;
use rotordyn::results::{Agreement, CampbellResult, ChannelPair, CutPair, StepError, level_difference_db};
use rotordyn::study::{Machine, MeasuredRun, smeared_maxima};
use rotordyn::update::UpdateError;
use rotordyn::warning::Code;

use super::args::{OrdersArgs, OutputFiles, ShaftArgs, SpectrogramArgs};
use super::failure::Failure;
use super::folder_lock::FolderLock;
use super::machine::ModelSource;
use super::signal::input::{File, InputProblems, clipping_text, cut_time_range, dropout_texts};
use super::signal::shaft_source::ShaftSource;
use super::store::{self, ModelText};
use super::studies::{Job, Study};
use super::terminal::{Terminal, number, rpm};
use super::{ehl_films, settings};

/// Largest number of rows printed.
const MAX_ROWS: usize = 40;
/// Fraction of the highest speed: a record that starts faster than this causes a start transient in the
/// simulation.
const MAX_START_SPEED_RATIO: f64 = 0.2;
/// Revolutions on either side over which the jitter of tacho pulses is smoothed.
const SMOOTHING_REVOLUTIONS: usize = 4;
/// Relative distance of two maxima from which a window takes another part of each.
const ELSEWHERE: f64 = 0.03;
/// Fraction of a channel's largest order below which an order is not listed.
const MIN_ORDER_LEVEL_RATIO: f64 = 1e-3;

/// A measured run-up mapped to the model.
pub struct MeasuredRunUp {
    pub run: MeasuredRun,
    pub source: String,
    /// Lowest and highest speed \[rpm\].
    pub rpm: [f64; 2],
}

/// How a run-up is read from a file.
#[derive(Clone, Copy)]
pub struct RunUpReading<'a> {
    pub mapping: Option<&'a Path>,
    /// Time range.
    pub time: Option<&'a str>,
    pub shaft: &'a ShaftArgs,
}

/// The run-up in a file, or the reason why it contains none.
pub fn read(
    path: &Path,
    args: &RunUpReading,
    model: &Model,
    terminal: &Terminal,
) -> Result<Result<MeasuredRunUp, String>, Failure> {
    let mut file = File::read(path, None)?;
    let mut findings = InputProblems::default();
    let mapping = args.mapping.map(mapping::read).transpose()?;
    if let Some(rate) = mapping.as_ref().and_then(mapping::Mapping::rate) {
        file.measured.set_missing_rate(rate);
    }
    mapping.iter().for_each(|mapping| mapping.set_missing_units(&mut file.measured));
    if !file.time_records().any(|r| !run_up::is_rotation_signal(r)) {
        return Ok(Err("it contains no time record".into()));
    }
    if let Some(left_out) = file.measured.left_out_text() {
        terminal.warn_of(Code::LeftOut, format!("{}: {left_out}", path.display()));
    }
    if let Some(record) = file.time_records().find(|r| r.sample_rate().is_err()) {
        return Ok(Err(format!(
            "`{}` has no sampling rate: give it in the mapping: rate = \"RATE\"",
            record.name
        )));
    }
    // The measured shaft angle drives the model; pulse jitter would excite it.
    let shaft = ShaftSource::of(args.shaft, None, &file, &mut findings).smoothed_over(SMOOTHING_REVOLUTIONS);
    let named = |failure: Failure| match failure {
        Failure::Input(text) => Failure::Input(format!("{}: {text}", path.display())),
        other => other,
    };
    let tacho = std::mem::take(&mut findings.warnings);
    std::mem::take(&mut findings).to_result().map_err(named)?;
    tacho
        .into_iter()
        .for_each(|text| terminal.warn_of(Code::MeasuredData, format!("{}: {text}", path.display())));
    if !shaft.is_known() {
        return Ok(Err("the speed of the shaft is not known: give --tacho CHANNEL, or --track \
             1=\"5 Hz .. 50 Hz\"; a channel `speed` needs its unit, such as [channel.speed] unit = \"rpm\" in the \
             mapping"
            .into()));
    }
    let is_shaft_channel = |r: &rotordyn::signal::record::Record| {
        run_up::is_rotation_signal(r) || args.shaft.tacho.as_deref() == Some(&r.name)
    };
    file.measured.records.retain(|r| !is_shaft_channel(r));
    if let (Some(mapping), Some(of)) = (&mapping, args.mapping) {
        let place = |name: &str| machine_records::point_number(model, name);
        for warning in mapping.apply(&mut file.measured, &place, of)? {
            terminal.warn_of(Code::MeasuredData, format!("{}: {warning}", path.display()));
        }
    }
    let of_file = |error: Error| match error {
        Error::Update(UpdateError { problem, advice }) => {
            Error::Content { path: path.into(), problem, advice }
        }
        other => other,
    };
    let (mut channels, warnings) = run_up::channels(&file.measured, model).map_err(of_file)?;
    for warning in warnings {
        terminal.warn_of(Code::MeasuredData, format!("{}: {warning}", path.display()));
    }
    for (_, channel) in &mut channels {
        cut_time_range(channel, args.time, "--time", &mut findings);
    }
    findings.to_result().map_err(named)?;
    let limited = channels.iter().filter_map(|(_, channel)| clipping_text(channel));
    limited.for_each(|text| terminal.warn_of(Code::ClippedRecord, format!("{}: {text}", path.display())));
    for (code, text) in channels.iter().flat_map(|(_, channel)| dropout_texts(channel)) {
        terminal.warn_of(code, format!("{}: {text}", path.display()));
    }
    let first = &channels[0].1;
    let motion = shaft.motion(first).map_err(|text| named(Failure::Input(text)))?;
    let Some(motion) = motion.filter(|m| !m.angle.is_empty() && !m.summary.steady) else {
        return Ok(Err(
            "the shaft speed is constant; `rotordyn signal FILE --compare-with RUN` compares records at constant \
             speed"
                .into(),
        ));
    };
    let rpm = [motion.summary.min, motion.summary.max].map(|speed| 60.0 * speed);
    let source = motion.summary.source.clone();
    Ok(Ok(MeasuredRunUp { run: MeasuredRun::new(channels, &motion, model)?, source, rpm }))
}

/// A measured run-up beside its simulation.
pub struct ComparedRunUp {
    source: String,
    /// Lowest and highest speed \[rpm\].
    rpm: [f64; 2],
    /// Duration \[s\].
    seconds: f64,
    /// Time steps \[s\] of the simulation.
    step: Option<f64>,
    requested_step: f64,
    step_error: Option<StepError>,
    pairs: Vec<ChannelPair>,
}

/// Simulates the run-up, compares it with the record and writes the results; returns the comparison, if the simulation
/// has a result, and the files.
pub fn compare(
    found: &MeasuredRunUp,
    origin: &ModelSource,
    prefix: &str,
    folder: &Path,
    draw: bool,
    terminal: &Terminal,
) -> Result<(Option<ComparedRunUp>, Vec<PathBuf>), Failure> {
    let first = rpm(found.run.history.speed.at(0)?.unwrap_or(0.0));
    let own = folder.join(format!("{prefix}_computed"));
    let _lock = FolderLock::take(&own, terminal)?;
    let (mut job, campbell) = simulation_job(found, origin, own, terminal)?;
    if first > MAX_START_SPEED_RATIO * found.rpm[1] {
        terminal.warn_of(Code::MeasuredData, format!(
                "the record starts at {first:.0} rpm, but the simulation starts at static equilibrium: its first \
                 seconds contain the start transient"
            ),
        );
    }
    check_record_length(&found.run, &job.machine.model)?;
    job.perform(&[Study::RunUp]);
    // Partial results are written even if the run failed.
    job.write(OutputFiles { figures: false, csv: false, page: false })?;
    if let Some((_, failure)) = job.failures.pop() {
        if !matches!(failure, Failure::Interrupted) {
            terminal.warn_of(Code::MeasuredData, format!(
                    "the simulation was driven by the shaft angle of {}: jumps or jitter of that angle excite the shaft",
                    found.source
                ),
            );
        }
        return Err(failure);
    }
    let Some(computed) = &job.results.run_up else { return Ok((None, job.files)) };
    let pairs = job.machine.correlate_run_up(&found.run, computed)?;
    tables(terminal, &pairs, &format!("{prefix}.h5"));
    let compared = ComparedRunUp {
        source: found.source.clone(),
        rpm: found.rpm,
        seconds: found.run.profile.duration(),
        step: computed.report.step,
        requested_step: computed.requested_step,
        step_error: computed.step_error.clone(),
        pairs,
    };
    let pairs = &compared.pairs;
    let mut files = std::mem::take(&mut job.files);
    let path = folder.join(format!("{prefix}.h5"));
    let file = Store::replace(&path)?;
    results_file::write_run_up_correlation(&file, pairs, &found.run.history, &computed.history)?;
    results_file::write_document(&file, "/comparison", &compared.document())?;
    file.commit()?;
    files.push(path);
    if draw {
        let spinner = terminal.spinner("figures");
        files.extend(figures::draw_run_up_correlation(
            prefix,
            pairs,
            campbell.as_ref(),
            &job.machine,
            folder,
        )?);
        spinner.finish_and_clear();
    }
    for warning in job.machine.run_up_warnings(computed) {
        terminal.warn(&warning.prefixed("the simulated run-up"));
    }
    let sides = ["the measured run-up", "the simulated run-up"];
    // Maxima at one place lose the same.
    let elsewhere = |cut: &CutPair| (cut.peaks[1].rpm / cut.peaks[0].rpm - 1.0).abs() > ELSEWHERE;
    let unlike = |pair: &&ChannelPair| {
        let smeared = || pair.orders.iter().flat_map(|found| &found.spectrogram.smeared);
        pair.cuts.iter().any(|cut| elsewhere(cut) && smeared().any(|smear| smear.order == cut.line.order))
    };
    let smeared =
        |side: usize| smeared_maxima(pairs.iter().filter(unlike).map(move |pair| &pair.orders[side]));
    for (side, warning) in (0..2).flat_map(|k| smeared(k).into_iter().map(move |w| (sides[k], w))) {
        terminal.warn(&warning.prefixed(side));
    }
    Ok((Some(compared), files))
}

/// Checks before the simulation that the record is long enough for the spectrogram and the order resolution.
fn check_record_length(run: &MeasuredRun, model: &Model) -> Result<(), Failure> {
    let seconds = run.profile.duration();
    let turns = run.history.angle.ends()?.map_or(0.0, |[_, end]| end) / std::f64::consts::TAU;
    let (spectra, orders) = (&model.studies.spectrogram, &model.studies.orders);
    let mut problems = Vec::new();
    if let Some(study) = spectra.as_ref().filter(|study| study.length > seconds) {
        problems.push(format!(
            "the record of {} s is shorter than the spectrogram window of {} s: use a longer record, or set \
             study.spectrogram.length=\"{} s\"",
            number(seconds, 3),
            number(study.length, 3),
            number(0.2 * seconds, 1)
        ));
    }
    if let Some(study) = orders.as_ref().filter(|study| study.resolution * turns < 1.0) {
        problems.push(format!(
            "the record has {} revolutions, fewer than the {} needed for an order resolution of {}: use a longer \
             record, or set study.orders.resolution={}",
            number(turns, 3),
            number(1.0 / study.resolution, 3),
            study.resolution,
            number((2.0 / turns).min(1.0), 1)
        ));
    }
    if problems.is_empty() { Ok(()) } else { Err(Failure::Input(problems.join("; "))) }
}

/// Job of the model driven by the measured speed, and its Campbell diagram up to the highest speed.
fn simulation_job<'a>(
    found: &MeasuredRunUp,
    origin: &ModelSource,
    folder: PathBuf,
    terminal: &'a Terminal,
) -> Result<(Job<'a>, Option<CampbellResult>), Failure> {
    let model = origin.load(&[])?.model;
    let top = format!("{} rpm", found.rpm[1]);
    let drafts = [
        settings::run_up(&model, None, None, None, None, None),
        settings::spectrogram(&model, &SpectrogramArgs::default()),
        settings::orders(&model, &OrdersArgs::default()),
        settings::campbell(&model, Some(&top), None),
    ];
    let set: Vec<(String, String)> = drafts.into_iter().flat_map(|draft| draft.set).collect();
    let mut loaded = origin.load(&set)?;
    ehl_films::prepare_machine_films(&mut loaded.model, &folder, terminal)?;
    let machine = Machine::new(found.run.driven_model(&loaded.model))?;
    let studies = &machine.model.studies;
    let campbell = studies.campbell.as_ref().map(|study| machine.campbell(study)).transpose()?;
    let text = ModelText { measured_speed: Some(found.source.clone()), ..(&loaded).into() };
    let output = store::open(&folder, text, origin, true, terminal)?;
    Ok((Job::new(terminal, machine, folder, output), campbell))
}

fn tables(terminal: &Terminal, pairs: &[ChannelPair], file: &str) {
    let level = |of: [f64; 2]| format!("{:+.1}", level_difference_db(of));
    let rows: Vec<Vec<String>> = pairs
        .iter()
        .map(|p| {
            let [m, c] = p.rms;
            vec![p.channel.clone(), number(m, 4), number(c, 4), p.unit.clone(), level(p.rms)]
        })
        .collect();
    let header = ["channel", "measured RMS", "computed RMS", "unit", "level dB"];
    terminal.table("Run-up: measured and computed RMS", &header, &rows);
    let mut rows = Vec::new();
    for pair in pairs {
        let size = |cut: &CutPair| cut.peaks[0].rms.max(cut.peaks[1].rms);
        let highest = pair.cuts.iter().map(size).fold(0.0, f64::max);
        for cut in pair.cuts.iter().filter(|cut| size(cut) >= MIN_ORDER_LEVEL_RATIO * highest) {
            let [m, c] = cut.peaks;
            rows.push(vec![
                pair.channel.clone(),
                cut.line.label.clone(),
                format!("{:.1}", m.rpm),
                format!("{:.1}", c.rpm),
                match m.at_end || c.at_end {
                    true => "(end)".into(),
                    false => format!("{:+.2}", 100.0 * (c.rpm / m.rpm - 1.0)),
                },
                match cut.agreement.finding {
                    _ if m.at_end || c.at_end => "-".into(),
                    Agreement::BelowBackground => "-".into(),
                    _ => format!("{:.2}", 100.0 * cut.agreement.speed),
                },
                number(m.rms, 4),
                number(c.rms, 4),
                level([m.rms, c.rms]),
                format!("{:.1}", cut.agreement.level_db()),
                format!("{:.3}", cut.correlation),
                cut.agreement.finding.name().into(),
            ]);
        }
    }
    let header = [
        "channel",
        "order",
        "measured rpm",
        "computed rpm",
        "error %",
        "+- %",
        "measured RMS",
        "computed RMS",
        "level dB",
        "+- dB",
        "correlation",
        "within +-",
    ];
    let count = rows.len();
    rows.truncate(MAX_ROWS);
    terminal.table("Peaks of the order cuts, measured and computed", &header, &rows);
    if count > MAX_ROWS {
        terminal.print(&format!("  ... and {} more in {file}", count - MAX_ROWS));
    }
    terminal.print(
        "  level: computed over measured; (end): peak at the lowest or highest speed; correlation of the order level \
         over\n  the whole run, 1 for proportional levels; +-: 95 % by background, shaft angle and time step, without \
         calibration",
    );
}

/// What is written of a comparison; `None`: the simulation has no result.
pub fn section<'a>(path: &str, found: Option<&'a ComparedRunUp>) -> Section<'a> {
    let content = Document::new().text(in_json("file"), path);
    Section::listed("run_ups", "comparison", content.and_if(found, |out, found| out.and(found.document())))
}

impl ComparedRunUp {
    /// What is written to files.
    fn document(&self) -> Document<'_> {
        Document::new()
            .text("speed_source", &self.source)
            .numbers("rpm", "rpm", &self.rpm)
            .number("seconds", "s", self.seconds)
            .optional("step_s", "s", self.step)
            .number("requested_step_s", "s", self.requested_step)
            .and(StepError::document(self.step_error.as_ref()))
            .table("channels", ChannelPair::columns(&self.pairs))
    }
}

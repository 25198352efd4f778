//! Comparison of measured files with a model: shared by `validate` and `update`.

use std::path::{Path, PathBuf};

use rotordyn::analysis::modal::Mode;
use rotordyn::analysis::table_range::check_tables;
use rotordyn::io::measured::test_data::{self, ReadSettings, TestData};
use rotordyn::model::Model;
use rotordyn::signal::record::MeasuredData;
use rotordyn::units::{self, FREQUENCY, SPEED};
use rotordyn::update::correlation::Correlation;
use rotordyn::update::frf_scale::FrfScale;
use rotordyn::update::state::ModelState;
use rotordyn::update::target::{Sensor, Target};
use rotordyn::warning::{Code, Warning};

use super::args::MeasuredArgs;
use super::failure::Failure;
use super::limits::limits;
use super::terminal::{Terminal, number, rpm};

/// Reads the measured files and maps them to the model; `None` for a file without modes and FRFs.
pub fn read(
    args: &MeasuredArgs,
    model: &Model,
    terminal: &Terminal,
) -> Result<Vec<Option<TestData>>, Failure> {
    (0..args.measured.len()).map(|k| read_one(args, k, model, None, terminal)).collect()
}

/// Reads the measured file `k`, or takes what is in memory in its place, and maps it to the model; `None` without modes and
/// FRFs.
pub fn read_one(
    args: &MeasuredArgs,
    k: usize,
    model: &Model,
    given: Option<MeasuredData>,
    terminal: &Terminal,
) -> Result<Option<TestData>, Failure> {
    let band = args.band.as_deref().map(|text| range(text, "--band")).transpose()?;
    let speed = match &args.speed {
        Some(text) => Some(units::parse(text, SPEED).map_err(|e| Failure::Input(format!("--speed: {e}")))?),
        None => None,
    };
    let window = parse_positive("--exponential-window", args.exponential_window.as_ref(), units::TIME)?;
    let reading = ReadSettings {
        added_decay: window.map_or(0.0, |time_constant| 1.0 / time_constant),
        mapping: args.mapping.as_deref(),
        band,
        speed,
        limits: Some(limits()),
        stop: Some(&terminal.stop),
    };
    let path = &args.measured[k];
    let bar = terminal.spinner(&format!("reading {}", path.display()));
    let found = match given {
        Some(measured) => test_data::of_measured(measured, &reading, model),
        None => test_data::read(path, &reading, model),
    };
    bar.finish_and_clear();
    let found = terminal.unless_stopped(found)?;
    for left_out in found.iter().filter_map(|found| found.left_out.as_ref()) {
        terminal.warn_of(Code::LeftOut, format!("{}: {left_out}", path.display()));
    }
    for warning in found.iter().flat_map(|found| &found.warnings) {
        terminal.warn_of(Code::MeasuredData, format!("{}: {warning}", path.display()));
    }
    Ok(found)
}

/// Parses a frequency range: "10 Hz .. 300 Hz", "10 .. 300 Hz", or with a comma.
pub fn range(text: &str, flag: &str) -> Result<[f64; 2], Failure> {
    let wrong = |why: &str| Failure::Input(format!("{flag} \"{text}\": {why}; write it as \"10 .. 300 Hz\""));
    let ends = text.split_once("..").or_else(|| text.split_once(','));
    let (from, to) = ends.ok_or_else(|| wrong("not a range of two values"))?;
    let hz = |text: &str| units::parse(text, FREQUENCY).map_err(|e| wrong(&e.to_string()));
    let high = hz(to)?;
    let low = match from.trim().parse::<f64>() {
        // A unit after the second number applies to both.
        Ok(bare) => {
            let unit = to.trim().trim_start_matches(|c: char| c.is_ascii_digit() || "+-.eE ".contains(c));
            hz(&format!("{bare} {unit}"))?
        }
        Err(_) => hz(from)?,
    };
    if low < high { Ok([low, high]) } else { Err(wrong("the lower end must be below the upper end")) }
}

/// Parses a positive quantity of a flag.
pub fn parse_positive(
    name: &str,
    text: Option<&String>,
    dimension: units::Dimension,
) -> Result<Option<f64>, Failure> {
    let Some(text) = text else { return Ok(None) };
    let example = if dimension == units::TIME { "0.5 s" } else { "12 kHz" };
    match units::parse(text, dimension) {
        Ok(value) if value > 0.0 => Ok(Some(value)),
        Ok(_) => Err(Failure::Input(format!("{name} \"{text}\" is not positive; write it as \"{example}\""))),
        Err(error) => Err(Failure::Input(format!("{name}: {error}; write it as \"{example}\""))),
    }
}

/// Results folder; default `out/NAME_ending`.
pub fn folder(out: Option<&PathBuf>, model: &str, suffix: &str) -> PathBuf {
    out.cloned().unwrap_or_else(|| Path::new("out").join(format!("{model}_{suffix}")))
}

/// File name without folder and extension.
pub fn stem(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    // All stored runs are named results.h5: use the folder name instead.
    match path.parent().and_then(Path::file_name) {
        Some(folder) if stem == "results" => folder.to_string_lossy().into_owned(),
        _ => stem,
    }
}

/// Table of mode pairs and of unpaired measured and computed modes, sorted by frequency.
pub fn mode_table(terminal: &Terminal, title: &str, target: &Target, state: &ModelState) {
    let per_cent = |v: f64| format!("{:.3}", 100.0 * v);
    // Of files of modes the errors are not known.
    let has_errors = target.modes.iter().any(|m| m.frequency_error > 0.0);
    let dash = || "-".to_string();
    let error = |value: f64| if value > 0.0 { number(value, 2) } else { dash() };
    let has_warnings = target.modes.iter().any(|m| !m.quality_warnings.is_empty());
    let mut rows: Vec<(f64, [String; 10])> = Vec::new();
    for (k, measured) in target.modes.iter().enumerate() {
        let pair = state.paired_mode(k);
        let hz = measured.frequency_hz;
        let computed = |text: &dyn Fn(&Mode) -> String| pair.map_or_else(dash, |(mode, _)| text(mode));
        let row = [
            format!("{hz:.3}"),
            error(measured.frequency_error),
            computed(&|mode| format!("{:.3}", mode.frequency_hz())),
            computed(&|mode| format!("{:+.2}", 100.0 * (mode.frequency_hz() / hz - 1.0))),
            measured.damping_ratio.map_or_else(dash, per_cent),
            error(100.0 * measured.damping_error),
            computed(&|mode| per_cent(mode.zeta())),
            pair.map_or_else(dash, |(_, mac)| format!("{mac:.3}")),
            pair.map_or("(not in the model)".into(), |(mode, _)| mode.label.clone()),
            measured.quality_text(),
        ];
        rows.push((hz, row));
    }
    let [low, high] = band(target);
    for &k in &state.pairing.unpaired_computed {
        let mode = &state.modes[k];
        let hz = mode.frequency_hz();
        if (low..=high).contains(&hz) {
            let mut row: [String; 10] = std::array::from_fn(|_| dash());
            row[2] = format!("{hz:.3}");
            row[6] = per_cent(mode.zeta());
            row[8] = format!("{} (not measured)", mode.label);
            row[9].clear();
            rows.push((hz, row));
        }
    }
    rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    const HEADER: [&str; 10] = [
        "measured Hz",
        "+-",
        "computed Hz",
        "error %",
        "measured zeta %",
        "+-",
        "computed zeta %",
        "MAC",
        "mode",
        "doubt",
    ];
    let shown = |k: &usize| match HEADER[*k] {
        "+-" => has_errors,
        "doubt" => has_warnings,
        _ => true,
    };
    let columns: Vec<usize> = (0..HEADER.len()).filter(shown).collect();
    let rows: Vec<Vec<String>> =
        rows.into_iter().map(|(_, row)| columns.iter().map(|k| row[*k].clone()).collect()).collect();
    let header: Vec<&str> = columns.iter().map(|k| HEADER[*k]).collect();
    terminal.table(&format!("{title} at {:.0} rpm", rpm(target.speed)), &header, &rows);
    if has_errors {
        terminal.print("  +- is one standard error of the measured value.");
    }
}

/// Relative frequency difference above which a mode pair gets a warning.
const FREQUENCY_ERROR_LIMIT: f64 = 0.2;

/// MAC below which a mode pair gets a warning.
const DOUBTFUL_MAC: f64 = 0.5;

/// Warns about bearings outside their tables, and mode pairs with a large frequency difference or a low MAC.
pub fn pair_warnings(terminal: &Terminal, target: &Target, state: &ModelState) -> Result<(), Failure> {
    for warning in check_tables(&state.linearised.model, "the measurement", [target.speed; 2])? {
        terminal.warn(&warning);
    }
    for (k, measured) in target.modes.iter().enumerate() {
        let Some((mode, mac)) = state.paired_mode(k) else { continue };
        let off = mode.frequency_hz() / measured.frequency_hz - 1.0;
        if off.abs() > FREQUENCY_ERROR_LIMIT || mac < DOUBTFUL_MAC {
            terminal.warn_of(
                Code::LowMac,
                format!(
                    "mode pair {:.1} Hz measured, {:.1} Hz computed ({}): frequency error {:+.0} %, MAC {mac:.2}; check \
                     that it is the same mode, and the points and directions of the mapping",
                    measured.frequency_hz,
                    mode.frequency_hz(),
                    mode.label,
                    100.0 * off
                ),
            );
        }
    }
    Ok(())
}

/// Warns about shapes of a rotating shaft compared with a model that stands still.
pub fn standstill_warning(terminal: &Terminal, found: &Correlation) {
    if found.whirls_at_standstill() {
        terminal.warn_of(
            Code::MeasuredData,
            "the measured shapes whirl, forward and backward, but the model stands still: if the shaft was rotating, state its \
             speed with --speed",
        );
    }
}

/// Frequency band of the measured modes, widened to 0.8 and 1.1 times its ends.
pub fn band(target: &Target) -> [f64; 2] {
    let all = || target.modes.iter().map(|m| m.frequency_hz);
    [0.8 * all().fold(f64::INFINITY, f64::min), 1.1 * all().fold(0.0, f64::max)]
}

/// Tables of the FRFs, and what they say of units, signs and points.
pub fn compare_frfs(terminal: &Terminal, found: &Correlation) {
    frf_level_tables(terminal, found);
    let (scale, faults) = found.frf_faults();
    if let Some(scale) = scale {
        terminal.warn(&scale_warning(&scale));
    }
    for text in faults {
        terminal.warn_of(Code::FrfLevel, text);
    }
}

/// Tables of the frequency response assurance criterion (FRAC) and of the levels of every response and reference.
pub fn frf_level_tables(terminal: &Terminal, found: &Correlation) {
    let (Some(measured), Some(frac), Some(level)) = (&found.target.frfs, found.frac(), found.frf_level_db())
    else {
        return;
    };
    let model = &found.state.linearised.model;
    let mut header = vec!["response".to_string()];
    header.extend(measured.references.iter().map(|s| s.name(model)));
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    let table = |title: &str, values: &[Vec<f64>], text: &dyn Fn(f64) -> String| {
        let row = |(sensor, row): (&Sensor, &Vec<f64>)| {
            std::iter::once(sensor.name(model)).chain(row.iter().map(|v| text(*v))).collect()
        };
        let rows: Vec<Vec<String>> = measured.responses.iter().zip(values).map(row).collect();
        terminal.table(title, &header, &rows);
    };
    let title = "FRAC by response and reference (force)";
    table(title, &frac, &|v| if v.is_nan() { "-".into() } else { number(v, 3) });
    let title = "Level of computed over measured FRFs, dB, median over the frequencies";
    table(title, &level, &|v| if v.abs() < MOST_LEVEL_DB { format!("{v:+.1}") } else { "-".into() });
}

/// All measured FRFs are the computed ones times a factor or a power of the frequency.
pub fn scale_warning(scale: &FrfScale) -> Warning {
    Warning::new(Code::FrfLevel, "", scale.text()).advise(scale.advice())
}

/// Level beyond which one of two FRFs is zero but for rounding \[dB\].
const MOST_LEVEL_DB: f64 = 150.0;

//! Table and statements of a trend.

use rotordyn::results::{TrendAxis, TrendRecord, TrendResult};
use rotordyn::signal::bearing_lines::BearingPart;

use super::super::signal::line_tables::band;
use super::super::terminal::{Terminal, number};

/// Most rows in the terminal: the first and the last of more.
const MAX_ROWS: usize = 100;

/// Prints one row per record, and the statements on the whole.
pub fn print(terminal: &Terminal, found: &TrendResult) {
    if let Some(b) = &found.bearing {
        let o = &b.orders;
        terminal.print(&format!(
            "Bearing {} ({}): FTF {:.4}, BPFO {:.4}, BPFI {:.4}, BSF {:.4} per revolution",
            b.name, b.source, o.ftf, o.bpfo, o.bpfi, o.bsf
        ));
    }
    let mut header = vec!["record".to_string(), axis_title(&found.axis)];
    header.push("rpm".into());
    let level = |name: &str| format!("{name} {}", found.unit).trim_end().to_string();
    header.extend([level("RMS"), "peak".into()]);
    header.extend(found.rms_bands.iter().map(|[low, high]| format!("{} Hz", short_band(*low, *high))));
    header.extend(["crest".into(), "kurtosis".into(), "skewness".into()]);
    if found.bearing.is_some() {
        header.extend(BearingPart::ALL.map(|part| part.line_name().to_string()));
    }
    header.push(if found.bearing.is_some() { "diagnosis" } else { "" }.into());
    let count = found.records.len();
    let left_out = count.saturating_sub(MAX_ROWS);
    let shown = |k: &usize| *k < MAX_ROWS / 2 || *k >= MAX_ROWS / 2 + left_out;
    let mut rows: Vec<Vec<String>> =
        (0..count).filter(shown).map(|k| row(found, &found.records[k])).collect();
    if left_out > 0 {
        rows.insert(MAX_ROWS / 2, vec![format!("... {left_out} more")]);
    }
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    let title = format!(
        "{count} record{} over {} ({})",
        if count == 1 { "" } else { "s" },
        found.axis.name,
        found.axis.source
    );
    terminal.table(&title, &header, &rows);
    if let Some(common) = found.line_band {
        terminal.print(&format!(
            "  {}: root sum of squares of the lines in the envelope spectrum of {}, {}",
            BearingPart::ALL.map(BearingPart::line_name).join(", "),
            band(common),
            level("peak")
        ));
    }
    terminal.heading("Trend");
    found.statements.iter().for_each(|text| terminal.print_wrapped(text));
}

fn row(found: &TrendResult, record: &TrendRecord) -> Vec<String> {
    let shown = |value: Option<f64>, digits: usize| {
        value.filter(|v| v.is_finite()).map_or("-".into(), |v| number(v, digits))
    };
    let state = record.state.as_ref();
    let statistics = state.map(|s| &s.statistics);
    let mut row = vec![record.name.clone(), position(record.position)];
    row.push(shown(state.and_then(|s| s.speed).map(|speed| 60.0 * speed), 5));
    row.extend([shown(statistics.map(|s| s.rms), 4), shown(statistics.map(|s| s.peak), 4)]);
    row.extend((0..found.rms_bands.len()).map(|k| shown(state.and_then(|s| s.band_rms.get(k).copied()), 4)));
    row.push(shown(statistics.and_then(|s| s.crest_factor), 4));
    row.push(shown(statistics.and_then(|s| s.kurtosis), 4));
    row.push(shown(statistics.and_then(|s| s.skewness), 3));
    let diagnosis = state.and_then(|s| s.diagnosis.as_ref());
    if found.bearing.is_some() {
        let lines = diagnosis.and_then(|d| d.lines);
        row.extend((0..4).map(|k| shown(lines.map(|lines| lines[k].strength), 3)));
    }
    let statement = diagnosis.map(|d| d.statement.clone());
    row.push(record.problem.clone().or(statement).unwrap_or_default());
    row
}

/// At most six digits, without zeros at the end.
fn position(value: f64) -> String {
    let rounded = format!("{value:.5e}").parse().unwrap_or(value);
    if value.is_finite() { f64::to_string(&rounded) } else { "-".into() }
}

/// "10..1000".
fn short_band(low: f64, high: f64) -> String {
    format!("{low}..{high}")
}

/// The axis with its unit.
fn axis_title(axis: &TrendAxis) -> String {
    if axis.unit.is_empty() { axis.name.clone() } else { format!("{} {}", axis.name, axis.unit) }
}

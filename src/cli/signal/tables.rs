//! Tables of the signal analyses.

use super::line_tables::{MAX_LINES, band, level};
use rotordyn::io::measured::run_up::is_rotation_signal;
use rotordyn::results::{JerkResult, RaceResult, ShaftAverage, ShaftOrders, SignalResult};
use rotordyn::signal::kurtogram::BandChoice;
use rotordyn::signal::race_defects::DefectKind;
use rotordyn::signal::ridge::find_hann_lines;
use rotordyn::signal::spectrum::Spectrum;

use super::super::printed;
use super::super::terminal::{Terminal, counted, number};
use super::input::File;
use super::line_tables;
use super::record_speed;

/// Largest number of rows of the channel list.
const MAX_CHANNELS: usize = 24;
/// Most names of what states the rates.
const MAX_SOURCES: usize = 6;

/// Channels of a file.
pub fn channels(terminal: &Terminal, file: &File, chosen: &[&str]) {
    let records = &file.measured.records;
    let rows: Vec<Vec<String>> = records
        .iter()
        .take(MAX_CHANNELS)
        .map(|r| {
            let rate = r.sample_rate().map_or("-".into(), |rate| number(rate, 6));
            let unit = if r.unit.is_empty() { &r.file_unit } else { &r.unit };
            let role = match chosen.contains(&r.name.as_str()) {
                true => "analysed",
                false if is_rotation_signal(r) => "shaft",
                false => "",
            };
            vec![
                r.name.clone(),
                r.kind.label().into(),
                r.values.len().to_string(),
                rate,
                if unit.is_empty() { "-".into() } else { unit.clone() },
                role.into(),
            ]
        })
        .collect();
    let more = match records.len().saturating_sub(MAX_CHANNELS) {
        0 => String::new(),
        n => format!(" (and {n} more)"),
    };
    let channels = counted(records.len(), "channel", "channels");
    let title = format!("{}: {channels}{more}", file.path.display());
    terminal.table(&title, &["channel", "content", "samples", "rate Hz", "unit", "use"], &rows);
    // What states the rate, once for all channels that have it from there.
    let mut sources: Vec<&str> =
        file.measured.axis_sources.iter().map(|(_, source)| source.as_str()).collect();
    sources.dedup();
    if !sources.is_empty() {
        let more = if sources.len() > MAX_SOURCES { ", ..." } else { "" };
        let some = sources[..sources.len().min(MAX_SOURCES)].join(", ");
        terminal.print(&format!("  rate or axis from {some}{more}"));
    }
}

/// Shaft speed and bearing defect frequencies.
pub fn shaft_and_bearing(terminal: &Terminal, result: &SignalResult) {
    if let Some(s) = &result.shaft {
        let rpm = |rev: f64| number(60.0 * rev, 6);
        let speed = match s.steady {
            true => format!("{} rpm ({} Hz)", rpm(s.mean), number(s.mean, 6)),
            false => format!("{} to {} rpm, mean {}", rpm(s.min), rpm(s.max), rpm(s.mean)),
        };
        terminal.print(&format!("\nShaft: {speed}, {}", s.source));
    }
    if let Some(line) = record_speed::line(result) {
        terminal.print(&line);
    }
    if let Some(b) = &result.bearing {
        let o = &b.orders;
        terminal.print(&format!(
            "Bearing {} ({}): FTF {:.4}, BPFO {:.4}, BPFI {:.4}, BSF {:.4} per revolution",
            b.name, b.source, o.ftf, o.bpfo, o.bpfi, o.bsf
        ));
    }
}

/// Time-domain statistics, one row per channel.
pub fn statistics(terminal: &Terminal, results: &[SignalResult]) {
    let optional = |v: Option<f64>| v.map_or("-".into(), |v| format!("{v:.4}"));
    let rows: Vec<Vec<String>> = results
        .iter()
        .map(|r| {
            let s = &r.statistics;
            vec![
                r.channel.clone(),
                if r.unit.is_empty() { "-".into() } else { r.unit.clone() },
                number(s.mean, 4),
                number(s.rms, 5),
                number(s.peak, 5),
                optional(s.crest_factor),
                optional(s.kurtosis),
                optional(s.skewness),
            ]
        })
        .collect();
    let header = ["channel", "unit", "mean", "RMS", "peak", "crest factor", "kurtosis", "skewness"];
    terminal.table("Statistics (kurtosis 3 for a normal distribution)", &header, &rows);
}

/// Tables of all analyses of one channel.
pub fn channel(terminal: &Terminal, result: &SignalResult) {
    if let Some(spectrum) = &result.spectrum {
        peaks(terminal, result, spectrum);
    }
    if let Some(k) = &result.kurtogram {
        let BandChoice { low, high, value, .. } = k.kurtogram.best();
        let top = |s: &Spectrum| {
            // Skip 0 Hz and Nyquist: real-valued bins have a different kurtosis.
            let best = (1..s.values.len() - 1).max_by(|&a, &b| s.values[a].total_cmp(&s.values[b]));
            best.map_or((0.0, 0.0), |k| (s.frequencies[k], s.values[k]))
        };
        let (at, most) = top(&k.spectral);
        terminal.print(&format!(
            "\nKurtogram of {}: maximum {value:.2} in {}; maximum spectral kurtosis {most:.2} at {} Hz",
            result.channel,
            band((low, high)),
            number(at, 5)
        ));
    }
    if let Some(orders) = &result.orders {
        cuts(terminal, result, orders);
    }
    if let Some(average) = &result.average {
        synchronous_average(terminal, result, average);
    }
    if let Some(jerk) = &result.jerk {
        jerk_jumps(terminal, result, jerk);
    }
    printed::tables(terminal, &result.document());
    if let Some(envelope) = &result.envelope {
        line_tables::lines(terminal, result, envelope);
    }
}

/// The highest lines of a spectrum.
fn peaks(terminal: &Terminal, result: &SignalResult, spectrum: &Spectrum) {
    let mut found = find_hann_lines(&spectrum.frequencies, &spectrum.values, 0.0).unwrap_or_default();
    found.sort_by(|a, b| b.amplitude.total_cmp(&a.amplitude));
    let steady = result.shaft.as_ref().filter(|s| s.steady);
    let rows: Vec<Vec<String>> = found
        .iter()
        .take(MAX_LINES)
        .map(|p| {
            let order = steady.map_or("-".into(), |s| format!("{:.3}", p.position / s.mean));
            vec![number(p.position, 6), order, number(p.amplitude, 4)]
        })
        .collect();
    let title = format!("Highest lines in the spectrum of {}", result.channel);
    terminal.table(&title, &["Hz", "order", &level("peak", result)], &rows);
}

fn cuts(terminal: &Terminal, result: &SignalResult, orders: &ShaftOrders) {
    let rows: Vec<Vec<String>> = orders
        .cuts
        .iter()
        .filter_map(|(line, cut)| {
            let best = (0..cut.rms.len()).max_by(|&a, &b| cut.rms[a].total_cmp(&cut.rms[b]))?;
            let mean = (cut.rms.iter().map(|v| v * v).sum::<f64>() / cut.rms.len() as f64).sqrt();
            Some(vec![
                line.label.clone(),
                format!("{:.4}", line.order),
                number(mean, 4),
                number(cut.rms[best], 4),
                number(cut.rpm[best], 4),
            ])
        })
        .collect();
    let header = ["line", "order", &level("RMS", result), "peak RMS", "at rpm"];
    terminal.table(
        &format!("Orders of {}, {}", result.channel, counted(orders.map.rpm.len(), "window", "windows")),
        &header,
        &rows,
    );
}

fn synchronous_average(terminal: &Terminal, result: &SignalResult, found: &ShaftAverage) {
    let [all, periodic, rest] = found.rms;
    let share = if all > 0.0 { 100.0 * (periodic / all).powi(2) } else { 0.0 };
    terminal.print(&format!(
        "\nTime synchronous average of {} over {} revolutions: RMS {} of {} ({share:.1} % of the power is synchronous), \
         residual {}",
        result.channel,
        found.average.periods,
        number(periodic, 4),
        level(&number(all, 4), result),
        number(rest, 4)
    ));
}

fn jerk_jumps(terminal: &Terminal, result: &SignalResult, found: &JerkResult) {
    terminal.print(&format!("\nJerk of {}: {} jumps in the record", result.channel, found.jumps.len()));
    if let Some(race) = &found.race {
        defects(terminal, race);
    }
}

fn defects(terminal: &Terminal, race: &RaceResult) {
    let rows: Vec<Vec<String>> = race
        .defects
        .iter()
        .map(|d| {
            vec![
                match d.kind {
                    DefectKind::Dent => "dent".into(),
                    DefectKind::Bump => "bump".into(),
                },
                format!("{:.3}", d.angle.to_degrees()),
                format!("{:.3}", d.width.to_degrees()),
                race.radius.map_or("-".into(), |r| format!("{:.1}", 1e6 * r * d.width)),
                number(d.jumps[0], 4),
                number(d.jumps[1], 4),
            ]
        })
        .collect();
    let title = format!("Defects of the {} from jumps of the jerk", race.race);
    let header = ["kind", "start deg", "width deg", "width um", "entry jump", "exit jump"];
    terminal.table(&title, &header, &rows);
    if !race.full_circumference {
        terminal.print(
            "  angles are modulo one ball spacing; --quadrature-channel gives the channel at 90 deg that resolves them",
        );
    }
}

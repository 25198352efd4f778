//! Tables of a comparison.

use rotordyn::results::{
    CaseFrf, CaseUnbalance, FrfComparison, PairedMode, PairedModes, RunUpComparison, UnbalanceComparison,
    UnpairedVariant, VariantComparison,
};
use rotordyn::study::MEASURED;

use super::super::terminal::{Terminal, number, rpm};

/// Peaks of one FRF listed in a row.
const MAX_PEAKS: usize = 6;
/// Fraction of a channel's largest order below which an order is not listed.
const MIN_ORDER_LEVEL_RATIO: f64 = 1e-3;
/// Largest number of rows printed.
const MAX_ROWS: usize = 60;

/// Prints the natural frequencies at one speed.
pub fn modes(terminal: &Terminal, found: &VariantComparison, at: &PairedModes) {
    let mut header = vec!["mode"];
    let titles: Vec<String> = found.variants.iter().map(|name| format!("{name} Hz")).collect();
    header.extend(titles.iter().map(String::as_str));
    header.push("min MAC");
    let any_unpaired = at.modes.iter().any(|row| !row.unpaired.is_empty());
    if any_unpaired {
        header.push("without a pair");
    }
    let line = |row: &PairedMode| {
        let mut line = vec![row.label().to_string()];
        line.extend(
            row.modes.iter().map(|m| m.as_ref().map_or("-".into(), |m| format!("{:.3}", m.frequency_hz))),
        );
        line.push(row.mac.map_or("-".into(), |mac| format!("{mac:.3}")));
        if any_unpaired {
            line.push(row.unpaired.iter().map(describe).collect::<Vec<_>>().join("; "));
        }
        line
    };
    let rows: Vec<Vec<String>> = at.modes.iter().map(line).collect();
    terminal.table(&format!("Natural frequencies at {:.0} rpm", rpm(at.speed)), &header, &rows);
    if any_unpaired {
        terminal.print(&format!("  modes are paired from a MAC of {} on (--min-mac)", found.min_mac));
    }
}

fn describe(unpaired: &UnpairedVariant) -> String {
    let name = &unpaired.variant;
    match &unpaired.nearest {
        Some((mode, mac)) => format!("{name}: no pair, best MAC {mac:.2} at {:.3} Hz", mode.frequency_hz),
        None => format!("{name}: no modes"),
    }
}

/// Prints the peaks of every FRF, and how it agrees with the measured one.
pub fn frfs(terminal: &Terminal, found: &FrfComparison) {
    let is_measured = |curve: &CaseFrf| curve.case == MEASURED;
    let any_measured = found.pairs.iter().any(|pair| pair.curves.iter().any(is_measured));
    let mut header = vec!["response", "force at", "case", "peaks Hz"];
    if any_measured {
        header.extend(["FRAC", "level dB"]);
    }
    let mut rows = Vec::new();
    for pair in &found.pairs {
        for (k, curve) in pair.curves.iter().enumerate() {
            let ends = if k == 0 { [&*pair.response, &*pair.excitation] } else { ["", ""] };
            let mut row: Vec<String> = ends.map(String::from).to_vec();
            row.extend([curve.case.clone(), peaks(curve)]);
            if any_measured {
                row.push(curve.frac.map_or("-".into(), |frac| format!("{frac:.3}")));
                row.push(curve.level_db.map_or("-".into(), |level| format!("{level:+.1}")));
            }
            rows.push(row);
        }
    }
    terminal.table(&format!("Peaks of the {}s", found.quantity), &header, &rows);
    let mut notes = format!("  peaks of 6 dB or more, the {MAX_PEAKS} highest");
    if any_measured {
        notes += "; FRAC and mean level against the measured FRF, at its frequencies";
    }
    terminal.print(&notes);
}

/// The highest peaks, by frequency.
fn peaks(curve: &CaseFrf) -> String {
    let mut highest = curve.peaks.clone();
    highest.sort_by(|a, b| b.magnitude.total_cmp(&a.magnitude));
    highest.truncate(MAX_PEAKS);
    highest.sort_by(|a, b| a.hz.total_cmp(&b.hz));
    match &highest[..] {
        [] => "-".into(),
        peaks => peaks.iter().map(|p| format!("{:.2}", p.hz)).collect::<Vec<_>>().join(", "),
    }
}

/// Prints the largest amplitude of every probe in every case, and its resonances.
pub fn unbalance(terminal: &Terminal, found: &UnbalanceComparison) {
    let row = |probe: &str, unit: &str, c: &CaseUnbalance| {
        let [at, amplitude] = c.largest;
        let peaks: Vec<String> = c.peaks.iter().map(|p| format!("{:.0}", p.rpm)).collect();
        vec![
            probe.to_string(),
            c.case.clone(),
            number(amplitude, 4),
            unit.to_string(),
            format!("{at:.1}"),
            if peaks.is_empty() { "-".into() } else { peaks.join(", ") },
        ]
    };
    let mut rows = Vec::new();
    for probe in &found.probes {
        for (k, curve) in probe.curves.iter().enumerate() {
            rows.push(row(if k == 0 { &probe.probe } else { "" }, &probe.unit, curve));
        }
    }
    if !rows.is_empty() {
        let header = ["probe", "case", "largest", "unit", "at rpm", "peaks rpm"];
        terminal.table("Unbalance responses, amplitudes 0 to peak", &header, &rows);
    }
}

/// Prints levels and the peaks of the order cuts.
pub fn run_ups(terminal: &Terminal, found: &RunUpComparison) {
    let mut header = vec!["channel", "unit"];
    header.extend(found.cases.iter().map(String::as_str));
    let levels = |channel: &rotordyn::results::ComparedChannel| {
        let mut row = vec![channel.channel.clone(), channel.unit.clone()];
        row.extend(channel.runs.iter().map(|run| number(run.rms, 4)));
        row
    };
    let rows: Vec<Vec<String>> = found.channels.iter().map(levels).collect();
    terminal.table("Run-ups: RMS of the vibration", &header, &rows);
    let measured = found.cases.first().is_some_and(|name| name == MEASURED);
    let mut header = vec!["channel", "order", "case", "peak RMS", "unit", "at rpm"];
    if measured {
        header.push("correlation");
    }
    let mut rows = Vec::new();
    for channel in &found.channels {
        let all = channel.runs.iter().flat_map(|run| &run.cuts);
        let highest = all.map(|cut| cut.peak.rms).fold(0.0, f64::max);
        for label in channel.labels() {
            let cuts: Vec<_> =
                channel.runs.iter().filter_map(|run| Some((&run.case, run.cut(label)?))).collect();
            if cuts.iter().all(|(_, cut)| cut.peak.rms < MIN_ORDER_LEVEL_RATIO * highest) {
                continue;
            }
            for (k, (case, cut)) in cuts.into_iter().enumerate() {
                let ends = if k == 0 { [&*channel.channel, label] } else { ["", ""] };
                let end = if cut.peak.at_end { " (end)" } else { "" };
                let mut row: Vec<String> = ends.map(String::from).to_vec();
                row.extend([
                    case.clone(),
                    number(cut.peak.rms, 4),
                    channel.unit.clone(),
                    format!("{:.1}{end}", cut.peak.rpm),
                ]);
                if measured {
                    let own = cut.correlation.filter(|_| case != MEASURED);
                    row.push(own.map_or("-".into(), |value| format!("{value:.3}")));
                }
                rows.push(row);
            }
        }
    }
    let count = rows.len();
    rows.truncate(MAX_ROWS);
    terminal.table("Peaks of the order cuts", &header, &rows);
    if count > MAX_ROWS {
        terminal.print(&format!("  ... and {} more rows in --json and --csv", count - MAX_ROWS));
    }
    let mut notes = "  (end): at the lowest or highest speed".to_string();
    if measured {
        notes += "; correlation with the measured level over the run, 1 for proportional levels";
    }
    terminal.print(&notes);
}

//! Tables of bearing lines (BPFO, BPFI, BSF, FTF) in the envelope spectrum, and the diagnosis.

use rotordyn::results::{EnvelopeResult, SignalResult};
use rotordyn::signal::bearing_lines::{BearingLine, Modulation};
use rotordyn::signal::diagnosis::BandRule;
use rotordyn::signal::grading::Explanation;
use rotordyn::signal::ridge::find_peaks;

use super::super::terminal::{Terminal, number};

/// Demodulation band, bearing lines in the envelope spectrum, and diagnosis.
pub fn lines(terminal: &Terminal, result: &SignalResult, envelope: &EnvelopeResult) {
    let why = match envelope.rule {
        BandRule::Given(..) => "as given",
        BandRule::Whole => "full band",
        BandRule::Kurtosis => "maximum of the kurtogram",
        BandRule::Lines => "most evidence of a damaged part",
    };
    let title_suffix = format!("envelope of {} in {}, {why}", result.channel, band(envelope.band));
    let Some(found) = &envelope.lines else {
        let unit = if envelope.over_orders { "order" } else { "Hz" };
        let mut highest =
            find_peaks(&envelope.spectrum.frequencies, &envelope.spectrum.values, 0.0).unwrap_or_default();
        highest.sort_by(|a, b| b.amplitude.total_cmp(&a.amplitude));
        let rows: Vec<Vec<String>> = highest
            .iter()
            .take(MAX_LINES)
            .map(|p| vec![number(p.position, 5), number(p.amplitude, 4)])
            .collect();
        terminal.table(&format!("Highest lines, {title_suffix}"), &[unit, &level("peak", result)], &rows);
        terminal.print(
            "  no bearing diagnosis: give the bearing with --bearing, or its orders with --bearing-orders",
        );
        return;
    };
    let unit = if envelope.over_orders { "order" } else { "Hz" };
    let rows: Vec<Vec<String>> = found
        .families
        .iter()
        .flat_map(|family| {
            let harmonic = |n: usize| family.lines.iter().find(|l| l.harmonic == n && l.modulation.is_none());
            // The first harmonic of every part, three of detected parts.
            (1..=if family.detected { 3 } else { 1 }).filter_map(harmonic)
        })
        .map(row)
        .collect();
    let [expected, at] = ["expected", "measured"].map(|name| format!("{name} {unit}"));
    let amplitude = level("peak", result);
    let header = ["line", &expected, &at, "deviation %", &amplitude, "above background dB", ""];
    terminal.table(&format!("Bearing lines, {title_suffix}"), &header, &rows);
    let bands: Vec<Vec<String>> = found
        .diagnosis
        .map(|part| found.family(part))
        .into_iter()
        .flat_map(|family| family.lines.iter().filter(|l| l.modulation.is_some() && l.significant))
        .take(MAX_LINES)
        .map(row)
        .collect();
    if !bands.is_empty() {
        terminal.table("Sidebands", &header, &bands);
    }
    print_diagnosis(terminal, result, envelope);
}

fn row(line: &BearingLine) -> Vec<String> {
    let word = match (line.significant, line.shared) {
        (true, false) => "detected",
        (true, true) => "coincides with a shaft order or a stronger line",
        (false, _) => "not above background",
    };
    // Without a significant line the highest bin is only noise.
    let (at, off) = match line.significant {
        true => {
            (number(line.frequency, 6), format!("{:+.2}", 100.0 * (line.frequency / line.expected - 1.0)))
        }
        false => ("-".into(), "-".into()),
    };
    vec![
        modulation(line),
        number(line.expected, 6),
        at,
        off,
        number(line.amplitude, 4),
        format!("{:.1}", line.level_db),
        word.into(),
    ]
}

fn print_diagnosis(terminal: &Terminal, result: &SignalResult, envelope: &EnvelopeResult) {
    let (Some(graded), Some(found)) = (&envelope.graded, &envelope.lines) else { return };
    let unit = if envelope.over_orders { "order" } else { "Hz" };
    let open: Vec<Vec<String>> = graded
        .strong_lines
        .iter()
        .filter(|line| matches!(line.explanation, Explanation::Unexplained | Explanation::Periodic(_)))
        .take(MAX_LINES)
        .map(|line| {
            let of = match line.explanation {
                Explanation::Periodic(rate) => {
                    format!("{:.0} x {} {unit}", (line.frequency / rate).round(), number(rate, 5))
                }
                _ => "unexplained".into(),
            };
            vec![number(line.frequency, 6), number(line.amplitude, 4), format!("{:.1}", line.level_db), of]
        })
        .collect();
    if !open.is_empty() {
        let header = [unit, &level("peak", result), "above background dB", "family"];
        terminal.table("Strong lines that are neither of this bearing nor of the shaft", &header, &open);
    }
    let name = graded.statement(envelope.frequency_unit());
    terminal.heading(&match found.strongest_line() {
        Some(line) if found.diagnosis == Some(line.part) => {
            format!(
                "Bearing diagnosis of {}: {name} ({:.1} dB above background at {})",
                result.channel,
                line.level_db,
                modulation(line)
            )
        }
        _ => format!("Bearing diagnosis of {}: {name}", result.channel),
    });
}

fn modulation(line: &BearingLine) -> String {
    let harmonic = match line.harmonic {
        1 => line.part.line_name().to_string(),
        n => format!("{n}x {}", line.part.line_name()),
    };
    match line.modulation {
        None => harmonic,
        Some(Modulation::Shaft(n)) => format!("{harmonic} {} fr", signed(n)),
        Some(Modulation::Cage(n)) => format!("{harmonic} {} FTF", signed(n)),
    }
}

/// "+", "- 2".
fn signed(n: i32) -> String {
    let sign = if n < 0 { "-" } else { "+" };
    if n.abs() == 1 { sign.into() } else { format!("{sign} {}", n.abs()) }
}

/// Largest number of rows of a list of lines.
pub const MAX_LINES: usize = 8;

/// "RMS m/s^2", or "RMS" alone.
pub fn level(what: &str, result: &SignalResult) -> String {
    format!("{what} {}", result.unit).trim_end().to_string()
}

/// "500.00 to 5500.0 Hz".
pub fn band((low, high): (f64, f64)) -> String {
    format!("{} to {} Hz", number(low, 5), number(high, 5))
}

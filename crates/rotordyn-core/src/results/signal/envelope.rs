//! Envelope spectrum and the lines of a bearing in it.

use super::curves::{bands, highest_peaks, over_axis, peak_rows};
use crate::document::{Document, Rows, Value, in_hdf5, in_json};
use rotordyn_signal::bearing_lines::{BearingLine, BearingLines, Modulation};
use rotordyn_signal::diagnosis::BandRule;
use rotordyn_signal::grading::{Explanation, GradedDiagnosis, StrongLine};
use rotordyn_signal::kurtogram::Kurtogram;
use rotordyn_signal::spectrum::Spectrum;
use serde::{Deserialize, Serialize};

/// Envelope (demodulated) spectrum of a band, and the bearing's lines in it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EnvelopeResult {
    pub rule: BandRule,
    /// Band \[Hz\].
    pub band: (f64, f64),
    /// Amplitude spectrum \[unit\], over Hz, or over orders at varying speed.
    pub spectrum: Spectrum,
    pub over_orders: bool,
    /// Score of every candidate band.
    pub band_scores: Option<Kurtogram>,
    /// Lines and diagnosis if a bearing is known.
    pub lines: Option<BearingLines>,
    /// Diagnosis with its probability, rivals and unexplained lines if a bearing is known.
    pub graded: Option<GradedDiagnosis>,
}

impl EnvelopeResult {
    /// Unit of its frequencies in statements: "Hz", or "x" for orders.
    pub fn frequency_unit(&self) -> &'static str {
        if self.over_orders { "x" } else { "Hz" }
    }

    /// What is said of the bearing, such as "outer race, 98 %"; `None` without a bearing.
    pub fn statement(&self) -> Option<String> {
        self.graded.as_ref().map(|graded| graded.statement(self.frequency_unit()))
    }

    pub(super) fn document(&self, unit: &str) -> Document<'_> {
        let rule = match self.rule {
            BandRule::Given(..) => "given",
            BandRule::Whole => "full_band",
            BandRule::Kurtosis => "kurtosis",
            BandRule::Lines => "lines",
        };
        let (axis, axis_unit) =
            if self.over_orders { ("order", "1/revolution") } else { ("frequency", "Hz") };
        let s = &self.spectrum;
        let peaks = peak_rows(&highest_peaks(&s.frequencies, &s.values), "measured", "amplitude");
        let content = over_axis(s, axis, axis_unit, unit)
            .numbers(in_json("band_hz"), "Hz", vec![self.band.0, self.band.1])
            .text(in_json("rule"), rule)
            .text(in_json("axis"), if self.over_orders { "order" } else { "Hz" })
            .with(in_json("peaks"), peaks)
            .and_if(self.graded.as_ref(), |out, graded| {
                out.and(graded_document(graded, self.frequency_unit()))
            })
            .and_if(self.lines.as_ref(), |out, lines| out.and(lines_document(lines)));
        let score_unit = if self.rule == BandRule::Lines { "dB" } else { "1" };
        Document::new()
            .group("envelope", content)
            .number(in_hdf5("band_low"), "Hz", self.band.0)
            .number(in_hdf5("band_high"), "Hz", self.band.1)
            .and_if(self.band_scores.as_ref(), |out, scores| {
                out.with(in_hdf5("band_scores"), bands(scores, score_unit))
            })
            .and_if(self.lines.as_ref(), |out, lines| {
                out.text(in_hdf5("diagnosis"), lines.diagnosis_name())
                    .table(in_hdf5("lines"), line_table(lines, axis_unit, unit))
            })
            .and_if(self.graded.as_ref(), |out, graded| {
                out.text(in_hdf5("statement"), graded.statement(self.frequency_unit()))
                    .number(in_hdf5("probability"), "1", graded.probability)
                    .table(in_hdf5("strong_lines"), strong_line_table(graded, axis_unit, unit))
            })
    }
}

/// Statement, probability, rivals and strong lines, JSON only.
fn graded_document<'a>(graded: &GradedDiagnosis, unit: &str) -> Document<'a> {
    let rivals = Rows::of(&graded.rivals)
        .text(in_json("source"), |r| r.name())
        .number(in_json("rate"), "", |r| r.rate)
        .integer(in_json("lines"), |r| r.lines)
        .number(in_json("amplitude"), "", |r| r.amplitude);
    let strong = Rows::of(&graded.strong_lines)
        .number(in_json("measured"), "", |l| l.frequency)
        .number(in_json("amplitude"), "", |l| l.amplitude)
        .number(in_json("level_db"), "dB", |l| l.level_db)
        .text(in_json("explained_by"), explanation);
    Document::new()
        .text(in_json("statement"), graded.statement(unit))
        .text(in_json("candidate"), graded.candidate.name())
        .number(in_json("candidate_frequency"), "", graded.frequency)
        .number(in_json("probability"), "1", graded.probability)
        .table(in_json("rivals"), rivals)
        .table(in_json("strong_lines"), strong)
}

/// What a strong line belongs to: "outer race", "3x shaft", "mains", "beat of shaft and mains", "12.42 x 3" or "unexplained".
fn explanation(line: &StrongLine) -> String {
    match line.explanation {
        Explanation::Bearing(part) => part.name().into(),
        Explanation::Shaft(order) => format!("shaft {order}x"),
        Explanation::Mains => "mains".into(),
        Explanation::Beat => "beat of shaft and mains".into(),
        Explanation::Periodic(rate) => {
            format!("{:.0} x {}", (line.frequency / rate).round(), crate::document::number(rate, 4))
        }
        Explanation::Unexplained => "unexplained".into(),
    }
}

/// Strong lines, HDF5 only.
fn strong_line_table<'a, 'r>(
    graded: &'r GradedDiagnosis,
    axis_unit: &str,
    unit: &str,
) -> Rows<'a, 'r, StrongLine> {
    Rows::of(&graded.strong_lines)
        .text("explained_by", explanation)
        .number("measured", axis_unit, |l| l.frequency)
        .number("amplitude", unit, |l| l.amplitude)
        .number("level", "dB", |l| l.level_db)
}

/// Diagnosis and lines by family, JSON only.
fn lines_document(lines: &BearingLines) -> Document<'_> {
    let families = Rows::of(&lines.families)
        .text(in_json("part"), |f| f.part.name())
        .text(in_json("line"), |f| f.part.line_name())
        .number(in_json("expected"), "", |f| f.expected)
        .number(in_json("fitted"), "", |f| f.frequency)
        .flag(in_json("detected"), |f| f.detected)
        .number(in_json("strength"), "", |f| f.strength)
        .nested(in_json("lines"), |f| &f.lines, line_columns);
    let out = Document::new().text(in_json("diagnosis"), lines.diagnosis_name());
    let out = match lines.strongest_line() {
        Some(line) => out.record(in_json("strongest"), line_columns(Rows::of([line]))),
        None => out.with(in_json("strongest"), Value::Missing),
    };
    out.table(in_json("families"), families)
}

fn line_columns<'a, 'r>(rows: Rows<'a, 'r, BearingLine>) -> Rows<'a, 'r, BearingLine> {
    rows.text("line", |l| l.part.line_name())
        .integer("harmonic", |l| l.harmonic)
        .optional_text("sideband_of", |l| match l.modulation? {
            Modulation::Shaft(_) => Some("shaft"),
            Modulation::Cage(_) => Some("cage"),
        })
        .signed("sideband_order", |l| match l.modulation {
            None => 0,
            Some(Modulation::Shaft(n) | Modulation::Cage(n)) => n.into(),
        })
        .number("expected", "", |l| l.expected)
        .number("measured", "", |l| l.frequency)
        .number("amplitude", "", |l| l.amplitude)
        .number("background", "", |l| l.background)
        .number("level_db", "dB", |l| l.level_db)
        .number("probability", "1", |l| l.probability)
        .flag("significant", |l| l.significant)
        .flag("coincident", |l| l.shared)
}

/// One row for every line searched, HDF5 only.
fn line_table<'a, 'r>(lines: &'r BearingLines, axis_unit: &str, unit: &str) -> Rows<'a, 'r, BearingLine> {
    Rows::of(lines.families.iter().flat_map(|f| &f.lines))
        .text("name", |line| {
            let side = match line.modulation {
                None => String::new(),
                Some(Modulation::Shaft(n)) => format!(" {n:+} fr"),
                Some(Modulation::Cage(n)) => format!(" {n:+} FTF"),
            };
            format!("{} {}{side}", line.harmonic, line.part.line_name())
        })
        .number("expected", axis_unit, |l| l.expected)
        .number("measured", axis_unit, |l| l.frequency)
        .number("amplitude", unit, |l| l.amplitude)
        .number("background", unit, |l| l.background)
        .number("level", "dB", |l| l.level_db)
        .number("probability", "1", |l| l.probability)
        .flag("significant_not_coincident", |l| l.significant && !l.shared)
}

//! Run-ups of several cases of a machine, and a measured one, on common axes.

use super::{CutPeak, OrderResult, SpectrogramResult};
use crate::document::{Document, Rows};
use serde::{Deserialize, Serialize};

/// Run-ups at the channels that they have in common.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct RunUpComparison {
    /// Names of the runs; a measured one first.
    pub cases: Vec<String>,
    pub channels: Vec<ComparedChannel>,
    /// Channels that are not compared, with the reason.
    pub left_out: Vec<String>,
}

/// One channel in every run.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct ComparedChannel {
    pub channel: String,
    pub unit: String,
    /// One for every case.
    pub runs: Vec<CaseRun>,
}

/// One channel of one run.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct CaseRun {
    pub case: String,
    /// RMS of the vibration (mean removed) over the whole run.
    pub rms: f64,
    pub spectrogram: Option<SpectrogramResult>,
    pub orders: Option<OrderResult>,
    pub cuts: Vec<CaseCut>,
}

/// One order of one run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CaseCut {
    /// Such as "2 BPFO".
    pub label: String,
    pub order: f64,
    pub peak: CutPeak,
    /// Correlation (Σ m c)² / (Σ m² Σ c²) with the level of the measured run over time; `None` without one.
    pub correlation: Option<f64>,
    pub points: Vec<CutPoint>,
}

/// Level of an order at one speed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CutPoint {
    pub rpm: f64,
    pub rms: f64,
}

impl CaseRun {
    /// The cut of an order by its label.
    pub fn cut(&self, label: &str) -> Option<&CaseCut> {
        self.cuts.iter().find(|cut| cut.label == label)
    }
}

impl ComparedChannel {
    /// Labels of the orders, each once, in the order of the first run that has them.
    pub fn labels(&self) -> Vec<&str> {
        let mut labels: Vec<&str> = Vec::new();
        for cut in self.runs.iter().flat_map(|run| &run.cuts) {
            if !labels.contains(&cut.label.as_str()) {
                labels.push(&cut.label);
            }
        }
        labels
    }
}

impl RunUpComparison {
    /// What is written to files; spectrograms are in the results of each case.
    pub fn document(&self) -> Document<'_> {
        let channels =
            Rows::of(&self.channels).text("channel", |c| &c.channel).text("unit", |c| &c.unit).nested(
                "runs",
                |c| &c.runs,
                |rows| {
                    rows.text("case", |r| &r.case).number("rms", "", |r| r.rms).nested(
                        "orders",
                        |r| &r.cuts,
                        |rows| {
                            rows.text("label", |c| &c.label)
                                .number("order", "1/revolution", |c| c.order)
                                .number("peak_rpm", "rpm", |c| c.peak.rpm)
                                .number("peak_rms", "", |c| c.peak.rms)
                                .flag("at_end", |c| c.peak.at_end)
                                .optional("correlation", "1", |c| c.correlation)
                                .nested(
                                    "points",
                                    |c| &c.points,
                                    |rows| rows.number("rpm", "rpm", |p| p.rpm).number("rms", "", |p| p.rms),
                                )
                        },
                    )
                },
            );
        Document::new()
            .texts("cases", &self.cases)
            .table("channels", channels)
            .texts("left_out", &self.left_out)
    }
}

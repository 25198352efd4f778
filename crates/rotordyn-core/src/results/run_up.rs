//! A run-up, and its reliability: error of its time step, dependence on the initial cage phase.

use super::history::History;
use super::run_summary::RunSummary;
use super::{OrderLine, RollingCageComparison};
use crate::document::{Array, Document, Rows, Value, in_hdf5, in_json, named, quantity};
use crate::transient::peak_loads::PeakLoad;
use crate::transient::run::{End, Report};
use rotordyn_signal::order::OrderCut;
use serde::{Deserialize, Serialize};

/// A run-up: size and accuracy of the reduced model, recorded samples, report of the integration.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct RunUpResult {
    /// Numbers of vibration modes and static correction modes of the reduced model.
    pub modes: usize,
    pub corrections: usize,
    /// Largest relative error of the reduced static equilibrium.
    pub static_error: f64,
    /// Largest relative error of the reduced model's damped frequencies up to half the cutoff, at top speed.
    pub frequency_error: f64,
    pub history: History,
    /// Extremes and levels of the samples.
    pub summary: RunSummary,
    pub report: Report,
    /// Requested step \[s\]; the step used divides the sampling interval.
    pub requested_step: f64,
    /// Bearings with balls and their cage angle at the start \[rad\].
    pub cage_angles: Vec<(String, f64)>,
    /// Estimated error of the order levels by the step.
    pub step_error: Option<StepError>,
    /// Free balls beside cages that roll without slip, if there are free balls.
    pub cage_comparison: Option<RollingCageComparison>,
    /// The largest loads of the bearings, at the samples.
    #[serde(default)]
    pub peak_loads: Vec<PeakLoad>,
}

impl RunUpResult {
    /// Whether balls were free bodies: the run then recorded their mean angle.
    pub fn has_free_balls(&self) -> bool {
        self.history.channels.iter().any(|channel| channel.name.ends_with("_ball_angle"))
    }

    /// What is written to files; the samples are streamed.
    pub fn document(&self) -> Document<'_> {
        let (report, e) = (&self.report, &self.report.energy);
        let end = match &report.end {
            End::Complete => "complete".to_string(),
            End::Stopped => "stopped".to_string(),
            End::Failed(error) => format!("failed: {error}"),
        };
        let energy = |name: &str| named(name, format!("energy_{name}"));
        let energy = Document::new()
            .number(energy("work"), "J", e.work)
            .number(energy("drive_work"), "J", e.drive)
            .number(energy("parametric_work"), "J", e.parametric)
            .number(energy("damping_loss"), "J", e.damping_loss)
            .number(energy("contact_loss"), "J", e.contact_loss)
            .number(energy("residual"), "J", e.residual())
            .number(in_json("stored_start"), "J", e.start)
            .number(in_json("stored_end"), "J", e.stored())
            .number(in_json("stored_change"), "J", e.stored() - e.start)
            .number(in_json("kinetic_end"), "J", e.kinetic)
            .number(in_json("strain_end"), "J", e.strain)
            .number(in_json("contact_end"), "J", e.contact);
        let cages = Rows::of(&self.cage_angles).text("bearing", |(bearing, _)| bearing).number(
            "initial_rad",
            "rad",
            |(_, angle)| *angle,
        );
        let mut out = Document::new()
            .integer("reduced_modes", self.modes)
            .integer("static_correction_modes", self.corrections)
            .number("static_error", "1", self.static_error)
            .number("frequency_error", "1", self.frequency_error)
            .text("end", end)
            .optional(quantity("step", "s"), "s", report.step)
            .quantity("requested_step", "s", self.requested_step)
            .and(StepError::document(self.step_error.as_ref()))
            .table(in_json("cage_angles"), cages)
            .count("steps", report.steps)
            .count("iterations", report.iterations)
            .count("halvings", report.halvings)
            .group(named("energy_j", ""), energy)
            .number(in_json("sample_rate_hz"), "Hz", self.history.sample_rate)
            .integer(in_json("samples"), self.summary.samples)
            .integer(in_hdf5("samples"), report.samples)
            .with(in_json("channels"), Value::Table(self.summary.columns(&self.history.channels)));
        if let Some(step) = report.defect_step {
            out = out.quantity("defect_step", "s", step);
        }
        if let Some(comparison) = &self.cage_comparison {
            out = out.group("cage_comparison", comparison.document());
        }
        for (bearing, angle) in &self.cage_angles {
            out = out.number(in_hdf5(format!("initial_cage_angle_{bearing}")), "rad", *angle);
        }
        out
    }
}

/// Estimated error of a run-up's order levels by its time step, from a rerun of a stretch with another step.
///
/// By Richardson extrapolation, the error of a level L(h) of second order is (L(2h) − L(h))/3.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StepError {
    /// Start and end of the comparison \[s\], around the largest response; the rerun begins earlier.
    pub stretch: [f64; 2],
    /// Step of the rerun \[s\].
    pub other_step: f64,
    /// Mean speed in the stretch \[rad/s\].
    pub speed: f64,
    pub lines: Vec<StepErrorLine>,
    /// Steps of the rerun, and their share of the run's.
    pub steps: u64,
    pub cost: f64,
}

/// One order line of one channel in the stretch.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StepErrorLine {
    pub channel: String,
    pub line: OrderLine,
    /// RMS level with the step of the run and with that of the rerun.
    pub level: f64,
    pub other_level: f64,
    /// Estimated relative error of the level.
    pub error: f64,
}

impl StepError {
    /// What is written to files: null in JSON if there is none.
    pub fn document(found: Option<&Self>) -> Document<'_> {
        let Some(found) = found else { return Document::new().with(in_json("step_error"), Value::Missing) };
        let lines = Rows::of(&found.lines)
            .text("channel", |l| &l.channel)
            .text("label", |l| &l.line.label)
            .number("order", "1/revolution", |l| l.line.order)
            .number(in_json("rms"), "", |l| l.level)
            .number(in_json("rerun_rms"), "", |l| l.other_level)
            .number("relative_error", "1", |l| l.error);
        let group = Document::new()
            .quantity("start", "s", found.stretch[0])
            .quantity("end", "s", found.stretch[1])
            .quantity("speed", "rad/s", found.speed)
            .number(in_json("rerun_step_s"), "s", found.other_step)
            .count(in_json("steps"), found.steps)
            .number("share_of_steps", "1", found.cost)
            .table(named("lines", ""), lines)
            .optional(in_json("largest_relative_error"), "1", found.worst().map(|l| l.error.abs()));
        Document::new().group("step_error", group)
    }

    /// The line with the largest error.
    pub fn worst(&self) -> Option<&StepErrorLine> {
        self.lines.iter().max_by(|a, b| a.error.abs().total_cmp(&b.error.abs()))
    }
}

/// Order cuts of run-ups that differ in the initial cage angles only.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CagePhaseBand {
    /// Bearings whose cage angle is varied.
    pub bearings: Vec<String>,
    /// Initial cage angle of every one of them in every run \[rad\]; the first run is that of the model.
    pub angles: Vec<Vec<f64>>,
    pub channels: Vec<CagePhaseChannel>,
}

/// Range of one channel's order cuts over the cage phases.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CagePhaseChannel {
    pub channel: String,
    pub unit: String,
    pub lines: Vec<CagePhaseLine>,
}

/// Range of one order cut.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CagePhaseLine {
    pub line: OrderLine,
    /// Speed of every window \[rpm\] and level in the run of the model \[RMS\].
    pub cut: OrderCut,
    /// Smallest and largest level over all runs in every window.
    pub minimum: Vec<f64>,
    pub maximum: Vec<f64>,
    /// Largest level of every run over all windows.
    pub peaks: Vec<f64>,
}

impl CagePhaseBand {
    /// What is written to files.
    pub fn document(&self) -> Document<'_> {
        let angles = Array::real(&[self.angles.len(), self.bearings.len()], "rad", self.angles.concat());
        let channels = Rows::of(&self.channels)
            .text("channel", |c| &c.channel)
            .text("unit", |c| &c.unit)
            .nested("cuts", |c| &c.lines, CagePhaseLine::columns);
        let mut out = Document::new()
            .texts(named("bearings", "bearing"), &self.bearings)
            .array(named("angles_rad", "angle"), angles)
            .table(in_json("channels"), channels);
        for channel in &self.channels {
            let Some(first) = channel.lines.first() else { continue };
            let windows = [channel.lines.len(), first.cut.rpm.len()];
            let all = |pick: fn(&CagePhaseLine) -> &[f64]| {
                let values: Vec<f64> = channel.lines.iter().flat_map(pick).copied().collect();
                Array::real(&windows, &channel.unit, values)
            };
            let group = Document::new()
                .texts("label", channel.lines.iter().map(|l| &l.line.label))
                .numbers("rpm", "rpm", &first.cut.rpm)
                .array("rms", all(|l| &l.cut.rms))
                .array("minimum", all(|l| &l.minimum))
                .array("maximum", all(|l| &l.maximum));
            out = out.group(in_hdf5(&channel.channel), group);
        }
        out
    }
}

impl CagePhaseLine {
    fn columns<'a, 'r>(rows: Rows<'a, 'r, Self>) -> Rows<'a, 'r, Self> {
        rows.text("label", |l| &l.line.label)
            .number("order", "1/revolution", |l| l.line.order)
            .series("speed_rpm", "rpm", |l| &l.cut.rpm)
            .series("rms", "", |l| &l.cut.rms)
            .series("minimum", "", |l| &l.minimum)
            .series("maximum", "", |l| &l.maximum)
            .series("peaks", "", |l| &l.peaks)
    }
}

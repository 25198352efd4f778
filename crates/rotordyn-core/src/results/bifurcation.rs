//! Bifurcation diagrams.

use super::steady::{SectionChannel, exponent_document, motion_document};
use crate::document::{Array, Document, Rows, Value, in_hdf5, in_json};
use crate::model::study::Parameter;
use rotordyn_signal::lyapunov::LyapunovExponent;
use rotordyn_signal::motion_classification::Classification;
use serde::{Deserialize, Serialize};

/// Poincaré sections over a parameter.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct BifurcationResult {
    pub parameter: Parameter,
    /// Name of the clock.
    pub clock: String,
    pub channels: Vec<SectionChannel>,
    /// The computed sweeps: up, down, or one from equilibrium.
    pub sweeps: Vec<BifurcationSweep>,
    /// Number of seams between chunks, and number of chunks rerun because they started on another branch.
    pub seams: usize,
    pub rerun_chunks: usize,
    /// Whether every value was computed; the others have the reason "stopped".
    pub complete: bool,
}

/// One sweep of a bifurcation diagram, in the order of its values.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct BifurcationSweep {
    /// "up", "down", or "from equilibrium".
    pub name: String,
    pub points: Vec<BifurcationPoint>,
}

/// The motion at one value of the parameter.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct BifurcationPoint {
    /// In the parameter's unit.
    pub value: f64,
    pub motion: Result<SteadyMotion, String>,
}

/// A steady motion: Poincaré sections, extremes and classification.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct SteadyMotion {
    /// Section of every channel.
    pub sections: Vec<Vec<f64>>,
    /// Minimum and maximum of every channel over the whole orbit.
    pub extremes: Vec<[f64; 2]>,
    /// Frequency of the sections \[Hz\].
    pub frequency: f64,
    pub motion: Classification,
    /// Periods discarded as transient: more than requested if the motion had not settled.
    pub transient_periods: usize,
    /// Largest Lyapunov exponent, if requested.
    pub exponent: Option<LyapunovExponent>,
}

impl BifurcationResult {
    /// What is written to files: in HDF5 all quantities of a sweep over the parameter's values, NaN where no steady
    /// motion was found.
    pub fn document(&self) -> Document<'_> {
        let channels = Rows::of(&self.channels).text("name", |c| &c.name).text("unit", |c| &c.unit);
        let sweeps = self.sweeps.iter().map(|sweep| {
            let points = sweep.points.iter().map(BifurcationPoint::document);
            Document::new().text("name", &sweep.name).list("points", points)
        });
        let mut out = Document::new()
            .with("parameter", Value::Texts(self.parameter.paths.clone()))
            .text("unit", &self.parameter.unit)
            .text("clock", &self.clock)
            .table(in_json("channels"), channels)
            .integer("chunk_boundaries", self.seams)
            .integer("rerun_chunks", self.rerun_chunks)
            .flag("complete", self.complete)
            .list("sweeps", sweeps);
        for sweep in &self.sweeps {
            out = out.table(in_hdf5(sweep.name.replace(' ', "_")), self.columns(sweep));
        }
        out
    }

    fn columns<'r>(&self, sweep: &'r BifurcationSweep) -> Rows<'static, 'r, BifurcationPoint> {
        let found = |p: &'r BifurcationPoint| p.motion.as_ref().ok();
        let number = |p, value: &dyn Fn(&'r SteadyMotion) -> f64| found(p).map_or(f64::NAN, value);
        let period = |m: &SteadyMotion| m.motion.motion.period().map_or(f64::NAN, |k| k as f64);
        let clock = "periods of the clock";
        let mut rows = Rows::of(&sweep.points)
            .over("value")
            .number("value", &self.parameter.unit, |p| p.value)
            .text("motion", BifurcationPoint::motion_name)
            .number("period", clock, |p| number(p, &period))
            .number("recurrence", "1", |p| number(p, &|m| m.motion.recurrence))
            .number("zero_one", "1", |p| number(p, &|m| m.motion.zero_one_k))
            .number("settled", "1", |p| number(p, &|m| f64::from(m.motion.motion.is_settled())))
            .number("residual", "1", |p| number(p, &|m| m.motion.residual))
            .number("decay_factor", "1", |p| number(p, &|m| m.motion.decay_factor))
            .number("transient_periods", clock, |p| number(p, &|m| m.transient_periods as f64))
            .number("frequency", "Hz", |p| number(p, &|m| m.frequency));
        if sweep.points.iter().filter_map(found).any(|m| m.exponent.is_some()) {
            let exponent = |p, value: fn(&LyapunovExponent) -> f64| {
                number(p, &|m| m.exponent.as_ref().map_or(f64::NAN, value))
            };
            rows = rows.number("exponent", "1/s", |p| exponent(p, |e| e.value)).number(
                "standard_error",
                "1/s",
                |p| exponent(p, |e| e.standard_error),
            );
        }
        let sections = sweep.points.iter().filter_map(found).flat_map(|m| &m.sections);
        let longest = sections.map(Vec::len).max().unwrap_or(0);
        for (c, channel) in self.channels.iter().enumerate() {
            let name = |quantity: &str| format!("channels/{}/{quantity}", channel.name);
            rows = rows
                .numbers(name("section"), &channel.unit, &[longest], |p| {
                    let mut section = found(p).map_or_else(Vec::new, |m| m.sections[c].clone());
                    section.resize(longest, f64::NAN);
                    section
                })
                .number(name("minimum"), &channel.unit, |p| number(p, &|m| m.extremes[c][0]))
                .number(name("maximum"), &channel.unit, |p| number(p, &|m| m.extremes[c][1]));
        }
        rows
    }
}

impl BifurcationPoint {
    /// Kind of the motion, or why none was found.
    fn motion_name(&self) -> String {
        match &self.motion {
            Ok(found) => found.motion.motion.name(),
            Err(reason) => format!("none: {reason}"),
        }
    }

    fn document(&self) -> Document<'_> {
        let out = Document::new().number("value", "", self.value);
        let found = match &self.motion {
            Ok(found) => found,
            Err(reason) => return out.text("failure", reason),
        };
        let sections = Rows::of(&found.sections).series("", "", |section| section);
        let exponent = found.exponent.as_ref().map(exponent_document);
        out.group("motion", motion_document(&found.motion))
            .quantity("frequency", "Hz", found.frequency)
            .integer("transient_periods", found.transient_periods)
            .table("sections", sections)
            .array("extremes", Array::real(&[found.extremes.len(), 2], "", found.extremes.concat()))
            .with("exponent", exponent.map_or(Value::Missing, Value::Group))
    }
}

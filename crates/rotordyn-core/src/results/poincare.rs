//! Poincaré sections.

use super::steady::{RecordedPeriods, SectionChannel, SectionClock, motion_document};
use crate::document::{Array, Document, Rows, Value, in_hdf5, in_json, named};
use rotordyn_signal::motion_classification::Classification;
use rotordyn_signal::orbit::FilteredOrbit;
use serde::{Deserialize, Serialize};

/// Orbits at steady speed with their Poincaré sections.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct PoincareResult {
    /// Ω \[rad/s\].
    pub speed: f64,
    pub clock: SectionClock,
    pub motion: Classification,
    /// Periods discarded as transient: more than requested if the motion had not settled.
    pub transient_periods: usize,
    /// Number of clusters of section points, all planes together.
    pub groups: usize,
    /// Shaft angle at every sample of the orbits \[rad\].
    pub shaft_angle: Vec<f64>,
    pub planes: Vec<PlaneSection>,
    /// Periods recorded when the run was stopped before its end; the motion is that of these alone.
    pub partial: Option<RecordedPeriods>,
}

/// One plane of an orbit.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct PlaneSection {
    pub name: String,
    pub axes: [SectionChannel; 2],
    /// The orbit over its last periods, evenly sampled in time.
    pub orbit: [Vec<f64>; 2],
    /// Sampling rate of the orbit \[Hz\].
    pub sample_rate: f64,
    /// Section points, one per period of the clock.
    pub section: [Vec<f64>; 2],
    /// Only for a shaft orbit, x and y of one point.
    pub whirl: Option<Whirl>,
    /// Radius of the bearing's clearance circle \[m\], for a fixed housing.
    pub clearance: Option<f64>,
}

/// Whirl direction and 1x component of an orbit in x and y.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Whirl {
    /// Area swept forward (from x towards y, with the spin) minus backward, over their sum: 1 is all forward.
    pub forwardness: f64,
    /// The 1x (synchronous) component, by least squares over the whole record with Hann's weights.
    pub synchronous: FilteredOrbit,
}

impl Whirl {
    /// "forward", "backward", or "mixed" for |forwardness| ≤ 0.05.
    pub fn name(&self) -> &'static str {
        match self.forwardness {
            f if f > 0.05 => "forward",
            f if f < -0.05 => "backward",
            _ => "mixed",
        }
    }
}

impl PoincareResult {
    /// What is written to files.
    pub fn document(&self) -> Document<'_> {
        Document::new()
            .quantity("speed", "rad/s", self.speed)
            .group(named("clock", ""), self.clock.document())
            .group(named("motion", ""), motion_document(&self.motion))
            .integer("transient_periods", self.transient_periods)
            .integer("groups", self.groups)
            .and_if(self.partial, |out, partial| out.group("partial", partial.document()))
            .numbers(in_hdf5("shaft_angle"), "rad", &self.shaft_angle)
            .groups(named("planes", ""), "name", self.planes.iter().map(|p| (p.name.clone(), p.document())))
    }
}

impl PlaneSection {
    fn document(&self) -> Document<'_> {
        let extremes = |values: &Vec<f64>| {
            values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| [v.min(l), v.max(h)])
        };
        let axes = Rows::of(&self.axes).text("name", |a| &a.name).text("unit", |a| &a.unit);
        let whirl = self.whirl.as_ref().map(|w| {
            let (major, minor) = w.synchronous.semi_axes();
            Document::new()
                .text(named("direction", "whirl"), w.name())
                .number("forwardness", "1", w.forwardness)
                .number("semi_major_1x", "m", major)
                .number("semi_minor_1x", "m", minor)
        });
        let section = Array::real(&[2, self.section[0].len()], "", self.section.concat());
        let mut out = Document::new()
            .table(in_json("axes"), axes)
            .array(in_json("section"), section)
            .array(in_json("orbit"), Array::real(&[2, 2], "", self.orbit.each_ref().map(extremes).concat()))
            .with(named("whirl", ""), whirl.map_or(Value::Missing, Value::Group))
            .optional("clearance", "m", self.clearance)
            .number(in_hdf5("sample_rate"), "Hz", self.sample_rate);
        for (k, axis) in ["x", "y"].into_iter().enumerate() {
            let unit = &self.axes[k].unit;
            out = out
                .text(in_hdf5(format!("{axis}_channel")), &self.axes[k].name)
                .numbers(in_hdf5(format!("orbit_{axis}")), unit, &self.orbit[k])
                .numbers(in_hdf5(format!("section_{axis}")), unit, &self.section[k]);
        }
        out
    }
}

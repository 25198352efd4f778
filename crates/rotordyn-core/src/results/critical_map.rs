//! Undamped critical speed map.

use crate::analysis::critical_map::{BearingCurve, MapCrossing, MapCurve};
use crate::document::{Document, Rows, TO_RPM, named};
use serde::{Deserialize, Serialize};

/// Undamped critical speeds over support stiffness, with the bearings' own stiffness over speed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CriticalMap {
    /// Highest speed \[rad/s\].
    pub max_speed: f64,
    /// Radial stiffness of every support \[N/m\], increasing.
    pub stiffness: Vec<f64>,
    pub curves: Vec<MapCurve>,
    /// Speeds at which the bearings' own stiffness is given \[rad/s\].
    pub speeds: Vec<f64>,
    pub bearings: Vec<BearingCurve>,
    /// Where a curve meets the stiffness of a bearing, by speed.
    pub crossings: Vec<MapCrossing>,
}

impl CriticalMap {
    /// What is written to files.
    pub fn document(&self) -> Document<'_> {
        let (points, speeds) = ([self.stiffness.len()], [self.speeds.len()]);
        let curves = Rows::of(&self.curves)
            .text("mode", |c| &c.label)
            .numbers(named("critical_speeds_rpm", "rpm"), "rpm", &points, |c| {
                c.speeds.iter().map(|speed| speed * TO_RPM).collect::<Vec<_>>()
            })
            .cells_over(0, "stiffness");
        let bearings = Rows::of(&self.bearings)
            .text("bearing", |b| &b.label)
            .numbers(named("stiffness_n_per_m", "own_stiffness"), "N/m", &speeds, |b| &b.stiffness)
            .cells_over(0, "own_rpm");
        let crossings = Rows::of(&self.crossings)
            .heading("Crossings with the bearings' own stiffness")
            .number(named("speed_rpm", "speed"), "rpm", |c| c.speed * TO_RPM)
            .text("mode", |c| &c.mode)
            .text("bearing", |c| &c.bearing)
            .quantity("stiffness", "N/m", |c| c.stiffness);
        let rpm = |speeds: &[f64]| speeds.iter().map(|speed| speed * TO_RPM).collect::<Vec<_>>();
        Document::new()
            .quantity("max_speed", "rad/s", self.max_speed)
            .numbers(named("stiffness_n_per_m", "stiffness"), "N/m", &self.stiffness[..])
            .table(named("curves", ""), curves)
            .numbers(named("bearing_speeds_rpm", "own_rpm"), "rpm", rpm(&self.speeds))
            .table(named("bearings", ""), bearings)
            .table("crossings", crossings)
    }
}

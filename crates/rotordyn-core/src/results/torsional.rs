//! Torsional modes and their interference with excitation orders.

use super::OrderLine;
use crate::analysis::torsional::TorsionalModes;
use crate::document::{Document, Rows, TO_RPM, in_json, named};
use serde::{Deserialize, Serialize};

/// Torsional natural frequencies, and the speeds at which orders of excitation meet them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TorsionalResult {
    pub max_speed: f64,
    pub found: TorsionalModes,
    /// Axial positions of the shaft nodes \[m\].
    pub z: Vec<f64>,
    pub orders: Vec<OrderLine>,
    /// Lowest and highest operating speed \[rad/s\].
    pub operating_speeds: Option<[f64; 2]>,
    pub interferences: Vec<Interference>,
}

/// A torsional natural frequency met by an order of excitation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Interference {
    /// Ω = ω/n \[rad/s\].
    pub speed: f64,
    /// Number of the mode, from 1.
    pub mode: usize,
    pub frequency_hz: f64,
    /// Label of the order line.
    pub order: String,
    /// Separation from the operating speeds, as a fraction of the nearer one.
    pub separation: Option<f64>,
}

impl Interference {
    /// Separation that API 684 requires of torsional natural frequencies: 10 %.
    pub const REQUIRED: f64 = 0.1;

    /// In words whether it lies far enough from the operating speeds.
    pub fn assessment(&self) -> &'static str {
        match self.separation {
            None => "no operating speed",
            Some(separation) if separation >= Self::REQUIRED => "clear",
            Some(_) => "within 10 %",
        }
    }
}

impl TorsionalResult {
    /// What is written to files.
    pub fn document(&self) -> Document<'_> {
        let numbered: Vec<_> = self.found.modes.iter().enumerate().collect();
        let modes = Rows::of(&numbered)
            .heading("Torsional natural frequencies")
            .integer("mode", |(k, _)| k + 1)
            .quantity("frequency", "Hz", |(_, mode)| mode.frequency_hz)
            .number(named("frequency_rpm", "critical_speed"), "rpm", |(_, mode)| 60.0 * mode.frequency_hz)
            .numbers("twist", "1", &[self.z.len()], |(_, mode)| &mode.twist)
            .cells_over(0, "z");
        let interferences = Rows::of(&self.interferences)
            .heading("Speeds at which an order meets a torsional natural frequency")
            .number(named("speed_rpm", "speed"), "rpm", |i| i.speed * TO_RPM)
            .integer("mode", |i| i.mode)
            .quantity("frequency", "Hz", |i| i.frequency_hz)
            .text("order", |i| &i.order)
            .optional("separation", "1", |i| i.separation)
            .text("assessment", |i| i.assessment());
        let orders =
            Rows::of(&self.orders).text("label", |o| &o.label).number("order", "1/revolution", |o| o.order);
        Document::new()
            .quantity("max_speed", "rad/s", self.max_speed)
            .integer("rigid_rotations", self.found.rigid_rotations)
            .flag("coupled", self.found.coupled)
            .optional(in_json("lowest_operating_speed_rpm"), "rad/s", self.operating_speeds.map(|s| s[0]))
            .optional(in_json("operating_speed_rpm"), "rad/s", self.operating_speeds.map(|s| s[1]))
            .numbers(named("z_m", "z"), "m", &self.z[..])
            .table(named("modes", ""), modes)
            .table("orders", orders)
            .table("interferences", interferences)
    }
}

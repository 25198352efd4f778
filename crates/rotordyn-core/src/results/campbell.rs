//! Campbell diagram.

use super::OrderLine;
use crate::analysis::Mode;
use crate::analysis::campbell::{Campbell, ModeValue};
use crate::analysis::critical_speed::{CriticalSpeed, CrossingList, UncertainRange};
use crate::analysis::stability::Threshold;
use crate::document::{Document, Rows, TO_RPM, in_hdf5, in_json, named};
use rotordyn_linalg::Complex64;
use serde::{Deserialize, Serialize};

/// Most values of the stored shapes (16 MB): those of a shaft of many elements are left out.
const MOST_SHAPE_VALUES: usize = 1 << 20;

/// Campbell diagram with order lines and their crossings (critical speeds).
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct CampbellResult {
    pub diagram: Campbell,
    pub orders: Vec<OrderLine>,
    pub crossings: CrossingList,
    /// Stability thresholds: speeds at which a mode's damping changes sign.
    pub thresholds: Vec<Threshold>,
}

/// The mode of least damping at a speed.
#[derive(Clone, Debug, PartialEq)]
pub struct LeastDamped {
    /// Ω \[rad/s\].
    pub speed: f64,
    pub label: String,
    /// δ; negative: unstable.
    pub log_decrement: f64,
}

/// Log decrement below which all modes are undamped but for round-off.
const UNDAMPED: f64 = 1e-6;

impl CampbellResult {
    /// The least log decrement of all modes of the diagram, tracked or not, at every speed; none if nothing is damped.
    pub fn least_damped(&self) -> Vec<LeastDamped> {
        let at = |(speed, modes): (&f64, &Vec<ModeValue>)| {
            let least = modes.iter().min_by(|a, b| a.log_dec().total_cmp(&b.log_dec()))?;
            Some(LeastDamped { speed: *speed, label: least.label.clone(), log_decrement: least.log_dec() })
        };
        let found: Vec<LeastDamped> =
            self.diagram.speeds.iter().zip(&self.diagram.all).filter_map(at).collect();
        let damped = found.iter().any(|point| point.log_decrement.abs() > UNDAMPED);
        if damped { found } else { Vec::new() }
    }

    /// What is written to files.
    pub fn document(&self) -> Document<'_> {
        let diagram = &self.diagram;
        let speeds: Vec<f64> = diagram.speeds.iter().map(|speed| speed * TO_RPM).collect();
        let cell = [speeds.len()];
        let over = |modes: &[Option<Mode>], value: fn(&Mode) -> f64| -> Vec<f64> {
            modes.iter().map(|m| m.as_ref().map_or(f64::NAN, value)).collect()
        };
        let nan = Complex64::new(f64::NAN, f64::NAN);
        let found = diagram.branches.iter().flat_map(|b| &b.modes).flatten().next();
        let nodes = found.map_or(0, |mode| mode.full_shape.len() / 6);
        let mut branches = Rows::of(&diagram.branches)
            .text("label", |b| &b.label)
            .text("kind", |b| b.kind.name())
            .texts("labels", speeds.len(), |b| {
                b.modes.iter().map(|m| m.as_ref().map(|m| m.label.clone())).collect()
            })
            .numbers(named("frequency_hz", "frequency"), "Hz", &cell, |b| over(&b.modes, Mode::frequency_hz))
            .cells_over(0, "rpm")
            .numbers(in_hdf5("zeta"), "1", &cell, |b| over(&b.modes, Mode::zeta))
            .cells_over(0, "rpm")
            .numbers(named("log_decrement", "log_dec"), "1", &cell, |b| over(&b.modes, Mode::log_dec))
            .cells_over(0, "rpm")
            .complex_numbers(in_json("eigenvalue"), "1/s", &cell, |b| -> Vec<_> {
                b.modes.iter().map(|m| m.as_ref().map_or(nan, |m| m.eigenvalue)).collect()
            });
        if diagram.branches.len() * speeds.len() * nodes * 6 <= MOST_SHAPE_VALUES {
            let unit = "m/sqrt(kg) m, rad/sqrt(kg) m";
            branches = branches.complex_numbers(in_hdf5("shapes"), unit, &[speeds.len(), nodes, 6], |b| {
                let shape =
                    |m: &Option<Mode>| m.as_ref().map_or(vec![nan; 6 * nodes], |m| m.full_shape.clone());
                b.modes.iter().flat_map(shape).collect::<Vec<_>>()
            });
        }
        let orders =
            Rows::of(&self.orders).text("label", |o| &o.label).number("order", "1/revolution", |o| o.order);
        let omitted = Rows::of(&self.crossings.omitted)
            .number("order", "1/revolution", |(order, _)| *order)
            .integer("modes", |(_, modes)| *modes);
        let lost = Rows::of(&diagram.lost)
            .integer("branch", |lost| lost.branch)
            .number("from_rpm", "rpm", |lost| lost.speeds[0] * TO_RPM)
            .number("to_rpm", "rpm", |lost| lost.speeds[1] * TO_RPM)
            .optional_integer("continued_by", |lost| lost.continued_by);
        let thresholds = Rows::of(&self.thresholds)
            .number(named("speed_rpm", "rpm"), "rpm", |t| t.speed * TO_RPM)
            .flag("unstable_above", |t| t.unstable_above)
            .text("label", |t| &t.mode.label);
        let least_damped = self.least_damped();
        let stability = Rows::of(&least_damped)
            .number(named("speed_rpm", "rpm"), "rpm", |p| p.speed * TO_RPM)
            .number(named("log_decrement", "log_dec"), "1", |p| p.log_decrement)
            .text("label", |p| p.label.clone());
        Document::new()
            .numbers(named("speeds_rpm", "rpm"), "rpm", speeds)
            .table("least_damped", stability)
            .table(named("branches", ""), branches)
            .table("orders", orders)
            .table("crossings", CriticalSpeed::columns(Rows::of(&self.crossings.list)))
            .table(in_json("crossings_omitted"), omitted)
            .table(in_json("uncertain"), UncertainRange::columns(&self.crossings.uncertain))
            .table(in_json("lost_branches"), lost)
            .table("thresholds", thresholds)
    }
}

//! Campbell diagram of the linearised machine, and its branches and order lines for other figures.

use super::machine::whirl;
use super::{Named, TO_RPM};
use crate::{Branch, Campbell, Critical, Figure, OrderLine, Whirl};
use rotordyn_core::analysis::Mode;
use rotordyn_core::results::{self, CampbellResult};
use rotordyn_core::study::Machine;

/// Log decrement below which a mode is undamped except for round-off.
const UNDAMPED_LOG_DECREMENT: f64 = 1e-6;
/// Smallest number of branches shown.
const MIN_BRANCHES: usize = 4;

pub fn campbell(found: &CampbellResult, machine: &Machine) -> Named {
    let mut branches = branches(found);
    let top = max_frequency(&branches, found);
    for (shown, branch) in branches.iter_mut().zip(&found.diagram.branches) {
        // Named by the mode that the branch is where it ends or leaves the panel.
        let inside = branch.modes.iter().flatten().rfind(|mode| mode.frequency_hz() <= top);
        shown.label = inside.map_or_else(String::new, |mode| mode.label.clone());
    }
    branches.retain(|b| b.hz.iter().any(|hz| *hz <= top));
    let figure = Campbell {
        title: "Campbell diagram".into(),
        note: machine.model.title.clone(),
        max_hz: Some(top),
        branches,
        orders: order_lines(&found.orders),
        criticals: found
            .crossings
            .list
            .iter()
            .filter(|c| c.speed > 0.0)
            .map(|c| Critical {
                rpm: c.speed * TO_RPM,
                hz: c.mode.frequency_hz(),
                label: format!("{:.0}", c.speed * TO_RPM),
            })
            .collect(),
    };
    ("campbell".into(), Figure::Campbell(figure))
}

/// Branches as curves; without log decrements if the machine is undamped.
pub fn branches(found: &CampbellResult) -> Vec<Branch> {
    let rpm: Vec<f64> = found.diagram.speeds.iter().map(|s| s * TO_RPM).collect();
    let curve = |branch: &rotordyn_core::analysis::campbell::Branch| {
        let values = |value: fn(&Mode) -> f64| {
            branch.modes.iter().map(|m| m.as_ref().map_or(f64::NAN, value)).collect::<Vec<f64>>()
        };
        let round_off = |d: f64| if d.abs() < UNDAMPED_LOG_DECREMENT { 0.0 } else { d };
        let end = branch.modes.iter().flatten().next_back();
        Branch {
            label: end.map_or_else(|| branch.label.clone(), |mode| mode.label.clone()),
            whirl: kinds(branch, &found.diagram.speeds),
            rpm: rpm.clone(),
            hz: values(Mode::frequency_hz),
            log_decrement: values(Mode::log_dec).into_iter().map(round_off).collect(),
        }
    };
    let mut branches: Vec<Branch> = found.diagram.branches.iter().map(curve).collect();
    if branches.iter().all(|b| b.log_decrement.iter().all(|d| *d == 0.0 || d.is_nan())) {
        branches.iter_mut().for_each(|b| b.log_decrement.clear());
    }
    branches
}

/// Kind at every speed; at standstill, where the modes of an axisymmetric rotor are planar, that of the next speed.
fn kinds(branch: &rotordyn_core::analysis::campbell::Branch, speeds: &[f64]) -> Vec<Whirl> {
    let modes = &branch.modes;
    let at = |k: usize| modes.get(k)?.as_ref().map(|m| whirl(m.kind));
    let kind = |k: usize| match speeds[k] {
        0.0 => at(k + 1).or_else(|| at(k)),
        _ => at(k),
    };
    (0..modes.len()).map(|k| kind(k).unwrap_or(Whirl::Mixed)).collect()
}

pub fn order_lines(orders: &[results::OrderLine]) -> Vec<OrderLine> {
    let line =
        |o: &results::OrderLine| OrderLine { label: o.label.clone(), order: o.order, bearing: o.bearing };
    orders.iter().map(line).collect()
}

/// Upper end of the frequency axis \[Hz\]: includes the lowest branches and all that an order line crosses or
/// nearly crosses.
pub fn max_frequency(branches: &[Branch], found: &CampbellResult) -> f64 {
    let highest = |b: &Branch| b.hz.iter().copied().filter(|hz| hz.is_finite()).fold(0.0, f64::max);
    let mut ends: Vec<f64> = branches.iter().map(highest).collect();
    ends.sort_by(f64::total_cmp);
    let speed = found.diagram.speeds.last().copied().unwrap_or(0.0);
    let order = found.orders.iter().map(|o| o.order * speed / std::f64::consts::TAU).fold(0.0, f64::max);
    let met = ends.partition_point(|hz| *hz <= 1.2 * order);
    let last = met.max(MIN_BRANCHES).min(ends.len()).checked_sub(1);
    1.12 * last.map_or(1.0, |last| ends[last])
}

//! Units, levels and cursor groups of signal figures.

use super::display_unit::{DisplayUnit, decibels, quantity, unit};
use rotordyn_core::results::{BearingWithOrders, SignalResult};
use rotordyn_signal::bearing_lines::BearingPart;

/// Groups of cursors: the shaft, then the bearing parts.
pub const CURSOR_GROUPS: [&str; 5] = ["shaft", "BPFO", "BPFI", "2 BSF", "FTF"];
/// Groups of strong lines that are neither of the shaft nor of the bearing.
pub const OTHER_GROUPS: [&str; 2] = ["another source", "unexplained"];

/// Cursor group of a bearing part.
pub fn cursor_group(part: BearingPart) -> usize {
    1 + BearingPart::ALL.iter().position(|p| *p == part).unwrap_or(0)
}

/// Display unit of a channel; empty if unknown.
pub fn display_unit(r: &SignalResult) -> DisplayUnit {
    if r.unit.is_empty() { DisplayUnit { factor: 1.0, name: "" } } else { unit(&r.unit) }
}

/// Name of the quantity of a channel.
pub fn quantity_name(r: &SignalResult) -> &'static str {
    if r.unit.is_empty() { "amplitude" } else { quantity(&r.unit) }
}

/// Defect frequencies of the bearing parts as orders (per revolution).
pub fn defect_orders(b: &BearingWithOrders) -> Vec<(BearingPart, f64)> {
    let o = &b.orders;
    vec![
        (BearingPart::OuterRace, o.bpfo),
        (BearingPart::InnerRace, o.bpfi),
        (BearingPart::Ball, 2.0 * o.bsf),
        (BearingPart::Cage, o.ftf),
    ]
}

/// Levels of a map \[dB\] and their reference.
pub fn levels(r: &SignalResult, amplitude: &[f64]) -> (Vec<f64>, String) {
    let d = display_unit(r);
    let unit = if d.name.is_empty() { "dB".into() } else { format!("dB re 1 {}", d.name) };
    (decibels(amplitude, d), unit)
}

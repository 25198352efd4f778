//! One page of a ball bearing for its designer: load distribution, contact angles, stiffness, pressure, film and friction
//! over load and speed.

use super::Named;
use super::bearing::{ball_loads, contact_angles, curve, note, of_most_loaded_ball, over, panel, section};
use crate::{Figure, Grid, GridPanel, Sheet, ball_load, bearing_section, grid, lines};
use rotordyn_core::model::study::SweepVariable;
use rotordyn_core::results::{BearingPoint, BearingResult, BearingSweepResult};

/// `bearing_<name>_sheet`; `title` is that of the model file.
pub fn figure(found: &BearingResult, title: &str) -> Named {
    let mut first = vec![ball_load::draw(&ball_loads(found, ""))];
    first.extend(section(found, "").map(|section| bearing_section::draw(&section)));
    let mut rows = vec![first, vec![lines::draw(&contact_angles(found, ""))]];
    let swept = |of: SweepVariable| found.sweeps.iter().find(|s| s.of == of && s.points.len() > 1);
    let grids = [SweepVariable::Load, SweepVariable::Speed].into_iter().filter_map(swept);
    rows.extend(grids.map(|sweep| vec![grid::draw(&panels(found, sweep))]));
    let sheet = Sheet { title: format!("Bearing {}", found.name), note: note(found, title), rows };
    (format!("bearing_{}_sheet", found.name), Figure::Sheet(sheet))
}

/// Panels of a sweep.
fn panels(found: &BearingResult, sweep: &BearingSweepResult) -> Grid {
    let one = |value: fn(&BearingPoint) -> f64| vec![curve(sweep, value)];
    let mut panels: Vec<GridPanel> = vec![
        panel("radial stiffness", "kN/mm", true, one(|p| 1e-6 * p.radial_stiffness[0])),
        panel("axial stiffness", "kN/mm", true, one(|p| 1e-6 * p.axial_stiffness[0])),
        panel("max pressure", "GPa", true, of_most_loaded_ball(sweep, |c| 1e-9 * c.pressure)),
        panel("contact angle", "°", false, of_most_loaded_ball(sweep, |c| c.angle.to_degrees())),
    ];
    if sweep.points.iter().any(|p| p.minimum_film() > 0.0) {
        panels.push(panel("minimum film", "µm", true, of_most_loaded_ball(sweep, |c| 1e6 * c.minimum_film)));
    }
    if sweep.points.iter().any(|p| p.friction.total() > 0.0) {
        panels.push(panel("friction torque", "N·m", true, one(|p| p.friction.total())));
    }
    let legend = vec!["inner race (or the bearing)".to_string(), "outer race".to_string()];
    Grid { panels, legend, ..over(found, sweep, "Stiffness and contacts") }
}

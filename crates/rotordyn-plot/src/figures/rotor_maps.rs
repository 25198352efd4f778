//! Critical speed map, stability map, torsional modes with their interference diagram.

use super::{Named, TO_RPM, campbell};
use crate::{Branch, Campbell, Critical, Curve, Figure, Lines, Stack, StackPanel, Whirl};
use rotordyn_core::analysis::Mode;
use rotordyn_core::results::{CampbellResult, CriticalMap, TorsionalResult};
use rotordyn_core::study::Machine;

/// Most curves of bearings in a map, and of modes in a figure.
const MOST_CURVES: usize = 6;

/// Undamped critical speeds over stiffness, with the bearings' own stiffness over speed.
pub fn critical_map(found: &CriticalMap, machine: &Machine) -> Option<Named> {
    if found.curves.is_empty() {
        return None;
    }
    let shown = |x: &[f64], y: &[f64]| -> (Vec<f64>, Vec<f64>) {
        let (low, high) = (found.stiffness[0], found.stiffness[found.stiffness.len() - 1]);
        let inside = |(x, y): &(&f64, &f64)| (low..=high).contains(*x) && **y > 0.0;
        x.iter().zip(y).filter(inside).unzip()
    };
    let rpm = |speeds: &[f64]| speeds.iter().map(|speed| speed * TO_RPM).collect::<Vec<_>>();
    let modes = found.curves.iter().map(|curve| {
        let (x, y) = shown(&found.stiffness, &rpm(&curve.speeds));
        Curve { label: curve.label.clone(), x, y, points: false }
    });
    let bearings = found.bearings.iter().take(MOST_CURVES).map(|bearing| {
        let (x, y) = shown(&bearing.stiffness, &rpm(&found.speeds));
        Curve { label: format!("stiffness of {}", bearing.label), x, y, points: false }
    });
    let mut curves: Vec<Curve> = modes.chain(bearings).filter(|curve| !curve.x.is_empty()).collect();
    if !found.crossings.is_empty() {
        curves.push(Curve {
            label: "crossing".into(),
            x: found.crossings.iter().map(|c| c.stiffness).collect(),
            y: found.crossings.iter().map(|c| c.speed * TO_RPM).collect(),
            points: true,
        });
    }
    let figure = Lines {
        title: "Undamped critical speed map".into(),
        note: machine.model.title.clone(),
        x_name: "radial stiffness of every bearing".into(),
        x_unit: "N/m".into(),
        y_name: "critical speed".into(),
        y_unit: "rpm".into(),
        curves,
        log_x: true,
        log_y: true,
        ..Lines::default()
    };
    Some(("critical_map".into(), Figure::Lines(figure)))
}

/// Log decrement over speed of the least damped modes, with the stability thresholds.
pub fn stability(found: &CampbellResult, machine: &Machine) -> Option<Named> {
    let least = found.least_damped();
    if least.is_empty() {
        return None;
    }
    let rpm: Vec<f64> = found.diagram.speeds.iter().map(|speed| speed * TO_RPM).collect();
    let lowest =
        |modes: &[Option<Mode>]| modes.iter().flatten().map(Mode::log_dec).fold(f64::INFINITY, f64::min);
    let mut branches: Vec<_> = found.diagram.branches.iter().collect();
    branches.sort_by(|a, b| lowest(&a.modes).total_cmp(&lowest(&b.modes)));
    branches.truncate(MOST_CURVES - 1);
    let curve = |y: Vec<f64>| Curve { x: rpm.clone(), y, ..Curve::default() };
    let of =
        |modes: &[Option<Mode>]| modes.iter().map(|m| m.as_ref().map_or(f64::NAN, Mode::log_dec)).collect();
    let modes: Vec<Curve> = branches.iter().map(|branch| curve(of(&branch.modes))).collect();
    let panel = |name: &str, curves| StackPanel {
        name: name.into(),
        curves,
        from_zero: true,
        ..StackPanel::default()
    };
    // The first curve of the lower panel is that of no legend entry of its own: the least of all modes.
    let below: Vec<Curve> = vec![curve(least.iter().map(|point| point.log_decrement).collect())];
    let marks = found.thresholds.iter().map(|threshold| {
        let side = if threshold.unstable_above { "unstable above" } else { "unstable below" };
        (format!("{side} {:.0}", threshold.speed * TO_RPM), threshold.speed * TO_RPM)
    });
    let mut legend = vec!["least of all modes".to_string()];
    legend.extend(branches.iter().map(|branch| branch.label.clone()));
    let upper = std::iter::once(Curve::default()).chain(modes).collect();
    let figure = Stack {
        title: "Stability: log decrement over speed".into(),
        note: machine.model.title.clone(),
        x_name: "shaft speed".into(),
        x_unit: "rpm".into(),
        legend,
        panels: vec![panel("log decrement", upper), panel("least log decrement", below)],
        marks: marks.collect(),
        height: 190.0,
    };
    Some(("stability".into(), Figure::Stack(figure)))
}

/// Torsional natural frequencies over speed with order lines; twist along the shaft.
pub fn torsional(found: &TorsionalResult, machine: &Machine) -> Vec<Named> {
    let modes = &found.found.modes;
    if modes.is_empty() {
        return Vec::new();
    }
    let top = found.max_speed * TO_RPM;
    let branch = |(k, mode): (usize, &rotordyn_core::analysis::torsional::TorsionalMode)| Branch {
        label: format!("torsional {}", k + 1),
        whirl: vec![Whirl::Torsion; 2],
        rpm: vec![0.0, top],
        hz: vec![mode.frequency_hz; 2],
        log_decrement: Vec::new(),
    };
    let orders = campbell::order_lines(&found.orders);
    let highest = orders.iter().map(|line| line.order * top / 60.0).fold(0.0, f64::max);
    // Modes far above all order lines would only compress the diagram.
    let near = modes.iter().filter(|mode| mode.frequency_hz <= 1.5 * highest).count().max(1);
    let diagram = Campbell {
        title: "Torsional interference diagram".into(),
        note: machine.model.title.clone(),
        max_hz: Some(1.12 * highest.max(modes[near - 1].frequency_hz)),
        branches: modes.iter().take(near).enumerate().map(branch).collect(),
        orders,
        criticals: found
            .interferences
            .iter()
            .map(|i| Critical {
                rpm: i.speed * TO_RPM,
                hz: i.frequency_hz,
                label: format!("{:.0}", i.speed * TO_RPM),
            })
            .collect(),
    };
    let z: Vec<f64> = found.z.iter().map(|z| 1e3 * z).collect();
    let shown = modes.iter().take(MOST_CURVES);
    let shapes = Stack {
        title: "Torsional mode shapes".into(),
        note: machine.model.title.clone(),
        x_name: "axial position z".into(),
        x_unit: "mm".into(),
        legend: shown.clone().map(|mode| format!("{:.1} Hz", mode.frequency_hz)).collect(),
        panels: vec![StackPanel {
            name: "twist, largest 1".into(),
            curves: shown
                .map(|mode| Curve { x: z.clone(), y: mode.twist.clone(), ..Curve::default() })
                .collect(),
            y_range: Some([-1.1, 1.1]),
            ..StackPanel::default()
        }],
        marks: machine.model.stations.iter().map(|s| (s.name.clone(), 1e3 * s.z)).collect(),
        height: 280.0,
    };
    let interference = ("torsional_interference".into(), Figure::Campbell(diagram));
    vec![interference, ("torsional_modes".into(), Figure::Stack(shapes))]
}

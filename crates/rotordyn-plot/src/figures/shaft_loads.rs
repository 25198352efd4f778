//! Deflection, shear force and bending moment along the shaft; bearing forces over speed.

use super::{Named, TO_RPM};
use crate::{Curve, Figure, Stack, StackPanel};
use rotordyn_core::analysis::equilibrium::Equilibrium;
use rotordyn_core::analysis::shaft_loads::{ShaftAmplitude, ShaftAmplitudes, ShaftPoint};
use rotordyn_core::model::Model;
use rotordyn_core::results::{BearingForce, UnbalanceResult};
use rotordyn_core::study::Machine;

/// Height of the panels \[px\].
const HEIGHT: f64 = 130.0;

/// Loads of the shaft at rest; `None` for a rigid rotor.
pub fn at_rest(found: &Equilibrium, machine: &Machine) -> Option<Named> {
    let points = &found.shaft;
    if points.is_empty() {
        return None;
    }
    let curve = |factor: f64, of: &dyn Fn(&ShaftPoint) -> f64| Curve {
        x: points.iter().map(|p| 1e3 * p.z).collect(),
        y: points.iter().map(|p| factor * of(p)).collect(),
        ..Curve::default()
    };
    let panel = |name: &str, unit: &str, factor: f64, of: [&dyn Fn(&ShaftPoint) -> f64; 2]| StackPanel {
        name: name.into(),
        unit: unit.into(),
        curves: of.map(|of| curve(factor, of)).into(),
        from_zero: true,
        ..StackPanel::default()
    };
    let panels = vec![
        panel("deflection", "µm", 1e6, [&|p| p.displacement[0], &|p| p.displacement[1]]),
        panel("shear force", "N", 1.0, [&|p| p.shear[0], &|p| p.shear[1]]),
        panel("bending moment", "N·m", 1.0, [&|p| p.moment[0], &|p| p.moment[1]]),
    ];
    let legend = ["horizontal plane (x)", "vertical plane (y)"].map(String::from).into();
    let note = format!("{}, {:.0} rpm", machine.model.title, found.speed * TO_RPM);
    let figure = along_shaft("Shaft under static loads".into(), note, legend, panels, &machine.model);
    Some(("static_shaft_loads".into(), figure))
}

fn along_shaft(
    title: String,
    note: String,
    legend: Vec<String>,
    panels: Vec<StackPanel>,
    model: &Model,
) -> Figure {
    let marks = model.stations.iter().map(|s| (s.name.clone(), 1e3 * s.z)).collect();
    let (x_name, x_unit) = ("axial position z".into(), "mm".into());
    Figure::Stack(Stack { title, note, x_name, x_unit, legend, panels, marks, height: HEIGHT })
}

/// Amplitudes along the shaft under unbalance, a figure for each speed; bearing forces over speed.
pub fn under_unbalance(found: &UnbalanceResult, machine: &Machine) -> Vec<Named> {
    let mut out: Vec<Named> = found.shaft.iter().map(|shaft| amplitudes(shaft, machine)).collect();
    out.extend(bearing_forces(found, machine));
    out
}

fn amplitudes(shaft: &ShaftAmplitudes, machine: &Machine) -> Named {
    let panel = |name: &str, unit: &str, factor: f64, of: &dyn Fn(&ShaftAmplitude) -> f64| {
        let curve = Curve {
            x: shaft.points.iter().map(|p| 1e3 * p.z).collect(),
            y: shaft.points.iter().map(|p| factor * of(p)).collect(),
            ..Curve::default()
        };
        StackPanel {
            name: name.into(),
            unit: unit.into(),
            curves: vec![curve],
            from_zero: true,
            ..StackPanel::default()
        }
    };
    let panels = vec![
        panel("deflection", "µm", 1e6, &|p| p.displacement),
        panel("shear force", "N", 1.0, &|p| p.shear),
        panel("bending moment", "N·m", 1.0, &|p| p.moment),
    ];
    let rpm = shaft.speed * TO_RPM;
    let note = format!("{}, amplitudes, {}", machine.model.title, shaft.reason);
    let title = format!("Shaft under unbalance at {rpm:.0} rpm");
    let figure = along_shaft(title, note, Vec::new(), panels, &machine.model);
    (format!("unbalance_shaft_loads_{rpm:.0}rpm"), figure)
}

fn bearing_forces(found: &UnbalanceResult, machine: &Machine) -> Option<Named> {
    let rpm: Vec<f64> = found.speeds.iter().map(|s| s * TO_RPM).collect();
    let loaded = |bearing: &&BearingForce| bearing.largest().is_some_and(|k| bearing.amplitude(k) > 0.0);
    let panel = |bearing: &BearingForce| {
        let over = |of: &dyn Fn(usize) -> f64| Curve {
            x: rpm.clone(),
            y: (0..rpm.len()).map(of).map(|f| if f.is_finite() { f } else { f64::NAN }).collect(),
            ..Curve::default()
        };
        let at_rest = bearing.at_rest[0].hypot(bearing.at_rest[1]);
        let resting = if at_rest > 0.0 { over(&|_| at_rest) } else { Curve::default() };
        StackPanel {
            name: format!("force {}", bearing.name),
            unit: "N".into(),
            curves: vec![over(&|k| bearing.components(k)[0]), over(&|k| bearing.components(k)[1]), resting],
            log_y: true,
            ..StackPanel::default()
        }
    };
    let panels: Vec<StackPanel> = found.bearing_forces.iter().filter(loaded).map(panel).collect();
    if panels.is_empty() {
        return None;
    }
    let marks = found.margins.iter().filter(|m| m.peak.is_some());
    let figure = Stack {
        title: "Bearing forces under unbalance".into(),
        note: format!("{}, steady state", machine.model.title),
        x_name: "shaft speed".into(),
        x_unit: "rpm".into(),
        legend: ["|F_x|, 0–peak", "|F_y|, 0–peak", "static force at rest"].map(String::from).into(),
        panels,
        marks: marks.map(|m| (format!("{:.0}", m.speed * TO_RPM), m.speed * TO_RPM)).collect(),
        height: 150.0,
    };
    Some(("unbalance_bearing_forces".into(), Figure::Stack(figure)))
}

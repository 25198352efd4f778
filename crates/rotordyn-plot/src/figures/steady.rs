//! Steady motion: orbits with Poincaré points, Poincaré sections, bifurcation diagrams, Lyapunov exponent
//! convergence.

use super::display_unit::{DisplayUnit, quantity, unit};
use super::{Named, TO_RPM};
use crate::{Bifurcation, Curve, Figure, Lines, PhasePlane, PhasePlanes, SweepPoints};
use rotordyn_core::results::{
    BifurcationResult, BifurcationSweep, LyapunovResult, PlaneSection, PoincareResult, RecordedPeriods,
    SectionChannel, SteadyMotion,
};
use rotordyn_core::study::Machine;
use rotordyn_signal::motion_classification::Motion;

/// Points of a 1x-filtered orbit.
const FILTERED_ORBIT_POINTS: usize = 181;

pub fn poincare(found: &PoincareResult, machine: &Machine) -> Vec<Named> {
    let note = format!(
        "{}, {:.1} rpm: {}, one point per {}{}",
        machine.model.title,
        found.speed * TO_RPM,
        found.motion.motion.name(),
        found.clock.name,
        stopped_after(found.partial)
    );
    let figure = |name: &str, title: &str, planes: Vec<PhasePlane>| {
        let data = PhasePlanes { title: title.into(), note: note.clone(), planes };
        (name.to_string(), Figure::PhasePlanes(data))
    };
    // A section per shaft revolution at angle zero coincides with the keyphasor marks.
    let same = found.clock.name == "shaft revolution" && found.clock.phase == 0.0;
    let keyphasor = if same { Vec::new() } else { keyphasor_passages(&found.shaft_angle) };
    let orbits = found.planes.iter().map(|p| PhasePlane { keyphasor: keyphasor.clone(), ..plane(p, true) });
    let sections = found.planes.iter().map(|p| plane(p, false));
    vec![
        figure("poincare_orbits", "Orbits with their Poincaré points", orbits.collect()),
        figure("poincare_sections", "Poincaré sections", sections.collect()),
    ]
}

/// How much there is of a record that was stopped; else nothing.
fn stopped_after(partial: Option<RecordedPeriods>) -> String {
    partial.map_or_else(String::new, |partial| format!("; stopped after {}", partial.words()))
}

/// Samples at which the keyphasor passes.
fn keyphasor_passages(shaft_angle: &[f64]) -> Vec<usize> {
    let turn = |angle: f64| (angle / std::f64::consts::TAU).floor();
    (1..shaft_angle.len()).filter(|&k| turn(shaft_angle[k]) > turn(shaft_angle[k - 1])).collect()
}

fn plane(found: &PlaneSection, with_orbit: bool) -> PhasePlane {
    let shown: [DisplayUnit; 2] = found.axes.each_ref().map(|axis| unit(&axis.unit));
    let scaled = |values: &[f64], k: usize| values.iter().map(|v| v * shown[k].factor).collect::<Vec<f64>>();
    let name = |axis: &SectionChannel| axis.name.clone();
    let mut plane = PhasePlane {
        title: match &found.whirl {
            Some(whirl) if with_orbit => format!("{}, {}", found.name, whirl.name()),
            _ => found.name.clone(),
        },
        x_name: name(&found.axes[0]),
        x_unit: shown[0].name.into(),
        y_name: name(&found.axes[1]),
        y_unit: shown[1].name.into(),
        equal: found.axes[0].unit == found.axes[1].unit,
        section_x: scaled(&found.section[0], 0),
        section_y: scaled(&found.section[1], 1),
        ..PhasePlane::default()
    };
    if with_orbit {
        (plane.x, plane.y) = (scaled(&found.orbit[0], 0), scaled(&found.orbit[1], 1));
        plane.clearance = found.clearance.map(|c| c * shown[0].factor);
        if let Some(whirl) = &found.whirl {
            let round = whirl.synchronous.points(FILTERED_ORBIT_POINTS);
            plane.filtered_x = round.iter().chain(round.first()).map(|p| p[0] * shown[0].factor).collect();
            plane.filtered_y = round.iter().chain(round.first()).map(|p| p[1] * shown[1].factor).collect();
        }
    }
    plane
}

pub fn lyapunov(found: &LyapunovResult, machine: &Machine) -> Named {
    let e = &found.exponent;
    let level = |offset: f64, label: &str| {
        let ends = [e.times.first(), e.times.last()].into_iter().flatten().copied();
        let x: Vec<f64> = ends.collect();
        Curve { label: label.into(), y: vec![e.value + offset; x.len()], x, points: false }
    };
    let history =
        Curve { label: "running mean".into(), x: e.times.clone(), y: e.history.clone(), points: false };
    let mut curves = vec![history];
    if e.standard_error.is_finite() {
        curves.push(level(2.0 * e.standard_error, "plus two standard errors"));
        curves.push(level(-2.0 * e.standard_error, "minus two standard errors"));
    }
    let figure = Lines {
        title: "Convergence of the largest Lyapunov exponent".into(),
        note: format!(
            "{}, {:.1} rpm: {:.4} ± {:.2} 1/s over {} periods, one per {}{}",
            machine.model.title,
            found.speed * TO_RPM,
            e.value,
            e.standard_error,
            e.times.len(),
            found.clock.name,
            stopped_after(found.partial)
        ),
        x_name: "time".into(),
        x_unit: "s".into(),
        y_name: "Lyapunov exponent".into(),
        y_unit: "1/s".into(),
        curves,
        ..Lines::default()
    };
    ("lyapunov".into(), Figure::Lines(figure))
}

/// One diagram per channel.
pub fn bifurcation(found: &BifurcationResult, machine: &Machine) -> Vec<Named> {
    let diagram = |(c, channel): (usize, &SectionChannel)| {
        let shown = unit(&channel.unit);
        let data = Bifurcation {
            title: format!("Bifurcation diagram over {}, {}", found.parameter.name(), channel.name),
            note: format!("{}, one point per {}", machine.model.title, found.clock),
            x_name: found.parameter.name(),
            x_unit: found.parameter.unit.replace("um", "µm"),
            y_name: format!("{}, {}", channel.name, quantity(&channel.unit)),
            y_unit: shown.name.into(),
            sweeps: found.sweeps.iter().map(|sweep| points(sweep, c, shown.factor)).collect(),
        };
        (format!("bifurcation_{}", channel.name), Figure::Bifurcation(data))
    };
    found.channels.iter().enumerate().map(diagram).collect()
}

fn points(sweep: &BifurcationSweep, channel: usize, factor: f64) -> SweepPoints {
    let label = match sweep.name.as_str() {
        "up" => "sweep up",
        "down" => "sweep down",
        _ => "",
    };
    let mut out = SweepPoints { label: label.into(), ..SweepPoints::default() };
    let computed = sweep.points.iter().filter_map(|p| Some((p.value, p.motion.as_ref().ok()?)));
    for (value, SteadyMotion { sections, motion, exponent, .. }) in computed {
        out.x.extend(std::iter::repeat_n(value, sections[channel].len()));
        out.y.extend(sections[channel].iter().map(|v| v * factor));
        match motion.motion {
            Motion::Periodic(k) => out.period.push([value, k as f64]),
            Motion::Settling(_) | Motion::Unsettled | Motion::Aperiodic => out.undecided.push(value),
            Motion::QuasiPeriodic => out.quasi_periodic.push(value),
            Motion::Chaotic => out.chaotic.push(value),
        }
        out.exponent.extend(exponent.as_ref().map(|e| [value, e.value, e.standard_error]));
    }
    out
}

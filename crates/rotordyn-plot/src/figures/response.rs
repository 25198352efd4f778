//! Frequency response functions and the synchronous unbalance response.

use super::display_unit::{quantity, typographic_unit, unit};
use super::{Named, TO_RPM};
use crate::{Bode, BodeCurve, Critical, Figure, Frf, FrfCurve, Orbit, Orbits, Polar, PolarCurve};
use rotordyn_core::analysis::mode_kind::ModeKind;
use rotordyn_core::analysis::unbalance::Orbit as Ellipse;
use rotordyn_core::results::{DiscOrbit, FrfResult, UnbalanceChannel, UnbalanceResult, is_rotation, unit_of};
use rotordyn_core::study::{Machine, Results};
use rotordyn_linalg::Complex64;

/// Most FRFs on common axes; more have a panel each.
const MAX_TOGETHER: usize = 4;
/// Points of a drawn orbit.
const ORBIT_POINTS: usize = 181;

pub fn frf(found: &FrfResult, machine: &Machine) -> Vec<Named> {
    let mut figures = Vec::new();
    for (e, excitation) in found.excitations.iter().enumerate() {
        let mut units: Vec<&String> = found.units.iter().map(|row| &row[e]).collect();
        units.sort();
        units.dedup();
        for unit in units {
            let rows =
                (0..found.responses.len()).filter(|&r| found.units[r][e] == *unit && found.is_coupled(r, e));
            let curves: Vec<FrfCurve> = rows.map(|r| frf_curve(found, r, e, &found.responses[r])).collect();
            if curves.is_empty() {
                continue;
            }
            let figure = Frf {
                title: frf_title(excitation, &machine.excitation_label(excitation)),
                note: format!("{}, {:.0} rpm", machine.model.title, found.speed * TO_RPM),
                quantity: found.name().into(),
                unit: typographic_unit(unit),
                apart: curves.len() > MAX_TOGETHER,
                curves,
            };
            let rotation = if unit.starts_with("rad") || unit.starts_with("(rad") { "_rotation" } else { "" };
            figures.push((format!("frf_{excitation}{rotation}"), Figure::Frf(figure)));
        }
    }
    figures
}

/// Title of the FRFs of an excitation, which names a point, or an axis and with its label the item.
fn frf_title(excitation: &str, label: &str) -> String {
    match label == excitation {
        true => format!("FRFs for a force at {excitation}"),
        false => format!("FRFs for a force along {label}"),
    }
}

/// One FRF as a curve.
pub fn frf_curve(found: &FrfResult, response: usize, excitation: usize, label: &str) -> FrfCurve {
    // An undamped peak is infinite: no point of the curve.
    let finite: Vec<(f64, Complex64)> = found
        .frf
        .frequencies
        .iter()
        .zip(&found.frf.values[response][excitation])
        .filter(|(_, h)| h.re.is_finite())
        .map(|(hz, h)| (*hz, *h))
        .collect();
    let values: Vec<Complex64> = finite.iter().map(|(_, h)| *h).collect();
    FrfCurve {
        label: label.into(),
        hz: finite.iter().map(|(hz, _)| *hz).collect(),
        re: values.iter().map(|v| v.re).collect(),
        im: values.iter().map(|v| v.im).collect(),
        coherence: Vec::new(),
    }
}

/// Synchronous (1x) critical speeds, from the critical speed study, else from the Campbell diagram.
pub fn criticals(results: &Results) -> Vec<Critical> {
    let list = match (&results.critical, &results.campbell) {
        (Some(found), _) => &found.crossings.list[..],
        (None, Some(found)) => &found.crossings.list[..],
        (None, None) => &[],
    };
    let synchronous =
        list.iter().filter(|c| c.order == 1.0 && c.speed > 0.0 && c.mode.kind != ModeKind::Torsional);
    let mark = |c: &rotordyn_core::analysis::critical_speed::CriticalSpeed| {
        let rpm = c.speed * TO_RPM;
        Critical { rpm, hz: c.mode.frequency_hz(), label: format!("{rpm:.0}") }
    };
    synchronous.map(mark).collect()
}

pub fn unbalance(found: &UnbalanceResult, criticals: &[Critical], machine: &Machine) -> Vec<Named> {
    let rpm: Vec<f64> = found.speeds.iter().map(|s| s * TO_RPM).collect();
    let si = |c: &UnbalanceChannel| unit_of(c.probe.quantity, is_rotation(&c.probe.direction));
    let mut units: Vec<&str> = Vec::new();
    for channel in &found.channels {
        if !units.contains(&si(channel)) {
            units.push(si(channel));
        }
    }
    let note = format!("{}, steady state", machine.model.title);
    let mut figures = Vec::new();
    for of in units {
        let shown = unit(of);
        let curves: Vec<BodeCurve> = found
            .channels
            .iter()
            .filter(|c| si(c) == of)
            .map(|c| {
                let finite: Vec<(f64, [f64; 2])> = rpm
                    .iter()
                    .zip(&c.amplitude)
                    .filter(|(_, [re, _])| re.is_finite())
                    .map(|(rpm, value)| (*rpm, *value))
                    .collect();
                BodeCurve {
                    label: c.probe.name.clone(),
                    rpm: finite.iter().map(|(rpm, _)| *rpm).collect(),
                    amplitude: finite.iter().map(|(_, [re, im])| shown.factor * re.hypot(*im)).collect(),
                    phase_deg: finite.iter().map(|(_, [re, im])| im.atan2(*re).to_degrees()).collect(),
                }
            })
            // Channels not excited by the unbalance have no phase.
            .filter(|c| c.amplitude.iter().any(|a| *a > 0.0))
            .collect();
        if curves.is_empty() {
            continue;
        }
        let polar = |c: &BodeCurve| PolarCurve {
            label: c.label.clone(),
            rpm: c.rpm.clone(),
            amplitude: c.amplitude.clone(),
            phase_deg: c.phase_deg.clone(),
        };
        let name = quantity(of).replace(' ', "_");
        let peak = |c: &BodeCurve| c.amplitude.iter().copied().fold(0.0, f64::max);
        let largest = curves.iter().map(peak).fold(0.0, f64::max);
        // Smaller curves would be dots on the linear scale of a polar plot.
        let polars = curves.iter().filter(|c| peak(c) > 0.05 * largest);
        let polar_figure = Polar {
            title: format!("Unbalance response, {}", quantity(of)),
            note: machine.model.title.clone(),
            unit: shown.name.into(),
            curves: polars.map(polar).collect(),
        };
        let bode = Bode {
            title: format!("Unbalance response, {}", quantity(of)),
            note: note.clone(),
            quantity: format!("{}, 0–peak", quantity(of)),
            unit: shown.name.into(),
            curves,
            log: true,
            criticals: criticals.to_vec(),
        };
        figures.push((format!("unbalance_bode_{name}"), Figure::Bode(bode)));
        figures.push((format!("unbalance_polar_{name}"), Figure::Polar(polar_figure)));
    }
    let orbits: Vec<Orbit> = found.orbits.iter().flat_map(|orbit| disc_orbits(orbit, &rpm)).collect();
    if !orbits.is_empty() {
        let figure = Orbits { title: "Unbalance orbits".into(), note, orbits };
        figures.push(("unbalance_orbits".into(), Figure::Orbits(figure)));
    }
    figures
}

/// Orbits of a disc at its largest amplitude and at the highest speed.
fn disc_orbits(orbit: &DiscOrbit, rpm: &[f64]) -> Vec<Orbit> {
    let ellipse = |k: usize| {
        let complex = |[re, im]: [f64; 2]| Complex64::new(re, im);
        Ellipse::new(complex(orbit.x[k]), complex(orbit.y[k]))
    };
    let size = |k: usize| Some(ellipse(k).major).filter(|major| major.is_finite()).unwrap_or(0.0);
    let Some(largest) = (0..rpm.len()).max_by(|&a, &b| size(a).total_cmp(&size(b))) else {
        return Vec::new();
    };
    if size(largest) == 0.0 {
        return Vec::new();
    }
    let mut at = vec![largest, rpm.len() - 1];
    at.dedup();
    let path = |k: usize| {
        let angle = |i: usize| std::f64::consts::TAU * i as f64 / (ORBIT_POINTS - 1) as f64;
        let along = |[re, im]: [f64; 2]| -> Vec<f64> {
            (0..ORBIT_POINTS).map(|i| re * angle(i).cos() - im * angle(i).sin()).collect()
        };
        let way = match ellipse(k).whirl {
            w if w > 0.01 => "forward",
            w if w < -0.01 => "backward",
            _ => "straight",
        };
        Orbit {
            title: format!("{}, {:.0} rpm, {way}", orbit.name, rpm[k]),
            x: along(orbit.x[k]),
            y: along(orbit.y[k]),
            keyphasor: vec![0],
            ..Orbit::default()
        }
    };
    at.into_iter().map(path).collect()
}

//! Poincaré sections, Lyapunov exponents and bifurcation diagrams as data sets.

use super::Place;
use crate::edge::hdf5::Store;
use crate::error::Error;
use crate::results::{BifurcationResult, BifurcationSweep, LyapunovResult, PoincareResult, SectionClock};
use crate::signal::period::Classified;

pub fn poincare(store: &Store, found: &PoincareResult) -> Result<(), Error> {
    let place = Place::new(store, "/poincare")?;
    place.note("speed", found.speed)?;
    clock(&place, &found.clock)?;
    motion(&place, &found.motion)?;
    place.note("groups", found.groups as i64)?;
    place.array("shaft_angle", &[found.shaft_angle.len()], &found.shaft_angle, "rad")?;
    for plane in &found.planes {
        let at = place.below(&plane.name)?;
        at.note("sample_rate", plane.sample_rate)?;
        if let Some(whirl) = &plane.whirl {
            let (major, minor) = whirl.once.semi_axes();
            at.note("whirl", whirl.name())?;
            at.note("forwardness", whirl.forwardness)?;
            at.note("semi_major_1x", major)?;
            at.note("semi_minor_1x", minor)?;
        }
        if let Some(clearance) = plane.clearance {
            at.note("clearance", clearance)?;
        }
        for (k, axis) in ["x", "y"].into_iter().enumerate() {
            let (channel, orbit, section) = (&plane.axes[k], &plane.orbit[k], &plane.section[k]);
            at.note(&format!("{axis}_channel"), channel.name.as_str())?;
            at.array(&format!("orbit_{axis}"), &[orbit.len()], orbit, &channel.unit)?;
            at.array(&format!("section_{axis}"), &[section.len()], section, &channel.unit)?;
        }
    }
    Ok(())
}

pub fn lyapunov(store: &Store, found: &LyapunovResult) -> Result<(), Error> {
    let place = Place::new(store, "/lyapunov")?;
    let e = &found.exponent;
    place.note("speed", found.speed)?;
    clock(&place, &found.clock)?;
    place.note("exponent", e.value)?;
    place.note("standard_error", e.standard_error)?;
    place.array("exponent", &[e.history.len()], &e.history, "1/s")?;
    place.array("time", &[e.times.len()], &e.times, "s")?;
    place.axis("exponent", 0, "time")
}

/// Per sweep all quantities over the parameter's values, in the order of the sweep; NaN where no steady
/// motion was found.
pub fn bifurcation(store: &Store, found: &BifurcationResult) -> Result<(), Error> {
    let place = Place::new(store, "/bifurcation")?;
    place.note("parameter", found.parameter.paths.clone())?;
    place.note("unit", found.parameter.unit.as_str())?;
    place.note("clock", found.clock.as_str())?;
    place.note("seams", found.seams as i64)?;
    place.note("repaired", found.repaired as i64)?;
    place.note("complete", i64::from(found.complete))?;
    for sweep in &found.sweeps {
        let at = place.below(&sweep.name.replace(' ', "_"))?;
        let n = sweep.points.len();
        let over = |value: &dyn Fn(&crate::results::SteadyMotion) -> f64| -> Vec<f64> {
            sweep.points.iter().map(|p| p.found.as_ref().map_or(f64::NAN, value)).collect()
        };
        let values: Vec<f64> = sweep.points.iter().map(|p| p.value).collect();
        at.array("value", &[n], &values, &found.parameter.unit)?;
        let kinds: Vec<String> = sweep
            .points
            .iter()
            .map(|p| {
                p.found.as_ref().map_or_else(|reason| format!("none: {reason}"), |m| m.motion.motion.name())
            })
            .collect();
        at.texts("motion", &[n], &kinds)?;
        let mut columns = vec![
            (
                "period",
                "periods of the clock",
                over(&|m| m.motion.motion.period().map_or(f64::NAN, |k| k as f64)),
            ),
            ("recurrence", "1", over(&|m| m.motion.recurrence)),
            ("zero_one", "1", over(&|m| m.motion.chaos)),
            ("frequency", "Hz", over(&|m| m.frequency)),
        ];
        if sweep.points.iter().any(|p| p.found.as_ref().is_ok_and(|m| m.exponent.is_some())) {
            let of = |value: fn(&crate::signal::lyapunov::Exponent) -> f64| {
                over(&move |m| m.exponent.as_ref().map_or(f64::NAN, value))
            };
            columns.push(("exponent", "1/s", of(|e| e.value)));
            columns.push(("standard_error", "1/s", of(|e| e.standard_error)));
        }
        for (name, unit, column) in columns {
            at.array(name, &[n], &column, unit)?;
            at.axis(name, 0, "value")?;
        }
        for (c, channel) in found.channels.iter().enumerate() {
            let path = format!("channels/{}", channel.name);
            let points = longest(sweep);
            let mut sections = vec![f64::NAN; n * points];
            for (row, point) in sections.chunks_mut(points.max(1)).zip(&sweep.points) {
                if let Ok(motion) = &point.found {
                    row[..motion.sections[c].len()].copy_from_slice(&motion.sections[c]);
                }
            }
            at.array(&format!("{path}/section"), &[n, points], &sections, &channel.unit)?;
            at.axis(&format!("{path}/section"), 0, "value")?;
            for (end, name) in ["minimum", "maximum"].into_iter().enumerate() {
                let name = format!("{path}/{name}");
                at.array(&name, &[n], &over(&|m| m.extremes[c][end]), &channel.unit)?;
                at.axis(&name, 0, "value")?;
            }
        }
    }
    Ok(())
}

/// Largest number of section points at any value.
fn longest(sweep: &BifurcationSweep) -> usize {
    let points = |p: &crate::results::BifurcationPoint| match &p.found {
        Ok(motion) => motion.sections.iter().map(Vec::len).max().unwrap_or(0),
        Err(_) => 0,
    };
    sweep.points.iter().map(points).max().unwrap_or(0)
}

fn clock(place: &Place, clock: &SectionClock) -> Result<(), Error> {
    place.note("clock", clock.name.as_str())?;
    place.note("phase", clock.phase)?;
    place.note("frequency", clock.frequency)
}

fn motion(place: &Place, found: &Classified) -> Result<(), Error> {
    place.note("motion", found.motion.name())?;
    place.note("recurrence", found.recurrence)?;
    place.note("zero_one", found.chaos)
}

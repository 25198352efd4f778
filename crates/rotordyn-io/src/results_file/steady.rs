//! Poincaré sections, Lyapunov exponents and bifurcation diagrams as data sets.

use super::GroupWriter;
use crate::error::Error;
use crate::hdf5::Store;
use rotordyn_core::results::{
    BifurcationResult, BifurcationSweep, LyapunovResult, PoincareResult, SectionClock,
};
use rotordyn_signal::motion_classification::Classification;

pub fn poincare(store: &Store, found: &PoincareResult) -> Result<(), Error> {
    let writer = GroupWriter::new(store, "/poincare")?;
    writer.set_attribute("speed", found.speed)?;
    clock(&writer, &found.clock)?;
    motion(&writer, &found.motion)?;
    writer.set_attribute("transient_periods", found.transient_periods as i64)?;
    writer.set_attribute("groups", found.groups as i64)?;
    writer.write_array("shaft_angle", &[found.shaft_angle.len()], &found.shaft_angle, "rad")?;
    for plane in &found.planes {
        let at = writer.subgroup(&plane.name)?;
        at.set_attribute("sample_rate", plane.sample_rate)?;
        if let Some(whirl) = &plane.whirl {
            let (major, minor) = whirl.synchronous.semi_axes();
            at.set_attribute("whirl", whirl.name())?;
            at.set_attribute("forwardness", whirl.forwardness)?;
            at.set_attribute("semi_major_1x", major)?;
            at.set_attribute("semi_minor_1x", minor)?;
        }
        if let Some(clearance) = plane.clearance {
            at.set_attribute("clearance", clearance)?;
        }
        for (k, axis) in ["x", "y"].into_iter().enumerate() {
            let (channel, orbit, section) = (&plane.axes[k], &plane.orbit[k], &plane.section[k]);
            at.set_attribute(&format!("{axis}_channel"), channel.name.as_str())?;
            at.write_array(&format!("orbit_{axis}"), &[orbit.len()], orbit, &channel.unit)?;
            at.write_array(&format!("section_{axis}"), &[section.len()], section, &channel.unit)?;
        }
    }
    Ok(())
}

pub fn lyapunov(store: &Store, found: &LyapunovResult) -> Result<(), Error> {
    let writer = GroupWriter::new(store, "/lyapunov")?;
    let e = &found.exponent;
    writer.set_attribute("speed", found.speed)?;
    clock(&writer, &found.clock)?;
    writer.set_attribute("exponent", e.value)?;
    writer.set_attribute("standard_error", e.standard_error)?;
    writer.write_array("exponent", &[e.history.len()], &e.history, "1/s")?;
    writer.write_array("time", &[e.times.len()], &e.times, "s")?;
    writer.attach_scale("exponent", 0, "time")
}

/// Per sweep all quantities over the parameter's values, in the order of the sweep; NaN where no steady
/// motion was found.
pub fn bifurcation(store: &Store, found: &BifurcationResult) -> Result<(), Error> {
    let writer = GroupWriter::new(store, "/bifurcation")?;
    writer.set_attribute("parameter", found.parameter.paths.clone())?;
    writer.set_attribute("unit", found.parameter.unit.as_str())?;
    writer.set_attribute("clock", found.clock.as_str())?;
    writer.set_attribute("chunk_boundaries", found.seams as i64)?;
    writer.set_attribute("rerun_chunks", found.rerun_chunks as i64)?;
    writer.set_attribute("complete", i64::from(found.complete))?;
    for sweep in &found.sweeps {
        let at = writer.subgroup(&sweep.name.replace(' ', "_"))?;
        let n = sweep.points.len();
        let over = |value: &dyn Fn(&rotordyn_core::results::SteadyMotion) -> f64| -> Vec<f64> {
            sweep.points.iter().map(|p| p.motion.as_ref().map_or(f64::NAN, value)).collect()
        };
        let values: Vec<f64> = sweep.points.iter().map(|p| p.value).collect();
        at.write_array("value", &[n], &values, &found.parameter.unit)?;
        let kinds: Vec<String> = sweep
            .points
            .iter()
            .map(|p| {
                p.motion.as_ref().map_or_else(|reason| format!("none: {reason}"), |m| m.motion.motion.name())
            })
            .collect();
        at.write_texts("motion", &[n], &kinds)?;
        let mut columns = vec![
            (
                "period",
                "periods of the clock",
                over(&|m| m.motion.motion.period().map_or(f64::NAN, |k| k as f64)),
            ),
            ("recurrence", "1", over(&|m| m.motion.recurrence)),
            ("zero_one", "1", over(&|m| m.motion.zero_one_k)),
            ("settled", "1", over(&|m| f64::from(m.motion.motion.is_settled()))),
            ("residual", "1", over(&|m| m.motion.residual)),
            ("decay_factor", "1", over(&|m| m.motion.decay_factor)),
            ("transient_periods", "periods of the clock", over(&|m| m.transient_periods as f64)),
            ("frequency", "Hz", over(&|m| m.frequency)),
        ];
        if sweep.points.iter().any(|p| p.motion.as_ref().is_ok_and(|m| m.exponent.is_some())) {
            let of = |value: fn(&rotordyn_signal::lyapunov::LyapunovExponent) -> f64| {
                over(&move |m| m.exponent.as_ref().map_or(f64::NAN, value))
            };
            columns.push(("exponent", "1/s", of(|e| e.value)));
            columns.push(("standard_error", "1/s", of(|e| e.standard_error)));
        }
        for (name, unit, column) in columns {
            at.write_array(name, &[n], &column, unit)?;
            at.attach_scale(name, 0, "value")?;
        }
        for (c, channel) in found.channels.iter().enumerate() {
            let path = format!("channels/{}", channel.name);
            let points = max_section_points(sweep);
            let mut sections = vec![f64::NAN; n * points];
            for (row, point) in sections.chunks_mut(points.max(1)).zip(&sweep.points) {
                if let Ok(motion) = &point.motion {
                    row[..motion.sections[c].len()].copy_from_slice(&motion.sections[c]);
                }
            }
            at.write_array(&format!("{path}/section"), &[n, points], &sections, &channel.unit)?;
            at.attach_scale(&format!("{path}/section"), 0, "value")?;
            for (end, name) in ["minimum", "maximum"].into_iter().enumerate() {
                let name = format!("{path}/{name}");
                at.write_array(&name, &[n], &over(&|m| m.extremes[c][end]), &channel.unit)?;
                at.attach_scale(&name, 0, "value")?;
            }
        }
    }
    Ok(())
}

/// Largest number of section points at any value.
fn max_section_points(sweep: &BifurcationSweep) -> usize {
    let points = |p: &rotordyn_core::results::BifurcationPoint| match &p.motion {
        Ok(motion) => motion.sections.iter().map(Vec::len).max().unwrap_or(0),
        Err(_) => 0,
    };
    sweep.points.iter().map(points).max().unwrap_or(0)
}

fn clock(writer: &GroupWriter, clock: &SectionClock) -> Result<(), Error> {
    writer.set_attribute("clock", clock.name.as_str())?;
    writer.set_attribute("phase", clock.phase)?;
    writer.set_attribute("frequency", clock.frequency)
}

fn motion(writer: &GroupWriter, found: &Classification) -> Result<(), Error> {
    writer.set_attribute("motion", found.motion.name())?;
    writer.set_attribute("recurrence", found.recurrence)?;
    writer.set_attribute("zero_one", found.zero_one_k)?;
    writer.set_attribute("settled", i64::from(found.motion.is_settled()))?;
    writer.set_attribute("residual", found.residual)?;
    writer.set_attribute("decay_factor", found.decay_factor)
}

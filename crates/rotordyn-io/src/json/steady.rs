//! Poincaré sections, Lyapunov exponents and bifurcation diagrams as JSON.

use serde_json::{Value, json};

use super::TO_RPM;
use rotordyn_core::results::{
    BifurcationPoint, BifurcationResult, BifurcationSweep, LyapunovResult, PlaneSection, PoincareResult,
    SectionClock, SteadyMotion,
};
use rotordyn_signal::lyapunov::LyapunovExponent;
use rotordyn_signal::motion_classification::Classification;

pub fn poincare(found: &PoincareResult) -> Value {
    let plane = |p: &PlaneSection| {
        let whirl = p.whirl.as_ref().map(|w| {
            let (major, minor) = w.synchronous.semi_axes();
            json!({
                "direction": w.name(), "forwardness": w.forwardness,
                "semi_major_1x": major, "semi_minor_1x": minor,
            })
        });
        json!({
            "name": p.name,
            "axes": p.axes.each_ref().map(|a| json!({ "name": a.name, "unit": a.unit })),
            "section": p.section, "orbit": p.orbit.each_ref().map(|v| extremes(v)), "whirl": whirl,
            "clearance": p.clearance,
        })
    };
    json!({
        "speed_rpm": found.speed * TO_RPM, "clock": clock(&found.clock), "motion": motion(&found.motion),
        "transient_periods": found.transient_periods,
        "groups": found.groups, "planes": found.planes.iter().map(plane).collect::<Value>(),
    })
}

pub fn lyapunov(found: &LyapunovResult) -> Value {
    let e = &found.exponent;
    json!({
        "speed_rpm": found.speed * TO_RPM, "clock": clock(&found.clock), "exponent": exponent(e),
        "time_s": e.times, "history": e.history,
    })
}

pub fn bifurcation(found: &BifurcationResult) -> Value {
    let point = |p: &BifurcationPoint| match &p.motion {
        Ok(found) => steady_motion(p.value, found),
        Err(reason) => json!({ "value": p.value, "failure": reason }),
    };
    let sweep = |s: &BifurcationSweep| json!({ "name": s.name, "points": s.points.iter().map(point).collect::<Value>() });
    json!({
        "parameter": found.parameter.paths, "unit": found.parameter.unit, "clock": found.clock,
        "channels": found.channels.iter().map(|c| json!({ "name": c.name, "unit": c.unit })).collect::<Value>(),
        "chunk_boundaries": found.seams, "rerun_chunks": found.rerun_chunks, "complete": found.complete,
        "sweeps": found.sweeps.iter().map(sweep).collect::<Value>(),
    })
}

fn steady_motion(value: f64, found: &SteadyMotion) -> Value {
    json!({
        "value": value, "motion": motion(&found.motion), "frequency_hz": found.frequency,
        "transient_periods": found.transient_periods,
        "sections": found.sections, "extremes": found.extremes,
        "exponent": found.exponent.as_ref().map(exponent),
    })
}

fn motion(found: &Classification) -> Value {
    json!({
        "kind": found.motion.name(), "period": found.motion.period(), "recurrence": found.recurrence,
        "zero_one": found.zero_one_k, "settled": found.motion.is_settled(), "residual": found.residual,
        "decay_factor": found.decay_factor,
    })
}

fn exponent(found: &LyapunovExponent) -> Value {
    json!({ "value": found.value, "standard_error": found.standard_error })
}

fn clock(found: &SectionClock) -> Value {
    json!({ "name": found.name, "phase": found.phase, "frequency_hz": found.frequency })
}

fn extremes(values: &[f64]) -> [f64; 2] {
    values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| [v.min(l), v.max(h)])
}

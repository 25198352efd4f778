//! Unbalance, loads, damping, drive, speed profile and probes.

use super::increasing::check_increasing;
use super::measured_speed;
use super::places::Places;
use crate::file::diagnostic::{Kind, Problem};
use crate::file::reader::{Reader, any, not_negative, positive};
use crate::{Damping, Drive, ExternalFile, Load, Probe, Quantity, SpeedProfile, Unbalance};
use rotordyn_core::element::Anchor;
use rotordyn_units::{
    ANGLE, FORCE, FREQUENCY, LENGTH, MASS, MOMENT, NUMBER, RATE, SPEED, TILT_DAMPING, TIME, UNBALANCE,
};

/// Unbalance by magnitude, by a mass at a radius, or by a balance quality grade of ISO 21940-11: U = m G/Ω, G
/// = e_per Ω.
pub(super) fn unbalances(top: &Reader, places: &Places, rotor_mass: f64) -> Vec<Unbalance> {
    let read = |(name, r): (&str, Reader)| {
        let (node, _) = places.station(&r, "station");
        let magnitude = match r.one_of(&["magnitude", "mass", "grade"]) {
            Some("magnitude") => r.need("magnitude", not_negative(UNBALANCE)),
            Some("mass") => r.need("mass", not_negative(MASS)) * r.need("radius", positive(LENGTH)),
            Some(_) => {
                let speed = r.need("speed", positive(SPEED));
                let mass = r.or("rotor_mass", positive(MASS), rotor_mass);
                mass * balance_grade(&r) / speed
            }
            None => {
                r.missing("magnitude", "\"560 g mm\", or mass and radius, or grade and speed");
                1.0
            }
        };
        let phase = r.or("phase", any(ANGLE), 0.0);
        r.finish();
        Unbalance { name: name.into(), node, magnitude, phase }
    };
    top.items("unbalance").into_iter().map(read).collect()
}

/// Balance quality grade, "G6.3" \[m/s\].
fn balance_grade(r: &Reader) -> f64 {
    let number = |text: &str| text.trim().strip_prefix(['G', 'g'])?.trim().parse::<f64>().ok();
    match r.text("grade").and_then(number) {
        Some(mm_per_s) if mm_per_s > 0.0 && mm_per_s.is_finite() => mm_per_s / 1e3,
        _ => {
            let problem = Problem::new(
                Kind::BadQuantity,
                &r.span_of("grade"),
                format!("{} is not a balance quality grade", r.name("grade")),
            );
            r.log.error(problem.expected("a grade of ISO 21940-11 such as \"G6.3\""));
            1.0
        }
    }
}

pub(super) fn loads(top: &Reader, places: &Places) -> Vec<Load> {
    let read = |(name, r): (&str, Reader)| {
        let at = places.anchor(&r);
        if at.node.is_none() && r.has_no_errors() {
            r.error(Kind::Conflict, "at", format!("{} acts on ground, where it has no effect", r.path));
        }
        let force = r.vector("force", FORCE);
        let moment = r.vector("moment", MOMENT);
        if force.is_none() && moment.is_none() && r.has_no_errors() {
            r.missing("force", "\"0, -100, 0 N\"");
        }
        let (f, m) = (force.unwrap_or_default(), moment.unwrap_or_default());
        let mut history = Vec::new();
        if r.has("time") || r.has("factor") {
            let (time, factor) = (r.need_list("time", any(TIME)), r.need_list("factor", any(NUMBER)));
            history = table(&r, "time", &time, "factor", &factor);
        }
        r.finish();
        Load { name: name.into(), at, force: [f[0], f[1], f[2], m[0], m[1], m[2]], history }
    };
    top.items("load").into_iter().map(read).collect()
}

/// Pairs from two lists of equal length, the first increasing.
fn table(r: &Reader, x_key: &str, x: &[f64], y_key: &str, y: &[f64]) -> Vec<[f64; 2]> {
    if !r.has_no_errors() {
        return Vec::new();
    }
    if x.len() != y.len() {
        let message = format!("{} has {} values, but `{x_key}` has {}", r.name(y_key), y.len(), x.len());
        r.error(Kind::Conflict, y_key, message);
    }
    check_increasing(r, x_key, x);
    x.iter().zip(y).map(|(&x, &y)| [x, y]).collect()
}

pub(super) fn damping(top: &Reader) -> Damping {
    let r = top.table_or_empty("damping");
    let proportional = [r.or("mass", not_negative(RATE), 0.0), r.or("stiffness", not_negative(TIME), 0.0)];
    let modal = r.table("modal").map_or_else(Vec::new, |m| {
        let frequency = m.need_list("frequency", not_negative(FREQUENCY));
        let ratio = m.need_list("ratio", not_negative(NUMBER));
        if ratio.iter().any(|&z| z >= 1.0) && m.has_no_errors() {
            let problem = Problem::new(
                Kind::OutOfRange,
                &m.span_of("ratio"),
                format!("{} is 1 or more", m.name("ratio")),
            );
            m.log.error(problem.expected("damping ratios below 1, such as 0.005 or \"0.5 %\""));
        }
        let modal = table(&m, "frequency", &frequency, "ratio", &ratio);
        m.finish();
        modal
    });
    r.finish();
    Damping { proportional, modal }
}

pub(super) fn drive(top: &Reader, places: &Places) -> Drive {
    let Some(r) = top.table("drive") else { return Drive::Prescribed { node: None } };
    if !r.has("kind") {
        r.missing("kind", "\"prescribed\" or \"torque\"");
    }
    let torque = r.choice("kind", &[("prescribed", false), ("torque", true)]).unwrap_or(false);
    let drive = if torque {
        let (node, _) = places.station(&r, "station");
        let speed = r.need_list("speed", any(SPEED));
        let values = r.need_list("torque", any(MOMENT));
        let drag = r.or("drag", not_negative(TILT_DAMPING), 0.0);
        Drive::Torque { node, table: table(&r, "speed", &speed, "torque", &values), drag }
    } else {
        Drive::Prescribed { node: r.has("station").then(|| places.station(&r, "station").0) }
    };
    r.finish();
    drive
}

pub(super) fn profile(top: &Reader, files: &[ExternalFile]) -> SpeedProfile {
    #[derive(Clone, Copy)]
    enum Shape {
        Constant,
        Ramp,
        SCurve,
        Table,
        CoastDown,
        Measured,
    }
    let Some(r) = top.table("speed") else { return SpeedProfile::Constant { speed: 0.0, duration: 1.0 } };
    let shapes = [
        ("constant", Shape::Constant),
        ("ramp", Shape::Ramp),
        ("s-curve", Shape::SCurve),
        ("table", Shape::Table),
        ("coast-down", Shape::CoastDown),
        ("measured", Shape::Measured),
    ];
    if !r.has("profile") {
        r.missing("profile", "\"ramp\"");
    }
    let speed = |key: &str| r.need(key, not_negative(SPEED));
    let from = || r.or("from", not_negative(SPEED), 0.0);
    let pause = |key: &str| r.or(key, not_negative(TIME), 0.0);
    let duration = |key: &str| r.need(key, positive(TIME));
    let profile = match r.choice("profile", &shapes) {
        Some(Shape::Constant) => {
            SpeedProfile::Constant { speed: speed("speed"), duration: duration("duration") }
        }
        Some(Shape::Ramp) => SpeedProfile::Ramp {
            from: from(),
            to: speed("to"),
            settle: pause("settle"),
            ramp: duration("ramp"),
            hold: pause("hold"),
        },
        Some(Shape::SCurve) => SpeedProfile::SCurve {
            from: from(),
            to: speed("to"),
            settle: pause("settle"),
            ramp: duration("ramp"),
            hold: pause("hold"),
        },
        Some(Shape::Table) => {
            let time = r.need_list("time", not_negative(TIME));
            let speed = r.need_list("speed", not_negative(SPEED));
            if time.len() < 2 && r.has_no_errors() {
                r.error(Kind::WrongType, "time", "speed.time needs two values or more");
            }
            SpeedProfile::Table { points: table(&r, "time", &time, "speed", &speed) }
        }
        Some(Shape::CoastDown) => SpeedProfile::CoastDown {
            from: speed("from"),
            settle: pause("settle"),
            time_constant: duration("time_constant"),
            duration: duration("duration"),
        },
        Some(Shape::Measured) => {
            measured_speed::read(&r, files).unwrap_or(SpeedProfile::Constant { speed: 0.0, duration: 1.0 })
        }
        None => {
            r.entries();
            SpeedProfile::Constant { speed: 0.0, duration: 1.0 }
        }
    };
    r.finish();
    profile
}

pub(super) const QUANTITIES: [(&str, Quantity); 3] = [
    ("displacement", Quantity::Displacement),
    ("velocity", Quantity::Velocity),
    ("acceleration", Quantity::Acceleration),
];

pub(super) fn probes(top: &Reader, places: &Places) -> Vec<Probe> {
    let read = |(name, r): (&str, Reader)| {
        if name.contains(['/', '"']) || name.is_empty() {
            let problem =
                Problem::new(Kind::OutOfRange, &r.span, format!("`{name}` is not a valid channel name"));
            r.log.error(problem.expected("a name without / and quotes"));
        }
        let probe = Probe {
            name: name.into(),
            at: places.anchor(&r),
            direction: direction(&r),
            quantity: r.choice("quantity", &QUANTITIES).unwrap_or(Quantity::Displacement),
        };
        r.finish();
        probe
    };
    top.items("probe").into_iter().map(read).collect()
}

/// Direction by name ("x", "-y", "tz" for a rotation) or as components (3 or 6); normalised to unit
/// translation, or to unit rotation if there is no translation.
pub(super) fn direction(r: &Reader) -> [f64; 6] {
    use crate::file::tree::Value;
    let mut direction = [0.0; 6];
    match r.entry("direction").map(|e| &e.node.value) {
        None => r.missing("direction", "\"x\" or [1, 1, 0]"),
        Some(Value::Text(text)) => {
            let (sign, axis) = text.strip_prefix('-').map_or((1.0, text.as_str()), |axis| (-1.0, axis));
            match ["x", "y", "z", "tx", "ty", "tz"].iter().position(|a| *a == axis) {
                Some(k) => direction[k] = sign,
                None => {
                    let message = format!("`{text}` is not a direction");
                    let problem = Problem::new(Kind::UnknownName, &r.span_of("direction"), message);
                    r.log.error(
                        problem.expected(
                            "x, y, z, tx, ty or tz, with - for the opposite direction, or [1, 1, 0]",
                        ),
                    );
                }
            }
        }
        Some(_) => {
            let Some(values) = r.list("direction", any(NUMBER)) else { return direction };
            if !matches!(values.len(), 3 | 6) {
                let message = format!("{} has three or six components", r.name("direction"));
                r.error(Kind::WrongType, "direction", message);
                return direction;
            }
            let length = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
            let scale = match (length(&values[..3]), length(&values)) {
                (translation, _) if translation > 0.0 => translation,
                (_, rotation) if rotation > 0.0 => rotation,
                _ => {
                    r.error(Kind::OutOfRange, "direction", format!("{} is zero", r.name("direction")));
                    1.0
                }
            };
            for (d, v) in direction.iter_mut().zip(&values) {
                *d = v / scale;
            }
        }
    }
    direction
}

/// Anchor and direction of an excitation, such as a hammer impact.
pub(super) fn anchor_and_direction(r: &Reader, places: &Places) -> (Anchor, [f64; 6]) {
    (places.anchor(r), direction(r))
}

//! Studies of steady motion at constant speed: Poincaré sections, Lyapunov exponents, bifurcation diagrams.

use super::run_keys::{channels, integrator};
use super::work_limits;
use crate::file::diagnostic::{Kind, Problem};
use crate::file::reader::{Reader, any, positive};
use crate::file::renamed::{self, renamed_path};
use crate::file::tree::{Node, Value};
use crate::study::{
    BifurcationStudy, Continuation, Integrator, LyapunovStudy, Parameter, Plane, PoincareStudy, RunUpStudy,
    SectionTrigger, SteadyRunSettings, Studies, Sweep,
};
use crate::{Drive, Model, Probe, Quantity};
use rotordyn_units::{ANGLE, FREQUENCY, LENGTH, NUMBER, SPEED, TIME, leading_number};

/// Default perturbation for the Lyapunov exponent \[m\].
const DEFAULT_PERTURBATION: f64 = 1e-9;
const DEFAULT_TOLERANCE: f64 = 1e-3;
const DEFAULT_LONGEST_PERIOD: usize = 32;
/// Default limit of a run whose motion does not settle, as a multiple of its transient and recorded periods.
const DEFAULT_LIMIT_FACTOR: usize = 10;

pub(super) fn read(all: &Reader, model: &Model, studies: &mut Studies) {
    if let Some(r) = all.table("poincare") {
        let steady = steady(&r, model, studies.run_up.as_ref(), [200, 300], false);
        let planes = planes(&r, model);
        studies.poincare = Some(PoincareStudy {
            steady,
            planes,
            tolerance: r.or("tolerance", positive(NUMBER), DEFAULT_TOLERANCE),
            longest_period: r.count("longest_period", DEFAULT_LONGEST_PERIOD, 1..=10_000),
        });
        r.finish();
    }
    if let Some(r) = all.table("lyapunov") {
        let steady = steady(&r, model, studies.run_up.as_ref(), [200, 1000], false);
        let perturbation = r.or("perturbation", positive(LENGTH), DEFAULT_PERTURBATION);
        studies.lyapunov = Some(LyapunovStudy { steady, perturbation });
        r.finish();
    }
    if let Some(r) = all.table("bifurcation") {
        studies.bifurcation = Some(bifurcation(&r, model, studies.run_up.as_ref()));
        r.finish();
    }
}

/// A run at constant speed; integrator, step and cutoff default to those of the run-up. `varied`: the speed
/// is the bifurcation parameter and need not be given.
fn steady(
    r: &Reader,
    model: &Model,
    run_up: Option<&RunUpStudy>,
    [transient_periods, periods]: [usize; 2],
    varied: bool,
) -> SteadyRunSettings {
    let top = model.profile.top_speed();
    if !r.has("speed") && top == 0.0 && !varied {
        r.missing("speed", "\"3000 rpm\"");
    }
    if matches!(model.drive, Drive::Torque { .. }) && r.has_no_errors() {
        let message = format!("{} runs at constant speed, but the drive is a torque", r.path);
        let problem = Problem::new(Kind::Conflict, &r.span, message);
        r.log.error(problem.hint("set drive.kind = \"prescribed\""));
    }
    let transient_periods = r.count("transient_periods", transient_periods, 0..=10_000_000);
    let periods = r.count("periods", periods, 8..=10_000_000);
    let limit = DEFAULT_LIMIT_FACTOR * (transient_periods + periods);
    let default = run_up.map_or(Integrator::GeneralisedAlpha { rho_infinity: 0.8 }, |s| s.integrator);
    let settings = SteadyRunSettings {
        speed: r.or("speed", positive(SPEED), top),
        integrator: integrator(r, default),
        step: r.or("step", positive(TIME), run_up.map_or(1e-4, |s| s.step)),
        cutoff: r.or("cutoff", positive(FREQUENCY), run_up.map_or(f64::INFINITY, |s| s.cutoff)),
        trigger: section_trigger(r, model),
        phase: r.or("phase", any(ANGLE), 0.0),
        transient_periods,
        periods,
        transient_limit: r.count("transient_limit", limit, 0..=1_000_000_000),
    };
    work_limits::check_steady(r, &settings);
    settings
}

fn section_trigger(r: &Reader, model: &Model) -> SectionTrigger {
    let kinds = [("shaft", 0), ("cage", 1), ("ball-pass", 2)];
    let kind = r.choice("section", &kinds).unwrap_or(0);
    let balls = |site: &crate::BearingSite| site.bearing.ball().map(|ball| ball.geometry.balls);
    let with_balls = || model.bearings.iter().enumerate().filter_map(|(k, s)| balls(s).map(|z| (k, s, z)));
    let wanted = r.text("bearing");
    if let Some(name) = wanted
        && with_balls().all(|(_, site, _)| site.name != name)
    {
        let problem = Problem::new(
            Kind::UnknownName,
            &r.span_of("bearing"),
            format!("there is no ball bearing `{name}`"),
        );
        r.log.error(problem.suggest(name, with_balls().map(|(_, site, _)| site.name.as_str())));
        return SectionTrigger::Shaft;
    }
    if kind == 0 {
        return SectionTrigger::Shaft;
    }
    match with_balls().find(|(_, site, _)| wanted.is_none_or(|name| site.name == name)) {
        Some((bearing, ..)) if kind == 1 => SectionTrigger::Cage { bearing },
        Some((bearing, _, balls)) => SectionTrigger::BallPass { bearing, balls },
        None => {
            let message = format!("{} needs a ball bearing", r.name("section"));
            r.error(Kind::UnknownName, "section", message);
            SectionTrigger::Shaft
        }
    }
}

/// Planes as pairs of probes, "disc_x, disc_y"; a single probe gives its phase plane (value and rate).
fn planes(r: &Reader, model: &Model) -> Vec<Plane> {
    let named = |name: &str| model.probes.iter().find(|p| p.name == name);
    if !r.has("planes") {
        let planes = default_planes(model);
        if planes.is_empty() && r.has_no_errors() {
            let message = format!("{} has no probe", r.path);
            let problem = Problem::new(Kind::MissingKey, &r.span, message);
            r.log.error(problem.hint("add [probe.NAME] with at and direction"));
        }
        return planes;
    }
    let mut planes = Vec::new();
    for (text, span) in r.texts("planes").unwrap_or_default() {
        let names: Vec<&str> = text.split(',').map(str::trim).collect();
        if let Some(unknown) = names.iter().find(|name| named(name).is_none()) {
            let problem = Problem::new(Kind::UnknownName, &span, format!("unknown probe `{unknown}`"));
            r.log.error(problem.suggest(unknown, model.probes.iter().map(|p| p.name.as_str())));
            continue;
        }
        let probes: Vec<&Probe> = names.iter().filter_map(|name| named(name)).collect();
        let plane = match probes[..] {
            [x, y] => Some(plane_of(x, y)),
            [x] => phase_plane(x),
            _ => None,
        };
        match plane {
            Some(plane) => planes.push(plane),
            None => {
                let message = format!("`{text}` is not a plane");
                let problem = Problem::new(Kind::OutOfRange, &span, message);
                r.log.error(problem.expected(
                    "two probes, \"disc_x, disc_y\", or one of a displacement or velocity, \"disc_x\"",
                ));
            }
        }
    }
    planes
}

/// Orbit planes of all x-y probe pairs of one point and quantity; phase planes of the other displacements and
/// velocities.
fn default_planes(model: &Model) -> Vec<Plane> {
    let axis = |p: &Probe| (0..6).find(|&k| p.direction[k] == 1.0 && p.direction.iter().sum::<f64>() == 1.0);
    let partner = |p: &Probe, wanted: usize| {
        model.probes.iter().find(|q| q.at == p.at && q.quantity == p.quantity && axis(q) == Some(wanted))
    };
    let plane = |p: &Probe| match axis(p) {
        Some(k @ (0 | 3)) => partner(p, k + 1).map(|q| plane_of(p, q)).or_else(|| phase_plane(p)),
        Some(k @ (1 | 4)) if partner(p, k - 1).is_some() => None,
        _ => phase_plane(p),
    };
    model.probes.iter().filter_map(plane).collect()
}

fn plane_of(x: &Probe, y: &Probe) -> Plane {
    Plane { name: format!("{}_{}", x.name, y.name), x: x.clone(), y: y.clone() }
}

/// Phase plane: displacement and velocity, or velocity and acceleration.
fn phase_plane(x: &Probe) -> Option<Plane> {
    let quantity = match x.quantity {
        Quantity::Displacement => Quantity::Velocity,
        Quantity::Velocity => Quantity::Acceleration,
        Quantity::Acceleration => return None,
    };
    let y = Probe { name: format!("rate of {}", x.name), quantity, ..x.clone() };
    Some(Plane { name: format!("{}_rate", x.name), x: x.clone(), y })
}

fn bifurcation(r: &Reader, model: &Model, run_up: Option<&RunUpStudy>) -> BifurcationStudy {
    let parameter = parameter(r);
    let speed = r.name("speed");
    let varied = parameter.paths.contains(&speed);
    let steady = steady(r, model, run_up, [200, 100], varied);
    let names = channels(r, "channels", model);
    let chosen = |p: &&Probe| match names.is_empty() {
        true => p.quantity == Quantity::Displacement,
        false => names.contains(&p.name),
    };
    let mut shown: Vec<Probe> = model.probes.iter().filter(chosen).cloned().collect();
    if shown.is_empty() && names.is_empty() {
        shown.clone_from(&model.probes);
    }
    if shown.is_empty() && r.has_no_errors() {
        let problem = Problem::new(Kind::MissingKey, &r.span, format!("{} has no probe", r.path));
        r.log.error(problem.hint("add [probe.NAME] with at and direction"));
    }
    let sweeps = [("up", Sweep::Up), ("down", Sweep::Down), ("both", Sweep::Both)];
    let starts = [("continuation", true), ("equilibrium", false)];
    let count = parameter.values.len().max(1);
    let continuation = match r.choice("start", &starts).unwrap_or(true) {
        true => Continuation::PreviousState {
            chunks: r.count("chunks", (count / 8).clamp(1, 16), 1..=1000),
            overlap: r.count("overlap", 2, 1..=1000),
        },
        false => {
            for key in ["chunks", "overlap", "sweep"].iter().filter(|key| r.has(key)) {
                r.error(Kind::Conflict, key, format!("{} belongs to start = \"continuation\"", r.name(key)));
            }
            Continuation::Equilibrium
        }
    };
    let lyapunov = r.flag("lyapunov", false);
    let perturbation = r.or("perturbation", positive(LENGTH), DEFAULT_PERTURBATION);
    BifurcationStudy {
        steady,
        parameter,
        channels: shown,
        tolerance: r.or("tolerance", positive(NUMBER), DEFAULT_TOLERANCE),
        longest_period: r.count("longest_period", DEFAULT_LONGEST_PERIOD, 1..=10_000),
        sweep: r.choice("sweep", &sweeps).unwrap_or(Sweep::Both),
        continuation,
        perturbation: lyapunov.then_some(perturbation),
    }
}

/// Paths and values: `parameter = "bearing.B.radial_clearance"`, `values = { from = "5 um", to = "40 um", count = 71 }`.
///
/// The unit is checked when a value is set; here it is kept as written.
fn parameter(r: &Reader) -> Parameter {
    if !r.has("parameter") {
        r.missing("parameter", "\"speed\", or \"bearing.B.radial_clearance\", or any other value's path");
    }
    let path = |(text, span): (&str, _)| match (text, renamed_path(text)) {
        ("speed", _) => format!("{}.speed", r.path),
        (_, Some(present)) => {
            r.log.hint(Problem::new(Kind::FormerName, &span, renamed::hint(text, &present)));
            present
        }
        _ => text.to_string(),
    };
    let paths = r.texts("parameter").unwrap_or_default().into_iter().map(path).collect();
    let Some(entry) = r.entry("values") else {
        r.missing("values", "{ from = \"1000 rpm\", to = \"5000 rpm\", count = 200 }");
        return Parameter::default();
    };
    let (unit, values) = match &entry.node.value {
        Value::Table(table) => {
            let even = Reader::new(table, r.name("values"), entry.key_span.clone(), r.log);
            let values = evenly_spaced_values(&even);
            even.finish();
            values
        }
        Value::List(items) => list_values(r, items),
        _ => list_values(r, std::slice::from_ref(&entry.node)),
    }
    .unwrap_or_default();
    let text = |v: &f64| if unit.is_empty() { format!("{v}") } else { format!("{v} {unit}") };
    let texts = values.iter().map(text).collect();
    let mut sorted = values.clone();
    sorted.sort_by(f64::total_cmp);
    sorted.dedup();
    if sorted != values {
        r.error(Kind::OutOfRange, "values", format!("{} must increase", r.name("values")));
    }
    Parameter { paths, unit, values, texts }
}

/// Number and unit of a value of any dimension.
fn number_and_unit(r: &Reader, node: &Node) -> Option<(f64, String)> {
    let split = match &node.value {
        #[allow(clippy::cast_precision_loss)] // integers in a model file are small
        Value::Integer(i) => Some((*i as f64, String::new())),
        Value::Float(f) => Some((*f, String::new())),
        Value::Text(text) => leading_number(text.trim())
            .map(|(value, length)| (value, text.trim()[length..].trim().to_string())),
        _ => None,
    };
    if split.as_ref().is_none_or(|(value, _)| !value.is_finite()) {
        let problem = Problem::new(Kind::WrongType, &node.span, "not a parameter value");
        r.log.error(problem.expected("such as \"5 um\", \"3000 rpm\" or 8"));
        return None;
    }
    split
}

fn list_values(r: &Reader, items: &[Node]) -> Option<(String, Vec<f64>)> {
    let found: Vec<(f64, String)> = items.iter().filter_map(|item| number_and_unit(r, item)).collect();
    let unit = found.first()?.1.clone();
    if let Some(k) = found.iter().position(|(_, other)| *other != unit) {
        report_mixed_units(r, &items[k], &found[k].1, &unit);
        return None;
    }
    Some((unit, found.into_iter().map(|(value, _)| value).collect()))
}

fn report_mixed_units(r: &Reader, node: &Node, found: &str, unit: &str) {
    let message = format!("different units in one list of values: `{found}` and `{unit}`");
    r.log.error(Problem::new(Kind::BadQuantity, &node.span, message).hint("use one unit for all values"));
}

fn evenly_spaced_values(r: &Reader) -> Option<(String, Vec<f64>)> {
    let end = |key: &str| {
        if !r.has(key) {
            r.missing(key, "\"1000 rpm\"");
        }
        r.entry(key).and_then(|entry| number_and_unit(r, &entry.node).map(|found| (found, &entry.node)))
    };
    let (from, to) = (end("from"), end("to"));
    let key = r.one_of(&["count", "step"]);
    let whole = |value: f64| value.fract() == 0.0 && value.abs() < 1e5;
    let step =
        r.entry("step").and_then(|entry| number_and_unit(r, &entry.node).map(|found| (found, &entry.node)));
    let count = r.count("count", 200, 2..=100_000);
    let (((from, unit), _), ((to, other), node)) = (from?, to?);
    if other != unit {
        report_mixed_units(r, node, &other, &unit);
        return None;
    }
    if to <= from {
        r.error(Kind::OutOfRange, "to", format!("{} must be above {}", r.name("to"), r.name("from")));
        return None;
    }
    let steps = match (key, step) {
        (Some("step"), Some(((step, other), node))) => {
            if other != unit {
                report_mixed_units(r, node, &other, &unit);
                return None;
            }
            let steps = (to - from) / step;
            if !(0.999..1e5).contains(&steps) {
                r.error(
                    Kind::OutOfRange,
                    "step",
                    format!("{} divides the range into {steps:.1} steps", r.name("step")),
                );
                return None;
            }
            return Some((unit, (0..=(steps + 1e-9) as usize).map(|k| from + k as f64 * step).collect()));
        }
        (Some("step"), None) => return None,
        // Integer parameter without unit: every integer of the range.
        (None, _) if unit.is_empty() && whole(from) && whole(to) => (to - from) as usize,
        _ => count - 1,
    };
    let value = |k: usize| if k == steps { to } else { from + (to - from) * k as f64 / steps as f64 };
    Some((unit, (0..=steps).map(value).collect()))
}

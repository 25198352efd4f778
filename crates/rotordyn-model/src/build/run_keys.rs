//! Keys that run-up and steady studies share.

use crate::file::diagnostic::{Kind, Problem};
use crate::file::key::{Key, Quantity, Texts, Words, keys, positive, quantity, within, words};
use crate::file::quantities::declared_default;
use crate::file::reader::Reader;
use crate::study::Integrator;
use crate::{Drive, Load, LoadFactor, Model};
use rotordyn_core::warning::Code;
use rotordyn_units::{LENGTH, NUMBER, TIME};
use std::f64::consts::TAU;

#[derive(Clone, Copy, Debug)]
pub(super) enum Method {
    Alpha,
    Newmark,
    Fitted,
    Rk4,
    Dopri,
}

keys! {
    /// Of run-ups and of runs at constant speed.
    pub(super) static INTEGRATOR: IntegratorKeys {
        integrator: Words<Method> = words(&[
            ("generalised-alpha", Method::Alpha),
            ("newmark", Method::Newmark),
            ("fitted-newmark", Method::Fitted),
            ("rk4", Method::Rk4),
            ("dormand-prince", Method::Dopri),
        ], "Time integration; rk4 and dormand-prince are explicit. With free balls rk4, also by default.").default("generalised-alpha");
        rho_infinity: Quantity = quantity(within(NUMBER, [0.0, 1.0]),
            "Spectral radius of generalised-alpha at high frequencies; smaller damps more.").default("0.8");
        relative_tolerance: Quantity = quantity(positive(NUMBER), "Relative error per step of dormand-prince.").default("1e-6")
            .with("integrator = \"dormand-prince\"");
        absolute_tolerance: Quantity = quantity(positive(LENGTH), "Absolute error per step of dormand-prince.").default("1e-12 m")
            .with("integrator = \"dormand-prince\"");
    }
}

keys! {
    /// Of run-ups; those of runs at constant speed default to it.
    pub(super) static RUN_STEP: StepKeys {
        step: Quantity = quantity(positive(TIME), "Greatest time step; the step used divides the sampling interval; of dormand-prince the first; free balls divide it further.")
            .computed("100 us, less at high speed: a 90th of the period of the highest ball pass at the outer race, order cut or \
                       2x, and a tenth of that of the highest frequency of a random load, in two digits").example("\"100 us\"");
    }
}

/// Step at low speed \[us\].
const LARGEST_STEP_US: f64 = 100.0;
/// Steps in a period of the highest order line that is looked at.
const STEPS_PER_PERIOD: f64 = 90.0;

/// Steps in a period of the highest frequency of a random load: by default, by which steps of second order give a motion
/// 3 % off, and at least, where it is 20 % off.
const STEPS_PER_LOAD_PERIOD: f64 = 10.0;
const FEWEST_PER_LOAD_PERIOD: f64 = 4.0;

/// Steps in which a ball passes over a local defect at the highest speed.
const STEPS_ON_DEFECT: f64 = 40.0;

/// Step of a run without one \[us\], in two digits.
///
/// Steps of second order shift a natural frequency ω_n by the share (ω_n h)²/12. A line that passes the resonance changes by
/// up to 2 Q times that: with 90 steps in a period and Q = 25 (ζ = 2 %) by 2 %. `cuts`: orders looked at beside 2x and the
/// ball passes of the outer races; `speed`: the highest \[rad/s\].
pub(super) fn default_step_us(model: &Model, cuts: &[f64], speed: f64) -> f64 {
    let balls = model.bearings.iter().filter_map(|site| site.bearing.characteristic_orders());
    let passes = balls.map(|orders| orders.bpfo);
    let highest = passes.chain(cuts.iter().copied()).fold(2.0, f64::max);
    let of_load =
        fastest_load(model).map_or(f64::INFINITY, |(_, highest)| 1.0 / (STEPS_PER_LOAD_PERIOD * highest));
    in_two_digits(1e6 * (TAU / (STEPS_PER_PERIOD * highest * speed)).min(of_load)).min(LARGEST_STEP_US)
}

/// The random load of the highest frequency \[Hz\].
fn fastest_load(model: &Model) -> Option<(&Load, f64)> {
    let random = model.loads.iter().filter_map(|load| match &load.factor {
        LoadFactor::Random(noise) => Some((load, noise.highest_frequency())),
        LoadFactor::Constant | LoadFactor::Table(_) => None,
    });
    random.max_by(|a, b| a.1.total_cmp(&b.1))
}

/// Warns of a given step \[s\] that does not resolve a random load: what it has above half the rate of the steps folds down.
pub(super) fn check_step_of_loads(r: &Reader, model: &Model, step: f64) {
    let Some((load, highest)) =
        fastest_load(model).filter(|(_, highest)| step * FEWEST_PER_LOAD_PERIOD * highest > 1.0)
    else {
        return;
    };
    let message = format!(
        "a step of {} us is {:.1} to a period of load.{} at {highest:.0} Hz, the end of its band: its force is not that spectrum",
        1e6 * step,
        1.0 / (step * highest),
        load.name
    );
    let largest = in_two_digits(1e6 / (STEPS_PER_LOAD_PERIOD * highest));
    let problem = Problem::new(Kind::OutOfRange, &r.span_of(&RUN_STEP.step), message);
    r.log.warn(
        Code::TimeStep,
        "study.run_up",
        problem.hint(format!("step = \"{largest} us\", or a narrower band")),
    );
}

/// Step on a local defect of a run without one \[us\], in two digits; `None` without defects.
///
/// `speed`: the highest \[rad/s\].
pub(super) fn default_defect_step_us(model: &Model, speed: f64) -> Option<f64> {
    let balls = model.bearings.iter().filter(|site| site.bearing.free_balls().is_none());
    let passes = balls.filter_map(|site| site.bearing.ball()?.shortest_defect_pass());
    let shortest = passes.min_by(f64::total_cmp)?;
    Some(in_two_digits(1e6 * shortest / (STEPS_ON_DEFECT * speed)).min(LARGEST_STEP_US))
}

/// A step \[us\] rounded down.
fn in_two_digits(step: f64) -> f64 {
    // A picosecond for orders and defects that cannot be meant, whose number of steps is then refused.
    let step = step.max(1e-6);
    match step {
        _ if step >= 100.0 => step,
        _ if step >= 10.0 => step.floor(),
        _ => {
            // Below 10 us one digit more for every power of ten, divided and not multiplied: 8.8 as it is written.
            let power = 10f64.powi(1 - step.log10().floor() as i32);
            (step * power).floor() / power
        }
    }
}

/// Highest speed of a run \[rad/s\]: of the profile, and of the torque of a motor.
pub(super) fn top_speed(model: &Model) -> f64 {
    let top = model.profile.top_speed();
    match &model.drive {
        Drive::Torque { table, .. } => table.iter().fold(top, |top, row| top.max(row[0].abs())),
        _ => top,
    }
}

/// Whether a bearing has free bodies.
fn has_bodies(model: &Model) -> bool {
    model.bearings.iter().any(|site| site.bearing.element().bodies().is_some())
}

/// The integrator of a run without settings: with free balls rk4.
pub(super) fn default_integrator(model: &Model) -> Integrator {
    if has_bodies(model) {
        return Integrator::RungeKutta4;
    }
    Integrator::GeneralisedAlpha { rho_infinity: declared_default(&INTEGRATOR.rho_infinity) }
}

pub(super) fn channels(r: &Reader, key: &Key<Texts>, model: &Model) -> Vec<String> {
    let mut channels = Vec::new();
    for (name, span) in r.texts(key).unwrap_or_default() {
        if !model.probes.iter().any(|p| p.name == name) {
            let problem =
                Problem::new(Kind::UnknownName, &span, format!("unknown probe `{name}`")).follows("probe");
            r.log.error(problem.suggest(r.log, name, model.probes.iter().map(|p| p.name.as_str())));
        }
        channels.push(name.to_string());
    }
    channels
}

/// The requested integrator or the default; reject settings of other integrators, and integrators that do not take free
/// balls.
pub(super) fn integrator(r: &Reader, default: Integrator, model: &Model) -> Integrator {
    let chosen = chosen_integrator(r, default);
    let key = &INTEGRATOR.integrator;
    if r.has(key) && chosen != Integrator::RungeKutta4 && has_bodies(model) {
        let message = format!("{} does not take balls and cage as free bodies", r.name(key));
        let problem = Problem::new(Kind::Conflict, &r.span_of(key), message);
        r.log.error(
            problem
                .expected("\"rk4\", whose steps the bearing divides as it needs")
                .hint("leave the key out"),
        );
    }
    chosen
}

fn chosen_integrator(r: &Reader, default: Integrator) -> Integrator {
    let keys = &INTEGRATOR;
    let rho = r.get(&keys.rho_infinity);
    let [relative, absolute] = [&keys.relative_tolerance, &keys.absolute_tolerance].map(|key| r.get(key));
    let foreign = |key: &Key<Quantity>, owner: &str| {
        let message = format!("{} belongs to integrator = \"{owner}\"", r.name(key));
        if r.is_setting(&keys.integrator) && r.has(key) && !r.is_setting(key) {
            let message = format!("{message} and is ignored with the integrator of the command line");
            r.log.hint(Problem::new(Kind::Ineffective, &r.span_of(key), message));
        } else if r.has(key) {
            r.error(Kind::Conflict, key, message);
        }
    };
    let Some(method) = r.choice(&keys.integrator) else {
        return match (default, rho) {
            (Integrator::GeneralisedAlpha { .. }, Some(rho_infinity)) => {
                Integrator::GeneralisedAlpha { rho_infinity }
            }
            (Integrator::RungeKutta4, Some(_)) => {
                foreign(&keys.rho_infinity, "generalised-alpha");
                default
            }
            _ => default,
        };
    };
    if !matches!(method, Method::Alpha) {
        foreign(&keys.rho_infinity, "generalised-alpha");
    }
    if !matches!(method, Method::Dopri) {
        foreign(&keys.relative_tolerance, "dormand-prince");
        foreign(&keys.absolute_tolerance, "dormand-prince");
    }
    let or_default = |value: Option<f64>, key| value.unwrap_or_else(|| declared_default(key));
    match method {
        Method::Alpha => Integrator::GeneralisedAlpha { rho_infinity: or_default(rho, &keys.rho_infinity) },
        Method::Newmark => Integrator::Newmark,
        Method::Fitted => Integrator::FittedNewmark,
        Method::Rk4 => Integrator::RungeKutta4,
        Method::Dopri => Integrator::DormandPrince {
            relative_tolerance: or_default(relative, &keys.relative_tolerance),
            absolute_tolerance: or_default(absolute, &keys.absolute_tolerance),
        },
    }
}

//! Studies of steady motion at constant speed: Poincaré sections, Lyapunov exponents, bifurcation diagrams.

use super::bifurcation_parameter::{ParameterKeys, parameter};
use super::run_keys::{
    IntegratorKeys, channels, default_defect_step_us, default_integrator, default_step_us, integrator,
    top_speed,
};
use super::work_limits;
use crate::file::diagnostic::{Kind, Problem};
use crate::file::key::{
    Count, Declared, Flag, Group, Key, Quantity, SubTable, Table, Text, Texts, Words, any, count, flag, keys,
    positive, quantity, sub_table, text, texts, words,
};
use crate::file::reader::Reader;
use crate::study::{
    BifurcationStudy, Continuation, LyapunovStudy, Plane, PoincareStudy, RunUpStudy, SectionTrigger,
    SteadyRunSettings, Studies, Sweep,
};
use crate::{Drive, Model, Probe, Quantity as MotionQuantity};
use rotordyn_units::{ANGLE, FREQUENCY, LENGTH, NUMBER, SPEED, TIME};

keys! {
    /// Of `[study]`.
    pub(super) static STUDY: SteadyStudyKeys {
        poincare: SubTable = sub_table(&POINCARE_TABLE);
        lyapunov: SubTable = sub_table(&LYAPUNOV_TABLE);
        bifurcation: SubTable = sub_table(&BIFURCATION_TABLE);
    }
}

static POINCARE_TABLE: Table = Table {
    meaning: "Orbits and Poincare sections at constant speed; integrator settings default to those of the run-up.",
    groups: &[
        Group::always(SteadyKeys::LIST),
        Group::always(PoincarePeriodKeys::LIST),
        Group::always(PlaneKeys::LIST),
        Group::always(ClassKeys::LIST),
        Group::always(IntegratorKeys::LIST),
    ],
};

static LYAPUNOV_TABLE: Table = Table {
    meaning: "Largest Lyapunov exponent at constant speed; integrator settings default to those of the run-up.",
    groups: &[
        Group::always(SteadyKeys::LIST),
        Group::always(LyapunovPeriodKeys::LIST),
        Group::always(PerturbationKeys::LIST),
        Group::always(IntegratorKeys::LIST),
    ],
};

static BIFURCATION_TABLE: Table = Table {
    meaning: "Poincare sections over a parameter; integrator settings default to those of the run-up.",
    groups: &[
        Group::always(ParameterKeys::LIST),
        Group::always(BifurcationKeys::LIST),
        Group::always(SteadyKeys::LIST),
        Group::always(BifurcationPeriodKeys::LIST),
        Group::always(ClassKeys::LIST),
        Group::always(PerturbationKeys::LIST),
        Group::always(IntegratorKeys::LIST),
    ],
};

keys! {
    /// Of a run at constant speed.
    static STEADY: SteadyKeys {
        speed: Quantity = quantity(positive(SPEED), "Speed.").computed("the highest of [speed]")
            .example("\"3000 rpm\"");
        step: Quantity = quantity(positive(TIME), "Greatest time step.").computed("that of the run-up")
            .example("\"20 us\"");
        cutoff: Quantity = quantity(positive(FREQUENCY), "Modes below it are kept, with static correction modes.")
            .computed("that of the run-up").example("\"2 kHz\"");
        section: Words<Clock> = words(&[("shaft", Clock::Shaft), ("cage", Clock::Cage), ("ball-pass", Clock::BallPass)],
            "Poincare section once per shaft revolution, cage revolution or ball passage.").default("shaft");
        bearing: Text = text("name of a ball bearing", "Bearing whose cage triggers the section.")
            .computed("the first").example("\"B\"");
        phase: Quantity = quantity(any(ANGLE), "Phase angle of the section.").default("0 deg").example("\"90 deg\"");
        transient_limit: Count = count([0, 1_000_000_000], "Periods up to which a run goes on that has not settled.")
            .computed("ten times transient_periods + periods").example("5000");
    }
}

/// Most periods of a run.
const MAX_PERIODS: usize = 10_000_000;
const TRANSIENT: &str = "Periods discarded as transient.";
const RECORDED: &str = "Periods recorded.";

keys! {
    /// Lengths of `[study.poincare]`.
    static POINCARE_PERIODS: PoincarePeriodKeys {
        transient_periods: Count = count([0, MAX_PERIODS], TRANSIENT).default("200");
        periods: Count = count([8, MAX_PERIODS], RECORDED).default("300");
    }
}

keys! {
    /// Lengths of `[study.lyapunov]`.
    static LYAPUNOV_PERIODS: LyapunovPeriodKeys {
        transient_periods: Count = count([0, MAX_PERIODS], TRANSIENT).default("200");
        periods: Count = count([8, MAX_PERIODS], RECORDED).default("1000");
    }
}

keys! {
    /// Lengths of `[study.bifurcation]`.
    static BIFURCATION_PERIODS: BifurcationPeriodKeys {
        transient_periods: Count = count([0, MAX_PERIODS], TRANSIENT).default("200");
        periods: Count = count([8, MAX_PERIODS], RECORDED).default("100");
    }
}

keys! {
    /// Of `[study.poincare]`.
    static PLANE: PlaneKeys {
        planes: Texts = texts("probes \"x, y\" of an orbit, or one for its phase plane", "Planes of the section.")
            .computed("orbits of all x-y pairs, phase planes of other probes").example("[\"disc_x, disc_y\"]");
    }
}

keys! {
    /// Classification of the motion.
    static CLASS: ClassKeys {
        tolerance: Quantity = quantity(positive(NUMBER), "Relative distance below which two points are one.")
            .default("1e-3");
        longest_period: Count = count([1, 10_000], "Longest period that is looked for.").default("32");
    }
}

keys! {
    /// Of Lyapunov exponents.
    static PERTURBATION: PerturbationKeys {
        perturbation: Quantity = quantity(positive(LENGTH), "Distance of the perturbed trajectory.").default("1 nm");
    }
}

keys! {
    /// Of `[study.bifurcation]`.
    static BIFURCATION: BifurcationKeys {
        channels: Texts = texts("names of probes", "Channels.").computed("all displacements")
            .example("[\"disc_x\"]");
        sweep: Words<Sweep> = words(&[("up", Sweep::Up), ("down", Sweep::Down), ("both", Sweep::Both)],
            "Direction of the sweep by continuation.").default("both").with("start = \"continuation\"");
        start: Words<bool> = words(&[("continuation", true), ("equilibrium", false)],
            "Initial state: the final state of the previous value, or static equilibrium.").default("continuation");
        chunks: Count = count([1, 1000], "Parts of the range, which run in parallel.")
            .computed("an eighth of the values, at most 16").example("4");
        overlap: Count = count([1, 1000], "Values that a part starts before its own.").default("2");
        lyapunov: Flag = flag("Also compute the largest Lyapunov exponent, in twice the time.").default("false");
    }
}

/// Keywords of the key `section`.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Clock {
    Shaft,
    Cage,
    BallPass,
}

/// Default limit of a run whose motion does not settle, as a multiple of its transient and recorded periods.
const DEFAULT_LIMIT_FACTOR: usize = 10;

pub(super) fn read(all: &Reader, model: &Model, studies: &mut Studies) {
    let run_up = studies.run_up.as_ref();
    if let Some(r) = all.table(&STUDY.poincare) {
        let lengths = [&POINCARE_PERIODS.transient_periods, &POINCARE_PERIODS.periods];
        let steady = steady(&r, model, run_up, lengths, false);
        let planes = planes(&r, model);
        let (tolerance, longest_period) = (r.value(&CLASS.tolerance), r.count(&CLASS.longest_period));
        studies.poincare = Some(PoincareStudy { steady, planes, tolerance, longest_period });
        r.finish();
    }
    if let Some(r) = all.table(&STUDY.lyapunov) {
        let lengths = [&LYAPUNOV_PERIODS.transient_periods, &LYAPUNOV_PERIODS.periods];
        let steady = steady(&r, model, run_up, lengths, false);
        let perturbation = r.value(&PERTURBATION.perturbation);
        studies.lyapunov = Some(LyapunovStudy { steady, perturbation });
        r.finish();
    }
    if let Some(r) = all.table(&STUDY.bifurcation) {
        studies.bifurcation = Some(bifurcation(&r, model, run_up));
        r.finish();
    }
}

/// A run at constant speed; integrator, step and cutoff default to those of the run-up. `varied`: the speed
/// is the bifurcation parameter and need not be given.
fn steady(
    r: &Reader,
    model: &Model,
    run_up: Option<&RunUpStudy>,
    [transient_periods, periods]: [&Key<Count>; 2],
    varied: bool,
) -> SteadyRunSettings {
    let top = model.profile.top_speed();
    if !r.has(&STEADY.speed) && top == 0.0 && !varied {
        r.missing(&STEADY.speed);
    }
    if matches!(model.drive, Drive::Torque { .. }) && r.has_no_errors() {
        let message = format!("{} runs at constant speed, but the drive is a torque", r.path);
        let problem = Problem::new(Kind::Conflict, &r.span, message);
        r.log.error(problem.hint("set drive.kind = \"prescribed\""));
    }
    let periods_key = periods;
    let [transient_periods, periods] = [transient_periods, periods].map(|key| r.count(key));
    let limit = DEFAULT_LIMIT_FACTOR * (transient_periods + periods);
    let speed = r.or(&STEADY.speed, top);
    // Steps of runs at constant speed are equal: those on a local defect are the shortest.
    let step = || {
        let highest = speed.max(top_speed(model));
        let on_defects = default_defect_step_us(model, highest).unwrap_or(f64::INFINITY);
        default_step_us(model, &[], highest).min(on_defects) / 1e6
    };
    let settings = SteadyRunSettings {
        speed,
        integrator: integrator(r, run_up.map_or_else(|| default_integrator(model), |s| s.integrator), model),
        step: r.or(&STEADY.step, run_up.map_or_else(step, |s| s.step.min(s.defect_step))),
        cutoff: r.or(&STEADY.cutoff, run_up.map_or(f64::INFINITY, |s| s.cutoff)),
        trigger: section_trigger(r, model),
        phase: r.value(&STEADY.phase),
        transient_periods,
        periods,
        transient_limit: r.count_or(&STEADY.transient_limit, limit),
    };
    work_limits::check_steady(r, [&STEADY.step, periods_key], &settings);
    settings
}

fn section_trigger(r: &Reader, model: &Model) -> SectionTrigger {
    let clock = r.word(&STEADY.section);
    let balls = |site: &crate::BearingSite| site.bearing.ball().map(|ball| ball.geometry.balls);
    let with_balls = || model.bearings.iter().enumerate().filter_map(|(k, s)| balls(s).map(|z| (k, s, z)));
    let wanted = r.text(&STEADY.bearing);
    if let Some(name) = wanted
        && with_balls().all(|(_, site, _)| site.name != name)
    {
        let problem = Problem::new(
            Kind::UnknownName,
            &r.span_of(&STEADY.bearing),
            format!("there is no ball bearing `{name}`"),
        );
        r.log.error(problem.suggest(r.log, name, with_balls().map(|(_, site, _)| site.name.as_str())));
        return SectionTrigger::Shaft;
    }
    if clock == Clock::Shaft {
        return SectionTrigger::Shaft;
    }
    match with_balls().find(|(_, site, _)| wanted.is_none_or(|name| site.name == name)) {
        Some((bearing, ..)) if clock == Clock::Cage => SectionTrigger::Cage { bearing },
        Some((bearing, _, balls)) => SectionTrigger::BallPass { bearing, balls },
        None => {
            let message = format!("{} needs a ball bearing", r.name(&STEADY.section));
            r.error(Kind::UnknownName, &STEADY.section, message);
            SectionTrigger::Shaft
        }
    }
}

/// Planes as pairs of probes, "disc_x, disc_y"; a single probe gives its phase plane (value and rate).
fn planes(r: &Reader, model: &Model) -> Vec<Plane> {
    let named = |name: &str| model.probes.iter().find(|p| p.name == name);
    if !r.has(&PLANE.planes) {
        let planes = default_planes(model);
        if planes.is_empty() && r.has_no_errors() {
            let message = format!("{} has no probe", r.path);
            let problem = Problem::new(Kind::MissingKey, &r.span, message);
            r.log.error(problem.hint("add [probe.NAME] with at and direction"));
        }
        return planes;
    }
    let mut planes = Vec::new();
    for (text, span) in r.texts(&PLANE.planes).unwrap_or_default() {
        let names: Vec<&str> = text.split(',').map(str::trim).collect();
        if let Some(unknown) = names.iter().find(|name| named(name).is_none()) {
            let problem = Problem::new(Kind::UnknownName, &span, format!("unknown probe `{unknown}`"));
            r.log.error(problem.suggest(r.log, unknown, model.probes.iter().map(|p| p.name.as_str())));
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
        MotionQuantity::Displacement => MotionQuantity::Velocity,
        MotionQuantity::Velocity => MotionQuantity::Acceleration,
        MotionQuantity::Acceleration => return None,
    };
    let y = Probe { name: format!("rate of {}", x.name), quantity, ..x.clone() };
    Some(Plane { name: format!("{}_rate", x.name), x: x.clone(), y })
}

fn bifurcation(r: &Reader, model: &Model, run_up: Option<&RunUpStudy>) -> BifurcationStudy {
    let parameter = parameter(r);
    let speed = r.name(&STEADY.speed);
    let varied = parameter.paths.contains(&speed);
    let lengths = [&BIFURCATION_PERIODS.transient_periods, &BIFURCATION_PERIODS.periods];
    let steady = steady(r, model, run_up, lengths, varied);
    let names = channels(r, &BIFURCATION.channels, model);
    let chosen = |p: &&Probe| match names.is_empty() {
        true => p.quantity == MotionQuantity::Displacement,
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
    let keys = &BIFURCATION;
    let count = parameter.values.len().max(1);
    let continuation = match r.word(&keys.start) {
        true => Continuation::PreviousState {
            chunks: r.count_or(&keys.chunks, (count / 8).clamp(1, 16)),
            overlap: r.count(&keys.overlap),
        },
        false => {
            let foreign: [&dyn Declared; 3] = [&keys.chunks, &keys.overlap, &keys.sweep];
            for key in foreign.into_iter().filter(|key| r.has(*key)) {
                let message = format!("{} belongs to start = \"continuation\"", r.name(key));
                r.error(Kind::Conflict, key, message);
            }
            Continuation::Equilibrium
        }
    };
    let lyapunov = r.flag(&keys.lyapunov);
    let perturbation = r.value(&PERTURBATION.perturbation);
    BifurcationStudy {
        steady,
        parameter,
        channels: shown,
        tolerance: r.value(&CLASS.tolerance),
        longest_period: r.count(&CLASS.longest_period),
        sweep: r.word(&keys.sweep),
        continuation,
        perturbation: lyapunov.then_some(perturbation),
    }
}

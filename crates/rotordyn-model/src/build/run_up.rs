//! `[study.run_up]`.

use super::loading;
use super::rounding::rounded_up;
use super::run_keys::{
    IntegratorKeys, RUN_STEP, StepKeys, default_defect_step_us, default_integrator, integrator, top_speed,
};
use crate::file::diagnostic::{Kind, Problem};
use crate::file::key::{
    Count, Flag, Group, Quantity, Table, count, flag, keys, not_negative, positive, quantity,
};
use crate::file::quantities::declared_default;
use crate::file::reader::Reader;
use crate::study::{MotionSettings, RunUpStudy};
use crate::{Drive, Model};
use rotordyn_units::{FREQUENCY, TIME};

pub(super) static RUN_UP_TABLE: Table = Table {
    meaning: "Nonlinear transient run through the profile of [speed].",
    groups: &[
        Group::always(StepKeys::LIST),
        Group::always(RunUpKeys::LIST),
        Group::always(IntegratorKeys::LIST),
    ],
};

keys! {
    /// `[study.run_up]`.
    pub(super) static RUN_UP: RunUpKeys {
        defect_step: Quantity = quantity(positive(TIME),
            "Greatest time step while a ball is on a local defect, and until the vibration after it has decayed; not with free balls.")
            .computed("a 40th of the shortest passage over a defect at the highest speed, in two digits").example("\"10 us\"");
        sample_rate: Quantity = quantity(positive(FREQUENCY), "Sampling rate; above 0.39 of it probes are filtered. By default more than 2 kHz if max_order of study.orders needs it.").default("2 kHz");
        cutoff: Quantity = quantity(positive(FREQUENCY), "Modes below it are kept, with static correction modes.")
            .computed("all modes").example("\"2 kHz\"");
        from_equilibrium: Flag = flag("Start at static equilibrium, otherwise at rest without loads.")
            .default("true");
        cage_phases: Count = count([0, 360], "Runs with this many cage phases, for the range of the order cuts.")
            .default("0").example("8");
        motion_rate: Quantity = quantity(positive(FREQUENCY),
            "Frames per second of the run of the motion of all parts, for animations.")
            .computed("not recorded; with motion_from or motion_to that of the samples").example("\"2 kHz\"");
        motion_from: Quantity = quantity(not_negative(TIME), "Time of the first frame.").computed("the start of the run")
            .example("\"0.1 s\"");
        motion_to: Quantity = quantity(positive(TIME), "Time of the last frame.").computed("the end of the run")
            .example("\"0.2 s\"");
    }
}

/// The study without its default step, which depends on the order cuts; `has_cuts`: whether the file has `[study.orders]`;
/// `least_rate`: sampling rate that its orders need \[Hz\].
pub(super) fn read(top: &Reader, r: &Reader, model: &Model, has_cuts: bool, least_rate: f64) -> RunUpStudy {
    let sample_rate = sample_rate(r, least_rate);
    if !top.has(&loading::TOP.speed) {
        let problem = Problem::new(Kind::MissingKey, &r.span, "study.run_up needs a speed profile");
        r.log.error(problem.hint("add [speed] with profile = \"ramp\", to = \"1200 rpm\", ramp = \"10 s\""));
    }
    if !r.has(&RUN_UP.cutoff) {
        r.taken_by_default(&RUN_UP.cutoff, "all modes");
    }
    RunUpStudy {
        integrator: integrator(r, default_integrator(model), model),
        step: r.get(&RUN_STEP.step).unwrap_or(f64::INFINITY),
        defect_step: defect_step(r, model),
        sample_rate,
        cutoff: r.or(&RUN_UP.cutoff, f64::INFINITY),
        from_equilibrium: r.flag(&RUN_UP.from_equilibrium),
        cage_phases: cage_phases(r, model, has_cuts),
        motion: motion(r, sample_rate),
    }
}

/// The sampling rate \[Hz\]; by default enough for the orders, in two digits.
fn sample_rate(r: &Reader, least: f64) -> f64 {
    let key = &RUN_UP.sample_rate;
    if r.has(key) || least <= declared_default(key) {
        return r.value(key);
    }
    let rate = rounded_up(least);
    r.taken_by_default(key, format!("\"{rate} Hz\""));
    rate
}

/// Step on local defects \[s\]; infinite without.
fn defect_step(r: &Reader, model: &Model) -> f64 {
    let by_default = default_defect_step_us(model, top_speed(model));
    if let Some(step) = by_default.filter(|_| !r.has(&RUN_UP.defect_step)) {
        r.taken_by_default(&RUN_UP.defect_step, format!("\"{step} us\""));
    }
    r.or(&RUN_UP.defect_step, by_default.map_or(f64::INFINITY, |step| step / 1e6))
}

/// Frames of the recorded motion: not faster than the samples, within a time that has some.
fn motion(r: &Reader, sample_rate: f64) -> Option<MotionSettings> {
    let [rate, from, to] = [&RUN_UP.motion_rate, &RUN_UP.motion_from, &RUN_UP.motion_to];
    if ![rate, from, to].into_iter().any(|key| r.has(key)) {
        return None;
    }
    let settings =
        MotionSettings { rate: r.or(rate, sample_rate), from: r.or(from, 0.0), to: r.or(to, f64::INFINITY) };
    if settings.rate > sample_rate {
        let message = format!("{} is above the sampling rate", r.name(rate));
        let problem = Problem::new(Kind::OutOfRange, &r.span_of(rate), message);
        r.log.error(problem.hint("raise study.run_up.sample_rate"));
    }
    if settings.to < settings.from {
        r.error(Kind::OutOfRange, to, format!("{} is before {}", r.name(to), r.name(from)));
    }
    Some(settings)
}

/// Number of cage phases: of a machine with a ball bearing and a prescribed speed, whose order cuts are requested.
fn cage_phases(r: &Reader, model: &Model, has_cuts: bool) -> usize {
    let count = r.count(&RUN_UP.cage_phases);
    if count == 0 || !r.has_no_errors() {
        return count;
    }
    let conflict = if count == 1 {
        Some(("is 1: one phase has no range", "give 2 phases or more, such as 8"))
    } else if model.bearings.iter().all(|site| site.bearing.ball().is_none()) {
        Some(("needs a bearing with balls", "remove it, or use model = \"ball\" in a bearing"))
    } else if matches!(model.drive, Drive::Torque { .. }) {
        Some((
            "needs a prescribed speed, so that all runs have the same speeds",
            "set drive.kind = \"prescribed\"",
        ))
    } else if !has_cuts {
        Some((
            "gives a range of order cuts, but the file has no [study.orders]",
            "add [study.orders] with cuts = [1, \"BPFO\"]",
        ))
    } else {
        None
    };
    if let Some((problem, hint)) = conflict {
        let message = format!("{} {problem}", r.name(&RUN_UP.cage_phases));
        r.log.error(Problem::new(Kind::Conflict, &r.span_of(&RUN_UP.cage_phases), message).hint(hint));
    }
    count
}

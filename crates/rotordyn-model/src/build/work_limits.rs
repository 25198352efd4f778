//! Limits of the steps and samples that a study may request: beyond them a value cannot be meant.

use std::f64::consts::TAU;

use crate::file::diagnostic::{Kind, Problem};
use crate::file::key::Declared;
use crate::file::reader::Reader;
use crate::study::{RunUpStudy, SteadyRunSettings};

/// Largest number of steps of a run: weeks at a microsecond a step.
const MAX_STEPS: f64 = 1e12;
/// Largest number of samples of a channel: 80 GB.
const MAX_SAMPLES: f64 = 1e10;

/// Errors at the keys of step, step on defects and sampling rate of a run-up of this duration \[s\].
pub(super) fn check_run_up(
    r: &Reader,
    [step, defect_step, sample_rate]: [&dyn Declared; 3],
    study: &RunUpStudy,
    duration: f64,
) {
    let samples = duration * study.sample_rate;
    if samples > MAX_SAMPLES {
        report(
            r,
            sample_rate,
            &format!("gives {samples:.1e} samples in {duration} s"),
            "lower sample_rate",
            MAX_SAMPLES,
        );
        return;
    }
    check_step(r, step, study.step, duration);
    if study.defect_step < study.step {
        check_step(r, defect_step, study.defect_step, duration);
    }
}

/// Errors at the keys of step and number of periods of a run at constant speed.
pub(super) fn check_steady(r: &Reader, [step, periods]: [&dyn Declared; 2], steady: &SteadyRunSettings) {
    if steady.speed <= 0.0 {
        return;
    }
    // At least a ball passage a tenth of a revolution.
    let shortest = 0.1 * TAU / steady.speed;
    check_step(r, step, steady.step, shortest * (steady.transient_periods + steady.periods) as f64);
    let samples = shortest / steady.step * steady.periods as f64;
    if samples > MAX_SAMPLES && r.has_no_errors() {
        report(
            r,
            periods,
            &format!("gives more than {samples:.1e} samples"),
            "lower periods or raise step",
            MAX_SAMPLES,
        );
    }
}

fn check_step(r: &Reader, key: &dyn Declared, step: f64, duration: f64) {
    let steps = duration / step;
    if duration + step == duration {
        let what = format!("is below the round-off of the time: {duration} s + {step:e} s = {duration} s");
        report(r, key, &what, "raise step", MAX_STEPS);
    } else if steps > MAX_STEPS {
        report(r, key, &format!("gives {steps:.1e} steps in {duration:.4} s"), "raise step", MAX_STEPS);
    }
}

fn report(r: &Reader, key: &dyn Declared, what: &str, advice: &str, limit: f64) {
    let message = format!("{} {what}", r.name(key));
    let problem = Problem::new(Kind::OutOfRange, &r.span_of(key), message);
    r.log.error(problem.hint(format!("{advice}, or shorten the run: {limit:.0e} at most")));
}

//! Runs stopped at random samples and resumed from bytes in a fresh system end in the bits of a run never stopped.

use crate::rig::variant;
use rotordyn::io::saved_results;
use rotordyn::model::study::{Integrator, MotionSettings, RunUpStudy};
use rotordyn::model::{Model, Options, load};
use rotordyn::results::{History, Motion, StepError};
use rotordyn::study::{Checkpoints, Machine, MotionRecorder, MotionSnapshot, Recorder, RecorderSnapshot};
use rotordyn::transient::run::{End, Report, RunSnapshot};
use serde::{Deserialize, Serialize, de::DeserializeOwned};
use std::ops::ControlFlow;

const GENERALISED_ALPHA: Integrator = Integrator::GeneralisedAlpha { rho_infinity: 0.8 };
const DORMAND_PRINCE: Integrator =
    Integrator::DormandPrince { relative_tolerance: 1e-6, absolute_tolerance: 1e-10 };
const STOPS: usize = 20;

/// Numbers that are the same in every run of the test (splitmix64).
pub struct Random(pub u64);

impl Random {
    pub fn below(&mut self, limit: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % limit as u64) as usize
    }

    /// Different numbers from `from` to `below`, in order.
    pub fn distinct(&mut self, count: usize, from: usize, below: usize) -> Vec<usize> {
        assert!(below - from >= count);
        let mut found = std::collections::BTreeSet::new();
        while found.len() < count {
            found.insert(from + self.below(below - from));
        }
        found.into_iter().collect()
    }
}

/// Bytes of a value as written to a file: equal if and only if every bit is.
pub fn bytes<T: Serialize>(value: &T) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("value");
    saved_results::save(&path, value).unwrap();
    std::fs::read(path).unwrap()
}

/// A value after being written and read.
pub fn through_file<T: Serialize + DeserializeOwned>(value: &T) -> T {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("value");
    saved_results::save(&path, value).unwrap();
    saved_results::load(path).unwrap()
}

#[derive(Serialize, Deserialize)]
struct Stopped {
    run: RunSnapshot,
    states: Checkpoints,
    motion: Option<MotionSnapshot>,
    recorder: RecorderSnapshot,
    history: History,
}

/// All that a run-up gives.
#[derive(Serialize)]
struct Whole {
    history: History,
    report: Report,
    motion: Option<Motion>,
    step_error: Option<StepError>,
}

/// Runs a machine from the start or a snapshot to the end (`Ok`) or to a sample.
fn run_to(
    model: &Model,
    study: &RunUpStudy,
    from: Option<Box<Stopped>>,
    stop: Option<usize>,
) -> Result<Whole, Box<Stopped>> {
    let machine = Machine::new(model.clone()).unwrap();
    let reduction = machine.reduce(study).unwrap();
    let mut recorder = Recorder::new(&machine.model, &reduction.system, study.sample_rate);
    let mut motion =
        study.motion.map(|settings| MotionRecorder::new(&machine, &reduction, settings, study.sample_rate));
    let mut states = Checkpoints::new(study, machine.model.profile.duration());
    let mut snapshot = None;
    if let Some(stopped) = from {
        let stopped = *stopped;
        (snapshot, states) = (Some(stopped.run), stopped.states);
        recorder.history = stopped.history;
        recorder.resume(stopped.recorder);
        motion.iter_mut().zip(stopped.motion).for_each(|(own, stored)| own.resume(stored).unwrap());
    }
    let mut taken = None;
    let observe = |sample: &rotordyn::transient::run::Sample| {
        states.observe(sample);
        motion.iter_mut().for_each(|motion| motion.observe(sample));
        recorder.record(sample);
        if stop == Some(sample.index) {
            taken = Some((sample.snapshot(), recorder.snapshot()));
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    };
    let report = match snapshot {
        None => machine.run_up(study, &reduction, observe),
        Some(snapshot) => machine.resume_run_up(study, &reduction, snapshot, observe),
    };
    if let Some((run, snapshot)) = taken {
        assert_eq!(report.end, End::Stopped);
        let motion = motion.map(|motion| motion.snapshot());
        return Err(Box::new(Stopped { run, states, motion, recorder: snapshot, history: recorder.history }));
    }
    let history = recorder.into_history();
    assert_ne!(report.end, End::Stopped);
    let step_error = machine.step_error(study, &reduction, &[1.0], (&states, &history, &report)).unwrap();
    Ok(Whole { history, report, motion: motion.map(|motion| motion.motion), step_error })
}

/// Compares a run stopped at random samples with one that was not.
fn stopped_run_equals_whole_run(name: &str, model: &Model, study: &RunUpStudy) -> Report {
    let Ok(whole) = run_to(model, study, None, None) else { panic!("{name}: not stopped") };
    let samples = whole.history.time.len();
    let stops = Random(samples as u64).distinct(STOPS, 0, samples);
    let mut from = None;
    for stop in &stops {
        let Err(stopped) = run_to(model, study, from, Some(*stop)) else { panic!("{name}: not stopped") };
        from = Some(through_file(&stopped));
    }
    let Ok(resumed) = run_to(model, study, from, None) else { panic!("{name}: stopped") };
    println!(
        "{name}: {samples} samples, {} steps, {} halvings, {} inversions, stopped at {stops:?}",
        whole.report.steps, whole.report.halvings, whole.report.refactored
    );
    for (a, b) in whole.history.channels.iter().zip(&resumed.history.channels) {
        assert_eq!(bytes(a), bytes(b), "{name}: channel {}", a.name);
    }
    assert_eq!(
        bytes(&whole.report),
        bytes(&resumed.report),
        "{name}: {:?} {:?}",
        whole.report,
        resumed.report
    );
    assert_eq!(bytes(&whole), bytes(&resumed), "{name}: motion or step error");
    whole.report
}

/// The rig, run up quickly.
fn rig(name: Option<&str>, set: &[(&str, &str)]) -> Model {
    let quick = [
        ("speed.settle", "0.01 s"),
        ("speed.ramp", "0.1 s"),
        ("speed.hold", "0.02 s"),
        ("study.run_up.cutoff", "800 Hz"),
    ];
    variant(name, &[&quick[..], set].concat())
}

fn study(model: &Model, integrator: Integrator, step: f64) -> RunUpStudy {
    RunUpStudy { integrator, step, ..model.studies.run_up.clone().unwrap() }
}

#[test]
fn kinematic_cages_with_every_integrator_and_motion() {
    let model = rig(None, &[]);
    for (integrator, step) in [
        (GENERALISED_ALPHA, 1e-4),
        (Integrator::Newmark, 5e-5),
        (Integrator::FittedNewmark, 5e-5),
        (Integrator::RungeKutta4, 1e-5),
        (DORMAND_PRINCE, 1e-5),
    ] {
        let mut study = study(&model, integrator, step);
        study.motion = Some(MotionSettings { rate: 400.0, from: 0.02, to: 0.11 });
        let report = stopped_run_equals_whole_run(&format!("rig, {integrator:?}"), &model, &study);
        assert_eq!(report.end, End::Complete);
    }
}

/// Steps are divided on the dent and until the vibration has decayed, with inertias fitted to their length.
#[test]
fn divided_steps_on_a_defect() {
    let model = rig(Some("dented"), &[("study.run_up.defect_step", "10 us")]);
    for integrator in [Integrator::FittedNewmark, GENERALISED_ALPHA] {
        let study = study(&model, integrator, 5e-5);
        let report = stopped_run_equals_whole_run(&format!("dented, {integrator:?}"), &model, &study);
        assert_eq!(report.end, End::Complete);
        // Two whole steps to a sample, or ten parts.
        assert!(report.steps > 2 * report.samples as u64 + 500, "{report:?}");
    }
}

/// Halved steps have inverses of their own and other guesses of the force; here until a step fails, as it does in the
/// resumed run.
#[test]
fn halved_steps() {
    let model = rig(None, &[("bearing.B.radial_clearance", "300 um"), ("speed.to", "6000 rpm")]);
    let study = RunUpStudy { sample_rate: 1000.0, ..study(&model, GENERALISED_ALPHA, 1e-3) };
    let report = stopped_run_equals_whole_run("halved steps", &model, &study);
    // The run is chaotic: the number depends on rounding, from 14 to over 20 in two forms of the step.
    assert!(report.halvings > 10 && report.steps > report.samples as u64, "{report:?}");
    assert!(matches!(report.end, End::Failed(_)));
}

#[test]
fn internal_coordinates_with_every_integrator() {
    let model = rig(Some("radial_balls"), &[("speed.ramp", "0.03 s")]);
    for (integrator, step) in [
        (GENERALISED_ALPHA, 1e-5),
        (Integrator::Newmark, 1e-5),
        (Integrator::FittedNewmark, 1e-5),
        (Integrator::RungeKutta4, 2e-6),
        (DORMAND_PRINCE, 2e-6),
    ] {
        let study = study(&model, integrator, step);
        let name = format!("radial balls, {integrator:?}");
        assert_eq!(stopped_run_equals_whole_run(&name, &model, &study).end, End::Complete);
    }
}

/// Free balls with the mean values of the sampling intervals, and their motion.
#[test]
fn free_balls() {
    let model = rig(Some("free_balls"), &[("speed.ramp", "0.02 s"), ("speed.hold", "0.005 s")]);
    let mut study = study(&model, Integrator::RungeKutta4, 1e-5);
    study.motion = Some(MotionSettings { rate: 1000.0, from: 0.01, to: 0.03 });
    assert_eq!(stopped_run_equals_whole_run("free balls", &model, &study).end, End::Complete);
}

/// A torque drive with unbalance and internal damping: the rotation is an unknown, recentred at every step.
#[test]
fn torque_drive_with_every_integrator() {
    let text = include_str!("../../models/sommerfeld.toml");
    let set = [("speed.duration", "0.5 s")].map(|(path, value)| (path.to_string(), value.to_string()));
    let options = Options { set: set.into(), ..Options::default() };
    let model = load("sommerfeld.toml", text, &options).unwrap().model;
    for (integrator, step) in [
        (GENERALISED_ALPHA, 2e-4),
        (Integrator::Newmark, 2e-4),
        (Integrator::FittedNewmark, 2e-4),
        (Integrator::RungeKutta4, 2e-5),
        (DORMAND_PRINCE, 2e-5),
    ] {
        let study = study(&model, integrator, step);
        let name = format!("torque drive, {integrator:?}");
        assert_eq!(stopped_run_equals_whole_run(&name, &model, &study).end, End::Complete);
    }
}

/// A snapshot of another machine, or of another integrator, is refused, not read beyond its end.
#[test]
fn a_snapshot_of_another_machine_is_refused() {
    let model = rig(None, &[]);
    let own = study(&model, GENERALISED_ALPHA, 1e-4);
    let Err(stopped) = run_to(&model, &own, None, Some(40)) else { panic!("not stopped") };
    let other = rig(Some("radial_balls"), &[]);
    for (model, study) in [
        (&other, study(&other, GENERALISED_ALPHA, 1e-5)),
        (&model, study(&model, Integrator::RungeKutta4, 1e-5)),
    ] {
        let machine = Machine::new(model.clone()).unwrap();
        let reduction = machine.reduce(&study).unwrap();
        let observe = |_: &rotordyn::transient::run::Sample| panic!("no sample");
        let report = machine.resume_run_up(&study, &reduction, stopped.run.clone(), observe);
        let End::Failed(error) = report.end else { panic!("{:?}", report.end) };
        assert!(error.to_string().contains("another machine or integrator"), "{error}");
    }
}

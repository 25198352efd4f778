//! Steady motions stopped at random periods and resumed end in the bits of a run never stopped; what is recorded when
//! stopped is the result of a run of that many periods.

use crate::resume::{Random, bytes, through_file};
use crate::rig::variant;
use rotordyn::model::study::{Integrator, LyapunovStudy, Plane, PoincareStudy, SectionTrigger};
use rotordyn::model::{Model, Options, load};
use rotordyn::results::{BifurcationResult, LyapunovResult, PoincareResult, RecordedPeriods};
use rotordyn::study::{FinishedValues, Machine, bifurcation, bifurcation_from};
use serde::{Serialize, de::DeserializeOwned};
use std::ops::ControlFlow;
use std::sync::Mutex;

const STOPS: usize = 20;

fn varying_compliance(set: &[(&str, &str)]) -> Model {
    let set = set.iter().map(|(path, value)| ((*path).into(), (*value).into())).collect();
    let options = Options { set, ..Options::default() };
    let text = include_str!("../../models/varying_compliance.toml");
    load("varying_compliance.toml", text, &options).unwrap().model
}

/// Runs a study to its end, stopped `STOPS` times after a few calls and resumed from bytes each time.
///
/// `run` takes a snapshot and a function called every period that says whether to stop, and gives the result with the
/// snapshot of the stop.
fn stopped_at_random<R: Serialize, S: Serialize + DeserializeOwned>(
    name: &str,
    run: impl Fn(Option<S>, &mut dyn FnMut() -> bool) -> (Option<R>, Option<S>),
) {
    let mut calls = 0;
    let (whole, _) = run(None, &mut || {
        calls += 1;
        false
    });
    let stops = Random(calls as u64).distinct(STOPS, 1, calls);
    let (mut before, mut snapshot) = (0, None);
    for stop in &stops {
        let mut left = stop - before;
        let (_, taken) = run(snapshot, &mut || {
            left -= 1;
            left == 0
        });
        snapshot = Some(through_file(&taken.expect("stopped")));
        before = *stop;
    }
    let (resumed, none) = run(snapshot, &mut || false);
    assert!(none.is_none());
    println!("{name}: {calls} periods, stopped after {stops:?}");
    assert_eq!(bytes(&whole), bytes(&resumed), "{name}");
}

fn flow(stop: bool) -> ControlFlow<()> {
    if stop { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
}

fn poincare(model: &Model, study: &PoincareStudy, name: &str) {
    stopped_at_random(name, |snapshot, stop: &mut dyn FnMut() -> bool| {
        let machine = Machine::new(model.clone()).unwrap();
        let mut taken = None;
        let found = machine.poincare_from(study, snapshot, &mut |now| {
            let stop = stop();
            if stop {
                taken = Some(now.snapshot());
            }
            flow(stop)
        });
        (found.unwrap(), taken)
    });
}

/// With a first record that has not settled, so that the run goes on in a second one.
#[test]
fn poincare_sections() {
    let model = varying_compliance(&[]);
    let mut study = model.studies.poincare.clone().unwrap();
    study.steady.speed = 1600.0 * std::f64::consts::PI / 30.0;
    (study.steady.transient_periods, study.steady.periods) = (20, 40);
    study.steady.transient_limit = 600;
    let machine = Machine::new(model.clone()).unwrap();
    let found = machine.poincare(&study, &mut |_| ControlFlow::Continue(())).unwrap().unwrap();
    assert!(found.transient_periods > 20, "the first record should not have settled");
    poincare(&model, &study, "varying compliance");
    let rk4 = PoincareStudy { steady: study.steady.clone(), ..study.clone() };
    let mut rk4 = rk4;
    rk4.steady.integrator = Integrator::RungeKutta4;
    poincare(&model, &rk4, "varying compliance, RK4");
}

#[test]
fn poincare_sections_with_free_balls() {
    let model = variant(Some("free_balls"), &[("bearing.B.slip", "\"centre\"")]);
    let probe = |name: &str| model.probes.iter().find(|p| p.name == name).expect("a probe").clone();
    let plane = Plane { name: "disc".into(), x: probe("disc_x"), y: probe("disc_y") };
    let clock = SectionTrigger::Cage { bearing: 0 };
    let mut steady = crate::steady_motion::steady(125.7, clock, 1e-5, [4, 21]);
    steady.trigger = SectionTrigger::BallPass { bearing: 0, balls: 8 };
    steady.integrator = Integrator::RungeKutta4;
    let study = PoincareStudy { steady, planes: vec![plane], tolerance: 1e-3, longest_period: 8 };
    poincare(&model, &study, "free balls");
}

#[test]
fn lyapunov_exponents_with_every_integrator() {
    let model = varying_compliance(&[]);
    let own = model.studies.lyapunov.clone().unwrap();
    for integrator in crate::steady_motion::EVERY_INTEGRATOR {
        let mut study = LyapunovStudy { steady: own.steady.clone(), ..own };
        study.steady.integrator = integrator;
        (study.steady.transient_periods, study.steady.periods) = (20, 40);
        stopped_at_random(&format!("{integrator:?}"), |snapshot, stop: &mut dyn FnMut() -> bool| {
            let machine = Machine::new(model.clone()).unwrap();
            let mut taken = None;
            let found = machine.lyapunov_from(&study, snapshot, &mut |now| {
                let stop = stop();
                if stop {
                    taken = Some(now.snapshot());
                }
                flow(stop)
            });
            (found.unwrap(), taken)
        });
    }
}

/// What is kept of a stopped run is the result of a run of that many periods, and says how many.
#[test]
fn partial_results_are_those_of_shorter_runs() {
    let model = varying_compliance(&[]);
    let machine = Machine::new(model.clone()).unwrap();
    let mut study = model.studies.poincare.clone().unwrap();
    (study.steady.transient_periods, study.steady.periods, study.steady.transient_limit) = (30, 40, 0);
    let stop_after = |study: &PoincareStudy, periods: usize| -> Option<PoincareResult> {
        let mut calls = 0;
        let found = machine.poincare_from(study, None, &mut |_| {
            calls += 1;
            flow(calls >= periods)
        });
        found.unwrap()
    };
    // Seven points cannot be classified.
    assert!(stop_after(&study, 37).is_none());
    let stopped = stop_after(&study, 55).expect("a partial result");
    assert_eq!(stopped.partial, Some(RecordedPeriods { recorded: 25, requested: 40 }));
    study.steady.periods = 25;
    let short = machine.poincare(&study, &mut |_| ControlFlow::Continue(())).unwrap().unwrap();
    assert_eq!(short.planes[0].section[0].len(), 25);
    assert_eq!(bytes(&PoincareResult { partial: None, ..stopped }), bytes(&short));

    let mut study = model.studies.lyapunov.clone().unwrap();
    (study.steady.transient_periods, study.steady.periods) = (30, 40);
    let stop_after = |study: &LyapunovStudy, periods: usize| -> Option<LyapunovResult> {
        let mut calls = 0;
        let found = machine.lyapunov_from(study, None, &mut |_| {
            calls += 1;
            flow(calls >= periods)
        });
        found.unwrap()
    };
    assert!(stop_after(&study, 30).is_none());
    let stopped = stop_after(&study, 55).expect("a partial result");
    assert_eq!(stopped.partial, Some(RecordedPeriods { recorded: 25, requested: 40 }));
    study.steady.periods = 25;
    let short = machine.lyapunov(&study, &mut |_| ControlFlow::Continue(())).unwrap().unwrap();
    assert_eq!(bytes(&LyapunovResult { partial: None, ..stopped }), bytes(&short));
}

/// Both sweeps in chunks, of which some are rerun, on one thread and on two.
#[test]
fn bifurcation_diagrams() {
    let range = ("study.bifurcation.values", "{ from = \"1000 rpm\", to = \"2300 rpm\", count = 12 }");
    let chunks = ("study.bifurcation.chunks", "3");
    let models: Vec<Model> = (0..12)
        .map(|k| {
            let set = [range, chunks, ("study.bifurcation.lyapunov", "true")];
            let first = varying_compliance(&set);
            let study = first.studies.bifurcation.as_ref().unwrap();
            let own = study.parameter.settings(k);
            let own = own.iter().map(|(path, value)| (path.as_str(), value.as_str()));
            let mut model = varying_compliance(&set.into_iter().chain(own).collect::<Vec<_>>());
            let steady = &mut model.studies.bifurcation.as_mut().unwrap().steady;
            (steady.transient_periods, steady.periods, steady.transient_limit) = (20, 16, 60);
            model
        })
        .collect();
    let whole: BifurcationResult = bifurcation(&models, &|_, _| ControlFlow::Continue(())).unwrap();
    assert!(whole.complete && whole.seams == 4);
    for threads in [1, 2] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let mut random = Random(threads as u64);
        let mut finished = FinishedValues::default();
        let (mut stops, mut runs) = (0, Vec::new());
        let resumed = loop {
            let left = Mutex::new(20 + random.below(400));
            let taken = Mutex::new(None);
            let found = pool.install(|| {
                bifurcation_from(&models, through_file(&finished), &|now| {
                    let mut left = left.lock().unwrap();
                    *left = left.saturating_sub(1);
                    if *left == 0 && stops < STOPS {
                        *taken.lock().unwrap() = Some(now.snapshot());
                    }
                    flow(*left == 0 && stops < STOPS)
                })
            });
            match taken.into_inner().unwrap() {
                // The last snapshot, of the thread that stopped last.
                Some(snapshot) => finished = snapshot,
                None => break found.unwrap(),
            }
            stops += 1;
            runs.push(finished.len());
        };
        println!("{threads} threads: {} reruns, runs finished at the stops {runs:?}", whole.rerun_chunks);
        assert!(stops > 5 && runs.is_sorted(), "{runs:?}");
        assert_eq!(bytes(&whole), bytes(&resumed), "{threads} threads");
    }
}

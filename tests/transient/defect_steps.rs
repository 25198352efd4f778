//! Steps that are short on a local defect only, against short steps all the time.

use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;

use crate::rig::variant;
use rotordyn::model::study::{Integrator, RunUpStudy};
use rotordyn::results::History;
use rotordyn::study::{Machine, Recorder};
use rotordyn::transient::run::{End, Report};

/// The dented rig at 1200 rpm for half a second after a quick run-up.
fn machine() -> Machine {
    let quick = [("speed.settle", "0.01 s"), ("speed.ramp", "0.1 s"), ("speed.hold", "0.6 s")];
    Machine::new(variant(Some("dented"), &quick)).unwrap()
}

fn run(machine: &Machine, study: &RunUpStudy) -> (History, Report) {
    let reduction = machine.reduce(study).unwrap();
    let mut recorder = Recorder::new(&machine.model, &reduction.system, study.sample_rate);
    let report = machine.run_up(study, &reduction, |sample| {
        recorder.record(sample);
        ControlFlow::Continue(())
    });
    assert_eq!(report.end, End::Complete);
    (recorder.into_history(), report)
}

/// Complex amplitude of the harmonics of a line in the last half second, with a Hann window.
fn lines(history: &History, channel: &str, frequency: f64) -> Vec<[f64; 2]> {
    let values = &history.channels.iter().find(|c| c.name == channel).unwrap().values;
    let values = values.read(0..values.len()).unwrap();
    let record = &values[values.len() - 5000..];
    let mean = record.iter().sum::<f64>() / 5000.0;
    (1..=12)
        .map(|n| {
            let mut sum = [0.0; 2];
            for (k, y) in record.iter().enumerate() {
                let window = (PI * k as f64 / 5000.0).sin().powi(2);
                let (sin, cos) = (TAU * f64::from(n) * frequency * k as f64 * 1e-4).sin_cos();
                sum[0] += window * (y - mean) * cos;
                sum[1] -= window * (y - mean) * sin;
            }
            sum
        })
        .collect()
}

/// Accelerations at the ball pass are a thousandth of those of the vibration after a passage: the record must add up where the
/// length of the steps changes, also with inertias fitted to it.
#[test]
fn lines_are_those_of_short_steps_all_the_time() {
    let machine = machine();
    let study = machine.model.studies.run_up.clone().unwrap();
    assert!(study.defect_step < 0.3 * study.step, "{} {}", study.defect_step, study.step);
    let (exact, _) = run(&machine, &RunUpStudy { integrator: Integrator::Newmark, step: 6.25e-6, ..study });
    let equal = RunUpStudy { step: study.defect_step, ..study };
    let (_, whole) = run(&machine, &equal);
    let bearing = machine.model.bearings[1].bearing.ball().unwrap();
    let pass = 20.0 * bearing.geometry.characteristic_orders(bearing.geometry.contact_angle).bpfo;
    let alpha = Integrator::GeneralisedAlpha { rho_infinity: 0.8 };
    for (integrator, limit) in [(study.integrator, 0.02), (Integrator::Newmark, 0.05), (alpha, 0.05)] {
        let (found, report) = run(&machine, &RunUpStudy { integrator, ..study });
        let share = report.steps as f64 / whole.steps as f64;
        let mut worst = (0.0, String::new());
        for channel in ["A_ax", "A_ay", "B_ax", "B_ay", "disc_x"] {
            let [found, exact] = [&found, &exact].map(|history| lines(history, channel, pass));
            let size = |line: &[f64; 2]| line[0].hypot(line[1]);
            let largest = exact.iter().map(size).fold(0.0, f64::max);
            for (n, (found, exact)) in (1..).zip(found.iter().zip(&exact)) {
                let error = size(&[found[0] - exact[0], found[1] - exact[1]]) / size(exact);
                if size(exact) > 0.02 * largest && error > worst.0 {
                    worst = (error, format!("{n} x ball pass of {channel}"));
                }
            }
        }
        let energy = &report.energy;
        let open = energy.residual() / energy.exchanged();
        println!("{integrator:?}: {:.0} % of the steps, energy {open:.1e}, {worst:?}", 100.0 * share);
        assert!(share < 0.7, "{share}");
        assert!(worst.0 < limit, "{worst:?}");
        assert!(open.abs() < 1e-3, "{open}");
    }
}

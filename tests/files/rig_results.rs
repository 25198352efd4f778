//! Every study of the overhung rig, with a short run-up.

use std::ops::ControlFlow;
use std::sync::LazyLock;

use rotordyn::model::study::BearingStudy;
use rotordyn::results::{Results, RunSummary, RunUpResult};
use rotordyn::study::{Machine, Recorder};
use rotordyn::warning::{Code, Warning};

use crate::rig::variant;

/// The rig and its results: few speeds, 2 s of run-up, spectra of one channel of the seven.
pub static RIG: LazyLock<(Machine, Results)> = LazyLock::new(|| {
    let model = variant(
        None,
        &[
            ("speed.settle", "0.1 s"),
            ("speed.ramp", "0.9 s"),
            ("speed.hold", "1 s"),
            ("study.campbell.speeds", "0, 600, 1200 rpm"),
            ("study.spectrogram.length", "0.25 s"),
            ("study.orders.resolution", "0.2"),
        ],
    );
    let machine = Machine::new(model).unwrap();
    let studies = machine.model.studies.clone();
    let study = studies.run_up.unwrap();
    let reduction = machine.reduce(&study).unwrap();
    let mut recorder = Recorder::new(&machine.model, &reduction.system, study.sample_rate);
    let report = machine.run_up(&study, &reduction, |sample| {
        recorder.record(sample);
        ControlFlow::Continue(())
    });
    let history = recorder.into_history();
    let mut results = Results {
        equilibrium: Some(machine.equilibrium(&studies.equilibrium.unwrap()).unwrap()),
        modal: machine.modal(&studies.modal.unwrap()).unwrap(),
        campbell: Some(machine.campbell(&studies.campbell.unwrap()).unwrap()),
        critical: Some(machine.critical(&studies.critical.unwrap()).unwrap()),
        frf: Some(machine.frf(&studies.frf.unwrap()).unwrap()),
        unbalance: Some(machine.unbalance(&studies.unbalance.unwrap()).unwrap()),
        bearings: machine
            .bearings(&BearingStudy { bearings: vec!["B".into()], ..Default::default() })
            .unwrap(),
        spectrograms: machine.spectrograms(&studies.spectrogram.unwrap(), &history).unwrap(),
        orders: machine.orders(&studies.orders.unwrap(), &history).unwrap(),
        run_up: Some(RunUpResult {
            modes: reduction.modes,
            corrections: reduction.corrections,
            static_error: reduction.static_error,
            frequency_error: 0.0,
            summary: RunSummary::of(&history).unwrap(),
            history,
            report,
            requested_step: 25e-6,
            cage_angles: machine.cage_angles(),
            step_error: None,
            cage_comparison: None,
            peak_loads: Vec::new(),
        }),
        critical_map: None,
        torsional: None,
        cage_phases: None,
        ball_inertia: Vec::new(),
        warnings: vec![Warning::new(Code::Film, "bearing.B", "a warning")],
        poincare: None,
        lyapunov: None,
        bifurcation: None,
    };
    results.spectrograms.retain(|s| s.channel == "B_ax");
    results.orders.retain(|s| s.channel == "B_ax");
    (machine, results)
});

//! Results saved and loaded by a library user, and every result in the documents.

use rotordyn::analysis::Mode;
use rotordyn::io::hdf5::Store;
use rotordyn::io::json::to_json;
use rotordyn::io::results_file::write_study;
use rotordyn::linalg::Complex64;
use rotordyn::model::study::{CriticalMapStudy, Parameter, TorsionalStudy};
use rotordyn::model::{Options, load as load_model};
use rotordyn::results::{
    BearingWithOrders, BifurcationPoint, BifurcationResult, BifurcationSweep, CagePhaseBand,
    CagePhaseChannel, CagePhaseLine, LyapunovResult, OrderLine, PlaneSection, PoincareResult, Results,
    SectionChannel, SectionClock, SignalResult, SteadyMotion, StepError, StepErrorLine, Whirl, load, save,
};
use rotordyn::signal::lyapunov::LyapunovExponent;
use rotordyn::signal::motion_classification::{Classification, Motion};
use rotordyn::signal::orbit::FilteredOrbit;
use rotordyn::study::Machine;
use rotordyn::study::signal::{AnalysisSelection, ShaftMotion, SignalChannel, SignalSettings, analyse};
use std::fmt::Debug;

use crate::rig_results::RIG;

/// Loaded, a result has the same fields (Debug prints every one) and, saved again, the same bytes.
fn assert_round_trip<T: Debug + serde::Serialize + serde::de::DeserializeOwned>(result: &T, what: &str) -> T {
    let folder = tempfile::tempdir().unwrap();
    let [first, second] = ["first", "second"].map(|name| folder.path().join(name));
    save(&first, result).unwrap();
    let loaded: T = load(&first).unwrap();
    save(&second, &loaded).unwrap();
    assert_eq!(std::fs::read(&first).unwrap(), std::fs::read(&second).unwrap(), "{what}");
    assert!(format!("{loaded:?}") == format!("{result:?}"), "{what}");
    loaded
}

fn clock() -> SectionClock {
    SectionClock { name: "cage revolution of B".into(), phase: 0.3, frequency: 7.6 }
}

fn classification(motion: Motion) -> Classification {
    Classification {
        motion,
        recurrence: 1e-9,
        zero_one_k: f64::NAN,
        residual: f64::INFINITY,
        decay_factor: f64::NAN,
        nearest_return: 0,
        mean_square_change: f64::NAN,
        amplitude_trend: -0.0,
    }
}

fn exponent() -> LyapunovExponent {
    LyapunovExponent { value: -3.5, standard_error: 0.1, times: vec![0.1, 0.2], history: vec![-4.0, -3.5] }
}

fn order_line() -> OrderLine {
    OrderLine { label: "BPFO".into(), order: 3.05, bearing: true }
}

/// Every study's result: those of the rig, and made ones of steady motions with NaN, infinite values and a failure.
fn every_result() -> (&'static Machine, Results) {
    let (machine, results) = &*RIG;
    let mut results = results.clone();
    let map =
        CriticalMapStudy { max_speed: 600.0, lowest_stiffness: None, highest_stiffness: None, points: 3 };
    results.critical_map = Some(machine.critical_map(&map).unwrap());
    let torsion =
        TorsionalStudy { max_speed: 200.0, orders: vec![1.0, 2.0], modes: 2, operating_speeds: None };
    results.torsional = Some(machine.torsional(&torsion).unwrap());
    let axis = |name: &str| SectionChannel { name: name.into(), unit: "m".into() };
    let orbit = FilteredOrbit {
        order: 1.0,
        centre: [1e-6, -2e-6],
        x: Complex64::new(1e-5, 2e-6),
        y: Complex64::new(-1e-6, 3e-5),
    };
    let plane = |name: &str, whirl| PlaneSection {
        name: name.into(),
        axes: [axis("disc_x"), axis("disc_y")],
        orbit: [vec![0.0, 1.0, 2.0], vec![3.0, 4.0, 5.0]],
        sample_rate: 1e4,
        section: [vec![0.5, 0.25], vec![-0.5, 0.125]],
        whirl,
        clearance: None,
    };
    let whirl = Whirl { forwardness: 0.9, synchronous: orbit };
    results.poincare = Some(PoincareResult {
        speed: 125.0,
        clock: clock(),
        motion: classification(Motion::QuasiPeriodic),
        transient_periods: 40,
        groups: 2,
        shaft_angle: vec![0.0, 0.1, 0.2],
        planes: vec![plane("disc", Some(whirl)), plane("phase", None)],
        partial: None,
    });
    results.lyapunov =
        Some(LyapunovResult { speed: 125.0, clock: clock(), exponent: exponent(), partial: None });
    let motion = SteadyMotion {
        sections: vec![vec![1.0, 2.0], vec![3.0, 4.0]],
        extremes: vec![[0.0, 2.5], [2.0, 4.5]],
        frequency: 20.0,
        motion: classification(Motion::Periodic(2)),
        transient_periods: 10,
        exponent: Some(exponent()),
    };
    let points = vec![
        BifurcationPoint { value: 1.0, motion: Ok(motion) },
        BifurcationPoint { value: 2.0, motion: Err("it diverged".into()) },
    ];
    results.bifurcation = Some(BifurcationResult {
        parameter: Parameter { paths: vec!["speed".into()], unit: "rpm".into(), ..Parameter::default() },
        clock: "shaft revolution".into(),
        channels: vec![axis("disc_x"), axis("disc_y")],
        sweeps: vec![
            BifurcationSweep { name: "up".into(), points },
            BifurcationSweep { name: "from equilibrium".into(), points: Vec::new() },
        ],
        seams: 0,
        rerun_chunks: 0,
        complete: false,
    });
    let cut = results.orders[0].cuts[0].1.clone();
    let line = CagePhaseLine {
        line: order_line(),
        minimum: cut.rms.clone(),
        maximum: cut.rms.clone(),
        peaks: vec![1.0, 2.0],
        cut,
    };
    let channel = CagePhaseChannel { channel: "B_ax".into(), unit: "m/s^2".into(), lines: vec![line] };
    results.cage_phases = Some(CagePhaseBand {
        bearings: vec!["A".into(), "B".into()],
        angles: vec![vec![0.0, 0.0], vec![0.1, 0.2]],
        channels: vec![channel],
    });
    if let Some(run) = &mut results.run_up {
        let line = StepErrorLine {
            channel: "B_ax".into(),
            line: order_line(),
            level: 1.0,
            other_level: 1.1,
            error: f64::NEG_INFINITY,
        };
        run.step_error = Some(StepError {
            stretch: [0.2, 0.4],
            other_step: 5e-5,
            speed: 100.0,
            lines: vec![line],
            steps: u64::MAX / 2,
            cost: 0.1,
        });
    }
    results.ball_inertia = vec![("static".into(), machine.ball_inertia(&[100.0]))];
    (machine, results)
}

#[test]
fn saved_results_are_loaded_bit_for_bit() {
    let (_, results) = every_result();
    let loaded = assert_round_trip(&results, "the rig");
    assert_eq!(loaded.run_up.unwrap().history, results.run_up.clone().unwrap().history);
    let [found, stated] = [loaded.poincare.unwrap(), results.poincare.clone().unwrap()]
        .map(|p| p.motion.amplitude_trend.to_bits());
    assert_eq!(found, stated, "the sign of zero");
    // One study's result alone, and no result.
    let modes: Vec<Vec<Mode>> = results.modal.iter().map(|at| at.modes.clone()).collect();
    assert_eq!(assert_round_trip(&modes, "modes"), modes);
    assert_round_trip(&results.bifurcation, "bifurcation");
    assert_round_trip(&Results::default(), "no results");
    for bits in [f64::NAN.to_bits(), (-f64::NAN).to_bits(), 0x7ff8_0000_0000_0123, f64::INFINITY.to_bits()] {
        let loaded = assert_round_trip(&vec![f64::from_bits(bits)], "special numbers");
        assert_eq!(loaded[0].to_bits(), bits);
    }
}

#[test]
fn saved_results_of_other_models_are_loaded_bit_for_bit() {
    for name in ["jeffcott", "nelson_mcvaugh", "two_disc_pedestals", "bal_2022", "zhang_2016"] {
        let path = format!("models/{name}.toml");
        let model =
            load_model(&path, std::fs::read_to_string(&path).unwrap(), &Options::default()).unwrap().model;
        let machine = Machine::new(model).unwrap();
        let studies = &machine.model.studies;
        let results = Results {
            equilibrium: studies.equilibrium.as_ref().map(|study| machine.equilibrium(study).unwrap()),
            modal: studies.modal.as_ref().map_or_else(Vec::new, |study| machine.modal(study).unwrap()),
            campbell: studies.campbell.as_ref().map(|study| machine.campbell(study).unwrap()),
            critical: studies.critical.as_ref().map(|study| machine.critical(study).unwrap()),
            frf: studies.frf.as_ref().map(|study| machine.frf(study).unwrap()),
            unbalance: studies.unbalance.as_ref().map(|study| machine.unbalance(study).unwrap()),
            bearings: studies
                .bearing
                .as_ref()
                .map_or_else(Vec::new, |study| machine.bearings(study).unwrap()),
            ..Results::default()
        };
        assert_round_trip(&results, name);
    }
}

#[test]
fn saved_signal_analyses_are_loaded_bit_for_bit() {
    let (machine, results) = &*RIG;
    let history = &results.run_up.as_ref().unwrap().history;
    let samples = history.channel("B_ax").unwrap().values.in_memory().unwrap();
    let channel = SignalChannel {
        name: "B_ax".into(),
        unit: "m/s^2".into(),
        sample_rate: history.sample_rate,
        start: 0.0,
        samples: samples.to_vec(),
        orthogonal: None,
    };
    let mut shaft = ShaftMotion::constant(10.0, "the run".into());
    shaft.summary.steady = false;
    shaft.angle = history.angle.all().unwrap().into_owned();
    let g = &machine.model.bearings.iter().find_map(|site| site.bearing.ball()).unwrap().geometry;
    let bearing = BearingWithOrders {
        name: "B".into(),
        source: "the model".into(),
        orders: g.characteristic_orders(g.contact_angle),
        balls: g.balls,
        raceway_radii: None,
    };
    let settings = SignalSettings { analyses: AnalysisSelection::All, ..SignalSettings::default() };
    let found = analyse(&channel, Some(&shaft), Some(&bearing), &settings).unwrap();
    assert!(found.orders.is_some() && found.envelope.is_some() && found.kurtogram.is_some());
    let _: SignalResult = assert_round_trip(&found, "signal");
}

#[test]
fn load_errors_name_file_and_place() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.results");
    let message = load::<Results>(&path).unwrap_err().to_string();
    assert!(message.contains("open") && message.contains("run.results"), "{message}");
    std::fs::write(&path, "not results").unwrap();
    let message = load::<Results>(&path).unwrap_err().to_string();
    assert!(message.contains("run.results: it contains no results"), "{message}");

    // Another result; the name of a field that is missing.
    save(&path, &exponent()).unwrap();
    let message = load::<SectionClock>(&path).unwrap_err().to_string();
    assert!(message.contains("missing field `name`"), "{message}");
    // A number where a text is expected, with the path to it.
    save(&path, &vec![("disc".to_string(), 1.0)]).unwrap();
    let message = load::<Vec<(String, String)>>(&path).unwrap_err().to_string();
    assert!(message.contains("at [0][1]: invalid type: floating point"), "{message}");
    // A file cut off.
    save(&path, &RIG.1.modal).unwrap();
    let bytes = std::fs::read(&path).unwrap();
    std::fs::write(&path, &bytes[..bytes.len() / 3]).unwrap();
    let message = load::<Vec<rotordyn::results::ModalResult>>(&path).unwrap_err().to_string();
    assert!(message.contains("run.results") && message.contains("].modes["), "{message}");
}

/// Keys in JSON and groups in HDF5 of every field of `Results`.
const WRITTEN: [(&str, &str, &str); 18] = [
    ("equilibrium", "equilibrium", "/equilibrium"),
    ("modal", "modal", "/modes"),
    ("campbell", "campbell", "/campbell"),
    ("critical", "critical_speeds", "/critical_speeds"),
    ("frf", "frf", "/frf"),
    ("unbalance", "unbalance", "/unbalance"),
    ("critical_map", "critical_map", "/critical_map"),
    ("torsional", "torsional", "/torsional"),
    ("run_up", "run_up", "/run_up"),
    ("spectrograms", "spectrograms", "/spectra/B_ax/spectrogram"),
    ("orders", "orders", "/spectra/B_ax/orders"),
    ("cage_phases", "cage_phases", "/run_up/cage_phases"),
    ("poincare", "poincare", "/poincare"),
    ("lyapunov", "lyapunov", "/lyapunov"),
    ("bifurcation", "bifurcation", "/bifurcation"),
    ("bearings", "bearings", "/bearings/B"),
    ("ball_inertia", "ball_inertia", "/ball_inertia/static"),
    ("warnings", "warnings", "/warnings"),
];

#[test]
fn every_field_of_the_results_is_in_both_formats() {
    let (machine, results) = every_result();
    let fields = serde_json::to_value(Results::default()).unwrap();
    let fields: Vec<&String> = fields.as_object().unwrap().keys().collect();
    let mut listed = WRITTEN.map(|(field, ..)| field);
    listed.sort_unstable();
    assert_eq!(fields, listed, "a new field needs a section in Results::sections and a row in WRITTEN");

    let folder = tempfile::tempdir().unwrap();
    let store = Store::create(folder.path().join("results.h5")).unwrap();
    write_study(&store, &results, machine).unwrap();
    let document = to_json(&results, machine);
    for (field, json, group) in WRITTEN {
        let value = &document[json];
        let empty = value.is_null() || value.as_array().is_some_and(Vec::is_empty);
        assert!(!empty, "{field} is not in JSON");
        assert!(store.contains(group), "{field} is not in HDF5");
        assert!(
            !store.members(group).unwrap().is_empty() || field == "ball_inertia",
            "{field} is empty in HDF5"
        );
    }
    // Without results, nothing but the labels of the machine.
    let store = Store::create(folder.path().join("empty.h5")).unwrap();
    write_study(&store, &Results::default(), machine).unwrap();
    assert_eq!(store.members("/").unwrap(), ["labels"]);
}

/// Rows of different length and failed points are filled with NaN in HDF5, and have their own form in JSON.
#[test]
fn incomplete_rows_are_filled_with_nan() {
    let (machine, mut results) = every_result();
    results.modal[0].modes.truncate(1);
    let folder = tempfile::tempdir().unwrap();
    let store = Store::create(folder.path().join("results.h5")).unwrap();
    write_study(&store, &results, machine).unwrap();
    let document = to_json(&results, machine);

    let modes = results.modal.iter().map(|at| at.modes.len()).max().unwrap();
    let frequency = store.read("/modes/frequency").unwrap();
    assert_eq!(frequency.shape, [results.modal.len(), modes]);
    assert_eq!(frequency.data[0], results.modal[0].modes[0].frequency_hz());
    assert!(frequency.data[1..modes].iter().all(|value| value.is_nan()));
    let shapes = store.read_complex("/modes/shapes").unwrap();
    let nodes = machine.assembly.dofs.full_len() / 6;
    assert_eq!(shapes.shape, [results.modal.len(), modes, nodes, 6]);
    assert_eq!(shapes.data[6 * nodes * modes..][..6 * nodes], results.modal[1].modes[0].full_shape);
    assert_eq!(document["modal"][0]["modes"].as_array().unwrap().len(), 1);

    let sections = store.read("/bifurcation/up/channels/disc_x/section").unwrap();
    assert_eq!(sections.shape, [2, 2]);
    assert!(sections.data[..2] == [1.0, 2.0] && sections.data[2..].iter().all(|value| value.is_nan()));
    let points = &document["bifurcation"]["sweeps"][0]["points"];
    assert_eq!(points[1], serde_json::json!({ "value": 2.0, "failure": "it diverged" }));
    assert_eq!(points[0]["sections"], serde_json::json!([[1.0, 2.0], [3.0, 4.0]]));
    assert!(points[0]["motion"]["residual"].is_null(), "infinite values are null in JSON");
    assert_eq!(store.read("/bifurcation/up/residual").unwrap().data[0], f64::INFINITY);
}

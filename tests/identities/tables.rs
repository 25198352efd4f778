//! Bearings tabulated over speed, at speeds beyond their tables.

use crate::modal_damping::{RATIO, overhung};
use rotordyn::bearing::{Bearing, LinearElement};
use rotordyn::error::PhysicsError;
use rotordyn::model::{Model, SpeedProfile, study};
use rotordyn::study::Machine;
use std::f64::consts::TAU;

const RPM: f64 = TAU / 60.0;

/// A bearing whose stiffness and damping fall over speed from 300 to 4500 rpm.
fn falling(lines: &str) -> String {
    format!(
        "speed = \"300, 2000, 4500 rpm\"\nk_xx = \"6e6, 3e6, 4e5 N/m\"\nk_yy = \"5e6, 2e6, 3e5 N/m\"\n\
         k_xy = \"0, 1e5, 2e5 N/m\"\nc_xx = \"900, 500, 50 N s/m\"\nc_yy = \"900, 500, 50 N s/m\"\n{lines}"
    )
}

fn machine(lines: &str) -> Model {
    overhung(6, ["k_xx = \"1e7 N/m\"\nk_yy = \"1e7 N/m\"", &falling(lines)], RATIO)
}

#[test]
fn the_values_of_the_ends_hold_beyond_a_table() {
    let model = machine("");
    let Bearing::Linear(linear) = &model.bearings[1].bearing else { panic!() };
    let element = LinearElement::new(linear);
    for (rpm, row) in [(0.0, 0), (299.0, 0), (300.0, 0), (4500.0, 2), (4501.0, 2), (20_000.0, 2), (-900.0, 0)]
    {
        let tangent = element.tangent(rpm * RPM);
        assert_eq!(
            (tangent.stiffness, tangent.damping),
            (linear.table[row].stiffness, linear.table[row].damping)
        );
    }
    // Continuous at the ends, and monotone between.
    let k = |rpm: f64| element.tangent(rpm * RPM).stiffness[0][0];
    assert!((k(4499.999) / 4e5 - 1.0).abs() < 1e-5 && (k(300.001) / 6e6 - 1.0).abs() < 1e-5);
    assert!(k(4500.0) < k(3000.0) && k(3000.0) < k(2000.0));
}

/// At any speed beyond the table every mode of a passive bearing stays stable.
#[test]
fn no_negative_stiffness_beyond_a_table() {
    let model = overhung(
        6,
        ["k_xx = \"1e7 N/m\"\nk_yy = \"1e7 N/m\"", &falling("").replace("0, 1e5, 2e5", "0, 0, 0")],
        RATIO,
    );
    let machine = Machine::new(model).unwrap();
    let study = study::ModalStudy { speeds: vec![4500.0 * RPM, 9000.0 * RPM, 30_000.0 * RPM], modes: 6 };
    for at in machine.modal(&study).unwrap() {
        assert!(
            at.modes.len() == 6 && at.modes.iter().all(|m| m.zeta() > 0.0 && m.omega() > 0.0),
            "{}",
            at.speed
        );
    }
}

type Run = fn(&Machine, f64) -> Result<(), PhysicsError>;

/// Every study of linearised or integrated motion, up to a speed \[rad/s\].
const STUDIES: [(&str, Run); 7] = [
    ("static", |m, speed| m.equilibrium(&study::EquilibriumStudy { speed, cage_average: true }).map(drop)),
    ("modal", |m, speed| m.modal(&study::ModalStudy { speeds: vec![speed], modes: 4 }).map(drop)),
    ("campbell", |m, speed| {
        let speeds = vec![0.5 * speed, speed];
        let study =
            study::CampbellStudy { speeds, modes: 4, orders: vec![1.0], speed_dependent_bearings: true };
        m.campbell(&study).map(drop)
    }),
    ("frf", |m, speed| {
        let study = study::FrfStudy { speed, ..m.model.studies.frf.clone().unwrap() };
        m.frf(&study).map(drop)
    }),
    ("unbalance", |m, speed| {
        let study = m.model.studies.unbalance.clone().unwrap();
        m.unbalance(&study::UnbalanceStudy { speeds: vec![0.5 * speed, speed], ..study }).map(drop)
    }),
    ("run-up", |m, speed| {
        let mut model = m.model.clone();
        model.profile =
            SpeedProfile::SCurve { from: 0.5 * speed, to: speed, settle: 0.1, ramp: 0.1, hold: 0.1 };
        let machine = Machine::new(model)?;
        machine.reduce(machine.model.studies.run_up.as_ref().unwrap()).map(drop)
    }),
    ("the linearised machine", |m, speed| {
        rotordyn::analysis::sensitivity::Linearised::new(m.model.clone(), speed, None).map(drop)
    }),
];

#[test]
fn every_study_refuses_or_warns_by_name() {
    let hold = Machine::new(machine("")).unwrap();
    let refuse = Machine::new(machine("beyond_table = \"refuse\"")).unwrap();
    for (name, run) in STUDIES {
        // Up to 1 % of the highest speed beyond the table is its end.
        for inside in [3000.0, 4500.0, 4544.0] {
            run(&refuse, inside * RPM).unwrap_or_else(|e| panic!("{name} at {inside} rpm: {e}"));
        }
        for speed in [4600.0, 9000.0] {
            run(&hold, speed * RPM).unwrap_or_else(|e| panic!("{name} at {speed} rpm: {e}"));
            match run(&refuse, speed * RPM) {
                Err(PhysicsError::BeyondTable { bearing, study, table_rpm, study_rpm }) => {
                    assert_eq!((bearing.as_str(), study.as_str()), ("B", name));
                    assert!((table_rpm[0] - 300.0).abs() < 1e-9 && (table_rpm[1] - 4500.0).abs() < 1e-9);
                    assert!((study_rpm[1] - speed).abs() < 1.0, "{study_rpm:?}");
                }
                other => panic!("{name} at {speed} rpm: {other:?}"),
            }
        }
    }
    let critical = study::CriticalStudy { max_speed: 4500.0 * RPM, orders: vec![1.0] };
    // From standstill: below the table's 300 rpm.
    assert!(refuse.critical(&critical).is_err());
    let warning = hold.check_tables("critical", &[0.0, critical.max_speed]).unwrap();
    assert_eq!(
        warning.iter().map(|w| w.text.as_str()).collect::<Vec<_>>(),
        [
            "bearing B: its table covers 300 to 4500 rpm, critical needs 0 to 4500 rpm; beyond it the values of its end hold"
        ]
    );
    assert!(hold.check_tables("frf", &[2000.0 * RPM]).unwrap().is_empty());
}

#[test]
fn a_torque_table_warns_beyond_its_speeds() {
    use rotordyn::analysis::table_range::check_torque_table;
    let table = [[0.0, 2.0], [300.0 * RPM, 1.5], [1500.0 * RPM, 0.2]];
    assert_eq!(check_torque_table(&table, [0.0, 1510.0 * RPM]), None);
    assert_eq!(check_torque_table(&table[..1], [0.0, 9e3]), None);
    let warning = check_torque_table(&table, [0.0, 1812.0 * RPM]).unwrap();
    assert!(
        warning.text.contains("0 to 1500 rpm") && warning.text.contains("reaches 0 to 1812 rpm"),
        "{warning}"
    );
}

//! Bearings with coefficients over whirl frequency in FRFs; studies that are asked to stop.

use crate::modal_damping::{CROSS, RATIO, TABLE, overhung};
use rotordyn::analysis::frf;
use rotordyn::assembly::LinearSystem;
use rotordyn::bearing::{Bearing, LinearElement, SiteTangent};
use rotordyn::error::PhysicsError;
use rotordyn::model::study::CampbellStudy;
use rotordyn::study::Machine;
use std::f64::consts::TAU;

/// A bearing over whirl frequency, whose values at the frequency of rotation are not those at other frequencies.
const WHIRL: &str = "whirl_frequency = \"0, 40, 90, 500 Hz\"\nk_xx = \"3e6, 5e6, 4e6, 9e6 N/m\"\nk_yy = \"2e6, 3e6, 6e6, 8e6 N/m\"\n\
     k_xy = \"0, 8e5, 2e5, 0 N/m\"\nc_xx = \"200, 300, 900, 100 N s/m\"\nc_yy = \"200, 300, 100, 100 N s/m\"";

/// Every frequency has the bearing over whirl frequency at that frequency, and the other one as at the speed.
#[test]
fn frfs_take_each_bearing_at_its_own_frequency() {
    let machine = Machine::new(overhung(6, [TABLE[1], WHIRL], RATIO)).unwrap();
    let study = machine.model.studies.frf.clone().unwrap();
    let found = machine.frf(&study).unwrap();
    let element = |k: usize| match &machine.model.bearings[k].bearing {
        Bearing::Linear(bearing) => LinearElement::new(bearing),
        other => panic!("{other:?}"),
    };
    let [a, b] = [element(0), element(1)];
    let row = |at: &rotordyn::element::Anchor, direction| machine.assembly.direction_row(at, direction);
    let excitations = [row(&study.excitations[0].at, &study.excitations[0].direction)];
    let responses: Vec<_> = study.responses.iter().map(|p| row(&p.at, &p.direction)).collect();
    let mut largest = 0.0f64;
    for (k, &hz) in found.frf.frequencies.iter().enumerate() {
        let own = |(stiffness, damping)| SiteTangent { stiffness, damping };
        let tangents =
            [own(a.matrices_at(study.speed, study.speed)), own(b.matrices_at(study.speed, hz * TAU))];
        let system = LinearSystem::new(&machine.assembly, &tangents, study.speed).unwrap();
        let expected =
            frf::frf(&machine.assembly, &system, &[hz], &excitations, &responses, study.quantity).unwrap();
        for (own, expected) in found.frf.values.iter().flatten().zip(expected.values.iter().flatten()) {
            largest = largest.max((own[k] - expected[0]).norm() / expected[0].norm());
        }
    }
    println!("{} frequencies: {largest:.1e}", found.frf.frequencies.len());
    // The same factorisation of the same matrices.
    assert!(largest < 1e-14, "{largest}");
}

#[test]
fn studies_end_on_request() {
    let machine = Machine::new(overhung(6, CROSS, RATIO)).unwrap();
    let study = CampbellStudy {
        speeds: vec![0.0, 100.0],
        modes: 4,
        orders: vec![1.0],
        speed_dependent_bearings: true,
    };
    assert!(machine.campbell(&study).is_ok());
    machine.stop.request();
    assert_eq!(machine.campbell(&study).unwrap_err(), PhysicsError::Stopped);
    let frf = machine.model.studies.frf.clone().unwrap();
    assert_eq!(machine.frf(&frf).unwrap_err(), PhysicsError::Stopped);
}

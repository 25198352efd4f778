//! Linear studies with speed-dependent ball bearings: film and ball inertia change the modes, dry massless
//! balls do not.

use rotordyn::model::{self, Model, Options, study};
use rotordyn::study::Machine;
use std::f64::consts::TAU;

/// A spindle on two angular contact bearings, back to back, preloaded rigidly.
pub fn spindle(extra: &str) -> Model {
    let bearing = |name: &str, thrust: &str| {
        format!(
            "[bearing.{name}]\nstation = \"{name}\"\nmodel = \"ball\"\ndesignation = \"7206B\"\nthrust = \"{thrust}\"\n\
             radial_clearance = \"0 um\"\npreload = {{ interference = \"4 um\" }}\n{extra}\n"
        )
    };
    let text = format!(
        "[model]\nname = \"spindle\"\n[material.steel]\nyoung = \"207 GPa\"\npoisson = 0.3\ndensity = \"7850 kg/m^3\"\n\
         [lubricant.oil]\nviscosity = \"0.04 Pa s\"\npressure_viscosity = \"2e-8 1/Pa\"\n\
         [shaft]\nelement_length = \"30 mm\"\nsection = [{{ length = \"300 mm\", outer_diameter = \"30 mm\" }}]\n\
         [station]\nA = \"60 mm\"\nB = \"240 mm\"\n{}{}",
        bearing("A", "-z"),
        bearing("B", "+z")
    );
    match model::load("spindle.toml", text, &Options::default()) {
        Ok(loaded) => loaded.model,
        Err(errors) => panic!("{errors:?}"),
    }
}

/// Frequencies \[Hz\] of the lowest branches at standstill and at 20 000 rpm.
fn branches(machine: &Machine, follow_bearings: bool) -> Vec<[f64; 2]> {
    let speeds = (0..5).map(|k| TAU * 5000.0 / 60.0 * f64::from(k)).collect();
    let study = study::CampbellStudy {
        speeds,
        modes: 5,
        orders: vec![1.0],
        speed_dependent_bearings: follow_bearings,
    };
    let found = machine.campbell(&study).unwrap();
    let ends = |b: &rotordyn::analysis::campbell::Branch| {
        [b.omega(0).unwrap() / TAU, b.omega(4).unwrap_or(f64::NAN) / TAU]
    };
    found.diagram.branches.iter().map(ends).collect()
}

#[test]
fn campbell_with_ball_inertia() {
    let machine = Machine::new(spindle("ball_inertia = \"outer_race_control\"")).unwrap();
    let (constant, updated) = (branches(&machine, false), branches(&machine, true));
    for (a, b) in constant.iter().zip(&updated) {
        assert_eq!(a[0], b[0]);
    }
    let change = |k: usize| updated[k][1] / constant[k][1] - 1.0;
    let largest = (0..constant.len()).map(|k| change(k).abs()).fold(0.0, f64::max);
    println!("inertia: {:?}", (0..constant.len()).map(change).collect::<Vec<_>>());
    assert!(largest > 0.01, "{constant:?} {updated:?}");
}

#[test]
fn campbell_with_film() {
    let machine =
        Machine::new(spindle("ball_inertia = \"none\"\ncontact = \"film\"\nlubricant = \"oil\"")).unwrap();
    let (constant, updated) = (branches(&machine, false), branches(&machine, true));
    println!("film: {constant:?} {updated:?}");
    // A film in a rigidly preloaded bearing adds to the preload: the supports become stiffer.
    assert!(updated[0][1] > 1.01 * constant[0][1], "{constant:?} {updated:?}");
}

#[test]
fn dry_massless_balls_do_not_depend_on_speed() {
    let machine = Machine::new(spindle("ball_inertia = \"none\"")).unwrap();
    assert_eq!(branches(&machine, false), branches(&machine, true));
}

/// Modes, Campbell diagram, bearing study and equilibrium at one speed use the same bearing state.
#[test]
fn all_studies_use_the_bearings_at_their_speed() {
    let machine = Machine::new(spindle("ball_inertia = \"outer_race_control\"")).unwrap();
    let speed = TAU * 20_000.0 / 60.0;
    let modes = machine.modal(&study::ModalStudy { speeds: vec![speed], modes: 9 }).unwrap();
    let top = branches(&machine, true);
    for [_, hz] in top.iter().filter(|b| b[1].is_finite()) {
        let nearest = modes[0].modes.iter().map(|m| (m.frequency_hz() / hz - 1.0).abs()).fold(1.0, f64::min);
        assert!(nearest < 1e-6, "{hz} Hz is not among the modes");
    }
    let bearings =
        machine.bearings(&study::BearingStudy { speed: Some(speed), ..Default::default() }).unwrap();
    let settings = study::EquilibriumStudy { speed, cage_average: false };
    let equilibrium = machine.equilibrium(&settings).unwrap();
    for (alone, mounted) in bearings.iter().zip(&equilibrium.bearings) {
        for a in 0..5 {
            for b in 0..5 {
                let k = &mounted.tangent.stiffness;
                let size = (k[a][a] * k[b][b]).sqrt();
                let error = (alone.point.state.stiffness[a][b] - k[a][b]).abs() / size;
                assert!(error < 1e-6, "{}: K[{a}][{b}] {error:e}", alone.name);
            }
        }
    }
}

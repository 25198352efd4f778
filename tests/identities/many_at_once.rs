//! Studies of many frequencies or speeds solve several at once; each value is that of the frequency or speed alone.

use crate::rig::variant;
use crate::speed_dependent_bearings::spindle;
use rotordyn::analysis::equilibrium::{CageTreatment, equilibrium, equilibrium_tangents};
use rotordyn::analysis::equilibrium_path::EquilibriumPath;
use rotordyn::linalg::{Complex64, StopRequest};
use rotordyn::model::study::{Excitation, FrfStudy, UnbalanceStudy};
use rotordyn::model::{self, Model, Options};
use rotordyn::study::Machine;
use std::f64::consts::TAU;

const RPM: f64 = TAU / 60.0;

fn grid(low: f64, high: f64, count: usize) -> Vec<f64> {
    (0..count).map(|k| low + (high - low) * k as f64 / (count - 1) as f64).collect()
}

/// Largest difference of two sets of responses, relative to each.
fn difference<'a>(a: impl Iterator<Item = &'a Complex64>, b: impl Iterator<Item = &'a Complex64>) -> f64 {
    a.zip(b).map(|(a, b)| (a - b).norm() / b.norm()).fold(0.0, f64::max)
}

#[test]
fn frf_of_many_frequencies() {
    // Without damping at the ball bearings too: sharp resonances, where rows are exchanged.
    for set in
        [vec![], vec![("bearing.A.contact_damping", "0 N s/m"), ("bearing.B.contact_damping", "0 N s/m")]]
    {
        let machine = Machine::new(variant(None, &set)).unwrap();
        let study = FrfStudy { refine: false, ..machine.model.studies.frf.clone().unwrap() };
        let run = |frequencies: Vec<f64>| {
            machine.frf(&FrfStudy { frequencies, ..study.clone() }).unwrap().frf.values
        };
        // Eight together, eight far apart, and a remainder of one.
        let frequencies: Vec<f64> = grid(0.5, 60.0, 160)
            .into_iter()
            .chain([0.01, 1.0, 30.0, 100.0, 400.0, 900.0, 3e3, 1e4, 20.0])
            .collect();
        let together = run(frequencies.clone());
        let mut worst: f64 = 0.0;
        for (k, &hz) in frequencies.iter().enumerate() {
            let alone = run(vec![hz]);
            let at = |values: &[Vec<Vec<Complex64>>], k: usize| -> Vec<Complex64> {
                values.iter().flatten().map(|h| h[k]).filter(|h| h.norm() > 0.0).collect()
            };
            let (a, b) = (at(&together, k), at(&alone, 0));
            assert_eq!(a.len(), b.len());
            assert!(!b.is_empty());
            worst = worst.max(difference(a.iter(), b.iter()));
        }
        println!("{set:?}: {worst:.1e}");
        assert!(worst < 1e-8, "{set:?}: {worst:e}");
    }
}

/// Each response to each excitation has its own place, here two excitations and more responses.
#[test]
fn frf_of_each_pair() {
    let machine = Machine::new(variant(None, &[])).unwrap();
    let mut study = machine.model.studies.frf.clone().unwrap();
    study.refine = false;
    study.frequencies = vec![7.0, 31.0, 83.0];
    let at = |index: usize| study.responses[index].clone();
    let of = |index: usize| Excitation {
        name: format!("e{index}"),
        at: at(index).at,
        direction: at(index).direction,
    };
    study.excitations = vec![of(0), of(1)];
    assert!(study.responses.len() > 2);
    let all = machine.frf(&study).unwrap().frf.values;
    for (r, response) in study.responses.iter().enumerate() {
        for (e, excitation) in study.excitations.iter().enumerate() {
            let responses = vec![response.clone()];
            let one = FrfStudy { responses, excitations: vec![excitation.clone()], ..study.clone() };
            let alone = &machine.frf(&one).unwrap().frf.values[0][0];
            let worst = difference(all[r][e].iter(), alone.iter());
            assert!(worst < 1e-9, "{} to {}: {worst:e}", response.name, excitation.name);
        }
    }
}

/// Largest relative difference of the unbalance response at many speeds from that at each of some.
fn unbalance_difference(model: Model, speeds: Vec<f64>) -> f64 {
    let machine = Machine::new(model).unwrap();
    let study = machine.model.studies.unbalance.clone().unwrap();
    let run = |speeds: Vec<f64>| {
        let found = machine.unbalance(&UnbalanceStudy { speeds, refine: false, ..study.clone() }).unwrap();
        let channels = found.channels.iter().map(|c| &c.amplitude);
        let discs = found.orbits.iter().flat_map(|o| [&o.x, &o.y]);
        let complex = |values: &Vec<[f64; 2]>| values.iter().map(|v| Complex64::new(v[0], v[1])).collect();
        channels.chain(discs).map(complex).collect::<Vec<Vec<Complex64>>>()
    };
    let together = run(speeds.clone());
    let mut worst: f64 = 0.0;
    for (k, &speed) in speeds.iter().enumerate().step_by(7) {
        let alone = run(vec![speed]);
        let (a, b): (Vec<_>, Vec<_>) =
            together.iter().zip(&alone).map(|(a, b)| (a[k], b[0])).filter(|(_, b)| b.norm() > 0.0).unzip();
        assert!(!b.is_empty() || speed == 0.0);
        worst = worst.max(difference(a.iter(), b.iter()));
    }
    worst
}

/// The rig with ball inertia and a clearance; chosen here, for "auto" depends on the highest speed of a study.
fn rig(inertia: &str, clearance: &str) -> Model {
    let of = |key: &str| [format!("bearing.A.{key}"), format!("bearing.B.{key}")];
    let [inertias, clearances] = [of("ball_inertia"), of("radial_clearance")];
    let pairs = inertias.iter().map(|key| (key.as_str(), inertia));
    let set: Vec<_> = pairs.chain(clearances.iter().map(|key| (key.as_str(), clearance))).collect();
    variant(None, &set)
}

/// From the path over speed one step of Newton's method is left of some three, whether all balls stay loaded (spindle) or
/// enter and leave the load zone.
#[test]
fn equilibria_over_speed_start_from_the_path() {
    for (name, model, top) in [
        ("spindle", spindle("ball_inertia = \"outer_race_control\""), 20000.0),
        ("rig", rig("outer_race_control", "10 um"), 12000.0),
    ] {
        let machine = Machine::new(model).unwrap();
        let (model, assembly, averaged) = (&machine.model, &machine.assembly, CageTreatment::Averaged);
        let iterations = |speed: f64, start: Option<&[f64]>| {
            equilibrium(model, assembly, speed, averaged, start).unwrap().iterations
        };
        let standstill = equilibrium(model, assembly, 0.0, averaged, None).unwrap().q;
        let path = EquilibriumPath::new(
            model,
            assembly,
            [0.0, top * RPM],
            averaged,
            &standstill,
            200,
            &StopRequest::default(),
        )
        .unwrap();
        assert_eq!(path.at(0.0), standstill);
        let speeds = grid(0.0, top * RPM, 50);
        let on = |start: &dyn Fn(f64) -> Vec<f64>| -> usize {
            speeds.iter().map(|&speed| iterations(speed, Some(&start(speed)))).sum()
        };
        let (from_path, from_standstill) = (on(&|speed| path.at(speed)), on(&|_| standstill.clone()));
        println!("{name}: {from_path} steps from the path, {from_standstill} from standstill");
        assert!(from_path <= speeds.len() && from_standstill > 100, "{name}: {from_path} {from_standstill}");
    }
}

/// Tangents from the path are those of the equilibrium, whether balls stay loaded or enter and leave the load zone.
#[test]
fn tangents_over_speed_come_from_the_path() {
    for (name, model, top, least) in [
        ("spindle", spindle("ball_inertia = \"outer_race_control\""), 20000.0, 41),
        ("rig", rig("outer_race_control", "10 um"), 12000.0, 5),
        ("clearance", rig("outer_race_control", "40 um"), 30000.0, 0),
        ("small bends", rig("outer_race_control", "33 um"), 9000.0, 5),
    ] {
        let machine = Machine::new(model).unwrap();
        let (model, assembly, averaged) = (&machine.model, &machine.assembly, CageTreatment::Averaged);
        let standstill = equilibrium(model, assembly, 0.0, averaged, None).unwrap().q;
        let range = [0.0, top * RPM];
        let path = EquilibriumPath::new(
            model,
            assembly,
            range,
            averaged,
            &standstill,
            1500,
            &StopRequest::default(),
        )
        .unwrap();
        let (mut worst, mut count) = (0.0_f64, 0);
        let speeds = grid(0.013 * top * RPM, 0.997 * top * RPM, 41);
        for &speed in &speeds {
            let Some(found) = path.tangents(speed) else { continue };
            count += 1;
            let exact =
                equilibrium_tangents(model, assembly, speed, averaged, Some(&path.at(speed))).unwrap();
            for (a, b) in found.iter().zip(&exact) {
                for (a, b) in [(&a.stiffness, &b.stiffness), (&a.damping, &b.damping)] {
                    for (i, j) in (0..36).map(|k| (k / 6, k % 6)) {
                        let size = (b[i][i] * b[j][j]).abs().sqrt().max(b[i][j].abs()).max(f64::MIN_POSITIVE);
                        worst = worst.max((a[i][j] - b[i][j]).abs() / size);
                    }
                }
            }
        }
        println!("{name}: {count} of {} speeds, {worst:.1e}", speeds.len());
        assert!(worst < 5e-9, "{name}: {worst:e}");
        assert!(count >= least, "{name}: {count} speeds");
    }
}

/// Ball inertia moves the equilibrium over speed, and at high speed lifts balls off the inner race.
#[test]
fn unbalance_at_many_speeds() {
    for (name, model, top) in [
        ("massless balls", rig("none", "10 um"), 6000.0),
        ("ball inertia", rig("outer_race_control", "10 um"), 12000.0),
        ("ball inertia and clearance", rig("outer_race_control", "40 um"), 30000.0),
    ] {
        let worst = unbalance_difference(model, grid(0.0, top * RPM, 203));
        println!("{name}: {worst:.1e}");
        assert!(worst < 1e-8, "{name}: {worst:e}");
    }
}

fn load(text: &str) -> Model {
    model::load("many.toml", text, &Options::default()).unwrap_or_else(|errors| panic!("{errors:?}")).model
}

/// A rigid rotor with its centre midway between bearings that differ in stiffness: forces couple displacement and rotation
/// where arms of equal stiffness would cancel. At one of them with cross-coupled stiffness.
#[test]
fn unbalance_of_a_rigid_rotor_on_unequal_bearings() {
    for (place, cross) in [("C", "0"), ("A", "0"), ("C", "3e5"), ("A", "3e5")] {
        let model = load(&format!(
            "[model]\nname = \"rigid\"\n[rotor]\nlength = \"0.5 m\"\nouter_diameter = \"40 mm\"\nmass = \"4.8 kg\"\n\
             centre = \"0.25 m\"\n[station]\nA = \"0 m\"\nB = \"0.5 m\"\nC = \"0.25 m\"\n\
             [bearing.A]\nstation = \"A\"\nmodel = \"linear\"\nk_xx = \"2e7 N/m\"\nk_yy = \"2e7 N/m\"\nk_zz = \"1e7 N/m\"\n\
             c_xx = \"900 N s/m\"\nc_yy = \"900 N s/m\"\n\
             [bearing.B]\nstation = \"B\"\nmodel = \"linear\"\nk_xx = \"5e6 N/m\"\nk_yy = \"5e6 N/m\"\nk_xy = \"{cross} N/m\"\n\
             k_yx = \"-{cross} N/m\"\nc_xx = \"900 N s/m\"\nc_yy = \"900 N s/m\"\n\
             [unbalance.u]\nstation = \"{place}\"\nmagnitude = \"100 g mm\"\n\
             [probe.x]\nat = \"rotor\"\ndirection = \"x\"\n[probe.tilt]\nat = \"station.B\"\ndirection = \"x\"\n\
             [study.unbalance]\nspeeds = \"500 rad/s\"\n"
        ));
        let worst = unbalance_difference(model, grid(0.0, 4000.0, 85));
        println!("unbalance at {place}, k_xy {cross}: {worst:.1e}");
        assert!(worst < 1e-11, "unbalance at {place}, k_xy {cross}: {worst:e}");
    }
}

/// A table may change between any two speeds, here at 3000 rpm, on the other side of ball bearings that depend on speed.
#[test]
fn unbalance_with_a_narrow_table() {
    let text = "[model]\nname = \"spindle\"\n[material.steel]\nyoung = \"207 GPa\"\npoisson = 0.3\ndensity = \"7850 kg/m^3\"\n\
         [shaft]\nelement_length = \"30 mm\"\nsection = [{ length = \"300 mm\", outer_diameter = \"30 mm\" }]\n\
         [station]\nA = \"60 mm\"\nB = \"240 mm\"\nC = \"300 mm\"\n\
         [bearing.A]\nstation = \"A\"\nmodel = \"ball\"\ndesignation = \"7206B\"\nthrust = \"-z\"\nradial_clearance = \"0 um\"\n\
         preload = { interference = \"4 um\" }\nball_inertia = \"outer_race_control\"\n\
         [bearing.B]\nstation = \"B\"\nmodel = \"ball\"\ndesignation = \"7206B\"\nthrust = \"+z\"\nradial_clearance = \"0 um\"\n\
         preload = { interference = \"4 um\" }\nball_inertia = \"outer_race_control\"\n\
         [bearing.C]\nstation = \"C\"\nmodel = \"linear\"\nspeed = \"0, 2990, 3000, 3010, 6300 rpm\"\n\
         k_xx = \"1e7, 1e7, 1e8, 1e7, 1e7 N/m\"\nk_yy = \"1e7, 1e7, 1e8, 1e7, 1e7 N/m\"\n\
         [unbalance.u]\nstation = \"C\"\nmagnitude = \"100 g mm\"\n[probe.x]\nat = \"station.B\"\ndirection = \"x\"\n\
         [study.unbalance]\nspeeds = \"500 rad/s\"\n";
    // Every seventh is compared with the speed alone: 3000 rpm is one of them.
    let speeds: Vec<f64> = (0..200).map(|k| f64::from(3000 + 15 * (k - 98)) * RPM).collect();
    let worst = unbalance_difference(load(text), speeds);
    println!("{worst:.1e}");
    assert!(worst < 1e-8, "{worst:e}");
}

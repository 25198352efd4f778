//! Studies of many frequencies or speeds solve several at once; each value is that of the frequency or speed alone.

use crate::rig::variant;
use crate::speed_dependent_bearings::spindle;
use rotordyn::analysis::equilibrium::{CageTreatment, equilibrium, equilibrium_tangents};
use rotordyn::analysis::equilibrium_path::EquilibriumPath;
use rotordyn::linalg::Complex64;
use rotordyn::model::Model;
use rotordyn::model::study::{FrfStudy, UnbalanceStudy};
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
        let path =
            EquilibriumPath::new(model, assembly, [0.0, top * RPM], averaged, &standstill, 200).unwrap();
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
    for (name, model, top) in [
        ("spindle", spindle("ball_inertia = \"outer_race_control\""), 20000.0),
        ("rig", rig("outer_race_control", "10 um"), 12000.0),
        ("clearance", rig("outer_race_control", "40 um"), 30000.0),
        ("small bends", rig("outer_race_control", "33 um"), 9000.0),
    ] {
        let machine = Machine::new(model).unwrap();
        let (model, assembly, averaged) = (&machine.model, &machine.assembly, CageTreatment::Averaged);
        let standstill = equilibrium(model, assembly, 0.0, averaged, None).unwrap().q;
        let range = [0.0, top * RPM];
        let path = EquilibriumPath::new(model, assembly, range, averaged, &standstill, 1500).unwrap();
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
        assert!(count > 10, "{name}: {count} speeds");
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

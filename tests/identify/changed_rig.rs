//! Noisy FRFs of a rig with changed parameters: the identified modes are the computed ones.

use std::f64::consts::TAU;

use rotordyn::element::Anchor;
use rotordyn::identify::{ModalIdentification, Settings, identify};
use rotordyn::io::machine_records;
use rotordyn::linalg::Complex64;
use rotordyn::model::study::{Excitation, FrfStudy, ModalStudy};
use rotordyn::model::{Probe, Quantity};
use rotordyn::signal::record::{FrfMatrix, MeasurementNoise};
use rotordyn::study::Machine;

use crate::known_modes::lines;
use crate::rig::variant;

/// Housings 30 % softer along x and 40 % stiffer along y, belt 50 % stiffer, other damping.
const CHANGED: [(&str, &str); 8] = [
    ("housing.A.k_x", "4.2e6 N/m"),
    ("housing.B.k_x", "4.2e6 N/m"),
    ("housing.A.k_y", "2.1e7 N/m"),
    ("housing.B.k_y", "2.1e7 N/m"),
    ("belt.drive.k_x", "6e5 N/m"),
    ("shaft.stiffness_damping", "3e-5 s"),
    ("bushing.disc_air.c_x", "18 N s/m"),
    ("bushing.disc_air.c_spin", "0.5 N m s/rad"),
];

const X: [f64; 6] = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0];
const Y: [f64; 6] = [0.0, 1.0, 0.0, 0.0, 0.0, 0.0];
const Z: [f64; 6] = [0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
const TWIST: [f64; 6] = [0.0, 0.0, 0.0, 0.0, 0.0, 1.0];

/// The machine and its FRFs at a speed: disc, pulley and both housings, hits at the disc along x and z, along its
/// rim (y and torsion), and at housing B along y.
fn simulated_test(set: &[(&str, &str)], speed: f64, frequencies: Vec<f64>) -> (Machine, FrfMatrix) {
    let mut model = variant(None, set);
    let place = |name: &str| Anchor::node(machine_records::point_number(&model, name).unwrap() as usize - 1);
    let disc = place("disc");
    let housing = |name: &str| model.probes.iter().find(|p| p.name == name).unwrap().at;
    let rim = Anchor { offset: [0.15, 0.0, 0.0], ..disc };
    let probe = |name: &str, at: Anchor, direction: [f64; 6]| Probe {
        name: name.into(),
        at,
        direction,
        quantity: Quantity::Acceleration,
    };
    let hit = |name: &str, at: Anchor, direction: [f64; 6]| Excitation { name: name.into(), at, direction };
    let study = FrfStudy {
        speed,
        frequencies,
        refine: false,
        excitations: vec![
            hit("disc_x", disc, X),
            hit("disc_z", disc, Z),
            hit("rim", rim, Y),
            hit("B_y", housing("B_ay"), Y),
        ],
        responses: vec![
            probe("disc_x", disc, X),
            probe("disc_y", disc, Y),
            probe("disc_z", disc, Z),
            probe("disc_twist", disc, TWIST),
            probe("pulley_x", place("pulley"), X),
            probe("pulley_y", place("pulley"), Y),
            probe("A_x", housing("A_ax"), X),
            probe("A_y", housing("A_ay"), Y),
            probe("B_x", housing("B_ax"), X),
            probe("B_y", housing("B_ay"), Y),
        ],
        quantity: Quantity::Acceleration,
    };
    model.studies.frf = Some(study.clone());
    let machine = Machine::new(model).unwrap();
    let measured = machine_records::frf_records(&machine.frf(&study).unwrap(), &machine);
    (machine, measured.frf_matrix().unwrap())
}

fn modes(machine: &Machine, speed: f64, below: f64) -> Vec<(Complex64, String)> {
    let found = machine.modal(&ModalStudy { speeds: vec![speed], modes: 16 }).unwrap();
    let modes = found[0].modes.iter().filter(|m| m.frequency_hz() < below);
    modes.map(|m| (m.eigenvalue, m.label.clone())).collect()
}

fn print(found: &ModalIdentification) {
    for m in &found.modes {
        println!(
            "{:9.4} ± {:.4} Hz  {:.4} ± {:.4} %  whirl {:+.3}  F {:.0}",
            m.frequency_hz(),
            m.frequency_error,
            100.0 * m.damping_ratio(),
            100.0 * m.damping_error,
            m.whirl.unwrap_or(f64::NAN),
            m.significance
        );
    }
    println!("error {:.4}, dropped {:#?}", found.total_error, found.dropped);
}

#[test]
fn all_modes_of_a_changed_rig() {
    let (machine, exact) = simulated_test(&CHANGED, 0.0, lines(4.0, 340.0, 0.25));
    let test = MeasurementNoise { signal_to_noise_db: 40.0, averages: 10, seed: 1 };
    let found = identify(&exact.with_measurement_noise(&test).unwrap(), &Settings::default()).unwrap();
    print(&found);
    let truth = modes(&machine, 0.0, 300.0);
    for (value, label) in &truth {
        let near =
            found.modes.iter().min_by(|a, b| (a.pole - value).norm().total_cmp(&(b.pole - value).norm()));
        let near = near.unwrap();
        let frequency = near.pole.im / value.im - 1.0;
        let zeta = -value.re / value.norm();
        let damping = near.damping_ratio() / zeta - 1.0;
        println!(
            "{label}: {:.3} Hz, {:.3} %: off by {:.4} % and {:.2} %",
            value.im / TAU,
            100.0 * zeta,
            100.0 * frequency,
            100.0 * damping
        );
        assert!(frequency.abs() < 0.002, "{label}: frequency off by {:.3} %", 100.0 * frequency);
        assert!(damping.abs() < 0.1, "{label}: damping off by {:.1} %", 100.0 * damping);
    }
    assert!(truth.iter().any(|(_, label)| label.contains("tors")), "{truth:?}");
    let below = found.modes.iter().filter(|m| m.frequency_hz() < 300.0).count();
    assert_eq!(below, truth.len(), "number of modes below 300 Hz");
}

#[test]
fn gyroscopic_pairs_whirl_in_opposite_directions() {
    let speed = 1200.0 * TAU / 60.0;
    // Isotropic housings: the pairs are split by the disc's gyroscopic moment.
    let round = [
        ("housing.A.k_y", "6e6 N/m"),
        ("housing.B.k_y", "6e6 N/m"),
        ("housing.A.c_y", "300 N s/m"),
        ("housing.B.c_y", "300 N s/m"),
        ("belt.drive.k_x", "2e4 N/m"),
        ("belt.drive.c_x", "0 N s/m"),
    ];
    let (machine, exact) = simulated_test(&round, speed, lines(4.0, 240.0, 0.125));
    let test = MeasurementNoise { signal_to_noise_db: 40.0, averages: 10, seed: 2 };
    let found = identify(&exact.with_measurement_noise(&test).unwrap(), &Settings::default()).unwrap();
    print(&found);
    let computed = machine.modal(&ModalStudy { speeds: vec![speed], modes: 12 }).unwrap();
    let mut pairs = 0;
    for mode in computed[0].modes.iter().filter(|m| m.frequency_hz() < 200.0) {
        let forward = mode.label.contains("forward");
        if !forward && !mode.label.contains("backward") {
            continue;
        }
        let near = found
            .modes
            .iter()
            .min_by(|a, b| (a.pole - mode.eigenvalue).norm().total_cmp(&(b.pole - mode.eigenvalue).norm()));
        let near = near.unwrap();
        println!("{}: {:.3} Hz, identified {:.3} Hz", mode.label, mode.frequency_hz(), near.frequency_hz());
        assert!((near.pole.im / mode.eigenvalue.im - 1.0).abs() < 0.002, "{}", mode.label);
        let whirl = near.whirl.unwrap();
        assert!(if forward { whirl > 0.3 } else { whirl < -0.3 }, "{}: whirl {whirl:.3}", mode.label);
        pairs += 1;
    }
    assert!(pairs >= 4 && pairs % 2 == 0, "{pairs} whirling modes");
}

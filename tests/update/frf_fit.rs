//! Model updating with noisy FRFs of the rig with changed housings, starting from the unchanged rig.

use rotordyn::model::{Model, Quantity};
use rotordyn::signal::record::{Dof, FrfMatrix, MeasurementNoise};
use rotordyn::update::frf::FrfFitting;
use rotordyn::update::parameter::FreeParameter;
use rotordyn::update::residual::Fitting;
use rotordyn::update::state::ModelState;
use rotordyn::update::target::{Target, TargetFrfs, sensors};
use rotordyn::update::{IdentifiabilityClass, Update};

use crate::rig::variant;
use crate::rig_as_truth::{TRUTH, fitted, measured, point};

/// Accelerances of both bearings, pulley and disc by hits on disc and bearing B, signal-to-noise ratio 40 dB.
fn simulated_frfs(model: Model, seed: u64) -> TargetFrfs {
    let dofs = |names: &[(&str, i8)]| -> Vec<Dof> {
        names.iter().map(|(name, way)| Dof::new(point(&model, name), *way)).collect()
    };
    let (responses, references) = (
        dofs(&[("A", 1), ("A", 2), ("B", 1), ("B", 2), ("disc", 1), ("disc", 2)]),
        dofs(&[("disc", 1), ("B", 2)]),
    );
    let frequencies: Vec<f64> = (20..1200).map(|k| 0.25 * f64::from(k)).collect();
    let placed = |dofs: &[Dof]| sensors(dofs, &Default::default(), &model).unwrap();
    let mut out = TargetFrfs {
        frequencies: frequencies.clone(),
        responses: placed(&responses),
        references: placed(&references),
        quantities: vec![Quantity::Acceleration; responses.len()],
        values: Vec::new(),
        coherence: None,
    };
    let state = ModelState::new(model.clone(), &Target::default(), None).unwrap();
    let exact = FrfMatrix {
        frequencies,
        units: vec![vec!["m/(s^2 N)".into(); references.len()]; responses.len()],
        responses,
        references,
        values: state.frfs(&out).unwrap(),
        coherence: None,
    };
    let noisy = exact
        .with_measurement_noise(&MeasurementNoise { signal_to_noise_db: 40.0, averages: 10, seed })
        .unwrap();
    (out.values, out.coherence) = (noisy.values, noisy.coherence);
    out
}

const BAND: [f64; 2] = [5.0, 300.0];

fn frf_only(complex: bool) -> Fitting {
    let frf = Some(FrfFitting::new(complex, BAND));
    Fitting { frequency: None, damping: None, shape: None, frf }
}

/// Target with FRFs and modes; `Fitting` selects what is fitted.
fn target(set: &[(&str, &str)], seed: u64) -> Target {
    let model = variant(None, set);
    let frfs = Some(simulated_frfs(model.clone(), seed));
    Target { frfs, ..measured(model) }
}

/// Natural logarithm of estimate over truth.
fn log_error(parameters: &[FreeParameter], found: &Update, j: usize, truth: f64) -> f64 {
    (parameters[j].value(found.outcomes[j].x) / truth).ln()
}

const HOUSINGS: [&str; 2] = ["housing.*.k_x", "housing.*.k_y"];

fn check_housings(parameters: &[FreeParameter], found: &Update, truth: [f64; 2]) {
    assert!(found.converged);
    for (j, truth) in truth.into_iter().enumerate() {
        let outcome = &found.outcomes[j];
        assert_eq!(outcome.class, IdentifiabilityClass::Identifiable, "{}", parameters[j].name);
        let off = log_error(parameters, found, j, truth);
        assert!(off.abs() < 0.02, "{} is off by {off:.4}", parameters[j].name);
        assert!(off.abs() < 2.0 * outcome.error, "off by {off:.4}, stated {:.4}", outcome.error);
    }
}

#[test]
fn housings_from_magnitudes_alone() {
    let (parameters, found) = fitted(&HOUSINGS, frf_only(false), &target(&TRUTH[..4], 1));
    check_housings(&parameters, &found, [4.2e6, 2.1e7]);
}

#[test]
fn housings_from_complex_frfs_alone() {
    let (parameters, found) = fitted(&HOUSINGS, frf_only(true), &target(&TRUTH[..4], 1));
    check_housings(&parameters, &found, [4.2e6, 2.1e7]);
}

#[test]
fn housings_from_frequencies_shapes_and_frfs() {
    let fitting = Fitting { frf: frf_only(false).frf, ..Fitting::default() };
    let (parameters, found) = fitted(&HOUSINGS, fitting, &target(&TRUTH[..4], 1));
    check_housings(&parameters, &found, [4.2e6, 2.1e7]);
}

#[test]
fn housings_far_from_their_start_values() {
    let [x, y] = ["1.5e6 N/m", "6e6 N/m"];
    let set = [("housing.A.k_x", x), ("housing.B.k_x", x), ("housing.A.k_y", y), ("housing.B.k_y", y)];
    for complex in [false, true] {
        let (parameters, found) = fitted(&HOUSINGS, frf_only(complex), &target(&set, 1));
        check_housings(&parameters, &found, [1.5e6, 6e6]);
    }
}

#[test]
fn housings_belt_and_housing_damping() {
    let paths = ["housing.*.k_x", "housing.*.k_y", "belt.drive.k_x", "housing.*.c_x"];
    let (parameters, found) = fitted(&paths, frf_only(false), &target(&TRUTH, 2));
    check_housings(&parameters, &found, [4.2e6, 2.1e7]);
    for (j, truth) in [(2, 3e5), (3, 400.0)] {
        let (off, error) = (log_error(&parameters, &found, j, truth), found.outcomes[j].error);
        assert_ne!(found.outcomes[j].class, IdentifiabilityClass::NotIdentifiable);
        assert!(off.abs() < 0.1 && off.abs() < 2.0 * error, "{} is off by {off:.4}", paths[j]);
    }
}

/// Errors over their standard errors, for housings and belt.
fn normalised(fitting: Fitting, set: &[(&str, &str)], seed: u64) -> [f64; 3] {
    let paths = ["housing.*.k_x", "housing.*.k_y", "belt.drive.k_x"];
    let (parameters, found) = fitted(&paths, fitting, &target(set, seed));
    let of = |j: usize, truth| log_error(&parameters, &found, j, truth) / found.outcomes[j].error;
    [of(0, 4.2e6), of(1, 2.1e7), of(2, 3e5)]
}

#[test]
fn truth_lies_within_the_standard_errors() {
    // With noise alone, and with model errors of shaft, pulley and damping that are not free parameters.
    let wrong = [
        ("material.steel.young", "206.5 GPa"),
        ("disc.pulley.mass", "1.02 kg"),
        ("bushing.disc_air.c_spin", "0.5 N m s/rad"),
    ];
    let wrong: Vec<(&str, &str)> = TRUTH.iter().chain(&wrong).copied().collect();
    for seed in 1..=2 {
        for complex in [false, true] {
            for set in [&TRUTH[..5], &wrong] {
                let all = normalised(frf_only(complex), set, seed);
                println!("seed {seed}, complex {complex}: {all:.2?}");
                assert!(all.iter().all(|z| z.abs() < 2.0), "seed {seed}, complex {complex}: {all:?}");
            }
        }
    }
}

#[test]
fn bearing_stiffness_is_not_identifiable() {
    let paths = ["housing.*.k_x", "housing.*.k_y", "belt.drive.k_x", "material.bearing_steel.young"];
    let all = Fitting { frf: frf_only(false).frf, ..Fitting::default() };
    for (fitting, seed) in [(frf_only(false), 3), (frf_only(true), 4), (all, 5)] {
        let (parameters, found) = fitted(&paths, fitting, &target(&TRUTH, seed));
        for (j, truth) in [4.2e6, 2.1e7, 3e5, 207.0].into_iter().enumerate() {
            let (off, error) = (log_error(&parameters, &found, j, truth), found.outcomes[j].error);
            assert!(off.abs() < 2.0 * error, "{} is off by {off:.4}, stated {error:.4}", paths[j]);
        }
        assert_ne!(found.outcomes[3].class, IdentifiabilityClass::Identifiable);
    }
}

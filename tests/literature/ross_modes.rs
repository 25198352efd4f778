//! Complex eigenvalues of ROSS 3.1.0's models, as sets.

use crate::agree;
use crate::ross::{self, number, numbers, read};
use rotordyn::assembly::{Assembly, LinearSystem, SpinUpForm};
use rotordyn::element::shaft_matrices::ConeRule;
use rotordyn::linalg::{Complex64, eigen, krylov};

const CASES: [&str; 7] = [
    "friswell_5_9_1",
    "jeffcott",
    "nelson_mcvaugh_isotropic_rayleigh",
    "nelson_mcvaugh_isotropic_timoshenko",
    "nelson_mcvaugh_orthotropic_damped",
    "overhung_disc_300x20",
    "uniform_pinned",
];

/// Largest relative distance of a reference value from the nearest of ours, each of ours used once.
fn worst_distance(ours: &[Complex64], theirs: &[Complex64]) -> f64 {
    let mut left = ours.to_vec();
    let mut worst: f64 = 0.0;
    for t in theirs {
        let best = (0..left.len()).min_by(|&a, &b| (left[a] - t).norm().total_cmp(&(left[b] - t).norm()));
        let partner = left.swap_remove(best.expect("as many values as the reference"));
        worst = worst.max((partner - t).norm() / t.norm());
    }
    worst
}

#[test]
fn complex_eigenvalues_agree() {
    for name in CASES.iter().copied().chain(["speed_table_proportional_damping"]) {
        let case = read(&format!("ross/{name}.json"));
        let model = ross::model(&case);
        let assembly = Assembly::with_forms(&model, SpinUpForm::Ross, ConeRule::ArithmeticMean).unwrap();
        for modal in case["results"]["modal"].as_array().unwrap() {
            let speed = number(&modal["speed"]);
            let system = LinearSystem::new(&assembly, &ross::tangents(&model, speed), speed).unwrap();
            let reference = &modal["reference_oscillatory"];
            let theirs: Vec<Complex64> = numbers(&reference["re"])
                .into_iter()
                .zip(numbers(&reference["im"]))
                .map(|(re, im)| Complex64::new(re, im))
                .collect();
            let found = krylov::lowest_eigenpairs(
                &system.mass,
                &system.damping,
                &system.stiffness,
                theirs.len(),
                30.0,
            )
            .unwrap();
            let ours: Vec<Complex64> = found.iter().map(|p| p.value).collect();
            let krylov = worst_distance(&ours, &theirs);
            let dense: Vec<Complex64> = eigen::quadratic(
                &system.mass.to_dense(),
                &system.damping.to_dense(),
                &system.stiffness.to_dense(),
            )
            .unwrap()
            .iter()
            .map(|p| p.0)
            .filter(|v| v.im > 0.0)
            .collect();
            let dense = worst_distance(&dense, &theirs);
            println!("{name} at {speed:.1} rad/s: Krylov {krylov:.1e}, dense {dense:.1e}");
            agree::curve(
                format_args!("{name} at {speed:.1} rad/s: eigenvalues by Krylov"),
                krylov,
                1.0,
                1e-6,
            );
            agree::curve(format_args!("{name} at {speed:.1} rad/s: eigenvalues, dense"), dense, 1.0, 1e-6);
        }
    }
}

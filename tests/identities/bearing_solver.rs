//! Single-bearing solver: equilibrium and stiffness under any load.

use crate::bearing::rig_6205;
use proptest::prelude::*;
use rotordyn::analysis::bearing_stiffness::{BearingSolver, Condition};
use rotordyn::analysis::equilibrium::CageTreatment;
use rotordyn::bearing::{BallBearing, BallGeometry};

fn condition(load: [f64; 5], cage: CageTreatment) -> Condition {
    Condition { load, prescribed: [None; 5], speed: 0.0, cage, cage_angle: 0.3 }
}

fn angular_contact() -> BallBearing {
    let geometry = BallGeometry { contact_angle: 0.44, radial_clearance: 0.0, ..rig_6205().geometry };
    BallBearing { geometry, ..rig_6205() }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]

    /// Equilibrium under any load, moments included, started at the centred bearing with clearance; the
    /// reaction at the constrained equilibrium displacement equals the load.
    #[test]
    fn equilibrium_under_any_load(
        force in prop::array::uniform3(-3000.0..3000.0f64),
        moment in prop::array::uniform2(-8.0..8.0f64),
        size in -4.0..0.0f64,
    ) {
        let solver = BearingSolver::new("any", &rig_6205());
        let scale = 10f64.powf(size);
        let load = [force[0], force[1], force[2], moment[0], moment[1]].map(|f| f * scale);
        for cage in [CageTreatment::FixedAngle, CageTreatment::Averaged] {
            let found = solver.solve(&condition(load, cage), None).unwrap();
            let held = Condition { prescribed: found.displacement.map(Some), ..condition([0.0; 5], cage) };
            let back = solver.solve(&held, None).unwrap();
            for k in 0..5 {
                let arm = if k > 2 { solver.radius } else { 1.0 };
                let size = load.iter().fold(0.0, |m: f64, f| m.max(f.abs()));
                prop_assert!((back.load[k] - load[k]).abs() < 1e-7 * size * arm.max(1e-2), "{k}: {load:?} {:?}", back.load);
            }
        }
    }

    /// Averaged over the cage angle the bearing is isotropic: rotating the load rotates the displacement.
    #[test]
    fn rotated_load_rotates_displacement(angle in -3.0..3.0f64, axial in 0.0..800.0f64, tilt in -3.0..3.0f64) {
        let solver = BearingSolver::new("round", &rig_6205());
        let load = [0.0, -900.0, axial, tilt, 0.0];
        let (sin, cos) = f64::sin_cos(angle);
        let turn = |v: [f64; 5]| {
            [cos * v[0] - sin * v[1], sin * v[0] + cos * v[1], v[2], cos * v[3] - sin * v[4], sin * v[3] + cos * v[4]]
        };
        let free = |load| condition(load, CageTreatment::Averaged);
        let found = solver.solve(&free(load), None).unwrap();
        let force = solver.reaction(&free(load), &turn(found.displacement)).force;
        let turned = turn(load);
        for k in 0..5 {
            // Residual ball-pitch dependence of the mean over 108 ball positions, some near loss of contact.
            let size = if k > 2 { 900.0 * solver.radius } else { 900.0 };
            prop_assert!((force[k] + turned[k]).abs() < 1e-3 * size, "{k}: {force:?} {turned:?}");
        }
    }
}

/// The condensed stiffness (other DOFs free) is the slope of load over displacement.
#[test]
fn condensed_stiffness_is_slope_of_load() {
    let solver = BearingSolver::new("slope", &angular_contact());
    let load = [200.0, -400.0, 900.0, 1.0, -2.0];
    let at = solver.solve(&condition(load, CageTreatment::FixedAngle), None).unwrap();
    for (n, step) in [([1.0, 0.0, 0.0, 0.0, 0.0], 1e-2), ([0.0, 0.6, 0.8, 0.0, 0.0], 1e-2)] {
        let moved = |sign: f64| {
            let load = std::array::from_fn(|k| load[k] + sign * step * n[k]);
            let found =
                solver.solve(&condition(load, CageTreatment::FixedAngle), Some(&at.displacement)).unwrap();
            found.displacement.iter().zip(&n).map(|(d, n)| d * n).sum::<f64>()
        };
        let slope = 2.0 * step / (moved(1.0) - moved(-1.0));
        let free = at.condensed_stiffness(&n, solver.radius);
        assert!((free / slope - 1.0).abs() < 1e-5, "{free} {slope}");
        assert!(free < at.constrained_stiffness(&n));
    }
}

/// Constrained DOFs take the reaction; free DOFs carry the given load.
#[test]
fn any_dofs_can_be_constrained() {
    let solver = BearingSolver::new("constrained", &angular_contact());
    let base = condition([0.0, -500.0, 700.0, 0.0, 0.0], CageTreatment::FixedAngle);
    for mask in 0..32usize {
        let held: [Option<f64>; 5] =
            std::array::from_fn(|k| (mask >> k & 1 == 1).then_some([2e-6, -3e-6, 8e-6, 1e-4, -2e-4][k]));
        let found = solver.solve(&Condition { prescribed: held, ..base }, None).unwrap();
        for (k, held) in held.into_iter().enumerate() {
            match held {
                Some(d) => assert_eq!(found.displacement[k], d),
                None => assert_eq!(found.load[k], base.load[k]),
            }
        }
        assert!(found.residual < 1e-7, "{mask}: {}", found.residual);
    }
}

/// Zero load with clearance gives zero displacement and stiffness; a load sweep from there converges.
#[test]
fn load_sweep_from_zero() {
    let solver = BearingSolver::new("loose", &rig_6205());
    let loads: Vec<Condition> = (0..20)
        .map(|k| condition([0.0, -50.0 * f64::from(k), 0.0, 0.0, 0.0], CageTreatment::FixedAngle))
        .collect();
    let (found, failure) = solver.sweep(&loads);
    assert!(failure.is_none() && found.len() == 20);
    assert_eq!(found[0].displacement, [0.0; 5]);
    assert_eq!(found[0].condensed_stiffness(&[0.0, 1.0, 0.0, 0.0, 0.0], solver.radius), 0.0);
    assert!(found.windows(2).all(|w| w[1].displacement[1] < w[0].displacement[1]));
    // Contact starts after at least half the diametral clearance.
    assert!(found[1].displacement[1] < -5e-6);
}

/// The map over loads and cage angles is independent of the number of threads and equals single solutions.
#[test]
fn map_equals_single_solutions() {
    let solver = BearingSolver::new("map", &rig_6205());
    let at = |angle: usize, load: usize| Condition {
        cage_angle: 0.03 * angle as f64,
        ..condition([30.0 * load as f64, -60.0 * load as f64, 20.0, 0.0, 0.0], CageTreatment::FixedAngle)
    };
    let rows: Vec<Vec<Condition>> = (0..6).map(|a| (1..6).map(|l| at(a, l)).collect()).collect();
    let map = solver.map(&rows).unwrap();
    let sweeps: Vec<_> = rows.iter().map(|row| solver.sweep(row).0).collect();
    assert_eq!(map, sweeps);
    assert!(map.iter().zip(&rows).all(|(found, row)| found.len() == row.len()));
    let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    assert_eq!(map, alone.install(|| solver.map(&rows)).unwrap());
    for (conditions, found) in rows.iter().zip(&map) {
        for (condition, point) in conditions.iter().zip(found) {
            let single = solver.solve(condition, None).unwrap();
            for k in 0..5 {
                let size = if k > 2 { 1e-3 } else { 1e-5 };
                let error = (single.displacement[k] - point.displacement[k]).abs();
                assert!(error < 1e-9 * size, "{k}: {error}");
            }
        }
    }
}

/// Without an equilibrium the error message gives bearing, load, speed and residual.
#[test]
fn no_equilibrium_error_message() {
    let solver = BearingSolver::new("front", &rig_6205());
    let load = [f64::NAN, 0.0, 0.0, 0.0, 0.0];
    let error =
        solver.solve(&Condition { speed: 104.72, ..condition(load, CageTreatment::FixedAngle) }, None);
    let text = error.unwrap_err().to_string();
    for part in ["bearing front", "NaN", "1000.0 rpm", "residual"] {
        assert!(text.contains(part), "{text}");
    }
}

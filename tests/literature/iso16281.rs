//! Displacements of a deep-groove bearing with the load distribution of ISO/TS 16281, by a commercial
//! program.
//!
//! Axes: its radial load is along our x, its axial load along our z, its tilt ψ in the plane of both is our
//! −θ_y (M_y = −R Σ Q sin α cos ψ_j). Its axial displacements count from the centred bearing and include the
//! axial free play A sin α₀ due to clearance, as ours do. Its ball forces act at half the pitch diameter, as in the
//! standard's moment equation: with the circle of inner groove centres instead the tilts are 1 % smaller.

use crate::bearing::rig_6205;
use rotordyn::analysis::bearing_stiffness::{BearingEquilibrium, BearingSolver, Condition};
use rotordyn::analysis::equilibrium::CageTreatment;
use rotordyn::bearing::{BallBearing, BallGeometry, Service};
use rotordyn::element::Material;
use rotordyn::model::study::BearingStudy;
use rotordyn::results::BearingLife;
use rotordyn::study::single_bearings;
use serde_json::Value;

/// Z = 7, D_w = 11.5 mm, D_pw = 43.5 mm, r_i = 0.52 D_w, r_e = 0.53 D_w, E = 210 GPa.
fn bearing(clearance: f64) -> BallBearing {
    let steel =
        Material { name: "steel".into(), young: 210e9, shear: 210e9 / 2.6, poisson: 0.3, density: 7800.0 };
    BallBearing {
        geometry: BallGeometry {
            balls: 7,
            ball_diameter: 11.5e-3,
            pitch_diameter: 43.5e-3,
            inner_groove_radius: 0.52 * 11.5e-3,
            outer_groove_radius: 0.53 * 11.5e-3,
            radial_clearance: clearance,
            moment_arm: Some(0.5 * 43.5e-3),
            ..rig_6205().geometry
        },
        ball_material: steel.clone(),
        ring_material: steel,
        ..rig_6205()
    }
}

fn loaded(case: &Value) -> BearingEquilibrium {
    let number = |key: &str| case[key].as_f64().unwrap_or(0.0);
    let solver = BearingSolver::new("case", &bearing(1e-3 * number("s_mm")));
    let condition = Condition {
        load: [number("Fr"), 0.0, number("Fa"), 0.0, 1e-3 * number("Mz_Nmm")],
        prescribed: [None; 5],
        speed: 0.0,
        cage: CageTreatment::FixedAngle,
        cage_angle: 0.0,
    };
    solver.solve(&condition, None).unwrap()
}

#[test]
fn displacements_of_the_six_cases() {
    let text = include_str!("../data/iso16281_ball_masta.json");
    let file: Value = serde_json::from_str(text).unwrap();
    let mut compared = 0;
    for case in file["cases"].as_array().unwrap() {
        let found = loaded(case).displacement;
        // Displacements: tolerance for rounding of the listed digits and their contact formulas. Tilt: 1 %,
        // the accuracy of the source's own solution.
        for (key, value, tolerance) in [
            ("dr_um", 1e6 * found[0], 1e-3),
            ("da_um", 1e6 * found[2], 1e-3),
            ("da_um_incl_free_play", 1e6 * found[2], 1e-3),
            ("psi_mrad", 1e3 * found[4].abs(), 1e-2),
        ] {
            if let Some(expected) = case[key].as_f64() {
                let error = value / expected - 1.0;
                println!("{case}: {key} {value:.4} for {expected}, {:.3} %", 100.0 * error);
                assert!(error.abs() < tolerance, "{case}: {key} is {value}");
                compared += 1;
            }
        }
    }
    assert_eq!(compared, 8);
}

/// Axial free play of the unloaded bearing from its geometry: cos α₀ = 1 − s / 2A.
#[test]
fn axial_free_play_under_vanishing_load() {
    let solver = BearingSolver::new("case", &bearing(10e-6));
    let condition = Condition {
        load: [0.0, 0.0, 1e-9, 0.0, 0.0],
        prescribed: [Some(0.0), Some(0.0), None, Some(0.0), Some(0.0)],
        speed: 0.0,
        cage: CageTreatment::FixedAngle,
        cage_angle: 0.0,
    };
    let found = solver.solve(&condition, None).unwrap();
    let a: f64 = 0.05 * 11.5e-3;
    let free_play = a * (1.0 - 0.5 * 10e-6 / a).acos().sin();
    assert!((free_play - 75.66e-6).abs() < 5e-9);
    // (1e-9 N)^(2/3) over the contacts' stiffness is a tenth of a picometre.
    assert!((found.displacement[2] - free_play).abs() < 1e-11, "{}", found.displacement[2] - free_play);
}

/// Lives of a bearing at rest under F_x, F_z \[N\] and M_x \[N m\], without prescribed motions; ball 0 is on the x axis.
fn life(ball: &BallBearing, [f_x, f_z, m_x]: [f64; 3]) -> BearingLife {
    let study = BearingStudy {
        force: Some([f_x, 0.0, f_z]),
        moment: Some([m_x, 0.0]),
        constrained: Some([false; 5]),
        ..BearingStudy::default()
    };
    single_bearings(&[("case".into(), ball.clone())], &study).unwrap()[0].point.life
}

/// L_10r of all cases of the source, C_r = 23.4 kN, for the model as it is: its moment arm is that of the grooves.
#[test]
fn reference_lives_of_the_seven_cases() {
    // Clearance, F_r, F_a, M, L_10r.
    for (clearance, load, expected) in [
        (0.0, [1000.0, 0.0, 0.0], 13163.019),
        (0.0, [0.0, 1000.0, 0.0], 2222.7318),
        (10e-6, [1000.0, 0.0, 0.0], 10795.7948),
        (10e-6, [0.0, 1000.0, 0.0], 3115.8781),
        (10e-6, [1000.0, 1000.0, 0.0], 1630.5367),
        (0.0, [0.0, 0.0, 1.0], 785144.7521),
    ] {
        let ball = bearing(clearance);
        let ball = BallBearing {
            geometry: BallGeometry { moment_arm: None, ..ball.geometry },
            service: Service { dynamic_rating: Some(23.4e3), ..Service::default() },
            ..ball
        };
        let found = life(&ball, load);
        println!("{load:?}: {} for {expected}, by the mechanics {}", found.reference, found.by_ball_loads);
        assert!((found.reference / expected - 1.0).abs() < 2e-3, "{load:?}: {found:?}");
        // The mechanics takes the arm to the groove centres, longer by r_i - D_w/2: as under a smaller moment.
        let arm = 1.0 + 2.0 * (0.52 - 0.5) * 11.5 / 43.5;
        let [f_x, f_z, m_x] = load;
        let by_arm = life(&ball, [f_x, f_z, m_x / arm]).reference;
        if f_x * f_z == 0.0 {
            assert!((found.by_ball_loads / by_arm - 1.0).abs() < 1e-6, "{load:?}: {found:?} {by_arm}");
        }
        assert!(m_x == 0.0 || found.by_ball_loads > 1.02 * found.reference, "{found:?}");
    }
}

/// Pure moment on an even number of balls against a direct solution of the standard's equations, by bisection: with
/// δ_j = √(A² + (R ψ cos φ_j)²) − A, M = D_pw/2 Σ Q_j sin α_j cos φ_j.
#[test]
fn pure_moment_by_bisection() {
    let ball = bearing(0.0);
    let geometry = BallGeometry {
        balls: 14,
        ball_diameter: 7e-3,
        pitch_diameter: 52e-3,
        inner_groove_radius: 0.515 * 7e-3,
        outer_groove_radius: 0.535 * 7e-3,
        moment_arm: None,
        ..ball.geometry
    };
    let ball = BallBearing { geometry, ..ball };
    let hertz = ball.hertz();
    let a: f64 = 0.05 * 7e-3;
    let under = |shift: f64| -> (Vec<f64>, f64) {
        let mut moment = 0.0;
        let loads = (0..14)
            .map(|j| {
                let cos = (std::f64::consts::TAU * f64::from(j) / 14.0).sin();
                let length = a.hypot(shift * cos);
                let load = hertz.series(length - a).load;
                moment += 26e-3 * load * shift * cos / length * cos;
                load
            })
            .collect();
        (loads, moment)
    };
    let (mut low, mut high) = (0.0, 1e-3);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if under(middle).1 < 20.0 { low = middle } else { high = middle }
    }
    let loads = under(low).0;
    let found = life(&ball, [0.0, 0.0, 20.0]);
    let rating = rotordyn::bearing::rating::LoadRating::new(
        &ball.geometry,
        &ball.ball_material,
        &ball.ring_material,
        None,
    );
    let expected = rotordyn::bearing::life::reference_life(
        &ball.geometry,
        rating.dynamic,
        &loads,
        &loads,
        rotordyn::contact::Race::Inner,
    );
    assert!((found.reference / expected.life - 1.0).abs() < 1e-8, "{found:?} {expected:?}");
    assert!((found.reference_load / expected.load - 1.0).abs() < 1e-8);
}

/// Opposed pairs without preload under a radial load: the rows carry half each with ε = 0.5, the distribution on which C
/// rests, so that L_10r is L_10 = (C/P)³ with the ratings of the pair; P and s_0 of the pair exist.
#[test]
fn opposed_pairs_under_radial_load() {
    use rotordyn::bearing::{Arrangement, Duplex};
    for (degrees, arrangement) in [(15.0f64, Arrangement::BackToBack), (25.0, Arrangement::FaceToFace)] {
        let single = bearing(0.0);
        let geometry = BallGeometry {
            balls: 17,
            ball_diameter: 9e-3,
            pitch_diameter: 62e-3,
            inner_groove_radius: 0.52 * 9e-3,
            outer_groove_radius: 0.53 * 9e-3,
            contact_angle: degrees.to_radians(),
            moment_arm: None,
            ..single.geometry.clone()
        };
        let pair =
            BallBearing { geometry, duplex: Some(Duplex { arrangement, spacing: 16e-3 }), ..single.clone() };
        let study = BearingStudy {
            force: Some([0.0, -3000.0, 0.0]),
            constrained: Some([false, false, false, true, true]),
            ..BearingStudy::default()
        };
        let found = &single_bearings(&[("pair".into(), pair)], &study).unwrap()[0];
        let life = &found.point.life;
        assert_eq!(life.equivalent_load, 3000.0);
        assert!((life.basic - (found.rating.dynamic / 3000.0).powi(3)).abs() < 1e-9 * life.basic);
        assert!((life.static_safety - found.rating.static_rating / 3000.0).abs() < 1e-9);
        println!("{degrees} deg: L_10r {} for L_10 {}", life.reference, life.basic);
        // Ball loads go with 1/cos α, the ratings of ISO 281 with cos^0.7 α: L_10r/L_10 ~ cos^0.9 α.
        let expected = life.basic * degrees.to_radians().cos().powf(0.9);
        assert!((life.reference / expected - 1.0).abs() < 0.03, "{life:?}");
    }
}

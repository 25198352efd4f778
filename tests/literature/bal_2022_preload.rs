//! Bal 2022: two preloaded FAG 7206 on a rigid shaft compared with an independent program for the same model
//! (tests/data/bal_2022.json, whose `meta` states its conventions: moment arm D_pw/2, A = r_i + r_o − D_w).
//!
//! The centre of mass is midway between two equal, opposed bearings, so that gravity displaces the shaft
//! radially only and each bearing carries half of it. The paper's x points down; here gravity acts along +x.

use crate::agree;
use crate::ross::{number, numbers, read};
use rotordyn::bearing::{BallBearing, BallElement, BallGeometry, BallInertia, Cage, Fit, Preload, Rotation};
use rotordyn::contact::{ContactDamping, ContactLaw, Lubricant};
use rotordyn::element::Material;

const BALL: f64 = 0.009528;
const PITCH: f64 = 0.046;
const MASS: f64 = 4.8;

fn bearing(contact: ContactLaw, preload: Preload) -> BallElement {
    let steel =
        Material { name: "steel".into(), young: 200e9, shear: 200e9 / 2.6, poisson: 0.3, density: 7850.0 };
    BallElement::new(&BallBearing {
        geometry: BallGeometry {
            balls: 13,
            ball_diameter: BALL,
            pitch_diameter: PITCH,
            inner_groove_radius: 0.004876,
            outer_groove_radius: 0.005057,
            radial_clearance: 0.0,
            contact_angle: 40f64.to_radians(),
            thrust_direction: 1.0,
            moment_arm: Some(0.5 * PITCH),
            bore: 30e-3,
            outside_diameter: 62e-3,
            width: 16e-3,
        },
        ball_material: steel.clone(),
        ring_material: steel,
        contact,
        contact_stiffness: Default::default(),
        damping: ContactDamping::Constant { coefficient: 200.0, ramp: 1e-9 },
        inertia: BallInertia::None,
        preload,
        duplex: None,
        fit: Fit::default(),
        cage: Cage::Rolling,
        cage_angle: 0.0,
        imperfections: Default::default(),
        cage_pocket_diameter: 9.7e-3,
        service: Default::default(),
        estimated_geometry: None,
    })
}

fn film_law() -> ContactLaw {
    let lubricant =
        Lubricant { name: "oil".into(), viscosity: 0.04, pressure_viscosity: 2.3e-8, density: 870.0 };
    ContactLaw::Film { lubricant, speed_factor: 1.0 }
}

fn rotation_at(rpm: f64, cage_angle: f64) -> Rotation {
    Rotation { shaft_speed: rpm * std::f64::consts::PI / 30.0, cage_angle, ..Rotation::default() }
}

/// Radial displacement at which one bearing carries half of the shaft.
fn under_gravity(element: &BallElement, rotation: &Rotation) -> [f64; 6] {
    let mut d = [0.0; 6];
    for _ in 0..60 {
        let r = element.reaction(&d, &[0.0; 6], rotation);
        d[0] += (0.5 * MASS * 9.81 + r.force[0]) / r.stiffness[0][0];
    }
    d
}

#[track_caller]
fn near(value: f64, reference: f64, tolerance: f64, what: &str) {
    agree::absolute(format_args!("{what}"), value, reference, tolerance * reference.abs());
}

/// All states of one speed and kind of preload.
fn check(set: &str, rpm: f64, contact: &ContactLaw, preload: impl Fn(f64) -> Preload) {
    let data = &read("bal_2022.json")["static"][set];
    let states = data.as_array().expect("states");
    assert_eq!(states.len(), 4);
    for state in states {
        let value = |key: &str| number(&state[key]);
        let element = bearing(contact.clone(), preload(value("Pr")));
        let rotation = rotation_at(rpm, 0.0);
        let what = |key: &str| format!("{set} {} N, {key}", value("Pr"));
        let found = element.preload_state(rotation.shaft_speed);
        near(found.offset, value("d0_axial_m"), 1e-6, &what("offset"));
        near(found.axial_force, value("axial_force_N"), 1e-6, &what("axial force"));
        let ball = element.ball_loads(&[0.0; 6], &rotation)[0];
        near(ball.deflection, value("delta_normal_m"), 1e-6, &what("approach"));
        near(ball.load, value("F_ball_N"), 1e-6, &what("ball load"));
        let angle = ball.contact_angle.to_degrees();
        agree::absolute(format_args!("{}", what("angle")), angle, value("alpha_deg"), 1e-6);
        if !state["h_inner_m"].is_null() {
            near(ball.film[0], value("h_inner_m"), 1e-6, &what("inner film"));
            near(ball.film[1], value("h_outer_m"), 1e-6, &what("outer film"));
        }
        let k = element.reaction(&[0.0; 6], &[0.0; 6], &rotation).stiffness;
        near(k[0][0], value("bearing_kxx"), 1e-6, &what("k_xx"));
        near(k[2][2], value("bearing_kzz"), 1e-6, &what("k_zz"));
        near(-k[0][4], value("bearing_kxphi"), 1e-6, &what("k_xphi"));
        near(k[4][4], value("bearing_kphiphi"), 1e-6, &what("k_phiphi"));
        let hertz = |stiffness: f64| (2.0 * stiffness / MASS).sqrt() / std::f64::consts::TAU;
        near(hertz(k[0][0]), value("f_trans_xy_Hz"), 1e-6, &what("radial frequency"));
        near(hertz(k[2][2]), value("f_axial_Hz"), 1e-6, &what("axial frequency"));

        let d = under_gravity(&element, &rotation);
        let k = element.reaction(&d, &[0.0; 6], &rotation).stiffness;
        near(d[0], value("gravity_x_m"), 1e-4, &what("sag"));
        near(2.0 * k[0][0], value("gravity_kxx_total"), 1e-4, &what("k_xx under gravity"));
        near(2.0 * k[1][1], value("gravity_kyy_total"), 1e-4, &what("k_yy under gravity"));
        let balls = element.ball_loads(&d, &rotation);
        let most = balls.iter().fold(0.0, |m: f64, b| m.max(b.load));
        let least = balls.iter().fold(most, |m: f64, b| m.min(b.load));
        near(most, value("gravity_F_ball_max"), 1e-4, &what("largest ball load"));
        agree::absolute(
            format_args!("{}", what("least ball load")),
            least,
            value("gravity_F_ball_min"),
            1e-4 * most,
        );
    }
}

#[test]
fn dry_states() {
    check("dry", 0.0, &ContactLaw::Hertz, Preload::DryForce);
}

#[test]
fn states_with_film_at_a_preload_force() {
    for rpm in [1000, 1400, 2000, 2800, 5000] {
        check(&format!("ehl_force_{rpm}"), f64::from(rpm), &film_law(), Preload::Force);
    }
}

#[test]
fn states_with_film_at_a_dry_interference() {
    for rpm in [1000, 1400, 2000, 2800, 5000] {
        check(&format!("ehl_disp_{rpm}"), f64::from(rpm), &film_law(), Preload::DryForce);
    }
}

#[test]
fn matrices_at_150_newton() {
    let data = &read("bal_2022.json")["K5_Pr150"];
    // Angles φ, ψ of the paper are −θ_y, θ_x.
    let map = [(0, 1.0), (1, 1.0), (2, 1.0), (4, -1.0), (3, 1.0)];
    for (key, rpm, contact, preload) in [
        ("dry", 0.0, ContactLaw::Hertz, Preload::DryForce(150.0)),
        ("ehl_2800_force", 2800.0, film_law(), Preload::Force(150.0)),
    ] {
        let k = bearing(contact, preload).reaction(&[0.0; 6], &[0.0; 6], &rotation_at(rpm, 0.0)).stiffness;
        for (a, (i, si)) in map.into_iter().enumerate() {
            for (b, (expected, (j, sj))) in numbers(&data[key][a]).into_iter().zip(map).enumerate() {
                let size = (k[i][i] * k[j][j]).sqrt();
                agree::absolute(format_args!("{key} K[{a}][{b}]"), si * sj * k[i][j], expected, 1e-8 * size);
            }
        }
    }
}

#[test]
fn contact_is_lost_below_the_critical_preload() {
    // Worst case with a ball opposite to gravity; the cage angle is scanned over a ball pitch.
    let least = |preload: f64| {
        let element = bearing(ContactLaw::Hertz, Preload::DryForce(preload));
        (0..26)
            .map(|k| {
                let rotation = rotation_at(0.0, std::f64::consts::TAU * f64::from(k) / (26.0 * 13.0));
                let d = under_gravity(&element, &rotation);
                element.ball_loads(&d, &rotation).iter().fold(f64::MAX, |m, b| m.min(b.deflection))
            })
            .fold(f64::MAX, f64::min)
    };
    let (mut low, mut high) = (20.0, 35.0);
    for _ in 0..30 {
        let middle = 0.5 * (low + high);
        if least(middle) > 0.0 { high = middle } else { low = middle }
    }
    near(high, number(&read("bal_2022.json")["Pcrit_dry_N"]["value"]), 1e-3, "critical preload");
}

#[test]
fn printed_frequencies_follow_from_dry_interference_plus_film() {
    let frequency = |preload: Preload| {
        let k = bearing(film_law(), preload)
            .reaction(&[0.0; 6], &[0.0; 6], &rotation_at(1400.0, 0.0))
            .stiffness[0][0];
        (2.0 * k / MASS).sqrt() / std::f64::consts::TAU
    };
    let (low, high) = (frequency(Preload::DryForce(50.0)), frequency(Preload::DryForce(150.0)));
    near(low, 833.1, 0.015, "50 N");
    near(high, 918.5, 0.015, "150 N");
    // The paper's ratio is 1.1025; at constant preload force it rises as the sixth root (dry), more with a
    // film.
    assert!((1.08..1.13).contains(&(high / low)));
    let ratio = frequency(Preload::Force(150.0)) / frequency(Preload::Force(50.0));
    assert!((1.19..1.28).contains(&ratio), "{ratio}");
}

#[test]
fn film_falls_and_angle_rises_with_preload() {
    let mut before = None;
    for preload in [20.0, 50.0, 100.0, 150.0, 200.0, 400.0] {
        let element = bearing(film_law(), Preload::Force(preload));
        let ball = element.ball_loads(&[0.0; 6], &rotation_at(2800.0, 0.0))[0];
        if let Some((film, angle)) = before {
            assert!(ball.film[0] < film && ball.contact_angle > angle);
        }
        before = Some((ball.film[0], ball.contact_angle));
    }
}

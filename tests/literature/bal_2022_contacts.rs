//! Bal 2022: contacts and films of the FAG 7206 compared with an independent program for the same model
//! (tests/data/bal_2022.json; its `meta` states the formulas).

use crate::agree;
use crate::ross::{number, read};
use rotordyn::contact::{BallContacts, ContactLaw, FilmFormula, HertzPair, Lubricant, Race};
use rotordyn::element::Material;

const BALL: f64 = 0.009528;
const PITCH: f64 = 0.046;

fn pair() -> HertzPair {
    let steel =
        Material { name: "steel".into(), young: 200e9, shear: 200e9 / 2.6, poisson: 0.3, density: 7850.0 };
    HertzPair::new(BALL, PITCH, [0.004876, 0.005057], 40f64.to_radians(), &steel, &steel)
}

fn oil() -> Lubricant {
    Lubricant { name: "oil".into(), viscosity: 0.04, pressure_viscosity: 2.3e-8, density: 870.0 }
}

/// Entrainment u = (D_pw/4) Ω (1 − γ²) at a speed in rpm.
fn entrainment(rpm: f64) -> f64 {
    let gamma = BALL * 40f64.to_radians().cos() / PITCH;
    0.25 * PITCH * rpm * std::f64::consts::PI / 30.0 * (1.0 - gamma * gamma)
}

#[track_caller]
fn near(value: f64, reference: f64, tolerance: f64, what: &str) {
    agree::relative(format_args!("{what}"), value, reference, tolerance);
}

#[test]
fn hertz_constants() {
    let data = read("bal_2022.json");
    let pair = pair();
    for (contact, name) in [(&pair.inner, "inner"), (&pair.outer, "outer")] {
        let reference = &data["hertz"][name];
        near(contact.rolling_radius, number(&reference["Rx"]), 1e-12, "R_x");
        near(contact.transverse_radius, number(&reference["Ry"]), 1e-12, "R_y");
        near(contact.curvature_sum, number(&reference["S"]), 1e-12, "curvature sum");
        near(contact.ratio, number(&reference["kappa"]), 1e-9, "ellipse ratio");
        near(contact.stiffness, number(&reference["Kc"]), 1e-9, "K");
    }
    near(pair.stiffness, number(&data["hertz"]["K_series"]), 1e-9, "K in series");
}

#[test]
fn film_and_load_of_all_lubricated_states() {
    let data = read("bal_2022.json");
    let contacts = BallContacts::new(pair(), ContactLaw::Film { lubricant: oil(), speed_factor: 1.0 });
    let mut states = 0;
    for (name, list) in data["static"].as_object().unwrap() {
        let Some(rpm) = name.strip_prefix("ehl_force_").or(name.strip_prefix("ehl_disp_")) else {
            continue;
        };
        let running = contacts.at_speed(entrainment(rpm.parse().unwrap()));
        for state in list.as_array().unwrap() {
            let load = number(&state["F_ball_N"]);
            let solved = running.series(number(&state["delta_normal_m"]));
            near(solved.load, load, 1e-9, "load of the pair");
            for (race, key) in [(Race::Inner, "h_inner_m"), (Race::Outer, "h_outer_m")] {
                near(running.film(race, load), number(&state[key]), 1e-9, key);
                assert!(running.minimum_film(race, load) < running.film(race, load));
            }
            states += 1;
        }
    }
    assert!(states >= 40, "{states} states");
}

#[test]
fn approaches_of_both_races_sum_to_that_of_the_pair() {
    let contacts = BallContacts::new(pair(), ContactLaw::Film { lubricant: oil(), speed_factor: 0.5 });
    let running = contacts.at_speed(2.0 * entrainment(1400.0));
    for load in [2e-4, 1e-2, 2.0, 300.0] {
        // Approach of each race alone under the load, by its definition d_c = (Q/K_c)^(2/3) - h_c(Q).
        let approach = |race, stiffness: f64| (load / stiffness).powf(2.0 / 3.0) - running.film(race, load);
        let inner = approach(Race::Inner, pair().inner.stiffness);
        let outer = approach(Race::Outer, pair().outer.stiffness);
        near(running.single(Race::Inner, inner).load, load, 1e-8, "inner");
        near(running.single(Race::Outer, outer).load, load, 1e-8, "outer");
        near(running.series(inner + outer).load, load, 1e-8, "series");
    }
    // A speed factor of one half at twice the speed is the plain law.
    let plain = BallContacts::new(pair(), ContactLaw::Film { lubricant: oil(), speed_factor: 1.0 });
    assert_eq!(plain.at_speed(entrainment(1400.0)).series(1e-6), running.series(1e-6));
}

#[test]
fn minimum_film_equals_the_printed_formula() {
    let contact = pair().inner;
    let (load, speed) = (15.0, 1.2);
    let modulus = 200e9 / (1.0 - 0.09);
    let r = contact.rolling_radius;
    let u: f64 = 0.04 * speed / (modulus * r);
    let g: f64 = 2.3e-8 * modulus;
    let w: f64 = load / (modulus * r * r);
    let printed =
        3.63 * u.powf(0.68) * g.powf(0.49) * w.powf(-0.073) * (1.0 - (-0.68 * contact.ratio).exp()) * r;
    near(FilmFormula::new(&contact, &oil()).minimum(speed, load), printed, 1e-12, "h_min");
}

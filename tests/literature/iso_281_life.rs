//! Load ratings and lives compared with ISO 281 tables, catalogues and a commercial program for ISO/TS 16281.

use crate::agree;
use crate::bearing::{rig_6205, steel};
use rotordyn::bearing::BallGeometry;
use rotordyn::bearing::life::{
    basic_life, combined_life, hours, life_modification, reference_life, reference_viscosity,
    reliability_factor,
};
use rotordyn::bearing::rating::LoadRating;
use rotordyn::contact::{HertzPair, Race};
use rotordyn::element::Material;

fn pair(g: &BallGeometry, steel: &Material) -> HertzPair {
    let grooves = [g.inner_groove_radius, g.outer_groove_radius];
    HertzPair::new(g.ball_diameter, g.pitch_diameter, grooves, g.contact_angle, steel, steel)
}

/// A bearing of given balls, pitch diameter \[mm\], grooves over ball diameter and contact angle \[°\].
pub fn bearing(balls: usize, ball: f64, pitch: f64, grooves: [f64; 2], angle: f64) -> BallGeometry {
    BallGeometry {
        balls,
        ball_diameter: ball * 1e-3,
        pitch_diameter: pitch * 1e-3,
        inner_groove_radius: grooves[0] * ball * 1e-3,
        outer_groove_radius: grooves[1] * ball * 1e-3,
        radial_clearance: 0.0,
        contact_angle: angle.to_radians(),
        ..rig_6205().geometry
    }
}

/// Ratings of a single row of bearing steel.
pub fn rating(g: &BallGeometry) -> LoadRating {
    LoadRating::new(g, &steel(), &steel(), None)
}

#[test]
fn factor_f_c_of_table_2() {
    // One ball of 1 mm: C = 1.3 f_c.
    let table = [
        (0.05, 46.7),
        (0.06, 49.1),
        (0.07, 51.1),
        (0.08, 52.8),
        (0.09, 54.3),
        (0.10, 55.5),
        (0.12, 57.5),
        (0.14, 58.8),
        (0.16, 59.6),
        (0.18, 59.9),
        (0.20, 59.9),
        (0.22, 59.6),
        (0.24, 59.0),
        (0.26, 58.2),
        (0.28, 57.1),
        (0.30, 56.0),
        (0.32, 54.6),
        (0.34, 53.2),
        (0.36, 51.7),
        (0.38, 50.0),
        (0.40, 48.4),
    ];
    for (gamma, factor) in table {
        for grooves in [[0.52, 0.53], [0.505, 0.515]] {
            let g = bearing(1, 1.0, 1.0 / gamma, grooves, 0.0);
            let here = rating(&g).dynamic / 1.3;
            agree::absolute(format_args!("f_c at γ = {gamma}"), here, factor, 0.11);
        }
    }
    let (gammas, factors): (Vec<f64>, Vec<f64>) = table.into_iter().unzip();
    let ours = |gamma: &f64| rating(&bearing(1, 1.0, 1.0 / gamma, [0.52, 0.53], 0.0)).dynamic / 1.3;
    let ours: Vec<f64> = gammas.iter().map(ours).collect();
    let over = agree::Over { name: "D_w cos α/D_pw", unit: "1", values: &gammas };
    agree::curves("f_c of table 2", "1", over, &ours, &factors, 2e-3);
}

#[test]
fn basic_life_and_life_modification_factor() {
    agree::absolute("basic life at a tenth of C", basic_life(14e3, 1400.0), 1000.0, 1e-9);
    assert!(basic_life(14e3, 0.0).is_infinite());
    // 1000 million revolutions at 1000 rpm.
    agree::absolute(
        "hours of 1000 million revolutions",
        hours(1000.0, 1000.0 * std::f64::consts::PI / 30.0),
        1e9 / 6e4,
        1e-6,
    );
    let rpm = |n: f64| n * std::f64::consts::PI / 30.0;
    // ν₁ = 4500/√(1500 · 50) mm²/s.
    agree::absolute(
        "reference viscosity at 1500 rpm [mm²/s]",
        reference_viscosity(0.05, rpm(1500.0)) * 1e6,
        4500.0 / 75_000f64.sqrt(),
        1e-9,
    );
    agree::absolute(
        "reference viscosity at 500 rpm [mm²/s]",
        reference_viscosity(0.05, rpm(500.0)) * 1e6,
        45_000.0 * 500f64.powf(-0.83) / 50f64.sqrt(),
        1e-9,
    );
    let a = |kappa: f64, ratio: f64| life_modification(kappa, 1.0, ratio, 1.0).unwrap();
    // The branches are continuous, to the digits of their constants.
    for kappa in [0.4, 1.0] {
        agree::relative("a_ISO is continuous in κ", a(kappa - 1e-9, 0.5), a(kappa + 1e-9, 0.5), 2e-3);
    }
    // Limits: 0.1 under severe contamination, at most 50, constant above κ = 4, undefined below κ = 0.1.
    agree::absolute(
        "a_ISO without lubrication",
        life_modification(2.0, 0.0, 500.0, 1000.0).unwrap(),
        0.1,
        1e-12,
    );
    assert_eq!(a(4.0, 2.0), 50.0);
    assert_eq!(a(4.0, 0.2), a(9.0, 0.2));
    assert!(life_modification(0.09, 0.5, 500.0, 1000.0).is_none());
    assert!(life_modification(f64::NAN, 0.5, 500.0, 1000.0).is_none());
    // By hand: κ = 1, e_C C_u/P = 0.1: (2.5671 − 1.9987)^0.83 = 0.62567, times 0.46416 is 0.29041.
    agree::absolute("a_ISO at κ = 1", a(1.0, 0.1), 0.1 * (1.0f64 - 0.29041).powf(-9.3), 1e-3);
    for (before, after) in [(0.1, 0.2), (0.5, 0.9), (1.0, 3.0)] {
        assert!(a(before, 0.3) < a(after, 0.3));
    }
    assert_eq!(reliability_factor(0.9), 1.0);
    agree::absolute("reliability factor of 99 %", reliability_factor(0.99), 0.25, 1e-12);
}

#[test]
fn reference_lives_of_a_commercial_program() {
    // Z = 7, D_w = 11.5 mm, D_pw = 43.5 mm, r_i = 0.52 D_w, r_e = 0.53 D_w, E = 210 GPa, C_r = 23.4 kN:
    // displacement and L_10r under 1000 N by the same program as tests/data/iso16281_ball_masta.json (ball 0
    // under the load).
    let g = bearing(7, 11.5, 43.5, [0.52, 0.53], 0.0);
    let steel = Material { young: 210e9, ..steel() };
    let pair = pair(&g, &steel);
    let a = g.inner_groove_radius + g.outer_groove_radius - g.ball_diameter;
    let angle = |j: usize| std::f64::consts::TAU * j as f64 / 7.0;
    let loads = |radial: f64, axial: f64, clearance: f64| -> (Vec<f64>, [f64; 2]) {
        let mut sum = [0.0; 2];
        let loads = (0..7)
            .map(|j| {
                let s = [a - 0.5 * clearance + radial * angle(j).cos(), axial];
                let length = s[0].hypot(s[1]);
                let load = pair.series(length - a).load;
                sum[0] += load * s[0] / length * angle(j).cos();
                sum[1] += load * s[1] / length;
                load
            })
            .collect();
        (loads, sum)
    };
    let cases: [([f64; 2], f64, [f64; 2], f64); 4] = [
        ([15.1101e-6, 0.0], 0.0, [1000.0, 0.0], 13163.019),
        ([0.0, 133.5381e-6], 0.0, [0.0, 1000.0], 2222.7318),
        ([21.223e-6, 0.0], 10e-6, [1000.0, 0.0], 10795.7948),
        ([0.0, 149.1717e-6], 10e-6, [0.0, 1000.0], 3115.8781),
    ];
    for ([radial, axial], clearance, force, life) in cases {
        let (loads, sum) = loads(radial, axial, clearance);
        // The rounded displacement gives the load to a few thousandths; the life is that of exactly 1000 N.
        let off = force[0].hypot(force[1]) / sum[0].hypot(sum[1]);
        agree::absolute("load of the displacement over 1000 N", off, 1.0, 3e-3);
        let loads: Vec<f64> = loads.iter().map(|q| q * off).collect();
        let here = reference_life(&g, 23.4e3, &loads, &loads, Race::Inner);
        agree::relative("life in the example", here.life, life, 2e-3);
        agree::absolute("load in the example [N]", here.load, 23.4e3 / here.life.cbrt(), 1e-9);
    }
}

#[test]
fn reference_life_and_basic_life() {
    // Pure radial load, no clearance: the load distribution for which C_r is defined.
    let g = bearing(9, 7.938, 38.5, [0.52, 0.53], 0.0);
    let rigid = |j: usize| {
        let angle = std::f64::consts::TAU * (j as f64 + 0.1) / 9.0;
        angle.cos().max(0.0).powf(1.5)
    };
    let shape: Vec<f64> = (0..9).map(rigid).collect();
    let sum: f64 = (0..9).map(|j| rigid(j) * (std::f64::consts::TAU * (j as f64 + 0.1) / 9.0).cos()).sum();
    let under = |load: f64| -> Vec<f64> { shape.iter().map(|q| q * load / sum).collect() };
    let life = |load: f64| reference_life(&g, 14e3, &under(load), &under(load), Race::Inner).life;
    agree::relative("reference life at 1 kN", life(1000.0), basic_life(14e3, 1000.0), 0.05);
    // L ~ P⁻³, and a rotating outer ring shortens the life of the stationary inner ring.
    agree::absolute("life over load: third power", life(2000.0) / life(1000.0), 0.125, 1e-12);
    let outer = reference_life(&g, 14e3, &under(1000.0), &under(1000.0), Race::Outer);
    assert!(outer.life < life(1000.0));
    assert!(reference_life(&g, 14e3, &[0.0; 9], &[0.0; 9], Race::Inner).life.is_infinite());
    // The life of two equal rows is 2^-0.9 of that of one.
    agree::absolute("life of two bearings", combined_life(&[100.0, 100.0]), 100.0 * 2f64.powf(-0.9), 1e-10);
}

/// L_nmr of a 6205 with the ratings of a catalogue, C 14.0 kN and C_u 335 N, under 1400 N at 6000 rpm in ISO VG 68 at 60 degC:
/// 6111 million revolutions by an independent evaluation, with clearance CN, e_C 0.5, kappa 3.03.
#[test]
fn modified_life_of_a_6205() {
    let text = "[model]\nname = \"b\"\n[lubricant.oil]\ngrade = \"ISO VG 68\"\ntemperature = \"60 degC\"\n[bearing.b]\n\
        model = \"ball\"\ndesignation = \"6205\"\nlubricant = \"oil\"\ndynamic_rating = \"14 kN\"\n\
        fatigue_limit = \"335 N\"\n[study.bearing]\nload = \"0, -1400, 0 N\"\nspeed = \"6000 rpm\"\n";
    let file = rotordyn::model::load_bearings("b.toml", text, &Default::default()).unwrap();
    let study = file.studies.bearing.clone().unwrap_or_default();
    let found = rotordyn::study::single_bearings(&file.bearings, &study).unwrap().remove(0);
    let life = &found.point.life;
    println!("{life:?}");
    // By hand: kappa = 28.3/(4500/√(6000 · 38.5)), (e_C C_u/P_ref)^{1/3}.
    let kappa = life.viscosity_ratio;
    let share = (0.5 * 335.0 / life.reference_load).cbrt();
    let stress = 1.0 - (2.5671 - 1.9987 * kappa.powf(-0.071739)).powf(0.83) * share;
    let by_hand = 0.1 * stress.powf(-9.3) * (14e3 / life.reference_load).powi(3);
    agree::relative("modified life", life.modified, by_hand, 1e-9);
    agree::relative("modified life, printed", life.modified, 6111.0, 2e-3);
}

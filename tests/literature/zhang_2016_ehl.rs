//! Zhang 2016: mutual approach of ball and races with the numerical EHL film, at two speeds.
//!
//! The paper gives fits Q_i = K δⁿ + ΔQ over Q_i = 600-2000 N, δ = δ_i(Q_i) + δ_o(Q_i + F_r) (eq. 9 and 11).
//! Its own rows of Table 2 do not follow from the stated entrainment speeds, u_r = 10 and 30 m/s, but from
//! u_r/(2π); so both are compared with the fits of an independent full solution of the same contacts.

use crate::agree;
use crate::lubricated::steel;
use rotordyn::contact::ehl::{Grid, Problem, extrapolate};
use rotordyn::contact::{EllipticContact, Lubricant};
use std::f64::consts::TAU;

/// Table 1: races of 48 and 82 mm, ball 17 mm, grooves of 0.54 ball diameters; oil of 0.096 Pa s and 1.82e-8
/// 1/Pa.
fn contacts() -> [EllipticContact; 2] {
    let ball = 17e-3;
    let across = 2.0 / ball - 1.0 / (0.54 * ball);
    [2.0 / 48e-3, -2.0 / 82e-3]
        .map(|race| EllipticContact::new(2.0 / ball + race, across, [&steel(2.07e11), &steel(2.07e11)]))
}

fn oil() -> Lubricant {
    Lubricant { name: "oil".into(), viscosity: 0.096, pressure_viscosity: 1.82e-8, density: 870.0 }
}

/// Approach of both contacts, and the ratio of each central film to Hamrock and Dowson's.
fn solved(speed: f64, load: f64, centrifugal: f64) -> (f64, [f64; 2]) {
    let mut approach = 0.0;
    let loads = [load, load + centrifugal];
    let ratios = [0, 1].map(|race| {
        let (contact, load) = (contacts()[race], loads[race]);
        let grid = Grid::flooded(&contact, &oil(), speed, load, 5);
        let found = extrapolate(&Problem { contact, lubricant: oil(), speed, load, grid }, None).unwrap();
        approach += found.approach;
        let (radius, modulus) = (contact.rolling_radius, 2.0 * contact.modulus);
        let velocity = 0.096 * speed / (modulus * radius);
        let force = load / (modulus * radius * radius);
        let hamrock_dowson = 2.69 * radius * velocity.powf(0.67) * (1.82e-8 * modulus).powf(0.53)
            / force.powf(0.067)
            * (1.0 - 0.61 * (-0.73 * contact.ratio).exp());
        found.central_film / hamrock_dowson
    });
    (approach, ratios)
}

/// (K, n, ΔQ) at 10 and 30 m/s with centrifugal loads of 40 and 354 N.
fn compare(factor: f64, fits: [[f64; 3]; 2]) -> Vec<f64> {
    let mut films = Vec::new();
    for ((rolling, centrifugal), [stiffness, exponent, offset]) in
        [(10.0, 40.0), (30.0, 354.0)].into_iter().zip(fits)
    {
        for load in [600.0, 1000.0, 2000.0] {
            let (approach, ratios) = solved(factor * rolling, load, centrifugal);
            let fit = ((load - offset) / stiffness).powf(1.0 / exponent);
            let error = approach / fit - 1.0;
            eprintln!(
                "{rolling} m/s x {factor:.3}, {load} N: {:.4} um, {error:+.4}, films {ratios:.3?}",
                approach * 1e6
            );
            // At 30 m/s and 600 N the film takes more than half of the approach, and the width of the domain counts:
            // -1.9 % here, -2.2 % with twice the nodes, another -1.8 % in a domain 1.5 times as wide; the reference
            // does not state its domain. All other cases are within 1 %.
            let limit = if factor * rolling > 20.0 && load < 700.0 { 0.025 } else { 0.015 };
            agree::relative(
                format_args!("{rolling} m/s x {factor:.3}, {load} N: approach [m]"),
                approach,
                fit,
                limit,
            );
            films.extend(ratios);
        }
    }
    films
}

#[test]
fn approach_at_the_rolling_speed() {
    let films = compare(
        1.0,
        [
            [4_675_448_803.976_562_5, 1.410_098_675_819_867_7, 160.378_563_337],
            [2_149_116_294.166_316_5, 1.325_466_932_481_948_4, 235.445_821_058],
        ],
    );
    for ratio in films {
        agree::absolute("central film over the formula of Hamrock and Dowson", ratio, 1.0, 0.1);
    }
}

#[test]
fn approach_at_the_rolling_speed_over_two_pi() {
    compare(1.0 / TAU, [[8.73e9, 1.4775, 34.5], [7.61e9, 1.462, -42.5]]);
}

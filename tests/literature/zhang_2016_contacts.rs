//! Zhang 2016: the dry contacts of the bearing and the power laws fitted to them, compared with an
//! independent program (tests/data/zhang_2016.json).

use crate::agree;
use crate::ross::{number, numbers, read};
use rotordyn::contact::{HertzPair, fit_power_law};
use rotordyn::element::Material;

fn pair() -> HertzPair {
    let steel =
        Material { name: "steel".into(), young: 207e9, shear: 207e9 / 2.6, poisson: 0.3, density: 7850.0 };
    HertzPair::new(0.017, 0.065, [0.00918, 0.00918], 0.0, &steel, &steel)
}

/// Dry approach under an inner load Q with the ball's centrifugal force on the outer race.
fn approach(pair: &HertzPair, load: f64, centrifugal: f64) -> f64 {
    pair.inner.patch(load).deflection + pair.outer.patch(load + centrifugal).deflection
}

#[test]
fn dry_contacts() {
    let data = read("zhang_2016.json");
    let dry = &data["zhang_dry"];
    let pair = pair();
    let checks =
        [(pair.inner.stiffness, "K_inner"), (pair.outer.stiffness, "K_outer"), (pair.stiffness, "K_total")];
    for (value, name) in checks {
        agree::relative(format_args!("{name}"), value, number(&dry[name]), 1e-9);
    }
    for (contact, name) in [(&pair.inner, "inner"), (&pair.outer, "outer")] {
        let (patch, reference) = (contact.patch(1000.0), &dry["hertz_at_1000N"][name]);
        let checks = [
            (patch.semi_minor, "ax"),
            (patch.semi_major, "ay"),
            (patch.maximum_pressure, "p0"),
            (patch.deflection, "delta"),
            (contact.ratio, "k"),
        ];
        for (value, key) in checks {
            agree::relative(format_args!("{name} {key}"), value, number(&reference[key]), 1e-9);
        }
    }
}

#[test]
fn fits_over_29_loads() {
    let data = read("zhang_2016.json");
    let pair = pair();
    let loads: Vec<f64> = (0..29).map(|k| 600.0 + 50.0 * f64::from(k)).collect();
    for (centrifugal, reference) in data["zhang_dry"]["fits_29pts_600_2000N"].as_object().unwrap() {
        let force: f64 = centrifugal.parse().unwrap();
        let approaches: Vec<f64> = loads.iter().map(|q| approach(&pair, *q, force)).collect();
        let fit = fit_power_law(&loads, &approaches).unwrap();
        // Two of the centrifugal forces, 38.6678 and 348.01 N, are rounded in the reference.
        let tight = if force.fract() == 0.0 { 1.0 } else { 1e3 };
        agree::relative(
            format_args!("fitted K, centrifugal force {centrifugal} N"),
            fit.stiffness,
            number(&reference["K"]),
            1e-8 * tight,
        );
        agree::absolute(
            format_args!("fitted exponent, centrifugal force {centrifugal} N"),
            fit.exponent,
            number(&reference["n"]),
            1e-9 * tight,
        );
        agree::absolute(
            format_args!("fitted offset, centrifugal force {centrifugal} N"),
            fit.offset,
            number(&reference["dQ"]),
            1e-6 * tight,
        );
        let worst = loads
            .iter()
            .zip(&approaches)
            .map(|(q, d)| (fit.stiffness * d.powf(fit.exponent) + fit.offset - q).abs())
            .fold(0.0, f64::max);
        assert!(worst < 1.001 * number(&reference["maxerrN"]) + 1e-6, "{centrifugal}: {worst}");
        for (load, d) in reference["delta_um"].as_object().unwrap() {
            let here = approach(&pair, load.parse().unwrap(), force);
            agree::relative(
                format_args!("approach, centrifugal force {centrifugal} N [um]"),
                here * 1e6,
                number(d),
                1e-9 * tight,
            );
        }
    }
}

#[test]
fn printed_dry_rows_of_table_2() {
    // With the printed centrifugal forces of 40 and 354 N (eq. 6 gives 38.7 and 348.0, which does not fit).
    let data = read("zhang_2016.json");
    let pair = pair();
    for (name, force) in [("dry10", 40.0), ("dry30", 354.0)] {
        let row = numbers(&data["table2"][name]);
        for load in [600.0, 1000.0, 1500.0, 2000.0] {
            let printed = ((load - row[2]) / row[0]).powf(1.0 / row[1]);
            agree::relative(
                format_args!("{name} at {load} N: approach [m]"),
                approach(&pair, load, force),
                printed,
                3e-3,
            );
        }
    }
}

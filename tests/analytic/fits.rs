//! Clearance change by fits compared with closed forms of thick and thin rings.

use crate::agree;
use crate::bearing::{rig_6205, steel};
use rotordyn::bearing::{BallBearing, BallElement, BallGeometry, Fit, FitMaterials, Rotation};
use rotordyn::element::Material;

fn geometry() -> BallGeometry {
    rig_6205().geometry
}

/// Diameters of the races F and E.
fn races(g: &BallGeometry) -> [f64; 2] {
    [g.pitch_diameter - g.ball_diameter, g.pitch_diameter + g.ball_diameter]
}

#[track_caller]
fn assert_unchanged(change: f64, tolerance: f64) {
    agree::absolute("change of clearance, none [m]", change, 0.0, tolerance);
}

#[track_caller]
fn assert_relative(value: f64, exact: f64, tolerance: f64) {
    agree::relative("change of clearance [m]", value, exact, tolerance);
}

#[test]
fn shaft_fit_with_shaft_of_ring_material() {
    // Contact pressure and modulus cancel: the race expands by I d/F for any steel.
    let (g, steel) = (geometry(), steel());
    let fit = Fit { shaft_interference: 12e-6, ..Fit::default() };
    let change = fit.clearance_change(&g, &FitMaterials::all(&steel), 0.0);
    assert_relative(change, -12e-6 * g.bore / races(&g)[0], 1e-13);
    // A hollow shaft is more compliant and the race expands less: by I (d/F)(1 − (d₁/d)²)/(1 − (d₁/F)²).
    let hollow = Fit { shaft_bore: 15e-3, ..fit };
    let [f, _] = races(&g);
    let exact = -12e-6 * g.bore / f * (1.0 - (15e-3 / g.bore).powi(2)) / (1.0 - (15e-3 / f).powi(2));
    assert_relative(hollow.clearance_change(&g, &FitMaterials::all(&steel), 0.0), exact, 1e-13);
    // A shaft of negligible stiffness does not expand the race.
    let rubber = Material { young: 1.0, ..steel.clone() };
    let materials = FitMaterials { shaft: &rubber, ..FitMaterials::all(&steel) };
    assert_unchanged(fit.clearance_change(&g, &materials, 0.0), 1e-15);
}

#[test]
fn housing_fit_with_housing_of_ring_material() {
    // In an infinite housing of the same steel the race contracts by I E/D (the inverse ratio of the solid
    // shaft): p = I_h E_y (D² − E²)/(2 D · D²), 2u = 2 p E D²/(E_y (D² − E²)).
    let (g, steel) = (geometry(), steel());
    let [_, e] = races(&g);
    let fit = Fit { housing_interference: 9e-6, housing_diameter: 1e3, ..Fit::default() };
    let change = fit.clearance_change(&g, &FitMaterials::all(&steel), 0.0);
    assert_relative(change, -9e-6 * e / g.outside_diameter, 1e-8);
    // A rigid housing gives the largest contraction.
    let rigid = Fit { housing_diameter: 0.0, ..fit }.clearance_change(&g, &FitMaterials::all(&steel), 0.0);
    let ratio = (e / g.outside_diameter).powi(2);
    assert_relative(rigid, -9e-6 * e / g.outside_diameter * 2.0 / (1.0 + ratio - 0.3 * (1.0 - ratio)), 1e-13);
    // A thin housing gives almost none.
    let thin = Fit { housing_diameter: g.outside_diameter * (1.0 + 1e-6), ..fit };
    assert_unchanged(thin.clearance_change(&g, &FitMaterials::all(&steel), 0.0), 1e-9);
}

#[test]
fn temperature_difference_changes_clearance() {
    let (g, steel) = (geometry(), steel());
    let fit = Fit {
        inner_temperature_rise: 30.0,
        outer_temperature_rise: 10.0,
        expansion: 12e-6,
        ..Fit::default()
    };
    assert_relative(
        fit.clearance_change(&g, &FitMaterials::all(&steel), 0.0),
        -12e-6 * 20.0 * g.pitch_diameter,
        1e-13,
    );
    let uniform = Fit { outer_temperature_rise: 30.0, ..fit };
    assert_eq!(uniform.clearance_change(&g, &FitMaterials::all(&steel), 0.0), 0.0);
}

#[test]
fn centrifugal_growth_of_inner_ring() {
    let steel = steel();
    let speed = 3000.0;
    let fit = Fit { speed_growth: true, ..Fit::default() };
    let free = fit.clearance_change(&geometry(), &FitMaterials::all(&steel), speed);
    // Thin ring: u = ρ Ω² r³/E.
    let thin = BallGeometry { bore: races(&geometry())[0] * (1.0 - 1e-9), ..geometry() };
    let radius = 0.5 * races(&thin)[0];
    let u = 7850.0 * speed * speed * radius.powi(3) / 207e9;
    assert_relative(fit.clearance_change(&thin, &FitMaterials::all(&steel), speed), -2.0 * u, 1e-8);
    // Disc: u = ρ Ω² r³ (1 − ν)/(4E).
    let disc = BallGeometry { bore: 1e-9, ..geometry() };
    assert_relative(
        fit.clearance_change(&disc, &FitMaterials::all(&steel), speed),
        -2.0 * u * 0.7 / 4.0,
        1e-8,
    );
    assert!(free < -2.0 * u * 0.7 / 4.0 && free > -2.0 * u);
    // Proportional to the square of the speed; off by default.
    assert_relative(
        fit.clearance_change(&geometry(), &FitMaterials::all(&steel), 2.0 * speed),
        4.0 * free,
        1e-13,
    );
    assert_eq!(Fit::default().clearance_change(&geometry(), &FitMaterials::all(&steel), speed), 0.0);
}

#[test]
fn centrifugal_growth_with_interference_fit() {
    // Under contact pressure, ring and solid shaft of one steel grow as one rotating disc, plus the fit.
    let (g, steel) = (geometry(), steel());
    let materials = FitMaterials::all(&steel);
    let fit = Fit { shaft_interference: 20e-6, speed_growth: true, ..Fit::default() };
    let speed = 3000.0;
    let [f, _] = races(&g);
    let disc = 7850.0 * speed * speed * (0.5 * f).powi(3) * 0.7 / (4.0 * 207e9);
    assert_relative(fit.clearance_change(&g, &materials, speed), -20e-6 * g.bore / f - 2.0 * disc, 1e-12);
    // Contact pressure falls with speed until the fit is lost; above that speed the ring grows as a free
    // ring.
    assert!(fit.shaft_pressure(&g, &materials, speed) < fit.shaft_pressure(&g, &materials, 0.0));
    let speed = 20_000.0;
    assert_eq!(fit.shaft_pressure(&g, &materials, speed), 0.0);
    let free = Fit { shaft_interference: 0.0, ..fit };
    assert_eq!(fit.clearance_change(&g, &materials, speed), free.clearance_change(&g, &materials, speed));
}

/// A centred ring displaced by half the diametral clearance touches a ball; the operating clearance of the
/// mounted bearing is reduced by the interference fit and by the centrifugal growth of the ring.
#[test]
fn contact_begins_at_mounted_clearance() {
    let bare = rig_6205();
    let (g, k) = (bare.geometry.clone(), bare.hertz().stiffness);
    let [f, _] = races(&g);
    let speed = 3000.0;
    // Ring and solid shaft as one disc (see above): fit expansion at rest, plus the disc's centrifugal growth
    // at speed.
    let fit = Fit { shaft_interference: 10e-6, speed_growth: true, ..Fit::default() };
    let fit_expansion = 10e-6 * g.bore / f;
    let disc = 2.0 * 7850.0 * speed * speed * (0.5 * f).powi(3) * 0.7 / (4.0 * 207e9);
    // Without a film nothing else depends on speed.
    for (fit, speed, clearance) in [
        (Fit::default(), 0.0, g.radial_clearance),
        (fit, 0.0, g.radial_clearance - fit_expansion),
        (fit, speed, g.radial_clearance - fit_expansion - disc),
    ] {
        let element = BallElement::new(&BallBearing { fit, ..bare.clone() });
        let rotation = Rotation { shaft_speed: speed, ..Rotation::default() };
        for penetration in [-1e-6, 3e-6, 12e-6] {
            let x = 0.5 * clearance + penetration;
            let force: f64 = (0..g.balls)
                .map(|j| {
                    let cos = (std::f64::consts::TAU * j as f64 / g.balls as f64).cos();
                    k * (x * cos - 0.5 * clearance).max(0.0).powf(1.5) * cos
                })
                .sum();
            let found = element.reaction(&[x, 0.0, 0.0, 0.0, 0.0, 0.0], &[0.0; 6], &rotation).force;
            assert_eq!(force > 0.0, penetration > 0.0);
            // Round-off of approaches of 1e-6 m as differences of lengths of 1e-3 m.
            let what = format_args!("{speed} rad/s, {penetration} m: force [N]");
            agree::absolute(what, found[0], -force, 1e-8 * force);
        }
    }
}

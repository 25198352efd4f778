//! The shaft element compared with the exact rotating pinned-pinned Timoshenko shaft.
//!
//! With r = u_x + j u_y = U sin(k z) e^{jωt} and tilt Ψ cos(k z) e^{jωt}, k = nπ/L, the exact frequencies
//! solve (κGA k² − ρA ω²)(EI k² + κGA − ρI ω² + 2ρI Ω ω) = (κGA k)². The element gives the exact static
//! deflection under end loads; under the distributed load ω²ρA u it lacks a cubic bubble of bending and a
//! parabola of shear: Δω/ω = (k h)⁴/1440 + ρω²h²/(24 κG). The first term is the fourth order of every slender
//! shaft; the second is due to the single shear parameter per element and matters where h approaches the
//! diameter.

use crate::machine::{element, shaft};
use crate::ross::{number, read};
use rotordyn::analysis::{ModeKind, modal};
use rotordyn::assembly::{Assembly, LinearSystem};
use rotordyn::element::{Anchor, Joint};
use std::f64::consts::PI;

/// Forward or backward bending frequencies of n elements, lowest first.
fn frequencies(n: usize, diameter: f64, speed: f64, forward: bool) -> Vec<f64> {
    let mut model = shaft(vec![element(1.0 / n as f64, diameter, diameter); n]);
    for (node, axial) in [(0, true), (n, false)] {
        let locked = [true, true, axial, false, false, axial];
        model.joints.push(Joint { name: "pin".into(), a: Anchor::node(node), b: Anchor::GROUND, locked });
    }
    let assembly = Assembly::new(&model).unwrap();
    let system = LinearSystem::new(&assembly, &[], speed).unwrap();
    let kind = match forward {
        _ if speed == 0.0 => ModeKind::PlaneX,
        true => ModeKind::Forward,
        false => ModeKind::Backward,
    };
    let modes = modal::modes(&assembly, &system, 10).unwrap();
    modes.iter().filter(|m| m.kind == kind).map(|m| m.omega()).collect()
}

/// Exact frequency of the n-th mode of a shaft of 1 m, by Newton from the Euler-Bernoulli one.
fn exact(n: usize, diameter: f64, speed: f64, forward: bool) -> f64 {
    let e = element(1.0, diameter, diameter);
    let (rho, area, inertia) = (e.material.density, e.area(0.5), e.second_moment(0.5));
    let shear = e.shear_coefficient().unwrap() * e.material.shear * area;
    let bending = e.material.young * inertia;
    let k = n as f64 * PI;
    let whirl = if forward { 1.0 } else { -1.0 };
    let mut w = whirl * (bending / (rho * area)).sqrt() * k * k;
    for _ in 0..50 {
        let (a, b) = (
            shear * k * k - rho * area * w * w,
            bending * k * k + shear - rho * inertia * w * (w - 2.0 * speed),
        );
        let slope = -2.0 * rho * area * w * b - a * rho * inertia * 2.0 * (w - speed);
        w -= (a * b - (shear * k).powi(2)) / slope;
    }
    w.abs()
}

/// Slope of ln(error) against ln(h).
fn fitted_order(sizes: &[usize], errors: &[f64]) -> f64 {
    let points: Vec<(f64, f64)> =
        sizes.iter().zip(errors).map(|(n, e)| (-(*n as f64).ln(), e.abs().ln())).collect();
    let count = points.len() as f64;
    let (mx, my) = points.iter().fold((0.0, 0.0), |s, p| (s.0 + p.0 / count, s.1 + p.1 / count));
    points.iter().map(|p| (p.0 - mx) * (p.1 - my)).sum::<f64>()
        / points.iter().map(|p| (p.0 - mx).powi(2)).sum::<f64>()
}

#[test]
fn closed_form_matches_reference_values() {
    let file = &read("ross/uniform_pinned.json")["results"]["analytic_timoshenko_pinned_pinned"]["by_speed"];
    for (name, speed) in [("0.0", 0.0), ("1000.0", 1000.0), ("3000.0", 3000.0)] {
        for n in 1..=4 {
            for (whirl, forward) in [("forward", true), ("backward", false)] {
                let reference = number(&file[name][n - 1][whirl]);
                assert!((exact(n, 0.05, speed, forward) / reference - 1.0).abs() < 1e-11);
            }
        }
    }
}

#[test]
fn slender_rotating_shaft_converges_with_fourth_order() {
    let sizes = [6, 8, 12, 16];
    for forward in [true, false] {
        let found: Vec<Vec<f64>> = sizes.iter().map(|&n| frequencies(n, 0.005, 1000.0, forward)).collect();
        for mode in 1..=3 {
            let exact = exact(mode, 0.005, 1000.0, forward);
            let errors: Vec<f64> = found.iter().map(|f| f[mode - 1] / exact - 1.0).collect();
            let order = fitted_order(&sizes, &errors);
            println!(
                "mode {mode}, forward {forward}: order {order:.3}, error with 16 elements {:.1e}",
                errors[3]
            );
            // Fourth order with a small contribution of the shear term.
            assert!((order - 4.0).abs() < 0.25, "{order}");
        }
    }
}

#[test]
fn thick_rotating_shaft_has_predicted_error() {
    let steel = element(1.0, 0.05, 0.05);
    let shear_speed_squared =
        steel.shear_coefficient().unwrap() * steel.material.shear / steel.material.density;
    let sizes = [12, 16, 24, 32];
    // At higher speed the gyroscopic moment adds a little to the second-order term.
    for speed in [0.0, 1000.0] {
        for forward in [true, false] {
            let found: Vec<Vec<f64>> = sizes.iter().map(|&n| frequencies(n, 0.05, speed, forward)).collect();
            for mode in 1..=3 {
                let exact = exact(mode, 0.05, speed, forward);
                let rest: Vec<f64> = sizes
                    .iter()
                    .zip(&found)
                    .map(|(&n, f)| {
                        let h = 1.0 / n as f64;
                        f[mode - 1] / exact - 1.0 - (exact * h).powi(2) / (24.0 * shear_speed_squared)
                    })
                    .collect();
                let order = fitted_order(&sizes, &rest);
                println!(
                    "mode {mode} at {speed} rad/s, forward {forward}: order without the shear term {order:.3}"
                );
                assert!((order - 4.0).abs() < 0.3, "{order}");
            }
        }
    }
}

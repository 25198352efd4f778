//! Shafts of many elements: banded solutions against the Euler-Bernoulli beam and against dense ones; what is refused.

use crate::agree;
use crate::machine::{disc, element, shaft};
use rotordyn::analysis::equilibrium::{CageTreatment, equilibrium};
use rotordyn::analysis::{frf::frf, modal};
use rotordyn::assembly::{Assembly, LinearSystem, PhysicsError};
use rotordyn::element::{Anchor, Joint, ShearCoefficient};
use rotordyn::linalg::eigen;
use rotordyn::model::study::CampbellStudy;
use rotordyn::model::{Model, Quantity, ShaftExtent};
use rotordyn::study::Machine;
use std::f64::consts::{PI, TAU};

const LENGTH: f64 = 1.0;
const DIAMETER: f64 = 0.02;

/// A slender shaft pinned at both ends, without shear deformation and rotary inertia.
fn pinned(elements: usize) -> Model {
    let mut slender = element(LENGTH / elements as f64, DIAMETER, DIAMETER);
    slender.shear = ShearCoefficient::Rigid;
    slender.rotary_inertia = false;
    let mut model = shaft(vec![slender; elements]);
    for (node, axial) in [(0, true), (elements, false)] {
        let locked = [true, true, axial, false, false, axial];
        model.joints.push(Joint { name: "pin".into(), a: Anchor::node(node), b: Anchor::GROUND, locked });
    }
    model
}

/// Statics, modes and FRF of 100, 1000 and 5000 elements: deflection 5 w L⁴/(384 E I), ω_k = (k π/L)² √(E I/ρA), receptance
/// at the middle (tan x − tanh x)/(4 E I β³) with x = β L/2, β⁴ = ρA ω²/(E I).
///
/// The error of the elements is (k h)⁴/1440: 5.5e-8 of the third frequency with 100, nothing with more. That of a direct
/// solution grows with the fourth power of their number, as the condition of the stiffness matrix does: 3e-3 in the
/// deflection of 5000. Refined, what is left is the round-off of the matrix, 6 n² ε: 3e-8 with 5000.
#[test]
fn many_elements_are_a_euler_bernoulli_beam() {
    for elements in [100, 1000, 5000] {
        compare_with_euler_bernoulli(&pinned(elements));
    }
}

/// Modal damping is a dense matrix beside the banded ones. Ratios of 1e-5 change frequencies |λ| by nothing and the real part of
/// a receptance off resonance by their square; a direct solution with 700 elements is off by 1e-6 to 1e-5.
#[test]
fn many_elements_with_modal_damping_are_a_euler_bernoulli_beam() {
    let mut model = pinned(700);
    model.damping.modal = vec![[10.0, 1e-5]];
    compare_with_euler_bernoulli(&model);
}

fn compare_with_euler_bernoulli(model: &Model) {
    let elements = model.shaft.len();
    let assembly = Assembly::new(model).unwrap();
    let stiffness = 2.1e11 * PI / 64.0 * DIAMETER.powi(4);
    let mass = 7850.0 * PI / 4.0 * DIAMETER.powi(2);
    let close = |name: &str, found: f64, expected: f64| {
        agree::relative(format_args!("{elements} elements: {name}"), found, expected, 1e-6);
    };

    let found = equilibrium(model, &assembly, 0.0, CageTreatment::Averaged, None).unwrap();
    let middle = assembly.dofs.expand(&found.q)[6 * (elements / 2) + 1];
    close("deflection", middle, -5.0 * mass * 9.80665 * LENGTH.powi(4) / (384.0 * stiffness));

    let system = LinearSystem::new(&assembly, &[], 0.0).unwrap();
    let modes = modal::modes(&assembly, &system, 6).unwrap();
    for (mode, k) in modes.iter().zip([1.0f64, 1.0, 2.0, 2.0, 3.0, 3.0]) {
        close("frequency", mode.natural_omega(), (k * PI / LENGTH).powi(2) * (stiffness / mass).sqrt());
    }

    let hz = 20.0;
    let row = assembly.direction_row(&Anchor::node(elements / 2), &[1.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let rows = std::slice::from_ref(&row);
    let found = frf(&assembly, &system, &[hz], rows, rows, Quantity::Displacement).unwrap();
    let beta = (mass * (TAU * hz).powi(2) / stiffness).powf(0.25);
    let x = 0.5 * beta * LENGTH;
    close("receptance", found.values[0][0][0].re, (x.tan() - x.tanh()) / (4.0 * stiffness * beta.powi(3)));
}

/// Beyond what double precision solves, the error is estimated and named, not shown as a result: ε n⁴ is 3e3 with 60 000 elements.
#[test]
fn elements_beyond_double_precision_are_refused() {
    let model = pinned(60_000);
    let assembly = Assembly::new(&model).unwrap();
    let error = equilibrium(&model, &assembly, 0.0, CageTreatment::Averaged, None).unwrap_err();
    println!("{error}");
    assert!(matches!(error, PhysicsError::RoundOff { .. }), "{error}");
    assert!(error.to_string().contains("60000 elements of 0.01667 mm"), "{error}");
}

/// Modes by the banded solver and by dense ones, of the same matrices, for a rotor of 40 elements at speed and one of 200 at
/// rest: to the round-off of the dense ones, ε (ω_max/ω)², which a banded solver that factors the stiffness does not have.
#[test]
fn banded_modes_are_the_dense_ones() {
    let with_disc = |elements: usize| {
        let mut model = pinned(elements);
        model.discs.push(disc(elements / 4, 2.0, 0.02, 0.01));
        model
    };
    for (elements, speed) in [(40, 300.0), (200, 0.0)] {
        let assembly = Assembly::new(&with_disc(elements)).unwrap();
        let system = LinearSystem::new(&assembly, &[], speed).unwrap();
        let found = modal::modes(&assembly, &system, 8).unwrap();
        let [m, d, k] = [&system.mass, &system.damping, &system.stiffness].map(|a| a.to_dense());
        let mut dense: Vec<f64> = if speed == 0.0 {
            eigen::undamped(&k, &m, 1.0).unwrap().0.iter().map(|square| square.sqrt()).collect()
        } else {
            let pairs = eigen::quadratic(&m, &d, &k).unwrap();
            pairs.iter().map(|(value, _)| value).filter(|v| v.im > 0.0).map(|v| v.norm()).collect()
        };
        dense.sort_by(f64::total_cmp);
        for (mode, expected) in found.iter().zip(&dense) {
            let what =
                format_args!("{elements} elements at {speed} rad/s: frequency by the dense solver [rad/s]");
            agree::relative(what, mode.natural_omega(), *expected, 1e-5);
        }
    }
}

/// Modal damping and reduced models need dense matrices: too many unknowns are refused at once, with what makes them.
#[test]
fn dense_matrices_beyond_the_memory_are_refused() {
    let mut model = pinned(5000);
    let speeds = (0..31).map(f64::from).collect();
    let study =
        |speeds| CampbellStudy { speeds, modes: 14, orders: vec![1.0], speed_dependent_bearings: false };
    model.studies.campbell = Some(study(speeds));
    let mut machine = Machine::new(model.clone()).unwrap();
    let error = machine.check_memory("campbell").unwrap_err().to_string();
    assert!(error.contains("MB for mode shapes") && error.contains("5000 elements of 0.2000 mm"), "{error}");
    machine.model.studies.campbell = Some(study(vec![0.0, 100.0]));
    assert!(machine.check_memory("campbell").is_ok());
    let error = machine.check_memory("run-up").unwrap_err().to_string();
    assert!(error.contains("5000 elements of 0.2000 mm") && error.contains("unit"), "{error}");
    assert!(machine.check_memory("modal").is_ok());

    model.damping.modal = vec![[10.0, 0.01]];
    let error = Machine::new(model).err().unwrap();
    assert!(matches!(error, PhysicsError::TooLarge { unknowns, .. } if unknowns >= 10_000), "{error}");
    println!("{error}");
}

/// Of a shaft with several sections the message names that of most elements.
#[test]
fn extent_names_the_part_with_most_elements() {
    let mut elements = vec![element(0.05, 0.03, 0.03); 3];
    elements.extend(vec![element(0.01, 0.02, 0.02); 7]);
    elements.push(element(0.05, 0.03, 0.03));
    let extent = ShaftExtent::of(&shaft(elements));
    let part = extent.part.unwrap();
    assert_eq!((extent.nodes, part.elements), (12, 7));
    agree::absolute("start of the part [m]", part.z[0], 0.15, 1e-12);
    agree::absolute("end of the part [m]", part.z[1], 0.22, 1e-12);
    agree::absolute("length of the shaft [m]", extent.length, 0.27, 1e-12);
    agree::absolute("slenderness of the shaft", extent.slenderness(), 3.5, 1e-9);
}

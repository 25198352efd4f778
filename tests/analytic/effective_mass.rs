//! Effective modal masses of uniform beams compared with closed forms, and their sum over all modes.

use crate::agree;
use crate::machine::{element, shaft};
use rotordyn::analysis::ModeKind;
use rotordyn::analysis::modal::{self, Mode};
use rotordyn::assembly::{Assembly, LinearSystem};
use rotordyn::element::{Anchor, Joint, ShearCoefficient};
use rotordyn::model::{Model, Options, load};
use rotordyn::study::Machine;

/// Modes of a slender uniform beam with constrained nodes: (node, locked motions).
fn beam(elements: usize, constrained: &[(usize, [bool; 6])]) -> Vec<Mode> {
    let mut slender = element(1.0 / elements as f64, 0.01, 0.01);
    slender.shear = ShearCoefficient::Rigid;
    slender.rotary_inertia = false;
    let mut model: Model = shaft(vec![slender; elements]);
    for &(node, locked) in constrained {
        model.joints.push(Joint { name: "end".into(), a: Anchor::node(node), b: Anchor::GROUND, locked });
    }
    let assembly = Assembly::new(&model).unwrap();
    modal::modes(&assembly, &LinearSystem::new(&assembly, &[], 0.0).unwrap(), 14).unwrap()
}

#[track_caller]
fn check_effective_masses(modes: &[Mode], kind: ModeKind, direction: usize, shares: &[f64]) {
    let found: Vec<&Mode> = modes.iter().filter(|m| m.kind == kind).collect();
    assert!(found.len() >= shares.len(), "{} of {kind:?}", found.len());
    for (k, (mode, share)) in found.iter().zip(shares).enumerate() {
        for axis in 0..3 {
            let expected = if axis == direction { *share } else { 0.0 };
            // Discretisation error of 24 cubic elements: at most (k h)⁴/720 of the fourth mode.
            let what = format_args!("{kind:?} {k}: effective mass along axis {axis}");
            agree::absolute(what, mode.effective_mass[axis], expected, 2e-4);
        }
    }
}

/// Mode shapes sin nπz/L: (∫φ)²/(L ∫φ²) = 8/(nπ)² for odd n, 0 for even n.
#[test]
fn effective_masses_of_pinned_beam() {
    let n = 24;
    let ends = [(0, [true, true, true, false, false, true]), (n, [true, true, false, false, false, false])];
    let modes = beam(n, &ends);
    let share = |n: f64| 8.0 / (n * std::f64::consts::PI).powi(2);
    for (kind, direction) in [(ModeKind::PlaneX, 0), (ModeKind::PlaneY, 1)] {
        check_effective_masses(&modes, kind, direction, &[share(1.0), 0.0, share(3.0), 0.0]);
    }
}

/// Clamped-free: (2 σ/λ)² with cos λ cosh λ = −1 and σ = (sinh λ − sin λ)/(cosh λ + cos λ): 0.6131, 0.1883,
/// 0.0647.
#[test]
fn effective_masses_of_cantilever_beam() {
    let n = 24;
    let modes = beam(n, &[(0, [true; 6])]);
    let shares = [1.875_104_068_711_961, 4.694_091_132_974_175, 7.854_757_438_237_613].map(|l: f64| {
        let sigma = (l.sinh() - l.sin()) / (l.cosh() + l.cos());
        (2.0 * sigma / l).powi(2)
    });
    // Published values, four digits.
    for (share, published) in shares.iter().zip([0.6131, 0.1883, 0.0647]) {
        agree::absolute("share of the effective mass, published", *share, published, 5e-5);
    }
    for (kind, direction) in [(ModeKind::PlaneX, 0), (ModeKind::PlaneY, 1)] {
        check_effective_masses(&modes, kind, direction, &shares);
    }
}

/// Rigid rotor with an elastically mounted housing: all mass is on springs, so the effective masses sum to
/// the total mass.
///
/// Balls with their own degrees of freedom move with the housing in the radial directions only, so that the
/// total mass along z is smaller than along x and y: by Z m/2 = 9 g of 5 kg, nine balls of 7.938 mm.
const MACHINE: &str = r#"
[model]
name = "sum"
[material.steel]
young = "207 GPa"
poisson = 0.3
density = "7850 kg/m^3"
[rotor]
length = "0.55 m"
outer_diameter = "40 mm"
mass = "4.8 kg"
centre = "0.25 m"
[station]
A = "0.05 m"
B = "0.5 m"
[housing.A]
station = "A"
mass = "0.2 kg"
inertia = "0.001, 0.0012, 0.0015 kg m^2"
k_x = "3e6 N/m"
k_y = "5e6 N/m"
k_z = "4e6 N/m"
k_tilt = "2e4 N m/rad"
k_spin = "3e4 N m/rad"
[bearing.A]
station = "A"
housing = "A"
BEARING
[bearing.B]
station = "B"
model = "linear"
k_xx = "2e7 N/m"
k_yy = "1e7 N/m"
k_zz = "1e8 N/m"
[drive]
kind = "prescribed"
station = "A"
"#;

#[test]
fn effective_masses_sum_to_total_mass() {
    let linear = "model = \"linear\"\nk_xx = \"1e7 N/m\"\nk_yy = \"2e7 N/m\"\nk_zz = \"5e6 N/m\"";
    let balls = "model = \"radial_ball\"\ndesignation = \"6205\"\nradial_clearance = \"-20 um\"\n\
                 stiffness_damping = \"0 s\"\nmaterial = \"steel\"";
    for bearing in [linear, balls] {
        let text = MACHINE.replace("BEARING", bearing);
        let model = load("sum.toml", &text, &Options::default()).unwrap_or_else(|e| panic!("{e:?}")).model;
        let machine = Machine::new(model).unwrap();
        assert!(machine.model.bearings[0].housing.node.is_some());
        let system = machine.linear_system(0.0).unwrap();
        let modes = modal::modes(&machine.assembly, &system, 11).unwrap();
        // Five degrees of freedom of the rotor (its rotation is prescribed) and six of the housing.
        assert_eq!((machine.assembly.dofs.len(), modes.len()), (11, 11));
        for axis in 0..3 {
            let sum: f64 = modes.iter().map(|m| m.effective_mass[axis]).sum();
            // Round-off of eigenvectors.
            agree::absolute(format_args!("sum of the effective masses, axis {axis}"), sum, 1.0, 1e-9);
        }
    }
}

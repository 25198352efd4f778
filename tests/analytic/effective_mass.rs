//! Effective modal masses: uniform beams in closed form, and the sum over all modes.

use crate::machine::{element, shaft};
use rotordyn::analysis::ModeKind;
use rotordyn::analysis::modal::{self, Mode};
use rotordyn::assembly::{Assembly, LinearSystem};
use rotordyn::element::{Anchor, Joint, ShearCoefficient};
use rotordyn::model::{Model, Options, load};
use rotordyn::study::Machine;

/// A slender uniform beam whose ends are held: (node, locked motions).
fn beam(elements: usize, held: &[(usize, [bool; 6])]) -> Vec<Mode> {
    let mut slender = element(1.0 / elements as f64, 0.01, 0.01);
    slender.shear = ShearCoefficient::Rigid;
    slender.rotary_inertia = false;
    let mut model: Model = shaft(vec![slender; elements]);
    for &(node, locked) in held {
        model.joints.push(Joint { name: "end".into(), a: Anchor::node(node), b: Anchor::GROUND, locked });
    }
    let assembly = Assembly::new(&model).unwrap();
    modal::modes(&assembly, &LinearSystem::new(&assembly, &[], 0.0).unwrap(), 14).unwrap()
}

fn compare(modes: &[Mode], kind: ModeKind, direction: usize, shares: &[f64]) {
    let found: Vec<&Mode> = modes.iter().filter(|m| m.kind == kind).collect();
    assert!(found.len() >= shares.len(), "{} of {kind:?}", found.len());
    for (k, (mode, share)) in found.iter().zip(shares).enumerate() {
        for along in 0..3 {
            let expected = if along == direction { *share } else { 0.0 };
            // Cubic elements of a 24th of the length: (k h)⁴/720 of the fourth mode and less.
            let off = (mode.effective_mass[along] - expected).abs();
            assert!(off < 2e-4, "{kind:?} {k} along {along}: {} {expected}", mode.effective_mass[along]);
        }
    }
}

/// Shapes sin nπz/L: (∫φ)²/(L ∫φ²) = 8/(nπ)² for odd n, 0 for even n.
#[test]
fn pinned_beam() {
    let n = 24;
    let ends = [(0, [true, true, true, false, false, true]), (n, [true, true, false, false, false, false])];
    let modes = beam(n, &ends);
    let share = |n: f64| 8.0 / (n * std::f64::consts::PI).powi(2);
    for (kind, direction) in [(ModeKind::PlaneX, 0), (ModeKind::PlaneY, 1)] {
        compare(&modes, kind, direction, &[share(1.0), 0.0, share(3.0), 0.0]);
    }
}

/// Clamped and free: (2 σ/λ)² with cos λ cosh λ = −1 and σ = (sinh λ − sin λ)/(cosh λ + cos λ): 0.6131, 0.1883, 0.0647.
#[test]
fn cantilever() {
    let n = 24;
    let modes = beam(n, &[(0, [true; 6])]);
    let shares = [1.875_104_068_711_961, 4.694_091_132_974_175, 7.854_757_438_237_613].map(|l: f64| {
        let sigma = (l.sinh() - l.sin()) / (l.cosh() + l.cos());
        (2.0 * sigma / l).powi(2)
    });
    // Published to four digits.
    for (share, printed) in shares.iter().zip([0.6131, 0.1883, 0.0647]) {
        assert!((share - printed).abs() < 5e-5, "{share} {printed}");
    }
    for (kind, direction) in [(ModeKind::PlaneX, 0), (ModeKind::PlaneY, 1)] {
        compare(&modes, kind, direction, &shares);
    }
}

/// A rigid rotor with a housing on springs of its own: all mass stands on springs, and all modes together take all of it.
///
/// Balls with coordinates of their own move with the housing across the shaft only, so that the total mass along z
/// is less than that along x and y: by Z m/2 = 9 g of 5 kg, nine balls of 7.938 mm.
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
fn all_modes_together_take_the_whole_mass() {
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
        // Five motions of the rotor, whose rotation is prescribed, and six of the housing.
        assert_eq!((machine.assembly.dofs.len(), modes.len()), (11, 11));
        for along in 0..3 {
            let sum: f64 = modes.iter().map(|m| m.effective_mass[along]).sum();
            // Round-off of eigenvectors.
            assert!((sum - 1.0).abs() < 1e-9, "along {along}: {sum}");
        }
    }
}

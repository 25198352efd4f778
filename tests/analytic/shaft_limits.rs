//! Shaft terms with closed-form limits: internal damping, angular acceleration, Euler buckling, rigid-body
//! modes.

use crate::agree;
use crate::machine::{disc, element, shaft};
use rotordyn::analysis::{campbell::campbell, modal, stability::thresholds};
use rotordyn::assembly::{Assembly, LinearSystem, rigid_body_modes};
use rotordyn::element::{Anchor, Bushing, Joint, ShearCoefficient};
use rotordyn::model::{Drive, Model};

/// Pins at both ends; the left one also constrains u_z and θ_z.
fn pinned(model: &mut Model) {
    let last = model.node_z.len() - 1;
    for (node, axial) in [(0, true), (last, false)] {
        let locked = [true, true, axial, false, false, axial];
        model.joints.push(Joint { name: "pin".into(), a: Anchor::node(node), b: Anchor::GROUND, locked });
    }
}

/// Internal damping c_i = η k and external damping c_e of a Jeffcott rotor: stable below Ω = ω (1 + c_e/c_i).
#[test]
fn internal_damping_stability_threshold_of_jeffcott_rotor() {
    let (eta, external, mass) = (1e-4, 20.0, 10.0);
    let mut light = element(0.1, 0.02, 0.02);
    light.material.density = 1e-3;
    light.shear = ShearCoefficient::Rigid;
    light.internal_viscous = eta;
    let mut model = shaft(vec![light; 8]);
    model.discs.push(disc(4, mass, 1e-6, 1e-6));
    pinned(&mut model);
    let mut damper = [[0.0; 6]; 6];
    (damper[0][0], damper[1][1]) = (external, external);
    model.bushings.push(Bushing {
        name: "damper".into(),
        a: Anchor::node(4),
        b: Anchor::GROUND,
        stiffness: [[0.0; 6]; 6],
        damping: damper,
    });
    let stiffness = 48.0 * 2.1e11 * std::f64::consts::PI / 64.0 * 0.02f64.powi(4) / 0.8f64.powi(3);
    let omega = (stiffness / mass).sqrt();
    let expected = omega * (1.0 + external / (eta * stiffness));

    let assembly = Assembly::new(&model).unwrap();
    let tangents = |_| Ok(Vec::new());
    let speeds: Vec<f64> = (0..=12).map(|k| expected * f64::from(k) / 8.0).collect();
    let diagram = campbell(&assembly, &speeds, 2, &tangents).unwrap();
    let found = thresholds(&assembly, &diagram, &[], &tangents, &[]).unwrap();
    assert_eq!(found.len(), 1, "only the forward mode turns unstable");
    assert!(found[0].unstable_above);
    assert!(found[0].mode.whirl[4] > 0.999);
    // Terms left out by the formula are of the order of the damping squared.
    agree::relative("stability threshold [rad/s]", found[0].speed, expected, 1e-4);
}

/// Smooth bent shape of the shaft in planes x and y: displacement u, slope u′, curvature u″.
fn shape(z: f64) -> ([f64; 2], [f64; 2], [f64; 2]) {
    let u = [z * (1.0 - z) * (2.0 + z), (1.3 * z).sin()];
    let slope = [2.0 - 2.0 * z - 3.0 * z * z, 1.3 * (1.3 * z).cos()];
    let curvature = [-2.0 - 6.0 * z, -1.69 * (1.3 * z).sin()];
    (u, slope, curvature)
}

/// Moments from angular acceleration of the shaft compared with the moment balance of its slices.
///
/// All polar inertia is accelerated through the shaft: only T dt/dz remains (t = tangent, T(z) = polar
/// inertia beyond z for Ω̇ = 1), plus half of the drive torque times the tilt at the driven station.
#[test]
fn spin_up_terms_satisfy_moment_balance() {
    let virtual_tilt = |z: f64| [0.4 + z * z, 1.0 - 0.5 * z];
    let (radius, disc_inertia, drive_z) = (0.04f64, 0.02, 0.25);
    let ip = 7850.0 * std::f64::consts::PI / 2.0 * radius.powi(4);
    let total = ip + disc_inertia;
    let torque = |z: f64| ip * (1.0 - z) + disc_inertia - if z < drive_z { total } else { 0.0 };

    // Virtual work of T t′ on the tilt by Simpson's rule on both sides of the drive, plus half the drive
    // torque.
    let density = |z: f64, side: f64| {
        let (_, _, [xx, yy]) = shape(z);
        let [dx, dy] = virtual_tilt(z);
        // θ_x = −u_y′, θ_y = u_x′: T θ_y′ works on δθ_x, −T θ_x′ on δθ_y.
        (torque(z + side)) * (dx * xx + dy * yy)
    };
    let simpson = |a: f64, b: f64| {
        let n = 2000;
        let h = (b - a) / f64::from(n);
        let nudge = |k: i32| if k == 0 { 1e-13 } else { -1e-13 };
        (0..=n)
            .map(|k| {
                let w = if k == 0 || k == n {
                    1.0
                } else if k % 2 == 1 {
                    4.0
                } else {
                    2.0
                };
                w * density(a + h * f64::from(k), nudge(k)) * h / 3.0
            })
            .sum::<f64>()
    };
    let (_, [sx, sy], _) = shape(drive_z);
    let [dx, dy] = virtual_tilt(drive_z);
    let expected = simpson(0.0, drive_z) + simpson(drive_z, 1.0) + 0.5 * total * (dx * sx + dy * sy);

    let mut errors = Vec::new();
    for n in [8, 16, 32] {
        let mut slender = element(1.0 / n as f64, 2.0 * radius, 2.0 * radius);
        slender.shear = ShearCoefficient::Rigid;
        let mut model = shaft(vec![slender; n]);
        model.discs.push(disc(n, 1.0, disc_inertia, 0.01));
        model.drive = Drive::Prescribed { node: Some(n / 4) };
        let assembly = Assembly::new(&model).unwrap();
        let (mut q, mut work) = (vec![0.0; 6 * (n + 1)], vec![0.0; 6 * (n + 1)]);
        for node in 0..=n {
            let z = node as f64 / n as f64;
            let ([ux, uy], [sx, sy], _) = shape(z);
            q[6 * node..6 * node + 5].copy_from_slice(&[ux, uy, 0.0, -sy, sx]);
            let [dx, dy] = virtual_tilt(z);
            // Displacements whose slopes are −δθ_x (plane y) and δθ_y (plane x).
            let integral = [0.4 * z + z.powi(3) / 3.0, z - 0.25 * z * z];
            work[6 * node..6 * node + 5].copy_from_slice(&[integral[1], -integral[0], 0.0, dx, dy]);
        }
        let reduced = |full: &[f64]| -> Vec<f64> { assembly.dofs.free.iter().map(|&i| full[i]).collect() };
        let force = assembly.spin_up.mul(&reduced(&q));
        let got: f64 = force.iter().zip(reduced(&work)).map(|(f, w)| f * w).sum();
        errors.push((got / expected - 1.0).abs());
    }
    agree::curve("moment of the spin-up terms, 32 elements", errors[2], 1.0, 1e-6);
    assert!(errors[1] > 8.0 * errors[2]);
}

/// At the Euler buckling load the lowest natural frequency is zero.
#[test]
fn euler_buckling_load() {
    let ei = 2.1e11 * std::f64::consts::PI / 64.0 * 0.02f64.powi(4);
    let lowest = |force: f64| {
        let mut e = element(0.05, 0.02, 0.02);
        e.shear = ShearCoefficient::Rigid;
        e.axial_force = -force;
        let mut model = shaft(vec![e; 20]);
        pinned(&mut model);
        let assembly = Assembly::new(&model).unwrap();
        let dense = (assembly.stiffness.to_dense(), assembly.mass.to_dense());
        rotordyn::linalg::eigen::undamped(&dense.0, &dense.1, 1e5).unwrap().0[0]
    };
    let euler = std::f64::consts::PI.powi(2) * ei;
    // ω² falls linearly to zero at the critical force.
    let (free, half) = (lowest(0.0), lowest(0.5 * euler));
    agree::absolute("ω² at half of the Euler load", half / free, 0.5, 1e-4);
    assert!(lowest(0.999 * euler) > 0.0 && lowest(1.001 * euler) < 0.0);
}

#[test]
fn rigid_body_modes_are_named() {
    let name = |model: &Model| {
        let assembly = Assembly::new(model).unwrap();
        let system = LinearSystem::new(&assembly, &[], 0.0).unwrap();
        let mut names = rigid_body_modes::rigid_body_modes_of(&assembly, &system).unwrap();
        names.sort();
        names
    };
    let mut model = shaft(vec![element(0.1, 0.03, 0.04); 5]);
    pinned(&mut model);
    assert_eq!(name(&model), [""; 0]);
    model.joints[0].locked[2] = false;
    assert_eq!(name(&model), ["axial motion of the shaft (u_z)"]);
    model.joints[0].locked[5] = false;
    assert_eq!(name(&model), ["axial motion of the shaft (u_z)", "rotation of the shaft about z (θ_z)"]);
}

/// The complex eigenvalues reproduce the given modal damping ratios.
#[test]
fn modal_damping_ratios_are_reproduced() {
    let mut model = shaft(vec![element(0.1, 0.03, 0.03); 8]);
    pinned(&mut model);
    model.damping.modal = vec![[100.0, 0.01], [500.0, 0.03]];
    let assembly = Assembly::new(&model).unwrap();
    let system = LinearSystem::new(&assembly, &[], 0.0).unwrap();
    let modes = modal::modes(&assembly, &system, 6).unwrap();
    assert_eq!(modes.len(), 6);
    for mode in &modes {
        let hz = mode.natural_omega() / std::f64::consts::TAU;
        let expected = 0.01 + 0.02 * ((hz - 100.0) / 400.0).clamp(0.0, 1.0);
        agree::relative(format_args!("damping ratio at {hz} Hz"), mode.zeta(), expected, 1e-6);
    }
}

//! Deflection, shear force and bending moment of beams under their weight and single forces (Gere & Timoshenko,
//! Mechanics of Materials, appendix G), and the balance of forces under unbalance.

use crate::agree;
use crate::machine::{disc, element, shaft};
use rotordyn::analysis::section_loads::ShaftSections;
use rotordyn::analysis::shaft_loads::ShaftPoint;
use rotordyn::analysis::unbalance;
use rotordyn::bearing::{Bearing, LinearBearing, LinearBearingRow};
use rotordyn::element::{Anchor, Joint, ShearCoefficient};
use rotordyn::linalg::Complex64;
use rotordyn::model::study::{EquilibriumStudy, UnbalanceStudy};
use rotordyn::model::{BearingSite, Load, LoadFactor, Model, Unbalance};
use rotordyn::study::Machine;
use std::f64::consts::PI;

const G: f64 = 9.80665;

/// 1 m of 40 mm shaft in ten elements, rigid in shear.
fn beam() -> Model {
    let bar =
        || rotordyn::element::ShaftElement { shear: ShearCoefficient::Rigid, ..element(0.1, 0.04, 0.04) };
    shaft((0..10).map(|_| bar()).collect())
}

fn pin(node: usize, z: f64, locked: [bool; 6]) -> Joint {
    let b = Anchor { node: None, offset: [0.0, 0.0, z] };
    Joint { name: format!("pin {node}"), a: Anchor::node(node), b, locked }
}

fn pinned(mut model: Model, nodes: [usize; 2]) -> Model {
    let locked = [[true, true, true, false, false, true], [true, true, false, false, false, false]];
    model.joints = nodes.iter().zip(locked).map(|(&n, locked)| pin(n, model.node_z[n], locked)).collect();
    model
}

fn at_rest(model: Model) -> rotordyn::analysis::equilibrium::Equilibrium {
    Machine::new(model).unwrap().equilibrium(&EquilibriumStudy { speed: 0.0, cage_average: true }).unwrap()
}

/// Relative to the largest value: solutions of ten elements have round-off of the stiffness over the load, 1e-10.
#[track_caller]
fn close(found: f64, expected: f64, largest: f64) {
    agree::curve("load or deflection along the shaft", found - expected, largest, 1e-8);
}

#[test]
fn simply_supported_beam_under_its_weight() {
    let found = at_rest(pinned(beam(), [0, 10]));
    let (length, w) = (1.0, 7850.0 * PI * 4e-4 * G);
    let ei = 2.1e11 * PI / 64.0 * 0.04_f64.powi(4);
    assert_eq!(found.shaft.len(), 20);
    let top = w * length * length / 8.0;
    for p in &found.shaft {
        let z = p.z;
        // Weight along −y: supports push up, V_y = w (L/2 − z), M = w z (L − z)/2, u_y < 0.
        close(p.shear[1], w * (0.5 * length - z), w * length);
        close(p.moment[1], 0.5 * w * z * (length - z), top);
        let deflection = -w * z * (length.powi(3) - 2.0 * length * z * z + z.powi(3)) / (24.0 * ei);
        close(p.displacement[1], deflection, 5.0 * w / (384.0 * ei));
        assert_eq!([p.shear[0], p.moment[0], p.displacement[0]], [0.0; 3]);
        // σ = 32 M/(π d³).
        close(p.stress, 32.0 * p.moment[1] / (PI * 0.04_f64.powi(3)), 1e6);
    }
    let z: Vec<f64> = found.shaft.iter().map(|p| p.z).collect();
    let over = agree::Over { name: "z", unit: "m", values: &z };
    let moments: Vec<f64> = found.shaft.iter().map(|p| p.moment[1]).collect();
    let closed: Vec<f64> = z.iter().map(|z| 0.5 * w * z * (length - z)).collect();
    agree::curves("bending moment of a simply supported beam", "N m", over, &moments, &closed, 1e-8);
    let sag: Vec<f64> = found.shaft.iter().map(|p| p.displacement[1]).collect();
    let cubic = |z: &f64| -w * z * (length.powi(3) - 2.0 * length * z * z + z.powi(3)) / (24.0 * ei);
    let closed: Vec<f64> = z.iter().map(cubic).collect();
    agree::curves("deflection of a simply supported beam", "m", over, &sag, &closed, 1e-8);
    let (middle, moment) = ShaftPoint::largest(&found.shaft, |p| p.moment[1]).unwrap();
    agree::absolute("place of the largest bending moment [m]", middle.z, 0.5, 1e-12);
    close(moment, top, top);
    let forces: Vec<_> = found.support_forces.iter().map(|r| (r.name.as_str(), r.force[1])).collect();
    assert_eq!([forces[0].0, forces[1].0], ["joint.pin 0", "joint.pin 10"]);
    forces.iter().for_each(|(_, force)| close(*force, 0.5 * w * length, w));
}

/// An overhung disc: force P at the end, supports at 0 and a; M = −P (L − z) behind the second support.
#[test]
fn overhung_disc_and_a_side_force() {
    let mut model = pinned(beam(), [0, 6]);
    model.shaft.iter_mut().for_each(|e| e.material.density = 1e-6);
    model.discs = vec![disc(10, 8.0, 0.1, 0.05)];
    model.loads = vec![Load {
        name: "belt".into(),
        at: Anchor::node(10),
        force: [50.0, 0.0, 0.0, 0.0, 0.0, 3.0],
        factor: LoadFactor::Constant,
    }];
    let found = at_rest(model);
    let p = 8.0 * G;
    for (k, point) in found.shaft.iter().enumerate() {
        let z = point.z;
        // Section k lies in element k/2: before or behind the support at 0.6 m.
        let behind = k / 2 >= 6;
        let (shear, moment) = if behind { (1.0, -(1.0 - z)) } else { (-0.4 / 0.6, -0.4 / 0.6 * z) };
        close(point.shear[1], p * shear, p);
        close(point.moment[1], p * moment, p);
        close(point.shear[0], -50.0 * shear, p);
        close(point.moment[0], -50.0 * moment, p);
        // The drive side carries the torque: 3 N m act at the end and are held at the first support.
        close(point.torque, 3.0, 3.0);
    }
    let expected = [[50.0 * 0.4 / 0.6, -p * 0.4 / 0.6], [-50.0 / 0.6, p / 0.6]];
    for (support, expected) in found.support_forces.iter().zip(expected) {
        close(support.force[0], expected[0], p);
        close(support.force[1], expected[1], p);
        close(support.force[3], 0.0, p);
    }
}

fn on_springs(stiffness: [f64; 2], damping: f64) -> Machine {
    let mut model = beam();
    model.discs = vec![disc(5, 12.0, 0.1, 0.05)];
    let mut matrices = [[[0.0; 6]; 6]; 2];
    for k in 0..2 {
        (matrices[0][k][k], matrices[1][k][k]) = (stiffness[k], damping);
    }
    matrices[0][2][2] = 1e7;
    let row = LinearBearingRow { speed: 0.0, stiffness: matrices[0], damping: matrices[1] };
    let site = |node: usize, name: &str| BearingSite {
        name: name.into(),
        node,
        housing: Anchor::GROUND,
        bearing: Bearing::Linear(LinearBearing { table: vec![row.clone()], ..Default::default() }),
    };
    model.bearings = vec![site(0, "A"), site(10, "B")];
    model.unbalances = vec![Unbalance { name: "u".into(), node: 5, magnitude: 2e-4, phase: 0.4 }];
    model.drive = rotordyn::model::Drive::Prescribed { node: Some(0) };
    Machine::new(model).unwrap()
}

/// Amplitudes of all DOFs under unbalance.
fn amplitudes(machine: &Machine, speeds: &[f64]) -> Vec<Vec<Complex64>> {
    let tangents = |speed| machine.tangents(speed, true);
    unbalance::response(&machine.assembly, speeds, &tangents, |motion| motion.amplitude).unwrap()
}

/// Σ F_bearing + U Ω² e^{jϕ} = −Ω² Σ m x: the bearing forces balance unbalance and inertia, in both directions.
#[test]
fn bearing_forces_balance_unbalance_and_inertia() {
    let machine = on_springs([4e6, 7e6], 800.0);
    let speeds: Vec<f64> = (1..40).map(|k| 20.0 * f64::from(k)).collect();
    let study = UnbalanceStudy {
        speeds,
        refine: false,
        responses: Vec::new(),
        operating_speeds: Some([600.0, 700.0]),
    };
    let found = machine.unbalance(&study).unwrap();
    let dofs = &machine.assembly.dofs;
    for ((k, &speed), q) in found.speeds.iter().enumerate().zip(amplitudes(&machine, &found.speeds)) {
        let momentum = machine.assembly.full_mass.mul_complex(&dofs.expand_complex(&q));
        for axis in 0..2 {
            let pick = |force: &rotordyn::results::BearingForce| {
                let pair = if axis == 0 { force.x[k] } else { force.y[k] };
                Complex64::new(pair[0], pair[1])
            };
            let bearings: Complex64 = found.bearing_forces.iter().map(pick).sum();
            let unbalance = Complex64::from_polar(2e-4 * speed * speed, 0.4)
                * if axis == 0 { Complex64::new(1.0, 0.0) } else { Complex64::new(0.0, -1.0) };
            let inertia: Complex64 =
                momentum.iter().skip(axis).step_by(6).sum::<Complex64>() * (speed * speed);
            let rest = bearings + unbalance + inertia;
            let size = unbalance.norm() + bearings.norm();
            // Round-off of the stiff shaft against the forces of the bearings.
            agree::curve(format_args!("balance of forces at {speed} rad/s"), rest.norm(), size, 1e-9);
        }
    }
    // Half the weight at each bearing at rest.
    let weight = G * (12.0 + 7850.0 * PI * 4e-4);
    found.bearing_forces.iter().for_each(|b| close(b.at_rest[1], 0.5 * weight, weight));
    assert_eq!(found.shaft[1].speed, 700.0);
}

/// The section beside a bearing at the shaft's end carries the bearing's force and no moment; at the unbalance the shear
/// force changes by unbalance and inertia of the disc.
#[test]
fn sections_under_unbalance_carry_the_bearing_forces() {
    let machine = on_springs([5e6, 5e6], 500.0);
    let speed = 300.0;
    let study =
        UnbalanceStudy { speeds: vec![speed], refine: false, responses: Vec::new(), operating_speeds: None };
    let found = machine.unbalance(&study).unwrap();
    let q = machine.assembly.dofs.expand_complex(&amplitudes(&machine, &[speed])[0]);
    let sections = ShaftSections::new(&machine.model).at_speed(&q, speed);
    let complex = |[re, im]: [f64; 2]| Complex64::new(re, im);
    let [a, b] = [0, 1].map(|k| complex(found.bearing_forces[k].x[0]));
    let off = |what: &str, found: Complex64, expected: Complex64| {
        agree::curve(what, (found - expected).norm(), a.norm(), 1e-8);
    };
    off("shear force at the first bearing", sections[0].shear[0], a);
    off("shear force at the second bearing", sections[19].shear[0], -b);
    off("bending moment at the first end", sections[0].moment[0], Complex64::default());
    off("bending moment at the second end", sections[19].moment[1], Complex64::default());
    let disc = q[30] * (12.0 * speed * speed) + Complex64::from_polar(2e-4 * speed * speed, 0.4);
    off("step of the shear force at the disc", sections[10].shear[0] - sections[9].shear[0], disc);
    // Circular whirl on isotropic supports: the amplitudes are those of one direction.
    let points = &found.shaft[0].points;
    agree::relative(
        "amplitude of a circular whirl [N m]",
        points[9].moment,
        sections[9].moment[0].norm(),
        1e-8,
    );
}

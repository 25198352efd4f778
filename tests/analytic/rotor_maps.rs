//! Closed forms of the critical speed map, of log decrements on cross-coupled bearings, and of torsional modes.

use crate::agree;
use crate::machine::{disc, element, shaft};
use nalgebra::Complex;
use rotordyn::analysis::ModeKind;
use rotordyn::analysis::critical_map::MapCurve;
use rotordyn::bearing::{Bearing, LinearBearing, LinearBearingRow};
use rotordyn::element::{Anchor, Bushing, Joint, RigidBody, ShaftElement, ShearCoefficient};
use rotordyn::model::study::{CampbellStudy, CriticalMapStudy, CriticalStudy, TorsionalStudy};
use rotordyn::model::{BearingSite, Drive, Model};
use rotordyn::study::Machine;
use std::f64::consts::{PI, TAU};

/// Elements of a bar of 1 m, rigid in shear and without rotary inertia.
fn bars(diameter: f64, density: f64) -> Vec<ShaftElement> {
    let mut bar = ShaftElement {
        shear: ShearCoefficient::Rigid,
        rotary_inertia: false,
        ..element(0.05, diameter, diameter)
    };
    bar.material.density = density;
    vec![bar; 20]
}

fn rows(speeds: &[f64], matrices: impl Fn(f64) -> [[[f64; 6]; 6]; 2]) -> Vec<LinearBearingRow> {
    let row = |&speed: &f64| {
        let [stiffness, damping] = matrices(speed);
        LinearBearingRow { speed, stiffness, damping }
    };
    speeds.iter().map(row).collect()
}

fn site(node: usize, name: &str, table: Vec<LinearBearingRow>) -> BearingSite {
    let bearing = Bearing::Linear(LinearBearing { table, ..Default::default() });
    BearingSite { name: name.into(), node, housing: Anchor::GROUND, bearing }
}

fn springs(k: f64) -> [[[f64; 6]; 6]; 2] {
    let mut stiffness = [[0.0; 6]; 6];
    (stiffness[0][0], stiffness[1][1], stiffness[2][2]) = (k, k, 1e6);
    [stiffness, [[0.0; 6]; 6]]
}

fn on_springs(mut model: Model, k: f64) -> Machine {
    model.bearings =
        vec![site(0, "A", rows(&[0.0], |_| springs(k))), site(20, "B", rows(&[0.0], |_| springs(k)))];
    model.drive = Drive::Prescribed { node: Some(0) };
    Machine::new(model).unwrap()
}

fn map(machine: &Machine, [lowest, highest]: [f64; 2], max_speed: f64) -> rotordyn::results::CriticalMap {
    let study = CriticalMapStudy {
        max_speed,
        lowest_stiffness: Some(lowest),
        highest_stiffness: Some(highest),
        points: 31,
    };
    machine.critical_map(&study).unwrap()
}

/// A uniform beam: rigid-body modes √(2k/m) and √(6k/m) on soft supports, then the free-free (β L = 4.7300), and on
/// stiff ones the pinned critical speeds (β L = nπ).
#[test]
fn critical_speed_map_between_free_and_pinned_beam() {
    let (d, density) = (0.01, 7850.0);
    let machine = on_springs(shaft(bars(d, density)), 1e5);
    let area = PI / 4.0 * d * d;
    let bending = (2.1e11 * PI / 64.0 * d.powi(4) / (density * area)).sqrt();
    let found = map(&machine, [1e-2, 1e12], 3000.0);
    let last = found.stiffness.len() - 1;
    // Gyroscopic effect of the shaft, (β d)²/16 < 2e-4, and the elasticity of the beam in its rigid-body modes.
    let close = |mode: &str, speed: f64, expected: f64| {
        agree::relative(format_args!("free beam, {mode} [rad/s]"), speed, expected, 1e-3);
    };
    for n in 1..=4 {
        // E I β⁴ = Ω² (ρA − ρ I_p β²) without rotary inertia, I_p/A = d²/8; the elements add (β h)⁴/1440.
        let beta = n as f64 * PI;
        let expected = beta * beta * bending / (1.0 - beta * beta * d * d / 8.0).sqrt();
        let speed = found.curves[n - 1].speeds[last];
        agree::relative(format_args!("pinned beam, critical speed {n} [rad/s]"), speed, expected, 2e-4);
    }
    let mass = density * area;
    close("translation", found.curves[0].speeds[0], (2.0 * 1e-2 / mass).sqrt());
    close("rotation", found.curves[1].speeds[0], (6.0 * 1e-2 / mass).sqrt());
    close("1st bending", found.curves[2].speeds[0], 4.730_040_75_f64.powi(2) * bending);
    // Stiffer supports never lower a critical speed.
    for curve in &found.curves {
        let finite: Vec<f64> = curve.speeds.iter().copied().filter(|s| s.is_finite()).collect();
        assert!(finite.windows(2).all(|pair| pair[1] >= pair[0] * (1.0 - 1e-9)), "{curve:?}");
    }
}

/// A disc of 10 kg amid a light shaft: Ω² = k/m with 1/k = 1/(2 k_b) + L³/(48 E I); also where the curve meets the
/// bearings' own stiffness.
#[test]
fn critical_speed_map_of_jeffcott_rotor() {
    let mut model = shaft(bars(0.03, 1.0));
    model.discs = vec![disc(10, 10.0, 0.02, 0.01)];
    let machine = on_springs(model, 5e5);
    let shaft_stiffness = 48.0 * 2.1e11 * PI / 64.0 * 0.03_f64.powi(4);
    let closed = |k: f64| (1.0 / (1.0 / (2.0 * k) + 1.0 / shaft_stiffness) / 10.0).sqrt();
    let found = map(&machine, [1e3, 1e9], 600.0);
    for (k, speed) in found.stiffness.iter().zip(&found.curves[0].speeds) {
        // The mass of the shaft is 7e-5 of the disc's, of which 1/2 counts at most.
        agree::relative("critical speed over stiffness [rad/s]", *speed, closed(*k), 4e-5);
    }
    let over = agree::Over { name: "bearing stiffness", unit: "N/m", values: &found.stiffness };
    let expected: Vec<f64> = found.stiffness.iter().map(|k| closed(*k)).collect();
    agree::curves(
        "first critical speed of a Jeffcott rotor",
        "rad/s",
        over,
        &found.curves[0].speeds,
        &expected,
        4e-5,
    );
    let crossing = found.crossings.iter().find(|c| c.mode == found.curves[0].label).unwrap();
    assert_eq!(crossing.bearing, "A x, A y, B x, B y");
    agree::relative("stiffness of the crossing [N/m]", crossing.stiffness, 5e5, 1e-8);
    agree::relative("speed of the crossing [rad/s]", crossing.speed, closed(5e5), 4e-5);
}

/// Bearings in housings of small mass on springs that differ along x and y.
fn in_housings(mut model: Model, nodes: [usize; 2], [k_x, k_y]: [f64; 2]) -> Machine {
    for (node, name) in nodes.into_iter().zip(["A", "B"]) {
        let body = model.node_z.len() + model.bodies.len();
        let inertia = [[1e-6, 0.0, 0.0], [0.0, 1e-6, 0.0], [0.0, 0.0, 1e-6]];
        let position = [0.0, 0.0, model.node_z[node]];
        model.bodies.push(RigidBody { name: name.into(), position, mass: [1e-4; 3], inertia });
        let mut stiffness = [[0.0; 6]; 6];
        let diagonal = [k_x, k_y, 1e7, 1e5, 1e5, 1e5];
        diagonal.into_iter().enumerate().for_each(|(i, k)| stiffness[i][i] = k);
        let ends = [Anchor { node: Some(body), offset: [0.0; 3] }, Anchor { node: None, offset: position }];
        let [a, b] = ends;
        model.bushings.push(Bushing {
            name: format!("foot {name}"),
            a,
            b,
            stiffness,
            damping: [[0.0; 6]; 6],
        });
        let housing = Anchor { node: Some(body), offset: [0.0; 3] };
        model.bearings.push(BearingSite { housing, ..site(node, name, rows(&[0.0], |_| springs(1e7))) });
    }
    model.drive = Drive::Prescribed { node: Some(nodes[0]) };
    Machine::new(model).unwrap()
}

/// A disc amid a light shaft in housings softer along x than along y: two criticals, of which neither whirls one way only,
/// Ω² = k/m with 1/k = 1/(2 k_b) + 1/(2 k_h) + L³/(48 E I).
#[test]
fn critical_speed_map_has_the_modes_of_both_planes_of_unlike_housings() {
    let mut model = shaft(bars(0.03, 1.0));
    model.discs = vec![disc(10, 10.0, 0.02, 0.01)];
    let [k_x, k_y] = [4e5, 2e6];
    let machine = in_housings(model, [0, 20], [k_x, k_y]);
    let shaft_stiffness = 48.0 * 2.1e11 * PI / 64.0 * 0.03_f64.powi(4);
    let found = map(&machine, [1e3, 1e9], 600.0);
    for (step, k) in found.stiffness.iter().enumerate() {
        for housing in [k_x, k_y] {
            let flexibility = 0.5 / k + 0.5 / housing + 1.0 / shaft_stiffness;
            let expected = (1.0 / flexibility / 10.0).sqrt();
            let at = found.curves.iter().map(|curve| curve.speeds[step]);
            let nearest = at.min_by(|a, b| (a - expected).abs().total_cmp(&(b - expected).abs())).unwrap();
            agree::relative("critical speed along x or y [rad/s]", nearest, expected, 1e-4);
        }
    }
}

/// An overhung disc in such housings, with modes of either whirl direction: no curve falls, begins or has a gap where the
/// bearings become stiffer, and the lowest speed of unbalance is among them.
#[test]
fn curves_of_a_critical_speed_map_rise_whatever_the_whirl_direction() {
    for k_y in [6e6, 2e7, 8e7] {
        let mut model = shaft(bars(0.045, 7850.0));
        model.discs = vec![disc(20, 12.0, 0.25, 0.13), disc(0, 4.0, 0.02, 0.011)];
        let machine = in_housings(model, [3, 14], [5e6, k_y]);
        let found = map(&machine, [1e5, 1e10], 6000.0);
        assert!(found.curves.len() >= 4, "{} curves", found.curves.len());
        for curve in &found.curves {
            let finite = curve.speeds.iter().take_while(|speed| speed.is_finite()).count();
            assert!(finite > 0 && curve.speeds[finite..].iter().all(|speed| speed.is_nan()), "{curve:?}");
            let falls = |pair: &[f64]| pair[1] < pair[0] * (1.0 - 1e-9);
            assert!(!curve.speeds[..finite].windows(2).any(falls), "{curve:?}");
        }
        // Bearings of 1e7 N/m at that stiffness of the map.
        let study = CriticalStudy { max_speed: 6000.0, orders: vec![1.0] };
        let critical = machine.critical(&study).unwrap();
        let stiffness = found.stiffness.iter().position(|k| (k / 1e7 - 1.0).abs() < 1e-6).unwrap();
        let lateral = |kind| !matches!(kind, ModeKind::Torsional | ModeKind::Axial);
        for own in critical.crossings.list.iter().filter(|own| lateral(own.mode.kind)) {
            let near = |curve: &MapCurve| (curve.speeds[stiffness] / own.speed - 1.0).abs() < 1e-6;
            assert!(found.curves.iter().any(near), "{} rad/s, {}", own.speed, own.mode.label);
        }
    }
}

/// A rigid rotor on cross-coupled bearings k_xy = −k_yx = κΩ: m s² + c s + k − j κΩ = 0, unstable above c √(k/m)/κ.
#[test]
fn log_decrement_on_cross_coupled_bearings() {
    let (mass, k, c, kappa) = (10.0, 5e6, 300.0, 600.0);
    let mut model = shaft(Vec::new());
    model.node_z = vec![-0.2, 0.0, 0.2];
    model.rigid_rotor = Some(disc(1, mass, 1e-6, mass * 0.04 / 4.0));
    let matrices = |speed: f64| {
        let [mut stiffness, mut damping] = springs(k);
        (stiffness[0][1], stiffness[1][0]) = (kappa * speed, -kappa * speed);
        (damping[0][0], damping[1][1], damping[2][2]) = (c, c, 4000.0);
        [stiffness, damping]
    };
    let table = || rows(&[0.0, 2000.0], matrices);
    model.bearings = vec![site(0, "A", table()), site(2, "B", table())];
    model.drive = Drive::Prescribed { node: Some(1) };
    let machine = Machine::new(model).unwrap();
    let speeds: Vec<f64> = (0..17).map(|k| 50.0 * f64::from(k)).collect();
    let study = CampbellStudy { speeds, modes: 5, orders: vec![1.0], speed_dependent_bearings: true };
    let found = machine.campbell(&study).unwrap();
    let least = found.least_damped();
    assert_eq!(least.len(), 17);
    let mut closed = Vec::new();
    for point in &least {
        let root = Complex::new(4.0 * c * c - 8.0 * mass * k, 8.0 * mass * kappa * point.speed).sqrt();
        let decrement = |s: Complex<f64>| -TAU * s.re / s.im.abs();
        let expected = [1.0, -1.0]
            .map(|sign| decrement((Complex::new(-2.0 * c, 0.0) + root * sign) / (2.0 * mass)))
            .into_iter()
            .fold(f64::INFINITY, f64::min);
        agree::absolute("least log decrement", point.log_decrement, expected, 1e-9);
        closed.push(expected);
    }
    let over = agree::Over { name: "shaft speed", unit: "rad/s", values: &study.speeds };
    let ours: Vec<f64> = least.iter().map(|point| point.log_decrement).collect();
    agree::curves("least log decrement on cross-coupled bearings", "1", over, &ours, &closed, 1e-9);
    // m s² + 2 c s + 2 k = j 2 κΩ: Im gives 2 c ω = 2 κΩ.
    let threshold = c * (2.0 * k / mass).sqrt() / kappa;
    agree::relative("threshold of stability [rad/s]", found.thresholds[0].speed, threshold, 1e-9);
    assert!(found.thresholds[0].unstable_above);
}

/// Two discs at the ends of a shaft: ω² = k (J₁ + J₂)/(J₁ J₂), k = G I_p/L; driven at the first: ω² = k/J₂.
#[test]
fn torsion_of_two_discs() {
    let model = |drive: Option<usize>| {
        let mut model = shaft(bars(0.02, 1.0));
        model.discs = vec![disc(0, 5.0, 0.04, 0.02), disc(20, 5.0, 0.09, 0.05)];
        let end = |node: usize, z: f64, axial: bool| Joint {
            name: format!("pin {node}"),
            a: Anchor::node(node),
            b: Anchor { node: None, offset: [0.0, 0.0, z] },
            locked: [true, true, axial, false, false, false],
        };
        model.joints = vec![end(0, 0.0, true), end(20, 1.0, false)];
        model.drive = Drive::Prescribed { node: drive };
        Machine::new(model).unwrap()
    };
    let k = 2.1e11 / 2.6 * PI / 32.0 * 0.02_f64.powi(4);
    let study = TorsionalStudy {
        max_speed: 500.0,
        orders: vec![1.0, 2.0],
        modes: 1,
        operating_speeds: Some([100.0, 110.0]),
    };
    for (drive, square, rigid) in [(None, k * 0.13 / (0.04 * 0.09), 1), (Some(0), k / 0.09, 0)] {
        let found = model(drive).torsional(&study).unwrap();
        let omega = square.sqrt();
        let mode = &found.found.modes[0];
        // The shaft has 4e-7 of the smaller inertia.
        agree::relative("torsional natural frequency [rad/s]", TAU * mode.frequency_hz, omega, 1e-6);
        assert_eq!((found.found.rigid_rotations, found.found.coupled), (rigid, false));
        // The twists of the discs balance: J₁ θ₁ + J₂ θ₂ = 0.
        let twist = [mode.twist[0], mode.twist[20]];
        let expected = if drive.is_none() { [1.0, -0.04 / 0.09] } else { [0.0, 1.0] };
        for (found, expected) in twist.into_iter().zip(expected) {
            agree::absolute("twist of a disc", found, expected, 1e-6);
        }
        let met: Vec<f64> = found.interferences.iter().map(|i| i.speed).collect();
        assert_eq!(met.len(), 2);
        agree::relative("speed at which 2x meets it [rad/s]", met[0], 0.5 * omega, 1e-6);
        agree::relative("speed at which 1x meets it [rad/s]", met[1], omega, 1e-6);
        for i in &found.interferences {
            let expected = if i.speed < 100.0 { 1.0 - i.speed / 100.0 } else { i.speed / 110.0 - 1.0 };
            agree::absolute(
                "separation from 100 to 110 rad/s",
                i.separation.unwrap(),
                expected.max(0.0),
                1e-12,
            );
        }
    }
}

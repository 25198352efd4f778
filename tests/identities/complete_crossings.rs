//! Critical speeds are complete: crossings listed are those that the dense spectrum shows on a fine grid of speeds.

use crate::machine::{disc, element, shaft};
use nalgebra::{Cholesky, DMatrix};
use rayon::prelude::*;
use rotordyn::analysis::critical_speed::CriticalSpeed;
use rotordyn::assembly::LinearSystem;
use rotordyn::bearing::{Bearing, LinearBearing, LinearBearingRow};
use rotordyn::element::{Anchor, Bushing, Joint, RigidBody};
use rotordyn::linalg::Complex64;
use rotordyn::model::study::{CampbellStudy, CriticalStudy, ModalStudy};
use rotordyn::model::{BearingSite, Model};
use rotordyn::study::Machine;
use std::f64::consts::TAU;

/// Uniform numbers in [0, 1) (linear congruential).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    /// Evenly distributed over decades.
    fn decades(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.next())
    }

    fn chance(&mut self, probability: f64) -> bool {
        self.next() < probability
    }
}

type Matrix = [[f64; 6]; 6];

/// Stiffness and damping in the plane, unequal along x and y, with cross terms.
fn plane_matrices(r: &mut Random) -> [Matrix; 2] {
    let [mut k, mut c] = [[[0.0; 6]; 6]; 2];
    let base = r.decades(3e5, 1e8);
    (k[0][0], k[1][1]) = (base, base * r.between(0.3, 1.5));
    let cross = base * r.between(-0.2, 0.2);
    match (r.next() * 4.0) as usize {
        0 => (k[0][1], k[1][0]) = (cross, cross),
        1 => (k[0][1], k[1][0]) = (cross, -cross),
        2 => (k[0][1], k[1][0]) = (cross, 0.3 * cross),
        _ => {}
    }
    if r.chance(0.7) {
        let damping = base * r.decades(1e-6, 5e-5);
        (c[0][0], c[1][1]) = (damping, damping * r.between(0.5, 1.5));
    }
    [k, c]
}

/// A bearing with constant or tabulated matrices.
fn bearing(r: &mut Random, top: f64) -> Bearing {
    let [k, c] = plane_matrices(r);
    let rows = if r.chance(0.5) { 1 } else { 4 };
    let table = (0..rows)
        .map(|row| {
            let factor = if row == 0 { 1.0 } else { r.decades(0.2, 20.0) };
            let scale = |m: &Matrix| m.map(|line| line.map(|v| v * factor));
            LinearBearingRow { speed: top * f64::from(row) / 3.0, stiffness: scale(&k), damping: scale(&c) }
        })
        .collect();
    Bearing::Linear(LinearBearing { table, ..Default::default() })
}

/// A shaft with discs on two bearings, on ground or on a sprung housing.
fn machine(r: &mut Random) -> (Model, f64) {
    let top = r.decades(100.0, 1500.0);
    let count = 2 + (r.next() * 2.0) as usize;
    let mut elements = Vec::new();
    for _ in 0..count {
        let [length, d] = [r.between(0.08, 0.25), r.between(0.015, 0.06)];
        let mut e = element(length, d, d * r.between(0.8, 1.2));
        if r.chance(0.3) {
            e.proportional_damping = [r.between(0.0, 5.0), r.decades(1e-7, 5e-6)];
        }
        if r.chance(0.15) {
            e.internal_viscous = r.decades(1e-7, 1e-6);
        }
        elements.push(e);
    }
    let mut model = shaft(elements);
    model.gravity = [0.0; 3];
    for _ in 0..1 + (r.next() * 3.0) as usize {
        let node = (r.next() * (count + 1) as f64) as usize;
        let (mass, radius) = (r.between(0.5, 20.0), r.between(0.04, 0.2));
        model.discs.push(disc(
            node,
            mass,
            0.5 * mass * radius * radius,
            mass * radius * radius * r.between(0.25, 0.6),
        ));
    }
    let mut nodes = vec![0, count - (r.next() * 2.0) as usize];
    if r.chance(0.2) {
        nodes.push(count / 2);
    }
    nodes.sort_unstable();
    nodes.dedup();
    for (k, node) in nodes.into_iter().enumerate() {
        let mut housing = Anchor::GROUND;
        if r.chance(0.3) {
            let body = model.node_z.len() + model.bodies.len();
            let mass = r.between(1.0, 30.0);
            let j = mass * 0.01;
            let name = format!("housing {k}");
            let position = [0.0, 0.0, model.node_z[node]];
            let inertia = [[j, 0.0, 0.0], [0.0, j, 0.0], [0.0, 0.0, j]];
            model.bodies.push(RigidBody { name: name.clone(), position, mass: [mass; 3], inertia });
            housing = Anchor::node(body);
            let [stiffness, damping] = plane_matrices(r);
            let locked = [false, false, true, true, true, true];
            model.joints.push(Joint { name: name.clone(), a: housing, b: Anchor::GROUND, locked });
            model.bushings.push(Bushing { name, a: housing, b: Anchor::GROUND, stiffness, damping });
        }
        model.bearings.push(BearingSite { name: format!("b{k}"), node, housing, bearing: bearing(r, top) });
    }
    // Most machines without axial and torsional motion, to have more lateral modes in little time.
    let free = r.chance(0.2);
    for node in 0..=count {
        let locked = [false, false, !free || node == 0, false, false, !free || node == 0];
        if locked.contains(&true) {
            let name = format!("guide {node}");
            model.joints.push(Joint { name, a: Anchor::node(node), b: Anchor::GROUND, locked });
        }
    }
    if r.chance(0.3) {
        model.damping.proportional = [r.between(0.0, 10.0), r.decades(1e-7, 5e-6)];
    }
    if r.chance(0.25) {
        model.damping.modal = vec![[0.0, r.between(0.0, 0.03)], [200.0, r.between(0.0, 0.03)]];
    }
    (model, top)
}

/// Damped frequencies and damping ratios of the oscillatory modes with |λ| < `reach`, by frequency, and the number of
/// other eigenvalues in that circle: eigenvalues of the dense state matrix by its Schur form.
fn dense_spectrum(system: &LinearSystem, reach: f64) -> (Vec<(f64, f64)>, usize) {
    let [m, d, s] = [&system.mass, &system.full_damping(), &system.stiffness].map(|m| m.to_dense());
    let n = m.nrows();
    let mass = Cholesky::new(m).unwrap();
    // Time scaled by the highest frequency: both halves of the state have the same size.
    let (s, d) = (mass.solve(&s), mass.solve(&d));
    let t = 1.0 / s.row_iter().map(|r| r.iter().map(|v| v.abs()).sum::<f64>()).fold(0.0, f64::max).sqrt();
    let mut state = DMatrix::zeros(2 * n, 2 * n);
    state.view_mut((0, n), (n, n)).fill_with_identity();
    state.view_mut((n, 0), (n, n)).copy_from(&(s * (-t * t)));
    state.view_mut((n, n), (n, n)).copy_from(&(d * -t));
    let values: Vec<Complex64> =
        state.complex_eigenvalues().iter().map(|v| v / t).filter(|v| v.norm() < reach).collect();
    let mut modes: Vec<(f64, f64)> =
        values.iter().filter(|v| v.im > 1e-2).map(|v| (v.im, -v.re / v.norm())).collect();
    modes.sort_by(|a, b| a.0.total_cmp(&b.0));
    let others = values.len() - 2 * modes.len();
    (modes, others)
}

/// Brackets of the crossings of every place in the dense spectrum with ω = n Ω, and whether the frequency comes to lie
/// above the line.
fn brackets(grid: &[(f64, Vec<(f64, f64)>)], order: f64) -> Vec<([f64; 2], bool)> {
    let mut found = Vec::new();
    for step in grid.windows(2) {
        let [(a, left), (b, right)] = step else { unreachable!() };
        for (l, r) in left.iter().zip(right) {
            let (ga, gb) = (l.0 - order * a, r.0 - order * b);
            if (ga > 0.0) != (gb > 0.0) && r.1.max(l.1) < 0.6 {
                found.push(([*a, *b], gb > 0.0));
            }
        }
    }
    found
}

const MACHINES: usize = 200;
const SPEEDS: usize = 100;
const ORDERS: [f64; 4] = [1.0, 2.0, 3.0, 4.0];

/// What was compared.
#[derive(Default)]
struct Comparison {
    crossings: usize,
    upward: usize,
    tabulated: bool,
    errors: Vec<String>,
}

/// Compares one machine; `None` if modes become overdamped, so that places in the spectrum change by a jump.
fn compare(seed: usize) -> Option<Comparison> {
    let mut r = Random((seed as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
    r.next();
    let (model, top) = machine(&mut r);
    let is_tabulated = |site: &BearingSite| matches!(&site.bearing, Bearing::Linear(b) if b.table.len() > 1);
    let tabulated = model.bearings.iter().any(is_tabulated);
    let machine = Machine::new(model).unwrap();
    let reach = 2.0 * ORDERS[3] * top;
    let dense = |speed: f64| dense_spectrum(&machine.linear_system(speed).unwrap(), reach);
    let mut grid = Vec::new();
    let mut others = None;
    for k in 1..=SPEEDS {
        let speed = top * k as f64 / SPEEDS as f64;
        let (modes, real) = dense(speed);
        if *others.get_or_insert(real) != real || modes.iter().any(|(_, zeta)| *zeta > 0.8) {
            return None;
        }
        grid.push((speed, modes));
    }
    let mut out = Comparison { tabulated, ..Comparison::default() };
    let found = machine.critical(&CriticalStudy { max_speed: top, orders: ORDERS.to_vec() }).unwrap();
    if !found.crossings.uncertain.is_empty() {
        out.errors.push(format!("machine {seed}: {:?}", found.crossings.uncertain));
    }
    for order in ORDERS {
        let expected = brackets(&grid, order);
        let within = |c: &&CriticalSpeed| c.order == order && c.mode.zeta() < 0.6 && c.speed > grid[0].0;
        let speeds: Vec<f64> = found.crossings.list.iter().filter(within).map(|c| c.speed).collect();
        let inside = |(speed, ([from, to], _)): (&f64, &([f64; 2], bool))| (*from..=*to).contains(speed);
        out.upward += expected.iter().filter(|(_, upward)| *upward).count();
        if speeds.len() != expected.len() || !speeds.iter().zip(&expected).all(inside) {
            out.errors.push(format!("machine {seed}, order {order}: {speeds:?} for {expected:?}"));
        }
        for speed in speeds {
            let line = order * speed;
            let nearest = dense(speed).0.iter().map(|(w, _)| (w / line - 1.0).abs()).fold(1.0, f64::min);
            if nearest > 1e-7 {
                out.errors
                    .push(format!("machine {seed}, order {order}: {speed} is {nearest:e} off the line"));
            }
            out.crossings += 1;
        }
    }
    Some(out)
}

/// 200 machines, orders 1 to 4: none missing, none invented.
#[test]
fn critical_speeds_are_those_of_the_dense_spectrum() {
    // Up to a tenth of the machines may have overdamped modes.
    let all: Vec<Comparison> = (0..MACHINES + MACHINES / 10).into_par_iter().filter_map(compare).collect();
    let errors: Vec<&String> = all.iter().flat_map(|c| &c.errors).collect();
    assert!(errors.is_empty(), "{errors:#?}");
    let sum = |count: fn(&Comparison) -> usize| all.iter().map(count).sum::<usize>();
    let (total, upward, tabulated) =
        (sum(|c| c.crossings), sum(|c| c.upward), sum(|c| usize::from(c.tabulated)));
    println!("{} machines, {tabulated} with tables: {total} crossings, {upward} upward", all.len());
    assert!(all.len() >= MACHINES && total > 1000 && upward > 10 && tabulated > 50);
}

/// Labels at a crossing and in a Campbell diagram are those of the modal analysis at that speed, however far the
/// sweep goes.
#[test]
fn labels_are_those_at_the_point_shown() {
    let mut compared = 0;
    for seed in 1_u64..6 {
        let mut r = Random(seed);
        r.next();
        let (model, top) = machine(&mut r);
        let machine = Machine::new(model).unwrap();
        let modal = |speed: f64| {
            machine.modal(&ModalStudy { speeds: vec![speed], modes: 12 }).unwrap().remove(0).modes
        };
        let critical = |max_speed: f64| {
            machine.critical(&CriticalStudy { max_speed, orders: vec![1.0, 2.0] }).unwrap().crossings.list
        };
        let (short, long) = (critical(0.4 * top), critical(top));
        compared += short.len();
        for c in &long {
            let modes = modal(c.speed);
            let same = modes
                .iter()
                .find(|m| (m.eigenvalue - c.mode.eigenvalue).norm() < 1e-7 * c.mode.natural_omega());
            let same = same.expect("the mode of a crossing is among the modes at its speed");
            assert_eq!(
                (&same.label, same.kind),
                (&c.mode.label, c.mode.kind),
                "{} rpm",
                c.speed * 60.0 / TAU
            );
        }
        for (a, b) in short.iter().zip(&long) {
            assert!((a.speed / b.speed - 1.0).abs() < 1e-9 && a.mode.label == b.mode.label);
        }
        let speeds: Vec<f64> = (0..13).map(|k| top * f64::from(k) / 12.0).collect();
        let study = |count: usize| CampbellStudy {
            speeds: speeds[..count].to_vec(),
            modes: 6,
            orders: vec![1.0],
            speed_dependent_bearings: true,
        };
        let diagram = machine.campbell(&study(13)).unwrap().diagram;
        for (k, speed) in speeds.iter().enumerate() {
            let modes = modal(*speed);
            for mode in diagram.branches.iter().filter_map(|b| b.modes[k].as_ref()) {
                let same = |m: &&rotordyn::analysis::Mode| {
                    (m.eigenvalue - mode.eigenvalue).norm() < 1e-7 * mode.natural_omega()
                        && m.label == mode.label
                };
                assert!(modes.iter().any(|m| same(&m)), "{} at {speed}", mode.label);
            }
        }
        let shorter = machine.campbell(&study(5)).unwrap().diagram;
        for (a, b) in diagram.branches.iter().zip(&shorter.branches) {
            assert_eq!((&a.label, a.kind), (&b.label, b.kind));
        }
    }
    assert!(compared > 5);
}

/// A disc on bearings whose damping falls with speed: overdamped at low speed, oscillatory above; that changes the
/// number of modes below the line without a crossing.
#[test]
fn a_mode_that_becomes_oscillatory_is_no_crossing() {
    let (mass, stiffness) = (10.0, 4e6);
    let critical = 2.0 * f64::sqrt(mass * stiffness);
    // ζ = 1.6 at standstill, 0.01 from 300 rad/s on; ω = 632 rad/s is crossed by order 1 only at the end.
    let row = |speed: f64, zeta: f64| {
        let [mut k, mut c] = [[[0.0; 6]; 6]; 2];
        (k[0][0], k[1][1], k[2][2]) = (stiffness, 1.21 * stiffness, stiffness);
        (c[0][0], c[1][1]) = (zeta * critical, 0.01 * critical);
        LinearBearingRow { speed, stiffness: k, damping: c }
    };
    let mut model = shaft(vec![element(0.02, 0.05, 0.05)]);
    model.gravity = [0.0; 3];
    for e in &mut model.shaft {
        e.material.density = 1e-3;
    }
    model.discs.push(disc(0, mass, 1.0, 0.6));
    let table = vec![row(0.0, 1.6), row(150.0, 1.2), row(300.0, 0.01), row(1000.0, 0.01)];
    let bearing = Bearing::Linear(LinearBearing { table, ..Default::default() });
    model.bearings.push(BearingSite { name: "b".into(), node: 0, housing: Anchor::GROUND, bearing });
    for node in 0..2 {
        let locked = [node == 1, node == 1, false, true, true, true];
        let name = format!("guide {node}");
        model.joints.push(Joint { name, a: Anchor::node(node), b: Anchor::node(0), locked });
        if node == 0 {
            let locked = [false, false, true, true, true, true];
            let joint = model.joints.last_mut().unwrap();
            (joint.b, joint.locked) = (Anchor::GROUND, locked);
        }
    }
    let machine = Machine::new(model).unwrap();
    let omega = |k: f64| (k / mass).sqrt();
    // ω_d = n Ω at ω √(1 − ζ²)/n; the order line 4 passes the frequency along x while that mode is overdamped.
    for (order, count) in [(1.0, 2), (2.0, 2), (4.0, 1)] {
        let found =
            machine.critical(&CriticalStudy { max_speed: 900.0, orders: vec![order] }).unwrap().crossings;
        assert!(found.uncertain.is_empty());
        // With falling damping its frequency rises from zero and crosses the lower lines upward, strongly damped.
        let light = found.list.iter().filter(|c| c.mode.zeta() < 0.6);
        let speeds: Vec<f64> = light.map(|c| c.speed).collect();
        assert_eq!(speeds.len(), count, "{order}: {speeds:?}");
        let along_y = omega(1.21 * stiffness) * (1.0f64 - (0.01f64 / 1.1).powi(2)).sqrt() / order;
        assert!(speeds.iter().any(|s| (s / along_y - 1.0).abs() < 1e-6), "{order}: {speeds:?} {along_y}");
        if order < 3.0 {
            let along_x = omega(stiffness) * (1.0f64 - 1e-4).sqrt() / order;
            assert!(speeds.iter().any(|s| (s / along_x - 1.0).abs() < 1e-6), "{order}: {speeds:?} {along_x}");
        }
    }
}

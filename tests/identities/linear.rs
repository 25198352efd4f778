//! Mass, stiffness and gyroscopic matrices, rigid-body motion, gyroscopic splitting, exact joints.

use crate::machine::{disc, element, shaft};
use nalgebra::{Cholesky, DMatrix};
use proptest::prelude::*;
use rotordyn::analysis::{ModeKind, modal};
use rotordyn::assembly::{Assembly, LinearSystem};
use rotordyn::bearing::{Bearing, LinearBearing, LinearBearingRow};
use rotordyn::element::{Anchor, Bushing, Joint, PointMass, RigidBody};
use rotordyn::linalg::{Complex64, SparseMatrix, eigen, krylov};
use rotordyn::model::{BearingSite, Model};

prop_compose! {
    /// A stepped and tapered shaft with two discs and a body attached by a bushing, without supports
    /// (free-free).
    fn free_machine()(
        sections in prop::collection::vec((0.02..0.2f64, 0.01..0.08f64, 0.01..0.08f64, 0.0..0.8f64), 3..7),
        discs in prop::collection::vec((0.0..1.0f64, 0.5..30.0f64, 0.02..0.2f64), 2),
        at in prop::array::uniform3(-0.3..0.3f64),
        stiffness in prop::collection::vec(-1.0..1.0f64, 36),
        body in (0.5..50.0f64, 0.05..0.3f64),
    ) -> Model {
        let shaft_elements: Vec<_> = sections.iter().map(|&(length, left, right, hollow)| {
            let mut e = element(length, left, right);
            e.inner_diameter = [hollow * left, hollow * right];
            e
        }).collect();
        let nodes = shaft_elements.len() + 1;
        let mut model = shaft(shaft_elements);
        for (place, mass, radius) in discs {
            let node = (place * nodes as f64) as usize;
            model.discs.push(disc(node, mass, mass * radius * radius, 0.6 * mass * radius * radius));
        }
        let (mass, radius) = body;
        let j = mass * radius * radius;
        model.bodies.push(RigidBody {
            name: "block".into(),
            position: [at[0], at[1], at[2] + 0.1],
            mass: [mass; 3],
            inertia: [[j, 0.1 * j, 0.0], [0.1 * j, 1.2 * j, 0.05 * j], [0.0, 0.05 * j, 0.9 * j]],
        });
        model.masses.push(PointMass {
            name: "sensor".into(),
            anchor: Anchor { node: Some(nodes), offset: [0.1, -0.2, 0.05] },
            mass: [0.1; 3],
        });
        // K = Aᵀ A is a legal stiffness, full and positive.
        let a = DMatrix::from_row_slice(6, 6, &stiffness);
        let k = a.transpose() * &a * 1e6 + DMatrix::identity(6, 6) * 1e5;
        // Both ends of the bushing meet at the shaft's node 1.
        let z = model.node_z[1];
        model.bushings.push(Bushing {
            name: "hanger".into(),
            a: Anchor::node(1),
            b: Anchor { node: Some(nodes), offset: [-at[0], -at[1], z - at[2] - 0.1] },
            stiffness: std::array::from_fn(|i| std::array::from_fn(|j| k[(i, j)])),
            damping: [[0.0; 6]; 6],
        });
        model
    }
}

fn isotropic(node: usize, stiffness: f64) -> BearingSite {
    let mut k = [[0.0; 6]; 6];
    (0..3).for_each(|i| k[i][i] = stiffness);
    let row = LinearBearingRow { speed: 0.0, stiffness: k, damping: [[0.0; 6]; 6] };
    BearingSite {
        name: "bearing".into(),
        node,
        housing: Anchor::GROUND,
        bearing: Bearing::Linear(LinearBearing { table: vec![row], ..Default::default() }),
    }
}

fn tangents(model: &Model) -> Vec<rotordyn::bearing::SiteTangent> {
    let one = |b: &BearingSite| match &b.bearing {
        Bearing::Linear(b) => rotordyn::bearing::LinearElement::new(b).tangent(0.0),
        _ => unreachable!("only linear bearings are built here"),
    };
    model.bearings.iter().map(one).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, rng_seed: proptest::test_runner::RngSeed::Fixed(1), ..ProptestConfig::default() })]

    #[test]
    fn matrix_symmetries(model in free_machine()) {
        let assembly = Assembly::new(&model).unwrap();
        let (m, k, g) = (assembly.mass.to_dense(), assembly.stiffness.to_dense(), assembly.gyroscopic.to_dense());
        prop_assert!((&m - m.transpose()).amax() <= 1e-14 * m.amax());
        prop_assert!((&k - k.transpose()).amax() <= 1e-14 * k.amax());
        prop_assert!((&g + g.transpose()).amax() <= 1e-14 * g.amax());
        prop_assert!(Cholesky::new(m).is_some());
    }

    #[test]
    fn rigid_body_modes_have_no_strain_energy_and_full_mass(model in free_machine()) {
        let assembly = Assembly::new(&model).unwrap();
        let nodes = model.node_count();
        let position = |node: usize| match node.checked_sub(model.node_z.len()) {
            None => [0.0, 0.0, model.node_z[node]],
            Some(b) => model.bodies[b].position,
        };
        let total: f64 = model.shaft.iter().map(|e| e.mass()).sum::<f64>()
            + model.discs.iter().map(|d| d.mass).sum::<f64>()
            + model.bodies.iter().map(|b| b.mass[0]).sum::<f64>()
            + model.masses.iter().map(|m| m.mass[0]).sum::<f64>();
        for motion in 0..6 {
            let mut q = vec![0.0; 6 * nodes];
            for node in 0..nodes {
                let [x, y, z] = position(node);
                let u = &mut q[6 * node..6 * node + 6];
                u[motion] = 1.0;
                match motion {
                    3 => (u[1], u[2]) = (-z, y),
                    4 => (u[0], u[2]) = (z, -x),
                    5 => (u[0], u[1]) = (-y, x),
                    _ => {}
                }
            }
            // Forces against the largest entry of K times a displacement of about one.
            let force = assembly.stiffness.mul(&q).iter().fold(0.0, |m: f64, f| m.max(f.abs()));
            prop_assert!(force <= 1e-12 * assembly.stiffness.max_abs(), "{motion}: {force}");
            if motion < 3 {
                let kinetic: f64 = assembly.mass.mul(&q).iter().zip(&q).map(|(p, q)| p * q).sum();
                prop_assert!((kinetic / total - 1.0).abs() < 1e-12);
            }
        }
        let system = LinearSystem::new(&assembly, &[], 0.0).unwrap();
        let free = rotordyn::assembly::rigid_body_modes::rigid_body_modes_of(&assembly, &system).unwrap();
        prop_assert!(free.iter().any(|motion| motion.starts_with("lateral")), "{free:?}");
    }

    #[test]
    fn gyroscopic_split_is_proportional_to_speed(mut model in free_machine()) {
        model.bodies.clear();
        model.bushings.clear();
        model.masses.clear();
        let last = model.node_z.len() - 1;
        model.bearings = vec![isotropic(0, 1e7), isotropic(last, 3e7)];
        let assembly = Assembly::new(&model).unwrap();
        let split = |speed: f64| {
            let system = LinearSystem::new(&assembly, &tangents(&model), speed).unwrap();
            let modes = modal::modes(&assembly, &system, 6).unwrap();
            let first = |kind| modes.iter().find(|m| m.kind == kind).map(|m| m.omega());
            match (first(ModeKind::Forward), first(ModeKind::Backward)) {
                (Some(f), Some(b)) => (f - b) / (f + b),
                _ => f64::NAN,
            }
        };
        let (fast, slow) = (split(2.0), split(1.0));
        // The split is odd in speed, so that halving the speed halves it up to terms of third order; 1e-9 is
        // the accuracy of the eigenvalues of a stiff random machine.
        prop_assert!(fast > 0.0 && (fast - 2.0 * slow).abs() < 1e-4 * fast + 1e-9, "{fast} {slow}");
        // At rest the pair is one frequency in two planes.
        let system = LinearSystem::new(&assembly, &tangents(&model), 0.0).unwrap();
        let modes = modal::modes(&assembly, &system, 6).unwrap();
        let bending: Vec<_> = modes.iter().filter(|m| m.kind.is_bending()).collect();
        prop_assert!((bending[0].omega() / bending[1].omega() - 1.0).abs() < 1e-7);
        prop_assert_eq!(bending[0].kind, ModeKind::PlaneX);
        prop_assert_eq!(bending[1].kind, ModeKind::PlaneY);
    }

    #[test]
    fn fixed_joint_merges_two_bodies(model in free_machine()) {
        // The block rigidly connected to node 1 by a joint.
        let mut jointed = model.clone();
        let bushing = jointed.bushings.remove(0);
        jointed.joints.push(Joint { name: "fixed".into(), a: bushing.a, b: bushing.b, locked: [true; 6] });
        // A redundant second joint adds nothing.
        jointed.joints.push(Joint { name: "again".into(), a: bushing.b, b: bushing.a, locked: [true; 6] });
        let assembly = Assembly::new(&jointed).unwrap();
        prop_assert_eq!(assembly.dofs.len(), 6 * model.node_z.len());
        let block = Anchor { node: Some(model.node_z.len()), offset: [0.0; 3] };
        // The block's motion follows the node's as a rigid body.
        let r = bushing.b.offset;
        let rows = assembly.anchor_rows(&block);
        let node = assembly.anchor_rows(&Anchor { node: Some(1), offset: r.map(|v| -v) });
        let q: Vec<f64> = (0..assembly.dofs.len()).map(|k| (k as f64 * 0.7).sin()).collect();
        for (a, b) in rows.iter().zip(&node) {
            prop_assert!((a.dot(&q) - b.dot(&q)).abs() < 1e-12);
        }
        // The gravity load sums to the total weight.
        let weight = |a: &Assembly| -> f64 {
            let mut up = vec![0.0; a.dofs.full_len()];
            up.iter_mut().skip(1).step_by(6).for_each(|v| *v = 1.0);
            a.full_mass.mul(&up).iter().zip(&up).map(|(p, u)| p * u).sum::<f64>() * 9.80665
        };
        let load: f64 = (0..model.node_z.len()).map(|n| {
            let row = &assembly.anchor_rows(&Anchor::node(n))[1];
            row.0.iter().map(|&(i, v)| v * assembly.gravity_load[i]).sum::<f64>()
        }).sum();
        prop_assert!((load / weight(&assembly) + 1.0).abs() < 1e-12);
    }

    #[test]
    fn lowest_modes_match_the_dense_solver(mut model in free_machine(), axisymmetric in any::<bool>()) {
        if axisymmetric {
            // Axisymmetric: every bending frequency is double at rest, the body's too.
            let nodes = model.node_z.len();
            model.masses.clear();
            let j = model.bodies[0].inertia[0][0];
            model.bodies[0].position = [0.0, 0.0, model.node_z[1]];
            model.bodies[0].inertia = [[j, 0.0, 0.0], [0.0, j, 0.0], [0.0, 0.0, 1.5 * j]];
            let hanger = &mut model.bushings[0];
            hanger.b = Anchor::node(nodes);
            hanger.stiffness = [[0.0; 6]; 6];
            for (i, k) in [2e6, 2e6, 1e6, 3e4, 3e4, 1e4].into_iter().enumerate() {
                hanger.stiffness[i][i] = k;
            }
        }
        let last = model.node_z.len() - 1;
        model.bearings = vec![isotropic(0, 1e7), isotropic(last, 3e7)];
        let assembly = Assembly::new(&model).unwrap();
        for speed in [0.0, 5.0, 500.0] {
            let system = LinearSystem::new(&assembly, &tangents(&model), speed).unwrap();
            let (m, d, s) = (&system.mass, &system.damping, &system.stiffness);
            let mut dense: Vec<f64> = eigen::quadratic(&m.to_dense(), &d.to_dense(), &s.to_dense())
                .unwrap()
                .iter()
                .filter(|p| p.0.im > 1.0)
                .map(|p| p.0.norm())
                .collect();
            dense.sort_by(f64::total_cmp);
            let lowest = krylov::lowest_eigenpairs(m, d, s, 10, 30.0).unwrap();
            for (k, (pair, dense)) in lowest.iter().zip(&dense).take(10).enumerate() {
                // The dense solver's round-off is that of the fastest mode: up to 1e-6 of a slow one.
                let deviation = (pair.value.norm() / dense - 1.0).abs();
                prop_assert!(deviation < 1e-5, "mode {k} at {speed} rad/s: {deviation:e} (axisymmetric {axisymmetric})");
                // The vector belongs to the value: φᴴ (λ² M + λ D + S) φ = 0, in parts of λ² φᴴ M φ.
                let form = |a: &SparseMatrix| -> Complex64 {
                    let image = a.mul_complex(&pair.vector);
                    pair.vector.iter().zip(&image).map(|(v, w)| v.conj() * w).sum()
                };
                let inertia = pair.value * pair.value * form(m);
                let rest = (inertia + pair.value * form(d) + form(s)).norm() / inertia.norm();
                prop_assert!(rest < 1e-6, "mode {k} at {speed} rad/s: {rest:e} (axisymmetric {axisymmetric})");
            }
        }
    }
}

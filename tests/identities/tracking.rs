//! Mode tracking over speed: modes of a double eigenvalue span one subspace, in whichever basis the solver
//! returns it.

use crate::machine::{disc, element, shaft};
use rotordyn::analysis::ModeKind;
use rotordyn::analysis::campbell::campbell;
use rotordyn::assembly::Assembly;
use rotordyn::element::{Anchor, Joint};
use std::sync::atomic::{AtomicUsize, Ordering};

/// An axisymmetric rotor has pairs of planar modes at standstill and whirl modes at speed: each whirl mode
/// has MAC ½ with either planar mode, but the subspace is the same, so that no intermediate speeds are
/// needed.
#[test]
fn planar_modes_link_to_whirl_modes_without_intermediate_speeds() {
    let mut model = shaft(vec![element(0.1, 0.03, 0.03); 8]);
    model.discs.push(disc(3, 10.0, 0.08, 0.05));
    for (node, axial) in [(0, true), (8, false)] {
        let locked = [true, true, axial, false, false, axial];
        model.joints.push(Joint { name: "pin".into(), a: Anchor::node(node), b: Anchor::GROUND, locked });
    }
    let assembly = Assembly::new(&model).unwrap();
    for speeds in [vec![0.0, 20.0], vec![-20.0, 0.0], vec![-20.0, 0.0, 20.0]] {
        let calls = AtomicUsize::new(0);
        let tangents = |_: f64| {
            calls.fetch_add(1, Ordering::Relaxed);
            Ok(Vec::new())
        };
        let diagram = campbell(&assembly, &speeds, 2, &tangents).unwrap();
        assert_eq!(calls.load(Ordering::Relaxed), speeds.len(), "{speeds:?}");
        for branch in &diagram.branches {
            assert!(
                branch.modes.iter().all(Option::is_some),
                "branch {} not tracked at every speed",
                branch.label
            );
        }
        // One branch is forward whirl, the other backward.
        if speeds[speeds.len() - 1] > 0.0 {
            let kinds: Vec<ModeKind> = diagram.branches.iter().map(|b| b.kind).collect();
            assert!(kinds.contains(&ModeKind::Forward) && kinds.contains(&ModeKind::Backward), "{kinds:?}");
        }
    }
}

//! Modes followed over speed: a pair of one frequency is one plane of shapes, whichever two of them a solver gives.

use crate::machine::{disc, element, shaft};
use rotordyn::analysis::ModeKind;
use rotordyn::analysis::campbell::campbell;
use rotordyn::assembly::Assembly;
use rotordyn::element::{Anchor, Joint};
use std::sync::atomic::{AtomicUsize, Ordering};

/// At rest an axisymmetric rotor has pairs in planes, beside it whirls: each whirl is half of either plane's mode, but
/// the plane of shapes stays the same, and nothing is in doubt that would call for speeds in between.
#[test]
fn planes_go_over_into_whirls_without_doubt() {
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
            assert!(branch.modes.iter().all(Option::is_some), "{} is lost", branch.label);
        }
        // Every branch goes its own way: one forward and one backward.
        if speeds[speeds.len() - 1] > 0.0 {
            let kinds: Vec<ModeKind> = diagram.branches.iter().map(|b| b.kind).collect();
            assert!(kinds.contains(&ModeKind::Forward) && kinds.contains(&ModeKind::Backward), "{kinds:?}");
        }
    }
}

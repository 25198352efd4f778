//! Modes of an axisymmetric rotor: planar at rest, forward and backward whirl with rotation.

use rotordyn::analysis::{ModeKind, modal};
use rotordyn::model::{Options, load};
use rotordyn::study::Machine;
use std::f64::consts::TAU;

#[test]
fn double_modes_are_planar_only_at_rest() {
    let text = include_str!("../../models/jeffcott.toml");
    let model = load("jeffcott.toml", text, &Options::default()).unwrap().model;
    let machine = Machine::new(model).unwrap();
    for rpm in [0.0, 10.0] {
        let system = machine.linear_system(rpm / 60.0 * TAU).unwrap();
        let modes = modal::modes(&machine.assembly, &system, 14).unwrap();
        let bending: Vec<_> = modes.iter().filter(|m| m.kind.is_bending()).collect();
        assert!(bending.len() >= 8);
        for mode in &bending {
            println!("{rpm} rpm: {:?} {}", mode.eigenvalue, mode.label);
        }
        for pair in bending.chunks_exact(2) {
            let mut kinds = [pair[0].kind, pair[1].kind];
            kinds.sort_by_key(|k| *k as u8);
            // 10 rpm split the pairs by 1e-6 of their frequency, a thousand times their error.
            let expected = if rpm == 0.0 {
                [ModeKind::PlaneX, ModeKind::PlaneY]
            } else {
                [ModeKind::Forward, ModeKind::Backward]
            };
            assert_eq!(kinds, expected, "{rpm} rpm, {} Hz", pair[0].frequency_hz());
            if rpm == 0.0 {
                let (x, y) = (&pair[0].energy, &pair[1].energy);
                assert!(x.bending_y.min(x.bending_x) < 1e-6 && y.bending_x.min(y.bending_y) < 1e-6);
            }
        }
    }
}

/// Dampers that are not in proportion to the stiffness make the orbits of a shaft at rest ellipses: its modes are still those
/// of two planes, each number once in each. Cross-coupled springs whirl at rest too.
#[test]
fn modes_at_rest_are_planar_whatever_the_damping() {
    let text = include_str!("../../benches/rotor_40.toml");
    let kinds = |text: &str, rpm: f64| {
        let model = load("rotor.toml", text, &Options::default()).unwrap().model;
        let machine = Machine::new(model).unwrap();
        let system = machine.linear_system(rpm / 60.0 * TAU).unwrap();
        let modes = modal::modes(&machine.assembly, &system, 8).unwrap();
        let bending = modes.into_iter().filter(|mode| mode.kind.is_bending());
        bending.map(|mode| (mode.kind, mode.label)).collect::<Vec<_>>()
    };
    let planar = |kind: &ModeKind| matches!(kind, ModeKind::PlaneX | ModeKind::PlaneY);
    // Dampers that couple x and y in one bearing only.
    let damped = text.replacen(
        "c_xx = \"200 N s/m\"",
        "c_xx = \"900 N s/m\"\nc_xy = \"400 N s/m\"\nc_yx = \"400 N s/m\"",
        1,
    );
    let at_rest = kinds(&damped, 0.0);
    assert!(at_rest.len() >= 6 && at_rest.iter().all(|(kind, _)| planar(kind)), "{at_rest:?}");
    let labels: std::collections::BTreeSet<&String> = at_rest.iter().map(|(_, label)| label).collect();
    assert_eq!(labels.len(), at_rest.len(), "{at_rest:?}");
    assert!(kinds(&damped, 3000.0).iter().any(|(kind, _)| !planar(kind)));
    let cross =
        text.replacen("k_xx = \"1e6 N/m\"", "k_xx = \"1e6 N/m\"\nk_xy = \"4e5 N/m\"\nk_yx = \"-4e5 N/m\"", 1);
    assert!(kinds(&cross, 0.0).iter().any(|(kind, _)| !planar(kind)));
}

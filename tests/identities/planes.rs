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

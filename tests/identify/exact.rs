//! FRFs without noise give their poles and residues back: a sum of modes is what is fitted, so only round-off is left.

use proptest::prelude::*;
use rotordyn::identify::{Settings, identify};
use rotordyn::linalg::Complex64;

use crate::made::{Known, bent, distance, frfs, lines};

/// Of |λ|.
const POLE: f64 = 1e-8;
/// Of the mode's largest.
const RESIDUE: f64 = 1e-6;

fn check(known: &[Known], power: i32, band: [f64; 2], step: f64) {
    let found = identify(&frfs(known, &lines(band[0], band[1], step), power), &Settings::default()).unwrap();
    let (pole, residue) = distance(&found, known);
    println!("poles {pole:.1e}, residues {residue:.1e}, error {:.1e}", found.total_error);
    assert!(pole < POLE && residue < RESIDUE, "poles {pole:.1e}, residues {residue:.1e}");
    assert!(found.total_error < 1e-7, "{}", found.total_error);
}

fn beam() -> Vec<Known> {
    let modes = [(18.0, 0.004), (44.0, 0.01), (81.0, 0.002), (130.0, 0.02)];
    modes.iter().enumerate().map(|(k, &(hz, zeta))| Known::real(hz, zeta, &bent(k + 1, 9), &[1, 4])).collect()
}

#[test]
fn receptance_mobility_accelerance() {
    for power in 0..3 {
        check(&beam(), power, [2.0, 180.0], 0.1);
    }
}

#[test]
fn a_band_far_from_zero() {
    let modes = [(1010.0, 0.004), (1044.0, 0.001), (1081.0, 0.002)];
    let known: Vec<Known> = modes
        .iter()
        .enumerate()
        .map(|(k, &(hz, zeta))| Known::real(hz, zeta, &bent(k + 1, 5), &[0]))
        .collect();
    check(&known, 2, [980.0, 1120.0], 0.1);
}

#[test]
fn close_modes() {
    // A quarter of their half-power width of 1 Hz apart.
    let known = [
        Known::real(50.0, 0.01, &bent(1, 6), &[1, 4]),
        Known::real(50.25, 0.01, &bent(2, 6), &[1, 4]),
        Known::real(80.0, 0.01, &bent(3, 6), &[1, 4]),
    ];
    check(&known, 2, [10.0, 120.0], 0.1);
}

#[test]
fn close_modes_by_one_reference() {
    let known = [
        Known::real(50.0, 0.01, &bent(1, 6), &[1]),
        Known::real(50.5, 0.008, &bent(2, 6), &[1]),
        Known::real(80.0, 0.01, &bent(3, 6), &[1]),
    ];
    check(&known, 2, [10.0, 120.0], 0.1);
}

#[test]
fn repeated_poles_need_two_references() {
    let (first, second) = (bent(1, 6), bent(2, 6));
    let known = [Known::real(50.0, 0.01, &first, &[1, 4]), Known::real(50.0, 0.01, &second, &[1, 4])];
    let measured = frfs(&known, &lines(10.0, 120.0, 0.1), 2);
    let found = identify(&measured, &Settings::default()).unwrap();
    assert_eq!(found.modes.len(), 2, "{:?}", found.modes);
    for mode in &found.modes {
        // Two poles on one another part as the root of what is left: 1e-8 needs 1e-16 of the FRFs.
        assert!((mode.pole - known[0].pole).norm() / known[0].pole.norm() < 1e-6, "{}", mode.pole);
    }
    // Shapes are any combination; the sum of the residues is not.
    for r in 0..6 {
        for e in 0..2 {
            let sum: Complex64 = found.modes.iter().map(|m| m.shape[r] * m.participation[e]).sum();
            let own = known[0].residue(r, e) + known[1].residue(r, e);
            assert!((sum - own).norm() < RESIDUE * known[0].residue(2, 1).norm(), "{r} {e}: {sum} for {own}");
        }
    }
}

#[test]
fn complex_modes_with_other_left_vectors() {
    // As of a rotor: forward and backward pair, l is not in proportion to ψ.
    let j = Complex64::i();
    let c = |re: f64| Complex64::from(re);
    let known = [
        Known::new(24.0, 0.01, vec![c(1.0), j, 0.3 * j + 0.2, c(0.6)], vec![-j * 1e-3, c(1e-3)]),
        Known::new(29.0, 0.012, vec![c(1.0), -j, -0.2 * j + 0.4, c(-0.3)], vec![-j * 1e-3, c(-0.8e-3)]),
    ];
    check(&known, 2, [5.0, 60.0], 0.05);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, ..ProptestConfig::default() })]

    #[test]
    fn random_systems(
        gaps in prop::collection::vec(4.0..25.0f64, 2..7),
        dampings in prop::collection::vec(0.002..0.03f64, 7),
        parts in prop::collection::vec(-1.0..1.0f64, 7 * 2 * (5 + 2)),
        power in 0..3i32,
    ) {
        let mut hz = 10.0;
        let known: Vec<Known> = gaps.iter().enumerate().map(|(m, gap)| {
            hz += gap;
            let own = &parts[14 * m..14 * (m + 1)];
            let value = |k: usize| Complex64::new(own[2 * k], own[2 * k + 1]);
            let shape: Vec<_> = (0..5).map(value).collect();
            // No mode is out of sight of all.
            let mut l: Vec<_> = (5..7).map(|k| 1e-3 * value(k)).collect();
            l[m % 2] = Complex64::new(1e-3, 0.0);
            let mut shape = shape;
            shape[m % 5] = Complex64::new(1.0, 0.3);
            Known::new(hz, dampings[m], shape, l)
        }).collect();
        let found = identify(&frfs(&known, &lines(2.0, hz + 15.0, 0.1), power), &Settings::default()).unwrap();
        let (pole, residue) = distance(&found, &known);
        prop_assert!(pole < POLE && residue < RESIDUE, "poles {:.1e}, residues {:.1e}", pole, residue);
    }
}

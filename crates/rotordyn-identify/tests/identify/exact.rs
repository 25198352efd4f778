//! FRFs without noise: poles and residues are recovered to round-off, since the fitted model is exact.

use proptest::prelude::*;
use rotordyn_identify::{Settings, identify};
use rotordyn_linalg::Complex64;

use crate::known_modes::{KnownMode, bending_shape, frfs, largest_errors, lines};

/// Pole tolerance, relative to |λ|.
const POLE_TOLERANCE: f64 = 1e-8;
/// Residue tolerance, relative to the mode's largest.
const RESIDUE_TOLERANCE: f64 = 1e-6;

fn check(known: &[KnownMode], power: i32, band: [f64; 2], step: f64) {
    let found = identify(&frfs(known, &lines(band[0], band[1], step), power), &Settings::default()).unwrap();
    let (pole, residue) = largest_errors(&found, known);
    println!("poles {pole:.1e}, residues {residue:.1e}, error {:.1e}", found.total_error);
    assert!(pole < POLE_TOLERANCE && residue < RESIDUE_TOLERANCE, "poles {pole:.1e}, residues {residue:.1e}");
    assert!(found.total_error < 1e-7, "{}", found.total_error);
}

fn beam() -> Vec<KnownMode> {
    let modes = [(18.0, 0.004), (44.0, 0.01), (81.0, 0.002), (130.0, 0.02)];
    modes
        .iter()
        .enumerate()
        .map(|(k, &(hz, zeta))| KnownMode::real(hz, zeta, &bending_shape(k + 1, 9), &[1, 4]))
        .collect()
}

#[test]
fn receptance_mobility_accelerance() {
    for power in 0..3 {
        check(&beam(), power, [2.0, 180.0], 0.1);
    }
}

#[test]
fn band_far_from_zero_frequency() {
    let modes = [(1010.0, 0.004), (1044.0, 0.001), (1081.0, 0.002)];
    let known: Vec<KnownMode> = modes
        .iter()
        .enumerate()
        .map(|(k, &(hz, zeta))| KnownMode::real(hz, zeta, &bending_shape(k + 1, 5), &[0]))
        .collect();
    check(&known, 2, [980.0, 1120.0], 0.1);
}

/// A mode just outside the band is part of the fit and no result: those in the band are exact, where residual terms alone
/// would leave an error of a per cent in the damping of the last.
#[test]
fn a_mode_outside_the_band() {
    for (band, inside) in [([2.0, 128.5], 0..3), ([44.2, 180.0], 2..4)] {
        let known = beam();
        let made = frfs(&known, &lines(band[0], band[1], 0.1), 2);
        let found = identify(&made, &Settings::default()).unwrap();
        assert_eq!(found.modes.len(), inside.len(), "{band:?}: {:?}", found.modes);
        for (mode, known) in found.modes.iter().zip(&known[inside]) {
            let off = (mode.pole - known.pole).norm() / known.pole.norm();
            println!("{band:?}: {:.3} Hz, pole {off:.1e}", mode.frequency_hz());
            assert!(off < 1e-6, "{off:.1e}");
        }
        assert!(
            found.dropped.iter().any(|pole| pole.reason.contains("part of the fit")),
            "{:?}",
            found.dropped
        );
    }
}

#[test]
fn close_modes() {
    // A quarter of their half-power width of 1 Hz apart.
    let known = [
        KnownMode::real(50.0, 0.01, &bending_shape(1, 6), &[1, 4]),
        KnownMode::real(50.25, 0.01, &bending_shape(2, 6), &[1, 4]),
        KnownMode::real(80.0, 0.01, &bending_shape(3, 6), &[1, 4]),
    ];
    check(&known, 2, [10.0, 120.0], 0.1);
}

#[test]
fn close_modes_with_one_reference() {
    let known = [
        KnownMode::real(50.0, 0.01, &bending_shape(1, 6), &[1]),
        KnownMode::real(50.5, 0.008, &bending_shape(2, 6), &[1]),
        KnownMode::real(80.0, 0.01, &bending_shape(3, 6), &[1]),
    ];
    check(&known, 2, [10.0, 120.0], 0.1);
}

#[test]
fn repeated_poles_need_two_references() {
    let (first, second) = (bending_shape(1, 6), bending_shape(2, 6));
    let known = [KnownMode::real(50.0, 0.01, &first, &[1, 4]), KnownMode::real(50.0, 0.01, &second, &[1, 4])];
    let measured = frfs(&known, &lines(10.0, 120.0, 0.1), 2);
    let found = identify(&measured, &Settings::default()).unwrap();
    assert_eq!(found.modes.len(), 2, "{:?}", found.modes);
    for mode in &found.modes {
        // A double pole splits with the square root of the error: 1e-8 needs 1e-16 in the FRFs.
        assert!((mode.pole - known[0].pole).norm() / known[0].pole.norm() < 1e-6, "{}", mode.pole);
    }
    // Shapes are arbitrary linear combinations; the sum of the residues is unique.
    for r in 0..6 {
        for e in 0..2 {
            let sum: Complex64 = found.modes.iter().map(|m| m.shape[r] * m.participation[e]).sum();
            let own = known[0].residue(r, e) + known[1].residue(r, e);
            assert!(
                (sum - own).norm() < RESIDUE_TOLERANCE * known[0].residue(2, 1).norm(),
                "{r} {e}: {sum} for {own}"
            );
        }
    }
}

#[test]
fn complex_modes_with_different_left_eigenvectors() {
    // As of a rotor: forward and backward whirl, l is not proportional to ψ.
    let j = Complex64::i();
    let c = |re: f64| Complex64::from(re);
    let known = [
        KnownMode::new(24.0, 0.01, vec![c(1.0), j, 0.3 * j + 0.2, c(0.6)], vec![-j * 1e-3, c(1e-3)]),
        KnownMode::new(29.0, 0.012, vec![c(1.0), -j, -0.2 * j + 0.4, c(-0.3)], vec![-j * 1e-3, c(-0.8e-3)]),
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
        let known: Vec<KnownMode> = gaps.iter().enumerate().map(|(m, gap)| {
            hz += gap;
            let own = &parts[14 * m..14 * (m + 1)];
            let value = |k: usize| Complex64::new(own[2 * k], own[2 * k + 1]);
            let shape: Vec<_> = (0..5).map(value).collect();
            // Every mode is observed and excited at one DOF at least.
            let mut l: Vec<_> = (5..7).map(|k| 1e-3 * value(k)).collect();
            l[m % 2] = Complex64::new(1e-3, 0.0);
            let mut shape = shape;
            shape[m % 5] = Complex64::new(1.0, 0.3);
            KnownMode::new(hz, dampings[m], shape, l)
        }).collect();
        let found = identify(&frfs(&known, &lines(2.0, hz + 15.0, 0.1), power), &Settings::default()).unwrap();
        let (pole, residue) = largest_errors(&found, &known);
        prop_assert!(pole < POLE_TOLERANCE && residue < RESIDUE_TOLERANCE, "poles {:.1e}, residues {:.1e}", pole, residue);
    }
}

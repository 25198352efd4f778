//! FRFs of records with an exponential window e^{−σt} are H(s + σ): exact poles and residues of every quantity.

use std::f64::consts::TAU;

use rotordyn_identify::{Settings, identify};
use rotordyn_linalg::Complex64;
use rotordyn_signal::record::FrfMatrix;

use crate::known_modes::{KnownMode, frfs, lines};

/// (s + σ)^p Σ ψ lᵀ/(s + σ − λ), s = jω: the receptance has the poles λ − σ.
fn windowed(known: &[KnownMode], frequencies: &[f64], power: i32, sigma: f64) -> FrfMatrix {
    let moved: Vec<KnownMode> =
        known.iter().map(|mode| KnownMode { pole: mode.pole - sigma, ..mode.clone() }).collect();
    let mut made = frfs(&moved, frequencies, 0);
    for frf in made.values.iter_mut().flatten() {
        let lines = frf.iter_mut().zip(frequencies);
        lines.for_each(|(h, hz)| *h *= Complex64::new(sigma, TAU * hz).powi(power));
    }
    let unit = ["m/N", "(m/s)/N", "(m/s^2)/N"][power as usize];
    made.units.iter_mut().flatten().for_each(|own| *own = unit.into());
    made
}

#[test]
fn windowed_frfs_of_every_quantity_give_exact_modes() {
    let known = [
        KnownMode::real(42.0, 0.006, &[0.9, -0.4, 0.7, 0.3], &[0, 1]),
        KnownMode::real(96.0, 0.008, &[0.5, 0.8, -0.6, 0.4], &[0, 1]),
    ];
    let sigma = 5.0;
    for power in 0..=2 {
        let made = windowed(&known, &lines(10.0, 150.0, 0.25), power, sigma);
        let found = identify(&made, &Settings { added_decay: sigma, ..Settings::default() }).unwrap();
        assert_eq!(found.modes.len(), 2, "{power}");
        for (mode, known) in found.modes.iter().zip(&known) {
            assert!((mode.pole - known.pole).norm() < 1e-7 * known.pole.norm(), "{power}: {:?}", mode.pole);
            let residue = mode.shape[1] * mode.participation[0];
            let off = (residue - known.residue(1, 0)).norm();
            assert!(off < 1e-5 * known.residue(1, 0).norm(), "{power}: residue off by {off}");
        }
        assert!(found.total_error < 1e-6, "{power}: {}", found.total_error);
    }
}

//! Residual terms chosen by the user: FRFs of modes in the band with terms of known size.

use std::f64::consts::TAU;

use rotordyn_identify::{ResidualTerms, Settings, identify};
use rotordyn_linalg::Complex64;
use rotordyn_signal::record::FrfMatrix;

use crate::known_modes::{KnownMode, bending_shape, frfs, largest_errors, lines};

const TERMS: [ResidualTerms; 4] =
    [ResidualTerms::Both, ResidualTerms::Upper, ResidualTerms::Lower, ResidualTerms::None];

fn modes() -> Vec<KnownMode> {
    [(44.0, 0.01), (81.0, 0.004)]
        .iter()
        .enumerate()
        .map(|(k, &(hz, zeta))| KnownMode::real(hz, zeta, &bending_shape(k + 1, 5), &[1, 3]))
        .collect()
}

/// U + V/s² of the receptance between two points, as large as the FRF between the modes.
fn known_terms(response: usize, reference: usize) -> [f64; 2] {
    let sign = if (response + reference).is_multiple_of(2) { 1.0 } else { -0.7 };
    let upper = sign * 1e-5 * (1.0 + response as f64);
    [upper, -upper * (TAU * 60.0).powi(2)]
}

/// FRFs of the modes with residual terms: the power of jω of their quantity is `power`.
fn made(power: i32, terms: ResidualTerms) -> FrfMatrix {
    let mut frfs = frfs(&modes(), &lines(20.0, 110.0, 0.1), power);
    for (r, row) in frfs.values.iter_mut().enumerate() {
        for (e, frf) in row.iter_mut().enumerate() {
            let [upper, lower] = known_terms(r, e);
            for (h, hz) in frf.iter_mut().zip(&frfs.frequencies) {
                let s = Complex64::new(0.0, TAU * hz);
                let upper = if terms.has_upper() { upper } else { 0.0 };
                let lower = if terms.has_lower() { lower } else { 0.0 };
                *h += (upper + lower / (s * s)) * s.powi(power);
            }
        }
    }
    frfs
}

/// With the terms that the FRFs have, or more, the fit is exact and finds their values; without one of them it is not.
#[test]
fn terms_of_known_size() {
    for power in [0, 2] {
        for present in TERMS {
            for fitted in TERMS {
                let settings = Settings { residual_terms: fitted, ..Settings::default() };
                let found = identify(&made(power, present), &settings).unwrap();
                let covers = (fitted.has_upper() || !present.has_upper())
                    && (fitted.has_lower() || !present.has_lower());
                println!("{present:?} fitted with {fitted:?}: error {:.1e}", found.total_error);
                if !covers {
                    assert!(found.total_error > 1e-3, "{present:?} with {fitted:?}: {}", found.total_error);
                    continue;
                }
                let (pole, _) = largest_errors(&found, &modes());
                assert!(pole < 1e-8 && found.total_error < 1e-7, "{present:?} with {fitted:?}: {pole:.1e}");
                for (r, e) in (0..5).flat_map(|r| [0, 1].map(|e| (r, e))) {
                    let [upper, lower] = known_terms(r, e);
                    for (found, known, present) in [
                        (found.upper[r][e], upper, present.has_upper()),
                        (found.lower[r][e], lower, present.has_lower()),
                    ] {
                        let expected = if present { known } else { 0.0 };
                        assert!((found - expected).abs() < 1e-6 * known.abs(), "{found:e} for {expected:e}");
                    }
                }
            }
        }
    }
}

/// Terms left out are exactly zero.
#[test]
fn terms_left_out() {
    let zero = |terms: &[Vec<f64>]| terms.iter().flatten().all(|value| *value == 0.0);
    for terms in TERMS {
        let settings = Settings { residual_terms: terms, ..Settings::default() };
        let found = identify(&made(2, ResidualTerms::Both), &settings).unwrap();
        assert_eq!(zero(&found.upper), !terms.has_upper(), "{terms:?}");
        assert_eq!(zero(&found.lower), !terms.has_lower(), "{terms:?}");
    }
}

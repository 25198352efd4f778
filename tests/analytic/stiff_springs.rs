//! Springs far stiffer than the rest of a machine stand for a fixed end.

use crate::agree;
use rotordyn::linalg::{SparseMatrix, Triplets, krylov};
use std::f64::consts::PI;

const MASSES: usize = 8;
const STIFFNESS: f64 = 1e6;
const GROUND: f64 = 1e20;

/// M and K of a chain of `MASSES` masses of 1 kg behind one of 1 kg on a spring of `ground` \[N/m\].
fn chain(ground: f64) -> (SparseMatrix, SparseMatrix) {
    let n = MASSES + 1;
    let (mut m, mut k) = (Triplets::new(n, n), Triplets::new(n, n));
    k.add(0, 0, ground);
    for i in 0..n {
        m.add(i, i, 1.0);
        if i > 0 {
            k.add(i - 1, i - 1, STIFFNESS);
            k.add(i, i, STIFFNESS);
            k.add(i - 1, i, -STIFFNESS);
            k.add(i, i - 1, -STIFFNESS);
        }
    }
    (m.build(), k.build())
}

#[test]
fn every_mode_of_a_chain_on_a_rigid_spring_is_that_of_the_fixed_chain() {
    let (m, k) = chain(GROUND);
    let c = SparseMatrix::sum(&[(0.0, &m)]);
    let found = krylov::lowest_eigenpairs(&m, &c, &k, MASSES + 1, 30.0).unwrap();
    assert_eq!(found.len(), MASSES + 1);
    for (j, pair) in found[..MASSES].iter().enumerate() {
        // ω_j = 2 √(k/m) sin((2j − 1) π / (2 (2n + 1))), j = 1 … n
        let expected =
            2.0 * STIFFNESS.sqrt() * ((2 * j + 1) as f64 * PI / (2 * (2 * MASSES + 1)) as f64).sin();
        agree::relative(
            format!("mode {} beside a rigid spring [rad/s]", j + 1),
            pair.value.im,
            expected,
            1e-9,
        );
        assert!(pair.value.re.abs() < 1e-9 * expected, "mode {j}: {}", pair.value);
        let largest = pair.vector.iter().map(|v| v.norm()).fold(0.0, f64::max);
        assert!(pair.vector[0].norm() < 1e-11 * largest, "mode {j} moves the fixed end");
    }
    let stiff = (GROUND + STIFFNESS).sqrt();
    agree::relative("mode on the rigid spring [rad/s]", found[MASSES].value.im, stiff, 1e-12);
}

//! Synthetic FRFs of known modes.

use std::f64::consts::{PI, TAU};

use rotordyn_identify::ModalIdentification;
use rotordyn_linalg::Complex64;
use rotordyn_signal::record::{Dof, FrfMatrix};

/// A mode: pole λ, shape ψ and participation l of the receptance.
#[derive(Clone, Debug)]
pub struct KnownMode {
    pub pole: Complex64,
    pub shape: Vec<Complex64>,
    pub participation: Vec<Complex64>,
}

impl KnownMode {
    pub fn new(hz: f64, zeta: f64, shape: Vec<Complex64>, participation: Vec<Complex64>) -> Self {
        let omega = TAU * hz;
        let pole = Complex64::new(-zeta * omega, omega * (1.0 - zeta * zeta).sqrt());
        Self { pole, shape, participation }
    }

    /// A real mode of unit modal mass: A = φ φᵀ/(2jω_d).
    pub fn real(hz: f64, zeta: f64, shape: &[f64], references: &[usize]) -> Self {
        let own: Vec<Complex64> = shape.iter().map(|v| Complex64::from(*v)).collect();
        let mut mode = Self::new(hz, zeta, own, Vec::new());
        let scale = (2.0 * Complex64::i() * mode.pole.im).inv();
        mode.participation = references.iter().map(|&k| scale * shape[k]).collect();
        mode
    }

    pub fn residue(&self, response: usize, reference: usize) -> Complex64 {
        self.shape[response] * self.participation[reference]
    }

    pub fn hz(&self) -> f64 {
        self.pole.im / TAU
    }

    pub fn zeta(&self) -> f64 {
        -self.pole.re / self.pole.norm()
    }
}

/// Units by the power of jω.
const UNITS: [&str; 3] = ["m/N", "(m/s)/N", "(m/s^2)/N"];

/// FRF matrix of modes, multiplied by (jω)^`power`.
pub fn frfs(modes: &[KnownMode], frequencies: &[f64], power: i32) -> FrfMatrix {
    let (responses, references) = (modes[0].shape.len(), modes[0].participation.len());
    let value = |r: usize, e: usize, f: f64| {
        let s = Complex64::new(0.0, TAU * f);
        let sum: Complex64 = modes
            .iter()
            .map(|m| {
                let a = m.residue(r, e);
                a / (s - m.pole) + a.conj() / (s - m.pole.conj())
            })
            .sum();
        sum * s.powi(power)
    };
    let curve = |r: usize, e: usize| frequencies.iter().map(|f| value(r, e, *f)).collect();
    FrfMatrix {
        frequencies: frequencies.to_vec(),
        responses: (0..responses).map(|k| Dof::new(k as i64 + 1, 2)).collect(),
        references: (0..references).map(|k| Dof::new(k as i64 + 1, 2)).collect(),
        values: (0..responses).map(|r| (0..references).map(|e| curve(r, e)).collect()).collect(),
        units: vec![vec![UNITS[power as usize].into(); references]; responses],
        coherence: None,
    }
}

/// Uniformly spaced frequencies.
pub fn lines(from: f64, to: f64, step: f64) -> Vec<f64> {
    (0..=((to - from) / step).round() as usize).map(|k| from + step * k as f64).collect()
}

/// Bending shape k of a beam at n points, sin(kπx).
pub fn bending_shape(k: usize, n: usize) -> Vec<f64> {
    (0..n).map(|p| (k as f64 * PI * (p as f64 + 0.7) / (n as f64 + 0.4)).sin()).collect()
}

/// Largest relative error of the poles, and of the residues over the largest of each mode; modes in order.
pub fn largest_errors(found: &ModalIdentification, known: &[KnownMode]) -> (f64, f64) {
    let list: Vec<_> =
        found.modes.iter().map(|m| (m.frequency_hz(), m.damping_ratio(), m.significance)).collect();
    let made: Vec<_> = known.iter().map(|k| (k.hz(), k.zeta())).collect();
    assert_eq!(found.modes.len(), known.len(), "{list:?} of {made:?}; dropped {:?}", found.dropped);
    let (mut pole, mut residue) = (0.0f64, 0.0f64);
    for (m, k) in found.modes.iter().zip(known) {
        pole = pole.max((m.pole - k.pole).norm() / k.pole.norm());
        let (mut off, mut size) = (0.0f64, 0.0f64);
        for r in 0..k.shape.len() {
            for e in 0..k.participation.len() {
                off = off.max((m.shape[r] * m.participation[e] - k.residue(r, e)).norm());
                size = size.max(k.residue(r, e).norm());
            }
        }
        residue = residue.max(off / size);
    }
    (pole, residue)
}

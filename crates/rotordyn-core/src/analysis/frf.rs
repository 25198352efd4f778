//! Frequency response functions at a fixed speed, solved directly.

use super::harmonic::HarmonicSystem;
use crate::assembly::rigid_body_modes::unconstrained_motion;
use crate::assembly::{Assembly, LinearSystem, PhysicsError};
use crate::model::Quantity;
use rayon::prelude::*;
use rotordyn_linalg::{Complex64, SparseRow};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Frequency responses H of every response to every excitation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Frf {
    /// Frequencies \[Hz\].
    pub frequencies: Vec<f64>,
    pub quantity: Quantity,
    /// H\[response\]\[excitation\]\[frequency\], in m/N (receptance), m/(s N) (mobility) or m/(s² N) (accelerance)
    /// for a displacement under a force.
    pub values: Vec<Vec<Vec<Complex64>>>,
}

/// H(ω) = (jω)^p r (S − ω² M + jω D)⁻¹ eᵀ for rows r (responses) and e (excitations) over the free DOFs;
/// p = 0, 1, 2 for receptance, mobility, accelerance.
///
/// Direct solution: one banded complex factorisation per frequency, of the groups of unknowns coupled to the
/// excitations.
///
/// # Errors
/// A frequency at which the dynamic stiffness is singular (0 Hz of a rigid-body mode), naming the motion.
pub fn frf(
    assembly: &Assembly,
    system: &LinearSystem,
    frequencies: &[f64],
    excitations: &[SparseRow],
    responses: &[SparseRow],
    quantity: Quantity,
) -> Result<Frf, PhysicsError> {
    let reached: Vec<usize> = excitations.iter().flat_map(|e| e.0.iter().map(|&(i, _)| i)).collect();
    let harmonic = HarmonicSystem::new(system, Some(&reached));
    let columns: Vec<Vec<Complex64>> = frequencies
        .par_iter()
        .map_init(
            || harmonic.solver(),
            |solver, &hz| {
                let omega = hz * TAU;
                solver.factor(omega).map_err(|pivot| PhysicsError::Singular {
                    motion: format!("at {hz} Hz {}", unconstrained_motion(assembly, system, pivot.unknown)),
                })?;
                let scale = derivative_factor(quantity, omega);
                let mut column = Vec::with_capacity(excitations.len() * responses.len());
                let mut q = vec![Complex64::default(); harmonic.size()];
                for excitation in excitations {
                    q.fill(Complex64::default());
                    for &(i, v) in &excitation.0 {
                        q[i] += v;
                    }
                    solver.solve(&mut q);
                    column.extend(responses.iter().map(|r| scale * r.dot_complex(&q)));
                }
                Ok(column)
            },
        )
        .collect::<Result<_, PhysicsError>>()?;

    let value = |r: usize, e: usize| columns.iter().map(|c| c[e * responses.len() + r]).collect();
    let values =
        (0..responses.len()).map(|r| (0..excitations.len()).map(|e| value(r, e)).collect()).collect();
    Ok(Frf { frequencies: frequencies.to_vec(), quantity, values })
}

/// (jω)^p of a quantity.
pub fn derivative_factor(quantity: Quantity, omega: f64) -> Complex64 {
    match quantity {
        Quantity::Displacement => Complex64::new(1.0, 0.0),
        Quantity::Velocity => Complex64::new(0.0, omega),
        Quantity::Acceleration => Complex64::new(-omega * omega, 0.0),
    }
}

//! Frequency response functions at a fixed speed, solved directly.

use super::harmonic::{HarmonicLanes, HarmonicSolver, HarmonicSystem};
use crate::assembly::rigid_body_modes::unconstrained_motion;
use crate::assembly::{Assembly, LinearSystem, PhysicsError};
use crate::model::Quantity;
use rayon::prelude::*;
use rotordyn_linalg::complex_lanes::{ComplexLanes, LANES, dot_lanes};
use rotordyn_linalg::workspaces::Workspaces;
use rotordyn_linalg::{Complex64, SparseRow, ZeroPivot};
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
/// excitations; several frequencies at once where their rows are exchanged alike.
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
    let columns = FrfSolver::new(assembly, system, excitations, responses, quantity).at(frequencies)?;
    let value = |r: usize, e: usize| columns.iter().map(|c| c[e * responses.len() + r]).collect();
    let values =
        (0..responses.len()).map(|r| (0..excitations.len()).map(|e| value(r, e)).collect()).collect();
    Ok(Frf { frequencies: frequencies.to_vec(), quantity, values })
}

/// The system of [`frf`], for frequencies that are not known at once.
pub struct FrfSolver<'a> {
    assembly: &'a Assembly,
    system: &'a LinearSystem,
    harmonic: HarmonicSystem<'a>,
    excitations: &'a [SparseRow],
    responses: &'a [SparseRow],
    quantity: Quantity,
    memory: Workspaces<Option<HarmonicLanes>>,
}

impl<'a> FrfSolver<'a> {
    /// A linear system, rows of its excitations and responses, and the quantity of the latter, as in [`frf`].
    pub fn new(
        assembly: &'a Assembly,
        system: &'a LinearSystem,
        excitations: &'a [SparseRow],
        responses: &'a [SparseRow],
        quantity: Quantity,
    ) -> Self {
        let reached: Vec<usize> = excitations.iter().flat_map(|e| e.0.iter().map(|&(i, _)| i)).collect();
        let harmonic = HarmonicSystem::new(system, Some(&reached));
        Self { assembly, system, harmonic, excitations, responses, quantity, memory: Workspaces::default() }
    }

    /// The responses at every frequency \[Hz\], those to the first excitation first.
    ///
    /// # Errors
    /// As [`frf`].
    pub fn at(&self, frequencies: &[f64]) -> Result<Vec<Vec<Complex64>>, PhysicsError> {
        let singular = |(hz, pivot): (f64, ZeroPivot)| PhysicsError::Singular {
            motion: format!("at {hz} Hz {}", unconstrained_motion(self.assembly, self.system, pivot.unknown)),
        };
        // Groups of frequencies do not depend on the number of threads, nor does the result.
        let columns: Vec<Vec<Vec<Complex64>>> = frequencies
            .par_chunks(LANES)
            .map_init(
                || (None, self.memory.take(|| None)),
                |(solver, lanes), hz| {
                    if let Some(columns) = self.several(lanes, hz) {
                        return Ok(columns);
                    }
                    let solver = solver.get_or_insert_with(|| self.harmonic.solver());
                    hz.iter().map(|&hz| self.one(solver, hz).map_err(|e| singular((hz, e)))).collect()
                },
            )
            .collect::<Result<_, PhysicsError>>()?;
        Ok(columns.into_iter().flatten().collect())
    }

    fn one(&self, solver: &mut HarmonicSolver, hz: f64) -> Result<Vec<Complex64>, ZeroPivot> {
        let omega = hz * TAU;
        solver.factor(omega)?;
        let scale = derivative_factor(self.quantity, omega);
        let mut column = Vec::with_capacity(self.excitations.len() * self.responses.len());
        let mut q = vec![Complex64::default(); self.harmonic.size()];
        for excitation in self.excitations {
            q.fill(Complex64::default());
            excitation.0.iter().for_each(|&(i, v)| q[i] += v);
            solver.solve(&mut q);
            column.extend(self.responses.iter().map(|r| scale * r.dot_complex(&q)));
        }
        Ok(column)
    }

    /// At two to [`LANES`] frequencies; `None` where they are to be taken one by one.
    fn several(&self, memory: &mut Option<HarmonicLanes>, hz: &[f64]) -> Option<Vec<Vec<Complex64>>> {
        let (&last, _) = hz.split_last().filter(|(_, others)| !others.is_empty())?;
        // At rest a rigid-body mode is singular to the last digit: found with the rounding of one matrix.
        (!hz.contains(&0.0)).then_some(())?;
        let omega = std::array::from_fn(|k| hz.get(k).copied().unwrap_or(last) * TAU);
        if memory.is_none() {
            *memory = self.harmonic.lanes();
        }
        let lanes = memory.as_mut()?;
        lanes.factor(&self.harmonic, &omega).then_some(())?;
        let size = self.excitations.len() * self.responses.len();
        let mut columns = vec![Vec::with_capacity(size); hz.len()];
        let mut q = vec![ComplexLanes::default(); self.harmonic.size()];
        for excitation in self.excitations {
            q.fill(ComplexLanes::default());
            excitation.0.iter().for_each(|&(i, v)| q[i].re.iter_mut().for_each(|re| *re += v));
            lanes.solve(&mut q);
            for response in self.responses {
                let h = dot_lanes(response, &q);
                for (k, column) in columns.iter_mut().enumerate() {
                    column.push(derivative_factor(self.quantity, omega[k]) * h.lane(k));
                }
            }
        }
        Some(columns)
    }
}

/// (jω)^p of a quantity.
pub fn derivative_factor(quantity: Quantity, omega: f64) -> Complex64 {
    match quantity {
        Quantity::Displacement => Complex64::new(1.0, 0.0),
        Quantity::Velocity => Complex64::new(0.0, omega),
        Quantity::Acceleration => Complex64::new(-omega * omega, 0.0),
    }
}

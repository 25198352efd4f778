//! Undamped critical speeds with constant bearings, solved directly or counted.

use super::CriticalSpeed;
use crate::analysis::modal::{self, Mode};
use crate::analysis::mode::inner;
use crate::analysis::mode_kind;
use crate::assembly::{Assembly, LinearSystem, PhysicsError};
use nalgebra::{Cholesky, DMatrix};
use rotordyn_linalg::{Complex64, SparseMatrix, eigen};

/// Undamped critical speeds of order n up to a speed, solved directly: K q = Ω² (n² M − j n G) q.
///
/// `system` gives M and K (the stiffness at standstill; its unsymmetric part and all damping are ignored).
///
/// # Errors
/// A structure whose stiffness is not positive semi-definite, or an eigenvalue computation that fails.
pub fn undamped_critical_speeds(
    assembly: &Assembly,
    system: &LinearSystem,
    order: f64,
    max_speed: f64,
) -> Result<Vec<CriticalSpeed>, PhysicsError> {
    let failed = |reason: String| PhysicsError::Eigen { speed_rpm: 0.0, reason };
    let gyroscopic = &assembly.gyroscopic;
    let layout = assembly.layouts.layout(&[&system.mass, &system.stiffness, gyroscopic]);
    let mut found = Vec::new();
    for group in layout.groups() {
        let dense = |a: &SparseMatrix| {
            DMatrix::from_fn(group.len(), group.len(), |i, j| 0.5 * a.get(group[i], group[j]))
        };
        let symmetric = |a: &SparseMatrix| dense(a) + dense(a).transpose();
        let (k, m) = (symmetric(&system.stiffness), symmetric(&system.mass) * (order * order));
        let g = (dense(gyroscopic) - dense(gyroscopic).transpose()) * order;
        // B q = μ (K + σ B) q, Ω² = 1/μ − σ. The shift regularises rigid-body rotation and translation along
        // the axis; there G = 0 and B = n² M.
        let sigma = if g.amax() == 0.0 { 1.0 } else { 0.0 };
        let lower = Cholesky::new(&k + &m * sigma)
            .ok_or_else(|| failed("the stiffness is not positive definite".into()))?
            .unpack();
        let congruent = |b: &DMatrix<f64>| {
            let half = lower.solve_lower_triangular(b).expect("a Cholesky factor has a positive diagonal");
            lower.solve_lower_triangular(&half.transpose()).expect("as above").transpose()
        };
        let (values, vectors) =
            eigen::hermitian(&congruent(&m), &-congruent(&g)).map_err(|e| failed(e.to_string()))?;
        let real = lower.transpose().map(|v| Complex64::new(v, 0.0));
        for (mu, vector) in values.iter().zip(vectors.column_iter()) {
            let square = 1.0 / mu - sigma;
            if !(*mu > 0.0 && square > 1e-2 && square <= max_speed * max_speed) {
                continue;
            }
            let shape = real.solve_upper_triangular(&vector).expect("as above");
            let mut all = vec![Complex64::default(); layout.size()];
            for (&i, v) in group.iter().zip(shape.iter()) {
                all[i] = *v;
            }
            let size = inner(&all, &system.mass.mul_complex(&all)).re.sqrt();
            all.iter_mut().for_each(|v| *v /= size);
            let speed = square.sqrt();
            let mode = mode_kind::characterise(assembly, Complex64::new(0.0, order * speed), all);
            found.push(CriticalSpeed { speed, order, mode });
        }
    }
    found.sort_by(|a, b| a.speed.total_cmp(&b.speed));
    let mut modes: Vec<Mode> = found.iter().map(|c| c.mode.clone()).collect();
    mode_kind::label(assembly, &mut modes);
    found.iter_mut().zip(modes).for_each(|(critical, mode)| critical.mode = mode);
    Ok(found)
}

/// Number of undamped modes with a frequency below the order line ω = n Ω at the speed of `system`, rigid-body modes
/// not counted: the negative eigenvalues of K − ω² M + j ω Ω G, less those at the frequency `lowest` \[rad/s\].
///
/// K symmetric and positive semi-definite, M positive definite: every undamped mode with ω_k < ω gives one negative
/// eigenvalue. With constant K the count cannot decrease with speed, so that it is the number of critical speeds.
pub(super) fn undamped_modes_below(
    assembly: &Assembly,
    system: &LinearSystem,
    order: f64,
    lowest: f64,
) -> usize {
    let undamped = modal::undamped(assembly, system);
    let count = |omega| modal::undamped_modes_below(&undamped, omega);
    count(order * system.speed).saturating_sub(count(lowest))
}

//! Critical speeds: intersections of a mode's frequency with an order line ω = n Ω.

use super::campbell::{Campbell, Tangents, Tracker};
use super::modal::Mode;
use super::mode_kind::{self, ModeKind};
use crate::assembly::{Assembly, LinearSystem};
use crate::error::{Error, PhysicsError};
use crate::linalg::{BandLayout, Complex64, SparseMatrix, eigen};
use nalgebra::{Cholesky, DMatrix};

/// A mode on an order line.
#[derive(Clone, Debug, PartialEq)]
pub struct CriticalSpeed {
    /// Ω \[rad/s\].
    pub speed: f64,
    /// n in ω = n Ω.
    pub order: f64,
    /// The mode at this speed; its kind gives the whirl direction.
    pub mode: Mode,
    /// Label of the branch that crosses.
    pub label: String,
}

/// Crossings of the tracked branches with the lines ω_d = n Ω, by speed; damping and bearings included.
///
/// # Errors
/// As [`campbell`](super::campbell::campbell).
pub fn crossings(
    assembly: &Assembly,
    diagram: &Campbell,
    orders: &[f64],
    tangents: &impl Tangents,
) -> Result<Vec<CriticalSpeed>, Error> {
    let count = diagram.branches.len() + 4;
    let tracker = Tracker { assembly, tangents, count };
    let mut found = Vec::new();
    for branch in &diagram.branches {
        for (k, pair) in branch.modes.windows(2).enumerate() {
            let [Some(a), Some(b)] = pair else { continue };
            let (left, right) = (diagram.speeds[k], diagram.speeds[k + 1]);
            for &order in orders {
                let gap = |mode: &Mode, speed: f64| mode.omega() - order * speed;
                let (ga, gb) = (gap(a, left), gap(b, right));
                // Half-open, so that a crossing at a computed speed counts once.
                if (ga > 0.0 && gb <= 0.0) || (ga < 0.0 && gb >= 0.0) {
                    let (speed, mode) = tracker.root((left, a), (right, b), gap)?;
                    found.push(CriticalSpeed { speed, order, mode, label: branch.label.clone() });
                }
            }
        }
    }
    found.sort_by(|a, b| a.speed.total_cmp(&b.speed).then(a.order.total_cmp(&b.order)));
    Ok(found)
}

impl<T: Tangents> Tracker<'_, T> {
    /// The speed between a and b where `gap` of the mode vanishes, and the mode there (secant method
    /// safeguarded by bisection, to 1e-12 of the speed).
    pub(super) fn root(
        &self,
        (mut left, a): (f64, &Mode),
        (mut right, b): (f64, &Mode),
        gap: impl Fn(&Mode, f64) -> f64,
    ) -> Result<(f64, Mode), Error> {
        let (mut ga, mut gb) = (gap(a, left), gap(b, right));
        let mut best = (right, b.clone());
        if gb == 0.0 {
            return Ok(best);
        }
        let ends = [a.clone(), b.clone()];
        for step in 0..60 {
            let secant = (left * gb - right * ga) / (gb - ga);
            // Every third step bisects the bracket, so that neither end stagnates.
            let speed = if step % 3 == 2 { 0.5 * (left + right) } else { secant };
            let modes = self.modes(speed)?;
            let mac = self.mac(&ends, &modes);
            let mac_sum = |j: usize| mac[0][j] + mac[1][j];
            let Some(j) = (0..modes.len()).max_by(|&i, &j| mac_sum(i).total_cmp(&mac_sum(j))) else {
                break;
            };
            let g = gap(&modes[j], speed);
            best = (speed, modes.into_iter().nth(j).expect("index found above"));
            if g == 0.0 {
                break;
            }
            if (g > 0.0) == (ga > 0.0) {
                (left, ga) = (speed, g);
            } else {
                (right, gb) = (speed, g);
            }
            let tight = 1e-12 * right.abs();
            if (right - left).abs() < tight || (secant - speed).abs() < tight && g.abs() < 1e-11 * speed.abs()
            {
                break;
            }
        }
        Ok(best)
    }
}

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
) -> Result<Vec<CriticalSpeed>, Error> {
    let failed = |reason: String| PhysicsError::Eigen { speed_rpm: 0.0, reason };
    let gyroscopic = &assembly.gyroscopic;
    let layout = BandLayout::new(&[&system.mass, &system.stiffness, gyroscopic]);
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
            let size = super::modal::inner(&all, &system.mass.mul_complex(&all)).re.sqrt();
            all.iter_mut().for_each(|v| *v /= size);
            let speed = square.sqrt();
            let mode = mode_kind::characterise(assembly, Complex64::new(0.0, order * speed), all);
            found.push(CriticalSpeed { speed, order, mode, label: String::new() });
        }
    }
    found.sort_by(|a, b| a.speed.total_cmp(&b.speed));
    let mut modes: Vec<Mode> = found.iter().map(|c| c.mode.clone()).collect();
    mode_kind::label(assembly, &mut modes);
    for (critical, mode) in found.iter_mut().zip(modes) {
        critical.label.clone_from(&mode.label);
        critical.mode = mode;
    }
    Ok(found)
}

/// Whether a crossing can be excited by unbalance of an axisymmetric machine: forward, at order 1.
pub fn is_synchronous_forward(critical: &CriticalSpeed) -> bool {
    critical.order == 1.0 && critical.mode.kind == ModeKind::Forward
}

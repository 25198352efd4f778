//! Whirl direction (forward, backward) from shapes measured along x and y.

use rotordyn_linalg::Complex64;
use rotordyn_signal::record::Dof;

/// Whirl measure of a shape over the points measured along x and y, weighted by their amplitude: 2 Im(φ_x
/// φ_y*) / (|φ_x|² + |φ_y|²).
///
/// q(t) = Re(φ e^{λt}) rotates from x towards y (forward, with the spin) if φ_y lags φ_x by 90°.
pub fn whirl(dofs: &[Dof], shape: &[Complex64]) -> Option<f64> {
    let along = |node: i64, axis: i8| {
        let at = dofs.iter().position(|d| d.node == node && d.direction.abs() == axis)?;
        Some(shape[at] * f64::from(dofs[at].direction.signum()))
    };
    let mut nodes: Vec<i64> = dofs.iter().map(|d| d.node).collect();
    nodes.sort_unstable();
    nodes.dedup();
    let pairs: Vec<_> =
        nodes.into_iter().filter_map(|node| Some((along(node, 1)?, along(node, 2)?))).collect();
    let size: f64 = pairs.iter().map(|(x, y)| x.norm_sqr() + y.norm_sqr()).sum();
    let area: f64 = pairs.iter().map(|(x, y)| 2.0 * (x * y.conj()).im).sum();
    (size > 0.0).then(|| area / size)
}

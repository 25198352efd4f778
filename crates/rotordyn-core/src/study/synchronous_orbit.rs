//! The 1x component of an orbit among other lines.

use rotordyn_signal::orbit::FilteredOrbit;
use std::f64::consts::{PI, TAU};

/// The 1x component of a record at constant speed over at least one turn, by least squares on 1, cos θ, sin θ with Hann's weights.
///
/// Without weights a line of order ν, as of ball passes, leaks by about 1/(π |ν − 1| N) over N turns that are not whole ones of it;
/// with them by about 1/(π |ν − 1|³ N³).
pub(super) fn synchronous_orbit(x: &[f64], y: &[f64], theta: &[f64]) -> Option<FilteredOrbit> {
    let (start, end) = (*theta.first()?, *theta.last()?);
    let turns = (end - start) / TAU;
    // A grid of whole turns contains its end once.
    let needed = 1.0 - 1.0 / theta.len() as f64;
    if turns.abs() < needed * (1.0 - 1e-9) || theta.len() < 4 {
        return None;
    }
    let mut normal = nalgebra::Matrix3::zeros();
    let mut right = nalgebra::Matrix3x2::zeros();
    for ((x, y), angle) in x.iter().zip(y).zip(theta) {
        let weight = (PI * (angle - start) / (end - start)).sin().powi(2);
        let (sin, cos) = angle.sin_cos();
        let row = nalgebra::Vector3::new(1.0, cos, sin);
        normal += weight * row * row.transpose();
        right += weight * row * nalgebra::RowVector2::new(*x, *y);
    }
    let fit = normal.cholesky()?.solve(&right);
    Some(FilteredOrbit {
        order: 1.0,
        centre: [fit[(0, 0)], fit[(0, 1)]],
        x: nalgebra::Complex::new(fit[(1, 0)], -fit[(2, 0)]),
        y: nalgebra::Complex::new(fit[(1, 1)], -fit[(2, 1)]),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ball passes of order 3.085 and their harmonics in 486.3 turns.
    #[test]
    fn ball_passes_are_not_synchronous() {
        let theta: Vec<f64> = (0..48_630).map(|k| 0.01 * TAU * f64::from(k)).collect();
        let of = |once: f64, phase: f64| -> Vec<f64> {
            let passes = |a: f64| 2.0 + (3.085 * a + phase).cos() + 0.3 * (6.17 * a).sin();
            theta.iter().map(|a| passes(*a) + once * (a + phase).cos()).collect()
        };
        let none = synchronous_orbit(&of(0.0, 0.4), &of(0.0, 1.1), &theta).unwrap();
        assert!(none.semi_axes().0 < 1e-8, "{none:?}");
        // Over the last ten turns alone, without weights, a hundredth.
        let last = 47_600..48_630;
        let short =
            FilteredOrbit::fit(&of(0.0, 0.4)[last.clone()], &of(0.0, 1.1)[last.clone()], &theta[last], 1.0);
        assert!(short.unwrap().semi_axes().0 > 1e-3);
        // x = 0.02 cos(θ − π/2), y = 0.02 cos θ: backward.
        let some = synchronous_orbit(&of(0.02, -0.5 * PI), &of(0.02, 0.0), &theta).unwrap();
        let (major, minor) = some.semi_axes();
        assert!((major - 0.02).abs() < 1e-8 && (minor + 0.02).abs() < 1e-8, "{some:?}");
        assert!((some.centre[0] - 2.0).abs() < 1e-8);
        assert!(synchronous_orbit(&theta[..50], &theta[..50], &theta[..50]).is_none());
    }
}

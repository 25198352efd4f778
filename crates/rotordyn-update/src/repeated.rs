//! Repeated (double) eigenvalues: an axisymmetric rotor at rest has two modes of one frequency, and any
//! linear combinations of them are modes as well. They are aligned with the measured shapes.

use super::pairing::{MIN_MAC, pair_score};
use super::target::TargetMode;
use rotordyn_core::analysis::modal::{self, Mode};
use rotordyn_core::assembly::Assembly;
use rotordyn_identify::mac::dot;
use rotordyn_linalg::{Complex64, SparseRow};

/// Aligns every pair of modes of a repeated eigenvalue with the measured shapes in their subspace, if any.
pub(super) fn align_repeated_modes(
    assembly: &Assembly,
    modes: &mut [Mode],
    doubles: &[Option<usize>],
    rows: &[SparseRow],
    measured: &[TargetMode],
) {
    for first in 0..modes.len() {
        let Some(second) = doubles[first].filter(|second| *second > first) else { continue };
        let at_sensors = |k: usize| rows.iter().map(|r| r.dot_complex(&modes[k].shape)).collect::<Vec<_>>();
        let Some(turn) = aligned_combinations(
            [&at_sensors(first), &at_sensors(second)],
            modes[first].frequency_hz(),
            measured,
        ) else {
            continue;
        };
        let old = [modes[first].shape.clone(), modes[second].shape.clone()];
        for (k, [a, b]) in [first, second].into_iter().zip(turn) {
            let shape = old[0].iter().zip(&old[1]).map(|(v, w)| v * a + w * b).collect();
            modes[k] = modal::with_shape(assembly, &modes[k], shape);
        }
    }
}

/// Two orthonormal combinations of two shapes, closest to the two measured shapes best in their subspace.
fn aligned_combinations(
    shapes: [&[Complex64]; 2],
    hz: f64,
    measured: &[TargetMode],
) -> Option<[[Complex64; 2]; 2]> {
    // Gram matrix of the shapes at the sensors, G = [[a, b], [b*, c]].
    let (a, c) = (dot(shapes[0], shapes[0]).re, dot(shapes[1], shapes[1]).re);
    let b = dot(shapes[0], shapes[1]);
    let determinant = a * c - b.norm_sqr();
    // Sensors in one plane cannot resolve the orientation of the pair.
    if determinant <= 1e-6 * a * c {
        return None;
    }
    let mut found: Vec<(f64, [Complex64; 2])> = Vec::new();
    for mode in measured {
        let size = dot(&mode.shape, &mode.shape).re;
        let [p, q] = shapes.map(|s| dot(s, &mode.shape));
        // Coordinates in the subspace, G⁻¹ Sᴴ m, and the fraction of m in it.
        let own = [(p * c - q * b) / determinant, (q * a - p * b.conj()) / determinant];
        let share = (p.conj() * own[0] + q.conj() * own[1]).re / size;
        let score = pair_score(share, hz, mode.frequency_hz);
        let length = (own[0].norm_sqr() + own[1].norm_sqr()).sqrt();
        if share >= MIN_MAC && score > 0.0 && length > 0.0 {
            found.push((score, own.map(|v| v / length)));
        }
    }
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    let first = found.first()?.1;
    let across = [-first[1].conj(), first[0].conj()];
    let Some(second) = found.get(1).map(|f| f.1) else { return Some([first, across]) };
    // Nearest unitary matrix (Löwdin orthogonalisation), C (CᴴC)^-½ with CᴴC = [[1, h], [h*, 1]].
    let h = first[0].conj() * second[0] + first[1].conj() * second[1];
    let size = h.norm();
    if size > 0.9 {
        // Nearly the same shape twice.
        return Some([first, across]);
    }
    let phase = if size > 0.0 { h / size } else { Complex64::default() };
    let (more, less) = ((1.0 + size).sqrt().recip(), (1.0 - size).sqrt().recip());
    let (along, cross) = (0.5 * (more + less), 0.5 * (more - less));
    let mix = |own: [Complex64; 2], other: [Complex64; 2], phase: Complex64| {
        [0, 1].map(|i| own[i] * along + other[i] * phase * cross)
    };
    Some([mix(first, second, phase.conj()), mix(second, first, phase)])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mode(shape: [f64; 4]) -> TargetMode {
        TargetMode {
            frequency_hz: 50.0,
            damping_ratio: None,
            frequency_error: 0.0,
            damping_error: 0.0,
            shape: shape.map(Complex64::from).to_vec(),
            shape_error: 0.0,
            quality_warnings: Vec::new(),
        }
    }

    #[test]
    fn repeated_modes_align_with_measured_planes() {
        let [x, y] = [[1.0, 0.5, 0.0, 0.0], [0.0, 0.0, 1.0, 0.5]].map(|s| s.map(Complex64::from));
        let (sin, cos) = 0.7_f64.sin_cos();
        // The second is 0.1 rad off, and the pair is rotated by half of it: 0.75 rad.
        let (s, c) = 0.8_f64.sin_cos();
        let measured = [mode([cos, 0.5 * cos, sin, 0.5 * sin]), mode([-s, -0.5 * s, c, 0.5 * c])];
        let [u, v] = aligned_combinations([&x, &y], 50.0, &measured).unwrap();
        assert!((u[0].re.abs() - 0.75_f64.cos()).abs() < 1e-12, "{u:?}");
        assert!((v[0].re.abs() - 0.75_f64.sin()).abs() < 1e-12, "{v:?}");
        assert!((u[0].conj() * v[0] + u[1].conj() * v[1]).norm() < 1e-12);
        // One shape alone, and none of this frequency.
        let [u, _] = aligned_combinations([&x, &y], 50.0, &measured[..1]).unwrap();
        assert!((u[0].re.abs() - cos).abs() < 1e-12);
        assert_eq!(aligned_combinations([&x, &y], 500.0, &measured), None);
        assert_eq!(aligned_combinations([&x, &x], 50.0, &measured), None);
    }
}

//! Correlation of mode shapes and FRFs: MAC, FRAC, FDAC, modal phase collinearity (MPC).

use rotordyn_linalg::Complex64;

/// Modal assurance criterion (MAC) |aᴴ b|² / (aᴴ a · bᴴ b) of two shapes, 0..1; 0 for a zero shape.
///
/// Source: Allemang & Brown, IMAC 1 (1982).
pub fn mac(a: &[Complex64], b: &[Complex64]) -> f64 {
    let size = norm_sqr(a) * norm_sqr(b);
    if size > 0.0 { dot(a, b).norm_sqr() / size } else { 0.0 }
}

/// MAC matrix: every shape of `a` (rows) with every shape of `b` (columns).
pub fn mac_matrix(a: &[&[Complex64]], b: &[&[Complex64]]) -> Vec<Vec<f64>> {
    a.iter().map(|a| b.iter().map(|b| mac(a, b)).collect()).collect()
}

/// Frequency response assurance criterion (FRAC) of two FRFs over the same frequencies, |Σ a* b|² / (Σ|a|²
/// Σ|b|²), 0..1.
///
/// Source: Heylen & Lammens, IMAC 14 (1996).
pub fn frac(a: &[Complex64], b: &[Complex64]) -> f64 {
    mac(a, b)
}

/// Frequency-domain assurance criterion (FDAC): MAC of the deflections at every line of `a` (rows) and of `b`
/// (columns).
///
/// `a[frf][line]`, `b[frf][line]` over the same FRFs; a frequency shift gives a ridge off the diagonal.
/// Source: Pascual, Golinval & Razeto, IMAC 15 (1997).
pub fn fdac(a: &[&[Complex64]], b: &[&[Complex64]]) -> Vec<Vec<f64>> {
    let lines = |frfs: &[&[Complex64]]| -> Vec<Vec<Complex64>> {
        let count = frfs.iter().map(|frf| frf.len()).min().unwrap_or(0);
        (0..count).map(|k| frfs.iter().map(|frf| frf[k]).collect()).collect()
    };
    let (a, b) = (lines(a), lines(b));
    a.iter().map(|a| b.iter().map(|b| mac(a, b)).collect()).collect()
}

/// Modal phase collinearity (MPC) ((S_xx − S_yy)² + 4 S_xy²) / (S_xx + S_yy)² of the real and imaginary
/// parts, 0..1.
///
/// 1 if all points move in phase or in antiphase (real mode), 0 for a circular whirl. Source: Vacher,
/// Jacquier & Bucharles, ISMA (2010), the form without mean.
pub fn phase_collinearity(shape: &[Complex64]) -> f64 {
    let sum = |of: &dyn Fn(&Complex64) -> f64| shape.iter().map(of).sum::<f64>();
    let (xx, yy, xy) = (sum(&|v| v.re * v.re), sum(&|v| v.im * v.im), sum(&|v| v.re * v.im));
    let size = (xx + yy) * (xx + yy);
    if size > 0.0 { ((xx - yy) * (xx - yy) + 4.0 * xy * xy) / size } else { 0.0 }
}

/// aᴴ b.
pub fn dot(a: &[Complex64], b: &[Complex64]) -> Complex64 {
    a.iter().zip(b).map(|(a, b)| a.conj() * b).sum()
}

/// aᴴ a.
pub(super) fn norm_sqr(a: &[Complex64]) -> f64 {
    a.iter().map(|v| v.norm_sqr()).sum()
}

//! Kaiser's window for filters.

/// I₀(β √(1 − r²))/I₀(β) for −1 ≤ r ≤ 1, the place over the half length; 0 outside. Kaiser (1974).
pub(crate) fn kaiser(beta: f64, r: f64) -> f64 {
    let inside = 1.0 - r * r;
    if inside < 0.0 { 0.0 } else { bessel_i0(beta * inside.sqrt()) / bessel_i0(beta) }
}

/// Modified Bessel function I₀ by its power series Σ (x²/4)ᵏ/(k!)², which converges fast for x up to 20.
fn bessel_i0(x: f64) -> f64 {
    let quarter = 0.25 * x * x;
    let (mut term, mut sum, mut k) = (1.0, 1.0, 1.0);
    while term > 1e-17 * sum {
        term *= quarter / (k * k);
        sum += term;
        k += 1.0;
    }
    sum
}

//! Deflection of a half-space under uniform pressure on a rectangle.

/// ∫∫ dξ dη / √((x − ξ)² + (y − η)²) at the corner (x, y); differences over the corners give a rectangle.
///
/// G(x, y) = x asinh(y/|x|) + y asinh(x/|y|), 0 on the line y = 0; x ≠ 0. Source: Love 1929; Johnson, Contact
/// Mechanics, eq. 3.25.
pub(super) fn corner(x: f64, y: f64) -> f64 {
    if y == 0.0 { 0.0 } else { x * (y / x.abs()).asinh() + y * (x / y.abs()).asinh() }
}

//! Belt: a static pull on a station and a linear spring and damper across the shaft.

/// Belt on a shaft node, to ground.
///
/// The static pull enters the equilibrium as a force; the stiffness resists deviation from that
/// equilibrium only, so it enters linearised and transient equations, not the static one.
#[derive(Clone, Debug, PartialEq)]
pub struct Belt {
    pub name: String,
    /// Shaft node of the pulley.
    pub node: usize,
    /// Static pull on the shaft \[N\], along x and y.
    pub pull: [f64; 2],
    /// Stiffness along x, y and about z \[N/m, N/m, N m/rad\].
    pub stiffness: [f64; 3],
    /// Damping along x, y and about z \[N s/m, N s/m, N m s/rad\].
    pub damping: [f64; 3],
}

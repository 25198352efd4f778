//! Belt: a static pull on a station and a linear spring and damper across the shaft.

/// Belt on a shaft node, to ground.
///
/// On fixed centres the pull is that of the undeflected shaft and falls as the shaft gives way: the stiffness
/// acts in statics as everywhere. With a constant pull (dead-weight or spring tensioner) the pull stays as
/// given and the stiffness only resists fast deviation from the equilibrium.
#[derive(Clone, Debug, PartialEq)]
pub struct Belt {
    pub name: String,
    /// Shaft node of the pulley.
    pub node: usize,
    /// Static pull on the shaft \[N\], along x and y.
    pub pull: [f64; 2],
    /// Whether the pull stays as given while the shaft gives way; else it belongs to the undeflected shaft.
    pub constant_pull: bool,
    /// Stiffness along x, y and about z \[N/m, N/m, N m/rad\].
    pub stiffness: [f64; 3],
    /// Damping along x, y and about z \[N s/m, N s/m, N m s/rad\].
    pub damping: [f64; 3],
}

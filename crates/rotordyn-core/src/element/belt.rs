//! Belt: static pull (belt tension) on a station, and a linear spring-damper across the shaft.

/// Belt on a shaft node, to ground.
///
/// With fixed centres the pull is that of the undeflected shaft and decreases as the shaft deflects: the
/// stiffness also acts in statics. With constant pull the stated pull is that of the machine at rest, whether
/// a tensioner holds it or it was set after mounting, and the stiffness only acts on deviations from the
/// equilibrium.
#[derive(Clone, Debug, PartialEq)]
pub struct Belt {
    pub name: String,
    /// Shaft node of the pulley.
    pub node: usize,
    /// Static pull on the shaft \[N\], along x and y.
    pub pull: [f64; 2],
    /// Whether `pull` is that of the machine at rest; else it is that of the undeflected shaft and unsettled
    /// supports, and less at equilibrium.
    pub constant_pull: bool,
    /// Stiffness along x, y and about z \[N/m, N/m, N m/rad\].
    pub stiffness: [f64; 3],
    /// Damping along x, y and about z \[N s/m, N s/m, N m s/rad\].
    pub damping: [f64; 3],
}

//! Belt: static pull (belt tension) on a station, and a linear spring-damper across the shaft.

use super::anchor::Anchor;
use super::contribution::{Connection, Element, ElementMatrices};

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

impl Element for Belt {
    fn add_matrices(&self, _node: usize, to: &mut ElementMatrices) {
        let stiffness = if self.constant_pull { &mut to.deviation_stiffness } else { &mut to.stiffness };
        for (k, dof) in [0, 1, 5].into_iter().map(|axis| 6 * self.node + axis).enumerate() {
            stiffness.add(dof, dof, self.stiffness[k]);
            to.damping.add(dof, dof, self.damping[k]);
            to.support_damping.add(dof, dof, self.damping[k]);
        }
    }

    fn add_load(&self, to: &mut [f64]) {
        to[6 * self.node] += self.pull[0];
        to[6 * self.node + 1] += self.pull[1];
    }

    fn connection(&self) -> Option<Connection> {
        let [x, y, spin] = self.stiffness.map(|k| k != 0.0);
        let found = Connection {
            name: format!("belt.{}", self.name),
            ends: [Anchor::node(self.node), Anchor::GROUND],
            stiff: [x, y, false, false, false, spin],
        };
        (x || y || spin).then_some(found)
    }
}

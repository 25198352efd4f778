//! The machine model: immutable, in SI units.

mod external_file;
pub mod free_ball_study;
mod integrator;
mod probe;
pub mod run_channels;
mod shaft_extent;
pub mod speed_profile;
mod steady_study;
pub mod study;

pub use external_file::{ExternalColumn, ExternalFile};
pub use probe::{Probe, Quantity};
pub use rotordyn_signal::band_noise::BandNoise;
pub use shaft_extent::{EqualElements, ShaftExtent};
pub use speed_profile::{SpeedCurve, SpeedProfile, Spin};

use crate::element::{
    Anchor, Belt, Bushing, Disc, Element, Joint, Material, PointMass, RigidBody, ShaftElement,
};
use rotordyn_bearing::Bearing;
use rotordyn_linalg::{Outside, piecewise};

/// One rotating machine in SI units; immutable after validation.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    pub name: String,
    pub title: String,
    /// Gravity \[m/s²\].
    pub gravity: [f64; 3],
    pub materials: Vec<Material>,
    /// Axial position of every shaft node \[m\], increasing.
    pub node_z: Vec<f64>,
    /// Element k joins shaft nodes k and k+1.
    pub shaft: Vec<ShaftElement>,
    /// Rigid rotor in place of shaft elements: its inertia at the node of its centre of mass; all shaft nodes
    /// are rigidly connected to it.
    pub rigid_rotor: Option<Disc>,
    pub stations: Vec<Station>,
    pub discs: Vec<Disc>,
    /// Body k is node `node_z.len() + k`.
    pub bodies: Vec<RigidBody>,
    pub masses: Vec<PointMass>,
    pub bushings: Vec<Bushing>,
    pub joints: Vec<Joint>,
    pub bearings: Vec<BearingSite>,
    pub belts: Vec<Belt>,
    pub unbalances: Vec<Unbalance>,
    pub loads: Vec<Load>,
    pub damping: Damping,
    pub drive: Drive,
    pub profile: SpeedProfile,
    pub probes: Vec<Probe>,
    pub studies: study::Studies,
}

impl Model {
    /// Number of nodes: shaft nodes, then bodies.
    pub fn node_count(&self) -> usize {
        self.node_z.len() + self.bodies.len()
    }

    /// Every element, with the left node of a shaft element and the node of a body.
    pub fn elements(&self) -> impl Iterator<Item = (usize, &dyn Element)> {
        fn each<E: Element>(list: &[E]) -> impl Iterator<Item = (usize, &dyn Element)> {
            list.iter().enumerate().map(|(k, element)| (k, element as &dyn Element))
        }
        let bodies = each(&self.bodies).map(|(k, body)| (self.node_z.len() + k, body));
        let discs = each(&self.discs).chain(self.rigid_rotor.iter().map(|rotor| (0, rotor as &dyn Element)));
        let inertias = discs.chain(bodies).chain(each(&self.masses));
        each(&self.shaft).chain(inertias).chain(each(&self.bushings)).chain(each(&self.belts))
    }

    /// Rigid rotating inertias: discs, then the rigid rotor.
    pub fn rotating_inertias(&self) -> impl Iterator<Item = &Disc> {
        self.discs.iter().chain(&self.rigid_rotor)
    }

    /// Names of the bearings with estimated internal geometry, and how each was estimated.
    pub fn estimated_geometries(&self) -> impl Iterator<Item = (&str, &str)> {
        self.bearings.iter().filter_map(|site| {
            Some((site.name.as_str(), site.bearing.ball()?.estimated_geometry.as_deref()?))
        })
    }
}

/// Named shaft station.
#[derive(Clone, Debug, PartialEq)]
pub struct Station {
    pub name: String,
    pub node: usize,
    /// Axial position \[m\].
    pub z: f64,
}

/// A bearing between a shaft node and a housing (body or ground).
#[derive(Clone, Debug, PartialEq)]
pub struct BearingSite {
    pub name: String,
    /// Shaft node.
    pub node: usize,
    /// Housing side: the point of the body (or ground) at the bearing's centre.
    pub housing: Anchor,
    pub bearing: Bearing,
}

/// Unbalance at a shaft node: F_x = U (Ω² cos φ + Ω̇ sin φ), F_y = U (Ω² sin φ − Ω̇ cos φ), φ = θ + phase.
#[derive(Clone, Debug, PartialEq)]
pub struct Unbalance {
    pub name: String,
    pub node: usize,
    /// Magnitude U = m e \[kg m\].
    pub magnitude: f64,
    /// Phase from the shaft's keyphasor \[rad\].
    pub phase: f64,
}

/// Concentrated load at an anchor: constant or over time.
#[derive(Clone, Debug, PartialEq)]
pub struct Load {
    pub name: String,
    pub at: Anchor,
    /// Force and moment \[N, N m\] at factor 1.
    pub force: [f64; 6],
    pub factor: LoadFactor,
}

/// Factor of a load over time.
#[derive(Clone, Debug, PartialEq)]
pub enum LoadFactor {
    /// Always 1, and part of the static load.
    Constant,
    /// (time \[s\], factor), piecewise linear; the first and the last factor hold before and after. No part of the static load.
    Table(Vec<[f64; 2]>),
    /// Gaussian of RMS 1 in a frequency band.
    Random(BandNoise),
}

impl LoadFactor {
    /// Value at a time \[s\].
    pub fn at(&self, time: f64) -> f64 {
        match self {
            Self::Constant => 1.0,
            Self::Table(points) => piecewise(points, time, Outside::Constant)[1],
            Self::Random(noise) => noise.at(time),
        }
    }

    pub fn is_random(&self) -> bool {
        matches!(self, Self::Random(_))
    }

    pub fn is_constant(&self) -> bool {
        matches!(self, Self::Constant)
    }
}

/// Global damping: proportional (Rayleigh) and modal damping, in addition to that of the elements.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Damping {
    /// C = α M + β K of the assembled structure: α \[1/s\], β \[s\].
    pub proportional: [f64; 2],
    /// Modal damping, e.g. measured: (frequency \[Hz\], damping ratio ζ), piecewise linear in frequency,
    /// constant beyond the ends; empty means none. Applied to the undamped modes at standstill.
    pub modal: Vec<[f64; 2]>,
}

/// How the shaft is driven.
#[derive(Clone, Debug, PartialEq)]
pub enum Drive {
    /// The rotation of this node follows the speed profile exactly; with `None` the whole shaft spins at the
    /// profile's speed and its torsion is free.
    Prescribed { node: Option<usize> },
    /// Drive torque at this node, a torque-speed characteristic: (speed \[rad/s\], torque \[N m\]) table. The
    /// speed follows from the equation of rotation, coupled to the other motions by unbalance, tilting inertias and
    /// damping; `drag` \[N m s/rad\] is viscous resistance to ground.
    Torque { node: usize, table: Vec<[f64; 2]>, drag: f64 },
}

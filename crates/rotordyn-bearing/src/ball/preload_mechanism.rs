//! How a row is preloaded, from its dry axial force.

use crate::{Preload, root_finding};
use serde::{Deserialize, Serialize};

/// Preload of a bearing with centred rings at one speed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PreloadState {
    /// Axial approach of the rings from nominal in the direction of thrust \[m\].
    pub offset: f64,
    /// Resulting axial force \[N\]; in a back-to-back or face-to-face pair that of each row.
    pub axial_force: f64,
}

/// Preload mechanism of a row, with its speed-independent quantities.
#[derive(Clone, Copy, Debug)]
pub(super) enum PreloadMechanism {
    /// Rigid, at this offset.
    Fixed(f64),
    /// Rigid, at the offset where the centred bearing carries this force at speed; `dry`: initial guess, dry
    /// offset.
    Force { force: f64, dry: f64 },
    /// Spring preload; dry centred offset, and the ring's share in an axial displacement there.
    Spring { stiffness: f64, force: f64, dry: f64, ring_motion_ratio: f64 },
}

impl PreloadMechanism {
    /// Preload mechanism of a row from its dry axial force and stiffness as a function of offset.
    pub fn new(preload: &Preload, dry: impl Fn(f64) -> [f64; 2]) -> Self {
        let guess = 1e-6;
        let offset_at_force = |force: f64| {
            root_finding::increasing_root(
                |offset| {
                    let [n, slope] = dry(offset);
                    [n - force, slope]
                },
                guess,
            )
        };
        match *preload {
            Preload::None => Self::Fixed(0.0),
            Preload::Interference(offset) | Preload::Mounted { interference: Some(offset), .. } => {
                Self::Fixed(offset)
            }
            Preload::DryForce(force) | Preload::Mounted { force, interference: None } => {
                Self::Fixed(offset_at_force(force))
            }
            Preload::Force(force) => Self::Force { force, dry: offset_at_force(force) },
            Preload::Spring { stiffness, force } => {
                let offset = root_finding::increasing_root(
                    |e| {
                        let [n, slope] = dry(e);
                        [n + stiffness * e - force, slope + stiffness]
                    },
                    guess,
                );
                let slope = dry(offset)[1];
                Self::Spring { stiffness, force, dry: offset, ring_motion_ratio: slope / (slope + stiffness) }
            }
        }
    }
}

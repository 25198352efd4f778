//! Axial force that a preloaded bearing carries at an equilibrium.

use std::sync::Arc;

use super::equilibrium::{BearingState, CAGE_ANGLES_PER_PITCH, CageTreatment};
use crate::document::{Document, in_json, quantity};
use crate::model::Model;
use rotordyn_bearing::{BearingElement, Preload, Rotation};
use serde::{Deserialize, Serialize};

/// Preload of a ball bearing beside the axial force that it carries in the machine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MountedPreload {
    pub bearing: String,
    /// As stated in the model file.
    pub stated: Preload,
    /// Axial force of every row in the direction of its thrust at equilibrium \[N\]; of a tandem pair that of both together, which
    /// share the preload.
    pub rows: Vec<f64>,
}

impl MountedPreload {
    /// Smallest axial force of a row as a share of the stated one; `None` for a stated interference.
    pub fn share(&self) -> Option<f64> {
        let least = self.rows.iter().copied().fold(f64::INFINITY, f64::min);
        self.stated.force().filter(|force| *force > 0.0).map(|force| least / force)
    }

    /// Mean axial force of the rows as a share of the stated one; `None` for a stated interference.
    ///
    /// A thrust on a pair unloads one row by about what it adds to the other; a shaft that yields unloads the mean.
    pub fn mean_share(&self) -> Option<f64> {
        let mean = self.rows.iter().sum::<f64>() / self.rows.len() as f64;
        self.stated.force().filter(|force| *force > 0.0).map(|force| mean / force)
    }

    /// What is written to files, without the bearing's name.
    pub fn document(&self) -> Document<'_> {
        let (kind, interference, stiffness) = match self.stated {
            Preload::None => ("none", None, None),
            Preload::Interference(offset) => ("interference", Some(offset), None),
            Preload::DryForce(_) => ("dry_force", None, None),
            Preload::Force(_) => ("force", None, None),
            Preload::Spring { stiffness, .. } => ("spring", None, Some(stiffness)),
            Preload::Mounted { interference, .. } => ("mounted_force", interference, None),
        };
        Document::new()
            .text(in_json("kind"), kind)
            .optional(quantity("stated_force", "N"), "N", self.stated.force())
            .optional(in_json("interference_m"), "m", interference)
            .optional(in_json("spring_n_per_m"), "N/m", stiffness)
            .numbers(quantity("axial_force", "N"), "N", &self.rows)
            .optional(in_json("share"), "1", self.share())
    }
}

/// Axial forces of the preloaded ball bearings at an equilibrium, F = ±f_z of a single row or a tandem pair, F = ±Σ Q_j sin α_j
/// of the rows of another pair, positive in the direction of the row's thrust.
pub(super) fn mounted_preloads(
    model: &Model,
    elements: &[(Arc<dyn BearingElement>, Rotation)],
    states: &[BearingState],
    cage: CageTreatment,
) -> Vec<MountedPreload> {
    let mut found = Vec::new();
    for (site, ((element, rotation), state)) in model.bearings.iter().zip(elements.iter().zip(states)) {
        let Some(ball) = site.bearing.static_balls() else { continue };
        if ball.preload == Preload::None {
            continue;
        }
        let rows = match ball.rows().as_slice() {
            [(_, direction)] => vec![-direction * state.force[2]],
            [(_, first), (_, second)] if first == second => vec![-first * state.force[2]],
            rows => rows
                .iter()
                .enumerate()
                .map(|(row, (_, direction))| {
                    direction * row_force(row, element.as_ref(), rotation, state, cage)
                })
                .collect(),
        };
        found.push(MountedPreload { bearing: site.name.clone(), stated: ball.preload, rows });
    }
    found
}

/// Axial force Σ Q_j sin α_j of one row \[N\], averaged over the cage angle as the equilibrium.
pub(super) fn row_force(
    row: usize,
    element: &dyn BearingElement,
    rotation: &Rotation,
    state: &BearingState,
    cage: CageTreatment,
) -> f64 {
    let angles = if cage == CageTreatment::Averaged { CAGE_ANGLES_PER_PITCH } else { 1 };
    let pitch = std::f64::consts::TAU / element.rolling_elements() as f64;
    let at = |k: usize| -> f64 {
        let cage_angle = rotation.cage_angle + pitch * k as f64 / angles as f64;
        let balls = element.contact_loads(&state.displacement, &Rotation { cage_angle, ..*rotation });
        balls.iter().filter(|ball| ball.row == row).map(|ball| ball.load * ball.contact_angle.sin()).sum()
    };
    (0..angles).map(at).sum::<f64>() / angles as f64
}

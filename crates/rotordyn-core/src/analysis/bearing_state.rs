//! A bearing at equilibrium, and the cage angles at which it is evaluated.

use crate::document::{Array, Document, Rows, in_json};
use rotordyn_bearing::{BearingContact, PreloadState, SiteTangent};
use serde::{Deserialize, Serialize};

/// Number of cage angles per ball pitch over which a bearing is averaged.
pub const CAGE_ANGLES_PER_PITCH: usize = 12;

/// Bearing forces at the cage angle of the model (`FixedAngle`), or averaged over one ball pitch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum CageTreatment {
    FixedAngle,
    Averaged,
}

/// One bearing at equilibrium.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BearingState {
    pub name: String,
    /// Displacement of the shaft relative to the housing \[m, rad\].
    pub displacement: [f64; 6],
    /// Force and moment on the shaft \[N, N m\].
    pub force: [f64; 6],
    /// Tangent stiffness and damping at equilibrium; opposite sign for the housing.
    pub tangent: SiteTangent,
    /// Every contact at the cage angle of the model, balls in a ball bearing; empty for a linear bearing.
    pub balls: Vec<BearingContact>,
    /// Largest ball load over all cage angles at this displacement \[N\]; 0 for a linear bearing.
    pub largest_ball_load: f64,
    /// Preload of the centred bearing at the speed; zero for a linear bearing.
    pub preload: PreloadState,
}

impl CageTreatment {
    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::FixedAngle => "fixed angle",
            Self::Averaged => "averaged over a ball pitch",
        }
    }
}

impl BearingState {
    /// What is written to files, without the name.
    pub fn document(&self) -> Document<'_> {
        let matrix = |m: &'_ [[f64; 6]; 6], unit| Array::real(&[6, 6], unit, m.as_flattened().to_vec());
        let balls = Rows::of(&self.balls)
            .quantity("position", "rad", |b| b.position)
            .quantity("load", "N", |b| b.load)
            .quantity("contact_angle", "rad", |b| b.contact_angle)
            .quantity("deflection", "m", |b| b.deflection);
        let names = if self.balls.is_empty() { in_json("balls") } else { "balls".into() };
        Document::new()
            .quantity("largest_ball_load", "N", self.largest_ball_load)
            .numbers("displacement", "m, rad", &self.displacement)
            .numbers("force", "N, N m", &self.force)
            .array("stiffness", matrix(&self.tangent.stiffness, "N/m, N, N m/rad"))
            .array("damping", matrix(&self.tangent.damping, "N s/m, N s, N m s/rad"))
            .table(names, balls)
    }
}

//! A bearing at equilibrium, and the cage angles at which it is evaluated.

use rotordyn_bearing::{BearingContact, PreloadState, SiteTangent};

/// Number of cage angles per ball pitch over which a bearing is averaged.
pub const CAGE_ANGLES_PER_PITCH: usize = 12;

/// Bearing forces at the cage angle of the model (`FixedAngle`), or averaged over one ball pitch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CageTreatment {
    FixedAngle,
    Averaged,
}

/// One bearing at equilibrium.
#[derive(Clone, Debug, PartialEq)]
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

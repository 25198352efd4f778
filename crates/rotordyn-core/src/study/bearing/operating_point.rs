//! Operating point of a single bearing.

use super::super::bearing_life::BearingRating;
use crate::analysis::bearing_stiffness::BearingSolver;
use crate::analysis::equilibrium::CageTreatment;
use crate::analysis::preload::MountedPreload;
use crate::model::study::BearingStudy;
use rotordyn_bearing::BallBearing;
use rotordyn_bearing::contact::BallContacts;

pub(super) fn cage_treatment(study: &BearingStudy) -> CageTreatment {
    if study.cage_average { CageTreatment::Averaged } else { CageTreatment::FixedAngle }
}

/// Operating point: load and prescribed displacements.
pub(super) struct OperatingPoint {
    pub(super) load: [f64; 5],
    pub(super) prescribed: [Option<f64>; 5],
    /// Description of the load's source.
    pub(super) load_source: String,
    pub(super) mounted_preload: Option<MountedPreload>,
}

/// Study of one bearing.
pub(super) struct SingleBearingStudy<'a> {
    pub(super) name: &'a str,
    pub(super) bearing: &'a BallBearing,
    pub(super) study: &'a BearingStudy,
    pub(super) solver: BearingSolver,
    /// Contacts with a film of the bearing's lubricant, also for a dry contact law: for the film thickness.
    pub(super) contacts: BallContacts,
    pub(super) rating: BearingRating<'a>,
    pub(super) speed: f64,
}

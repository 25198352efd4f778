//! Ball bearings with static balls as a bearing model.

use std::f64::consts::TAU;
use std::sync::Arc;

use super::element::BallElement;
use super::input::{Arrangement, BallBearing, Duplex, Preload};
use super::preload::PreloadState;
use crate::model::{BearingElement, BearingModel, BearingSymbol, CageStart};
use crate::{BearingContact, Profile, Reaction, Rotation};

impl BearingModel for BallBearing {
    fn keyword(&self) -> &'static str {
        "ball"
    }

    fn description(&self) -> String {
        String::new()
    }

    fn element(&self) -> Arc<dyn BearingElement> {
        Arc::new(BallElement::new(self))
    }

    fn supports(&self) -> [bool; 6] {
        [true, true, true, true, true, false]
    }

    fn depends_on_speed(&self) -> bool {
        Self::depends_on_speed(self)
    }

    fn symbol(&self) -> BearingSymbol<'_> {
        BearingSymbol::RollingElement
    }

    fn thrust_directions(&self) -> [bool; 2] {
        match self.duplex {
            Some(Duplex { arrangement: Arrangement::BackToBack | Arrangement::FaceToFace, .. }) => [true; 2],
            _ if self.geometry.contact_angle == 0.0 && self.preload == Preload::None => [true; 2],
            _ => [self.geometry.thrust_direction > 0.0, self.geometry.thrust_direction < 0.0],
        }
    }

    fn cage(&self) -> Option<CageStart> {
        Some(self.cage_start())
    }

    fn set_cage_angle(&mut self, angle: f64) {
        self.cage_angle = angle;
    }

    fn ball(&self) -> Option<&BallBearing> {
        Some(self)
    }

    fn static_balls(&self) -> Option<&BallBearing> {
        Some(self)
    }

    fn static_balls_mut(&mut self) -> Option<&mut BallBearing> {
        Some(self)
    }
}

impl BallBearing {
    /// The cage at the start; with equal balls it looks the same after a pitch 2π/Z.
    pub fn cage_start(&self) -> CageStart {
        let period = if self.balls_are_alike() { TAU / self.geometry.balls as f64 } else { TAU };
        CageStart { angle: self.cage_angle, period }
    }
}

impl BearingElement for BallElement {
    fn relative_dofs(&self) -> usize {
        5
    }

    fn reaction(&self, d: &[f64; 6], v: &[f64; 6], rotation: &Rotation) -> Reaction {
        Self::reaction(self, d, v, rotation)
    }

    fn force(&self, d: &[f64; 6], v: &[f64; 6], rotation: &Rotation, out: &mut Reaction) {
        Self::force(self, d, v, rotation, out);
    }

    fn has_cheap_force(&self) -> bool {
        BallElement::has_cheap_force(self)
    }

    fn cage_average(&self, d: &[f64; 6], rotation: &Rotation, angles: usize) -> Reaction {
        Self::cage_average(self, d, rotation, angles)
    }

    fn contact_loads(&self, d: &[f64; 6], rotation: &Rotation) -> Vec<BearingContact> {
        self.ball_loads(d, rotation)
    }

    fn depends_on_speed(&self) -> bool {
        Self::depends_on_speed(self)
    }

    fn preload_state(&self, speed: f64) -> PreloadState {
        Self::preload_state(self, speed)
    }

    fn rolling_elements(&self) -> usize {
        self.balls()
    }

    fn has_defects(&self) -> bool {
        self.profiles().any(Profile::has_defects)
    }

    fn meets_defect(&self, from: &Rotation, to: &Rotation) -> bool {
        self.profiles().any(|profile| profile.meets_defect(from, to))
    }

    fn each_defect_edge(&self, from: &Rotation, to: &Rotation, visit: &mut dyn FnMut(f64)) {
        self.profiles().for_each(|profile| profile.each_edge(from, to, &mut *visit));
    }

    fn cage_ratio(&self, mean_cos: f64) -> f64 {
        Self::cage_ratio(self, mean_cos)
    }

    fn nominal_cos(&self) -> f64 {
        Self::nominal_cos(self)
    }
}

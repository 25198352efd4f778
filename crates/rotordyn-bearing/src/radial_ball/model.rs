//! Plane ball bearings with one coordinate per ball as a bearing model.

use std::sync::Arc;

use super::{RadialBallBearing, RadialElement, Rings};
use crate::internal::{InternalCoordinates, InternalStep, InternalTangent, Motion, NewmarkGain};
use crate::model::{BearingElement, BearingModel, BearingSymbol, CageStart};
use crate::{BallBearing, BearingContact, Reaction, Rotation};

impl BearingModel for RadialBallBearing {
    fn keyword(&self) -> &'static str {
        "radial_ball"
    }

    fn description(&self) -> String {
        "radial ball DOF".into()
    }

    fn element(&self) -> Arc<dyn BearingElement> {
        Arc::new(RadialElement::new(self))
    }

    fn supports(&self) -> [bool; 6] {
        [true, true, false, false, false, false]
    }

    fn depends_on_speed(&self) -> bool {
        self.ball_mass() > 0.0
    }

    fn symbol(&self) -> BearingSymbol<'_> {
        BearingSymbol::RollingElement
    }

    fn added_housing_mass(&self) -> f64 {
        self.added_ball_mass()
    }

    fn cage(&self) -> Option<CageStart> {
        Some(self.ball.cage_start())
    }

    fn set_cage_angle(&mut self, angle: f64) {
        self.ball.cage_angle = angle;
    }

    fn ball(&self) -> Option<&BallBearing> {
        Some(&self.ball)
    }
}

impl BearingElement for RadialElement {
    fn relative_dofs(&self) -> usize {
        2
    }

    fn reaction(&self, d: &[f64; 6], v: &[f64; 6], rotation: &Rotation) -> Reaction {
        Self::reaction(self, d, v, rotation)
    }

    fn cage_average(&self, d: &[f64; 6], rotation: &Rotation, angles: usize) -> Reaction {
        Self::cage_average(self, d, rotation, angles)
    }

    fn contact_loads(&self, d: &[f64; 6], rotation: &Rotation) -> Vec<BearingContact> {
        self.ball_loads(d, rotation)
    }

    fn depends_on_speed(&self) -> bool {
        self.ball_mass() > 0.0
    }

    fn rolling_elements(&self) -> usize {
        self.balls()
    }

    fn has_defects(&self) -> bool {
        self.profile.as_ref().is_some_and(|profile| profile.has_defects())
    }

    fn meets_defect(&self, from: &Rotation, to: &Rotation) -> bool {
        self.profile.as_ref().is_some_and(|profile| profile.meets_defect(from, to))
    }

    fn cage_ratio(&self, _mean_cos: f64) -> f64 {
        Self::cage_ratio(self)
    }

    fn internal(&self) -> Option<&dyn InternalCoordinates> {
        Some(self)
    }
}

impl InternalCoordinates for RadialElement {
    fn masses(&self) -> &[f64] {
        &self.masses
    }

    fn name(&self, coordinate: usize) -> String {
        format!("ball {coordinate}")
    }

    fn housing_dofs(&self) -> usize {
        2
    }

    fn equilibrium(&self, rows: &[f64], rotation: &Rotation) -> Vec<f64> {
        self.equilibrium_positions(&Rings::from_rows(rows, &[]), rotation)
    }

    fn stiffness(&self, _coordinate: usize, rotation: &Rotation) -> f64 {
        self.outer_contact_stiffness(rotation)
    }

    fn forces(
        &self,
        rows: Motion,
        coordinates: Motion,
        rotation: &Rotation,
        on_rows: &mut [f64],
        on_coordinates: &mut [f64],
    ) -> Reaction {
        let rings = Rings::from_rows(rows.position, rows.velocity);
        let balls = [coordinates.position, coordinates.velocity];
        let reaction = Self::forces(self, &rings, balls, rotation, on_coordinates);
        on_rows.copy_from_slice(&reaction.force[..on_rows.len()]);
        reaction
    }

    fn tangent(&self, rows: Motion, coordinates: Motion, rotation: &Rotation) -> InternalTangent {
        let rings = Rings::from_rows(rows.position, rows.velocity);
        let mut out = Self::tangent(self, &rings, [coordinates.position, coordinates.velocity], rotation);
        // Without the rows of a fixed housing.
        for matrix in [&mut out.stiffness, &mut out.damping] {
            matrix.drain(rows.position.len()..4);
            matrix.iter_mut().for_each(|row| drop(row.drain(rows.position.len()..4)));
        }
        out
    }

    fn step(
        &self,
        rows: Motion,
        balls: InternalStep,
        rotation: &Rotation,
        gain: &NewmarkGain,
        on_rows: &mut [f64],
    ) -> Reaction {
        let rings = Rings::from_rows(rows.position, rows.velocity);
        let reaction = Self::step(self, &rings, on_rows.len(), balls, rotation, gain);
        on_rows.copy_from_slice(&reaction.force[..on_rows.len()]);
        reaction
    }
}

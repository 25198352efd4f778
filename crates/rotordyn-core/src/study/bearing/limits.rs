//! Warnings of ball bearings that exceed a limit of their model or operation, in every study.

use super::super::warnings::standstill_and_top;
use super::{Machine, SingleBearingStudy, TO_RPM};
use crate::analysis::bearing_stiffness::Condition;
use crate::analysis::equilibrium::{CageTreatment, Equilibrium, equilibrium};
use crate::assembly::PhysicsError;
use crate::model::study::BearingStudy;
use crate::results::BearingPoint;
use crate::transient::peak_loads::PeakLoad;
use crate::warning::{Code, Warning};
use rotordyn_bearing::limits::{BearingLoad, ExceededLimit};
use rotordyn_bearing::{BallLoad, LimitCheck};
use std::mem::discriminant;

impl Machine {
    /// Limits that the ball bearings exceed in static equilibrium at the highest of the speeds \[rad/s\], and beside
    /// those at standstill.
    ///
    /// # Errors
    /// No equilibrium.
    pub fn bearing_warnings(&self, speeds: &[f64]) -> Result<Vec<Warning>, PhysicsError> {
        if let Some(machine) = self.decided(speeds)? {
            return machine.bearing_warnings(speeds);
        }
        let mut found: Vec<(&str, f64, ExceededLimit)> = Vec::new();
        let mut unloaded: Vec<Warning> = Vec::new();
        for speed in standstill_and_top(speeds) {
            let start = &self.standstill_equilibrium.q;
            let state =
                equilibrium(&self.model, &self.assembly, speed, CageTreatment::FixedAngle, Some(start))?;
            for warning in self.unloaded_bearings(&state) {
                if !unloaded.iter().any(|known| known.item == warning.item) {
                    unloaded.push(warning);
                }
            }
            for (name, limit) in self.exceeded_limits(&state)? {
                let kind = discriminant(&limit);
                if !found.iter().any(|(other, _, known)| *other == name && discriminant(known) == kind) {
                    found.push((name, speed, limit));
                }
            }
        }
        unloaded.extend(found.into_iter().map(|(name, speed, limit)| message(name, speed, &limit)));
        Ok(unloaded)
    }

    /// Static load ratings that the largest loads of a run exceed, by the balls' loads at the displacements there.
    ///
    /// A displacement for which no ball loads are found has no warning.
    pub(crate) fn peak_load_warnings(&self, peaks: &[PeakLoad]) -> Vec<Warning> {
        let speeds: Vec<f64> = peaks.iter().map(|peak| peak.speed.abs()).collect();
        if let Ok(Some(machine)) = self.decided(&speeds) {
            return machine.peak_load_warnings(peaks);
        }
        let mut found = Vec::new();
        for peak in peaks {
            let site = self.model.bearings.iter().find(|site| site.name == peak.bearing);
            let Some(ball) = site.and_then(|site| site.bearing.ball()) else { continue };
            let study = BearingStudy { speed: Some(peak.speed), ..BearingStudy::default() };
            let single = SingleBearingStudy::new(&peak.bearing, ball, &study);
            let condition = Condition {
                load: [0.0; 5],
                prescribed: peak.displacement.map(Some),
                speed: peak.speed,
                cage: CageTreatment::FixedAngle,
                cage_angle: peak.cage_angle,
            };
            let Ok(state) = single.solver.solve(&condition, None) else { continue };
            let limits = single.exceeded_limits(&single.point(state));
            let overload = limits.iter().find(|limit| matches!(limit, ExceededLimit::StaticLoad { .. }));
            found.extend(overload.map(|limit| {
                let (name, rpm) = (&peak.bearing, peak.speed * TO_RPM);
                let text = format!("bearing {name} at t = {:.4} s, {rpm:.0} rpm: {limit}", peak.time);
                Warning::new(code(limit), format!("bearing.{name}"), text)
            }));
        }
        found
    }

    fn exceeded_limits(&self, state: &Equilibrium) -> Result<Vec<(&str, ExceededLimit)>, PhysicsError> {
        let speed = state.speed;
        let bearings = self.model.bearings.iter().enumerate();
        let balls = bearings.filter_map(|(k, site)| Some((k, &*site.name, site.bearing.static_balls()?)));
        let balls: Vec<_> = balls.collect();
        if balls.is_empty() {
            return Ok(Vec::new());
        }
        let study =
            BearingStudy { speed: Some(speed), ..self.model.studies.bearing.clone().unwrap_or_default() };
        let mut found = Vec::new();
        for (k, name, ball) in balls {
            let d = state.bearings[k].displacement;
            let condition = Condition {
                load: [0.0; 5],
                prescribed: std::array::from_fn(|a| Some(d[a])),
                speed,
                cage: CageTreatment::FixedAngle,
                cage_angle: ball.cage_angle,
            };
            let single = SingleBearingStudy::new(name, ball, &study);
            let point = single.point(single.solver.solve(&condition, None)?);
            // One without load is named with those of other models.
            let limits = single.exceeded_limits(&point).into_iter();
            found.extend(limits.filter(|limit| *limit != ExceededLimit::Unloaded).map(|limit| (name, limit)));
        }
        Ok(found)
    }
}

impl SingleBearingStudy<'_> {
    fn exceeded_limits(&self, point: &BearingPoint) -> Vec<ExceededLimit> {
        self.load_at(point, &self.solver.ball_loads(&point.state)).exceeded_limits()
    }

    /// Every limit that applies, with its figure.
    pub(super) fn limit_checks(&self, point: &BearingPoint) -> Vec<LimitCheck> {
        self.load_at(point, &self.solver.ball_loads(&point.state)).limit_checks()
    }

    fn load_at<'b>(&'b self, point: &BearingPoint, balls: &'b [BallLoad]) -> BearingLoad<'b> {
        let speed = point.state.condition.speed;
        let film = self.bearing.lubricant().map(|_| [point.minimum_film(), self.study.roughness]);
        BearingLoad {
            bearing: self.bearing,
            balls,
            speed,
            cage_speed: point.orders.ftf * speed,
            axial_displacement: point.state.displacement[2],
            equivalent_load: self.rating().dynamic / point.life.reference.cbrt(),
            static_load: point.life.static_load,
            static_rating: self.rating().static_rating,
            film,
        }
    }

    /// Warnings at the operating point.
    pub(super) fn warnings(&self, point: &BearingPoint) -> Vec<Warning> {
        let speed = point.state.condition.speed;
        let mut found = self.rating.warnings(self.name, &point.life);
        found.extend(self.exceeded_limits(point).iter().map(|limit| message(self.name, speed, limit)));
        let imperfections = &self.bearing.imperfections;
        if self.study.cage_average && !imperfections.is_empty() {
            let text = format!(
                "bearing {} ({}) is averaged over the cage angle as if it had no defects; ball loads are those at the cage angle of the model",
                self.name,
                imperfections.condition()
            );
            found.push(Warning::new(Code::DefectsAveraged, format!("bearing.{}", self.name), text));
        }
        found
    }
}

fn message(name: &str, speed: f64, limit: &ExceededLimit) -> Warning {
    let text = match speed {
        0.0 => format!("bearing {name} at standstill: {limit}"),
        _ => format!("bearing {name} at {:.0} rpm: {limit}", speed * TO_RPM),
    };
    Warning::new(code(limit), format!("bearing.{name}"), text)
}

fn code(limit: &ExceededLimit) -> Code {
    match limit {
        ExceededLimit::Unloaded => Code::BearingUnloaded,
        ExceededLimit::FittedLaw { .. } => Code::FittedLaw,
        ExceededLimit::StaticLoad { .. } => Code::StaticLoad,
        ExceededLimit::Shoulder { .. } => Code::Shoulder,
        ExceededLimit::Film { .. } => Code::Film,
        ExceededLimit::LostContactAngle { .. } => Code::ContactAngleLost,
        ExceededLimit::OpenSide { .. } => Code::OpenSide,
        ExceededLimit::MinimumLoad { .. } => Code::MinimumLoad,
        ExceededLimit::GyroscopicSliding { .. } => Code::GyroscopicSliding,
        ExceededLimit::LooseRing { .. } => Code::LooseRing,
    }
}

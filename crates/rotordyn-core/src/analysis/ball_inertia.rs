//! Whether the inertia of a bearing's balls matters: centrifugal force over the largest contact load in the machine.

use super::equilibrium::{CageTreatment, equilibrium};
use crate::assembly::Assembly;
use crate::document::{Document, TO_RPM};
use crate::model::Model;
use crate::warning::{Code, Warning};
use rotordyn_bearing::ball_inertia::INERTIA_LIMIT;
use rotordyn_bearing::{BallBearing, BallInertia, BearingElement, DefectLaw, InertiaDecision};
use serde::{Deserialize, Serialize};

/// Ball inertia used for one bearing in a study, and why.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct InertiaUse {
    pub bearing: String,
    /// As stated in the model, or `Auto` with its decision.
    pub inertia: BallInertia,
    /// F_c and largest contact load of massless balls at the highest speed of the study.
    pub compared: InertiaDecision,
    /// Property of the bearing that excludes ball inertia.
    pub excluded_by: Option<String>,
}

impl InertiaUse {
    /// One bearing, from the largest contact load \[N\] of its massless balls at a speed \[rad/s\].
    pub fn new(name: &str, ball: &BallBearing, speed: f64, contact_load: f64) -> Self {
        let centrifugal = ball.centrifugal_force(speed);
        let excluded_by = match &ball.imperfections.law {
            _ if !ball.contact.has_separate_contacts() => Some("the fitted power law"),
            DefectLaw::Force { .. } => Some("the force law of its defects"),
            DefectLaw::Displacement | DefectLaw::UndampedDisplacement => None,
        };
        let on = excluded_by.is_none() && centrifugal > INERTIA_LIMIT * contact_load;
        let compared = InertiaDecision { on, speed: speed.abs(), centrifugal, contact_load };
        let inertia = match ball.inertia {
            BallInertia::Auto(decided) => BallInertia::Auto(Some(decided.unwrap_or(compared))),
            stated => stated,
        };
        Self { bearing: name.into(), inertia, compared, excluded_by: excluded_by.map(str::to_string) }
    }

    /// What is written to files, without the bearing's name.
    pub fn document(&self) -> Document<'_> {
        let compared = &self.compared;
        Document::new()
            .text("stated", self.inertia.keyword())
            .text("used", self.inertia.in_effect().keyword())
            .quantity("speed", "rad/s", compared.speed)
            .quantity("centrifugal_force", "N", compared.centrifugal)
            .quantity("largest_contact_load", "N", compared.contact_load)
            .number("ratio", "1", compared.ratio())
            .number("limit", "1", INERTIA_LIMIT)
    }

    /// What was used and why, in two lines.
    pub fn sentence(&self) -> String {
        let by = if matches!(self.inertia, BallInertia::Auto(_)) { "auto" } else { "as stated" };
        let used = match self.inertia.in_effect() {
            BallInertia::None => "massless".to_string(),
            BallInertia::CentrifugalForce(force) => format!("centrifugal force of {force} N"),
            control => control.keyword().to_string(),
        };
        format!("balls of bearing {}: {used} ({by}),\n    {}", self.bearing, self.comparison())
    }

    fn comparison(&self) -> String {
        let InertiaDecision { speed, centrifugal, contact_load, .. } = self.compared;
        let rpm = speed * TO_RPM;
        match (centrifugal > 0.0, contact_load > 0.0) {
            (false, _) => "no centrifugal force at standstill".into(),
            (true, false) => format!("centrifugal force {centrifugal:.3} N at {rpm:.0} rpm, no contact load"),
            (true, true) => format!(
                "centrifugal force {centrifugal:.3} N at {rpm:.0} rpm is {:.2} % of the largest contact load {contact_load:.1} N \
                 (limit {} %)",
                100.0 * self.compared.ratio(),
                100.0 * INERTIA_LIMIT
            ),
        }
    }

    /// Warning of massless balls whose inertia matters.
    pub fn warning(&self) -> Option<Warning> {
        let matters = self.compared.ratio() > INERTIA_LIMIT;
        if !matters || self.inertia.is_on() {
            return None;
        }
        let why = match &self.excluded_by {
            Some(excluded_by) => format!("{excluded_by} excludes ball inertia"),
            None => "ball_inertia = \"auto\" includes it".to_string(),
        };
        let text = format!("bearing {}: its balls are massless, but {}", self.bearing, self.comparison());
        Some(Warning::new(Code::BallInertia, format!("bearing.{}", self.bearing), text).advise(why))
    }
}

/// Ball inertia of every bearing with contact angles, at the highest speed \[rad/s\] of a study.
///
/// The contact loads are those of massless balls in static equilibrium of the machine at that speed, the largest over
/// the cage angles; without equilibrium or contact there is no load, and ball inertia counts. `start`: an
/// equilibrium to start from.
pub fn ball_inertia(
    model: &Model,
    assembly: &Assembly,
    speed: f64,
    start: Option<&[f64]>,
) -> Vec<InertiaUse> {
    let mut massless = model.clone();
    let mut any = false;
    for site in &mut massless.bearings {
        if let Some(ball) = site.bearing.static_balls_mut() {
            ball.inertia = BallInertia::None;
            any = true;
        }
    }
    let found =
        any.then(|| equilibrium(&massless, assembly, speed, CageTreatment::FixedAngle, start).ok()).flatten();
    let used = |(k, site): (usize, &crate::model::BearingSite)| {
        let ball = site.bearing.static_balls()?;
        let load = found.as_ref().map_or(0.0, |found| found.bearings[k].largest_ball_load);
        Some(InertiaUse::new(&site.name, ball, speed, load))
    };
    model.bearings.iter().enumerate().filter_map(used).collect()
}

/// Whether a bearing of the model has automatic ball inertia that is not yet decided.
pub fn is_undecided(model: &Model) -> bool {
    let balls = model.bearings.iter().filter_map(|site| site.bearing.static_balls());
    balls.map(|ball| ball.inertia).any(|inertia| inertia == BallInertia::Auto(None))
}

/// The model with the decisions of [`ball_inertia`].
pub fn with_decisions(model: &Model, used: &[InertiaUse]) -> Model {
    let mut out = model.clone();
    for site in &mut out.bearings {
        if let Some(ball) = site.bearing.static_balls_mut()
            && let Some(found) = used.iter().find(|found| found.bearing == site.name)
        {
            ball.inertia = found.inertia;
        }
    }
    out
}

/// Models of one sweep with the same decision: ball inertia is on in all where one of them needs it.
pub fn decided_together(models: &[Model], speeds: &[f64]) -> Vec<Model> {
    if !models.iter().any(is_undecided) {
        return models.to_vec();
    }
    let each: Vec<Vec<InertiaUse>> = models
        .iter()
        .zip(speeds)
        .map(|(model, speed)| {
            Assembly::new(model).map_or(Vec::new(), |assembly| ball_inertia(model, &assembly, *speed, None))
        })
        .collect();
    let mut together: Vec<InertiaUse> = Vec::new();
    for found in each.into_iter().flatten() {
        match together.iter_mut().find(|known| known.bearing == found.bearing) {
            Some(known) if known.compared.ratio() < found.compared.ratio() => *known = found,
            Some(_) => {}
            None => together.push(found),
        }
    }
    models.iter().map(|model| with_decisions(model, &together)).collect()
}

/// Largest contact load of a single bearing at a displacement, over the cage angles \[N\].
pub fn largest_contact_load(element: &dyn BearingElement, d: &[f64; 6], speed: f64) -> f64 {
    let rotation = rotordyn_bearing::Rotation { shaft_speed: speed, ..Default::default() };
    super::equilibrium::largest_ball_load(element, d, &rotation)
}

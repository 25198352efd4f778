//! Every limit of a ball bearing beside its figure, exceeded or not: what a designer looks up.

use super::limits::{BearingLoad, LOST_ANGLE, LOWEST_FILM_RATIO, TRACTION, race_name};
use super::load_rating::STATIC_CONTACT_STRESS;
use crate::BallBearing;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Speed parameter n d_m up to which grease lasts in deep groove ball bearings \[mm/min\]; a guide of makers' catalogues,
/// n in rpm, d_m the pitch diameter in mm.
pub const GREASE_SPEED_PARAMETER: f64 = 5e5;
/// Speed parameters beyond which no deep groove and no angular contact ball bearing is built \[mm/min\], with oil, ceramic
/// balls and light series.
const SPEED_LIMITS: [f64; 2] = [1.5e6, 2.5e6];

/// Speed parameter n d_m of a bearing at a speed \[rad/s\], in mm/min.
pub fn speed_parameter(bearing: &BallBearing, speed: f64) -> f64 {
    1e3 * bearing.geometry.pitch_diameter * speed.abs() * 30.0 / PI
}

/// The largest speed parameter of a bearing's kind \[mm/min\].
pub fn speed_limit(bearing: &BallBearing) -> f64 {
    SPEED_LIMITS[usize::from(bearing.geometry.contact_angle > 0.0)]
}

/// What a figure says beside its limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum LimitState {
    Within,
    /// An assumption of the model fails, or the bearing is misused: there is a warning.
    Exceeded,
    /// Beyond a guide of makers; no warning.
    BeyondGuide,
}

impl LimitState {
    pub fn name(self) -> &'static str {
        match self {
            Self::Within => "within",
            Self::Exceeded => "exceeded",
            Self::BeyondGuide => "beyond the guide",
        }
    }
}

/// A figure and its limit, both in the same unit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LimitCheck {
    pub quantity: String,
    pub value: f64,
    /// Least or greatest value, as `is_least` says.
    pub limit: f64,
    pub is_least: bool,
    pub unit: String,
    pub state: LimitState,
    /// What the limit says.
    pub says: String,
}

/// Sides of a limit.
const LEAST: bool = true;
const GREATEST: bool = false;

fn check(quantity: &str, [value, limit]: [f64; 2], is_least: bool, unit: &str, says: &str) -> LimitCheck {
    let holds = if is_least { value >= limit } else { value <= limit };
    LimitCheck {
        quantity: quantity.into(),
        value,
        limit,
        is_least,
        unit: unit.into(),
        state: if holds { LimitState::Within } else { LimitState::Exceeded },
        says: says.into(),
    }
}

impl BearingLoad<'_> {
    /// The limits that apply to the bearing, each with its figure; where one is exceeded,
    /// [`exceeded_limits`](Self::exceeded_limits) has it too.
    pub fn limit_checks(&self) -> Vec<LimitCheck> {
        let g = &self.bearing.geometry;
        let loaded = self.loads().count();
        let mut speed = check(
            "speed parameter n d_m",
            [speed_parameter(self.bearing, self.speed), speed_limit(self.bearing)],
            GREATEST,
            "mm/min",
            "what bearings of this kind are built for at most; grease in deep groove ball bearings lasts up to 500000",
        );
        if speed.state == LimitState::Exceeded {
            speed.state = LimitState::BeyondGuide;
        }
        let balls = check(
            "loaded balls",
            [loaded as f64, 1.0],
            LEAST,
            "1",
            "without a loaded ball the bearing has no stiffness",
        );
        if loaded == 0 {
            return vec![balls, speed];
        }
        let safety = self.static_rating / self.static_load;
        let static_safety = check(
            "static safety s_0 = C_0/P_0",
            [safety, 1.0],
            LEAST,
            "1",
            "below 1 races and balls keep dents (ISO 76)",
        );
        let pressure = self.largest_pressure().map(|(race, pressure)| {
            check(
                &format!("contact pressure, {} race", race_name(race)),
                [pressure, STATIC_CONTACT_STRESS],
                GREATEST,
                "Pa",
                "above it the most loaded contact keeps a dent of 1e-4 of the ball diameter (ISO 76)",
            )
        });
        let nearest = self.shoulders().min_by(|(_, a), (_, b)| a.arc.total_cmp(&b.arc));
        let shoulder = nearest.map(|(race, margin)| {
            check(
                &format!("contact ellipse to shoulder, {} race", race_name(race)),
                [margin.arc, 0.0],
                LEAST,
                "m",
                "below 0 the shoulder cuts the ellipse: load and pressure there are invalid",
            )
        });
        let film = self.film.filter(|_| self.speed != 0.0).map(|[film, roughness]| {
            check(
                "film ratio lambda",
                [film / roughness, LOWEST_FILM_RATIO],
                LEAST,
                "1",
                "below 1 asperities touch; above 3 the film separates the surfaces",
            )
        });
        let minimum = self.needed_load().map(|minimum| {
            check(
                "equivalent load against the minimum load",
                [self.equivalent_load, minimum],
                LEAST,
                "N",
                "below it balls and cage may skid, as some balls carry no load",
            )
        });
        let sliding = self.gyroscopic_coefficient().map(|coefficient| {
            check(
                "friction coefficient against gyroscopic sliding",
                [coefficient, TRACTION],
                GREATEST,
                "1",
                "above it the gyroscopic moment turns the balls about the line of contact",
            )
        });
        let fit = self.bearing.interference_left(self.speed).map(|left| {
            check(
                "interference of inner ring and shaft at speed",
                [left, 0.0],
                LEAST,
                "m",
                "below 0 rotation has loosened the ring, which creeps",
            )
        });
        let angle = self.mean_contact_angle().map(|mean| {
            check(
                "mean contact angle by load",
                [mean, LOST_ANGLE * g.contact_angle],
                LEAST,
                "rad",
                "below half the nominal angle the row has slid axially: it needs thrust or preload",
            )
        });
        let open_side = self.balls_on_open_side().map(|balls| {
            check(
                "balls on the open side of the outer race",
                [balls as f64, 0.0],
                GREATEST,
                "1",
                "that side has no shoulder",
            )
        });
        let fitted = self.outside_fitted_law().map(|(outside, _)| {
            check(
                "balls outside the range of the fitted contact law",
                [outside as f64, 0.0],
                GREATEST,
                "1",
                "there the law is extrapolated",
            )
        });
        let has_static_load = safety.is_finite().then_some(static_safety);
        let found = [
            Some(balls),
            has_static_load,
            pressure,
            shoulder,
            film,
            minimum,
            Some(speed),
            sliding,
            fit,
            angle,
            open_side,
            fitted,
        ];
        // A figure that a standard does not define has no limit.
        found.into_iter().flatten().filter(|check| !check.value.is_nan()).collect()
    }
}

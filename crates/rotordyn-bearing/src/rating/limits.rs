//! Limits of a ball bearing under its load: where an assumption of the model fails, or the bearing is misused.

use super::life::reference_viscosity;
use super::load_rating::STATIC_CONTACT_STRESS;
use super::shoulder::{ShoulderMargin, shoulder_margin};
use crate::contact::{ContactLaw, Race};
use crate::{BallBearing, BallInertia, BallLoad};
use std::f64::consts::PI;
use std::fmt::{self, Display, Formatter};

/// Film ratio λ below which asperities touch.
pub(super) const LOWEST_FILM_RATIO: f64 = 1.0;
/// Share of the nominal contact angle below which a single row has lost it.
pub(super) const LOST_ANGLE: f64 = 0.5;
/// Radial minimum load factor k_r of deep groove ball bearings; makers give 0.015 (series 618) to 0.03 (series 63).
const RADIAL_FACTOR: f64 = 0.025;
/// Traction coefficient of an oil-lubricated contact.
pub(super) const TRACTION: f64 = 0.07;

/// Share of the largest contact load below which the ellipse of a contact does not count: balls outside the loaded zone
/// that centrifugal force presses against the inner race at a steep angle.
const SMALL_LOAD: f64 = 0.02;

/// State of a bearing for its limits.
#[derive(Clone, Debug)]
pub struct BearingLoad<'a> {
    pub bearing: &'a BallBearing,
    pub balls: &'a [BallLoad],
    /// Shaft speed Ω and cage speed ω_c \[rad/s\].
    pub speed: f64,
    pub cage_speed: f64,
    /// Axial displacement of the inner ring \[m\].
    pub axial_displacement: f64,
    /// Dynamic equivalent load of the balls' loads \[N\] (ISO/TS 16281).
    pub equivalent_load: f64,
    /// Static equivalent load P₀ \[N\]; NaN where ISO 76 defines none. Static load rating C₀ \[N\].
    pub static_load: f64,
    pub static_rating: f64,
    /// Smallest film of a loaded contact and composite roughness \[m\]; `None` without lubricant.
    pub film: Option<[f64; 2]>,
}

/// A limit that a bearing exceeds, with its figures in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ExceededLimit {
    /// No ball carries load at the inner race: the bearing has no stiffness.
    Unloaded,
    /// Ball loads outside the range of a fitted contact law \[N\].
    FittedLaw { outside: usize, loaded: usize, range: [f64; 2] },
    /// Largest contact pressure above that of the static load rating \[Pa\], or P₀ above C₀ \[N\]: permanent dents.
    StaticLoad { pressure: f64, race: Race, load: f64, rating: f64 },
    /// Share of a contact ellipse beyond the shoulder of its groove, angles of the edges of both \[rad\].
    Shoulder { race: Race, share: f64, ellipse_angle: f64, shoulder_angle: f64 },
    /// Smallest film below the roughness \[m\].
    Film { film: f64, roughness: f64 },
    /// A single row with a contact angle slides until its balls carry at a much smaller one \[rad, m\].
    LostContactAngle { nominal: f64, mean: f64, displacement: f64 },
    /// Balls pressed onto the open side of the outer race.
    OpenSide { balls: usize },
    /// Equivalent load below the minimum load of a bearing with unloaded balls \[N\]: balls and cage may skid.
    MinimumLoad { load: f64, minimum: f64 },
    /// Friction coefficient that the gyroscopic moment needs above the traction of the contact: the balls slide.
    GyroscopicSliding { coefficient: f64 },
    /// Diametral play that rotation gives an inner ring fitted with interference \[m\].
    LooseRing { interference: f64, play: f64 },
}

impl BearingLoad<'_> {
    /// The limits exceeded.
    pub fn exceeded_limits(&self) -> Vec<ExceededLimit> {
        let carries = |ball: &&BallLoad| ball.load > 0.0;
        let loaded = self.balls.iter().filter(carries).count();
        if loaded == 0 {
            return vec![ExceededLimit::Unloaded];
        }
        [
            self.fitted_law(loaded),
            self.static_load(),
            self.shoulder(),
            self.film(),
            self.lost_contact_angle(),
            self.open_side(),
            self.minimum_load(),
            self.gyroscopic_sliding(),
            self.loose_ring(),
        ]
        .into_iter()
        .flatten()
        .collect()
    }

    pub(super) fn loads(&self) -> impl Iterator<Item = f64> {
        self.balls.iter().map(|ball| ball.load).filter(|load| *load > 0.0)
    }

    /// Number of loaded balls outside the range of a fitted law, and that range \[N\].
    pub(super) fn outside_fitted_law(&self) -> Option<(usize, [f64; 2])> {
        let ContactLaw::PowerLaw(law) = &self.bearing.contact else { return None };
        let range = law.range;
        Some((self.loads().filter(|load| *load < range[0] || *load > range[1]).count(), range))
    }

    fn fitted_law(&self, loaded: usize) -> Option<ExceededLimit> {
        let (outside, range) = self.outside_fitted_law()?;
        (outside > 0).then_some(ExceededLimit::FittedLaw { outside, loaded, range })
    }

    /// Race and value of the largest contact pressure \[Pa\].
    pub(super) fn largest_pressure(&self) -> Option<(Race, f64)> {
        let contacts = self.bearing.hertz();
        let pressures = self.balls.iter().flat_map(|ball| {
            [Race::Inner, Race::Outer].into_iter().zip(ball.patches(&contacts).map(|p| p.maximum_pressure))
        });
        pressures.max_by(|(_, a), (_, b)| a.total_cmp(b))
    }

    /// p₀ > 4.2 GPa in a contact, or s₀ = C₀/P₀ < 1: the balls' own loads and the rating of the bearing differ where its
    /// load distribution, grooves or stated C₀ differ from those of ISO 76.
    fn static_load(&self) -> Option<ExceededLimit> {
        let (race, pressure) = self.largest_pressure()?;
        let (load, rating) = (self.static_load, self.static_rating);
        (pressure > STATIC_CONTACT_STRESS || load > rating).then_some(ExceededLimit::StaticLoad {
            pressure,
            race,
            load,
            rating,
        })
    }

    fn film(&self) -> Option<ExceededLimit> {
        let [film, roughness] = self.film.filter(|_| self.speed != 0.0)?;
        (film < LOWEST_FILM_RATIO * roughness).then_some(ExceededLimit::Film { film, roughness })
    }

    /// Whether it has a contact angle and takes thrust one way: a single row, or a tandem pair. Each outer race has one shoulder.
    fn is_angled(&self) -> bool {
        self.bearing.geometry.contact_angle > 0.0 && self.bearing.takes_thrust_one_way()
    }

    /// Mean inner contact angle by load of a single row or tandem pair with a contact angle \[rad\].
    pub(super) fn mean_contact_angle(&self) -> Option<f64> {
        let balls = self.balls.iter().filter(|ball| ball.load > 0.0);
        let mean = || {
            balls.map(|ball| ball.load * ball.contact_angle.abs()).sum::<f64>() / self.loads().sum::<f64>()
        };
        self.is_angled().then(mean)
    }

    /// Mean inner contact angle by load below half the nominal one.
    fn lost_contact_angle(&self) -> Option<ExceededLimit> {
        let (nominal, mean) = (self.bearing.geometry.contact_angle, self.mean_contact_angle()?);
        let displacement = self.axial_displacement;
        (mean < LOST_ANGLE * nominal).then_some(ExceededLimit::LostContactAngle {
            nominal,
            mean,
            displacement,
        })
    }

    /// Number of balls pressed onto the open side of a single row or tandem pair with a contact angle.
    pub(super) fn balls_on_open_side(&self) -> Option<usize> {
        let thrust = self.bearing.geometry.thrust_direction;
        let on_open_side =
            |ball: &&BallLoad| ball.outer_load > 0.0 && ball.outer_contact_angle * thrust < 0.0;
        self.is_angled().then(|| self.balls.iter().filter(on_open_side).count())
    }

    fn open_side(&self) -> Option<ExceededLimit> {
        let balls = self.balls_on_open_side()?;
        (balls > 0).then_some(ExceededLimit::OpenSide { balls })
    }

    /// Minimum load of a turning bearing with unloaded balls \[N\].
    pub(super) fn needed_load(&self) -> Option<f64> {
        // With all balls loaded none slows down outside a loaded zone; gyroscopic sliding remains.
        if self.speed == 0.0 || self.balls.iter().all(|ball| ball.load > 0.0) {
            return None;
        }
        let viscosity = self.bearing.lubricant().map(|oil| oil.viscosity / oil.density);
        Some(minimum_load(self.bearing.geometry.pitch_diameter, self.speed, viscosity))
    }

    fn minimum_load(&self) -> Option<ExceededLimit> {
        let (load, minimum) = (self.equivalent_load, self.needed_load()?);
        (load < minimum).then_some(ExceededLimit::MinimumLoad { load, minimum })
    }

    /// μ = Σ 2 M/D / Σ Q over the balls that carry at the inner race: a lightly loaded ball at the end of the loaded zone may
    /// slide for a moment.
    ///
    /// M/D = F_c sin α_o/5 on a ball that rolls on the outer race, which resists it; F_c sin α_i/5 (Ω − ω_c)/ω_c where the inner
    /// race is stated to control, which resists all of it, or after Harris each race half.
    pub(super) fn gyroscopic_coefficient(&self) -> Option<f64> {
        let g = &self.bearing.geometry;
        if !self.bearing.inertia.has_moment() {
            return None;
        }
        let mass = self.bearing.ball_material.density * PI / 6.0 * g.ball_diameter.powi(3);
        let centrifugal = 0.5 * mass * g.pitch_diameter * self.cage_speed.powi(2);
        let carrying = || self.balls.iter().filter(|ball| ball.load > 0.0);
        let friction = |angle: fn(&BallLoad) -> f64| -> f64 {
            carrying().map(|ball| 0.4 * centrifugal * angle(ball).sin().abs()).sum()
        };
        let [inner, outer] = [
            carrying().map(|ball| ball.load).sum::<f64>(),
            carrying().map(|ball| ball.outer_load).sum::<f64>(),
        ];
        let on_outer = friction(|ball| ball.outer_contact_angle);
        let on_inner = friction(|ball| ball.contact_angle) * (self.speed / self.cage_speed - 1.0).abs();
        Some(match self.bearing.inertia.in_effect() {
            _ if self.cage_speed == 0.0 => 0.0,
            BallInertia::InnerRaceControl => on_inner / inner,
            BallInertia::HarrisInnerRaceControl => 0.5 * on_inner / inner.min(outer),
            _ => on_outer / outer,
        })
    }

    fn gyroscopic_sliding(&self) -> Option<ExceededLimit> {
        let coefficient = self.gyroscopic_coefficient()?;
        (coefficient > TRACTION).then_some(ExceededLimit::GyroscopicSliding { coefficient })
    }

    /// Play between shaft and inner ring that rotation makes of an interference.
    fn loose_ring(&self) -> Option<ExceededLimit> {
        let left = self.bearing.interference_left(self.speed).filter(|left| *left < 0.0)?;
        Some(ExceededLimit::LooseRing { interference: self.bearing.fit.shaft_interference, play: -left })
    }

    /// Contacts with load, with their distance from the shoulder of the groove.
    pub(super) fn shoulders(&self) -> impl Iterator<Item = (Race, ShoulderMargin)> {
        let largest = self.balls.iter().fold(0.0, |most: f64, ball| most.max(ball.load).max(ball.outer_load));
        let contacts = self.balls.iter().flat_map(move |ball| {
            let margins = shoulder_margin(self.bearing, ball);
            let loads = [ball.load, ball.outer_load];
            [Race::Inner, Race::Outer]
                .into_iter()
                .zip(margins)
                .zip(loads)
                .filter(move |(_, load)| *load > SMALL_LOAD * largest)
        });
        contacts.map(|(contact, _)| contact)
    }

    /// The contact with the largest share of its ellipse beyond the shoulder of the groove.
    fn shoulder(&self) -> Option<ExceededLimit> {
        let worst =
            self.shoulders().max_by(|(_, a), (_, b)| a.fraction_beyond.total_cmp(&b.fraction_beyond))?;
        let (race, ShoulderMargin { ellipse_angle, shoulder_angle, fraction_beyond: share, .. }) = worst;
        (share > 0.0).then_some(ExceededLimit::Shoulder { race, share, ellipse_angle, shoulder_angle })
    }
}

/// Minimum load against skidding of a ball bearing, F = k_r (ν n/1000)^{2/3} (D_pw/100)² kN with k_r = 0.025, ν in mm²/s,
/// n in rpm, D_pw in mm \[N\].
///
/// `pitch_diameter` D_pw \[m\], `speed` Ω \[rad/s\], `viscosity` ν \[m²/s\]; `None`: the reference viscosity ν₁ of ISO 281.
/// Source: makers' catalogues of deep groove ball bearings (SKF, requisite minimum load).
pub fn minimum_load(pitch_diameter: f64, speed: f64, viscosity: Option<f64>) -> f64 {
    let viscosity = viscosity.unwrap_or_else(|| reference_viscosity(pitch_diameter, speed));
    let rpm = speed.abs() * 30.0 / PI;
    1e3 * RADIAL_FACTOR * (1e6 * viscosity * rpm / 1e3).powf(2.0 / 3.0) * (10.0 * pitch_diameter).powi(2)
}

pub(super) fn race_name(race: Race) -> &'static str {
    match race {
        Race::Inner => "inner",
        Race::Outer => "outer",
    }
}

impl Display for ExceededLimit {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Unloaded => write!(
                f,
                "no ball carries load, and the bearing has no stiffness; preload it, or reduce its clearance"
            ),
            Self::FittedLaw { outside, loaded, range: [low, high] } => write!(
                f,
                "{outside} of {loaded} loaded balls are outside the range {low} to {high} N of their fitted power \
                 law; fit it to the loads that occur, or use contact = \"hertz\""
            ),
            Self::StaticLoad { pressure, race, load, rating } => {
                let contact = format!("{:.2} GPa at the {} race", 1e-9 * pressure, race_name(race));
                let loads = format!("C_0 {rating:.0} N, P_0 {load:.0} N");
                let safety = format!("static safety s_0 = C_0/P_0 = {:.2}", rating / load);
                match (pressure > STATIC_CONTACT_STRESS, load > rating) {
                    (true, true) => write!(
                        f,
                        "contact pressure {contact} above the 4.2 GPa of the static load rating, and {safety} below 1 \
                         ({loads}; ISO 76): the races are dented, and the elastic contact is invalid"
                    ),
                    (true, false) if load.is_finite() => write!(
                        f,
                        "contact pressure {contact} above the 4.2 GPa of the static load rating (ISO 76): the races \
                         are dented, and the elastic contact is invalid; {safety} ({loads}) does not show it"
                    ),
                    (true, false) => write!(
                        f,
                        "contact pressure {contact} above the 4.2 GPa of the static load rating (ISO 76): the races \
                         are dented, and the elastic contact is invalid"
                    ),
                    (false, _) => write!(
                        f,
                        "{safety} below 1 ({loads}; ISO 76), with a contact pressure of {contact}: permanent \
                         deformation of balls and races"
                    ),
                }
            }
            Self::Shoulder { race, share, ellipse_angle, shoulder_angle } => write!(
                f,
                "{:.0} % of a contact ellipse of the {} race lies beyond the shoulder of the groove: it reaches to \
                 {:.1} deg, the shoulder is at {:.1} deg (inner_ and outer_shoulder_diameter); loads and pressures there are invalid",
                100.0 * share,
                race_name(race),
                ellipse_angle.to_degrees(),
                shoulder_angle.to_degrees()
            ),
            Self::Film { film, roughness } => write!(
                f,
                "film ratio {:.2}, below 1: the film of {:.3} um is thinner than the roughness of {:.2} um, and \
                 asperities touch",
                film / roughness,
                1e6 * film,
                1e6 * roughness
            ),
            Self::LostContactAngle { nominal, mean, displacement } => write!(
                f,
                "the inner ring slides {:.0} um axially, and the balls carry at {:.1} deg instead of {:.0} deg: a \
                 bearing that takes thrust one way needs an axial load or preload",
                1e6 * displacement.abs(),
                mean.to_degrees(),
                nominal.to_degrees()
            ),
            Self::OpenSide { balls } => {
                write!(
                    f,
                    "the load presses {balls} balls onto the open side of the outer race, which has no shoulder"
                )
            }
            Self::MinimumLoad { load, minimum } => write!(
                f,
                "the equivalent load of {load:.1} N is below the minimum load of {minimum:.1} N at this speed \
                 (0.025 (nu n/1000)^(2/3) (d_m/100)^2 kN): balls and cage may skid; preload the bearing"
            ),
            Self::GyroscopicSliding { coefficient } => write!(
                f,
                "the gyroscopic moment of the balls needs a friction coefficient of {coefficient:.3}, above {TRACTION}: \
                 the balls slide, and the control hypothesis of ball_inertia is invalid; preload the bearing"
            ),
            Self::LooseRing { interference, play } => write!(
                f,
                "rotation widens the bore of the inner ring by more than the {:.1} um of its interference on the shaft: \
                 {:.1} um of play, in which the ring moves and creeps; raise shaft_interference",
                1e6 * interference,
                1e6 * play
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 6205-size at 3000 rpm and 20 mm²/s: (20·3)^{2/3} (39/100)² · 0.025 kN.
    #[test]
    fn minimum_load_in_catalogue_units() {
        let speed = 3000.0 * PI / 30.0;
        let expected = 1e3 * 0.025 * 60f64.powf(2.0 / 3.0) * 0.39f64.powi(2);
        assert!((minimum_load(0.039, speed, Some(20e-6)) / expected - 1.0).abs() < 1e-12);
        assert!(expected > 50.0 && expected < 70.0);
        // ν₁ ∝ n^{−1/2}: without a stated viscosity F ∝ n^{1/3}.
        let ratio = minimum_load(0.039, 8.0 * speed, None) / minimum_load(0.039, speed, None);
        assert!((ratio - 2.0).abs() < 1e-12, "{ratio}");
    }
}

//! Input data of a bearing whose balls and cage are free bodies.

use super::friction::FrictionLaw;
use crate::contact::{ContactLaw, EllipticContact, Race, Traction};
use crate::material::Material;
use crate::{BallBearing, Defect, DefectLaw, Preload, Surface};
use std::f64::consts::PI;

/// Ball bearing with every ball and the cage as a rigid body.
#[derive(Clone, Debug, PartialEq)]
pub struct FreeBallBearing {
    /// Geometry, materials, stiffness of the contacts, fit, rigid preload, surfaces of the races and ball sizes.
    pub ball: BallBearing,
    /// Friction between balls and races.
    pub friction: FrictionLaw,
    /// Where slip is evaluated in a race contact.
    pub slip: SlipModel,
    /// Contact damping of balls and races: χ in Q = K δ^{3/2} (1 + χ δ̇) \[s/m\] (Hunt & Crossley 1975).
    pub damping: f64,
    /// Hysteresis loss factor \[-\] of rolling resistance, M = (3/16) · factor · Q b.
    pub rolling_loss: f64,
    /// `None`: a full complement of balls, which touch each other.
    pub cage: Option<FreeCage>,
    /// Friction of balls that touch each other.
    pub ball_friction: Traction,
    pub drag: Drag,
    /// Gravity \[m/s²\].
    pub gravity: [f64; 3],
}

impl FreeBallBearing {
    /// Validation errors, one sentence each: combinations and values that are not supported; empty if valid.
    pub fn problems(&self) -> Vec<String> {
        let mut out = Vec::new();
        let mut refuse = |wrong: bool, why: &str| {
            if wrong {
                out.push(why.to_string());
            }
        };
        let (ball, g) = (&self.ball, &self.ball.geometry);
        refuse(ball.duplex.is_some(), "free balls are for a single row");
        refuse(
            matches!(ball.preload, Preload::Spring { .. }),
            "free balls have rings of given motion, so no preload by a spring",
        );
        refuse(
            !matches!(ball.contact, ContactLaw::Hertz),
            "free balls have Hertzian contacts; the film acts in their friction law",
        );
        let on_ball = |defect: &Defect| matches!(defect.surface, Surface::Ball(_));
        refuse(
            !ball.imperfections.ball_waviness.is_empty() || ball.imperfections.defects.iter().any(on_ball),
            "free balls take waviness and defects of the races and off-size balls, not the surfaces of balls",
        );
        refuse(
            ball.imperfections.law != DefectLaw::Displacement && !ball.imperfections.defects.is_empty(),
            "defects act on free balls by displacement",
        );
        refuse(
            ball.imperfections.ball_numbers().any(|number| number >= g.balls),
            "a size is on a ball number that does not exist (balls count from 0)",
        );
        refuse(
            ball.fit.speed_growth,
            "free balls keep the clearance they have at standstill: no growth of the rings with speed",
        );
        refuse(g.balls == 0, "a bearing needs a ball");
        refuse(self.slip.is_empty(), "the contact ellipse needs at least one point in each direction");
        let law = match &self.friction {
            FrictionLaw::Coulomb(law) => law.friction >= 0.0 && law.slip_speed > 0.0,
            FrictionLaw::Curve(law) => law.limit > 0.0 && law.slope >= 0.0 && law.decay > 0.0,
            FrictionLaw::Film(law) => law.limit > 0.0 && law.slip_speed > 0.0 && law.eyring_stress > 0.0,
        };
        refuse(!law, "a coefficient or a slip speed of the friction law is not positive");
        let Drag { density, ball_force, ball_moment, cage_moment } = self.drag;
        let resistances = [self.damping, self.rolling_loss, density, ball_force, ball_moment, cage_moment];
        refuse(
            !resistances.iter().all(|value| *value >= 0.0),
            "a damping, a loss factor or a drag is negative",
        );
        refuse(
            self.cage.is_none() && !regularised(&self.ball_friction),
            "friction of balls that touch each other: coefficient negative or slip speed not positive",
        );
        let larger = ball.imperfections.off_size.iter().map(|size| size.diameter_difference);
        let largest = g.ball_diameter + larger.fold(0.0, f64::max);
        if let Some(cage) = &self.cage {
            let larger = cage.pocket_diameter > largest;
            refuse(!larger, "a cage pocket is not larger than the ball");
            let spacing = g.pitch_diameter * (PI / g.balls.max(1) as f64).sin();
            refuse(g.balls > 1 && cage.pocket_diameter >= spacing, "neighbouring cage pockets overlap");
            let inertia = [cage.mass, cage.polar_inertia, cage.transverse_inertia];
            refuse(!inertia.into_iter().all(positive), "mass or inertia of the cage is not positive");
            refuse(
                !cage.pocket_contact.is_valid(),
                "contact of the cage pockets: stiffness or slip speed not positive, or damping or friction negative",
            );
            refuse(
                matches!(cage.pocket, Pocket::Closed { radial_clearance } if !positive(radial_clearance)),
                "a closed pocket has no radial clearance",
            );
            if let Guidance::Land(land) = &cage.guidance {
                refuse(
                    !positive(land.clearance),
                    "the cage touches its guiding ring at rest: its clearance is not positive",
                );
                let sizes = positive(land.radius) && positive(land.width);
                refuse(!sizes, "radius or width of the cage's land is not positive");
                refuse(
                    !land.contact.is_valid(),
                    "contact of the cage's land: stiffness or slip speed not positive, or damping or friction negative",
                );
            }
        }
        out
    }
}

/// Positive and finite; false for NaN.
fn positive(value: f64) -> bool {
    value > 0.0 && value.is_finite()
}

/// Regularised Coulomb friction with μ ≥ 0 and v₀ > 0; v₀ = 0 would give 0/0 at rest.
fn regularised(law: &Traction) -> bool {
    law.friction >= 0.0 && law.friction.is_finite() && positive(law.slip_speed)
}

/// Where slip is evaluated in the contact of a ball and a race.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SlipModel {
    /// At the centre of the contact: no moment by spin, no slip by conformity.
    Centre,
    /// Over the contact ellipse, with this many points along and across the direction of rolling.
    Ellipse { along: usize, across: usize },
}

impl SlipModel {
    fn is_empty(self) -> bool {
        matches!(self, Self::Ellipse { along, across } if along == 0 || across == 0)
    }
}

impl Default for SlipModel {
    fn default() -> Self {
        Self::Ellipse { along: 4, across: 12 }
    }
}

/// Cage as a rigid body with one pocket per ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeCage {
    /// Mass \[kg\].
    pub mass: f64,
    /// Moments of inertia about the cage's axis and about a diameter \[kg m²\].
    pub polar_inertia: f64,
    pub transverse_inertia: f64,
    /// Shape of the pockets.
    pub pocket: Pocket,
    /// Diameter of a pocket \[m\]; its clearance is that over the ball diameter.
    pub pocket_diameter: f64,
    /// Contact of balls and pockets, Q = K δ^{3/2}.
    pub pocket_contact: PointContactLaw,
    pub guidance: Guidance,
}

impl FreeCage {
    /// Mass \[kg\], polar and transverse moment of inertia \[kg m²\] of a plain ring between two radii over a width \[m\].
    ///
    /// m = ρ π (r_2² − r_1²) w, I_p = ½ m (r_1² + r_2²), I_t = ½ I_p + m w²/12; pockets are not subtracted.
    pub fn ring_inertia(density: f64, radii: [f64; 2], width: f64) -> [f64; 3] {
        let [inner, outer] = radii.map(|r| r * r);
        let mass = density * PI * (outer - inner) * width;
        let polar = 0.5 * mass * (inner + outer);
        [mass, polar, 0.5 * polar + mass * width * width / 12.0]
    }
}

/// Shape of a cage pocket; its centre lies on the pitch circle of the cage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pocket {
    /// Cylinder with radial axis: no support of the cage in radial direction.
    Cylindrical,
    /// Sphere.
    Spherical,
    /// Cylinder with radial axis, closed inside and outside at this radial clearance \[m\] to the ball.
    Closed { radial_clearance: f64 },
}

/// Guidance of the cage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Guidance {
    /// By the balls in their pockets.
    Balls,
    /// On a cylindrical land of the inner or the outer ring.
    Land(Land),
}

/// Cylindrical land that guides the cage at its two edges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Land {
    pub race: Race,
    /// Radius of the ring's land \[m\].
    pub radius: f64,
    /// Radial clearance of the centred cage \[m\].
    pub clearance: f64,
    /// Axial distance of the cage's edges \[m\].
    pub width: f64,
    /// Contact of each edge, Q = k δ.
    pub contact: PointContactLaw,
}

/// Contact with slip at one point: cage pockets and lands, balls that touch each other.
///
/// Q = K δⁿ (1 + χ δ̇), never negative, friction regularised Coulomb.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointContactLaw {
    /// K \[N/mⁿ\], n = 3/2 for pockets and balls, 1 for lands.
    pub stiffness: f64,
    /// χ \[s/m\].
    pub damping: f64,
    pub friction: Traction,
}

impl PointContactLaw {
    /// K > 0, χ ≥ 0, μ ≥ 0 and v₀ > 0, all finite.
    fn is_valid(&self) -> bool {
        let damped = self.damping >= 0.0 && self.damping.is_finite();
        positive(self.stiffness) && damped && regularised(&self.friction)
    }
}

/// Resistance of the lubricant around balls and cage, at rest relative to the outer ring.
///
/// Ball: force ½ ρ C_d π r² v² against its velocity, moment ½ ρ C_n r⁵ ω² against its rotation. Cage: moment c ω.
/// Source: Gupta, Advanced Dynamics of Rolling Elements, 1984.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Drag {
    /// Density of the mixture of oil and air ρ \[kg/m³\].
    pub density: f64,
    /// C_d of the moving ball and C_n of the rotating ball \[-\].
    pub ball_force: f64,
    pub ball_moment: f64,
    /// c of the cage \[N m s/rad\].
    pub cage_moment: f64,
}

/// Hertzian stiffness K \[N/m^1.5\] of a ball in a pocket of a material.
///
/// `ball_diameter` and `pocket_diameter` in \[m\].
pub fn pocket_stiffness(
    shape: Pocket,
    ball_diameter: f64,
    pocket_diameter: f64,
    materials: [&Material; 2],
) -> f64 {
    let (ball, pocket) = (2.0 / ball_diameter, 2.0 / pocket_diameter);
    let axial = if shape == Pocket::Spherical { ball - pocket } else { ball };
    EllipticContact::new(axial, ball - pocket, materials).stiffness
}

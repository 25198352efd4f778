//! A ball bearing as its user describes it.

use super::{BallGeometry, DefectLaw, Fit, FitMaterials, Imperfections};
use crate::contact::{ContactDamping, ContactLaw, ContactStiffness, HertzPair, Lubricant};
use crate::element::Material;

/// Ball bearing with one force element per ball and a kinematic cage.
#[derive(Clone, Debug, PartialEq)]
pub struct BallBearing {
    pub geometry: BallGeometry,
    /// Material of balls and of rings.
    pub ball_material: Material,
    pub ring_material: Material,
    /// How a ball's contacts carry load.
    pub contact: ContactLaw,
    /// Stiffness of the dry contacts, where it is given instead of following from curvatures and elasticity.
    pub contact_stiffness: ContactStiffness,
    /// How they dissipate.
    pub damping: ContactDamping,
    pub inertia: BallInertia,
    pub preload: Preload,
    /// Second row that makes a matched pair of this bearing; `None` for a single row.
    pub duplex: Option<Duplex>,
    pub fit: Fit,
    pub cage: Cage,
    /// Cage angle ψ₀ of ball 0 at the start \[rad\], from +x towards +y.
    pub cage_angle: f64,
    pub imperfections: Imperfections,
    /// Cage pocket diameter and cage width \[m\] for the overlap check and pictures.
    pub cage_pocket_diameter: f64,
    pub service: Service,
}

/// What a bearing's rating life is reckoned with beside its loads.
#[derive(Clone, Debug, PartialEq)]
pub struct Service {
    /// Load ratings C and C₀ and fatigue load limit C_u by the maker \[N\]; `None`: by the geometry.
    pub dynamic_rating: Option<f64>,
    pub static_rating: Option<f64>,
    pub fatigue_limit: Option<f64>,
    /// Oil of a bearing whose contact law has none.
    pub lubricant: Option<Lubricant>,
    /// Contamination factor e_C from 0 (very severe) to 1 (extreme cleanliness).
    pub contamination: f64,
    /// Reliability from 0.9 to 0.999.
    pub reliability: f64,
}

impl Default for Service {
    /// Normal cleanliness of a small bearing (ISO 281 table 13), reliability of 90 %.
    fn default() -> Self {
        Self {
            dynamic_rating: None,
            static_rating: None,
            fatigue_limit: None,
            lubricant: None,
            contamination: 0.5,
            reliability: 0.9,
        }
    }
}

impl BallBearing {
    /// The oil it runs in: of its contact law, else of its service.
    pub fn lubricant(&self) -> Option<&Lubricant> {
        match &self.contact {
            ContactLaw::Film { lubricant, .. } => Some(lubricant),
            ContactLaw::Ehl(law) => Some(&law.lubricant),
            ContactLaw::Hertz | ContactLaw::PowerLaw(_) => self.service.lubricant.as_ref(),
        }
    }

    /// Whether forces at a given displacement change with the shaft's speed: film, ball inertia, growing ring.
    pub fn depends_on_speed(&self) -> bool {
        let dry = matches!(self.contact, ContactLaw::Hertz | ContactLaw::PowerLaw(_));
        !dry || self.inertia != BallInertia::None || self.fit.speed_growth
    }

    /// The dry contacts of a ball at the nominal contact angle.
    pub fn hertz(&self) -> HertzPair {
        let g = &self.geometry;
        HertzPair::new(
            g.ball_diameter,
            g.pitch_diameter,
            [g.inner_groove_radius, g.outer_groove_radius],
            g.contact_angle,
            &self.ball_material,
            &self.ring_material,
        )
        .with_stiffness(self.contact_stiffness)
    }

    /// Change of the diametral clearance by fits, temperatures and a speed Ω \[rad/s\] \[m\]; shaft and housing of the
    /// rings' material.
    pub fn clearance_change(&self, speed: f64) -> f64 {
        self.fit.clearance_change(&self.geometry, &FitMaterials::all(&self.ring_material), speed)
    }
}

impl BallBearing {
    /// Why this bearing cannot be computed, one sentence each; empty when it can.
    pub fn problems(&self) -> Vec<String> {
        let mut out = Vec::new();
        let mut refuse = |wrong: bool, why: &str| {
            if wrong {
                out.push(why.to_string());
            }
        };
        let split = self.inertia != BallInertia::None;
        refuse(
            split && matches!(self.contact, ContactLaw::PowerLaw(_)),
            "ball inertia needs each contact alone; a fitted power law knows only both together",
        );
        refuse(
            !matches!(self.contact, ContactLaw::Film { .. })
                && matches!(self.damping, ContactDamping::Film { .. }),
            "film damping needs the film formula, contact = \"film\"",
        );
        refuse(
            self.contact_stiffness != ContactStiffness::Elastic
                && matches!(self.contact, ContactLaw::PowerLaw(_) | ContactLaw::Ehl(_)),
            "a contact stiffness says nothing beside a fitted law or a solved film, which have their own",
        );
        refuse(
            self.imperfections.balls().any(|ball| ball >= self.geometry.balls),
            "a wave, a size or a defect is on a ball that is not there",
        );
        let forced = matches!(self.imperfections.law, DefectLaw::Force { .. });
        refuse(
            forced && split,
            "the force law of defects does not say which contact of a ball with inertia it pushes",
        );
        refuse(
            forced && matches!(self.preload, Preload::Spring { .. }),
            "the force law of defects has no energy, which a ring on a spring is placed by",
        );
        refuse(self.geometry.balls < 2, "a ball bearing has two balls at least");
        refuse(
            matches!(self.preload, Preload::Spring { stiffness, .. } if stiffness < 0.0 || stiffness.is_nan()),
            "the preload spring's stiffness is negative",
        );
        refuse(
            matches!(self.preload, Preload::DryForce(f) | Preload::Force(f) | Preload::Spring { force: f, .. }
                if f < 0.0 || f.is_nan()),
            "a preload force is negative: the bearing carries thrust one way",
        );
        refuse(
            self.duplex.is_some_and(|pair| pair.spacing <= 0.0 || pair.spacing.is_nan()),
            "the rows of a matched pair are no distance apart",
        );
        out
    }
}

/// Centrifugal force and gyroscopic moment of the balls.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BallInertia {
    /// Massless balls: both contacts carry the same load on one line.
    #[default]
    None,
    /// Two contact angles per ball; the outer race alone resists the gyroscopic moment.
    OuterRaceControl,
    /// The inner race alone resists it.
    InnerRaceControl,
    /// d'Alembert: shared in proportion to the contact loads.
    Shared,
}

/// Axial preload, in the direction of the bearing's thrust.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Preload {
    #[default]
    None,
    /// Axial approach of the rings from their nominal place δ₀ \[m\], rigid; the film adds to it.
    Interference(f64),
    /// The interference at which the dry bearing at rest carries this axial force \[N\] when centred.
    DryForce(f64),
    /// The interference at which the centred bearing carries this axial force \[N\] at its speed, with
    /// film and ball inertia: adjusted by a load cell, then held.
    Force(f64),
    /// A spring pushes the outer ring, which slides axially without mass: axial force F₀ − k e, e the
    /// ring's shift in the thrust direction.
    Spring { stiffness: f64, force: f64 },
}

/// Two equal rows side by side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Duplex {
    pub arrangement: Arrangement,
    /// Axial distance of the ball planes \[m\]; the bearing's station is midway.
    pub spacing: f64,
}

/// Arrangement of a matched pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arrangement {
    /// O: load lines meet the axis outside the pair; stiff against tilting.
    BackToBack,
    /// X: load lines meet the axis between the rows or near them.
    FaceToFace,
    /// Both rows carry thrust the same way, `thrust_direction`.
    Tandem,
}

/// How the cage turns with the shaft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cage {
    /// Rolling without slip at the mean current contact angle: Ω_c/Ω = ½ (1 − D_w cos α / D_pw).
    Rolling,
    /// Given ratio Ω_c/Ω.
    Ratio(f64),
}

//! Ball bearing input data: geometry, materials, contact law, preload, fits, cage, imperfections, service.

use super::lubrication::{Lubrication, SLIDING_FRICTION};
use crate::contact::{ContactDamping, ContactLaw, ContactStiffness, HertzPair, Lubricant};
use crate::material::Material;
use crate::{
    BallGeometry, BallInertia, CharacteristicOrders, DefectLaw, Fit, FitMaterials, Imperfections, Surface,
};
use serde::{Deserialize, Serialize};

/// Ball bearing with one force element per ball and a kinematic cage.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BallBearing {
    pub geometry: BallGeometry,
    /// Material of balls and of rings.
    pub ball_material: Material,
    pub ring_material: Material,
    /// Contact law of the balls.
    pub contact: ContactLaw,
    /// Stiffness of the dry contacts: from curvatures and elasticity, or given.
    pub contact_stiffness: ContactStiffness,
    /// Contact damping.
    pub damping: ContactDamping,
    pub inertia: BallInertia,
    pub preload: Preload,
    /// Arrangement of a matched (duplex) pair; `None` for a single row.
    pub duplex: Option<Duplex>,
    pub fit: Fit,
    pub cage: Cage,
    /// Initial cage angle ψ₀, position of ball 0 \[rad\], from +x towards +y.
    pub cage_angle: f64,
    pub imperfections: Imperfections,
    /// Cage pocket diameter and cage width \[m\] for the overlap check and drawings.
    pub cage_pocket_diameter: f64,
    pub service: Service,
    /// How the internal geometry was estimated; `None` if it is given or has a source.
    pub estimated_geometry: Option<String>,
}

/// Catalogue data and service conditions: load ratings, shoulders; lubricant, contamination, reliability (ISO 281).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Service {
    /// Load ratings C and C₀ and fatigue load limit C_u from the catalogue \[N\]; `None`: from the geometry.
    pub dynamic_rating: Option<f64>,
    pub static_rating: Option<f64>,
    pub fatigue_limit: Option<f64>,
    /// Lubricant, if the contact law specifies none.
    pub lubricant: Option<Lubricant>,
    /// Lubrication method and sliding friction coefficient of the friction torque.
    pub lubrication: Lubrication,
    pub sliding_friction: f64,
    /// Contamination factor e_C from 0 (very severe) to 1 (extreme cleanliness).
    pub contamination: f64,
    /// Reliability from 0.9 to 0.999.
    pub reliability: f64,
    /// Diameters of the shoulders of inner and outer race \[m\]; `None`: by the rule of
    /// [`shoulder_height`](crate::rating::shoulder::shoulder_height).
    pub shoulder_diameters: [Option<f64>; 2],
}

/// Default contamination factor e_C: normal cleanliness of a small bearing (ISO 281 table 13).
pub const CONTAMINATION: f64 = 0.5;
/// Default reliability of the rating life.
pub const RELIABILITY: f64 = 0.9;

impl Default for Service {
    fn default() -> Self {
        Self {
            dynamic_rating: None,
            static_rating: None,
            fatigue_limit: None,
            lubricant: None,
            lubrication: Lubrication::default(),
            sliding_friction: SLIDING_FRICTION,
            contamination: CONTAMINATION,
            reliability: RELIABILITY,
            shoulder_diameters: [None; 2],
        }
    }
}

impl BallBearing {
    /// Whether all balls are of one size and shape.
    pub fn balls_are_alike(&self) -> bool {
        let Imperfections { ball_waviness, off_size, defects, .. } = &self.imperfections;
        let on_ball = |d: &crate::Defect| matches!(d.surface, crate::Surface::Ball(_));
        ball_waviness.is_empty() && off_size.is_empty() && !defects.iter().any(on_ball)
    }

    /// Angle by which the shaft turns while a ball passes over the local defect that it passes over fastest \[rad\]; `None`
    /// without defects.
    pub fn shortest_defect_pass(&self) -> Option<f64> {
        let g = &self.geometry;
        let orders = g.characteristic_orders(g.contact_angle);
        let passes = self.imperfections.defects.iter().map(|defect| {
            let order = match defect.surface {
                Surface::Outer => orders.bpfo / g.balls as f64,
                Surface::Inner => orders.bpfi / g.balls as f64,
                Surface::Ball(_) => orders.bsf,
            };
            defect.angle(g) / order
        });
        passes.filter(|angle| *angle > 0.0).min_by(f64::total_cmp)
    }

    /// Lubricant of the contact law, else of the service conditions.
    pub fn lubricant(&self) -> Option<&Lubricant> {
        self.contact.lubricant().or(self.service.lubricant.as_ref())
    }

    /// Whether forces at a given displacement depend on shaft speed: film, ball inertia, centrifugal ring
    /// growth.
    pub fn depends_on_speed(&self) -> bool {
        !self.contact.is_dry() || self.inertia.depends_on_speed() || self.fit.speed_growth
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

    /// Characteristic orders under load, at a load-weighted mean cos α; cage and ball passages at the cage's ratio
    /// if that is given.
    pub fn loaded_orders(&self, mean_cos: f64) -> CharacteristicOrders {
        let orders = self.geometry.characteristic_orders_at(mean_cos);
        let balls = self.geometry.balls as f64;
        match self.cage {
            Cage::Rolling => orders,
            Cage::Ratio(ratio) => CharacteristicOrders {
                ftf: ratio,
                bpfo: balls * ratio,
                bpfi: balls * (1.0 - ratio),
                ..orders
            },
        }
    }

    /// Centrifugal force F_c = ½ m D_pw ω_c² of a ball \[N\] at a shaft speed \[rad/s\] and the cage ratio of the nominal
    /// contact angle; the given one if it is given.
    pub fn centrifugal_force(&self, speed: f64) -> f64 {
        if let BallInertia::CentrifugalForce(given) = self.inertia {
            return given;
        }
        let g = &self.geometry;
        let ratio = match self.cage {
            Cage::Rolling => g.characteristic_orders(g.contact_angle).ftf,
            Cage::Ratio(ratio) => ratio,
        };
        let mass = self.ball_material.density * std::f64::consts::PI / 6.0 * g.ball_diameter.powi(3);
        0.5 * mass * g.pitch_diameter * (ratio * speed).powi(2)
    }

    /// Change of the diametral clearance by fits, temperatures and a speed Ω \[rad/s\] \[m\]; shaft and housing of the
    /// rings' material.
    pub fn clearance_change(&self, speed: f64) -> f64 {
        self.fit.clearance_change(&self.geometry, &FitMaterials::all(&self.ring_material), speed)
    }

    /// Diametral interference of shaft and inner ring that a speed Ω \[rad/s\] leaves of the stated one \[m\]; negative for
    /// play. `None` without a stated interference.
    pub fn interference_left(&self, speed: f64) -> Option<f64> {
        let left =
            || self.fit.interference_left(&self.geometry, &FitMaterials::all(&self.ring_material), speed);
        (self.fit.shaft_interference > 0.0).then(left)
    }
}

impl BallBearing {
    /// Validation errors, one sentence each: combinations and values that are not supported; empty if valid.
    pub fn problems(&self) -> Vec<String> {
        let mut out = Vec::new();
        let mut refuse = |wrong: bool, why: &str| {
            if wrong {
                out.push(why.to_string());
            }
        };
        let split = self.inertia.is_on();
        refuse(
            split && !self.contact.has_separate_contacts(),
            "ball inertia needs a contact law for each race; a fitted power law gives only both in series",
        );
        refuse(
            !self.contact.has_film_formula() && matches!(self.damping, ContactDamping::Film { .. }),
            "film damping requires the film formula, contact = \"film\"",
        );
        refuse(
            self.contact_stiffness != ContactStiffness::Elastic && !self.contact.takes_contact_stiffness(),
            "a contact stiffness cannot be combined with a fitted power law or an EHL film",
        );
        refuse(
            self.imperfections.ball_numbers().any(|ball| ball >= self.geometry.balls),
            "a wave, a size or a defect is on a ball number that does not exist (balls count from 0)",
        );
        let forced = matches!(self.imperfections.law, DefectLaw::Force { .. });
        refuse(
            forced && split,
            "the force law of defects is not defined for balls with inertia (two separate contacts)",
        );
        refuse(
            forced && matches!(self.preload, Preload::Spring { .. }),
            "the force law of defects is not conservative and cannot be combined with spring preload",
        );
        refuse(self.geometry.balls < 2, "a ball bearing needs at least two balls");
        refuse(
            matches!(self.preload, Preload::Spring { stiffness, .. } if stiffness < 0.0 || stiffness.is_nan()),
            "the preload spring's stiffness is negative",
        );
        refuse(
            self.preload.force().is_some_and(|f| f < 0.0 || f.is_nan()),
            "a preload force is negative; the bearing carries thrust in one direction only",
        );
        refuse(
            self.duplex.is_some() && matches!(self.preload, Preload::Mounted { .. }),
            "a mounted preload is the axial force of a single row; a matched pair is preloaded within itself (force)",
        );
        refuse(
            self.duplex.is_some_and(|pair| pair.spacing <= 0.0 || pair.spacing.is_nan()),
            "the row spacing of a matched pair is not positive",
        );
        out
    }
}

/// Axial preload, in the direction of the bearing's thrust.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum Preload {
    #[default]
    None,
    /// Rigid (fixed-position) preload: axial approach δ₀ of the rings from nominal \[m\]; the film adds to
    /// it.
    Interference(f64),
    /// The interference at which the dry bearing at rest carries this axial force \[N\] when centred.
    DryForce(f64),
    /// The interference at which the centred bearing carries this axial force \[N\] at its speed, with
    /// film and ball inertia: adjusted by load cell, then locked (rigid).
    Force(f64),
    /// Constant-pressure (spring) preload on a massless, axially sliding outer ring: axial force F₀ − k e,
    /// e the ring's displacement in the thrust direction.
    Spring { stiffness: f64, force: f64 },
    /// Rigid: the axial force \[N\] that the bearing carries in the assembled machine at standstill, with the
    /// interference that gives it; where that is not known yet, the bearing is as with [`Preload::DryForce`].
    Mounted { force: f64, interference: Option<f64> },
}

impl Preload {
    /// The stated axial force \[N\]; `None` without preload or with an interference.
    pub fn force(&self) -> Option<f64> {
        match *self {
            Self::None | Self::Interference(_) => None,
            Self::DryForce(force)
            | Self::Force(force)
            | Self::Spring { force, .. }
            | Self::Mounted { force, .. } => Some(force),
        }
    }

    /// The share of each of some equal rows that take it side by side: force and spring are divided.
    pub(super) fn shared_by(self, rows: usize) -> Self {
        let part = 1.0 / rows as f64;
        match self {
            Self::None | Self::Interference(_) => self,
            Self::DryForce(force) => Self::DryForce(part * force),
            Self::Force(force) => Self::Force(part * force),
            Self::Spring { stiffness, force } => {
                Self::Spring { stiffness: part * stiffness, force: part * force }
            }
            Self::Mounted { force, interference } => Self::Mounted { force: part * force, interference },
        }
    }
}

/// Duplex (matched) pair: two equal rows.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Duplex {
    pub arrangement: Arrangement,
    /// Axial distance of the ball planes \[m\]; the bearing's station is midway.
    pub spacing: f64,
}

/// Arrangement of a matched pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Arrangement {
    /// O arrangement (DB): load lines meet the axis outside the pair; high tilting stiffness.
    BackToBack,
    /// X arrangement (DF): load lines meet the axis between the rows or near them.
    FaceToFace,
    /// Tandem (DT): both rows carry thrust in the same direction, `thrust_direction`.
    Tandem,
}

/// Cage speed ratio.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Cage {
    /// Rolling without slip at the mean current contact angle: Ω_c/Ω = ½ (1 − D_w cos α / D_pw).
    Rolling,
    /// Given ratio Ω_c/Ω.
    Ratio(f64),
}

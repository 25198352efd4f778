//! Contact of a ball with the groove of a race.
//!
//! A groove is the inner side of a torus: centre circle of radius R_g in the plane at z_g of the ring, groove radius r_g.
//! With the ball's centre at (ρ, z) from the ring's axis and plane, x = (R_g − ρ) e + (z_g − z) a points to the centre
//! circle (e radial, a axial), δ = |x| − (r_g − r) + w, and the race presses on the ball along n = x/|x|. The groove ends
//! at the shoulders; beyond their angle the ball touches their edge, a circle, with n from the edge to the ball's centre and
//! δ = r − distance, continuous with the groove and with its stiffness. The far side of the torus does not exist. Waviness and local defects w(φ) turn the normal force
//! by its slope to n − (w′/ρ) t; it passes through the ball's centre, so that contact and surface conserve energy.

use super::ellipse::{EllipseRule, SlidingContact, TractionSum, traction_at_centre};
use super::friction::{CoulombSlip, FilmSlip, FrictionLaw, PreparedLaw, ViscosityTable};
use super::input::{FreeBallBearing, SlipModel};
use super::ring::{RingFrame, V};
use super::surfaces::{Distances, GroovePlace, GrooveSurface};
use crate::contact::{FilmFormula, Race};
use crate::shoulder::shoulder_angle;
use crate::{BallGeometry, Imperfections, Profile, Rotation, Surface};

/// Groove of a race with its contact properties.
#[derive(Clone, Debug)]
pub(super) struct Groove {
    pub torus: GrooveSurface,
    /// K \[N/m^1.5\].
    pub stiffness: f64,
    /// χ \[s/m\].
    damping: f64,
    /// Semi-axes along and across rolling over √δ \[m^0.5\], and 1/(2R) of the deformed surface \[1/m\].
    semi_axes: [f64; 2],
    half_curvature: f64,
    /// Maximum pressure over √δ \[Pa/m^0.5\].
    pressure: f64,
    /// The ball's share of the approach.
    ball_share: f64,
    /// (3/16) · loss factor, and the rolling speed below which rolling resistance fades \[rad/s\].
    rolling: [f64; 2],
    /// Surface over the race's angle; `None` for a perfect race.
    surface: Option<Profile>,
    /// Bound of the surface's height \[m\].
    highest: f64,
    law: PreparedLaw,
    rule: Option<EllipseRule>,
}

/// Centre, velocities and radius of a ball.
#[derive(Clone, Copy, Debug)]
pub(super) struct BallMotionState {
    pub position: V,
    pub velocity: V,
    pub rotation: V,
    pub radius: f64,
}

/// Forces of a race on a ball, with their geometry.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct RaceForce {
    /// Normal load Q \[N\], and the cosine and sine of the contact angle, positive towards +z at the ring.
    pub load: f64,
    pub angle: [f64; 2],
    /// Normal force \[N\]; through the ball's centre.
    pub normal: V,
    /// Friction force \[N\] at the contact's centre, that place from the ball's centre \[m\], and moment \[N m\].
    pub friction: V,
    pub arm: V,
    pub moment: V,
    /// Slip at the centre along and across rolling \[m/s\], spin and rolling against the race \[rad/s\].
    pub slip: [f64; 2],
    pub spin: f64,
    pub rolling: f64,
    /// Semi-axes along and across rolling \[m\].
    pub semi_axes: [f64; 2],
    /// Elastic energy \[J\].
    pub energy: f64,
    /// Power lost by traction, by rolling resistance and by contact damping \[W\].
    pub traction_power: f64,
    pub rolling_power: f64,
    pub damping_power: f64,
    /// Slopes dQ/dδ \[N/m\], dQ/dδ̇ \[N s/m\], and friction over slip \[N s/m\].
    pub slopes: [f64; 3],
    /// Moment of rolling resistance over the rotation of rolling \[N m s\].
    pub rolling_slope: f64,
}

impl Groove {
    /// Groove of a race; `clearance`: diametral, as mounted \[m\]; `preload`: axial interference \[m\].
    ///
    /// The inner centre circle lies in the plane of its ring; its radial distance from the outer one is A cos α₀ − P_d/2,
    /// the axial one A sin α₀ + δ₀, A = r_i + r_o − D_w.
    pub fn new(bearing: &FreeBallBearing, race: Race, clearance: f64, preload: f64) -> Self {
        let (g, hertz) = (&bearing.ball.geometry, bearing.ball.hertz());
        let ball_radius = 0.5 * g.ball_diameter;
        let (sin, cos) = g.contact_angle.sin_cos();
        let radii = [g.inner_groove_radius, g.outer_groove_radius];
        let distance = radii[0] + radii[1] - g.ball_diameter;
        let (side, radius, contact) = match race {
            Race::Inner => (1.0, radii[0], hertz.inner),
            Race::Outer => (-1.0, radii[1], hertz.outer),
        };
        let direction = if g.thrust_direction < 0.0 { -1.0 } else { 1.0 };
        let axial = if side > 0.0 { 0.0 } else { -direction * (distance * sin + preload) };
        // Ellipse and pressure grow with √δ; at δ = 1 m the load is K.
        let unit = contact.patch(contact.stiffness);
        let compliance = |m: &crate::material::Material| (1.0 - m.poisson * m.poisson) / m.young;
        let [ball, ring] = [&bearing.ball.ball_material, &bearing.ball.ring_material].map(compliance);
        let ball_share = ball / (ball + ring);
        let curvature = 1.0 / ball_radius - ball_share * (1.0 / ball_radius - 1.0 / radius);
        let slip_speed = match &bearing.friction {
            FrictionLaw::Coulomb(law) => law.slip_speed,
            FrictionLaw::Curve(law) => law.limit / (law.slope + law.limit * law.decay),
            FrictionLaw::Film(law) => law.slip_speed,
        };
        let imperfections = of_race(&bearing.ball.imperfections, race);
        Self {
            torus: GrooveSurface {
                race,
                side,
                centre_radius: 0.5 * g.pitch_diameter
                    + side * ((radius - ball_radius) * cos - 0.25 * clearance),
                axial,
                radius,
                shoulder: {
                    let (sin, cos) = shoulder_angle(&bearing.ball, race).sin_cos();
                    [cos, sin]
                },
            },
            stiffness: contact.stiffness,
            damping: bearing.damping,
            semi_axes: contact.semi_axes(contact.stiffness),
            pressure: unit.maximum_pressure,
            half_curvature: 0.5 * curvature,
            ball_share,
            rolling: [3.0 / 16.0 * bearing.rolling_loss, slip_speed / ball_radius],
            surface: Profile::new(g, &imperfections, 0, 0.0, 0.0),
            highest: highest(g, &imperfections),
            law: match &bearing.friction {
                FrictionLaw::Coulomb(law) => PreparedLaw::Coulomb(CoulombSlip::from(law)),
                FrictionLaw::Curve(law) => PreparedLaw::Curve(*law),
                FrictionLaw::Film(law) => PreparedLaw::Film {
                    film: FilmFormula::new(&contact, &law.lubricant),
                    viscosity: ViscosityTable::new(&law.lubricant),
                    law: law.clone(),
                },
            },
            rule: match bearing.slip {
                SlipModel::Centre => None,
                SlipModel::Ellipse { along, across } => Some(EllipseRule::new(along, across)),
            },
        }
    }

    /// Largest slope of friction over slip per load \[s/m\], at zero slip.
    pub fn friction_slope(&self) -> f64 {
        match &self.law {
            PreparedLaw::Coulomb(law) => law.friction / law.slip_speed_squared.sqrt(),
            PreparedLaw::Curve(law) => law.slope + law.limit * law.decay,
            PreparedLaw::Film { law, .. } => law.limit / law.slip_speed,
        }
    }

    /// Forces of the race on a ball; `None` where they do not touch.
    #[inline]
    pub fn react<D: Distances>(
        &self,
        distances: &D,
        ring: &RingFrame,
        ball: &BallMotionState,
    ) -> Option<RaceForce> {
        let from_ring = ball.position - ring.centre;
        let height = from_ring.dot(&ring.axis);
        let radial = from_ring - height * ring.axis;
        let rho = radial.norm();
        let outward = radial * (1.0 / rho);
        let to_circle = [self.torus.centre_radius - rho, self.torus.axial - height];
        let along = ring.axis.cross(&outward);
        let place = GroovePlace { ring, centre: ball.position, radius: ball.radius, outward, to_circle };
        let ([n_radial, n_axial], free_depth) = distances.groove(&self.torus, &place);
        if free_depth <= -self.highest {
            return None;
        }
        let [height_there, slope] = self.surface_height(ring, &outward, &along);
        let depth = free_depth + height_there;
        if depth <= 0.0 {
            return None;
        }
        let n = n_radial * outward + n_axial * ring.axis;
        let across = n.cross(&along);
        let pressed = n - slope / rho * along;
        let rate = -pressed.dot(&(ball.velocity - ring.velocity_at(&from_ring)));

        let root = depth.sqrt();
        let elastic = self.stiffness * root * depth;
        let damping = self.damping * elastic;
        let load = (elastic + damping * rate).max(0.0);
        let semi_axes = [self.semi_axes[0] * root, self.semi_axes[1] * root];

        let arm = (self.ball_share * depth - ball.radius) * n;
        let ball_surface = ball.velocity + ball.rotation.cross(&arm);
        let race_surface = ring.velocity_at(&(from_ring + arm));
        let slip = ball_surface - race_surface;
        let relative = ball.rotation - ring.rotation;
        let (spin, rolling) = (relative.dot(&n), relative.dot(&across));
        let sliding = SlidingContact {
            load,
            pressure: self.pressure * root,
            semi_axes,
            half_curvature: self.half_curvature,
            slip: [slip.dot(&along), slip.dot(&across)],
            rotation: [relative.dot(&along), rolling, spin],
        };
        let traction = if load > 0.0 {
            let orbit = ball.velocity.dot(&along) * (rho + arm.dot(&outward)) / rho;
            self.traction(&sliding, 0.5 * (ball_surface + race_surface).dot(&along) - orbit)
        } else {
            TractionSum::default()
        };
        let roll = relative - spin * n;
        let rolling_slope = self.rolling_slope(&roll, load, semi_axes[0]);
        let moment = traction.moment[0] * along + traction.moment[1] * across + traction.moment[2] * n;
        Some(RaceForce {
            load,
            angle: [self.torus.side * n_radial, self.torus.side * n_axial],
            normal: load * pressed,
            friction: traction.force[0] * along + traction.force[1] * across,
            arm,
            moment: moment - rolling_slope * roll,
            slip: sliding.slip,
            spin,
            rolling,
            semi_axes,
            energy: 0.4 * elastic * depth,
            traction_power: traction.power,
            rolling_power: rolling_slope * roll.norm_squared(),
            damping_power: (load - elastic) * rate,
            slopes: [1.5 * self.stiffness * root, damping, traction.slope],
            rolling_slope,
        })
    }

    /// Moment of rolling resistance against the rolling part of the rotation, over that rotation \[N m s\].
    #[inline(always)]
    fn rolling_slope(&self, roll: &V, load: f64, semi_axis: f64) -> f64 {
        let [factor, fading] = self.rolling;
        if factor == 0.0 {
            return 0.0;
        }
        factor * load * semi_axis / (roll.norm_squared() + fading * fading).sqrt()
    }

    /// Friction at an entrainment speed \[m/s\].
    #[inline(always)]
    fn traction(&self, contact: &SlidingContact, entrainment: f64) -> TractionSum {
        match (&self.law, &self.rule) {
            (PreparedLaw::Coulomb(law), None) => traction_at_centre(law, contact),
            (PreparedLaw::Coulomb(law), Some(rule)) => rule.traction(law, contact),
            (PreparedLaw::Curve(law), None) => traction_at_centre(&law, contact),
            (PreparedLaw::Curve(law), Some(rule)) => rule.traction(&law, contact),
            (PreparedLaw::Film { law, film, viscosity }, rule) => {
                let thickness = film.central(entrainment.abs(), contact.load);
                let law = FilmSlip { law, viscosity, thickness };
                match rule {
                    None => traction_at_centre(&law, contact),
                    Some(rule) => rule.traction(&law, contact),
                }
            }
        }
    }

    /// Height of the surface at a ball \[m\] and its derivative by the ball's angle \[m/rad\].
    #[inline(always)]
    pub fn surface_height(&self, ring: &RingFrame, outward: &V, along: &V) -> [f64; 2] {
        let Some(surface) = &self.surface else { return [0.0; 2] };
        // The ball's angle from the ring's x axis; along = ∂(outward)/∂φ.
        let angle = (-along.dot(&ring.across)).atan2(outward.dot(&ring.across)) - ring.angle;
        // Ball 0 of a cage at that angle; its rate at unit speed is the derivative.
        let place = Rotation { cage_angle: angle, cage_speed: Some(1.0), ..Rotation::default() };
        let deviation = surface.at_rotation(&place).ball(0);
        let contact = if self.torus.side > 0.0 { 0 } else { 1 };
        [deviation.height[contact], deviation.full_rate()[contact]]
    }

    /// Why a ball at this place is no longer in the bearing; `None` if it is.
    pub fn lost(&self, ring: &RingFrame, position: &V, ball_radius: f64) -> Option<String> {
        let from_ring = position - ring.centre;
        let height = from_ring.dot(&ring.axis);
        let rho = (from_ring - height * ring.axis).norm();
        let race = if self.torus.side > 0.0 { "inner" } else { "outer" };
        let apart = (height - self.torus.axial).abs();
        if !(apart.is_finite() && rho.is_finite()) {
            return Some("its motion diverged".into());
        }
        if apart > ball_radius {
            return Some(format!("moved {apart:.3e} m axially out of the {race} groove"));
        }
        let through = self.torus.side * (self.torus.centre_radius - rho) - self.torus.radius;
        (through > 0.0).then(|| format!("its centre passed through the {race} race"))
    }
}

/// Waviness and defects of one race alone.
fn of_race(all: &Imperfections, race: Race) -> Imperfections {
    let (on, inner_waviness, outer_waviness) = match race {
        Race::Inner => (Surface::Inner, all.inner_waviness.clone(), Vec::new()),
        Race::Outer => (Surface::Outer, Vec::new(), all.outer_waviness.clone()),
    };
    let defects = all.defects.iter().filter(|defect| defect.surface == on).copied().collect();
    Imperfections { inner_waviness, outer_waviness, defects, ..Imperfections::default() }
}

/// Bound of the height of a race's surface \[m\].
fn highest(g: &BallGeometry, race: &Imperfections) -> f64 {
    let waves = race.inner_waviness.iter().chain(&race.outer_waviness).map(|wave| wave.amplitude.abs());
    waves.chain(race.defects.iter().map(|defect| defect.height(g).abs())).sum()
}

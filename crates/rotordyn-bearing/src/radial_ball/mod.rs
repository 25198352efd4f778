//! Plane ball bearing with one radial degree of freedom per ball (Upadhyay, Harsha & Jain 2009).
//!
//! Ball j is guided by the cage at ψ_j and free to move along e_r(ψ_j) between the races. Its coordinate y_j
//! is its radial position in the inertial frame: with the housing displaced by h and the inner ring by h + d,
//! its centre is at h + ρ e_r with ρ = ρ₀ + y − h·e_r, ρ₀ the radius at which it just touches the outer race.
//! With this choice every ball has a constant mass, and T = ½ m Σ [(ẏ − ψ̇ h·e_t)² + (ḣ·e_t + ψ̇ ρ)²] gives
//! the housing the constant added mass Z m/2 of the balls; all other terms are forces. χ = |ρ e_r − d| is the
//! exact distance from the centre of the inner race, n the unit vector along it, and the contact deformations
//! are δ_i = ρ_i − χ + w_i and δ_o = y − h·e_r + w_o. The generalised forces of d, h and y are
//!
//! Q_d = −Σ F_i n, Q_h = Σ (F_o − F_i n_r) e_r − 2 m ψ̇ ρ̇ e_t,
//! Q_y = F_i n_r − F_o + m (ψ̇² (ρ − h·e_r) + 2 ψ̇ ḣ·e_t + g·e_r).
//!
//! The cage is guided by the housing, which takes its tangential forces; the term with its angular
//! acceleration, m h ψ̈, is neglected.
//!
//! Source: Upadhyay 2009 eq. 6-8 and Appendices A and B, with the sign of ρ θ̇² corrected and without the two
//! terms d(k)/dρ, which count the contact force twice; the paper's housing is fixed.

mod ball;
mod ball_state;
mod model;
mod quasi_static;
mod step;
mod tangent;

use std::f64::consts::{PI, TAU};

use ball_state::{BallState, LocalMotion};

use crate::{BallBearing, Cage, Deviation, Profile, Reaction, Rotation};

/// Plane ball bearing: every ball a mass with its own radial degree of freedom.
#[derive(Clone, Debug, PartialEq)]
pub struct RadialBallBearing {
    /// Geometry, materials, dry contacts, cage and imperfections; other fields are ignored.
    pub ball: BallBearing,
    /// Stiffness-proportional damping C of F = K δ^{3/2} + (3/2) C K δ^{1/2} δ̇, at both races \[s\].
    ///
    /// Source: Upadhyay 2009 eq. B.1-B.5 with p = 1.
    pub stiffness_damping: [f64; 2],
    /// Whether the damped contact force may become tensile during separation while δ > 0, as in the paper;
    /// else it is cut off at zero.
    pub tensile_contact: bool,
    /// Gravity in the bearing's plane \[m/s²\].
    pub gravity: [f64; 2],
}

impl RadialBallBearing {
    /// Mass of a ball \[kg\].
    pub fn ball_mass(&self) -> f64 {
        self.ball.ball_material.density * PI / 6.0 * self.ball.geometry.ball_diameter.powi(3)
    }

    /// Added mass of the balls on the housing, Z m/2 (motion tangential to each ball's line) \[kg\].
    pub fn added_ball_mass(&self) -> f64 {
        0.5 * self.ball.geometry.balls as f64 * self.ball_mass()
    }
}

/// Displacements of the rings: d of the inner relative to the outer one, h of the outer one (housing),
/// absolute.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rings {
    /// d and h along x and y \[m\]; ḋ and ḣ \[m/s\].
    pub relative_displacement: [f64; 2],
    pub housing_displacement: [f64; 2],
    pub relative_velocity: [f64; 2],
    pub housing_velocity: [f64; 2],
}

impl Rings {
    /// From interface rows d_x d_y and, for a flexible housing, h_x h_y.
    pub fn from_rows(d: &[f64], rate: &[f64]) -> Self {
        let pair = |rows: &[f64], k: usize| match rows.get(k..k + 2) {
            Some(&[x, y]) => [x, y],
            _ => [0.0; 2],
        };
        Self {
            relative_displacement: pair(d, 0),
            housing_displacement: pair(d, 2),
            relative_velocity: pair(rate, 0),
            housing_velocity: pair(rate, 2),
        }
    }
}

/// The bearing prepared for evaluation.
#[derive(Clone, Debug)]
pub struct RadialElement {
    stiffness: [f64; 2],
    damping: [f64; 2],
    tensile_contact: bool,
    mass: f64,
    /// The same for every ball.
    masses: Vec<f64>,
    gravity: [f64; 2],
    /// Radius ρ₀ of the ball centre in zero-load contact with the outer race, and ρ_i with the inner race
    /// \[m\].
    outer_contact_radius: f64,
    inner_contact_radius: f64,
    cage: Cage,
    ball_to_pitch: f64,
    /// cos and sin of 2πj/Z.
    spacing: Vec<[f64; 2]>,
    /// Deviations of races and balls; `None` when they are perfect.
    profile: Option<Box<Profile>>,
}

impl RadialElement {
    /// Prepares a bearing for evaluation.
    pub fn new(bearing: &RadialBallBearing) -> Self {
        let g = &bearing.ball.geometry;
        let spacing = (0..g.balls).map(|j| {
            let (sin, cos) = (TAU * j as f64 / g.balls as f64).sin_cos();
            [cos, sin]
        });
        let pair = bearing.ball.hertz();
        Self {
            stiffness: [pair.inner.stiffness, pair.outer.stiffness],
            damping: bearing.stiffness_damping,
            tensile_contact: bearing.tensile_contact,
            mass: bearing.ball_mass(),
            masses: vec![bearing.ball_mass(); g.balls],
            gravity: bearing.gravity,
            outer_contact_radius: 0.5 * g.pitch_diameter + 0.25 * g.radial_clearance,
            inner_contact_radius: 0.5 * g.pitch_diameter - 0.25 * g.radial_clearance,
            cage: bearing.ball.cage,
            ball_to_pitch: g.ball_diameter / g.pitch_diameter,
            spacing: spacing.collect(),
            profile: Profile::new(g, &bearing.ball.imperfections, 0, bearing.ball.cage_angle, pair.stiffness)
                .map(Box::new),
        }
    }

    /// Number of balls Z.
    pub fn balls(&self) -> usize {
        self.spacing.len()
    }

    /// Mass of a ball \[kg\].
    pub fn ball_mass(&self) -> f64 {
        self.mass
    }

    /// Cage speed over shaft speed: ½ (1 − D_w/D_pw) = r/(r + R) (Upadhyay 2009 eq. 1), or the given ratio.
    pub fn cage_ratio(&self) -> f64 {
        match self.cage {
            Cage::Rolling => 0.5 * (1.0 - self.ball_to_pitch),
            Cage::Ratio(ratio) => ratio,
        }
    }

    /// Forces at ball positions y \[m\] and velocities ẏ \[m/s\]: on d and h in the reaction (rows
    /// d_x d_y h_x h_y), on y in `force`; no tangents.
    pub fn forces(
        &self,
        rings: &Rings,
        [places, rates]: [&[f64]; 2],
        rotation: &Rotation,
        force: &mut [f64],
    ) -> Reaction {
        let mut sum = RingForceSum::default();
        self.for_each_ball(rings, rotation, |j, seen| {
            let acting = self.ball_state(&seen, places[j], rates[j]);
            force[j] = acting.force;
            sum.add(&seen, &acting, rates[j], self.mass);
        });
        sum.reaction()
    }

    /// Calls `visit` with every ball's number and its local ring and cage motion.
    #[inline(always)]
    fn for_each_ball(&self, rings: &Rings, rotation: &Rotation, mut visit: impl FnMut(usize, LocalMotion)) {
        let passing = self.profile.as_ref().map(|profile| profile.at_rotation(rotation));
        let (sin, cos) = rotation.cage_angle.sin_cos();
        for (j, [cj, sj]) in self.spacing.iter().enumerate() {
            let (c, s) = (cos * cj - sin * sj, sin * cj + cos * sj);
            let local = |v: &[f64; 2]| [v[0] * c + v[1] * s, v[1] * c - v[0] * s];
            let deviation = passing.map_or(Deviation::default(), |passing| passing.ball(j));
            visit(
                j,
                LocalMotion {
                    cos: c,
                    sin: s,
                    relative_displacement: local(&rings.relative_displacement),
                    housing_displacement: local(&rings.housing_displacement),
                    relative_velocity: local(&rings.relative_velocity),
                    housing_velocity: local(&rings.housing_velocity),
                    cage_speed: rotation.cage_speed.unwrap_or(0.0),
                    weight: self.mass * local(&self.gravity)[0],
                    deviation: deviation.height,
                    deviation_rate: deviation.rate,
                },
            );
        }
    }
}

/// Sum of ball forces on the rings, with energy and powers.
#[derive(Clone, Copy, Debug, Default)]
struct RingForceSum {
    /// On d_x d_y h_x h_y.
    force: [f64; 4],
    energy: f64,
    dissipated: f64,
    power: f64,
}

impl RingForceSum {
    /// Adds a ball with velocity ẏ.
    fn add(&mut self, seen: &LocalMotion, acting: &BallState, rate: f64, mass: f64) {
        let [dr, dt, hr, ht] = acting.ring_forces(seen, mass);
        let (c, s) = (seen.cos, seen.sin);
        for (sum, f) in
            self.force.iter_mut().zip([dr * c - dt * s, dr * s + dt * c, hr * c - ht * s, hr * s + ht * c])
        {
            *sum += f;
        }
        let [inner, outer] = &acting.contacts;
        let closing = inner.force * acting.deformation_rate[0] + outer.force * acting.deformation_rate[1];
        let [v, h] = [seen.relative_velocity, seen.housing_velocity];
        let work = dr * v[0] + dt * v[1] + hr * h[0] + ht * h[1] + acting.force * rate;
        self.energy += inner.energy + outer.energy;
        self.dissipated +=
            closing - inner.elastic * acting.deformation_rate[0] - outer.elastic * acting.deformation_rate[1];
        // Input power: power delivered to rings and balls beyond that of the contacts comes from the cage,
        // passing waves and gravity on the balls.
        self.power += work + closing;
    }

    fn reaction(&self) -> Reaction {
        let mut out = Reaction {
            elastic_energy: self.energy,
            dissipated_power: self.dissipated,
            parametric_power: self.power,
            mean_cos: 1.0,
            ..Reaction::default()
        };
        out.force[..4].copy_from_slice(&self.force);
        out
    }
}

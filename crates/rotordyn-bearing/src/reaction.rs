//! Kinematic state of a bearing and its reaction.

use serde::{Deserialize, Serialize};

/// Kinematic state of a bearing at one instant: angles and speeds of cage and shaft.
#[derive(Clone, Copy, Debug, PartialEq, Default, Serialize, Deserialize)]
pub struct Rotation {
    /// Cage angle ψ \[rad\].
    pub cage_angle: f64,
    /// Cage speed ψ̇ \[rad/s\]; `None` in statics: the contacts do not move past the rings, and the balls have
    /// the inertial loads of the cage speed at which they roll under the contact angles of the equilibrium.
    pub cage_speed: Option<f64>,
    /// Shaft (inner race) angle θ \[rad\] and speed θ̇ \[rad/s\].
    pub shaft_angle: f64,
    pub shaft_speed: f64,
}

impl Rotation {
    /// The state at a part of the way to another one.
    pub fn towards(&self, to: &Self, part: f64) -> Self {
        let between = |a: f64, b: f64| a + part * (b - a);
        Self {
            cage_angle: between(self.cage_angle, to.cage_angle),
            cage_speed: self.cage_speed.zip(to.cage_speed).map(|(a, b)| between(a, b)),
            shaft_angle: between(self.shaft_angle, to.shaft_angle),
            shaft_speed: between(self.shaft_speed, to.shaft_speed),
        }
    }
}

/// Bearing force on the shaft with stiffness and damping tangents, at one relative displacement and velocity.
#[derive(Clone, Copy, Debug, PartialEq, Default, Serialize, Deserialize)]
pub struct Reaction {
    /// Force and moment on the shaft f \[N, N m\]; the reaction on the housing is −f.
    pub force: [f64; 6],
    /// Additional force on the housing, on top of −f, along x and y \[N\]: weight and centrifugal force of
    /// balls with inertia.
    pub housing_force: [f64; 2],
    /// −∂f/∂d.
    pub stiffness: [[f64; 6]; 6],
    /// −∂f/∂ḋ.
    pub damping: [[f64; 6]; 6],
    /// Elastic energy stored \[J\].
    pub elastic_energy: f64,
    /// Parametric power \[W\]: input to the elastic energy by cage rotation, waviness and defects passing the
    /// contacts.
    pub parametric_power: f64,
    /// Power lost in contact damping \[W\].
    pub dissipated_power: f64,
    /// Load-weighted mean of cos α over the loaded balls.
    pub mean_cos: f64,
}

impl Reaction {
    /// Adds `weight` times another reaction.
    pub fn add(&mut self, other: &Self, weight: f64) {
        for a in 0..6 {
            self.force[a] += weight * other.force[a];
            for b in 0..6 {
                self.stiffness[a][b] += weight * other.stiffness[a][b];
                self.damping[a][b] += weight * other.damping[a][b];
            }
        }
        for (own, other) in self.housing_force.iter_mut().zip(other.housing_force) {
            *own += weight * other;
        }
        self.elastic_energy += weight * other.elastic_energy;
        self.parametric_power += weight * other.parametric_power;
        self.dissipated_power += weight * other.dissipated_power;
        self.mean_cos += weight * other.mean_cos;
    }
}

/// Stiffness and damping of a bearing between shaft node and housing point, linearised.
///
/// With d = (displacement of the shaft node) − (that of the housing's point), the force on the shaft is
/// f = −K d − C ḋ; order u_x u_y u_z θ_x θ_y θ_z.
#[derive(Clone, Copy, Debug, PartialEq, Default, Serialize, Deserialize)]
pub struct SiteTangent {
    /// K \[N/m, N/rad, N m/m, N m/rad\].
    pub stiffness: [[f64; 6]; 6],
    /// C, same order \[N s/m ...\].
    pub damping: [[f64; 6]; 6],
}

impl From<&Reaction> for SiteTangent {
    fn from(reaction: &Reaction) -> Self {
        Self { stiffness: reaction.stiffness, damping: reaction.damping }
    }
}

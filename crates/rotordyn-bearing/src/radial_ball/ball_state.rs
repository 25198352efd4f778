//! Motion and contacts of one ball with a radial coordinate.

/// Motion of rings and cage in a ball's local frame (radial, tangential).
#[derive(Clone, Copy, Debug)]
pub(super) struct LocalMotion {
    pub cos: f64,
    pub sin: f64,
    /// d, h \[m\] and their rates \[m/s\].
    pub relative_displacement: [f64; 2],
    pub housing_displacement: [f64; 2],
    pub relative_velocity: [f64; 2],
    pub housing_velocity: [f64; 2],
    /// Cage speed ψ̇ \[rad/s\].
    pub cage_speed: f64,
    /// m g·e_r \[N\].
    pub weight: f64,
    /// Deviations w_i and w_o of race and ball, positive towards each other \[m\], and their rates \[m/s\].
    pub deviation: [f64; 2],
    pub deviation_rate: [f64; 2],
}

/// State of one contact, deformed or open.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ContactState {
    /// F \[N\], ∂F/∂δ \[N/m\], ∂F/∂δ̇ \[N s/m\].
    pub force: f64,
    pub by_deformation: f64,
    pub by_rate: f64,
    /// Elastic part K δ^{3/2} \[N\], and the energy it stores \[J\].
    pub elastic: f64,
    pub energy: f64,
}

/// Kinematics and forces of a ball at one position.
#[derive(Clone, Copy, Debug)]
pub(super) struct BallState {
    /// Unit vector n and distance χ from the centre of the inner race \[m\].
    pub n: [f64; 2],
    pub distance: f64,
    /// Velocity of the ball relative to the inner race's centre, in non-rotating directions \[m/s\].
    pub relative_ball_velocity: [f64; 2],
    /// ρ̇ \[m/s\].
    pub radial_rate: f64,
    /// Deformations δ_i, δ_o \[m\] and their rates \[m/s\].
    pub deformation: [f64; 2],
    pub deformation_rate: [f64; 2],
    /// Inner and outer contact.
    pub contacts: [ContactState; 2],
    /// Q_y \[N\].
    pub force: f64,
}

impl BallState {
    /// Generalised forces on d_r d_t h_r h_t \[N\].
    pub fn ring_forces(&self, seen: &LocalMotion, mass: f64) -> [f64; 4] {
        let [inner, outer] = [self.contacts[0].force, self.contacts[1].force];
        [
            -inner * self.n[0],
            -inner * self.n[1],
            outer - inner * self.n[0],
            -2.0 * mass * seen.cage_speed * self.radial_rate,
        ]
    }
}

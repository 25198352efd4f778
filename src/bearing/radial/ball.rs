//! One ball between its races: position, contact deformation, contact forces.

use super::RadialElement;

/// Motion of rings and cage in a ball's local frame (radial, tangential).
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen {
    pub cos: f64,
    pub sin: f64,
    /// d, h \[m\] and their rates \[m/s\].
    pub shift: [f64; 2],
    pub frame: [f64; 2],
    pub shift_rate: [f64; 2],
    pub frame_rate: [f64; 2],
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
pub(super) struct Pressed {
    /// F \[N\], ∂F/∂δ \[N/m\], ∂F/∂δ̇ \[N s/m\].
    pub force: f64,
    pub by_depth: f64,
    pub by_rate: f64,
    /// Elastic part K δ^{3/2} \[N\], and the energy it stores \[J\].
    pub elastic: f64,
    pub energy: f64,
}

/// Kinematics and forces of a ball at one position.
#[derive(Clone, Copy, Debug)]
pub(super) struct Acting {
    /// Unit vector n and distance χ from the centre of the inner race \[m\].
    pub n: [f64; 2],
    pub distance: f64,
    /// Velocity of the ball relative to the inner race's centre, in non-rotating directions \[m/s\].
    pub drift: [f64; 2],
    /// ρ̇ \[m/s\].
    pub radial_rate: f64,
    /// Deformations δ_i, δ_o \[m\] and their rates \[m/s\].
    pub depth: [f64; 2],
    pub closing: [f64; 2],
    /// Inner and outer contact.
    pub contacts: [Pressed; 2],
    /// Q_y \[N\].
    pub force: f64,
}

impl Acting {
    /// Generalised forces on d_r d_t h_r h_t \[N\].
    pub fn on_rings(&self, seen: &Seen, mass: f64) -> [f64; 4] {
        let [inner, outer] = [self.contacts[0].force, self.contacts[1].force];
        [
            -inner * self.n[0],
            -inner * self.n[1],
            outer - inner * self.n[0],
            -2.0 * mass * seen.cage_speed * self.radial_rate,
        ]
    }
}

impl RadialElement {
    /// State of the ball at position y and velocity ẏ.
    #[inline(always)]
    pub(super) fn ball(&self, seen: &Seen, place: f64, rate: f64) -> Acting {
        let cage_speed = seen.cage_speed;
        let lift = place - seen.frame[0];
        let radius = self.outer_reach + lift;
        let radial_rate = rate - seen.frame_rate[0] - cage_speed * seen.frame[1];
        let arm = [radius - seen.shift[0], -seen.shift[1]];
        let distance = (arm[0] * arm[0] + arm[1] * arm[1]).sqrt();
        let n = [arm[0] / distance, arm[1] / distance];
        let drift = [radial_rate - seen.shift_rate[0], radius * cage_speed - seen.shift_rate[1]];
        // ρ_i − χ without cancellation: χ − a_r = a_t²/(χ + a_r).
        let bend = arm[1] * arm[1] / (distance + arm[0]);
        let gap = self.outer_reach - self.inner_reach;
        let depth = [seen.shift[0] - lift - gap - bend + seen.deviation[0], lift + seen.deviation[1]];
        let closing = [
            seen.deviation_rate[0] - n[0] * drift[0] - n[1] * drift[1],
            radial_rate + seen.deviation_rate[1],
        ];
        let contacts = [0, 1].map(|k| self.press(k, depth[k], closing[k]));
        let carried = cage_speed * (cage_speed * (radius - seen.frame[0]) + 2.0 * seen.frame_rate[1]);
        let force = contacts[0].force * n[0] - contacts[1].force + self.mass * carried + seen.weight;
        Acting { n, distance, drift, radial_rate, depth, closing, contacts, force }
    }

    /// Contact law F = K δ^{3/2} + (3/2) C K δ^{1/2} δ̇ for δ > 0 (Upadhyay 2009 eq. A.4, A.5, B.3, B.5 with
    /// p = 1).
    ///
    /// Limits: zero at δ ≤ 0; ∂F/∂δ is unbounded as δ → 0 with δ̇ ≠ 0.
    #[inline(always)]
    fn press(&self, contact: usize, depth: f64, rate: f64) -> Pressed {
        if depth <= 0.0 {
            return Pressed::default();
        }
        let (k, lag) = (self.stiffness[contact], 1.5 * self.damping[contact] * rate);
        let root = depth.sqrt();
        let elastic = k * root * depth;
        let mut out = Pressed { elastic, energy: 0.4 * elastic * depth, ..Pressed::default() };
        if self.pulls || depth + lag > 0.0 {
            out.force = elastic + k * root * lag;
            out.by_depth = 1.5 * k * root + 0.5 * k * lag / root;
            out.by_rate = 1.5 * self.damping[contact] * k * root;
        }
        out
    }
}

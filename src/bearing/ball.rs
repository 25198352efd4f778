//! Ball bearing element: one Hertz spring per ball, clearance, loss of contact, kinematic cage.
//!
//! Force law of Cakmak & Sanliturk 2010 §2.1 and §3.1 with massless balls: the groove centres of ball j are
//! A + δ_j apart, A = r_i + r_o − D_w, and the ball carries Q = K δ_j^{3/2} along the line that joins them.

use super::{BallBearing, Cage, Reaction, Wave};
use crate::contact::{ContactDamping, HertzPair};

/// A ball bearing made ready for evaluation: constants and per-ball data laid out as arrays.
#[derive(Clone, Debug)]
pub struct BallElement {
    /// Hertz contacts at the nominal contact angle.
    pub contacts: HertzPair,
    /// Distance of the groove centres of an unloaded ball A = r_i + r_o − D_w \[m\].
    pub centre_distance: f64,
    /// Radius of the circle of inner groove centres R_i \[m\].
    pub inner_centre_radius: f64,
    /// Groove-centre offset of the centred bearing: radial A cos α₀ − P_d/2, axial A sin α₀ \[m\].
    pub offset: [f64; 2],
    damping: f64,
    ramp: f64,
    cage: Cage,
    ball_to_pitch: f64,
    nominal_cos: f64,
    /// cos and sin of 2πj/Z.
    spacing: Vec<[f64; 2]>,
    inner_waves: Waviness,
    outer_waves: Waviness,
}

/// Where a bearing's moving parts are at one instant.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Rotation {
    /// Cage angle ψ \[rad\] and speed ψ̇ \[rad/s\].
    pub cage_angle: f64,
    pub cage_speed: f64,
    /// Shaft (inner race) angle θ \[rad\] and speed θ̇ \[rad/s\].
    pub shaft_angle: f64,
    pub shaft_speed: f64,
}

/// What one ball carries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallLoad {
    /// Angular position ψ_j \[rad\] from +x towards +y.
    pub position: f64,
    /// Normal load Q \[N\].
    pub load: f64,
    /// Contact angle α \[rad\].
    pub contact_angle: f64,
    /// Elastic approach δ \[m\]; negative is the gap that is left.
    pub deflection: f64,
}

/// One ball's kinematics at a relative displacement of the rings.
struct Ball {
    cos: f64,
    sin: f64,
    /// cos α and sin α.
    ca: f64,
    sa: f64,
    /// Distance of the groove centres |s| and approach δ.
    distance: f64,
    deflection: f64,
    /// Rate of δ from waviness passing by, at fixed ring displacement.
    wave_rate: f64,
}

impl BallElement {
    /// Prepares a bearing for evaluation.
    pub fn new(bearing: &BallBearing) -> Self {
        let g = &bearing.geometry;
        let contacts = bearing.hertz();
        let (damping, ramp) = match bearing.damping {
            ContactDamping::Constant { coefficient, ramp } => (coefficient, ramp),
            ContactDamping::HuntCrossley { .. } => (0.0, 1e-6),
        };
        let a = g.inner_groove_radius + g.outer_groove_radius - g.ball_diameter;
        let spacing = (0..g.balls)
            .map(|j| {
                let angle = std::f64::consts::TAU * j as f64 / g.balls as f64;
                [angle.cos(), angle.sin()]
            })
            .collect();
        Self {
            contacts,
            centre_distance: a,
            inner_centre_radius: g.inner_centre_radius(),
            offset: [
                a * g.contact_angle.cos() - 0.5 * g.radial_clearance,
                a * g.contact_angle.sin() * g.thrust_direction,
            ],
            damping,
            ramp,
            cage: bearing.cage,
            ball_to_pitch: g.ball_diameter / g.pitch_diameter,
            nominal_cos: g.contact_angle.cos(),
            spacing,
            inner_waves: Waviness::new(&bearing.inner_waviness),
            outer_waves: Waviness::new(&bearing.outer_waviness),
        }
    }

    /// Number of balls Z.
    pub fn balls(&self) -> usize {
        self.spacing.len()
    }

    /// Cage speed over shaft speed at a mean contact angle: ½ (1 − D_w cos α / D_pw), or the given ratio.
    ///
    /// Source: Cakmak & Sanliturk 2010 eq. 20 with the outer ring at rest.
    pub fn cage_ratio(&self, mean_cos: f64) -> f64 {
        match self.cage {
            Cage::Rolling => 0.5 * (1.0 - self.ball_to_pitch * mean_cos),
            Cage::Ratio(ratio) => ratio,
        }
    }

    /// Cosine of the nominal contact angle.
    pub fn nominal_cos(&self) -> f64 {
        self.nominal_cos
    }

    fn ball(&self, j: usize, d: &[f64; 6], rotation: &Rotation, cage: [f64; 2], waves: bool) -> Ball {
        let [cj, sj] = self.spacing[j];
        let cos = cage[0] * cj - cage[1] * sj;
        let sin = cage[1] * cj + cage[0] * sj;
        let r = self.inner_centre_radius;
        let radial = self.offset[0] + d[0] * cos + d[1] * sin;
        let axial = self.offset[1] + d[2] + r * (d[3] * sin - d[4] * cos);
        let distance = (radial * radial + axial * axial).sqrt();
        let mut deflection = distance - self.centre_distance;
        let mut wave_rate = 0.0;
        if waves && !self.outer_waves.is_empty() {
            let (w, slope) = self.outer_waves.at(cos, sin);
            deflection += w;
            wave_rate += slope * rotation.cage_speed;
        }
        if waves && !self.inner_waves.is_empty() {
            let (st, ct) = rotation.shaft_angle.sin_cos();
            let (w, slope) = self.inner_waves.at(cos * ct + sin * st, sin * ct - cos * st);
            deflection += w;
            wave_rate += slope * (rotation.cage_speed - rotation.shaft_speed);
        }
        Ball { cos, sin, ca: radial / distance, sa: axial / distance, distance, deflection, wave_rate }
    }

    /// Force on the shaft and both tangents at a displacement of the inner ring relative to the outer one.
    ///
    /// δ_j = |s_j| − A + w_i + w_o with s_j = (A cos α₀ − P_d/2 + x cos ψ_j + y sin ψ_j,
    /// A sin α₀ + z + R_i (θ_x sin ψ_j − θ_y cos ψ_j)), Q_j = max(0, K δ^{3/2} + c w(δ) δ̇) for δ > 0, else 0;
    /// f = −Σ Q_j ∂δ_j/∂d. δ̇ is the full rate of approach: motion of the rings, of the cage and of the waves.
    ///
    /// `d`, `v`: displacement \[m, rad\] and velocity of the shaft relative to the housing (θ_z is ignored).
    /// Limits: all δ ≤ 0 gives zero force and zero tangents; the force never pulls.
    pub fn reaction(&self, d: &[f64; 6], v: &[f64; 6], rotation: &Rotation) -> Reaction {
        self.sum(d, v, rotation, true)
    }

    fn sum(&self, d: &[f64; 6], v: &[f64; 6], rotation: &Rotation, waves: bool) -> Reaction {
        let mut out = Reaction::default();
        let cage = [rotation.cage_angle.cos(), rotation.cage_angle.sin()];
        let r = self.inner_centre_radius;
        let mut load_sum = 0.0;
        let mut load_cos = 0.0;
        for j in 0..self.spacing.len() {
            let ball = self.ball(j, d, rotation, cage, waves);
            if ball.deflection <= 0.0 {
                continue;
            }
            let Ball { cos, sin, ca, sa, .. } = ball;
            // g = ∂δ/∂d; t = |s| ∂α/∂d; g_psi = ∂g/∂ψ at fixed d.
            let g = [ca * cos, ca * sin, sa, sa * r * sin, -sa * r * cos];
            let t = [-sa * cos, -sa * sin, ca, ca * r * sin, -ca * r * cos];
            let radial_psi = d[1] * cos - d[0] * sin;
            let axial_psi = r * (d[3] * cos + d[4] * sin);
            let delta_psi = ca * radial_psi + sa * axial_psi;
            let alpha_psi = (ca * axial_psi - sa * radial_psi) / ball.distance;
            let rate = g.iter().zip(v).map(|(a, b)| a * b).sum::<f64>()
                + rotation.cage_speed * delta_psi
                + ball.wave_rate;
            let root = ball.deflection.sqrt();
            let elastic = self.contacts.stiffness * ball.deflection * root;
            let (weight, weight_slope) = ramp(ball.deflection, self.ramp);
            let load = elastic + self.damping * weight * rate;
            // A contact that would have to pull lets go: its elastic energy is lost to damping.
            let load = load.max(0.0);
            out.elastic_energy += 0.4 * elastic * ball.deflection;
            out.parametric_power += load * (rotation.cage_speed * delta_psi + ball.wave_rate);
            out.dissipated_power += (load - elastic) * rate;
            if load == 0.0 {
                continue;
            }
            load_sum += load;
            load_cos += load * ca;
            let by_deflection = 1.5 * self.contacts.stiffness * root + self.damping * weight_slope * rate;
            let by_rate = self.damping * weight;
            let turn = t.iter().zip(v).map(|(a, b)| a * b).sum::<f64>() / ball.distance
                + rotation.cage_speed * alpha_psi;
            let g_psi = [-ca * sin, ca * cos, 0.0, sa * r * cos, sa * r * sin];
            let bend = load / ball.distance;
            for a in 0..5 {
                out.force[a] -= load * g[a];
                for b in 0..5 {
                    let rate_by_d = turn * t[b] + rotation.cage_speed * g_psi[b];
                    out.stiffness[a][b] +=
                        by_deflection * g[a] * g[b] + bend * t[a] * t[b] + by_rate * g[a] * rate_by_d;
                    out.damping[a][b] += by_rate * g[a] * g[b];
                }
            }
        }
        out.mean_cos = if load_sum > 0.0 { load_cos / load_sum } else { self.nominal_cos };
        out
    }

    /// Elastic force and stiffness averaged over one ball pitch of cage angles at fixed ring displacement.
    ///
    /// f̄(d) = (1/N) Σ_k f(d, ψ₀ + (2π/Z) k/N); the average is a potential force, so its tangent is symmetric.
    /// Waviness is left out: it averages to zero over a turn.
    pub fn cage_average(&self, d: &[f64; 6], rotation: &Rotation, angles: usize) -> Reaction {
        let pitch = std::f64::consts::TAU / self.spacing.len() as f64;
        let mut out = Reaction::default();
        for k in 0..angles {
            let at =
                Rotation { cage_angle: rotation.cage_angle + pitch * k as f64 / angles as f64, ..*rotation };
            out.add(&self.sum(d, &[0.0; 6], &at, false), 1.0 / angles as f64);
        }
        out
    }

    /// Load, contact angle and approach of every ball under elastic forces alone.
    pub fn ball_loads(&self, d: &[f64; 6], rotation: &Rotation) -> Vec<BallLoad> {
        let cage = [rotation.cage_angle.cos(), rotation.cage_angle.sin()];
        (0..self.spacing.len())
            .map(|j| {
                let ball = self.ball(j, d, rotation, cage, true);
                let squeezed = ball.deflection.max(0.0);
                BallLoad {
                    position: ball.sin.atan2(ball.cos),
                    load: self.contacts.stiffness * squeezed * squeezed.sqrt(),
                    contact_angle: ball.sa.atan2(ball.ca),
                    deflection: ball.deflection,
                }
            })
            .collect()
    }
}

/// Smooth start of the contact damping: 0 at δ = 0, 1 from `length` on, C¹; returns value and slope.
fn ramp(deflection: f64, length: f64) -> (f64, f64) {
    if deflection >= length {
        return (1.0, 0.0);
    }
    let x = deflection / length;
    (x * x * (3.0 - 2.0 * x), 6.0 * x * (1.0 - x) / length)
}

/// Waviness of a race as cosine and sine coefficients by order, summed by a rotation recurrence.
#[derive(Clone, Debug, Default)]
struct Waviness {
    /// (Re, Im) of a e^{iϕ₀} for orders 0, 1, 2, ...
    coefficients: Vec<[f64; 2]>,
}

impl Waviness {
    fn new(waves: &[Wave]) -> Self {
        let highest = waves.iter().map(|w| w.order as usize + 1).max().unwrap_or(0);
        let mut coefficients = vec![[0.0; 2]; highest];
        for wave in waves {
            coefficients[wave.order as usize][0] += wave.amplitude * wave.phase.cos();
            coefficients[wave.order as usize][1] += wave.amplitude * wave.phase.sin();
        }
        Self { coefficients }
    }

    fn is_empty(&self) -> bool {
        self.coefficients.is_empty()
    }

    /// Deviation Σ a cos(n φ + ϕ₀) and its slope with φ, from cos φ and sin φ.
    fn at(&self, cos: f64, sin: f64) -> (f64, f64) {
        let (mut c, mut s) = (1.0, 0.0);
        let (mut value, mut slope) = (0.0, 0.0);
        for (n, [re, im]) in self.coefficients.iter().enumerate() {
            value += re * c - im * s;
            slope -= n as f64 * (re * s + im * c);
            (c, s) = (c * cos - s * sin, s * cos + c * sin);
        }
        (value, slope)
    }
}

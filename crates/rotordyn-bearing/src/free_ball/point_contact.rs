//! Contact with slip at one point: cage pockets and lands, balls that touch each other.

use super::input::PointContactLaw;
use super::ring::V;

/// Relation of load and approach.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LoadLaw {
    /// Q = K δ^{3/2}.
    Hertz,
    /// Q = k δ.
    Linear,
}

/// Two bodies that touch.
#[derive(Clone, Copy, Debug)]
pub(super) struct PointContact {
    /// Unit vector along the force on the first body.
    pub normal: V,
    /// Approach δ > 0 \[m\].
    pub depth: f64,
    /// Velocity of the first body against the second at the contact \[m/s\].
    pub velocity: V,
}

/// Force of a contact, power and stiffness.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct PointForce {
    /// Force on the first body \[N\].
    pub force: V,
    /// Elastic energy \[J\].
    pub energy: f64,
    /// Power lost by friction and damping \[W\].
    pub power: f64,
    /// Slopes dQ/dδ \[N/m\], dQ/dδ̇ \[N s/m\], and friction over slip \[N s/m\].
    pub slopes: [f64; 3],
}

impl PointContact {
    /// Q = K δⁿ (1 + χ δ̇) ≥ 0 and friction −μ Q v/√(v² + v₀²).
    #[inline(always)]
    pub fn react(&self, law: &PointContactLaw, load_law: LoadLaw) -> PointForce {
        let Self { normal, depth, velocity } = self;
        let (elastic, slope, energy) = match load_law {
            LoadLaw::Hertz => {
                let q = law.stiffness * depth.sqrt() * depth;
                (q, 1.5 * q / depth, 0.4 * q * depth)
            }
            LoadLaw::Linear => {
                let q = law.stiffness * depth;
                (q, law.stiffness, 0.5 * q * depth)
            }
        };
        let rate = -normal.dot(velocity);
        let damping = law.damping * elastic;
        let load = (elastic + damping * rate).max(0.0);
        let slip = velocity + rate * normal;
        let friction = law.friction.friction * load
            / (slip.norm_squared() + law.friction.slip_speed * law.friction.slip_speed).sqrt();
        PointForce {
            force: load * normal - friction * slip,
            energy,
            power: friction * slip.norm_squared() + (load - elastic) * rate,
            slopes: [slope, damping, friction],
        }
    }
}

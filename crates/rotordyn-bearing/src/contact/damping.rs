//! Contact damping of balls: constant, Hunt-Crossley, lubricant film.

use super::{ContactLoad, SpeedContacts};
use serde::{Deserialize, Serialize};

/// Damping law: force against the approach rate of the races along a ball's contact line.
///
/// With Q_e the elastic load of both contacts in series at the approach δ, the ball carries
/// Q = max(0, Q_e + F_d(δ, δ̇)): no tensile force. F_d = 0 where Q_e = 0.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum ContactDamping {
    /// F_d = c w(δ) δ̇ with a constant c \[N s/m\]; w rises smoothly from 0 where load begins to 1 over `ramp` \[m\].
    Constant { coefficient: f64, ramp: f64 },
    /// F_d = χ Q_e δ̇ with χ \[s/m\] (Hunt & Crossley 1975).
    HuntCrossley { factor: f64 },
    /// F_d = β (b/u) K_f (1 − K_f/K_e) δ̇ of the film, with a relaxation factor β \[-\] of order one.
    ///
    /// A film forms at the inlet and is convected through the contact at the entrainment speed u, so that its
    /// thickness follows the load with a time lag: τ ḣ = h(Q) − h, τ = β b/u with b the semi-axis along
    /// rolling. A fast approach sees the elastic stiffness K_e = (3/2) K √s, a slow one the lower K_f = dQ/dδ
    /// of contact and film; the damping is the first order in τ. Two contacts in series: τ is their mean,
    /// weighted by film thickness. Valid for frequencies well below u/b; zero without a film.
    ///
    /// Source: derived from the film law, instead of the curve fits to transient numerical solutions of
    /// Wijnant 1998 and of Nonato & Cavalca 2014, which are limited to the contacts they were fitted for.
    Film { factor: f64 },
}

/// Load of a damped contact and its derivatives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Damped {
    /// Q \[N\], never negative.
    pub load: f64,
    /// ∂Q/∂δ at fixed δ̇ \[N/m\].
    pub by_approach: f64,
    /// ∂Q/∂δ̇ \[N s/m\].
    pub by_rate: f64,
}

impl ContactDamping {
    /// Load of both contacts in series with damping; `elastic`: result of [`SpeedContacts::series`] at the
    /// approach δ \[m\]; `rate`: approach rate δ̇ \[m/s\].
    #[inline(always)]
    pub fn apply(&self, contacts: &SpeedContacts, elastic: &ContactLoad, approach: f64, rate: f64) -> Damped {
        if elastic.load <= 0.0 {
            return Damped::default();
        }
        let (coefficient, slope) = match *self {
            Self::Constant { coefficient, ramp } => {
                let (weight, slope) = smoothstep(approach - contacts.onset(), ramp);
                (coefficient * weight, coefficient * slope)
            }
            Self::HuntCrossley { factor } => (factor * elastic.load, factor * elastic.slope),
            Self::Film { factor } => {
                let (value, slope) = contacts.film_damping(elastic);
                (factor * value, factor * slope)
            }
        };
        let load = elastic.load + coefficient * rate;
        if load <= 0.0 {
            return Damped::default();
        }
        Damped { load, by_approach: elastic.slope + slope * rate, by_rate: coefficient }
    }
}

/// Smoothstep from 0 at x = 0 to 1 at `length`, C¹; returns value and slope.
fn smoothstep(x: f64, length: f64) -> (f64, f64) {
    if x >= length {
        return (1.0, 0.0);
    }
    let t = x / length;
    (t * t * (3.0 - 2.0 * t), 6.0 * t * (1.0 - t) / length)
}

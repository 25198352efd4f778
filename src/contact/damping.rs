//! Damping of a ball's contacts.

/// Force that resists the approach of the races along a ball's line of contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ContactDamping {
    /// Constant c \[N s/m\], ramping in smoothly over the deflection `ramp` \[m\].
    Constant { coefficient: f64, ramp: f64 },
    /// Q_e (1 + χ δ̇) with χ \[s/m\] (Hunt & Crossley 1975).
    HuntCrossley { factor: f64 },
}

//! Kinds of the data of a fit, and the misfit of each.

use super::chi_squared::upper_probability;

/// Kind of a datum; each kind has its own standard deviations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DataKind {
    Frequency,
    Damping,
    Shape,
    Frf,
}

impl DataKind {
    pub const COUNT: usize = 4;
    pub const ALL: [Self; Self::COUNT] = [Self::Frequency, Self::Damping, Self::Shape, Self::Frf];

    /// Label.
    pub fn label(self) -> &'static str {
        match self {
            DataKind::Frequency => "frequencies",
            DataKind::Damping => "damping ratios",
            DataKind::Shape => "shapes",
            DataKind::Frf => "FRFs",
        }
    }
}

/// χ² of the data of one kind: large standard deviations of another kind do not hide its misfit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KindFit {
    pub kind: DataKind,
    /// Effective number of data.
    pub data: f64,
    /// |r|² of its data over their standard deviations.
    pub chi_squared: f64,
    /// ν: data minus the parameters that they determine, tr J (JᵀJ + P)⁻¹ Jᵀ over its rows.
    pub degrees_of_freedom: f64,
}

impl KindFit {
    /// Whether there are degrees of freedom enough to judge the kind by itself.
    pub fn is_tested(&self) -> bool {
        self.degrees_of_freedom >= 1.0
    }

    /// Probability of a larger χ² if the model is right and the standard deviations are those of the data.
    pub fn probability(&self) -> f64 {
        upper_probability(self.chi_squared, self.degrees_of_freedom.max(1.0))
    }
}

//! Load of a contact over its approach.

use serde::{Deserialize, Serialize};

/// One race.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Race {
    Inner,
    Outer,
}

/// Load of a contact or of a pair of contacts at an approach.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactLoad {
    /// Q \[N\], never negative.
    pub load: f64,
    /// dQ/dδ \[N/m\].
    pub slope: f64,
    /// ∫ Q dδ \[J\].
    pub energy: f64,
}

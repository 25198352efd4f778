//! A lubricated contact under load, and its grid.

use crate::contact::{EllipticContact, Lubricant};

/// A lubricated contact under load, and its grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    pub contact: EllipticContact,
    pub lubricant: Lubricant,
    /// Entrainment speed u, mean of both surface speeds \[m/s\].
    pub speed: f64,
    /// Load Q \[N\].
    pub load: f64,
    pub grid: Grid,
}

/// Regular grid over a domain; only the half on one side of the line of symmetry is solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// Nodes along rolling.
    pub nx: usize,
    /// Nodes across the whole domain, odd: (ny + 1)/2 rows are solved.
    pub ny: usize,
    pub domain: Domain,
}

/// Extent of the computed film in semi-axes of the dry ellipse, from its centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Domain {
    /// Upstream, in semi-axes along rolling.
    pub inlet: f64,
    /// Downstream, in semi-axes along rolling.
    pub outlet: f64,
    /// To either side, in semi-axes across.
    pub side: f64,
}

impl Grid {
    /// Number of solved rows: half the domain including the line of symmetry.
    pub(super) fn rows(&self) -> usize {
        self.ny.div_ceil(2)
    }

    /// Grid with half as many intervals in both directions over the same domain.
    pub(super) fn coarser(&self) -> Self {
        Self { nx: (self.nx - 1) / 2 + 1, ny: 2 * (self.rows().saturating_sub(1) / 2) + 1, ..*self }
    }
}

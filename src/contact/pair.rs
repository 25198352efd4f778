//! The two contacts of one ball under a bearing's contact law, at one entrainment speed.

use super::{ContactLaw, HertzPair};

/// One race.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Race {
    Inner,
    Outer,
}

/// Load of a contact or of a pair of contacts at an approach.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Loaded {
    /// Q \[N\], never negative.
    pub load: f64,
    /// dQ/dδ \[N/m\].
    pub slope: f64,
    /// ∫ Q dδ \[J\].
    pub energy: f64,
}

/// A ball's contacts under a law, before a speed is known.
#[derive(Clone, Debug, PartialEq)]
pub struct BallContacts {
    pub hertz: HertzPair,
    law: ContactLaw,
}

/// A ball's contacts at one entrainment speed, ready to be evaluated for every ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpeedContacts<'a> {
    Hertz(&'a HertzPair),
}

impl BallContacts {
    /// Contacts of a ball between grooves under a law.
    pub fn new(hertz: HertzPair, law: ContactLaw) -> Self {
        Self { hertz, law }
    }

    /// The contacts at an entrainment speed u ≥ 0 \[m/s\], before the law's speed factor.
    pub fn at_speed(&self, _speed: f64) -> SpeedContacts<'_> {
        SpeedContacts::Hertz(&self.hertz)
    }
}

impl SpeedContacts<'_> {
    /// Both contacts in series under the same load (massless ball) at the total approach δ of the races \[m\].
    ///
    /// Limits: Q = 0 and slope 0 where the law says unloaded; Q and dQ/dδ continuous everywhere.
    pub fn series(&self, approach: f64) -> Loaded {
        match self {
            Self::Hertz(pair) => pair.series(approach),
        }
    }

    /// One contact alone at its own approach \[m\].
    pub fn single(&self, race: Race, approach: f64) -> Loaded {
        match self {
            Self::Hertz(pair) => pair.single(race, approach),
        }
    }

    /// Central film thickness of a contact under a load \[m\]; 0 for a dry law.
    pub fn film(&self, _race: Race, _load: f64) -> f64 {
        0.0
    }
}

impl HertzPair {
    /// Both contacts in series at the total approach: Q = K δ^{3/2}.
    #[inline]
    pub fn series(&self, approach: f64) -> Loaded {
        hertz(self.stiffness, approach)
    }

    /// One contact alone.
    #[inline]
    pub fn single(&self, race: Race, approach: f64) -> Loaded {
        match race {
            Race::Inner => hertz(self.inner.stiffness, approach),
            Race::Outer => hertz(self.outer.stiffness, approach),
        }
    }
}

#[inline]
fn hertz(stiffness: f64, approach: f64) -> Loaded {
    if approach <= 0.0 {
        return Loaded::default();
    }
    let root = stiffness * approach.sqrt();
    let load = root * approach;
    Loaded { load, slope: 1.5 * root, energy: 0.4 * load * approach }
}

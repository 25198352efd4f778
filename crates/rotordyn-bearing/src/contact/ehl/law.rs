//! EHL film as the contact law of a ball.

use super::{Curve, Table, TableSpec, geometric};
use crate::contact::{ContactLoad, HertzPair, Lubricant, Race};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// EHL contact law of a ball: specification of the film tables, and the tables once computed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EhlLaw {
    pub lubricant: Lubricant,
    /// Factor on the entrainment speed.
    pub speed_factor: f64,
    /// Load range of the tables \[N\].
    pub loads: [f64; 2],
    /// Entrainment speed range of the tables \[m/s\], the factor included.
    pub speeds: [f64; 2],
    /// Number of loads and of speeds.
    pub counts: [usize; 2],
    /// Grid resolution, see [`super::Grid::flooded`].
    pub points: usize,
    /// Inner and outer contact; `None` until they are computed.
    pub tables: Option<Arc<[Table; 2]>>,
}

/// A ball's contacts at one speed: in series and each alone.
#[derive(Clone, Debug, PartialEq)]
pub struct EhlPair {
    pub(in crate::contact) series: Curve,
    inner: Curve,
    outer: Curve,
}

impl EhlLaw {
    /// Specifications of the tables of inner and outer contact.
    pub fn specs(&self, hertz: &HertzPair) -> [TableSpec; 2] {
        let [loads, speeds] = [(self.loads, self.counts[0]), (self.speeds, self.counts[1])]
            .map(|([first, last], count)| geometric(first, last, count));
        [hertz.inner, hertz.outer].map(|contact| TableSpec {
            contact,
            lubricant: self.lubricant.clone(),
            loads: loads.clone(),
            speeds: speeds.clone(),
            points: self.points,
        })
    }

    /// The contacts at an entrainment speed u > 0 \[m/s\], the factor included.
    pub(in crate::contact) fn at_speed(&self, tables: &[Table; 2], speed: f64) -> EhlPair {
        let [inner, outer] = [tables[0].at_speed(speed), tables[1].at_speed(speed)];
        EhlPair { series: inner.in_series(&outer), inner, outer }
    }
}

impl EhlPair {
    fn of(&self, race: Race) -> &Curve {
        match race {
            Race::Inner => &self.inner,
            Race::Outer => &self.outer,
        }
    }

    pub(in crate::contact) fn single(&self, race: Race, approach: f64) -> ContactLoad {
        self.of(race).load(approach)
    }

    pub(in crate::contact) fn film(&self, race: Race, load: f64) -> f64 {
        self.of(race).central_film(load)
    }

    pub(in crate::contact) fn minimum_film(&self, race: Race, load: f64) -> f64 {
        self.of(race).minimum_film(load)
    }
}

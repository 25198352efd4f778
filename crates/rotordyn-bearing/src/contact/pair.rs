//! The two contacts of one ball (inner and outer race) under a contact law, at one entrainment speed.

use super::ehl::{EhlLaw, EhlPair};
use super::film::FilmSpeedScaling;
pub use super::load::{ContactLoad, Race};
use super::{ContactLaw, EllipticContact, FilmFormula, FilmSpring, HertzPair, Lubricant, PowerSpring};

/// A ball's contacts under a contact law, speed-independent part.
#[derive(Clone, Debug, PartialEq)]
pub struct BallContacts {
    pub hertz: HertzPair,
    law: Law,
}

/// Speed-independent data of a contact law.
#[derive(Clone, Debug, PartialEq)]
enum Law {
    Hertz,
    Film { unit: FilmPair, speed_factor: f64 },
    Power(PowerSpring),
    Ehl(Box<EhlLaw>),
}

/// A ball's contacts at one entrainment speed, prepared for evaluation.
#[derive(Clone, Debug, PartialEq)]
pub enum SpeedContacts<'a> {
    Hertz(&'a HertzPair),
    Film(FilmPair),
    /// Power law of both contacts in series; a single contact takes its share of the dry compliance.
    Power {
        pair: &'a HertzPair,
        spring: &'a PowerSpring,
    },
    Ehl(Box<EhlPair>),
}

/// Film springs of a ball's two contacts, in series and each alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmPair {
    series: FilmSpring,
    inner: FilmSpring,
    outer: FilmSpring,
    formulas: [FilmFormula; 2],
    /// Entrainment speed \[m/s\], the law's factor included.
    speed: f64,
}

impl FilmPair {
    /// Springs at u = 1 m/s.
    fn new(pair: &HertzPair, lubricant: &Lubricant) -> Self {
        let (inner, outer) = (&pair.inner, &pair.outer);
        let formulas = [FilmFormula::new(inner, lubricant), FilmFormula::new(outer, lubricant)];
        Self {
            series: FilmSpring::new(&[(inner, &formulas[0]), (outer, &formulas[1])], pair.stiffness),
            inner: FilmSpring::new(&[(inner, &formulas[0])], inner.stiffness),
            outer: FilmSpring::new(&[(outer, &formulas[1])], outer.stiffness),
            formulas,
            speed: 1.0,
        }
    }

    fn at_speed(&self, speed: f64) -> Self {
        let growth = FilmSpeedScaling::new(speed);
        Self {
            series: self.series.scaled(&growth),
            inner: self.inner.scaled(&growth),
            outer: self.outer.scaled(&growth),
            formulas: self.formulas,
            speed,
        }
    }

    fn of(&self, race: Race) -> (&FilmSpring, &FilmFormula) {
        match race {
            Race::Inner => (&self.inner, &self.formulas[0]),
            Race::Outer => (&self.outer, &self.formulas[1]),
        }
    }
}

impl BallContacts {
    /// Contacts of a ball between grooves under a law.
    ///
    /// An EHL film whose tables are not yet computed is replaced by the film formula.
    pub fn new(hertz: HertzPair, law: ContactLaw) -> Self {
        let law = match law {
            ContactLaw::Hertz => Law::Hertz,
            ContactLaw::PowerLaw(law) => Law::Power(PowerSpring::new(law)),
            ContactLaw::Ehl(law) if law.tables.is_some() => Law::Ehl(Box::new(law)),
            ContactLaw::Ehl(EhlLaw { lubricant, speed_factor, .. })
            | ContactLaw::Film { lubricant, speed_factor } => {
                Law::Film { unit: FilmPair::new(&hertz, &lubricant), speed_factor }
            }
        };
        Self { hertz, law }
    }

    /// The contacts at an entrainment speed u ≥ 0 \[m/s\], before the law's speed factor; dry at u = 0.
    pub fn at_speed(&self, speed: f64) -> SpeedContacts<'_> {
        match &self.law {
            Law::Film { unit, speed_factor } => {
                let films = unit.at_speed(speed * speed_factor);
                if films.series.exists() {
                    SpeedContacts::Film(films)
                } else {
                    SpeedContacts::Hertz(&self.hertz)
                }
            }
            Law::Hertz => SpeedContacts::Hertz(&self.hertz),
            Law::Power(spring) => SpeedContacts::Power { pair: &self.hertz, spring },
            Law::Ehl(law) => match &law.tables {
                Some(tables) if speed > 0.0 => {
                    let pair = law.at_speed(tables, speed * law.speed_factor);
                    SpeedContacts::Ehl(Box::new(pair))
                }
                _ => SpeedContacts::Hertz(&self.hertz),
            },
        }
    }
}

impl SpeedContacts<'_> {
    /// Whether there is no film.
    pub fn is_dry(&self) -> bool {
        matches!(self, Self::Hertz(_) | Self::Power { .. })
    }

    /// Both contacts in series under the same load (massless ball) at the total approach δ of the races \[m\].
    ///
    /// Limits: Q = 0 and slope 0 where unloaded; Q and dQ/dδ continuous everywhere.
    pub fn series(&self, approach: f64) -> ContactLoad {
        match self {
            Self::Hertz(pair) => pair.series(approach),
            Self::Film(films) => films.series.load(approach),
            Self::Power { spring, .. } => spring.load(approach),
            Self::Ehl(pair) => pair.series.load(approach),
        }
    }

    /// One contact alone at its own approach \[m\].
    pub fn single(&self, race: Race, approach: f64) -> ContactLoad {
        match self {
            Self::Hertz(pair) => pair.single(race, approach),
            Self::Film(films) => films.of(race).0.load(approach),
            Self::Power { pair, spring } => {
                let share = (pair.stiffness / pair.of(race).stiffness).powf(2.0 / 3.0);
                let both = spring.load(approach / share);
                ContactLoad { load: both.load, slope: both.slope / share, energy: both.energy * share }
            }
            Self::Ehl(pair) => pair.single(race, approach),
        }
    }

    /// Central film thickness of a contact under a load Q ≥ 0 \[m\]; 0 for a dry law.
    pub fn film(&self, race: Race, load: f64) -> f64 {
        match self {
            Self::Hertz(_) | Self::Power { .. } => 0.0,
            Self::Film(films) => films.of(race).0.film(load),
            Self::Ehl(pair) => pair.film(race, load),
        }
    }

    /// Minimum film thickness of a contact under a load Q > 0 \[m\]; 0 for a dry law.
    pub fn minimum_film(&self, race: Race, load: f64) -> f64 {
        match self {
            Self::Hertz(_) | Self::Power { .. } => 0.0,
            Self::Film(films) => films.of(race).1.minimum(films.speed, load.max(FilmSpring::THRESHOLD)),
            Self::Ehl(pair) => pair.minimum_film(race, load),
        }
    }

    /// Total approach \[m\] above which both contacts in series carry load: 0 for a dry law, −h₀ with a film.
    #[inline]
    pub fn onset(&self) -> f64 {
        match self {
            Self::Hertz(_) => 0.0,
            Self::Film(films) => -films.series.zero_load_film(),
            Self::Power { spring, .. } => spring.onset(),
            Self::Ehl(pair) => -pair.series.zero_load_film(),
        }
    }

    /// Whether a ball's load \[N\] is outside the fitted range of the law.
    pub fn is_outside_range(&self, load: f64) -> bool {
        match self {
            Self::Hertz(_) | Self::Film(_) | Self::Ehl(_) => false,
            Self::Power { spring, .. } => spring.law.is_outside_range(load),
        }
    }

    /// Film damping coefficient of both contacts in series per unit of relaxation factor \[N s/m\] and its
    /// slope with δ: (b/u) K_f (1 − K_f/K_e), see [`super::ContactDamping::Film`]; 0 for a dry law.
    pub(super) fn film_damping(&self, elastic: &ContactLoad) -> (f64, f64) {
        match self {
            Self::Hertz(_) | Self::Power { .. } | Self::Ehl(_) => (0.0, 0.0),
            Self::Film(films) => {
                let (value, slope) = films.series.film_damping(elastic);
                (value / films.speed, slope / films.speed)
            }
        }
    }
}

impl HertzPair {
    /// Both contacts in series at the total approach: Q = K δ^{3/2}.
    #[inline]
    pub fn series(&self, approach: f64) -> ContactLoad {
        hertz(self.stiffness, approach)
    }

    /// One contact alone.
    #[inline]
    pub fn single(&self, race: Race, approach: f64) -> ContactLoad {
        hertz(self.of(race).stiffness, approach)
    }

    /// The contact of a race.
    #[inline]
    pub fn of(&self, race: Race) -> &EllipticContact {
        match race {
            Race::Inner => &self.inner,
            Race::Outer => &self.outer,
        }
    }
}

#[inline]
fn hertz(stiffness: f64, approach: f64) -> ContactLoad {
    if approach <= 0.0 {
        return ContactLoad::default();
    }
    let root = stiffness * approach.sqrt();
    let load = root * approach;
    ContactLoad { load, slope: 1.5 * root, energy: 0.4 * load * approach }
}

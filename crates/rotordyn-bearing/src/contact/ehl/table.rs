//! Film table of one EHL contact over load and speed.

use super::similarity::{MIN_SOLVED_FILM, SPEED_POWER, SimilarContact};
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::curve::Curve;
use super::{EhlError, Grid, Problem, Solution, extrapolate};
use crate::contact::{EllipticContact, FilmFormula, Lubricant};
use rotordyn_linalg::pchip::Pchip;

/// Input of a [`Table`].
#[derive(Clone, Debug, PartialEq)]
pub struct TableSpec {
    pub contact: EllipticContact,
    pub lubricant: Lubricant,
    /// Loads Q, increasing \[N\].
    pub loads: Vec<f64>,
    /// Entrainment speeds u, increasing \[m/s\].
    pub speeds: Vec<f64>,
    /// Grid resolution as in [`Grid::flooded`]. With [`DEFAULT_POINTS`] contacts similar to stored ones are
    /// interpolated (see [`super::similarity`]); with any other every contact is solved.
    pub points: usize,
}

/// Grid resolution by default: central film and shift to about 0.2 %, minimum film to 1 %.
pub const DEFAULT_POINTS: usize = 6;

/// Films of one contact of a table.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Films {
    /// δ_dry − δ \[m\].
    pub shift: f64,
    /// h_c \[m\].
    pub central: f64,
    /// h_min \[m\].
    pub minimum: f64,
}

/// Where solved contacts are kept, so that an interrupted table continues where it was.
pub trait SolvedContacts: Sync {
    /// Films of a contact with this key, if it is known.
    fn find(&self, key: &str) -> Option<Films>;
    /// Keeps the films of a contact that has just been solved.
    fn keep(&self, key: &str, films: &Films);
}

/// Keeps nothing.
impl SolvedContacts for () {
    fn find(&self, _: &str) -> Option<Films> {
        None
    }
    fn keep(&self, _: &str, _: &Films) {}
}

/// Film shift δ_dry − δ, central and minimum film at every load and speed of a [`TableSpec`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Table {
    /// All inputs as text (cache key): equal keys, equal tables.
    pub key: String,
    /// Dry stiffness K in Q = K δ^{3/2} \[N/m^1.5\].
    pub stiffness: f64,
    pub loads: Vec<f64>,
    pub speeds: Vec<f64>,
    /// δ_dry − δ \[m\], one row of loads for each speed.
    pub shift: Vec<Vec<f64>>,
    /// Central film h_c \[m\], one row of loads for each speed.
    pub central_film: Vec<Vec<f64>>,
    /// Minimum film h_min \[m\], one row of loads for each speed.
    pub minimum_film: Vec<Vec<f64>>,
}

/// `count` ≥ 2 values in geometric progression from `first` to `last`.
pub fn geometric(first: f64, last: f64, count: usize) -> Vec<f64> {
    let ratio = last / first;
    (0..count).map(|k| first * ratio.powf(k as f64 / (count.max(2) - 1) as f64)).collect()
}

impl TableSpec {
    /// Cache key: text of all inputs, the same on every machine.
    pub fn key(&self) -> String {
        let Self { loads, speeds, .. } = self;
        format!("ehl table 5; {}; Q {loads:?} N; u {speeds:?} m/s", self.contact_text())
    }

    /// Cache key of one contact.
    fn contact_key(&self, load: f64, speed: f64) -> String {
        format!("ehl contact 5; {}; Q {load:?} N; u {speed:?} m/s", self.contact_text())
    }

    /// Cache keys of all contacts.
    pub fn contact_keys(&self) -> impl Iterator<Item = String> {
        let speeds = self.speeds.iter();
        speeds.flat_map(move |&speed| self.loads.iter().map(move |&load| self.contact_key(load, speed)))
    }

    fn contact_text(&self) -> String {
        let Self { contact, lubricant, points, .. } = self;
        format!(
            "Rx {:e} m; Ry {:e} m; E* {:e} Pa; eta {:e} Pa s; alpha {:e} 1/Pa; points {points}",
            contact.rolling_radius,
            contact.transverse_radius,
            contact.modulus,
            lubricant.viscosity,
            lubricant.pressure_viscosity,
        )
    }

    /// Solves the contact at every load and speed, on two grids each, extrapolated to zero mesh width.
    ///
    /// Speeds in parallel, each in order of decreasing load; the result does not depend on the number of
    /// threads. `progress(done, total)` is called after every contact, from any thread.
    ///
    /// # Errors
    /// [`EhlError::Input`] for loads or speeds that are not positive and increasing; else the first contact in
    /// table order that does not converge.
    pub fn compute(&self, progress: impl Fn(usize, usize) + Sync) -> Result<Table, EhlError> {
        self.compute_with(&(), progress)
    }

    /// As [`TableSpec::compute`], with solved contacts taken from `known` and kept there one by one.
    ///
    /// # Errors
    /// As [`TableSpec::compute`]; contacts solved before the error are kept.
    pub fn compute_with(
        &self,
        known: &impl SolvedContacts,
        progress: impl Fn(usize, usize) + Sync,
    ) -> Result<Table, EhlError> {
        for (quantity, values) in [("first load", &self.loads), ("first entrainment speed", &self.speeds)] {
            let increasing = values.windows(2).all(|pair| pair[0] < pair[1]);
            let value = values.first().copied().unwrap_or(f64::NAN);
            if !(increasing && value > 0.0) {
                return Err(EhlError::Input {
                    quantity,
                    range: "positive, with increasing values after it",
                    value,
                });
            }
        }
        let done = AtomicUsize::new(0);
        let total = self.loads.len() * self.speeds.len();
        let count = || progress(done.fetch_add(1, Ordering::Relaxed) + 1, total);
        let rows: Vec<Result<Vec<Films>, EhlError>> =
            self.speeds.par_iter().map(|&speed| self.row(speed, known, &count)).collect();
        let rows = rows.into_iter().collect::<Result<Vec<_>, _>>()?;
        let figure =
            |film: fn(&Films) -> f64| rows.iter().map(|row| row.iter().map(film).collect()).collect();
        Ok(Table {
            key: self.key(),
            stiffness: self.contact.stiffness,
            loads: self.loads.clone(),
            speeds: self.speeds.clone(),
            shift: figure(|films| films.shift),
            central_film: figure(|films| films.central),
            minimum_film: figure(|films| films.minimum),
        })
    }

    /// Films at all loads and one speed, each solved contact started from the next higher load.
    fn row(
        &self,
        speed: f64,
        known: &impl SolvedContacts,
        count: &impl Fn(),
    ) -> Result<Vec<Films>, EhlError> {
        let mut near: Option<Solution> = None;
        let mut row = Vec::with_capacity(self.loads.len());
        for &load in self.loads.iter().rev() {
            let films = match self.similar(speed, load) {
                Some(films) => films,
                None => {
                    let key = self.contact_key(load, speed);
                    match known.find(&key) {
                        Some(films) => films,
                        None => {
                            let films = self.solve(speed, load, &mut near)?;
                            known.keep(&key, &films);
                            films
                        }
                    }
                }
            };
            row.push(films);
            count();
        }
        row.reverse();
        Ok(row)
    }

    /// Similarity parameters of a contact at its speed or, for a thinner film, at the speed of
    /// [`MIN_SOLVED_FILM`]; and the ratio of the film after Hamrock and Dowson to that at this speed.
    fn scaled(&self, speed: f64, load: f64) -> (SimilarContact, f64) {
        let similar = SimilarContact::new(&self.contact, &self.lubricant, speed, load);
        let share = (similar.film / MIN_SOLVED_FILM).min(1.0);
        (SimilarContact { film: similar.film / share, ..similar }, share)
    }

    /// Films interpolated between stored contacts.
    fn similar(&self, speed: f64, load: f64) -> Option<Films> {
        if self.points != DEFAULT_POINTS {
            return None;
        }
        let (similar, share) = self.scaled(speed, load);
        let ratios = similar.films()?;
        let unit = FilmFormula::new(&self.contact, &self.lubricant).central(speed, load) / share;
        let films = Films {
            shift: unit * ratios.shift,
            central: unit * ratios.central,
            minimum: unit * ratios.minimum,
        };
        Some(films.thinner(share, ratios.powers))
    }

    /// Films of a contact solved on two grids.
    fn solve(&self, speed: f64, load: f64, near: &mut Option<Solution>) -> Result<Films, EhlError> {
        let Self { contact, lubricant, points, .. } = self;
        let (similar, share) = self.scaled(speed, load);
        let speed = speed * share.powf(-1.0 / SPEED_POWER);
        let grid = Grid::flooded(contact, lubricant, speed, load, *points);
        let problem = Problem { contact: *contact, lubricant: lubricant.clone(), speed, load, grid };
        let found = extrapolate(&problem, near.as_ref())?;
        let films =
            Films { shift: found.film_shift(), central: found.central_film, minimum: found.minimum_film };
        *near = Some(found.fine);
        Ok(films.thinner(share, similar.nearest_powers()))
    }
}

impl Films {
    /// Films at a speed at which Hamrock and Dowson's film is `share` ≤ 1 of that here, by their powers of it.
    fn thinner(self, share: f64, [shift, central, minimum]: [f64; 3]) -> Self {
        Self {
            shift: self.shift * share.powf(shift),
            central: self.central * share.powf(central),
            minimum: self.minimum * share.powf(minimum),
        }
    }
}

impl Table {
    /// The contact law at an entrainment speed u \[m/s\]: dry for u ≤ 0.
    ///
    /// Between the speeds ln h_c, ln h_min and ln s are monotone cubics (PCHIP) of ln u; below the lowest and above the
    /// highest speed powers of u (with a single speed u^0.67, Hamrock and Dowson's), so that all vanish with
    /// u.
    pub fn at_speed(&self, speed: f64) -> Curve {
        if speed <= 0.0 {
            return Curve::dry(self.stiffness);
        }
        let logs: Vec<f64> = self.speeds.iter().map(|u| u.ln()).collect();
        let at = |rows: &[Vec<f64>]| -> Vec<f64> {
            (0..self.loads.len())
                .map(|k| {
                    let values: Vec<f64> = rows.iter().map(|row| row[k].ln()).collect();
                    let single =
                        values.first().map_or(f64::NAN, |v| v + SPEED_POWER * (speed.ln() - logs[0]));
                    match Pchip::new(&logs, &values) {
                        Some(curve) if logs.len() > 1 => curve.evaluate(speed.ln())[0],
                        _ => single,
                    }
                })
                .collect()
        };
        let films = [at(&self.shift), at(&self.central_film), at(&self.minimum_film)];
        Curve::new(self.stiffness, &self.loads, films.each_ref().map(Vec::as_slice))
    }
}

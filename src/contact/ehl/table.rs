//! Film table of one EHL contact over load and speed.

use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::curve::Curve;
use super::{EhlError, Grid, Problem, Solution, extrapolate};
use crate::contact::{EllipticContact, FilmFormula, Lubricant};
use crate::linalg::pchip::Pchip;

/// Input of a [`Table`].
#[derive(Clone, Debug, PartialEq)]
pub struct TableSpec {
    pub contact: EllipticContact,
    pub lubricant: Lubricant,
    /// Loads Q, increasing \[N\].
    pub loads: Vec<f64>,
    /// Entrainment speeds u, increasing \[m/s\].
    pub speeds: Vec<f64>,
    /// Grid resolution as in [`Grid::flooded`]; 6 gives the film to about 1 %.
    pub points: usize,
}

/// Film shift δ_dry − δ and central film at every load and speed of a [`TableSpec`].
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
}

/// Smallest h R_x/b_x² (Hamrock and Dowson's h) that is solved: a thinner film is scaled from the speed at
/// which it has this thickness, by their speed exponent. Such a film changes the approach by 5 % or less,
/// known to a tenth of that.
const MIN_SOLVED_FILM: f64 = 0.05;

/// Exponent of the speed in Hamrock and Dowson's central film.
const SPEED_POWER: f64 = 0.67;

/// `count` ≥ 2 values in geometric progression from `first` to `last`.
pub fn geometric(first: f64, last: f64, count: usize) -> Vec<f64> {
    let ratio = last / first;
    (0..count).map(|k| first * ratio.powf(k as f64 / (count.max(2) - 1) as f64)).collect()
}

impl TableSpec {
    /// Cache key: text of all inputs, the same on every machine.
    pub fn key(&self) -> String {
        let Self { contact, lubricant, loads, speeds, points } = self;
        format!(
            "ehl table 2; Rx {:e} m; Ry {:e} m; E* {:e} Pa; eta {:e} Pa s; alpha {:e} 1/Pa; Q {loads:?} N; u {speeds:?} m/s; points {points}",
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
        let rows: Vec<Result<Vec<[f64; 2]>, EhlError>> =
            self.speeds.par_iter().map(|&speed| self.row(speed, &count)).collect();
        let rows = rows.into_iter().collect::<Result<Vec<_>, _>>()?;
        let figure = |k: usize| rows.iter().map(|row| row.iter().map(|pair| pair[k]).collect()).collect();
        Ok(Table {
            key: self.key(),
            stiffness: self.contact.stiffness,
            loads: self.loads.clone(),
            speeds: self.speeds.clone(),
            shift: figure(0),
            central_film: figure(1),
        })
    }

    /// Film shift and central film at all loads and one speed, each started from the next higher load.
    fn row(&self, speed: f64, count: &impl Fn()) -> Result<Vec<[f64; 2]>, EhlError> {
        let Self { contact, lubricant, points, .. } = self;
        let formula = FilmFormula::new(contact, lubricant);
        let mut near: Option<Solution> = None;
        let mut row = Vec::with_capacity(self.loads.len());
        for &load in self.loads.iter().rev() {
            let depth = contact.semi_axes(load)[0].powi(2) / contact.rolling_radius;
            // Ratio to the thinnest film solved; h ~ u^SPEED_POWER below it.
            let share = (formula.central(speed, load) / (MIN_SOLVED_FILM * depth)).min(1.0);
            let speed = speed * share.powf(-1.0 / SPEED_POWER);
            let grid = Grid::flooded(contact, lubricant, speed, load, *points);
            let problem = Problem { contact: *contact, lubricant: lubricant.clone(), speed, load, grid };
            let found = extrapolate(&problem, near.as_ref())?;
            row.push([share * found.film_shift(), share * found.central_film]);
            near = Some(found.fine);
            count();
        }
        row.reverse();
        Ok(row)
    }
}

impl Table {
    /// The contact law at an entrainment speed u \[m/s\]: dry for u ≤ 0.
    ///
    /// Between the speeds ln h_c and ln s are monotone cubics (PCHIP) of ln u; below the lowest and above the
    /// highest speed powers of u (with a single speed u^0.67, Hamrock and Dowson's), so that both vanish with
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
        Curve::new(self.stiffness, &self.loads, &at(&self.shift), &at(&self.central_film))
    }
}

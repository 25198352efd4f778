//! Films of similar contacts: solved once for dimensionless contacts, stored with the program, interpolated.
//!
//! A lubricated elliptic contact has five dimensionless parameters: the ratio D = R_y/R_x of the radii across and
//! along rolling, the pressure G = α p₀ with the dry maximum pressure p₀, the film H = h R_x/b_x² after Hamrock and
//! Dowson (in place of the speed), and the lubricant's α p_r and z of the Roelands equation. Moes' M and L are powers
//! of G and H at given D. Stored are the logarithms of the solved films over Hamrock and Dowson's central film, at the
//! Chebyshev-Lobatto points of ln D, ln G and the share t of ln H within its range, for the lubricant
//! `REFERENCE`; and their change with α p_r and with z. The minimum film lies at the exit or in the side lobe, which
//! change places near D = 9: both are stored, as only each by itself is smooth.
//!
//! `cargo run --release --example ehl_similarity > assets/ehl_similarity.csv` computes the stored values again.

use rayon::prelude::*;
use std::f64::consts::PI;
use std::sync::LazyLock;

use super::{EhlError, Grid, Problem, extrapolate};
use crate::contact::{EllipticContact, FilmFormula, Lubricant};
use crate::material::Material;

/// Smallest H = h R_x/b_x² after Hamrock and Dowson that is solved: a thinner film is scaled from the speed at which
/// it has this thickness, by its own power of the speed there. Such a film changes the approach by 3 % or less.
pub const MIN_SOLVED_FILM: f64 = 0.03;

/// Dimensionless parameters of a lubricated contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SimilarContact {
    /// D = R_y/R_x.
    pub radius_ratio: f64,
    /// G = α p₀.
    pub pressure: f64,
    /// H = h R_x/b_x² with the central film of Hamrock and Dowson.
    pub film: f64,
    /// α p_r, p_r = 1.96e8 Pa.
    pub viscosity_rise: f64,
    /// Roelands' exponent z.
    pub roelands: f64,
}

/// Films of a contact over Hamrock and Dowson's central film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmRatios {
    /// Film shift (δ_dry − δ)/h.
    pub shift: f64,
    /// Central film h_c/h.
    pub central: f64,
    /// Minimum film h_min/h.
    pub minimum: f64,
    /// Powers of H in shift, central and minimum film: d ln h/d ln H.
    pub powers: [f64; 3],
}

/// Ranges of D and G.
const RADIUS_RATIOS: [f64; 2] = [1.0, 130.0];
const PRESSURES: [f64; 2] = [3.0, 130.0];
/// Number of points of t, G and D.
const COUNTS: [usize; 3] = [8, 7, 8];
/// Number of points of D, from its smallest, between which the film of the side lobe is interpolated: up to D = 20.
/// Beyond, the film at the exit is thinner and the side lobe disappears.
const SIDE_RADII: usize = 5;
/// α p_r and z of the stored films.
const REFERENCE: [f64; 2] = [4.0, 0.62];
/// α p_r and z of the other lubricants, and the ranges allowed.
const OTHERS: [[f64; 2]; 2] = [[2.2, 7.0], [0.52, 0.72]];
const LUBRICANTS: [[f64; 2]; 2] = [[1.5, 8.0], [0.47, 0.76]];
/// G above which other lubricants than mineral oils are not interpolated.
const MINERAL_OIL_PRESSURE: f64 = 40.0;
/// Grid resolution of the stored films, and of their change with the lubricant.
const POINTS: [usize; 2] = [6, 3];

/// Numbers of a stored contact: shift, central film, film at the exit and in the side lobe, for the reference
/// lubricant and their changes.
const FIGURES: usize = 4;
const VARIANTS: usize = 5;
/// Numbers before them in a line: D, G and H.
const PARAMETERS: usize = 3;

/// Largest H stored at a pressure G: in a thicker film the pressure spike approaches the centre, and the contact turns
/// rigid; these need few nodes and are soon solved.
fn thickest(pressure: f64) -> f64 {
    1.6 * pressure / (pressure + 8.0)
}

/// Chebyshev-Lobatto point k of `count` on \[0, 1\], from 0.
fn chebyshev(k: usize, count: usize) -> f64 {
    0.5 - 0.5 * (PI * k as f64 / (count - 1) as f64).cos()
}

/// Value on a logarithmic range at the share t.
fn logarithmic([first, last]: [f64; 2], t: f64) -> f64 {
    first * (last / first).powf(t)
}

/// Share t of a value on a logarithmic range.
fn share([first, last]: [f64; 2], value: f64) -> f64 {
    (value / first).ln() / (last / first).ln()
}

/// Weights of the values at the first `used` of `count` Chebyshev-Lobatto points in the polynomial through them at t,
/// and in its derivative by t; zero for the others.
fn weights(t: f64, count: usize, used: usize) -> Vec<[f64; 2]> {
    let node = |k: usize| chebyshev(k, count);
    (0..count)
        .map(|k| {
            if k >= used {
                return [0.0; 2];
            }
            let others = || (0..used).filter(move |&j| j != k);
            let factor = |j: usize| (t - node(j)) / (node(k) - node(j));
            let value = others().map(factor).product();
            let slope = others()
                .map(|i| others().filter(|&j| j != i).map(factor).product::<f64>() / (node(k) - node(i)))
                .sum();
            [value, slope]
        })
        .collect()
}

impl SimilarContact {
    /// Parameters of a contact under a load \[N\] at an entrainment speed \[m/s\].
    pub fn new(contact: &EllipticContact, lubricant: &Lubricant, speed: f64, load: f64) -> Self {
        let depth = contact.semi_axes(load)[0].powi(2) / contact.rolling_radius;
        Self {
            radius_ratio: contact.transverse_radius / contact.rolling_radius,
            pressure: lubricant.pressure_viscosity * contact.patch(load).maximum_pressure,
            film: FilmFormula::new(contact, lubricant).central(speed, load) / depth,
            viscosity_rise: lubricant.pressure_viscosity * Lubricant::ROELANDS_PRESSURE,
            roelands: lubricant.roelands_exponent(),
        }
    }

    /// A contact of these parameters: of steel, with R_x = 10 mm.
    pub fn problem(&self, points: usize) -> Problem {
        let steel =
            Material { name: "steel".into(), young: 2.06e11, shear: 8e10, poisson: 0.3, density: 7850.0 };
        let contact = EllipticContact::new(100.0, 100.0 / self.radius_ratio, [&steel, &steel]);
        let pressure_viscosity = self.viscosity_rise / Lubricant::ROELANDS_PRESSURE;
        let viscosity = (self.viscosity_rise / self.roelands - Lubricant::ROELANDS_LOG_VISCOSITY).exp();
        let lubricant = Lubricant { name: "oil".into(), viscosity, pressure_viscosity, density: 870.0 };
        let pressure = self.pressure / pressure_viscosity;
        let load = (pressure / contact.patch(1.0).maximum_pressure).powi(3);
        let depth = contact.semi_axes(load)[0].powi(2) / contact.rolling_radius;
        let unit = FilmFormula::new(&contact, &lubricant).central(1.0, load);
        let speed = (self.film * depth / unit).powf(1.0 / SPEED_POWER);
        let grid = Grid::flooded(&contact, &lubricant, speed, load, points);
        Problem { contact, lubricant, speed, load, grid }
    }

    /// ln of shift, central film, film at the exit and in the side lobe over Hamrock and Dowson's central film, from a
    /// solution.
    fn solve(&self, points: usize) -> Result<[f64; FIGURES], EhlError> {
        let problem = self.problem(points);
        let found = extrapolate(&problem, None)?;
        let unit =
            FilmFormula::new(&problem.contact, &problem.lubricant).central(problem.speed, problem.load);
        let films = [found.film_shift(), found.central_film, found.exit_film, found.side_film];
        Ok(films.map(|film| (film / unit).ln()))
    }

    /// Powers of H in shift, central and minimum film at the nearest stored contact.
    pub(super) fn nearest_powers(&self) -> [f64; 3] {
        let [pressure, radius_ratio] = [(self.pressure, PRESSURES), (self.radius_ratio, RADIUS_RATIOS)]
            .map(|(value, [low, high])| value.clamp(low, high));
        let film = self.film.clamp(MIN_SOLVED_FILM, thickest(pressure));
        let [viscosity_rise, roelands] = REFERENCE;
        let nearest = Self { radius_ratio, pressure, film, viscosity_rise, roelands };
        nearest.films().map_or([1.0; 3], |films| films.powers)
    }

    /// Whether the lubricant is one whose effect the stored changes describe: above [`MINERAL_OIL_PRESSURE`] only near
    /// mineral oils, as the effects of α p_r and z are not independent there.
    fn has_stored_lubricant(&self) -> bool {
        let Self { pressure, viscosity_rise, roelands, .. } = *self;
        let [rises, exponents] = LUBRICANTS;
        // Wooster's rule α = (0.6 + 0.965 log₁₀ η₀) 1e-8 1/Pa, η₀ in mPa s, as in `Lubricant::grade`.
        let viscosity =
            1e-3 * 10f64.powf((1e8 * viscosity_rise / Lubricant::ROELANDS_PRESSURE - 0.6) / 0.965);
        let mineral = viscosity_rise / (viscosity.ln() + Lubricant::ROELANDS_LOG_VISCOSITY);
        let is_near_mineral = (roelands - mineral).abs() <= 0.03 && pressure <= 22.0 * viscosity_rise;
        (rises[0]..=rises[1]).contains(&viscosity_rise)
            && (exponents[0]..=exponents[1]).contains(&roelands)
            && (pressure <= MINERAL_OIL_PRESSURE || is_near_mineral)
    }

    /// Interpolated films; `None` outside of the stored range, where a contact has to be solved.
    ///
    /// Within 0.8 % of the shift, 0.6 % of the central and 2 % of the minimum film solved by default for 128 random
    /// contacts, in the mean square 0.15 %, 0.16 % and 0.4 %; but 3 and 10 % above the minimum film of two of them
    /// (D = 26 and 127).
    pub fn films(&self) -> Option<FilmRatios> {
        let t = [
            share([MIN_SOLVED_FILM, thickest(self.pressure)], self.film),
            share(PRESSURES, self.pressure),
            share(RADIUS_RATIOS, self.radius_ratio),
        ];
        let inside = |t: f64| (-1e-9..=1.0 + 1e-9).contains(&t);
        if !(t.into_iter().all(inside) && self.has_stored_lubricant()) {
            return None;
        }
        let [by_film, by_pressure, by_radius] = [0, 1, 2].map(|n| weights(t[n], COUNTS[n], COUNTS[n]));
        let has_side = t[2] <= chebyshev(SIDE_RADII - 1, COUNTS[2]);
        let side_by_radius = weights(t[2], COUNTS[2], SIDE_RADII);
        // Quadratic interpolation between the three values of α p_r, and between those of z.
        let changes = [
            (self.viscosity_rise.ln(), REFERENCE[0].ln(), OTHERS[0].map(f64::ln)),
            (self.roelands, REFERENCE[1], OTHERS[1]),
        ]
        .map(|(x, middle, [low, high])| {
            [
                (x - middle) * (x - high) / ((low - middle) * (low - high)),
                (x - middle) * (x - low) / ((high - middle) * (high - low)),
            ]
        });
        let variant = [1.0, changes[0][0], changes[0][1], changes[1][0], changes[1][1]];
        let stored = STORED.as_slice();
        let mut sum = [[0.0; 2]; FIGURES];
        let mut contacts = stored.chunks_exact(FIGURES * VARIANTS);
        for (radius, side_radius) in by_radius.iter().zip(&side_by_radius) {
            for pressure in &by_pressure {
                for film in &by_film {
                    let contact = contacts.next()?;
                    let by_figure =
                        [radius, radius, radius, side_radius].map(|radius| radius[0] * pressure[0]);
                    for ((sum, figures), weight) in
                        sum.iter_mut().zip(contact.chunks_exact(VARIANTS)).zip(by_figure)
                    {
                        let value: f64 = figures.iter().zip(variant).map(|(f, v)| f * v).sum();
                        sum[0] += weight * film[0] * value;
                        sum[1] += weight * film[1] * value;
                    }
                }
            }
        }
        let range = (thickest(self.pressure) / MIN_SOLVED_FILM).ln();
        let [shift, central, exit, side] = sum;
        let minimum = if has_side && side[0] < exit[0] { side } else { exit };
        let figures = [shift, central, minimum];
        let [shift, central, minimum] = figures.map(|[value, _]| value.exp());
        Some(FilmRatios { shift, central, minimum, powers: figures.map(|[_, slope]| 1.0 + slope / range) })
    }
}

/// Stored numbers in order of D, G, H; shift, central film, film at the exit and in the side lobe; value and changes
/// with the lubricant.
static STORED: LazyLock<Vec<f64>> = LazyLock::new(|| {
    include_str!("../../../../../assets/ehl_similarity.csv")
        .lines()
        .skip_while(|line| !line.starts_with(|c: char| c.is_ascii_digit()))
        .flat_map(|line| line.split(',').skip(PARAMETERS).filter_map(|field| field.trim().parse().ok()))
        .collect()
});

/// Solves the contacts of the stored table, as its text (comma-separated).
///
/// # Errors
/// The first contact that does not converge.
pub fn compute(progress: impl Fn(usize, usize) + Sync) -> Result<String, EhlError> {
    let [films, pressures, radii] = COUNTS;
    let contacts: Vec<[f64; 3]> = (0..radii)
        .flat_map(|r| (0..pressures).flat_map(move |p| (0..films).map(move |f| (r, p, f))))
        .map(|(r, p, f)| {
            let pressure = logarithmic(PRESSURES, chebyshev(p, pressures));
            let film = logarithmic([MIN_SOLVED_FILM, thickest(pressure)], chebyshev(f, films));
            [logarithmic(RADIUS_RATIOS, chebyshev(r, radii)), pressure, film]
        })
        .collect();
    let done = std::sync::atomic::AtomicUsize::new(0);
    let line = |&[radius_ratio, pressure, film]: &[f64; 3]| -> Result<String, EhlError> {
        let [rise, exponent] = REFERENCE;
        let contact =
            SimilarContact { radius_ratio, pressure, film, viscosity_rise: rise, roelands: exponent };
        let [fine, coarse] = POINTS;
        // All at the same resolution, so that their differences do not contain its error.
        let solve = |contacts: &[SimilarContact], points: usize| {
            let at = |points: usize| -> Result<Vec<[f64; FIGURES]>, EhlError> {
                contacts.iter().map(|contact| contact.solve(points)).collect()
            };
            at(points).or_else(|_| at(points + 1)).or_else(|_| at(points + 2))
        };
        let value = solve(&[contact], fine)?[0];
        let rises = OTHERS[0].map(|viscosity_rise| SimilarContact { viscosity_rise, ..contact });
        let exponents = OTHERS[1].map(|roelands| SimilarContact { roelands, ..contact });
        let variants = solve(&[&[contact], &rises[..], &exponents[..]].concat(), coarse)?;
        let figures: Vec<String> = (0..FIGURES)
            .flat_map(|k| {
                let changes = variants.iter().skip(1).map(|other| other[k] - variants[0][k]);
                std::iter::once(value[k]).chain(changes).map(|v| format!("{v:.5}")).collect::<Vec<_>>()
            })
            .collect();
        progress(done.fetch_add(1, std::sync::atomic::Ordering::Relaxed) + 1, contacts.len());
        Ok(format!("{radius_ratio:.5},{pressure:.5},{film:.6},{}", figures.join(",")))
    };
    let lines = contacts.par_iter().map(line).collect::<Result<Vec<_>, _>>()?;
    let names: Vec<String> = ["shift", "central", "exit", "side"]
        .iter()
        .flat_map(|figure| {
            ["", " low alpha", " high alpha", " low z", " high z"].map(|variant| format!("{figure}{variant}"))
        })
        .collect();
    Ok(format!(
        "# Solved EHL films of similar contacts; the module contact::ehl::similarity describes and computes them.\n\
         D,G,H,{}\n{}\n",
        names.join(","),
        lines.join("\n")
    ))
}

/// Exponent of the speed in Hamrock and Dowson's central film.
pub(super) const SPEED_POWER: f64 = 0.67;

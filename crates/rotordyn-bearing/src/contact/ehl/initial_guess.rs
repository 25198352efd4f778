//! Initial guess of film and pressure.

use super::Problem;
use super::newton::InitialGuess;
use super::scaled::Scaled;
use crate::contact::FilmFormula;
use rotordyn_linalg::dot;

/// Semi-ellipsoidal pressure over the dry contact, or over the film's wedge if wider, and the separation at
/// which the minimum film is about Hamrock and Dowson's.
pub(super) fn ellipse(problem: &Problem, s: &Scaled) -> InitialGuess {
    let film = FilmFormula::new(&problem.contact, &problem.lubricant).central(problem.speed, problem.load);
    let wedge = |radius: f64, axis: f64| ((2.0 * film * radius).sqrt() / axis).max(1.0);
    let width = wedge(problem.contact.rolling_radius, s.axes[0]);
    let height = wedge(problem.contact.transverse_radius, s.axes[1]);
    let mut pressure: Vec<f64> =
        s.x.iter()
            .flat_map(|x| s.y.iter().map(move |y| 1.0 - (x / width).powi(2) - (y / height).powi(2)))
            .enumerate()
            .map(|(node, square)| if s.is_inner(node) { square.max(0.0).sqrt() } else { 0.0 })
            .collect();
    let load = dot(&pressure, &s.weights);
    pressure.iter_mut().for_each(|p| *p /= load);
    InitialGuess { pressure, separation: f64::NEG_INFINITY, least_film: film / s.film }
}

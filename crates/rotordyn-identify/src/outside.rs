//! Modes just outside the band: within their half-power bandwidth of it they act there as no residual term does.

use std::f64::consts::TAU;

use super::Settings;
use super::lsfd::free_residues;
use super::plscf::{Pole, normalise_largest};
use super::pole_selection::directions;
use super::refine::{MIN_LOCAL_GAIN, Problem};
use super::window::Window;
use rotordyn_linalg::Complex64;

/// Width of what is fitted at an end of the band, in half-power bandwidths of the usual mode, and in lines at least.
const WIDTH: f64 = 4.0;
const MIN_LINES: f64 = 40.0;
/// Steps of the fit there with one more mode, and where it starts: from the end of the band, over the usual decay rate.
const STEPS: usize = 20;
const DISTANCES: [f64; 2] = [0.5, 3.0];

/// Poles with a mode outside each end of the band that explains the FRFs there; the stabilisation diagram has none outside.
pub(super) fn with_modes_outside(problem: &Problem, mut poles: Vec<Pole>, settings: &Settings) -> Vec<Pole> {
    let data = problem.data();
    let band = data.band();
    let mut decays: Vec<f64> = poles.iter().map(|pole| pole.value.re.abs()).collect();
    decays.sort_by(f64::total_cmp);
    let decay = decays[decays.len() / 2];
    let width = (WIDTH * 2.0 * decay / TAU).max(MIN_LINES * data.step);
    let at = problem.refine(poles.clone(), 0);
    let fit = problem.fit(&at);
    for (end, side) in [(band[0], -1.0), (band[1], 1.0)] {
        let outside = |pole: &Pole| (pole.value.im / TAU - end) * side > 0.0;
        if poles.iter().any(outside) {
            continue;
        }
        let inner = end - side * width;
        let Some(window) = Window::new(data, &at.poles, &fit, [end.min(inner), end.max(inner)]) else {
            continue;
        };
        let here = Problem::new(&window.data);
        let trial = |distance: f64| {
            let value = Complex64::new(-decay, TAU * end + side * distance * decay);
            let values: Vec<Complex64> = window.near.iter().map(|pole| pole.value).chain([value]).collect();
            let residues = free_residues(&window.data, &values);
            let participation = directions(residues.last()?).0.into_iter().next()?;
            let mut poles = window.near.clone();
            poles.push(Pole::new(value, normalise_largest(participation)));
            let at = here.refine(poles, STEPS);
            let own = at.poles.last()?;
            let valid = outside(own)
                && own.reaches_into(band)
                && (0.0..=settings.largest_damping).contains(&own.damping_ratio())
                && here.local_gain(&at, at.poles.len() - 1) > MIN_LOCAL_GAIN;
            valid.then_some(at)
        };
        let best = DISTANCES.into_iter().filter_map(trial).min_by(|a, b| a.cost.total_cmp(&b.cost));
        poles.extend(best.and_then(|best| best.poles.last().cloned()));
    }
    poles
}

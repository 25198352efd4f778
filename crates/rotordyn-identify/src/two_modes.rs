//! Whether two close poles are two modes.
//!
//! FRFs of one mode that differs between them (a structure that changes between hits) have one pole each, λ + δ of that FRF;
//! two common poles explain them as well. FRFs of two modes have both poles each, unless the modes share no point: where one
//! pole of its own for each FRF leaves unexplained what two common poles explain, there are two modes. A nonlinear mode and
//! noise of the force also need more than one pole, but of one shape.

use std::f64::consts::TAU;

use rayon::prelude::*;

use super::data::Data;
use super::lsfd::Fit;
use super::mac::mac;
use super::plscf::Pole;
use super::refine::{FitPoint, Problem};
use super::window::Window;
use rotordyn_linalg::Complex64;

/// Half width of the window around the poles in half-power bandwidths, and in lines at least.
const WINDOW: f64 = 2.0;
const MIN_LINES: f64 = 20.0;
/// Steps of the fits with two common poles, and with one pole for each FRF.
const TOGETHER_STEPS: usize = 4;
const EACH_STEPS: usize = 8;
/// Minimum F statistic of the two common poles against one for each FRF.
const MIN_SIGNIFICANCE: f64 = 10.0;

/// What the second pole explains over what neither it nor noise explains: less is as likely a structure that changes between
/// hits, of which a second pole takes up a part.
pub(super) const MIN_EXPLAINED: f64 = 20.0;

/// Energy of the noise in the residuals, by third differences from line to line, as in `frf_power::noise_rms`; their mean, not the
/// median, contains the noise of the force, which is strongest at the resonance.
pub(super) fn noise(at: &FitPoint, lines: usize) -> f64 {
    let third = |w: &[f64]| (w[3] - 3.0 * w[2] + 3.0 * w[1] - w[0]).powi(2) / 20.0;
    let of = |part: &[f64]| part.windows(4).map(third).sum::<f64>() * lines as f64 / (lines - 3) as f64;
    at.residual.as_slice().chunks(lines).map(of).sum()
}

/// MAC below which the shapes may be those of FRFs of one mode that differ, each on its own outputs; and above which they are
/// one shape, whose second pole is that of a nonlinear mode or of noise of the force. Between them a second pole that
/// explains little more than is left, of misfit by modes outside of the window, is a mode.
const UNLIKE: f64 = 0.3;
const ONE_SHAPE: f64 = 0.9;
const MIN_EXPLAINED_BETWEEN: f64 = 4.0;

/// Whether two poles, which take the place of the poles `taken`, are two modes with shapes of a MAC below `shapes`.
pub(super) fn are_two(
    data: &Data,
    poles: &[Pole],
    fit: &Fit,
    taken: &[usize],
    pair: [&Pole; 2],
    shapes: f64,
) -> bool {
    let hz = pair.map(|pole| pole.value.im / TAU);
    let decay = pair[0].value.re.abs().max(pair[1].value.re.abs());
    let half = (WINDOW * 2.0 * decay / TAU).max(MIN_LINES * data.step);
    let between = [hz[0].min(hz[1]) - half, hz[0].max(hz[1]) + half];
    let window = Window::of_all_outputs(data, poles, fit, between);
    if taken.iter().any(|m| !window.inside.contains(m)) {
        return false;
    }
    let kept = window.inside.iter().zip(&window.near).filter(|(m, _)| !taken.contains(m));
    let others: Vec<Pole> = kept.map(|(_, pole)| pole.clone()).collect();
    let all: Vec<Pole> = others.iter().chain(pair).cloned().collect();
    let lines = window.data.lines();
    // Both fits have unknowns to spare.
    if lines < 2 * (2 * all.len() + 2) {
        return false;
    }
    let here = Problem::new(&window.data);
    let two = here.refine(all, TOGETHER_STEPS);
    let (a, b) = (two.poles.len() - 2, two.poles.len() - 1);
    let alike = least_mac(&window.data, &two, a, b);
    if alike > ONE_SHAPE {
        return false;
    }
    let explained = if alike > shapes.min(UNLIKE) { MIN_EXPLAINED_BETWEEN } else { MIN_EXPLAINED };
    let values = [two.poles[a].value, two.poles[b].value];
    let frfs: Vec<&Vec<Complex64>> = window.data.values.iter().flatten().collect();
    let each: Vec<f64> = frfs.par_iter().map(|frf| cost_of_one(&window.data, frf, &others, values)).collect();
    let each = each.iter().sum::<f64>();
    let noise = noise(&two, lines);
    let gain = each - two.cost;
    let variance = two.residual_variance().max(f64::MIN_POSITIVE);
    gain > MIN_SIGNIFICANCE * 2.0 * frfs.len() as f64 * variance
        && gain > explained * (two.cost - noise).max(0.0)
}

/// Squared residuals of one FRF with one pole of its own instead of two, and the other poles where they are.
fn cost_of_one(data: &Data, frf: &[Complex64], others: &[Pole], values: [Complex64; 2]) -> f64 {
    let single = Data {
        frequencies: data.frequencies.clone(),
        values: vec![vec![frf.to_vec()]],
        output_scale: vec![1.0],
        input_scale: vec![1.0],
        stop: data.stop.clone(),
        ..*data
    };
    let here = Problem::new(&single);
    let one: Vec<Complex64> = vec![1.0.into()];
    let starts = [values[0], values[1], 0.5 * (values[0] + values[1])];
    let fits = starts.into_iter().map(|value| {
        let held = others.iter().map(|pole| Pole { held: true, ..Pole::new(pole.value, one.clone()) });
        here.refine(held.chain([Pole::new(value, one.clone())]).collect(), EACH_STEPS).cost
    });
    fits.fold(f64::INFINITY, f64::min)
}

/// MAC of two shapes as measured or as scaled for the fit, the smaller.
fn least_mac(data: &Data, at: &FitPoint, a: usize, b: usize) -> f64 {
    let scale = &data.output_scale;
    let fitted = |m: usize| (0..scale.len()).map(|o| at.shape(m, o)).collect::<Vec<_>>();
    let measured = |m: usize| (0..scale.len()).map(|o| at.shape(m, o) * scale[o]).collect::<Vec<_>>();
    mac(&fitted(a), &fitted(b)).min(mac(&measured(a), &measured(b)))
}

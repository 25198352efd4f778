//! What a mode may be instead, as part of its standard errors.
//!
//! A mode that may be two is then the nearer of the two: its error is the distance to that one, of the pole and of the shape.
//! A mode that may be one with its neighbour is then the mode of one pole between both. The shape at a pole that is not refined
//! contains the motion that drew the pole away, of which nothing is known: an equal mixture of two modes.

use super::mac::mac;
use super::plscf::Pole;
use super::refine::{FitPoint, Problem};
use rotordyn_linalg::Complex64;

/// 1 − MAC of the shape at a pole that is not refined: that of an equal mixture of two orthogonal shapes.
pub(super) const NOT_REFINED: f64 = 0.5;

/// Share of the squared distance to the nearer pole of two in the variance: the interval of 95 % covers both.
const OF_TWO: f64 = 0.5;

/// Squared errors of a mode by what it may be instead.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct AlternativeMode {
    /// Of the pole's real and imaginary part.
    pub pole: [f64; 2],
    /// 1 − MAC of the shape.
    pub shape: f64,
}

impl AlternativeMode {
    /// Of a mode that may have another pole, and a shape of this 1 − MAC.
    pub fn new(pole: Complex64, other: Complex64, shape: f64) -> Self {
        let apart = other - pole;
        Self { pole: [apart.re * apart.re, apart.im * apart.im], shape: shape.clamp(0.0, 1.0) }
    }

    /// The larger of two, of the pole and of the shape.
    pub fn or(self, other: AlternativeMode) -> Self {
        Self {
            pole: [self.pole[0].max(other.pole[0]), self.pole[1].max(other.pole[1])],
            shape: self.shape.max(other.shape),
        }
    }

    /// A mode that may be two with these poles: the nearer of the two by its shape.
    pub fn of_two(problem: &Problem, at: &FitPoint, m: usize, pair: &[Pole; 2]) -> Self {
        let mut poles = at.poles.clone();
        poles.remove(m);
        let first = poles.len();
        poles.extend_from_slice(pair);
        let two = problem.refine(poles, 0);
        let own = measured_shape(problem, at, m);
        let correlation = [first, first + 1].map(|k| mac(&own, &measured_shape(problem, &two, k)));
        let nearer = usize::from(correlation[1] > correlation[0]);
        let whole = Self::new(at.poles[m].value, pair[nearer].value, 1.0 - correlation[nearer]);
        Self { pole: whole.pole.map(|square| OF_TWO * square), ..whole }
    }

    /// A mode that may be one with its neighbour.
    pub fn of_one(problem: &Problem, at: &FitPoint, m: usize, neighbour: usize) -> Self {
        let mut poles = at.poles.clone();
        let value = 0.5 * (poles[m].value + poles[neighbour].value);
        poles[m].value = value;
        poles.remove(neighbour);
        let one = problem.refine(poles, 0);
        let place = m - usize::from(neighbour < m);
        let correlation = mac(&measured_shape(problem, at, m), &measured_shape(problem, &one, place));
        Self::new(at.poles[m].value, value, 1.0 - correlation)
    }
}

/// Shape in the units of the outputs.
pub(super) fn measured_shape(problem: &Problem, at: &FitPoint, m: usize) -> Vec<Complex64> {
    let scale = &problem.data().output_scale;
    scale.iter().enumerate().map(|(o, scale)| at.shape(m, o) * *scale).collect()
}

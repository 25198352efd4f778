//! Stabilisation diagram: poles of every order with their shapes, and their stability from order to order.

use rayon::prelude::*;

use super::data::Data;
use super::dense::solve_normal_equations;
use super::lsfd::Basis;
use super::mac::mac;
use super::plscf::Pole;
use super::principal_outputs::project_outputs;
use super::{DiagramPole, IdentifyError, Stability};
use rotordyn_linalg::Complex64;

/// A pole of one order with its shape over the outputs, or over their principal directions.
#[derive(Clone, Debug)]
pub(super) struct Candidate {
    /// Index of the order.
    pub order: usize,
    pub pole: Pole,
    pub shape: Vec<Complex64>,
    /// Whether it is a repeated (double) pole: the two shapes may then be any linear combinations.
    pub double: bool,
}

/// Maximum number of outputs of candidate shapes; more are projected on their principal directions.
const MAX_DIRECTIONS: usize = 16;
/// Distance, relative to the decay rate, below which two poles of one order are a double pole.
const DOUBLE_POLE_DISTANCE: f64 = 0.3;

/// Shapes for the poles of every order, by LSFD with all poles of that order.
pub(super) fn candidates(data: &Data, poles: Vec<Vec<Pole>>) -> Result<Vec<Candidate>, IdentifyError> {
    let basis = Basis::new(data);
    let y = basis.right_side(&project_outputs(data, MAX_DIRECTIONS)?);
    let of_order = |(order, poles): (usize, Vec<Pole>)| -> Vec<Candidate> {
        if poles.is_empty() {
            return Vec::new();
        }
        let Some(x) = solve_normal_equations(basis.design(&poles), &y) else { return Vec::new() };
        let shapes = basis.fit(&x, poles.len()).shapes;
        let values: Vec<Complex64> = poles.iter().map(|p| p.value).collect();
        poles
            .into_iter()
            .zip(shapes)
            .enumerate()
            .map(|(k, (pole, shape))| {
                let near = |other: &Complex64| {
                    (other - pole.value).norm() < DOUBLE_POLE_DISTANCE * pole.value.re.abs()
                };
                let double = values.iter().enumerate().any(|(j, other)| j != k && near(other));
                Candidate { order, pole, shape, double }
            })
            .collect()
    };
    let lists: Vec<Vec<Candidate>> =
        poles.into_iter().enumerate().collect::<Vec<_>>().into_par_iter().map(of_order).collect();
    Ok(lists.into_iter().flatten().collect())
}

/// Stabilisation diagram: each pole compared with those of the next lower order.
pub(super) fn diagram(candidates: &[Candidate], orders: &[usize]) -> Vec<DiagramPole> {
    let describe = |c: &Candidate| {
        let before = candidates.iter().filter(|b| b.order + 1 == c.order);
        let nearest = before.min_by(|a, b| {
            let off = |p: &Candidate| (p.pole.value - c.pole.value).norm();
            off(a).total_cmp(&off(b))
        });
        let stability = match nearest {
            Some(b) if (b.pole.value.im / c.pole.value.im - 1.0).abs() < 0.01 => {
                let damped = (b.pole.damping_ratio() / c.pole.damping_ratio() - 1.0).abs() < 0.05;
                let shaped = b.double || c.double || mac(&b.shape, &c.shape) > 0.95;
                match (damped, shaped) {
                    (true, true) => Stability::Stable,
                    (true, false) => Stability::Damping,
                    (false, true) => Stability::Shape,
                    (false, false) => Stability::Frequency,
                }
            }
            _ => Stability::New,
        };
        DiagramPole { order: orders[c.order], value: c.pole.value, stability }
    };
    candidates.iter().map(describe).collect()
}

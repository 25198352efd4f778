//! Minimum film of a solution between its nodes, at the exit and in the side lobe.

use super::scaled::Scaled;
use serde::{Deserialize, Serialize};

/// Minimum films in units of b_x²/R_x.
///
/// The film has two minima: at the exit on the line of symmetry, and near the end of the ellipse across (side lobe).
/// Each is smooth in the parameters of the contact; the lesser of them has a kink where they are equal.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Minima {
    /// Least film between the line of symmetry and the ridge before the side lobe.
    pub exit: f64,
    /// Least film from that ridge outwards. Without a side lobe, where the film grows all the way to the side, the
    /// film where it grows least, which is above the film at the exit.
    pub side: f64,
}

/// Largest share by which interpolation may lower the film of the least node: more is a grid too coarse for it.
const MAX_LOWERING: f64 = 0.3;

/// Nodes of an interpolation, and points per interval at which it is evaluated.
const WINDOW: usize = 5;
const SAMPLES: i32 = 50;

/// Part of the ellipse across in which a missing side lobe would be.
const LOBE: [f64; 2] = [0.4, 1.0];

impl Minima {
    /// Both minima of a film on the half domain, index i·ny + j.
    pub(super) fn new(s: &Scaled, film: &[f64]) -> Self {
        // Least film of every row but the last, which lies on the edge.
        let rows: Vec<f64> = (0..s.ny - 1)
            .map(|j| {
                let line = |i: usize| film[i * s.ny + j];
                let least = (0..s.nx).min_by(|&a, &b| line(a).total_cmp(&line(b))).unwrap_or(0);
                between(|i| line(i.clamp(0, s.nx as isize - 1) as usize), least)
            })
            .collect();
        // Even in Y; beyond the last row as there.
        let row = |j: isize| rows[j.unsigned_abs().min(rows.len() - 1)];
        let least = |range: std::ops::RangeInclusive<usize>| {
            let node = range.clone().min_by(|&a, &b| rows[a].total_cmp(&rows[b])).unwrap_or(*range.start());
            between(row, node)
        };
        // From the side inwards to the first minimum.
        let lobe = (1..rows.len()).rev().find(|&j| rows[j - 1] >= rows[j] && j + 1 < rows.len());
        let Some(lobe) = lobe else {
            return Self { exit: least(0..=rows.len() - 1), side: inflection(&s.y, &rows) };
        };
        let ridge = (0..=lobe).max_by(|&a, &b| rows[a].total_cmp(&rows[b])).unwrap_or(0);
        Self { exit: least(0..=ridge), side: least(ridge..=lobe) }
    }
}

/// Least value within an interval of the node `least`, by the polynomial through it and its neighbours.
fn between(value: impl Fn(isize) -> f64, least: usize) -> f64 {
    let node = value(least as isize);
    let at = |k: i32| interpolate(&value, least as f64 + f64::from(k) / f64::from(SAMPLES));
    let lowest = (-SAMPLES..=SAMPLES).map(at).fold(node, f64::min);
    lowest.max(node - MAX_LOWERING * node.abs())
}

/// Value at a position between nodes, by the polynomial through the [`WINDOW`] nearest.
fn interpolate(value: impl Fn(isize) -> f64, at: f64) -> f64 {
    let first = at.round() as isize - WINDOW as isize / 2;
    let nodes = || (0..WINDOW as isize).map(|k| first + k);
    nodes()
        .map(|i| {
            let factor = |k: isize| (at - k as f64) / (i - k) as f64;
            value(i) * nodes().filter(|&k| k != i).map(factor).product::<f64>()
        })
        .sum()
}

/// Film where it grows least with Y within [`LOBE`].
fn inflection(y: &[f64], rows: &[f64]) -> f64 {
    let slope = |j: usize| (rows[j + 1] - rows[j]) / (y[j + 1] - y[j]);
    let inside = |&j: &usize| (LOBE[0]..=LOBE[1]).contains(&(0.5 * (y[j] + y[j + 1])));
    let least =
        (1..rows.len().saturating_sub(2)).filter(inside).min_by(|&a, &b| slope(a).total_cmp(&slope(b)));
    let Some(j) = least else { return rows[rows.len() - 1] };
    let [before, at, after] = [slope(j - 1), slope(j), slope(j + 1)];
    let curvature = before - 2.0 * at + after;
    let shift = if curvature > 0.0 { (0.5 * (before - after) / curvature).clamp(-0.5, 0.5) } else { 0.0 };
    interpolate(|k| rows[k.unsigned_abs().min(rows.len() - 1)], j as f64 + 0.5 + shift)
}

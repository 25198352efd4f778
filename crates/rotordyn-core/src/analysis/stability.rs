//! Stability threshold (onset speed of instability): the speed where a mode's damping vanishes.

use super::campbell::{Campbell, EXTRA_MODES, Tangents, Tracker};
use super::critical_speed::CriticalSpeed;
use super::modal::{Mode, SHIFT};
use crate::assembly::{Assembly, PhysicsError};
use rotordyn_linalg::Complex64;
use serde::{Deserialize, Serialize};

/// A zero crossing of a mode's damping.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Threshold {
    /// Ω \[rad/s\].
    pub speed: f64,
    /// Whether the mode is unstable above this speed.
    pub unstable_above: bool,
    /// The mode at this speed, with its label there.
    pub mode: Mode,
    /// Index of its branch in the diagram.
    #[serde(default)]
    pub branch: Option<usize>,
}

/// Damping ratio below which a mode is unstable, not undamped to round-off.
pub const UNSTABLE: f64 = -1e-9;
/// Least MAC of a crossing with the mode of its branch at the nearer of both ends of a step: a whirling mode has 0.5 with each of
/// the plane ones at rest.
const LEAST_MAC: f64 = 0.4;

/// Speeds where Re λ of a tracked branch changes sign, by speed; `crossings`: modes known between the speeds of the diagram;
/// `nodes`: speeds at which coefficients of bearings turn, where the modes are looked at too.
///
/// # Errors
/// As [`campbell`](super::campbell::campbell).
pub fn thresholds(
    assembly: &Assembly,
    diagram: &Campbell,
    crossings: &[CriticalSpeed],
    tangents: &impl Tangents,
    nodes: &[f64],
) -> Result<Vec<Threshold>, PhysicsError> {
    let tracker = Tracker { assembly, tangents, count: diagram.count + EXTRA_MODES };
    let mut found = Vec::new();
    for (k, range) in diagram.speeds.windows(2).enumerate() {
        let (branches, ends): (Vec<usize>, Vec<[&Mode; 2]>) = diagram
            .branches
            .iter()
            .enumerate()
            .filter_map(|(at, branch)| Some((at, [branch.modes[k].as_ref()?, branch.modes[k + 1].as_ref()?])))
            .unzip();
        let at_nodes = at_nodes(&tracker, &ends, nodes, range)?;
        let known = between(&tracker, &ends, crossings, range);
        for (at, ([a, b], crossed)) in ends.into_iter().zip(known).enumerate() {
            let mut inner: Vec<(f64, &Mode)> =
                at_nodes[at].iter().map(|(speed, mode)| (*speed, mode)).collect();
            inner.extend(crossed);
            inner.sort_by(|a, b| a.0.total_cmp(&b.0));
            let path = [(range[0], a)].into_iter().chain(inner).chain([(range[1], b)]);
            for step in path.collect::<Vec<_>>().windows(2) {
                let unstable_above = is_unstable(step[1].1.eigenvalue);
                if is_unstable(step[0].1.eigenvalue) != unstable_above {
                    // The real part of an undamped mode at one end is round-off of either sign.
                    let [left, right] = [step[0].1, step[1].1].map(|mode| mode.eigenvalue.re > 0.0);
                    let least = |m: &Mode| if left == right { round_off(m.eigenvalue) } else { 0.0 };
                    let gap = |m: &Mode, _| m.eigenvalue.re - least(m);
                    let (speed, mode) = tracker.root(step[0], step[1], gap)?;
                    found.push(Threshold { speed, unstable_above, mode, branch: Some(branches[at]) });
                }
            }
        }
    }
    found.sort_by(|a, b| a.speed.total_cmp(&b.speed));
    Ok(found)
}

/// Round-off of ζ of a mode that the eigenvalue solver has from far above its shift, over (|λ|/σ)².
const ROUND_OFF: f64 = 1e-13;

/// Growth Re λ \[1/s\] of a mode that may be round-off of its eigenvalue: a part of |λ|, more far above and below the solver's
/// shift. Of λ far below it the solver has λ² to a part of σ², as of the slow precession of a rotor that nothing holds.
fn round_off(eigenvalue: Complex64) -> f64 {
    let size = eigenvalue.norm();
    let ratio = size / SHIFT;
    size * (-UNSTABLE * ratio.powi(-2).max(1.0)).max(ROUND_OFF * ratio.powi(2))
}

/// Whether a mode grows by more than the round-off of its eigenvalue.
pub fn is_unstable(eigenvalue: Complex64) -> bool {
    eigenvalue.re > round_off(eigenvalue)
}

/// The modes of branches at the nodes within a range of speeds, by speed, for each of the branches with these modes at its ends;
/// only up to a node at which no mode follows the branch, and none where all modes are as stable as at the ends.
fn at_nodes(
    tracker: &Tracker<impl Tangents>,
    ends: &[[&Mode; 2]],
    nodes: &[f64],
    range: &[f64],
) -> Result<Vec<Vec<(f64, Mode)>>, PhysicsError> {
    let inside = nodes.iter().copied().filter(|node| *node > range[0] && *node < range[1]);
    let modes =
        inside.map(|node| Ok((node, tracker.modes(node)?))).collect::<Result<Vec<_>, PhysicsError>>()?;
    let mut found = vec![Vec::new(); ends.len()];
    let grows = |mode: &Mode| is_unstable(mode.eigenvalue);
    let all = || modes.iter().flat_map(|(_, modes)| modes).chain(ends.iter().flatten().copied());
    if !(all().any(grows) && all().any(|mode| !grows(mode))) {
        return Ok(found);
    }
    let mut last = (range[0], ends.iter().map(|[a, _]| Mode::clone(a)).collect::<Vec<_>>());
    // Index of every branch's mode among the last ones.
    let mut at: Vec<Option<usize>> = (0..ends.len()).map(Some).collect();
    for (speed, modes) in modes {
        let links = tracker.continued((last.0, &last.1), (speed, &modes), &at)?;
        at = at.into_iter().map(|i| links[i?]).collect();
        for (path, at) in found.iter_mut().zip(&at) {
            path.extend(at.map(|i| (speed, modes[i].clone())));
        }
        last = (speed, modes);
    }
    Ok(found)
}

/// The crossings within a range of speeds that tell of a threshold, by speed, for each of the branches with these modes at its
/// ends: a crossing belongs to the branch whose shapes are the most similar.
fn between<'a>(
    tracker: &Tracker<impl Tangents>,
    ends: &[[&Mode; 2]],
    crossings: &'a [CriticalSpeed],
    range: &[f64],
) -> Vec<Vec<(f64, &'a Mode)>> {
    let mut known = vec![Vec::new(); ends.len()];
    let tells = |mode: &Mode| {
        ends.iter().flatten().any(|end| is_unstable(end.eigenvalue) != is_unstable(mode.eigenvalue))
    };
    let inside = |crossing: &&CriticalSpeed| crossing.speed > range[0] && crossing.speed < range[1];
    for crossing in crossings.iter().filter(inside).filter(|crossing| tells(&crossing.mode)) {
        let correlation = |[a, b]: &[&Mode; 2]| {
            let shapes = [Mode::clone(a), Mode::clone(b)];
            let with_ends = tracker.mac(&shapes, std::slice::from_ref(&crossing.mode)).concat();
            let is_own = with_ends.iter().any(|mac| *mac > LEAST_MAC);
            is_own.then(|| with_ends.iter().sum::<f64>())
        };
        let correlation: Vec<Option<f64>> = ends.iter().map(correlation).collect();
        let size = |k: &usize| correlation[*k].unwrap_or(0.0);
        // A mode that no branch follows has none.
        let own = (0..ends.len()).max_by(|i, j| size(i).total_cmp(&size(j))).filter(|k| size(k) > 0.0);
        if let Some(own) = own {
            known[own].push((crossing.speed, &crossing.mode));
        }
    }
    known.iter_mut().for_each(|list| list.sort_by(|a, b| a.0.total_cmp(&b.0)));
    known
}

impl<T: Tangents> Tracker<'_, T> {
    /// The speed between a and b where `gap` of the mode vanishes, and the mode there (secant method
    /// safeguarded by bisection, to 1e-12 of the speed).
    fn root(
        &self,
        (mut left, a): (f64, &Mode),
        (mut right, b): (f64, &Mode),
        gap: impl Fn(&Mode, f64) -> f64,
    ) -> Result<(f64, Mode), PhysicsError> {
        let (mut ga, mut gb) = (gap(a, left), gap(b, right));
        let mut best = (right, b.clone());
        if gb == 0.0 {
            return Ok(best);
        }
        let ends = [a.clone(), b.clone()];
        for step in 0..60 {
            let secant = (left * gb - right * ga) / (gb - ga);
            // Every third step bisects the bracket, so that neither end stagnates.
            let speed = if step % 3 == 2 { 0.5 * (left + right) } else { secant };
            let modes = self.modes(speed)?;
            let Some(j) = self.most_similar(&ends, &modes) else { break };
            let g = gap(&modes[j], speed);
            best = (speed, modes.into_iter().nth(j).expect("index found above"));
            if g == 0.0 {
                break;
            }
            if (g > 0.0) == (ga > 0.0) {
                (left, ga) = (speed, g);
            } else {
                (right, gb) = (speed, g);
            }
            let tight = 1e-12 * right.abs();
            if (right - left).abs() < tight || (secant - speed).abs() < tight && g.abs() < 1e-11 * speed.abs()
            {
                break;
            }
        }
        Ok(best)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn growth_within_round_off_of_the_eigenvalue_is_none() {
        let grows = |re: f64, im: f64| is_unstable(Complex64::new(re, im));
        // The precession of a free rotor at 0.005 Hz, of which the solver knows λ² to a part of σ².
        assert!(!grows(4e-10, 0.03) && !grows(1e-6, 0.03));
        // ζ of -1e-8 at 10 and 100 Hz, and -1e-3 far below the shift and far above.
        assert!(grows(6e-7, 62.8) && grows(6e-6, 628.0));
        assert!(grows(6e-3, 6.0) && grows(100.0, 1e5));
        assert!(!grows(-1.0, 100.0) && !grows(0.0, 0.0));
    }
}

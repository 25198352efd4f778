//! Campbell diagram: modes over speed, tracked by the MAC of their shapes.

use super::modal::{self, Mode};
use super::mode::{inner, log_decrement};
use super::mode_kind::ModeKind;
use crate::assembly::{Assembly, LinearSystem, PhysicsError};
use rayon::prelude::*;
use rotordyn_bearing::SiteTangent;
use rotordyn_linalg::Complex64;
use serde::{Deserialize, Serialize};

/// Modes computed in addition to the requested ones, so that a branch continues when others drop below it.
pub(crate) const EXTRA_MODES: usize = 4;
/// Below this MAC the speed step is halved.
const CERTAIN_MAC: f64 = 0.7;
/// Below this MAC a branch is lost.
const LOST_MAC: f64 = 0.2;
/// Largest number of halvings of a speed step.
const MAX_HALVINGS: usize = 4;

/// Tangent stiffness and damping of all bearings as a function of speed.
pub trait Tangents: Fn(f64) -> Result<Vec<SiteTangent>, PhysicsError> + Sync {}
impl<F: Fn(f64) -> Result<Vec<SiteTangent>, PhysicsError> + Sync> Tangents for F {}

/// Modes over speed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Campbell {
    /// Speeds Ω \[rad/s\].
    pub speeds: Vec<f64>,
    /// One branch per mode, by frequency at the first speed; then those that continue lost ones.
    pub branches: Vec<Branch>,
    /// Branches that could not be followed.
    pub lost: Vec<LostBranch>,
    /// Number of modes requested.
    pub(super) count: usize,
    /// All modes computed at every speed, a few more than requested.
    pub(crate) all: Vec<Vec<ModeValue>>,
}

/// A mode without its shape.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct ModeValue {
    pub eigenvalue: Complex64,
    pub label: String,
}

impl ModeValue {
    /// Log decrement δ.
    pub fn log_dec(&self) -> f64 {
        log_decrement(self.eigenvalue)
    }
}

/// One mode tracked over speed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Branch {
    /// Label at the lowest speed at which the branch exists and the shaft rotates; made unique by a number.
    pub label: String,
    /// Kind at the same speed.
    pub kind: ModeKind,
    /// The mode at every speed, each with its own label and kind; `None` where it was not tracked.
    pub modes: Vec<Option<Mode>>,
}

impl Branch {
    /// Damped angular frequency at speed k \[rad/s\].
    pub fn omega(&self, k: usize) -> Option<f64> {
        self.modes[k].as_ref().map(Mode::omega)
    }

    /// The modes from the lowest speed on, with rotation before those at standstill.
    fn first(&self, speeds: &[f64]) -> Option<&Mode> {
        let modes = || speeds.iter().zip(&self.modes).filter_map(|(s, m)| Some((s, m.as_ref()?)));
        let rotating = modes().find(|(speed, _)| **speed != 0.0);
        rotating.or_else(|| modes().next()).map(|(_, mode)| mode)
    }
}

/// A branch with no similar mode (MAC) at the next speed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LostBranch {
    /// Index of the branch.
    pub branch: usize,
    /// Last speed at which it is known and next speed \[rad/s\].
    pub speeds: [f64; 2],
    /// Index of a new branch that starts at the next speed, if one of the lowest modes there has no branch.
    pub continued_by: Option<usize>,
}

/// Campbell diagram of the `count` lowest modes over increasing speeds \[rad/s\].
///
/// Modes of neighbouring speeds are paired by their mass-weighted MAC, |φ₁ᴴ M φ₂|², not by frequency order;
/// where the MAC is low, intermediate speeds are computed.
///
/// # Errors
/// Errors of the tangents or of the eigenvalue computation.
pub fn campbell(
    assembly: &Assembly,
    speeds: &[f64],
    count: usize,
    tangents: &impl Tangents,
) -> Result<Campbell, PhysicsError> {
    let tracker = Tracker { assembly, tangents, count: count + EXTRA_MODES };
    let sets: Vec<Vec<Mode>> =
        speeds.par_iter().map(|&s| tracker.modes(s)).collect::<Result<_, PhysicsError>>()?;
    // Index of every branch's mode in the mode set of the current speed.
    let mut at: Vec<Option<usize>> =
        (0..sets.first().map_or(0, |set| set.len().min(count))).map(Some).collect();
    let mut paths: Vec<Vec<Option<usize>>> = vec![at.clone()];
    let mut lost = Vec::new();
    for k in 1..speeds.len() {
        let (a, b) = ((speeds[k - 1], sets[k - 1].as_slice()), (speeds[k], sets[k].as_slice()));
        let links = tracker.link_modes(a, b, &at, MAX_HALVINGS)?;
        let next: Vec<Option<usize>> = at.iter().map(|i| i.and_then(|i| links[i])).collect();
        let ended: Vec<usize> = (0..at.len()).filter(|&i| at[i].is_some() && next[i].is_none()).collect();
        at = next;
        for branch in ended {
            let free = (0..sets[k].len().min(count)).find(|&j| !at.contains(&Some(j)));
            let continued_by = free.map(|j| {
                at.push(Some(j));
                at.len() - 1
            });
            lost.push(LostBranch { branch, speeds: [speeds[k - 1], speeds[k]], continued_by });
        }
        paths.push(at.clone());
    }
    let value = |mode: &Mode| ModeValue { eigenvalue: mode.eigenvalue, label: mode.label.clone() };
    let all = sets.iter().map(|set| set.iter().map(value).collect()).collect();
    // No two branches have a mode in common, so that each can be moved into its own.
    let mut sets: Vec<Vec<Option<Mode>>> =
        sets.into_iter().map(|set| set.into_iter().map(Some).collect()).collect();
    let mut branches: Vec<Branch> = (0..at.len())
        .map(|branch| {
            let index = |path: &Vec<Option<usize>>| path.get(branch).copied().flatten();
            let modes = paths.iter().zip(&mut sets).map(|(path, set)| set[index(path)?].take()).collect();
            let mut branch = Branch { label: String::new(), kind: ModeKind::Mixed, modes };
            if let Some((label, kind)) = branch.first(speeds).map(|m| (m.label.clone(), m.kind)) {
                (branch.label, branch.kind) = (label, kind);
            }
            branch
        })
        .collect();
    make_labels_unique(&mut branches);
    Ok(Campbell { speeds: speeds.to_vec(), branches, lost, count, all })
}

/// Makes labels unique by a number: branches that start at different speeds may have the same label.
fn make_labels_unique(branches: &mut [Branch]) {
    for k in 1..branches.len() {
        let same = (0..k).filter(|&i| branches[i].label == branches[k].label).count();
        if same > 0 {
            branches[k].label = format!("{} ({})", branches[k].label, same + 1);
        }
    }
}

/// Mode tracking from speed to speed.
pub(super) struct Tracker<'a, T> {
    pub assembly: &'a Assembly,
    pub tangents: &'a T,
    pub count: usize,
}

impl<T: Tangents> Tracker<'_, T> {
    /// Modes at a speed.
    pub fn modes(&self, speed: f64) -> Result<Vec<Mode>, PhysicsError> {
        let system = LinearSystem::new(self.assembly, &(self.tangents)(speed)?, speed)?;
        modal::modes(self.assembly, &system, self.count)
    }

    /// Continuation of every mode of `a` in `b`; the step is halved until those in `tracked` are certain.
    fn link_modes(
        &self,
        a: (f64, &[Mode]),
        b: (f64, &[Mode]),
        tracked: &[Option<usize>],
        depth: usize,
    ) -> Result<Vec<Option<usize>>, PhysicsError> {
        let mac = self.mac(a.1, b.1);
        let links = pair_by_mac(&mac);
        let uncertain = |i: usize| links[i].is_none_or(|j| mac[i][j] < CERTAIN_MAC);
        if depth == 0 || !tracked.iter().flatten().any(|&i| uncertain(i)) {
            return Ok(links);
        }
        let speed = 0.5 * (a.0 + b.0);
        let middle = self.modes(speed)?;
        let first = self.link_modes(a, (speed, &middle), tracked, depth - 1)?;
        let half_way: Vec<Option<usize>> = tracked.iter().map(|i| i.and_then(|i| first[i])).collect();
        let second = self.link_modes((speed, &middle), b, &half_way, depth - 1)?;
        Ok(first.into_iter().map(|i| i.and_then(|i| second[i])).collect())
    }

    /// Continuation of every mode of `a` in `b`, as between two speeds of a diagram.
    pub fn continued(
        &self,
        a: (f64, &[Mode]),
        b: (f64, &[Mode]),
        tracked: &[Option<usize>],
    ) -> Result<Vec<Option<usize>>, PhysicsError> {
        self.link_modes(a, b, tracked, MAX_HALVINGS)
    }

    /// Index of the mode that is the most similar to all of `ends` by the sum of the MAC; of those of a repeated eigenvalue, which
    /// share it, the one whose own shape is.
    pub fn most_similar(&self, ends: &[Mode], modes: &[Mode]) -> Option<usize> {
        /// Largest difference of sums that count as equal.
        const EQUAL: f64 = 1e-3;
        let (shared, own) = (self.mac(ends, modes), self.own_mac(ends, modes));
        let sum = |mac: &[Vec<f64>], j: usize| mac.iter().map(|row| row[j]).sum::<f64>();
        let best = (0..modes.len()).map(|j| sum(&shared, j)).max_by(f64::total_cmp)?;
        let equal = (0..modes.len()).filter(|&j| sum(&shared, j) > best - EQUAL);
        equal.max_by(|&i, &j| sum(&own, i).total_cmp(&sum(&own, j)))
    }

    /// MAC matrix between the modes of `a` and `b`, each by its own shape.
    fn own_mac(&self, a: &[Mode], b: &[Mode]) -> Vec<Vec<f64>> {
        let momenta: Vec<Vec<Complex64>> =
            b.iter().map(|m| self.assembly.mass.mul_complex(&m.shape)).collect();
        a.iter().map(|m| momenta.iter().map(|p| inner(&m.shape, p).norm_sqr()).collect()).collect()
    }

    /// MAC matrix between the modes of `a` and `b`; modes of a repeated eigenvalue share their sum, since any
    /// linear combination of them is a mode too.
    pub fn mac(&self, a: &[Mode], b: &[Mode]) -> Vec<Vec<f64>> {
        let plain = self.own_mac(a, b);
        let same = |p: &Mode, q: &Mode| (p.eigenvalue - q.eigenvalue).norm() < 1e-7 * q.natural_omega();
        let mut shared = plain.clone();
        for (i, row) in shared.iter_mut().enumerate() {
            for (j, value) in row.iter_mut().enumerate() {
                let left: f64 = (0..a.len()).filter(|&k| same(&a[k], &a[i])).map(|k| plain[k][j]).sum();
                let right: f64 = (0..b.len()).filter(|&k| same(&b[k], &b[j])).map(|k| plain[i][k]).sum();
                *value = left.max(right).min(1.0);
            }
        }
        shared
    }
}

/// Greedy pairing of rows with columns by descending MAC; ties are resolved by list order.
fn pair_by_mac(mac: &[Vec<f64>]) -> Vec<Option<usize>> {
    let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
    for (i, row) in mac.iter().enumerate() {
        pairs.extend(row.iter().enumerate().filter(|(_, v)| **v > LOST_MAC).map(|(j, v)| (*v, i, j)));
    }
    // Rounded, so that a degenerate pair with equal MAC is paired in list order.
    let step = |v: f64| (v * 1e4).round() as i64;
    pairs.sort_by_key(|&(v, i, j)| (-step(v), i, j));
    let mut links = vec![None; mac.len()];
    let mut taken = vec![false; mac.first().map_or(0, Vec::len)];
    for (_, i, j) in pairs {
        if links[i].is_none() && !taken[j] {
            links[i] = Some(j);
            taken[j] = true;
        }
    }
    links
}

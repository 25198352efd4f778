//! Automatic pole selection from the stabilisation diagram: clusters of poles that many orders share.
//!
//! Every candidate is scored by its similarity to poles of the other orders in frequency, damping,
//! participation and shape; the best is taken with all similar ones as a cluster, until the remaining support
//! is too small. Overlapping clusters are one mode, unless the residues there have rank two (repeated poles).

use nalgebra::DMatrix;

use super::data::Data;
use super::lsfd::free_residues;
use super::mac::mac;
use super::plscf::{Pole, StablePole, damping_ratio, normalise_largest};
use super::stabilisation::Candidate;
use rotordyn_linalg::Complex64;

/// Relative difference of frequency at which the similarity is zero.
const FREQUENCY_TOLERANCE: f64 = 0.005;
/// Likewise, difference of damping over its mean.
const DAMPING_TOLERANCE: f64 = 0.6;
/// Likewise, 1 − MAC of the residues.
const MAC_TOLERANCE: f64 = 0.15;
/// Minimum support of a mode, relative to the number of orders.
const MIN_SUPPORT: f64 = 0.1;
/// Distance of two poles, relative to their decay rate, below which they may be duplicates of one mode.
const DUPLICATE_DISTANCE: f64 = 0.8;
/// Ratio of second to first singular value of the residues from which there is a second mode.
const SECOND_MODE_RATIO: f64 = 0.2;

/// Similar poles of many orders.
pub(super) struct Cluster {
    /// Median of the poles.
    pub value: Complex64,
    participation: Vec<Complex64>,
    /// Sum over the orders of the similarity to the seed.
    pub score: f64,
    /// Mean number of poles per order in the cluster.
    multiplicity: f64,
    /// Standard deviations of the real and imaginary part over the members.
    spread: [f64; 2],
    /// Indices of the candidates.
    pub members: Vec<usize>,
}

impl Cluster {
    /// The pole of the cluster, of `orders` orders.
    fn pole(&self, orders: usize) -> Pole {
        let support = self.score / orders as f64;
        let stable = StablePole { value: self.value, spread: self.spread, support };
        Pole { stable: Some(stable), ..Pole::new(self.value, self.participation.clone()) }
    }
}

/// Selected poles in order of frequency: start values of the refinement.
pub(super) fn select_poles(data: &Data, candidates: &[Candidate], orders: usize) -> Vec<Pole> {
    let mut clusters = clusters(candidates, orders);
    clusters.sort_by(|a, b| a.value.im.total_cmp(&b.value.im));
    let mut groups: Vec<Vec<Cluster>> = Vec::new();
    for cluster in clusters {
        let near = |c: &Cluster| {
            (c.value - cluster.value).norm()
                < DUPLICATE_DISTANCE * c.value.re.abs().min(cluster.value.re.abs())
        };
        match groups.last_mut() {
            Some(group) if group.iter().any(near) => group.push(cluster),
            _ => groups.push(vec![cluster]),
        }
    }
    let best = |group: &[Cluster]| {
        group.iter().enumerate().fold(0, |b, (k, c)| if c.score > group[b].score { k } else { b })
    };
    let values: Vec<Complex64> = groups.iter().map(|group| group[best(group)].value).collect();
    let several = |group: &Vec<Cluster>| group.len() > 1 || group[0].multiplicity > 1.4;
    let residues = if groups.iter().any(several) { free_residues(data, &values) } else { Vec::new() };
    let mut poles = Vec::new();
    for (k, mut group) in groups.into_iter().enumerate() {
        let first = group.swap_remove(best(&group));
        if group.is_empty() && first.multiplicity <= 1.4 {
            poles.push(first.pole(orders));
            continue;
        }
        let (directions, sizes) = directions(&residues[k]);
        if sizes.len() < 2 || sizes[1] < SECOND_MODE_RATIO * sizes[0] {
            poles.push(first.pole(orders));
            continue;
        }
        // Second mode: the cluster with the lowest MAC to the first, else the residues' second direction.
        let unlike = group.into_iter().min_by(|a, b| {
            let participation_mac = |c: &Cluster| mac(&c.participation, &first.participation);
            participation_mac(a).total_cmp(&participation_mac(b))
        });
        match unlike.filter(|c| mac(&c.participation, &first.participation) < 0.8) {
            Some(second) => {
                poles.push(first.pole(orders));
                poles.push(second.pole(orders));
            }
            None => {
                for direction in directions.into_iter().take(2) {
                    let pole = first.pole(orders);
                    poles.push(Pole { participation: normalise_largest(direction), ..pole });
                }
            }
        }
    }
    poles
}

/// Clusters of similar poles, in order of their support.
pub(super) fn clusters(candidates: &[Candidate], orders: usize) -> Vec<Cluster> {
    let mut places: Vec<usize> = (0..candidates.len()).collect();
    places.sort_by(|&a, &b| {
        let (a, b) = (&candidates[a], &candidates[b]);
        a.pole.value.im.total_cmp(&b.pole.value.im).then(a.order.cmp(&b.order))
    });
    let sorted: Vec<&Candidate> = places.iter().map(|&k| &candidates[k]).collect();
    let n = sorted.len();
    // Similarity 0..1 with the neighbours in frequency.
    let mut similar: Vec<Vec<(usize, f64)>> = vec![Vec::new(); n];
    for i in 0..n {
        similar[i].push((i, 1.0));
        for j in i + 1..n {
            if sorted[j].pole.value.im > sorted[i].pole.value.im * (1.0 + FREQUENCY_TOLERANCE) {
                break;
            }
            let value = similarity(sorted[i], sorted[j]);
            if value > 0.0 {
                similar[i].push((j, value));
                similar[j].push((i, value));
            }
        }
    }
    let mut alive = vec![true; n];
    let mut out = Vec::new();
    let mut best = vec![0.0f64; orders];
    loop {
        let mut top = (0.0, 0);
        for i in (0..n).filter(|&i| alive[i]) {
            best.fill(0.0);
            for &(j, value) in similar[i].iter().filter(|(j, _)| alive[*j]) {
                let slot = &mut best[sorted[j].order];
                *slot = slot.max(value);
            }
            let score = best.iter().sum::<f64>();
            if score > top.0 {
                top = (score, i);
            }
        }
        let (score, seed) = top;
        if score < (MIN_SUPPORT * orders as f64).max(2.0) {
            return out;
        }
        let members: Vec<usize> = similar[seed].iter().map(|(j, _)| *j).filter(|&j| alive[j]).collect();
        out.push(Cluster {
            members: members.iter().map(|&j| places[j]).collect(),
            ..cluster(&sorted, &members, seed, score)
        });
        members.iter().for_each(|&j| alive[j] = false);
    }
}

fn cluster(sorted: &[&Candidate], members: &[usize], seed: usize, score: f64) -> Cluster {
    let value = |part: &dyn Fn(&Complex64) -> f64| {
        let mut list: Vec<f64> = members.iter().map(|&j| part(&sorted[j].pole.value)).collect();
        list.sort_by(f64::total_cmp);
        list[list.len() / 2]
    };
    let spread = |part: &dyn Fn(&Complex64) -> f64| {
        let count = members.len() as f64;
        let list = || members.iter().map(|&j| part(&sorted[j].pole.value));
        let mean = list().sum::<f64>() / count;
        (list().map(|v| (v - mean).powi(2)).sum::<f64>() / (count - 1.0).max(1.0)).sqrt()
    };
    let mut seen: Vec<usize> = members.iter().map(|&j| sorted[j].order).collect();
    seen.sort_unstable();
    seen.dedup();
    Cluster {
        value: Complex64::new(value(&|v| v.re), value(&|v| v.im)),
        participation: sorted[seed].pole.participation.clone(),
        score,
        multiplicity: members.len() as f64 / seen.len() as f64,
        spread: [spread(&|v| v.re), spread(&|v| v.im)],
        members: Vec::new(),
    }
}

/// Similarity of two poles: 1 if equal, falling to 0 with the square of their scaled distance.
fn similarity(a: &Candidate, b: &Candidate) -> f64 {
    let (va, vb) = (a.pole.value, b.pole.value);
    let apart = (va.im - vb.im) / va.im.min(vb.im) / FREQUENCY_TOLERANCE;
    let (za, zb) = (damping_ratio(va), damping_ratio(vb));
    let damped = 2.0 * (za - zb) / (za + zb) / DAMPING_TOLERANCE;
    let mut distance = apart * apart + damped * damped;
    if distance < 1.0 && !a.double && !b.double {
        let same = mac(&a.shape, &b.shape) * mac(&a.pole.participation, &b.pole.participation);
        distance += (1.0 - same) / MAC_TOLERANCE;
    }
    (1.0 - distance).max(0.0)
}

/// Right singular vectors of a residue matrix (as participations) and its singular values, descending.
pub(super) fn directions(residue: &DMatrix<Complex64>) -> (Vec<Vec<Complex64>>, Vec<f64>) {
    let svd = residue.clone().svd(false, true);
    let Some(v) = svd.v_t else { return (Vec::new(), Vec::new()) };
    let mut order: Vec<usize> = (0..svd.singular_values.len()).collect();
    order.sort_by(|a, b| svd.singular_values[*b].total_cmp(&svd.singular_values[*a]));
    // R = Σ σ u vᴴ: the rows of vᴴ are the participations.
    let list = order.iter().map(|&k| v.row(k).iter().copied().collect()).collect();
    (list, order.iter().map(|&k| svd.singular_values[k]).collect())
}

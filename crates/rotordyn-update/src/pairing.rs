//! Mode pairing: assignment of measured to computed modes by MAC and frequency.

use rotordyn_identify::mac::mac_matrix;
use rotordyn_linalg::Complex64;

/// Minimum MAC of a mode pair.
pub const MIN_MAC: f64 = 0.3;
/// Standard deviation of ln(f_computed/f_measured) in the pair score.
const FREQUENCY_SPREAD: f64 = 0.25;

/// A pair of a measured and a computed mode, by index.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    pub measured: usize,
    pub computed: usize,
    pub mac: f64,
}

/// Mode pairs, unpaired modes and the MAC matrix.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pairing {
    /// In order of the measured mode.
    pub pairs: Vec<Pair>,
    pub unpaired_measured: Vec<usize>,
    pub unpaired_computed: Vec<usize>,
    /// `mac[measured][computed]`.
    pub mac: Vec<Vec<f64>>,
}

/// A mode to be paired: frequency \[Hz\] and shape over the measured points.
#[derive(Clone, Copy, Debug)]
pub struct Candidate<'a> {
    pub frequency_hz: f64,
    pub shape: &'a [Complex64],
}

/// Pair score MAC · exp(−½ (ln(f_c/f_m)/0.25)²); 0 for a MAC < 0.3 or frequencies a factor ≥ 2 apart.
pub fn pair_score(mac: f64, computed_hz: f64, measured_hz: f64) -> f64 {
    let apart = (computed_hz / measured_hz).ln();
    let near = apart.abs() < std::f64::consts::LN_2;
    if near && mac >= MIN_MAC { mac * (-0.5 * (apart / FREQUENCY_SPREAD).powi(2)).exp() } else { 0.0 }
}

/// Optimal pairing: the assignment with the largest sum of [`pair_score`]; modes of zero score are not paired.
pub fn pair_modes(measured: &[Candidate], computed: &[Candidate]) -> Pairing {
    let measured_shapes: Vec<&[Complex64]> = measured.iter().map(|c| c.shape).collect();
    let computed_shapes: Vec<&[Complex64]> = computed.iter().map(|c| c.shape).collect();
    let mac = mac_matrix(&measured_shapes, &computed_shapes);
    let score =
        |m: usize, c: usize| pair_score(mac[m][c], computed[c].frequency_hz, measured[m].frequency_hz);
    let scores: Vec<Vec<f64>> =
        (0..measured.len()).map(|m| (0..computed.len()).map(|c| score(m, c)).collect()).collect();
    let chosen = assign(&scores);
    let pairs: Vec<Pair> = chosen
        .iter()
        .enumerate()
        .filter_map(|(measured, computed)| {
            let computed = (*computed)?;
            let is_pair = scores[measured][computed] > 0.0;
            is_pair.then(|| Pair { measured, computed, mac: mac[measured][computed] })
        })
        .collect();
    let left = |count: usize, taken: &dyn Fn(usize) -> bool| (0..count).filter(|&k| !taken(k)).collect();
    Pairing {
        unpaired_measured: left(measured.len(), &|k| pairs.iter().any(|p| p.measured == k)),
        unpaired_computed: left(computed.len(), &|k| pairs.iter().any(|p| p.computed == k)),
        pairs,
        mac,
    }
}

/// Optimal assignment of rows to columns with the largest sum of scores (Hungarian algorithm, Kuhn-Munkres).
///
/// Rows beyond the number of columns get none. Cost O(rows² · columns).
pub fn assign(score: &[Vec<f64>]) -> Vec<Option<usize>> {
    let (rows, columns) = (score.len(), score.first().map_or(0, Vec::len));
    if rows == 0 || columns == 0 {
        return vec![None; rows];
    }
    if rows > columns {
        let transposed: Vec<Vec<f64>> =
            (0..columns).map(|c| (0..rows).map(|r| score[r][c]).collect()).collect();
        let mut out = vec![None; rows];
        for (column, row) in assign(&transposed).into_iter().enumerate() {
            if let Some(row) = row {
                out[row] = Some(column);
            }
        }
        return out;
    }
    // Row and column 0 mean unassigned; potentials u, v keep reduced costs non-negative.
    let (mut u, mut v) = (vec![0.0; rows + 1], vec![0.0; columns + 1]);
    let mut row_of = vec![0; columns + 1];
    for row in 1..=rows {
        row_of[0] = row;
        let mut column = 0;
        let mut least = vec![f64::INFINITY; columns + 1];
        let mut from = vec![0; columns + 1];
        let mut done = vec![false; columns + 1];
        while row_of[column] != 0 {
            done[column] = true;
            let (here, mut step, mut next) = (row_of[column], f64::INFINITY, 0);
            for c in (1..=columns).filter(|&c| !done[c]) {
                let reduced = -score[here - 1][c - 1] - u[here] - v[c];
                if reduced < least[c] {
                    (least[c], from[c]) = (reduced, column);
                }
                if least[c] < step {
                    (step, next) = (least[c], c);
                }
            }
            for c in 0..=columns {
                if done[c] {
                    u[row_of[c]] += step;
                    v[c] -= step;
                } else {
                    least[c] -= step;
                }
            }
            column = next;
        }
        while column != 0 {
            row_of[column] = row_of[from[column]];
            column = from[column];
        }
    }
    let mut out = vec![None; rows];
    for (column, &row) in row_of.iter().enumerate().skip(1).filter(|(_, row)| **row != 0) {
        out[row - 1] = Some(column - 1);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn assignment_is_optimal() {
        // Compared with every permutation, on pseudo-random numbers.
        let mut seed = 12345_u64;
        let mut number = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 33) as f64 / f64::from(1u32 << 31)
        };
        for _ in 0..20 {
            let score: Vec<Vec<f64>> = (0..4).map(|_| (0..5).map(|_| number()).collect()).collect();
            let sum = |choice: &[usize]| choice.iter().enumerate().map(|(r, &c)| score[r][c]).sum::<f64>();
            let mut best: f64 = 0.0;
            for code in 0..5usize.pow(4) {
                let choice: Vec<usize> = (0..4).map(|r| code / 5usize.pow(r) % 5).collect();
                let distinct = (0..4).all(|r| (0..r).all(|s| choice[r] != choice[s]));
                if distinct {
                    best = best.max(sum(&choice));
                }
            }
            let chosen: Vec<usize> = assign(&score).into_iter().map(Option::unwrap).collect();
            assert!((sum(&chosen) - best).abs() < 1e-12);
        }
    }

    #[test]
    fn more_rows_than_columns_leave_the_lowest_score_out() {
        assert_eq!(assign(&[vec![0.1], vec![0.9], vec![0.5]]), [None, Some(0), None]);
        assert_eq!(assign(&[]), Vec::<Option<usize>>::new());
    }

    #[test]
    fn pairs_by_shape_where_frequencies_have_crossed() {
        let c = |re: f64| Complex64::new(re, 0.0);
        let (x, y) = (vec![c(1.0), c(0.1)], vec![c(0.1), c(-1.0)]);
        let at = |hz, shape| Candidate { frequency_hz: hz, shape };
        let found = pair_modes(&[at(10.0, &x), at(12.0, &y)], &[at(10.5, &y), at(11.5, &x), at(40.0, &x)]);
        let pairs: Vec<(usize, usize)> = found.pairs.iter().map(|p| (p.measured, p.computed)).collect();
        assert_eq!(pairs, [(0, 1), (1, 0)]);
        assert_eq!((found.unpaired_measured, found.unpaired_computed), (vec![], vec![2]));
    }
}

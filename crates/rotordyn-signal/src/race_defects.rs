//! Localised race defects (dents and bumps) from jerk jumps, synchronously averaged over ball passages.

use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

use rustfft::num_complex::Complex;

use super::SignalError;
use super::error::{check, check_length, check_rate, check_record, check_same_length};
use super::jerk::{Jump, find_jumps, second_differences};

/// Detection threshold for a jump of the folded profile, in robust standard deviations.
const THRESHOLD: f64 = 10.0;

/// Kinematics of the ball passages over a race.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallPassage {
    /// Ball pass frequency of the race, BPFO or BPFI \[Hz\].
    pub frequency: f64,
    /// Number of balls Z, 2π/Z apart.
    pub balls: usize,
    /// Rotational speed of the race \[rev/s\], + from x to y: 0 for a fixed outer race, else the shaft speed.
    pub race_speed: f64,
    /// Reference time \[s\] from the first sample: a ball is at angle 0 of the race, which lies along x.
    pub datum: f64,
}

/// Kind of a localised race defect.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum DefectKind {
    /// Depression (spall): the contact force drops, then rises.
    Dent,
    /// Elevation: the contact force rises, then drops.
    Bump,
}

/// A detected race defect.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RaceDefect {
    /// Start angle, in the direction of increasing angle \[rad\]: 0..2π with two channels, 0..2π/Z with one.
    pub angle: f64,
    /// Angular width \[rad\]; times the raceway radius it is a length (Atef eq. 2).
    pub width: f64,
    pub kind: DefectKind,
    /// Size of the two jumps of the jerk \[unit/s\].
    pub jumps: [f64; 2],
}

/// Jerk changes over one ball spacing of a race, averaged over all ball passages (folded).
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct FoldedJerk {
    /// Angle on the race of each bin \[rad\], 0..2π/Z.
    pub angles: Vec<f64>,
    /// Change of the jerk from bin to bin \[unit/s\], in race-fixed axes (x + jy).
    pub changes: Vec<Complex<f64>>,
    /// Detected jumps: angle \[rad\] and size.
    pub jumps: Vec<(f64, Complex<f64>)>,
}

/// Folds (synchronously averages) the second differences of the outer ring's acceleration over the ball
/// passages and detects the jumps.
///
/// Ball angle φ = ± (2π/Z) f t from the datum (− on a race that rotates faster than the cage); x + jy is
/// transformed to race-fixed axes by e^{−jω t}. Noise is reduced by the root of the number of passages;
/// resolution is below a sample. `x`, `y` (N) \[m/s²\]; without `y` only x is used, as the radial direction
/// of every defect.
/// Errors: NaN, unequal lengths, a record shorter than three passages, fewer than 48 samples in a passage.
pub fn fold_jerk(
    x: &[f64],
    y: Option<&[f64]>,
    sample_rate: f64,
    passage: &BallPassage,
) -> Result<FoldedJerk, SignalError> {
    check_record("x", x)?;
    check_rate(sample_rate)?;
    check(
        passage.frequency > 0.0 && passage.frequency.is_finite(),
        "ball pass frequency",
        "a positive number of Hz",
        passage.frequency,
    )?;
    check(passage.balls >= 1, "number of balls", "one or more", passage.balls as f64)?;
    check(passage.race_speed.is_finite(), "speed of the race", "a number", passage.race_speed)?;
    check(passage.datum.is_finite(), "datum", "a time", passage.datum)?;
    if let Some(y) = y {
        check_record("y", y)?;
        check_same_length("y", y.len(), "x", x.len())?;
    }
    let per_passage = sample_rate / passage.frequency;
    if per_passage < 48.0 {
        let (needed, purpose) = (48.0 * passage.frequency, "jumps of the jerk within a ball passage");
        return Err(SignalError::RateTooLow { given: sample_rate, needed, purpose });
    }
    check_length("x", x.len(), (3.0 * per_passage).ceil() as usize + 2, "three ball passages")?;
    let bins = per_passage.round() as usize;
    let (mut sums, mut weights) = (vec![Complex::<f64>::ZERO; bins], vec![0.0; bins]);
    let changes_y: Box<dyn Iterator<Item = f64>> = match y {
        Some(y) => Box::new(second_differences(y)),
        None => Box::new(std::iter::repeat(0.0)),
    };
    let backward = passage.race_speed * passage.balls as f64 > passage.frequency;
    for (n, (cx, cy)) in second_differences(x).zip(changes_y).enumerate() {
        let t = (n + 1) as f64 / sample_rate - passage.datum;
        let turn =
            if y.is_some() { Complex::from_polar(1.0, -TAU * passage.race_speed * t) } else { Complex::ONE };
        let value = Complex::new(cx, cy) * turn;
        let passages = passage.frequency * t * if backward { -1.0 } else { 1.0 };
        let place = passages.rem_euclid(1.0) * bins as f64;
        let (bin, part) = (place as usize, place.fract());
        for (k, w) in [(bin % bins, 1.0 - part), ((bin + 1) % bins, part)] {
            sums[k] += value * w;
            weights[k] += w;
        }
    }
    let profile: Vec<_> =
        sums.iter().zip(&weights).map(|(s, w)| if *w > 0.0 { s / *w } else { Complex::ZERO }).collect();
    let spacing = TAU / passage.balls as f64;
    let to_angle = |place: f64| (place / bins as f64).rem_euclid(1.0) * spacing;
    let jumps = find_jumps(&profile, THRESHOLD, true)?;
    Ok(FoldedJerk {
        angles: (0..bins).map(|k| to_angle(k as f64)).collect(),
        changes: profile.iter().map(|c| c * sample_rate).collect(),
        jumps: jumps.iter().map(|Jump { place, size }| (to_angle(*place), size * sample_rate)).collect(),
    })
}

/// Detects dents and bumps of a race: start angle, width and kind.
///
/// A ball entering a half-sine bump causes an outward kink of the ring's acceleration, and another one on
/// leaving; a dent causes inward kinks, and between the two the jerk returns. Jumps of the folded profile
/// ([`fold_jerk`]) of the same direction are paired accordingly. With two channels the direction of the
/// kinks, outward or inward, determines the ball spacing that contains the defect: uniquely for an odd number
/// of balls, on the x half of the race for an even one.
/// `x`, `y` are the outer ring's acceleration \[m/s²\]; x alone must point outward at the defects, and angles
/// are then ambiguous by multiples of 2π/Z. Errors as [`fold_jerk`]. Source: Atef et al., Machines 10:1062
/// (2022), section 3 and eq. 20-22.
pub fn race_defects(
    x: &[f64],
    y: Option<&[f64]>,
    sample_rate: f64,
    passage: &BallPassage,
) -> Result<Vec<RaceDefect>, SignalError> {
    let fold = fold_jerk(x, y, sample_rate, passage)?;
    let spacing = TAU / passage.balls as f64;
    let mut defects: Vec<RaceDefect> = pair_jumps(&fold)
        .into_iter()
        .map(|(entry, exit)| {
            let ((begin, first), (end, second)) = (fold.jumps[entry], fold.jumps[exit]);
            let width = (end - begin).rem_euclid(spacing);
            let (turns, kind) = match y {
                Some(_) => place_and_kind(begin, width, first + second, passage.balls),
                None => (0, defect_kind(first.re + second.re)),
            };
            RaceDefect {
                angle: begin + turns as f64 * spacing,
                width,
                kind,
                jumps: [first, second].map(|j| match kind {
                    DefectKind::Bump => j.norm(),
                    DefectKind::Dent => -j.norm(),
                }),
            }
        })
        .collect();
    defects.sort_by(|a, b| a.angle.total_cmp(&b.angle));
    Ok(defects)
}

fn defect_kind(outward: f64) -> DefectKind {
    if outward > 0.0 { DefectKind::Bump } else { DefectKind::Dent }
}

/// The ball spacing k and the kind for which ± e^{j(φ + k 2π/Z)} is best aligned with the kinks.
fn place_and_kind(begin: f64, width: f64, kinks: Complex<f64>, balls: usize) -> (usize, DefectKind) {
    let direction = kinks / kinks.norm();
    let candidates = (0..balls).flat_map(|k| {
        let angle = begin + 0.5 * width + TAU * k as f64 / balls as f64;
        let outward = (Complex::from_polar(1.0, -angle) * direction).re;
        // Tie: the one on the half of the race around +x.
        let near_x = if angle.cos() > 0.0 { 1e-6 } else { 0.0 };
        [(outward + near_x, k, DefectKind::Bump), (near_x - outward, k, DefectKind::Dent)]
    });
    let (_, k, kind) = candidates.max_by(|a, b| a.0.total_cmp(&b.0)).expect("there is at least one ball");
    (k, kind)
}

/// Pairs neighbouring jumps of the same direction between which the jerk returns: (entry, exit).
///
/// Greedy, in order of the returned fraction: between the jumps of one defect the jerk returns by about their
/// sum, between two adjacent defects of one kind it does not.
fn pair_jumps(fold: &FoldedJerk) -> Vec<(usize, usize)> {
    let count = fold.jumps.len();
    if count < 2 {
        return Vec::new();
    }
    // Fraction of two jumps that the smooth profile between them reverses, 0..1 or more.
    let reversed_fraction = |i: usize| {
        let ((from, first), (to, second)) = (fold.jumps[i], fold.jumps[(i + 1) % count]);
        let total = first + second;
        let same_way = (first * second.conj()).re > 0.5 * first.norm() * second.norm();
        if !same_way || count == 2 && i == 1 && (to - from).rem_euclid(fold.spacing()) > 0.5 * fold.spacing()
        {
            return 0.0;
        }
        -(fold.smooth_change_between(from, to) * total.conj()).re / total.norm_sqr()
    };
    let strength: Vec<f64> = (0..count).map(reversed_fraction).collect();
    let mut order: Vec<usize> = (0..count).filter(|i| strength[*i] > 0.5).collect();
    order.sort_by(|a, b| strength[*b].min(1.0).total_cmp(&strength[*a].min(1.0)).then(a.cmp(b)));
    let mut taken = vec![false; count];
    let mut pairs = Vec::new();
    for i in order {
        let next = (i + 1) % count;
        if !taken[i] && !taken[next] {
            taken[i] = true;
            taken[next] = true;
            pairs.push((i, next));
        }
    }
    pairs
}

impl FoldedJerk {
    fn spacing(&self) -> f64 {
        TAU.min(self.angles[1] * self.angles.len() as f64)
    }

    /// Change of the jerk between two angles; bins of the jumps at its ends are set to the mean of the
    /// others.
    fn smooth_change_between(&self, from: f64, to: f64) -> Complex<f64> {
        let bins = self.changes.len();
        let step = self.angles[1];
        let length = ((to - from).rem_euclid(self.spacing()) / step).round() as usize;
        let first = (from / step).round() as usize;
        let inner: Vec<Complex<f64>> =
            (3..length.saturating_sub(2)).map(|k| self.changes[(first + k) % bins]).collect();
        if inner.is_empty() {
            return Complex::ZERO;
        }
        inner.iter().sum::<Complex<f64>>() / inner.len() as f64 * length as f64
    }
}

//! Dents and bumps of a race from the jumps of the jerk, folded over the passages of the balls.

use std::f64::consts::TAU;

use rustfft::num_complex::Complex;

use super::SignalError;
use super::error::{check, check_length, check_rate, check_record, check_same_length};
use super::jerk::{Jump, find_jumps, second_differences};

/// Robust standard deviations that a jump of the folded profile must stand out.
const THRESHOLD: f64 = 10.0;

/// How balls pass the places of a race.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallPassage {
    /// Balls past a point of the race per second, BPFO or BPFI \[Hz\].
    pub frequency: f64,
    /// Number of balls Z, 2π/Z apart.
    pub balls: usize,
    /// Turning of the race in space \[rev/s\], + from x to y: 0 for the outer race, the shaft's speed for the inner one.
    pub race_speed: f64,
    /// Time \[s\] from the first sample at which a ball stands at the race's angle 0 and that angle lies along x.
    pub datum: f64,
}

/// What a defect does to a ball.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DefectKind {
    /// Lets the ball in: contact force falls, then rises.
    Dent,
    /// Presses on the ball: contact force rises, then falls.
    Bump,
}

/// A defect found on a race.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RaceDefect {
    /// Where it begins, in the sense of growing angle \[rad\]: 0..2π with two channels, 0..2π/Z with one.
    pub angle: f64,
    /// Its width \[rad\]; times the raceway's radius it is a length (Atef eq. 2).
    pub width: f64,
    pub kind: DefectKind,
    /// Size of the two jumps of the jerk \[unit/s\].
    pub jumps: [f64; 2],
}

/// Jerk jumps over one ball spacing of a race: the fold of all passages.
#[derive(Clone, Debug)]
pub struct FoldedJerk {
    /// Angle on the race of each bin \[rad\], 0..2π/Z.
    pub angles: Vec<f64>,
    /// Change of the jerk from bin to bin \[unit/s\], in the race's own axes (x + jy).
    pub changes: Vec<Complex<f64>>,
    /// The jumps that stand out: angle \[rad\] and size.
    pub jumps: Vec<(f64, Complex<f64>)>,
}

/// Folds the second differences of the outer ring's acceleration over the passages of the balls and finds the jumps.
///
/// A ball stands at φ = ± (2π/Z) f t from the datum (− on a race that turns faster than the cage); x + jy is turned with
/// the race, e^{−jω t}. Noise falls by the root of the number of passages, and the fold is finer than a sample.
/// `x`, `y` (N) \[m/s²\]; without `y` only x is used, as the radial direction of every defect.
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
        let (needed, purpose) = (48.0 * passage.frequency, "jumps of the jerk within a ball's passage");
        return Err(SignalError::RateTooLow { given: sample_rate, needed, purpose });
    }
    check_length("x", x.len(), (3.0 * per_passage).ceil() as usize + 2, "three passages of balls")?;
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

/// Finds the dents and bumps of a race: where they begin, how wide they are, of which kind.
///
/// A ball that enters a half-sine bump kinks the ring's acceleration outward, and again when it leaves it; a dent kinks
/// it inward both times, and between the two the jerk runs back. Jumps of the fold ([`fold_jerk`]) that point the same
/// way are paired so. With two channels the direction of the kinks, outward or inward, singles out the ball spacing in
/// which the defect lies; an odd number of balls leaves no doubt, an even one takes the half of the race about x.
/// `x`, `y` are the outer ring's acceleration \[m/s²\]; x alone must point outward at the defects, and angles are then
/// known up to 2π/Z. Errors as [`fold_jerk`]. Source: Atef et al., Machines 10:1062 (2022), section 3 and eq. 20-22.
pub fn race_defects(
    x: &[f64],
    y: Option<&[f64]>,
    sample_rate: f64,
    passage: &BallPassage,
) -> Result<Vec<RaceDefect>, SignalError> {
    let fold = fold_jerk(x, y, sample_rate, passage)?;
    let spacing = TAU / passage.balls as f64;
    let mut defects: Vec<RaceDefect> = pairs(&fold)
        .into_iter()
        .map(|(entry, exit)| {
            let ((begin, first), (end, second)) = (fold.jumps[entry], fold.jumps[exit]);
            let width = (end - begin).rem_euclid(spacing);
            let (turns, kind) = match y {
                Some(_) => place_and_kind(begin, width, first + second, passage.balls),
                None => (0, kind_of(first.re + second.re)),
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

fn kind_of(outward: f64) -> DefectKind {
    if outward > 0.0 { DefectKind::Bump } else { DefectKind::Dent }
}

/// The ball spacing k and the kind for which ± e^{j(φ + k 2π/Z)} points most nearly along the kinks.
fn place_and_kind(begin: f64, width: f64, kinks: Complex<f64>, balls: usize) -> (usize, DefectKind) {
    let direction = kinks / kinks.norm();
    let candidates = (0..balls).flat_map(|k| {
        let angle = begin + 0.5 * width + TAU * k as f64 / balls as f64;
        let outward = (Complex::from_polar(1.0, -angle) * direction).re;
        // Of two that fit alike the one on the half of the race about x.
        let near_x = if angle.cos() > 0.0 { 1e-6 } else { 0.0 };
        [(outward + near_x, k, DefectKind::Bump), (near_x - outward, k, DefectKind::Dent)]
    });
    let (_, k, kind) = candidates.max_by(|a, b| a.0.total_cmp(&b.0)).expect("there is at least one ball");
    (k, kind)
}

/// Neighbouring jumps that point the same way, with the jerk running back between them: (entry, exit).
///
/// Of all ways to pair neighbours round the race the one that pairs most of the jumps' size: a defect's own pair has
/// the jerk run back by about the sum of its jumps, two defects side by side of one kind have none.
fn pairs(fold: &FoldedJerk) -> Vec<(usize, usize)> {
    let count = fold.jumps.len();
    if count < 2 {
        return Vec::new();
    }
    // How much of two jumps the smooth part of the profile between them undoes, 0..1 or more.
    let undone = |i: usize| {
        let ((from, first), (to, second)) = (fold.jumps[i], fold.jumps[(i + 1) % count]);
        let total = first + second;
        let same_way = (first * second.conj()).re > 0.5 * first.norm() * second.norm();
        if !same_way || count == 2 && i == 1 && (to - from).rem_euclid(fold.spacing()) > 0.5 * fold.spacing()
        {
            return 0.0;
        }
        -(fold.smooth_between(from, to) * total.conj()).re / total.norm_sqr()
    };
    let strength: Vec<f64> = (0..count).map(undone).collect();
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

    /// Change of the jerk between two angles, the bins of the jumps at its ends left out and replaced by their neighbours.
    fn smooth_between(&self, from: f64, to: f64) -> Complex<f64> {
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

//! Lines of FRFs that stand alone, such as those of the mains: neither their neighbours nor a mode explains them.

use rotordyn_linalg::Complex64;
use rotordyn_signal::record::FrfMatrix;

/// Deviation of a line from its neighbours over their magnitude, and over the roughness beside, from which it stands out.
const STANDS_OUT: f64 = 1.0;
const OVER_ROUGHNESS: f64 = 10.0;
/// Share of the FRFs in which it does.
const MIN_SHARE: f64 = 0.5;
/// Lines on either side over which the roughness is read.
const BESIDE: std::ops::Range<usize> = 4..8;

/// The FRFs with the lines that stand alone in most of them replaced by cubic interpolation, and the frequencies of these \[Hz\];
/// `None` if there are none.
///
/// A pole between lines, however light its damping, raises its neighbours with opposite signs and more than the lines farther
/// off; a line of the mains, which is no response to the force, raises itself alone, or with a Hann window also its neighbours.
/// Uniformly spaced frequencies are assumed.
pub fn without_single_lines(frfs: &FrfMatrix) -> Option<(FrfMatrix, Vec<f64>)> {
    let all: Vec<&Vec<Complex64>> = frfs.values.iter().flatten().collect();
    let lines = frfs.frequencies.len();
    let margin = BESIDE.end + 3;
    let mut found: Vec<(usize, usize)> = Vec::new();
    for k in margin..lines.saturating_sub(margin) {
        let share = |half: usize| all.iter().filter(|frf| stands_out(frf, k, half)).count() as f64;
        let least = MIN_SHARE * all.len() as f64;
        let half = (0..2).find(|half| share(*half) >= least);
        found.extend(half.map(|half| (k, half)));
    }
    if found.is_empty() {
        return None;
    }
    let mut repaired = frfs.clone();
    for frf in repaired.values.iter_mut().flatten() {
        for &(k, half) in &found {
            let (a, b) = (half as i32 + 1, half as i32 + 2);
            let at = |offset: i32| frf[(k as i32 + offset) as usize];
            let known = [-b, -a, a, b].map(|x| (x, at(x)));
            let value =
                |x: i32| known.iter().map(|&(own, h)| h * weight(own, x, [-b, -a, a, b])).sum::<Complex64>();
            let values: Vec<Complex64> = (-(half as i32)..=half as i32).map(value).collect();
            frf[k - half..=k + half].copy_from_slice(&values);
        }
    }
    Some((repaired, found.iter().map(|(k, _)| frfs.frequencies[*k]).collect()))
}

/// What is said of replaced lines.
pub fn single_lines_text(frequencies: &[f64]) -> String {
    const NAMED: usize = 6;
    let names: Vec<String> = frequencies.iter().take(NAMED).map(|hz| format!("{hz:.2}")).collect();
    let more = if frequencies.len() > NAMED { ", ..." } else { "" };
    format!(
        "single lines at {}{more} Hz stand out of their neighbours as no mode does, such as those of the mains: they are replaced \
         by interpolation",
        names.join(", ")
    )
}

/// Lagrange's weight of the point `own` of four at x.
fn weight(own: i32, x: i32, points: [i32; 4]) -> f64 {
    let others = points.iter().filter(|other| **other != own);
    others.map(|other| f64::from(x - other) / f64::from(own - other)).product()
}

/// Whether line k, with `half` lines on either side, stands alone in an FRF.
fn stands_out(frf: &[Complex64], k: usize, half: usize) -> bool {
    let (a, b) = (half + 1, half + 2);
    let off = |k: usize| {
        let points = [-(b as i32), -(a as i32), a as i32, b as i32];
        let expected: Complex64 =
            points.iter().map(|&x| frf[(k as i32 + x) as usize] * weight(x, 0, points)).sum();
        (frf[k] - expected).norm()
    };
    let near = [k - a, k + a].map(|j| frf[j].norm()).into_iter().fold(0.0, f64::max);
    let spike = off(k);
    if spike <= STANDS_OUT * near {
        return false;
    }
    let mut beside: Vec<f64> = BESIDE.flat_map(|j| [off(k - j), off(k + j)]).collect();
    beside.sort_by(f64::total_cmp);
    let roughness = beside[beside.len() / 2];
    let across = |j: usize| (frf[k + j] - frf[k - j]).norm();
    spike > OVER_ROUGHNESS * roughness && across(a) < across(b) + 3.0 * roughness
}

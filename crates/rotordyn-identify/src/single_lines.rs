//! Lines of FRFs at multiples of the mains that stand alone: neither their neighbours nor a mode explains them.

use rotordyn_linalg::Complex64;
use rotordyn_signal::record::FrfMatrix;

/// Magnitude of a line over those of its neighbours, and its deviation from them over the roughness beside, from which it stands
/// out.
const STANDS_OUT: f64 = 1.5;
const OVER_ROUGHNESS: f64 = 10.0;
/// Amplitude of a pole in the neighbours, at a distance of one line, over the roughness, up to which there is none.
const NO_POLE: f64 = 6.0;
/// Frequencies of mains, and the coarsest lines that tell their multiples \[Hz\].
const MAINS: [f64; 2] = [50.0, 60.0];
const COARSEST: f64 = 2.0;
/// Share of the FRFs in which it does.
const MIN_SHARE: f64 = 0.5;
/// Lines on either side over which the roughness is read.
const APART: std::ops::Range<usize> = 4..8;

/// The FRFs with the lines at multiples of 50 or 60 Hz that stand alone in most of them replaced by cubic interpolation, and the
/// frequencies of these \[Hz\]; `None` if there are none.
///
/// A pole near a line, however light its damping, has its part R/x in the lines at ±x beside; a line of the mains, which is no
/// response to the force, stands alone, or with a Hann window with its neighbours.
/// Uniformly spaced frequencies are assumed.
pub fn without_single_lines(frfs: &FrfMatrix) -> Option<(FrfMatrix, Vec<f64>)> {
    let all: Vec<&Vec<Complex64>> = frfs.values.iter().flatten().collect();
    let lines = frfs.frequencies.len();
    let margin = APART.end + 3;
    let mut found: Vec<(usize, usize)> = Vec::new();
    let step = frfs.frequencies.get(1).map_or(0.0, |second| second - frfs.frequencies[0]);
    let of_mains = |k: usize| {
        let hz = frfs.frequencies[k];
        MAINS.iter().any(|mains| hz > 0.5 * mains && (hz - mains * (hz / mains).round()).abs() <= 0.5 * step)
    };
    if step > COARSEST {
        return None;
    }
    for k in (margin..lines.saturating_sub(margin)).filter(|k| of_mains(*k)) {
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
    let near = [k - b, k - a, k + a, k + b].map(|j| frf[j].norm()).into_iter().fold(0.0, f64::max);
    let spike = off(k);
    if frf[k].norm() <= STANDS_OUT * near {
        return false;
    }
    let mut deviations: Vec<f64> = APART.flat_map(|j| [off(k - j), off(k + j)]).collect();
    deviations.sort_by(f64::total_cmp);
    let roughness = deviations[deviations.len() / 2];
    // Odd part q x + R/x of the lines at ±a and ±b.
    let odd = |j: usize| (frf[k + j] - frf[k - j]) * 0.5;
    let (near, far) = (a as f64, b as f64);
    let pole = (odd(a) * far - odd(b) * near).norm() / (far / near - near / far);
    spike > OVER_ROUGHNESS * roughness && pole < NO_POLE * roughness
}

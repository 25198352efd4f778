//! Resonance peaks of the unbalance response.

use crate::analysis::peaks::peaks;
use crate::analysis::unbalance::Orbit;
use crate::results::{DiscOrbit, ResponsePeak, UnbalanceChannel, UndampedPeak, is_rotation, unit_of};
use rotordyn_linalg::Complex64;

/// Amplitude, as a fraction of the largest of the same unit, below which a response has no peaks: what is left where shares of
/// several unbalances cancel, by their last given digit.
const NEGLIGIBLE: f64 = 1e-5;

/// Peaks of every channel and of every orbit's semi-major axis, by speed; without the negligible ones, and without the highest
/// points beside an undamped mode, whose height is that of the grid.
pub(super) fn response_peaks(
    speeds: &[f64],
    channels: &[UnbalanceChannel],
    orbits: &[DiscOrbit],
    undamped: &[UndampedPeak],
) -> Vec<ResponsePeak> {
    let mut found = Vec::new();
    // Largest finite amplitude of every unit.
    let mut largest: Vec<(&str, f64)> = Vec::new();
    let mut add = |response: String, unit: &'static str, sizes: Vec<f64>| {
        let size = sizes.iter().copied().filter(|size| size.is_finite()).fold(0.0, f64::max);
        match largest.iter_mut().find(|(of, _)| *of == unit) {
            Some((_, so_far)) => *so_far = so_far.max(size),
            None => largest.push((unit, size)),
        }
        let of = |peak| ResponsePeak { response: response.clone(), unit: unit.into(), peak };
        let infinite: Vec<f64> = UndampedPeak::of(undamped, &response).collect();
        let resolved =
            peaks(speeds, &sizes).into_iter().filter(|peak| !is_beside(speeds, peak.at, &infinite));
        found.extend(resolved.map(of));
    };
    for channel in channels {
        let unit = unit_of(channel.probe.quantity, is_rotation(&channel.probe.direction));
        let sizes = channel.amplitude.iter().map(|[re, im]| re.hypot(*im)).collect();
        add(channel.probe.name.clone(), unit, sizes);
    }
    for disc in orbits {
        let complex = |[re, im]: [f64; 2]| Complex64::new(re, im);
        let major = |(x, y): (&[f64; 2], &[f64; 2])| Orbit::new(complex(*x), complex(*y)).major;
        add(format!("orbit of disc.{}", disc.name), "m", disc.x.iter().zip(&disc.y).map(major).collect());
    }
    let of_unit = |unit: &str| largest.iter().find(|(of, _)| *of == unit).map_or(0.0, |(_, size)| *size);
    found.retain(|one| one.peak.amplitude > NEGLIGIBLE * of_unit(&one.unit));
    found.sort_by(|a, b| a.peak.at.total_cmp(&b.peak.at));
    found
}

/// Whether one of the speeds `infinite` lies in the intervals of the grid that a peak is found from: that around it, and one on
/// either side.
fn is_beside(speeds: &[f64], peak: f64, infinite: &[f64]) -> bool {
    let next = speeds.partition_point(|speed| *speed < peak);
    let low = speeds.get(next.saturating_sub(2)).copied().unwrap_or(0.0);
    let high = speeds.get(next + 1).or(speeds.last()).copied().unwrap_or(f64::INFINITY);
    infinite.iter().any(|at| (low..=high).contains(at))
}

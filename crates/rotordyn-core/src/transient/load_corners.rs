//! Corners of load histories within a step: a step sees the load at its ends and stages only.

use super::system::System;
use crate::model::LoadFactor;

/// Error of the impulse over a step by the trapezoidal rule, as a share of the largest load times the step, above which fixed steps
/// are divided at corners. A load that rises from nothing to its largest value within n steps has an error of up to 1/(8 n).
const IMPULSE_ERROR: f64 = 0.02;
/// Corners closer to an end of a step than this share of it are at the end.
const AT_END: f64 = 1e-6;

/// Which load histories have corners; the largest factor of each.
pub(super) struct LoadCorners {
    histories: Vec<(usize, f64)>,
}

impl LoadCorners {
    pub fn new(system: &System) -> Self {
        let largest = |points: &[[f64; 2]]| points.iter().fold(0.0, |m: f64, point| m.max(point[1].abs()));
        let histories = system.varying_loads.iter().enumerate().filter_map(|(k, load)| match &load.factor {
            LoadFactor::Table(points) if points.len() > 1 => Some((k, largest(points))),
            _ => None,
        });
        Self { histories: histories.collect() }
    }

    /// Whether a step between two times is to be divided at the corners within: with `all` wherever there are some.
    #[inline]
    pub fn divide(&self, system: &System, from: f64, to: f64, all: bool) -> bool {
        self.histories.iter().any(|(k, largest)| {
            let factor = &system.varying_loads[*k].factor;
            let LoadFactor::Table(points) = factor else { return false };
            let within = corners(points, from, to);
            if within.is_empty() || all {
                return !within.is_empty();
            }
            // Trapezoidal rule over the step, and over the pieces between the corners.
            let (mut impulse, mut before) = (0.0, [from, factor.at(from)]);
            let end = [to, factor.at(to)];
            let whole = 0.5 * (to - from) * (before[1] + end[1]);
            for point in within.iter().chain([&end]) {
                impulse += 0.5 * (point[0] - before[0]) * (before[1] + point[1]);
                before = *point;
            }
            (impulse - whole).abs() > IMPULSE_ERROR * largest * (to - from)
        })
    }

    /// The first corner between two times.
    pub fn next(&self, system: &System, from: f64, to: f64) -> Option<f64> {
        let firsts = self.histories.iter().filter_map(|(k, _)| match &system.varying_loads[*k].factor {
            LoadFactor::Table(points) => corners(points, from, to).first().map(|point| point[0]),
            _ => None,
        });
        firsts.reduce(f64::min)
    }
}

/// Points of a history between two times, without those at the ends.
#[inline]
fn corners(points: &[[f64; 2]], from: f64, to: f64) -> &[[f64; 2]] {
    let margin = AT_END * (to - from);
    let first = points.partition_point(|point| point[0] <= from + margin);
    let end = points.partition_point(|point| point[0] < to - margin);
    points.get(first..end).unwrap_or_default()
}

//! The strongest line of each record over the shaft angle.

use std::f64::consts::TAU;

use rotordyn_signal::segment::Level;
use rotordyn_signal::spectrum::amplitude_spectrum;
use rotordyn_signal::window::WindowKind;

/// Lowest order looked at: below is the slow motion of a run-up.
const LOWEST: f64 = 0.4;
/// Bins of the spectrum by which a line may be off a named order.
const NEAR: f64 = 1.0;

/// To what an order without a name is rounded.
const ROUNDED: f64 = 1e-3;

/// Orders of the highest line of every record that no order of `known` has, each once; a line within a bin of a multiple of
/// one of `bases` is that multiple.
///
/// `angle`: of the shaft at every sample \[rad\]; `highest`: order up to which lines are looked at.
pub(super) fn strongest_orders<'a>(
    angle: &[f64],
    records: impl Iterator<Item = &'a [f64]>,
    known: &[f64],
    bases: &[f64],
    highest: f64,
) -> Vec<f64> {
    let mut found: Vec<f64> = Vec::new();
    for record in records {
        let Some(line) = strongest_line(angle, record, highest) else { continue };
        let step = TAU / (angle[angle.len() - 1] - angle[0]).abs();
        let multiples = bases.iter().map(|base| base * (line / base).round().max(1.0));
        let named = multiples.min_by(|a, b| (a - line).abs().total_cmp(&(b - line).abs()));
        let order = named
            .filter(|order| (order - line).abs() <= NEAR * step)
            .unwrap_or((line / ROUNDED).round() * ROUNDED);
        if known.iter().chain(&found).all(|other| (other - order).abs() > NEAR * step) {
            found.push(order);
        }
    }
    found
}

/// Order of the highest line of a record; `None` of one that does not vary, or of a shaft that does not turn one way.
fn strongest_line(angle: &[f64], record: &[f64], highest: f64) -> Option<f64> {
    let (first, last) = (*angle.first()?, *angle.last()?);
    let sign = (last - first).signum();
    let count = angle.len();
    if count < 3 || !angle.windows(2).all(|pair| (pair[1] - pair[0]) * sign > 0.0) {
        return None;
    }
    // Equal steps of the angle.
    let step = (last - first).abs() / (count - 1) as f64;
    let mut k = 0;
    let at = |n: usize| {
        let place = step * n as f64;
        while k + 2 < count && (angle[k + 1] - first) * sign < place {
            k += 1;
        }
        let [low, high] = [angle[k], angle[k + 1]].map(|angle| (angle - first) * sign);
        record[k] + (record[k + 1] - record[k]) * (place - low) / (high - low)
    };
    let even: Vec<f64> = (0..count).map(at).collect();
    let spectrum = amplitude_spectrum(&even, TAU / step, WindowKind::Hann, Level::Rms).ok()?;
    let lines = spectrum.frequencies.iter().zip(&spectrum.values);
    let inside = lines.filter(|(order, value)| **order >= LOWEST && **order <= highest && **value > 0.0);
    inside.max_by(|a, b| a.1.total_cmp(b.1)).map(|(order, _)| *order)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lines over the angle of a shaft that speeds up, turning either way.
    #[test]
    fn lines_between_known_orders_are_found_and_named() {
        for sign in [1.0, -1.0] {
            let angle: Vec<f64> =
                (0..8000).map(|k| f64::from(k) / 1000.0).map(|t| sign * (60.0 * t + t * t)).collect();
            let record = |order: f64, other: f64| -> Vec<f64> {
                angle.iter().map(|a| (order * a).cos() + 0.3 * (other * a).sin()).collect()
            };
            // 4 x 3.5721, 1x known already, 5.33 of nothing.
            let records = [record(14.2885, 1.0), record(1.0, 2.0), record(5.33, 2.0), record(14.2885, 3.0)];
            let of = records.iter().map(Vec::as_slice);
            let found = strongest_orders(&angle, of, &[1.0, 2.0, 3.5721], &[1.0, 3.5721], 40.0);
            assert_eq!(found.len(), 2, "{found:?}");
            assert!((found[0] - 14.2884).abs() < 1e-12 && (found[1] - 5.33).abs() < 0.02, "{found:?}");
        }
    }

    #[test]
    fn a_constant_record_has_no_line() {
        let angle: Vec<f64> = (0..100).map(f64::from).collect();
        let records: [&[f64]; 1] = [&[2.0; 100]];
        assert!(strongest_orders(&angle, records.into_iter(), &[], &[1.0], 0.5).iter().all(|o| *o < 0.5));
        let none: [&[f64]; 1] = [&[0.0; 100]];
        assert!(strongest_orders(&angle, none.into_iter(), &[], &[1.0], 0.5).is_empty());
    }
}

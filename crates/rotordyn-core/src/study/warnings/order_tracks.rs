//! Orders that the bandwidth of the Vold-Kalman filter does not separate.

use crate::document::number;
use crate::study::Results;
use crate::warning::{Code, Warning};
use rotordyn_signal::order_tracks;

/// The closest pair of tracked orders, if it lies in one pass band.
pub(super) fn orders_in_one_band(results: &Results) -> Option<Warning> {
    let found = results.orders.iter().find(|found| found.tracks.is_some())?;
    let width = found.tracks.as_ref()?.bandwidth;
    let orders: Vec<f64> = found.cuts.iter().map(|(line, _)| line.order).collect();
    let distance = |[a, b]: &[usize; 2]| (orders[*a] - orders[*b]).abs();
    let pairs = order_tracks::orders_in_one_band(&orders, width);
    let closest = pairs.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    let [a, b] = closest.map(|k| &found.cuts[k].0.label);
    let text = format!(
        "order tracks: {b} is {} orders from {a}, within its pass band of {} orders",
        number(distance(closest), 3),
        number(width, 3)
    );
    Some(Warning::new(Code::OrdersInOneBand, "study.orders", text))
}

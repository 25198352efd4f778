//! Orders that the bandwidth of the Vold-Kalman filter does not separate, and maxima that window or bandwidth lower.

use crate::document::number;
use crate::results::OrderResult;
use crate::study::Results;
use crate::warning::{Code, Warning};
use rotordyn_signal::order::smear::Smear;
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

/// The cut and the track that lose most at their maximum, by the window and by the bandwidth.
pub fn smeared_maxima<'a>(orders: impl IntoIterator<Item = &'a OrderResult>) -> Vec<Warning> {
    let orders: Vec<&OrderResult> = orders.into_iter().collect();
    let label = |found: &OrderResult, order: f64| {
        let line = found.cuts.iter().find(|(line, _)| line.order == order);
        line.map_or_else(|| format!("{}x", number(order, 4)), |(line, _)| line.label.clone())
    };
    let worst = |smears: &dyn Fn(&OrderResult) -> Vec<Smear>| {
        let of = |found: &&'a OrderResult| {
            let found = *found;
            smears(found).into_iter().map(move |smear| (found, smear))
        };
        let all: Vec<(&OrderResult, Smear)> = orders.iter().flat_map(of).collect();
        let (found, smear) = *all.iter().max_by(|a, b| a.1.loss.total_cmp(&b.1.loss))?;
        let more = match all.len() - 1 {
            0 => String::new(),
            1 => " (and one more)".into(),
            n => format!(" (and {n} more)"),
        };
        let place =
            format!("{} of {} at {:.0} rpm{more}", label(found, smear.order), found.channel, smear.rpm);
        Some((found, smear, place))
    };
    let cuts = worst(&|found| found.spectrogram.smeared.clone()).map(|(found, smear, place)| {
        let resolution = found.spectrogram.orders.get(1).copied().unwrap_or(1.0);
        let text = format!(
            "order cuts: the maximum of {place} is {:.0} % or more too low: the amplitude changes within the window of {} \
             revolutions",
            100.0 * smear.least_loss(),
            number(1.0 / resolution, 3)
        );
        let advice = format!(
            "study.orders.resolution = {} (--resolution) halves the window",
            number((2.0 * resolution).min(1.0), 3)
        );
        Warning::new(Code::OrderSmear, "study.orders", text).advise(advice)
    });
    let of_tracks = |found: &OrderResult| found.tracks.as_ref().map_or(Vec::new(), |t| t.smeared.clone());
    let tracks = worst(&of_tracks).map(|(found, smear, place)| {
        let width = found.tracks.as_ref().map_or(0.0, |tracks| tracks.bandwidth);
        let text = format!(
            "order tracks: the maximum of {place} is {:.0} % or more too low: the amplitude changes faster than the bandwidth \
             of {} orders lets through",
            100.0 * smear.least_loss(),
            number(width, 3)
        );
        let advice = format!("study.orders.bandwidth (--bandwidth) of {} or more", number(3.0 * width, 3));
        Warning::new(Code::OrderSmear, "study.orders", text).advise(advice)
    });
    cuts.into_iter().chain(tracks).collect()
}

//! Orders asked for by number or by name: 7, 1x, BPFO, "2 BPFO".

use rotordyn::results::{BearingWithOrders, OrderLine, ShaftOrders, SignalResult};
use rotordyn::signal::order::smear::Smear;
use rotordyn::signal::order_neighbours::Neighbour;
use rotordyn::signal::order_tracks::orders_in_one_band;
use rotordyn::signal::tacho_jitter::JitterLeak;

use super::super::terminal::number;
use super::input::InputProblems;

/// The order lines of the words; problems for those that are none.
pub fn lines(
    words: &[String],
    bearing: Option<&BearingWithOrders>,
    findings: &mut InputProblems,
) -> Vec<OrderLine> {
    let mut lines: Vec<OrderLine> = Vec::new();
    for word in words {
        match line(word.trim(), bearing) {
            Ok(line) if lines.iter().any(|known| known.order == line.order) => {}
            Ok(line) => lines.push(line),
            Err(problem) => findings.problem(format!("--orders {word}: {problem}")),
        }
    }
    lines
}

/// A warning for every pair of tracked orders that the bandwidth does not separate, and for every cut and track that reads a line of
/// another order.
pub fn one_band_warnings(result: &SignalResult) -> Vec<String> {
    let Some(found) = &result.orders else { return Vec::new() };
    let mut texts: Vec<String> = Vec::new();
    if let Some(tracks) = &found.tracks {
        let orders: Vec<f64> = tracks.tracks.iter().map(|track| track.order).collect();
        let text = |pair: [usize; 2]| {
            let [a, b] = pair.map(|k| &found.cuts[k].0.label);
            let width = number(tracks.bandwidth, 3);
            format!("{}: {a} and {b} lie in one pass band of {width} orders", result.channel)
        };
        texts.extend(orders_in_one_band(&orders, tracks.bandwidth).into_iter().map(text));
    }
    texts.extend((0..found.cuts.len()).flat_map(|place| neighbour_warnings(result, found, place)));
    texts
}

/// Warnings if a cut or its track reads the line of a shaft harmonic or of another cut.
fn neighbour_warnings(result: &SignalResult, found: &ShaftOrders, place: usize) -> Vec<String> {
    let own = &found.cuts[place].0;
    let resolution = found.map.orders.get(1).copied().unwrap_or(1.0);
    let highest = found.map.orders.last().map_or(0, |order| order.floor() as usize);
    let mut others: Vec<f64> = found.cuts.iter().map(|(line, _)| line.order).collect();
    others.extend(
        (1..=highest)
            .map(|order| order as f64)
            .filter(|order| !found.cuts.iter().any(|c| c.0.order == *order)),
    );
    let label = |order: f64| {
        let line = found.cuts.iter().find(|(line, _)| line.order == order);
        line.map_or_else(|| format!("{order}x"), |(line, _)| line.label.clone())
    };
    let channel = &result.channel;
    let in_cut = found.map.neighbour_in_cut(&found.average, own.order, resolution, &others);
    let cut_text = |Neighbour { order, read, part }: Neighbour| {
        let apart = (order - own.order).abs();
        format!(
            "{channel}: of the RMS {} in the cut of {} about {} is the line of {}, {} orders beside it: the resolution of {} orders does \
             not part them; --order-resolution {} does",
            number(read, 3),
            own.label,
            number(part, 3),
            label(order),
            number(apart, 3),
            number(resolution, 3),
            number(0.3 * apart, 2)
        )
    };
    let tracked = found.tracks.as_ref().and_then(|tracks| Some((tracks, tracks.tracks.get(place)?)));
    let in_track = tracked.and_then(|(tracks, track)| {
        // Orders that are tracked together are told apart by the filter.
        let is_tracked = |order: &f64| tracks.tracks.iter().any(|track| track.order == *order);
        let others: Vec<f64> = others.iter().copied().filter(|order| !is_tracked(order)).collect();
        let squares: f64 = track.amplitude.iter().map(|a| 0.5 * a * a).sum();
        let read = squares / track.amplitude.len().max(1) as f64;
        let width = tracks.bandwidth;
        let found = found.map.neighbour_in_track(&found.average, own.order, width, read, &others)?;
        Some((width, found))
    });
    let track_text = |(width, Neighbour { order, read, part }): (f64, Neighbour)| {
        let apart = (order - own.order).abs();
        format!(
            "{channel}: of the RMS {} tracked for {} about {} is the line of {}, {} orders beside it, which the bandwidth of {} orders lets \
         through; --bandwidth {} does not, or track both",
            number(read, 3),
            own.label,
            number(part, 3),
            label(order),
            number(apart, 3),
            number(width, 3),
            number(0.8 * apart, 2)
        )
    };
    in_cut.map(cut_text).into_iter().chain(in_track.map(track_text)).collect()
}

/// A warning for every cut and track whose maximum its window or bandwidth lowers.
pub fn smear_warnings(result: &SignalResult) -> Vec<String> {
    let Some(found) = &result.orders else { return Vec::new() };
    let place = |smear: &Smear| {
        let line = found.cuts.iter().find(|(line, _)| line.order == smear.order);
        let label =
            line.map_or_else(|| format!("{}x", number(smear.order, 4)), |(line, _)| line.label.clone());
        format!("{}: the maximum of {label} at {:.0} rpm", result.channel, smear.rpm)
    };
    let resolution = found.map.orders.get(1).copied().unwrap_or(1.0);
    let cut = |smear: &Smear| {
        format!(
            "{} is {:.0} % or more too low in the cut: the amplitude changes within the window of {} revolutions; \
             --order-resolution {} halves it",
            place(smear),
            100.0 * smear.least_loss(),
            number(1.0 / resolution, 3),
            number((2.0 * resolution).min(1.0), 3)
        )
    };
    let track = |(smear, width): (&Smear, f64)| {
        format!(
            "{} is {:.0} % or more too low in the track: the amplitude changes faster than the bandwidth of {} orders lets \
             through; --bandwidth {} or more shows it",
            place(smear),
            100.0 * smear.least_loss(),
            number(width, 3),
            number(3.0 * width, 3)
        )
    };
    let tracks = found.tracks.iter().flat_map(|t| t.smeared.iter().map(|smear| (smear, t.bandwidth)));
    found.map.smeared.iter().map(cut).chain(tracks.map(track)).collect()
}

/// A warning for every order that the tacho's jitter lowers, or that has a part of a stronger one by it.
pub fn jitter_warnings(result: &SignalResult) -> Vec<String> {
    let Some(found) = &result.orders else { return Vec::new() };
    let label = |track: usize| &found.cuts[track].0.label;
    let warning = |leak: &JitterLeak| {
        if leak.track == leak.neighbour {
            return format!(
                "{}: {} is up to {:.0} % too low: the shaft angle from the tacho pulses jitters",
                result.channel,
                label(leak.track),
                100.0 * leak.leak / (leak.leak + leak.amplitude)
            );
        }
        format!(
            "{}: of the amplitude {} read for {} about {} (RMS over the run) is of {}: the jitter of the tacho pulses modulates it",
            result.channel,
            number(leak.amplitude, 3),
            label(leak.track),
            number(leak.leak, 2),
            label(leak.neighbour)
        )
    };
    found.jitter_leaks.iter().map(warning).collect()
}

fn line(word: &str, bearing: Option<&BearingWithOrders>) -> Result<OrderLine, String> {
    const EXPECTED: &str = "expected a number, or BPFO, BPFI, BSF, FTF as \"2 BPFO\"";
    let factor = |text: &str| match text.trim().trim_end_matches(['x', 'X']).parse::<f64>() {
        Ok(value) if value > 0.0 && value.is_finite() => Ok(value),
        _ => Err(EXPECTED.to_string()),
    };
    let Some(start) = word.find(|c: char| c.is_ascii_alphabetic() && !c.eq_ignore_ascii_case(&'x')) else {
        let order = factor(word)?;
        return Ok(OrderLine { label: format!("{order}x"), order, bearing: false });
    };
    let (multiple, name) = word.split_at(start);
    let multiple = if multiple.trim().is_empty() { 1.0 } else { factor(multiple)? };
    let name = name.trim().to_uppercase();
    let Some(bearing) = bearing else {
        return Err("names of bearing orders need --bearing or --bearing-orders".into());
    };
    let orders = &bearing.orders;
    let order = match name.as_str() {
        "BPFO" => orders.bpfo,
        "BPFI" => orders.bpfi,
        "BSF" => orders.bsf,
        "FTF" => orders.ftf,
        _ => return Err(EXPECTED.into()),
    };
    let label = if multiple == 1.0 { name } else { format!("{multiple} {name}") };
    Ok(OrderLine { label, order: multiple * order, bearing: true })
}

#[cfg(test)]
mod tests {
    use super::*;
    use rotordyn::bearing::CharacteristicOrders;

    #[test]
    fn orders_by_number_and_by_name() {
        let orders = CharacteristicOrders { ftf: 0.4, bpfo: 3.6, bpfi: 5.4, bsf: 2.3 };
        let bearing = BearingWithOrders {
            name: "b".into(),
            source: String::new(),
            orders,
            balls: 9,
            raceway_radii: None,
        };
        let found =
            |word: &str| line(word, Some(&bearing)).map(|line| (line.label, line.order, line.bearing));
        assert_eq!(found("7"), Ok(("7x".into(), 7.0, false)));
        assert_eq!(found("1x"), Ok(("1x".into(), 1.0, false)));
        assert_eq!(found("7.144"), Ok(("7.144x".into(), 7.144, false)));
        assert_eq!(found("bpfo"), Ok(("BPFO".into(), 3.6, true)));
        assert_eq!(found("2 BSF"), Ok(("2 BSF".into(), 4.6, true)));
        for wrong in ["-1", "0", "BPF", "two", "nan", "1e400", ""] {
            assert!(line(wrong, Some(&bearing)).is_err(), "{wrong}");
        }
        assert!(line("BPFO", None).unwrap_err().contains("--bearing"));
    }
}
